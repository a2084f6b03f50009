//! The time domain beside the frequency domain: a run of the scenario's own, nonlinear equations at one speed, started in
//! the steady motion that the lines predict, and its amplitudes at their frequencies.
//!
//! The motion of a node is `x = -a / w^2` and `theta = omega / (i w)` of its recorded acceleration and angular velocity;
//! amplitudes are found by least squares of sines and cosines at all frequencies, and a constant, over a whole number
//! of the slowest line's periods. The frequencies are those at which the rotors turn on average: a free rotor does not keep
//! its rate to the last digit.

use std::ops::ControlFlow;

use nalgebra::{Complex, DMatrix, DVector, Vector3};
use precess_dynamics::{Attitude, Gravity, HubMode, JointStates, Quaternion};

use super::budget::Budget;
use super::device::Steady;
use super::model::{HUB, Model};
use super::settled::add_vibration;
use crate::engine;
use crate::record::{End, Header, Outcome, RecordError, Recorder, RunError};
use crate::scenario::{Drive, IntegratorChoice, Profile, Scenario};
use crate::structure::Fault;

/// Samples of the fastest line's period.
const SAMPLES: f64 = 16.0;
/// Periods of the slowest line that the window has at least.
const PERIODS: f64 = 20.0;
/// The window is at least this many time constants of the most slowly decaying mode near a line.
const TIME_CONSTANTS: f64 = 4.0;
/// A mode is near a line within this share of its frequency.
const NEAR: f64 = 0.2;
/// Longest run, s, and most samples.
const LONGEST: f64 = 120.0;
const SAMPLES_MAX: f64 = 4e6;
/// Error of a step of the integrator.
const TOLERANCE: f64 = 1e-10;

/// Why two paths could not be compared.
#[derive(Debug)]
pub enum CoupledError {
    /// The lines of the frequency domain.
    Fault(Fault),
    /// The run.
    Run(RunError),
    /// A node whose motion the scenario does not record.
    NotRecorded(String),
    /// The run ended early.
    Ended {
        /// When, s.
        time: f64,
        /// Of so many.
        of: f64,
    },
    /// No contributor has a tone.
    NoTones,
}

impl std::fmt::Display for CoupledError {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Fault(fault) => fault.fmt(f),
            Self::Run(error) => error.fmt(f),
            Self::NotRecorded(node) => write!(
                f,
                "the motion of node `{node}` is not recorded; add `[[structure.point]]` with `name = \"{node}\"` to \
                 the scenario"
            ),
            Self::Ended { time, of } => {
                write!(f, "the coupled run ended after {time} s of {of} s; see `precess run`")
            }
            Self::NoTones => f.write_str(
                "no rotor has a tone: give a wheel an imbalance and a rate in the scenario, or a `[[source]]`",
            ),
        }
    }
}

impl std::error::Error for CoupledError {}

impl From<Fault> for CoupledError {
    fn from(fault: Fault) -> Self {
        Self::Fault(fault)
    }
}

/// Amplitudes of both paths at a speed.
#[derive(Clone, Debug)]
pub struct Compared {
    /// Speed, rad/s.
    pub speed: f64,
    /// Length of the window, s.
    pub window: f64,
    /// Frequency, rad/s, and amplitudes of each output: predicted, found.
    pub lines: Vec<(f64, Vec<[Complex<f64>; 2]>)>,
    /// Of each frequency what does not cancel, of the output of which it is largest: the magnitudes of its tones, added up,
    /// or a thousandth of the magnitudes of all terms of the amplitude where that is more.
    pub magnitudes: Vec<f64>,
}

impl Compared {
    /// The largest difference of an amplitude, in units of [`Self::magnitudes`]; of a frequency at which there are none,
    /// in those of the largest of all frequencies. Zero where nothing moves.
    #[must_use]
    pub fn difference(&self) -> f64 {
        let largest = self.magnitudes.iter().copied().fold(0.0, f64::max);
        let of = |(values, unit): (&Vec<[Complex<f64>; 2]>, &f64)| {
            let apart = values.iter().map(|[expected, found]| (found - expected).norm());
            let apart = apart.fold(0.0, f64::max);
            let unit = if *unit > 0.0 { *unit } else { largest };
            if unit > 0.0 { apart / unit } else { apart }
        };
        let values = self.lines.iter().map(|(_, values)| values);
        values.zip(&self.magnitudes).map(of).fold(0.0, f64::max)
    }
}

