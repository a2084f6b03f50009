//! `modelDescription.xml` and `buildDescription.xml` of FMI 3.0, where variables are known by their value references.

use std::fmt::Write as _;

use super::layout::Layout;
use super::variables::{Role, Variable};
use super::xml::{Contents, DECLARATION, Header};

/// The description of the unit.
pub(super) fn description(header: &Header, of: &Contents<'_>) -> String {
    let mut text = DECLARATION.to_owned();
    // Writing into a text does not fail; results are dropped below.
    let _ = write!(
        text,
        "<fmiModelDescription\n  fmiVersion=\"3.0\"\n  modelName=\"{}\"\n  instantiationToken=\"{}\"\n  \
         description=\"{}\"\n  generationTool=\"{}\"\n  variableNamingConvention=\"flat\">\n",
        header.name(),
        of.token,
        header.description(),
        Header::TOOL,
    );
    let derives = !of.is_run;
    let both = format!(
        "needsExecutionTool=\"false\" canGetAndSetFMUState=\"true\" canSerializeFMUState=\"true\" \
         providesDirectionalDerivatives=\"{derives}\" providesAdjointDerivatives=\"{derives}\""
    );
    let own = [
        ("ModelExchange", "needsCompletedIntegratorStep=\"true\""),
        (
            "CoSimulation",
            "canHandleVariableCommunicationStepSize=\"true\" maxOutputDerivativeOrder=\"0\" \
             hasEventMode=\"false\"",
        ),
    ];
    for (kind, capabilities) in own.into_iter().skip(usize::from(of.is_run)) {
        let _ = writeln!(
            text,
            "  <{kind} modelIdentifier=\"{}\" {both} {capabilities}/>",
            of.identifier
        );
    }
    header.write_definitions(&mut text, of.variables);
    text.push_str("  <ModelVariables>\n");
    for variable in of.variables {
        let (of_variable, mut of_number) = header.attributes(variable);
        if let Role::Derivative { state, .. } = variable.role {
            let _ = write!(of_number, " derivative=\"{}\"", Layout::state(state));
        }
        let _ = writeln!(text, "    <Float64{of_variable}{of_number}/>");
    }
    text.push_str("  </ModelVariables>\n");
    structure(&mut text, header, of.variables);
    text.push_str("</fmiModelDescription>\n");
    text
}

/// Outputs, derivatives, and what is computed in initialisation, each with what it depends on.
fn structure(text: &mut String, header: &Header, variables: &[Variable]) {
    let unknowns = header.unknowns(variables);
    text.push_str("  <ModelStructure>\n");
    for kind in ["Output", "InitialUnknown"] {
        for place in &unknowns.computed {
            let _ = writeln!(text, "    <{kind} valueReference=\"{place}\"/>");
        }
    }
    for place in unknowns.outputs {
        let _ = writeln!(
            text,
            "    <Output valueReference=\"{place}\" dependencies=\"{place}\" dependenciesKind=\"constant\"/>"
        );
    }
    for (kind, unknowns) in
        [("ContinuousStateDerivative", unknowns.derivatives), ("InitialUnknown", unknowns.initial)]
    {
        for (place, depends) in unknowns {
            let depends: Vec<_> = depends.iter().map(usize::to_string).collect();
            let depends = depends.join(" ");
            let _ = writeln!(
                text,
                "    <{kind} valueReference=\"{place}\" dependencies=\"{depends}\"/>"
            );
        }
    }
    text.push_str("  </ModelStructure>\n");
}

/// How the sources are compiled: as C99, each by itself, by any compiler.
pub(super) fn build_description(identifier: &str, sources: &[&str]) -> String {
    let mut text = format!(
        "{DECLARATION}<fmiBuildDescription fmiVersion=\"3.0\">\n  <BuildConfiguration \
         modelIdentifier=\"{identifier}\">\n    <SourceFileSet language=\"C99\">\n"
    );
    for source in sources {
        let _ = writeln!(text, "      <SourceFile name=\"{source}\"/>");
    }
    text.push_str("    </SourceFileSet>\n  </BuildConfiguration>\n</fmiBuildDescription>\n");
    text
}
