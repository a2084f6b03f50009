//! `[[controller]]` as text, in SI units and with every default written out, but for the inertia of a law that states none.

use std::fmt::Write as _;

use nalgebra::Matrix3;
use precess_control::{AttitudeRow, Gyroscopic, MrpGains};
use precess_dynamics::Quaternion;

use super::{Written, controller_sensors, inertia, quoted, vector};
use crate::scenario::{
    AllocationInverse, AttitudeReference, ControlLaw, NullMotion, SampledController, Scenario,
    TorqueAllocation,
};

/// The table of a controller.
pub(super) fn write(out: &mut String, s: &Scenario, of: &SampledController) -> Written {
    writeln!(out, "\n[[controller]]\nname = {}", quoted(&of.name))?;
    writeln!(out, "rate = \"{:?} Hz\"\noffset = \"{:?} s\"", of.rate, of.offset)?;
    writeln!(out, "delay = \"{:?} s\"", of.delay)?;
    let joints: Vec<_> = s.joints().collect();
    let mut devices: Vec<String> = of
        .joints
        .iter()
        .filter_map(|own| joints.get(own.joint))
        .map(|(_, device, _)| quoted(device))
        .collect();
    devices.dedup();
    writeln!(out, "devices = [{}]", devices.join(", "))?;
    law(out, &of.law)?;
    reference(out, &of.reference)?;
    allocation(out, &of.allocation)?;
    writeln!(out, "\n[controller.servo]\ngain = \"{:?} 1/s\"", of.servo.gain)?;
    if let Some(rate) = of.servo.rate {
        writeln!(out, "rate = \"{rate:?} Hz\"")?;
    }
    controller_sensors::write(out, s, of)
}

fn law(out: &mut String, law: &ControlLaw) -> Written {
    writeln!(out, "\n[controller.law]")?;
    let (own, gyroscopic) = match law {
        ControlLaw::MrpFeedback { gains, inertia, gyroscopic } => {
            let MrpGains { attitude, rate, integral, integral_limit } = gains;
            writeln!(out, "kind = \"mrp_feedback\"\nattitude_gain = \"{attitude:?} N m\"")?;
            writeln!(out, "rate_gain = {}", diagonal(rate, "N m s"))?;
            writeln!(out, "integral_gain = {}", diagonal(integral, "1/(kg m^2)"))?;
            writeln!(out, "integral_limit = \"{integral_limit:?} N m s\"")?;
            (inertia, Some(gyroscopic))
        }
        ControlLaw::QuaternionFeedback { attitude, rate, inertia, gyroscopic } => {
            writeln!(out, "kind = \"quaternion_feedback\"")?;
            writeln!(out, "attitude_gain = {}", diagonal(attitude, "N m"))?;
            writeln!(out, "rate_gain = {}", diagonal(rate, "N m s"))?;
            (inertia, Some(gyroscopic))
        }
        ControlLaw::EigenAxis { frequency, damping_ratio, inertia } => {
            writeln!(out, "kind = \"eigen_axis\"\nfrequency = \"{frequency:?} Hz\"")?;
            writeln!(out, "damping_ratio = {damping_ratio:?}")?;
            (inertia, None)
        }
        ControlLaw::RateDamping { rate } => {
            writeln!(out, "kind = \"rate_damping\"")?;
            return writeln!(out, "rate_gain = {}", diagonal(rate, "N m s"));
        }
        ControlLaw::Program { command, time_limit, .. } => {
            let words: Vec<_> = command.iter().map(|word| quoted(word)).collect();
            writeln!(out, "kind = \"program\"\ncommand = [{}]", words.join(", "))?;
            return writeln!(out, "time_limit = \"{time_limit:?} s\"");
        }
    };
    if let Some(tensor) = own {
        inertia(out, tensor)?;
    }
    let word = match gyroscopic {
        None => return Ok(()),
        Some(Gyroscopic::Whole) => "whole",
        Some(Gyroscopic::Reference) => "reference",
        Some(Gyroscopic::Nothing) => "nothing",
    };
    writeln!(out, "gyroscopic = \"{word}\"")
}

fn diagonal(m: &Matrix3<f64>, unit: &str) -> String {
    format!("\"{:?}, {:?}, {:?} {unit}\"", m.m11, m.m22, m.m33)
}

