//! `load_derivatives`, and the same by differences of `loads`.

use std::rc::Rc;

use nalgebra::DVector;

use super::{Device, Fault};
use crate::mutation::physics::slope;
use crate::mutation::state::{Accelerations, Case, Motion};
use crate::mutation::tape::Returned;
use precess_codegen::kinds;
use precess_codegen::space::XYZ;

/// What `loads` are differentiated by, and its name.
enum By {
    Coordinate(usize),
    Rate(usize),
    Acceleration(usize),
    Omega(usize),
    OmegaDot(usize),
}

/// The names of what `load_derivatives` returns, variable by variable.
pub(super) fn derivative_names(kind: &kinds::Kind) -> Vec<String> {
    let column = |by: &By| {
        let by = match by {
            By::Coordinate(k) => kind.links[*k].joint.coordinate.to_owned(),
            By::Rate(k) => kind.links[*k].joint.rate.to_owned(),
            By::Acceleration(k) => kind.links[*k].joint.acceleration.to_owned(),
            By::Omega(axis) => format!("omega_b{}", XYZ[*axis]),
            By::OmegaDot(axis) => format!("omega_dot_b{}", XYZ[*axis]),
        };
        let hub = ["f", "n"].into_iter().flat_map(|of| XYZ.map(|axis| format!("{of}_b{axis}")));
        let motors = kind.driven().map(|link| link.joint.torque.to_owned());
        hub.chain(motors).map(|of| format!("{of}_by_{by}")).collect::<Vec<_>>()
    };
    variables(kind).iter().flat_map(column).collect()
}

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
        self.derivative_names.iter().map(|name| returned.scalar(name)).collect()
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
        let hub = ["f_load", "n_load"].map(|stem| returned.vector(stem, "b"));
        let along = |link: &kinds::Link| {
            let letter = match link.joint.motion {
                kinds::Motion::Turn(_) => "n",
                kinds::Motion::Slide(_) => "f",
            };
            let axis = XYZ[link.joint.motion.axis().cycle()[0]];
            returned.scalar(&format!("{letter}_load_{}{axis}", link.body.frame))
        };
        let hub = hub.iter().flat_map(|v| v.iter().copied());
        DVector::from_iterator(
            6 + self.chain.kind.driven().count(),
            hub.chain(self.chain.kind.driven().map(along)),
        )
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
