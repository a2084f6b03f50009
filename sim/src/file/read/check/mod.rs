//! [`check`]: what only the whole scenario tells, at its places in the text.

mod spans;

use nalgebra::Vector2;
use precess_dynamics::{ParameterError, Part};

use crate::file::diagnostic::{Diagnostic, Diagnostics, Severity, Span};
use crate::file::document::Node;
use crate::record::no_data::no_data;
use crate::scenario::{Scenario, ScenarioError};

/// What only the whole tells: bounds and names, and what the solver rejects or warns of.
pub(super) fn check(root: &Node, scenario: &Scenario, reports: &mut Diagnostics) {
    let names = &scenario.names;
    let tables = spans::Tables::from_scenario(scenario);
    for error in scenario.check() {
        if let ScenarioError::Parameters(ParameterError::NegativeInertia {
            part: Part::Body { device, .. },
            ..
        }) = error
            && let Some(span) = spans::of_dynamic_imbalance(root, device, &tables)
            && let Some(message) = above_bound(scenario, device)
        {
            let help = "that of a balanced wheel is some g cm^2; is the unit right?";
            reports.error(&span, message, "", help);
            continue;
        }
        let message = match &error {
            ScenarioError::Range { key, message } => format!("{key}: {message}"),
            ScenarioError::Parameters(error) => named(&error.to_string(), names),
            ScenarioError::Modes(error) => {
                format!("structure: {}", named(&error.to_string(), names))
            }
        };
        match spans::of_error(root, &error, &tables) {
            Some(span) => reports.error(&span, message, "", ""),
            None => reports.error_anywhere(message, ""),
        }
    }
    without_data(root, scenario, reports);
    for (source, message) in scenario.fundamental_warnings() {
        let span = spans::of_harmonic(root, source);
        reports.all.push(warning(span, format!("source.{source}: {message}"), ""));
    }
    if let Ok(spacecraft) = scenario.spacecraft() {
        for found in spacecraft.warnings() {
            let span = spans::of_warning(root, &found, &tables);
            let help = "check moments and products of inertia and their units; it is run as given";
            reports.all.push(warning(span, named(&found.to_string(), names), help));
        }
    }
}

/// The place of a key of a joint, or of the innermost table that is there.
pub(super) fn place_of_joint(
    root: &Node,
    scenario: &Scenario,
    joint: usize,
    key: &str,
) -> Option<Span> {
    let (member, _, info) = scenario.joints().nth(joint)?;
    spans::of_joint(root, (member, info), key, &spans::Tables::from_scenario(scenario))
}

fn warning(span: Option<Span>, message: String, help: &str) -> Diagnostic {
    let (severity, label) = (Severity::Warning, String::new());
    Diagnostic { severity, span, message, label, help: help.to_owned() }
}

/// Warns of requirements that a whole run has no data for.
fn without_data(root: &Node, scenario: &Scenario, reports: &mut Diagnostics) {
    for of in &scenario.requirements {
        let found = no_data(of, scenario.output.rate, scenario.settings.duration);
        let Some(reason) = found else { continue };
        let span = spans::of_requirement(root, &of.name, of.statistic.key());
        let message = format!("requirement `{}` cannot be evaluated: {reason}", of.name);
        let help =
            "a requirement without data is neither met nor violated: the exit code of its run is 3";
        reports.all.push(warning(span, message, help));
    }
}

/// What is wrong with the dynamic imbalance of a wheel whose moments of inertia by themselves are those of a body.
///
/// With the products `p = [J_12, J_13]` beside the moment `J_11` and the transverse block `T`, the inertia has no negative
/// principal moment where `p T^-1 p <= J_11`: so is the length of `p`, the dynamic imbalance, bounded.
fn above_bound(scenario: &Scenario, device: usize) -> Option<String> {
    let (name, member) = scenario.members().nth(device)?;
    let inertia = member.bodies().last()?.inertia;
    let products = Vector2::new(inertia[(0, 1)], inertia[(0, 2)]);
    let transverse = inertia.fixed_view::<2, 2>(1, 1).into_owned();
    let spin = inertia[(0, 0)];
    let share = products.dot(&transverse.cholesky()?.solve(&products));
    let (dynamic, bound) = (products.norm(), products.norm() * (spin / share).sqrt());
    let [shown, most] =
        [dynamic, bound].map(|value| format!("{value:.3e}").parse().unwrap_or(value));
    (spin > 0.0 && bound < dynamic).then(|| {
        format!(
            "dynamic imbalance {shown} kg m^2 of {name} is above {most} kg m^2, the most with which its wheel has no \
             negative principal moment of inertia"
        )
    })
}

/// `device 0` by its name.
fn named(message: &str, names: &[String]) -> String {
    const DEVICE: &str = "device ";
    let mut text = String::new();
    let mut rest = message;
    while let Some(at) = rest.find(DEVICE) {
        let number = rest.get(at + DEVICE.len()..).unwrap_or_default();
        let end = number.find(|c: char| !c.is_ascii_digit()).unwrap_or(number.len());
        let (digits, after) = number.split_at(end);
        text.push_str(rest.get(..at).unwrap_or_default());
        match digits.parse::<usize>().ok().and_then(|index| names.get(index)) {
            Some(name) => text.push_str(name),
            None => text.extend([DEVICE, digits]),
        }
        rest = after;
    }
    text + rest
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use super::*;
    use crate::file::read::from_toml;

    /// A wheel with the moments 2 and 1 g m^2 can have a dynamic imbalance up to their geometric mean, 1.414 g m^2.
    #[test]
    fn an_impossible_dynamic_imbalance_is_underlined_with_its_bound() {
        let wheel = |dynamic: &str, inertia: &str| {
            let text = format!(
                "format = 1\n[hub]\nmass = \"9 kg\"\ninertia = \"1, 1, 1 kg m^2\"\n[run]\nduration = \"1 s\"\n\
                 [[device]]\nname = \"rw\"\nkind = \"reaction_wheel\"\nimbalance = {{ dynamic = \"{dynamic}\" }}\n\
                 wheel.mass = \"4 kg\"\nwheel.inertia = \"{inertia}\"\n"
            );
            match from_toml("test.toml", &text, Path::new("")) {
                Ok((_, reports)) | Err(reports) => reports.to_string(),
            }
        };
        assert!(!wheel("1.4 g m^2", "2, 1, 1 g m^2").contains("error"));
        let shown = wheel("1.42 g m^2", "2, 1, 1 g m^2");
        for part in
            ["dynamic imbalance 0.00142 kg m^2 of rw is above 0.001414 kg m^2", "test.toml:10:25"]
        {
            assert!(shown.contains(part), "{part} in\n{shown}");
        }
        // Moments that no body has are an error of their own.
        let shown = wheel("1.42 g m^2", "-2, 1, 1 g m^2");
        assert!(shown.contains("a moment of inertia is not negative"), "{shown}");
    }

    #[test]
    fn a_device_is_named_by_its_whole_number() {
        let names = ["a", "b"].map(str::to_owned);
        let text = "device 1, device 12; device 0: device x, device ";
        assert_eq!(named(text, &names), "b, device 12; a: device x, device ");
    }
}
