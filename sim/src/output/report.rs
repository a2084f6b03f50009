//! The report: one HTML page with every figure, caption and number in it, and nothing fetched.

use std::fmt;

use precess_dynamics::Warning;
use precess_dynamics::units::to_rpm;
use serde::Serialize;
use tera::{Context, Tera};

use super::figure::{DrawError, THEME};
use super::plates::Plate;
use super::summary::NO_JITTER;
use crate::bound::BOUND;
use crate::outcome::Outcome;
use crate::run::Settings;

const TEMPLATE: &str = include_str!("report.html");
const STYLE: &str = include_str!("report.css");

/// The page could not be made.
#[derive(Debug)]
pub enum ReportError {
    /// A figure could not be drawn.
    Draw(DrawError),
    /// The template and its data do not agree.
    Template(tera::Error),
}

impl fmt::Display for ReportError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Draw(error) => error.fmt(f),
            Self::Template(error) => {
                write!(f, "cannot lay out the report: {error}; this is a fault of the program")
            }
        }
    }
}

impl std::error::Error for ReportError {
    fn source(&self) -> Option<&(dyn std::error::Error + 'static)> {
        match self {
            Self::Draw(source) => Some(source),
            Self::Template(source) => Some(source),
        }
    }
}

impl From<DrawError> for ReportError {
    fn from(error: DrawError) -> Self {
        Self::Draw(error)
    }
}

impl From<tera::Error> for ReportError {
    fn from(error: tera::Error) -> Self {
        Self::Template(error)
    }
}