/// Compares both paths at a speed.
///
/// # Errors
/// [`CoupledError`].
pub fn compare(scenario: &Scenario, budget: &Budget, speed: f64) -> Result<Compared, CoupledError> {
    let steady = Steady { motor: budget.motor, sprung: budget.sprung, swept: Some(&budget.swept) };
    // Only imbalance: the run has no sources, whose noise would be among the lines.
    let model = Model::new(scenario, &budget.outputs(), &steady)?;
    let lines = model.lines(speed)?;
    let mut frequencies: Vec<f64> = lines.iter().map(|line| line.frequency).collect();
    frequencies.sort_by(f64::total_cmp);
    frequencies.dedup();
    let (Some(slowest), Some(fastest)) = (frequencies.first(), frequencies.last()) else {
        return Err(CoupledError::NoTones);
    };
    let turn = std::f64::consts::TAU;
    let slow_modes = model.structure.modes.iter().filter(|mode| {
        frequencies.iter().any(|frequency| (mode.frequency / frequency - 1.0).abs() < NEAR)
    });
    let decay = slow_modes.map(|mode| mode.damping * mode.frequency).fold(f64::INFINITY, f64::min);
    let wanted = (PERIODS * turn / slowest).max(TIME_CONSTANTS / decay);
    let rate = SAMPLES * fastest / turn;
    let window = wanted.min(LONGEST).min(SAMPLES_MAX / rate);
    let mut run = scenario.clone();
    run.start_in_mean();
    steady_spin(&mut run, scenario, &model, &steady, speed)?;
    add_vibration(&mut run, &model, speed)?;
    run.settings.duration = window;
    run.settings.integrator = IntegratorChoice::Dop853 { tolerance: TOLERANCE };
    run.output.rate = rate;
    let nodes = nodes(budget, &run)?;
    run.output.columns = nodes.iter().flat_map(|(_, columns)| columns.clone()).collect();
    let mut samples = Samples::default();
    let outcome = engine::run(&run, &mut samples, &mut |_| ControlFlow::Continue(()))
        .map_err(CoupledError::Run)?;
    if !matches!(outcome.end, End::Finished) {
        return Err(CoupledError::Ended { time: outcome.end_time, of: window });
    }
    let expected = |frequency: f64, output: usize| -> Complex<f64> {
        let same = lines.iter().filter(|line| line.frequency.to_bits() == frequency.to_bits());
        same.filter_map(|line| line.values.get(output)).sum()
    };
    let magnitudes = model.magnitudes(speed, &lines, &frequencies)?;
    let found = samples.amplitudes(&frequencies, &nodes, budget);
    let outputs = 2 * budget.sights.len();
    let lines = frequencies.iter().zip(found).map(|(frequency, found)| {
        let values = (0..outputs)
            .map(|k| [expected(*frequency, k), found.get(k).copied().unwrap_or_default()]);
        (*frequency, values.collect())
    });
    Ok(Compared { speed, window, lines: lines.collect(), magnitudes })
}

/// Rotors at their rates by motors that keep or balance them; all other joints free on their springs, or held. No gravity,
/// wrenches, changes, controllers or end stops.
fn steady_spin(
    run: &mut Scenario,
    scenario: &Scenario,
    model: &Model,
    steady: &Steady<'_>,
    speed: f64,
) -> Result<(), CoupledError> {
    (run.gravity, run.hub_mode) = (Gravity::None, HubMode::Free);
    run.wrenches.clear();
    run.disturbances.clear();
    run.changes.clear();
    run.controllers.clear();
    run.stops.clear();
    run.crossings.clear();
    run.requirements.clear();
    for drive in &mut run.drives {
        if !matches!(drive, Drive::Acceleration(_)) {
            *drive = Drive::Locked;
        }
    }
    for (_, device) in &model.devices {
        let torques = device.motors(scenario, steady, speed)?;
        for (joint, torque) in device.free.iter().zip(torques) {
            if let Some(drive) = run.drives.get_mut(device.first_joint + joint) {
                *drive = Drive::Torque { profile: Profile::Constant(torque), limit: None };
            }
        }
        for rotor in &device.rotors {
            let joint = device.first_joint + rotor.joint;
            let rate = rotor.rate(speed);
            if let Some([_, of]) = run.initial.devices.states_mut().nth(joint) {
                *of = rate;
            }
            let is_free = device.free.contains(&rotor.joint);
            if let (false, Some(drive)) = (is_free, run.drives.get_mut(joint)) {
                *drive = Drive::Acceleration(Profile::ZERO);
            }
        }
    }
    // What is held does not move.
    let joints: Vec<bool> = run.drives.iter().map(|drive| *drive == Drive::Locked).collect();
    for ([_, rate], locked) in run.initial.devices.states_mut().zip(joints) {
        if locked {
            *rate = 0.0;
        }
    }
    let none = Vector3::zeros();
    (run.initial.r_b_n, run.initial.r_b_n_dot, run.initial.omega) = (none, none, none);
    run.initial.attitude = Quaternion::identity();
    Ok(())
}

