//! The kernel `back_substitute`: joint accelerations from those of the hub.

use super::{Kernel, Record, records};
use crate::derivation::chain::Chain;
use crate::derivation::elimination::{Eliminated, HUB};
use crate::derivation::heading::Heading;
use crate::derivation::script::Script;
use crate::graph::{Expr, Stage};

/// The kernel.
#[must_use]
pub(super) fn kernel<'g>(
    chain: &Chain<'g>,
    eliminated: &Eliminated<'g>,
    gains: Record,
) -> Kernel<'g> {
    let graph = chain.graph;
    let hub = ["r_b_n_ddot_bx", "r_b_n_ddot_by", "r_b_n_ddot_bz"].into_iter().chain([
        "omega_dot_bx",
        "omega_dot_by",
        "omega_dot_bz",
    ]);
    let mut known: Vec<Expr<'g>> =
        hub.map(|name| graph.symbol(name, Stage::Acceleration)).collect();
    let given = |name: &str| graph.symbol(name, Stage::Rate);
    let mut script = Script::new(graph);
    let heading = Heading::new("Row by row, outboard").equation("(D13)");
    script.section("row", heading.part("the free acceleration less the gains", ""));
    for link in chain.kind.links.iter().filter(|link| !link.is_locked()) {
        let (tag, name) = (link.joint.tag, link.joint.acceleration);
        let Some(pivot) = eliminated.pivots.iter().find(|pivot| pivot.tag == tag) else {
            // The kind says that it keeps its rate.
            script.name(name, graph.zero());
            continue;
        };
        let free = given(&pivot.free.0);
        let gains = pivot.gains.iter().zip(&known).filter(|((_, gain), _)| !gain.is_zero());
        let products = gains.map(|((name, _), unknown)| given(name) * *unknown);
        let value = products.fold(free, |sum, product| sum - product);
        let symbol = graph.symbol(name, Stage::Acceleration);
        script.define(name, value, symbol);
        known.push(symbol);
    }
    assert_eq!(known.len(), HUB.len() + eliminated.pivots.len());
    Kernel {
        name: "back_substitute".to_owned(),
        doc: vec!["Joint accelerations from those of the hub.".to_owned()],
        inputs: vec![("e", gains), ("a", records::body_acceleration())],
        sections: script.sections,
        output: records::joint_accelerations(chain.kind),
        hoisted: true,
        claims: Vec::new(),
    }
}
