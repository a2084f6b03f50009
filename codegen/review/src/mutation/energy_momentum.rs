//! What a part of a spacecraft has of energy and momenta.

use nalgebra::{SVector, Vector3};

use super::state::{Hub, Motion};

/// Energy, linear momentum, angular momentum in one row: what can be added and differentiated.
pub(super) type Packed = SVector<f64, 7>;

/// Kinetic energy, linear momentum, angular momentum about B; along B.
#[derive(Clone, Copy)]
pub(super) struct EnergyMomentum {
    pub(super) energy: f64,
    pub(super) linear: Vector3<f64>,
    pub(super) angular: Vector3<f64>,
}

impl EnergyMomentum {
    pub(super) fn packed(self) -> Packed {
        let Self { energy, linear: p, angular: h } = self;
        Packed::from([energy, p.x, p.y, p.z, h.x, h.y, h.z])
    }

    pub(super) fn unpacked(packed: &Packed) -> Self {
        let part = |row: usize| packed.fixed_rows::<3>(row).into_owned();
        Self { energy: packed[0], linear: part(1), angular: part(4) }
    }
}

impl Hub {
    /// One rigid body by Newton and Euler.
    pub(super) fn energy_momentum(&self, motion: &Motion) -> EnergyMomentum {
        let velocity = motion.velocity + motion.omega.cross(&self.centre);
        let spin = self.inertia * motion.omega;
        let linear = self.mass * velocity;
        EnergyMomentum {
            energy: 0.5 * (velocity.dot(&linear) + motion.omega.dot(&spin)),
            linear,
            angular: self.centre.cross(&linear) + spin,
        }
    }
}
