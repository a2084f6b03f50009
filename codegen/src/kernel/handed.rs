//! The kernel `handed`: what the hub takes over of a device, once for each spacecraft.

use super::{Claim, Kernel, Record, records};
use crate::derivation::aboard::handed;
use crate::derivation::chain::Chain;
use crate::derivation::script::Script;

/// The kernel.
#[must_use]
pub(super) fn kernel<'g>(chain: &Chain<'g>) -> Kernel<'g> {
    let mut script = Script::new(chain.graph);
    handed(chain, &mut script);
    let mass = chain.links.iter().skip(1).fold(chain.links[0].mass, |sum, link| sum + link.mass);
    Kernel {
        name: "handed".to_owned(),
        doc: vec![
            "What the hub takes over of a device: mass, and what does not notice that the joints"
                .into(),
            "move.".into(),
        ],
        inputs: vec![("p", Record::new("Prepared", ""))],
        sections: script.sections,
        output: records::handed(),
        claims: vec![Claim {
            tag: "(D4)".to_owned(),
            name: "hand_m".to_owned(),
            components: vec![("hand_m".to_owned(), mass)],
        }],
    }
}
