//! The page of kinds: the chain of each, its symbols with their units, what is zero in it and left
//! out, and what its functions cost.

use serde::Serialize;

use crate::notation::{Accent, symbol};
use precess_codegen::derivation::chain::Chain;
use precess_codegen::emit::Emitted;
use precess_codegen::kernel::{Kernel, Record, kernels, motors, parameters, pose, rates};
use precess_codegen::kinds::{Centre, Inertia, Kind, Link, Motion};

/// One kind, as the page describes it.
#[derive(Clone, Debug, Serialize)]
pub struct KindText {
    name: &'static str,
    title: &'static str,
    links: Vec<LinkText>,
    symbols: Vec<SymbolText>,
    /// Angles that no equation knows.
    unknown: Vec<String>,
    /// Values that are zero in every state, by the functions that would return them.
    zero: Vec<ZeroText>,
    operations: Vec<(String, usize)>,
}

#[derive(Clone, Debug, Serialize)]
struct LinkText {
    body: &'static str,
    joint: String,
    coordinate: String,
    rate: String,
    drive: String,
    origin: String,
    mass: String,
    centre: String,
    inertia: String,
}

#[derive(Clone, Debug, Serialize)]
struct SymbolText {
    latex: String,
    name: String,
    doc: String,
}

#[derive(Clone, Debug, Serialize)]
struct ZeroText {
    function: String,
    names: Vec<String>,
}

/// The table of operations: functions that every kind has, and the bodies' together.
#[derive(Serialize)]
pub(super) struct Costs {
    functions: Vec<String>,
    rows: Vec<CostRow>,
}

#[derive(Serialize)]
struct CostRow {
    name: &'static str,
    counts: Vec<usize>,
    bodies: usize,
}

impl KindText {
    /// What there is to tell of a kind.
    #[must_use]
    pub fn of_chain(chain: &Chain<'_>, emitted: &Emitted) -> Self {
        let kind = chain.kind;
        let turning: Vec<_> = kind.turning().map(|link| link.joint.coordinate).collect();
        let turned = |link: &&Link| matches!(link.joint.motion, Motion::Turn(_));
        let angles = kind.links.iter().filter(turned).map(|link| link.joint.coordinate);
        let unknown = angles.filter(|angle| !turning.contains(angle));
        Self {
            name: kind.name,
            title: kind.title,
            links: (0..kind.links.len()).map(|k| link_text(chain, k)).collect(),
            symbols: symbols(kind),
            unknown: unknown.map(math).collect(),
            zero: kernels(chain).iter().filter_map(|kernel| zero(kind, kernel)).collect(),
            operations: emitted.operations(),
        }
    }
}

impl Costs {
    /// What the functions of all kinds cost.
    pub(super) fn of_kinds(kinds: &[KindText]) -> Self {
        let everywhere = |name: &&String| {
            kinds.iter().all(|kind| kind.operations.iter().any(|(function, _)| function == *name))
        };
        let first = kinds.iter().take(1).flat_map(|kind| &kind.operations);
        let functions: Vec<String> =
            first.map(|(name, _)| name).filter(everywhere).cloned().collect();
        let row = |kind: &KindText| {
            let count = |name: &String| {
                kind.operations
                    .iter()
                    .find(|(function, _)| function == name)
                    .map(|(_, count)| *count)
            };
            let counts: Vec<usize> = functions.iter().filter_map(count).collect();
            let all: usize = kind.operations.iter().map(|(_, count)| count).sum();
            CostRow { name: kind.name, bodies: all - counts.iter().sum::<usize>(), counts }
        };
        Self { rows: kinds.iter().map(row).collect(), functions }
    }
}

fn link_text(chain: &Chain<'_>, k: usize) -> LinkText {
    let Link { joint, body, .. } = &chain.kind.links[k];
    let axis = chain.triad(k)[joint.motion.axis().cycle()[0]];
    let hat = math(&format!("{axis}_hat"));
    LinkText {
        body: body.title,
        joint: match joint.motion {
            Motion::Turn(_) => format!("turns about {hat}"),
            Motion::Slide(_) => format!("slides along {hat}"),
        },
        coordinate: math(joint.coordinate),
        rate: math(joint.rate),
        drive: math(joint.torque),
        origin: joint.place().map_or("the parent's".to_owned(), |place| math(place.name)),
        mass: body.mass.map_or("none".to_owned(), math),
        centre: match body.centre {
            Centre::Free(place) => math(place.name),
            Centre::On(axis, distance) => {
                let along = body.triad[axis.cycle()[0]];
                format!("{} along {}", math(distance), math(&format!("{along}_hat")))
            }
            Centre::At => "at its origin".to_owned(),
        },
        inertia: match body.inertia {
            Inertia::Full(_) => "full".to_owned(),
            Inertia::Diagonal(_) => "no products".to_owned(),
            Inertia::Symmetric(axis, _) => {
                let about = body.triad[axis.cycle()[0]];
                format!("symmetric about {}", math(&format!("{about}_hat")))
            }
            Inertia::Point => "none: a point mass".to_owned(),
        },
    }
}

/// Parameters, pose, rates and drives, each as the emitted code documents it.
fn symbols(kind: &Kind) -> Vec<SymbolText> {
    let pose = pose(kind).into_iter().map(|(_, record)| record);
    let records = std::iter::once(parameters(kind)).chain(pose).chain([rates(kind), motors(kind)]);
    let text = |field: precess_codegen::kernel::Field| SymbolText {
        latex: symbol(&field.name, Accent::Plain),
        doc: field.doc.split_once(": ").map_or(field.doc.as_str(), |(_, what)| what).to_owned(),
        name: field.name,
    };
    records.flat_map(|record: Record| record.fields).map(text).collect()
}

/// What a function would return but for the kind: claimed vectors and tensors that are zero in every
/// state, and gains.
fn zero(kind: &Kind, kernel: &Kernel<'_>) -> Option<ZeroText> {
    let emitted: Vec<&String> = kernel
        .sections
        .iter()
        .flat_map(|section| &section.statements)
        .map(|statement| &statement.name)
        .collect();
    let claimed = kernel
        .claims
        .iter()
        .filter(|claim| claim.components.iter().all(|(name, _)| !emitted.contains(&name)));
    let mut names: Vec<String> = claimed.map(|claim| claim.name.clone()).collect();
    if kernel.name == "eliminate" {
        // What the hub has a part in is emitted under names of its own, and never zero.
        let whole = kind.links[0].assembly;
        let shared = [format!("mr_{whole}_b"), format!("i_{whole}_b")];
        names.retain(|name| !shared.contains(name) && !name.ends_with("_rest"));
        let returned = kernel.output.sources();
        names.extend(gains(kind).into_iter().filter(|gain| !returned.contains(gain)));
    }
    let names: Vec<_> = names.into_iter().map(|name| format!("`{name}`")).collect();
    (!names.is_empty()).then(|| ZeroText { function: kernel.name.clone(), names })
}

/// The gains of every joint on the hub and on the joints nearer to it.
fn gains(kind: &Kind) -> Vec<String> {
    let hub = ["v1", "v2", "v3", "w1", "w2", "w3"];
    let tags: Vec<_> = kind.links.iter().map(|link| link.joint.tag).collect();
    let of = |(k, tag): (usize, &&str)| {
        let nearer = hub.iter().chain(&tags[..k]);
        nearer.map(|other| format!("gain_{tag}_{other}")).collect::<Vec<_>>()
    };
    tags.iter().enumerate().flat_map(of).collect()
}

fn math(name: &str) -> String {
    format!("${}$", symbol(name, Accent::Plain))
}
