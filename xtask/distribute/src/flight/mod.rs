//! `flight`: builds the firmware for boards, runs it under emulation, compares it with this machine
//! bit for bit, and measures it.

mod board;
mod build;
mod gates;
mod image;
mod output;
mod page;
mod tally;
mod thumb;
mod tools;

use std::path::{Path, PathBuf};
use std::process::Command;
use std::thread;

use clap::Args;

use board::{BOARDS, Board};
use gates::Library;
use output::{lines, same, whole};
use page::Figures;
use tally::Tally;
use xtask::capi;
use xtask::skip::skip;

/// The library that is checked and measured, and the programs with it.
const LIBRARY: &str = "precess-flight-library";
const EXAMPLE: &str = "wake-up";
const COUNTS: &str = "instructions";
/// The library of the linearised system, which has the emitted derivatives, and the program that counts it: built apart,
/// so that nothing else has them.
const LINEARIZATION: &str = "precess-flight-linearization";
const LINEARIZATION_COUNTS: &str = "linearization";

/// Options of `flight`.
#[derive(Args)]
pub(crate) struct Options {
    /// Write nothing; fail if a figure exceeds the committed one by more than 2 %
    #[arg(long)]
    check: bool,
    /// Only this board; gates and figures go with the Cortex-M7
    #[arg(long, value_name = "NAME")]
    board: Option<String>,
    /// Two of the boards: the Cortex-M7, and the one of the other word order
    #[arg(long, conflicts_with = "board")]
    quick: bool,
}

/// Tests the library from C; then builds, runs, compares and measures everything on boards, and
/// writes the page or compares with it.
pub(crate) fn flight(options: &Options) -> Result<(), String> {
    if options.board.is_none() {
        capi::host()?;
    }
    if let Some(install) = tools::missing() {
        return skip("flight", &install);
    }
    let compiler = tools::compiler()?;
    let mut tally = Tally::default();
    let wanted = |board: &&Board| {
        let named = options.board.as_ref().is_none_or(|name| board.name == name);
        named && (board.is_quick || !options.quick)
    };
    let boards: Vec<&Board> = BOARDS.iter().filter(wanted).collect();
    if boards.is_empty() {
        let names = BOARDS.map(|board| board.name).join(", ");
        return Err(format!("no such board; there are {names}"));
    }
    let mut programs: Vec<_> = boards.iter().flat_map(|board| board.programs).copied().collect();
    programs.push(EXAMPLE);
    let here = build::for_host(&programs)?;
    // Two at a time: a build is one thread for most of its time.
    for pair in boards.chunks(2) {
        for (board, images) in pair.iter().zip(built(pair)) {
            match images {
                Ok(images) => compare(board, &images, &here, &mut tally),
                Err(why) => tally.check(&format!("{}: built", board.name), Err(why)),
            }
        }
    }
    let measured = &BOARDS[0];
    if !boards.iter().any(|board| board.name == measured.name) {
        return tally.end();
    }
    gates::twins(measured, &mut tally);
    let figures = figures(measured, &mut tally);
    if let Some(figures) = figures {
        page::settle(&compiler, &figures, options.check, &mut tally)?;
    }
    tally.end()
}

/// Builds for some boards at once.
fn built(boards: &[&Board]) -> Vec<Result<PathBuf, String>> {
    let build = |board: &Board| {
        let mut programs = board.programs.to_vec();
        if board.name == BOARDS[0].name {
            programs.extend([EXAMPLE, COUNTS]);
            build::programs(board, &[LINEARIZATION_COUNTS])?;
        }
        build::programs(board, &programs)
    };
    thread::scope(|scope| {
        let started: Vec<_> =
            boards.iter().map(|board| scope.spawn(move || build(board))).collect();
        let ended = started.into_iter().map(|build| {
            build.join().unwrap_or_else(|_| Err("the build was not waited for".to_owned()))
        });
        ended.collect()
    })
}

/// Runs a board's programs and holds what they print against this machine.
fn compare(board: &Board, images: &Path, here: &Path, tally: &mut Tally) {
    let run = |program: &str| lines(&mut board.emulate(&images.join(program))).and_then(whole);
    let on_host = |program: &str, arguments: &[&str]| {
        lines(Command::new(here.join(program)).args(arguments)).and_then(whole)
    };
    for program in board.programs {
        let what =
            format!("{} ({}): {program} prints the bits of this machine", board.name, board.says);
        let there = run(program);
        let result = on_host(program, &[])
            .and_then(|here| there.clone().and_then(|there| same(&here, &there)));
        tally.check(&what, result);
        // The same, one number off by one unit in its last place, has to be found.
        let nudged = on_host(program, &["--nudge"])
            .and_then(|here| there.map(|there| same(&here, &there)))
            .and_then(|seen| match seen {
                Ok(()) => Err("it was not: the comparison is blind".to_owned()),
                Err(_) => Ok(()),
            });
        tally.check(
            &format!("{}: {program} off by one unit in the last place is found", board.name),
            nudged,
        );
    }
    if board.name == BOARDS[0].name {
        let result = on_host(EXAMPLE, &[])
            .and_then(|here| run(EXAMPLE).and_then(|there| same(&here, &there)));
        tally.check(
            &format!("{}: {EXAMPLE} runs within its energy and momentum bounds", board.name),
            result,
        );
    }
}

/// What is measured of the library; none if it does not pass or was not counted.
fn figures(board: &Board, tally: &mut Tally) -> Option<Figures> {
    let exports = page::sets().flat_map(|set| {
        ["accelerations", "step"].map(|call| format!("precess_{}_{}_{call}", set.kind, set.devices))
    });
    let steering = page::STEERING.map(|call| format!("precess_dgvscmg_4_{call}"));
    let exports = exports.chain(steering);
    let library =
        Library { package: LIBRARY, features: &["standalone"], exports: exports.collect() };
    let exports = page::LINEARIZED.map(|devices| format!("precess_dgvscmg_{devices}_linearize"));
    let linearization =
        Library { package: LINEARIZATION, features: &["standalone"], exports: exports.into() };
    let images = [&library, &linearization].map(|library| gates::passed(board, library));
    let folder = xtask::run::target()
        .map(|folder| folder.join("flight").join(board.name).join(board.triple).join("release"));
    let counted = |folder: &Path| -> Result<Vec<String>, String> {
        let of = |program: &str| lines(&mut board.emulate(&folder.join(program))).and_then(whole);
        let mut counts = of(COUNTS)?;
        counts.extend(of(LINEARIZATION_COUNTS)?);
        Ok(counts)
    };
    let counts = folder.and_then(|folder| counted(&folder));
    let found = match (&images, &counts) {
        ([Ok(image), Ok(linearization)], Ok(counts)) => {
            Some(Figures::from_images(image, linearization, counts))
        }
        _ => None,
    };
    for (Library { package, exports, .. }, image) in [library, linearization].iter().zip(images) {
        let exports = exports.len();
        let gated = format!(
            "gates: {package}, {exports} exports, without allocator, panic or endless stack"
        );
        tally.check(&gated, image.map(|_| ()));
    }
    tally.check(&format!("{}: instructions counted", board.name), counts.map(|_| ()));
    match found? {
        Ok(figures) => Some(figures),
        Err(why) => {
            tally.check("figures", Err(why));
            None
        }
    }
}
