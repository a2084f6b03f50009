//! Checks of a scenario, whether a file or a program gave it; and [`ScenarioError`].

use std::collections::HashSet;
use std::fmt;

use precess_dynamics::{Gravity, HubMode, ModesError, ParameterError};

use super::reserved::is_reserved;
use super::{
    Action, Drive, IntegratorChoice, Member, Profile, Scenario, Statistic, Target, members,
};
use crate::names::{column_name_fault, name_fault};
use crate::pointing::{EXPOSURE_SAMPLES_MIN, Index, IndexStream, PointingError, samples_of};
use crate::units::Plain;

/// Shorter, and a turn of no wheel fits in.
pub(crate) const DURATION_MIN: f64 = 1e-6;
/// Ten years.
pub(crate) const DURATION_MAX: f64 = 3.2e8;
/// Tighter than a few roundings of one step, no step can be accepted.
pub(crate) const TOLERANCE_MIN: f64 = 1e-15;
/// Looser than this, the step no longer resolves a turn of a wheel.
pub(crate) const TOLERANCE_MAX: f64 = 1e-3;
/// A step of RK4 is no shorter, s.
pub(crate) const STEP_MIN: f64 = 1e-9;
/// Most samples of a run: 8 bytes a number and fifty columns are 400 GB.
pub(crate) const SAMPLES_MAX: f64 = 1e9;
/// Most steps of a run that chooses its steps, for each second; Table 1 takes about 300 a second, and a run that needs
/// this many does not converge.
pub(crate) const STEPS_PER_SECOND_MAX: f64 = 1e5;
/// Most steps of a run with fixed steps.
pub(crate) const STEPS_MAX: f64 = 1e11;

impl Statistic {
    /// Whether its windows are whole numbers of samples at a rate, 1/s, and its level a probability.
    pub(crate) fn check(&self, rate: f64) -> Result<(), PointingError> {
        match *self {
            Self::Displacement(time) | Self::Smear(time) | Self::Jitter(time) => {
                samples_of(time, rate, EXPOSURE_SAMPLES_MIN).map(|_| ())
            }
            Self::Index { index, level } => {
                if !(level > 0.0 && level < 1.0) {
                    return Err(PointingError::Level(level));
                }
                if matches!(index, Index::Pre { .. }) {
                    let of = "the reproducibility error of one run";
                    return Err(PointingError::Interpretation { of });
                }
                IndexStream::new(index, rate).map(|_| ())
            }
            _ => Ok(()),
        }
    }

    /// The key of a file that says what it is of: what [`Self::check`] rejects, or what has no data.
    pub(crate) fn key(&self) -> &'static str {
        match self {
            Self::BandRms(_) => "band",
            Self::Displacement(_) | Self::Smear(_) | Self::Jitter(_) => "exposure",
            Self::Index { index: Index::Ape, .. } => "level",
            Self::Index { .. } => "window",
            _ => "statistic",
        }
    }
}

/// A scenario that cannot be run.
#[derive(Clone, Debug, PartialEq)]
pub enum ScenarioError {
    /// A number or a name is out of its range.
    Range {
        /// The key of a scenario file that holds it: `run.duration`.
        key: String,
        /// What is wrong, with the bound and the remedy.
        message: String,
    },
    /// The solver rejects the parameters.
    Parameters(ParameterError),
    /// It rejects the modes of the structure.
    Modes(ModesError),
}

impl fmt::Display for ScenarioError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Range { key, message } => write!(f, "{key}: {message}"),
            Self::Parameters(error) => error.fmt(f),
            Self::Modes(error) => error.fmt(f),
        }
    }
}

impl std::error::Error for ScenarioError {
    fn source(&self) -> Option<&(dyn std::error::Error + 'static)> {
        match self {
            Self::Range { .. } => None,
            Self::Parameters(source) => Some(source),
            Self::Modes(source) => Some(source),
        }
    }
}

pub(super) fn range(key: &str, message: String) -> ScenarioError {
    ScenarioError::Range { key: key.to_owned(), message }
}

