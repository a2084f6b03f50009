//! [`SampledController`]: a law that is computed at samples, and what it commands; and what is wrong with one.

use nalgebra::Matrix3;
use precess_dynamics::Steered;
use precess_dynamics::kind::JointInfo;

use super::check::{SAMPLES_MAX, range};
use super::control_law::{AttitudeReference, ControlLaw};
use super::controller_sensors::{
    ControllerSensors, DumpingSettings, EstimatorSettings, FilterSettings,
};
use super::mass::MassProperties;
use super::{Action, Drive, Member, Scenario, ScenarioError, body_key, joint_key, members};
use crate::units::Plain;

/// Most joints that a controller commands: eight gyros of three.
pub(crate) const COMMANDED_MAX: usize = 24;
/// Longest delay, in samples.
pub(crate) const DELAY_MAX: f64 = 100.0;

/// A controller that samples attitude and rate of the hub, and holds the torques of motors between its samples.
///
/// Its samples are at `offset + k / rate`, k from 0; what it computes from one acts from `delay` after it.
#[derive(Clone, Debug, PartialEq)]
pub struct SampledController {
    /// Its name, with which its columns begin.
    pub name: String,
    /// Samples per second, Hz.
    pub rate: f64,
    /// The time of the first sample, s.
    pub offset: f64,
    /// From a sample to the action of what is computed from it, s.
    pub delay: f64,
    /// The joints that it commands, in the order of the set.
    pub joints: Vec<CommandedJoint>,
    /// From motion and reference to a torque on the spacecraft.
    pub law: ControlLaw,
    /// What the hub is to follow.
    pub reference: AttitudeReference,
    /// From that torque to commands of joints.
    pub allocation: TorqueAllocation,
    /// From commands to torques of motors.
    pub servo: ServoSettings,
    /// What it reads of the truth.
    pub sensors: ControllerSensors,
    /// One after another, of the rate that it reads and of the torque that it commands.
    pub filters: Vec<FilterSettings>,
    /// From readings to attitude and rate; none where the law reads these as they are.
    pub estimator: Option<EstimatorSettings>,
    /// An external torque that takes momentum from the devices.
    pub dumping: Option<DumpingSettings>,
}

/// A joint that is commanded.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CommandedJoint {
    /// The joint.
    pub joint: usize,
    /// Its rate, of a gimbal, or its acceleration, of a wheel.
    pub steered: Steered,
}

/// How a torque is divided among joints.
#[derive(Clone, Debug, PartialEq)]
pub struct TorqueAllocation {
    /// The inverse of the steering matrix.
    pub inverse: AllocationInverse,
    /// Weight of the rates of gimbals.
    pub gimbal_weight: f64,
    /// Weight of the accelerations of wheels; zero where they are to keep their rates.
    pub wheel_weight: f64,
    /// How fast the weight of wheels falls with the measure of singularity: `wheel_weight exp(-mu measure)`.
    pub wheel_mu: f64,
    /// The momentum that makes lambda and the measure dimensionless, N m s; none for the largest column of gimbals, without
    /// these of wheels, of the steering matrix at the first sample.
    pub reference: Option<f64>,
    /// Motion that gives no torque.
    pub null_motion: NullMotion,
}

/// Motion of joints that gives no torque, towards preferred angles of gimbals and out of speeds of wheels.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct NullMotion {
    /// Of the commanded gimbals in their order, rad; empty where none is preferred.
    pub preferred_angles: Vec<f64>,
    /// Rate towards these per distance, 1/s.
    pub angle_gain: f64,
    /// Speeds that wheels leave, lower and upper end of each band, rad/s: of both directions of turning.
    pub keep_out: Vec<[f64; 2]>,
    /// Acceleration out of a band per distance to its end, 1/s.
    pub keep_out_gain: f64,
}

/// The inverse of the steering matrix.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum AllocationInverse {
    /// Weighted pseudo-inverse.
    Exact,
    /// Of wheels: the least largest acceleration.
    LeastLargest,
    /// Singularity-robust: lambda and mu.
    SingularityRobust([f64; 2]),
    /// Generalised: lambda and mu, amplitude and frequency (rad/s) of the dither.
    Generalised([f64; 2], [f64; 2]),
}

/// How torques of motors are computed from commands.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ServoSettings {
    /// Feedback of the rate of gimbals, 1/s.
    pub gain: f64,
    /// How often torques are computed from the commands that act, Hz; none where it is once, at the sample.
    pub rate: Option<f64>,
}

/// What is commanded of a joint of a kind; none where it cannot be.
pub(crate) fn steered(info: &JointInfo) -> Option<Steered> {
    let body = body_key(info);
    match body.as_str() {
        _ if !info.driven => None,
        "gimbal" | "outer_gimbal" | "inner_gimbal" => Some(Steered::Rate),
        "wheel" => Some(Steered::Acceleration),
        _ => None,
    }
}

