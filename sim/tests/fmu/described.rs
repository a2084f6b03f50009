//! `modelDescription.xml` of both versions, and the files beside it.

use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

use precess::fmu::FmiVersion;

use super::{UNIT, files, scenario};

/// Attributes of an element.
pub(super) type Attributes = BTreeMap<String, String>;

/// The attributes of every element of a kind, and a panic where the text is not well-formed: every element is closed, every
/// attribute quoted, and no letter is one that has to be escaped. There are no comments and no texts between elements.
pub(super) fn elements(document: &str, kind: &str) -> Vec<Attributes> {
    let mut open: Vec<&str> = Vec::new();
    let mut found = Vec::new();
    let rest = document.strip_prefix("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n");
    for element in rest.expect("a declaration").split_inclusive('>') {
        let element = element.trim();
        let Some(text) = element.strip_prefix('<').and_then(|text| text.strip_suffix('>')) else {
            assert!(element.is_empty(), "a text between elements: {element}");
            continue;
        };
        if let Some(name) = text.strip_prefix('/') {
            assert_eq!(open.pop(), Some(name));
            continue;
        }
        let (text, closed) = text.strip_suffix('/').map_or((text, false), |text| (text, true));
        let name = text.split_whitespace().next().expect("a name");
        let mut attributes = BTreeMap::new();
        let mut rest = text[name.len()..].trim();
        while let Some((key, value)) = rest.split_once("=\"") {
            let (value, after) = value.split_once('"').expect("a quotation mark");
            assert!(!value.contains('<') && !value.chars().any(char::is_control), "{value:?}");
            let entities = value.split('&').skip(1);
            let known = ["amp;", "lt;", "gt;", "quot;"];
            assert!(entities.into_iter().all(|of| known.iter().any(|known| of.starts_with(known))));
            assert!(attributes.insert(key.trim().to_owned(), value.to_owned()).is_none(), "{key}");
            rest = after;
        }
        assert!(rest.trim().is_empty(), "{element}");
        if name == kind {
            found.push(attributes);
        }
        if !closed {
            open.push(name);
        }
    }
    assert!(open.is_empty() && !found.is_empty(), "{open:?}");
    found
}

/// The variables of a description, each by its attributes as a variable and as a number.
pub(super) fn variables(version: FmiVersion, document: &str) -> Vec<(Attributes, Attributes)> {
    let (variable, number) = match version {
        FmiVersion::Two => ("ScalarVariable", "Real"),
        FmiVersion::Three => ("Float64", "Float64"),
    };
    let (variables, numbers) = (elements(document, variable), elements(document, number));
    assert_eq!(variables.len(), numbers.len());
    variables.into_iter().zip(numbers).collect()
}

#[test]
fn the_description_is_well_formed_and_names_are_short_and_given_once() {
    let long = "w".repeat(100);
    let text =
        UNIT.replace("\"rw\"", &format!("\"{long}\"")).replace("\"rw.", &format!("\"{long}."));
    for (text, version) in
        [UNIT, &text].into_iter().flat_map(|text| FmiVersion::ALL.map(|of| (text, of)))
    {
        let (unit, files) = files(version, &scenario(text));
        let (path, document) = &files[0];
        assert_eq!((path.as_str(), unit.name()), ("modelDescription.xml", "bus_1"));
        let found = variables(version, document);
        assert_eq!(found.len(), unit.variable_count());
        for key in ["name", "valueReference"] {
            let different: BTreeSet<_> = found.iter().map(|(of, _)| &of[key]).collect();
            assert_eq!(different.len(), found.len(), "{key}");
        }
        for name in found.iter().map(|(of, _)| &of["name"]) {
            let plain = name.chars().all(|c| c.is_ascii_alphanumeric() || c == '_');
            assert!(plain && name.len() <= 55, "{name}");
        }
        let units: BTreeSet<_> =
            elements(document, "Unit").into_iter().map(|of| of["name"].clone()).collect();
        let used: BTreeSet<_> = found.iter().map(|(_, of)| of["unit"].clone()).collect();
        assert_eq!(units, used);
        let head = &elements(document, "fmiModelDescription")[0];
        assert!(
            head["description"]
                .starts_with("Bus &amp; &lt;panel&gt;. One line and another: &quot;")
        );
        let sources: BTreeSet<_> =
            files[1..].iter().filter_map(|(path, _)| path.strip_prefix("sources/")).collect();
        assert_eq!(sources.len(), files.len() - 1);
        let listed = match version {
            // Each for both types.
            FmiVersion::Two => elements(document, "File"),
            FmiVersion::Three => elements(of_build(&files), "SourceFile"),
        };
        let times = if version == FmiVersion::Two { 2 } else { 1 };
        let compiled =
            sources.iter().filter(|path| Path::new(path).extension() == Some("c".as_ref())).count();
        assert_eq!(listed.len(), times * compiled);
        assert!(listed.iter().all(|of| sources.contains(of["name"].as_str())));
    }
}

