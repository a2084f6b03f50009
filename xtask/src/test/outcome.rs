//! What became of a suite: cases, time, and what was skipped, read from what it printed.

use std::process::Output;

/// A suite that ended.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Outcome {
    pub(crate) name: String,
    pub(crate) passed: bool,
    /// Cases that passed; none where the suite counts nothing.
    pub(crate) cases: Option<u64>,
    /// Tests that are left to `--all`.
    pub(crate) left: u64,
    /// Lines that say what was skipped and how to install it.
    pub(crate) skipped: Vec<String>,
    /// Tests that failed, and the last error that was printed.
    pub(crate) failures: Vec<String>,
    pub(crate) seconds: f64,
    /// CPU time, where the operating system tells.
    pub(crate) cpu: Option<f64>,
}

impl Outcome {
    pub(crate) fn failed(&self) -> bool {
        !self.passed
    }

    /// A suite whose program did not start.
    pub(crate) fn not_started(name: &str) -> Self {
        let name = name.to_owned();
        Self {
            name,
            passed: false,
            cases: None,
            left: 0,
            skipped: Vec::new(),
            failures: vec!["did not start".to_owned()],
            seconds: 0.0,
            cpu: None,
        }
    }

    /// A line for whoever waits.
    pub(crate) fn line(&self) -> String {
        let how = if self.passed { "passed" } else { "FAILED" };
        let cases = self.cases.map_or_else(String::new, |cases| format!(", {cases} cases"));
        let cpu = self.cpu.map_or_else(String::new, |cpu| format!(" ({cpu:.0} CPU s)"));
        format!("{how}  {}{cases}, {:.1} s{cpu}", self.name, self.seconds)
    }

    /// Reads what a suite printed.
    pub(crate) fn from_output(name: &str, output: &Output, seconds: f64, cpu: Option<f64>) -> Self {
        let text = String::from_utf8_lossy(&output.stdout)
            + "\n"
            + String::from_utf8_lossy(&output.stderr);
        let skipped = text.lines().filter_map(|line| line.strip_prefix("skipped: "));
        let passed = output.status.success();
        Self {
            name: name.to_owned(),
            passed,
            cases: cases(&text),
            left: sum(&text, " ignored"),
            skipped: skipped.map(str::to_owned).collect(),
            failures: if passed { Vec::new() } else { failures(&text) },
            seconds,
            cpu,
        }
    }
}

/// The tests that a harness of Rust or of Python names as failed, then the last error of a command.
fn failures(text: &str) -> Vec<String> {
    let test = |line: &str| match line.strip_prefix("test ") {
        Some(rest) => rest.strip_suffix(" ... FAILED").map(str::to_owned),
        None => line.strip_prefix("FAILED ").filter(|rest| rest.contains("::")).map(str::to_owned),
    };
    let error = text.lines().rfind(|line| line.starts_with("error: ")).map(str::to_owned);
    text.lines().filter_map(test).chain(error).collect()
}

/// Endings of what counts cases: tests of Rust, Python and boards; proofs; files; mutants; counts of instructions; the
/// report in a browser.
const CASES: [&str; 6] = [
    " passed",
    " claims proven equal",
    " files are fresh",
    " mutants fail",
    " instruction counts",
    " checks in the browser",
];

/// The sum of the numbers before the endings; none where there is none.
fn cases(text: &str) -> Option<u64> {
    let counts: Vec<u64> = CASES.iter().flat_map(|ending| numbers(text, ending)).collect();
    (!counts.is_empty()).then(|| counts.iter().sum())
}

fn sum(text: &str, ending: &str) -> u64 {
    numbers(text, ending).iter().sum()
}

/// The numbers before an ending, `N of M` counting as N.
fn numbers(text: &str, ending: &str) -> Vec<u64> {
    let mut found = Vec::new();
    for line in text.lines() {
        let Some((before, after)) = line.split_once(ending) else { continue };
        // A longer word ends otherwise.
        if after.starts_with(|next: char| next.is_alphanumeric()) {
            continue;
        }
        let mut words = before.split_whitespace().rev();
        let last = words.next();
        let number = if words.next() == Some("of") { words.next() } else { last };
        let digits = number.unwrap_or("").rsplit(|c: char| !c.is_ascii_digit()).next();
        found.extend(digits.unwrap_or("").parse::<u64>());
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_failed_is_named() {
        let cargo = "test a::one ... ok\ntest a::two ... FAILED\n\nerror: test failed, to rerun pass `--lib`\n";
        assert_eq!(failures(cargo), ["a::two", "error: test failed, to rerun pass `--lib`"]);
        let python = "FAILED tests/test_run.py::test_steps - assert 1 == 2\n1 failed in 0.1s\n";
        assert_eq!(failures(python), ["tests/test_run.py::test_steps - assert 1 == 2"]);
        let command = "error: an earlier one\nnoise\nerror: `npm ci` failed (exit status: 1)\n";
        assert_eq!(failures(command), ["error: `npm ci` failed (exit status: 1)"]);
    }

    #[test]
    fn cases_are_counted_in_what_tools_print() {
        let cargo = "test result: ok. 12 passed; 0 failed; 2 ignored; 0 measured; 0 filtered out\n";
        assert_eq!(cases(cargo), Some(12));
        assert_eq!(sum(cargo, " ignored"), 2);
        assert_eq!(cases("1230 of 1230 claims proven equal\n36 files are fresh"), Some(1266));
        assert_eq!(cases("==== 121 passed in 40.1s ===="), Some(121));
        let report = "reports: 5 files are those of their sources, 1082 checks in the browser";
        assert_eq!(cases(report), Some(1082));
        assert_eq!(cases("nothing passedover"), None);
    }

    #[test]
    fn a_skip_is_kept_with_its_remedy() {
        let output = Output {
            status: std::process::ExitStatus::default(),
            stdout: b"3 passed, 0 failed".to_vec(),
            stderr: b"skipped: flight; install with `apt-get install lld`\n".to_vec(),
        };
        let outcome = Outcome::from_output("flight", &output, 1.0, None);
        assert_eq!(outcome.skipped, ["flight; install with `apt-get install lld`"]);
        assert_eq!((outcome.cases, outcome.failed()), (Some(3), false));
    }
}
