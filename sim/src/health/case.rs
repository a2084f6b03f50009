//! [`HealthCase`]: a spacecraft, a loop, a fault and its size, by a name; and when and where a seed puts it.

use precess_control::Noise;

use super::fault::{Fault, Size};

/// Which spacecraft.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Spacecraft {
    /// Four reaction wheels.
    Bus,
    /// Four DGVSCMGs.
    Pyramid,
}

/// What commands the motors.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Loop {
    /// A torque on the spacecraft by the time, which motors are to exert; no attitude.
    Open,
    /// Attitude control by gyro, star tracker and estimator, along a scan.
    Closed,
}

/// A case; without a fault it is the nominal one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HealthCase {
    /// Which spacecraft.
    pub spacecraft: Spacecraft,
    /// What commands it.
    pub of: Loop,
    /// The fault.
    pub fault: Option<(Fault, Size)>,
}

/// Lengths of every case, s.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Timing {
    /// Of a block.
    pub block: f64,
    /// In which the reference is taken.
    pub learn: f64,
    /// After which a fault may begin, in the next block.
    pub healthy: f64,
    /// Of a record.
    pub duration: f64,
}

impl Default for Timing {
    fn default() -> Self {
        Self { block: 2.0, learn: 200.0, healthy: 230.0, duration: 300.0 }
    }
}

/// What is true of a case.
#[derive(Clone, Debug, PartialEq)]
pub struct TrueChange {
    /// The name of the case.
    pub case: String,
    /// The device or the axis; empty of the nominal case.
    pub place: String,
    /// What has changed, as the watch calls it; empty of the nominal case.
    pub quantity: String,
    /// When, s; the end of the record of the nominal case.
    pub onset: f64,
    /// By how much, SI units; NaN of a bearing's stiffness, whose size the watch does not say, and of the nominal case.
    pub change: f64,
}

impl Spacecraft {
    pub(super) fn name(self) -> &'static str {
        match self {
            Self::Bus => "bus",
            Self::Pyramid => "pyramid",
        }
    }

    /// The prefix of its devices, one to four.
    pub(super) fn device(self, number: usize) -> String {
        match self {
            Self::Bus => format!("rw{number}"),
            Self::Pyramid => format!("cmg{number}"),
        }
    }
}

impl Loop {
    fn name(self) -> &'static str {
        match self {
            Self::Open => "open",
            Self::Closed => "closed",
        }
    }
}

impl HealthCase {
    /// All of them: of each spacecraft and loop the nominal one, and eight faults of three sizes.
    #[must_use]
    pub fn all() -> Vec<Self> {
        let mut all = Vec::new();
        for spacecraft in [Spacecraft::Bus, Spacecraft::Pyramid] {
            for of in [Loop::Open, Loop::Closed] {
                all.push(Self { spacecraft, of, fault: None });
                for fault in Fault::all(spacecraft) {
                    all.extend(Size::ALL.map(|size| Self {
                        spacecraft,
                        of,
                        fault: Some((fault, size)),
                    }));
                }
            }
        }
        all
    }

    /// Its name: `bus-open-drag-medium`.
    #[must_use]
    pub fn name(&self) -> String {
        let (spacecraft, of) = (self.spacecraft.name(), self.of.name());
        match self.fault {
            None => format!("{spacecraft}-{of}-nominal"),
            Some((fault, size)) => format!("{spacecraft}-{of}-{}-{}", fault.name(), size.name()),
        }
    }

    /// Numbers of a case from zero to one: when a fault begins in its block, and where.
    pub(super) fn drawn(self, seed: u32) -> [f64; 2] {
        // Pairs of normal numbers by Box and Muller: the squared radius is exponential, and the angle uniform.
        let [a, b, c, d, ..] = Noise::new(u64::from(seed), &format!("{}.fault", self.name())).at(0);
        [[a, b], [c, d]].map(|[x, y]| 1.0 - libm::exp(-0.5 * (x * x + y * y)))
    }

    /// When the fault begins, s: at a sample of the controllers.
    pub(super) fn onset(self, seed: u32, timing: &Timing) -> f64 {
        let [when, _] = self.drawn(seed);
        match self.fault {
            None => timing.duration,
            Some(_) => timing.healthy + (100.0 * when * timing.block).floor() / 100.0,
        }
    }

    /// The number of the device, one to four, that it is in.
    pub(super) fn number(self, seed: u32) -> usize {
        let [_, place] = self.drawn(seed);
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "below four")]
        let index = (4.0 * place).floor() as usize;
        index.min(3) + 1
    }
}
