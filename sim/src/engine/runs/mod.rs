//! [`Run`]: one run step by step; recorded to its end ([`run`]), or several side by side
//! ([`run_side_by_side`]).

mod actions;
mod checkpoint;
mod coupled;
mod friction;
#[cfg(feature = "cuda")]
mod gpu;
mod hardware;
#[cfg(feature = "lanes")]
mod lanes;
mod motors;
mod recorded;
mod sampling;
mod side_by_side;

use precess_dynamics::{About, JointStates, ModalState, State};

pub use checkpoint::CheckpointError;
pub use coupled::CoupledRun;
pub(crate) use coupled::{driven_by_program, hub_input_count};
use friction::Changed;
#[cfg(feature = "cuda")]
pub use gpu::Gpu;
pub(crate) use hardware::HardwareChange;
pub(crate) use recorded::run_with_change;
pub use recorded::{run, run_with_controllers};
pub use side_by_side::{SIDE_BY_SIDE, run_side_by_side, run_side_by_side_on};

/// A GPU; there is none in a build without the feature `cuda`.
#[cfg(not(feature = "cuda"))]
#[derive(Debug)]
pub enum Gpu {}

use crate::control::Controller;
use crate::engine::control::Controls;
use crate::engine::craft_of;
use crate::engine::equations::run_quantities::RunQuantities;
use crate::engine::equations::system::System;
use crate::engine::events::motors::MotorChange;
use crate::engine::events::segments::Segments;
use crate::engine::events::{EventKind, Monitors, StepEvent};
use crate::engine::integration::{Moment, Stepper};
use crate::engine::quantities::drift::Conserved;
use crate::record::{Drift, End, Event, Outcome, RunError, Steps};
use crate::scenario::{Scenario, Set, StopAction};

/// Events kept; a crossing in every turn of a wheel would otherwise fill the memory.
const EVENTS_MAX: usize = 10_000;

/// A run in progress.
pub struct Run<'a> {
    scenario: &'a Scenario,
    pub(super) system: System<'a>,
    pub(super) stepper: Stepper,
    segments: Segments<'a>,
    controls: Controls<'a>,
    /// The end of the present segment, s.
    segment_end: f64,
    monitors: Monitors<'a>,
    conserved: Conserved,
    events: Vec<Event>,
    events_omitted: u64,
    lost: f64,
    peak_rates: Vec<f64>,
    /// The state at the start of a segment or the end of a step.
    pub(super) moment: Moment,
    time: f64,
    /// Whether the present time is the end of a segment.
    at_boundary: bool,
    /// A joint that has reached a stop which locks it, and the stop.
    stopped: Option<(usize, f64)>,
    /// A motor that has come to one of its limits or leaves it.
    motor_change: Option<MotorChange>,
    /// A joint whose friction comes to hold it or no longer does.
    changed: Option<Changed>,
    /// Changes of friction since the time last changed.
    changes_at_once: usize,
    end: Option<End>,
    /// Whether an error has ended it.
    failed: bool,
}

/// Whether a run goes on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Advance {
    /// A step was made.
    Stepped,
    /// The run has ended; nothing was done.
    Ended,
}

impl<'a> Run<'a> {
    /// Checks a scenario and prepares its run; no step is made.
    ///
    /// # Errors
    ///
    /// [`RunError::Scenario`] with everything that is wrong with the scenario, and what can only be
    /// found with the spacecraft: a joint beyond its stops, a moving joint that is locked, a
    /// crossing of an unknown column, a state that the solver cannot solve.
    pub fn new(scenario: &'a Scenario) -> Result<Self, RunError> {
        Self::with_quantities(scenario, RunQuantities::All)
    }

    /// As [`Self::new`]; computes no more than what is kept.
    ///
    /// # Errors
    ///
    /// As [`Self::new`].
    pub fn with_quantities(
        scenario: &'a Scenario,
        quantities: RunQuantities,
    ) -> Result<Self, RunError> {
        Self::with_controllers(scenario, quantities, Vec::new())
    }

