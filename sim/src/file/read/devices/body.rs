//! The keys of a body and of its joint.

use nalgebra::{Matrix3, Vector3};
use precess_dynamics::Passive;
use precess_dynamics::kind::{BodyParameters, JointInfo};

use crate::file::keys::Keys;
use crate::file::read::values::drive::profile;
use crate::scenario::{Drive, Profile, StopAction};
use crate::units::{Measure, Plain};

/// What the table of a body says.
pub(in crate::file::read) struct Body {
    pub(in crate::file::read) parameters: BodyParameters<f64>,
    pub(in crate::file::read) joint: Joint,
}

/// What the keys of a joint say.
#[derive(Clone)]
pub(in crate::file::read) struct Joint {
    pub(in crate::file::read) passive: Passive,
    /// Initial coordinate and rate.
    pub(in crate::file::read) state: [f64; 2],
    pub(in crate::file::read) drive: Drive,
    /// Lowest and highest coordinate, and what happens there.
    pub(in crate::file::read) stop: Option<([f64; 2], StopAction)>,
}

impl Joint {
    /// At rest at zero, without anything that acts on it.
    pub(in crate::file::read) fn free() -> Self {
        let drive = Drive::Torque { profile: Profile::ZERO, limit: None };
        Self { passive: Passive::none(), state: [0.0; 2], drive, stop: None }
    }
}

/// What a kind requires of a body.
#[derive(Clone, Copy)]
pub(in crate::file::read) struct BodyRequirements {
    pub(in crate::file::read) joint: &'static JointInfo,
    /// Whether the link has a body; those of flexible bearings have only a joint.
    pub(in crate::file::read) mass: bool,
    /// Whether the body has an inertia; a point mass has none.
    pub(in crate::file::read) inertia: bool,
    /// Whether its table has the origin of its joint.
    pub(in crate::file::read) origin: bool,
}

/// The measures of a joint.
#[derive(Clone, Copy)]
pub(in crate::file::read) struct JointMeasures {
    pub(in crate::file::read) coordinate: Measure,
    pub(in crate::file::read) rate: Measure,
    pub(in crate::file::read) acceleration: Measure,
    pub(in crate::file::read) torque: Measure,
    stiffness: Measure,
    damping: Measure,
}

impl JointMeasures {
    pub(in crate::file::read) fn of_joint(joint: &JointInfo) -> Self {
        if joint.slides {
            Self {
                coordinate: Measure::LENGTH,
                rate: Measure::VELOCITY,
                acceleration: Measure::ACCELERATION,
                torque: Measure::FORCE,
                stiffness: Measure::STIFFNESS,
                damping: Measure::DAMPING,
            }
        } else {
            Self {
                coordinate: Measure::ANGLE,
                rate: Measure::ANGULAR_RATE,
                acceleration: Measure::ANGULAR_ACCELERATION,
                torque: Measure::TORQUE,
                stiffness: Measure::ANGULAR_STIFFNESS,
                damping: Measure::ANGULAR_DAMPING,
            }
        }
    }
}

/// The table of a body; what is missing or wrong has been reported.
pub(in crate::file::read) fn body(
    keys: &Keys<'_>,
    needs: BodyRequirements,
    folder: &std::path::Path,
) -> Option<Body> {
    let measures = JointMeasures::of_joint(needs.joint);
    let (mass, centre) = if needs.mass {
        (mass(keys), keys.vector("centre_of_mass", Measure::LENGTH).unwrap_or_else(Vector3::zeros))
    } else {
        (Some(0.0), Vector3::zeros())
    };
    let inertia = if needs.inertia { inertia(keys, true) } else { Some(Matrix3::zeros()) };
    let origin = needs.origin.then(|| keys.vector("origin", Measure::LENGTH)).flatten();
    let joint = joint(keys, needs.joint, &measures, folder);
    keys.finish();
    let parameters = BodyParameters {
        origin: origin.unwrap_or_else(Vector3::zeros).into(),
        mass: mass?,
        centre: centre.into(),
        inertia: inertia?,
    };
    Some(Body { parameters, joint: joint? })
}

/// The keys of a joint; what is wrong has been reported.
pub(in crate::file::read) fn joint(
    keys: &Keys<'_>,
    joint: &JointInfo,
    measures: &JointMeasures,
    folder: &std::path::Path,
) -> Option<Joint> {
    let passive = passive(keys, measures);
    // A joint that slides has a displacement and a speed.
    let [coordinate, rate] =
        if joint.slides { ["displacement", "speed"] } else { ["angle", "rate"] };
    let state = [
        keys.quantity(coordinate, measures.coordinate).unwrap_or(0.0),
        keys.quantity(rate, measures.rate).unwrap_or(0.0),
    ];
    let drive = drive(keys, joint, measures, folder);
    let stop = stop(keys, measures, state[0]);
    Some(Joint { passive, state, drive: drive?, stop })
}

/// A mass, at least zero.
pub(in crate::file) fn mass(keys: &Keys<'_>) -> Option<f64> {
    let mass = keys.required("mass", Measure::MASS)?;
    if mass >= 0.0 {
        return Some(mass);
    }
    keys.error(
        "mass",
        format!("`{}.mass` is {} kg", keys.path(), Plain(mass)),
        "a mass is not negative",
    );
    None
}

