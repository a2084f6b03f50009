//! B1 of the C back end: every kernel of every kind, as C and as Rust, on a thousand random inputs,
//! and whole evaluations of a thousand random spacecraft.
//!
//! The emitted C is compiled by each compiler at hand with the warnings that its page promises; what
//! is emitted twice must compute the same bits. Needs a C compiler, cargo, and no network.

mod build;
mod programs;
mod random;

use std::path::PathBuf;
use std::process::Command;
use std::sync::LazyLock;
use std::{env, fs};

use precess_codegen::emit::{EmittedFile, c};
use precess_codegen::kinds::KINDS;
use precess_outside::{Outside, Profile};

use build::{compilers, folder, run};
use programs::{Plan, plans};
use random::Random;

/// Inputs of each kernel.
const ROUNDS: usize = 1000;
/// Spacecraft of the whole evaluation.
const SPACECRAFT: usize = 1000;
/// The programs in Rust.
const KERNELS: &str = "kernels_in_rust";
const WHOLE: &str = "whole_in_rust";
/// The page for users.
const PAGE: &str = include_str!("../../../docs/c.md");
/// Where all random numbers start.
const SEED: u64 = 0x1AC_17C1;

/// What the tests of kernels start from.
struct Start {
    plans: Vec<Plan>,
    numbers: Vec<f64>,
    /// What the Rust kernels make of the numbers.
    rust: Vec<f64>,
}

static START: LazyLock<Start> = LazyLock::new(|| {
    let plans = plans();
    let mut random = Random::new(SEED);
    let inputs: usize = plans.iter().map(Plan::inputs).sum();
    let numbers: Vec<_> = (0..ROUNDS * inputs).map(|_| random.number()).collect();
    let rust = run(&rust_program(KERNELS), &numbers);
    Start { plans, numbers, rust }
});

static FILES: LazyLock<Vec<EmittedFile>> = LazyLock::new(|| c::files().expect("C"));

/// The folder of the Rust programs, built together once.
static RUST: LazyLock<PathBuf> = LazyLock::new(|| {
    let outside = Outside {
        name: "rust_kernels",
        manifest: "",
        with_nalgebra: true,
        profile: Profile::Development { opt_level: 1 },
    };
    let temporary = env!("CARGO_TARGET_TMPDIR");
    let source = outside.folder(temporary).join("src/bin");
    fs::create_dir_all(&source).expect("a folder for the programs");
    let kernels = programs::rust(&plans(), ROUNDS);
    for (name, text) in [(KERNELS, kernels.as_str()), (WHOLE, include_str!("whole.rs"))] {
        fs::write(source.join(format!("{name}.rs")), text).expect("a program");
    }
    outside.build(temporary, &[])
});

fn rust_program(name: &str) -> PathBuf {
    RUST.join(name).with_extension(env::consts::EXE_EXTENSION)
}

fn same(a: f64, b: f64) -> bool {
    // What is no number (a zero pivot's) has no bits that either language promises.
    a.to_bits() == b.to_bits() || a.is_nan() && b.is_nan()
}

/// The first number of which the bits differ, by its name, and how many do.
fn differing(found: &[f64], start: &Start) -> Option<(String, usize)> {
    assert_eq!(found.len(), start.rust.len(), "as many numbers");
    let wrong = found.iter().zip(&start.rust).enumerate().filter(|(_, (a, b))| !same(**a, **b));
    let wrong: Vec<_> = wrong.map(|(place, _)| place).collect();
    let mut first = *wrong.first()?;
    for outputs in start.plans.iter().map(Plan::outputs) {
        if first < ROUNDS * outputs.len() {
            let (round, place) = (first / outputs.len(), first % outputs.len());
            return Some((format!("{}, round {round}", outputs[place]), wrong.len()));
        }
        first -= ROUNDS * outputs.len();
    }
    unreachable!("each number is of a kind")
}

fn compared(
    name: &str,
    compiler: &str,
    files: &[EmittedFile],
    more: &[&str],
) -> Option<(String, usize)> {
    let start = &*START;
    let main = programs::c(&start.plans, ROUNDS);
    let main = ("main.c", main.as_str());
    let program = build::c(&folder(&format!("{name}-{compiler}")), compiler, files, &[main], more);
    differing(&run(&program, &start.numbers), start)
}

#[test]
#[ignore = "long: `cargo xtask test --all`"]
fn every_kernel_has_the_bits_of_rust_from_every_compiler() {
    let kernels: usize = START.plans.iter().map(Plan::kernels).sum();
    let told = format!("{} results of {kernels} kernels", START.rust.len());
    assert!(PAGE.contains(&told), "docs/c.md does not say: {told}");
    let odd = START.rust.iter().filter(|number| !number.is_finite()).count();
    assert!(odd * 1000 < START.rust.len(), "{odd} of {} are not finite", START.rust.len());
    for compiler in compilers() {
        assert_eq!(compared("bits", compiler, &FILES, &[]), None, "{compiler}");
        println!("{compiler}: {told} equal");
    }
}

