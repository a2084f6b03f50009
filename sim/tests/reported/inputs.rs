//! Inputs that were refused wrongly, accepted silently, or ended in a fault. Units and extremes are in files of their own.

use std::fmt::Write as _;
use std::fs;
use std::path::Path;
use std::time::{Duration, Instant};

use clap::CommandFactory as _;
use clap::error::ErrorKind;
use precess::command::Cli;
use precess::file::{from_file, from_toml, measurement_from_toml};
use precess_dynamics::BuiltInKind;

use super::folder;

const HEAD: &str = "format = 1\n[run]\nduration = \"1 s\"\n[hub]\nmass = \"100 kg\"\ninertia = \"9, 8, 7 kg m^2\"\n";
const PANEL: &str = "[[device]]\nname = \"p\"\nkind = \"hinged_panel\"\n[device.panel]\nmass = \"1 kg\"\n\
    centre_of_mass = \"10, 0, 0 cm\"\ninertia = \"0.01, 0.01, 0.01 kg m^2\"\n";

/// What is printed of a text: errors and warnings, or nothing.
fn said(text: &str) -> String {
    match from_toml("input", text, Path::new("")) {
        Ok((_, reports)) | Err(reports) => reports.to_string(),
    }
}

/// The errors of a text; a panic where there are none.
fn refused(text: &str) -> String {
    match from_toml("input", text, Path::new("")) {
        Ok(_) => panic!("accepted:\n{text}"),
        Err(errors) => errors.to_string(),
    }
}

/// Messages with value, bound and remedy, at the place.
#[test]
fn what_is_no_spacecraft_is_said_with_its_place() {
    let hub = |inertia: &str| HEAD.replace("9, 8, 7", inertia);
    let panel = |keys: &str| format!("{HEAD}{PANEL}{keys}");
    for (text, parts) in [
        (format!("{HEAD}[[point]]\nname = \"omega\"\n"), ["`omega` names other columns", "^^^"]),
        (
            format!("{HEAD}[[point]]\nname = \"a\"\n[[point]]\nname = \"a\"\n"),
            ["two of `point` are named `a`", "^^^"],
        ),
        (format!("{HEAD}[[point]]\nname = \"a\"\non = \"rw.rim\"\n"), ["named `rw.rim`", "^^^"]),
        (hub("0, 0, 0"), ["hub of 0, 0, 0 kg m^2", "^^^"]),
        (hub("0, 8, 8"), ["has moments above zero", "^^^"]),
        (hub("inf, 8, 7"), ["`inf` is no number", "^^^"]),
        (format!("{HEAD}[gravity]\ncentral = \"-4e14 m^3/s^2\"\n"), ["of -4e14 m^3/s^2", "^^^"]),
        (HEAD.replace("1 s", "1e300 s"), ["1e300 s is outside 1e-6 s to 3.2e8 s", "^^^"]),
        (HEAD.replace("100 kg", "100 stone"), ["no such unit\n", "^^^"]),
        (
            panel("lower_stop = \"10 deg\"\nupper_stop = \"-10 deg\"\n"),
            ["is above the upper stop", "exchange them"],
        ),
        (
            format!("{HEAD}[[at]]\ntime = \"9 s\"\njoint = \"p.panel\"\nlocked = true\n{PANEL}"),
            ["`at.0.time` is 9 s", "^^^"],
        ),
    ] {
        let shown = refused(&text);
        for part in parts {
            assert!(shown.contains(part), "{part} in\n{shown}");
        }
    }
    // A point mass among devices with inertia turns with them.
    let wheel = "[[device]]\nname = \"rw\"\nkind = \"reaction_wheel\"\nposition = \"1, 1, 1 m\"\n\
                 wheel = { mass = \"1 kg\", inertia = \"2, 1, 1 g m^2\" }\n";
    assert_eq!(said(&format!("{}{wheel}", hub("0, 8, 8"))), "");
    let shown = said(&hub("1, 1, 9"));
    assert!(shown.contains("exceeds the sum of the other two by 7.0 kg m^2; no mass"), "{shown}");
}