impl Scenario {
    /// Inertia of the whole spacecraft about its centre of mass, joints at their initial coordinates, B axes, kg m²; zero
    /// where the solver rejects it.
    pub(crate) fn inertia_at_start(&self) -> Matrix3<f64> {
        let craft = self.spacecraft().ok();
        let properties = craft.and_then(|craft| MassProperties::from_spacecraft(self, &craft).ok());
        properties.map_or_else(Matrix3::zeros, |of| of.inertia_c())
    }

    /// The controller that commands a joint.
    pub(crate) fn controller_of(&self, joint: usize) -> Option<&SampledController> {
        self.controllers.iter().find(|of| of.joints.iter().any(|own| own.joint == joint))
    }

    /// The same without its controllers: their joints have no torque.
    #[cfg(feature = "tool")]
    pub(crate) fn without_controllers(&self) -> Self {
        let mut open = self.clone();
        open.controllers.clear();
        open.changes.retain(|change| change.action != Action::Release);
        open
    }

    pub(super) fn check_controllers(&self) -> Vec<ScenarioError> {
        let mut errors = Vec::new();
        let mut commanded: Vec<(usize, &str)> = Vec::new();
        for (index, of) in self.controllers.iter().enumerate() {
            let name = &of.name;
            let earlier = self.controllers.iter().take(index).any(|other| other.name == *name);
            let known = earlier || self.points.iter().any(|point| point.name == *name);
            let remedy = "choose another `name`";
            errors.extend(self.point_name_error(("controller", name), known, remedy));
            let mut add = |key: &str, message: String| {
                errors.push(range(&format!("controller.{name}.{key}"), message));
            };
            for (key, message) in of.faults(self.settings.duration) {
                add(key, message);
            }
            if let Err(error) = of.law.built(|| self.inertia_at_start()) {
                add("law", error.to_string());
            }
            if let Err(error) = of.reference.built() {
                add("reference", error.to_string());
            }
            for joint in &of.joints {
                if let Some(message) = self.commanded_fault(joint) {
                    add("devices", message);
                }
                let other = commanded.iter().find(|(known, _)| *known == joint.joint);
                if let Some((_, other)) = other {
                    add("devices", format!("`{other}` commands them, too; keep them in one"));
                    break;
                }
            }
            commanded.extend(of.joints.iter().map(|own| (own.joint, name.as_str())));
        }
        for change in self.changes.iter().filter(|change| change.action == Action::Release) {
            if self.controller_of(change.joint).is_none() {
                let joint = self.joints().nth(change.joint);
                let joint = joint.map_or_else(String::new, |(_, device, info)| {
                    format!("{device}.{}", joint_key(info))
                });
                let message = format!(
                    "no controller commands `{joint}`, which `controlled` at {} s gives back to one",
                    Plain(change.time)
                );
                errors.push(range("at", message));
            }
        }
        errors
    }

    /// Why a joint cannot be commanded.
    fn commanded_fault(&self, of: &CommandedJoint) -> Option<String> {
        let joints: Vec<_> = self.joints().collect();
        let Some((member, device, info)) = joints.get(of.joint) else {
            return Some(format!("joint {} of {}", of.joint, joints.len()));
        };
        let all = members(&self.devices);
        let on_hub = self.devices.0.len();
        let body = body_key(info);
        if *member >= on_hub || !matches!(all.get(*member), Some(Member::Device { .. })) {
            return Some(format!(
                "`{device}` does not stand on the hub by itself; command devices on the hub"
            ));
        }
        if steered(info) != Some(of.steered) {
            return Some(format!("`{device}.{body}` is no gimbal or wheel with a motor"));
        }
        match self.drives.get(of.joint) {
            Some(Drive::Torque { profile, .. }) if profile.is_zero() => None,
            Some(Drive::Torque { .. }) => Some(format!(
                "`{device}.{body}` has a torque of its own; remove it, or command other devices"
            )),
            _ => Some(format!(
                "`{device}.{body}` is locked or has a prescribed motion; a commanded joint has neither"
            )),
        }
    }
}

