//! What the emitted functions say of each body, and of all of them as one mass.

use std::rc::Rc;

use nalgebra::{Matrix3, Vector3};

use super::{Device, Fault};
use crate::mutation::state::{Case, Motion};
use crate::mutation::tape::Returned;
use precess_codegen::kinds;
use precess_codegen::space::{Axis, ENTRIES};

/// One body seen from B; vectors along B but for `omega`, which is along the axes of its functions.
pub(in crate::mutation) struct BodyKinematics {
    pub(in crate::mutation) mass: f64,
    /// The axes along which its functions resolve it, as columns along B. A rotor that is the same
    /// from every angle does not carry them along.
    axes: Matrix3<f64>,
    /// The axes that are fixed in it.
    pub(in crate::mutation) attitude: Matrix3<f64>,
    pub(in crate::mutation) r: Vector3<f64>,
    pub(in crate::mutation) r_prime: Vector3<f64>,
    pub(in crate::mutation) columns: Vec<Vector3<f64>>,
    pub(in crate::mutation) r_dprime_rest: Vector3<f64>,
    pub(in crate::mutation) omega: Vector3<f64>,
    /// About the body's own centre of mass: given, not computed by a kernel.
    pub(in crate::mutation) inertia: Matrix3<f64>,
    pub(in crate::mutation) inertia_prime: Matrix3<f64>,
    pub(in crate::mutation) inertia_b: Matrix3<f64>,
    pub(in crate::mutation) inertia_b_prime: Matrix3<f64>,
}

/// The device's centre of mass, weighted with its mass, along B.
pub(in crate::mutation) struct Moment {
    pub(in crate::mutation) mc: Vector3<f64>,
    pub(in crate::mutation) mc_prime: Vector3<f64>,
    pub(in crate::mutation) columns: Vec<Vector3<f64>>,
    pub(in crate::mutation) rest: Vector3<f64>,
}

impl Device<'_, '_> {
    /// `first_moment`.
    pub(in crate::mutation) fn moment(
        &self,
        case: &Case,
        motion: &Motion,
        fault: &Fault,
    ) -> Rc<Moment> {
        let function = self.functions.first_moment;
        fault.result(
            |known| &known.moments,
            &[function],
            case,
            motion,
            || {
                let returned = self.call(function, &self.arguments(case, motion), fault);
                let tags = self.chain.kind.links.iter().map(|link| link.joint.tag);
                Rc::new(Moment {
                    mc: returned.vector("mc", "b"),
                    mc_prime: returned.vector("mc_prime", "b"),
                    columns: tags
                        .map(|tag| returned.vector(&format!("mc_dprime_{tag}"), "b"))
                        .collect(),
                    rest: returned.vector("f_tilde", "b"),
                })
            },
        )
    }

    /// The function of body `k`.
    pub(in crate::mutation) fn body(
        &self,
        k: usize,
        case: &Case,
        motion: &Motion,
        fault: &Fault,
    ) -> Rc<BodyKinematics> {
        let function = self.functions.bodies[k];
        fault.result(
            |known| &known.bodies,
            &[function],
            case,
            motion,
            || {
                let returned = self.call(function, &self.arguments(case, motion), fault);
                Rc::new(self.seen(k, case, motion, &returned))
            },
        )
    }

    fn seen(
        &self,
        k: usize,
        case: &Case,
        motion: &Motion,
        returned: &Returned<'_>,
    ) -> BodyKinematics {
        let links = self.chain.kind.links;
        let data = &links[k].body;
        let carrier = if k == 0 { "b" } else { links[k - 1].body.frame };
        let (own, point) = (data.frame, data.point);
        let before = self.axes(k, motion);
        let turned = self.turned(k, motion);
        let axes = if self.chain.kind.axes_turn(k) { before * turned } else { before };
        let vector = |stem: &str| before * returned.vector(stem, carrier);
        let tensor = |stem: &str| axes * returned.tensor(stem) * axes.transpose();
        let names = data.inertia.names();
        let given = |row: usize, column: usize| {
            let entry = format!("{}{}", row.min(column) + 1, row.max(column) + 1);
            let named = ENTRIES.iter().zip(&names).find(|(known, _)| **known == entry);
            let name = named.and_then(|(_, name)| name.as_ref());
            name.map_or(0.0, |name| self.parameter(case, name))
        };
        let column = |tag: &str| vector(&format!("r_{point}_b_dprime_{tag}"));
        BodyKinematics {
            mass: self.body_mass(k, case),
            axes,
            attitude: before * turned,
            r: vector(&format!("r_{point}_b")),
            r_prime: vector(&format!("r_{point}_b_prime")),
            columns: links[..=k].iter().map(|link| column(link.joint.tag)).collect(),
            r_dprime_rest: column("rest"),
            omega: returned.vector(&format!("omega_{own}_b"), own),
            inertia: axes * Matrix3::from_fn(given) * axes.transpose(),
            inertia_prime: tensor(&format!("i_{own}_{point}_prime")),
            inertia_b: tensor(&format!("i_{own}_b")),
            inertia_b_prime: tensor(&format!("i_{own}_b_prime")),
        }
    }

    /// The axes that the functions use outboard of so many joints, as columns in B: the geometry
    /// itself.
    pub(super) fn axes(&self, joints: usize, motion: &Motion) -> Matrix3<f64> {
        let turning = (0..joints).filter(|k| self.chain.kind.axes_turn(*k));
        turning.fold(Matrix3::identity(), |axes, k| axes * self.turned(k, motion))
    }

    /// How joint `k` has turned what it carries: a sliding one has not.
    fn turned(&self, k: usize, motion: &Motion) -> Matrix3<f64> {
        match self.chain.kind.links[k].joint.motion {
            kinds::Motion::Slide(_) => Matrix3::identity(),
            kinds::Motion::Turn(axis) => {
                let angle = motion.coordinates[k];
                // Rodrigues: what lies along the axis stays, the rest turns.
                let tilde = unit(axis).cross_matrix();
                let (sine, cosine) = (libm::sin(angle), libm::cos(angle));
                Matrix3::identity() + sine * tilde + (1.0 - cosine) * tilde * tilde
            }
        }
    }
}

pub(super) fn unit(axis: Axis) -> Vector3<f64> {
    let mut v = Vector3::zeros();
    v[axis.cycle()[0]] = 1.0;
    v
}

impl BodyKinematics {
    /// Second derivative of the centre of mass, seen from B.
    pub(in crate::mutation) fn r_dprime(&self, joints: &[f64]) -> Vector3<f64> {
        let terms = self.columns.iter().zip(joints).map(|(column, q)| *q * column);
        terms.fold(self.r_dprime_rest, |sum, term| sum + term)
    }

    /// Angular velocity relative to B, along B.
    pub(in crate::mutation) fn omega_b(&self) -> Vector3<f64> {
        self.axes * self.omega
    }
}

impl Moment {
    /// `m c″`.
    pub(in crate::mutation) fn mc_dprime(&self, joints: &[f64]) -> Vector3<f64> {
        let terms = self.columns.iter().zip(joints).map(|(column, q)| *q * column);
        terms.fold(self.rest, |sum, term| sum + term)
    }
}