/// Friction that sticks: its keys together, and their bounds.
#[test]
fn friction_that_cannot_be_is_said_with_its_place() {
    for (keys, parts) in [
        ("static_friction = \"9 mN m\"\n", ["`device.p.panel.coulomb` is missing", "add `coulomb"]),
        ("stribeck_rate = \"1 deg/s\"\n", ["about a `stribeck_rate`", "add `static_friction"]),
        (
            "static_friction = \"9 mN m\"\ncoulomb = \"8 mN m\"\ncoulomb_rate = \"1 deg/s\"\n",
            ["does not fall to zero at a `coulomb_rate`", "remove one of them"],
        ),
        (
            "static_friction = \"7 mN m\"\ncoulomb = \"8 mN m\"\n",
            ["0.007 N m is below the Coulomb friction of 0.008 N m", "^^^"],
        ),
        (
            "quadratic_drag = \"-1 N m s^2/rad^2\"\n",
            ["-1 N m s^2/rad^2; it is not negative", "^^^"],
        ),
        ("quadratic_drag = \"1 N m s/rad\"\n", ["where a quadratic drag", "^^^"]),
    ] {
        let shown = refused(&format!("{HEAD}{PANEL}{keys}"));
        for part in parts {
            assert!(shown.contains(part), "{part} in\n{shown}");
        }
    }
}

/// A spin axis of a measurement that is none.
#[test]
fn a_zero_axis_has_no_direction() {
    let folder = folder("axis");
    let path = folder.join("wheel.toml");
    let text = |axis: &str, reference: &str| {
        format!(
            "format = 1\nname = \"rw\"\nrate = \"1 kHz\"\n[table]\nposition = \"0, 0, 8 cm\"\nspin_axis = {axis}\n\
             reference = {reference}\n[[record]]\nfile = \"no.csv\"\nspeed = \"600 rpm\"\n"
        )
    };
    for (axis, reference) in [("[0, 0, 0]", "[1, 0, 0]"), ("[0, 0, 1]", "[0, 0, 0]")] {
        fs::write(&path, text(axis, reference)).expect("written");
        let errors = measurement_from_toml(&path, &mut |_| {}).expect_err("an error").to_string();
        assert!(errors.contains("has no direction") && !errors.contains("NaN"), "{errors}");
    }
}

/// Springs, dampers and profiles that no run can follow are named with their time, before it.
#[test]
fn what_is_too_fast_is_named_before_the_run() {
    let started = Instant::now();
    let sine = |hertz: &str| format!("torque = {{ sine = \"1 mN m\", frequency = \"{hertz}\" }}\n");
    let platform = "[[platform]]\nname = \"iso\"\nmass = \"1 kg\"\ninertia = \"1, 1, 1 kg m^2\"\n";
    for (text, parts) in [
        (
            format!("{HEAD}{PANEL}stiffness = \"1e18 N m/rad\"\n"),
            ["stiffness of `p.panel`", "1.26e-9 s"],
        ),
        (
            format!("{HEAD}{PANEL}damping = \"1e12 N m s/rad\"\n"),
            ["damping of `p.panel`", "decays within"],
        ),
        (format!("{HEAD}{PANEL}{}", sine("1e30 Hz")), ["torque on `p.panel`", "1e-30 s"]),
        (
            format!("{HEAD}{platform}x_slide.stiffness = \"1e18 N/m\"\n"),
            ["stiffness of `iso.x_slide`", "6.28e-9 s"],
        ),
        (
            format!(
                "{HEAD}{platform}coupled.stiffness.slides = [\"1e18, 0, 0 N/m\", \"0, 1, 0 N/m\", \"0, 0, 1 N/m\"]\n"
            ),
            ["stiffness of `iso.x_slide`", "6.28e-9 s"],
        ),
        (
            format!(
                "{HEAD}[[wrench]]\non = \"hub\"\nforce.x = {{ sine = \"1 N\", frequency = \"1 GHz\" }}\n"
            ),
            ["force of wrench 1 along x", "1e-9 s"],
        ),
        (
            format!("{HEAD}{PANEL}{}", sine("5 kHz"))
                .replace("[run]", "[run]\nintegrator = \"rk4\"\nstep = \"1 ms\""),
            ["torque on `p.panel`", "the step of 0.001 s is longer"],
        ),
    ] {
        let shown = refused(&text);
        for part in parts {
            assert!(shown.contains(part), "{part} in\n{shown}");
        }
        assert!(!shown.contains("tolerance"), "{shown}");
    }
    assert!(started.elapsed() < Duration::from_secs(20));
    // What a run can follow is as it was.
    for keys in ["stiffness = \"1e6 N m/rad\"\n", "damping = \"1e3 N m s/rad\"\n", &sine("1 kHz")] {
        assert_eq!(said(&format!("{HEAD}{PANEL}{keys}")), "");
    }
}

