//! [`ModalColumns`]: what the modes of a structure add to the equations of hub and modes, (F4), and how it changes.

use alloc::vec::Vec;

use crate::derivatives::tree::base_motion::BaseMotion;
use crate::equations::gravity::Central;
use crate::isolation::motion::{Spatial, product};
use crate::numbers::real::{Scalar, one, two, zero};
use crate::numbers::vec3::{Vec3, add, cross, scale, sub, zeros};

/// The structure's own part, mode by mode; empty of a rigid hub.
#[derive(Clone, Debug)]
pub(crate) struct ModalColumns<T> {
    /// How many of the modes, from the first on, have a modal mass.
    pub(crate) massive: usize,
    /// Linear and angular momentum integral of each, P and H.
    pub(crate) momenta: Vec<Spatial<T>>,
    /// Stiffness and damping of each.
    pub(crate) passive: Vec<[T; 2]>,
    /// `P eta'` and `H eta'`.
    pub(crate) rates: Spatial<T>,
    /// Of the mounts, B axes.
    pub(crate) positions: Vec<Vec3<T>>,
}

impl<T: Scalar> ModalColumns<T> {
    /// Of a rigid hub.
    pub(crate) fn none() -> Self {
        let (momenta, passive, positions) = (Vec::new(), Vec::new(), Vec::new());
        Self { massive: 0, momenta, passive, rates: [zeros(); 2], positions }
    }

    /// The number of modes.
    pub(crate) fn count(&self) -> usize {
        self.momenta.len()
    }

    /// What the hub's rows change by with a motion, beside those of the deformed body; what each mode's row changes by
    /// is shown to a function.
    pub(crate) fn by_motion(&self, change: &BaseMotion<T>, mut show: impl FnMut(T)) -> Spatial<T> {
        let accelerations = [change.acceleration, change.omega_dot];
        self.momenta.iter().for_each(|momenta| show(product(momenta, &accelerations)));
        let [linear, angular] = self.rates;
        [scale(two(), cross(change.omega, linear)), cross(change.omega, angular)]
    }

    /// What the hub's rows change by with a modal coordinate, and what the mode's own does.
    pub(crate) fn by_coordinate(
        &self,
        mode: usize,
        hub: &BaseMotion<T>,
        field: Option<&Central<T>>,
    ) -> (Spatial<T>, T) {
        let Some(([p, _], [stiffness, _])) = self.of(mode) else { return ([zeros(); 2], zero()) };
        let turning = add(cross(hub.omega_dot, p), cross(hub.omega, cross(hub.omega, p)));
        let field = field.map_or_else(zeros, |field| field.gradient.times(p));
        ([sub(turning, field), cross(p, hub.acceleration)], stiffness)
    }

    /// The same with its rate.
    pub(crate) fn by_rate(&self, mode: usize, hub: &BaseMotion<T>) -> (Spatial<T>, T) {
        let Some(([p, h], [_, damping])) = self.of(mode) else { return ([zeros(); 2], zero()) };
        ([scale(two(), cross(hub.omega, p)), cross(hub.omega, h)], damping)
    }

    fn of(&self, mode: usize) -> Option<(Spatial<T>, [T; 2])> {
        self.momenta.get(mode).copied().zip(self.passive.get(mode).copied())
    }

    /// A component of a wrench about a mount as one about the origin of its frame K.
    pub(crate) fn at_origin(&self, mount: usize, [force, moment]: Spatial<T>) -> Spatial<T> {
        let position = self.positions.get(mount).copied().unwrap_or_else(zeros);
        [force, add(moment, cross(position, force))]
    }

    /// The modal mass of a mode by itself.
    pub(crate) fn mass(&self, mode: usize) -> T {
        if mode < self.massive { one() } else { zero() }
    }
}
