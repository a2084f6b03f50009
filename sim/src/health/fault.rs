//! [`Fault`]: what changes in the hardware, and by how much.

use super::case::{HealthCase, Spacecraft, Timing, TrueChange};

/// What changes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Fault {
    /// Static imbalance of a wheel grows.
    StaticImbalance,
    /// Dynamic imbalance of a wheel grows.
    DynamicImbalance,
    /// The static imbalance of a wheel turns about its axis: a part has come loose.
    ImbalancePhase,
    /// Dry friction of a wheel's bearing grows.
    Drag,
    /// Bearings of a wheel become softer: their whirl frequencies fall. Of the bus.
    Bearing,
    /// Dry friction of an outer gimbal grows. Of the pyramid.
    GimbalDrag,
    /// A motor exerts less than what it is commanded to: that of a wheel of the bus, of an outer gimbal of the pyramid.
    TorqueConstant,
    /// The bias of the gyro jumps about its y axis.
    GyroBias,
    /// The scale of a wheel's tachometer in the telemetry.
    Tachometer,
}

/// How much.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Size {
    /// At the edge of what is found.
    Small,
    /// Three times that, or so.
    Medium,
    /// Ten times that, or so.
    Large,
}

impl Size {
    /// All.
    pub const ALL: [Self; 3] = [Self::Small, Self::Medium, Self::Large];

    pub(super) fn name(self) -> &'static str {
        match self {
            Self::Small => "small",
            Self::Medium => "medium",
            Self::Large => "large",
        }
    }
}

impl Fault {
    /// The eight of a spacecraft.
    #[must_use]
    pub fn all(of: Spacecraft) -> [Self; 8] {
        let fifth = match of {
            Spacecraft::Bus => Self::Bearing,
            Spacecraft::Pyramid => Self::GimbalDrag,
        };
        [
            Self::StaticImbalance,
            Self::DynamicImbalance,
            Self::ImbalancePhase,
            Self::Drag,
            fifth,
            Self::TorqueConstant,
            Self::GyroBias,
            Self::Tachometer,
        ]
    }

    pub(super) fn name(self) -> &'static str {
        match self {
            Self::StaticImbalance => "static",
            Self::DynamicImbalance => "dynamic",
            Self::ImbalancePhase => "phase",
            Self::Drag => "drag",
            Self::Bearing => "bearing",
            Self::GimbalDrag => "gimbal",
            Self::TorqueConstant => "torque",
            Self::GyroBias => "gyro",
            Self::Tachometer => "tachometer",
        }
    }

    /// Change of this size, SI units: kg m, kg m², rad, N m, share of the stiffness, N m, share of the torque constant, rad/s,
    /// share of the rate.
    #[must_use]
    pub fn change(self, of: Spacecraft, size: Size) -> f64 {
        let bus = of == Spacecraft::Bus;
        let of = match self {
            Self::StaticImbalance if bus => [5e-7, 1.5e-6, 5e-6],
            Self::DynamicImbalance if bus => [1.5e-7, 5e-7, 1.5e-6],
            Self::StaticImbalance | Self::DynamicImbalance => [3e-6, 1e-5, 3e-5],
            Self::ImbalancePhase => [0.3, 0.9, 2.4],
            Self::Drag if bus => [3e-5, 1e-4, 3e-4],
            Self::Drag => [6e-4, 2e-3, 6e-3],
            Self::Bearing => [-0.25, -0.5, -0.7],
            Self::GimbalDrag => [5e-3, 15e-3, 50e-3],
            Self::TorqueConstant => [-0.02, -0.06, -0.2],
            Self::GyroBias => [1.5e-5, 5e-5, 1.5e-4],
            Self::Tachometer => [3e-4, 1e-3, 3e-3],
        };
        let [small, medium, large] = of;
        match size {
            Size::Small => small,
            Size::Medium => medium,
            Size::Large => large,
        }
    }
}

impl HealthCase {
    /// What is true of it.
    #[must_use]
    pub fn truth(&self, seed: u32, timing: &Timing) -> TrueChange {
        let onset = self.onset(seed, timing);
        let case = self.name();
        let Some((fault, size)) = self.fault else {
            let (place, quantity) = (String::new(), String::new());
            return TrueChange { case, place, quantity, onset, change: f64::NAN };
        };
        let device = self.spacecraft.device(self.number(seed));
        let bus = self.spacecraft == Spacecraft::Bus;
        let change = fault.change(self.spacecraft, size);
        let (quantity, place, change) = match fault {
            Fault::StaticImbalance => (format!("static imbalance of {device}"), device, change),
            Fault::DynamicImbalance => (format!("dynamic imbalance of {device}"), device, change),
            Fault::ImbalancePhase => {
                (format!("phase step of the static imbalance of {device}"), device, change)
            }
            Fault::Drag if bus => (format!("drag torque of {device}"), device, change),
            Fault::Drag => (format!("drag torque of {device}.wheel"), device, change),
            Fault::GimbalDrag => (format!("drag torque of {device}.outer_gimbal"), device, change),
            Fault::TorqueConstant if bus => {
                (format!("torque constant of {device}"), device, change)
            }
            Fault::TorqueConstant => {
                (format!("torque constant of {device}.outer_gimbal"), device, change)
            }
            Fault::GyroBias => ("gyro bias about y".to_owned(), "y".to_owned(), change),
            Fault::Tachometer if bus => (format!("tachometer scale of {device}"), device, change),
            Fault::Tachometer => (format!("tachometer scale of {device}.wheel"), device, change),
            // The watch has the growth of a line, no stiffness.
            Fault::Bearing => (format!("bearing stiffness of {device}"), device, f64::NAN),
        };
        TrueChange { case, place, quantity, onset, change }
    }
}
