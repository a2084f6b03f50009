//! Base inertial parameters: what of a body a joint's motion changes; the rest is regrouped to the
//! parent body.
//!
//! Two passes over the chain, arithmetic on parameters only. Neither changes an equation, which the
//! proof shows of what is emitted (a third, over the functions, is [`crate::emit`]'s):
//!
//! - *slide* (D3): the origin of a turning joint may lie anywhere on its axis. Moved along it, each
//!   offset between two joints loses a component.
//! - *regroup* (D4): a mass on the axis of a turning joint, or spread along it, is not moved by the
//!   joint. Three of a body's ten parameters are regrouped to its parent body: its mass, the first
//!   moment along the axis, and one moment of inertia across it. Of a sliding body it is the
//!   inertia. What reaches the hub is the device's constant share of it: a massless device is left.
//!
//! What the passes leave is a polynomial in the parameters, stated as its normal form: a large
//! moment that was added and subtracted again, `m l^2` of a long arm, cancels without rounding.

use crate::derivation::chain::mass_properties::MassProperties;
use crate::derivation::chain::{Chain, Coordinate};
use crate::derivation::heading::Heading;
use crate::derivation::script::{Script, pairs, sextuple, triple};
use crate::graph::Expr;
use crate::kinds::{Link, Motion};
use crate::normal::Ring;
use crate::space::{Axis, BodyFrame, ParentFrame, Symmetric, Vector};

/// A joint's origin and what turns or slides with it, after the passes.
#[derive(Clone, Copy)]
pub(super) struct Base<'g> {
    /// From the parent body's origin.
    pub(super) origin: Vector<'g, ParentFrame>,
    /// About the joint's origin.
    pub(super) mass_properties: MassProperties<'g>,
}

/// The chain after the passes.
pub(super) struct Based<'g> {
    /// From the hub outwards.
    pub(super) links: Vec<Base<'g>>,
    /// Constant share of the hub, about B, expressed in the device's axes.
    pub(super) constant_share: MassProperties<'g, ParentFrame>,
}

/// Makes the passes; the bodies' own first moments and inertias go to `script`.
pub(super) fn based<'g>(chain: &Chain<'g>, script: &mut Script<'g>) -> Based<'g> {
    let passes = chain.passes;
    let bodies = chain.links.iter().zip(chain.kind.links);
    let links = bodies.map(|(link, data)| Base {
        origin: link.origin,
        mass_properties: MassProperties::of_body(link, data, script),
    });
    let mut links: Vec<_> = links.collect();
    if passes.slide {
        slide(chain, &mut links);
    }
    let constant_share =
        if passes.regroup { regroup(chain, &mut links) } else { MassProperties::zero(chain.graph) };
    let mut based = Based { links, constant_share };
    if passes.slide || passes.regroup {
        based.settle(chain, script);
    }
    based
}

impl<'g> Based<'g> {
    /// From B to the origin of the first joint that moves, along the device's axes.
    pub(super) fn reach(&self, chain: &Chain<'g>) -> Vector<'g, ParentFrame> {
        let origins: Vec<_> = self.links.iter().map(|link| link.origin).collect();
        chain.reach(&origins)
    }

    /// Every number as its normal form, and under a name.
    fn settle(&mut self, chain: &Chain<'g>, script: &mut Script<'g>) {
        let mut ring = Ring::new(chain.graph);
        let mut settled = |e: Expr<'g>| {
            let normal = ring.normal(e).ok();
            // A coordinate of a sliding joint is a variable like any other.
            normal.map_or(e, |normal| ring.expression(&normal))
        };
        for (k, (base, data)) in self.links.iter_mut().zip(chain.kind.links).enumerate() {
            base.origin = Vector::new(base.origin.components().map(&mut settled));
            base.mass_properties = base.mass_properties.map(&mut settled);
            let carrier = k.checked_sub(1).map_or("d", |inner| chain.kind.links[inner].body.frame);
            base.name(data, &origin_words(chain, k), carrier, script);
        }
        self.constant_share = self.constant_share.map(&mut settled);
    }
}

