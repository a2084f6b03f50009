//! From the tip to the hub: the device's share of the mass matrix and of the bias, from its base
//! parameters.
//!
//! Moments are taken about the joint's own origin and moved to the next one, so that a light wheel
//! far from B does not lose digits beside the inertia of its lever arm. Everything is expressed in
//! local axes until the last step, which changes from the first body's axes, turned by the mount
//! and the first joint, to B.
//!
//! What the hub's own motion requires of the bodies is computed with the hub, from their first
//! moment and inertia. Here are what the joints' rates require, and the joints' own equations.

mod base_parameters;
mod first_origin;
mod hub_share;
mod joint;
mod parent_motion;
mod perpendicular;

use self::base_parameters::{Based, based, origin_words};
use self::first_origin::{OriginAxes, in_first_body_axes};
use self::hub_share::{cut, named};
use self::joint::AtJoint;
use self::parent_motion::{ParentMotion, parent_motions};
use self::perpendicular::PerpendicularComposite;
use super::chain::Chain;
use super::chain::mass_properties::MassProperties;
use super::chain::parallel_axes::{ParallelAxes, PerpendicularEntries};
use super::chain::wrench::Wrench;
use super::heading::Heading;
use super::script::{Script, pairs, sextuple, triple};
use super::share::Share;
use crate::graph::Expr;
use crate::kinds::{Body, Link, Motion, units};
use crate::space::{BodyFrame, Hub, Turn, Vector, XYZ};

/// The share of a device, with its steps written to `script`: first moment and inertia of what
/// moves, blocks of the joints, and the bias without what the hub's own motion requires. Expressed
/// in B; the mass is the hub's.
#[must_use]
pub fn inward_pass<'g>(chain: &Chain<'g>, script: &mut Script<'g>) -> Share<'g> {
    let based = based(chain, script);
    let axes = first_axes(chain, script);
    let omega = Vector::new(axes.map(|axis| axis.dot(chain.hub.omega)));
    let first = chain.first_moving();
    let data = &chain.kind.links[first].body;
    let frame = format!("the axes of the {}", data.title);
    script.section("rate", Heading::new("ω_{B/N}").equation("(D5)").axes(frame).unit("rad/s"));
    script.names(pairs(triple("omega_b_n", data.frame), omega.components()));
    let hub = first_parent(chain, &based, omega, script);
    let parent_motions = parent_motions(chain, &based, hub, script);
    let mut pass = InwardPass::new(chain, OriginAxes::choose(chain, &based));
    for k in (first + 1..chain.links.len()).rev() {
        pass.inwards(chain, &based, k, &parent_motions[k - first - 1], script);
    }
    let seen = pass.at_first(chain, &based, &hub, script);
    seen.share(chain, &based, axes, script)
}

/// The first body's axes, expressed in B.
fn first_axes<'g>(chain: &Chain<'g>, script: &mut Script<'g>) -> [Vector<'g, Hub>; 3] {
    use crate::space::Axis::{X, Y, Z};
    let first = chain.first_moving();
    let (link, data) = (&chain.links[first], &chain.kind.links[first].body);
    let parent = parent_axes(chain, script);
    let back = link.turn.inverse();
    let axes = [X, Y, Z]
        .map(|axis| Vector::<BodyFrame>::unit(chain.graph, axis).turned(back).along(parent));
    let heading = Heading::new(format!("Axes of the {}", data.title));
    script.section("axis", heading.equation("(D1)").axes("B").unit("1"));
    for (axis, letter) in axes.into_iter().zip(["x", "y", "z"]) {
        script.names(pairs(triple(&format!("e_{letter}"), "b"), axis.components()));
    }
    axes
}

/// The hub, whose angular velocity along the first body's axes is `omega`.
fn first_parent<'g>(
    chain: &Chain<'g>,
    based: &Based<'g>,
    omega: Vector<'g, BodyFrame>,
    script: &mut Script<'g>,
) -> ParentMotion<'g, BodyFrame> {
    if OriginAxes::choose(chain, based) == OriginAxes::Hub {
        return ParentMotion::hub(omega, Vector::zero(chain.graph));
    }
    let first = chain.first_moving();
    let body = &chain.kind.links[first].body;
    let axes = format!("the axes of the {}", body.title);
    let what = "Origin of the first joint from B, moved by (D3)";
    script.section("place", Heading::new(what).equation("(D2)").axes(&axes).unit("m"));
    let reach = in_first_body_axes(chain, based.reach(chain));
    script.names(pairs(triple("reach", body.frame), reach.components()));
    script.section("path", Heading::new(FIRST_ORIGIN).equation("(D5)").axes(axes).unit("m/s²"));
    let carried = omega.cross(omega.cross(reach));
    script.names(pairs(triple("r_first_rest", body.frame), carried.components()));
    ParentMotion::hub(omega, carried)
}

