//! A linked library for Cortex-M: its functions, how large they and their frames are, and which
//! calls which.
//!
//! Sizes come from the symbol table, frames from the section that the compiler writes for this
//! (`-Z emit-stack-sizes`), calls from the instructions themselves: what was inlined, merged or
//! turned into a jump is as the processor finds it.

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};
use std::process::Command;

use object::read::elf::ElfFile32;
use object::{Endianness, Object, ObjectSection, ObjectSymbol, SymbolKind};

use super::thumb::{Flow, flows};

/// A function.
pub(super) struct Function {
    pub(super) name: String,
    pub(super) size: u64,
    /// Bytes of stack it takes, saved registers included; `None` where the compiler does not state
    /// it.
    frame: Option<u64>,
    /// The functions that it may call or jump to.
    calls: BTreeSet<u32>,
    /// Whether it may go to an address that the image does not contain.
    indirect: bool,
}

/// Functions by address.
pub(super) struct Image {
    functions: BTreeMap<u32, Function>,
    /// Bytes of code and constants.
    pub(super) text: u64,
}

/// Links only a library, keeping only what the exports reach. That it links shows that
/// nothing is missing: no C library, no allocator.
pub(super) fn linked(library: &Path, exports: &[String]) -> Result<PathBuf, String> {
    let image = library.with_extension("elf");
    let mut linker = Command::new("ld.lld");
    linker.args(["-m", "armelf", "--gc-sections", "--entry=0", "-o"]).arg(&image);
    linker.args(exports.iter().map(|export| format!("--undefined={export}"))).arg(library);
    let output = linker.output().map_err(|error| format!("ld.lld did not start: {error}"))?;
    if output.status.success() {
        return Ok(image);
    }
    Err(format!(
        "{} does not link:\n{}",
        library.display(),
        String::from_utf8_lossy(&output.stderr)
    ))
}

impl Image {
    /// Reads a linked image.
    pub(super) fn read(path: &Path) -> Result<Self, String> {
        let wrong = |error: &dyn std::fmt::Display| format!("{}: {error}", path.display());
        let bytes = std::fs::read(path).map_err(|error| wrong(&error))?;
        let file: ElfFile32<'_, Endianness> =
            ElfFile32::parse(&*bytes).map_err(|error| wrong(&error))?;
        let mut frames = BTreeMap::new();
        let mut text = 0;
        for section in file.sections() {
            let name = section.name().map_err(|error| wrong(&error))?;
            if name == ".stack_sizes" {
                let data = section.data().map_err(|error| wrong(&error))?;
                frames.extend(stack_sizes(data).ok_or_else(|| wrong(&"frames cut short"))?);
            }
            if [".text", ".rodata"].iter().any(|kind| name.starts_with(kind)) {
                text += section.size();
            }
        }
        // `$t` begins code, `$d` data within it.
        let marks: BTreeMap<u32, bool> = file
            .symbols()
            .filter_map(|symbol| match symbol.name().ok()?.get(..2)? {
                "$t" => Some((address(symbol.address()), true)),
                "$d" => Some((address(symbol.address()), false)),
                _ => None,
            })
            .collect();
        let mut functions = BTreeMap::new();
        let of_code = file.symbols().filter(|symbol| symbol.kind() == SymbolKind::Text);
        for symbol in of_code.filter(|symbol| symbol.is_definition() && symbol.size() > 0) {
            let at = address(symbol.address()) & !1;
            let index = symbol.section_index().ok_or_else(|| wrong(&"a function nowhere"))?;
            let section = file.section_by_index(index).map_err(|error| wrong(&error))?;
            let code = section.data_range(u64::from(at), symbol.size());
            let code =
                code.map_err(|error| wrong(&error))?.ok_or_else(|| wrong(&"code cut short"))?;
            let inside = at..at.wrapping_add(address(symbol.size()));
            let found: Vec<Flow> = pieces(code, at, &marks)
                .flat_map(|(piece, at)| flows(piece, at))
                .filter(|flow| !matches!(flow, Flow::To(to) if inside.contains(to) && *to != at))
                .collect();
            let calls = found.iter().filter_map(|flow| match flow {
                Flow::To(to) => Some(*to),
                Flow::Anywhere => None,
            });
            let function = Function {
                name: symbol.name().map_err(|error| wrong(&error))?.to_owned(),
                size: symbol.size(),
                frame: frames.get(&at).copied(),
                calls: calls.collect(),
                indirect: found.contains(&Flow::Anywhere),
            };
            // Of two names for one address the one that sorts first: it does not matter, but is the
            // same.
            match functions.get(&at) {
                Some(Function { name, .. }) if *name <= function.name => {}
                _ => drop(functions.insert(at, function)),
            }
        }
        Ok(Self { functions, text })
    }

    /// Every function.
    pub(super) fn functions(&self) -> impl Iterator<Item = &Function> {
        self.functions.values()
    }

    /// Bytes of code that a function reaches, its own included.
    pub(super) fn reach(&self, name: &str) -> Result<u64, String> {
        let mut seen = BTreeSet::new();
        let mut open = vec![self.find(name)?];
        while let Some(at) = open.pop() {
            if seen.insert(at) {
                open.extend(self.get(at)?.calls.iter().copied());
            }
        }
        Ok(seen.iter().filter_map(|at| self.functions.get(at)).map(|function| function.size).sum())
    }

