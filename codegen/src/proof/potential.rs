//! The field's wrenches have a potential: summed inwards, they are the slopes of `G : S / 2`.
//!
//! Stated from the emitted wrenches and the emitted second moment S only, by virtual work; the same
//! sums are what the emitted `external` is held against.

use super::Comparison;
use super::laws::labelled;
use crate::derivation::chain::Chain;
use crate::derivation::chain::wrench::Wrench;
use crate::derivation::recursions::gravity::gradient;
use crate::derivation::reference::{acting, bodies, field};
use crate::graph::Expr;
use crate::kinds::Link;
use crate::normal::Ring;
use crate::space::{BodyFrame, ENTRIES, Hub, Symmetric, Vector, XYZ};

/// One row for each joint, and two for the hub: the force is G times the first moment, and the
/// moment about B is what turns S.
pub(super) fn rows<'g>(
    ring: &mut Ring<'g>,
    chain: &Chain<'g>,
    named: impl Fn(&str) -> Option<Expr<'g>>,
) -> Vec<Comparison> {
    let zero = chain.graph.zero();
    let value = |name: String| named(&name).unwrap_or(zero);
    let entry = |entry: &str| value(format!("second_moment_{entry}"));
    let second_moment = Symmetric::<Hub>::new(ENTRIES.map(entry));
    let on_body = |(k, link): (usize, &Link)| {
        let frame = link.body.frame;
        let part = |letter: char| {
            Vector::<BodyFrame>::new(XYZ.map(|axis| value(format!("{letter}_on_{frame}{axis}"))))
        };
        Wrench { force: part('f'), moment: part('n') }.along_b(chain, k)
    };
    let on_bodies: Vec<_> = chain.kind.links.iter().enumerate().map(on_body).collect();
    let gradient = gradient(chain.graph);

    let mut made = Vec::new();
    let mut row = |name: &str, law: &str, checked: &[Expr<'g>], expected: &[Expr<'g>]| {
        let claim = format!("fn gravity = {law}");
        let heading = ["(potential)", name, claim.as_str()];
        made.push(Comparison::new(ring, heading, &labelled(checked), &labelled(expected)));
    };
    let potential = field::work_of(second_moment, gradient);
    let work = acting::virtual_work(chain, &on_bodies);
    for ((work, link), data) in work.into_iter().zip(&chain.links).zip(chain.kind.links) {
        let name = format!("drive_{}", data.joint.tag);
        row(&name, "d(G:S/2)/dq", &[work], &[link.coordinate.partial(potential)]);
    }
    let hub = acting::on_hub(chain, &on_bodies);
    let first_moment =
        bodies(chain).iter().fold(Vector::zero(chain.graph), |sum, b| sum + b.mass * b.r);
    let force = gradient.times(first_moment);
    row("f_sum_b", "G Σ m r", &hub.force.components(), &force.components());
    let moment = field::turning(second_moment, gradient);
    row("n_sum_b", "ε (S G)", &hub.moment.components(), &moment.components());
    made
}
