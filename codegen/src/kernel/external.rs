//! The kernel `external`: what acts on the bodies, at the joints and on the hub.

use super::{Claim, Kernel, Record, records};
use crate::derivation::chain::Chain;
use crate::derivation::recursions::external::{acting as symbols, external};
use crate::derivation::reference::acting;
use crate::derivation::script::Script;
use crate::kinds::Kind;

/// A wrench on every body, summed inwards.
#[must_use]
pub(super) fn kernel<'g>(chain: &Chain<'g>) -> Kernel<'g> {
    let mut script = Script::new(chain.graph);
    external(chain, &mut script);
    let mut inputs = records::placed(chain.kind);
    inputs.push(("x", records::wrenches(chain.kind)));
    Kernel {
        name: "external".to_owned(),
        doc: vec!["External wrenches on the bodies, summed from the tip inwards.".to_owned()],
        inputs,
        sections: script.sections,
        output: output(chain.kind),
        hoisted: true,
        claims: claims(chain),
    }
}

fn output(kind: &Kind) -> Record {
    let doc = "External wrenches: on each body with all bodies outboard of it, expressed in its own \
               axes, moments about its joint's origin; on the hub. The component along a \
               joint's axis adds to its motor's, eq. (D15).";
    let mut record = Record::new("External", doc);
    for link in kind.links {
        let body = &link.body;
        let on = format!("the {} and the bodies outboard of it, eq. (D14)", body.title);
        record.wrench("sum", body.frame, &on, body.letters[0]);
    }
    record.wrench("sum", "b", "the hub, eq. (D14)", "B");
    record
}

fn claims<'g>(chain: &Chain<'g>) -> Vec<Claim<'g>> {
    let own = symbols(chain).into_iter().enumerate();
    let on_bodies: Vec<_> = own.map(|(k, wrench)| wrench.along_b(chain, k)).collect();
    let mut made = Vec::new();
    for (k, link) in chain.kind.links.iter().enumerate() {
        let wrench = acting::at_joint(chain, &on_bodies, k).resolved(chain, k + 1);
        made.extend(Claim::wrench(["(D14)"; 2], "sum", link.body.frame, wrench));
    }
    made.extend(Claim::wrench(["(D14)"; 2], "sum", "b", acting::on_hub(chain, &on_bodies)));
    for (drive, link) in acting::virtual_work(chain, &on_bodies).into_iter().zip(chain.kind.links) {
        let name = format!("drive_{}", link.joint.tag);
        made.push(Claim::along_joint(["(D15)", &name, "sum"], link, drive));
    }
    made
}