    /// Bytes of stack that a call of a function takes at most: the largest sum of frames along any
    /// chain of calls.
    pub(super) fn stack(&self, name: &str) -> Result<u64, String> {
        self.deepest(self.find(name)?, &mut BTreeMap::new())
    }

    /// The largest sum of frames from a function on; `known` has the sums of others, `None` for one
    /// that is being computed.
    fn deepest(&self, at: u32, known: &mut BTreeMap<u32, Option<u64>>) -> Result<u64, String> {
        let function = self.get(at)?;
        let name = &function.name;
        match known.get(&at) {
            Some(Some(sum)) => return Ok(*sum),
            Some(None) => return Err(format!("{name} calls itself: no sum bounds its stack")),
            None => {}
        }
        if function.indirect {
            return Err(format!(
                "{name} jumps or calls through a pointer: no sum bounds its stack"
            ));
        }
        let frame = function.frame.ok_or_else(|| format!("the frame of {name} is not known"))?;
        known.insert(at, None);
        let mut deepest = 0;
        for &callee in &function.calls {
            deepest = deepest.max(self.deepest(callee, known)?);
        }
        known.insert(at, Some(frame + deepest));
        Ok(frame + deepest)
    }

    fn find(&self, name: &str) -> Result<u32, String> {
        let found = self.functions.iter().find(|(_, function)| function.name == name);
        found.map(|(at, _)| *at).ok_or_else(|| format!("no function is called {name}"))
    }

    fn get(&self, at: u32) -> Result<&Function, String> {
        self.functions.get(&at).ok_or_else(|| format!("no function begins at {at:#x}"))
    }
}

/// The pieces of a function that are code, each with its address.
fn pieces<'a>(
    code: &'a [u8],
    at: u32,
    marks: &'a BTreeMap<u32, bool>,
) -> impl Iterator<Item = (&'a [u8], u32)> {
    let end = at.wrapping_add(u32::try_from(code.len()).unwrap_or(u32::MAX));
    let inside = marks.range(at..end).map(|(address, is_code)| (*address, *is_code));
    let starts: Vec<(u32, bool)> = std::iter::once((at, true)).chain(inside).collect();
    let ends: Vec<u32> = starts.iter().skip(1).map(|(address, _)| *address).chain([end]).collect();
    starts.into_iter().zip(ends).filter(|((_, is_code), _)| *is_code).filter_map(
        move |((start, _), end)| {
            let range = start.wrapping_sub(at) as usize..end.wrapping_sub(at) as usize;
            Some((code.get(range)?, start))
        },
    )
}

/// The compiler's section: of each function its address, four bytes, and its frame, LEB128.
fn stack_sizes(mut data: &[u8]) -> Option<Vec<(u32, u64)>> {
    let mut found = Vec::new();
    while !data.is_empty() {
        let (at, rest) = data.split_first_chunk::<4>()?;
        let digits = rest.iter().position(|byte| byte & 0x80 == 0)?;
        let (frame, rest) = rest.split_at_checked(digits + 1)?;
        let size = frame.iter().rev().fold(0_u64, |sum, byte| sum << 7 | u64::from(byte & 0x7F));
        // The lowest bit says Thumb.
        found.push((u32::from_le_bytes(*at) & !1, size));
        data = rest;
    }
    Some(found)
}

/// An address of a 32-bit image.
fn address(wide: u64) -> u32 {
    u32::try_from(wide).unwrap_or(u32::MAX)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn image(functions: &[(u32, u64, &[u32], bool)]) -> Image {
        let function = |&(at, frame, calls, indirect): &(u32, u64, &[u32], bool)| {
            let name = format!("f{at}");
            let calls = calls.iter().copied().collect();
            (at, Function { name, size: 10, frame: Some(frame), calls, indirect })
        };
        Image { functions: functions.iter().map(function).collect(), text: 0 }
    }

    #[test]
    fn stack_is_the_deepest_chain_of_calls() {
        let found = image(&[
            (0, 8, &[2, 4], false),
            (2, 100, &[], false),
            (4, 16, &[6], false),
            (6, 90, &[], false),
            (8, 999, &[], false),
        ]);
        assert_eq!(found.stack("f0"), Ok(8 + 16 + 90));
        assert_eq!(found.reach("f0"), Ok(40));
    }

    #[test]
    fn stack_that_no_sum_bounds_is_rejected() {
        let recursive = image(&[(0, 8, &[2], false), (2, 8, &[0], false)]);
        assert!(recursive.stack("f0").unwrap_err().contains("calls itself"));
        let indirect = image(&[(0, 8, &[], true)]);
        assert!(indirect.stack("f0").unwrap_err().contains("through a pointer"));
    }

    #[test]
    fn frames_are_read_as_written() {
        let data = [1, 0x10, 0, 0, 0x88, 0x0e, 0x20, 0, 0, 0, 5];
        assert_eq!(stack_sizes(&data), Some(vec![(0x1000, 1800), (0x20, 5)]));
        assert_eq!(stack_sizes(&data[..7]), None);
    }
}
