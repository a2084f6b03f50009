//! Batches of spacecraft whose parameters differ: variants of one case, each with a state of its own; of
//! a list of wheels also ragged ones, whose lists differ in length.

use precess_dynamics::kind::ImbalanceModel;
use precess_dynamics::lanes::{Batch, LanedSet};
use precess_dynamics::{BuiltIn, Dgvscmg, Inputs, Passive, Spacecraft, State};

use super::call_results::{of_accelerations, of_state};
use super::case::{Case, List, given, moved};
use super::shapes::{Batched, RAGGED, Taken, Three, Wheels, exactly};

/// The case of one of its states, with a spacecraft of its own in three of four: without springs and
/// friction; twice as heavy, the imbalance in the other model; mounted the other way round. The
/// case's own spacecraft where that is none.
#[must_use]
pub fn variant(case: &Case, state: usize) -> Option<Case> {
    let all = case.all();
    let (state_of, inputs) = all.get(state)?;
    let own = case.with(state_of, inputs);
    let mut changed = own.clone();
    if !state.is_multiple_of(4) {
        changed.hub.m_b *= 1.5;
        changed.devices = case.devices.iter().map(|device| other(device, state % 4)).collect();
    }
    let found = if changed.list().is_ok() { changed } else { own };
    Some(if case.kinds() == RAGGED { shortened(found, length(case, state)) } else { found })
}

/// How many wheels a variant of a list of them has: others than the first variant here and there, in all
/// groups of lanes from one on, or once.
fn length(case: &Case, state: usize) -> usize {
    let most = RAGGED.len();
    match case.steps % 3 {
        0 => most - (state + case.more.len()) % (most + 1),
        1 => most - (state / 4) % (most + 1),
        _ if state == case.more.len() / 2 => 1,
        _ => most,
    }
}

/// The case with only the first devices.
fn shortened(mut case: Case, devices: usize) -> Case {
    case.devices.truncate(devices);
    case.state.devices.truncate(devices);
    case.inputs = shortened_inputs(case.inputs, devices);
    case
}

fn shortened_inputs(mut inputs: Inputs<List>, devices: usize) -> Inputs<List> {
    inputs.motors.truncate(devices);
    inputs.modes.truncate(devices);
    if let Some(bodies) = &mut inputs.bodies {
        bodies.truncate(devices);
    }
    inputs
}

/// The inputs of the first variant, which are of its number of devices.
#[must_use]
pub fn first_inputs(case: &Case) -> Option<Inputs<List>> {
    Some(shortened_inputs(case.inputs.clone(), variant(case, 0)?.devices.len()))
}

/// Another device of the kind; the same where there is none.
fn other(device: &BuiltIn, which: usize) -> BuiltIn {
    let mut parameters = device.parameters();
    match which {
        1 => parameters.passive = parameters.passive.map(|_| Passive::none()),
        2 => {
            parameters.bodies.iter_mut().for_each(|body| body.mass *= 2.0);
            parameters.model = match parameters.model {
                ImbalanceModel::Coupled => ImbalanceModel::Lumped,
                ImbalanceModel::Lumped => ImbalanceModel::Coupled,
            };
        }
        _ => {
            parameters.mount = parameters.mount.transpose();
            parameters.bodies.iter_mut().for_each(|body| body.origin = body.origin.map(|x| -x));
        }
    }
    BuiltIn::new(device.kind(), &parameters).unwrap_or(*device)
}

/// What a batch makes of the variants of a case, with the inputs of the first state or each with its
/// own; none for lists of which no batch is compiled.
#[must_use]
pub fn batched_variants(case: &Case, each: bool) -> Option<Batched> {
    batch_of::<[Dgvscmg; 1]>(case, each)
        .or_else(|| batch_of::<Three>(case, each))
        .or_else(|| batch_of::<Wheels>(case, each))
}

fn batch_of<D: LanedSet + Taken<f64>>(case: &Case, each: bool) -> Option<Batched> {
    let count = case.all().len();
    let (mut crafts, mut states, mut inputs) = (Vec::new(), Vec::new(), Vec::new());
    for state in 0..count {
        let variant = variant(case, state)?;
        let devices: D = exactly(&variant.devices)?;
        let craft = Spacecraft::new(&variant.hub, &devices).ok()?;
        if each || inputs.is_empty() {
            inputs.push(given(&variant.inputs, &craft));
        }
        let state: State<D> = moved(&variant.state, State::at_rest_for(&craft));
        states.push(state);
        crafts.push(craft);
    }
    let batch = Batch::from_spacecraft(crafts);
    let (mut found, mut ends) = (Vec::new(), Vec::new());
    let called = if each {
        batch
            .accelerations(&states, &inputs, &mut found)
            .and_then(|()| batch.run(&mut states, &inputs, case.dt, case.steps, &mut ends))
    } else {
        batch
            .accelerations(&states, &inputs[0], &mut found)
            .and_then(|()| batch.run(&mut states, &inputs[0], case.dt, case.steps, &mut ends))
    };
    // A step that is finite.
    called.ok()?;
    let accelerations =
        found.into_iter().map(|found| found.map(|found| of_accelerations(&found))).collect();
    Some(Batched { accelerations, runs: states.iter().map(of_state).zip(ends).collect() })
}
