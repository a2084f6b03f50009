//! Where sources act: mounts, bodies, axes, platforms and structures, each against the same wrench given
//! in another way.

use precess::record::Samples;

use super::{WHEEL, last, ran, read, read_back};

/// Of motions of order one after some hundred steps at tolerance 1e-13.
const MOTION: f64 = 1e-12;

const STATE: [&str; 8] = [
    "position_x",
    "position_y",
    "position_z",
    "omega_x",
    "omega_y",
    "omega_z",
    "rw.spin",
    "rw.theta",
];

/// A record with a constant force and moment along the axes of the data sheet.
fn constant(keys: &str) -> String {
    format!(
        "[[source]]\nname = \"push\"\n{keys}\n[source.record]\ntimes = \"0, 20 s\"\n\
         force_x = \"1, 1 N\"\nforce_y = \"-2, -2 N\"\nforce_z = \"3, 3 N\"\n\
         moment_x = \"0.1, 0.1 N m\"\nmoment_y = \"0.2, 0.2 N m\"\nmoment_z = \"-0.3, -0.3 N m\"\n\
         interpolation = \"linear\"\n"
    )
}

fn wrench(on: &str, keys: &str) -> String {
    format!("[[wrench]]\non = \"{on}\"\n{keys}\n")
}

fn compare(what: &str, one: &str, other: &str, columns: &[&str]) {
    let end = |text: &str| -> Samples {
        read_back(text);
        let (outcome, samples) = ran(&read(text));
        assert!(
            outcome.drift.energy.is_some_and(|drift| drift < 1e-9),
            "{what}: {:?}",
            outcome.drift
        );
        samples
    };
    let (one, other) = (end(one), end(other));
    for name in columns {
        let (a, b) = (last(&one, name), last(&other, name));
        println!("{what}: {name} {a} {b}");
        assert!((a - b).abs() <= MOTION * a.abs().max(1.0), "{what}: {name} {a} {b}");
    }
    assert!(columns.iter().any(|name| last(&one, name).abs() > 1e-6), "{what}: nothing moves");
}

fn wheel(keys: &str) -> String {
    WHEEL
        .replace("[device.wheel]", &format!("{keys}\n[device.wheel]"))
        .replace("\"10 s\"", "\"1 s\"")
}

/// Mount turned by 90 deg about B's z: axes of the device are `b_y, -b_x, b_z`; of the sheet, z is the device's
/// x, x its y and y its z: `b_y` is z, `-b_x` is x, `b_z` is y.
#[test]
fn a_source_at_a_mount_is_the_wrench_on_the_hub_there() {
    let base =
        wheel("position = \"10, 20, -30 cm\"\nmount = { axis = [0, 0, 1], angle = \"90 deg\" }");
    let source = constant("on = \"rw\"\nspin_axis = \"z\"\npoint = \"5, 0, 0 cm\"");
    // The point, 5 cm along the device's x: b_y.
    let same = wrench(
        "hub",
        "force = \"-1, 3, -2 N\"\nmoment = \"-0.1, -0.3, 0.2 N m\"\npoint = \"10, 25, -30 cm\"",
    );
    compare("mount", &format!("{base}{source}"), &format!("{base}{same}"), &STATE);
    let source = constant(
        "on = \"hub\"\npoint = \"10, 25, -30 cm\"\nmount = { matrix = [[-1, 0, 0], [0, 0, 1], [0, 1, 0]] }",
    );
    compare("hub", &format!("{base}{source}"), &format!("{base}{same}"), &STATE);
}

/// Across a rigid bearing a force and a moment across the axis on the rotor are those on the hub; about the axis
/// the moment drives the wheel, so it is left out here.
#[test]
fn a_source_on_a_rotor_in_the_axes_of_its_bearing_is_one_at_the_mount() {
    let base = wheel("position = \"10, 20, -30 cm\"\nmount = { spin_axis = [0, 1, 0] }");
    let on = |keys: &str| {
        base.clone()
            + &constant(keys).replace("moment_x = \"0.1, 0.1 N m\"\n", "moment_x = \"0, 0 N m\"\n")
    };
    compare("bearing", &on("on = \"rw.wheel\""), &on("on = \"rw\""), &STATE);
}

