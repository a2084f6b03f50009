//! The paper's quantities of each body and of the system's centre of mass, by name.
//!
//! Names are those of the hand-checked pages; frames are numbered as in [`super::chain::framed_value`].

mod angular_momenta;
mod motor_torques;

use super::chain::Chain;
use super::chain::framed_value::FramedValue;
use super::chain::motion::{Motion, Observer, motions};

use crate::graph::{Expr, Stage};
use crate::kinds::Centre;
use crate::space::{Axis, BodyFrame, Frame, Hub, ParentFrame, Symmetric, Vector};

/// One derived quantity.
#[derive(Clone)]
pub struct Quantity<'g> {
    /// Its name in code.
    pub name: String,
    /// What it is.
    pub value: FramedValue<'g>,
    /// What it belongs to.
    pub chapter: Chapter,
}

/// Quantities that belong together.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Chapter {
    /// `Inner gimbal`.
    pub title: String,
    /// The equations that they go into; none for what only the hub is made of.
    pub goes_into: String,
}

/// Every quantity of a chain that has a name in the paper.
#[must_use]
pub fn quantities<'g>(chain: &Chain<'g>) -> Vec<Quantity<'g>> {
    let mut list = List::default();
    list.chapter("Axes", "");
    axes(chain, &mut list);
    list.chapter("Hub", "");
    hub(chain, &mut list);
    let seen_from_b = motions(chain, &Observer::on_hub(chain.graph));
    let seen_from_n = motions(chain, &Observer::inertial(chain));
    for (k, (of_b, of_n)) in seen_from_b.iter().zip(&seen_from_n).enumerate() {
        list.chapter(&capital(chain.kind.links[k].body.title), "(16) and (75)");
        body(chain, k, of_b, of_n, &mut list);
    }
    list.chapter("Centre of mass and translation", "(16) and (75)");
    system(chain, &seen_from_b, &mut list);
    list.chapter("Angular momentum", "(75)");
    angular_momenta::angular_momenta(chain, &mut list);
    motor_torques::motor_torques(chain, &mut list);
    list.quantities
}

/// Collects quantities, chapter by chapter.
#[derive(Default)]
pub(super) struct List<'g> {
    quantities: Vec<Quantity<'g>>,
    chapter: Chapter,
}

impl<'g> List<'g> {
    /// What the quantities from here on belong to.
    pub(super) fn chapter(&mut self, title: &str, goes_into: &str) {
        self.chapter = Chapter { title: title.to_owned(), goes_into: goes_into.to_owned() };
    }

    fn push(&mut self, name: &str, value: FramedValue<'g>) {
        let (name, chapter) = (name.to_owned(), self.chapter.clone());
        self.quantities.push(Quantity { name, value, chapter });
    }

    pub(super) fn scalar(&mut self, name: &str, e: Expr<'g>) {
        self.push(name, FramedValue::Scalar(e));
    }

    pub(super) fn vector<F: Frame>(&mut self, name: &str, v: Vector<'g, F>, frame: usize) {
        self.push(name, FramedValue::Vector(v.components(), frame));
    }

    pub(super) fn tensor<F: Frame>(&mut self, name: &str, t: Symmetric<'g, F>, frame: usize) {
        self.push(name, FramedValue::Tensor(t.entries(), frame));
    }
}

impl<'g> List<'g> {
    /// A vector collected before, expressed in B.
    pub(super) fn hub_vector(&self, name: &str) -> Vector<'g, Hub> {
        match find(&self.quantities, name).map(|quantity| quantity.value) {
            Some(FramedValue::Vector(v, 0)) => Vector::new(v),
            _ => panic!("`{name}` is a vector along B axes, derived before it is used"),
        }
    }
}

/// `outer gimbal` -> `Outer gimbal`.
pub(super) fn capital(title: &str) -> String {
    let mut letters = title.chars();
    letters.next().map_or_else(String::new, |first| first.to_uppercase().chain(letters).collect())
}

/// Unit vectors of every frame; an axis about which a joint turns has its first frame's name.
fn axes<'g>(chain: &Chain<'g>, list: &mut List<'g>) {
    let triads = chain.kind.links.iter().map(|link| link.body.triad);
    let hub = ["b_x", "b_y", "b_z"];
    for (frame, triad) in std::iter::once(hub).chain(triads).enumerate() {
        for (name, axis) in triad.into_iter().zip([Axis::X, Axis::Y, Axis::Z]) {
            let unit = Vector::<BodyFrame>::unit(chain.graph, axis);
            list.vector(&format!("{name}_hat"), unit, frame);
        }
    }
}

fn hub<'g>(chain: &Chain<'g>, list: &mut List<'g>) {
    let hub = &chain.hub;
    list.vector("omega", hub.omega, 0);
    list.vector("omega_dot", hub.omega_dot, 0);
    list.vector("r_c_n_ddot", hub.r_c_n_ddot, 0);
    // (6): Newton's second law for the system's centre of mass; (19) in the balanced case.
    list.vector("force", hub.m_sc * hub.r_c_n_ddot, 0);
    list.vector("r_bc_b", hub.r_bc_b, 0);
    list.tensor("i_b_bc", hub.i_b_bc, 0);
    // (29), and its derivative: B does not turn seen from B.
    let i_b_b = hub.i_b_bc + hub.m_b * Symmetric::tilde_squared(hub.r_bc_b);
    list.tensor("i_b_b", i_b_b, 0);
    list.tensor("i_b_b_prime", i_b_b.prime(Vector::zero(chain.graph)), 0);
}

