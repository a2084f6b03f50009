//! Where in a file the check of a whole scenario finds fault: the place of a key by its path.
//!
//! A path names tables, entries of lists by their `name` or number, and a key: `device.wheel.wheel.mass`,
//! `wrench.0.point`. A key that is not there has the place of the innermost table that is, without one it has none.

use precess_dynamics::kind::JointInfo;
use precess_dynamics::{ModesError, ParameterError, Part, Warning};

use crate::file::diagnostic::Span;
use crate::file::document::{Node, Value};
use crate::scenario::{Member, Scenario, ScenarioError, joint_key};

/// The path of each device and platform in the order of the set, and whether it is a platform.
pub(super) struct Tables(Vec<(String, bool)>);

impl Tables {
    pub(super) fn from_scenario(scenario: &Scenario) -> Self {
        let path = |(name, member): (&str, Member<'_>)| {
            let is_platform = member.platform().is_some();
            let table = if is_platform { "platform" } else { "device" };
            (format!("{table}.{name}"), is_platform)
        };
        Self(scenario.members().map(path).collect())
    }

    fn get(&self, member: usize) -> Option<(&str, bool)> {
        self.0.get(member).map(|(path, is_platform)| (path.as_str(), *is_platform))
    }
}

/// The place of an error.
pub(super) fn of_error(root: &Node, error: &ScenarioError, tables: &Tables) -> Option<Span> {
    match error {
        ScenarioError::Range { key, .. } => find(root, key),
        ScenarioError::Parameters(error) | ScenarioError::Modes(ModesError::Rigid(error)) => {
            find(root, &parameter(error, tables)?)
        }
        ScenarioError::Modes(_) => find(root, "structure"),
    }
}

/// The place of the dynamic imbalance of a device, where it is written.
pub(super) fn of_dynamic_imbalance(root: &Node, device: usize, tables: &Tables) -> Option<Span> {
    let table = format!("{}.imbalance", tables.get(device)?.0);
    let place = find(root, &format!("{table}.dynamic"))?;
    (find(root, &table).as_ref() != Some(&place)).then_some(place)
}

/// The place of a key of a joint of a member.
pub(super) fn of_joint(
    root: &Node,
    (member, info): (usize, &JointInfo),
    key: &str,
    tables: &Tables,
) -> Option<Span> {
    find(root, &format!("{}.{}.{key}", tables.get(member)?.0, joint_key(info)))
}

/// The place of a key of a requirement.
pub(super) fn of_requirement(root: &Node, name: &str, key: &str) -> Option<Span> {
    find(root, &format!("requirement.{name}.{key}"))
}

/// The place of a source, at its harmonics.
pub(super) fn of_harmonic(root: &Node, source: &str) -> Option<Span> {
    find(root, &format!("source.{source}.harmonic"))
}

/// The place of a warning.
pub(super) fn of_warning(root: &Node, warning: &Warning, tables: &Tables) -> Option<Span> {
    match warning {
        Warning::Triangle { part, .. } => find(root, &key(*part, "inertia", tables)?),
        _ => None,
    }
}

/// The path of the parameter that the solver rejects.
fn parameter(error: &ParameterError, tables: &Tables) -> Option<String> {
    let (part, last) = match *error {
        // Numbers of a file are finite: one that is not was computed from several of a body's.
        ParameterError::NotFinite { part, .. } => (part, ""),
        ParameterError::Mass { part, .. } => (part, "mass"),
        ParameterError::Passive { part, name: "viscous", .. } => (part, "damping"),
        ParameterError::Passive { part, name, .. } => (part, name),
        ParameterError::NegativeInertia { part, .. }
        | ParameterError::LargeInertia { part, .. } => (part, "inertia"),
        ParameterError::SkewedMount { device, .. }
        | ParameterError::LeftHandedMount { device, .. } => {
            return Some(format!("{}.mount", tables.get(device)?.0));
        }
        ParameterError::Strut { device, .. } => {
            return Some(format!("{}.strut", tables.get(device)?.0));
        }
        ParameterError::Suspension { device, name, .. }
        | ParameterError::AsymmetricSuspension { device, name, .. } => {
            return Some(format!("{}.coupled.{name}", tables.get(device)?.0));
        }
        _ => return None,
    };
    key(part, last, tables)
}

