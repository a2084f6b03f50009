//! `steer`: its terms, summed for given accelerations.

use nalgebra::{Matrix3, Vector3};

use super::{Device, Fault};
use crate::mutation::state::{Accelerations, Case};
use crate::mutation::tape::Returned;

impl Device<'_, '_> {
    /// The moment about B that the terms of `steer` sum to, and the momentum relative to the hub.
    pub(in crate::mutation) fn steered(
        &self,
        case: &Case,
        any: &Accelerations,
        fault: &Fault,
    ) -> [Vector3<f64>; 2] {
        let function = self.functions.steer;
        let returned: Returned<'_> =
            self.call(function, &self.arguments(case, &case.motion), fault);
        let vector = |stem: &str| returned.vector(stem, "b");
        let inertia: Matrix3<f64> = returned.tensor("inertia");
        let mut moment =
            vector("n_gyroscopic") + inertia * any.omega + vector("first_moment").cross(&any.point);
        let joints = self.chain.kind.links.iter().zip(&case.motion.rates).zip(&any.joints);
        for ((link, rate), acceleration) in joints.filter(|((link, _), _)| !link.is_locked()) {
            let tag = link.joint.tag;
            moment += vector(&format!("n_rate_{tag}")) * *rate;
            moment += vector(&format!("n_acceleration_{tag}")) * *acceleration;
        }
        [moment, vector("h_relative")]
    }
}
