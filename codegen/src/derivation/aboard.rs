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

use super::Share;
use super::base::{Based, based, origin_words};
use super::carriers::{Carrying, carriers};
use super::chain::{Chain, Coordinate, XYZ};
use super::heading::Heading;
use super::joint::AtJoint;
use super::lump::Lump;
use super::script::{Script, pairs, sextuple, triple};
use super::wrench::Wrench;
use crate::graph::Expr;
use crate::kinds::{Body, Link, Motion, units};
use crate::space::{Hub, Own, Symmetric, Vector};

/// The share of a device, with its steps written to `script`: first moment and inertia of what
/// moves, blocks of the joints, and the bias without what the hub's own motion requires. Expressed
/// in B; the mass is the hub's.
#[must_use]
pub fn aboard<'g>(chain: &Chain<'g>, script: &mut Script<'g>) -> Share<'g> {
    let based = based(chain, script);
    let axes = first_axes(chain, script);
    let omega = Vector::new(axes.map(|axis| axis.dot(chain.hub.omega)));
    let first = chain.first_moving();
    let data = &chain.kind.links[first].body;
    let frame = format!("the axes of the {}", data.title);
    script.section("rate", Heading::of("ω_{B/N}").equation("(D5)").axes(frame).unit("rad/s"));
    script.names(pairs(triple("omega_b_n", data.frame), omega.components()));
    let carriers = carriers(chain, &based, omega, script);
    let mut walk = Walk::new(chain);
    for k in (first + 1..chain.links.len()).rev() {
        walk.inwards(chain, &based, k, &carriers[k - first - 1], script);
    }
    let seen = walk.at_first(chain, &based, &Carrying::hub(omega), script);
    seen.aboard(chain, &based, axes, script)
}

/// The first body's axes, expressed in B.
fn first_axes<'g>(chain: &Chain<'g>, script: &mut Script<'g>) -> [Vector<'g, Hub>; 3] {
    use crate::space::Axis::{X, Y, Z};
    let first = chain.first_moving();
    let (link, data) = (&chain.links[first], &chain.kind.links[first].body);
    let parent = parent_axes(chain, script);
    let back = link.turn.inverse();
    let axes =
        [X, Y, Z].map(|axis| Vector::<Own>::unit(chain.graph, axis).turned(back).along(parent));
    let heading = Heading::of(format!("Axes of the {}", data.title));
    script.section("axis", heading.equation("(D1)").axes("B").unit("1"));
    for (axis, letter) in axes.into_iter().zip(["x", "y", "z"]) {
        script.names(pairs(triple(&format!("e_{letter}"), "b"), axis.components()));
    }
    axes
}

/// The axes of the parent body of the first joint that moves, expressed in B: the mount. Where it is
/// made of turns, or bodies stand on the hub, they are constants of their own.
fn parent_axes<'g>(chain: &Chain<'g>, script: &mut Script<'g>) -> [Vector<'g, Hub>; 3] {
    use crate::space::Axis::{X, Y, Z};
    if chain.first_moving() == 0 && !chain.mount_is_turned() {
        return chain.mount;
    }
    let heading = Heading::of("Axes of the parent body of the first joint that moves");
    script.section("axis", heading.equation("(D1)").axes("B").unit("1"));
    [(X, "x"), (Y, "y"), (Z, "z")].map(|(axis, letter)| {
        let axis = chain.mounted(chain.on_first(Vector::unit(chain.graph, axis)));
        cut(script, &format!("parent_{letter}"), axis)
    })
}

/// What joints' rates require of the left side.
const CORIOLIS: &str = "Coriolis and centrifugal terms of the left side, which";

/// What the row of the first of these joints consists of, about or along an axis of `frame`.
fn row_heading(outboard: &[Link], frame: &str) -> Heading {
    let (data, motion) = (&outboard[0], outboard[0].joint.motion);
    let (about, what, unit) = match motion {
        Motion::Turn(_) => ("about", "moment", units(outboard, |units| units.moment)),
        Motion::Slide(_) => ("along", "force", units(outboard, |units| units.force)),
    };
    let axis = XYZ[motion.axis().cycle()[0]];
    let heading =
        Heading::of(format!("Joint row of the {} {about} {frame}{axis}", data.body.title));
    let heading = heading.equation(data.body.equations.torque).equation("(D7), (D9)");
    let heading =
        heading.part("M_ij", unit).part("bias without the hub's part", motion.units().drive);
    if outboard.len() == 1 {
        return heading;
    }
    heading.note(format!(
        "which contains the {what} that the rates of the outboard joints require {about} the same \
         axis"
    ))
}