    /// As [`Self::with_quantities`], with controllers of a program in the place of the laws of the scenario's controllers of
    /// these names.
    ///
    /// # Errors
    ///
    /// As [`Self::new`]; [`RunError::NoController`] of a name that no controller has.
    pub fn with_controllers(
        scenario: &'a Scenario,
        quantities: RunQuantities,
        controllers: Vec<(String, Box<dyn Controller>)>,
    ) -> Result<Self, RunError> {
        let errors = scenario.check();
        if !errors.is_empty() {
            return Err(RunError::Scenario(errors));
        }
        let craft = craft_of(scenario)?;
        let system = System::new(scenario, craft, quantities);
        let (eta, eta_dot) = scenario
            .structure
            .as_ref()
            .map_or_else(Default::default, |of| (of.coordinates.clone(), of.rates.clone()));
        let state = scenario.initial.clone().with_modal(ModalState { eta, eta_dot });
        let moment = Moment { state, integrals: [0.0; 2] };
        // The solver names what is not finite, and a list of another length.
        let evaluated = system.craft.momentum(&moment.state, About::InertialOrigin);
        evaluated.map_err(|source| RunError::solve(&system, 0.0, source))?;
        let mut run = Self {
            stepper: Stepper::new(&system, scenario.settings.integrator, &moment),
            segments: Segments::new(scenario),
            controls: Controls::new(scenario, controllers)?,
            segment_end: 0.0,
            monitors: Monitors::new(scenario, &system, &moment)?,
            conserved: Conserved::new(scenario, &system),
            events: Vec::new(),
            events_omitted: 0,
            lost: 0.0,
            peak_rates: match quantities {
                RunQuantities::All => vec![0.0; scenario.joint_count()],
                RunQuantities::Motion => Vec::new(),
            },
            moment,
            time: 0.0,
            at_boundary: true,
            stopped: None,
            motor_change: None,
            changed: None,
            changes_at_once: 0,
            end: None,
            failed: false,
            scenario,
            system,
        };
        run.check_drives()?;
        run.begin_segment()?;
        run.enter()?;
        Ok(run)
    }

    /// Makes one accepted step, and before it whatever is due at the present time.
    ///
    /// # Errors
    ///
    /// The one that ends the run; the state stays that of the last accepted step.
    pub fn advance(&mut self) -> Result<Advance, RunError> {
        if self.end.is_some() || self.failed {
            return Ok(Advance::Ended);
        }
        let advanced = self.make_step();
        self.failed = advanced.is_err();
        advanced.map(|()| Advance::Stepped)
    }

    fn make_step(&mut self) -> Result<(), RunError> {
        self.prepare_step()?;
        if self.end.is_some() {
            return Ok(());
        }
        self.stepper.step(&self.system)?;
        self.finish_step()
    }

    /// Whatever is due at the present time; the same when called again before the step.
    fn prepare_step(&mut self) -> Result<(), RunError> {
        if self.at_boundary { self.begin_segment() } else { self.stepper.reduce(&self.system) }
    }

    /// Stops, crossings and limits of motors that the last step passed, and the state that is reached.
    fn finish_step(&mut self) -> Result<(), RunError> {
        let passed = self.monitors.passed(&self.system, &mut self.stepper)?;
        let mut reached = self.stepper.time();
        for StepEvent { time, what } in passed {
            match what {
                EventKind::Crossing { index, ends } => {
                    let name = self.scenario.crossings[index].name.clone();
                    self.note(time, format!("crossing `{name}`"));
                    if ends {
                        reached = time;
                        self.end = Some(End::Crossing { name });
                    }
                }
                EventKind::Motor(change) => {
                    reached = time;
                    self.motor_change = Some(change);
                }
                EventKind::Rest { joint } => {
                    (reached, self.changed) = (time, Some(Changed::AtRest(joint)));
                }
                EventKind::Release { joint } => {
                    (reached, self.changed) = (time, Some(Changed::Released(joint)));
                }
                EventKind::Stop { joint, bound, action } => {
                    reached = time;
                    let place = &self.system.layout.joints[joint];
                    let (name, [unit, ..]) = (place.name.clone(), place.info.units());
                    match action {
                        StopAction::End => {
                            self.note(
                                time,
                                format!("{name} reaches its end stop at {bound} {unit}"),
                            );
                            self.end = Some(End::EndStop { joint: name, bound, unit });
                        }
                        StopAction::Lock => self.stopped = Some((joint, bound)),
                    }
                }
            }
        }
        self.count_changes(reached)?;
        let jumps = self.stopped.is_some() || self.motor_change.is_some() || self.changed.is_some();
        if reached < self.stepper.time() || jumps {
            self.stepper.restep(&self.system, reached, &mut self.moment)?;
            self.at_boundary = true;
        } else {
            self.stepper.now(&self.system, &mut self.moment);
            self.at_boundary = reached >= self.segment_end;
        }
        self.time = reached;
        self.enter()?;
        if self.end.is_none() && self.stopped.is_none() && self.time >= self.duration() {
            self.end = Some(End::Finished);
        }
        Ok(())
    }

