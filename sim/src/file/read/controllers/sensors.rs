//! `sensors`, `filter`, `estimator` and `dumping` of a `[[controller]]`.

use nalgebra::{Matrix3, Vector3};
use precess_control::GyroOutput;

use super::Wrong;
use crate::file::document::Value;
use crate::file::keys::Keys;
use crate::file::read::structure::Structure;
use crate::file::read::values::mount::rotation_of;
use crate::scenario::{
    AccelerometerSettings, ControllerSensors, DumpingSettings, EstimatorSettings, FilterKind,
    FilterSettings, FilteredSignal, GyroSettings, StarTrackerSettings,
};
use crate::units::Measure;

/// Damping ratio of a low-pass filter without a key: Butterworth's.
const BUTTERWORTH: f64 = std::f64::consts::FRAC_1_SQRT_2;

/// What a controller reads and filters, and how it dumps momentum.
pub(super) type Sensing =
    (ControllerSensors, Vec<FilterSettings>, Option<EstimatorSettings>, Option<DumpingSettings>);

pub(super) fn sensing(keys: &Keys<'_>, structure: Option<&Structure>) -> Option<Sensing> {
    let estimator = optional(keys, "estimator", |keys| {
        let attitude = keys.required("attitude_deviation", Measure::ANGLE);
        let bias = keys.required("bias_deviation", Measure::ANGULAR_RATE);
        Some(EstimatorSettings { attitude_deviation: attitude?, bias_deviation: bias? })
    });
    let draws = keys.has("estimator");
    let sensors = optional(keys, "sensors", |keys| sensors(keys, structure, draws));
    let filters: Vec<_> = keys.tables("filter").iter().map(filter).collect();
    let dumping = optional(keys, "dumping", dumping);
    Some((
        sensors.ok()?.unwrap_or_default(),
        filters.into_iter().collect::<Option<_>>()?,
        estimator.ok()?,
        dumping.ok()?,
    ))
}

/// What a table says, where it is there.
fn optional<'a, T>(
    keys: &Keys<'a>,
    key: &str,
    read: impl FnOnce(&Keys<'a>) -> Option<T>,
) -> Result<Option<T>, Wrong> {
    if !keys.has(key) {
        return Ok(None);
    }
    let table = keys.table(key).ok_or(Wrong)?;
    let found = read(&table);
    table.finish();
    found.map(Some).ok_or(Wrong)
}

fn sensors(
    keys: &Keys<'_>,
    structure: Option<&Structure>,
    draws: bool,
) -> Option<ControllerSensors> {
    let gyro = optional(keys, "gyro", |keys| gyro(keys, structure));
    let star_tracker = optional(keys, "star_tracker", |keys| star_tracker(keys, structure));
    let accelerometer = optional(keys, "accelerometer", |keys| accelerometer(keys, structure));
    let (gyro, star_tracker) = (gyro.ok()?, star_tracker.ok()?);
    let accelerometer = accelerometer.ok()?;
    let noise = gyro.is_some_and(|of| of.angle_random_walk != 0.0 || of.rate_random_walk != 0.0)
        || star_tracker.is_some_and(|of| of.noise != Vector3::zeros())
        || accelerometer.is_some_and(|of| of.noise_density != 0.0);
    if (noise || draws) && !keys.has("seed") {
        keys.missing("seed", "seed = 1");
    }
    let seed = if keys.has("seed") { keys.count("seed", 0, u32::MAX)? } else { 0 };
    let quantum = |key: &str, measure| keys.quantity(key, measure).unwrap_or(0.0);
    Some(ControllerSensors {
        seed,
        gyro,
        star_tracker,
        accelerometer,
        encoder_quantum: quantum("encoder_quantum", Measure::ANGLE),
        tachometer_quantum: quantum("tachometer_quantum", Measure::ANGULAR_RATE),
    })
}

fn gyro(keys: &Keys<'_>, structure: Option<&Structure>) -> Option<GyroSettings> {
    let words = [("sampled", GyroOutput::Sampled), ("integrating", GyroOutput::Integrating)];
    let output = keys.choice("output", &words).unwrap_or_default();
    let node = node(keys, structure);
    let walk = |key: &str, measure| {
        if keys.has(key) { keys.per_root(key, measure, Measure::TIME) } else { Some(0.0) }
    };
    let angle = walk("angle_random_walk", Measure::ANGLE);
    let rate = walk("rate_random_walk", Measure::ANGULAR_RATE);
    let bias = keys.vector("bias", Measure::ANGULAR_RATE);
    let measure = match output {
        GyroOutput::Sampled => Measure::ANGULAR_RATE,
        GyroOutput::Integrating => Measure::ANGLE,
    };
    let quantum = keys.quantity("quantum", measure);
    Some(GyroSettings {
        node: node.ok()?,
        output,
        angle_random_walk: angle?,
        rate_random_walk: rate?,
        bias: bias.unwrap_or_else(Vector3::zeros),
        quantum: quantum.unwrap_or(0.0),
    })
}

