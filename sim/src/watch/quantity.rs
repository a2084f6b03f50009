//! [`Quantity`]: what is watched: its name, unit and tests, and what else would look the same.

use super::block::Detail;
use super::detector::{Cause, Detector, Kind, Sample, Shift};
use super::drag::DragDetector;
use super::thresholds::Thresholds;

/// What a quantity is.
#[derive(Clone, Debug, PartialEq)]
pub enum Watched {
    /// Static imbalance of a rotor, kg m.
    StaticImbalance,
    /// Dynamic imbalance, kg m².
    DynamicImbalance,
    /// Phase of the line of static imbalance from block to block, rad.
    StaticPhase,
    /// Of dynamic imbalance, rad.
    DynamicPhase,
    /// Drag torque of a wheel or gimbal beyond that of the scenario, N m.
    Drag,
    /// Torque constant of the motor of a wheel or gimbal by that of the scenario, less one.
    TorqueConstant,
    /// Stiffness of the bearings of a rotor: growth of its static imbalance in the body rate that is as the square of its rate, kg m at the rate at
    /// first.
    BearingStiffness,
    /// Step of the scale of a wheel's tachometer, by the scale before.
    TachometerScale,
    /// Step of the gyro's reading about an axis, rad/s.
    GyroJump,
}

impl Watched {
    /// SI unit.
    #[must_use]
    pub fn unit(&self) -> &'static str {
        match self {
            Self::StaticImbalance | Self::BearingStiffness => "kg m",
            Self::DynamicImbalance => "kg m^2",
            Self::StaticPhase | Self::DynamicPhase => "rad",
            Self::Drag => "N m",
            Self::TorqueConstant | Self::TachometerScale => "1",
            Self::GyroJump => "rad/s",
        }
    }

    /// What else changes the same series of estimates, by a signature of its own.
    pub(crate) fn other_cause(&self) -> Option<Self> {
        match self {
            Self::StaticImbalance => Some(Self::BearingStiffness),
            Self::Drag => Some(Self::TorqueConstant),
            _ => None,
        }
    }

    /// How it is tested; a torque constant in the series of drag.
    pub(super) fn kind(&self) -> Kind {
        match self {
            Self::StaticImbalance | Self::DynamicImbalance | Self::BearingStiffness => {
                Kind::Amplitude
            }
            Self::StaticPhase | Self::DynamicPhase => Kind::Single,
            Self::Drag | Self::TorqueConstant => Kind::Level,
            Self::TachometerScale | Self::GyroJump => Kind::Centred,
        }
    }

    /// What it is, of a joint, rotor or axis.
    fn name(&self, of: &str) -> String {
        match self {
            Self::StaticImbalance => format!("static imbalance of {of}"),
            Self::DynamicImbalance => format!("dynamic imbalance of {of}"),
            Self::StaticPhase => format!("phase step of the static imbalance of {of}"),
            Self::DynamicPhase => format!("phase step of the dynamic imbalance of {of}"),
            Self::Drag => format!("drag torque of {of}"),
            Self::TorqueConstant => format!("torque constant of {of}"),
            Self::BearingStiffness => format!("bearing stiffness of {of}"),
            Self::TachometerScale => format!("tachometer scale of {of}"),
            Self::GyroJump => format!("gyro bias about {of}"),
        }
    }

    /// What would look the same in these sensors.
    fn alike(&self, of: &str) -> Vec<String> {
        let texts: &[&str] = match self {
            Self::StaticImbalance | Self::DynamicImbalance => &[
                "a disturbance from elsewhere at the rotation frequency of {}",
                "other stiffness of the bearings of {}, which amplifies the line",
                "of all rotors at once: another inertia of the hub, or another scale factor of the gyro",
            ],
            Self::StaticPhase | Self::DynamicPhase => &[
                "a jump of the angle of {}, which is the integral of its tachometer; from block to block another scale of that",
                "an imbalance that moves about the axis, such as a loose part",
            ],
            Self::Drag => &[
                "another torque constant of the motor of {}, where its torque does not change",
                "an offset of the telemetered torque",
                "a torque from outside about its axis on the hub, by the share of the rotor in the inertia",
            ],
            Self::TorqueConstant => &[
                "drag of {}, as long as its torque has not changed",
                "friction or a cable of {} that grows with the torque",
                "another scale of the telemetered torque",
            ],
            Self::BearingStiffness => &[
                "static imbalance of {}, as long as its rate has not changed",
                "a mode of the structure near its rotation frequency",
            ],
            Self::TachometerScale => &[
                "an impulse about the axis of {}, such as a touch, which does not turn phases from then on",
            ],
            Self::GyroJump => &[
                "an angular impulse from outside about {}",
                "a motor torque that the telemetry does not have",
            ],
        };
        texts.iter().map(|text| text.replace("{}", of)).collect()
    }
}

/// A quantity with its tests.
#[derive(Clone, Debug)]
pub(crate) struct Quantity {
    pub(super) watched: Watched,
    pub(super) name: String,
    /// Of which joint, rotor or axis.
    pub(super) of: String,
    pub(super) kind: Kind,
    tests: Tests,
}

/// The tests of a quantity.
#[derive(Clone, Debug)]
enum Tests {
    Series(Box<Detector>),
    Drag(Box<DragDetector>),
    /// Of a torque constant, which is found with drag.
    Other,
}

/// A change that a test has found.
#[derive(Clone, Debug, PartialEq)]
pub struct Alarm {
    /// What has changed.
    pub name: String,
    /// Which quantity that is.
    pub watched: Watched,
    /// Of which joint, rotor or axis.
    pub of: String,
    /// When it was raised, s.
    pub time: f64,
    /// From when on, and by how much.
    pub shift: Shift,
    /// What else would look the same.
    pub alike: Vec<String>,
}

impl Quantity {
    /// With so many blocks of reference and onsets that are tried.
    pub(super) fn new(
        (watched, of, kind): (Watched, String, Kind),
        thresholds: Thresholds,
        counts: [usize; 2],
    ) -> Self {
        let tests = match (&watched, kind) {
            (Watched::TorqueConstant, _) => Tests::Other,
            (_, Kind::Drag) => Tests::Drag(Box::new(DragDetector::new(thresholds.ratio, counts))),
            _ => Tests::Series(Box::new(Detector::new(kind, thresholds, counts))),
        };
        Self { name: watched.name(&of), of, watched, kind, tests }
    }

    /// The reference and the scatter about it by the stated variance; none while it is taken.
    pub(super) fn reference(&self) -> Option<[f64; 2]> {
        match &self.tests {
            Tests::Series(detector) => detector.reference(),
            Tests::Drag(detector) => detector.reference(),
            Tests::Other => None,
        }
    }

    /// Takes the estimate of a block, with its variance, and what else its tests need.
    pub(crate) fn take(
        &mut self,
        [start, end]: [f64; 2],
        [value, variance]: [f64; 2],
        detail: &Detail,
    ) -> Option<Alarm> {
        let (shift, cause) = match (&mut self.tests, detail) {
            (Tests::Series(detector), Detail::Signature(signature)) => {
                detector.take(Sample { time: start, value, variance, signature: *signature })?
            }
            (Tests::Drag(detector), Detail::Drag(sample)) => detector.take(sample.as_ref()?)?,
            _ => return None,
        };
        let other = self.watched.other_cause().filter(|_| cause == Cause::Other);
        let watched = other.unwrap_or_else(|| self.watched.clone());
        let name = watched.name(&self.of);
        let alike = watched.alike(&self.of);
        Some(Alarm { name, watched, of: self.of.clone(), time: end, shift, alike })
    }
}
