//! Fits of wheels on a table that believed what they were given: speeds of long records, wrong axes, rates and speeds,
//! modes that nothing determines, a record that is listed twice.
#![expect(clippy::cast_precision_loss, reason = "counts of samples, and integers of 53 bits")]

use std::f64::consts::TAU;
use std::fmt::Write as _;
use std::fs;
use std::path::{Path, PathBuf};

use precess::fit::{Discrepancy, Estimate, FitError, Fitted, Measurement, Options, Record, fit};

use super::{CommandResult, folder, precess};

/// Static imbalance, kg m, dynamic imbalance, kg m², its phase, rad, and the second harmonic, kg m.
const U_S: f64 = 5e-7;
const U_D: f64 = 2e-9;
const PHASE: f64 = 30.0 * TAU / 360.0;
const SECOND: f64 = 2e-8;
/// Height of the wheel's centre above the table's origin, m.
const HEIGHT: f64 = 0.05;

/// `SplitMix64`, and Box and Muller's normal numbers.
struct Random(u64);

impl Random {
    fn uniform(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) >> 11) as f64 / (1_u64 << 53) as f64
    }

    fn normal(&mut self) -> f64 {
        let radius = (-2.0 * (1.0 - self.uniform()).ln()).sqrt();
        radius * (TAU * self.uniform()).cos()
    }
}

fn rpm(speed: f64) -> f64 {
    speed * TAU / 60.0
}

/// The speeds that are stated, rpm.
fn speeds() -> Vec<f64> {
    (0..10).map(|k| 1000.0 + 4600.0 * f64::from(k) / 9.0).collect()
}

/// Ten records of a wheel whose spin axis is the table's z, two seconds at 2 kHz each, at speeds within 0.01 %.
fn write_records(folder: &Path) {
    let mut random = Random(1);
    for (k, speed) in speeds().into_iter().enumerate() {
        let spin = rpm(speed) * (1.0 + 1e-4 * random.normal());
        let [start, second] = [(); 2].map(|()| TAU * random.uniform());
        let mut text = String::from("fx,fy,fz,tx,ty,tz\n");
        for index in 0..4000 {
            let angle = start + spin * f64::from(index) / 2000.0;
            let square = spin * spin;
            let [fx, fy] = [0.0, 0.25 * TAU].map(|axis| {
                U_S * square * (angle - axis).cos()
                    + SECOND * square * (2.0 * angle + second - axis).cos()
            });
            let [mx, my] =
                [0.0, 0.25 * TAU].map(|axis| U_D * square * (angle + PHASE - axis).cos());
            // r x F with r along z.
            let moment = [mx - HEIGHT * fy, my + HEIGHT * fx, 0.0];
            let mut sample = |value: f64, deviation: f64| value + deviation * random.normal();
            let force = [fx, fy, 0.0].map(|f| sample(f, 1e-3));
            let moment = moment.map(|m| sample(m, 2e-5));
            let all: Vec<String> =
                force.iter().chain(&moment).map(|value| format!("{value:.9e}")).collect();
            let _ = writeln!(text, "{}", all.join(","));
        }
        fs::write(folder.join(format!("step{k}.csv")), text).expect("a file");
    }
}

/// The description of these records: the text before the table, the spin axis, and speeds with their unit.
fn description(keys: &str, axis: &str, speed: impl Fn(usize, f64) -> String) -> String {
    let mut text = format!(
        "format = 1\nname = \"rw\"\n{keys}[table]\nposition = \"0, 0, 5 cm\"\nspin_axis = {axis}\n\
         reads = \"on_table\"\n[columns]\nforce = [\"fx\", \"fy\", \"fz\"]\n"
    );
    for (k, stated) in speeds().into_iter().enumerate() {
        let stated = speed(k, stated);
        let _ = write!(text, "[[record]]\nfile = \"step{k}.csv\"\nspeed = \"{stated}\"\n");
    }
    text
}

const RATE: &str = "rate = \"2 kHz\"\n";
const AXIS: &str = "[0, 0, 1]";

fn as_it_is(_: usize, stated: f64) -> String {
    format!("{stated} rpm")
}

