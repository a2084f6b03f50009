//! Numbers at the ends of what a number can be, in every key: an error with a message, or a run and its report.

use std::fs;
use std::ops::ControlFlow;
use std::path::Path;

use precess::engine::run;
use precess::file::{from_toml, to_toml};
use precess::record::End;
use precess::report::Report;

use super::{folder, precess};

/// A bit of everything that has numbers.
const SCENARIO: &str = r#"format = 1
[hub]
mass = "50 kg"
inertia = "9, 8, 7 kg m^2"
[gravity]
central = "3.986e14 m^3/s^2"
[initial]
position = "7e6, 0, 0 m"
velocity = "0, 7500, 0 m/s"
angular_velocity = "0.1, 0.2, 0.3 deg/s"
[[device]]
name = "rw"
kind = "reaction_wheel"
position = "5, 0, 0 cm"
imbalance = { static = "0.1 g cm", dynamic = "1 g cm^2" }
wheel = { mass = "1 kg", inertia = "2, 1, 1 g m^2", rate = "3000 rpm", damping = "1 mN m s/rad", coulomb = "1 mN m", coulomb_rate = "1 rad/s" }
[[device]]
name = "p"
kind = "hinged_panel"
panel = { mass = "1 kg", inertia = "0.01, 0.02, 0.02 kg m^2", centre_of_mass = "10, 0, 0 cm", stiffness = "1 N m/rad", angle = "1 deg", lower_stop = "-30 deg" }
[[device]]
name = "s"
kind = "slosh_mass"
slosh_mass = { mass = "1 kg", stiffness = "10 N/m", damping = "0.1 N s/m", force = { sine = "1 mN", frequency = "5 Hz" } }
[[platform]]
name = "iso"
mass = "2 kg"
inertia = "0.1, 0.1, 0.1 kg m^2"
x_slide = { stiffness = "100 N/m", damping = "1 N s/m" }
z_turn = { torque = { ramp = "0, 1 mN m", from = "1 ms", to = "3 ms" } }
[[wrench]]
on = "hub"
force.x = { chirp = "1 mN", frequency = "1, 50 Hz", from = "0 s", to = "4 ms" }
point = "0, 0, 10 cm"
[[source]]
name = "tones"
on = "rw"
seed = 1
harmonic = [{ number = 2.5, radial_force = "1 g mm" }]
[[source]]
name = "noise"
on = "hub"
seed = 2
broadband = { band = "10, 200 Hz", period = "1 s", force_x = "1e-9 N^2/Hz" }
[[at]]
time = "2 ms"
joint = "rw.wheel"
torque = "1 mN m"
[[crossing]]
column = "rw.spin"
value = "2000 rpm"
[[requirement]]
name = "peak"
quantity = "omega"
statistic = "peak"
limit = "1 deg/s"
[run]
duration = "5 ms"
[output]
rate = "10 kHz"
"#;

/// Numbers at the ends, and beyond what a run can follow.
const NUMBERS: [&str; 6] = ["1e300", "-1e300", "1e-310", "3e307", "1e18", "0"];
/// Steps of a run: those that follow find nothing new.
const STEPS: u32 = 60;

/// The places of the numbers of a line.
fn numbers(line: &str) -> Vec<std::ops::Range<usize>> {
    let Some(start) = line.find(" = ") else { return Vec::new() };
    let is_part = |c: char| c.is_ascii_digit() || "+-.e".contains(c);
    let mut found = Vec::new();
    let mut at = start + 3;
    while let Some(offset) = line[at..].find(|c: char| c.is_ascii_digit() || c == '-') {
        let from = at + offset;
        let length = line[from..].find(|c| !is_part(c)).unwrap_or(line.len() - from);
        // Not a digit of a name or of an exponent: `omega_1`, `m^2`.
        let before = line[..from].chars().next_back();
        if before.is_none_or(|c| " \"[".contains(c))
            && line[from..from + length].parse::<f64>().is_ok()
        {
            found.push(from..from + length);
        }
        at = from + length.max(1);
    }
    found
}

