//! What charts of joints, loads and work say: titles, axes, units, symbols.

use crate::report::unit::{self, Family};

/// Slug, title and axis of the chart that begins with the energy.
pub(super) const ENERGY: [&str; 3] = ["energy", "Energy and work since the start", "Energy"];
/// Of the one that begins with the work.
pub(super) const WORK: [&str; 3] = ["energy", "Work and losses since the start", "Energy"];

/// Axis, unit and symbol of forces and of moments.
pub(super) type LoadTexts = (&'static str, &'static Family, &'static str);
pub(super) const FORCE: LoadTexts = ("Force", unit::FORCE, "F");
pub(super) const MOMENT: LoadTexts = ("Moment", unit::MOMENT, "M");

/// What is shown of a joint, the axis and the unit: of a wheel, of a sliding joint, of any other.
pub(super) type JointTexts = [(&'static str, &'static str, &'static Family); 3];
pub(super) const RATE: JointTexts = [
    ("rates", "Rate", unit::WHEEL_RATE),
    ("speeds", "Speed", unit::VELOCITY),
    ("rates", "Rate", unit::ANGULAR_RATE),
];
pub(super) const COORDINATE: JointTexts = [
    ("angles", "Angle", unit::REVOLUTIONS),
    ("displacements", "Displacement", unit::LENGTH),
    ("angles", "Angle", unit::ANGLE),
];
pub(super) const MOTOR: JointTexts = [
    ("motor torques", "Torque", unit::MOTOR_TORQUE),
    ("motor forces", "Force", unit::FORCE),
    ("motor torques", "Torque", unit::MOTOR_TORQUE),
];
pub(super) const FRICTION: JointTexts = [
    ("friction torques", "Torque", unit::MOTOR_TORQUE),
    ("friction forces", "Force", unit::FORCE),
    ("friction torques", "Torque", unit::MOTOR_TORQUE),
];
pub(super) const ACCELERATION: JointTexts = [
    ("accelerations", "Acceleration", unit::WHEEL_ACCELERATION),
    ("accelerations", "Acceleration", unit::ACCELERATION),
    ("accelerations", "Acceleration", unit::ANGULAR_ACCELERATION),
];

/// Order, slug, title, symbol and unit of a momentum.
pub(super) type MomentumTexts =
    ((usize, usize), &'static str, &'static str, &'static str, &'static Family);
pub(super) const LINEAR: MomentumTexts =
    ((22, 0), "linear-momentum", "Linear momentum", "Δp", unit::LINEAR_MOMENTUM);
pub(super) const ANGULAR: MomentumTexts = (
    (23, 0),
    "angular-momentum",
    "Angular momentum about the inertial origin",
    "ΔH",
    unit::ANGULAR_MOMENTUM,
);
pub(super) const ABOUT_CENTRE: MomentumTexts = (
    (23, 1),
    "momentum-about-centre",
    "Angular momentum about the centre of mass",
    "ΔH",
    unit::ANGULAR_MOMENTUM,
);
