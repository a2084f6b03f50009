//! Shapes: devices of one kind with the same assumptions share one kernel.
//!
//! Invariant: shapes are in the order of their first device, and so are the devices of each; the
//! hub's equations are added up in that order.

use precess_codegen::derivation::chain::Chain;
use precess_codegen::derivation::chain::assumed::{Assumed, Exchange, Mount, Turns};
use precess_codegen::emit::{StandaloneKernels, standalone_kernels};
use precess_codegen::graph::Graph;
use precess_codegen::kernel::{Record, parameters_of};
use precess_codegen::kinds::{KINDS, Kind, Link};
use precess_codegen::proof::{Comparison, prove_assumed};
use precess_description::{Body, Description, Device};
use serde::Serialize;

use crate::assumed::assumed;
use crate::by_hand::mount::{Turned, turned};
use crate::error::BakeError;
use crate::fold::only_tested;
use crate::options::{Language, Options};
use crate::parameters::check;
use crate::templates::COMMAND;

/// Devices that share a kernel.
pub(crate) struct Shape<'a> {
    /// The kind with locked joints, under the name of the emitted module.
    pub(crate) kind: &'static Kind,
    /// As it is for everybody.
    pub(crate) general: &'static Kind,
    pub(crate) assumed: Assumed,
    pub(crate) devices: Vec<&'a Device>,
}

/// What is emitted and shown of a shape.
pub(crate) struct Derived {
    pub(crate) emitted: StandaloneKernels,
    /// What is left of the parameters.
    pub(crate) parameters: Record,
    pub(crate) proof: Vec<Comparison>,
}

/// Modules of every emitted crate, fields of its records and locals of its functions.
const TAKEN: [&str; 25] = [
    "assembly",
    "body",
    "check",
    "constants",
    "drive",
    "failed",
    "finite",
    "fmt",
    "force",
    "found",
    "hub",
    "inputs",
    "kernels",
    "mount",
    "number",
    "omega",
    "omega_dot",
    "parameters",
    "r_b_n_ddot",
    "real",
    "rigid",
    "sin_cos",
    "solve",
    "tests",
    "torque_b",
];

/// Names that a spacecraft may not have: those of files and records that are emitted beside it.
const NOT_OF_A_SPACECRAFT: [&str; 4] = ["alloc", "kernels", "proc_macro", "test_reference"];

/// Headers of the standard library of C: an emitted one of that name would be included in its place.
const C_HEADERS: &str = "\
    assert complex ctype errno fenv float inttypes iso646 limits locale math setjmp signal stdalign \
    stdarg stdatomic stdbool stddef stdint stdio stdlib stdnoreturn string tgmath threads time uchar \
    wchar wctype";

/// Operations of an evaluation of the hub by itself, 183 of them in the checks of its pivots: the
/// suite `operations` of the emitted crates counts them.
pub const HUB_OPERATIONS: usize = 415;

/// Sums of a device's share into the hub's equations, counted likewise.
pub const SUM_OPERATIONS: usize = 36;

/// The shapes of a spacecraft.
pub(crate) fn shapes(description: &Description) -> Result<Vec<Shape<'_>>, BakeError> {
    let mut list: Vec<Shape<'_>> = Vec::new();
    let own = description.name.as_str();
    check_name(own)?;
    for device in &description.device {
        let known = KINDS.iter().find(|kind| kind.name == device.kind);
        let unknown = || BakeError::Kind(device.name.clone(), device.kind.clone());
        let general: &'static Kind = known.copied().ok_or_else(unknown)?;
        check(general, device)?;
        let assumed = assumed(general, device)?;
        let locked = locked(device);
        has_inertia(general, device, &locked)?;
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
        let name = free_name(&device.name, own, &list);
        // A kind lives as long as the program: a few per call, and a call per program.
        let links = Box::leak(links.into_boxed_slice());
        let kind = Kind { name: Box::leak(name.into_boxed_str()), links, ..*general };
        let kind = Box::leak(Box::new(kind));
        list.push(Shape { kind, general, assumed, devices: vec![device] });
    }
    if list.iter().all(Shape::is_rigid) {
        return Err(BakeError::Rigid);
    }
    for shape in &list {
        for device in &shape.devices {
            turns(shape, device)?;
        }
    }
    Ok(list)
}

/// Whether files and records may have the spacecraft's name.
pub(crate) fn check_name(own: &str) -> Result<(), BakeError> {
    let reserved = NOT_OF_A_SPACECRAFT.contains(&own)
        || C_HEADERS.split_whitespace().any(|header| header == own)
        || own.starts_with("precess");
    if reserved || is_keyword(own) || own.contains("__") || own.ends_with('_') {
        return Err(BakeError::Name(own.to_owned()));
    }
    Ok(())
}

/// The turns of a device's mount, where it is made of some.
pub(crate) fn turns(shape: &Shape<'_>, device: &Device) -> Result<Option<Turned>, BakeError> {
    let Mount::Turned { outer, turns, inner } = shape.assumed.mount else { return Ok(None) };
    let rows = |of: Exchange| [0, 1, 2].map(|row| [0, 1, 2].map(|column| of.entry(row, column)));
    let found = turned(&device.mount, &rows(outer), &rows(inner), turns.angles().len());
    found.map(Some).map_err(|off| BakeError::Mount(device.name.clone(), off.off, off.bound))
}

