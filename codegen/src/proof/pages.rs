//! The derivation against the hand-checked pages: every block has its row, and every derived
//! quantity its block.

use super::Comparison;
use crate::derivation::chain::Chain;
use crate::derivation::quantities::{Quantity, find, traces};
use crate::graph::Expr;
use crate::normal::Ring;
use crate::page::{Block, Equation, Kind, in_the_case};

/// One row per block, and one for each quantity that no block states.
#[must_use]
pub fn against_pages<'g>(
    ring: &mut Ring<'g>,
    chain: &Chain<'g>,
    quantities: &[Quantity<'g>],
    equations: &[Equation<'g>],
) -> Vec<Comparison> {
    let stated: Vec<_> =
        equations.iter().map(|e| against_block(ring, chain, quantities, e)).collect();
    let lacking = quantities.iter().filter(|quantity| {
        let axis = quantity.name.ends_with("_hat");
        !axis && equations.iter().all(|equation| !states(&equation.block, quantity))
    });
    let lacking = lacking
        .map(|quantity| Comparison::absent(["(missing)", &quantity.name, "derivation = page"]));
    stated.into_iter().chain(lacking).collect()
}

/// Whether a block states the quantity, and not of a special case only.
fn states(block: &Block, quantity: &Quantity<'_>) -> bool {
    block.name == quantity.name && block.given.is_empty()
}

/// The row of one block.
#[must_use]
pub fn against_block<'g>(
    ring: &mut Ring<'g>,
    chain: &Chain<'g>,
    quantities: &[Quantity<'g>],
    equation: &Equation<'g>,
) -> Comparison {
    let block = &equation.block;
    let heading = [block.tag.as_str(), &block.name, "derivation = page"];
    let row = match derived(chain, quantities, block) {
        Some(derived) => Comparison::new(ring, heading, &derived, &equation.components),
        None => Comparison::absent(heading),
    };
    row.at(format!("{}:{}", block.page, block.line))
}

/// The derived quantity of a block's name, in the block's components and special case.
fn derived<'g>(
    chain: &Chain<'g>,
    quantities: &[Quantity<'g>],
    block: &Block,
) -> Option<Vec<(String, Expr<'g>)>> {
    let hub = ["b_x", "b_y", "b_z"].map(str::to_owned);
    let axes = match &block.kind {
        Kind::Scalar | Kind::Text => &hub,
        Kind::Vector(axes) | Kind::Tensor(axes) => axes,
    };
    let (quantity, frame) = (find(quantities, &block.name)?, frame_of(chain, axes)?);
    let components = quantity.value.along(chain, frame).labelled(axes);
    in_the_case(chain.graph, &block.given, components).ok()
}

/// Every inertia's derivative about the body's own centre of mass has no trace.
#[must_use]
pub fn zero_traces<'g>(ring: &mut Ring<'g>, chain: &Chain<'g>) -> Vec<Comparison> {
    let zero = vec![(String::new(), chain.graph.zero())];
    let traces = traces(chain).into_iter().zip(chain.kind.links);
    traces
        .map(|(trace, link)| {
            let body = &link.body;
            let name = format!("i_{}_{}_prime", body.frame, body.point);
            let heading = [body.equations.i_prime, &name, "trace = 0"];
            Comparison::new(ring, heading, &[(String::new(), trace)], &zero)
        })
        .collect()
}

/// The number of the frame with these axes.
pub(super) fn frame_of(chain: &Chain<'_>, axes: &[String; 3]) -> Option<usize> {
    let hub = ["b_x", "b_y", "b_z"];
    let triads = chain.kind.links.iter().map(|link| link.body.triad);
    std::iter::once(hub).chain(triads).position(|triad| triad == *axes)
}
