//! Composite, columns and bias of the whole device, expressed in B, about B.

use super::base_parameters::Based;
use super::first_origin::{OriginAxes, in_first_body_axes};
use super::{CORIOLIS, FIRST_ORIGIN, InwardPass};
use crate::derivation::chain::{Chain, Coordinate};
use crate::derivation::heading::Heading;
use crate::derivation::script::{Script, pairs, sextuple, triple};
use crate::derivation::share::Share;
use crate::graph::Expr;
use crate::kinds::units;
use crate::space::{BodyFrame, Hub, Symmetric, Vector};

impl<'g> InwardPass<'g> {
    /// Transforms the composite to B axes, about B.
    pub(super) fn share(
        &self,
        chain: &Chain<'g>,
        based: &Based<'g>,
        axes: [Vector<'g, Hub>; 3],
        script: &mut Script<'g>,
    ) -> Share<'g> {
        let first = chain.first_moving();
        let own_reach = (self.origin_axes == OriginAxes::FirstBody)
            .then(|| in_first_body_axes(chain, based.reach(chain)));
        let reach = chain.mounted(based.reach(chain));
        let what = "Origin of the first joint from B, moved by (D3)";
        script.section("place", Heading::new(what).equation("(D2)").axes("B").unit("m"));
        let reach = named(script, "reach", reach);
        let along_b = |v: Vector<'g, BodyFrame>| v.along(axes);
        let links = &chain.kind.links[first..];
        let whole = links[0].assembly;
        let wrench = [units(links, |units| units.force), units(links, |units| units.moment)];
        let heading = Heading::new("M_vi and M_wi").equation("(17), (75), (D7)").axes("B");
        let heading = heading.wrench(wrench.each_ref().map(String::as_str), "B");
        script.section("col", heading.note("per unit joint acceleration"));
        // Bodies inboard of it have no equation.
        let zero = chain.graph.zero();
        let mut force = vec![Vector::zero(chain.graph); first];
        let mut moment = force.clone();
        let mut own_moment = Vector::zero(chain.graph);
        for (k, (link, column)) in links.iter().zip(&self.columns).enumerate() {
            let f = cut(script, &format!("f_{}", link.joint.tag), along_b(column.force));
            let n = match own_reach.filter(|_| k > 0) {
                Some(arm) => along_b(column.moment + arm.cross(column.force)),
                None => along_b(column.moment) + reach.cross(f),
            };
            if k == 0 {
                own_moment = along_b(column.moment);
            }
            force.push(f);
            moment.push(cut(script, &format!("n_{}", link.joint.tag), n));
        }
        let what = format!("{} without its constant share of the hub", whole.to_uppercase());
        let heading = Heading::new(what).equation("(9), (76), (D6)").axes("B").about("B");
        let heading = heading.part("first moment", "kg m").part("inertia", "kg m²");
        script.section("moment", heading);
        let first_moment = along_b(self.composite.first_moment);
        let inertia = self.inertia_along_b(chain, axes, own_moment, [reach, first_moment]);
        let first_moment = cut(script, "mr_moving", first_moment + self.composite.mass * reach);
        let names = sextuple("i_moving");
        let entries = pairs(names, inertia.entries());
        let entries: Vec<_> = entries.map(|(name, entry)| script.cut(name, entry)).collect();
        let inertia = Symmetric::new(entries.try_into().expect("six entries"));

        let heading = Heading::new(format!("{CORIOLIS} the joints' rates require"));
        let heading = heading.equation("(16), (75), (D8)").axes("B").wrench(["N", "N m"], "B");
        script.section("bias", heading);
        let bias_force = cut(script, "f_rates", along_b(self.rates.force));
        let turned = along_b(self.rates.moment);
        let bias_moment = cut(script, "n_rates", turned + reach.cross(bias_force));
        let bias_joint = self.biases(chain, reach, &force[first..], script);
        let bias_joint = vec![zero; first].into_iter().chain(bias_joint).collect();
        let joint = vec![Vec::new(); first].into_iter().chain(self.joint.clone()).collect();
        Share {
            mass: chain.graph.zero(),
            first_moment,
            inertia,
            force,
            moment,
            joint,
            perpendicular: self.perpendicular,
            bias_force,
            bias_moment,
            bias_joint,
        }
    }

