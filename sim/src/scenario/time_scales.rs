//! [`TimeScale`]: the times in which springs, dampers, modes, profiles and sources vary, before anything is run; and what
//! is too fast for any run of a scenario's length.
//!
//! ```text
//! spring   w >= sqrt(k / J)      J: an upper bound of the inertia that the joint moves while all else is held
//! damper   |s| >= c / (2 J)      the faster root of s^2 + (c / J) s + k / J
//! ```
//!
//! Both are lower bounds whatever the other joints do: by Rayleigh's quotient of a motion of this joint by itself.

use std::f64::consts::TAU;

use precess_dynamics::kind::{BodyParameters, JointInfo};

use super::check::{STEPS_PER_SECOND_MAX, range};
use super::{
    Action, Drive, IntegratorChoice, Member, ModalStructure, Profile, Scenario, ScenarioError,
    StopAction, members,
};
use crate::units::Plain;

/// An explicit step is stable up to `|s| h` of about 6: with more than this, it is not by any of its ways.
const STABLE: f64 = 10.0;
/// So many times as many steps are taken as too many for a run that an end stop or a crossing may end early.
const EARLY: f64 = 1e6;
/// With more than a cycle in each step nothing of a profile is left.
const CYCLE: f64 = TAU;
/// No step is longer than half a cycle of a source.
const HALF_CYCLE: f64 = 0.5 * TAU;

/// The time in which something varies.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct TimeScale {
    /// The key of a file that states it.
    key: String,
    /// What it is: `the stiffness of p.panel`.
    what: String,
    /// A lower bound of its angular frequency, or of its rate of decay, 1/s.
    pub(crate) rate: f64,
    /// Whether it oscillates; otherwise it decays.
    oscillates: bool,
    /// How long it acts in the run, s.
    span: f64,
    /// The most of `rate` times the step with which it can be followed.
    per_step: f64,
}

impl TimeScale {
    /// The steps that it takes at least.
    fn steps(&self) -> f64 {
        self.rate * self.span / self.per_step
    }

    /// What varies, and in which time.
    pub(crate) fn described(&self) -> String {
        let what = &self.what;
        if self.oscillates {
            let period = Plain(rounded(TAU / self.rate));
            format!("{what}, with a period of at most {period} s")
        } else {
            format!("{what}, which decays within {} s at most", Plain(rounded(1.0 / self.rate)))
        }
    }
}

/// Three digits, for messages.
fn rounded(value: f64) -> f64 {
    format!("{value:.2e}").parse().unwrap_or(value)
}

/// Most steps of a run of a length, s, with steps of its own choice.
pub(crate) fn steps_max(length: f64) -> f64 {
    STEPS_PER_SECOND_MAX * length.max(1.0)
}

impl Scenario {
    /// What cannot be followed by as many steps as a run of this length may have, or by steps of a given length.
    pub(super) fn check_time_scales(&self) -> Vec<ScenarioError> {
        let duration = self.settings.duration;
        // A run that ends early takes fewer steps.
        let ends_early = self.crossings.iter().any(|crossing| crossing.ends)
            || self.stops.iter().any(|stop| stop.action == StopAction::End);
        let mut errors = Vec::new();
        for scale in self.time_scales() {
            let message = match self.settings.integrator {
                IntegratorChoice::Dop853 { .. }
                    if scale.steps()
                        > steps_max(duration) * if ends_early { EARLY } else { 1.0 } =>
                {
                    let (steps, most) = (scale.steps(), steps_max(duration));
                    format!(
                        "{}: a run of {} s takes more than {steps:.1e} steps, of at most {most:.1e}; slow it \
                         down, lock the joint or shorten the run",
                        scale.described(),
                        Plain(duration)
                    )
                }
                // The stability of its steps is checked with each; of sources there is advice.
                IntegratorChoice::Rk4 { step }
                    if scale.per_step == CYCLE && scale.rate * step > CYCLE =>
                {
                    format!(
                        "{}: the step of {} s is longer; slow it down, or shorten the step",
                        scale.described(),
                        Plain(step)
                    )
                }
                _ => continue,
            };
            errors.push(range(&scale.key, message));
        }
        errors
    }

    /// The times in which anything varies that is known before the run.
    pub(crate) fn time_scales(&self) -> Vec<TimeScale> {
        let mut scales = self.spring_and_damper_scales();
        let modes = self.structure.iter().flat_map(ModalStructure::massive).zip(1..);
        scales.extend(modes.map(|(mode, number)| TimeScale {
            key: "structure".to_owned(),
            what: format!("mode {number} of the structure"),
            rate: mode.frequency,
            oscillates: true,
            span: self.settings.duration,
            per_step: STABLE,
        }));
        scales.extend(self.profile_scales());
        let rates: Vec<f64> = self.initial_rates();
        for source in &self.disturbances {
            let rate = source.wheel.and_then(|joint| rates.get(joint)).copied().unwrap_or(0.0);
            let [from, to] = source.window;
            let span = to.min(self.settings.duration) - from.max(0.0);
            scales.push(TimeScale {
                key: format!("source.{}.{}", source.name, source.model.key()),
                what: format!("the source `{}`", source.name),
                rate: TAU * source.model.highest_frequency(rate),
                oscillates: true,
                span: span.max(0.0),
                per_step: HALF_CYCLE,
            });
        }
        scales.retain(|scale| scale.rate > 0.0);
        scales
    }

