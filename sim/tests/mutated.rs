//! A thousand mutated scenario files: each is an error with a message, or starts and makes a hundred
//! steps or an error of the run. Nothing panics or hangs.

use std::fs;
use std::path::Path;

use precess::engine::{Advance, Run};
use precess::file::{from_file, from_toml};
use precess_tests::cases;

#[path = "shared/numbers.rs"]
mod numbers;

use numbers::Numbers;

impl Numbers {
    fn below(&mut self, bound: usize) -> usize {
        let number = self.next().unwrap_or_default();
        usize::try_from(number % u64::try_from(bound.max(1)).unwrap_or(1)).unwrap_or(0)
    }
}

const NUMBERS: [&str; 12] =
    ["0", "-1", "1e12", "1e308", "1e-308", "nan", "inf", "1e999", "-0.0", "0x10", "1_000", "3,4"];
const UNITS: [&str; 10] =
    ["kg", "m", "rpm", "kg m^2", "furlong", "", "s", "N m/rad", "1/", "deg/s^2"];
const LINES: [&str; 10] = [
    "[[device]]",
    "[run]",
    "format = 2",
    "mass = \"1 kg\"",
    "base = \"loop.toml\"",
    "a.b.c = 1",
    "]",
    "\u{0}",
    "rate = { sine = \"1 N m\" }",
    "device = 3",
];

/// The text with one to three mutations.
fn mutated(text: &str, numbers: &mut Numbers) -> String {
    let mut lines: Vec<String> = text.lines().map(str::to_owned).collect();
    for _ in 0..=numbers.below(3) {
        let at = numbers.below(lines.len());
        match numbers.below(8) {
            0 => drop(lines.remove(at)),
            1 => lines.insert(at, LINES[numbers.below(LINES.len())].to_owned()),
            2 => {
                let copy = lines[at].clone();
                lines.insert(at, copy);
            }
            3 => lines.truncate(at + 1),
            4 => {
                let other = numbers.below(lines.len());
                lines.swap(at, other);
            }
            5 => replace(&mut lines[at], char::is_numeric, NUMBERS[numbers.below(NUMBERS.len())]),
            6 => {
                let unit = format!(" {}\"", UNITS[numbers.below(UNITS.len())]);
                if let Some((first, _)) = lines[at].clone().rsplit_once(' ') {
                    lines[at] = first.to_owned() + &unit;
                }
            }
            _ => {
                let line = &lines[at];
                let cut = (0..=line.len()).filter(|i| line.is_char_boundary(*i));
                let cut: Vec<_> = cut.collect();
                let cut = cut[numbers.below(cut.len())];
                lines[at].truncate(cut);
            }
        }
        if lines.is_empty() {
            lines.push(String::new());
        }
    }
    lines.join("\n")
}

/// The first run of such letters becomes another text.
fn replace(line: &mut String, of: fn(char) -> bool, by: &str) {
    let Some(start) = line.find(of) else { return };
    let rest = &line[start..];
    let end = start + rest.find(|c| !of(c)).unwrap_or(rest.len());
    line.replace_range(start..end, by);
}

#[test]
fn a_mutated_file_is_an_error_or_starts() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../scenarios");
    let mut files: Vec<_> = fs::read_dir(&folder)
        .expect("scenarios")
        .filter_map(|entry| Some(entry.ok()?.path()))
        .filter(|path| path.extension().is_some_and(|extension| extension == "toml"))
        .collect();
    files.sort();
    let texts: Vec<_> = files.iter().map(|f| fs::read_to_string(f).expect("text")).collect();
    let mut numbers = Numbers(0x9e37_79b9_7f4a_7c15);
    let (mut rejected, mut started) = (0, 0);
    let cases = usize::try_from(cases(1000)).expect("few");
    for case in 0..cases {
        let text = mutated(&texts[case % texts.len()], &mut numbers);
        match from_toml("mutated.toml", &text, &folder) {
            Err(errors) => {
                assert!(!errors.to_string().trim().is_empty(), "no message:\n{text}");
                assert!(serde_json::from_str::<serde_json::Value>(&errors.json()).is_ok());
                rejected += 1;
            }
            Ok((scenario, _)) => {
                started += 1;
                let Ok(mut run) = Run::new(&scenario) else { continue };
                for _ in 0..100 {
                    match run.advance() {
                        Ok(Advance::Stepped) => {}
                        Ok(Advance::Ended) | Err(_) => break,
                    }
                }
                let state = run.state();
                assert!(state.omega.iter().all(|w| w.is_finite()), "{text}");
            }
        }
    }
    let (some, few) = (3 * cases / 10, cases / 10);
    assert!(rejected > some && started > few, "{rejected} rejected, {started} started");
}

#[test]
fn what_is_no_scenario_is_an_error_at_once() {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("odd");
    let _ = fs::remove_dir_all(&folder);
    fs::create_dir_all(&folder).expect("a folder");
    let write = |name: &str, bytes: &[u8]| {
        let path = folder.join(name);
        fs::write(&path, bytes).expect("a file");
        path
    };
    let nested = "[".repeat(100_000);
    let odd = [
        write("empty.toml", b""),
        write("binary.toml", &[0, 159, 146, 150, 255]),
        write("large.toml", "# ten megabytes of nothing\n".repeat(400_000).as_bytes()),
        write("nested.toml", format!("a = {nested}").as_bytes()),
        write("loop.toml", b"base = \"loop.toml\"\nformat = 1\n"),
        write("a.toml", b"base = \"b.toml\"\n"),
        write("b.toml", b"base = \"a.toml\"\n"),
        folder.join("missing.toml"),
        folder.clone(),
    ];
    for path in odd {
        let errors = from_file(&path, &[]).expect_err("no scenario");
        assert!(!errors.to_string().trim().is_empty(), "{}", path.display());
    }
    let many = "format = 1\n[hub]\nmass = \"1 kg\"\ninertia = \"1, 1, 1 kg m^2\"\n[run]\n\
                duration = \"1e6 s\"\n[output]\nrate = \"1e6 Hz\"\n";
    let errors = from_toml("many", many, &folder).expect_err("1e12 samples");
    assert!(errors.to_string().contains("output.rate"), "{errors}");
}
