//! What is refused, with its key and the remedy.

use super::{WHEEL, errors, ran, read};

const TONE: &str =
    "[[source.harmonic]]\nnumber = 2\nradial_force = \"1 g m\"\nphase.radial_force = \"0 deg\"\n";
const NOISE: &str =
    "seed = 1\n[source.broadband]\nband = \"1, 40 Hz\"\naxial_force = \"1e-4 N^2/Hz\"\n";
const RECORD: &str =
    "[source.record]\ntimes = \"0, 1, 2 s\"\nforce_y = \"0, 1, 2 N\"\ninterpolation = \"linear\"\n";

fn on(on: &str, rest: &str) -> String {
    format!("{WHEEL}[[source]]\nname = \"a\"\non = \"{on}\"\n{rest}")
}

fn refused(text: &str, parts: &[&str]) {
    let shown = errors(text);
    for part in parts {
        assert!(shown.contains(part), "`{part}` is not in\n{shown}\nof\n{text}");
    }
}

fn imbalanced(text: &str) -> String {
    text.replace("[device.wheel]", "imbalance.static = \"1 g cm\"\n[device.wheel]")
}

/// The wheel on flexible bearings of `soft-wheel-whirl.toml`, shortened.
fn soft(text: &str) -> String {
    let bearing = ["axial_slide", "radial_slide_y", "radial_slide_z"]
        .map(|key| format!("[device.{key}]\nstiffness = \"4e5 N/m\"\ndamping = \"50 N s/m\"\n"));
    let tilts = ["tilt_y", "tilt_z"].map(|key| {
        format!("[device.{key}]\nstiffness = \"1580 N m/rad\"\ndamping = \"1 N m s/rad\"\n")
    });
    text.replace(
        "kind = \"reaction_wheel\"\n",
        &format!("kind = \"flexible_reaction_wheel\"\n{}{}", bearing.concat(), tilts.concat()),
    )
}

#[test]
fn the_fundamental_is_refused_beside_an_imbalance() {
    for number in ["1", "0.995", "1.009"] {
        let tone = TONE.replace("number = 2", &format!("number = {number}"));
        let text = on("rw", &tone);
        // A balanced wheel has none.
        read(&text);
        refused(
            &imbalanced(&text),
            &[
                "source.a.harmonic",
                "`rw` already has",
                "within 0.01 of 1",
                "fundamental_removed = true",
            ],
        );
        read(&imbalanced(&on("rw", &format!("fundamental_removed = true\n{tone}"))));
        // Along the spin axis an imbalance exerts nothing.
        read(&imbalanced(&text.replace("radial", "axial")));
        let lumped =
            imbalanced(&text).replace("imbalance.", "imbalance_model = \"lumped\"\nimbalance.");
        refused(&lumped, &["fundamental"]);
        // Also where it acts elsewhere, but by the wheel's angle.
        refused(
            &imbalanced(&on("hub", &format!("wheel = \"rw.wheel\"\n{tone}"))),
            &["fundamental"],
        );
        // Moments, too.
        let moment = text.replace("radial_force", "radial_moment").replace("g m\"", "g m^2\"");
        refused(&imbalanced(&moment), &["fundamental"]);
    }
    read(&imbalanced(&on("rw", TONE.replace("number = 2", "number = 1.02").as_str())));
    refused(&imbalanced(&on("rw", RECORD)), &["source.a.record", "fundamental_removed = true"]);
    read(&imbalanced(&on("rw", &format!("fundamental_removed = true\n{RECORD}"))));
    read(&imbalanced(&on("rw", NOISE)));
}

#[test]
fn the_modes_of_a_soft_wheel_are_refused() {
    for model in [TONE, NOISE, RECORD] {
        let text = soft(&on("rw", model));
        refused(&text, &["source.a.modes_removed", "flexible bearings", "modes_removed = true"]);
        let text = soft(&on("rw", &format!("modes_removed = true\n{model}")));
        let text =
            text.replace("\"10 s\"", "\"20 ms\"").replace("band =", "period = \"1 s\"\nband =");
        assert!(ran(&read(&text)).0.end.is_complete());
    }
}

#[test]
fn what_a_source_refers_to_is_there() {
    refused(&on("nothing", TONE), &["no joint is named `nothing`"]);
    refused(&on("hub", TONE), &["source.a.harmonic", "wheel = \"rw.wheel\""]);
    refused(
        &on("rw", &format!("wheel = \"rw.gimbal\"\n{TONE}")),
        &["no joint is named `rw.gimbal`"],
    );
    refused(&on("rw", &format!("axes = \"body\"\n{TONE}")), &["only a body on a joint has `axes`"]);
    refused(
        &on("rw", &format!("mount = {{ axis = [0, 0, 1], angle = \"1 deg\" }}\n{TONE}")),
        &["has the axes of the device"],
    );
    refused(&on("rw", ""), &["`source.a` is given in 0 ways"]);
    refused(&on("rw", &format!("{TONE}{RECORD}")), &["given in 2 ways"]);
    refused(
        &(on("rw", TONE) + "[[source]]\nname = \"a\"\non = \"rw\"\n" + TONE),
        &["two of `source` are named `a`"],
    );
    refused(&on("rw", TONE).replace("name = \"a\"", "name = \"A b\""), &["lower-case letters"]);
    refused(&on("rw", TONE).replace("\"rw\"", "\"source_a\""), &["`source_a` names other columns"]);
}