impl<'g> Base<'g> {
    fn name(&self, data: &Link, origin: &str, carrier: &str, script: &mut Script<'g>) {
        let (joint, body) = (&data.joint, &data.body);
        let heading = Heading::new(format!("Base inertial parameters of the {}", body.title));
        let heading =
            heading.equation("(D3), (D4)").part(format!("{origin} from the parent's origin"), "m");
        let heading = heading.part("first moment", "kg m").part("inertia", "kg m²").about("it");
        script.section("base", heading);
        let tag = joint.tag;
        script.names(pairs(triple(&format!("arm_{tag}"), carrier), self.origin.components()));
        let names = triple(&format!("mr_{tag}_base"), body.frame);
        script.names(pairs(names, self.mass_properties.first_moment.components()));
        let names = sextuple(&format!("i_{tag}_base"));
        script.names(pairs(names, self.mass_properties.inertia.entries()));
    }
}

/// The origin of a joint in the equations: of a turning joint it is not where the paper places it.
pub(super) fn origin_words(chain: &Chain<'_>, k: usize) -> String {
    let link = &chain.kind.links[k];
    let moved = chain.passes.slide && matches!(link.joint.motion, Motion::Turn(_));
    format!("{}{}", link.body.letters[0], if moved { " moved by (D3)" } else { "" })
}

/// (D3). A joint's origin goes where the next offset has no component along its axis, the last
/// one's where its own has none.
fn slide<'g>(chain: &Chain<'g>, links: &mut [Base<'g>]) {
    let zero = chain.graph.zero();
    for (k, data) in chain.kind.links.iter().enumerate().rev() {
        let Motion::Turn(axis) = data.joint.motion else { continue };
        let along = axis.cycle()[0];
        let by = match links.get(k + 1) {
            Some(next) => next.origin.components()[along],
            None => -links[k].origin.components()[along],
        };
        let step = [0, 1, 2].map(|c| if c == along { by } else { zero });
        links[k].origin = links[k].origin + Vector::new(step);
        links[k].mass_properties =
            links[k].mass_properties.shifted(-Vector::<BodyFrame>::new(step));
        if let Some(next) = links.get_mut(k + 1) {
            let mut rest = next.origin.components();
            rest[along] = zero;
            next.origin = Vector::new(rest);
        }
    }
}

/// (D4), from the tip to the hub.
fn regroup<'g>(chain: &Chain<'g>, links: &mut [Base<'g>]) -> MassProperties<'g, ParentFrame> {
    let mut constant_share = MassProperties::zero(chain.graph);
    for (k, link) in chain.links.iter().enumerate().rev() {
        let own = &mut links[k];
        own.mass_properties = own.mass_properties.plus(constant_share.relabelled_inboard());
        if chain.kind.links[k].is_locked() {
            // It never moves in its parent body.
            let origin = own.origin;
            let mass_properties =
                std::mem::replace(&mut own.mass_properties, MassProperties::zero(chain.graph));
            constant_share = mass_properties.in_parent_axes(link).shifted(origin);
            continue;
        }
        let axis = chain.kind.links[k].joint.motion.axis();
        let moved = movable(own.mass_properties, link.coordinate, axis);
        own.mass_properties = own.mass_properties.less(moved);
        // The same from every angle: in the parent body's axes as in its own.
        let moved = MassProperties {
            mass: moved.mass,
            first_moment: Vector::new(moved.first_moment.components()),
            inertia: Symmetric::new(moved.inertia.entries()),
        };
        constant_share = match link.coordinate {
            Coordinate::Angle(_) => moved.shifted(own.origin),
            // Without mass and first moment, an inertia is the same about every origin.
            Coordinate::Length(_) => moved,
        };
    }
    constant_share
}

/// The part that its joint's motion does not change.
fn movable<'g>(
    mass_properties: MassProperties<'g>,
    coordinate: Coordinate<'g>,
    axis: Axis,
) -> MassProperties<'g> {
    let zero = mass_properties.mass.graph().zero();
    match coordinate {
        Coordinate::Length(_) => MassProperties {
            mass: zero,
            first_moment: Vector::zero(zero.graph()),
            ..mass_properties
        },
        Coordinate::Angle(_) => {
            let [k, i, j] = axis.cycle();
            let across = mass_properties.inertia.at(j, j);
            let along = mass_properties.first_moment.components()[k];
            let mut first_moment = [zero; 3];
            first_moment[k] = along;
            let mut moments = [zero; 3];
            (moments[i], moments[j]) = (across, across);
            MassProperties {
                mass: mass_properties.mass,
                first_moment: Vector::new(first_moment),
                inertia: Symmetric::diagonal(moments),
            }
        }
    }
}
