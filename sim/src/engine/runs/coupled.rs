//! [`CoupledRun`]: a run in a program that gives inputs and takes outputs at times of its own.
//!
//! Steps are those of the scenario, whatever the program's times are: outputs within a step are those that a recorder would
//! have there. Inputs are held from the end of the step in which they are given, as commands of a controller are: a change of
//! a joint's drive, a brake or an end stop takes their place.

use nalgebra::Vector3;
use precess_control::Checkpoint;
use precess_dynamics::HubMode;
use sha2::{Digest as _, Sha256};

use super::{Advance, CheckpointError, Run};
use crate::engine::integration::Moment;
use crate::engine::integration::dop853::same;
use crate::engine::quantities::sample_values::SampleValues;
use crate::record::columns::Columns;
use crate::record::{Column, RunError};
use crate::scenario::{Drive, Scenario};

/// Bytes of a digest at the end of a checkpoint.
const DIGEST: usize = 8;

/// A run that a program is coupled to.
pub struct CoupledRun<'a> {
    run: Run<'a>,
    columns: Vec<Column>,
    /// The joints whose motors the program drives.
    motors: Vec<usize>,
    /// The inputs that are held; NaN of motors until they are given.
    inputs: Vec<f64>,
    values: SampleValues,
    moment: Moment,
    /// The time that the program has reached, s.
    time: f64,
    /// Of the scenario's text, with every default.
    scenario: [u8; 32],
}

impl<'a> CoupledRun<'a> {
    /// Begins a run; no step is made.
    ///
    /// # Errors
    ///
    /// As [`Run::new`]; [`RunError::Record`] of a column that the scenario has not.
    pub fn new(scenario: &'a Scenario) -> Result<Self, RunError> {
        let run = Run::new(scenario)?;
        let columns = Columns::from_scenario(scenario)?;
        let motors = driven_by_program(scenario);
        let mut inputs = vec![0.0; hub_input_count(scenario)];
        inputs.resize(inputs.len() + motors.len(), f64::NAN);
        Ok(Self {
            columns: columns.as_slice().to_vec(),
            motors,
            inputs,
            values: SampleValues::new(scenario, columns),
            moment: run.moment.clone(),
            time: 0.0,
            scenario: Sha256::digest(&scenario.source.filled).into(),
            run,
        })
    }

    /// What the outputs are: the columns that the scenario records, time first.
    #[must_use]
    pub fn columns(&self) -> &[Column] {
        &self.columns
    }

    /// How many inputs there are: of a free rigid hub force through B and torque about B, both expressed in B, N and N m; then
    /// the torque or force of each motor that no controller commands, in the order of the joints, N m or N.
    #[must_use]
    pub fn input_count(&self) -> usize {
        self.inputs.len()
    }

    /// The joints of these motors, by their numbers from 0.
    #[must_use]
    pub fn motors(&self) -> &[usize] {
        &self.motors
    }

    /// Runs to a time, s, with inputs that are held. Returns whether it is reached: the run may end before.
    ///
    /// # Errors
    ///
    /// [`RunError::Inputs`] of another number of inputs; the one that ends the run.
    pub fn advance(&mut self, inputs: &[f64], time: f64) -> Result<bool, RunError> {
        self.give(inputs)?;
        while self.run.time < time && !same(self.run.time, time) {
            if self.run.advance()? == Advance::Ended {
                return Ok(false);
            }
        }
        self.time = time;
        if same(self.run.time, time) && self.run.end.is_none() {
            // What a controller commands at this time is an output of it.
            self.run.prepare_step()?;
        }
        Ok(true)
    }

    /// The outputs at the time that was reached, with these inputs.
    ///
    /// # Errors
    ///
    /// [`RunError::Inputs`] of another number of inputs; [`RunError::Solve`].
    pub fn outputs(&mut self, inputs: &[f64]) -> Result<&[f64], RunError> {
        self.give(inputs)?;
        let Self { run, values, moment, time, .. } = self;
        let held_from = if *time >= run.time || same(*time, run.time) {
            moment.clone_from(&run.moment);
            run.time
        } else {
            run.stepper.at(&run.system, *time, moment)?;
            run.stepper.held_from(*time)
        };
        let turns = run.stepper.turns();
        let filled = values.fill(&run.system, [*time, held_from], moment, turns, run.lost);
        filled.map_err(|source| RunError::solve(&run.system, *time, source))
    }