/// Nodes of the lines of sight, with the columns of their acceleration and angular velocity.
fn nodes(budget: &Budget, run: &Scenario) -> Result<Vec<(String, Vec<String>)>, CoupledError> {
    let mut nodes: Vec<(String, Vec<String>)> = Vec::new();
    for of in budget.sights.iter().flat_map(|sight| sight.line.sensitivities()) {
        if nodes.iter().any(|(node, _)| *node == of.node) {
            continue;
        }
        let columns = match &run.structure {
            None if of.node == HUB => vec!["velocity".to_owned(), "omega".to_owned()],
            None => return Err(CoupledError::NotRecorded(of.node.clone())),
            Some(structure) => {
                let point = structure.points.iter().find(|point| {
                    structure.nodes.get(point.node).is_some_and(|node| node.name == of.node)
                });
                let point = point.ok_or_else(|| CoupledError::NotRecorded(of.node.clone()))?;
                vec![format!("{}.acceleration", point.name), format!("{}.omega", point.name)]
            }
        };
        nodes.push((of.node.clone(), columns));
    }
    Ok(nodes)
}

/// What a run recorded.
#[derive(Default)]
struct Samples {
    names: Vec<String>,
    rows: Vec<Vec<f64>>,
}

impl Recorder for Samples {
    fn begin(&mut self, header: &Header) -> Result<(), RecordError> {
        self.names = header.columns.iter().map(|column| column.name.clone()).collect();
        Ok(())
    }

    fn sample(&mut self, row: &[f64]) -> Result<(), RecordError> {
        self.rows.push(row.to_vec());
        Ok(())
    }

    fn finish(&mut self, _: &Outcome) -> Result<(), RecordError> {
        Ok(())
    }
}

impl Samples {
    /// At each frequency the amplitude of each output.
    fn amplitudes(
        &self,
        frequencies: &[f64],
        nodes: &[(String, Vec<String>)],
        budget: &Budget,
    ) -> Vec<Vec<Complex<f64>>> {
        let count = 2 * frequencies.len() + 2;
        let row = |time: f64| {
            let mut row = vec![1.0, time];
            for frequency in frequencies {
                let (sine, cosine) = precess_dynamics::Angle::sin_cos(frequency * time);
                row.extend([cosine, sine]);
            }
            row
        };
        // Normal equations: lines are periods apart, so they are nearly diagonal.
        let (mut normal, columns) = (DMatrix::zeros(count, count), self.names.len());
        let mut right = DMatrix::zeros(count, columns);
        for sample in &self.rows {
            let own = DVector::from_vec(row(sample.first().copied().unwrap_or(0.0)));
            normal += &own * own.transpose();
            right += &own * DVector::from_column_slice(sample).transpose();
        }
        let Some(found) = normal.lu().solve(&right) else { return Vec::new() };
        let amplitude = |line: usize, column: &str| {
            let place = self.names.iter().position(|name| name == column);
            place.map_or(Complex::new(0.0, 0.0), |place| {
                Complex::new(found[(2 + 2 * line, place)], -found[(3 + 2 * line, place)])
            })
        };
        let of_line = |(line, frequency): (usize, &f64)| {
            let by_rate = Complex::new(0.0, *frequency).inv();
            let mut outputs = Vec::new();
            for sight in &budget.sights {
                let mut sums = [Complex::new(0.0, 0.0); 2];
                for of in sight.line.sensitivities() {
                    let Some((_, columns)) = nodes.iter().find(|(node, _)| *node == of.node) else {
                        continue;
                    };
                    let [moved, turned] =
                        [0, 1].map(|k| columns.get(k).cloned().unwrap_or_default());
                    let to_place = if moved == "velocity" { by_rate } else { by_rate * by_rate };
                    for (axis, sum) in sums.iter_mut().enumerate() {
                        for (k, letter) in ["x", "y", "z"].into_iter().enumerate() {
                            let x = amplitude(line, &format!("{moved}_{letter}")) * to_place;
                            let theta = amplitude(line, &format!("{turned}_{letter}")) * by_rate;
                            *sum += x * of.displacement[(axis, k)] + theta * of.rotation[(axis, k)];
                        }
                    }
                }
                outputs.extend(sums);
            }
            outputs
        };
        frequencies.iter().enumerate().map(of_line).collect()
    }
}