#[test]
#[ignore = "long: `cargo xtask test --all`"]
fn every_finite_number_in_every_key_is_an_error_or_a_run_with_its_report() {
    let read = from_toml("extremes", SCENARIO, Path::new(""));
    let (scenario, _) = read.unwrap_or_else(|errors| panic!("{errors}"));
    let filled = to_toml(&scenario);
    let lines: Vec<&str> = filled.lines().collect();
    let mut wrong = Vec::new();
    let (mut refused, mut failed, mut complete) = (0, 0, 0);
    for (index, line) in lines.iter().enumerate() {
        // One number of each key: of a vector the first.
        let Some(place) = numbers(line).into_iter().next() else { continue };
        for number in NUMBERS {
            let changed = format!("{}{number}{}", &line[..place.start], &line[place.end..]);
            let mut lines = lines.clone();
            lines[index] = &changed;
            let message = match from_toml("extremes", &lines.join("\n"), Path::new("")) {
                Err(errors) => {
                    refused += 1;
                    let each = errors.all.iter().flat_map(|of| [of.message.as_str(), &of.help]);
                    each.collect::<Vec<_>>().join("\n")
                }
                Ok((scenario, _)) => {
                    let mut report = Report::new(&scenario, &[]);
                    let mut steps = 0;
                    let ended = run(&scenario, &mut report, &mut |_| {
                        steps += 1;
                        if steps < STEPS {
                            ControlFlow::Continue(())
                        } else {
                            ControlFlow::Break(())
                        }
                    });
                    match ended {
                        Err(error) => {
                            failed += 1;
                            error.to_string()
                        }
                        Ok(outcome) => {
                            let page = report.html(&outcome);
                            assert!(page.is_ok(), "{changed}: {:?}", page.err());
                            assert!(report.figures().is_ok(), "{changed}");
                            complete += 1;
                            match &outcome.end {
                                End::Failed(error) => error.to_string(),
                                _ => String::new(),
                            }
                        }
                    }
                }
            };
            // No number is written in more digits than it has.
            let longest = message.split(|c: char| !c.is_ascii_digit()).map(str::len).max();
            if message.contains("fault of the program") || longest.unwrap_or(0) > 40 {
                wrong.push(format!("{changed}: {message}"));
            }
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
    println!("{refused} refused, {failed} failed, {complete} complete");
    assert!(
        refused > 50 && complete > 200,
        "{refused} refused, {failed} failed, {complete} complete"
    );
}

/// Where the square of a distance is no number, and where a distance is zero: what is printed are numbers.
#[test]
fn what_is_printed_far_from_the_origin_and_at_it_are_numbers() {
    let folder = folder("far");
    let path = |name: &str| folder.join(name).to_str().expect("text").to_owned();
    let hub = "format = 1\n[hub]\nmass = \"100 kg\"\ncentre_of_mass = \"1, 0, 0 cm\"\n\
        inertia = \"9, 8, 7 kg m^2\"\n[run]\nduration = \"0.1 s\"\n";
    let moving = "velocity = \"1, 2, 3 mm/s\"\nangular_velocity = \"0.1, 0, 0.2 rad/s\"\n";
    for (name, keys, code) in [
        ("far.toml", format!("[initial]\nposition = \"1e200, 0, 0 m\"\n{moving}"), 0),
        ("centre.toml", "[gravity]\ncentral = \"4e14 m^3/s^2\"\n".to_owned(), 1),
    ] {
        fs::write(path(name), format!("{hub}{keys}")).expect("a file");
        let checked = precess(&["check", &path(name)]);
        let ran = precess(&["run", &path(name), "--out", &path("out")]);
        assert_eq!([checked.code, ran.code], [Some(code); 2], "{}", ran.error);
        for text in [&checked.out, &checked.error, &ran.out, &ran.error] {
            let is_none = |word: &str| ["NaN", "inf", "-inf"].contains(&word);
            assert!(!text.split([' ', ',', '\n']).any(is_none), "{name}: {text}");
        }
    }
}
