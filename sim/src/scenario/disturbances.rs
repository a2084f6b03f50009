//! Checks of a scenario's disturbances: joints, nodes and names that they use, their numbers, and what a
//! blocked measurement has twice beside a coupled wheel.

use precess_dynamics::kind::{BodyParameters, JointInfo};
use precess_dynamics::{BuiltIn, BuiltInKind};

use super::check::range;
use super::{Member, Scenario, ScenarioError, members};
use crate::disturbance::{COMPONENTS, Disturbance, Harmonic, Model, SourceTarget, by_spin_axis};
use crate::names::column_name_fault;
use crate::units::Plain;

/// A harmonic number this near to one is the fundamental: twice the 0.5 % to which a fit gives it.
const FUNDAMENTAL: f64 = 0.01;
/// A harmonic number this near to one may be the fundamental, by a speed that was not known better, or a tone of its own.
const PERHAPS_FUNDAMENTAL: f64 = 0.03;
/// Of a distance of harmonic numbers: 1.01 - 1 is above 0.01 in floating point.
const DECIMAL: f64 = 1e-9;
/// Most tones of one source.
const HARMONICS_MAX: usize = 1000;
/// Highest harmonic number: its angle keeps nine digits after a million turns.
const NUMBER_MAX: f64 = 1e4;
/// Most times of 32 bytes that the noise of all sources keeps: 134 MB.
const KNOTS_MAX: usize = 1 << 22;
/// Axes are at right angles and of unit length to this.
const SKEW_MAX: f64 = 1e-6;

/// A member with the number of its first joint.
type NumberedMember<'a> = (usize, Member<'a>);

impl Scenario {
    /// Everything that is wrong with its disturbances.
    pub(super) fn check_disturbances(&self) -> Vec<ScenarioError> {
        let mut errors = Vec::new();
        let mut knots: usize = 0;
        let placed = self.placed();
        for (index, of) in self.disturbances.iter().enumerate() {
            let mut error = |key: &str, message: String| {
                errors.push(range(&format!("source.{}.{key}", of.name), message));
            };
            if let Some(message) = self.name_fault(index, of) {
                error("name", message);
            }
            if let Some((key, message)) = self.place_fault(of, placed.len()) {
                error(key, message);
                continue;
            }
            if let Some(message) = self.model_fault(of) {
                error(of.model.key(), message);
                continue;
            }
            if let Some((key, message)) = self.twice(of, &placed) {
                error(key, message);
            }
            if let Model::Broadband(noise) = &of.model {
                knots = knots.saturating_add(noise.knots());
                if knots > KNOTS_MAX {
                    let message = format!(
                        "the noise of the sources up to this one has {knots} times, of at most \
                         {KNOTS_MAX}: 8 to 16 for each cycle of its highest frequency in a period, for \
                         each component; shorten `period`"
                    );
                    error("broadband", message);
                    break;
                }
            }
        }
        errors
    }

    fn name_fault(&self, index: usize, of: &Disturbance) -> Option<String> {
        let name = &of.name;
        if let Some(fault) = column_name_fault(name) {
            return Some(fault.to_string());
        }
        if self.disturbances.iter().take(index).any(|other| other.name == *name) {
            return Some(format!("two sources are named `{name}`; rename one"));
        }
        let columns = format!("source_{name}");
        let points = self.structure.iter().flat_map(|of| &of.points).map(|point| &point.name);
        let points = points.chain(self.points.iter().map(|point| &point.name));
        let known = self.names.iter().chain(points).any(|known| *known == columns);
        known.then(|| format!("`{columns}` names other columns, of a device or point; rename one"))
    }

