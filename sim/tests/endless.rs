//! A file without an end is refused: as a scenario, as its base, as a table.

#![cfg(unix)]

use std::path::Path;

use precess::file::{from_file, from_toml};

/// It gives zeros for as long as it is read.
const ENDLESS: &str = "/dev/zero";

#[test]
fn a_scenario_or_a_base_without_an_end_is_refused() {
    let errors = from_file(Path::new(ENDLESS), &[]).expect_err("no scenario").to_string();
    assert!(errors.contains("/dev/zero has more than"), "{errors}");
    let text = format!("format = 1\nbase = \"{ENDLESS}\"\n");
    let errors = from_toml("based", &text, Path::new("")).expect_err("no base").to_string();
    assert!(errors.contains("/dev/zero has more than") && errors.contains("based:2"), "{errors}");
}

#[test]
fn a_table_without_an_end_is_refused() {
    let text = format!(
        "format = 1\n[hub]\nmass = \"9 kg\"\ninertia = \"1, 1, 1 kg m^2\"\n[run]\nduration = \"1 s\"\n\
         [[wrench]]\non = \"hub\"\n\
         force.x = {{ table = \"{ENDLESS}\", column = \"f\", unit = \"N\", interpolation = \"hold\" }}\n"
    );
    let errors = from_toml("table", &text, Path::new("")).expect_err("no table").to_string();
    assert!(errors.contains("/dev/zero: more than 100000000 bytes"), "{errors}");
}
