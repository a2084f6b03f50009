//! Instructions counted by callgrind: the total of a run, and the share of functions by name.

use std::path::Path;
use std::process::Command;

/// What callgrind found in a run.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Counts {
    /// All instructions.
    pub(crate) total: u64,
    /// Those of the C library's functions that move or fill memory.
    pub(crate) copies: u64,
}

impl Counts {
    /// Per call, from a shorter and a longer run: what is not in the calls drops out.
    pub(crate) fn per_call(short: Self, long: Self, more_calls: u32) -> Option<Self> {
        let of = |short: u64, long: u64| {
            let more = long.checked_sub(short)?;
            // To the nearest: a run may differ by an instruction or two outside the calls.
            Some((more + u64::from(more_calls) / 2) / u64::from(more_calls))
        };
        Some(Self { total: of(short.total, long.total)?, copies: of(short.copies, long.copies)? })
    }
}

/// Counts the instructions of a program. Its environment is empty, so that its stack is where it
/// always does, and the C library is held to what every x86-64 has, so that copies count the same
/// on every CPU. None where valgrind does not know an instruction of the program: 3.19 lacks the form of `vmovq` from a
/// register above the seventh to a lower one, which LLVM rarely chooses.
pub(crate) fn count(
    program: &Path,
    arguments: &[&str],
    into: &Path,
) -> Result<Option<Counts>, String> {
    const PORTABLE: &str = "glibc.cpu.hwcaps=-AVX_Fast_Unaligned_Load,-ERMS,-FSRM,-SSSE3";
    let mut valgrind = Command::new("valgrind");
    valgrind.arg("--tool=callgrind").arg(format!("--callgrind-out-file={}", into.display()));
    valgrind.arg(program).args(arguments).env_clear().env("GLIBC_TUNABLES", PORTABLE);
    if let Some(path) = std::env::var_os("PATH") {
        valgrind.env("PATH", path);
    }
    let output = valgrind.output().map_err(|error| format!("valgrind did not start: {error}"))?;
    if !output.status.success() {
        let errors = String::from_utf8_lossy(&output.stderr);
        if errors.contains("valgrind: Unrecognised instruction") {
            return Ok(None);
        }
        return Err(format!("valgrind failed ({}): {errors}", output.status));
    }
    let text = std::fs::read_to_string(into)
        .map_err(|error| format!("cannot read {}: {error}", into.display()))?;
    parse(&text).map(Some).ok_or_else(|| format!("{} has no total", into.display()))
}

/// Reads callgrind's format: after a line `fn=(7) name` (later `fn=(7)`) come lines of position and
/// cost, which are the function's own but for the one after each `calls=`.
fn parse(text: &str) -> Option<Counts> {
    let mut copying = std::collections::BTreeMap::new();
    let (mut copies, mut inside, mut of_callee, mut total) = (0, false, false, None);
    for line in text.lines() {
        if let Some(function) = line.strip_prefix("fn=") {
            let (id, name) = function.split_once(' ').unwrap_or((function, ""));
            inside = *copying.entry(id).or_insert_with(|| is_copy(name));
        } else if let Some(callee) = line.strip_prefix("cfn=") {
            // A name may be defined here.
            if let Some((id, name)) = callee.split_once(' ') {
                copying.entry(id).or_insert_with(|| is_copy(name));
            }
        } else if line.starts_with("calls=") {
            of_callee = true;
        } else if let Some(sum) = line.strip_prefix("totals:").or(line.strip_prefix("summary:")) {
            total = total.or(sum.trim().parse().ok());
        } else if line.starts_with(|first: char| first.is_ascii_digit() || "+-*".contains(first)) {
            let cost = line.split_whitespace().nth(1).and_then(|cost| cost.parse::<u64>().ok());
            if inside && !of_callee {
                copies += cost.unwrap_or(0);
            }
            of_callee = false;
        }
    }
    Some(Counts { total: total?, copies })
}

fn is_copy(name: &str) -> bool {
    ["memcpy", "memmove", "memset"].iter().any(|copy| name.contains(copy))
}

#[cfg(test)]
mod tests {
    use super::*;

    const RUN: &str = "events: Ir\nfn=(1) main\n5 100\ncfn=(2) __memcpy_sse2\ncalls=3 0\n7 60\n\
                       +1 10\n\nfn=(2)\n3 40\n* 20\nfn=(1)\n9 5\ntotals: 175\n";

    #[test]
    fn cost_of_a_call_is_not_the_callers_own() {
        assert_eq!(parse(RUN), Some(Counts { total: 175, copies: 60 }));
        assert_eq!(parse("fn=(1) main\n5 100\n"), None);
    }

    #[test]
    fn what_is_not_in_the_calls_drops_out() {
        let [short, long] = [1000, 11_001].map(|total| Counts { total, copies: 0 });
        let per_call = Counts::per_call(short, long, 100);
        assert_eq!(per_call, Some(Counts { total: 100, copies: 0 }));
        assert_eq!(Counts::per_call(long, short, 100), None);
    }
}
