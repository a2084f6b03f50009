//! Where in a file the check of a whole scenario finds fault: the place of a key by its path.
//!
//! A path names tables, entries of lists by their `name`, and a key: `device.wheel.wheel.mass`. What
//! the file does not have is at the nearest thing around it; what it has by a default, nowhere.

use precess_dynamics::{Parameter, ParameterError, Part, Warning};

use super::super::diagnostic::Span;
use super::super::document::{Node, Value};
use crate::scenario::ScenarioError;

/// The place of an error.
pub(super) fn of_error(root: &Node, error: &ScenarioError, names: &[String]) -> Option<Span> {
    match error {
        ScenarioError::Range { key, .. } => find(root, key),
        ScenarioError::Parameters(error) => find(root, &parameter(error, names)?),
    }
}

/// The place of a warning.
pub(super) fn of_warning(root: &Node, warning: &Warning, names: &[String]) -> Option<Span> {
    match warning {
        Warning::Triangle { part, .. } => find(root, &key(*part, "inertia", names)?),
        _ => None,
    }
}

/// The path of the parameter that the solver rejects.
fn parameter(error: &ParameterError, names: &[String]) -> Option<String> {
    let (part, last) = match *error {
        ParameterError::NotFinite { part, parameter, .. } => (
            part,
            match parameter {
                Parameter::Mass => "mass",
                Parameter::CentreOfMass => "centre_of_mass",
                Parameter::Inertia => "inertia",
                Parameter::Origin => "origin",
                Parameter::Mount => "mount",
                Parameter::Passive(name) => passive(name),
            },
        ),
        ParameterError::Mass { part, .. } => (part, "mass"),
        ParameterError::Passive { part, name, .. } => (part, passive(name)),
        ParameterError::Asymmetric { part, .. }
        | ParameterError::NegativeInertia { part, .. }
        | ParameterError::LargeInertia { part, .. } => (part, "inertia"),
        ParameterError::SkewedMount { device, .. }
        | ParameterError::LeftHandedMount { device, .. } => {
            return Some(format!("device.{}.mount", names.get(device)?));
        }
        _ => return None,
    };
    key(part, last, names)
}

/// The key of a joint's spring, damper or friction.
fn passive(name: &'static str) -> &'static str {
    if name == "viscous" { "damping" } else { name }
}

/// The path of a body's parameter.
fn key(part: Part, last: &str, names: &[String]) -> Option<String> {
    Some(match part {
        Part::Hub => format!("hub.{last}"),
        Part::Body { device, body } => {
            format!("device.{}.{}.{last}", names.get(device)?, body.replace(' ', "_"))
        }
    })
}

/// The place of the last thing along a path that is there.
fn find(root: &Node, path: &str) -> Option<Span> {
    let (mut here, mut place) = (root, None);
    for segment in path.split('.') {
        here = match &here.value {
            Value::Table(table) => match table.get(segment) {
                Some(entry) => &entry.node,
                None => break,
            },
            Value::List(list) => match entry(list, segment) {
                Some(node) => node,
                None => break,
            },
            _ => break,
        };
        if !matches!(here.value, Value::List(_)) {
            place = Some(here.span.clone());
        }
    }
    place
}

/// The last entry of this name, which is the one that repeats it; of a device of a layout, `cmg3`,
/// the entry `cmg`.
fn entry<'a>(list: &'a [Node], name: &str) -> Option<&'a Node> {
    let of = |name: &str| list.iter().rev().find(|node| node.name() == Some(name));
    of(name).or_else(|| of(name.trim_end_matches(|c: char| c.is_ascii_digit())))
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use super::super::from_toml;

    const HUB: &str = "format = 1\n[hub]\nmass = \"100 kg\"\ninertia = \"9, 8, 7 kg m^2\"\n[run]\nduration = \"1 s\"\n";
    const WHEEL: &str = "[[device]]\nname = \"rw\"\nkind = \"reaction_wheel\"\n\
                         wheel.mass = \"4 kg\"\nwheel.inertia = \"0.2, 0.1, 0.1 kg m^2\"\n";

    /// The underlined parts of a text; `nowhere` where there is none.
    fn underlined(text: &str) -> Vec<String> {
        let reports = match from_toml("test.toml", text, Path::new("")) {
            Ok((_, reports)) | Err(reports) => reports,
        };
        let part = |span: &super::Span| text.get(span.range.clone()).unwrap_or_default().to_owned();
        let parts = reports.all.iter().map(|found| found.span.as_ref().map(part));
        parts.map(|part| part.unwrap_or_else(|| "nowhere".to_owned())).collect()
    }

    #[test]
    fn what_the_solver_rejects_is_underlined() {
        assert_eq!(underlined(&format!("{HUB}{WHEEL}")), [""; 0]);
        let massless = format!("{HUB}{WHEEL}").replace("4 kg", "0 kg");
        assert_eq!(underlined(&massless), ["\"0 kg\""]);
        let one_of_four =
            massless.replace("kind", "layout.ring = { count = 4, radius = \"0.3 m\" }\nkind");
        assert!(underlined(&one_of_four).contains(&"\"0 kg\"".to_owned()), "{one_of_four}");
        let thin = HUB.replace("9, 8, 7", "9, 1, 1");
        assert_eq!(underlined(&thin), ["\"9, 1, 1 kg m^2\""]);
    }

    #[test]
    fn what_is_out_of_range_is_underlined() {
        assert_eq!(underlined(&HUB.replace("1 s", "0 s")), ["\"0 s\""]);
        let rate = format!("{HUB}[output]\nrate = \"1e12 Hz\"\n");
        assert_eq!(underlined(&rate), ["\"1e12 Hz\""]);
        assert_eq!(underlined(&format!("{HUB}{WHEEL}{WHEEL}")), ["\"rw\""]);
    }
}
