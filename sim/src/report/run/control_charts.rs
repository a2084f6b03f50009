//! Charts of controllers: error and rate error, reference, torque, commands of joints, measure of singularity.

use super::chart::Part;
use super::grouping::{AXES, ChartColumn, Joints, capitalised, hyphenated, plain};
use crate::record::Column;
use crate::record::columns::ControlQuantity;
use crate::report::unit::{self, Family};

/// The rank of these charts among all, after those of sources.
const RANK: usize = 19;
/// Charts of a controller, those of its joints after them.
const CHARTS: usize = 100;

/// The chart of a column of a controller.
pub(super) fn chart(
    controller: usize,
    quantity: ControlQuantity,
    column: &Column,
    (joints, bodies): (&Joints<'_>, &[&str]),
) -> Option<ChartColumn> {
    let (order, what, axis, family, label): (_, &str, _, &'static Family, _) = match quantity {
        ControlQuantity::ErrorAngle => {
            (0, "pointing error", "Angle", unit::SMALL_ANGLE, "angle".to_owned())
        }
        ControlQuantity::Error(k) => {
            (0, "pointing error", "Angle", unit::SMALL_ANGLE, of_axis("θ", k))
        }
        ControlQuantity::RateError(k) => {
            let what = "angular velocity relative to the reference";
            (1, what, "Angular velocity", unit::ANGULAR_RATE, of_axis("ω", k))
        }
        ControlQuantity::ReferenceQuaternion(k) => {
            let label = format!("q_{k}");
            (2, "reference, Euler parameters", "Attitude q", unit::NUMBER, label)
        }
        ControlQuantity::ReferenceOmega(k) => {
            let what = "angular velocity of the reference";
            (3, what, "Angular velocity", unit::ANGULAR_RATE, of_axis("ω", k))
        }
        ControlQuantity::Torque(k) => {
            (4, "commanded torque", "Torque", unit::MOMENT, of_axis("u", k))
        }
        ControlQuantity::TorqueError(k) => {
            let what = "what the commands lack of the torque";
            (5, what, "Torque", unit::MOMENT, of_axis("u", k))
        }
        ControlQuantity::Measure => {
            (6, "measure of singularity", "Measure", unit::NUMBER, "measure".to_owned())
        }
        ControlQuantity::Limited => {
            (7, "commands at a limit", "Count", unit::NUMBER, "limited".to_owned())
        }
        ControlQuantity::Command(_) => return command(controller, column, (joints, bodies)),
        ControlQuantity::Gyro(k) => {
            (30, "reading of the gyro", "Angular velocity", unit::ANGULAR_RATE, of_axis("ω", k))
        }
        ControlQuantity::Accelerometer(k) => {
            let what = "reading of the accelerometer";
            (37, what, "Acceleration", unit::ACCELERATION, of_axis("a", k))
        }
        ControlQuantity::MeasuredOmega(k) => {
            let what = "angular velocity that the law reads";
            (31, what, "Angular velocity", unit::ANGULAR_RATE, of_axis("ω", k))
        }
        ControlQuantity::MeasuredQuaternion(k) => {
            let what = "attitude that the law reads, Euler parameters";
            (32, what, "Attitude q", unit::NUMBER, format!("q_{k}"))
        }
        ControlQuantity::MeasurementError(k) => {
            let what = "error of the attitude that the law reads";
            (33, what, "Angle", unit::SMALL_ANGLE, of_axis("θ", k))
        }
        ControlQuantity::AttitudeDeviation(k) => {
            let what = "standard deviation of the estimated attitude";
            (34, what, "Angle", unit::SMALL_ANGLE, of_axis("σ", k))
        }
        ControlQuantity::GyroBias(k) => {
            (35, "bias of the gyro", "Angular velocity", unit::ANGULAR_RATE, of_axis("b", k))
        }
        ControlQuantity::EstimatedBias(k) => {
            let label = format!("{}, estimated", of_axis("b", k));
            (35, "bias of the gyro", "Angular velocity", unit::ANGULAR_RATE, label)
        }
        ControlQuantity::External(k) => {
            (36, "external torque", "Torque", unit::MOMENT, of_axis("L", k))
        }
    };
    let name = &column.group;
    Some(ChartColumn {
        key: (RANK, CHARTS * controller + order),
        part: Part::Histories,
        slug: hyphenated(&format!("{name} {}", what.replace(',', ""))),
        title: capitalised(&format!("{}: {what}", plain(name))),
        axis,
        family,
        label,
        departure: false,
    })
}

/// One chart for the joints of bodies of one name.
fn command(
    controller: usize,
    column: &Column,
    (joints, bodies): (&Joints<'_>, &[&str]),
) -> Option<ChartColumn> {
    let (device, what) = column.name.split_once(".commanded_")?;
    let (.., info) = joints.iter().find(|(_, name, info)| {
        *name == device && (info.rate == what || info.acceleration == what)
    })?;
    let body = bodies.iter().position(|body| *body == info.body).unwrap_or_default();
    let is_rate = info.rate == what;
    let (axis, family) = match (is_rate, info.body) {
        (true, _) => ("Rate", unit::ANGULAR_RATE),
        (false, "wheel") => ("Acceleration", unit::WHEEL_ACCELERATION),
        (false, _) => ("Acceleration", unit::ANGULAR_ACCELERATION),
    };
    let text = format!("{}: commanded {} of the {}", column.group, axis.to_lowercase(), info.body);
    Some(ChartColumn {
        key: (RANK, CHARTS * controller + 10 + body),
        part: Part::Histories,
        slug: hyphenated(&text.replace(':', "")),
        title: capitalised(&plain(&text)),
        axis,
        family,
        label: plain(device),
        departure: false,
    })
}

fn of_axis(symbol: &str, axis: usize) -> String {
    format!("{symbol}_{}", AXES.get(axis).copied().unwrap_or_default())
}