/// The axes of the parent body of the first joint that moves, expressed in B: the mount. Where it is
/// made of turns, or bodies are locked on the hub, they are constants of their own.
fn parent_axes<'g>(chain: &Chain<'g>, script: &mut Script<'g>) -> [Vector<'g, Hub>; 3] {
    use crate::space::Axis::{X, Y, Z};
    if chain.first_moving() == 0 && !chain.mount_is_turned() {
        return chain.mount;
    }
    let heading = Heading::new("Axes of the parent body of the first joint that moves");
    script.section("axis", heading.equation("(D1)").axes("B").unit("1"));
    [(X, "x"), (Y, "y"), (Z, "z")].map(|(axis, letter)| {
        let axis = chain.mounted(chain.on_first(Vector::unit(chain.graph, axis)));
        cut(script, &format!("parent_{letter}"), axis)
    })
}

/// What the hub's rotation makes of the first joint's origin.
const FIRST_ORIGIN: &str = "Acceleration of the first joint's origin, moved by (D3), due to ω";

/// What joints' rates require of the left side.
const CORIOLIS: &str = "Coriolis and centrifugal terms of the left side, which";

/// What the row of the first of these joints consists of, about or along an axis of `frame`.
fn row_heading(outboard: &[Link], frame: &str, origin_axes: OriginAxes) -> Heading {
    let (data, motion) = (&outboard[0], outboard[0].joint.motion);
    let (about, what, unit) = match motion {
        Motion::Turn(_) => ("about", "moment", units(outboard, |units| units.moment)),
        Motion::Slide(_) => ("along", "force", units(outboard, |units| units.force)),
    };
    let axis = XYZ[motion.axis().cycle()[0]];
    let heading =
        Heading::new(format!("Joint row of the {} {about} {frame}{axis}", data.body.title));
    let heading = heading.equation(data.body.equations.torque).equation("(D7), (D9)");
    let bias = match origin_axes {
        OriginAxes::FirstBody => "bias",
        OriginAxes::Hub => "bias without the hub's part",
    };
    let heading = heading.part("M_ij", unit).part(bias, motion.units().drive);
    if outboard.len() == 1 {
        return heading;
    }
    heading.note(format!(
        "which contains the {what} that the rates of the outboard joints require {about} the same \
         axis"
    ))
}

/// The composite of the joints processed so far, expressed in the current frame, about its origin.
struct InwardPass<'g> {
    origin_axes: OriginAxes,
    composite: MassProperties<'g>,
    /// What the rates of the joints processed so far require.
    rates: Wrench<'g, BodyFrame>,
    /// What a unit acceleration of each joint processed so far requires; the innermost first.
    columns: Vec<Wrench<'g, BodyFrame>>,
    joint: Vec<Vec<Expr<'g>>>,
    bias_joint: Vec<Expr<'g>>,
    /// What is across the tip's axis, where another can be parallel to it.
    perpendicular_composite: Option<PerpendicularComposite<'g>>,
    perpendicular: Option<PerpendicularEntries<'g>>,
}

impl<'g> InwardPass<'g> {
    fn new(chain: &Chain<'g>, origin_axes: OriginAxes) -> Self {
        Self {
            origin_axes,
            composite: MassProperties::zero(chain.graph),
            rates: Wrench::zero(chain.graph),
            columns: Vec::new(),
            joint: Vec::new(),
            bias_joint: Vec::new(),
            perpendicular_composite: None,
            perpendicular: None,
        }
    }

    /// Across joint `k`: its row, expressed in the parent body's axes, then all about that body's
    /// origin.
    fn inwards(
        &mut self,
        chain: &Chain<'g>,
        based: &Based<'g>,
        k: usize,
        parent: &ParentMotion<'g, BodyFrame>,
        script: &mut Script<'g>,
    ) {
        let link = &chain.links[k];
        let inner = &chain.kind.links[k - 1].body;
        let composite = based.links[k]
            .mass_properties
            .plus(self.composite)
            .in_parent_axes(link)
            .relabelled_inboard();
        let back = |v: Vector<'g, BodyFrame>| v.turned(link.turn.inverse()).relabelled_inboard();
        for wrench in self.columns.iter_mut().chain([&mut self.rates]) {
            *wrench = Wrench { force: back(wrench.force), moment: back(wrench.moment) };
        }
        self.perpendicular_composite = self
            .perpendicular_composite
            .map(|own| own.with_body(&based.links[k].mass_properties, link.turn.inverse()));
        self.row(chain, k, inner, composite, parent, script);
        if ParallelAxes::of_chain(chain).is_some_and(|joints| joints.tip == k) {
            let axis = chain.kind.links[k].joint.motion.axis();
            self.perpendicular_composite =
                Some(PerpendicularComposite::of_tip(axis, &composite, self.columns[0]));
        }
        let arm = based.links[k].origin.relabelled_inboard();
        self.perpendicular_composite =
            self.perpendicular_composite.map(|carried| carried.shifted(arm, &composite));
        self.composite = composite.shifted(arm);
        for wrench in self.columns.iter_mut().chain([&mut self.rates]) {
            wrench.moment = wrench.moment + arm.cross(wrench.force);
        }
    }