#[test]
fn numbers_of_harmonics_are_bounded() {
    let with = |from: &str, to: &str| on("rw", &TONE.replace(from, to));
    refused(&with("number = 2", "number = 0"), &["harmonic number 0 is not above 0"]);
    refused(&with("number = 2", "number = -1"), &["not above 0"]);
    refused(&with("number = 2", "number = 1e99"), &["up to 10000"]);
    refused(&with("number = 2\n", ""), &["`source.a.harmonic.0.number` is missing"]);
    refused(&with("\"1 g m\"", "\"-1 g m\""), &["finite and not negative", "180 deg"]);
    refused(&with("\"1 g m\"", "\"1 N\""), &["amplitude of a force over the square of the rate"]);
    refused(&with("phase.radial_force = \"0 deg\"\n", ""), &["has no phase", "`seed`"]);
    refused(&with("phase.radial", "phase.axial"), &["is of no amplitude"]);
    refused(
        &with("phase.", "force_y = \"1 g m\"\nphase."),
        &["gives a component that `force_y` has given"],
    );
    let many = TONE.repeat(1001);
    refused(&on("rw", &many), &["1001 harmonics, of 1 to 1000"]);
}

#[test]
fn noise_is_bounded() {
    let with = |from: &str, to: &str| on("rw", &NOISE.replace(from, to));
    refused(&with("seed = 1\n", ""), &["need a `seed`"]);
    refused(&with("1e-4", "-1e-4"), &["finite and not negative"]);
    refused(&with("1, 40 Hz", "0, 40 Hz"), &["starts above 0 Hz"]);
    refused(&with("1, 40 Hz", "40, 1 Hz"), &["ends above that"]);
    refused(&with("1, 40 Hz", "1.01, 1.02 Hz"), &["needs a whole number of cycles"]);
    refused(&with("1, 40 Hz", "1, 1e9 Hz"), &["source.a.broadband", "131072"]);
    refused(&with("axial", "period = \"0 s\"\naxial"), &["a period of 0 s"]);
    refused(&with("axial", "frequencies = \"1, 5, 5, 40 Hz\"\naxial"), &["they grow"]);
    refused(&with("axial", "frequencies = \"1, 5 Hz\"\naxial"), &["not within the table"]);
    refused(&with("1e-4", "1e-4, 1e-5"), &["2 densities of force_x"]);
    refused(&with("axial", "reference_rate = \"0 rpm\"\naxial"), &["reference rate of 0"]);
    refused(
        &with("axial_force = \"1e-4 N^2/Hz\"\n", ""),
        &["`source.a.broadband.radial_force` is missing"],
    );
    refused(&with("1e-4 N^2/Hz", "1e-4 N/Hz"), &["a spectral density of a force"]);
    // Each by itself is within its bound; together they are not.
    let large = NOISE.replace("1, 40 Hz", "1, 13107 Hz").replace(
        "axial_force",
        "radial_force = \"1 N^2/Hz\"\nradial_moment = \"1 N^2 m^2/Hz\"\naxial_force",
    );
    refused(&on("rw", &large), &["shorten `period`", "4194304"]);
}

#[test]
fn records_are_bounded() {
    let with = |from: &str, to: &str| on("rw", &RECORD.replace(from, to));
    refused(&with("0, 1, 2 s", "0, 2, 1 s"), &["is not after that of the row before"]);
    refused(&with("0, 1, 2 s", "0, 1 s"), &["3 values of force_y for 2 rows"]);
    refused(&with("0, 1, 2 s", "0 s"), &["1 rows"]);
    refused(&with("force_y = \"0, 1, 2 N\"\n", ""), &["has no force and no moment"]);
    refused(&with("interpolation = \"linear\"\n", ""), &["interpolation` is missing"]);
    refused(&with("times", "file = \"x.csv\"\ntimes"), &["keep one of them"]);
    refused(&with("times", "force_unit = \"N\"\ntimes"), &["`force_unit` is of a file"]);
    refused(
        &(with("0, 1, 2 s", "0, 1, 2 us") + "repeats = true\n"),
        &["times in the run at which a step ends", "cubic"],
    );
    let file = "[source.record]\nfile = \"nowhere.csv\"\ninterpolation = \"cubic\"\n";
    refused(&on("rw", file), &["nowhere.csv"]);
    let endless = file.replace("nowhere.csv", "/dev/zero");
    refused(&on("rw", &endless), &["/dev/zero: more than 100000000 bytes"]);
}

#[test]
fn a_structure_has_no_hub_to_push() {
    let text = on("hub", RECORD).replace("kind =", "node = \"tip\"\nkind =")
        + "[structure]\ncontains_devices = false\n[[structure.node]]\nname = \"tip\"\n\
           position = \"0, 0, 1 m\"\n[[structure.mode]]\nfrequency = \"3 Hz\"\n";
    refused(&text, &["source.a.on", "on = \"NODE\""]);
}
