//! What averaging a rotor over a turn leaves out, against a run of an asymmetric one: below its bound, and not far below.

use nalgebra::{Complex, DVector, Matrix3, Vector3};
use precess::structure::averaged::AveragedDevices;
use precess::structure::dynamic_mass::Motor;
use precess_dynamics::{
    BuiltIn, Each, Hub, HubMode, Inputs, JointStates, LoadAxes, Mode, ReactionWheel, Spacecraft,
    State,
};

/// The hub turns by so little, rad, that its square is rounding.
const TURN: f64 = 1e-6;
/// A step, of the faster of hub and rotor, rad; inputs are held at the middle of each.
const STEP: f64 = 2e-3;
/// Steps.
const STEPS: u32 = 6000;
/// What is left out is at least this share of its bound: the norms of both are of all elements, and the elements act
/// on two axes of two.
const SHARE_MIN: f64 = 0.3;

/// The largest `|S^-1 f|` of the loads that are left out in a run, by `|S y|`; and the bound.
fn left_out(second: f64, rate: f64, frequency: f64) -> [f64; 2] {
    let inertia = Matrix3::from_diagonal(&Vector3::new(0.02, 0.012, second));
    let devices: Vec<BuiltIn> = vec![ReactionWheel::bare_wheel(4.0, inertia).into()];
    let zero = Vector3::zeros();
    let of = AveragedDevices::new(&devices, &zero, &[[0.0, rate]], &[Motor::ConstantRate]);
    let of = of.expect("valid");
    let bound = of.periodic(frequency).expect("above zero");
    let mean = of.dynamic_mass(frequency).expect("above zero");
    let scale = of.mean()[0].diagonal().map(f64::sqrt);

    // The hub's own part of the load is known, and subtracted.
    let own = 1e-3;
    let hub = Hub { m_b: own, r_bc_b: zero, i_b_bc: Matrix3::from_diagonal_element(own) };
    let craft = Spacecraft::new(&hub, &devices).expect("valid");
    let axis = Vector3::new(0.0, 1.0, 0.5);
    // theta = TURN sin(w t) about the axis: alpha = Re(i TURN w^2 exp(i w t)).
    let alpha = |t: f64| axis * (-TURN * frequency * frequency * (frequency * t).sin());
    let motion = DVector::from_fn(6, |row, _| {
        let part = if row < 3 { 0.0 } else { axis[row - 3] };
        Complex::new(0.0, TURN * frequency * frequency * part)
    });
    let mut state: State<Vec<BuiltIn>> = State::at_rest_for(&craft);
    state.omega = axis * (TURN * frequency);
    for joint in state.devices.states_mut() {
        *joint[1] = rate;
    }
    let mut inputs: Inputs<Vec<BuiltIn>> = Inputs::none_for(&craft);
    inputs.modes.values_mut().for_each(|mode| *mode = Mode::Prescribed(0.0));
    let at = |t: f64| HubMode::Prescribed { r_b_n_ddot: zero, omega_dot: alpha(t) };
    let dt = STEP / frequency.max(rate);
    let mut most = 0.0_f64;
    for step in 0..STEPS {
        let time = f64::from(step) * dt;
        inputs.hub = at(time);
        let found = craft.accelerations(&state, &inputs).expect("regular");
        let loads = craft.loads(&state, &inputs, &found, LoadAxes::Hub).expect("regular").hub;
        let averaged = (&mean * &motion) * Complex::from_polar(1.0, frequency * time);
        let left_out = DVector::from_fn(6, |row, _| {
            let load = if row < 3 {
                loads.force[row]
            } else {
                loads.moment[row - 3] - own * alpha(time)[row - 3]
            };
            (load - averaged[row].re) / scale[row]
        });
        most = most.max(left_out.norm());
        inputs.hub = at(time + 0.5 * dt);
        state = craft.step(&state, &inputs, dt).expect("regular");
    }
    let moved = DVector::from_fn(6, |row, _| scale[row] * motion[row].norm()).norm();
    [most / moved, bound]
}

#[test]
fn what_averaging_leaves_out_is_below_its_bound_and_not_far_below() {
    for (rate, frequency) in [(300.0, 60.0), (300.0, 290.0), (100.0, 700.0)] {
        let [found, bound] = left_out(0.018, rate, frequency);
        assert!(found <= bound, "{rate}, {frequency} rad/s: {found} above {bound}");
        assert!(found >= SHARE_MIN * bound, "{rate}, {frequency} rad/s: {found} of {bound}");
    }
    // A rotor that is the same from every angle leaves nothing out.
    let [found, bound] = left_out(0.012, 300.0, 60.0);
    assert!(found < 1e-5 && bound < 1e-12, "{found}, {bound}");
}
