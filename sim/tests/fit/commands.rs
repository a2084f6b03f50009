//! `precess fit` as a user runs it: the example, its device in a scenario, errors.

use std::fmt::Write as _;
use std::fs;
use std::io::Write as _;
use std::path::{Path, PathBuf};

use precess::file::{from_toml, measurement_from_toml};
use precess::fit::fit;

fn precess(arguments: &[&str]) -> (bool, String, String) {
    let mut command = std::process::Command::new(env!("CARGO_BIN_EXE_precess"));
    let output = command.args(arguments).output().expect("the command starts");
    let text = |bytes: Vec<u8>| String::from_utf8(bytes).expect("text");
    (output.status.success(), text(output.stdout), text(output.stderr))
}

fn folder(name: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
    let _ = fs::remove_dir_all(&folder);
    fs::create_dir_all(&folder).expect("a folder");
    folder
}

/// What the example's imbalance is put in as, kg m and kg m²; within the acceptance.
const PUT_IN: [f64; 2] = [1.8e-6, 2.6e-7];
const IMBALANCE: f64 = 0.02;

#[test]
#[ignore = "long: `cargo xtask test --all --for sim/src/fit`"]
fn the_example_is_fitted_and_its_device_is_read() {
    let folder = folder("fit-example");
    let at = |name: &str| folder.join(name).to_str().expect("text").to_owned();
    let (good, files, error) = precess(&["fit", "--example", &at("")]);
    assert!(good && files.contains("wheel-sweep.csv"), "{error}");
    let run = ["fit", &at("wheel-measurement.toml"), "--out", &at("out")];
    let (good, shown, error) = precess(&run);
    assert!(good && error.is_empty(), "{error}");
    for part in ["U_s", "phase of U_d", "harmonic 5.2", "mode of the radial torque", "I_s / I_r"] {
        assert!(shown.contains(part), "{part}: {shown}");
    }
    let first = fs::read_to_string(at("out/rw-device.toml")).expect("a device");
    let (good, _, error) = precess(&run);
    assert!(!good && error.contains("--force"), "{error}");
    assert!(precess(&[&run[..], &["--force"]].concat()).0);
    assert_eq!(fs::read_to_string(at("out/rw-device.toml")).expect("a device"), first);
    for group in ["axial-force", "radial-force", "axial-torque", "radial-torque"] {
        for picture in ["waterfall", "lines", "spectrum", "residuals"] {
            let name = at(&format!("out/rw-{picture}-{group}.svg"));
            let svg = fs::read_to_string(&name).expect("a picture");
            assert!(svg.contains("</svg>") && !svg.contains("NaN"), "{name}");
            // The legend of measured lines has a cross at each.
            let (_, legend) = svg.split_once("<g font-family").expect("a legend");
            let (legend, _) = legend.split_once("</g>").expect("its end");
            let (crosses, names) =
                (legend.matches("v48\"").count(), legend.matches("</text>").count());
            assert_eq!(crosses, if picture == "lines" { names } else { 0 }, "{legend}");
        }
    }
    let page = fs::read_to_string(at("out/rw-fit.html")).expect("a page");
    assert!(page.len() < 3_000_000, "{} bytes", page.len());
    for part in [
        "Parameters with 95 % intervals",
        "Residuals</h2>",
        "phase of U_d",
        "I_s / I_r",
        "The model holds",
        "above 1.5; pure noise has 1",
    ] {
        assert!(page.contains(part), "{part}");
    }
    let scenario = "format = 1\nbase = [\"rw-device.toml\", \"rw-sources.toml\"]\n[hub]\nmass = \"400 kg\"\n\
        inertia = \"120, 110, 90 kg m^2\"\n[[device]]\nname = \"rw\"\nwheel.rate = \"3000 rpm\"\n\
        [run]\nduration = \"1 s\"\n";
    let read = from_toml("a.toml", scenario, &folder.join("out"));
    let (scenario, _) = read.expect("a scenario");
    assert_eq!(scenario.members().count(), 1);
    // Harmonics on the rotor, and the noise of each group at the mount.
    assert_eq!(scenario.disturbances.len(), 5);
    assert!(first.contains("kind = \"flexible_reaction_wheel\""), "{first}");
}

#[test]
#[ignore = "long: `cargo xtask test --all --for sim/src/fit`"]
fn the_example_has_the_imbalance_that_was_put_in() {
    let folder = folder("fit-put-in");
    let at = |name: &str| folder.join(name).to_str().expect("text").to_owned();
    assert!(precess(&["fit", "--example", &at("")]).0);
    let path = folder.join("wheel-measurement.toml");
    let file = measurement_from_toml(&path, &mut |_| {}).expect("a measurement");
    assert_eq!(file.measurement.records.len(), 30);
    let fitted = fit(&file.measurement, &file.options).expect("it fits");
    let found = [fitted.imbalance.u_s.value, fitted.imbalance.u_d.value];
    for (found, put_in) in found.iter().zip(PUT_IN) {
        assert!((found / put_in - 1.0).abs() < IMBALANCE, "{found}");
    }
    // Without the index, the angle of the wheel is unknown; the phase of U_d is not.
    let text = fs::read_to_string(&path).expect("a file").replace("index = ", "# index = ");
    fs::write(&path, text).expect("a file");
    let file = measurement_from_toml(&path, &mut |_| {}).expect("a measurement");
    let fitted = fit(&file.measurement, &file.options).expect("it fits");
    assert!(fitted.imbalance.angle.is_none() && fitted.imbalance.phase.is_some());
}