/// Fits a description into a folder `out` of its own.
fn fitted(folder: &Path, name: &str, description: &str) -> (CommandResult, PathBuf) {
    let file = folder.join(format!("{name}.toml"));
    fs::write(&file, description).expect("a file");
    let out = folder.join(name);
    let arguments = ["fit", file.to_str().expect("text"), "--out", out.to_str().expect("text")];
    (precess(&arguments), out)
}

/// Value and ends of the interval in a row of the table that `fit` prints.
fn row(shown: &str, name: &str) -> [f64; 3] {
    let line = shown.lines().find(|line| line.starts_with(name)).expect(name);
    let rest = line.strip_prefix(name).expect("the start");
    let mut numbers = rest.split_whitespace().map(|word| word.parse().expect("a number"));
    std::array::from_fn(|_| numbers.next().expect("three numbers"))
}

#[test]
#[ignore = "long: `cargo xtask test --all`"]
fn what_the_model_does_not_explain_is_a_failure_without_a_device() {
    let folder = folder("fit-wrong");
    write_records(&folder);
    let (ended, out) = fitted(&folder, "right", &description(RATE, AXIS, as_it_is));
    assert_eq!(ended.code, Some(0), "{}{}", ended.out, ended.error);
    let [value, low, high] = row(&ended.out, "U_s");
    assert!(low <= 0.05 && 0.05 <= high && (value / 0.05 - 1.0).abs() < 1e-3, "{}", ended.out);
    assert!(!ended.out.contains("does not"), "{}", ended.out);
    assert!(out.join("rw-device.toml").exists() && out.join("rw-sources.toml").exists());
    let stated = "[[harmonic]]\nnumber = 2\n";
    let twice = |_: usize, stated: f64| format!("{} rpm", 2.0 * stated);
    let half = |_: usize, stated: f64| format!("{} rpm", 0.5 * stated);
    let radians = |_: usize, stated: f64| format!("{stated} rad/s");
    let one_backward =
        |k: usize, stated: f64| format!("{} rpm", if k == 0 { -stated } else { stated });
    let backward = |_: usize, stated: f64| format!("{} rpm", -stated);
    let slow = "rate = \"1 kHz\"\n";
    for (name, text, part) in [
        ("axis", description(RATE, "[1, 0, 0]", as_it_is), "axial force: a line at h = 1"),
        ("tilted", description(RATE, "[1, 0, 3]", as_it_is), "check `table.spin_axis`"),
        ("rate", description(slow, AXIS, as_it_is), "the true rate 2.000 times the stated"),
        (
            "rate-stated",
            description(slow, AXIS, as_it_is) + stated,
            "a line that is not fitted, h = 0.50",
        ),
        ("twice", description(RATE, AXIS, twice), "the true speeds are 0.500 times"),
        ("half", description(RATE, AXIS, half), "the true speeds are 2.000 times"),
        ("half-stated", description(RATE, AXIS, half) + stated, "2.000 times the stated ones"),
        ("unit", description(RATE, AXIS, radians), "times the stated ones"),
        ("sign", description(RATE, AXIS, one_backward), "h = 1.0000 in step0.csv"),
        ("backward", description(RATE, AXIS, backward), "radial force, backward: a line at h = 1"),
    ] {
        let (ended, out) = fitted(&folder, name, &text);
        assert_eq!(ended.code, Some(2), "{name}: {}{}", ended.out, ended.error);
        assert!(ended.out.contains(part), "{name}: {}", ended.out);
        assert!(ended.out.contains("no device and no sources are written"), "{name}");
        for file in ["rw-device.toml", "rw-sources.toml"] {
            assert!(!out.join(file).exists(), "{name}: {file}");
        }
        let page = fs::read_to_string(out.join("rw-fit.html")).expect("a page");
        assert!(page.contains("The model does not hold"), "{name}");
    }
    // Where the wheel has such lines, that is stated, and they are among the sources.
    let keys = format!("{RATE}compare_with_imbalance = false\n");
    let (ended, out) = fitted(&folder, "accepted", &description(&keys, "[1, 0, 0]", as_it_is));
    assert_eq!(ended.code, Some(0), "{}{}", ended.out, ended.error);
    let sources = fs::read_to_string(out.join("rw-sources.toml")).expect("sources");
    let mut first = sources.split("number = 1.0  #").skip(1);
    let [forward, backward] = std::array::from_fn(|_| first.next().unwrap_or_default());
    assert!(forward.contains("axial_force") && backward.contains("force_y"), "{sources}");
}