#[test]
#[ignore = "long: `cargo xtask test --all`"]
fn a_sum_in_another_order_is_noticed() {
    let (right, wrong) = (
        "b->omega_by * p->r_s_b_bz - b->omega_bz * p->r_s_b_by + v->x_dot",
        "b->omega_by * p->r_s_b_bz - (b->omega_bz * p->r_s_b_by - v->x_dot)",
    );
    for compiler in compilers() {
        let mut files = FILES.clone();
        let file = files.iter_mut().find(|file| file.path == "precess_slosh_mass.c");
        let file = file.expect("a source for each kind");
        assert!(file.text.contains(right));
        file.text = file.text.replacen(right, wrong, 1);
        let noticed = compared("twin", compiler, &files, &[]);
        println!("{compiler}: {noticed:?}");
        assert!(noticed.is_some_and(|(name, _)| name.starts_with("slosh_mass ")), "{compiler}");
    }
}

/// With contraction on, a product and a sum are rounded once where the CPU can do both.
#[cfg(target_arch = "x86_64")]
#[test]
#[ignore = "long: `cargo xtask test --all`"]
fn contraction_is_noticed() {
    if !std::arch::is_x86_feature_detected!("fma") {
        eprintln!("skipped: contraction (needs a CPU with FMA)");
        return;
    }
    for compiler in compilers() {
        let noticed = compared("fused", compiler, &FILES, &["-mfma", "-ffp-contract=fast"]);
        println!("{compiler}: {noticed:?}");
        assert!(noticed.is_some_and(|(_, count)| count > START.rust.len() / 20), "{compiler}");
    }
}

/// Parameters, sines, kernels, the hub's six equations: four devices, wheels of two prescribed.
#[test]
#[ignore = "long: `cargo xtask test --all`"]
fn a_whole_evaluation_has_the_bits_of_rust() {
    let mut random = Random::new(SEED);
    let numbers: Vec<_> = (0..SPACECRAFT).flat_map(|_| random.spacecraft(4)).collect();
    let rust = run(&rust_program(WHOLE), &numbers);
    assert_eq!(rust.len(), SPACECRAFT * (6 + 4 * 3));
    assert!(rust.iter().all(|number| number.is_finite() && *number != 0.0));
    let sources = [("evaluate.h", include_str!("evaluate.h")), ("main.c", include_str!("whole.c"))];
    for compiler in compilers() {
        let at = folder(&format!("whole-{compiler}"));
        let program = build::c(&at, compiler, &FILES, &sources, &[]);
        let found = run(&program, &numbers);
        assert_eq!(found.len(), rust.len());
        let wrong = found.iter().zip(&rust).position(|(a, b)| !same(*a, *b));
        assert_eq!(wrong, None, "{compiler}: the first number of {} that differs", rust.len());
        println!("{compiler}: {} accelerations equal", rust.len());

        // A twin with one operation of the solver in another order.
        let mut files = FILES.clone();
        let solver = files.iter_mut().find(|file| file.path == "precess_solve.c");
        let solver = solver.expect("the solver");
        let (right, wrong) =
            ("a[5] - l_31 * a[2] - l_32 * below", "a[5] - (l_31 * a[2] + l_32 * below)");
        assert!(solver.text.contains(right));
        solver.text = solver.text.replace(right, wrong);
        let program = build::c(&at, compiler, &files, &sources, &[]);
        assert_ne!(run(&program, &numbers), found, "{compiler}");
    }
}

/// The program asserts, and says which line does not hold; a twin that accepts any pivot fails.
#[test]
fn what_has_no_solution_is_refused() {
    let main = [("main.c", include_str!("edges.c"))];
    let bound = "pivot > 64.0 * DBL_EPSILON * scale";
    for compiler in compilers() {
        let mut files = FILES.clone();
        let known = ["precess_hub", "precess_body", "precess_solve", "precess_sin_cos"];
        files.retain(|file| known.iter().any(|name| file.path.starts_with(name)));
        let at = folder(&format!("edges-{compiler}"));
        let succeeds = |files: &[EmittedFile]| {
            let program = build::c(&at, compiler, files, &main, &[]);
            Command::new(program).status().expect("the program starts").success()
        };
        assert!(succeeds(&files), "{compiler}");
        let solver = files.iter_mut().find(|file| file.text.contains(bound)).expect("the bound");
        solver.text = solver.text.replace(bound, "pivot >= 0.0 * scale");
        assert!(!succeeds(&files), "{compiler}");
    }
}

/// Clang needs nothing but itself for that; GCC's C++ is a package of its own.
#[test]
fn the_headers_are_good_cpp_too() {
    if !compilers().contains(&"clang") {
        return;
    }
    let headers = FILES.iter().filter(|file| !file.path.ends_with('c'));
    let headers: Vec<_> = headers.map(|file| file.path.as_str()).collect();
    let at = folder("cpp");
    for file in FILES.iter() {
        fs::write(at.join(&file.path), &file.text).expect("an emitted file");
    }
    let mut clang = Command::new("clang");
    clang.args(["-x", "c++", "-std=c++11", "-fsyntax-only", "-Wall", "-Wextra", "-pedantic"]);
    let output = clang.arg("-Werror").args(&headers).current_dir(&at).output().expect("clang");
    assert!(headers.len() == KINDS.len() + 12 && output.status.success(), "{output:?}");
}

#[test]
fn the_page_shows_what_is_compiled_and_how() {
    assert!(PAGE.contains(&format!("```c\n{}```\n", include_str!("evaluate.h"))), "the evaluation");
    let flags = build::FLAGS.join(" ").replace("-Werror ", "");
    assert!(PAGE.contains(&format!("cc {flags} -c precess_*.c")), "{flags}");
}
