//! One second of Table 1 under given equations.

use super::assembled::Equations;
use super::ledger::{Accountant, Ledger};
use super::state::State;
use super::system::{Failure, System};
use super::{ConsequenceError, Effect};
use precess_codegen::graph::Graph;

/// How long a run lasts, s.
pub const DURATION: f64 = 1.0;

/// Steps of a run: a wheel at 500 rpm turns by an eightieth of a radian in each. The right system
/// then drifts by 4e-12 at most, of 16 times that with half as many, and all runs together take a
/// second or two.
pub(super) const STEPS: u32 = 4000;

/// The step of a run, s.
pub const STEP: f64 = DURATION / STEPS as f64;

/// Every how many steps the conserved quantities are looked at: fifty times in a turn of the wheel.
const LOOK: u32 = 10;

/// Runs the equations; never [`Effect::Unchanged`] or [`Effect::Vanishes`].
pub(super) fn run<'g>(
    graph: &'g Graph,
    accountant: &mut Accountant,
    equations: &Equations<'g>,
    steps: u32,
) -> Result<Effect, ConsequenceError> {
    let mut system = System::new(graph, equations)?;
    let mut state = State::initial();
    let start = accountant.entry(&state);
    if !start.is_finite() {
        return Ok(Effect::Diverges { at: 0.0 });
    }
    let mut ledger = Ledger::new(start);
    let h = DURATION / f64::from(steps);
    for step in 0..steps {
        let at = f64::from(step) * h;
        state = match system.step(&state, h) {
            Ok(next) => next,
            Err(Failure::Singular) => return Ok(Effect::Singular { at }),
            Err(Failure::NotFinite) => return Ok(Effect::Diverges { at }),
        };
        if (step + 1) % LOOK == 0 {
            let entry = accountant.entry(&state);
            if !entry.is_finite() {
                return Ok(Effect::Diverges { at: at + h });
            }
            ledger.add(&entry);
        }
    }
    Ok(Effect::Drift(ledger.drift()))
}
