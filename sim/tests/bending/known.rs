//! The beam of `known-tip-wheel.toml` against its closed form, and a force on a node against the
//! accelerance.

use std::f64::consts::{PI, TAU};

use nalgebra::{Complex, Matrix2, Vector2};

use super::{columns, file, ran, text};

/// Length, m, mass, kg/m, and bending stiffness, N m², of the beam.
const BEAM: [f64; 3] = [1.2, 2.5, 4000.0];

/// Frequency, and deflection and slope of the tip, of the k-th mode of a cantilever, from 1.
fn cantilever(k: u32) -> [f64; 3] {
    let [length, per_length, stiffness] = BEAM;
    let mut x = (f64::from(k) - 0.5) * PI;
    for _ in 0..60 {
        let slope = -x.sin() - x.sinh() / x.cosh().powi(2);
        x -= (x.cos() + 1.0 / x.cosh()) / slope;
    }
    let sign = if k % 2 == 1 { 1.0 } else { -1.0 };
    let shape = 2.0 * sign / (per_length * length).sqrt();
    let ratio = (x.cosh() + x.cos()) / (x.sinh() + x.sin());
    [(x / length).powi(2) * (stiffness / per_length).sqrt(), shape, shape * x * ratio / length]
}

/// Twelve digits of the file's modes are those of the cantilever.
const MODES_MISS: f64 = 1e-12;
/// What the closed form, linear in the deformation, leaves out: products with a slope of 6 µrad.
/// Measured: 2.7e-6 of radius and slope.
const WHIRL_MISS: f64 = 1e-5;

#[test]
#[ignore = "long: `cargo xtask test --all`"]
fn a_tip_wheel_whirls_by_the_modal_receptance() {
    let scenario = file("known-tip-wheel.toml");
    let structure = scenario.structure.as_ref().expect("a structure");
    let wheel = scenario.devices.0[0].parameters().bodies[0];
    let rate = scenario.initial.devices.0[0][0][1];
    let zeta = structure.modes[0].damping;
    let mut receptance = Matrix2::zeros();
    for k in 1..=3_u32 {
        let [frequency, shape, slope] = cantilever(k);
        for plane in 0..2 {
            let mode = 2 * (k as usize - 1) + plane;
            let found = structure.nodes[0].shapes[mode];
            let tip = if plane == 0 { [found[1], found[5]] } else { [found[2], -found[4]] };
            let pairs =
                [(structure.modes[mode].frequency, frequency), (tip[0], shape), (tip[1], slope)];
            for (found, wanted) in pairs {
                assert!((found / wanted - 1.0).abs() < MODES_MISS, "{mode}: {found} {wanted}");
            }
        }
        let gain = Complex::new(frequency.powi(2) - rate.powi(2), 2.0 * zeta * frequency * rate);
        let v = Vector2::new(Complex::from(shape), Complex::from(slope));
        receptance += v * v.transpose() / gain;
    }
    // (w, theta) = R Omega^2 (m (w + d), (J_t - J_s) theta)
    let (mass, tilt) = (wheel.mass, wheel.inertia.m22 - wheel.inertia.m11);
    let of = |value: f64| Complex::from(rate * rate * value);
    let inertial = Matrix2::from_diagonal(&Vector2::new(of(mass), of(tilt)));
    let applied = Vector2::new(of(mass * wheel.centre[1]), of(0.0));
    let system = Matrix2::identity() - receptance * inertial;
    let [w, theta] = (system.try_inverse().expect("off resonance") * (receptance * applied)).into();

    // At the wheel's own angle: damping of the beam takes 2e-7 of its rate in the run.
    let (samples, _) = ran(&scenario);
    let names = [
        "wheel.theta",
        "tip.displacement_y",
        "tip.displacement_z",
        "tip.rotation_y",
        "tip.rotation_z",
    ];
    let mut miss: f64 = 0.0;
    for [angle, y, z, about_y, about_z] in columns(&samples, names) {
        let turn = Complex::from_polar(1.0, angle);
        let deflection = (Complex::new(y, z) - w * turn).norm() / w.norm();
        let slope = (Complex::new(about_z, -about_y) - theta * turn).norm() / theta.norm();
        miss = miss.max(deflection).max(slope);
    }
    println!("radius {:e} m, miss {miss:e}", w.norm());
    assert!(miss < WHIRL_MISS, "{miss:e}");
}