/// A file that is based twice on each of the next ones, sixteen deep.
#[test]
fn a_base_is_read_once() {
    let folder = folder("bases");
    for level in 0..15 {
        let next = level + 1;
        let text =
            format!("format = 1\nbase = [\"b{next}.toml\", \"b{next}.toml\", \"b{next}.toml\"]\n");
        fs::write(folder.join(format!("b{level}.toml")), text).expect("written");
    }
    fs::write(folder.join("b15.toml"), HEAD).expect("written");
    let started = Instant::now();
    let (scenario, _) = from_file(&folder.join("b0.toml"), &[]).expect("a scenario");
    assert!(started.elapsed() < Duration::from_secs(5), "{:?}", started.elapsed());
    assert_eq!(scenario.source.text.matches("[hub]").count(), 1);
}

/// Very many errors: linear time, and no more of them than are read.
#[test]
fn very_many_errors_are_soon_said() {
    let keys = (0..50_000).fold(String::new(), |mut text, k| {
        let _ = writeln!(text, "durat{k} = 1");
        text
    });
    let devices = (0..10_000).fold(String::new(), |mut text, k| {
        let _ = write!(text, "[[device]]\nname = \"d{k}\"\nkind = \"none\"\nmas = 1\n");
        text
    });
    for (text, more) in [
        (HEAD.replace("[run]\n", &format!("[run]\n{keys}")), "49980 more unknown keys in `run`"),
        (format!("{HEAD}{devices}"), "more errors and warnings; mend the first ones"),
    ] {
        let started = Instant::now();
        let shown = refused(&text);
        assert!(started.elapsed() < Duration::from_secs(20), "{:?}", started.elapsed());
        assert!(shown.contains(more), "{}", &shown[shown.len() - 400..]);
        assert!(shown.lines().count() < 2000);
        let errors = from_toml("input", &text, Path::new("")).expect_err("errors");
        assert!(errors.json().contains(more));
    }
}

/// Every option that is a count has a bound: a thousand million of anything is refused at once.
#[test]
fn every_count_of_the_command_line_has_a_bound() {
    fn options(command: &clap::Command, path: &[String], found: &mut Vec<(Vec<String>, String)>) {
        for argument in command.get_arguments().filter(|a| a.get_action().takes_values()) {
            if let Some(long) = argument.get_long() {
                found.push((path.to_vec(), format!("--{long}")));
            }
        }
        for below in command.get_subcommands() {
            options(below, &[path, &[below.get_name().to_owned()]].concat(), found);
        }
    }
    let mut found = Vec::new();
    options(&Cli::command(), &["precess".to_owned()], &mut found);
    let refused = |path: &[String], option: &str, value: &str| {
        let mut words = path.to_vec();
        words.extend([option.to_owned(), value.to_owned()]);
        let error = Cli::command().try_get_matches_from(words).err().map(|error| error.kind());
        matches!(error, Some(ErrorKind::InvalidValue | ErrorKind::ValueValidation))
    };
    let mut counts = Vec::new();
    for (path, option) in &found {
        let is_count = ["x", "2.5"].iter().all(|value| refused(path, option, value))
            && !refused(path, option, "2");
        // Any number names a sample of random numbers.
        if is_count && option != "--seed" {
            assert!(refused(path, option, "1000000000"), "{path:?} {option}");
            counts.push(format!("{} {option}", path.join(" ")));
        }
    }
    for known in
        ["precess jitter --threads", "precess sweep --threads", "precess montecarlo --samples"]
    {
        assert!(counts.iter().any(|count| count == known), "{counts:?}");
    }
}

