//! Inverse dynamics: what the parent body of each joint must exert for given accelerations.
//!
//! Recursive Newton and Euler in local frames: accelerations outwards, those of B among them, then
//! forces and moments inwards. Of each moment the part about the joint's axis is the motor's
//! torque; the structure bears the rest, the torques of (77), (98) and (116).

use super::composite::required_wrench;
use crate::derivation::chain::Chain;
use crate::derivation::chain::mass_properties::MassProperties;
use crate::derivation::chain::motion::{Motion, Observer, motions};
use crate::derivation::chain::wrench::Wrench;
use crate::derivation::heading::Heading;
use crate::derivation::script::{Script, pairs, triple};

/// Writes the loads of a device to `script`: at each joint on all bodies outboard of it, expressed
/// in own axes, about the joint's origin; then on the whole device, about B.
pub fn loads<'g>(chain: &Chain<'g>, script: &mut Script<'g>) {
    let motions = outwards(chain, script);
    let mut wrench = Wrench::zero(chain.graph);
    for ((link, data), motion) in chain.links.iter().zip(chain.kind.links).zip(&motions).rev() {
        let body = MassProperties::of_body(link, data, script);
        wrench = wrench.plus(required_wrench(link, motion, &body));
        let (whole, body) = (data.assembly.to_uppercase(), &data.body);
        let what = format!("On {whole}, the {} and the bodies outboard of it", body.title);
        let heading = Heading::new(what + ", at its joint").equation(body.equations.across);
        script.section("load", heading.wrench(["N", "N m"], body.letters[0]));
        script.names(wrench.named("load", data.body.frame));
        wrench = wrench.in_parent_frame(link);
    }
    let heading = Heading::new("On the whole device").equation("(16), (75)");
    script.section("load", heading.wrench(["N", "N m"], "B"));
    script.names(wrench.named("load", "b"));
}

/// Motions, with everything accelerating.
pub(super) fn outwards<'g>(chain: &Chain<'g>, script: &mut Script<'g>) -> Vec<Motion<'g>> {
    let motions = motions(chain, &Observer::accelerating(chain));
    for ((link, data), motion) in chain.links.iter().zip(chain.kind.links).zip(&motions) {
        let (body, equations) = (&data.body, &data.body.equations);
        let (frame, [letter, _]) = (body.frame, body.letters);
        let axes = if link.turn.is_none() { "the parent body's axes" } else { "its own axes" };
        let heading = Heading::new(format!("ω_{{{letter}/N}}")).equation(equations.omega);
        script.section("rate", heading.axes(axes).unit("rad/s"));
        let stem = format!("omega_{frame}_n");
        script.names(pairs(triple(&stem, frame), motion.omega.components()));
        let heading = Heading::new("Its derivative by components").cited("as in", equations.h_dot);
        script.section("turn", heading.axes("the same axes").unit("rad/s²"));
        let rates = motion.omega.component_rates();
        script.names(pairs(triple(&format!("{stem}_dot"), frame), rates.components()));
        let heading = Heading::new(format!("Inertial acceleration of {letter}"));
        let heading = heading.cited("as in", equations.r_ddot).axes("the same axes");
        script.section("path", heading.unit("m/s²"));
        let origin = motion.origin.acceleration.turned(link.turn);
        let stem = format!("r_{}_n_ddot", body.origin);
        script.names(pairs(triple(&stem, frame), origin.components()));
    }
    motions
}
