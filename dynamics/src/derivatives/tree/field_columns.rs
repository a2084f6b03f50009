//! [`FieldColumns`]: how what a central field exerts on the hub changes with the position of B from the centre.
//!
//! Expressed in B the field depends on position and attitude only by `rho`, the position expressed in B: a small
//! rotation `dtheta` of the hub changes it by `rho x dtheta`.

use crate::equations::gravity::{Central, Gravity};
use crate::equations::hub::HubConstants;
use crate::numbers::dual::Dual;
use crate::numbers::real::{Scalar, one, zero};
use crate::numbers::symmetric::Symmetric;
use crate::numbers::vec3::{Columns, Vec3, add, components, map, rotate, vector};

/// A number with its derivatives by the components of `rho`.
type ByPosition<T> = Dual<T, 3>;

/// A central field about B, expressed in B.
#[derive(Clone, Copy, Debug)]
pub(crate) struct FieldColumns<T> {
    /// `[BN]`.
    pub(crate) bn: Columns<T>,
    /// `rho`, m.
    pub(crate) rho: Vec3<T>,
    field: Central<ByPosition<T>>,
}

impl<T: Scalar> FieldColumns<T> {
    /// For `[BN]` and the position of B, N axes; none where the field is not central.
    pub(crate) fn new(
        gravity: &Gravity<T>,
        bn: Columns<T>,
        r_b_n: &nalgebra::Vector3<T>,
    ) -> Option<Self> {
        let Gravity::Central { mu } = gravity else { return None };
        let rho = rotate(&bn, components(r_b_n));
        let [x, y, z] = rho;
        let seeded = [(x, 0), (y, 1), (z, 2)].map(|(x, number)| ByPosition::variable(x, number));
        let (o, i) = (zero(), one());
        let field = Gravity::Central { mu: ByPosition::constant(*mu) };
        let field = field.field(&[[i, o, o], [o, i, o], [o, o, i]], &vector(seeded))?.central?;
        Some(Self { bn, rho, field })
    }

    /// Derivatives of force and moment on the hub about B, by `rho`: of the gradient on its body, and of the third-order
    /// force on the whole, of this second moment.
    pub(crate) fn on_hub(
        &self,
        hub: &HubConstants<T>,
        second_moment: &Symmetric<T>,
    ) -> [[T; 6]; 3] {
        let constant = ByPosition::constant;
        let tensor = |of: Symmetric<T>| of.zip(of, |entry, _| constant(entry));
        let (own, all) = (tensor(hub.second_moment()), tensor(*second_moment));
        let (force, moment) = self.field.wrench(map(hub.first_moment, constant), &own);
        let force = add(force, self.field.third_order(&all));
        [0, 1, 2].map(|k| {
            let of = |v: Vec3<ByPosition<T>>| v.map(|component| component.derivative(k));
            let ([a, b, c], [d, e, f]) = (of(force), of(moment));
            [a, b, c, d, e, f]
        })
    }
}
