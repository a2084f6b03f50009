//! Each file of the emitted C with one operation changed: the comparison with the Rust notices.

use crate::reference::reference;
use crate::{SETS, build, cases, differing, files, program};

/// A file, and a text of it with what stands in its place: one file of each that is written by hand,
/// that of a kind, and that of the set.
const MUTANTS: [(&str, &str, &str); 12] = [
    (
        "precess_joint.c",
        "spring + (viscous - passive->coulomb * q[0] * (1.0 / root))",
        "spring + viscous - passive->coulomb * q[0] * (1.0 / root)",
    ),
    ("precess_gravity.c", "powers[1] = powers[0] * per_r", "powers[1] = mu * (per_r * per_r)"),
    ("precess_attitude.c", "1.0 - (s2 * q[2] + s3 * q[3])", "1.0 - s2 * q[2] - s3 * q[3]"),
    ("precess_device.c", "drives[k].torque + along", "drives[k].torque - along"),
    (
        "precess_evaluation.c",
        "force[k] = force[k] + third[k]",
        "force[k] = force[k] + 0.0 * third[k]",
    ),
    ("mixed.c", "start[k] + (0.0 + offset * s)", "start[k] + weight * s + (offset - weight) * s"),
    (
        "precess_arithmetic.c",
        "return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];",
        "return a[0] * b[0] + (a[1] * b[1] + a[2] * b[2]);",
    ),
    ("precess_body.c", "+ (m[1] * r[1] + m[2] * r[2])", "+ m[1] * r[1] + m[2] * r[2]"),
    (
        "precess_solve.c",
        "b[2] - f->l_31 * b[0] - f->l_32 * out[1]",
        "b[2] - (f->l_31 * b[0] + f->l_32 * out[1])",
    ),
    (
        "precess_sin_cos.c",
        "x - (x * x2 * polynomial(x2, x4, SINE) + excess * parabola)",
        "x - x * x2 * polynomial(x2, x4, SINE) - excess * parabola",
    ),
    (
        "precess_wrap.c",
        "guess + (sine * cosine_guess - cosine * sine_guess)",
        "guess + sine * cosine_guess - cosine * sine_guess",
    ),
    ("precess_vscmg_device.c", " + gravity.wrenches.", " - gravity.wrenches."),
];

#[test]
#[ignore = "long: `cargo xtask test --all`"]
fn a_sum_in_another_order_is_noticed() {
    let (name, names) = SETS[1];
    let (cases, files) = (cases(names), files(name, names));
    let expected: Vec<_> = cases.iter().map(reference).collect();
    let Some(compiler) = build::compilers().first().copied() else { return };
    for (path, right, wrong) in MUTANTS {
        let mut files = files.clone();
        let file = files.iter_mut().find(|file| file.path == path).expect("a file");
        assert!(file.text.contains(right), "{path}: {right}");
        file.text = file.text.replacen(right, wrong, 1);
        let program = program(["mutants", name], compiler, &files, &[]);
        let noticed = differing(&program, &cases, &expected);
        assert!(noticed.is_some(), "{path}: nothing seen");
    }
}