/// The composite of the joints processed so far, expressed in the current frame, about its origin.
struct Walk<'g> {
    lump: Lump<'g>,
    /// What the rates of the joints processed so far require.
    rates: Wrench<'g, Own>,
    /// What a unit acceleration of each joint processed so far requires; the innermost first.
    columns: Vec<Wrench<'g, Own>>,
    joint: Vec<Vec<Expr<'g>>>,
    bias_joint: Vec<Expr<'g>>,
}

impl<'g> Walk<'g> {
    fn new(chain: &Chain<'g>) -> Self {
        Self {
            lump: Lump::zero(chain.graph),
            rates: Wrench::zero(chain.graph),
            columns: Vec::new(),
            joint: Vec::new(),
            bias_joint: Vec::new(),
        }
    }

    /// Across joint `k`: its row, expressed in the parent body's axes, then all about that body's
    /// origin.
    fn inwards(
        &mut self,
        chain: &Chain<'g>,
        based: &Based<'g>,
        k: usize,
        carrying: &Carrying<'g, Own>,
        script: &mut Script<'g>,
    ) {
        let link = &chain.links[k];
        let inner = &chain.kind.links[k - 1].body;
        let lump = based.links[k].lump.plus(self.lump).turned_back(link).handed_back();
        let back = |v: Vector<'g, Own>| v.turned(link.turn.inverse()).handed_back();
        for wrench in self.columns.iter_mut().chain([&mut self.rates]) {
            *wrench = Wrench { force: back(wrench.force), moment: back(wrench.moment) };
        }
        self.row(chain, k, inner, lump, carrying, script);
        let arm = based.links[k].origin.handed_back();
        self.lump = lump.shifted(arm);
        for wrench in self.columns.iter_mut().chain([&mut self.rates]) {
            wrench.moment = wrench.moment + arm.cross(wrench.force);
        }
    }

    /// The first joint's row, expressed in its body's own axes.
    fn at_first(
        mut self,
        chain: &Chain<'g>,
        based: &Based<'g>,
        hub: &Carrying<'g, Own>,
        script: &mut Script<'g>,
    ) -> Self {
        let first = chain.first_moving();
        let own = &chain.kind.links[first].body;
        let lump = based.links[first].lump.plus(self.lump);
        self.row(chain, first, own, lump, hub, script);
        self.lump = lump;
        self
    }

    /// The row of joint `k`, expressed in the axes of `body`, and what its rate requires.
    fn row(
        &mut self,
        chain: &Chain<'g>,
        k: usize,
        body: &Body,
        lump: Lump<'g>,
        carrying: &Carrying<'g, Own>,
        script: &mut Script<'g>,
    ) {
        let (link, behind) = (&chain.links[k], &chain.kind.links[k..]);
        let (data, axis) = (&behind[0], behind[0].joint.motion.axis());
        let (whole, frame) = (data.assembly.to_uppercase(), body.frame);
        let (title, origin) = (data.body.title, origin_words(chain, k));
        let axes = format!("the axes of the {}", body.title);
        let what = format!("Outboard composite of the joint of the {title}, {whole}");
        let heading = Heading::of(what + ", by base parameters").equation("(D6)").axes(&axes);
        let heading = heading.part("first moment", "kg m").part("inertia", "kg m²");
        script.section("lump", heading.about(&origin));
        let stem = format!("mr_behind_{}", data.assembly);
        script.names(pairs(triple(&stem, frame), lump.first_moment.components()));
        let stem = format!("i_behind_{}", data.assembly);
        script.names(pairs(sextuple(&stem), lump.inertia.entries()));

        let at = AtJoint {
            axis,
            coordinate: link.coordinate,
            rate: link.rate,
            lump,
            carrying: *carrying,
        };
        self.columns.insert(0, lump.moved(link.coordinate, Vector::unit(chain.graph, axis)));
        let tip = behind.len() == 1;
        script.section("row", row_heading(behind, frame));
        let tags = behind.iter().map(|link| link.joint.tag);
        let row = tags.zip(&self.columns).map(|(tag, column)| {
            script.cut(format!("mass_{}{tag}", data.joint.tag), column.along(link))
        });
        self.joint.insert(0, row.collect());
        let asked = at.of_field() + self.rates.along(link);
        script.name(format!("field_{}", data.joint.tag), asked);
        self.bias_joint.insert(0, asked);

        let what = if tip {
            format!("{CORIOLIS} the rate of the joint of the {title} requires")
        } else {
            format!(
                "{CORIOLIS} the rates of the joint of the {title} and of those outboard of it require"
            )
        };
        script.section(
            "coriolis",
            Heading::of(what).equation("(D8)").axes(axes).wrench(["N", "N m"], &origin),
        );
        self.rates = self.rates.plus(at.of_rate());
        script.names(self.rates.named(&format!("rates_{}", data.joint.tag), frame));
    }

