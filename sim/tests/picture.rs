//! The picture in the README is the one that a run draws.
//!
//! Bytes are compared on one platform: the equations of motion have the same bits everywhere, but
//! the control of the integrator's step takes powers from the platform's own libm, and a step cut
//! elsewhere moves a curve by rounding, which may turn the last digit of a point.

#![cfg(all(target_os = "linux", target_arch = "x86_64"))]

use std::fs;
use std::path::Path;

use precess::outcome::outcome;
use precess::output::plates::plates;
use precess::run::Settings;
use precess::scenario::table1::{Drive, Imbalance, Variant};

#[test]
fn the_committed_picture_is_what_the_run_draws() {
    let name = "table1-printed-200-angular-velocity.svg";
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../docs").join(name);
    let committed = fs::read_to_string(path).expect("docs holds the README's picture");
    let variant = Variant { imbalance: Imbalance::Printed, drive: Drive::Wheel200 };
    let outcome =
        outcome(variant.scenario(), Settings::default(), &mut |_| {}).expect("Table 1 runs");
    let plates = plates(&outcome);
    let plate =
        plates.iter().find(|plate| format!("{}-{}.svg", variant.name(), plate.name) == name);
    let drawn = plate.expect("a figure of angular velocity").figure.file().expect("it is drawn");
    assert!(
        drawn == committed,
        "docs/{name} is stale; run `cargo xtask demo` and copy target/demo/{name} to docs/"
    );
}