/// Turning with the rotor, `(0, f, 0)` is `f (0, cos theta, sin theta)` along the axes of the bearing: a tone of
/// `h = 1` at a constant rate.
#[test]
fn a_source_in_the_axes_of_the_rotor_turns_with_it() {
    let base = wheel("position = \"0, 0, 0 cm\"")
        .replace("[device.wheel]", "[device.wheel]\nacceleration = \"0 rad/s^2\"");
    let fixed = format!(
        "{base}[[source]]\nname = \"a\"\non = \"rw.wheel\"\naxes = \"body\"\n[source.record]\n\
         times = \"0, 20 s\"\nforce_y = \"2.5, 2.5 N\"\ninterpolation = \"cubic\"\n"
    );
    let tone = format!(
        "{base}[[source]]\nname = \"a\"\non = \"rw\"\n[[source.harmonic]]\nnumber = 1\n\
         force_y = \"1 g m\"\nphase.force_y = \"90 deg\"\nforce_z = \"1 g m\"\nphase.force_z = \"0 deg\"\n"
    );
    compare("rotor", &fixed, &tone, &STATE[..6]);
}

/// A device on a platform: its mount is on the platform's body.
#[test]
fn a_source_of_a_device_on_a_platform_acts_on_the_platform() {
    let spring = "stiffness = \"900 N/m\", damping = \"4 N s/m\"";
    let turn = "stiffness = \"90 N m/rad\", damping = \"0.4 N m s/rad\"";
    let platform = format!(
        "[[platform]]\nname = \"iso\"\nmass = \"3 kg\"\ninertia = \"0.4, 0.5, 0.6 kg m^2\"\n\
         position = \"0, 0, 50 cm\"\nx_slide = {{ {spring} }}\ny_slide = {{ {spring} }}\n\
         z_slide = {{ {spring} }}\nx_turn = {{ {turn} }}\ny_turn = {{ {turn} }}\nz_turn = {{ {turn} }}\n"
    );
    let base = wheel("on = \"iso\"\nposition = \"1, 2, 3 cm\"\nmount = { spin_axis = [0, 0, 1] }");
    let base = base + &platform;
    // spin_axis [0, 0, 1]: the device's x is p_z, its y p_x, its z p_y.
    let source = constant("on = \"rw\"");
    let same = wrench(
        "iso.platform",
        "force = \"-2, 3, 1 N\"\nmoment = \"0.2, -0.3, 0.1 N m\"\npoint = \"1, 2, 3 cm\"",
    );
    let columns = ["position_x", "omega_y", "iso.x", "iso.z", "iso.alpha", "iso.gamma", "rw.spin"];
    compare("platform", &format!("{base}{source}"), &format!("{base}{same}"), &columns);
}

const BEAM: &str = "[structure]\ncontains_devices = false\n[[structure.point]]\nname = \"tip\"\n\
    [[structure.node]]\nname = \"tip\"\nposition = \"1.2, 0, 0 m\"\n\
    [[structure.mode]]\nfrequency = \"15.5 Hz\"\ndamping = 0.01\nlinear_momentum = [0, 0, 1.356]\n\
    angular_momentum = [0, -1.182, 0]\n\
    shape = [{ node = \"tip\", translation = [0, 0, 1.155], rotation = [0, -1.325, 0] }]\n";

/// On a structure the mount's axes turn with it, by some microradians here, which is what the bound allows.
#[test]
fn a_source_at_a_mount_of_a_structure_excites_its_mode() {
    let base = wheel("node = \"tip\"\nmount = { spin_axis = [1, 0, 0] }") + BEAM;
    let scale = |text: String| text.replace(" N\"", " uN\"").replace(" N m\"", " uN m\"");
    let source = scale(constant("on = \"rw\""));
    let node = scale(constant("on = \"tip\""));
    let same = scale(wrench("tip", "force = \"1, -2, 3 N\"\nmoment = \"0.1, 0.2, -0.3 N m\""));
    let end = |text: &str| {
        read_back(text);
        let (_, samples) = ran(&read(text));
        ["modes.eta_1", "modes.eta_dot_1", "tip.displacement_z"].map(|name| last(&samples, name))
    };
    let expected = end(&format!("{base}{same}"));
    for source in [source, node] {
        for (found, expected) in end(&format!("{base}{source}")).iter().zip(expected) {
            assert!((found / expected - 1.0).abs() < 1e-5, "{found} {expected}");
        }
    }
}
