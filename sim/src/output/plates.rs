//! The figures of an outcome: angular velocity, position, conservation; each with its caption.

use super::figure::{Curve, Figure, Panel};
use super::ticks::Scale;
use crate::bound::BOUND;
use crate::jitter::Ripple;
use crate::outcome::Outcome;

/// A figure with the words that belong under it.
pub struct Plate {
    /// The part of the file name after the scenario's.
    pub name: &'static str,
    /// The drawing.
    pub figure: Figure,
    /// Its caption, without a number.
    pub caption: String,
}

/// Length of the window in which single turns are shown, s.
const WINDOW: f64 = 0.5;

const MILLI: f64 = 1e3;
const MICRO: f64 = 1e6;

const JITTER: &str = "Difference from the same run with a balanced wheel, less its mean over one \
                      turn of the wheel.";

/// The figures of an outcome, in the order of the report.
#[must_use]
pub fn plates<const N: usize>(outcome: &Outcome<N>) -> Vec<Plate> {
    vec![angular_velocity(outcome), position(outcome), conservation(outcome)]
}

fn angular_velocity<const N: usize>(outcome: &Outcome<N>) -> Plate {
    let of = |k: usize| {
        let samples = outcome.history.samples.iter();
        samples.map(|s| (s.time, s.state.omega[k].to_degrees())).collect()
    };
    let mut panels = vec![Panel {
        title: "Whole run".into(),
        label: "Angular velocity ω (deg/s)",
        scale: Scale::Linear,
        curves: components(["ω₁", "ω₂", "ω₃"], of),
        level: None,
    }];
    let jitter = |r: &Ripple, k: usize| MILLI * r.omega[k].to_degrees();
    panels.extend(zoom(outcome, "Jitter δω (10⁻³ deg/s)", ["ω₁", "ω₂", "ω₃"], jitter));
    let caption = caption(
        "Angular velocity of the spacecraft along the body axes (Fig. 3 of the paper).",
        &panels,
    );
    plate(outcome, "angular-velocity", panels, caption)
}

fn position<const N: usize>(outcome: &Outcome<N>) -> Plate {
    let of = |k: usize| {
        let samples = outcome.history.samples.iter();
        samples.map(|s| (s.time, MILLI * s.state.r_b_n[k])).collect()
    };
    let mut panels = vec![Panel {
        title: "Whole run".into(),
        label: "Position r (mm)",
        scale: Scale::Linear,
        curves: components(["r₁", "r₂", "r₃"], of),
        level: None,
    }];
    let jitter = |r: &Ripple, k: usize| MICRO * r.position[k];
    panels.extend(zoom(outcome, "Jitter δr (µm)", ["r₁", "r₂", "r₃"], jitter));
    let caption =
        caption("Inertial position of the spacecraft’s point B (Fig. 4 of the paper).", &panels);
    plate(outcome, "position", panels, caption)
}

fn conservation<const N: usize>(outcome: &Outcome<N>) -> Plate {
    let drifts: Vec<_> = outcome.history.ledger.drifts().collect();
    let curve = |name, of: fn(&crate::ledger::Drift) -> f64| {
        let points = drifts.iter().map(|(t, d)| (*t, of(d))).collect();
        Curve { name, points }
    };
    let panels = vec![Panel {
        title: "After each step".into(),
        label: "Drift (1)",
        scale: Scale::Logarithmic,
        curves: vec![
            curve("energy − work", |d| d.energy),
            curve("linear momentum", |d| d.linear),
            curve("angular momentum", |d| d.angular),
        ],
        level: Some((BOUND, "bound 10⁻¹²")),
    }];
    let caption = "Conservation: departure from the start. Energy less work, in units of the \
                   largest kinetic energy plus ∫Σ|u q̇| dt; momenta about the inertial origin, in \
                   units of the largest sum over the bodies of magnitudes."
        .to_owned();
    plate(outcome, "conservation", panels, caption)
}

fn plate<const N: usize>(
    outcome: &Outcome<N>,
    name: &'static str,
    panels: Vec<Panel>,
    caption: String,
) -> Plate {
    let description = format!("Table 1: {}. {caption}", outcome.scenario.title);
    Plate { name, figure: Figure { description, panels }, caption }
}

fn caption(what: &str, panels: &[Panel]) -> String {
    match panels.len() {
        1 => what.to_owned(),
        _ => format!("{what} (b) {JITTER}"),
    }
}

fn components(names: [&'static str; 3], points: impl Fn(usize) -> Vec<(f64, f64)>) -> Vec<Curve> {
    names.into_iter().enumerate().map(|(k, name)| Curve { name, points: points(k) }).collect()
}

/// The jitter in the middle of the run, over a few turns of the wheel.
fn zoom<const N: usize>(
    outcome: &Outcome<N>,
    label: &'static str,
    names: [&'static str; 3],
    of: impl Fn(&Ripple, usize) -> f64,
) -> Option<Panel> {
    let middle = 0.5 * outcome.settings.duration;
    let window = middle..=middle + WINDOW;
    let ripple: Vec<_> = outcome.ripple.iter().filter(|r| window.contains(&r.time)).collect();
    if ripple.len() < 2 {
        return None;
    }
    let points = |k: usize| ripple.iter().map(|r| (r.time, of(r, k))).collect();
    Some(Panel {
        title: "Jitter, a few turns of the wheel in mid-run".into(),
        label,
        scale: Scale::Linear,
        curves: components(names, points),
        level: None,
    })
}