fn reference(out: &mut String, reference: &AttitudeReference) -> Written {
    writeln!(out, "\n[controller.reference]")?;
    match reference {
        AttitudeReference::Hold(attitude) => {
            writeln!(out, "kind = \"hold\"\nattitude = {}", quaternion(attitude))
        }
        AttitudeReference::Slew { start, from, to, limits } => {
            writeln!(out, "kind = \"slew\"\nstart = \"{start:?} s\"")?;
            writeln!(out, "from = {}\nattitude = {}", quaternion(from), quaternion(to))?;
            for (key, limit, unit) in [
                ("rate", limits.rate, "rad/s"),
                ("acceleration", limits.acceleration, "rad/s^2"),
                ("jerk", limits.jerk, "rad/s^3"),
            ] {
                if limit.is_finite() {
                    writeln!(out, "{key}_limit = \"{limit:?} {unit}\"")?;
                }
            }
            Ok(())
        }
        AttitudeReference::Turning { attitude, omega } => {
            writeln!(out, "kind = \"turning\"\nattitude = {}", quaternion(attitude))?;
            writeln!(out, "angular_velocity = {}", vector(omega, "rad/s"))
        }
        AttitudeReference::Table(rows) => {
            let each = |of: &dyn Fn(&AttitudeRow) -> String| {
                rows.iter().map(of).collect::<Vec<_>>().join(", ")
            };
            let times = each(&|row| format!("{:?}", row.time));
            writeln!(out, "kind = \"table\"\ntimes = \"{times} s\"\nscalar = \"first\"")?;
            let attitudes =
                each(&|AttitudeRow { attitude: q, .. }| format!("{:?}", [q.q0, q.q1, q.q2, q.q3]));
            writeln!(out, "quaternions = [{attitudes}]")?;
            let rates = each(&|row| vector(&row.omega, "rad/s"));
            writeln!(out, "angular_velocities = [{rates}]")
        }
    }
}

fn quaternion(of: &Quaternion) -> String {
    let numbers = [of.q0, of.q1, of.q2, of.q3];
    format!("{{ quaternion = {numbers:?}, scalar = \"first\" }}")
}

fn allocation(out: &mut String, of: &TorqueAllocation) -> Written {
    writeln!(out, "\n[controller.allocation]")?;
    let word = match of.inverse {
        AllocationInverse::Exact => "exact",
        AllocationInverse::LeastLargest => "least_largest",
        AllocationInverse::SingularityRobust(_) => "singularity_robust",
        AllocationInverse::Generalised(..) => "generalised",
    };
    writeln!(out, "inverse = \"{word}\"\ngimbal_weight = {:?}", of.gimbal_weight)?;
    writeln!(out, "wheel_weight = {:?}\nwheel_mu = {:?}", of.wheel_weight, of.wheel_mu)?;
    if let AllocationInverse::SingularityRobust([lambda, mu])
    | AllocationInverse::Generalised([lambda, mu], _) = of.inverse
    {
        writeln!(out, "lambda = {lambda:?}\nmu = {mu:?}")?;
    }
    if let AllocationInverse::Generalised(_, [amplitude, frequency]) = of.inverse {
        writeln!(out, "dither_amplitude = {amplitude:?}")?;
        writeln!(out, "dither_frequency = \"{frequency:?} rad/s\"")?;
    }
    if let Some(reference) = of.reference {
        writeln!(out, "reference_momentum = \"{reference:?} N m s\"")?;
    }
    let NullMotion { preferred_angles, angle_gain, keep_out, keep_out_gain } = &of.null_motion;
    if !preferred_angles.is_empty() {
        let angles: Vec<_> = preferred_angles.iter().map(|of| format!("\"{of:?} rad\"")).collect();
        writeln!(
            out,
            "preferred_angles = [{}]\nangle_gain = \"{angle_gain:?} 1/s\"",
            angles.join(", ")
        )?;
    }
    if !keep_out.is_empty() {
        let bands: Vec<_> =
            keep_out.iter().map(|[from, to]| format!("\"{from:?}, {to:?} rad/s\"")).collect();
        writeln!(
            out,
            "keep_out = [{}]\nkeep_out_gain = \"{keep_out_gain:?} 1/s\"",
            bands.join(", ")
        )?;
    }
    Ok(())
}
