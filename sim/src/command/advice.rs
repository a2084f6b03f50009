//! [`Advice`]: where samples or fixed steps are too few for the fastest wheel, or samples for a source, with
//! what would do; where a window is too short for a band; where B is so far from the centre of mass that a central field about it is not enough; and where
//! the start, or rotors of one speed, make the hub drift.
//!
//! ```text
//! samples per turn = 2 pi rate / |omega|        at least 2, the sampling theorem
//! steps per turn   = 2 pi / (|omega| step)      of rk4, at least 20
//! ```
//!
//! The phase of a rotor after one turn in n steps of RK4 is off by `2 pi (2 pi / n)^4 / 120`: the
//! method is exact to the fourth power of `omega step`. At n = 20 that is 0.5 mrad.
//!
//! The field of a central body is taken about B to second order, and what is of third order acts at B. With the
//! centre of mass at c from B and at R from the body's centre, and the mean moment of inertia I about it, that is a
//! torque of up to `2 n^2 m c^3 / R`, n the mean motion `sqrt(mu / R^3)`; it turns with the orbit, so the attitude is
//! off by the order of `2 m c^3 / (R I) n t`.

mod drift;
mod window;

use std::f64::consts::TAU;
use std::fmt;

use precess_dynamics::Gravity;

use super::table::six;
use crate::file::{Diagnostic, Severity};
use crate::scenario::mass::MassProperties;
use crate::scenario::{IntegratorChoice, Scenario, joint_key};

/// Fewer, and a figure shows another frequency than the wheel's.
const SAMPLES_PER_TURN_MIN: f64 = 2.0;
/// What shows the shape of a vibration.
const SAMPLES_PER_TURN: f64 = 20.0;
/// Fewer steps of RK4, and the phase of the wheel's force is off by more than 0.5 mrad a turn.
const STEPS_PER_TURN_MIN: f64 = 20.0;

/// Less, and what a central field about B leaves out is less than two seconds of arc, rad.
const FIELD_ERROR_MAX: f64 = 1e-5;

/// What to change in a scenario.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Advice {
    /// Samples do not resolve a turn.
    Aliasing(Turns),
    /// Steps of RK4 do not.
    CoarseSteps(Turns),
    /// B is far from the centre of mass, in a central field.
    Field {
        /// The centre of mass from B, in B, m.
        centre: [f64; 3],
        /// The order of the error of the attitude at the end, rad.
        error: f64,
    },
    /// The hub starts at rest, so its vibration begins with a mean rate or velocity, and a requirement has it.
    Drift {
        /// The requirement.
        requirement: String,
        /// The mean rate, rad/s, and velocity, m/s: magnitudes.
        mean: [f64; 2],
    },
    /// Rotors of one speed make the hub of a settled run drift, and a requirement has it.
    SecondOrder {
        /// The requirement.
        requirement: String,
        /// The mean accelerations, rad/s² and m/s²: magnitudes.
        mean: [f64; 2],
    },
    /// A window does not resolve the lowest frequency of a band.
    ShortWindow {
        /// The requirement.
        requirement: String,
        /// The lower end of the band, Hz.
        lowest: f64,
        /// The length of the window, s.
        window: f64,
    },
    /// Samples do not resolve a source.
    Source {
        /// Its name.
        name: String,
        /// Its highest frequency at the start, Hz.
        highest: f64,
        /// The rate of samples, Hz.
        rate: f64,
    },
}

/// The fastest joint, and how many samples or steps one of its turns has.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Turns {
    /// `cmg.wheel`.
    joint: String,
    /// Its angular rate, rad/s.
    omega: f64,
    per_turn: f64,
    /// The present rate of samples, Hz, or length of a step, s.
    present: f64,
}

