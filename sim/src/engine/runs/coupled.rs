//! [`CoupledRun`]: a run in a program that gives inputs and takes outputs at times of its own.
//!
//! Steps are those of the scenario, whatever the program's times are: outputs within a step are those that a recorder would
//! have there. Inputs are held from the end of the step in which they are given.

use nalgebra::Vector3;

use super::{Advance, Run};
use crate::engine::equations::given::GivenInputs;
use crate::engine::integration::Moment;
use crate::engine::integration::dop853::same;
use crate::engine::quantities::sample_values::SampleValues;
use crate::record::columns::Columns;
use crate::record::{Column, RunError};
use crate::scenario::{Drive, Scenario};

/// Numbers of the hub's inputs: force and torque.
const ON_HUB: usize = 6;

/// A run that a program is coupled to.
pub struct CoupledRun<'a> {
    run: Run<'a>,
    columns: Vec<Column>,
    /// The joints whose motors the program drives.
    motors: Vec<usize>,
    values: SampleValues,
    moment: Moment,
    /// The time that the program has reached, s.
    time: f64,
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
        Ok(Self {
            columns: columns.as_slice().to_vec(),
            motors: driven_by_program(scenario),
            values: SampleValues::new(scenario, columns),
            moment: run.moment.clone(),
            time: 0.0,
            run,
        })
    }

    /// What the outputs are: the columns that the scenario records, time first.
    #[must_use]
    pub fn columns(&self) -> &[Column] {
        &self.columns
    }

    /// How many inputs there are: force through B and torque about B on the hub, both expressed in B, N and N m; then the
    /// torque or force of each motor that no controller commands, in the order of the joints, N m or N.
    #[must_use]
    pub fn input_count(&self) -> usize {
        ON_HUB + self.motors.len()
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

    /// Holds inputs. Others than those that are held begin a segment.
    fn give(&mut self, inputs: &[f64]) -> Result<(), RunError> {
        let expected = self.input_count();
        if inputs.len() != expected || !inputs.iter().all(|input| input.is_finite()) {
            return Err(RunError::Inputs { expected, found: inputs.len() });
        }
        let (on_hub, motors) = inputs.split_at(ON_HUB);
        let (force, torque) = on_hub.split_at(3);
        let mut of_joints = vec![None; self.run.scenario.joint_count()];
        for (joint, torque) in self.motors.iter().zip(motors) {
            if let Some(of_joint) = of_joints.get_mut(*joint) {
                *of_joint = Some(*torque);
            }
        }
        let (force, torque) =
            (Vector3::from_column_slice(force), Vector3::from_column_slice(torque));
        let given = GivenInputs { force, torque, motors: of_joints };
        if given != self.run.system.acting.given {
            self.run.system.acting.given = given;
            self.run.at_boundary = true;
        }
        Ok(())
    }
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