#[derive(Serialize)]
struct Section {
    name: String,
    title: String,
    row: Vec<String>,
    plates: Vec<Picture>,
    facts: Vec<(&'static str, String)>,
    warnings: Vec<String>,
}

#[derive(Serialize)]
struct Picture {
    number: usize,
    svg: String,
    caption: String,
}

/// The page.
///
/// # Errors
/// If a figure or the template fails, which is a fault of the program.
pub fn report<const N: usize>(
    outcomes: &[(Outcome<N>, Vec<Plate>)],
    settings: &Settings,
) -> Result<String, ReportError> {
    let mut number = 0;
    let mut sections = Vec::new();
    for (outcome, plates) in outcomes {
        let mut pictures = Vec::new();
        for plate in plates {
            number += 1;
            let svg = plate.figure.inline()?;
            pictures.push(Picture { number, svg, caption: plate.caption.clone() });
        }
        sections.push(Section {
            name: outcome.scenario.name.clone(),
            title: outcome.scenario.title.clone(),
            row: row(outcome),
            plates: pictures,
            facts: facts(outcome),
            warnings: outcome.warnings.iter().map(words).collect(),
        });
    }
    let mut context = Context::new();
    context.insert("style", STYLE);
    context.insert("theme", THEME);
    context.insert("sections", &sections);
    context.insert("duration", &settings.duration.to_string());
    context.insert("tolerance", &power(settings.tolerance, 2));
    context.insert("rate", &settings.rate.to_string());
    context.insert("bound", &power(BOUND, 0));
    let still = outcomes.iter().any(|(outcome, _)| outcome.ripple.is_empty());
    context.insert("no_jitter", if still { NO_JITTER } else { "" });
    let mut tera = Tera::new();
    tera.add_raw_template("report.html", TEMPLATE)?;
    Ok(tera.render("report.html", &context)?)
}

/// The line of the table at the head of the page.
fn row<const N: usize>(outcome: &Outcome<N>) -> Vec<String> {
    let f = outcome.figures();
    let jitter = |of: fn((f64, f64)) -> f64| f.jitter.map_or("–".into(), |j| three(of(j)));
    vec![
        format!("{:.4}", f.omega_peak.to_degrees()),
        jitter(|(omega, _)| 1e3 * omega.to_degrees()),
        jitter(|(_, r)| 1e6 * r),
        format!("{:.2}", 1e3 * f.position_drift),
        power(f.drift.energy, 0),
        power(f.drift.linear, 0),
        power(f.drift.angular, 0),
    ]
}

/// Lines of the table next to the figures; the names are HTML.
fn facts<const N: usize>(outcome: &Outcome<N>) -> Vec<(&'static str, String)> {
    let mut facts = given(outcome);
    for device in &outcome.scenario.devices {
        facts.push(("Wheel offset <i>d</i>", format!("{} mm", digits(1e3 * device.d))));
        let j_13 = device.i_w_wc[(0, 2)];
        let name = "Product of inertia <i>J</i><sub>13</sub>";
        facts.push((name, format!("{} kg m²", power(j_13, 2))));
    }
    for u in &outcome.scenario.inputs.motors {
        let torques = [u.u_w, u.u_i, u.u_o].map(|u| digits(1e3 * u)).join(", ");
        let name = "Motors <i>u<sub>x</sub></i>, <i>u<sub>y</sub></i>, <i>u<sub>z</sub></i>";
        facts.push((name, format!("{torques} mN m")));
    }
    let (history, steps) = (&outcome.history, outcome.history.steps);
    if let Some(last) = history.samples.last() {
        for j in &last.state.devices {
            let gimbals = [j.gamma_o, j.gamma_i].map(|a| digits(a.to_degrees())).join(", ");
            let name = "Gimbals at the end, outer, inner";
            facts.push((name, format!("{gimbals} deg")));
            facts.push(("Wheel at the end", format!("{:.1} rpm", to_rpm(j.spin))));
        }
        facts.push(("Work of the motors", format!("{} J", digits(last.entry.work))));
    }
    facts.push(("Steps accepted, rejected", format!("{}, {}", steps.accepted, steps.rejected)));
    facts
}

/// Lines of the same table: the hub, and how the run starts.
fn given<const N: usize>(outcome: &Outcome<N>) -> Vec<(&'static str, String)> {
    let (hub, state) = (&outcome.scenario.hub, &outcome.scenario.state);
    let list = |values: &[f64]| values.iter().map(|v| exact(*v)).collect::<Vec<_>>().join(", ");
    let inertia = |elements: [(usize, usize); 3]| {
        format!("{} kg m²", list(&elements.map(|element| hub.i_b_bc[element])))
    };
    let moments = "Its inertia <i>J</i><sub>11</sub>, <i>J</i><sub>22</sub>, <i>J</i><sub>33</sub>";
    let products =
        "Its products <i>J</i><sub>12</sub>, <i>J</i><sub>13</sub>, <i>J</i><sub>23</sub>";
    let omega: Vec<_> = state.omega.iter().map(|rate| rate.to_degrees()).collect();
    let mut given = vec![
        ("Hub", format!("{} kg", exact(hub.m_b))),
        (moments, inertia([(0, 0), (1, 1), (2, 2)])),
        (products, inertia([(0, 1), (0, 2), (1, 2)])),
        ("Body rate <i>ω</i> at the start", format!("{} deg/s", list(&omega))),
    ];
    for j in &state.devices {
        given.push(("Wheel at the start", format!("{} rpm", exact(to_rpm(j.spin)))));
    }
    given
}

/// What the solver warns of, as a sentence.
fn words(warning: &Warning) -> String {
    match warning {
        Warning::Triangle { part, excess } => format!(
            "The largest principal moment of the {part} exceeds the sum of the other two by {} \
             kg m²; no mass distribution has this inertia. It is run as printed.",
            power(*excess, 1)
        ),
        // Kinds of warning that this report does not know yet.
        other => other.to_string(),
    }
}

/// A number as it was stated: nine decimals take off what a change of units adds, and no zeros at
/// the end.
fn exact(value: f64) -> String {
    let text = format!("{value:.9}");
    let text = text.trim_end_matches('0').trim_end_matches('.');
    if text == "-0" { "0".into() } else { text.replace('-', "\u{2212}") }
}

/// Three significant digits, zeros at the end left off.
fn digits(value: f64) -> String {
    let text = three(value);
    if text.contains('.') {
        text.trim_end_matches('0').trim_end_matches('.').to_owned()
    } else {
        text
    }
}

/// Three significant digits.
fn three(value: f64) -> String {
    if value == 0.0 {
        return "0".into();
    }
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "clamped to 0 to 12"
    )]
    let decimals = (2.0 - value.abs().log10().floor()).clamp(0.0, 12.0) as usize;
    format!("{value:.decimals$}").replace('-', "\u{2212}")
}

/// A number times a power of ten, the number with so many decimals at most.
fn power(value: f64, decimals: usize) -> String {
    if value == 0.0 {
        return "0".into();
    }
    let text = format!("{value:.decimals$e}");
    let (mantissa, exponent) = text.split_once('e').unwrap_or((&text, "0"));
    let mantissa = if mantissa.contains('.') {
        mantissa.trim_end_matches('0').trim_end_matches('.')
    } else {
        mantissa
    };
    let decade = super::ticks::Scale::Logarithmic.words(exponent.parse().unwrap_or(0.0), 1.0);
    match mantissa {
        "1" => decade,
        _ => format!("{mantissa}\u{b7}{decade}"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_read_as_in_print() {
        assert_eq!(power(1e-13, 2), "10⁻¹³");
        assert_eq!(power(1.54e-6, 2), "1.54·10⁻⁶");
        assert_eq!(power(3.2e-15, 0), "3\u{b7}10⁻¹⁵");
        assert_eq!(digits(37.2151), "37.2");
        assert_eq!(digits(-0.080_04), "\u{2212}0.08");
        assert_eq!((digits(0.540_1), three(0.540_1)), ("0.54".into(), "0.540".into()));
        assert_eq!(digits(1234.5), "1234");
        assert_eq!((exact(810.0), exact(-0.0)), ("810".into(), "0".into()));
        assert_eq!(exact(-4.85_f64.to_radians().to_degrees()), "\u{2212}4.85");
    }
}
