//! Largest torque, power and rate of a joint's motor.

use precess_dynamics::kind::JointInfo;

use super::joint_measures::JointMeasures;
use crate::file::keys::Keys;
use crate::scenario::MotorLimits;
use crate::units::{Measure, Plain, parse_quantity};

/// The limits of a motor; reports one that is not above zero, and any where no motor torque is an input.
pub(super) fn motor_limits(
    keys: &Keys<'_>,
    joint: &JointInfo,
    measures: &JointMeasures,
    has_torque: bool,
) -> Option<MotorLimits> {
    let [torque, rate] = if joint.slides { ["force", "speed"] } else { ["torque", "rate"] };
    let limit = |name: &str, measure: Measure| {
        let key = format!("{name}_limit");
        let value = keys.quantity(&key, measure)?;
        if value.is_nan() || value <= 0.0 {
            let message = format!("`{key}` is {} {}, not above zero", Plain(value), measure.unit);
            keys.error(&key, message, "give its magnitude, or remove it");
        }
        if !joint.driven {
            let message = format!("the kind keeps the rate of the joint: no `{torque}` to limit");
            keys.error(&key, message, "remove it");
        } else if !has_torque {
            keys.error(&key, format!("the joint has no `{torque}` to limit"), "remove it");
        }
        Some(value)
    };
    let limits = MotorLimits {
        torque: limit(torque, measures.torque),
        power: limit("power", Measure::POWER),
        rate: limit(rate, measures.rate),
    };
    (limits != MotorLimits::default()).then_some(limits)
}

/// Reports a joint that starts beyond the largest rate of its motor.
pub(super) fn starts_within(
    keys: &Keys<'_>,
    joint: &JointInfo,
    measures: &JointMeasures,
    [rate, limit]: [f64; 2],
) {
    if rate.abs() <= limit {
        return;
    }
    let key = if joint.slides { "speed" } else { "rate" };
    let limit_key = format!("{key}_limit");
    let (unit, size) =
        unit_as_written(keys, &limit_key).unwrap_or((measures.rate.unit.into(), 1.0));
    let [rate, limit] = [rate, limit].map(|value| Plain(rounded(value / size)));
    let message = format!(
        "the joint starts with `{key}` {rate} {unit}, beyond its `{limit_key}` {limit} {unit}"
    );
    keys.error(&limit_key, message, "raise the limit, or start slower");
}

/// The unit in which a quantity is written, and its size in SI; none of a number without a unit.
fn unit_as_written(keys: &Keys<'_>, key: &str) -> Option<(String, f64)> {
    let unit = keys.any_quantity(key)?.unit;
    let one = parse_quantity(&format!("1 {unit}")).ok().filter(|_| !unit.is_empty())?;
    Some((unit, *one.values.first()?))
}

/// Without the last digits, in which a number in SI and back differs from what was written.
fn rounded(value: f64) -> f64 {
    format!("{value:.11e}").parse().unwrap_or(value)
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use crate::file::from_toml;
    use crate::scenario::MotorLimits;

    const FILE: &str = "format = 1\n[run]\nduration = \"1 s\"\n[output]\nrate = \"1 kHz\"\n[hub]\nmass = \"9 kg\"\n\
        inertia = \"1, 1, 1 kg m^2\"\n[[device]]\nname = \"rw\"\nkind = \"reaction_wheel\"\n[device.wheel]\n\
        mass = \"1 kg\"\ninertia = \"2, 1, 1 g m^2\"\n";

    fn errors(keys: &str) -> String {
        let read = from_toml("test.toml", &format!("{FILE}{keys}"), Path::new(""));
        read.map(|_| ()).expect_err("an error").to_string()
    }

    #[test]
    fn limits_are_read_in_their_units() {
        let keys =
            "torque_limit = \"20 mN m\"\npower_limit = \"30 W\"\nrate_limit = \"60 deg/s\"\n";
        let read = from_toml("test.toml", &format!("{FILE}{keys}"), Path::new(""));
        let (scenario, _) = read.unwrap_or_else(|errors| panic!("{errors}"));
        let (torque, power) = (Some(20e-3), Some(30.0));
        let rate = Some(60.0_f64.to_radians());
        assert_eq!(scenario.drives[0].limits(), MotorLimits { torque, power, rate });
    }

    #[test]
    fn a_limit_that_limits_nothing_is_an_error_with_its_value() {
        for (keys, parts) in [
            (
                "power_limit = \"-30 W\"\n",
                vec!["`power_limit` is -30 W, not above zero", "give its magnitude"],
            ),
            (
                "rate = \"-100 rad/s\"\nrate_limit = \"90 rad/s\"\n",
                vec![
                    "the joint starts with `rate` -100 rad/s, beyond its `rate_limit` 90 rad/s",
                    "raise the limit, or start slower",
                    "test.toml:16",
                ],
            ),
            (
                "rate = \"6000 rpm\"\nrate_limit = \"5000 rpm\"\n",
                vec!["starts with `rate` 6000 rpm, beyond its `rate_limit` 5000 rpm"],
            ),
            (
                "acceleration = \"1 rad/s^2\"\npower_limit = \"3 W\"\n",
                vec!["the joint has no `torque` to limit"],
            ),
            (
                "rate = { ramp = \"1, 2 rad/s\", from = \"0 s\", to = \"1 s\" }\nrate_limit = \"3 rad/s\"\n",
                vec!["a joint whose `rate` is a profile has no `rate_limit`"],
            ),
            ("speed_limit = \"3 m/s\"\n", vec!["unknown key", "did you mean `rate_limit`?"]),
            ("speed = \"3 m/s\"\n", vec!["unknown key", "did you mean `rate`?"]),
            ("max_speed = \"6000 rpm\"\n", vec!["unknown key", "did you mean `rate_limit`?"]),
            ("max_torque = \"1 N m\"\n", vec!["unknown key", "did you mean `torque_limit`?"]),
        ] {
            let shown = errors(keys);
            for part in parts {
                assert!(shown.contains(part), "{part}\n{shown}");
            }
        }
    }
}
