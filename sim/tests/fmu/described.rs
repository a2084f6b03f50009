//! `modelDescription.xml`, and the files beside it.

use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

use super::{UNIT, files, scenario};

/// The attributes of every element of a kind, and a panic where the text is not well-formed: every element is closed, every
/// attribute quoted, and no letter is one that has to be escaped. There are no comments and no texts between elements.
fn elements(document: &str, kind: &str) -> Vec<BTreeMap<String, String>> {
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

#[test]
fn the_description_is_well_formed_and_names_are_short_and_given_once() {
    let long = "w".repeat(100);
    let text =
        UNIT.replace("\"rw\"", &format!("\"{long}\"")).replace("\"rw.", &format!("\"{long}."));
    for text in [UNIT, &text] {
        let (unit, files) = files(&scenario(text));
        let (path, document) = &files[0];
        assert_eq!((path.as_str(), unit.name()), ("modelDescription.xml", "bus_1"));
        let variables = elements(document, "ScalarVariable");
        assert_eq!(variables.len(), unit.variable_count());
        for key in ["name", "valueReference"] {
            let different: BTreeSet<_> = variables.iter().map(|of| &of[key]).collect();
            assert_eq!(different.len(), variables.len(), "{key}");
        }
        for name in variables.iter().map(|of| &of["name"]) {
            let plain = name.chars().all(|c| c.is_ascii_alphanumeric() || c == '_');
            assert!(plain && name.len() <= 55, "{name}");
        }
        let units: BTreeSet<_> =
            elements(document, "Unit").into_iter().map(|of| of["name"].clone()).collect();
        let used: BTreeSet<_> =
            elements(document, "Real").into_iter().map(|of| of["unit"].clone()).collect();
        assert_eq!(units, used);
        let head = &elements(document, "fmiModelDescription")[0];
        assert!(
            head["description"]
                .starts_with("Bus &amp; &lt;panel&gt;. One line and another: &quot;")
        );
        let sources: BTreeSet<_> =
            files[1..].iter().filter_map(|(path, _)| path.strip_prefix("sources/")).collect();
        assert_eq!(sources.len(), files.len() - 1);
        let listed = elements(document, "File");
        let compiled =
            sources.iter().filter(|path| Path::new(path).extension() == Some("c".as_ref())).count();
        assert_eq!(listed.len(), 2 * compiled, "each for both types");
        assert!(listed.iter().all(|of| sources.contains(of["name"].as_str())));
    }
}

#[test]
fn starts_limits_and_units_are_those_of_the_scenario() {
    let (_, files) = files(&scenario(UNIT));
    let document = &files[0].1;
    let variables = elements(document, "ScalarVariable");
    let numbers = elements(document, "Real");
    let of = |name: &str| {
        let index = variables.iter().position(|of| of["name"] == name).expect(name);
        (&variables[index], &numbers[index])
    };
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
    // A derivative names its state, counted from one.
    let (_, derivative) = of("der_rw_spin");
    let state: usize = derivative["derivative"].parse().expect("a number");
    assert_eq!(variables[state - 1]["name"], "rw_spin");
    // What its kind has zero is no parameter of a wheel; of a joint without a motor torque there is no spring.
    let absent = ["rw_wheel_centre_of_mass_x", "gravity_x", "gravity_mu"];
    assert!(variables.iter().all(|of| !absent.contains(&of["name"].as_str())));
}

#[test]
fn the_same_scenario_gives_the_same_bytes_and_another_number_another_identifier() {
    let of = |text: &str| {
        let (_, files) = files(&scenario(text));
        let guid = elements(&files[0].1, "fmiModelDescription")[0]["guid"].clone();
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
}
