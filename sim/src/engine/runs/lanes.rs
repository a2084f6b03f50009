//! [`Lanes`]: the steps of several runs of RK4 at a time.
//!
//! What happens between steps is the runs' own: segments, inputs, samples, stops. A run whose step is of
//! another length, or fails, makes it by itself.

use precess_dynamics::JointStates as _;
use precess_lanes::{Motion, SideBySide, StateInputs, side_by_side};

use super::recorded::Recorded;
use super::{Gpu, Run};
use crate::engine::equations::run_quantities::RunQuantities;
use crate::record::RunError;
use crate::scenario::IntegratorChoice;
use precess_craft::CraftState;

/// The most steps between two checks whether to go on.
const STEPS_MAX: usize = 64;

/// Runs whose steps are made together.
pub(crate) struct Lanes {
    crafts: Box<dyn SideBySide>,
    /// State and inputs of each, whether it still runs or not.
    at: Vec<(Motion, StateInputs)>,
}

impl Lanes {
    /// These runs, on a GPU where there is one. None where there are fewer than two, one has ended, keeps more than its motion, is not of
    /// RK4 or has a structure, platforms, panels that carry devices or friction that sticks, or where their devices are not
    /// of one kind.
    pub(crate) fn from_runs<'a, 's: 'a, 'r: 'a>(
        gpu: Option<&Gpu>,
        runs: impl Iterator<Item = Option<&'a Recorded<'s, 'r>>>,
    ) -> Option<Self> {
        let mut crafts = Vec::new();
        let mut at = Vec::new();
        for recorded in runs {
            let run = &recorded?.run;
            let scenario = run.scenario;
            if run.system.craft.is_flexible() {
                return None;
            }
            let devices = scenario.devices_on_hub()?;
            let fixed = matches!(scenario.settings.integrator, IntegratorChoice::Rk4 { .. });
            let smooth = scenario.friction.is_empty();
            if !(fixed && smooth && run.system.quantities == RunQuantities::Motion) {
                return None;
            }
            crafts.push((scenario.bare_hub().ok()?, devices.to_vec()));
            at.push((run.motion(), run.state_inputs()));
        }
        if crafts.len() < 2 {
            return None;
        }
        #[cfg(not(feature = "cuda"))]
        let _ = gpu;
        #[cfg(feature = "cuda")]
        if let Some(gpu) = gpu {
            return Some(Self { crafts: gpu.runs(crafts)?, at });
        }
        Some(Self { crafts: side_by_side(&crafts)?, at })
    }

    /// Steps of as many runs as have coming ones of the same length. Of each whether it was advanced, and the error
    /// that ends it.
    pub(crate) fn advance<'a, 's: 'a, 'r: 'a>(
        &mut self,
        runs: impl Iterator<Item = Option<&'a mut Recorded<'s, 'r>>>,
    ) -> Vec<Option<Result<(), RunError>>> {
        let mut runs: Vec<_> = runs.map(Lane::new).collect();
        let first = runs.iter().find_map(Lane::length);
        let together = || runs.iter().filter(|lane| lane.length() == first);
        let steps = together().map(|lane| lane.steps).min().unwrap_or(0);
        if let (Some(length), 2..) = (first, together().count()) {
            for (lane, at) in runs.iter().zip(&mut self.at) {
                lane.write(first, at);
            }
            let ends = self.crafts.advance(&mut self.at, length, steps);
            for (lane, ((motion, _), end)) in runs.iter_mut().zip(self.at.iter().zip(ends)) {
                // A run whose step fails makes it again by itself, and says where.
                if end.is_ok() {
                    lane.take(first, motion, steps);
                }
            }
        }
        runs.into_iter().map(|lane| lane.advanced).collect()
    }
}

/// A run and its coming steps.
struct Lane<'a, 's, 'r> {
    /// None of a run that has ended.
    recorded: Option<&'a mut Recorded<'s, 'r>>,
    length: f64,
    /// How many of that length it makes next with nothing in between; none of a run that ends or has ended.
    steps: usize,
    advanced: Option<Result<(), RunError>>,
}

impl<'a, 's, 'r> Lane<'a, 's, 'r> {
    fn new(recorded: Option<&'a mut Recorded<'s, 'r>>) -> Self {
        let mut lane = Self { recorded, length: 0.0, steps: 0, advanced: None };
        let Some(recorded) = &mut lane.recorded else { return lane };
        let until = recorded.next_sample();
        match recorded.run.coming(until) {
            Ok(Some((length, steps))) => (lane.length, lane.steps) = (length, steps),
            Ok(None) => {}
            Err(error) => lane.advanced = Some(Err(error)),
        }
        lane
    }

    /// The length of the coming steps, where there are any.
    fn length(&self) -> Option<f64> {
        (self.steps > 0).then_some(self.length)
    }

    /// Writes state and inputs, where the coming steps are of this length.
    fn write(&self, length: Option<f64>, at: &mut (Motion, StateInputs)) {
        if let Some(recorded) = self.recorded.as_ref().filter(|_| self.length() == length) {
            *at = (recorded.run.motion(), recorded.run.state_inputs());
        }
    }

    /// Takes over the motion after so many steps of this length.
    fn take(&mut self, length: Option<f64>, motion: &Motion, steps: usize) {
        let moves = self.length() == length;
        if let Some(recorded) = self.recorded.as_mut().filter(|_| moves) {
            self.advanced = Some(recorded.run.take(motion, steps));
        }
    }
}

impl Run<'_> {
    /// Length and number of the coming steps with nothing in between; none where the run ends.
    fn coming(&mut self, until: f64) -> Result<Option<(f64, usize)>, RunError> {
        if self.failed || self.end.is_some() {
            return Ok(None);
        }
        let prepared = self.prepare_step();
        self.failed = prepared.is_err();
        prepared?;
        let alone = self.system.acting.is_constant() && self.monitors.is_empty();
        let coming = self.stepper.coming(until, if alone { STEPS_MAX } else { 1 });
        Ok(coming.filter(|_| self.end.is_none()))
    }

    fn motion(&self) -> Motion {
        let state = &self.moment.state;
        Motion {
            r_b_n: state.r_b_n,
            r_b_n_dot: state.r_b_n_dot,
            attitude: state.attitude,
            omega: state.omega,
            joints: state.devices.states().collect(),
        }
    }

    fn state_inputs(&self) -> StateInputs {
        StateInputs::new(&self.system.inputs(self.time, &self.moment.state))
    }

    /// Takes over the motion after so many steps.
    fn take(&mut self, motion: &Motion, steps: usize) -> Result<(), RunError> {
        let mut state: CraftState = self.moment.state.clone();
        (state.r_b_n, state.r_b_n_dot) = (motion.r_b_n, motion.r_b_n_dot);
        (state.attitude, state.omega) = (motion.attitude, motion.omega);
        for ([coordinate, rate], from) in state.devices.states_mut().zip(&motion.joints) {
            [*coordinate, *rate] = *from;
        }
        self.stepper.take(&self.system, state, steps);
        self.finish_step()
    }
}
