//! `sensors`, `filter`, `estimator` and `dumping` of a `[[controller]]` as text, in SI units.

use std::fmt::Write as _;

use precess_control::GyroOutput;

use super::{Written, mount, quoted, structure, vector};
use crate::scenario::{
    AccelerometerSettings, DumpingSettings, EstimatorSettings, FilterKind, FilterSettings,
    FilteredSignal, GyroSettings, SampledController, Scenario, StarTrackerSettings,
};

pub(super) fn write(out: &mut String, s: &Scenario, of: &SampledController) -> Written {
    let sensors = &of.sensors;
    if !sensors.is_empty() {
        writeln!(out, "\n[controller.sensors]\nseed = {}", sensors.seed)?;
        writeln!(out, "encoder_quantum = \"{:?} rad\"", sensors.encoder_quantum)?;
        writeln!(out, "tachometer_quantum = \"{:?} rad/s\"", sensors.tachometer_quantum)?;
    }
    if let Some(of) = &sensors.gyro {
        gyro(out, s, of)?;
    }
    if let Some(of) = &sensors.star_tracker {
        star_tracker(out, s, of)?;
    }
    if let Some(of) = &sensors.accelerometer {
        accelerometer(out, s, of)?;
    }
    of.filters.iter().try_for_each(|of| filter(out, of))?;
    if let Some(EstimatorSettings { attitude_deviation, bias_deviation }) = of.estimator {
        writeln!(out, "\n[controller.estimator]")?;
        writeln!(out, "attitude_deviation = \"{attitude_deviation:?} rad\"")?;
        writeln!(out, "bias_deviation = \"{bias_deviation:?} rad/s\"")?;
    }
    if let Some(DumpingSettings { gain, momentum, torque_limit }) = &of.dumping {
        writeln!(out, "\n[controller.dumping]\ngain = \"{gain:?} 1/s\"")?;
        writeln!(out, "momentum = {}", vector(momentum, "N m s"))?;
        if torque_limit.iter().all(|limit| limit.is_finite()) {
            writeln!(out, "torque_limit = {}", vector(torque_limit, "N m"))?;
        }
    }
    Ok(())
}

fn node(out: &mut String, s: &Scenario, of: Option<usize>) -> Written {
    match of {
        Some(node) => writeln!(out, "node = {}", quoted(structure::node_name(s, node))),
        None => Ok(()),
    }
}

fn gyro(out: &mut String, s: &Scenario, of: &GyroSettings) -> Written {
    let (word, unit) = match of.output {
        GyroOutput::Sampled => ("sampled", "rad/s"),
        GyroOutput::Integrating => ("integrating", "rad"),
    };
    writeln!(out, "\n[controller.sensors.gyro]\noutput = \"{word}\"")?;
    node(out, s, of.node)?;
    writeln!(out, "angle_random_walk = \"{:?} rad/sqrt(s)\"", of.angle_random_walk)?;
    writeln!(out, "rate_random_walk = \"{:?} rad/s/sqrt(s)\"", of.rate_random_walk)?;
    writeln!(out, "bias = {}", vector(&of.bias, "rad/s"))?;
    writeln!(out, "quantum = \"{:?} {unit}\"", of.quantum)
}

fn star_tracker(out: &mut String, s: &Scenario, of: &StarTrackerSettings) -> Written {
    writeln!(out, "\n[controller.sensors.star_tracker]")?;
    node(out, s, of.node)?;
    mount(out, &of.mount)?;
    writeln!(out, "noise = {}", vector(&of.noise, "rad"))?;
    if let Some(rate) = of.rate {
        writeln!(out, "rate = \"{rate:?} Hz\"")?;
    }
    writeln!(out, "latency = \"{:?} s\"", of.latency)
}

fn accelerometer(out: &mut String, s: &Scenario, of: &AccelerometerSettings) -> Written {
    writeln!(out, "\n[controller.sensors.accelerometer]")?;
    match of.node {
        Some(_) => node(out, s, of.node)?,
        None => writeln!(out, "position = {}", vector(&of.position, "m"))?,
    }
    writeln!(out, "noise_density = \"{:?} m/s^2/sqrt(Hz)\"", of.noise_density)?;
    writeln!(out, "bias = {}", vector(&of.bias, "m/s^2"))?;
    writeln!(out, "quantum = \"{:?} m/s^2\"", of.quantum)
}

fn filter(out: &mut String, of: &FilterSettings) -> Written {
    let signal = if of.signal == FilteredSignal::Rate { "rate" } else { "torque" };
    writeln!(out, "\n[[controller.filter]]\nsignal = \"{signal}\"")?;
    match of.kind {
        FilterKind::FirstOrderLowPass { frequency } => {
            writeln!(out, "kind = \"first_order_low_pass\"\nfrequency = \"{frequency:?} Hz\"")
        }
        FilterKind::LowPass { frequency, damping_ratio } => {
            writeln!(out, "kind = \"low_pass\"\nfrequency = \"{frequency:?} Hz\"")?;
            writeln!(out, "damping_ratio = {damping_ratio:?}")
        }
        FilterKind::Notch { frequency, zero_damping, pole_damping } => {
            writeln!(out, "kind = \"notch\"\nfrequency = \"{frequency:?} Hz\"")?;
            writeln!(out, "zero_damping = {zero_damping:?}\npole_damping = {pole_damping:?}")
        }
        FilterKind::LeadLag { zero, pole } => {
            writeln!(out, "kind = \"lead_lag\"\nzero = \"{zero:?} Hz\"\npole = \"{pole:?} Hz\"")
        }
    }
}