/// The path of a body's parameter.
fn key(part: Part, last: &str, tables: &Tables) -> Option<String> {
    Some(match part {
        Part::Hub => format!("hub.{last}"),
        Part::Body { device, body } => {
            let (table, is_platform) = tables.get(device)?;
            // A platform's own body has its keys beside those of the joints.
            match (is_platform, last) {
                (true, "mass" | "inertia" | "") => format!("{table}.{last}"),
                (true, _) if body == "platform" => format!("{table}.z_turn.{last}"),
                _ => format!("{table}.{}.{last}", body.replace(' ', "_")),
            }
        }
    })
}

/// The place of the last thing along a path that is there.
fn find(root: &Node, path: &str) -> Option<Span> {
    let (mut here, mut place, mut rest) = (root, None, path);
    while !rest.is_empty() {
        let (next, after) = match &here.value {
            Value::Table(table) => {
                let (key, after) = rest.split_once('.').unwrap_or((rest, ""));
                (table.get(key).map(|entry| &entry.node), after)
            }
            Value::List(list) => entry(list, rest),
            _ => (None, ""),
        };
        let Some(next) = next else { break };
        (here, rest) = (next, after);
        if !matches!(here.value, Value::List(_)) {
            place = Some(here.span.clone());
        }
    }
    place
}

/// The entry whose name a path begins with, and the rest of the path. Names may contain dots. Of
/// several of one name the last, which is the one that repeats it; of a device of a layout, `cmg3`,
/// the entry `cmg`.
fn entry<'a, 'p>(list: &'a [Node], path: &'p str) -> (Option<&'a Node>, &'p str) {
    let after = |name: &str| {
        let rest = path.strip_prefix(name)?;
        if rest.is_empty() { Some(rest) } else { rest.strip_prefix('.') }
    };
    let of_layout = |name: &str| {
        let rest = path.strip_prefix(name)?;
        let number = rest.find(|c: char| !c.is_ascii_digit()).unwrap_or(rest.len());
        let (number, rest) = rest.split_at(number);
        if number.is_empty() { None } else { rest.strip_prefix('.') }
    };
    let has_layout = |node: &Node| match &node.value {
        Value::Table(table) => table.get("layout").is_some(),
        _ => false,
    };
    let by_number = || {
        let (number, rest) = path.split_once('.').unwrap_or((path, ""));
        Some((list.get(number.parse::<usize>().ok()?)?, rest))
    };
    let own = list.iter().rev().find_map(|node| Some((node, after(node.name()?)?)));
    let layouts = list.iter().filter(|node| has_layout(node));
    let found =
        own.or_else(|| layouts.rev().find_map(|node| Some((node, of_layout(node.name()?)?))));
    let found = found.or_else(by_number);
    found.map_or((None, ""), |(node, rest)| (Some(node), rest))
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use crate::file::read::from_toml;

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
        assert_eq!(underlined(&one_of_four), ["\"0 kg\""]);
        let thin = HUB.replace("9, 8, 7", "9, 1, 1");
        assert_eq!(underlined(&thin), ["\"9, 1, 1 kg m^2\""]);
    }

    #[test]
    fn what_is_out_of_range_is_underlined() {
        assert_eq!(underlined(&HUB.replace("1 s", "0 s")), ["\"0 s\""]);
        let rate = format!("{HUB}[output]\nrate = \"1e12 Hz\"\n");
        assert_eq!(underlined(&rate), ["\"1e12 Hz\""]);
        let window = "[[requirement]]\nname = \"0.1 deg\"\nquantity = \"omega\"\n\
                      statistic = \"peak\"\nlimit = \"1 rad/s\"\nto = \"2 s\"\n";
        assert_eq!(underlined(&format!("{HUB}{window}")), ["\"2 s\""]);
        let of_a_group = format!("{HUB}{WHEEL}").replace("rw", "loads");
        assert_eq!(underlined(&of_a_group), ["\"loads\""]);
        // The second of one name is the one that repeats it.
        let twice = format!("{HUB}{WHEEL}{WHEEL}");
        let found = from_toml("test.toml", &twice, Path::new("")).expect_err("two of one name");
        let places: Vec<_> = found.all.iter().filter_map(|found| found.span.clone()).collect();
        assert_eq!(places.len(), 1);
        assert_eq!(Some(places[0].range.start), twice.rfind("\"rw\""));
    }
}
