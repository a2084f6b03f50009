//! `modelDescription.xml` of FMI 2.0.

use std::collections::BTreeMap;
use std::fmt::Write as _;

use super::variables::Role;
use super::xml::{Contents, DECLARATION, Header};

/// The document.
pub(super) fn description(header: &Header, of: &Contents<'_>) -> String {
    let mut text = DECLARATION.to_owned();
    // Writing into a text does not fail; results are dropped below.
    let _ = write!(
        text,
        "<fmiModelDescription\n  fmiVersion=\"2.0\"\n  modelName=\"{}\"\n  guid=\"{}\"\n  \
         description=\"{}\"\n  generationTool=\"{}\"\n  variableNamingConvention=\"flat\"\n  \
         numberOfEventIndicators=\"0\">\n",
        header.name(),
        of.token,
        header.description(),
        Header::TOOL,
    );
    let derives = !of.is_run;
    let both = format!(
        "canGetAndSetFMUstate=\"true\" canSerializeFMUstate=\"true\" \
         canNotUseMemoryManagementFunctions=\"true\" providesDirectionalDerivative=\"{derives}\""
    );
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
    for (kind, capabilities) in own.into_iter().skip(usize::from(of.is_run)) {
        let _ =
            write!(text, "  <{kind} modelIdentifier=\"{}\" {capabilities} {both}", of.identifier);
        if of.sources.is_empty() {
            text.push_str("/>\n");
            continue;
        }
        text.push_str(">\n    <SourceFiles>\n");
        for source in of.sources {
            let _ = writeln!(text, "      <File name=\"{source}\"/>");
        }
        let _ = write!(text, "    </SourceFiles>\n  </{kind}>\n");
    }
    header.write_definitions(&mut text, of.variables);
    text.push_str("  <ModelVariables>\n");
    for variable in of.variables {
        let (of_variable, mut of_number) = header.attributes(variable);
        if let Role::Derivative { state, .. } = variable.role {
            // Variables count from one, and time is the first.
            let _ = write!(of_number, " derivative=\"{}\"", state + 2);
        }
        let _ = write!(
            text,
            "    <ScalarVariable{of_variable}>\n      <Real{of_number}/>\n    </ScalarVariable>\n"
        );
    }
    text.push_str("  </ModelVariables>\n");
    structure(&mut text, header, of);
    text.push_str("</fmiModelDescription>\n");
    text
}

/// Outputs, derivatives, and what is computed in initialisation, each with what it depends on, by numbers of variables.
fn structure(text: &mut String, header: &Header, of: &Contents<'_>) {
    let Contents { variables, is_run, .. } = *of;
    let numbers: BTreeMap<usize, usize> =
        variables.iter().zip(1..).map(|(variable, number)| (variable.place, number)).collect();
    let of_place = |place: usize| numbers.get(&place).copied().unwrap_or_default();
    let unknowns = header.unknowns(variables);
    text.push_str("  <ModelStructure>\n    <Outputs>\n");
    for place in &unknowns.computed {
        let _ = writeln!(text, "      <Unknown index=\"{}\"/>", of_place(*place));
    }
    for place in unknowns.outputs {
        let number = of_place(place);
        let _ = writeln!(
            text,
            "      <Unknown index=\"{number}\" dependencies=\"{number}\" dependenciesKind=\"constant\"/>"
        );
    }
    text.push_str("    </Outputs>\n");
    if is_run {
        text.push_str("    <InitialUnknowns>\n");
        for place in &unknowns.computed {
            let _ = writeln!(text, "      <Unknown index=\"{}\"/>", of_place(*place));
        }
        text.push_str("    </InitialUnknowns>\n  </ModelStructure>\n");
        return;
    }
    for (list, unknowns) in
        [("Derivatives", unknowns.derivatives), ("InitialUnknowns", unknowns.initial)]
    {
        let _ = writeln!(text, "    <{list}>");
        for (place, depends) in unknowns {
            let depends: Vec<_> =
                depends.into_iter().map(|place| of_place(place).to_string()).collect();
            let (number, depends) = (of_place(place), depends.join(" "));
            let _ =
                writeln!(text, "      <Unknown index=\"{number}\" dependencies=\"{depends}\"/>");
        }
        let _ = writeln!(text, "    </{list}>");
    }
    text.push_str("  </ModelStructure>\n");
}