    /// Transforms the composite to B axes, about B.
    fn aboard(
        &self,
        chain: &Chain<'g>,
        based: &Based<'g>,
        axes: [Vector<'g, Hub>; 3],
        script: &mut Script<'g>,
    ) -> Share<'g> {
        let first = chain.first_moving();
        let origins: Vec<_> = based.links.iter().map(|link| link.origin).collect();
        let reach = chain.mounted(chain.reach(&origins));
        let what = "Origin of the first joint from B, moved by (D3)";
        script.section("place", Heading::of(what).equation("(D2)").axes("B").unit("m"));
        let reach = named(script, "reach", reach);
        let along_b = |v: Vector<'g, Own>| v.along(axes);
        let on_hub = |w: &Wrench<'g, Own>| {
            let force = along_b(w.force);
            (force, along_b(w.moment), reach)
        };
        let links = &chain.kind.links[first..];
        let whole = links[0].assembly;
        let wrench = [units(links, |units| units.force), units(links, |units| units.moment)];
        let heading = Heading::of("M_vi and M_wi").equation("(17), (75), (D7)").axes("B");
        let heading = heading.wrench(wrench.each_ref().map(String::as_str), "B");
        script.section("col", heading.note("per unit joint acceleration"));
        // Bodies inboard of it have no equation.
        let zero = chain.graph.zero();
        let mut force = vec![Vector::zero(chain.graph); first];
        let mut moment = force.clone();
        let mut own_moment = Vector::zero(chain.graph);
        for (k, (link, column)) in links.iter().zip(&self.columns).enumerate() {
            let (f, n, arm) = on_hub(column);
            let f = cut(script, &format!("f_{}", link.joint.tag), f);
            if k == 0 {
                own_moment = n;
            }
            force.push(f);
            moment.push(cut(script, &format!("n_{}", link.joint.tag), n + arm.cross(f)));
        }
        let what = format!("{} without its constant share of the hub", whole.to_uppercase());
        let heading = Heading::of(what).equation("(9), (76), (D6)").axes("B").about("B");
        let heading = heading.part("first moment", "kg m").part("inertia", "kg m²");
        script.section("moment", heading);
        let first_moment = along_b(self.lump.first_moment);
        let inertia = self.inertia_along_b(chain, axes, own_moment);
        let lump = Lump { mass: self.lump.mass, first_moment, inertia }.shifted(reach);
        let first_moment = cut(script, "mr_moving", lump.first_moment);
        let names = sextuple("i_moving");
        let entries = pairs(names, lump.inertia.entries());
        let entries: Vec<_> = entries.map(|(name, entry)| script.cut(name, entry)).collect();
        let inertia = Symmetric::new(entries.try_into().expect("six entries"));

