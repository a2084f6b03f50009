//! Units as data sheets write them, and hertz where a rate is wanted.

use std::path::Path;

use precess::file::{from_toml, to_toml};
use precess::units::{Measure, parse_quantity};

/// Spellings of data sheets, with the measure that is wanted and the value in SI.
const READ: [(&str, Measure, f64); 31] = [
    ("0.48 g-cm", Measure::STATIC_IMBALANCE, 0.48e-5),
    ("0.48 g.cm", Measure::STATIC_IMBALANCE, 0.48e-5),
    ("0.48 gcm", Measure::STATIC_IMBALANCE, 0.48e-5),
    ("4.8 g mm", Measure::STATIC_IMBALANCE, 0.48e-5),
    ("480 mg cm", Measure::STATIC_IMBALANCE, 0.48e-5),
    ("0.48 g*cm", Measure::STATIC_IMBALANCE, 0.48e-5),
    ("0.0067 oz in", Measure::STATIC_IMBALANCE, 4.824_521_845e-6),
    ("15.4 g-cm^2", Measure::DYNAMIC_IMBALANCE, 15.4e-7),
    ("15.4 g cm2", Measure::DYNAMIC_IMBALANCE, 15.4e-7),
    ("15.4 g·cm²", Measure::DYNAMIC_IMBALANCE, 15.4e-7),
    ("15.4 gcm^2", Measure::DYNAMIC_IMBALANCE, 15.4e-7),
    ("12 Kg", Measure::MASS, 12.0),
    ("26.5 lbm", Measure::MASS, 1.202_019_781e1),
    ("0.82 slug", Measure::MASS, 1.196_700_041e1),
    ("0.159 kg-m^2", Measure::INERTIA, 0.159),
    ("0.159 kgm^2", Measure::INERTIA, 0.159),
    ("0.159 kg*m**2", Measure::INERTIA, 0.159),
    ("0.117 slug ft^2", Measure::INERTIA, 1.586_307_000e-1),
    ("543 lb in^2", Measure::INERTIA, 1.589_033_318e-1),
    ("6000 RPM", Measure::ANGULAR_RATE, 628.318_530_7),
    ("6000 rev/min", Measure::ANGULAR_RATE, 628.318_530_7),
    ("6000 r/min", Measure::ANGULAR_RATE, 628.318_530_7),
    ("628.3 rad/sec", Measure::ANGULAR_RATE, 628.3),
    ("36000 degrees/s", Measure::ANGULAR_RATE, 628.318_530_7),
    ("0.2 Nm", Measure::TORQUE, 0.2),
    ("200 mNm", Measure::TORQUE, 0.2),
    ("0.2 N-m", Measure::TORQUE, 0.2),
    ("28.3 ozf in", Measure::TORQUE, 1.998_419_163e-1),
    ("1.77 in lbf", Measure::TORQUE, 1.999_831_474e-1),
    ("8 mas", Measure::ANGLE, 3.878_509_449e-8),
    ("8 milli-arcsec", Measure::ANGLE, 3.878_509_449e-8),
];

const HEAD: &str = "format = 1\n[run]\nduration = \"1 s\"\n[hub]\nmass = \"100 kg\"\ninertia = \"9, 8, 7 kg m^2\"\n";
const WHEEL: &str = "[[device]]\nname = \"rw\"\nkind = \"reaction_wheel\"\nimbalance_model = \"balanced\"\n\
    wheel = { mass = \"1 kg\", inertia = \"2, 1, 1 g m^2\", rate = \"3000 rpm\", torque = \"1 mN m\" }\n";

fn refused(text: &str) -> String {
    match from_toml("units", text, Path::new("")) {
        Ok(_) => panic!("accepted:\n{text}"),
        Err(errors) => errors.to_string(),
    }
}

#[test]
fn data_sheets_are_read_where_they_have_one_reading() {
    for (text, measure, value) in READ {
        let found = parse_quantity(text).unwrap_or_else(|error| panic!("{text}: {}", error.kind));
        assert!(found.is(measure), "{text} is {}", found.name());
        assert!((found.values[0] / value - 1.0).abs() < 1e-7, "{text}: {:?}", found.values);
    }
}

