//! [`Share`] and [`Momenta`]: what one device contributes to the equations of motion, to energy and momenta.

use super::chain::parallel_axes::{ParallelAxes, PerpendicularEntries};
use super::script::{pairs, sextuple, triple};
use crate::graph::Expr;
use crate::kinds::{Kind, Link};
use crate::space::{Hub, Symmetric, Vector};

/// One device's share of `M [r_B''; omega'; q''] + bias = [F; L_B; u]`, expressed in B.
pub struct Share<'g> {
    /// `M_vv = mass 1`.
    pub mass: Expr<'g>,
    /// `sum m_k r_k`: `M_vw = -[S~]`.
    pub first_moment: Vector<'g, Hub>,
    /// `M_ww = sum [I_{k,B}]`.
    pub inertia: Symmetric<'g, Hub>,
    /// `M_vi` per joint: the paper's `f_o`, `f_i`, `f_w`.
    pub force: Vec<Vector<'g, Hub>>,
    /// `M_wi` per joint.
    pub moment: Vec<Vector<'g, Hub>>,
    /// `M_ij`, upper triangle by rows: `joint[i][j - i]`.
    pub joint: Vec<Vec<Expr<'g>>>,
    /// What the elimination subtracts instead, where the axes of two joints can be parallel.
    pub perpendicular: Option<PerpendicularEntries<'g>>,
    /// Bias of the translational equation.
    pub bias_force: Vector<'g, Hub>,
    /// Bias of the rotational equation, about B.
    pub bias_moment: Vector<'g, Hub>,
    /// Bias of each motor-torque equation.
    pub bias_joint: Vec<Expr<'g>>,
}

/// One device's share of the kinetic energy and of both momenta, expressed in B.
pub struct Momenta<'g> {
    /// Kinetic energy.
    pub energy: Expr<'g>,
    /// Linear momentum.
    pub linear: Vector<'g, Hub>,
    /// Angular momentum about B.
    pub angular: Vector<'g, Hub>,
}

/// A quantity by name, with its components by the names they are emitted under.
pub type Named<'g> = (String, Vec<(String, Expr<'g>)>);

impl<'g> Share<'g> {
    /// The blocks of the hub and of the joints chosen, under the names the recursion gives them.
    #[must_use]
    pub fn named(&self, kind: &Kind, chosen: impl Fn(&Link) -> bool) -> Vec<Named<'g>> {
        let whole = kind.links[0].assembly;
        let links = kind.links.iter().enumerate().filter(|(_, link)| chosen(link));
        let joints: Vec<_> = links.map(|(k, link)| (k, link.joint.tag)).collect();
        let mut list = vec![
            vector(format!("mr_{whole}_b"), self.first_moment),
            tensor(format!("i_{whole}_b"), self.inertia),
        ];
        for (place, &(k, tag)) in joints.iter().enumerate() {
            for &(l, other) in &joints[place..] {
                list.push(scalar(format!("mass_{tag}{other}"), self.joint[k][l - k]));
            }
        }
        for &(k, tag) in &joints {
            list.push(vector(format!("f_{tag}"), self.force[k]));
            list.push(vector(format!("n_{tag}"), self.moment[k]));
        }
        list.push(vector("f_rest".to_owned(), self.bias_force));
        list.push(vector("n_rest".to_owned(), self.bias_moment));
        for &(k, tag) in &joints {
            list.push(scalar(format!("u_rest_{tag}"), self.bias_joint[k]));
        }
        list
    }

    /// `A_kk` and `A_kj` of two joints whose axes can be parallel.
    #[must_use]
    pub fn perpendicular_to_tip(&self, joints: ParallelAxes<'g>) -> [Expr<'g>; 2] {
        let ParallelAxes { inner, tip, cosine } = joints;
        let own = cosine * self.joint[tip][0];
        [self.joint[inner][0] - cosine * own, self.joint[inner][tip - inner] - own]
    }
}

impl<'g> Momenta<'g> {
    /// Energy and momenta with their names.
    #[must_use]
    pub fn named(&self) -> Vec<Named<'g>> {
        vec![
            scalar("energy".to_owned(), self.energy),
            vector("linear".to_owned(), self.linear),
            vector("angular_b".to_owned(), self.angular),
        ]
    }
}

fn scalar(name: String, value: Expr<'_>) -> Named<'_> {
    (name.clone(), vec![(name, value)])
}

fn vector<'g>(stem: String, v: Vector<'g, Hub>) -> Named<'g> {
    let components = pairs(triple(&stem, "b"), v.components()).collect();
    (stem, components)
}

fn tensor<'g>(stem: String, t: Symmetric<'g, Hub>) -> Named<'g> {
    let entries = pairs(sextuple(&stem), t.entries()).collect();
    (stem, entries)
}