        let heading = Heading::of(format!("{CORIOLIS} the joints' rates require"));
        let heading = heading.equation("(16), (75), (D8)").axes("B").wrench(["N", "N m"], "B");
        script.section("bias", heading);
        let (f, n, arm) = on_hub(&self.rates);
        let bias_force = cut(script, "f_rates", f);
        let bias_moment = cut(script, "n_rates", n + arm.cross(bias_force));

        let what = "Acceleration of the first joint's origin, moved by (D3), due to ω";
        script.section("reach", Heading::of(what).equation("(D5)").axes("B").unit("m/s²"));
        let carried = chain.hub.omega.cross(chain.hub.omega.cross(reach));
        let carried = named(script, "r_first_rest", carried);
        let what = "Bias of each joint row, with that acceleration of the first joint's origin";
        let unit = units(links, |units| units.drive);
        script.section("bias", Heading::of(what).equation("(D9)").unit(&unit));
        let bias = self.bias_joint.iter().zip(&force[first..]).zip(links);
        let bias_joint = bias.map(|((asked, force), link)| {
            script.cut(format!("u_rest_{}", link.joint.tag), *asked + force.dot(carried))
        });
        let bias_joint = vec![zero; first].into_iter().chain(bias_joint).collect();
        let joint = vec![Vec::new(); first].into_iter().chain(self.joint.clone()).collect();
        Share {
            mass: chain.graph.zero(),
            first_moment,
            inertia,
            force,
            moment,
            joint,
            bias_force,
            bias_moment,
            bias_joint,
        }
    }

    /// `C I C^T` with the axes for columns. With k the first joint's axis and 1 the unit tensor,
    /// `I_jj 1` and what the other axes add to it: two pairs of vectors, one of which is the
    /// joint's own column.
    fn inertia_along_b(
        &self,
        chain: &Chain<'g>,
        axes: [Vector<'g, Hub>; 3],
        column: Vector<'g, Hub>,
    ) -> Symmetric<'g, Hub> {
        let inertia = self.lump.inertia;
        let first = chain.first_moving();
        let [k, i, j] = chain.kind.links[first].joint.motion.axis().cycle();
        let half = chain.graph.constant(2).recip();
        let (ii, jj, kk) = (inertia.at(i, i), inertia.at(j, j), inertia.at(k, k));
        let across = (half * (ii - jj)) * axes[i] + inertia.at(i, j) * axes[j];
        // (I_kk - I_jj) / 2 e_k + I_ki e_i + I_kj e_j.
        let along = match chain.links[first].coordinate {
            Coordinate::Angle(_) => column - (half * (kk + jj)) * axes[k],
            Coordinate::Length(_) => {
                (half * (kk - jj)) * axes[k]
                    + inertia.at(k, i) * axes[i]
                    + inertia.at(k, j) * axes[j]
            }
        };
        Symmetric::isotropic(jj) + Symmetric::pairs([(axes[i], across), (axes[k], along)])
    }
}

/// Constant share of the hub: what a device adds to it whatever its joints do.
pub fn constant_share<'g>(chain: &Chain<'g>, script: &mut Script<'g>) {
    let Lump { first_moment, inertia, .. } = based(chain, script).constant_share;
    let mass = chain.links.iter().skip(1).fold(chain.links[0].mass, |sum, link| sum + link.mass);
    let heading = Heading::of("Constant share of the hub").equation("(D4)").axes("B").about("B");
    let heading = heading.part("mass", "kg").part("first moment", "kg m").part("inertia", "kg m²");
    script.section("share", heading);
    script.name("constant_m", mass);
    named(script, "constant_mr", chain.mounted(first_moment));
    script.names(pairs(sextuple("constant_i"), chain.mounted_tensor(inertia).entries()));
}

fn named<'g>(script: &mut Script<'g>, stem: &str, v: Vector<'g, Hub>) -> Vector<'g, Hub> {
    script.names(pairs(triple(stem, "b"), v.components()));
    v
}

fn cut<'g>(script: &mut Script<'g>, stem: &str, v: Vector<'g, Hub>) -> Vector<'g, Hub> {
    let components = pairs(triple(stem, "b"), v.components());
    let symbols: Vec<_> = components.map(|(name, value)| script.cut(name, value)).collect();
    Vector::new(symbols.try_into().expect("three components"))
}
