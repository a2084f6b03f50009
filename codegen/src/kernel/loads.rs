//! The kernel `loads`: inverse dynamics.

use super::function::inputs;
use super::{Claim, Kernel, Record, records};
use crate::derivation::chain::Chain;
use crate::derivation::recursions::loads::loads;
use crate::derivation::reference::exerted;
use crate::derivation::script::Script;
use crate::kinds::{Kind, cited};

/// What each parent body exerts.
#[must_use]
pub(super) fn kernel<'g>(chain: &Chain<'g>) -> Kernel<'g> {
    let kind = chain.kind;
    let mut script = Script::new(chain.graph);
    loads(chain, &mut script);
    let across = cited(kind.links, |equations| equations.across);
    Kernel {
        name: "loads".to_owned(),
        doc: vec![
            "Inverse dynamics: force and moment that each parent body exerts on its child body at"
                .into(),
            format!("given accelerations, with the torques of {across}."),
        ],
        inputs: inputs(
            kind,
            [
                ("w", records::body_rate()),
                ("a", records::body_acceleration()),
                ("j", records::joint_accelerations(kind)),
            ],
        ),
        sections: script.sections,
        output: output(kind),
        hoisted: true,
        claims: claims(chain),
    }
}

fn output(kind: &Kind) -> Record {
    let doc = "Loads across the joints without external wrenches: what the parent body exerts on \
               the child body and all bodies outboard of it, expressed in the child body's axes, \
               moments about the joint's origin. Along the joint's axis it is the motor's.";
    let mut record = Record::new("Loads", doc);
    for link in kind.links {
        let (body, equations) = (&link.body, &link.body.equations);
        let on = format!("the {}, eq. {}", body.title, equations.across);
        record.wrench("load", body.frame, &on, body.letters[0]);
    }
    record.wrench("load", "b", "the whole device, eqs. (16), (75)", "B");
    record
}

fn claims<'g>(chain: &Chain<'g>) -> Vec<Claim<'g>> {
    let links = chain.kind.links;
    let mut made = Vec::new();
    for (k, (needed, link)) in exerted::joints(chain).into_iter().zip(links).enumerate() {
        let wrench = needed.resolved(chain, k + 1);
        made.extend(Claim::wrench(
            [link.body.equations.across; 2],
            "load",
            link.body.frame,
            wrench,
        ));
    }
    made.extend(Claim::wrench(["(16)", "(75)"], "load", "b", exerted::whole(chain)));
    for (torque, link) in exerted::motors(chain).into_iter().zip(links) {
        let heading = [link.body.equations.torque, link.joint.torque, "load"];
        made.push(Claim::along_joint(heading, link, torque));
    }
    made
}
