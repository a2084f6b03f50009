//! `allocation` of a `[[controller]]`: how a torque is divided among its joints.

use std::path::Path;

use crate::file::document::Value;
use crate::file::keys::Keys;
use crate::file::read::values::table_file::columns;
use crate::jitter::keep_out::{KEEP_OUT_COLUMNS, union};
use crate::scenario::{AllocationInverse, NullMotion, TorqueAllocation};
use crate::units::Measure;

/// Gains of motion without torque without keys, 1/s.
const NULL_GAINS: [f64; 2] = [0.1, 0.1];

/// What an inverse needs.
#[derive(Clone, Copy, PartialEq)]
enum InverseKind {
    Exact,
    LeastLargest,
    SingularityRobust,
    Generalised,
}

/// Of a controller, a file of bands from a folder.
pub(super) fn allocation(
    keys: &Keys<'_>,
    has_gimbals: bool,
    folder: &Path,
) -> Option<TorqueAllocation> {
    let words = [
        ("exact", InverseKind::Exact),
        ("least_largest", InverseKind::LeastLargest),
        ("singularity_robust", InverseKind::SingularityRobust),
        ("generalised", InverseKind::Generalised),
    ];
    let kind = keys.choice("inverse", &words);
    let number = |key: &str, default: f64| keys.number(key).unwrap_or(default);
    let gimbal_weight = number("gimbal_weight", 1.0);
    let wheel_weight = number("wheel_weight", if has_gimbals { 0.0 } else { 1.0 });
    let wheel_mu = number("wheel_mu", 0.0);
    // Nakamura and Hanafusa's, with the exponent of Wie (2001).
    let robustness = [number("lambda", 0.01), number("mu", 10.0)];
    let dither = [
        number("dither_amplitude", 0.1),
        keys.quantity("dither_frequency", Measure::ANGULAR_RATE).unwrap_or(1.0),
    ];
    let reference = keys.quantity("reference_momentum", Measure::ANGULAR_MOMENTUM);
    let null_motion = null_motion(keys, folder);
    keys.finish();
    if keys.has("inverse") {
        kind?;
    }
    let kind = kind.unwrap_or(InverseKind::Exact);
    let robust = matches!(kind, InverseKind::SingularityRobust | InverseKind::Generalised);
    for key in ["lambda", "mu"].into_iter().filter(|key| !robust && keys.has(key)) {
        let message = format!("`{key}` is of a singularity-robust inverse");
        keys.error(key, message, "take `inverse = \"singularity_robust\"`, or remove it");
    }
    for key in ["dither_amplitude", "dither_frequency"] {
        if kind != InverseKind::Generalised && keys.has(key) {
            let message = format!("`{key}` is of the generalised inverse");
            keys.error(key, message, "take `inverse = \"generalised\"`, or remove it");
        }
    }
    let inverse = match kind {
        InverseKind::Exact => AllocationInverse::Exact,
        InverseKind::LeastLargest => AllocationInverse::LeastLargest,
        InverseKind::SingularityRobust => AllocationInverse::SingularityRobust(robustness),
        InverseKind::Generalised => AllocationInverse::Generalised(robustness, dither),
    };
    Some(TorqueAllocation {
        inverse,
        gimbal_weight,
        wheel_weight,
        wheel_mu,
        reference,
        null_motion: null_motion?,
    })
}

/// Motion without torque; none where something in its keys is wrong.
fn null_motion(keys: &Keys<'_>, folder: &Path) -> Option<NullMotion> {
    let [angle_gain, keep_out_gain] = NULL_GAINS;
    let gain = |key: &str, default| keys.quantity(key, Measure::FREQUENCY).unwrap_or(default);
    let (angle_gain, keep_out_gain) =
        (gain("angle_gain", angle_gain), gain("keep_out_gain", keep_out_gain));
    for (gain, of) in [("angle_gain", "preferred_angles"), ("keep_out_gain", "keep_out")] {
        if keys.has(gain) && !keys.has(of) {
            keys.error(gain, format!("there is no `{of}`"), &format!("add `{of}`, or remove it"));
        }
    }
    let angles = listed(keys, "preferred_angles", Measure::ANGLE);
    let keep_out = bands(keys, folder)?;
    Some(NullMotion { preferred_angles: angles?.concat(), angle_gain, keep_out, keep_out_gain })
}

/// Bands of speeds, of a file or in the key itself; those that meet are one, for the ends of others within a band are no way out of it.
fn bands(keys: &Keys<'_>, folder: &Path) -> Option<Vec<[f64; 2]>> {
    let key = "keep_out";
    let of_file = matches!(keys.node(key), Some(node) if matches!(node.value, Value::Table(_)));
    let found: Vec<[f64; 2]> = if of_file {
        let own = keys.table(key)?;
        let named = own.file("file", folder);
        if !own.has("file") {
            own.missing("file", "file = \"bus-jitter-keep-out.csv\"");
        }
        own.finish();
        let (path, shown) = named?;
        match columns(&path, &KEEP_OUT_COLUMNS.map(|name| (name, true))).as_deref() {
            Ok([lower, upper]) => lower.iter().zip(upper).map(|(l, u)| [*l, *u]).collect(),
            Ok(_) => Vec::new(),
            Err(message) => {
                let help = "`precess jitter` writes one: BUDGET-keep-out.csv";
                own.error("file", format!("{shown}: {message}"), help);
                return None;
            }
        }
    } else {
        let listed = listed(keys, key, Measure::ANGULAR_RATE)?;
        let pairs = listed.iter().filter_map(|of| <[f64; 2]>::try_from(of.as_slice()).ok());
        let pairs: Vec<[f64; 2]> = pairs.collect();
        if pairs.len() != listed.len() {
            keys.error(
                key,
                "a band has a lower and an upper end",
                "write for example `keep_out = [\"1500, 1700 rpm\"]`",
            );
            return None;
        }
        pairs
    };
    // A band that is none is an error of the scenario.
    let all = found.iter().all(|[from, to]| to > from);
    Some(if all { union(found) } else { found })
}

/// The quantities of each text of a list, or of one text by itself; nothing without the key, none where one is wrong.
fn listed(keys: &Keys<'_>, key: &str, measure: Measure) -> Option<Vec<Vec<f64>>> {
    let Some(node) = keys.node(key) else { return Some(Vec::new()) };
    let path = format!("{}.{key}", keys.path());
    match &node.value {
        Value::List(list) => list.iter().map(|node| keys.values_of(node, &path, measure)).collect(),
        _ => keys.values_of(node, &path, measure).map(|of| vec![of]),
    }
}
