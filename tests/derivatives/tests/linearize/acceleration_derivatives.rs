//! [`Spacecraft::acceleration_derivatives_into`]: the bits of `c` and `d` of a linearisation.

use precess_dynamics::kind::Kind;
use precess_dynamics::set::WithNumbers;
use precess_dynamics::{
    AccelerationDerivatives, DerivativeError, Gravity, Inputs, Outputs, Spacecraft, State,
};
use precess_tests::cases;
use precess_tests::measured::{EachKind, Measured, dgvscmg, each_kind};

use crate::draw::{Drawn, List, SEED};

/// How many spacecraft.
const SPACECRAFT: u64 = 240;

/// Holds both matrices, and all besides, to those of `linearize`.
fn compare<D: WithNumbers<Scalar = f64>>(
    craft: &Spacecraft<D>,
    (state, inputs): (&State<D>, &Inputs<D>),
    kept: &mut Option<AccelerationDerivatives<D>>,
    name: &str,
) {
    let expected = craft.linearize(state, inputs, &Outputs::accelerations()).unwrap();
    let kept = kept.get_or_insert_with(|| craft.acceleration_derivatives(state, inputs).unwrap());
    craft.acceleration_derivatives_into(state, inputs, kept).unwrap();
    assert_eq!(kept.accelerations, expected.accelerations, "{name}");
    assert_eq!((&kept.states, &kept.inputs), (&expected.states, &expected.inputs), "{name}");
    for (found, expected) in [(&kept.by_states, &expected.c), (&kept.by_inputs, &expected.d)] {
        assert_eq!(found.shape(), expected.shape(), "{name}");
        assert_eq!(found.map(f64::to_bits), expected.map(f64::to_bits), "{name}");
    }
}

#[test]
fn random_spacecraft_have_the_bits_of_linearize() {
    let mut kept: Option<AccelerationDerivatives<List>> = None;
    for seed in SEED..SEED + cases(SPACECRAFT) {
        for drawn in [Drawn::new(seed), Drawn::on_bearings(seed)] {
            let case = drawn.case::<f64>();
            compare(&case.craft(), (&case.state, &case.inputs), &mut kept, &format!("{seed:#x}"));
        }
    }
}

struct Sets;

impl EachKind<f64> for Sets {
    fn visit<K: Kind<Scalar = f64>>(&mut self, name: &'static str, device: K) {
        check(name, &device);
        check(name, &[device; 5]);
        check(name, &([device; 2], dgvscmg(), device));
    }
}

fn check<D: WithNumbers<Scalar = f64>>(name: &str, devices: &D) {
    let Measured { craft, state, mut inputs } = Measured::new(devices);
    let mut kept = None;
    for gravity in [Gravity::None, Gravity::Uniform([0.1, 0.2, -9.8].into())] {
        inputs.gravity = gravity;
        compare(&craft, (&state, &inputs), &mut kept, name);
    }
}

#[test]
fn sets_of_every_kind_have_the_bits_of_linearize() {
    each_kind(&mut Sets);
}

#[test]
fn a_state_without_accelerations_is_rejected() {
    let Measured { craft, mut state, inputs } = Measured::new(&[dgvscmg::<f64>()]);
    let mut kept = craft.acceleration_derivatives(&state, &inputs).unwrap();
    state.omega.x = f64::INFINITY;
    let found = craft.acceleration_derivatives_into(&state, &inputs, &mut kept);
    assert!(matches!(found, Err(DerivativeError::Solve(_))), "{found:?}");
}