#[test]
fn starts_limits_and_units_are_those_of_the_scenario() {
    for version in FmiVersion::ALL {
        let (_, files) = files(version, &scenario(UNIT));
        let variables = variables(version, &files[0].1);
        let of = |name: &str| variables.iter().find(|(of, _)| of["name"] == name).expect(name);
        let rate = (3000.0 * std::f64::consts::TAU / 60.0).to_string();
        for (name, causality, start, unit) in [
            ("rw_spin", "output", rate.as_str(), "rad/s"),
            ("rw_u_w", "input", "0.2", "N.m"),
            ("wrench_1_force_z", "input", "-3.0", "N"),
            ("wrench_2_moment_x", "input", "0.001", "N.m"),
            ("panel_panel_stiffness", "parameter", "3.0", "N.m/rad"),
            ("hub_mass", "parameter", "90.0", "kg"),
            ("step", "parameter", "0.001", "s"),
        ] {
            let (variable, number) = of(name);
            let found = [&variable["causality"], &number["start"], &number["unit"]];
            assert_eq!(found, [causality, start, unit], "{name}");
        }
        let (_, torque) = of("rw_u_w");
        assert_eq!([&torque["min"], &torque["max"]], ["-0.2", "0.2"]);
        // Events wrap angles, and change no other state.
        let is_angle = |name: &str| ["rw_theta", "panel_phi"].contains(&name);
        for (variable, number) in &variables {
            let name = variable["name"].as_str();
            assert_eq!(
                number.get("reinit").is_some_and(|of| of == "true"),
                is_angle(name),
                "{name}"
            );
        }
        // A derivative names its state: by its number, counted from one, and by its value reference.
        let (_, derivative) = of("der_rw_spin");
        let state = match version {
            FmiVersion::Two => {
                let number: usize = derivative["derivative"].parse().expect("a number");
                &variables[number - 1].0
            }
            FmiVersion::Three => {
                let named = |of: &&(Attributes, Attributes)| {
                    of.0["valueReference"] == derivative["derivative"]
                };
                &variables.iter().find(named).expect("a state").0
            }
        };
        assert_eq!(state["name"], "rw_spin");
        // What its kind has zero is no parameter of a wheel; of a joint without a motor torque there is no spring.
        let absent = ["rw_wheel_centre_of_mass_x", "gravity_x", "gravity_mu"];
        assert!(variables.iter().all(|(of, _)| !absent.contains(&of["name"].as_str())));
    }
}

/// The description of how a unit of FMI 3.0 is compiled.
fn of_build(files: &[(String, String)]) -> &str {
    let found = files.iter().find(|(path, _)| path == "sources/buildDescription.xml");
    &found.expect("a description of the build").1
}

#[test]
fn the_structure_of_both_versions_is_the_same_by_names() {
    let (_, two) = files(FmiVersion::Two, &scenario(UNIT));
    let (_, three) = files(FmiVersion::Three, &scenario(UNIT));
    let (two, three) = (&two[0].1, &three[0].1);
    let names = variables(FmiVersion::Three, three);
    // Of 2.0 an unknown is a number counted from one, of 3.0 a value reference.
    let by_number = |of: &str| names[of.parse::<usize>().expect("a number") - 1].0["name"].clone();
    let by_reference = |of: &str| {
        let found = names.iter().find(|(variable, _)| variable["valueReference"] == of);
        found.expect("a variable").0["name"].clone()
    };
    let named = |list: &str, name: &dyn Fn(&str) -> String| {
        list.split_whitespace().map(name).collect::<Vec<_>>()
    };
    let of_two = elements(two, "Unknown")
        .into_iter()
        .map(|of| (by_number(&of["index"]), named(&of["dependencies"], &by_number)));
    let of_three = ["Output", "ContinuousStateDerivative", "InitialUnknown"];
    let of_three = of_three
        .into_iter()
        .flat_map(|kind| elements(three, kind))
        .map(|of| (by_reference(&of["valueReference"]), named(&of["dependencies"], &by_reference)));
    let (of_two, of_three): (Vec<_>, Vec<_>) = (of_two.collect(), of_three.collect());
    assert_eq!(of_two.len(), 3 * (13 + 4));
    assert_eq!(of_two, of_three);
}

#[test]
fn the_same_scenario_gives_the_same_bytes_and_another_number_another_identifier() {
    let mut tokens = BTreeSet::new();
    for (version, key) in FmiVersion::ALL.into_iter().zip(["guid", "instantiationToken"]) {
        let of = |text: &str| {
            let (_, files) = files(version, &scenario(text));
            let guid = elements(&files[0].1, "fmiModelDescription")[0][key].clone();
            let token = format!("#define FMU_TOKEN \"{guid}\"");
            assert!(
                files.iter().any(|(path, text)| path == "sources/model.h" && text.contains(&token))
            );
            (precess::fmu::archive(&files).expect("an archive"), guid)
        };
        let (bytes, guid) = of(UNIT);
        assert_eq!(of(UNIT), (bytes.clone(), guid.clone()));
        assert!(bytes.len() < 1_000_000, "{} bytes", bytes.len());
        let (_, other) = of(&UNIT.replace("mass = \"8 kg\"", "mass = \"8.0000001 kg\""));
        assert_ne!(guid, other);
        assert!(tokens.insert(guid), "one of each version");
    }
}