/// A copy has keys of its original; an error that comes of both names `copy_of`.
#[test]
fn an_error_of_a_copy_names_its_original() {
    let wheel = "[[device]]\nname = \"a\"\nkind = \"reaction_wheel\"\nmount.spin_axis = [0, 0, 1]\n\
                 wheel = { mass = \"1 kg\", inertia = \"2, 1, 1 g m^2\", torque = \"1 mN m\" }\n";
    for keys in
        ["mount = { axis = [1, 0, 0], angle = \"90 deg\" }", "wheel.acceleration = \"1 rad/s^2\""]
    {
        let shown =
            refused(&format!("{HEAD}{wheel}[[device]]\nname = \"b\"\ncopy_of = \"a\"\n{keys}\n"));
        assert!(shown.contains("by `copy_of` it has the keys of `a`, too"), "{shown}");
    }
    let both = refused(&format!(
        "{HEAD}{wheel}[[device]]\nname = \"b\"\ncopy_of = \"a\"\nmount = {{ axis = [1, 0, 0], angle = \"90 deg\" }}\n"
    ));
    assert!(both.contains("more than one way: `axis`, `spin_axis`"), "{both}");
}

/// What a wrench may not have on a structure is underlined.
#[test]
fn a_wrench_is_refused_at_its_place() {
    let structure = "[structure]\ncontains_devices = false\n[[structure.mode]]\nfrequency = \"9 Hz\"\n\
        [[structure.mode.shape]]\nnode = \"tip\"\ntranslation = [0, 0, 1]\n\
        [[structure.node]]\nname = \"tip\"\nposition = \"0, 0, 1 m\"\n";
    let wrench = "[[wrench]]\non = \"tip\"\nforce = \"0, 0, 1 N\"\n";
    for (keys, place) in [
        (
            "[[wrench]]\non = \"tip\"\nforce = \"0, 0, 1 N\"\npoint = \"0, 0, 3 cm\"\n",
            "\"0, 0, 3 cm\"",
        ),
        ("[[wrench]]\non = \"hub\"\nforce = \"0, 0, 1 N\"\n", "\"hub\""),
    ] {
        let text = format!("{HEAD}{structure}{wrench}{keys}");
        let errors = from_toml("input", &text, Path::new("")).expect_err("an error");
        let span = errors.all[0].span.clone().unwrap_or_else(|| panic!("{errors}"));
        assert_eq!(&text[span.range], place);
    }
}

/// Of every kind the tables of links without a body may be left out: all their keys have defaults.
#[test]
fn tables_whose_keys_all_have_defaults_are_not_required() {
    let mut left_out = 0;
    for kind in BuiltInKind::ALL {
        let mut text = format!("{HEAD}[[device]]\nname = \"a\"\nkind = \"{}\"\n", kind.name());
        for joint in kind.joints() {
            let body = joint.body.replace(' ', "_");
            let has = |unit: &str| {
                let of_body = |body: Option<&str>| body == Some(joint.body);
                kind.parameters().iter().any(|of| of_body(of.body) && of.unit == unit)
            };
            if has("kg") {
                let inertia = if has("kg m²") { ", inertia = \"2, 1, 1 g m^2\"" } else { "" };
                let _ = writeln!(text, "{body} = {{ mass = \"1 kg\"{inertia} }}");
            } else {
                left_out += 1;
            }
        }
        let read = from_toml("input", &text, Path::new(""));
        assert!(read.is_ok(), "{}", read.expect_err("an error"));
    }
    assert!(left_out > 1, "{left_out}");
}