    fn initial_rates(&self) -> Vec<f64> {
        use precess_dynamics::JointStates as _;
        self.initial.devices.states().map(|[_, rate]| rate).collect()
    }

    fn spring_and_damper_scales(&self) -> Vec<TimeScale> {
        let all = members(&self.devices);
        let mut scales = Vec::new();
        let mut first = 0;
        for (index, (member, name)) in all.iter().zip(&self.names).enumerate() {
            let carried = carried(&all, index, 0.0);
            let table = if member.platform().is_some() { "platform" } else { "device" };
            let suspension = member.suspension().and_then(|of| of.coupled);
            for (joint, passive) in member.joints().iter().zip(member.passive()) {
                let number = first + joint.index;
                if !matches!(self.drives.get(number), Some(Drive::Torque { .. })) {
                    continue;
                }
                let inertia = inertia_max(member, joint, &carried);
                let place = (joint.index, joint.index);
                let coupled = suspension.map(|of| [of.stiffness, of.damping].map(|of| of[place]));
                let [k, c] = coupled.unwrap_or_default();
                let (k, c) = (k + passive.stiffness, c + passive.viscous);
                let body = crate::scenario::joint_key(joint);
                let of = |key: &str, rate: f64, oscillates: bool| TimeScale {
                    key: format!("{table}.{name}.{body}.{key}"),
                    what: format!("the {key} of `{name}.{body}`"),
                    rate,
                    oscillates,
                    span: self.settings.duration,
                    per_step: STABLE,
                };
                scales.push(of("stiffness", (k / inertia).sqrt(), true));
                scales.push(of("damping", c / (2.0 * inertia), false));
            }
            first += member.joints().len();
        }
        scales
    }

    fn profile_scales(&self) -> Vec<TimeScale> {
        let mut scales = Vec::new();
        let mut add = |key: String, what: String, profile: &Profile| {
            if let Some((frequency, [from, to])) = cycles(profile, [0.0, self.settings.duration]) {
                scales.push(TimeScale {
                    key,
                    what,
                    rate: TAU * frequency,
                    oscillates: true,
                    span: (to - from).max(0.0),
                    per_step: CYCLE,
                });
            }
        };
        let kinds: Vec<_> = self.members().map(|(_, m)| m.platform().is_some()).collect();
        let joints: Vec<_> = self.joints().collect();
        let key_of = |drive: &Drive, info: &JointInfo| match drive {
            Drive::Acceleration(_) => "acceleration",
            _ if info.slides => "force",
            _ => "torque",
        };
        for ((member, name, info), drive) in joints.iter().zip(&self.drives) {
            if let Some(profile) = drive.profile() {
                let platform = kinds.get(*member).copied().unwrap_or(false);
                let table = if platform { "platform" } else { "device" };
                let (key, body) = (key_of(drive, info), crate::scenario::joint_key(info));
                let what = format!("the {key} on `{name}.{body}`");
                add(format!("{table}.{name}.{body}.{key}"), what, profile);
            }
        }
        for change in &self.changes {
            let Action::Drive(drive) = &change.action else { continue };
            let (Some(profile), Some((_, name, info))) =
                (drive.profile(), joints.get(change.joint))
            else {
                continue;
            };
            let (key, body) = (key_of(drive, info), crate::scenario::joint_key(info));
            let what = format!("the {key} on `{name}.{body}` from {} s on", Plain(change.time));
            add("at".to_owned(), what, profile);
        }
        for (index, wrench) in self.wrenches.iter().enumerate() {
            for (key, profiles) in [("force", &wrench.force), ("moment", &wrench.moment)] {
                for (axis, profile) in ["x", "y", "z"].into_iter().zip(profiles) {
                    let what = format!("the {key} of wrench {} along {axis}", index + 1);
                    add(format!("wrench.{index}.{key}.{axis}"), what, profile);
                }
            }
        }
        scales
    }
}

/// The mean frequency of a profile while it oscillates, Hz, and the part of a time in which it does, s.
fn cycles(profile: &Profile, [start, end]: [f64; 2]) -> Option<(f64, [f64; 2])> {
    match profile {
        Profile::Sine { amplitude, frequency, .. } if *amplitude != 0.0 => {
            Some((frequency.abs(), [start, end]))
        }
        Profile::Chirp { amplitude, between: [from, to], frequencies: [first, last] }
            if *amplitude != 0.0 =>
        {
            Some((0.5 * (first.abs() + last.abs()), [start.max(*from), end.min(*to)]))
        }
        Profile::During { between: [from, to], profile } => {
            cycles(profile, [start.max(*from), end.min(*to)])
        }
        _ => None,
    }
}