impl SampledController {
    /// Keys with what is wrong with their values.
    fn faults(&self, duration: f64) -> Vec<(&'static str, String)> {
        let mut faults = Vec::new();
        let positive = |value: f64| value > 0.0 && value.is_finite();
        let not_negative = |value: f64| value >= 0.0 && value.is_finite();
        if !positive(self.rate) || self.rate > SAMPLES_MAX / duration {
            let [rate, most] = [self.rate, SAMPLES_MAX / duration].map(Plain);
            faults.push(("rate", format!("{rate} Hz is not above 0 Hz and at most {most} Hz")));
        }
        if !(0.0..=duration).contains(&self.offset) {
            let [offset, duration] = [self.offset, duration].map(Plain);
            faults.push(("offset", format!("{offset} s is outside the run, 0 s to {duration} s")));
        }
        let longest = DELAY_MAX / self.rate;
        if !(not_negative(self.delay) && self.delay <= longest) {
            let [delay, longest] = [self.delay, longest].map(Plain);
            let message = format!("{delay} s is outside 0 s to {longest} s, {DELAY_MAX} samples");
            faults.push(("delay", message));
        }
        let count = self.joints.len();
        if count == 0 {
            faults.push(("devices", "it commands no gimbal and no wheel with a motor".to_owned()));
        } else if count > COMMANDED_MAX {
            let message = format!("it commands {count} joints; at most {COMMANDED_MAX}");
            faults.push(("devices", message));
        }
        if let ControlLaw::Program { command, time_limit, .. } = &self.law {
            if command.iter().all(String::is_empty) {
                faults.push(("law.command", "it names no program".to_owned()));
            }
            if !positive(*time_limit) {
                let limit = Plain(*time_limit);
                faults.push(("law.time_limit", format!("{limit} s is not above 0 s")));
            }
        }
        for (key, element) in self.law.beside_the_diagonal() {
            let message = format!(
                "{} is beside the diagonal; a scenario has one gain for each axis, others are those of a controller of your own",
                Plain(element)
            );
            faults.push((key, message));
        }
        if faults.is_empty() {
            faults.extend(self.sensor_faults());
        }
        faults.extend(self.allocation.faults(&self.joints));
        if !not_negative(self.servo.gain) {
            let gain = Plain(self.servo.gain);
            faults.push(("servo.gain", format!("{gain} 1/s; it is not negative")));
        }
        if let Some(rate) = self.servo.rate
            && !(rate >= self.rate && rate <= SAMPLES_MAX / duration)
        {
            let [rate, own, most] = [rate, self.rate, SAMPLES_MAX / duration].map(Plain);
            let message =
                format!("{rate} Hz is outside {own} Hz, the rate of samples, to {most} Hz");
            faults.push(("servo.rate", message));
        }
        faults
    }
}

impl TorqueAllocation {
    fn faults(&self, joints: &[CommandedJoint]) -> Vec<(&'static str, String)> {
        let mut faults = Vec::new();
        let gimbals = joints.iter().any(|of| of.steered == Steered::Rate);
        if gimbals && self.inverse == AllocationInverse::LeastLargest {
            let message =
                "the least largest command is of wheels by themselves; take another inverse";
            faults.push(("allocation.inverse", message.to_owned()));
        }
        let mut not_negative = |key: &'static str, value: f64, unit: &str| {
            if !(value >= 0.0 && value.is_finite()) {
                faults.push((key, format!("{}{unit}; it is not negative", Plain(value))));
            }
        };
        not_negative("allocation.gimbal_weight", self.gimbal_weight, "");
        not_negative("allocation.wheel_weight", self.wheel_weight, "");
        not_negative("allocation.wheel_mu", self.wheel_mu, "");
        match self.inverse {
            AllocationInverse::Exact | AllocationInverse::LeastLargest => {}
            AllocationInverse::SingularityRobust([lambda, mu]) => {
                not_negative("allocation.lambda", lambda, "");
                not_negative("allocation.mu", mu, "");
            }
            AllocationInverse::Generalised([lambda, mu], [amplitude, frequency]) => {
                not_negative("allocation.lambda", lambda, "");
                not_negative("allocation.mu", mu, "");
                not_negative("allocation.dither_frequency", frequency, " rad/s");
                if !(0.0..0.5).contains(&amplitude) {
                    let message = format!("{} is not from 0 to below 0.5", Plain(amplitude));
                    faults.push(("allocation.dither_amplitude", message));
                }
            }
        }
        self.null_motion.add_faults(joints, &mut faults);
        if let Some(reference) = self.reference
            && !(reference > 0.0 && reference.is_finite())
        {
            let message = format!("{} N m s; it is above zero", Plain(reference));
            faults.push(("allocation.reference_momentum", message));
        }
        faults
    }
}

impl NullMotion {
    fn add_faults(&self, joints: &[CommandedJoint], faults: &mut Vec<(&'static str, String)>) {
        let gimbals = joints.iter().filter(|of| of.steered == Steered::Rate).count();
        let angles = self.preferred_angles.len();
        if angles > 0 && angles != gimbals {
            let message = format!("{angles} angles for {gimbals} gimbals; give one for each");
            faults.push(("allocation.preferred_angles", message));
        }
        for (key, gain) in [
            ("allocation.angle_gain", self.angle_gain),
            ("allocation.keep_out_gain", self.keep_out_gain),
        ] {
            if !(gain >= 0.0 && gain.is_finite()) {
                faults.push((key, format!("{} 1/s; it is not negative", Plain(gain))));
            }
        }
        for [from, to] in &self.keep_out {
            if !(*from >= 0.0 && to > from && to.is_finite()) {
                let [from, to] = [*from, *to].map(Plain);
                let message = format!(
                    "{from} rad/s to {to} rad/s is no band; its upper end is above its lower one, which is not negative"
                );
                faults.push(("allocation.keep_out", message));
            }
        }
    }
}
