//! The physics checks: laws that hold between what the emitted functions return.
//!
//! Nothing here knows the derivation. A law's residual is a number without unit: the difference of
//! its two sides over the larger of them, or over one where both are smaller.

mod axes;
mod conservation;
mod differences;
mod engines;
mod external;
mod field;
mod law;
mod loads;
mod stored;
mod trial;

pub use engines::Engines;
pub use law::{Kind, Law};
pub use stored::EngineError;

pub(super) use trial::{Residuals, Role, Trial, slope};

use super::device::{Device, Fault};
use trial::concerns;

/// Residuals of every law that a change in `role` can move.
pub(super) fn residuals(
    device: &Device<'_, '_>,
    trials: &[Trial],
    engines: &Engines,
    fault: &Fault,
    role: Option<Role>,
) -> Residuals {
    let mut found: Residuals = Vec::new();
    let mut keep = |new: Residuals| {
        for (law, residual) in new {
            match found.iter_mut().find(|(known, _)| *known == law) {
                Some((_, largest)) => *largest = largest.max(residual),
                None => found.push((law, residual)),
            }
        }
    };
    let modes = concerns(role, &[Role::Solution]);
    for trial in trials.iter().filter(|trial| modes || !trial.mixed) {
        keep(conservation::residuals(device, trial, fault, role));
        keep(differences::residuals(device, trial, fault, role));
        keep(axes::residuals(device, trial, fault, role));
        keep(loads::residuals(device, trial, fault, role));
        keep(external::residuals(device, trial, fault, role));
        keep(field::residuals(device, trial, fault, role));
    }
    keep(engines.residuals(device, fault, role));
    found.sort_by_key(|(law, _)| *law);
    found
}
