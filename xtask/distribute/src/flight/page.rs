//! `docs/flight.md`: instructions, stack and code of a call on a Cortex-M7, and the bounds on them.

use std::fmt::Write;
use std::fs;

use precess_codegen::kinds::KINDS;

use super::gates::LARGEST_STACK;
use super::image::Image;
use super::tally::Tally;
use xtask::files::write;
use xtask::run::root;
use xtask::say;

/// The committed page.
const PAGE: &str = "docs/flight.md";

/// A figure may exceed the committed one by one in so many.
const GATE: u64 = 50;

/// Largest number of instructions of an evaluation, by the number of DGVSCMGs.
const BOUNDS: [(u32, u64); 2] = [(1, 3000), (4, 8500)];

/// The same of four DGVSCMGs with locked gimbals, by kernels of their own.
const BAKED: u64 = 5000;

/// The same of an allocation of a torque to four DGVSCMGs.
const ALLOCATION: u64 = 3000;

/// Instructions of their servo at most, in tenths of an evaluation.
const SERVO: u64 = 17;

/// What steers four DGVSCMGs: its name in the library.
pub(super) const STEERING: [&str; 3] = ["steering_terms", "allocate", "servo"];

/// Of so many DGVSCMGs the linearised system is measured.
pub(super) const LINEARIZED: [u32; 2] = [1, 4];

/// A set of devices that is measured.
pub(super) struct Set {
    pub(super) kind: &'static str,
    pub(super) devices: u32,
}

/// Every kind, one device and four.
pub(super) fn sets() -> impl Iterator<Item = Set> {
    KINDS.iter().flat_map(|kind| [1, 4].map(|devices| Set { kind: kind.name, devices }))
}

/// Columns of the table after the name.
const COLUMNS: [&str; 6] = [
    "instructions of an evaluation",
    "instructions of a step",
    "stack of an evaluation",
    "stack of a step",
    "code of an evaluation",
    "code of a step",
];

/// Everything measured.
pub(super) struct Figures {
    /// Name and columns of each set.
    rows: Vec<(String, [u64; 6])>,
    /// Code and constants of the whole library, bytes.
    text: u64,
    /// Instructions of a sine with its cosine, and of a square root.
    parts: [u64; 2],
    /// Of an evaluation of the imaging satellite by kernels of its own.
    baked: u64,
    /// Instructions, stack and code of each of [`STEERING`].
    steering: [[u64; 3]; 3],
    /// The same of the linearised system of [`LINEARIZED`].
    linearized: [[u64; 3]; 2],
}

impl Figures {
    /// From the images of the library and of that of the linearised system, and the lines of the programs that count.
    pub(super) fn from_images(
        image: &Image,
        linearization: &Image,
        counts: &[String],
    ) -> Result<Self, String> {
        let counted = |name: &str| {
            let of_line = |line: &String| line.strip_prefix(name)?.strip_prefix(": ")?.parse().ok();
            counts.iter().find_map(of_line).ok_or_else(|| format!("no count of `{name}`"))
        };
        let row = |Set { kind, devices }: Set| {
            let module = format!("{kind}_{devices}");
            let [evaluation, step] =
                ["accelerations", "step"].map(|call| format!("precess_{module}_{call}"));
            let columns = [
                counted(&format!("{module} accelerations"))?,
                counted(&format!("{module} step"))?,
                image.stack(&evaluation)?,
                image.stack(&step)?,
                image.reach(&evaluation)?,
                image.reach(&step)?,
            ];
            Ok((format!("{kind} {devices}"), columns))
        };
        let mut steering = [[0; 3]; 3];
        for (columns, call) in steering.iter_mut().zip(STEERING) {
            let export = format!("precess_dgvscmg_4_{call}");
            let instructions = counted(&format!("dgvscmg_4 {call}"))?;
            *columns = [instructions, image.stack(&export)?, image.reach(&export)?];
        }
        let mut linearized = [[0; 3]; 2];
        for (columns, devices) in linearized.iter_mut().zip(LINEARIZED) {
            let export = format!("precess_dgvscmg_{devices}_linearize");
            let instructions = counted(&format!("dgvscmg_{devices} linearize"))?;
            *columns = [instructions, linearization.stack(&export)?, linearization.reach(&export)?];
        }
        Ok(Self {
            steering,
            linearized,
            rows: sets().map(row).collect::<Result<_, String>>()?,
            text: image.text,
            parts: [counted("sin_cos")?, counted("sqrt")?],
            baked: counted("imaging_satellite accelerations")?,
        })
    }

