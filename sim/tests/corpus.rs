//! The corpus of the fuzzer: every input is an error with a message, or a scenario that is read back
//! as it was written and starts. `sim/fuzz/README.md` says how it came about.

use std::io::{Cursor, Read};

use zip::ZipArchive;

#[path = "../fuzz/input.rs"]
mod input;

use input::{Reached, tried};

const CORPUS: &[u8] = include_bytes!("../fuzz/scenario.zip");

/// The corpus has at least as many inputs of each kind: errors, and scenarios that are stepped.
const LEAST: usize = 30;

#[test]
fn every_input_of_the_corpus_is_an_error_or_steps() {
    let mut corpus = ZipArchive::new(Cursor::new(CORPUS)).expect("the corpus");
    let mut reached = [0; 4];
    for index in 0..corpus.len() {
        let mut member = corpus.by_index(index).expect("an input");
        // Shown where one panics.
        println!("{}", member.name().expect("a name"));
        let mut input = Vec::new();
        member.read_to_end(&mut input).expect("an input");
        reached[tried(&input) as usize] += 1;
    }
    let of = |which: Reached| reached[which as usize];
    println!("{} rejected, {} stepped", of(Reached::Rejected), of(Reached::Stepped));
    assert!(of(Reached::Rejected) >= LEAST && of(Reached::Stepped) >= LEAST, "{reached:?}");
}
