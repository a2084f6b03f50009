//! What moves in an oscillation: modes, whirls of a rotor on soft bearings, nutation.

use super::{BUS, controller, loop_of, read};

/// Rounding of eigenvalues, and of a sine's argument.
const NATURAL: f64 = 1e-9;

/// A bus whose third wheel has momentum about z nutates, the other two wheels free.
#[test]
fn nutation_is_named_with_its_frequency() {
    let fast = BUS.replacen(
        "spin_axis = [0, 0, 1] }\nwheel = { mass = \"2 kg\"",
        "spin_axis = [0, 0, 1] }\nwheel = { rate = \"600 rad/s\", mass = \"2 kg\"",
        1,
    );
    assert_ne!(fast, BUS);
    let found = loop_of(&read(&format!("{fast}{}", controller(""))));
    let found = found.analysis().expect("an analysis").oscillations;
    // Transverse inertia of hub and wheels without the axial one of the free wheel on the axis.
    let [x, y] = [12.0 + 0.01 + 0.01_f64, 11.0 + 0.01 + 0.01];
    let expected = 0.02 * 600.0 / (x * y).sqrt() / std::f64::consts::TAU;
    assert_eq!(found.len(), 1, "{found:?}");
    assert_eq!(found[0].name, "nutation");
    assert!(
        (found[0].frequency / expected - 1.0).abs() < NATURAL,
        "{} {expected}",
        found[0].frequency
    );
}

/// Both whirls of a rotor that tilts on bearings, and its slides, beside the wheels of the controller.
#[test]
fn whirls_are_named_with_their_direction() {
    let soft = r#"[[device]]
name = "soft"
kind = "flexible_reaction_wheel"
mount = { spin_axis = [0, 0, 1] }
[device.axial_slide]
stiffness = "4e5 N/m"
[device.radial_slide_y]
stiffness = "2.5e5 N/m"
[device.radial_slide_z]
stiffness = "2.5e5 N/m"
[device.tilt_y]
stiffness = "1580 N m/rad"
[device.tilt_z]
stiffness = "1580 N m/rad"
[device.wheel]
mass = "4 kg"
inertia = "0.020, 0.030, 0.030 kg m^2"
rate = "3000 rpm"
"#;
    let keys = "devices = [\"rwx\", \"rwy\", \"rwz\"]";
    let found = loop_of(&read(&format!("{BUS}{soft}{}", controller(keys))));
    let found = found.analysis().expect("an analysis");
    let names: Vec<(&str, f64)> =
        found.oscillations.iter().map(|of| (of.name.as_str(), of.frequency)).collect();
    println!("{names:?}");
    let of = |part: &str| {
        let found =
            names.iter().find(|(name, _)| name.contains("soft.tilt") && name.contains(part));
        found.unwrap_or_else(|| panic!("no {part} in {names:?}")).1
    };
    let (forward, backward) = (of("forward whirl"), of("backward whirl"));
    // Of a rotor by itself w² -+ (Ia / It) W w - k / It = 0; the hub is 400 times heavier.
    let (spin, natural) = (314.159_265_358_979_3_f64 * 0.02 / 0.03, 1580.0_f64 / 0.03);
    let whirl = |sign: f64| {
        let half = sign * 0.5 * spin;
        (half + (half * half + natural).sqrt()) / std::f64::consts::TAU
    };
    assert!((forward / whirl(1.0) - 1.0).abs() < 0.01, "{forward} {}", whirl(1.0));
    assert!((backward / whirl(-1.0) - 1.0).abs() < 0.01, "{backward} {}", whirl(-1.0));
    assert!(names.iter().any(|(name, _)| *name == "soft.axial_slide"), "{names:?}");
    // Each has its pole of the closed loop.
    let named = found.poles.iter().filter(|pole| pole.oscillation.is_some()).count();
    assert!(named >= 2, "{named} of {}", found.oscillations.len());
}

#[test]
fn modes_are_named_by_their_numbers() {
    let path =
        std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../scenarios/flexible-slew.toml");
    let (scenario, _) = precess::file::from_file(&path, &[]).expect("it is read");
    let found = loop_of(&scenario).analysis().expect("an analysis");
    let names: Vec<&str> = found.oscillations.iter().map(|of| of.name.as_str()).collect();
    println!("{:?}", found.oscillations);
    assert!(names.contains(&"mode 1") && names.contains(&"mode 2"), "{names:?}");
    let first = found.oscillations.iter().position(|of| of.name == "mode 1").expect("it is there");
    assert!(found.poles.iter().any(|pole| pole.oscillation == Some(first)));
}