#[test]
fn of_other_spellings_the_right_ones_are_offered() {
    let wheel = |from: &str, to: &str| {
        assert!(WHEEL.contains(from), "{from}");
        refused(&format!("{HEAD}{}", WHEEL.replace(from, to)))
    };
    for (from, to, offered) in [
        ("1 mN m", "28.3 oz in", "write `28.3 ozf in`"),
        ("1 mN m", "0.1475 ft lb", "write `0.1475 ft lbf`"),
        ("1 mN m", "0.2 NM", "write `N m` or `nm`"),
        ("3000 rpm", "50 Hz", "`50 rev/s` for turns, `50 rad/s` for radians"),
        ("3000 rpm", "3000 1/min", "`3000 rev/min` for turns, `3000 rad/min` for radians"),
        ("3000 rpm", "1 kHz", "in rev/s for turns per second, in rad/s for radians"),
        ("3000 rpm", "50 rps", "write `rev/s` or `rad/s`"),
        ("2, 1, 1 g m^2", "2, 1, 1 gm m^2", "write `g` or `g m`"),
        ("1 kg", "2 kgs", "did you mean `kg`?"),
        ("1 mN m", "0.2", "has no unit"),
    ] {
        let shown = wheel(from, to);
        assert!(shown.contains(offered), "{offered} in\n{shown}");
    }
}

/// Every component of a harmonic, whose amplitude is over the square of a rotation rate.
#[test]
fn hertz_of_a_rotation_rate_name_both_readings() {
    let source = |key: &str, unit: &str| {
        format!(
            "{HEAD}{WHEEL}[[source]]\nname = \"s\"\non = \"rw\"\nharmonic = [{{ number = 2, {key} = \"3.6e-5 {unit}\", \
             phase.{key} = \"90 deg\" }}]\n"
        )
    };
    let keys = [
        "force_x",
        "force_y",
        "force_z",
        "radial_force",
        "axial_force",
        "moment_x",
        "moment_y",
        "moment_z",
        "radial_moment",
        "axial_moment",
    ];
    for key in keys {
        let numerator = if key.contains("force") { "N" } else { "N m" };
        let shown = refused(&source(key, &format!("{numerator}/Hz^2")));
        for reading in ["(rev/s)^2", "(rad/s)^2"] {
            assert!(shown.contains(&format!("`{numerator}/{reading}`")), "{key}: {shown}");
        }
        // The table of phases beside it is no second error.
        assert_eq!(shown.matches("error:").count(), 1, "{shown}");
        // Both are read: a revolution is 2 pi.
        let amplitude = |unit: &str| {
            let read = from_toml("units", &source(key, unit), Path::new(""));
            let (scenario, _) = read.unwrap_or_else(|errors| panic!("{errors}"));
            let precess::disturbance::Model::Harmonic(tones) = &scenario.disturbances[0].model
            else {
                panic!("a tone");
            };
            tones[0].amplitudes.iter().copied().fold(0.0, f64::max)
        };
        let [turns, radians] =
            ["(rev/s)^2", "(rad/s)^2"].map(|rate| amplitude(&format!("{numerator}/{rate}")));
        assert_eq!(radians, 3.6e-5, "{key}");
        let ratio = radians / turns;
        assert!(
            (ratio / (4.0 * std::f64::consts::PI.powi(2)) - 1.0).abs() < 1e-14,
            "{key}: {ratio}"
        );
    }
}

/// Every key of every kind of device whose unit has both an angle and a time: with hertz in their place it is refused.
#[test]
fn hertz_are_refused_wherever_a_unit_has_radians_and_seconds() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../scenarios/every-kind.toml");
    let (scenario, _) =
        precess::file::from_file(&path, &[]).unwrap_or_else(|errors| panic!("{errors}"));
    let filled = to_toml(&scenario)
        + "\n[[requirement]]\nname = \"a\"\nquantity = \"omega\"\nstatistic = \"peak\"\n\
        limit = \"1.0 rad/s\"\n[[crossing]]\ncolumn = \"single_variable.spin\"\nvalue = \"1.0 rad/s\"\n";
    let lines: Vec<&str> = filled.lines().collect();
    let mut changed = std::collections::BTreeSet::new();
    for (index, line) in lines.iter().enumerate() {
        let Some((key, _)) = line.split_once(" = ") else { continue };
        for (unit, hertz) in [("rad/s\"", "Hz\""), ("rad/s^2\"", "Hz/s\""), ("s/rad\"", "/Hz\"")] {
            if !line.contains(unit) || !changed.insert(format!("{key} {unit}")) {
                continue;
            }
            let mut lines = lines.clone();
            let line = line.replace(unit, hertz);
            lines[index] = &line;
            let shown = refused(&lines.join("\n"));
            assert!(shown.contains("rad/s") || shown.contains("s/rad"), "{line}: {shown}");
        }
    }
    let keys: std::collections::BTreeSet<_> =
        changed.iter().filter_map(|of| of.split(' ').next()).collect();
    for key in ["rate", "coulomb_rate", "damping", "angular_velocity", "limit", "value"] {
        assert!(keys.contains(key), "{keys:?}");
    }
}
