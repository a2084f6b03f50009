//! A chain with assumptions held against the general one under the same substitution.
//!
//! The general derivation knows nothing of the assumptions: it is made in a graph of its own, with
//! the device's axes along those of B. Its symbols are then replaced by what is assumed of them, the
//! hub's rate by its components along the device's axes, and its vectors and tensors are expressed
//! in B. The result must be the derivation that was made with the assumptions, by normal form.

use super::kind::own_file;
use super::{Comparison, EmittedError, Prover};
use crate::derivation::chain::Chain;
use crate::derivation::reference;
use crate::derivation::share::Share;
use crate::emit::EmittedFile;
use crate::graph::{Expr, Graph, Stage};
use crate::kinds::Kind;
use crate::normal::Ring;
use crate::space::{Hub, ParentFrame, Symmetric, Vector};

/// Every claim about the emitted file of a chain with assumptions, and the rows that hold its
/// derivation against that of the `general` kind.
///
/// # Errors
/// When there is no such file, or it cannot be read.
pub fn prove_assumed(
    chain: &Chain<'_>,
    general: &'static Kind,
    files: &[EmittedFile],
) -> Result<Vec<Comparison>, EmittedError> {
    let file = own_file(chain.kind, files)?;
    let mut rows = substituted(chain, general);
    rows.extend(Prover::new(chain).rows(&file.text)?);
    Ok(rows.into_iter().map(|row| row.about(chain.kind)).collect())
}

/// Mass matrix and bias of the general kind under the substitution.
fn substituted<'g>(chain: &Chain<'g>, general: &'static Kind) -> Vec<Comparison> {
    let graph = Graph::new();
    let whole = reference::share(&Chain::new(&graph, general));
    let put = Substitution::new(chain, general);
    let made = reference::share(chain);
    let sizes = |share: &Share<'_>| {
        let entries = share.joint.iter().map(Vec::len).sum::<usize>();
        [share.force.len(), share.moment.len(), share.bias_joint.len(), entries]
    };
    assert_eq!(sizes(&made), sizes(&whole), "both have the joints of the kind");
    let mut ring = Ring::new(chain.graph);
    let mut rows = Vec::new();
    let mut row = |tag: &str, name: &str, pairs: Vec<(Expr<'g>, Expr<'g>)>| {
        let labelled = |side: fn(&(Expr<'g>, Expr<'g>)) -> Expr<'g>| -> Vec<_> {
            pairs.iter().enumerate().map(|(k, pair)| (k.to_string(), side(pair))).collect()
        };
        let (checked, reference) = (labelled(|pair| pair.0), labelled(|pair| pair.1));
        let heading = [tag, name, "derivation = general, substituted"];
        rows.push(Comparison::new(&mut ring, heading, &checked, &reference));
        ring.settle();
    };
    row("(9)", "m, m c", {
        let mut pairs = vec![(made.mass, put.number(whole.mass))];
        pairs.extend(put.vectors(&[made.first_moment], &[whole.first_moment]));
        pairs
    });
    row("(76)", "[I_sc,B]", put.tensors(made.inertia, whole.inertia));
    row("(17)", "M_vi", put.vectors(&made.force, &whole.force));
    row("(75)", "M_wi", put.vectors(&made.moment, &whole.moment));
    let entries = made.joint.iter().flatten().zip(whole.joint.iter().flatten());
    row("(M_ij)", "M_ij", entries.map(|(own, of)| (*own, put.number(*of))).collect());
    row("(16)", "f_rest", put.vectors(&[made.bias_force], &[whole.bias_force]));
    row("(75)", "n_rest", put.vectors(&[made.bias_moment], &[whole.bias_moment]));
    let biases = made.bias_joint.iter().zip(&whole.bias_joint);
    row("(u)", "u_rest", biases.map(|(own, of)| (*own, put.number(*of))).collect());
    rows
}

/// What each symbol of the general derivation is under the assumptions.
struct Substitution<'a, 'g> {
    chain: &'a Chain<'g>,
    general: &'static Kind,
    /// The mount, or the unit matrix where references have the device's axes along those of B.
    axes: [Vector<'g, Hub>; 3],
}

impl<'a, 'g> Substitution<'a, 'g> {
    fn new(chain: &'a Chain<'g>, general: &'static Kind) -> Self {
        use crate::space::Axis::{X, Y, Z};
        let unit = [X, Y, Z].map(|axis| Vector::unit(chain.graph, axis));
        let axes = if chain.mount_is_turned() { chain.mount } else { unit };
        Self { chain, general, axes }
    }

    /// The symbol `name` of the general derivation.
    fn symbol(&self, name: &str) -> Expr<'g> {
        let graph = self.chain.graph;
        let joints = self.general.links.iter().zip(self.chain.kind.links);
        let stands = joints.filter(|(_, own)| own.is_locked()).any(|(of, _)| of.joint.rate == name);
        let assumed = self.chain.assumed.as_ref();
        if stands || assumed.is_some_and(|assumed| assumed.zero.contains(name)) {
            return graph.zero();
        }
        if let Some(axis) = ["omega_bx", "omega_by", "omega_bz"].iter().position(|n| *n == name) {
            return self.axes[axis].dot(self.chain.hub.omega);
        }
        let equal = assumed.and_then(|assumed| assumed.equal.get(name));
        let name = equal.map_or(name, String::as_str);
        // What the chain has no symbol for is in no expression of its own: the row then differs.
        let lacking = || graph.symbol(name, Stage::Acceleration);
        graph.find(name).unwrap_or_else(lacking)
    }

    fn number(&self, e: Expr<'_>) -> Expr<'g> {
        let of = e.graph();
        let symbol = |symbol| self.symbol(&of.symbol_info(symbol).name);
        of.rebuilt_in(self.chain.graph, [e.id()], symbol)[&e.id()]
    }

    /// Components of vectors, and of the general ones expressed in B.
    fn vectors(
        &self,
        made: &[Vector<'g, Hub>],
        whole: &[Vector<'_, Hub>],
    ) -> Vec<(Expr<'g>, Expr<'g>)> {
        let pairs = made.iter().zip(whole).flat_map(|(own, of)| {
            let of = Vector::<ParentFrame>::new(of.components().map(|e| self.number(e)));
            let of = of.along(self.axes);
            own.components().into_iter().zip(of.components())
        });
        pairs.collect()
    }

    /// Entries of a tensor, and of the general one expressed in B.
    fn tensors(
        &self,
        made: Symmetric<'g, Hub>,
        whole: Symmetric<'_, Hub>,
    ) -> Vec<(Expr<'g>, Expr<'g>)> {
        let entries = whole.entries().map(|e| self.number(e));
        let of = Symmetric::<ParentFrame>::new(entries).along(self.axes);
        made.entries().into_iter().zip(of.entries()).collect()
    }
}
