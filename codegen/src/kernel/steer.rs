//! The kernel `steer`: what each joint's rate and acceleration require about B.

use super::function::inputs;
use super::{Claim, Kernel, Record, records};
use crate::derivation::chain::Chain;
use crate::derivation::heading::Heading;
use crate::derivation::recursions::steering::steering;
use crate::derivation::reference;
use crate::derivation::script::{Script, pairs, sextuple, triple};
use crate::kinds::{Kind, Link};
use crate::space::{Hub, Vector};

/// Moments about B per rate and per acceleration of each joint, and the remaining terms.
#[must_use]
pub(super) fn kernel<'g>(chain: &Chain<'g>) -> Kernel<'g> {
    let kind = chain.kind;
    let mut script = Script::new(chain.graph);
    let found = steering(chain, &mut script);
    let heading = Heading::new("Moment about B per rate and per acceleration of each joint");
    script.section("steer", heading.cited("as in", "(75)").axes("the device's axes"));
    for (k, link) in moving(kind) {
        let [rate, acceleration] = columns(link);
        script.names(pairs(triple(&rate, "b"), found.by_rate[k].components()));
        script.names(pairs(triple(&acceleration, "b"), found.by_acceleration[k].components()));
    }
    let heading = Heading::new("Momentum relative to the hub, and the remaining terms");
    script.section("rest", heading.cited("as in", "(75)").axes("the device's axes"));
    script.names(pairs(triple("h_relative", "b"), found.relative.components()));
    script.names(pairs(triple("first_moment", "b"), found.first_moment.components()));
    script.names(pairs(sextuple("inertia"), found.inertia.entries()));
    script.names(pairs(triple("n_gyroscopic", "b"), found.gyroscopic.components()));
    Kernel {
        name: "steer".to_owned(),
        doc: vec![
            "What steers, term by term. The moment about B that the hub exerts on the device is the sum".into(),
            "of `n_rate_i q_i'` and `n_acceleration_i q_i''` over the joints, of `inertia omega'`, of".into(),
            "`first_moment x r_B''`, and of `n_gyroscopic`.".into(),
        ],
        inputs: inputs(kind, [("w", records::body_rate())]),
        sections: script.sections,
        output: output(kind),
        hoisted: false,
        claims: claims(chain),
    }
}

/// The joints that move.
fn moving(kind: &Kind) -> impl Iterator<Item = (usize, &Link)> {
    kind.links.iter().enumerate().filter(|(_, link)| !link.is_locked())
}

/// The stems of a joint's columns.
fn columns(link: &Link) -> [String; 2] {
    ["rate", "acceleration"].map(|by| format!("n_{by}_{}", link.joint.tag))
}

fn output(kind: &Kind) -> Record {
    let doc = "Moments about B per rate and per acceleration of each joint, expressed in the device's axes.";
    let mut record = Record::new("Steering", doc);
    for (_, link) in moving(kind) {
        let (title, units, [rate, acceleration]) =
            (link.body.title, link.joint.motion.units(), columns(link));
        let doc = format!("`∂H/∂q + ω × {acceleration}`, moment per rate of the {title}");
        record.vector(&rate, "b", &doc, &format!("N m per {}", units.rate));
        let doc = format!("Moment per acceleration of the {title}");
        record.vector(&acceleration, "b", &doc, units.moment);
    }
    record.vector("h_relative", "b", "Angular momentum about B relative to the hub", "kg m²/s");
    record.vector("first_moment", "b", "First moment about B", "kg m");
    record.tensor("inertia", "Inertia about B", "kg m²");
    record.vector("n_gyroscopic", "b", "ω × (inertia ω)", "N m");
    record
}

fn claims<'g>(chain: &Chain<'g>) -> Vec<Claim<'g>> {
    let (share, omega) = (reference::share(chain), chain.hub.omega);
    let tag = "(75)";
    let momentum = reference::relative_angular_momentum(chain, omega);
    let at_rest = reference::relative_angular_momentum(chain, Vector::zero(chain.graph));
    let mut list = vec![
        Claim::vector(tag, "h_relative", "b", at_rest),
        Claim::vector(tag, "first_moment", "b", share.first_moment),
        Claim::vector(tag, "n_gyroscopic", "b", omega.cross(share.inertia.times(omega))),
    ];
    let components = pairs(sextuple("inertia"), share.inertia.entries()).collect();
    list.push(Claim { tag: tag.to_owned(), name: "inertia".to_owned(), components });
    for (k, link) in moving(chain.kind) {
        let ([rate, acceleration], coordinate) = (columns(link), chain.links[k].coordinate);
        let slope: Vector<'g, Hub> =
            Vector::new(momentum.components().map(|component| coordinate.partial(component)));
        let by_rate = slope + omega.cross(share.moment[k]);
        list.push(Claim::vector(tag, &rate, "b", by_rate));
        list.push(Claim::vector(tag, &acceleration, "b", share.moment[k]));
    }
    list
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::derivation::reference::exerted;
    use crate::graph::Graph;
    use crate::kinds::{DGVSCMG, HINGED_PANEL, SLOSH_MASS, VSCMG};
    use crate::normal::Ring;

    /// The terms of the documentation, summed, are the moment that `loads` has on the device: about B, by Newton and
    /// Euler for each body.
    #[test]
    fn the_terms_sum_to_the_moment_on_the_device() {
        for kind in [&DGVSCMG, &VSCMG, &HINGED_PANEL, &SLOSH_MASS] {
            let graph = Graph::new();
            let chain = Chain::new(&graph, kind);
            let found = steering(&chain, &mut Script::new(&graph));
            let hub = &chain.hub;
            let mut sum = found.inertia.times(hub.omega_dot)
                + found.first_moment.cross(hub.r_b_n_ddot)
                + found.gyroscopic;
            for (k, link) in chain.links.iter().enumerate() {
                sum = sum + link.rate * found.by_rate[k];
                sum = sum + link.acceleration * found.by_acceleration[k];
            }
            let whole = exerted::whole(&chain).moment;
            let mut ring = Ring::new(&graph);
            for (stated, required) in sum.components().into_iter().zip(whole.components()) {
                let [stated, required] = [stated, required].map(|e| ring.normal(e).unwrap());
                assert!(stated == required && !required.is_empty(), "{}", kind.name);
            }
        }
    }
}
