//! Steering: what the rates and the accelerations of a device's joints require about B, one by one.
//!
//! With H the device's angular momentum about B by velocities relative to B, `H = [I] omega + sum n_i q_i'`, the moment
//! about B that the device requires is
//! `sum (dH/dq_i + omega x n_i) q_i' + sum n_i q_i'' + [I] omega' + S x r_B'' + omega x [I] omega`.
//! A joint that turns about a turns the composite of all that is outboard of it, and what the rates further out give it,
//! but not the velocity v of its origin nor the angular velocity omega that its parent body has: about the origin
//! `dp/dq = omega x (a x S) + a x p_out` and `dH/dq = (a x S) x v + a x [I] omega - [I] (a x omega) + a x H_out`. Both hold
//! with the omega of its own body as well: what its own rate gives, turns with it.

use super::composite::outwards;
use crate::derivation::chain::mass_properties::MassProperties;
use crate::derivation::chain::motion::{Motion, Observer};
use crate::derivation::chain::wrench::Wrench;
use crate::derivation::chain::{Chain, Coordinate, Link};
use crate::derivation::heading::Heading;
use crate::derivation::script::Script;
use crate::kinds;
use crate::space::{BodyFrame, Hub, Symmetric, Vector};

/// What a device requires about B, expressed in its axes.
pub(crate) struct Steering<'g> {
    /// Angular momentum of the motion relative to the hub.
    pub(crate) relative: Vector<'g, Hub>,
    /// Moment per rate of each joint.
    pub(crate) by_rate: Vec<Vector<'g, Hub>>,
    /// Moment per acceleration of each joint.
    pub(crate) by_acceleration: Vec<Vector<'g, Hub>>,
    /// Moment per acceleration of B: its cross product.
    pub(crate) first_moment: Vector<'g, Hub>,
    /// Moment per angular acceleration of the hub.
    pub(crate) inertia: Symmetric<'g, Hub>,
    /// Moment that no joint's motion needs: `omega x [I] omega`.
    pub(crate) gyroscopic: Vector<'g, Hub>,
}

/// Writes the steps to `script`.
pub(crate) fn steering<'g>(chain: &Chain<'g>, script: &mut Script<'g>) -> Steering<'g> {
    let graph = chain.graph;
    // Velocities relative to B: what the hub's own velocity adds to H, it adds to no moment.
    let observer = Observer { velocity: Vector::zero(graph), ..Observer::inertial(chain) };
    let motions = outwards(chain, &observer, script);
    let mut composite = MassProperties::zero(graph);
    let mut columns: Vec<[Wrench<'g, BodyFrame>; 2]> = Vec::new();
    for ((link, data), motion) in chain.links.iter().zip(chain.kind.links).zip(&motions).rev() {
        let body = MassProperties::of_body(link, data, script);
        composite = composite.plus(body);
        composite.name(data, script);
        let outboard = &chain.links[chain.links.len() - columns.len()..];
        let further = outboard.iter().zip(&columns).fold(Wrench::zero(graph), |sum, (of, pair)| {
            let [_, column] = *pair;
            sum.plus(Wrench { force: of.rate * column.force, moment: of.rate * column.moment })
        });
        let column = composite.column(link);
        let turned = by_coordinate(link, motion, &composite, &column, &further);
        columns.insert(0, [turned, column]);
        describe(data, columns[0], script);
        composite = composite.in_parent_frame(link);
        columns = columns.iter().map(|pair| pair.map(|of| of.in_parent_frame(link))).collect();
    }
    let on_hub = |v: Vector<'g, BodyFrame>| v.relabelled_outboard().on_hub();
    let omega = chain.hub.omega;
    let inertia = Symmetric::new(composite.inertia.entries());
    let (mut relative, mut by_rate, mut by_acceleration) = (Vector::zero(graph), vec![], vec![]);
    for (link, [turned, column]) in chain.links.iter().zip(columns) {
        let column = on_hub(column.moment);
        relative = relative + link.rate * column;
        by_rate.push(on_hub(turned.moment) + omega.cross(column));
        by_acceleration.push(column);
    }
    let first_moment = on_hub(composite.first_moment);
    let gyroscopic = omega.cross(inertia.times(omega));
    Steering { relative, by_rate, by_acceleration, first_moment, inertia, gyroscopic }
}

/// The derivative of the momentum of all that is outboard of a joint by its coordinate, about the joint's origin where it
/// was. `column` is what the joint's rate gives the composite, `further` what the rates further out give it.
fn by_coordinate<'g>(
    link: &Link<'g>,
    motion: &Motion<'g>,
    composite: &MassProperties<'g>,
    column: &Wrench<'g, BodyFrame>,
    further: &Wrench<'g, BodyFrame>,
) -> Wrench<'g, BodyFrame> {
    let (axis, omega, inertia) = (link.axis, motion.omega, composite.inertia);
    let v = motion.origin.velocity.turned(link.turn);
    match link.coordinate {
        // A symmetric rotor looks the same from every angle.
        Coordinate::Angle(_) if link.turn.is_none() => Wrench::zero(link.rate.graph()),
        Coordinate::Angle(_) => Wrench {
            force: omega.cross(column.force) + axis.cross(further.force),
            moment: column.force.cross(v) + axis.cross(inertia.times(omega) + further.moment)
                - inertia.times(axis.cross(omega)),
        },
        Coordinate::Length(_) => {
            let sideways = omega.cross(axis);
            let p = composite.mass * v + omega.cross(composite.first_moment) + further.force;
            Wrench {
                force: composite.mass * sideways,
                moment: composite.first_moment.cross(sideways) + axis.cross(p),
            }
        }
    }
}

/// Names the columns of the first of these joints.
fn describe<'g>(
    data: &kinds::Link,
    [turned, column]: [Wrench<'g, BodyFrame>; 2],
    script: &mut Script<'g>,
) {
    let (body, whole) = (&data.body, data.assembly.to_uppercase());
    let (frame, letter, equations) = (body.frame, body.letters[0], &body.equations);
    let (tag, units) = (data.joint.tag, data.joint.motion.units());
    let heading = Heading::new(format!("{whole} per unit acceleration of its joint"));
    script.section("col", heading.equation("(17)").wrench([units.force, units.moment], letter));
    script.names(column.named(&format!("{tag}_moved"), frame));
    let what = format!("Momentum of {whole}, differentiated by `{}`", data.joint.coordinate);
    script.section("turn", Heading::new(what).cited("as in", equations.h_dot).about(letter));
    script.names(turned.named(&format!("{tag}_turned"), frame));
}
