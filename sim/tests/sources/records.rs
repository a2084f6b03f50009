//! Measured records: from CSV and NPZ, once and repeated, against the same force as a profile.

use std::fmt::Write as _;
use std::fs;
use std::path::Path;

use super::{WHEEL, column, errors, last, ran, read, read_back};

/// Of a metre, at tolerance 1e-13 and with steps that end where the slope of the force jumps.
const DISTANCE: f64 = 1e-12;

fn source(keys: &str) -> String {
    format!("{WHEEL}[[source]]\nname = \"r\"\non = \"hub\"\n[source.record]\n{keys}")
}

fn end(text: &str) -> f64 {
    last(&ran(&read(text)).1, "position_y")
}

#[test]
fn a_record_of_straight_lines_is_the_profile_of_its_table() {
    let record =
        "times = \"1, 2, 4, 5 s\"\nforce_y = \"1, 3, -2, 2 N\"\ninterpolation = \"linear\"\n";
    let profile = |rows: &str| {
        format!(
            "{WHEEL}[[wrench]]\non = \"hub\"\nforce.y = {{ {rows}, interpolation = \"linear\" }}\n"
        )
    };
    let once = profile(
        "times = \"1, 2, 4, 5 s\", values = \"1, 3, -2, 2 N\", from = \"1 s\", to = \"5 s\"",
    );
    let (found, expected) = (end(&source(record)), end(&once));
    assert!((found - expected).abs() < DISTANCE, "{found} {expected}");
    read_back(&source(record));
    // Repeated with a period of four seconds: back to the start, where it is within the third interval.
    let text = source(&format!("{record}repeats = true\n"));
    read_back(&text);
    let (_, samples) = ran(&read(&text));
    let force = column(&samples, "source_r.force_y");
    let at = |time: f64| {
        let index = column(&samples, "time").iter().position(|t| (t - time).abs() < 1e-9);
        force[index.expect("a sample")]
    };
    for (time, expected) in
        [(0.0, -2.0), (0.5, 0.0), (1.0, 1.0), (1.5, 2.0), (5.0, 1.0), (9.5, 2.0)]
    {
        assert!((at(time) - expected).abs() < 1e-12, "{time}: {}", at(time));
    }
}

/// A sine sampled a hundred times a period, `w s = 0.0628`. Its fundamental after interpolation is less by
/// `(w s)² / 12 = 3.29e-4` of it with straight lines, and by about `(w s)⁴ / 720 = 2e-8` with a cubic spline; and the hub
/// moves by the closed form, `x = A / (m w²) (w t - sin w t)`.
#[test]
fn a_cubic_record_is_smooth() {
    let rows: Vec<f64> = (0..=1000).map(|i| f64::from(i) / 100.0).collect();
    let list = |of: &dyn Fn(f64) -> f64| {
        rows.iter().map(|t| format!("{:?}", of(*t))).collect::<Vec<_>>().join(", ")
    };
    let w = std::f64::consts::TAU;
    let keys = |word: &str| {
        let (times, values) = (list(&|t| t), list(&|t| (w * t).sin()));
        source(&format!(
            "times = \"{times} s\"\nforce_y = \"{values} N\"\ninterpolation = \"{word}\"\n"
        ))
    };
    let exact = (w * 10.0 - (w * 10.0).sin()) / (100.0 * w * w);
    let [cubic, linear] = ["cubic", "linear"].map(|word| (end(&keys(word)) / exact - 1.0).abs());
    println!("cubic {cubic:e}, linear {linear:e}");
    let step = w / 100.0;
    assert!(cubic < 5e-8, "{cubic:e}");
    assert!((linear / (step * step / 12.0) - 1.0).abs() < 1e-3, "{linear:e}");
}

/// Written by hand, the way `numpy.savez` does.
fn npz(path: &Path, arrays: &[(&str, &[f64])]) {
    let mut archive = zip::ZipWriter::new(fs::File::create(path).expect("a file"));
    for (name, numbers) in arrays {
        let options = zip::write::SimpleFileOptions::default()
            .compression_method(zip::CompressionMethod::Stored);
        archive.start_file(format!("{name}.npy"), options).expect("a member");
        let head =
            format!("{{'descr': '<f8', 'fortran_order': False, 'shape': ({},), }}", numbers.len());
        let head = format!("{head:<117}\n");
        let mut bytes = b"\x93NUMPY\x01\x00".to_vec();
        bytes.extend(u16::try_from(head.len()).expect("short").to_le_bytes());
        bytes.extend(head.bytes());
        numbers.iter().for_each(|number| bytes.extend(number.to_le_bytes()));
        std::io::Write::write_all(&mut archive, &bytes).expect("written");
    }
    archive.finish().expect("an archive");
}

#[test]
fn a_record_is_read_from_csv_and_from_npz() {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR"));
    let (times, f, m) = ([0.0, 1.0, 3.0], [0.0, 2.0, -1.0], [5.0, 0.0, 5.0]);
    let mut text = "time_s, Fy, moment_z\n".to_owned();
    for ((time, f), m) in times.iter().zip(f).zip(m) {
        let _ = writeln!(text, "{time}, {f}, {m}");
    }
    fs::write(folder.join("sources-record.csv"), text).expect("a file");
    npz(&folder.join("sources-record.npz"), &[("time_s", &times), ("Fy", &f), ("moment_z", &m)]);
    let inline = read(&source(
        "times = \"0, 1, 3 s\"\nforce_y = \"0, 2, -1 mN\"\nmoment_z = \"5, 0, 5 N m\"\ninterpolation = \"linear\"\n",
    ));
    for file in ["csv", "npz"] {
        let text = source(&format!(
            "file = \"sources-record.{file}\"\ncolumns.force_y = \"Fy\"\nforce_unit = \"mN\"\n\
             interpolation = \"linear\"\n"
        ));
        assert_eq!(read(&text).disturbances, inline.disturbances, "{file}");
        read_back(&text);
        let missing = errors(&text.replace("\"Fy\"", "\"Fx\""));
        assert!(missing.contains("no column `Fx`; there are time_s, Fy, moment_z"), "{missing}");
    }
}

/// Longer than two thousand rows, a record is written by the name of its file.
#[test]
fn a_long_record_stays_in_its_file() {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR"));
    let mut text = "t,fx,my\n".to_owned();
    for row in 0..2001 {
        let _ = writeln!(text, "{row}e-3,{},{}", f64::from(row).sin(), f64::from(row).cos());
    }
    fs::write(folder.join("sources-long.csv"), text).expect("a file");
    let text = source(
        "file = \"sources-long.csv\"\ntime = \"t\"\ncolumns = { force_x = \"fx\", moment_y = \"my\" }\n\
         force_unit = \"uN\"\ninterpolation = \"cubic\"\n",
    );
    read_back(&text);
    let written = precess::file::to_toml(&read(&text));
    assert!(written.contains("file = \"sources-long.csv\"") && written.len() < 3000, "{written}");
}
