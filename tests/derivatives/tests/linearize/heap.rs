//! Into matrices that are kept, a linearisation allocates nothing, nor do products: of a fixed set on a rigid hub, with
//! emitted derivatives.

use allocation_counter::measure;
use nalgebra::{Matrix3, Vector3};
use precess_dynamics::kind::{Each, JointStates};
use precess_dynamics::set::WithNumbers;
use precess_dynamics::{
    BuiltIn, Dgvscmg, Gravity, Hub, HubMode, Inputs, Mode, Outputs, ReactionWheel, Sgcmg,
    Spacecraft, State,
};

/// Allocations of `linearize_into` after its first call, of `jvp`, `vjp`, of `acceleration_derivatives_into` after its
/// first call, and of one evaluation.
fn allocations<D: WithNumbers<Scalar = f64>>(
    craft: &Spacecraft<D>,
    state: &State<D>,
    inputs: &Inputs<D>,
) -> [u64; 5] {
    let outputs = Outputs::accelerations();
    let mut kept = craft.linearize(state, inputs, &outputs).unwrap();
    let (of_states, of_inputs) = (vec![0.3; kept.states.len()], vec![-0.2; kept.inputs.len()]);
    let (mut by_states, mut by_inputs) = (of_states.clone(), of_inputs.clone());
    let weights = kept.accelerations.clone();
    let mut of_accelerations = craft.acceleration_derivatives(state, inputs).unwrap();
    let [mut into, mut jvp, mut vjp, mut only, mut one] = [false; 5];
    let counts = [
        measure(|| into = craft.linearize_into(state, inputs, &outputs, &mut kept).is_ok()),
        measure(|| jvp = craft.jvp(state, inputs, (&of_states, &of_inputs)).is_ok()),
        measure(|| {
            let gradient = (by_states.as_mut_slice(), by_inputs.as_mut_slice());
            vjp = craft.vjp(state, inputs, &weights, gradient).is_ok();
        }),
        measure(|| {
            let into = &mut of_accelerations;
            only = craft.acceleration_derivatives_into(state, inputs, into).is_ok();
        }),
        measure(|| one = craft.accelerations(state, inputs).is_ok()),
    ];
    assert!(into && jvp && vjp && only && one);
    counts.map(|count| count.count_total)
}

fn moving<D: WithNumbers<Scalar = f64>>(devices: &D) -> (Spacecraft<D>, State<D>, Inputs<D>) {
    let hub = Hub { m_b: 80.0, r_bc_b: Vector3::zeros(), i_b_bc: Matrix3::identity() * 9.0 };
    let craft = Spacecraft::new(&hub, devices).unwrap();
    let (mut state, inputs) = (State::at_rest_for(&craft), Inputs::none_for(&craft));
    state.omega = Vector3::new(0.1, -0.2, 0.3);
    for (k, [coordinate, rate]) in (0_u8..).zip(state.devices.states_mut()) {
        (*coordinate, *rate) = (0.3 * f64::from(k) - 0.5, 2.0 - f64::from(k));
    }
    (craft, state, inputs)
}

fn check<D: WithNumbers<Scalar = f64>>(devices: &D) {
    let (craft, state, mut inputs) = moving(devices);
    for gravity in [Gravity::None, Gravity::Uniform(Vector3::new(0.1, 0.2, -9.8))] {
        inputs.gravity = gravity;
        for hub in [
            HubMode::Free,
            HubMode::Prescribed { r_b_n_ddot: Vector3::x(), omega_dot: Vector3::y() },
        ] {
            inputs.hub = hub;
            for mode in [Mode::Driven, Mode::Locked, Mode::Prescribed(0.3)] {
                let (mut state, mut inputs) = (state.clone(), inputs.clone());
                *inputs.modes.values_mut().next().unwrap() = mode;
                if mode == Mode::Locked {
                    *state.devices.states_mut().next().unwrap()[1] = 0.0;
                }
                assert_eq!(allocations(&craft, &state, &inputs), [0; 5], "{inputs:?}");
            }
        }
    }
}

#[test]
fn fixed_sets_allocate_nothing() {
    let inertia = Matrix3::from_diagonal(&Vector3::new(0.2, 0.1, 0.12));
    let gyro = Dgvscmg { d: 1e-3, ..Dgvscmg::bare_wheel(4.0, inertia) };
    let wheel = ReactionWheel { d: 1e-3, ..ReactionWheel::bare_wheel(4.0, inertia) };
    check(&[gyro; 1]);
    check(&[gyro; 9]);
    check(&([wheel; 5], Sgcmg::bare_wheel(4.0, inertia), [gyro; 2]));
}

/// Of a list an evaluation allocates, and a linearisation no more than that.
#[test]
fn a_list_allocates_what_an_evaluation_of_it_does() {
    let inertia = Matrix3::from_diagonal(&Vector3::new(0.2, 0.1, 0.12));
    let gyro = Dgvscmg { d: 1e-3, ..Dgvscmg::bare_wheel(4.0, inertia) };
    let (craft, state, inputs) = moving(&vec![BuiltIn::from(gyro); 5]);
    let [into, _, _, only, one] = allocations(&craft, &state, &inputs);
    assert!(one > 0);
    assert_eq!([into, only], [one; 2]);
}