#[test]
#[ignore = "long: `cargo xtask test --all`"]
fn what_is_not_determined_is_refused() {
    let folder = folder("fit-undetermined");
    write_records(&folder);
    // No line is near this mode of the moments, and h = 1 does not separate frequency and inertia ratio.
    let mode = "[[mode]]\nof = \"radial_torque\"\nfrequency = \"700 Hz\"\n";
    let (ended, _) = fitted(&folder, "mode", &(description(RATE, AXIS, as_it_is) + mode));
    assert_eq!(ended.code, Some(1), "{}", ended.out);
    assert!(
        ended.error.contains("radial torque: the lines do not determine the"),
        "{}",
        ended.error
    );
    // No line is in the band.
    let (ended, _) = fitted(
        &folder,
        "band",
        &(description("rate = \"30 Hz\"\n", AXIS, as_it_is) + "[[harmonic]]\nnumber = 0.1\n"),
    );
    assert_eq!(ended.code, Some(1), "{}", ended.out);
    assert!(ended.error.contains("no record shows h = 1"), "{}", ended.error);
    // One record twice, by its name and by a copy.
    let text = description(RATE, AXIS, as_it_is);
    fs::copy(folder.join("step3.csv"), folder.join("copy.csv")).expect("a copy");
    for file in ["step3.csv", "copy.csv"] {
        let again = format!("[[record]]\nfile = \"{file}\"\nspeed = \"2600 rpm\"\n");
        let (ended, _) = fitted(&folder, "again", &format!("{text}{again}"));
        assert_eq!(ended.code, Some(1), "{}", ended.out);
        let part = format!("{file} (number 11): the same samples as step3.csv (number 4)");
        assert!(ended.error.contains(&part), "{}", ended.error);
    }
}

/// Records in the wheel's axes at some speeds, rpm, stated `share` too low, of so many seconds; by Omega the drift over a
/// record.
fn long_records(seconds: f64, [share, drift]: [f64; 2], random: &mut Random) -> Measurement {
    const RATE: f64 = 100.0;
    const FORCE: f64 = 1.8e-6;
    let records = [600.0, 1200.0, 1800.0, 2400.0].map(|stated| {
        let spin = rpm(stated) * (1.0 + share);
        let count = (seconds * RATE).round();
        let mut channels: [Vec<f64>; 6] = Default::default();
        let start = TAU * random.uniform();
        let mut index = 0.0;
        while index < count {
            let t = (index - 0.5 * (count - 1.0)) / RATE;
            let angle = start + spin * t * (1.0 + 0.5 * drift * t / seconds);
            for (k, channel) in channels.iter_mut().enumerate() {
                let value = match k {
                    1 => FORCE * spin * spin * angle.cos(),
                    2 => FORCE * spin * spin * angle.sin(),
                    _ => 0.0,
                };
                let deviation = if k < 3 { 1e-2 } else { 1e-3 };
                channel.push(value + deviation * random.normal());
            }
            index += 1.0;
        }
        Record {
            name: format!("{stated} rpm"),
            rate: RATE,
            speed: rpm(stated),
            drift: 0.0,
            pulses: Vec::new(),
            channels,
        }
    });
    Measurement { records: records.to_vec() }
}

/// Four standard deviations by half of a 95 % interval.
const FAR: f64 = 2.1;

fn near(found: &Estimate, put_in: f64) -> bool {
    let half = 0.5 * (found.interval[1] - found.interval[0]);
    half < 0.03 * put_in && (found.value - put_in).abs() < FAR * half
}

fn fit_found(measurement: &Measurement, options: &Options) -> Fitted {
    fit(measurement, options).expect("it fits")
}

