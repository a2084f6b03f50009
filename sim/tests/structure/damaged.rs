//! Damaged files: errors, and no more.

use std::fs;
use std::path::Path;

use precess::file::structure_from_file;
use precess::structure::{flex42, npz, op4};

use super::numbers::Numbers;
use super::{FLEX, FORMS, LAYOUTS, bytes, example};

/// Bytes with one to three damages: other bytes, a part left out, doubled or moved, or an end that is too early.
fn damaged(bytes: &[u8], numbers: &mut Numbers) -> Vec<u8> {
    const VALUES: [u8; 10] = [0, 1, 0xff, 0x7f, 0x80, b'-', b'9', b'\n', b' ', b'E'];
    let mut bytes = bytes.to_vec();
    let mut below = |bound: usize| {
        usize::try_from(numbers.next().unwrap_or_default() % (bound.max(1) as u64)).unwrap_or(0)
    };
    for _ in 0..=below(3) {
        let at = below(bytes.len());
        match below(6) {
            0 => bytes.truncate(at + 1),
            1 => drop(bytes.drain(at..(at + 1 + below(16)).min(bytes.len()))),
            2 => {
                let part = bytes[at..(at + 1 + below(64)).min(bytes.len())].to_vec();
                let to = below(bytes.len());
                bytes.splice(to..to, part);
            }
            _ => {
                bytes[at] = if below(2) == 0 {
                    VALUES[below(10)]
                } else {
                    u8::try_from(below(256)).unwrap_or(0)
                }
            }
        }
        if bytes.is_empty() {
            bytes.push(0);
        }
    }
    bytes
}

#[test]
fn damaged_files_are_errors_or_structures_and_nothing_panics() {
    let mut numbers = Numbers(0x5eed_0016);
    let mut originals: Vec<(String, Vec<u8>)> = LAYOUTS
        .iter()
        .flat_map(|layout| FORMS.map(|form| format!("{layout}-{form}.op4")))
        .map(|name| (name.clone(), bytes(&name)))
        .collect();
    originals.push(("flex".into(), FLEX.as_bytes().to_vec()));
    originals.push(("npz".into(), npz::write(&example()).expect("it is written")));
    let (mut read, mut errors) = (0_u32, 0_u32);
    for (name, original) in &originals {
        for _ in 0..1500 {
            let bytes = damaged(original, &mut numbers);
            let result = match name.as_str() {
                "flex" => flex42::read(&bytes).and_then(flex42::Flex::structure).map(drop),
                "npz" => npz::read(&bytes).map(drop),
                _ => op4::read(&bytes)
                    .and_then(|all| all.iter().try_for_each(|matrix| matrix.dense().map(drop))),
            };
            match result {
                Ok(()) => read += 1,
                Err(error) => {
                    errors += 1;
                    assert!(!error.to_string().is_empty());
                }
            }
        }
    }
    // Both happen: a damage may be in a comment, or in a digit.
    assert!(read > 300 && errors > 10_000, "{read} read, {errors} errors");
}

#[test]
fn a_reduced_model_or_its_table_that_is_damaged_ends_in_an_error_or_in_checks() {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("damaged");
    fs::create_dir_all(&folder).expect("a folder");
    let mut numbers = Numbers(0x5eed_0017);
    let matrices = bytes("craig-bampton.op4");
    let table = "format = 1\nfile = \"model.op4\"\ndamping = 0.01\n[op4]\nmass = \"MXX\"\n\
                 stiffness = \"KXX\"\nrigid_modes = 6\n[[node]]\nname = \"root\"\n\
                 position = \"0, 0, 0 m\"\nrows = 1\n[[node]]\nname = \"tip\"\n\
                 position = \"2, 0, 0 m\"\nrows = 7\n";
    let path = folder.join("model.toml");
    let (mut read, mut errors) = (0_u32, 0_u32);
    for round in 0..600 {
        let (mut matrices, mut table) = (matrices.clone(), table.as_bytes().to_vec());
        match round % 3 {
            0 => matrices = damaged(&matrices, &mut numbers),
            1 => table = damaged(&table, &mut numbers),
            // Elements that are wrong and no more: the length stays.
            _ => {
                let at = usize::try_from(numbers.next().unwrap_or_default() % 6000).unwrap_or(0);
                matrices[at + 100] ^= 0x55;
            }
        }
        fs::write(folder.join("model.op4"), matrices).expect("a file");
        fs::write(&path, table).expect("a file");
        match structure_from_file(&path) {
            Ok(structure) => {
                read += 1;
                assert_eq!(structure.checks().len(), 5);
            }
            Err(error) => {
                errors += 1;
                assert!(!error.to_string().is_empty());
            }
        }
    }
    assert!(read > 20 && errors > 200, "{read} read, {errors} errors");
}
