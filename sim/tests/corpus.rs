//! The corpus of the fuzzer: every input is an error with a message, or a scenario that is read back
//! as it was written and starts. `sim/fuzz/README.md` says how it came about.

use std::fs;
use std::path::Path;

#[path = "../fuzz/input.rs"]
mod input;

use input::{Reached, tried};

/// The corpus has at least as many inputs of each kind: errors, and scenarios that are stepped.
const LEAST: usize = 30;

#[test]
fn every_input_of_the_corpus_is_an_error_or_steps() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("fuzz/corpus/scenario");
    let entries = fs::read_dir(&folder).expect("the corpus").map(|entry| entry.expect("an entry"));
    let mut paths: Vec<_> = entries.map(|entry| entry.path()).collect();
    paths.sort();
    let mut reached = [0; 4];
    for path in paths {
        // Shown where one panics.
        println!("{}", path.display());
        reached[tried(&fs::read(&path).expect("an input")) as usize] += 1;
    }
    let of = |which: Reached| reached[which as usize];
    println!("{} rejected, {} stepped", of(Reached::Rejected), of(Reached::Stepped));
    assert!(of(Reached::Rejected) >= LEAST && of(Reached::Stepped) >= LEAST, "{reached:?}");
}