/// Moments of inertia and products: `inertia = "900, 800, 600 kg m^2"`, and
/// `products_of_inertia = "4.15, 2.93, 2.75 kg m^2"`, the elements 12, 13 and 23 of the tensor.
pub(in crate::file) fn inertia(keys: &Keys<'_>, required: bool) -> Option<Matrix3<f64>> {
    let products = keys.quantities::<3>("products_of_inertia", Measure::INERTIA);
    if !keys.has("inertia") {
        if required {
            keys.missing("inertia", "inertia = \"1, 1, 1 kg m^2\"");
        }
        return None;
    }
    let [xx, yy, zz] = keys.quantities::<3>("inertia", Measure::INERTIA)?;
    if [xx, yy, zz].iter().any(|moment| *moment < 0.0) {
        let [x, y, z] = [xx, yy, zz].map(Plain);
        let message = format!("`{}.inertia` is {x}, {y}, {z} kg m^2", keys.path());
        keys.error("inertia", message, "a moment of inertia is not negative");
        return None;
    }
    let [xy, xz, yz] = products.unwrap_or_default();
    Some(Matrix3::new(xx, xy, xz, xy, yy, yz, xz, yz, zz))
}

fn passive(keys: &Keys<'_>, measures: &JointMeasures) -> Passive {
    let quantity = |key, measure| keys.quantity(key, measure).unwrap_or(0.0);
    let passive = Passive {
        stiffness: quantity("stiffness", measures.stiffness),
        rest: quantity("rest", measures.coordinate),
        viscous: quantity("damping", measures.damping),
        coulomb: quantity("coulomb", measures.torque),
        coulomb_rate: quantity("coulomb_rate", measures.rate),
    };
    if passive.coulomb != 0.0 && !keys.has("coulomb_rate") {
        let unit = measures.rate.usual;
        keys.missing("coulomb_rate", &format!("coulomb_rate = \"0.01 {unit}\""));
    }
    passive
}

/// The drive of a joint from the start: a torque, an acceleration, or locked.
pub(in crate::file::read) fn drive(
    keys: &Keys<'_>,
    joint: &JointInfo,
    measures: &JointMeasures,
    folder: &std::path::Path,
) -> Option<Drive> {
    let torque = if joint.slides { "force" } else { "torque" };
    let limit_key = if joint.slides { "force_limit" } else { "torque_limit" };
    let given = [torque, "acceleration", "locked"].map(|key| keys.has(key));
    let limit = keys.quantity(limit_key, measures.torque);
    if let Some(value) = limit {
        if value.is_nan() || value <= 0.0 {
            keys.error(limit_key, format!("`{limit_key}` is not above zero"), "");
        }
        if given[1] || given[2] {
            keys.error(limit_key, format!("the joint has no `{torque}` to limit"), "remove it");
        }
    }
    if given.iter().filter(|given| **given).count() > 1 {
        let message = format!("a joint has a `{torque}`, or an `acceleration`, or is `locked`");
        keys.error(if given[1] { "acceleration" } else { "locked" }, message, "keep one of them");
    }
    let locked = keys.boolean("locked").unwrap_or(false);
    let acceleration = keys
        .node("acceleration")
        .map(|node| profile(keys, "acceleration", node, measures.acceleration, folder));
    let profile_of_torque =
        keys.node(torque).map(|node| profile(keys, torque, node, measures.torque, folder));
    if locked {
        return Some(Drive::Locked);
    }
    match (acceleration, profile_of_torque) {
        (Some(profile), _) => profile.map(Drive::Acceleration),
        (None, Some(profile)) => profile.map(|profile| Drive::Torque { profile, limit }),
        (None, None) if joint.driven => Some(Drive::Torque { profile: Profile::ZERO, limit }),
        (None, None) => Some(Drive::Acceleration(Profile::ZERO)),
    }
}

fn stop(keys: &Keys<'_>, measures: &JointMeasures, initial: f64) -> Option<([f64; 2], StopAction)> {
    let lower = keys.quantity("lower_stop", measures.coordinate);
    let upper = keys.quantity("upper_stop", measures.coordinate);
    let action = keys.choice("at_stop", &[("end", StopAction::End), ("lock", StopAction::Lock)]);
    if lower.is_none() && upper.is_none() {
        if action.is_some() {
            keys.error("at_stop", "the joint has no stop", "give `lower_stop` or `upper_stop`");
        }
        return None;
    }
    let bounds = [lower.unwrap_or(f64::NEG_INFINITY), upper.unwrap_or(f64::INFINITY)];
    if bounds[0] > bounds[1] {
        let unit = measures.coordinate.unit;
        let [lower, upper] = bounds.map(Plain);
        let message =
            format!("the lower stop, {lower} {unit}, is above the upper stop, {upper} {unit}");
        keys.error("lower_stop", message, "exchange them, or correct a sign");
        return None;
    }
    if !(bounds[0]..=bounds[1]).contains(&initial) {
        let key = if initial < bounds[0] { "lower_stop" } else { "upper_stop" };
        keys.error(key, "the joint starts beyond its stop", "move the stop, or the start");
    }
    Some((bounds, action.unwrap_or(StopAction::End)))
}
