//! The kernel `gravity`: a field of acceleration that grows linearly from B.

use super::{Claim, Kernel, Record, records};
use crate::derivation::chain::Chain;
use crate::derivation::recursions::gravity::gravity;
use crate::derivation::reference::field;
use crate::derivation::script::{Script, pairs, sextuple};
use crate::kinds::Kind;

/// The field's wrench on every body, and the device's second moment.
#[must_use]
pub(super) fn kernel<'g>(chain: &Chain<'g>) -> Kernel<'g> {
    let mut script = Script::new(chain.graph);
    gravity(chain, &mut script);
    let mut inputs = records::placed(chain.kind);
    inputs.push(("g", records::gradient()));
    Kernel {
        name: "gravity".to_owned(),
        doc: vec![
            "Wrench of a field of acceleration `G r` on each body, an argument of [`external`]."
                .into(),
        ],
        inputs,
        sections: script.sections,
        output: output(chain.kind),
        hoisted: true,
        claims: claims(chain),
    }
}

fn output(kind: &Kind) -> Record {
    let mut record = Record::new(
        "Gravity",
        "Wrenches of a field of acceleration, and the second moment of the device.",
    );
    record.nested("wrenches", records::wrenches(kind), "On each body, eq. (D17).");
    let doc = "S = ∫ r rᵀ dm of the device about B, expressed in the device's axes, eq. (D18)";
    record.tensor("second_moment", doc, "kg m²");
    record
}

fn claims<'g>(chain: &Chain<'g>) -> Vec<Claim<'g>> {
    let mut made = Vec::new();
    for (k, (on, link)) in field::wrenches(chain).into_iter().zip(chain.kind.links).enumerate() {
        let wrench = on.resolved(chain, k + 1);
        made.extend(Claim::wrench(["(D17)"; 2], "on", link.body.frame, wrench));
    }
    let entries = field::second_moment(chain).entries();
    made.push(Claim {
        tag: "(D18)".to_owned(),
        name: "second_moment".to_owned(),
        components: pairs(sextuple("second_moment"), entries).collect(),
    });
    made
}