    /// What is wrong with the place that a source acts at, and the key.
    fn place_fault(&self, of: &Disturbance, members: usize) -> Option<(&'static str, String)> {
        let joints = self.joint_count();
        let nodes = self.structure.as_ref().map_or(0, |structure| structure.nodes.len());
        let on = match of.on {
            SourceTarget::Mount(member) if member >= members => {
                Some(format!("device {member} of {members}"))
            }
            SourceTarget::Joint { joint, .. } if joint >= joints => {
                Some(format!("joint {joint} of {joints}"))
            }
            SourceTarget::Node { node, .. } if node >= nodes => {
                Some(format!("node {node} of {nodes}"))
            }
            SourceTarget::Hub { .. } if self.structure.is_some() => Some(
                "a force on a flexible structure acts on one of its nodes; write `on = \"NODE\"`"
                    .to_owned(),
            ),
            _ => None,
        };
        if let Some(message) = on {
            return Some(("on", message));
        }
        if let SourceTarget::Hub { axes } | SourceTarget::Node { axes, .. } = of.on {
            let skew = (axes.transpose() * axes - nalgebra::Matrix3::identity()).abs().max();
            if skew.is_nan() || skew > SKEW_MAX {
                let message =
                    format!("its axes are off right angles by {skew:e}, above {SKEW_MAX:e}");
                return Some(("mount", message));
            }
        }
        if of.point.iter().any(|number| !number.is_finite()) {
            return Some(("point", format!("{:?} is not finite", of.point.as_slice())));
        }
        let [from, to] = of.window;
        let rises = from < to;
        if !rises {
            return Some((
                "to",
                format!(
                    "it acts from {} s to {} s; the end is after the start",
                    Plain(from),
                    Plain(to)
                ),
            ));
        }
        if of.spin_axis > 2 {
            return Some(("spin_axis", format!("axis {} of 0 to 2", of.spin_axis)));
        }
        let wheel = of.wheel?;
        match self.joints().nth(wheel) {
            None => Some(("wheel", format!("joint {wheel} of {joints}"))),
            Some((.., info)) if info.slides => Some((
                "wheel",
                "a joint that slides has no angle; name the joint of a wheel".to_owned(),
            )),
            Some(_) => None,
        }
    }

    /// What is wrong with what it exerts.
    fn model_fault(&self, of: &Disturbance) -> Option<String> {
        let no_wheel = "the angle of no wheel is named; write `wheel = \"rw.wheel\"`";
        match &of.model {
            Model::Harmonic(_) if of.wheel.is_none() => Some(no_wheel.to_owned()),
            Model::Harmonic(harmonics) => {
                let count = harmonics.len();
                if !(1..=HARMONICS_MAX).contains(&count) {
                    return Some(format!("{count} harmonics, of 1 to {HARMONICS_MAX}"));
                }
                harmonics.iter().find_map(fault)
            }
            Model::Broadband(noise) => {
                if of.seed.is_none() {
                    return Some("its phases need a `seed`; write `seed = 1`".to_owned());
                }
                if noise.reference_rate.is_some() && of.wheel.is_none() {
                    return Some(format!("with `reference_rate`, {no_wheel}"));
                }
                noise.check().err().map(|error| error.to_string())
            }
            Model::Measured(record) => {
                record.check(self.settings.duration).err().map(|error| error.to_string())
            }
        }
    }

    /// Sources with a harmonic that may be the fundamental of an imbalance that their wheel has already: the name of the
    /// source, and both readings.
    #[must_use]
    pub fn fundamental_warnings(&self) -> Vec<(&str, String)> {
        let placed = self.placed();
        let warning = |of: &Disturbance| {
            let Model::Harmonic(harmonics) = &of.model else { return None };
            let (name, device) = self.device_of(of, &placed)?;
            if of.fundamental_removed || !is_imbalanced(&device) {
                return None;
            }
            let apart = |tone: &Harmonic| (tone.number - 1.0).abs() - DECIMAL;
            let near =
                |tone: &&Harmonic| FUNDAMENTAL < apart(tone) && apart(tone) <= PERHAPS_FUNDAMENTAL;
            let found = harmonics.iter().filter(near).find(|tone| is_radial(of, tone))?;
            Some(format!(
                "harmonic {}, within {PERHAPS_FUNDAMENTAL} of 1 and across the spin axis, is either the fundamental \
                 of an imbalance that `{name}` already has, then counted twice: remove it, or balance the wheel \
                 (`imbalance_model = \"balanced\"`); or a tone of its own beside the imbalance: it is run so, and \
                 `fundamental_removed = true` says so",
                found.number
            ))
        };
        let named = |of| warning(of).map(|message| (of.name.as_str(), message));
        self.disturbances.iter().filter_map(named).collect()
    }