    /// Name and columns of what steers and of the linearised system: instructions, stack, code.
    fn others(&self) -> impl Iterator<Item = (String, [u64; 3])> {
        let steering = STEERING.map(|call| format!("steering: {call}"));
        let linearized = LINEARIZED.map(|devices| format!("linearized: dgvscmg {devices}"));
        let rows = steering.into_iter().zip(self.steering);
        rows.chain(linearized.into_iter().zip(self.linearized))
    }

    fn instructions(&self, devices: u32) -> u64 {
        let name = format!("dgvscmg {devices}");
        let row = self.rows.iter().find(|(row, _)| *row == name);
        row.map_or(u64::MAX, |(_, columns)| columns[0])
    }
}

/// Writes the page, or holds each figure to the committed one.
pub(super) fn settle(
    compiler: &str,
    figures: &Figures,
    check: bool,
    tally: &mut Tally,
) -> Result<(), String> {
    if !check {
        return write([(PAGE, page(compiler, figures).as_str())], &root());
    }
    let committed = fs::read_to_string(root().join(PAGE)).unwrap_or_default();
    tally.check(
        "figures: none exceeds the committed one by more than 2 %",
        held(figures, &committed),
    );
    // The same figures, each committed a tenth smaller, have to be rejected.
    let smaller = Figures {
        rows: figures
            .rows
            .iter()
            .map(|(name, row)| (name.clone(), row.map(|n| n - n / 10)))
            .collect(),
        text: figures.text - figures.text / 10,
        parts: figures.parts,
        baked: figures.baked - figures.baked / 10,
        steering: figures.steering.map(|row| row.map(|n| n - n / 10)),
        linearized: figures.linearized.map(|row| row.map(|n| n - n / 10)),
    };
    let caught = match held(figures, &page(compiler, &smaller)) {
        Ok(()) => Err("they passed: the gate is blind".to_owned()),
        Err(_) => Ok(()),
    };
    tally.check("figures: some that have grown by a tenth are caught", caught);
    if !committed.contains(compiler) {
        say!("{PAGE} was not measured with {compiler}; run `cargo xtask flight`");
    }
    Ok(())
}

fn held(figures: &Figures, committed: &str) -> Result<(), String> {
    let mut wrong = String::new();
    let mut hold = |what: &str, now: u64, before: Option<u64>| {
        // Writing to a string cannot fail.
        let _ = match before {
            Some(before) if now <= before + before / GATE => Ok(()),
            Some(before) => write!(wrong, "\n  {what}: {now}, {before} committed"),
            None => write!(wrong, "\n  {what}: {now}, none committed"),
        };
    };
    for (name, columns) in &figures.rows {
        let before = committed_row(committed, name);
        for ((column, now), index) in COLUMNS.iter().zip(columns).zip(0..) {
            let before =
                before.as_ref().and_then(|row: &Vec<u64>| row.get::<usize>(index).copied());
            hold(&format!("{name}, {column}"), *now, before);
        }
    }
    let text = committed_row(committed, "whole library").and_then(|row| row.first().copied());
    hold("whole library", figures.text, text);
    let baked = committed_row(committed, "imaging satellite, baked");
    hold("imaging satellite, baked", figures.baked, baked.and_then(|row| row.first().copied()));
    for (name, columns) in figures.others() {
        let before = committed_row(committed, &name);
        for (index, (what, now)) in
            ["instructions", "stack", "code"].iter().zip(columns).enumerate()
        {
            let before = before.as_ref().and_then(|row| row.get(index).copied());
            hold(&format!("{name}, {what}"), now, before);
        }
    }
    if wrong.is_empty() {
        return Ok(());
    }
    Err(format!("beyond {PAGE}:{wrong}\nif that is meant, run `cargo xtask flight`"))
}

/// The numbers after a name.
fn committed_row(page: &str, name: &str) -> Option<Vec<u64>> {
    let start = format!("| `{name}` |");
    let row = page.lines().find_map(|line| line.strip_prefix(&start))?;
    row.split('|')
        .filter(|cell| !cell.trim().is_empty())
        .map(|cell| cell.trim().parse().ok())
        .collect()
}

