//! Opens a service for the spacecraft of a file: devices as an array where the solver has a typed set
//! of so many, as a list otherwise.

use std::path::Path;

#[cfg(feature = "lanes")]
use precess_dynamics::{
    BuiltIn, FlexibleReactionWheel, ReactionWheel, Spacecraft, Vscmg, lanes::LanedSet,
};
use precess_dynamics::{Devices, Dgvscmg};
use precess_tests::stored::Stored;

use super::{Name, Rejected, Service, imaging, single_state::SingleState};
#[cfg(feature = "lanes")]
use super::{
    baked::Baked,
    batch::{ManyStates, on_threads, own, same},
    derivatives::Derivatives,
    flexible,
    listed::Listed,
    runs::{Runs, STATES},
    step::Step,
};

/// A service opened.
type Opened = Result<Box<dyn Service>, Rejected>;

/// States of a batch on one thread: enough that starting costs nothing, and their data stay in the
/// first cache.
#[cfg(feature = "lanes")]
const IN_CACHE: u32 = 64;
/// States of a batch on several threads: of fewer the solver evaluates all on one.
#[cfg(feature = "lanes")]
const ON_THREADS: u32 = 4096;

/// Calls a function with the devices as an array, where there is one of so many.
macro_rules! array_of {
    ($devices:expr, $counts:tt, $with:expr, $other:expr) => {
        array_of!(@ $devices, $devices.len(), $counts, $with, $other)
    };
    (@ $devices:expr, $len:expr, [$($n:literal)*], $with:expr, $other:expr) => {
        match $len {
            $($n => {
                let array: Result<[_; $n], _> = $devices.try_into();
                $with(&array.map_err(|_| "another number of devices")?)
            })*
            _ => $other,
        }
    };
}

/// Opens the spacecraft.
pub(crate) fn open(name: Name, file: &Path) -> Opened {
    match name {
        Name::General => Ok(Box::new(imaging::open(&imaging::read(file)?)?)),
        #[cfg(feature = "lanes")]
        Name::Baked => Ok(Box::new(Baked::open(&imaging::read(file)?)?)),
        #[cfg(feature = "lanes")]
        Name::Step | Name::StepList => of_steps(name, &Listed::read(file)?),
        #[cfg(feature = "lanes")]
        Name::Steps | Name::StepsParameters | Name::StepsThreads => {
            of_runs(name, &Listed::read(file)?)
        }
        #[cfg(feature = "lanes")]
        Name::Flexible => of_flexible(&Listed::read(file)?),
        #[cfg(feature = "lanes")]
        Name::Evaluation
        | Name::Derivatives
        | Name::Linearized
        | Name::LinearizedInto
        | Name::Jvp
        | Name::Vjp
        | Name::Differences
        | Name::ByParameters
        | Name::SingleStep
        | Name::LinearizedStep
        | Name::LinearizedStepInto => of_derivatives(name, &Stored::read(file)?),
        _ => of_evaluations(name, &Stored::read(file)?),
    }
}

/// Only the hub, one evaluation after another.
pub(crate) fn open_hub(stored: &Stored) -> Opened {
    let bare: [Dgvscmg; 0] = [];
    Ok(Box::new(SingleState::open(stored, &bare)?))
}

fn of_evaluations(name: Name, stored: &Stored) -> Opened {
    let devices: Vec<_> = stored.dgvscmgs().collect();
    #[cfg(feature = "lanes")]
    if name == Name::List {
        let devices: Vec<_> = devices.into_iter().map(BuiltIn::Dgvscmg).collect();
        return Ok(Box::new(SingleState::open(stored, &devices)?));
    }
    array_of!(
        devices,
        [1 2 4 8 16 32 64 128 256],
        |array| of_array(name, stored, array),
        unbatched(name, stored, &devices)
    )
}

#[cfg(not(feature = "lanes"))]
fn of_array<const N: usize>(name: Name, stored: &Stored, devices: &[Dgvscmg; N]) -> Opened {
    unbatched(name, stored, devices)
}

