//! The gates that a library for flight passes, and the deliberately bad ones that each must catch.
//!
//! A library is its package and its exports. By construction, the build has only `core` and so no
//! allocator, and the link has only the library.

use std::path::Path;

use super::board::Board;
use super::build;
use super::image::{Image, linked};
use super::tally::Tally;

/// A call may take this much stack, bytes: half of what a small Cortex-M7 has as closely coupled
/// memory.
pub(super) const LARGEST_STACK: u64 = 32 * 1024;

/// A library to be checked.
pub(super) struct Library<'a> {
    pub(super) package: &'a str,
    pub(super) features: &'a [&'a str],
    pub(super) exports: Vec<String>,
}

/// Builds, links and reads a library; returns its image if it passes every gate.
pub(super) fn passed(board: &Board, library: &Library<'_>) -> Result<Image, String> {
    let archive = build::library(board, library.package, library.features)?;
    no_panic_in(&archive)?;
    let path = linked(&archive, &library.exports)?;
    let image = Image::read(&path)?;
    every_export(&image, &library.exports)?;
    no_panic(&image)?;
    for export in &library.exports {
        let stack = image.stack(export)?;
        if stack > LARGEST_STACK {
            return Err(format!(
                "{export} takes up to {stack} bytes of stack, more than {LARGEST_STACK}; \
                 keep large values out of its frames"
            ));
        }
    }
    Ok(image)
}

/// Each bad library has to be rejected, for its own reason.
pub(super) fn twins(board: &Board, tally: &mut Tally) {
    // A good one first: else a rejection would prove nothing.
    let good = twin(board, &[]).map(|_| ());
    tally.check("gates: a valid library passes", good);
    for (feature, reason) in [
        ("allocates", "E0463"),
        ("panics", "can panic"),
        ("incomplete", "is no function of the library"),
        ("deep", "bytes of stack"),
        ("recursive", "calls itself"),
        ("indirect", "through a pointer"),
    ] {
        let caught = match twin(board, &[feature]) {
            Ok(_) => Err("it passed: the gate is blind".to_owned()),
            Err(why) if why.contains(reason) => Ok(()),
            Err(why) => Err(format!("rejected, but not since `{reason}`: {why}")),
        };
        tally.check(&format!("gates: a library that is bad ({feature}) is caught"), caught);
    }
}

fn twin(board: &Board, features: &[&str]) -> Result<Image, String> {
    let exports = vec!["precess_twin".to_owned()];
    passed(board, &Library { package: "precess-twins", features, exports })
}

fn every_export(image: &Image, exports: &[String]) -> Result<(), String> {
    let there = |export: &&String| image.functions().any(|function| function.name == **export);
    match exports.iter().find(|export| !there(export)) {
        Some(export) => Err(format!("{export} is no function of the library")),
        None => Ok(()),
    }
}

/// No function of what is linked belongs to a panic, its handler included.
fn no_panic(image: &Image) -> Result<(), String> {
    let name = image.functions().map(|function| &*function.name).find(|name| panics(name));
    name.map_or(Ok(()), |name| Err(can_panic(name)))
}

/// No object of the library as it is built names one: a library is linked by others, too.
fn no_panic_in(archive: &Path) -> Result<(), String> {
    use object::read::archive::ArchiveFile;
    use object::{Object, ObjectSymbol};

    let wrong = |error: &dyn std::fmt::Display| format!("{}: {error}", archive.display());
    let bytes = std::fs::read(archive).map_err(|error| wrong(&error))?;
    let members = ArchiveFile::parse(&*bytes).map_err(|error| wrong(&error))?;
    let mut objects = 0;
    for member in members.members() {
        let data = member.and_then(|member| member.data(&*bytes)).map_err(|error| wrong(&error))?;
        let file = object::File::parse(data).map_err(|error| wrong(&error))?;
        let mut names = file.symbols().filter_map(|symbol| symbol.name().ok());
        if let Some(name) = names.find(|name| panics(name) && !is_handler(name)) {
            return Err(can_panic(name));
        }
        objects += 1;
    }
    if objects == 0 { Err(wrong(&"no object in the library")) } else { Ok(()) }
}

fn can_panic(name: &str) -> String {
    format!("the library can panic: {name} is linked; find the index, the unwrap or the division")
}

/// Whether a symbol belongs to a panic.
fn panics(name: &str) -> bool {
    let of_panics = ["panicking", "unwrap_failed", "expect_failed", "_fail"];
    is_handler(name) || of_panics.iter().any(|part| name.contains(part))
}

/// The handler, which every static library has to bring, reached or not.
fn is_handler(name: &str) -> bool {
    name.contains("rust_begin_unwind")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn symbols_of_panics_are_known() {
        for name in [
            "_RNvNtCs_4core9panicking18panic_bounds_check",
            "_RNvNtCs_4core6option13unwrap_failed",
            "_RNvNtCs_4core6option13expect_failed",
            "_RNvNtCs_4core5slice5index26slice_index_order_fail",
            "rust_begin_unwind",
        ] {
            assert!(panics(name), "{name}");
        }
        assert!(!panics("precess_dgvscmg_4_step"));
    }
}