    /// The present simulated time, s.
    #[must_use]
    pub fn time(&self) -> f64 {
        self.time
    }

    /// Length of the run, s.
    #[must_use]
    pub fn duration(&self) -> f64 {
        self.scenario.settings.duration
    }

    /// The present state, joint angles counted through every turn.
    #[must_use]
    pub fn state(&self) -> State<Set> {
        let mut state: State<Set> = self.moment.state.clone().with_modal(());
        let joints = state.devices.states_mut();
        for ([coordinate, _], turns) in joints.zip(self.stepper.turns()) {
            *coordinate += turns * std::f64::consts::TAU;
        }
        state
    }

    /// Modal coordinates of the structure, m kg^1/2, and their rates; empty on a rigid hub.
    #[must_use]
    pub fn modal(&self) -> (&[f64], &[f64]) {
        (&self.moment.state.modal.eta, &self.moment.state.modal.eta_dot)
    }

    /// Work of all sources but gravity and springs since the start, J; NaN where it is not kept.
    #[must_use]
    pub fn work(&self) -> f64 {
        self.moment.integrals[0]
    }

    /// Energy lost in brakes and locking end stops so far, J.
    #[must_use]
    pub fn energy_lost(&self) -> f64 {
        self.lost
    }

    /// How far conserved quantities have drifted so far; nothing where only the motion is kept.
    #[must_use]
    pub fn drift(&self) -> Drift {
        match self.system.quantities {
            RunQuantities::All => self.conserved.drift(),
            RunQuantities::Motion => Drift::default(),
        }
    }

    /// Why it has ended; none while it has not, or after an error.
    #[must_use]
    pub fn end(&self) -> Option<&End> {
        self.end.as_ref()
    }

    /// What has happened so far.
    #[must_use]
    pub fn events(&self) -> &[Event] {
        &self.events
    }

    /// Counts so far.
    #[must_use]
    pub fn steps(&self) -> Steps {
        let [accepted, rejected] = self.stepper.steps();
        Steps { accepted, rejected, evaluations: self.system.evaluations() }
    }

    /// The result as it is now, for this reason.
    #[must_use]
    pub fn outcome(self, end: End, samples: u64) -> Outcome {
        Outcome {
            end_time: self.time,
            end,
            steps: self.steps(),
            samples,
            drift: self.drift(),
            energy_lost: self.lost,
            peak_rates: self.peak_rates,
            events: self.events,
            events_omitted: self.events_omitted,
        }
    }

    fn note(&mut self, time: f64, text: String) {
        if self.events.len() < EVENTS_MAX {
            self.events.push(Event { time, text });
        } else {
            self.events_omitted += 1;
        }
    }

    /// Enters the present moment into the peaks and the drifts, where these are kept.
    fn enter(&mut self) -> Result<(), RunError> {
        if self.system.quantities == RunQuantities::Motion {
            return Ok(());
        }
        let joints = self.moment.state.devices.states();
        for (peak, [_, rate]) in self.peak_rates.iter_mut().zip(joints) {
            *peak = peak.max(rate.abs());
        }
        self.conserved
            .enter(self.scenario, &self.system, self.time, &self.moment, self.lost)
            .map_err(|source| RunError::solve(&self.system, self.time, source))
    }
}
