//! What the machine code of every kernel does beside its arithmetic: read by the example
//! `object_code`, held to the committed table by [`compare`].

use std::fmt::Write;
use std::path::PathBuf;
use std::process::Command;

use xtask::run::{cargo, target};
use xtask::say;

/// A number may exceed the committed one by one in so many.
const GATE: u64 = 100;

/// A kernel: its name; arithmetic operations, loads, stores, copies, cycles of the longest chain.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Kernel {
    name: String,
    counts: [u64; 5],
}

impl Kernel {
    /// Reads a line of the example or a row of the table: a name and five numbers first.
    fn read(line: &str) -> Option<Self> {
        let mut words = line.split(['|', ' ', '`']).filter(|word| !word.is_empty());
        let name = words.next()?.to_owned();
        let mut counts = [0; 5];
        for count in &mut counts {
            *count = words.next()?.parse().ok()?;
        }
        Some(Self { name, counts })
    }

    /// Loads, stores and copies.
    fn moves(&self) -> u64 {
        let [_, loads, stores, copies, _] = self.counts;
        loads + stores + copies
    }

    fn chain(&self) -> u64 {
        self.counts[4]
    }
}

/// Builds a program of the crate of counts for any CPU of the target; where it is.
pub(crate) fn program(name: &str, options: &[&str]) -> Result<PathBuf, String> {
    let build = ["build", "--release", "--quiet", "-p", "precess-counts", "--bin", name];
    cargo(&[&build[..], options].concat())?;
    Ok(target()?.join("release").join(name))
}

/// Builds and runs the program that reads the kernels.
pub(crate) fn kernels() -> Result<Vec<Kernel>, String> {
    let program = program("object_code", &[])?;
    let output = Command::new(&program).output();
    let output = output.map_err(|error| format!("{}: {error}", program.display()))?;
    if !output.status.success() {
        return Err(format!("object_code: {}", String::from_utf8_lossy(&output.stderr).trim()));
    }
    let text = String::from_utf8_lossy(&output.stdout);
    let read = |line: &str| Kernel::read(line).ok_or_else(|| format!("object_code wrote `{line}`"));
    text.lines().map(read).collect()
}

/// The section of the page.
pub(crate) fn section(kernels: &[Kernel]) -> String {
    let mut text = "\n## Kernels\n\n\
         The machine code of each kernel by itself: numbers come from memory and go there. *Operations* are\n\
         products, sums and quotients of numbers; *loads* and *stores* are instructions that read and write\n\
         memory, *copies* move numbers between registers. *Per operation* is their sum. *Chain* is the latency\n\
         of the longest chain of instructions that wait for each other, in cycles of an Intel core since\n\
         Skylake: products and sums 4, quotients 14, loads 5. `cargo xtask instructions --check` lets neither the\n\
         sum nor the chain grow by more than 1 %.\n\n\
         | kernel | operations | loads | stores | copies | per operation | chain |\n\
         |---|---:|---:|---:|---:|---:|---:|\n"
        .to_owned();
    for kernel in kernels {
        let Kernel { name, counts: [arithmetic, loads, stores, copies, chain] } = kernel;
        let hundredths = (100 * kernel.moves()).checked_div(*arithmetic).unwrap_or(0);
        let (whole, part) = (hundredths / 100, hundredths % 100);
        // Writing to a string cannot fail.
        let _ = writeln!(
            text,
            "| `{name}` | {arithmetic} | {loads} | {stores} | {copies} | {whole}.{part:02} | {chain} |"
        );
    }
    text
}

/// Holds each kernel to the committed one; how many exceed it.
pub(crate) fn compare(kernels: &[Kernel], committed: &str) -> usize {
    let rows: Vec<Kernel> = committed.lines().filter_map(committed_row).collect();
    let mut wrong = 0;
    for kernel in kernels {
        let name = &kernel.name;
        let Some(row) = rows.iter().find(|row| row.name == *name) else {
            say!("`{name}`: no row committed");
            wrong += 1;
            continue;
        };
        let pairs = [
            ("loads, stores and copies", kernel.moves(), row.moves()),
            ("cycles of the chain", kernel.chain(), row.chain()),
        ];
        for (what, now, bound) in pairs {
            let room = bound / GATE;
            if now > bound + room {
                say!("`{name}`: {now} {what}, {bound} committed: too many");
                wrong += 1;
            }
            if now + room < bound {
                say!("`{name}`: {now} {what}, {bound} committed: fewer; commit them");
            }
        }
    }
    wrong
}

/// A row of the table, without the column that follows from the others.
fn committed_row(line: &str) -> Option<Kernel> {
    let mut cells: Vec<&str> = line.split('|').map(str::trim).collect();
    (cells.len() == 9 && cells[1].contains('/')).then(|| cells.remove(6))?;
    Kernel::read(&cells.join(" "))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn kernel(counts: [u64; 5]) -> Vec<Kernel> {
        vec![Kernel { name: "dgvscmg/eliminate".to_owned(), counts }]
    }

    #[test]
    fn a_row_reads_back_as_it_was_written() {
        let kernels = kernel([864, 375, 263, 507, 204]);
        let text = section(&kernels);
        assert!(text.contains("| 864 | 375 | 263 | 507 | 1.32 | 204 |"), "{text}");
        assert_eq!(text.lines().filter_map(committed_row).collect::<Vec<_>>(), kernels);
    }

    #[test]
    fn moves_and_chain_may_grow_by_a_hundredth() {
        let committed = section(&kernel([800, 300, 200, 500, 200]));
        assert_eq!(compare(&kernel([900, 300, 200, 510, 202]), &committed), 0);
        assert_eq!(compare(&kernel([800, 300, 200, 511, 200]), &committed), 1);
        assert_eq!(compare(&kernel([800, 300, 200, 511, 203]), &committed), 2);
        assert_eq!(compare(&kernel([1, 1, 1, 1, 1]), ""), 1, "nothing is committed");
    }
}
