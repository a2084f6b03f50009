//! The composite of the bodies outboard of each joint, from the tip to the hub, in local frames.
//!
//! Moments are taken about the joint's own origin and moved to the next one, so that a light wheel
//! far from B does not lose digits beside the inertia of its lever arm.

use crate::derivation::chain::mass_properties::MassProperties;
use crate::derivation::chain::motion::{Motion, Observer, motions};
use crate::derivation::chain::wrench::Wrench;
use crate::derivation::chain::{Chain, Link};
use crate::derivation::heading::Heading;
use crate::derivation::script::{Script, pairs, triple};
use crate::derivation::share::{Momenta, Share};
use crate::graph::Stage;
use crate::kinds::{self, units};
use crate::space::{BodyFrame, Symmetric, Vector};

/// The device's share of the mass matrix and of the bias, with its steps written to `script`.
#[must_use]
pub fn share<'g>(chain: &Chain<'g>, observer: &Observer<'g>, script: &mut Script<'g>) -> Share<'g> {
    let graph = chain.graph;
    let motions = outwards(chain, observer, script);
    let mut composite = MassProperties::zero(graph);
    let mut bias = Wrench::zero(graph);
    // What a unit acceleration of each joint processed so far requires; tip last.
    let mut columns: Vec<Wrench<'g, BodyFrame>> = Vec::new();
    let mut joint = Vec::new();
    let mut bias_joint = Vec::new();
    for (k, (link, motion)) in chain.links.iter().zip(&motions).enumerate().rev() {
        let behind = &chain.kind.links[k..];
        let data = &behind[0];
        let tags = behind.iter().map(|link| link.joint.tag);
        let body = MassProperties::of_body(link, data, script);
        composite = composite.plus(body);
        bias = bias.plus(bias_of(link, motion, &body));
        columns.insert(0, composite.column(link));
        describe(behind, &composite, &bias, &columns, script);
        let row: Vec<_> = tags.zip(columns.iter().map(|column| column.along(link))).collect();
        let cut = |(tag, entry)| script.cut(format!("mass_{}{tag}", data.joint.tag), entry);
        joint.insert(0, row.into_iter().map(cut).collect());
        let required = bias.along(link);
        bias_joint.insert(0, script.cut(format!("u_rest_{}", data.joint.tag), required));

        composite = composite.in_parent_frame(link);
        bias = bias.in_parent_frame(link);
        columns = columns.into_iter().map(|column| column.in_parent_frame(link)).collect();
    }
    let on_hub = |v: Vector<'g, BodyFrame>| v.relabelled_outboard().on_hub();
    Share {
        mass: composite.mass,
        first_moment: on_hub(composite.first_moment),
        inertia: Symmetric::new(composite.inertia.entries()),
        force: columns.iter().map(|column| on_hub(column.force)).collect(),
        moment: columns.iter().map(|column| on_hub(column.moment)).collect(),
        joint,
        perpendicular: None,
        bias_force: on_hub(bias.force),
        bias_moment: on_hub(bias.moment),
        bias_joint,
    }
}

/// Motions, with their angular velocities and accelerations named.
pub(super) fn outwards<'g>(
    chain: &Chain<'g>,
    observer: &Observer<'g>,
    script: &mut Script<'g>,
) -> Vec<Motion<'g>> {
    let motions = motions(chain, observer);
    let seen_from = observer.name;
    for ((link, data), motion) in chain.links.iter().zip(chain.kind.links).zip(&motions) {
        let body = &data.body;
        let (frame, letter, equation) = (body.frame, body.letters[0], body.equations.omega);
        let stem = format!("{frame}_{}", seen_from.to_lowercase());
        let axes = if link.turn.is_none() { "the parent body's axes" } else { "its own axes" };
        let heading = Heading::new(format!("ω_{{{letter}/{seen_from}}}")).equation(equation);
        script.section("rate", heading.axes(axes).unit("rad/s"));
        script.names(pairs(triple(&format!("omega_{stem}"), frame), motion.omega.components()));
        let by = if link.turn.is_none() { " by components" } else { "" };
        let heading = Heading::new(format!("Its derivative{by}, no joint accelerating"));
        let heading = heading.cited("as in", body.equations.h_dot);
        script.section("turn", heading.axes("the same axes").unit("rad/s²"));
        let rest = motion.omega.component_rates().without(Stage::Acceleration);
        script.names(pairs(triple(&format!("omega_{stem}_rest"), frame), rest.components()));
        let what = format!("Acceleration of {letter} relative to B, no joint accelerating");
        let heading = Heading::new(what).cited("as in", body.equations.r_ddot);
        script.section("path", heading.axes("the same axes").unit("m/s²"));
        let origin = origin_acceleration(link, motion);
        script.names(pairs(triple(&format!("r_{}_rest", body.origin), frame), origin.components()));
    }
    motions
}