impl Scenario {
    /// Everything that is wrong with it, in the order of the file's keys.
    #[must_use]
    pub fn check(&self) -> Vec<ScenarioError> {
        let mut errors = Vec::new();
        errors.extend(self.check_settings());
        errors.extend(self.check_hub());
        errors.extend(self.check_names());
        errors.extend(self.check_joints());
        errors.extend(self.check_points());
        errors.extend(self.check_friction());
        errors.extend(self.check_controllers());
        errors.extend(self.check_margin_requirements());
        if let Err(error) = self.spacecraft() {
            errors.push(ScenarioError::Parameters(error));
        } else {
            errors.extend(self.check_time_scales());
            errors.extend(self.check_structure());
            errors.extend(self.check_disturbances());
        }
        errors
    }

    /// What no hub and no field of gravity is, and the solver cannot tell before a state is evaluated.
    fn check_hub(&self) -> Vec<ScenarioError> {
        let mut errors = Vec::new();
        let moments = self.hub.i_b_bc.diagonal();
        let alone = members(&self.devices).is_empty();
        let zero = |moment: &f64| *moment == 0.0;
        if self.hub_mode == HubMode::Free
            && (moments.iter().all(zero) || (alone && moments.iter().any(zero)))
        {
            let [x, y, z] = [moments.x, moments.y, moments.z].map(Plain);
            let message = format!(
                "moments of inertia of the hub of {x}, {y}, {z} kg m^2; one that is free to turn has \
                 moments above zero, or write `mode = \"fixed\"`"
            );
            errors.push(range("hub.inertia", message));
        }
        if let Gravity::Central { mu } = self.gravity
            && !(mu >= 0.0 && mu.is_finite())
        {
            let message = format!(
                "a gravitational parameter of {} m^3/s^2; it is not negative, the Earth's is 3.986e14",
                Plain(mu)
            );
            errors.push(range("gravity.central", message));
        }
        errors
    }

    fn check_settings(&self) -> Vec<ScenarioError> {
        let mut errors = Vec::new();
        let duration = self.settings.duration;
        if !(DURATION_MIN..=DURATION_MAX).contains(&duration) {
            errors.push(range(
                "run.duration",
                format!(
                    "{} s is outside {DURATION_MIN:e} s to {DURATION_MAX:e} s",
                    Plain(duration)
                ),
            ));
            return errors;
        }
        match self.settings.integrator {
            IntegratorChoice::Dop853 { tolerance } => {
                if !(TOLERANCE_MIN..=TOLERANCE_MAX).contains(&tolerance) {
                    errors.push(range(
                        "run.tolerance",
                        format!(
                            "{tolerance:e} is outside {TOLERANCE_MIN:e} to {TOLERANCE_MAX:e}; \
                             1e-10 suits most runs"
                        ),
                    ));
                }
            }
            IntegratorChoice::Rk4 { step } => {
                let shortest = STEP_MIN.max(duration / STEPS_MAX);
                if !(shortest..=duration).contains(&step) {
                    errors.push(range(
                        "run.step",
                        format!(
                            "{} s is outside {shortest:e} s to the duration, {} s",
                            Plain(step),
                            Plain(duration)
                        ),
                    ));
                }
            }
        }
        let (lowest, highest) = (1.0 / duration, SAMPLES_MAX / duration);
        let rate = self.output.rate;
        if !(lowest..=highest).contains(&rate) {
            errors.push(range(
                "output.rate",
                format!(
                    "{} Hz is outside {} Hz to {} Hz: one sample in the run, and {SAMPLES_MAX:e}",
                    Plain(rate),
                    Plain(lowest),
                    Plain(highest)
                ),
            ));
        }
        for requirement in &self.requirements {
            let [from, to] = requirement.window;
            if !(0.0 <= from && from < to && to <= duration) {
                let key = if 0.0 <= from { "to" } else { "from" };
                errors.push(range(
                    &format!("requirement.{}.{key}", requirement.name),
                    format!(
                        "the window {} s to {} s is not within the run's {} s",
                        Plain(from),
                        Plain(to),
                        Plain(duration)
                    ),
                ));
            }
            let limit = requirement.limit;
            if !(limit >= 0.0 && limit.is_finite()) {
                errors.push(range(
                    &format!("requirement.{}.limit", requirement.name),
                    format!(
                        "the limit {} is not 0 or above: what it limits is a magnitude, which is never negative",
                        requirement.written
                    ),
                ));
            }
            if let Err(error) = requirement.statistic.check(rate) {
                let key = requirement.statistic.key();
                errors.push(range(
                    &format!("requirement.{}.{key}", requirement.name),
                    error.to_string(),
                ));
            }
        }
        errors
    }