/// Advice for a scenario whose joints turn at these rates, in the order of the set.
pub(super) fn advice(scenario: &Scenario, rates: impl Iterator<Item = f64>) -> Vec<Advice> {
    let joints = scenario.joints().zip(rates.map(f64::abs)).filter(|((.., info), _)| !info.slides);
    let fastest = joints.max_by(|a, b| a.1.total_cmp(&b.1)).filter(|(_, omega)| *omega > 0.0);
    let Some(((_, device, info), omega)) = fastest else { return Vec::new() };
    let turns = |per_turn: f64, present: f64| Turns {
        joint: format!("{device}.{}", joint_key(info)),
        omega,
        per_turn,
        present,
    };
    let mut advice = Vec::new();
    let rate = scenario.output.rate;
    let samples = TAU * rate / omega;
    if samples <= SAMPLES_PER_TURN_MIN {
        advice.push(Advice::Aliasing(turns(samples, rate)));
    }
    if let IntegratorChoice::Rk4 { step } = scenario.settings.integrator {
        let steps = TAU / (omega * step);
        if steps < STEPS_PER_TURN_MIN {
            advice.push(Advice::CoarseSteps(turns(steps, step)));
        }
    }
    advice
}

/// The advice at the initial rates.
pub(super) fn initial(scenario: &Scenario) -> Vec<Advice> {
    let mut advice = of_rates(scenario);
    advice.extend(window::too_short(scenario));
    advice.extend(of_field(scenario));
    advice.extend(drift::at_rest(scenario));
    advice.extend(drift::second_order(scenario));
    advice
}

/// That of joints and sources at their initial rates, which takes no evaluation.
pub(super) fn of_rates(scenario: &Scenario) -> Vec<Advice> {
    let mut advice = advice(scenario, scenario.mean_joints().map(|[_, rate]| rate));
    advice.extend(of_sources(scenario));
    advice
}

/// What a central field about B leaves out over the run, where it shows.
fn of_field(scenario: &Scenario) -> Option<Advice> {
    let Gravity::Central { mu } = scenario.gravity else { return None };
    let spacecraft = scenario.spacecraft().ok()?;
    let MassProperties { mass, centre_of_mass: centre, inertia_b } =
        MassProperties::from_spacecraft(scenario, &spacecraft).ok()?;
    let far = scenario.initial.r_b_n.norm();
    // At its centre there is no field.
    if far == 0.0 {
        return None;
    }
    let turned = (mu / far.powi(3)).sqrt() * scenario.settings.duration;
    let moved = mass * centre.norm_squared();
    let moment = (inertia_b.trace() - 2.0 * moved) / 3.0;
    let error = 2.0 * moved / moment * (centre.norm() / far) * turned;
    (error > FIELD_ERROR_MAX).then(|| Advice::Field { centre: centre.into(), error })
}

/// The source that reaches furthest beyond half the rate of samples.
fn of_sources(scenario: &Scenario) -> Option<Advice> {
    let rate = scenario.output.rate;
    let highest = scenario.disturbances.iter().map(|of| {
        let wheel = of.wheel.and_then(|wheel| scenario.mean_joints().nth(wheel));
        let [_, rate] = wheel.unwrap_or_default();
        (of.model.highest_frequency(rate), &of.name)
    });
    let (highest, name) = highest.max_by(|a, b| a.0.total_cmp(&b.0))?;
    let beyond = 2.0 * highest > rate;
    beyond.then(|| Advice::Source { name: name.clone(), highest, rate })
}

impl Advice {
    /// Whether another is about the same matter, at another rate.
    pub(super) fn is_like(&self, other: &Self) -> bool {
        std::mem::discriminant(self) == std::mem::discriminant(other)
    }

    /// Whether it is among those of [`of_rates`].
    pub(super) fn is_of_rates(&self) -> bool {
        matches!(self, Self::Aliasing(_) | Self::CoarseSteps(_) | Self::Source { .. })
    }

