//! What the descriptions of both versions have in common: head, units, attributes of variables, what depends on what.

use std::collections::BTreeSet;
use std::fmt::Write as _;
use std::ops::Range;

use precess_dynamics::HubMode;

use super::layout::Layout;
use super::units::UNITS;
use super::variables::{Role, Variable, nominals};
use crate::scenario::{IntegratorChoice, Scenario};

/// How each document begins.
pub(super) const DECLARATION: &str = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n";

/// What is described.
#[derive(Clone, Copy, Debug)]
pub(super) struct Contents<'a> {
    /// The name of functions and binaries.
    pub(super) identifier: &'a str,
    /// What identifies the sources.
    pub(super) token: &'a str,
    /// Names of the files that are compiled.
    pub(super) sources: &'a [&'a str],
    pub(super) variables: &'a [Variable],
    /// Whether the simulator's engine runs it: for Co-Simulation alone, with outputs of which nothing more is known.
    pub(super) is_run: bool,
}

/// What is computed, by the places of the variables; with what it depends on.
#[derive(Clone, Debug, Default)]
pub(super) struct Unknowns {
    /// Outputs, each of which is a state.
    pub(super) outputs: Vec<usize>,
    /// Outputs of which it is not known on what they depend.
    pub(super) computed: Vec<usize>,
    /// Derivatives, of states and inputs.
    pub(super) derivatives: Vec<(usize, Vec<usize>)>,
    /// Derivatives in initialisation, of parameters as well.
    pub(super) initial: Vec<(usize, Vec<usize>)>,
}

/// What of a scenario is in the head of a description.
#[derive(Clone, Debug)]
pub(super) struct Header {
    name: String,
    description: String,
    duration: f64,
    step: f64,
    tolerance: Option<f64>,
    nominals: Vec<f64>,
    /// Places of the hub's parameters where its motion is given and they are in no equation.
    idle: Range<usize>,
}

impl Header {
    /// What writes the units.
    pub(super) const TOOL: &'static str = concat!("Precess ", env!("CARGO_PKG_VERSION"));

    pub(super) fn new(scenario: &Scenario, layout: &Layout, step: f64) -> Self {
        let texts = [&scenario.title, &scenario.description];
        let texts: Vec<_> =
            texts.iter().map(|text| text.trim()).filter(|text| !text.is_empty()).collect();
        let tolerance = match scenario.settings.integrator {
            IntegratorChoice::Dop853 { tolerance } => Some(tolerance),
            IntegratorChoice::Rk4 { .. } => None,
        };
        Self {
            name: scenario.name.clone(),
            description: texts.join(". "),
            duration: scenario.settings.duration,
            step,
            tolerance,
            nominals: nominals(scenario),
            idle: if scenario.hub_mode == HubMode::Free { 0..0 } else { layout.hub() },
        }
    }

    /// The scenario's name as the value of an attribute.
    pub(super) fn name(&self) -> String {
        escaped(&self.name)
    }

    /// Title and description of the scenario as the value of an attribute.
    pub(super) fn description(&self) -> String {
        escaped(&self.description)
    }

    /// Units, categories of messages, and the experiment of the scenario.
    pub(super) fn write_definitions(&self, text: &mut String, variables: &[Variable]) {
        units(text, variables);
        text.push_str(
            "  <LogCategories>\n    <Category name=\"logStatusError\" description=\"Why a function returns an \
             error\"/>\n  </LogCategories>\n",
        );
        let tolerance =
            self.tolerance.map_or_else(String::new, |of| format!(" tolerance=\"{of:?}\""));
        // Writing into a text does not fail; results are dropped here and below.
        let _ = writeln!(
            text,
            "  <DefaultExperiment startTime=\"0.0\" stopTime=\"{:?}\"{tolerance} stepSize=\"{:?}\"/>",
            self.duration, self.step
        );
    }