/// One tensor in four ways: its elements, its integrals, its principal moments with their axes.
#[test]
fn an_inertia_is_written_as_its_table_has_it() {
    let tensor = |keys: &str| {
        let text = HEAD.replace("inertia = \"9, 8, 7 kg m^2\"", keys);
        let (scenario, _) =
            from_toml("hub", &text, Path::new("")).unwrap_or_else(|e| panic!("{e}"));
        scenario.hub.i_b_bc
    };
    let elements =
        tensor("inertia = \"9, 8, 7 kg m^2\"\nproducts_of_inertia = \"0.5, -0.25, 0.125 kg m^2\"");
    let integrals =
        tensor("inertia = \"9, 8, 7 kg m^2\"\ninertia_integrals = \"-0.5, 0.25, -0.125 kg m^2\"");
    assert_eq!(elements, integrals);
    // Moments of 9 and 8 about axes that are turned by 30 degrees about z.
    let (sin, cos) = 30.0_f64.to_radians().sin_cos();
    let expected =
        [9.0 * cos * cos + 8.0 * sin * sin, 9.0 * sin * sin + 8.0 * cos * cos, 7.0, sin * cos];
    for axes in [
        "{ axis = [0, 0, 1], angle = \"30 deg\" }",
        "{ euler = \"30, 0, 0 deg\", sequence = \"ZYX\", direction = \"body to axes\" }",
        "{ euler = \"-30, 0, 0 deg\", sequence = \"ZYX\", direction = \"axes to body\" }",
    ] {
        let found = tensor(&format!("inertia = \"9, 8, 7 kg m^2\"\ninertia_axes = {axes}"));
        let found = [found.m11, found.m22, found.m33, found.m12];
        for (found, expected) in found.iter().zip(expected) {
            assert!((found - expected).abs() < 1e-14, "{axes}: {found} {expected}");
        }
    }
    // `check` has the moments and axes back.
    let folder = folder("principal");
    let path = folder.join("hub.toml");
    let axes =
        "inertia = \"9, 8, 7 kg m^2\"\ninertia_axes = { axis = [0, 0, 1], angle = \"30 deg\" }";
    fs::write(&path, HEAD.replace("inertia = \"9, 8, 7 kg m^2\"", axes)).expect("it is written");
    let shown = super::precess(&["check", path.to_str().expect("text")]).out;
    for part in [
        "principal moments about the centre of mass",
        "7, 8, 9 kg m^2",
        "axis of the third, B axes",
        "-0.866025, -0.5, 0",
    ] {
        assert!(shown.contains(part), "{part} in\n{shown}");
    }
    for (keys, parts) in [
        (
            "products_of_inertia = \"1, 0, 0 kg m^2\"\ninertia_integrals = \"-1, 0, 0 kg m^2\"",
            ["`products_of_inertia` and `inertia_integrals` are given", "keep one of them"],
        ),
        (
            "inertia_integrals = \"1, 0, 0 kg m^2\"\ninertia_axes = { axis = [0, 0, 1], angle = \"3 deg\" }",
            ["`inertia_integrals` and `inertia_axes` are given", "^^^"],
        ),
        ("inertia_axes = { angle = \"3 deg\" }", ["says no direction", "^^^"]),
    ] {
        let text = HEAD.replace(
            "inertia = \"9, 8, 7 kg m^2\"",
            &format!("inertia = \"9, 8, 7 kg m^2\"\n{keys}"),
        );
        let shown = refused(&text);
        for part in parts {
            assert!(shown.contains(part), "{part} in\n{shown}");
        }
    }
}