#[cfg(feature = "lanes")]
fn of_array<const N: usize>(name: Name, stored: &Stored, devices: &[Dgvscmg; N]) -> Opened {
    let hub = stored.hub();
    let many = |batch, states| Ok(Box::new(ManyStates::open(stored, batch, states)?) as Box<_>);
    match name {
        Name::Batch => many(same(&hub, devices)?, IN_CACHE),
        Name::Parameters => many(own(&hub, devices, IN_CACHE)?, IN_CACHE),
        Name::Threads => many(on_threads(&hub, devices)?, ON_THREADS),
        _ => unbatched(name, stored, devices),
    }
}

fn unbatched<D: Devices<Scalar = f64> + 'static>(
    name: Name,
    stored: &Stored,
    devices: &D,
) -> Opened {
    match name {
        #[cfg(not(feature = "lanes"))]
        Name::Portable => Ok(Box::new(SingleState::open(stored, devices)?)),
        #[cfg(feature = "lanes")]
        Name::Dispatched => Ok(Box::new(SingleState::open(stored, devices)?)),
        _ => Err(format!("{name:?} takes no {} devices", stored.devices.len()).into()),
    }
}

/// The devices as one of a kind, where all are.
#[cfg(feature = "lanes")]
macro_rules! all_of {
    ($devices:expr, $kind:ident) => {
        $devices
            .iter()
            .map(|device| if let BuiltIn::$kind(device) = device { Some(*device) } else { None })
            .collect::<Option<Vec<$kind>>>()
    };
}

#[cfg(feature = "lanes")]
fn of_steps(name: Name, listed: &Listed) -> Opened {
    let devices = listed.devices()?;
    if name == Name::StepList {
        let craft = Spacecraft::new(&listed.hub(), &devices)?;
        return Ok(Box::new(Step::open(listed, craft)));
    }
    let other = || Err(format!("no typed set of these {} devices", devices.len()).into());
    if let Some(devices) = all_of!(devices, Dgvscmg) {
        return array_of!(devices, [1 4], |array| step(listed, array), other());
    }
    if let Some(devices) = all_of!(devices, ReactionWheel) {
        return array_of!(devices, [3], |array| step(listed, array), other());
    }
    match all_of!(devices, Vscmg) {
        Some(devices) => array_of!(devices, [1], |array| step(listed, array), other()),
        None => other(),
    }
}

#[cfg(feature = "lanes")]
fn step<D: Devices<Scalar = f64>>(listed: &Listed, devices: &D) -> Opened {
    Ok(Box::new(Step::open(listed, Spacecraft::new(&listed.hub(), devices)?)))
}

#[cfg(feature = "lanes")]
fn of_flexible(listed: &Listed) -> Opened {
    let devices = listed.devices()?;
    flexible::open(listed, all_of!(devices, ReactionWheel), all_of!(devices, FlexibleReactionWheel))
}

#[cfg(feature = "lanes")]
fn of_derivatives(name: Name, stored: &Stored) -> Opened {
    let devices: Vec<_> = stored.dgvscmgs().collect();
    let other = || Err(format!("no derivatives of {} devices", devices.len()).into());
    array_of!(
        devices.clone(),
        [1 4 16],
        |array| Ok(Box::new(Derivatives::open(name, stored, array)?) as Box<dyn Service>),
        other()
    )
}

#[cfg(feature = "lanes")]
fn of_runs(name: Name, listed: &Listed) -> Opened {
    let devices = listed.devices()?;
    let other = || Err(format!("no typed set of these {} devices", devices.len()).into());
    match all_of!(devices, Dgvscmg) {
        Some(devices) => array_of!(devices, [1 4], |array| runs(name, listed, array), other()),
        None => other(),
    }
}

#[cfg(feature = "lanes")]
fn runs<D: LanedSet + 'static>(name: Name, listed: &Listed, devices: &D) -> Opened {
    let hub = listed.hub();
    let batch = match name {
        Name::StepsParameters => own(&hub, devices, STATES)?,
        Name::StepsThreads => on_threads(&hub, devices)?,
        _ => same(&hub, devices)?,
    };
    Ok(Box::new(Runs::open(listed, batch)?))
}