    /// All that its next steps and outputs depend on, as bytes: a run that takes them goes on with the same bits, on every host.
    ///
    /// # Errors
    ///
    /// [`CheckpointError::Kept`] of a run with a tolerance, or with a controller that is another program.
    pub fn checkpoint(&mut self) -> Result<Vec<u8>, CheckpointError> {
        let written = Checkpoint::written(|checkpoint| self.visit(checkpoint));
        let mut bytes = written.ok_or(CheckpointError::Kept)?;
        let digest = self.digest(&bytes);
        bytes.extend(digest);
        Ok(bytes)
    }

    /// Goes on from a checkpoint of a run of the same scenario.
    ///
    /// # Errors
    ///
    /// [`CheckpointError::Bytes`] of bytes that are none; the run then stays as it is.
    pub fn restore(&mut self, bytes: &[u8]) -> Result<(), CheckpointError> {
        let (bytes, digest) = bytes.split_last_chunk::<DIGEST>().ok_or(CheckpointError::Bytes)?;
        if *digest != self.digest(bytes) {
            return Err(CheckpointError::Bytes);
        }
        let before = self.checkpoint()?;
        if Checkpoint::read(bytes, |checkpoint| self.visit(checkpoint)) {
            return Ok(());
        }
        let (before, _) = before.split_last_chunk::<DIGEST>().ok_or(CheckpointError::Bytes)?;
        let _ = Checkpoint::read(before, |checkpoint| self.visit(checkpoint));
        Err(CheckpointError::Bytes)
    }

    fn visit(&mut self, checkpoint: &mut Checkpoint<'_>) {
        checkpoint.numbers(self.inputs.iter_mut().chain([&mut self.time]));
        self.run.visit(checkpoint);
    }

    /// What tells bytes of this scenario from others.
    fn digest(&self, bytes: &[u8]) -> [u8; DIGEST] {
        let mut digest = Sha256::new();
        digest.update(self.scenario);
        digest.update(bytes);
        let digest: [u8; 32] = digest.finalize().into();
        std::array::from_fn(|index| digest.get(index).copied().unwrap_or_default())
    }

    /// Holds inputs. Others than those that are held begin a segment.
    fn give(&mut self, inputs: &[f64]) -> Result<(), RunError> {
        let expected = self.input_count();
        if inputs.len() != expected || !inputs.iter().all(|input| input.is_finite()) {
            return Err(RunError::Inputs { expected, found: inputs.len() });
        }
        if inputs == self.inputs {
            return Ok(());
        }
        self.inputs.copy_from_slice(inputs);
        let held = &mut self.run.system.acting.held;
        let (on_hub, motors) = inputs.split_at(expected - self.motors.len());
        if let [f_x, f_y, f_z, l_x, l_y, l_z] = *on_hub {
            held.hold_on_hub(Vector3::new(f_x, f_y, f_z), Vector3::new(l_x, l_y, l_z));
        }
        for (joint, torque) in self.motors.iter().zip(motors) {
            held.hold(*joint, *torque);
        }
        self.run.at_boundary = true;
        Ok(())
    }
}

/// How many numbers a program gives for the hub: force and torque, of a free rigid one. A force on a flexible structure
/// acts on one of its nodes.
pub(crate) fn hub_input_count(scenario: &Scenario) -> usize {
    let is_free = scenario.hub_mode == HubMode::Free && scenario.structure.is_none();
    if is_free { 6 } else { 0 }
}

/// The joints with a motor that a profile drives and no controller commands.
pub(crate) fn driven_by_program(scenario: &Scenario) -> Vec<usize> {
    let commanded = |joint: usize| {
        scenario.controllers.iter().flat_map(|of| &of.joints).any(|of| of.joint == joint)
    };
    let joints = scenario.joints().zip(&scenario.drives).enumerate();
    let driven = joints.filter(|(joint, ((.., info), drive))| {
        info.driven && matches!(drive, Drive::Torque { .. }) && !commanded(*joint)
    });
    driven.map(|(joint, _)| joint).collect()
}