    fn check_names(&self) -> Vec<ScenarioError> {
        let mut errors = Vec::new();
        let all = members(&self.devices);
        if self.names.len() != all.len() || self.drives.len() != self.joint_count() {
            errors.push(range(
                "device",
                format!(
                    "{} names and {} drives for {} devices with {} joints",
                    self.names.len(),
                    self.drives.len(),
                    all.len(),
                    self.joint_count()
                ),
            ));
        }
        let mut known = HashSet::new();
        for (index, name) in self.names.iter().enumerate() {
            let is_platform = matches!(all.get(index), Some(Member::Platform { .. }));
            let key = format!("{}.{name}.name", if is_platform { "platform" } else { "device" });
            if let Some(fault) = column_name_fault(name) {
                errors.push(range(&key, fault.to_string()));
            }
            if name == "hub" {
                let message = "`on = \"hub\"` means the hub; choose another name";
                errors.push(range(&key, message.to_owned()));
            } else if is_reserved(name) {
                let message = format!("`{name}` names other columns; choose another name");
                errors.push(range(&key, message));
            }
            if !known.insert(name.as_str()) {
                let what = if all.iter().any(|member| member.platform().is_some()) {
                    "two devices or platforms"
                } else {
                    "two devices"
                };
                errors.push(range(&key, format!("{what} are named `{name}`; rename one")));
            }
        }
        let of_margins = self.margin_requirements.iter().map(|of| of.name.as_str());
        let requirements = self.requirements.iter().map(|of| of.name.as_str()).chain(of_margins);
        let crossings = self.crossings.iter().map(|of| of.name.as_str());
        let nodes = self.structure.iter().flat_map(|of| &of.nodes).map(|node| node.name.as_str());
        errors.extend(named_once("requirement", "requirements", requirements));
        errors.extend(named_once("crossing", "crossings", crossings));
        errors.extend(named_once("structure.node", "nodes", nodes));
        errors
    }

    fn check_joints(&self) -> Vec<ScenarioError> {
        let count = self.joint_count();
        let mut errors = Vec::new();
        let mut number = |key: &str, joint: usize| {
            if joint >= count {
                errors.push(range(key, format!("joint {joint} of {count}")));
            }
        };
        self.stops.iter().for_each(|stop| number("stops", stop.joint));
        self.changes.iter().for_each(|change| number("at", change.joint));
        for wrench in &self.wrenches {
            if let Target::Joint(joint) = wrench.body {
                number("wrench.on", joint);
            }
        }
        for change in &self.changes {
            if !(0.0..=self.settings.duration).contains(&change.time) {
                let [time, duration] = [change.time, self.settings.duration].map(Plain);
                let message = format!("{time} s is outside the run, 0 s to {duration} s");
                errors.push(range("at.time", message));
            }
        }
        for profile in self.profiles() {
            if let Some(message) = profile.fault() {
                errors.push(range("profile", message));
            }
        }
        errors
    }

    /// All profiles.
    pub(crate) fn profiles(&self) -> impl Iterator<Item = &Profile> {
        let changed = self.changes.iter().filter_map(|change| match &change.action {
            Action::Drive(drive) => Some(drive),
            Action::Brake | Action::Release => None,
        });
        let of_drives = self.drives.iter().chain(changed).filter_map(Drive::profile);
        let of_wrenches = self.wrenches.iter().flat_map(|w| w.force.iter().chain(&w.moment));
        of_drives.chain(of_wrenches)
    }
}

/// What is wrong with names of one kind: a name that is none, and a second one.
fn named_once<'a>(
    table: &str,
    kind: &str,
    names: impl Iterator<Item = &'a str>,
) -> Vec<ScenarioError> {
    let mut known = HashSet::new();
    let wrong = |name: &'a str| {
        let twice = !known.insert(name);
        let message = match name_fault(name) {
            Some(fault) => fault.to_string(),
            None if twice => format!("two {kind} are named `{name}`; rename one"),
            None => return None,
        };
        Some(range(&format!("{table}.{name}.name"), message))
    };
    names.filter_map(wrong).collect()
}
