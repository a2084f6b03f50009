//! `modelDescription.xml` of FMI 2.0.

use std::collections::BTreeMap;
use std::fmt::Write as _;
use std::ops::Range;

use precess_dynamics::HubMode;

use super::layout::Layout;
use super::units::UNITS;
use super::variables::{Role, Variable, nominals};
use crate::scenario::{IntegratorChoice, Scenario};

/// What of a scenario is in its head.
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

    /// The document.
    pub(super) fn document(
        &self,
        identifier: &str,
        guid: &str,
        sources: &[&str],
        variables: &[Variable],
    ) -> String {
        let mut text = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n".to_owned();
        self.write(&mut text, (identifier, guid), sources, variables);
        text
    }

    fn write(
        &self,
        text: &mut String,
        (identifier, guid): (&str, &str),
        sources: &[&str],
        variables: &[Variable],
    ) {
        // Writing into a text does not fail; results are dropped below.
        let _ = write!(
            text,
            "<fmiModelDescription\n  fmiVersion=\"2.0\"\n  modelName=\"{}\"\n  guid=\"{guid}\"\n  \
             description=\"{}\"\n  generationTool=\"Precess {}\"\n  variableNamingConvention=\"flat\"\n  \
             numberOfEventIndicators=\"0\">\n",
            escaped(&self.name),
            escaped(&self.description),
            env!("CARGO_PKG_VERSION")
        );
        let both = "canGetAndSetFMUstate=\"true\" canSerializeFMUstate=\"true\" \
                    canNotUseMemoryManagementFunctions=\"true\" providesDirectionalDerivative=\"false\"";
        let own = [
            (
                "ModelExchange",
                "needsExecutionTool=\"false\" completedIntegratorStepNotNeeded=\"false\"",
            ),
            (
                "CoSimulation",
                "needsExecutionTool=\"false\" canHandleVariableCommunicationStepSize=\"true\" \
                 canInterpolateInputs=\"false\" maxOutputDerivativeOrder=\"0\" canRunAsynchronuously=\"false\"",
            ),
        ];
        for (kind, capabilities) in own {
            let _ = write!(
                text,
                "  <{kind} modelIdentifier=\"{identifier}\" {capabilities} {both}>\n    <SourceFiles>\n"
            );
            for source in sources {
                let _ = writeln!(text, "      <File name=\"{source}\"/>");
            }
            let _ = write!(text, "    </SourceFiles>\n  </{kind}>\n");
        }
        units(text, variables);
        text.push_str(
            "  <LogCategories>\n    <Category name=\"logStatusError\" description=\"Why a function returns an \
             error\"/>\n  </LogCategories>\n",
        );
        let tolerance =
            self.tolerance.map_or_else(String::new, |of| format!(" tolerance=\"{of:?}\""));
        let _ = writeln!(
            text,
            "  <DefaultExperiment startTime=\"0.0\" stopTime=\"{:?}\"{tolerance} stepSize=\"{:?}\"/>",
            self.duration, self.step
        );
        text.push_str("  <ModelVariables>\n");
        for variable in variables {
            self.variable(text, variable);
        }
        text.push_str("  </ModelVariables>\n");
        structure(text, variables, &self.idle);
        text.push_str("</fmiModelDescription>\n");
    }

    fn variable(&self, text: &mut String, variable: &Variable) {
        let Variable { name, place, role, unit, shown, start, meaning } = variable;
        let mut attributes = format!(" unit=\"{unit}\"");
        if let Some(shown) = shown {
            let _ = write!(attributes, " displayUnit=\"{shown}\"");
        }
        let (causality, variability, initial) = match role {
            Role::Independent => ("independent", "continuous", None),
            Role::State => ("output", "continuous", Some("exact")),
            Role::Derivative { .. } => ("local", "continuous", Some("calculated")),
            Role::Input(_) => ("input", "continuous", None),
            Role::Fixed => ("parameter", "fixed", Some("exact")),
            Role::Tunable => ("parameter", "tunable", Some("exact")),
        };
        if let Role::Input(Some(limit)) = role {
            let _ = write!(attributes, " min=\"{:?}\" max=\"{limit:?}\"", -limit);
        }
        if let Role::Derivative { state, .. } = role {
            // Variables count from one, and time is the first.
            let _ = write!(attributes, " derivative=\"{}\"", state + 2);
        } else if *role != Role::Independent {
            let _ = write!(attributes, " start=\"{start:?}\"");
        }
        if *role == Role::State {
            let nominal = self.nominals.get(place.wrapping_sub(Layout::state(0)));
            if let Some(nominal) = nominal.filter(|nominal| **nominal != 1.0) {
                let _ = write!(attributes, " nominal=\"{nominal:?}\"");
            }
        }
        let initial = initial.map_or_else(String::new, |of| format!(" initial=\"{of}\""));
        let _ = write!(
            text,
            "    <ScalarVariable name=\"{name}\" valueReference=\"{place}\" causality=\"{causality}\" \
             variability=\"{variability}\"{initial} description=\"{}\">\n      <Real{attributes}/>\n    \
             </ScalarVariable>\n",
            escaped(meaning)
        );
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

/// Outputs, derivatives, and what is computed in initialisation, each with what it depends on.
fn structure(text: &mut String, variables: &[Variable], idle: &Range<usize>) {
    let numbers: BTreeMap<usize, usize> =
        variables.iter().zip(1..).map(|(variable, number)| (variable.place, number)).collect();
    let listed = |places: &mut dyn Iterator<Item = usize>| {
        let known = places.filter_map(|place| numbers.get(&place));
        known.map(usize::to_string).collect::<Vec<_>>().join(" ")
    };
    let is_parameter = |of: &&Variable| {
        matches!(of.role, Role::Tunable) || (of.role == Role::Fixed && of.name != "step")
    };
    let all = variables.iter().filter(is_parameter).map(|of| of.place);
    let parameters: Vec<usize> = all.filter(|place| !idle.contains(place)).collect();
    let (mut outputs, mut derivatives, mut initial) = (String::new(), String::new(), String::new());
    for (variable, number) in variables.iter().zip(1..) {
        match &variable.role {
            Role::State => {
                let _ = writeln!(
                    outputs,
                    "      <Unknown index=\"{number}\" dependencies=\"{number}\" dependenciesKind=\"constant\"/>"
                );
            }
            Role::Derivative { depends, on_parameters, .. } => {
                let own = listed(&mut depends.iter().copied());
                let unknown =
                    format!("      <Unknown index=\"{number}\" dependencies=\"{own}\"/>\n");
                derivatives += &unknown;
                let parameters = if *on_parameters { parameters.as_slice() } else { &[] };
                let own = listed(&mut depends.iter().chain(parameters).copied());
                let _ =
                    writeln!(initial, "      <Unknown index=\"{number}\" dependencies=\"{own}\"/>");
            }
            _ => {}
        }
    }
    let _ = write!(
        text,
        "  <ModelStructure>\n    <Outputs>\n{outputs}    </Outputs>\n    <Derivatives>\n{derivatives}    \
         </Derivatives>\n    <InitialUnknowns>\n{initial}    </InitialUnknowns>\n  </ModelStructure>\n"
    );
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
