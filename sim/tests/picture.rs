//! The picture in the README is the one that a run draws.
//!
//! Bytes are compared on one platform: the equations of motion have the same bits everywhere, but
//! the control of the integrator's step takes powers from the platform's own libm, and a step cut
//! elsewhere moves a curve by rounding, which may turn the last digit of a point.

#![cfg(all(target_os = "linux", target_arch = "x86_64"))]

use std::fs;
use std::ops::ControlFlow;
use std::path::Path;

use precess::engine::run;
use precess::file::from_file;
use precess::record::IntervalRecorder;
use precess::report::Report;

#[test]
fn the_committed_picture_is_what_the_run_draws() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let (name, figure) = ("imaging-satellite", "angular-velocity");
    let path = root.join("docs").join(format!("{name}-{figure}.svg"));
    let committed = fs::read_to_string(path).expect("docs holds the README's picture");
    let read = from_file(&root.join("scenarios").join(format!("{name}.toml")), &[]);
    let (scenario, _) = read.unwrap_or_else(|errors| panic!("{errors}"));
    let mut report = Report::new(&scenario, &[]);
    let (from, to) = (0.0, 0.1);
    let mut part = IntervalRecorder::new([from, to], &mut report);
    run(&scenario, &mut part, &mut |time| {
        if time > to { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    })
    .expect("it runs");
    let figures = report.figures().expect("they are drawn");
    let (_, drawn) = figures.iter().find(|(of, _)| of == figure).expect("a figure of omega");
    assert!(
        *drawn == committed,
        "docs/{name}-{figure}.svg is stale; it is one of the files of `precess plot scenarios/{name}.toml --to '0.1 s' \
         --out target/picture`"
    );
}