/// Names the outboard composite of the first of these joints, its bias and its columns.
fn describe<'g>(
    behind: &[kinds::Link],
    composite: &MassProperties<'g>,
    bias: &Wrench<'g, BodyFrame>,
    columns: &[Wrench<'g, BodyFrame>],
    script: &mut Script<'g>,
) {
    let data = &behind[0];
    let (frame, whole) = (data.body.frame, data.assembly.to_uppercase());
    let (title, letter, equations) = (data.body.title, data.body.letters[0], &data.body.equations);
    composite.name(data, script);
    let heading = Heading::new(format!("{whole} with no joint accelerating"));
    script.section("bias", heading.equation(equations.about_origin).wrench(["N", "N m"], letter));
    script.names(bias.named("rest", frame));
    let wrench = [units(behind, |units| units.force), units(behind, |units| units.moment)];
    let heading = Heading::new(format!("{whole} per unit acceleration of each joint from here on"));
    let heading = heading.equation("(17)").equation(equations.about_origin);
    script.section("col", heading.wrench(wrench.each_ref().map(String::as_str), letter));
    for (tag, column) in behind.iter().map(|link| link.joint.tag).zip(columns) {
        script.names(column.named(tag, frame));
    }
    let [force, moment] = wrench;
    let unit = match data.joint.motion {
        kinds::Motion::Turn(_) => moment,
        kinds::Motion::Slide(_) => force,
    };
    let heading = Heading::new(format!("Row of the {title}'s joint, along its axis"));
    let heading = heading.equation(equations.torque).part("M_ij", unit);
    script.section("row", heading.part("bias", data.joint.motion.units().drive));
}

/// What one body requires while no joint accelerates.
fn bias_of<'g>(
    link: &Link<'g>,
    motion: &Motion<'g>,
    body: &MassProperties<'g>,
) -> Wrench<'g, BodyFrame> {
    let Wrench { force, moment } = required_wrench(link, motion, body);
    Wrench {
        force: force.without(Stage::Acceleration),
        moment: moment.without(Stage::Acceleration),
    }
}

/// What one body requires: with S and I about the joint's origin p, force `m p'' + S''` and moment
/// `S x p'' + d(I omega)/dt`, derivatives seen from N.
pub(super) fn required_wrench<'g>(
    link: &Link<'g>,
    motion: &Motion<'g>,
    body: &MassProperties<'g>,
) -> Wrench<'g, BodyFrame> {
    let (omega, axes) = (motion.omega, motion.axes);
    let p_ddot = motion.origin.acceleration.turned(link.turn);
    let s_ddot = body.first_moment.prime(axes).prime(axes);
    let spin_rate = body.inertia.times(omega).prime(axes);
    Wrench {
        force: body.mass * p_ddot + s_ddot,
        moment: body.first_moment.cross(p_ddot) + spin_rate,
    }
}

/// Acceleration of the joint's origin relative to B, no joint accelerating, expressed in own axes.
fn origin_acceleration<'g>(link: &Link<'g>, motion: &Motion<'g>) -> Vector<'g, BodyFrame> {
    motion.origin.acceleration.without(Stage::Acceleration).turned(link.turn)
}

/// The device's share of energy and momenta, with its steps written to `script`.
#[must_use]
pub fn momenta<'g>(
    chain: &Chain<'g>,
    observer: &Observer<'g>,
    script: &mut Script<'g>,
) -> Momenta<'g> {
    let graph = chain.graph;
    let motions = outwards(chain, observer, script);
    let mut momentum = Wrench::<BodyFrame>::zero(graph);
    let mut twice_energy = graph.zero();
    for (k, (link, motion)) in chain.links.iter().zip(&motions).enumerate().rev() {
        let data = &chain.kind.links[k];
        let (frame, letter) = (data.body.frame, data.body.letters[0]);
        let body = MassProperties::of_body(link, data, script);
        let (omega, p_dot) = (motion.omega, motion.origin.velocity.turned(link.turn));
        let own = Wrench {
            force: body.mass * p_dot + omega.cross(body.first_moment),
            moment: body.first_moment.cross(p_dot) + body.inertia.times(omega),
        };
        let heading = Heading::new(format!("Momentum of the {}", data.body.title));
        let heading = heading.cited("its moment as in", data.body.equations.h);
        let heading = heading
            .part("momentum", "kg m/s")
            .part("moment", "kg m²/s")
            .about(&format!("{letter} instead of B"));
        script.section("mom", heading);
        script.names(pairs(triple(&format!("p_{frame}"), frame), own.force.components()));
        script.names(pairs(triple(&format!("h_{frame}"), frame), own.moment.components()));
        twice_energy = twice_energy + (p_dot.dot(own.force) + omega.dot(own.moment));
        momentum = momentum.plus(own).in_parent_frame(link);
    }
    Momenta {
        energy: graph.constant(2).recip() * twice_energy,
        linear: momentum.force.relabelled_outboard().on_hub(),
        angular: momentum.moment.relabelled_outboard().on_hub(),
    }
}