#[test]
fn errors_have_their_place_and_remedy() {
    let folder = folder("fit-errors");
    let at = |name: &str| folder.join(name).to_str().expect("text").to_owned();
    let toml = "format = 1\nname = \"Wheel 1\"\nfile = \"a.csv\"\ncolour = 3\nrate = \"1 kHz\"\n\
        [table]\nposition = \"0, 0, 8 kg\"\nspin_axis = [0, 0, 1]\n[columns]\nspeed = \"n\"\n\
        speed_unit = \"Hz\"\n[[mode]]\nof = \"rocking\"\n";
    fs::write(at("m.toml"), toml).expect("a file");
    let (good, _, error) = precess(&["fit", &at("m.toml")]);
    assert!(!good);
    for part in [
        "the name is not lower-case letters, digits and underscores",
        "unknown key `colour`",
        "is a mass, where a length is wanted",
        "`Hz` is no unit of an angular rate",
        "it is one of",
        "`mode.0.frequency` is missing",
        "m.toml:7:12",
    ] {
        assert!(error.contains(part), "{part}: {error}");
    }
    let toml = "format = 1\nname = \"a\"\nfile = \"a.csv\"\nrate = \"1 kHz\"\n[table]\n\
        position = \"0, 0, 8 cm\"\nspin_axis = [0, 0, 1]\n[columns]\nspeed = \"n\"\n";
    fs::write(at("m.toml"), toml).expect("a file");
    let of = |csv: &str| {
        fs::write(at("a.csv"), csv).expect("a file");
        precess(&["fit", &at("m.toml")]).2
    };
    assert!(of("fx,fy,fz,tx,ty,n\n").contains("no column `tz`; there are fx, fy"));
    assert!(of("fx,fy,fz,tx,ty,tz,n\n1,2,3,4,5,x,7\n").contains("line 2: `x` of tz"));
    assert!(of("fx,fy,fz,tx,ty,tz,n\n1,2,3,4,5,6,7\n").contains("no stretch of 0.5 s"));
    fs::remove_file(at("a.csv")).expect("a file");
    assert!(precess(&["fit", &at("m.toml")]).2.contains("a.csv"));
    assert!(precess(&["fit", "--help"]).1.contains("Examples"));
}

/// An array of doubles in `NumPy`'s format.
fn npy(values: &[f64]) -> Vec<u8> {
    let header =
        format!("{{'descr': '<f8', 'fortran_order': False, 'shape': ({},), }}", values.len());
    let header = format!("{header:<117}\n");
    let mut bytes = b"\x93NUMPY\x01\x00".to_vec();
    bytes.extend(u16::try_from(header.len()).expect("short").to_le_bytes());
    bytes.extend(header.as_bytes());
    bytes.extend(values.iter().flat_map(|value| value.to_le_bytes()));
    bytes
}

#[test]
fn a_waterfall_is_read_row_by_row() {
    let folder = folder("fit-waterfall");
    let at = |name: &str| folder.join(name).to_str().expect("text").to_owned();
    let toml = "format = 1\nname = \"a\"\nwaterfall = \"w.csv\"\nsegments = 4\n[columns]\n\
        speed = \"n\"\nspeed_unit = \"rpm\"\nfrequency = \"f\"\nforce_unit = \"mN\"\n";
    fs::write(at("m.toml"), toml).expect("a file");
    let mut csv = String::from("n,f,fx,fy,fz,tx,ty,tz\n");
    for speed in [600, 1200, 1800] {
        for bin in 0..70 {
            let _ = writeln!(csv, "{speed},{},{bin},2,3,4,5,6", 2 * bin);
        }
    }
    fs::write(at("w.csv"), &csv).expect("a file");
    let read = || measurement_from_toml(Path::new(&at("m.toml")), &mut |_| {});
    let rows = read().expect("spectra").waterfall;
    assert_eq!((rows.len(), rows[2].bin, rows[0].densities[0].len()), (3, 2.0, 70));
    // mN² are 1e-6 N².
    assert!((rows[1].densities[0][7] - 7e-6).abs() < 1e-18 && rows[1].densities[5][7] == 6.0);
    // The same as `numpy.savez` writes it.
    let heads: Vec<&str> = csv.lines().next().expect("a heading").split(',').collect();
    let column = |k: usize| -> Vec<f64> {
        let cell = |line: &str| line.split(',').nth(k).expect("a cell").parse().expect("a number");
        csv.lines().skip(1).map(cell).collect()
    };
    let file = fs::File::create(at("w.npz")).expect("a file");
    let mut archive = zip::ZipWriter::new(file);
    let stored =
        zip::write::SimpleFileOptions::default().compression_method(zip::CompressionMethod::Stored);
    for (k, head) in heads.iter().enumerate() {
        archive.start_file(format!("{head}.npy"), stored).expect("a member");
        archive.write_all(&npy(&column(k))).expect("a member");
    }
    archive.finish().expect("an archive");
    fs::write(at("m.toml"), toml.replace("w.csv", "w.npz")).expect("a file");
    assert_eq!(read().expect("spectra").waterfall, rows);
    fs::write(at("m.toml"), toml).expect("a file");
    fs::write(at("w.csv"), csv.replace("600,4,", "600,5,")).expect("a file");
    let error = read().expect_err("an uneven step").to_string();
    assert!(error.contains("row 3 has 5 Hz, not 4 Hz"), "{error}");
    fs::write(at("m.toml"), toml.replace("[columns]", "[table]\n[columns]")).expect("a file");
    let error = read().expect_err("a table").to_string();
    assert!(error.contains("cannot be referred"), "{error}");
}
