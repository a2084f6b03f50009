//! Errors of every key of a structure and of what is on it: the key, and the remedy.

use precess::file::from_toml;

use super::{BEAM, folder};

/// Everything that is said of a text.
fn said(text: &str) -> String {
    let read = from_toml("test.toml", text, &folder());
    read.map_or_else(|errors| errors.to_string(), |_| String::new())
}

/// A text with one part replaced.
fn with(part: &str, by: &str) -> String {
    assert!(BEAM.contains(part), "{part}");
    BEAM.replacen(part, by, 1)
}

#[test]
fn every_key_has_its_error() {
    assert_eq!(said(BEAM), "");
    let structure = "contains_devices = false";
    let add = |keys: &str| with(structure, &format!("{structure}\n{keys}"));
    let end = |tables: &str| format!("{BEAM}{tables}");
    let cases = [
        (with(structure, ""), "`structure.contains_devices` is missing"),
        (with(structure, "contains_devices = 1"), "`structure.contains_devices` is a number"),
        (add("file = \"modes.npz\""), "the modes are given twice"),
        (add("damping = [0.1, 0.2, 0.3]"), "3 damping ratios for 2 modes"),
        (add("damping = 1.5"), "a damping ratio of 1.5 is outside 0 to below 1"),
        (add("damping = \"1 %\""), "write numbers without a unit"),
        (add("modes = 3"), "it is a whole number from 1 to 2"),
        (add("modes = 0"), "it is a whole number from 1 to 2"),
        (add("frequency_limit = \"2 Hz\""), "the lowest mode is at 9 Hz, above this limit"),
        (add("frequency_limit = \"2 kg\""), "write one number in Hz"),
        (add("coordinates = [1, 2, 3]"), "3 numbers for 2 modes"),
        (add("rates = 1"), "1 numbers for 2 modes"),
        (add("mods = 3"), "did you mean `modes`?"),
        (with("frequency = \"9 Hz\"", "frequency = \"9 m\""), "is no frequency"),
        (with("frequency = \"9 Hz\"", "frequency = \"-9 Hz\""), "angular frequency of mode 1"),
        (with("frequency = \"9 Hz\"", ""), "`structure.mode.0.frequency` is missing"),
        (with("damping = 0.01", "damping = 2"), "damping ratio of mode 1"),
        (
            with("translation = [0, 0, 1.1]", "translation = [0, 1.1]"),
            "no list of 3 finite numbers",
        ),
        (with("position = \"1.2, 0, 0 m\"", ""), "`structure.node.tip.position` is missing"),
        (
            with("node = \"tip\"\ntranslation", "node = \"tp\"\ntranslation"),
            "no node of the structure is named `tp`",
        ),
        (
            with("linear_momentum = [0, 0, 1.2]", "linear_momentum = [0, 0, 12]"),
            "check that the shapes are mass-normalised",
        ),
        (
            with("name = \"tip\"\n[[", "name = \"top\"\n[["),
            "no node of the structure is named `top`",
        ),
        (
            with("name = \"tip\"\n[[", "name = \"rw\"\nnode = \"tip\"\n[["),
            "a point or a group; choose another `name`, with `node = \"tip\"`",
        ),
        (
            with("[[structure.point]]", "[[point]]\nname = \"imu\"\n[[structure.point]]"),
            "points of a flexible structure are its nodes",
        ),
        (
            with("name = \"tip\"\n[[", "name = \"A 1\"\nnode = \"tip\"\n[["),
            "is not lower-case letters",
        ),
        (with("node = \"tip\"\nmount", "mount"), "`device.rw.node` is missing"),
        (
            with("node = \"tip\"\nmount", "node = \"rot\"\nmount"),
            "no node of the structure is named `rot`",
        ),
        (
            with("node = \"tip\"\nmount", "node = [\"tip\", \"root\"]\nmount"),
            "2 nodes for 1 devices",
        ),
        (end("[[wrench]]\non = \"hub\"\nforce = \"1, 0, 0 N\""), "acts on one of its nodes"),
        (
            end("[[wrench]]\non = \"tip\"\nforce = \"1, 0, 0 N\"\npoint = \"1, 0, 0 m\""),
            "acts at the node; remove `point`",
        ),
        (
            end("[[wrench]]\non = \"rw.wheel\"\nforce = \"1, 0, 0 N\"\naxes = \"inertial\""),
            "in the axes of the body",
        ),
        (
            end("[[platform]]\nname = \"iso\"\nmass = \"1 kg\"\ninertia = \"1, 1, 1 g m^2\""),
            "`platform.iso.node` is missing",
        ),
        (
            end(
                "[[platform]]\nname = \"iso\"\nmass = \"1 kg\"\ninertia = \"1, 1, 1 g m^2\"\nnode = \"rot\"",
            ),
            "no node of the structure is named `rot`",
        ),
        (
            end(
                "[[platform]]\nname = \"iso\"\nmass = \"1 kg\"\ninertia = \"1, 1, 1 g m^2\"\nnode = [\"tip\", \"root\"]",
            ),
            "2 nodes for a platform",
        ),
        (
            with("node = \"tip\"\nmount", "on = \"iso\"\nnode = \"tip\"\nmount"),
            "a device on `iso` has the node of `iso`",
        ),
    ];
    for (text, part) in cases {
        let shown = said(&text);
        assert!(shown.contains(part), "{part} in\n{shown}\nof\n{text}");
    }
}

#[test]
fn a_file_that_is_missing_or_none_is_an_error_of_its_key() {
    let of_file = |keys: &str, hub: &str| {
        format!("format = 1\n[hub]\n{hub}\n[structure]\n{keys}\n[run]\nduration = \"1 s\"\n")
    };
    let modes = "file = \"imaging-satellite-modes.npz\"";
    assert_eq!(said(&of_file(modes, "mode = \"free\"")), "");
    let shown = said(&of_file("file = \"no.npz\"", "mode = \"free\""));
    assert!(shown.contains("no.npz") && shown.contains("test.toml:5"), "{shown}");
    let shown = said(&of_file("file = \"known-nutation.toml\"", "mode = \"free\""));
    assert!(shown.contains("`file` is missing"), "{shown}");
    let shown = said(&of_file("", "mode = \"free\""));
    assert!(shown.contains("`structure.file` is missing"), "{shown}");
    // A hub of another mass than the file's.
    let shown = said(&of_file(modes, "mass = \"800 kg\"\ninertia = \"400, 400, 400 kg m^2\""));
    assert!(shown.contains("make them agree, or leave the hub's to the file"), "{shown}");
    // A node without a structure.
    let text = "format = 1\n[hub]\nmass = \"9 kg\"\ninertia = \"1, 1, 1 kg m^2\"\n\
                [[device]]\nname = \"tank\"\nkind = \"slosh_mass\"\nnode = \"tip\"\n\
                slosh_mass = { mass = \"1 kg\" }\n[run]\nduration = \"1 s\"\n";
    assert!(said(text).contains("a rigid hub has no nodes"), "{}", said(text));
}