/// Operations of one evaluation, sines apart.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub struct Operations {
    /// Of the emitted kernels, sums into the hub's equations and their solution included.
    pub baked: usize,
    /// Of the general kernels of the same devices, counted alike.
    pub general: usize,
}

/// Whether something moves with each joint that has a motor.
fn has_inertia(kind: &Kind, device: &Device, locked: &[bool]) -> Result<(), BakeError> {
    let something = |body: &Body| {
        body.mass != 0.0 || body.inertia.as_flattened().iter().any(|entry| *entry != 0.0)
    };
    for (k, link) in kind.links.iter().enumerate() {
        let moves = link.is_driven() && !locked[k];
        if moves && !device.body[k..].iter().any(something) {
            let (name, body) = (device.name.clone(), link.body.title);
            return Err(BakeError::Massless(name, body.to_owned()));
        }
    }
    Ok(())
}

/// Whether each joint is locked.
fn locked(device: &Device) -> Vec<bool> {
    device.body.iter().map(|body| body.locked_at.is_some()).collect()
}

/// The device's name without its number; with it, or with more, where that is taken.
fn free_name(device: &str, spacecraft: &str, list: &[Shape<'_>]) -> String {
    let stem = device.trim_end_matches(|c: char| c.is_ascii_digit() || c == '_');
    let is_free = |name: &str| {
        let keyword = is_keyword(name) || TAKEN.contains(&name) || name == spacecraft;
        !name.is_empty() && !keyword && list.iter().all(|shape| shape.kind.name != name)
    };
    let named = [stem, device].into_iter().find(|name| is_free(name)).map(str::to_owned);
    let numbered =
        || (1..=list.len() + 1).map(|n| format!("{device}_{n}")).find(|name| is_free(name));
    named.or_else(numbered).unwrap_or_default()
}

/// Words that are no names in Rust, C or C++.
pub(crate) fn is_keyword(name: &str) -> bool {
    const WORDS: &str = "\
        abstract alignas alignof and and_eq as asm async auto await become bitand bitor bool box \
        break case catch char class compl const constexpr continue core crate decltype default \
        delete do double dyn else enum explicit export extern false final float fn for friend \
        gen goto if impl in inline int let long loop macro main match mod move mut mutable \
        namespace new noexcept not not_eq nullptr operator or or_eq override priv private \
        protected pub public ref register restrict return self short signed sizeof static \
        static_assert std struct super switch template test this thread_local throw trait true \
        try type typedef typeid typename typeof union unsafe unsigned unsized use using virtual \
        void volatile wchar_t where while xor xor_eq yield";
    WORDS.split_whitespace().any(|word| word == name)
}

impl Shape<'_> {
    /// Whether every joint is locked for good: its devices are bodies of the hub.
    pub(crate) fn is_rigid(&self) -> bool {
        self.kind.links.iter().all(Link::is_locked)
    }

    /// Derives and proves.
    pub(crate) fn derived(&self, options: Options) -> Result<Derived, BakeError> {
        let graph = Graph::new();
        let chain = Chain::assuming(&graph, self.kind, self.assumed.clone());
        let mut emitted = standalone_kernels(&chain, COMMAND)?;
        // A module of a rigid shape is for the tests as a whole.
        if options.constants && options.language == Language::Rust && !self.is_rigid() {
            emitted.file.text = only_tested(&emitted.file.text);
        }
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
            let states = |device: &&&Device| device.turns.is_some();
            let known = match self.devices.iter().filter(states).count() {
                0 => "found in its numbers",
                count if count == self.devices.len() => "as its turns are stated",
                _ => "as stated of some of them, found in the numbers of the others",
            };
            lines.push(format!("{of}: the mount is {turns}, {known}"));
        }
        for link in self.kind.links.iter().filter(|link| link.is_locked()) {
            lines.push(format!("{of}: the {} is locked for good", link.body.title));
        }
        if self.is_rigid() {
            lines.push(format!("{of}: no joint moves, so it is part of the hub"));
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
    let (mut baked, mut general) = (HUB_OPERATIONS, HUB_OPERATIONS);
    for (shape, derived) in shapes.iter().zip(derived) {
        let own = derived.emitted.functions.iter().filter(|(name, ..)| evaluated(name));
        let own: usize = own.map(|(.., count)| count).sum();
        let graph = Graph::new();
        let whole = Chain::assuming(&graph, shape.general, Assumed::default());
        let whole = standalone_kernels(&whole, COMMAND)?.functions;
        let whole = whole.iter().filter(|(name, ..)| evaluated(name));
        let whole: usize = whole.map(|(.., count)| count).sum();
        if !shape.is_rigid() {
            baked += shape.devices.len() * (own + SUM_OPERATIONS);
        }
        general += shape.devices.len() * (whole + SUM_OPERATIONS);
    }
    Ok(Operations { baked, general })
}