    /// The attributes of a variable, and those that it has as a real number, but for what it is the derivative of.
    pub(super) fn attributes(&self, variable: &Variable) -> (String, String) {
        let Variable { name, place, role, unit, shown, start, meaning } = variable;
        let mut of_number = String::new();
        if !unit.is_empty() {
            let _ = write!(of_number, " unit=\"{unit}\"");
        }
        if let Some(shown) = shown {
            let _ = write!(of_number, " displayUnit=\"{shown}\"");
        }
        let (causality, variability, initial) = match role {
            Role::Independent => ("independent", "continuous", None),
            Role::State => ("output", "continuous", Some("exact")),
            Role::Output => ("output", "continuous", Some("calculated")),
            Role::Derivative { .. } => ("local", "continuous", Some("calculated")),
            Role::Input(_) => ("input", "continuous", None),
            Role::Fixed => ("parameter", "fixed", Some("exact")),
            Role::Tunable => ("parameter", "tunable", Some("exact")),
        };
        if let Role::Input(Some(limit)) = role {
            let _ = write!(of_number, " min=\"{:?}\" max=\"{limit:?}\"", -limit);
        }
        if !matches!(role, Role::Derivative { .. } | Role::Independent | Role::Output) {
            let _ = write!(of_number, " start=\"{start:?}\"");
        }
        if *role == Role::State {
            let nominal = self.nominals.get(place.wrapping_sub(Layout::state(0)));
            if let Some(nominal) = nominal.filter(|nominal| **nominal != 1.0) {
                let _ = write!(of_number, " nominal=\"{nominal:?}\"");
            }
            // An angle, which an event may bring into [-pi, pi].
            if *unit == "rad" {
                of_number.push_str(" reinit=\"true\"");
            }
        }
        let initial = initial.map_or_else(String::new, |of| format!(" initial=\"{of}\""));
        let of_variable = format!(
            " name=\"{name}\" valueReference=\"{place}\" causality=\"{causality}\" \
             variability=\"{variability}\"{initial} description=\"{}\"",
            escaped(meaning)
        );
        (of_variable, of_number)
    }

    /// What is computed, and what each depends on, of variables only.
    pub(super) fn unknowns(&self, variables: &[Variable]) -> Unknowns {
        let places: BTreeSet<usize> = variables.iter().map(|variable| variable.place).collect();
        let is_parameter = |of: &&Variable| {
            matches!(of.role, Role::Tunable) || (of.role == Role::Fixed && of.name != "step")
        };
        let all = variables.iter().filter(is_parameter).map(|of| of.place);
        let parameters: Vec<usize> = all.filter(|place| !self.idle.contains(place)).collect();
        let mut unknowns = Unknowns::default();
        for variable in variables {
            match &variable.role {
                Role::State => unknowns.outputs.push(variable.place),
                Role::Output => unknowns.computed.push(variable.place),
                Role::Derivative { depends, on_parameters, .. } => {
                    let mut depends: Vec<usize> =
                        depends.iter().copied().filter(|of| places.contains(of)).collect();
                    unknowns.derivatives.push((variable.place, depends.clone()));
                    if *on_parameters {
                        depends.extend(&parameters);
                    }
                    unknowns.initial.push((variable.place, depends));
                }
                _ => {}
            }
        }
        unknowns
    }
}

/// The units that variables have.
fn units(text: &mut String, variables: &[Variable]) {
    text.push_str("  <UnitDefinitions>\n");
    for unit in UNITS {
        if !variables.iter().any(|variable| variable.unit == unit.name) {
            continue;
        }
        let mut base = String::new();
        for (name, exponent) in unit.base {
            let _ = write!(base, " {name}=\"{exponent}\"");
        }
        let _ = write!(text, "    <Unit name=\"{}\">\n      <BaseUnit{base}/>\n", unit.name);
        for (name, factor) in unit.shown {
            let _ = writeln!(text, "      <DisplayUnit name=\"{name}\" factor=\"{factor:?}\"/>");
        }
        text.push_str("    </Unit>\n");
    }
    text.push_str("  </UnitDefinitions>\n");
}

/// A text as the value of an attribute; a space in the place of a character that XML has not, and of the end of a line.
fn escaped(text: &str) -> String {
    let mut found = String::with_capacity(text.len());
    for letter in text.chars() {
        match letter {
            '&' => found.push_str("&amp;"),
            '<' => found.push_str("&lt;"),
            '>' => found.push_str("&gt;"),
            '"' => found.push_str("&quot;"),
            '\u{fffe}' | '\u{ffff}' => found.push(' '),
            letter if letter.is_control() => found.push(' '),
            letter => found.push(letter),
        }
    }
    found
}

#[cfg(test)]
mod tests {
    use super::escaped;

    #[test]
    fn a_text_is_an_attribute_whatever_is_in_it() {
        assert_eq!(escaped("a<b & \"c\"\n\u{1b}é\u{ffff}"), "a&lt;b &amp; &quot;c&quot;  é ");
    }
}