#[test]
#[ignore = "long: `cargo xtask test --all`"]
fn speeds_are_found_in_records_of_any_number_of_turns() {
    // From 100 to 24,000 turns: up to 24 bins for one standard deviation of the speeds.
    let mut random = Random(20_261_126);
    for seconds in [10.0, 60.0, 600.0] {
        let each = [[2e-4, 0.0], [-1e-3, 5e-4], [2.5e-3, -2e-3]];
        for errors in each.into_iter().skip(if seconds > 100.0 { 2 } else { 0 }) {
            let measurement = long_records(seconds, errors, &mut random);
            let found = fit_found(&measurement, &Options::default());
            assert!(found.holds(), "{seconds} s, {errors:?}: {:?}", found.discrepancies);
            assert_eq!(found.harmonics.len(), 1, "{seconds} s: {:?}", found.harmonics);
            let u_s = found.imbalance.u_s;
            assert!(near(&u_s, 1.8e-6), "{seconds} s, {errors:?}: {u_s:?}");
            for (rotation, record) in found.rotations.iter().zip(&measurement.records) {
                let put_in = record.speed * (1.0 + errors[0]);
                // A twentieth of a bin: the shortest records are the noisiest.
                let bin = TAU / seconds;
                let off = (rotation.speed - put_in).abs() / bin;
                assert!(off < 0.05, "{seconds} s, {errors:?}: {off} bins");
            }
        }
    }
    // Where that takes too many trials, a part of each record is searched first.
    let options = Options { speed_accuracy: 0.05, ..Options::default() };
    let measurement = long_records(600.0, [0.1, 1e-3], &mut random);
    let u_s = fit_found(&measurement, &options).imbalance.u_s;
    assert!(near(&u_s, 1.8e-6), "{u_s:?}");
    // A record of noise has no speed: it is said to take no part.
    let mut measurement = long_records(300.0, [2e-4, 0.0], &mut random);
    for sample in measurement.records[2].channels.iter_mut().flatten() {
        *sample = 1e-2 * random.normal();
    }
    let found = fit_found(&measurement, &Options::default());
    let lost = Discrepancy::Lost { records: vec!["1800 rpm".to_owned()], of: 4 };
    assert!(found.holds() && found.discrepancies.contains(&lost), "{:?}", found.discrepancies);
    assert!(near(&found.imbalance.u_s, 1.8e-6), "{:?}", found.imbalance.u_s);
    // Where one record is left, there is no model, and the reason is the speeds.
    for record in &mut measurement.records[1..] {
        record.channels.iter_mut().flatten().for_each(|sample| *sample = 1e-2 * random.normal());
    }
    let options = Options { harmonics: vec![1.0], ..Options::default() };
    let found = fit(&measurement, &options);
    assert!(matches!(found, Err(FitError::Lost { lost: 3, of: 4 })), "{found:?}");
    // Pure noise has no line and no speed.
    for record in &mut measurement.records {
        record.channels.iter_mut().flatten().for_each(|sample| *sample = random.normal());
    }
    let found = fit(&measurement, &Options::default());
    assert!(matches!(found, Err(FitError::NoLines { .. })), "{found:?}");
}

#[test]
fn a_speed_beyond_a_third_of_a_bin_is_no_reason_for_a_wrong_imbalance() {
    // As it was sent in: sixty seconds, speeds 0.02 % off, no index, no modes; the truth is 0.18 g cm.
    let folder = folder("fit-long");
    let measurement = long_records(60.0, [2e-4, 0.0], &mut Random(1));
    let mut text = String::from(
        "format = 1\nname = \"rw\"\nrate = \"100 Hz\"\nfind_modes = false\n[columns]\n[table]\n\
         position = \"0, 0, 0 m\"\nspin_axis = [1, 0, 0]\nreference = [0, 1, 0]\n",
    );
    for (k, record) in measurement.records.iter().enumerate() {
        let mut csv = String::from("fx,fy,fz,tx,ty,tz\n");
        for index in 0..record.length() {
            let row = record.channels.each_ref().map(|channel| format!("{:.5e}", channel[index]));
            let _ = writeln!(csv, "{}", row.join(","));
        }
        fs::write(folder.join(format!("s{k}.csv")), csv).expect("a file");
        let _ = write!(text, "[[record]]\nfile = \"s{k}.csv\"\nspeed = \"{}\"\n", record.name);
    }
    let (ended, _) = fitted(&folder, "long", &text);
    assert_eq!(ended.code, Some(0), "{}{}", ended.out, ended.error);
    let [value, low, high] = row(&ended.out, "U_s");
    assert!(low <= 0.18 && 0.18 <= high && (value / 0.18 - 1.0).abs() < 0.01, "{}", ended.out);
    assert!(!ended.out.contains("harmonic"), "false lines: {}", ended.out);
}