    fn help(&self) -> String {
        match self {
            Self::Aliasing(Turns { omega, .. }) => {
                let hertz = |per_turn: f64| six((omega / TAU * per_turn).ceil());
                format!(
                    "record at more than {} Hz; {} samples per turn are `output.rate = \"{} Hz\"`",
                    hertz(SAMPLES_PER_TURN_MIN),
                    SAMPLES_PER_TURN,
                    hertz(SAMPLES_PER_TURN)
                )
            }
            Self::Field { .. } => {
                "put B at the centre of mass: shift every position, and `initial.position`"
                    .to_owned()
            }
            Self::Drift { .. } => {
                "`initial.settled = true` starts in the vibration itself, without the mean"
                    .to_owned()
            }
            Self::SecondOrder { .. } => {
                "a requirement on the vibration is one in a band: `statistic = \"band_rms\"` with `band`".to_owned()
            }
            Self::ShortWindow { lowest, .. } => {
                format!("let the window be {} s or more", six(window::PERIODS_MIN / lowest))
            }
            Self::Source { highest, .. } => {
                format!("record at more than {} Hz", six(2.0 * highest))
            }
            Self::CoarseSteps(Turns { omega, .. }) => format!(
                "{STEPS_PER_TURN_MIN} steps per turn are `run.step = \"{} s\"`, or take dop853",
                six(TAU / omega / STEPS_PER_TURN_MIN)
            ),
        }
    }
}

impl fmt::Display for Advice {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let rpm = |omega: f64| six(precess_dynamics::units::to_rpm(omega));
        match self {
            Self::Aliasing(Turns { joint, omega, per_turn, present }) => write!(
                f,
                "{joint} turns at {} rpm: {} samples per turn at {} Hz, so figures and \
                 statistics show another frequency than its own (aliasing)",
                rpm(*omega),
                six(*per_turn),
                six(*present)
            ),
            Self::Source { name, highest, rate } => write!(
                f,
                "the source {name} reaches {} Hz, samples at {} Hz show up to half of that, so figures \
                 and statistics show other frequencies than its own (aliasing)",
                six(*highest),
                six(*rate)
            ),
            Self::ShortWindow { requirement, lowest, window } => write!(
                f,
                "the requirement `{requirement}` is on a band from {} Hz, of which its window of {} s has {} periods: \
                 Hann's window takes that for other frequencies, or loses it",
                six(*lowest),
                six(*window),
                six(lowest * window)
            ),
            Self::Drift { requirement, mean: [rate, velocity] } => write!(
                f,
                "the hub starts at rest while its rotors are out of balance, so it drifts beside its vibration, at \
                 {} rad/s and {} m/s, and the requirement `{requirement}` counts that",
                six(*rate),
                six(*velocity)
            ),
            Self::SecondOrder { requirement, mean: [angular, linear] } => write!(
                f,
                "rotors out of balance that exchange power through the hub speed up and slow down, so it drifts beside its \
                 vibration, at first at {} rad/s^2 and {} m/s^2, and the requirement `{requirement}` counts that: its value \
                 depends on the time",
                six(*angular),
                six(*linear)
            ),
            Self::Field { centre: [x, y, z], error } => write!(
                f,
                "the centre of mass is at {}, {}, {} m from B, about which the central field is taken to \
                 second order: the attitude is off by the order of {} deg at the end",
                six(*x),
                six(*y),
                six(*z),
                six(error.to_degrees())
            ),
            Self::CoarseSteps(Turns { joint, omega, per_turn, present }) => write!(
                f,
                "{joint} turns at {} rpm: {} steps per turn at {} s, so the phase of its force is \
                 off by about {} rad a turn",
                rpm(*omega),
                six(*per_turn),
                six(*present),
                six(TAU * (TAU / per_turn).powi(4) / 120.0)
            ),
        }
    }
}

impl From<&Advice> for Diagnostic {
    fn from(advice: &Advice) -> Self {
        Self {
            severity: Severity::Warning,
            span: None,
            message: advice.to_string(),
            label: String::new(),
            help: advice.help(),
        }
    }
}

#[cfg(test)]
mod tests {
    use nalgebra::Vector3;

    use super::*;
    use crate::disturbance::{Disturbance, Harmonic, Model, SourceTarget};
    use crate::engine::tests::{scenario, set_joint, wheel};

