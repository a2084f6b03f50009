//! The keys of a body and of its joint.

use nalgebra::{Matrix3, Vector3};
use precess_dynamics::Passive;
use precess_dynamics::kind::{BodyParameters, JointInfo};

use super::corner::{Corner, corner};
use super::friction::friction;
use super::inertia::inertia;
use super::joint_measures::JointMeasures;
use super::kept_rate::{reject_drives, reject_motion, reject_spring};
use super::motion::{motion, only_motion};
use super::motor_limits::{motor_limits, starts_within};
use crate::file::keys::Keys;
use crate::file::read::values::drive::profile;
use crate::scenario::{Drive, JointFriction, Profile, StopAction};
use crate::units::{Measure, Plain};

/// What the table of a body says.
pub(in crate::file::read) struct Body {
    pub(in crate::file::read) parameters: BodyParameters<f64>,
    pub(in crate::file::read) joint: Joint,
    /// What gives the spring of the joint instead of its stiffness.
    pub(super) corner: Option<Corner>,
}

/// What the keys of a joint say.
#[derive(Clone)]
pub(in crate::file::read) struct Joint {
    pub(in crate::file::read) passive: Passive,
    /// Friction that sticks, and quadratic drag; its joint is not known yet.
    pub(in crate::file::read) friction: Option<JointFriction>,
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
        Self { passive: Passive::none(), friction: None, state: [0.0; 2], drive, stop: None }
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
    let inertia = if needs.inertia { inertia(keys) } else { Some(Matrix3::zeros()) };
    let corner = corner(keys);
    if !needs.joint.driven && keys.has("corner_frequency") {
        let message = "the kind keeps the rate of the joint: no `corner_frequency`";
        keys.error("corner_frequency", message, "remove it");
    }
    let origin = needs.origin.then(|| keys.vector("origin", Measure::LENGTH)).flatten();
    let joint = joint(keys, needs.joint, &measures, folder);
    keys.finish();
    let parameters = BodyParameters {
        origin: origin.unwrap_or_else(Vector3::zeros).into(),
        mass: mass?,
        centre: centre.into(),
        inertia: inertia?,
    };
    Some(Body { parameters, joint: joint?, corner: corner? })
}

/// The keys of a joint; what is wrong has been reported.
pub(in crate::file::read) fn joint(
    keys: &Keys<'_>,
    joint: &JointInfo,
    measures: &JointMeasures,
    folder: &std::path::Path,
) -> Option<Joint> {
    let friction = friction(keys, measures);
    let passive = passive(keys, measures);
    let (state, motion) = motion(keys, joint, measures, folder);
    let drive = drive(keys, joint, measures, folder);
    let drive = match motion {
        Some((key, _)) if !joint.driven => {
            reject_motion(keys, key);
            drive
        }
        Some((key, motion)) => {
            only_motion(keys, key);
            motion.map(Drive::Acceleration)
        }
        None => drive,
    };
    if let Some(limit) = drive.as_ref().and_then(|drive| drive.limits().rate) {
        starts_within(keys, joint, measures, [state[1], limit]);
    }
    let stop = stop(keys, measures, state[0]);
    if !joint.driven {
        reject_spring(keys, &passive, stop);
    }
    Some(Joint { passive, friction, state, drive: drive?, stop })
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

fn passive(keys: &Keys<'_>, measures: &JointMeasures) -> Passive {
    let quantity = |key, measure| keys.quantity(key, measure).unwrap_or(0.0);
    // Of friction that sticks it is in `friction`.
    let smooth = !keys.has("static_friction");
    let passive = Passive {
        stiffness: quantity("stiffness", measures.stiffness),
        rest: quantity("rest", measures.coordinate),
        viscous: quantity("damping", measures.damping),
        coulomb: if smooth { quantity("coulomb", measures.torque) } else { 0.0 },
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
    let locked = keys.boolean("locked").unwrap_or(false);
    let given = [keys.has(torque), keys.has("acceleration"), locked];
    let limit = motor_limits(keys, joint, measures, !(given[1] || given[2]));
    if given.iter().filter(|given| **given).count() > 1 {
        let message = format!("a joint has a `{torque}`, or an `acceleration`, or is `locked`");
        keys.error(if given[1] { "acceleration" } else { "locked" }, message, "keep one of them");
    }
    let acceleration = keys
        .node("acceleration")
        .map(|node| profile(keys, "acceleration", node, measures.acceleration, folder));
    let profile_of_torque =
        keys.node(torque).map(|node| profile(keys, torque, node, measures.torque, folder));
    if !joint.driven {
        reject_drives(keys, torque, acceleration.flatten().as_ref(), locked);
        return Some(Drive::Acceleration(Profile::ZERO));
    }
    if locked {
        return Some(Drive::Locked);
    }
    match (acceleration, profile_of_torque) {
        (Some(profile), _) => profile.map(Drive::Acceleration),
        (None, Some(profile)) => profile.map(|profile| Drive::Torque { profile, limit }),
        (None, None) => Some(Drive::Torque { profile: Profile::ZERO, limit }),
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
