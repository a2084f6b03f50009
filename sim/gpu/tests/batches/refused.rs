//! What is no batch of a GPU is refused, with its number, also without one.

use precess_dynamics::kind::ImbalanceModel;
use precess_dynamics::{BuiltIn, BuiltInKind, Hub};
use precess_gpu::{Batch, BatchInputs, GpuError, SetError};

use crate::random::Random;
use crate::spacecraft::{SETTINGS, craft, inputs, random, row};

fn made(crafts: Vec<(Hub, Vec<BuiltIn>)>) -> Result<Batch, SetError> {
    Batch::new(crafts, true, Err(GpuError::NoDriver), |_| Err(GpuError::NoDriver))
}

fn one(kinds: &[BuiltInKind]) -> (Hub, Vec<BuiltIn>) {
    craft(&random(kinds, SETTINGS, &mut Random::new(3)))
}

#[test]
fn a_set_that_differs_is_refused() {
    let wheel = one(&[BuiltInKind::ReactionWheel]);
    let (hub, devices) = &wheel;
    let lumped = {
        let mut parameters = devices[0].parameters();
        parameters.model = ImbalanceModel::Lumped;
        BuiltIn::new(BuiltInKind::ReactionWheel, &parameters).expect("a wheel")
    };
    let other = one(&[BuiltInKind::Vscmg]);
    for (crafts, error, text) in [
        (Vec::new(), SetError::Empty, "needs a spacecraft"),
        (vec![(*hub, Vec::new())], SetError::NoDevice, "it has none"),
        (vec![wheel.clone(), other], SetError::Kinds(1), "spacecraft 1 has other kinds"),
        (vec![wheel.clone(), (*hub, vec![lumped])], SetError::Lumped(1, 0), "coupled"),
    ] {
        let found = made(crafts).err();
        assert_eq!(found.as_ref(), Some(&error));
        assert!(error.to_string().contains(text), "{error}");
    }
}

#[test]
fn an_array_of_another_length_is_refused() {
    let case = random(&[BuiltInKind::ReactionWheel], SETTINGS, &mut Random::new(3));
    let mut batch = made(vec![craft(&case); 2]).expect("a batch");
    let (base, y) = (inputs(&case), row(&case).repeat(2));
    let mut out = vec![0.0; 14];
    let mut refused = |y: &[f64], rows: &[f64], base, out: &mut [f64]| {
        let found = batch.accelerations(y, BatchInputs { base, rows }, out, &|_| true);
        let Err(SetError::Length { array, expected, found }) = found else { panic!("{found:?}") };
        (array, expected, found)
    };
    assert_eq!(refused(&y[..15], &[], &base, &mut out), ("the array of states", 30, 15));
    assert_eq!(refused(&y, &[0.0; 7], &base, &mut out), ("the array of inputs", 14, 7));
    assert_eq!(refused(&y, &[], &base, &mut out[..7]), ("the array of accelerations", 14, 7));
    let mut none = base.clone();
    none.motors.clear();
    assert_eq!(refused(&y, &[], &none, &mut out), ("the list of motors", 1, 0));
}
