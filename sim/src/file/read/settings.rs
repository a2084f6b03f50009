//! `[gravity]` and `[run]`: the field, duration and integrator.

use precess_dynamics::Gravity;

use super::super::keys::Keys;
use crate::scenario::{IntegratorChoice, Settings};
use crate::units::Measure;

pub(super) fn gravity(keys: &Keys<'_>) -> Gravity {
    let Some(gravity) = keys.table("gravity") else { return Gravity::None };
    let uniform = gravity.vector("uniform", Measure::ACCELERATION);
    let central = gravity.quantity("central", Measure::GRAVITATIONAL_PARAMETER);
    gravity.finish();
    match (uniform, central) {
        (Some(_), Some(_)) => {
            gravity.error("central", "gravity is uniform and central", "keep one of them");
            Gravity::None
        }
        (Some(g), None) => Gravity::Uniform(g),
        (None, Some(mu)) => Gravity::Central { mu },
        (None, None) => Gravity::None,
    }
}

pub(super) fn settings(keys: &Keys<'_>) -> Option<Settings> {
    let Some(run) = keys.table("run") else {
        if !keys.has("run") {
            keys.missing("run", "[run]");
        }
        return None;
    };
    let duration = run.required("duration", Measure::TIME);
    let fixed = run.choice("integrator", &[("dop853", false), ("rk4", true)]).unwrap_or(false);
    let integrator = if fixed {
        if run.has("tolerance") {
            run.error("tolerance", "steps of rk4 are fixed", "give `step`, or take dop853");
        }
        run.required("step", Measure::TIME).map(|step| IntegratorChoice::Rk4 { step })
    } else {
        if run.has("step") {
            run.error("step", "dop853 chooses its steps", "give `tolerance`, or take rk4");
        }
        let tolerance = run.number("tolerance").unwrap_or(1e-10);
        Some(IntegratorChoice::Dop853 { tolerance })
    };
    run.finish();
    Some(Settings { duration: duration?, integrator: integrator? })
}
