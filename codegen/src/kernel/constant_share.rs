//! The kernel `constant_share`: what a device adds to the hub whatever its joints do.

use super::{Claim, Kernel, Record, eliminate, records};
use crate::derivation::chain::Chain;
use crate::derivation::inward_pass::constant_share;
use crate::derivation::reference;
use crate::derivation::script::Script;

/// The kernel.
#[must_use]
pub(super) fn kernel<'g>(chain: &Chain<'g>) -> Kernel<'g> {
    let mut script = Script::new(chain.graph);
    constant_share(chain, &mut script);
    // Where no joint moves, it is the whole device, and what follows of the hub's motion.
    let whole = if chain.is_rigid() {
        eliminate::claims(chain.kind, reference::share(chain).named(chain.kind, |_| false))
    } else {
        Vec::new()
    };
    let mass = chain.links.iter().skip(1).fold(chain.links[0].mass, |sum, link| sum + link.mass);
    Kernel {
        name: "constant_share".to_owned(),
        doc: vec![
            "Constant share of the hub: mass, first moment and inertia that the device adds to the"
                .into(),
            "hub whatever its joints do.".into(),
        ],
        inputs: vec![("p", Record::new("Prepared", ""))],
        sections: script.sections,
        output: records::constant_share(),
        hoisted: true,
        claims: std::iter::once(Claim {
            tag: "(D4)".to_owned(),
            name: "constant_m".to_owned(),
            components: vec![("constant_m".to_owned(), mass)],
        })
        .chain(whole)
        .collect(),
    }
}
