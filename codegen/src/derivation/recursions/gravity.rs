//! A field of acceleration that grows linearly from B, `G r`, and what it does to each body.
//!
//! With S and I about a joint's origin p, the field pulls a body with `m G p + G S` and turns it
//! with `S x G p` and with the torque of the gradient on an extended body, which depends on the
//! second moment only up to a multiple of the unit tensor. G need not be free of a trace.

use crate::derivation::chain::mass_properties::MassProperties;
use crate::derivation::chain::wrench::Wrench;
use crate::derivation::chain::{Chain, Link};
use crate::derivation::heading::Heading;
use crate::derivation::script::{Script, pairs, sextuple, triple};
use crate::graph::{Graph, Stage};
use crate::space::{BodyFrame, ENTRIES, Hub, ParentFrame, Symmetric, Vector};

/// Writes to `script` what the field does to each body, expressed in own axes, about its joint's
/// origin, and `S = integral of r r^T dm` of the device, about B.
pub fn gravity<'g>(chain: &Chain<'g>, script: &mut Script<'g>) {
    let mut here = Field::about_b(chain.graph);
    let mut bodies = Vec::new();
    for (link, data) in chain.links.iter().zip(chain.kind.links) {
        let (frame, origin) = (data.body.frame, data.body.origin);
        let (title, letter) = (data.body.title, data.body.letters[0]);
        let own = here.across(link);
        let heading = Heading::new("G").cited("as in", "(D16)");
        script.section("field", heading.axes(format!("the axes of the {title}")).unit("1/s²"));
        script.names(pairs(sextuple(&format!("g_{frame}")), own.gradient.entries()));
        let heading = Heading::new(format!("G r at {letter}")).equation("(D16)");
        script.section("field", heading.axes("the same axes").unit("m/s²"));
        script.names(pairs(triple(&format!("g_r_{origin}"), frame), own.origin.components()));
        let body = MassProperties::of_body(link, data, script);
        let heading = Heading::new(format!("On the {title} only")).equation("(D17)");
        script.section("pull", heading.wrench(["N", "N m"], letter));
        script.names(own.on(&body).named("on", frame));
        bodies.push(body);
        here = own.relabelled_outboard();
    }
    let mut composite = MassProperties::zero(chain.graph);
    for ((link, data), body) in chain.links.iter().zip(chain.kind.links).zip(bodies).rev() {
        composite = composite.plus(body);
        composite.name(data, script);
        composite = composite.in_parent_frame(link);
    }
    let second_moment = composite.inertia.second_moment();
    let heading = Heading::new("S = ∫ r rᵀ dm of the device about B").equation("(D18)");
    script.section("axis", heading.axes("the device's axes").unit("kg m²"));
    script.names(pairs(sextuple("second_moment"), second_moment.entries()));
}

/// The symbols of the gradient, expressed in B.
#[must_use]
pub fn gradient(graph: &Graph) -> Symmetric<'_, Hub> {
    Symmetric::new(ENTRIES.map(|entry| graph.symbol(&format!("g_{entry}"), Stage::Rate)))
}

/// The field about an origin.
#[derive(Clone, Copy)]
struct Field<'g, F> {
    /// G.
    gradient: Symmetric<'g, F>,
    /// `G r` at the origin.
    origin: Vector<'g, F>,
}

impl<'g> Field<'g, ParentFrame> {
    /// About B.
    fn about_b(graph: &'g Graph) -> Self {
        let gradient = Symmetric::new(gradient(graph).entries());
        Self { gradient, origin: Vector::zero(graph) }
    }

    /// About a joint's origin, expressed in own axes.
    fn across(self, link: &Link<'g>) -> Field<'g, BodyFrame> {
        let origin = self.origin + self.gradient.times(link.origin);
        Field { gradient: self.gradient.turned(link.turn), origin: origin.turned(link.turn) }
    }
}

impl<'g> Field<'g, BodyFrame> {
    /// Away from the hub: the body's frame is the parent frame of the next joint.
    fn relabelled_outboard(self) -> Field<'g, ParentFrame> {
        let gradient = Symmetric::new(self.gradient.entries());
        Field { gradient, origin: self.origin.relabelled_outboard() }
    }

    /// Force and moment on a body. S and I are `tr(I) / 2 - I` and I up to a multiple of the
    /// unit tensor.
    fn on(self, body: &MassProperties<'g>) -> Wrench<'g, BodyFrame> {
        let s = body.first_moment;
        Wrench {
            force: body.mass * self.origin + self.gradient.times(s),
            moment: s.cross(self.origin) - body.inertia.couple(self.gradient),
        }
    }
}