fn star_tracker(keys: &Keys<'_>, structure: Option<&Structure>) -> Option<StarTrackerSettings> {
    let node = node(keys, structure);
    let mount = optional(keys, "mount", |keys| rotation_of(keys).map(|mount| mount.matrix));
    let noise = each_axis(keys, "noise", Measure::ANGLE);
    let rate = keys.quantity("rate", Measure::FREQUENCY);
    let latency = keys.quantity("latency", Measure::TIME).unwrap_or(0.0);
    Some(StarTrackerSettings {
        node: node.ok()?,
        mount: mount.ok()?.unwrap_or_else(Matrix3::identity),
        noise: noise.unwrap_or_else(Vector3::zeros),
        rate,
        latency,
    })
}

fn accelerometer(keys: &Keys<'_>, structure: Option<&Structure>) -> Option<AccelerometerSettings> {
    let node = node(keys, structure);
    if keys.has("node") && keys.has("position") {
        let message = "it stands on a node, and at a position of the hub";
        keys.error("position", message, "remove one");
    }
    let position = keys.vector("position", Measure::LENGTH);
    let noise_density = if keys.has("noise_density") {
        keys.per_root("noise_density", Measure::ACCELERATION, Measure::FREQUENCY)
    } else {
        Some(0.0)
    };
    let bias = keys.vector("bias", Measure::ACCELERATION);
    let quantum = keys.quantity("quantum", Measure::ACCELERATION);
    Some(AccelerometerSettings {
        node: node.ok()?,
        position: position.unwrap_or_else(Vector3::zeros),
        noise_density: noise_density?,
        bias: bias.unwrap_or_else(Vector3::zeros),
        quantum: quantum.unwrap_or(0.0),
    })
}

/// The node of the structure on which a sensor stands; none for the hub.
fn node(keys: &Keys<'_>, structure: Option<&Structure>) -> Result<Option<usize>, Wrong> {
    let Some(name) = keys.text("node") else { return Ok(None) };
    let Some(structure) = structure else {
        keys.error("node", "there is no structure", "remove `node`, or describe a `[structure]`");
        return Err(Wrong);
    };
    structure.node(keys, "node", name).map(Some).ok_or(Wrong)
}

fn filter(keys: &Keys<'_>) -> Option<FilterSettings> {
    let signals = [("rate", FilteredSignal::Rate), ("torque", FilteredSignal::Torque)];
    let signal = keys.choice("signal", &signals).unwrap_or_default();
    if !keys.has("kind") {
        keys.missing("kind", "kind = \"low_pass\"");
    }
    let words = [("first_order_low_pass", 0), ("low_pass", 1), ("notch", 2), ("lead_lag", 3)];
    let chosen = keys.choice("kind", &words)?;
    let frequency = |key: &str| keys.required(key, Measure::FREQUENCY);
    let kind = match chosen {
        0 => frequency("frequency").map(|frequency| FilterKind::FirstOrderLowPass { frequency }),
        1 => {
            let damping_ratio = keys.number("damping_ratio").unwrap_or(BUTTERWORTH);
            frequency("frequency").map(|frequency| FilterKind::LowPass { frequency, damping_ratio })
        }
        2 => {
            let zero_damping = keys.number("zero_damping").unwrap_or(0.0);
            let pole_damping = keys.required("pole_damping", Measure::NUMBER);
            let both = frequency("frequency").zip(pole_damping);
            both.map(|(frequency, pole_damping)| FilterKind::Notch {
                frequency,
                zero_damping,
                pole_damping,
            })
        }
        _ => {
            let both = (frequency("zero"), frequency("pole"));
            both.0.zip(both.1).map(|(zero, pole)| FilterKind::LeadLag { zero, pole })
        }
    };
    keys.finish();
    kind.map(|kind| FilterSettings { signal, kind })
}

fn dumping(keys: &Keys<'_>) -> Option<DumpingSettings> {
    let gain = keys.required("gain", Measure::FREQUENCY);
    let momentum = keys.vector("momentum", Measure::ANGULAR_MOMENTUM);
    let limit = each_axis(keys, "torque_limit", Measure::TORQUE);
    Some(DumpingSettings {
        gain: gain?,
        momentum: momentum.unwrap_or_else(Vector3::zeros),
        torque_limit: limit.unwrap_or_else(|| Vector3::repeat(f64::INFINITY)),
    })
}

/// One number for all axes, or three.
fn each_axis(keys: &Keys<'_>, key: &str, measure: Measure) -> Option<Vector3<f64>> {
    let node = keys.node(key)?;
    match &node.value {
        Value::Text(text) if !text.contains(',') => {
            keys.quantity(key, measure).map(Vector3::repeat)
        }
        _ => keys.vector(key, measure),
    }
}