    /// The bias of each joint row. Where the acceleration of the first joint's origin is not in it
    /// yet, each row requires its force for that.
    fn biases(
        &self,
        chain: &Chain<'g>,
        reach: Vector<'g, Hub>,
        force: &[Vector<'g, Hub>],
        script: &mut Script<'g>,
    ) -> Vec<Expr<'g>> {
        let links = &chain.kind.links[chain.first_moving()..];
        let unit = units(links, |units| units.drive);
        let carried = (self.origin_axes == OriginAxes::Hub).then(|| {
            script.section(
                "reach",
                Heading::new(FIRST_ORIGIN).equation("(D5)").axes("B").unit("m/s²"),
            );
            let carried = chain.hub.omega.cross(chain.hub.omega.cross(reach));
            named(script, "r_first_rest", carried)
        });
        let what = match carried {
            Some(_) => "Bias of each joint row, with that acceleration of the first joint's origin",
            None => "Bias of each joint row",
        };
        script.section("bias", Heading::new(what).equation("(D9)").unit(&unit));
        let bias = self.bias_joint.iter().zip(force).zip(links);
        let bias = bias.map(|((required, force), link)| {
            let required = carried.map_or(*required, |carried| *required + force.dot(carried));
            script.cut(format!("u_rest_{}", link.joint.tag), required)
        });
        bias.collect()
    }

    /// `C I C^T` with the axes for columns, about B. With k the first joint's axis and 1 the unit
    /// tensor, `I_jj 1` and what the other axes add to it: two pairs of vectors, one of which is the
    /// joint's own column. The parallel axis theorem adds the rest, from the origin's place and the
    /// first moment.
    fn inertia_along_b(
        &self,
        chain: &Chain<'g>,
        axes: [Vector<'g, Hub>; 3],
        column: Vector<'g, Hub>,
        [reach, first_moment]: [Vector<'g, Hub>; 2],
    ) -> Symmetric<'g, Hub> {
        let inertia = self.composite.inertia;
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
        let pairs = Symmetric::pairs([(axes[i], across), (axes[k], along)]);
        let squares = self.composite.mass * Symmetric::tilde_squared(reach);
        let made = pairs + Symmetric::tilde_pair(reach, first_moment) + squares;
        // The moments one by one: two of them have a part in common, and the trace is that of the
        // device's axes, so that the third follows from these.
        let (reach, first_moment) = (reach.components(), first_moment.components());
        let [x, y, z] = [0, 1, 2].map(|axis| (reach[axis] + reach[axis]) * first_moment[axis]);
        let (common, rest) = (jj + z, kk + (ii - jj) - pairs.at(0, 0) - pairs.at(1, 1));
        let moments =
            [pairs.at(0, 0) + (common + y), pairs.at(1, 1) + (common + x), rest + (x + y)];
        moments.into_iter().enumerate().fold(made, |made, (axis, moment)| {
            made.with(axis, axis, moment + squares.at(axis, axis))
        })
    }
}

pub(super) fn named<'g>(
    script: &mut Script<'g>,
    stem: &str,
    v: Vector<'g, Hub>,
) -> Vector<'g, Hub> {
    script.names(pairs(triple(stem, "b"), v.components()));
    v
}

pub(super) fn cut<'g>(script: &mut Script<'g>, stem: &str, v: Vector<'g, Hub>) -> Vector<'g, Hub> {
    let components = pairs(triple(stem, "b"), v.components());
    let symbols: Vec<_> = components.map(|(name, value)| script.cut(name, value)).collect();
    Vector::new(symbols.try_into().expect("three components"))
}