fn page(compiler: &str, figures: &Figures) -> String {
    let mut text = format!(
        "<!-- @generated by `cargo xtask flight`; do not edit. -->\n\n{}",
        include_str!("flight.md")
            .replace("{compiler}", compiler)
            .replace("{stack}", &LARGEST_STACK.to_string())
            // An evaluation and a step each, and steering.
            .replace("{exports}", &(2 * figures.rows.len() + STEERING.len()).to_string())
            .replace("{sin_cos}", &figures.parts[0].to_string())
            .replace("{sqrt}", &figures.parts[1].to_string())
            .replace("{bounds}", &bounds(figures))
            .replace("{text}", &figures.text.to_string())
    );
    for (name, columns) in &figures.rows {
        let cells = columns.map(|number| number.to_string()).join(" | ");
        // Writing to a string cannot fail.
        let _ = writeln!(text, "| `{name}` | {cells} |");
    }
    let _ = writeln!(text, "| `imaging satellite, baked` | {} | | | | | |", figures.baked);
    text += "\n## What steers four DGVSCMGs\n\n`steering_terms`, `SteeringLaw::allocate` of the exact inverse for twelve joints, and `servo`, an evaluation with\n\
             prescribed joints and inverse dynamics:\n\n| call | instructions | stack | code |\n|---|---:|---:|---:|\n";
    let mut others = figures.others();
    let mut rows = |text: &mut String, count: usize| {
        for (name, columns) in others.by_ref().take(count) {
            let cells = columns.map(|number| number.to_string()).join(" | ");
            // Writing to a string cannot fail.
            let _ = writeln!(text, "| `{name}` | {cells} |");
        }
    };
    rows(&mut text, STEERING.len());
    text += "\n## The linearised system\n\n`Spacecraft::linearize_fixed`: the matrices A and B, 18 by 18 and 18 by 9 of one DGVSCMG, 36 by 36 and 36 by 18 of four,\n\
             into the caller's arrays, with the accelerations. A library of its own, with the feature `derivatives`, which the other\n\
             does not have. The workspace is the caller's, too:\n\n| call | instructions | stack | code |\n|---|---:|---:|---:|\n";
    rows(&mut text, LINEARIZED.len());
    text
}

/// The bounds on an evaluation, and whether they hold.
fn bounds(figures: &Figures) -> String {
    let rows =
        BOUNDS.map(|(devices, bound)| (format!("{devices}"), bound, figures.instructions(devices)));
    let baked = "4, gimbals locked, [kernels of one spacecraft](bake.md)".to_owned();
    let [_, [allocation, ..], [servo, ..]] = figures.steering;
    let steering = [
        ("4, allocation of a torque".to_owned(), ALLOCATION, allocation),
        ("4, servo: 1.7 evaluations".to_owned(), SERVO * figures.instructions(4) / 10, servo),
    ];
    let rows = rows.into_iter().chain([(baked, BAKED, figures.baked)]).chain(steering);
    let row = |(what, bound, now): (String, u64, u64)| {
        let verdict = if now <= bound {
            "holds".to_owned()
        } else {
            format!("does not hold, by {}", now - bound)
        };
        format!("| {what} | {bound} | {now} | {verdict} |")
    };
    rows.map(row).collect::<Vec<_>>().join("\n")
}

#[cfg(test)]
mod tests {
    use super::*;

    fn figures(number: u64) -> Figures {
        let row = |Set { kind, devices }: Set| (format!("{kind} {devices}"), [number; 6]);
        Figures {
            rows: sets().map(row).collect(),
            text: number,
            parts: [1, 2],
            baked: number,
            steering: [[number; 3]; 3],
            linearized: [[number; 3]; 2],
        }
    }

    #[test]
    fn a_figure_may_exceed_the_committed_one_by_a_fiftieth() {
        let committed = page("a compiler", &figures(10_000));
        assert_eq!(held(&figures(10_200), &committed), Ok(()));
        assert_eq!(held(&figures(5000), &committed), Ok(()));
        let rejected = held(&figures(10_201), &committed).unwrap_err();
        assert!(rejected.ends_with("run `cargo xtask flight`"), "{rejected}");
        assert!(held(&figures(1), "").is_err(), "nothing is committed");
    }

    #[test]
    fn page_says_whether_the_bounds_hold() {
        let rows = bounds(&figures(3001));
        let (first, rest) = rows.split_once('\n').unwrap();
        assert_eq!(first, "| 1 | 3000 | 3001 | does not hold, by 1 |");
        assert!(rest.starts_with("| 4 | 8500 | 3001 | holds |"), "{rest}");
        assert!(rest.contains("(bake.md) | 5000 | 3001 | holds |"), "{rest}");
        assert!(
            rest.contains("allocation of a torque | 3000 | 3001 | does not hold, by 1 |"),
            "{rest}"
        );
        assert!(rest.ends_with("| 4, servo: 1.7 evaluations | 5101 | 3001 | holds |"), "{rest}");
    }
}
