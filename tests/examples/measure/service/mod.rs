//! The services: calls of the solver that compute accelerations.

mod across;
mod batch;
mod one;
mod step;

use std::error::Error;

use clap::ValueEnum;
use precess_dynamics::{Devices, Dgvscmg};
use precess_tests::stored::Stored;
use serde_json::json;

/// What a service could not do.
pub(crate) type Rejected = Box<dyn Error>;

/// The row of the issue floor that bounds fused lanes.
const WIDEST: &str = "8 lanes, fused";

/// A spacecraft opened for one of the services.
pub(crate) trait Service {
    /// All accelerations in the state of the file: of the hub, then joint by joint.
    fn accelerations(&mut self) -> Result<Vec<f64>, Rejected>;
    /// Makes so many calls, none of which can be computed before the one before it is done, or
    /// without being made.
    fn run(&mut self, calls: u32) -> Result<(), Rejected>;
    /// Evaluations in a call.
    fn evaluations(&self) -> u32;
}

/// The services by name.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum Name {
    /// One state, one evaluation after another
    One,
    /// One state, one evaluation after another, products and sums rounded once
    Fused,
    /// One state, whole steps of the Runge-Kutta method, by four evaluations each
    Step,
    /// One state, its devices side by side in lanes
    Across,
    /// Many states in lanes
    Batch,
    /// Runs of many states in lanes
    Runs,
}

impl Name {
    /// Name, title, whether its accelerations are its own, to be checked, and the row of the issue
    /// floor that bounds it.
    pub(crate) fn description(self) -> serde_json::Value {
        let (name, title, checked, floor) = match self {
            Self::One => ("one", "Precess, one state", true, "f64"),
            Self::Fused => ("fused", "Precess, one state, fused", true, "fused f64"),
            Self::Step => ("step", "Precess, RK4 steps of one state, per evaluation", false, "f64"),
            Self::Across => ("across", "Precess, devices in lanes", true, WIDEST),
            Self::Batch => ("batch", "Precess, batch of states, per state", true, WIDEST),
            Self::Runs => ("runs", "Precess, RK4 runs of a batch, per evaluation", false, WIDEST),
        };
        json!({ "name": name, "title": title, "checked": checked, "floor": floor })
    }
}

/// Opens the spacecraft: as an array where its length is a power of two up to 256, as a vector
/// otherwise.
pub(crate) fn open(name: Name, stored: &Stored) -> Result<Box<dyn Service>, Rejected> {
    macro_rules! arrays {
        ($($n:literal)*) => {
            match stored.devices.len() {
                $($n => of_array(name, stored, &array::<$n>(stored)?),)*
                _ => of(name, stored, &stored.dgvscmgs().collect::<Vec<_>>()),
            }
        };
    }
    arrays!(1 2 4 8 16 32 64 128 256)
}

/// Only the hub, one evaluation after another.
pub(crate) fn open_hub(stored: &Stored) -> Result<Box<dyn Service>, Rejected> {
    let bare: [Dgvscmg; 0] = [];
    Ok(Box::new(one::One::open(stored, &bare)?))
}

/// The devices as an array.
fn array<const N: usize>(stored: &Stored) -> Result<[Dgvscmg; N], Rejected> {
    let devices: Vec<_> = stored.dgvscmgs().collect();
    let found = devices.len();
    devices.try_into().map_err(|_| format!("{found} devices, not {N}").into())
}

fn of_array<const N: usize>(
    name: Name,
    stored: &Stored,
    devices: &[Dgvscmg; N],
) -> Result<Box<dyn Service>, Rejected> {
    let many = || batch::Many::open(stored, devices);
    Ok(match name {
        Name::Across => Box::new(across::Across::open(stored, devices)?),
        Name::Batch => Box::new(batch::Evaluated(many()?)),
        Name::Runs => Box::new(batch::Runs(many()?)),
        Name::One | Name::Fused | Name::Step => of(name, stored, devices)?,
    })
}

fn of<D: Devices<Scalar = f64> + 'static>(
    name: Name,
    stored: &Stored,
    devices: &D,
) -> Result<Box<dyn Service>, Rejected> {
    Ok(match name {
        Name::One => Box::new(one::One::open(stored, devices)?),
        Name::Fused => Box::new(one::One::open_fused(stored, devices)?),
        Name::Step => Box::new(step::Step(one::One::open(stored, devices)?)),
        Name::Across | Name::Batch | Name::Runs => {
            return Err(format!("{} devices: lanes take arrays", stored.devices.len()).into());
        }
    })
}