    /// The members with the number of the first joint of each.
    fn placed(&self) -> Vec<NumberedMember<'_>> {
        let mut first = 0;
        let place = |member: Member<'_>| {
            let place = first;
            first += member.joints().len();
            place
        };
        let members = members(&self.devices);
        let firsts: Vec<usize> = members.iter().copied().map(place).collect();
        firsts.into_iter().zip(members).collect()
    }

    /// Name and device of the wheel of a source, or of what it acts on.
    fn device_of<'a>(
        &self,
        of: &Disturbance,
        placed: &[NumberedMember<'a>],
    ) -> Option<(&str, BuiltIn)> {
        let joint_of = |joint: usize| {
            let within = |(first, member): &&NumberedMember<'_>| {
                (*first..first + member.joints().len()).contains(&joint)
            };
            placed.iter().position(|place| within(&place))
        };
        let on = match of.on {
            SourceTarget::Mount(member) => Some(member),
            SourceTarget::Joint { joint, .. } => joint_of(joint),
            SourceTarget::Hub { .. } | SourceTarget::Node { .. } => None,
        };
        let member = of.wheel.and_then(joint_of).or(on)?;
        let device = placed.get(member)?.1.device()?;
        Some((self.names.get(member).map_or("", String::as_str), device))
    }

    /// What the wheel already has, and the key that says that it was removed.
    fn twice(
        &self,
        of: &Disturbance,
        placed: &[NumberedMember<'_>],
    ) -> Option<(&'static str, String)> {
        let (name, device) = self.device_of(of, placed)?;
        let on_bearings = matches!(
            device.kind(),
            BuiltInKind::FlexibleReactionWheel | BuiltInKind::FlexibleVscmg
        );
        if on_bearings && !of.modes_removed {
            let message = format!(
                "`{name}` stands on flexible bearings, whose modes a measurement on a table has, too; \
                 remove them from the data and write `modes_removed = true`"
            );
            return Some(("modes_removed", message));
        }
        if of.fundamental_removed || !is_imbalanced(&device) {
            return None;
        }
        let what = match &of.model {
            Model::Broadband(_) => return None,
            Model::Measured(record) => {
                let values = |component: usize| record.values.get(component);
                let has = radial_components(of)
                    .any(|of| values(of).is_some_and(|values| values.iter().any(|v| *v != 0.0)));
                has.then(|| "a record across the spin axis contains the fundamental".to_owned())
            }
            Model::Harmonic(harmonics) => {
                let near = |tone: &&Harmonic| (tone.number - 1.0).abs() <= FUNDAMENTAL + DECIMAL;
                let found = harmonics.iter().filter(near).find(|tone| is_radial(of, tone));
                found.map(|of| {
                    format!(
                        "harmonic {}, within {FUNDAMENTAL} of 1 and across the spin axis, is the \
                         fundamental",
                        of.number
                    )
                })
            }
        };
        let message = format!(
            "{} of an imbalance that `{name}` already has; remove it, or balance the wheel \
             (`imbalance_model = \"balanced\"`), or write `fundamental_removed = true` where it was \
             removed from the data",
            what?
        );
        Some((of.model.key(), message))
    }
}

/// The components across the spin axis.
fn radial_components(of: &Disturbance) -> impl Iterator<Item = usize> {
    let radial = [by_spin_axis(of.spin_axis, 0), by_spin_axis(of.spin_axis, 3)];
    radial.into_iter().flat_map(|[first, second, _]| [first, second])
}

/// Whether a harmonic of a source has a component across the spin axis.
fn is_radial(of: &Disturbance, tone: &Harmonic) -> bool {
    radial_components(of).any(|component| tone.amplitudes.get(component) != Some(&0.0))
}

/// Whether a device's wheel exerts a force or moment that turns with it.
fn is_imbalanced(device: &BuiltIn) -> bool {
    let (joints, parameters) = (device.kind().joints(), device.parameters());
    let wheel = |(info, _): &(&JointInfo, &BodyParameters<f64>)| info.body == "wheel";
    let mut bodies = joints.iter().zip(&parameters.bodies);
    bodies.find(wheel).is_some_and(|(info, body)| {
        let axis = info.axis.min(2);
        let mut across = (0..3).filter(|other| *other != axis);
        across.any(|other| body.centre[other] != 0.0 || body.inertia[(axis, other)] != 0.0)
    })
}

/// What is wrong with a harmonic.
fn fault(harmonic: &Harmonic) -> Option<String> {
    let number = Plain(harmonic.number);
    if !(harmonic.number > 0.0 && harmonic.number <= NUMBER_MAX) {
        return Some(format!("harmonic number {number} is not above 0 and up to {NUMBER_MAX}"));
    }
    let of = COMPONENTS.into_iter().zip(harmonic.amplitudes.iter().zip(&harmonic.phases));
    of.into_iter().find_map(|(component, (amplitude, phase))| {
        if !(*amplitude >= 0.0 && amplitude.is_finite()) {
            let sign = "it is finite and not negative; a sign is a phase of 180 deg";
            let amplitude = Plain(*amplitude);
            return Some(format!("harmonic {number}: {component} is {amplitude}; {sign}"));
        }
        (!phase.is_finite())
            .then(|| format!("harmonic {number}: the phase of {component} is {phase}"))
    })
}
