//! Tables as other programs write them, in every place that reads one.

use std::fmt::Write as _;
use std::fs;

use super::{folder, precess};

/// How a table that one command reads is written by others.
fn dialects(rows: &str) -> Vec<(&'static str, String)> {
    vec![
        ("semicolons", rows.replace(',', ";")),
        ("tabs", rows.replace(',', "\t")),
        ("comments", format!("% by another program\n{}", rows.replacen('\n', "\n% 1, 2\n", 1))),
        ("mark", format!("\u{feff}{rows}")),
    ]
}

/// The same table in dialects that are not read, and what the error says.
fn refused(rows: &str) -> Vec<(String, &'static str)> {
    let columns = rows.lines().next().map_or(0, |line| line.split(',').count());
    let units = vec!["N"; columns].join(",");
    vec![
        (rows.replacen('\n', &format!("\n{units}\n"), 1), "row of units"),
        (rows.replace(',', ";").replace('.', ","), "decimal comma"),
        (rows.replace(',', " "), "the columns are separated by spaces"),
    ]
}

#[test]
fn tables_of_other_programs_are_read_or_their_dialect_is_named() {
    let folder = folder("tables");
    let at = |name: &str| folder.join(name).to_str().expect("text").to_owned();
    let scenario = |part: &str| {
        format!(
            "format = 1\n[hub]\nmass = \"9 kg\"\ninertia = \"1, 1, 1 kg m^2\"\n[run]\nduration = \"1 s\"\n{part}"
        )
    };
    let source = scenario(
        "[[source]]\nname = \"r\"\non = \"hub\"\n[source.record]\nfile = \"data.csv\"\n\
         columns.force_y = \"fy\"\nforce_unit = \"N\"\ninterpolation = \"linear\"\n",
    );
    let wrench = scenario(
        "[[wrench]]\non = \"hub\"\nforce.x = { table = \"data.csv\", column = \"fy\", unit = \"N\", \
         interpolation = \"linear\" }\n",
    );
    let fit_file = "format = 1\nname = \"rw\"\nfile = \"data.csv\"\nrate = \"1 kHz\"\n[table]\n\
        position = \"0, 0, 8 cm\"\nspin_axis = [0, 0, 1]\n[columns]\nspeed = \"n\"\n";
    let waterfall = "format = 1\nname = \"rw\"\nwaterfall = \"data.csv\"\nsegments = 4\n[columns]\nspeed = \"n\"\n\
        frequency = \"f\"\n";
    fs::write(at("source.toml"), source).expect("a file");
    fs::write(at("wrench.toml"), wrench).expect("a file");
    fs::write(at("fit.toml"), fit_file).expect("a file");
    fs::write(at("waterfall.toml"), waterfall).expect("a file");
    let table = "time_s,fy\n0.0,1.5\n0.5,2.5\n1.0,-1.0\n";
    let steady = "fx,fy,fz,tx,ty,tz,n\n".to_owned() + &"0.5,0.5,0.5,0.5,0.5,0.5,9.5\n".repeat(3);
    let spectra = "n,f,fx,fy,fz,tx,ty,tz\n9.5,0.0,1.5,1.5,1.5,1.5,1.5,1.5\n".to_owned();
    let mut result = String::from("time,omega_x\n");
    for index in 0..600 {
        let _ = writeln!(result, "{:.2},{}.5", f64::from(index) / 100.0, index % 7);
    }
    let cases: [(&str, Vec<String>, &str); 5] = [
        ("source", vec!["check".to_owned(), at("source.toml")], table),
        ("wrench", vec!["check".to_owned(), at("wrench.toml")], table),
        ("fit", vec!["fit".to_owned(), at("fit.toml"), "--out".to_owned(), at("out")], &steady),
        (
            "waterfall",
            vec!["fit".to_owned(), at("waterfall.toml"), "--out".to_owned(), at("out")],
            &spectra,
        ),
        (
            "spectrum",
            ["spectrum", &at("data.csv"), "--out", &at("out"), "--force"]
                .map(str::to_owned)
                .to_vec(),
            &result,
        ),
    ];
    for (name, arguments, rows) in cases {
        let ended = |text: &str| {
            fs::write(at("data.csv"), text).expect("a file");
            precess(&arguments.iter().map(String::as_str).collect::<Vec<_>>())
        };
        // Three samples are too few for a fit: then the error is that of the numbers.
        let plain = ended(rows);
        for (dialect, text) in dialects(rows) {
            let other = ended(&text);
            assert_eq!(other.code, plain.code, "{name}, {dialect}: {}", other.error);
            assert_eq!(other.out, plain.out, "{name}, {dialect}");
            assert_eq!(other.error, plain.error, "{name}, {dialect}");
        }
        for (text, part) in refused(rows) {
            let other = ended(&text);
            assert_eq!(other.code, Some(1), "{name}: {}", other.out);
            assert!(other.error.contains(part), "{name}: {part}: {}", other.error);
        }
    }
}
