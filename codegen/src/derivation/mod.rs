//! The one derivation: positions and angular velocities are stated, differentiation does the rest.
//!
//! - [`chain`]: a kind's symbols, and the hub's;
//! - [`motion`]: outwards along the chain by the transport theorem, seen from B or from N;
//! - [`quantities`]: the paper's quantities of each body and of the system's centre of mass;
//! - `angular` and `torques`: the paper's angular momenta (20) to (76) and motor torques (77) to
//!   (121), by the same names;
//! - [`by_body`]: mass matrix and bias as sums over bodies, by plain differentiation in B: the
//!   reference of the proofs;
//! - [`boltzmann_hamel`]: the same once more from the kinetic energy only;
//! - [`composite`]: from the tip to the hub in local frames, emitted as `first_moment` and
//!   `energy_momentum`;
//! - [`inward_pass`]: the same from base parameters ([`base`], with `parent_motion` for the motion of the
//!   parent bodies, `joint` for one joint, `reach` for the first one's origin and
//!   `on_hub` for the last step), emitted as `eliminate` and `constant_share`;
//! - [`elimination`]: the joints eliminated into the hub's six equations, tip first: the second
//!   half of `eliminate`; [`parallel`]: where the axes of two joints can be parallel;
//! - [`axes`], [`loads`], [`external`], [`gravity`], each emitted by its own name: axes and origins
//!   of the bodies, loads across their joints, sums of applied wrenches, wrenches of a field;
//! - `mass_properties`, [`wrench`], [`placed`]: mass, first moment and inertia of bodies; force and moment; a
//!   vector or tensor with the frame it is expressed in;
//! - [`script`]: the named steps of the recursions; [`heading`]: what they compute, as data.

mod angular;
pub mod assumed;
pub mod axes;
pub mod base;
pub mod boltzmann_hamel;
pub mod by_body;
pub mod chain;
pub mod composite;
pub mod elimination;
pub mod external;
pub mod gravity;
pub mod heading;
pub mod inward_pass;
mod joint;
pub mod loads;
mod mass_properties;
pub mod motion;
mod on_hub;
pub mod parallel;
mod parent_motion;
pub mod placed;
pub mod quantities;
mod reach;
pub mod script;
mod torques;
pub mod wrench;

use parallel::Across;
use script::{pairs, sextuple, triple};

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
    pub across: Option<Across<'g>>,
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
