//! Columns of typed sets, of lists and of options are the same; values are those of the solver in
//! every bit; dual numbers serve every other call.

use nalgebra::{Matrix3, Vector3};
use precess_dynamics::kind::{Each, JointStates};
use precess_dynamics::{
    BuiltIn, Dual, Hub, Inputs, Passive, ReactionWheel, Sgcmg, SloshMass, Spacecraft, State,
};

use crate::draw::{Drawn, SEED};

type Typed = ([ReactionWheel; 2], Option<Sgcmg>, SloshMass);

fn devices() -> Typed {
    let disc = Matrix3::new(0.2, 0.0, 1e-4, 0.0, 0.1, 0.0, 1e-4, 0.0, 0.1);
    let mut wheel = ReactionWheel { d: 1e-3, ..ReactionWheel::bare_wheel(4.0, disc) };
    wheel.passive.wheel = Passive::friction(0.01, 0.1, 0.05);
    wheel.r_w_b.x = 0.3;
    let mut slosh = SloshMass::bare_slosh_mass(7.0);
    slosh.passive.slosh_mass = Passive::spring(3.0, 0.1);
    (
        [wheel; 2],
        Some(Sgcmg { l_g: Vector3::new(0.0, 0.1, 0.0), ..Sgcmg::bare_wheel(3.0, disc) }),
        slosh,
    )
}

#[test]
fn typed_sets_and_lists_have_the_same_columns() {
    let hub =
        Hub { m_b: 80.0, r_bc_b: Vector3::new(0.1, 0.0, -0.2), i_b_bc: Matrix3::identity() * 9.0 };
    let typed = devices();
    let list: Vec<BuiltIn> =
        vec![typed.0[0].into(), typed.0[1].into(), typed.1.unwrap().into(), typed.2.into()];
    let (of_types, of_list) =
        (Spacecraft::new(&hub, &typed).unwrap(), Spacecraft::new(&hub, &list).unwrap());
    let mut state: State<Typed> = State::at_rest_for(&of_types);
    state.omega = Vector3::new(0.1, 0.2, -0.3);
    for (k, [coordinate, rate]) in state.devices.states_mut().enumerate() {
        let k = f64::from(u32::try_from(k).unwrap());
        (*coordinate, *rate) = (0.3 + k, 2.0 - k);
    }
    let inputs: Inputs<Typed> = Inputs::none_for(&of_types);
    let mut listed: State<Vec<BuiltIn>> = State::at_rest_for(&of_list);
    listed.omega = state.omega;
    for (to, from) in listed.devices.states_mut().zip(state.devices.states()) {
        for (to, from) in to.into_iter().zip(from) {
            *to = from;
        }
    }
    let given = Inputs::none_for(&of_list);
    let outputs = crate::outputs::OUTPUTS;
    let a = of_types.linearize(&state, &inputs, &outputs).unwrap();
    let b = of_list.linearize(&listed, &given, &outputs).unwrap();
    assert_eq!((&a.a, &a.b, &a.c, &a.d), (&b.a, &b.b, &b.c, &b.d));
    assert_eq!((&a.states, &a.inputs, &a.outputs), (&b.states, &b.inputs, &b.outputs));
    assert_eq!((a.a.nrows(), a.a.ncols(), a.c.nrows()), (22, 22, 6 + 5 + 7 + 6 * 5 + 6));
    let names: Vec<_> =
        a.inputs.iter().map(|input| of_types.variable_name(*input).to_string()).collect();
    assert_eq!(names[6..], ["motors[0].u_w", "motors[1].u_w", "motors[2].u_g", "motors[3].u_s"]);
}

#[test]
fn values_have_the_bits_of_the_solver() {
    for seed in SEED..SEED + 100 {
        let drawn = Drawn::new(seed);
        let (case, mut dual) = (drawn.case::<f64>(), drawn.case::<Dual<f64, 6>>());
        let craft = case.craft();
        // Derivatives that are not zero.
        for axis in 0..3 {
            dual.state.omega[axis].add_derivative(axis, 1.0);
            dual.inputs.force[axis].add_derivative(axis, -2.0);
        }
        for (k, [coordinate, _]) in dual.state.devices.states_mut().enumerate() {
            coordinate.add_derivative(k % 6, 1.5);
        }
        let expected = craft.accelerations(&case.state, &case.inputs).unwrap();
        let energy = craft.energy(&case.state).unwrap();
        let bits = |of: f64| of.to_bits();
        // Converted after the constants were computed, and before.
        for craft in [craft.with_numbers(Dual::constant), dual.craft()] {
            let found = craft.accelerations(&dual.state, &dual.inputs).unwrap();
            for (found, expected) in
                [(found.r_b_n_ddot, expected.r_b_n_ddot), (found.omega_dot, expected.omega_dot)]
            {
                assert_eq!(found.map(|x| bits(x.value)), expected.map(bits), "seed {seed:#x}");
            }
            let found = found.devices.values().map(|x| bits(x.value));
            assert!(found.eq(expected.devices.values().map(bits)), "seed {seed:#x}");
            assert_eq!(bits(craft.energy(&dual.state).unwrap().value), bits(energy));
        }
    }
}

/// A whole step over dual numbers: the transition matrix of a joint on a spring.
#[test]
fn a_step_has_derivatives_too() {
    let hub = Hub { m_b: 80.0, r_bc_b: Vector3::zeros(), i_b_bc: Matrix3::identity() * 9.0 };
    let mut slosh = SloshMass::bare_slosh_mass(2.0);
    slosh.passive.slosh_mass = Passive::spring(8.0, 0.0);
    let craft = Spacecraft::new(&hub, &slosh).unwrap().with_numbers(Dual::<f64, 6>::constant);
    let mut state = State::<SloshMass<Dual<f64, 6>>>::at_rest();
    state.devices.x = Dual::variable(0.1, 0);
    state.devices.x_dot = Dual::variable(0.0, 1);
    let inputs = Inputs { hub: precess_dynamics::HubMode::Fixed, ..Inputs::none() };
    let dt = 1e-3;
    for _ in 0..500 {
        state = craft.step(&state, &inputs, Dual::constant(dt)).unwrap();
    }
    // cos(w t), sin(w t) / w; -w sin(w t), cos(w t) with w = 2 rad/s after 0.5 s.
    let (sine, cosine) = 1.0_f64.sin_cos();
    let expected = [[cosine, sine / 2.0], [-2.0 * sine, cosine]];
    let found =
        [state.devices.x, state.devices.x_dot].map(|of| [of.derivative(0), of.derivative(1)]);
    for (found, expected) in found.into_iter().flatten().zip(expected.into_iter().flatten()) {
        assert!((found - expected).abs() < 1e-12, "{found} is not {expected}");
    }
}