    /// The first joint's row, expressed in its body's own axes.
    fn at_first(
        mut self,
        chain: &Chain<'g>,
        based: &Based<'g>,
        hub: &ParentMotion<'g, BodyFrame>,
        script: &mut Script<'g>,
    ) -> Self {
        let first = chain.first_moving();
        let own = &chain.kind.links[first].body;
        let composite = based.links[first].mass_properties.plus(self.composite);
        let body = &based.links[first].mass_properties;
        self.perpendicular_composite = self
            .perpendicular_composite
            .map(|carried| carried.with_body(body, Turn::none(chain.graph)));
        self.row(chain, first, own, composite, hub, script);
        self.composite = composite;
        self
    }

    /// The row of joint `k`, expressed in the axes of `body`, and what its rate requires.
    fn row(
        &mut self,
        chain: &Chain<'g>,
        k: usize,
        body: &Body,
        composite: MassProperties<'g>,
        parent: &ParentMotion<'g, BodyFrame>,
        script: &mut Script<'g>,
    ) {
        let (link, behind) = (&chain.links[k], &chain.kind.links[k..]);
        let (data, axis) = (&behind[0], behind[0].joint.motion.axis());
        let (whole, frame) = (data.assembly.to_uppercase(), body.frame);
        let (title, origin) = (data.body.title, origin_words(chain, k));
        let axes = format!("the axes of the {}", body.title);
        let what = format!("Outboard composite of the joint of the {title}, {whole}");
        let heading = Heading::new(what + ", by base parameters").equation("(D6)").axes(&axes);
        let heading = heading.part("first moment", "kg m").part("inertia", "kg m²");
        script.section("lump", heading.about(&origin));
        let stem = format!("mr_behind_{}", data.assembly);
        script.names(pairs(triple(&stem, frame), composite.first_moment.components()));
        let stem = format!("i_behind_{}", data.assembly);
        script.names(pairs(sextuple(&stem), composite.inertia.entries()));

        let at = AtJoint {
            axis,
            coordinate: link.coordinate,
            rate: link.rate,
            composite,
            parent: *parent,
        };
        self.columns.insert(0, composite.moved(link.coordinate, Vector::unit(chain.graph, axis)));
        let tip = behind.len() == 1;
        script.section("row", row_heading(behind, frame, self.origin_axes));
        self.perpendicular_row(chain, k, script);
        let tags = behind.iter().map(|link| link.joint.tag);
        let row = tags.zip(&self.columns).map(|(tag, column)| {
            script.cut(format!("mass_{}{tag}", data.joint.tag), column.along(link))
        });
        self.joint.insert(0, row.collect());
        let required = at.of_field() + self.rates.along(link);
        script.name(format!("field_{}", data.joint.tag), required);
        self.bias_joint.insert(0, required);

        let what = if tip {
            format!("{CORIOLIS} the rate of the joint of the {title} requires")
        } else {
            format!(
                "{CORIOLIS} the rates of the joint of the {title} and of those outboard of it require"
            )
        };
        script.section(
            "coriolis",
            Heading::new(what).equation("(D8)").axes(axes).wrench(["N", "N m"], &origin),
        );
        self.rates = self.rates.plus(at.of_rate());
        script.names(self.rates.named(&format!("rates_{}", data.joint.tag), frame));
    }

    /// Where the axis of joint `k` can be parallel to the tip's: its row across that, and the tip's
    /// column by it.
    fn perpendicular_row(&mut self, chain: &Chain<'g>, k: usize, script: &mut Script<'g>) {
        let parallel = ParallelAxes::of_chain(chain).filter(|joints| joints.inner == k);
        let Some((joints, carried)) = parallel.zip(self.perpendicular_composite) else { return };
        let links = chain.kind.links;
        let axis = links[k].joint.motion.axis();
        let names = joints.names(links).into_iter();
        let cut = names.zip(carried.along(axis)).map(|(name, value)| script.cut(name, value));
        let [diagonal, coupling] = cut.collect::<Vec<_>>()[..] else { unreachable!("two names") };
        let column = &mut self.columns[joints.tip - k];
        let mut moment = column.moment.components();
        moment[axis.cycle()[0]] = coupling + joints.cosine * self.joint[joints.tip - k - 1][0];
        column.moment = Vector::new(moment);
        self.perpendicular = Some(PerpendicularEntries { joints, diagonal, coupling });
    }
}

/// Constant share of the hub: what a device adds to it whatever its joints do.
pub fn constant_share<'g>(chain: &Chain<'g>, script: &mut Script<'g>) {
    let MassProperties { first_moment, inertia, .. } = based(chain, script).constant_share;
    let mass = chain.links.iter().skip(1).fold(chain.links[0].mass, |sum, link| sum + link.mass);
    let heading = Heading::new("Constant share of the hub").equation("(D4)").axes("B").about("B");
    let heading = heading.part("mass", "kg").part("first moment", "kg m").part("inertia", "kg m²");
    script.section("share", heading);
    script.name("constant_m", mass);
    named(script, "constant_mr", chain.mounted(first_moment));
    script.names(pairs(sextuple("constant_i"), chain.mounted_tensor(inertia).entries()));
}
