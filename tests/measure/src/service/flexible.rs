//! Four reaction wheels on what gives: on flexible bearings, on an isolated platform, on a flexible
//! structure; and on a rigid hub.

use precess_dynamics::{
    Devices, Flexible, FlexibleReactionWheel, Inputs, Isolated, ListedModes, ReactionWheel,
    Spacecraft, State, Suspension,
};
use precess_tests::bending::{WHEELS, structure, swing};

use super::listed::Listed;
use super::single_state::SingleState;
use super::{Rejected, Service};

/// Opens a case, by what is in its file.
pub(super) fn open(
    listed: &Listed,
    rigid: Option<Vec<ReactionWheel>>,
    soft: Option<Vec<FlexibleReactionWheel>>,
) -> Result<Box<dyn Service>, Rejected> {
    if let Some(soft) = soft {
        return Ok(Box::new(one(listed, &four(soft)?)?));
    }
    let wheels = four(rigid.ok_or("other devices than reaction wheels")?)?;
    if let Some(platform) = listed.platform() {
        let set = Isolated { carrier: platform, suspension: Suspension::none(), carried: wheels };
        return Ok(Box::new(one(listed, &set)?));
    }
    match listed.modes {
        0 => Ok(Box::new(one(listed, &wheels)?)),
        _ => Ok(Box::new(on_mounts(listed, &wheels)?)),
    }
}

fn four<K>(devices: Vec<K>) -> Result<[K; WHEELS], Rejected> {
    devices.try_into().map_err(|_| "another number of devices".into())
}

fn one<D: Devices<Scalar = f64>>(listed: &Listed, devices: &D) -> Result<SingleState<D>, Rejected> {
    let craft = Spacecraft::new(&listed.hub(), devices)?;
    let (state, inputs) = (listed.state(&craft), listed.inputs(&craft));
    Ok(SingleState { craft, state, inputs })
}

/// A structure with a wheel on each of four mounts.
fn on_mounts(
    listed: &Listed,
    wheels: &[ReactionWheel; WHEELS],
) -> Result<SingleState<[ReactionWheel; WHEELS], Flexible<ListedModes>>, Rejected> {
    let rigid = one(listed, wheels)?;
    let modes = structure(listed.modes, &wheels.map(|wheel| wheel.r_w_b));
    let craft = Spacecraft::flexible(&listed.hub(), &modes, wheels, &[0, 1, 2, 3])?;
    let mut state = State::at_rest_for(&craft);
    state = rigid.state.with_modal(state.modal);
    swing(&mut state.modal.eta);
    let inputs = rigid.inputs.with_modal(Inputs::none_for(&craft).modal);
    Ok(SingleState { craft, state, inputs })
}