    /// 60 rad/s, recorded at 18 Hz; at 1 kHz; in steps of 10 ms.
    #[test]
    fn too_few_samples_and_too_long_steps_are_named() {
        let mut turning = scenario(&["wheel"], vec![wheel().into()], 1.0);
        set_joint(&mut turning, 0, [0.0, 60.0]);
        turning.output.rate = 18.0;
        let found = initial(&turning);
        assert!(
            matches!(&found[..], [Advice::Aliasing(turns)] if turns.per_turn < 1.9),
            "{found:?}"
        );
        let shown = Diagnostic::from(&found[0]);
        assert!(shown.message.starts_with("wheel.wheel turns at 572.958 rpm: 1.88496 samples"));
        assert!(shown.help.contains("more than 20 Hz") && shown.help.contains("\"191 Hz\""));
        turning.output.rate = 1000.0;
        assert_eq!(initial(&turning), []);
        turning.settings.integrator = IntegratorChoice::Rk4 { step: 0.01 };
        let found = initial(&turning);
        assert!(matches!(&found[..], [Advice::CoarseSteps(turns)] if turns.per_turn < 10.5));
        assert!(Diagnostic::from(&found[0]).help.contains("\"0.00523599 s\""));
    }

    /// Harmonic 8 of 60 rad/s is 76.4 Hz, above half of 150 Hz.
    #[test]
    fn a_source_beyond_the_samples_is_named() {
        let mut turning = scenario(&["wheel"], vec![wheel().into()], 1.0);
        set_joint(&mut turning, 0, [0.0, 60.0]);
        turning.disturbances = vec![Disturbance {
            name: "bearing".to_owned(),
            on: SourceTarget::Mount(0),
            point: Vector3::zeros(),
            spin_axis: 0,
            wheel: Some(0),
            fundamental_removed: false,
            modes_removed: false,
            window: crate::disturbance::ALWAYS,
            seed: None,
            model: Model::Harmonic(vec![Harmonic {
                number: 8.0,
                amplitudes: [1e-6; 6],
                phases: [0.0; 6],
            }]),
        }];
        turning.output.rate = 150.0;
        let found = initial(&turning);
        let shown = Diagnostic::from(&found[0]);
        assert!(shown.message.starts_with("the source bearing reaches 76.3944 Hz"), "{shown:?}");
        assert_eq!(shown.help, "record at more than 152.789 Hz");
        turning.output.rate = 153.0;
        assert_eq!(initial(&turning), []);
    }

    /// 100 kg at 6 m in a low orbit for 8 h, 40 kg m^2: three tenths of a degree. Runs of a hub of 400 kg and
    /// 97 kg m^2, against B at the centre of mass, are off by 0.36 to 2 degrees at 6 m and 0.012 to 0.08 at 2 m, for
    /// an order of 0.45 and 0.017.
    #[test]
    fn a_centre_of_mass_far_from_b_in_a_central_field_is_named() {
        let mut orbit = scenario(&[], vec![], 28_800.0);
        orbit.gravity = Gravity::Central { mu: 3.986e14 };
        orbit.initial.r_b_n = Vector3::new(7e6, 0.0, 0.0);
        orbit.hub.r_bc_b = Vector3::new(0.0, 0.0, 6.0);
        let found = initial(&orbit);
        let shown = Diagnostic::from(&found[0]);
        assert!(shown.message.contains("off by the order of 0.27"), "{shown:?}");
        orbit.hub.r_bc_b = Vector3::new(0.0, 0.0, 0.6);
        assert_eq!(initial(&orbit), []);
    }

    /// The phase of `y' = i omega y` after a turn in n steps, against the formula that is printed.
    #[test]
    fn the_phase_error_of_a_turn_is_the_methods() {
        let n = 20.0;
        let h = TAU / n;
        // The stability function of RK4 at i h.
        let (re, im) = (1.0 - h * h / 2.0 + h.powi(4) / 24.0, h - h.powi(3) / 6.0);
        let phase = n * (im.atan2(re) - h);
        let stated = TAU * h.powi(4) / 120.0;
        assert!((phase.abs() / stated - 1.0).abs() < 0.05, "{phase:e} {stated:e}");
    }
}
