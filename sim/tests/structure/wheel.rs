//! Dynamic mass of a wheel, and the force of a mounted one, against the nonlinear solver.

use nalgebra::{Complex, DMatrix, DVector, Matrix3, Unit, Vector3, Vector6};
use precess::structure::RigidMass;
use precess::structure::accelerance::complex;
use precess::structure::dynamic_mass::Wheel;
use precess::structure::mounted::mounted_force;
use precess_dynamics::{Hub, Inputs, ReactionWheel, Spacecraft, State};

pub(crate) const I: Complex<f64> = Complex::new(0.0, 1.0);

pub(crate) fn hub() -> Hub {
    let inertia = Matrix3::new(8.0, 0.3, -0.2, 0.3, 7.0, 0.4, -0.2, 0.4, 6.0);
    Hub { m_b: 35.0, r_bc_b: Vector3::new(0.05, -0.02, 0.04), i_b_bc: inertia }
}

pub(crate) fn wheel(d: f64) -> ReactionWheel {
    let inertia = Matrix3::from_diagonal(&Vector3::new(0.02, 0.012, 0.012));
    let axis = Unit::new_normalize(Vector3::new(0.2, -0.5, 1.0));
    let mount = nalgebra::Rotation3::rotation_between(&Vector3::x(), &axis).expect("an angle");
    ReactionWheel {
        mount: mount.into_inner(),
        r_w_b: Vector3::new(0.3, 0.2, -0.1),
        d,
        ..ReactionWheel::bare_wheel(4.0, inertia)
    }
}

fn hub_mass() -> nalgebra::Matrix6<f64> {
    let hub = hub();
    RigidMass::about_centre(hub.m_b, hub.r_bc_b, hub.i_b_bc).matrix()
}

/// Acceleration and angular acceleration of B, of a free spacecraft with the wheel, by the nonlinear solver.
fn solved(
    wheel: ReactionWheel,
    rate: f64,
    theta: f64,
    omega: Vector3<f64>,
    f: &Vector6<f64>,
) -> Vector6<f64> {
    let craft = Spacecraft::new(&hub(), &[wheel]).expect("valid");
    let mut state: State<[ReactionWheel; 1]> = State::at_rest();
    state.omega = omega;
    state.devices[0].theta = theta;
    state.devices[0].spin = rate;
    let mut inputs: Inputs<[ReactionWheel; 1]> = Inputs::none();
    inputs.force = f.fixed_rows::<3>(0).into_owned();
    inputs.torque_b = f.fixed_rows::<3>(3).into_owned();
    let found = craft.accelerations(&state, &inputs).expect("regular");
    let [a, alpha] = [found.r_b_n_ddot, found.omega_dot];
    Vector6::new(a.x, a.y, a.z, alpha.x, alpha.y, alpha.z)
}

/// Blocked force of a wheel with static imbalance, moments about B.
pub(crate) fn blocked(wheel: &ReactionWheel, rate: f64) -> DVector<Complex<f64>> {
    // The centre of mass turns from y to z: U_s Omega^2 (y - i z) exp(i Omega t) at W, moved to B.
    let size = wheel.m_w * wheel.d * rate * rate;
    let [y, z] = [wheel.mount.column(1), wheel.mount.column(2)];
    let force = y.map(|v| Complex::new(size * v, 0.0)) + z.map(|v| Complex::new(0.0, -size * v));
    let moment = wheel.r_w_b.map(|v| Complex::new(v, 0.0)).cross(&force);
    DVector::from_iterator(6, force.iter().chain(moment.iter()).copied())
}

#[test]
fn the_dynamic_mass_is_the_linearisation_of_the_nonlinear_solver() {
    let (rate, frequency) = (400.0, 37.0);
    let averaged = Wheel::from_reaction_wheel(&wheel(0.0), &Vector3::zeros(), rate).expect("valid");
    let mass = averaged.dynamic_mass(frequency).expect("above zero");
    let f = Vector6::new(3e-4, -2e-4, 1e-4, 5e-5, -8e-5, 2e-5);
    let omega = Vector3::new(2e-7, -5e-7, 3e-7);
    let acceleration = solved(wheel(0.0), rate, 0.3, omega, &f);
    // M(w) alpha = Re M alpha + i Im M (i w omega) = Re M alpha - w Im M omega.
    let real = mass.map(|value| value.re).fixed_view::<6, 6>(0, 0).into_owned();
    let rates = mass.map(|value| -frequency * value.im).fixed_view::<6, 6>(0, 0).into_owned();
    let moving = Vector6::new(0.0, 0.0, 0.0, omega.x, omega.y, omega.z);
    let residual = (hub_mass() + real) * acceleration + rates * moving - f;
    // What is quadratic in omega is 1e-9 of the gyroscopic moment: omega over the rate of the wheel.
    assert!(residual.norm() < 1e-8 * f.norm(), "{residual}");
    assert!((rates * moving).norm() > 1e-6, "the gyroscopic moment counts");
    // Nothing about the axis reaches the mount.
    let axis = averaged.axis.into_inner();
    let about_w = Wheel { place: Vector3::zeros(), ..averaged };
    let about_w = about_w.dynamic_mass(frequency).expect("above zero");
    let turn = DVector::from_fn(6, |row, _| if row < 3 { 0.0 } else { axis[row - 3] });
    assert!((about_w * complex(&DMatrix::from_column_slice(6, 1, turn.as_slice()))).norm() < 1e-15);
}

#[test]
fn the_mounted_force_of_an_imbalanced_wheel_is_that_of_the_nonlinear_motion() {
    let (rate, d) = (400.0, 1e-7);
    let imbalanced = wheel(d);
    let averaged = Wheel::from_reaction_wheel(&imbalanced, &Vector3::zeros(), rate).expect("valid");
    let mass = averaged.dynamic_mass(rate).expect("above zero");
    let own = hub_mass().try_inverse().expect("positive definite");
    let own = complex(&DMatrix::from_column_slice(6, 6, own.as_slice()));
    let blocked = blocked(&imbalanced, rate);
    let mounted = mounted_force(&mass, &own, &blocked, rate).expect("regular");
    assert!((&mounted - &blocked).norm() > 0.1 * blocked.norm(), "the mount gives way");
    let moved = &own * mounted;
    for theta in [0.0, 0.7, 2.0, 4.4] {
        let turn = (I * theta).exp();
        let alpha = |row: usize| moved[row] * turn;
        let omega = Vector3::from_fn(|row, _| (alpha(3 + row) / (I * rate)).re);
        let found = solved(imbalanced, rate, theta, omega, &Vector6::zeros());
        let wanted = Vector6::from_fn(|row, _| alpha(row).re);
        let error = (found - wanted).norm() / moved.norm();
        // What is not linear in d, of d over a length: 1e-6, and less.
        assert!(error < 1e-6, "{theta}: {error:e}");
    }
    assert!(averaged.periodic[0] < 1e-5);
}
