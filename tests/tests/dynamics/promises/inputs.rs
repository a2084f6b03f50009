//! An angle that no equation depends on is checked like every other input.

use nalgebra::{Matrix3, Vector3};
use precess_dynamics::kind::{JointStates, Kind};
use precess_dynamics::{
    BalancedDgcmg, BalancedDgvscmg, BalancedReactionWheel, BalancedSgcmg, BalancedVscmg, BuiltIn,
    FixedSet, Hub, HubMode, Inputs, Quantity, ReactionWheel, SolveError, Spacecraft, State,
};

use super::services::{OneDevice, outcomes};

fn hub() -> Hub {
    Hub { m_b: 10.0, r_bc_b: Vector3::zeros(), i_b_bc: Matrix3::identity() }
}

/// On a held hub nothing but its own acceleration could depend on a wheel's rate.
#[test]
fn rate_of_a_wheel_on_a_held_hub_is_rejected_where_it_is_not_finite() {
    let disc = Matrix3::from_diagonal(&Vector3::new(0.2, 0.1, 0.1));
    let device = ReactionWheel::bare_wheel(4.0, disc);
    let still = HubMode::Prescribed { r_b_n_ddot: Vector3::zeros(), omega_dot: Vector3::zeros() };
    for held in [HubMode::Fixed, still] {
        let mut state = State::<[ReactionWheel; 1]>::at_rest();
        state.devices[0].spin = f64::NAN;
        let inputs = Inputs { hub: held, ..Inputs::<[ReactionWheel; 1]>::none() };
        for (service, outcome) in outcomes(&OneDevice { hub: hub(), device, state, inputs }) {
            let named = matches!(
                outcome,
                Err(SolveError::NotFinite { what: Quantity::Joint { field: "spin", .. }, .. })
            );
            assert!(named, "{service}: {outcome:?}");
        }
    }
}

fn rejected<K: Kind<Scalar = f64> + Into<BuiltIn>>(device: K) {
    for angle in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        let mut state = State::<[K; 1]>::at_rest();
        let joints = state.devices.states_mut().zip(K::JOINTS);
        for ([coordinate, _], info) in joints.filter(|(_, info)| info.ignorable) {
            assert_eq!(info.coordinate, "theta");
            *coordinate = angle;
        }
        let inputs = Inputs::<[K; 1]>::none();
        let what = Quantity::Joint { device: 0, field: "theta" };
        let named = |error: &SolveError| match error {
            SolveError::NotFinite { what: found, value } => {
                *found == what && value.to_bits() == angle.to_bits()
            }
            _ => false,
        };
        for (service, outcome) in outcomes(&OneDevice { hub: hub(), device, state, inputs }) {
            assert!(outcome.as_ref().is_err_and(named), "{service}: {outcome:?}");
        }
        let craft = Spacecraft::new(&hub(), &[device]).expect("valid parameters");
        assert!(craft.step(&state, &inputs, 1e-3).as_ref().is_err_and(named));
        assert_eq!(<[K; 1]>::joint_infos().filter(|info| info.ignorable).count(), 1);
    }
}

#[test]
fn angle_of_a_balanced_rotor_is_rejected_where_it_is_not_finite() {
    rejected(BalancedReactionWheel::bare_wheel(4.0, 0.2, 0.1));
    rejected(BalancedSgcmg::bare_wheel(4.0, 0.2, 0.1));
    rejected(BalancedVscmg::bare_wheel(4.0, 0.2, 0.1));
    rejected(BalancedDgcmg::bare_wheel(4.0, 0.2, 0.1));
    rejected(BalancedDgvscmg::bare_wheel(4.0, 0.2, 0.1));
}
