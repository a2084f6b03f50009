//! Two joints with one between them whose axes can be parallel: the tip's, and the one that it can be
//! parallel to.
//!
//! Where a pose makes them parallel, what the elimination of the tip leaves to the inboard joint is a
//! small difference of large numbers: the inertia about the tip's axis is in both. It is therefore
//! taken out of both before they are subtracted. With `c` the cosine between the axes,
//! `M_kk = A_kk + c^2 M_jj` and `M_kj = A_kj + c M_jj`, where `A` is of the composite without
//! inertia about the tip's axis, and
//!
//! `M_kk - M_kj^2 / M_jj = A_kk - c A_kj - A_kj g` with the gain `g = M_kj / M_jj`:
//!
//! `M_jj` has gone. Between perpendicular axes, `c = 0`, there is nothing to take out.

use super::assumed::Assumed;
use super::{Chain, Coordinate};
use crate::graph::{Expr, Stage};
use crate::kinds::Link as Data;
use crate::space::ParentFrame;

/// The two joints, by their numbers, and the cosine between their axes.
#[derive(Clone, Copy)]
pub struct ParallelAxes<'g> {
    /// The inboard one.
    pub inner: usize,
    /// The tip's.
    pub tip: usize,
    /// Between their axes.
    pub cosine: Expr<'g>,
}

/// What the inboard joint's row has across the tip's axis.
#[derive(Clone, Copy)]
pub struct PerpendicularEntries<'g> {
    /// The joints.
    pub joints: ParallelAxes<'g>,
    /// `A_kk`.
    pub diagonal: Expr<'g>,
    /// `A_kj`.
    pub coupling: Expr<'g>,
}

impl<'g> ParallelAxes<'g> {
    /// The pair of this chain, where the joint between them turns one axis towards the other and both
    /// have a row. A body that is known to have inertia about the inboard joint's axis keeps it in any
    /// pose: nothing small is left there.
    #[must_use]
    pub fn of_chain(chain: &Chain<'g>) -> Option<Self> {
        let tip = chain.links.len() - 1;
        let inner = tip.checked_sub(2).filter(|inner| *inner >= chain.first_moving())?;
        let [k, ..] = chain.kind.links[inner].joint.motion.axis().cycle();
        let known = chain.assumed.as_ref().is_some_and(|assumed| *assumed != Assumed::default());
        if known && !chain.links[inner].inertia.at(k, k).is_zero() {
            return None;
        }
        let row = |k: usize| {
            let link = &chain.links[k];
            let turns = matches!(link.coordinate, Coordinate::Angle(_));
            (turns && link.mode.is_some()).then_some(link.axis)
        };
        let (axis, other) = (row(tip)?, row(inner)?);
        let axis = axis.turned::<ParentFrame>(chain.links[tip - 1].turn.inverse());
        let cosine = axis.relabelled_inboard().dot(other);
        (cosine.stage() > Stage::Parameter).then_some(Self { inner, tip, cosine })
    }

    /// The names of `A_kk` and `A_kj`.
    #[must_use]
    pub fn names(self, links: &[Data]) -> [String; 2] {
        let [inner, tip] = [self.inner, self.tip].map(|k| links[k].joint.tag);
        [format!("across_{inner}{inner}"), format!("across_{inner}{tip}")]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::graph::Graph;
    use crate::kinds::KINDS;

    #[test]
    fn only_a_wheel_that_is_free_in_two_gimbals_or_tilts_has_an_axis_that_can_be_parallel_to_another()
     {
        let can = |kind: &&'static crate::kinds::Kind| {
            ParallelAxes::of_chain(&Chain::new(&Graph::new(), kind)).is_some()
        };
        let names: Vec<_> = KINDS.iter().copied().filter(can).map(|kind| kind.name).collect();
        let expected = ["dgvscmg", "balanced_dgvscmg", "flexible_reaction_wheel", "flexible_vscmg"];
        assert_eq!(names, expected);
    }

    #[test]
    fn the_cosine_is_that_of_the_axes() {
        let graph = Graph::new();
        let kind = KINDS.iter().find(|kind| kind.name == "dgvscmg").expect("it is built in");
        let joints =
            ParallelAxes::of_chain(&Chain::new(&graph, kind)).expect("its axes can be parallel");
        assert_eq!((joints.inner, joints.tip), (0, 2));
        assert_eq!(joints.cosine, -graph.find("sin_gamma_i").expect("a sine"));
    }
}