/// The transient at 9 Hz and 1 % has decayed to exp(-0.01 w 20 s), 1e-5, of the amplitude.
const STEADY_MISS: f64 = 1e-4;

/// One mode, a free hub, a force of 7 Hz on the tip: `a = A F` with the accelerance of rigid body
/// and mode, by the equations of docs/structure.md solved for the unknowns at once.
#[test]
fn a_force_on_a_node_accelerates_it_by_the_accelerance() {
    let hertz = 7.0;
    let (w, zeta, frequency) = (TAU * hertz, 0.01, TAU * 9.0);
    let scenario = text(&format!(
        "format = 1\n[hub]\nmass = \"40 kg\"\ninertia = \"3, 8, 7 kg m^2\"\n\
         [structure]\ncontains_devices = false\n[[structure.point]]\nname = \"tip\"\n\
         [[structure.node]]\nname = \"tip\"\nposition = \"1.2, 0, 0 m\"\n\
         [[structure.mode]]\nfrequency = \"9 Hz\"\ndamping = {zeta}\n\
         linear_momentum = [0, 0, 1.2]\nangular_momentum = [0, -1.1, 0]\n\
         [[structure.mode.shape]]\nnode = \"tip\"\ntranslation = [0, 0, 1.1]\nrotation = [0, -1.3, 0]\n\
         [[wrench]]\non = \"tip\"\nforce = {{ z = {{ sine = \"1 mN\", frequency = \"{hertz} Hz\" }} }}\n\
         [run]\nduration = \"24 s\"\n[output]\nrate = \"700 Hz\"\ncolumns = [\"tip.acceleration\"]\n",
    ));
    // Unknowns: acceleration of B in z, angular acceleration in y, eta''. The force does
    // f (z - 1.2 about y + 1.1 eta). The modal stiffness is (w0^2 + 2 i zeta w0 w) / -w^2 eta''.
    let stiffness = -Complex::new(frequency * frequency, 2.0 * zeta * frequency * w) / (w * w);
    let c = Complex::from;
    let matrix = nalgebra::Matrix3::new(
        c(40.0),
        c(0.0),
        c(1.2),
        c(0.0),
        c(8.0),
        c(-1.1),
        c(1.2),
        c(-1.1),
        c(1.0) + stiffness,
    );
    let force = nalgebra::Vector3::new(c(1.0), c(-1.2), c(1.1));
    let motion = matrix.try_inverse().expect("off resonance") * force;
    let accelerance = motion.dot(&force);

    // The last four seconds are 28 periods: their Fourier coefficient at 7 Hz.
    let (samples, _) = ran(&scenario);
    let rows = columns(&samples, ["time", "tip.acceleration_z"]);
    let last: Vec<_> = rows.iter().filter(|[time, _]| (20.0..23.9999).contains(time)).collect();
    assert_eq!(last.len(), 2800);
    let sum: Complex<f64> = last.iter().map(|[time, a]| Complex::from_polar(*a, -w * time)).sum();
    // sin = Im exp(i w t): the coefficient of exp(i w t) is A F / 2i.
    let found = sum / 2800.0 * Complex::new(0.0, 2.0) / 1e-3;
    let miss = (found - accelerance).norm() / accelerance.norm();
    println!("{accelerance} {found} {miss:e}");
    assert!(miss < STEADY_MISS, "{found}, not {accelerance}: {miss:e}");
}