fn body<'g>(
    chain: &Chain<'g>,
    k: usize,
    of_b: &Motion<'g>,
    of_n: &Motion<'g>,
    list: &mut List<'g>,
) {
    let link = &chain.links[k];
    let (joint, body) = (&chain.kind.links[k].joint, &chain.kind.links[k].body);
    let (point, origin, frame) = (body.point, body.origin, body.frame);
    let (carrier, own) = (k, k + 1);

    list.vector(joint.origin.name, link.origin, carrier);
    let centre = match body.centre {
        Centre::Free(triple) => triple.name.to_owned(),
        Centre::On(..) | Centre::At => format!("r_{point}_{origin}"),
    };
    list.vector(&centre, link.centre, own);

    // (31), (44), (59).
    list.vector(&format!("omega_{frame}_b"), of_b.omega, own);
    list.vector(&format!("omega_{frame}_n"), of_n.omega, own);

    // (12), (13), (14), and (67), the position of the wheel.
    let stem = format!("r_{point}_b");
    list.vector(&stem, of_b.centre.position, carrier);
    list.vector(&format!("{stem}_prime"), of_b.centre.velocity, carrier);
    list.vector(&format!("{stem}_dprime"), of_b.centre.acceleration, carrier);

    // (35), (48), (63); (36), (49)-(52), (64), (65) in the balanced case; (40), (55), (71); (42),
    // (57), (73).
    let r = of_b.centre.position.turned(link.turn);
    let i_b = link.inertia + link.mass * Symmetric::tilde_squared(r);
    list.tensor(&format!("i_{frame}_{point}"), link.inertia, own);
    list.tensor(&format!("i_{frame}_{point}_prime"), link.inertia.prime(of_b.axes), own);
    list.tensor(&format!("i_{frame}_b"), i_b, own);
    list.tensor(&format!("i_{frame}_b_prime"), i_b.prime(of_b.axes), own);
}

fn system<'g>(chain: &Chain<'g>, motions: &[Motion<'g>], list: &mut List<'g>) {
    let hub = &chain.hub;
    let per_sc = hub.m_sc.recip();
    let zero = Vector::<Hub>::zero(chain.graph);
    let sum = |of: &dyn Fn(&Motion<'g>) -> Vector<'g, ParentFrame>| {
        let mut sum = zero;
        for (k, motion) in motions.iter().enumerate() {
            sum = sum + chain.links[k].mass * to_hub(chain, k, of(motion));
        }
        sum
    };
    // (9), (11).
    let c = per_sc * (hub.m_b * hub.r_bc_b + sum(&|motion| motion.centre.position));
    list.vector("c", c, 0);
    list.vector("c_prime", per_sc * sum(&|motion| motion.centre.velocity), 0);
    list.vector("c_dprime", per_sc * sum(&|motion| motion.centre.acceleration), 0);
    // (10): two inertial derivatives; (15) from (8), (16) the same with (17), (18) balanced.
    let c_ddot = c.prime(hub.omega).prime(hub.omega);
    list.vector("c_ddot", c_ddot, 0);
    list.vector("r_b_n_ddot", hub.r_c_n_ddot - c_ddot, 0);
    // (17): what multiplies each second-order state in m_sc c'', and what is left.
    for (link, data) in chain.links.iter().zip(chain.kind.links) {
        let f = sum(&|motion| motion.centre.acceleration.partial(link.acceleration));
        list.vector(&format!("f_{}", data.joint.tag), f, 0);
    }
    let f_tilde = sum(&|motion| motion.centre.acceleration.without(Stage::Acceleration));
    list.vector("f_tilde", f_tilde, 0);
}

fn to_hub<'g>(chain: &Chain<'g>, carrier: usize, v: Vector<'g, ParentFrame>) -> Vector<'g, Hub> {
    let FramedValue::Vector(v, _) = FramedValue::Vector(v.components(), carrier).along(chain, 0)
    else {
        unreachable!("a vector stays a vector")
    };
    Vector::new(v)
}

/// The value of `name` among `list`.
#[must_use]
pub fn find<'a, 'g>(list: &'a [Quantity<'g>], name: &str) -> Option<&'a Quantity<'g>> {
    list.iter().find(|quantity| quantity.name == name)
}

/// The trace of every inertia's derivative about the body's own centre of mass: zero.
#[must_use]
pub fn traces<'g>(chain: &Chain<'g>) -> Vec<Expr<'g>> {
    let motions = motions(chain, &Observer::on_hub(chain.graph));
    let prime = |(k, motion): (usize, &Motion<'g>)| chain.links[k].inertia.prime(motion.axes);
    motions.iter().enumerate().map(|pair| prime(pair).trace()).collect()
}
