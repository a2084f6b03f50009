//! `load_derivatives`, and the same by differences of `loads`.

use std::rc::Rc;

use nalgebra::DVector;

use super::{Device, Fault};
use crate::mutation::physics::slope;
use crate::mutation::state::{Accelerations, Case, Motion};
use crate::mutation::tape::Returned;
use precess_codegen::kinds;

/// What `loads` are differentiated by.
enum By {
    Coordinate(usize),
    Rate(usize),
    Acceleration(usize),
    Omega(usize),
    OmegaDot(usize),
}

/// Variables in the order of what `load_derivatives` returns.
fn variables(kind: &kinds::Kind) -> Vec<By> {
    let joints = || 0..kind.links.len();
    let of_joints = joints().map(By::Coordinate).chain(joints().map(By::Rate));
    let of_joints = of_joints.chain(joints().map(By::Acceleration));
    of_joints.chain((0..3).map(By::Omega)).chain((0..3).map(By::OmegaDot)).collect()
}

impl Device<'_, '_> {
    /// What `load_derivatives` returns, variable by variable.
    pub(in crate::mutation) fn load_derivatives(
        &self,
        case: &Case,
        any: &Accelerations,
        fault: &Fault,
    ) -> Vec<f64> {
        let function = self.functions.load_derivatives;
        let returned = self.moving(function, case, &case.motion, any, fault);
        let fields = self.listings[function].fields.iter();
        fields.map(|(field, _)| returned.scalar(field)).collect()
    }

    /// The same by differences of `loads`.
    pub(in crate::mutation) fn load_slopes(
        &self,
        case: &Case,
        any: &Accelerations,
        fault: &Fault,
    ) -> Rc<[f64]> {
        let find = || {
            let column = |by: &By| slope(|change| self.loads_after(by, change, case, any, fault));
            variables(self.chain.kind)
                .iter()
                .flat_map(|by| column(by).as_slice().to_vec())
                .collect()
        };
        let functions = [self.functions.loads];
        fault.result(|known| &known.load_slopes, &functions, case, &case.motion, find)
    }

    /// Force and moment on the device about B, and what each motor exerts, with one variable changed.
    fn loads_after(
        &self,
        by: &By,
        change: f64,
        case: &Case,
        any: &Accelerations,
        fault: &Fault,
    ) -> DVector<f64> {
        let (mut motion, mut any) = (case.motion.clone(), any.clone());
        match by {
            By::Coordinate(k) => motion.coordinates[*k] += change,
            By::Rate(k) => motion.rates[*k] += change,
            By::Acceleration(k) => any.joints[*k] += change,
            By::Omega(axis) => motion.omega[*axis] += change,
            By::OmegaDot(axis) => any.omega[*axis] += change,
        }
        let returned = self.moving(self.functions.loads, case, &motion, &any, fault);
        let found = self.carried(&returned, "load", &motion);
        let drives = found.drives.into_iter().zip(self.chain.kind.links);
        let driven = drives.filter(|(_, link)| link.is_driven()).map(|(drive, _)| drive);
        DVector::from_vec(found.whole.list().into_iter().chain(driven).collect())
    }

    /// A function of motion and accelerations.
    pub(super) fn moving(
        &self,
        function: usize,
        case: &Case,
        motion: &Motion,
        any: &Accelerations,
        fault: &Fault,
    ) -> Returned<'_> {
        let mut values = self.arguments(case, motion);
        let hub = &self.chain.hub;
        values.set_vector(hub.r_b_n_ddot.components(), any.point);
        values.set_vector(hub.omega_dot.components(), any.omega);
        for (link, acceleration) in self.chain.links.iter().zip(&any.joints) {
            values.set(link.acceleration, *acceleration);
        }
        self.call(function, &values, fault)
    }
}
