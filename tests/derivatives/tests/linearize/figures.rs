//! Errors of the derivatives over the spacecraft of the suite, for docs/accuracy.md: a line each for
//! those by states and inputs and those by parameters, with the worst, the median and how many
//! spacecraft. The same bytes on every run.

use crate::{accuracy, parameters};

/// The file that is written, for `cargo xtask accuracy`.
const FILE: &str = "PRECESS_FIGURES";

#[test]
#[ignore = "writes a file: `cargo xtask accuracy` runs it"]
fn figures_for_the_accuracy_page() {
    let path = std::env::var_os(FILE).expect("the file to be written, by `cargo xtask accuracy`");
    let rows = [
        (accuracy::measured(), accuracy::SPACECRAFT),
        (parameters::measured(), parameters::SPACECRAFT),
    ];
    let lines = rows.map(|((figures, _), spacecraft)| {
        format!("{:e} {:e} {spacecraft}\n", figures.worst(), figures.median())
    });
    std::fs::write(path, lines.concat()).expect("written");
}
