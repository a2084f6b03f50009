//! Shapes: devices of one kind with the same assumptions share one kernel.
//!
//! Invariant: shapes are in the order of their first device, and so are the devices of each; the
//! hub's equations are added up in that order.

use precess_codegen::derivation::assumed::{Assumed, Mount, Turns};
use precess_codegen::derivation::chain::Chain;
use precess_codegen::emit::{Alone, alone};
use precess_codegen::graph::Graph;
use precess_codegen::kernel::{Record, parameters_of};
use precess_codegen::kinds::{KINDS, Kind, Link};
use precess_codegen::proof::{Row, prove_assumed};
use precess_description::{Description, Device};

use crate::assumed::assumed;
use crate::error::BakeError;
use crate::parameters::check;
use crate::{COMMAND, Operations};

/// Devices that share a kernel.
pub(crate) struct Shape<'a> {
    /// The module and, for the compiler's sake, of the same name: the kind with what is locked.
    pub(crate) kind: &'static Kind,
    /// As it is for everybody.
    pub(crate) general: &'static Kind,
    pub(crate) assumed: Assumed,
    pub(crate) devices: Vec<&'a Device>,
}

/// What is emitted and shown of a shape.
pub(crate) struct Derived {
    pub(crate) emitted: Alone,
    /// What is left of the parameters.
    pub(crate) parameters: Record,
    pub(crate) proof: Vec<Row>,
}

/// Modules that every emitted crate has.
const TAKEN: [&str; 8] = ["body", "check", "hub", "kernels", "mount", "real", "sin_cos", "solve"];

/// Operations of an evaluation of the hub by itself, as the suite `operations` counts them.
const HUB: usize = 255;

/// Sums of a device's share into the hub's equations.
const SUMS: usize = 36;

/// The shapes of a spacecraft.
pub(crate) fn shapes(description: &Description) -> Result<Vec<Shape<'_>>, BakeError> {
    let mut list: Vec<Shape<'_>> = Vec::new();
    for device in &description.device {
        let known = KINDS.iter().find(|kind| kind.name == device.kind);
        let unknown = || BakeError::Kind(device.name.clone(), device.kind.clone());
        let general: &'static Kind = known.copied().ok_or_else(unknown)?;
        check(general, device)?;
        let assumed = assumed(general, device)?;
        let locked = locked(device);
        let same = |shape: &&mut Shape<'_>| {
            let own = self::locked(shape.devices[0]);
            shape.general.name == general.name && shape.assumed == assumed && own == locked
        };
        if let Some(shape) = list.iter_mut().find(same) {
            shape.devices.push(device);
            continue;
        }
        let links = general.links.iter().zip(&locked);
        let links: Vec<Link> =
            links.map(|(link, locked)| if *locked { link.locked() } else { *link }).collect();
        let name = free_name(&device.name, &list);
        // A kind lives as long as the program: a few per call, and a call per program.
        let links = Box::leak(links.into_boxed_slice());
        let kind = Kind { name: Box::leak(name.into_boxed_str()), links, ..*general };
        let kind = Box::leak(Box::new(kind));
        list.push(Shape { kind, general, assumed, devices: vec![device] });
    }
    Ok(list)
}

/// Whether each joint is locked. Where all are, the last one stays a joint: a device without one has
/// no equation to emit.
fn locked(device: &Device) -> Vec<bool> {
    let mut locked: Vec<_> = device.body.iter().map(|body| body.locked_at.is_some()).collect();
    if let [.., last] = locked.as_mut_slice()
        && device.body.iter().all(|body| body.locked_at.is_some())
    {
        *last = false;
    }
    locked
}

/// The device's name without its number; with it, or with more, where that is taken.
fn free_name(device: &str, list: &[Shape<'_>]) -> String {
    let stem = device.trim_end_matches(|c: char| c.is_ascii_digit() || c == '_');
    let is_free = |name: &str| {
        let keyword = syn_keyword(name) || TAKEN.contains(&name);
        !name.is_empty() && !keyword && list.iter().all(|shape| shape.kind.name != name)
    };
    let named = [stem, device].into_iter().find(|name| is_free(name)).map(str::to_owned);
    let numbered =
        || (1..=list.len() + 1).map(|n| format!("{device}_{n}")).find(|name| is_free(name));
    named.or_else(numbered).unwrap_or_default()
}

/// Words that are no names in Rust or in C.
fn syn_keyword(name: &str) -> bool {
    const WORDS: [&str; 52] = [
        "as", "async", "auto", "await", "box", "break", "case", "char", "const", "continue",
        "crate", "default", "do", "double", "dyn", "else", "enum", "extern", "false", "float",
        "fn", "for", "goto", "if", "impl", "in", "inline", "int", "let", "long", "loop", "match",
        "mod", "move", "mut", "pub", "ref", "register", "restrict", "return", "self", "short",
        "static", "struct", "super", "switch", "trait", "true", "type", "unsafe", "use", "while",
    ];
    WORDS.contains(&name)
}

impl Shape<'_> {
    /// Derives and proves.
    pub(crate) fn derived(&self) -> Result<Derived, BakeError> {
        let graph = Graph::new();
        let chain = Chain::assuming(&graph, self.kind, self.assumed.clone());
        let emitted = alone(&chain, COMMAND)?;
        let files = std::slice::from_ref(&emitted.file);
        let proof = prove_assumed(&chain, self.general, files)?;
        Ok(Derived { parameters: parameters_of(&chain), proof, emitted })
    }

    /// What is assumed, a line for each.
    pub(crate) fn assumptions(&self) -> Vec<String> {
        let names: Vec<_> = self.devices.iter().map(|device| device.name.as_str()).collect();
        let of = names.join(", ");
        let mut lines = vec![format!("{of}: {}", self.general.title)];
        let zero: Vec<_> = self.assumed.zero.iter().map(String::as_str).collect();
        if !zero.is_empty() {
            lines.push(format!("{of}: zero are {}", zero.join(", ")));
        }
        for (name, other) in &self.assumed.equal {
            lines.push(format!("{of}: {name} equals {other}"));
        }
        if let Mount::Turned { turns, .. } = self.assumed.mount {
            let turns = match turns {
                Turns::None => "whole quarter turns about the axes of B",
                Turns::One => "one turn about a coordinate axis, between quarter turns",
                Turns::Two => "two turns about coordinate axes, between quarter turns",
            };
            lines.push(format!("{of}: the mount is {turns}"));
        }
        for link in self.kind.links.iter().filter(|link| link.is_locked()) {
            lines.push(format!("{of}: the {} is locked for good", link.body.title));
        }
        lines
    }
}

/// Operations of an evaluation, of the emitted kernels and of the general ones.
pub(crate) fn operations(
    shapes: &[Shape<'_>],
    derived: &[Derived],
) -> Result<Operations, BakeError> {
    let evaluated = |name: &str| ["eliminate", "back_substitute"].contains(&name);
    let (mut baked, mut general) = (HUB, HUB);
    for (shape, derived) in shapes.iter().zip(derived) {
        let own = derived.emitted.functions.iter().filter(|(name, ..)| evaluated(name));
        let own: usize = own.map(|(.., count)| count).sum();
        let graph = Graph::new();
        let whole = Chain::assuming(&graph, shape.general, Assumed::default());
        let whole = alone(&whole, COMMAND)?.functions;
        let whole = whole.iter().filter(|(name, ..)| evaluated(name));
        let whole: usize = whole.map(|(.., count)| count).sum();
        baked += shape.devices.len() * (own + SUMS);
        general += shape.devices.len() * (whole + SUMS);
    }
    Ok(Operations { baked, general })
}
