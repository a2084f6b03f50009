//! The kernel `axes`: axes and origins of the bodies.

use super::{Claim, Kernel, Record, records};
use crate::derivation::chain::Chain;
use crate::derivation::recursions::axes::axes;
use crate::derivation::reference::bodies;
use crate::derivation::script::Script;
use crate::kinds::Kind;
use crate::space::XYZ;

/// Axes and origin of every body.
#[must_use]
pub(super) fn kernel<'g>(chain: &Chain<'g>) -> Kernel<'g> {
    let mut script = Script::new(chain.graph);
    axes(chain, &mut script);
    Kernel {
        name: "axes".to_owned(),
        doc: vec![
            "Axes of each body and origin of its joint, expressed in the device's axes.".into(),
        ],
        inputs: records::placed(chain.kind),
        sections: script.sections,
        output: output(chain.kind),
        hoisted: true,
        claims: claims(chain),
    }
}

fn output(kind: &Kind) -> Record {
    let doc = "Axes of the bodies and origins of their joints, expressed in the device's axes.";
    let mut record = Record::new("Axes", doc);
    for (k, link) in kind.links.iter().enumerate() {
        let (frame, [letter, _]) = (link.body.frame, link.body.letters);
        let whose = if kind.axes_turn(k) { "" } else { "parent body of the " };
        for (axis, symbol) in XYZ.iter().zip(["First", "Second", "Third"]) {
            let title = link.body.title;
            let doc = format!("{symbol} axis of the {whose}{title}, eq. (D1)");
            record.vector(&format!("{frame}_{axis}"), "b", &doc, "1");
        }
        let doc = format!("{letter}, origin of its joint, from B, eq. (D2)");
        record.vector(&format!("origin_{frame}"), "b", &doc, "m");
    }
    record
}

/// The columns of each body's rotation, and its joint's origin.
fn claims<'g>(chain: &Chain<'g>) -> Vec<Claim<'g>> {
    let mut made = Vec::new();
    let mut carrier = crate::derivation::reference::hub_body(chain).axes;
    for ((link, data), body) in chain.links.iter().zip(chain.kind.links).zip(bodies(chain)) {
        let frame = data.body.frame;
        let own = if link.turn.is_none() { carrier } else { body.axes };
        for (axis, column) in XYZ.iter().zip(own) {
            made.push(Claim::vector("(D1)", &format!("{frame}_{axis}"), "b", column));
        }
        made.push(Claim::vector("(D2)", &format!("origin_{frame}"), "b", body.origin()));
        carrier = own;
    }
    made
}