/// An upper bound of the mass or of the inertia about its axis that a joint moves while all else is held, kg or kg m²,
/// whatever the pose is: each body outboard as far from the joint as it can be.
fn inertia_max(member: &Member<'_>, joint: &JointInfo, carried: &[(Member<'_>, f64)]) -> f64 {
    let of_chain = |bodies: &[BodyParameters<f64>], mut reach: f64| {
        let mut sum = 0.0;
        for (place, body) in bodies.iter().enumerate() {
            reach += if place > 0 { length(&body.origin) } else { 0.0 };
            let arm = reach + length(&body.centre);
            let about = body.inertia.diagonal().map(f64::abs).sum() + body.mass * arm * arm;
            sum += if joint.slides { body.mass } else { about };
        }
        sum
    };
    let bodies = member.bodies();
    let outboard = bodies.get(joint.index..).unwrap_or_default();
    let own = of_chain(outboard, 0.0);
    let of_carried = carried.iter().map(|(device, reach)| of_chain(&device.bodies(), *reach));
    own + of_carried.sum::<f64>()
}

/// What stands on a platform or panel and on those on it, each with the distance of its first joint from the origin of the
/// first, m, whatever the pose is; `reach` is that of `carrier`.
fn carried<'a>(all: &[Member<'a>], carrier: usize, reach: f64) -> Vec<(Member<'a>, f64)> {
    let mut found = Vec::new();
    for (index, member) in all.iter().enumerate().filter(|(_, of)| of.on() == Some(carrier)) {
        let own = reach + member.bodies().first().map_or(0.0, |body| length(&body.origin));
        found.push((*member, own));
        found.extend(carried(all, index, own));
    }
    found
}

fn length(v: &[f64; 3]) -> f64 {
    v.iter().map(|x| x * x).sum::<f64>().sqrt()
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use crate::file::from_toml;

    fn rates(text: &str) -> Vec<(String, f64)> {
        let head = "format = 1\n[hub]\nmass = \"10 kg\"\ninertia = \"1, 1, 1 kg m^2\"\n[run]\nduration = \"1 s\"\n";
        let read = from_toml("test", &format!("{head}{text}"), Path::new(""));
        let (scenario, _) = read.unwrap_or_else(|errors| panic!("{errors}"));
        scenario.time_scales().into_iter().map(|scale| (scale.what.clone(), scale.rate)).collect()
    }

    #[test]
    fn a_spring_is_never_said_to_be_faster_than_it_is() {
        // A panel of a point mass of 2 kg at 0.5 m about its hinge, and a sliding mass of 3 kg.
        let found = rates(
            "[[device]]\nname = \"p\"\nkind = \"hinged_panel\"\n[device.panel]\nmass = \"2 kg\"\n\
             centre_of_mass = \"50, 0, 0 cm\"\ninertia = \"0, 0.1, 0.1 kg m^2\"\nstiffness = \"18 N m/rad\"\n\
             [[device]]\nname = \"s\"\nkind = \"slosh_mass\"\n[device.slosh_mass]\nmass = \"3 kg\"\n\
             stiffness = \"12 N/m\"\ndamping = \"6 N s/m\"\n",
        );
        let names: Vec<_> = found.iter().map(|(name, _)| name.as_str()).collect();
        let all = [
            "the stiffness of `p.panel`",
            "the stiffness of `s.slosh_mass`",
            "the damping of `s.slosh_mass`",
        ];
        assert_eq!(names, all);
        // The panel's own inertia is at most 0.6 kg m², and it is bounded by 0.7.
        let panel = found[0].1;
        assert!((5.0..=(18.0_f64 / 0.6).sqrt()).contains(&panel), "{panel}");
        assert_eq!([found[1].1, found[2].1], [2.0, 1.0]);
    }

    /// 1 kg, 2 kg on it and a wheel of 6 kg on that: w^2 = k / (9 kg), and of the upper one k / (8 kg).
    #[test]
    fn a_slide_moves_all_that_stands_on_platforms_above() {
        let platform = |name: &str, on: &str, mass: f64, stiffness: f64| {
            format!(
                "[[platform]]\nname = \"{name}\"\non = \"{on}\"\nmass = \"{mass} kg\"\ninertia = \"1, 1, 1 kg m^2\"\n\
                 position = \"1, 0, 0 m\"\nx_slide.stiffness = \"{stiffness} N/m\"\n"
            )
        };
        let found = rates(&format!(
            "{}{}[[device]]\nname = \"rw\"\nkind = \"reaction_wheel\"\non = \"upper\"\n\
             wheel = {{ mass = \"6 kg\", inertia = \"2, 1, 1 g m^2\" }}\n",
            platform("upper", "lower", 2.0, 32.0),
            platform("lower", "hub", 1.0, 81.0),
        ));
        let expected = [("lower", 3.0), ("upper", 2.0)]
            .map(|(name, rate)| (format!("the stiffness of `{name}.x_slide`"), rate));
        assert_eq!(found, expected);
    }
}
