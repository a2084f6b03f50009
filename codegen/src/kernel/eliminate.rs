//! The kernel `eliminate`: the hot path.

use super::function::inputs;
use super::{Claim, Kernel, Record, records};
use crate::derivation::chain::Chain;
use crate::derivation::chain::parallel_axes::ParallelAxes;
use crate::derivation::elimination::{Eliminated, HUB, eliminate};
use crate::derivation::inward_pass::inward_pass;
use crate::derivation::reference;
use crate::derivation::script::Script;
use crate::derivation::share::Named;
use crate::kinds::{Kind, Link, Motion, cited};

/// The kernel, the elimination it is built from, and what back substitution needs of its result.
#[must_use]
pub(super) fn kernel<'g>(chain: &Chain<'g>) -> (Kernel<'g>, Eliminated<'g>, Record) {
    let mut script = Script::new(chain.graph);
    let share = inward_pass(chain, &mut script);
    let eliminated = eliminate(chain, &share, &mut script);
    let kind = chain.kind;
    let gains = gains(kind, &eliminated);
    let drives = [("u", records::motors(kind)), ("m", records::modes(kind))];
    let kernel = Kernel {
        name: "eliminate".to_owned(),
        doc: doc(kind),
        inputs: inputs(kind, [("w", records::body_rate())].into_iter().chain(drives)),
        sections: script.sections,
        output: output(kind, &eliminated, &gains),
        hoisted: true,
        claims: claims(
            kind,
            [reference::share(chain).named(kind, Link::is_driven), across(chain)].concat(),
        ),
    };
    (kernel, eliminated, gains)
}

/// The documentation. A kind whose joints all keep their rates has nothing to eliminate.
fn doc(kind: &Kind) -> Vec<String> {
    let torques = cited(kind.driven(), |equations| equations.torque);
    let motors = [
        &format!("Translation (16), rotation (75), motor torques {torques}; with the joints"),
        "eliminated by `M = L D Lᵀ`, six equations for the hub are left. A joint whose",
        "acceleration is given has no equation: what it requires goes to the right side.",
    ];
    let none = [
        "Translation (16), rotation (75). Every joint of the kind keeps its rate and has no",
        "equation: what the rates require goes to the right side.",
    ];
    let what =
        ["Mass matrix and right side of one device, its joints eliminated from the tip.", ""];
    let pages = [
        "",
        "Equations (D1) to (D13) are derived in `tests/derivation/kernels`. By (D3), the origin",
        "of a turning joint is elsewhere on its axis than where the paper places it.",
    ];
    let equations = if torques.is_empty() { none.as_slice() } else { motors.as_slice() };
    [&what, equations, &pages].concat().into_iter().map(str::to_owned).collect()
}

fn output(kind: &Kind, eliminated: &Eliminated<'_>, gains: &Record) -> Record {
    let doc = "What is left of a device once its joints are eliminated.";
    let mut record = Record::new("Eliminated", doc);
    record.nested("share", records::hub_share(), "Share of the hub's equations.");
    for pivot in &eliminated.pivots {
        let tag = pivot.tag;
        let link = link_of(kind, tag);
        let (title, units) = (link.body.title, link.joint.motion.units());
        record.alias(
            format!("pivot_{tag}"),
            &pivot.pivot.0,
            format!(
                "Pivot of the {title}, {}; singular unless well above zero beside the diagonal.",
                units.pivot
            ),
        );
        // Where no outboard joint changes it, the pivot is the diagonal.
        if pivot.pivot.1 != pivot.diagonal.1 {
            record.alias(
                format!("diagonal_{tag}"),
                &pivot.diagonal.0,
                format!("Diagonal of the {title} before the elimination, {}.", units.pivot),
            );
        }
    }
    if !gains.fields.is_empty() {
        record.nested("gains", gains.clone(), "What back substitution needs.");
    }
    record
}

/// The rows of eq. (D13): kept for each device until the hub is solved, and so apart from the rest.
fn gains(kind: &Kind, eliminated: &Eliminated<'_>) -> Record {
    let doc = "How the joints of a device follow the hub, eq. (D13), once they are eliminated.";
    let mut record = Record::new("Gains", doc);
    for pivot in &eliminated.pivots {
        let link = link_of(kind, pivot.tag);
        let (title, units) = (link.body.title, link.joint.motion.units());
        for (name, _) in pivot.gains.iter().filter(|(_, gain)| !gain.is_zero()) {
            let of = name.rsplit('_').next().unwrap_or_default();
            let (what, slides) = match (of.split_at(1), HUB.contains(&of)) {
                (("v", n), true) => (format!("component {n} of r̈_{{B/N}}"), true),
                ((_, n), true) => (format!("component {n} of ω̇_{{B/N}}"), false),
                _ => {
                    let other = link_of(kind, of);
                    let slides = matches!(other.joint.motion, Motion::Slide(_));
                    (format!("the acceleration of the {}", other.body.title), slides)
                }
            };
            let unit = match (link.joint.motion, slides) {
                (Motion::Turn(_), true) => ", 1/m",
                (Motion::Slide(_), false) => ", m",
                _ => "",
            };
            record.field(name.clone(), format!("Gain of the {title} on {what}{unit}."));
        }
        let unit = units.acceleration;
        let doc =
            format!("Acceleration of the {title} with all else at rest, or as given, {unit}.");
        record.field(pivot.free.0.clone(), doc);
    }
    record
}

/// What is across the tip's axis in the row of a joint that can be parallel to it, from the entries of
/// the mass matrix.
fn across<'g>(chain: &Chain<'g>) -> Vec<Named<'g>> {
    let Some(joints) = ParallelAxes::of_chain(chain) else { return Vec::new() };
    let values = reference::share(chain).perpendicular_to_tip(joints);
    let named = joints.names(chain.kind.links).into_iter().zip(values);
    named.map(|(name, value)| (name.clone(), vec![(name, value)])).collect()
}

/// The link whose joint has this tag.
fn link_of(kind: &Kind, tag: &str) -> &'static Link {
    let link = kind.links.iter().find(|link| link.joint.tag == tag);
    link.expect("a gain is named after a joint of the kind")
}

/// The system's equations have no single number each: the row cites the block.
pub(super) fn claims<'g>(kind: &Kind, named: Vec<Named<'g>>) -> Vec<Claim<'g>> {
    let claim = |(name, components): Named<'g>| {
        let tag = tag(kind, &name).to_owned();
        Claim { tag, name, components }
    };
    named.into_iter().map(claim).collect()
}

fn tag(kind: &Kind, name: &str) -> &'static str {
    let motor = |link: &&Link| name == format!("u_rest_{}", link.joint.tag);
    if let Some(link) = kind.links.iter().find(motor) {
        return link.body.equations.torque;
    }
    match name {
        "f_rest" => "(16)",
        "n_rest" => "(75)",
        "energy" => "(energy)",
        "linear" => "(momentum)",
        "angular_b" => "(20)",
        _ if name.starts_with("f_") => "(17)",
        _ if name.starts_with("n_") => "(75)",
        _ if name.starts_with("i_") => "(76)",
        _ if name.starts_with("mr_") => "(9)",
        _ => "(M_ij)",
    }
}
