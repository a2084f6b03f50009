//! [`PointMotion`]: how a point of the structure moves, an optic or a star tracker.

use nalgebra::{Matrix3, Vector3};

use crate::attitude::parameterisation::Attitude;
use crate::equations::error::{Quantity, SolveError};
use crate::flexible::equations::block::{Six, add_scaled, joined, parted};
use crate::flexible::equations::mount::MountMotion;
use crate::flexible::modal::modes::ModalPoint;
use crate::flexible::modal::storage::{Flexible, ModalStorage};
use crate::numbers::real::{Scalar, zero};
use crate::numbers::vec3::{add, columns, components, cross, finite, rotate, scale, vector, zeros};
use crate::sets::devices::Devices;
use crate::solve::spacecraft::Spacecraft;
use crate::solve::state::{Accelerations, State};

/// Place and velocity of a point of the structure, all expressed in B.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PointMotion<T = f64> {
    /// `Phi eta`, displacement in B, m.
    pub displacement: Vector3<T>,
    /// `Psi eta`, rotation vector in B, rad.
    pub rotation: Vector3<T>,
    /// Columns: the axes of the point, `exp(tilde(Psi eta))`.
    pub axes: Matrix3<T>,
    /// Inertial velocity, m/s.
    pub velocity: Vector3<T>,
    /// Inertial angular velocity, rad/s.
    pub omega: Vector3<T>,
}

/// Acceleration of a point of the structure, all expressed in B.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PointAcceleration<T = f64> {
    /// Inertial acceleration, m/s²; an accelerometer reads it less gravity.
    pub acceleration: Vector3<T>,
    /// Derivative of the inertial angular velocity, rad/s².
    pub omega_dot: Vector3<T>,
}

/// The motion of a point as if it were a mount; displacement above rotation, and their rates.
type MovingPoint<T> = (MountMotion<T>, [Six<T>; 2]);

impl<D: Devices, M: ModalStorage> Spacecraft<D, Flexible<M>> {
    /// Place and velocity of a point, (F5) and (F6).
    ///
    /// # Errors
    ///
    /// [`SolveError::NotFinite`], [`SolveError::ModalCount`] also for the shapes of the point,
    /// [`SolveError::Overflow`].
    pub fn point_motion<A: Attitude<D::Scalar>>(
        &self,
        point: &ModalPoint<M, D::Scalar>,
        state: &State<D, A, Flexible<M>>,
    ) -> Result<PointMotion<D::Scalar>, SolveError<D::Scalar>> {
        let (motion, [q, q_dot]) = self.moving_point(point, state)?;
        let ((displacement, rotation), (rate, _)) = (parted(&q), parted(&q_dot));
        let arm = add(components(&point.position), displacement);
        let bn = columns(&state.attitude.dcm());
        let of_b = rotate(&bn, components(&state.r_b_n_dot));
        let velocity = add(of_b, add(cross(components(&state.omega), arm), rate));
        let omega = rotate(&motion.axes, motion.omega);
        if !(finite(displacement) && finite(rotation) && finite(velocity) && finite(omega)) {
            return Err(SolveError::Overflow { what: Quantity::Velocity });
        }
        let [x, y, z] = motion.axes.map(vector);
        Ok(PointMotion {
            displacement: vector(displacement),
            rotation: vector(rotation),
            axes: Matrix3::from_columns(&[x, y, z]),
            velocity: vector(velocity),
            omega: vector(omega),
        })
    }

    /// Acceleration of a point, (F8).
    ///
    /// # Errors
    ///
    /// As [`Self::point_motion`], and of the accelerations.
    pub fn point_acceleration<A: Attitude<D::Scalar>>(
        &self,
        point: &ModalPoint<M, D::Scalar>,
        state: &State<D, A, Flexible<M>>,
        accelerations: &Accelerations<D, Flexible<M>>,
    ) -> Result<PointAcceleration<D::Scalar>, SolveError<D::Scalar>> {
        let (motion, [q, q_dot]) = self.moving_point(point, state)?;
        self.reject_accelerations(state, accelerations)?;
        let eta_ddot = accelerations.modal.eta_ddot.as_ref();
        let ((shift, _), (rate, _)) = (parted(&q), parted(&q_dot));
        let q_ddot = shape_sum(point, eta_ddot);
        let (arm, omega) = (add(components(&point.position), shift), &state.omega);
        let (omega, turning) = (components(omega), components(&accelerations.omega_dot));
        let relative = add(parted(&q_ddot).0, scale(D::Scalar::from_f64(2.0), cross(omega, rate)));
        let carried = add(cross(turning, arm), cross(omega, cross(omega, arm)));
        let of_b = components(&accelerations.r_b_n_ddot);
        let acceleration = add(of_b, add(carried, relative));
        let of_hub = motion.of_hub.times(&joined(zeros(), turning));
        let of_shape = motion.of_shape.times(&q_ddot);
        let ((_, hub), (_, shape), (_, bias)) =
            (parted(&of_hub), parted(&of_shape), parted(&motion.bias));
        let omega_dot = rotate(&motion.axes, add(add(hub, shape), bias));
        if !(finite(acceleration) && finite(omega_dot)) {
            return Err(SolveError::Overflow { what: Quantity::HubAcceleration });
        }
        Ok(PointAcceleration { acceleration: vector(acceleration), omega_dot: vector(omega_dot) })
    }

    /// The motion of a point as if it were a mount, displacement and rotation with their rates.
    fn moving_point<A: Attitude<D::Scalar>>(
        &self,
        point: &ModalPoint<M, D::Scalar>,
        state: &State<D, A, Flexible<M>>,
    ) -> Result<MovingPoint<D::Scalar>, SolveError<D::Scalar>> {
        self.reject_state(state)?;
        let expected = self.modes();
        for found in [point.translation.as_ref().len(), point.rotation.as_ref().len()] {
            if found != expected {
                return Err(SolveError::ModalCount { expected, found });
            }
        }
        let q = [&state.modal.eta, &state.modal.eta_dot]
            .map(|numbers| shape_sum(point, numbers.as_ref()));
        let [now, rate] = &q;
        let (position, omega) = (components(&point.position), components(&state.omega));
        Ok((MountMotion::new(position, now, rate, omega), q))
    }
}

/// Displacement and rotation of a point for modal coordinates.
fn shape_sum<M: ModalStorage, T: Scalar>(point: &ModalPoint<M, T>, eta: &[T]) -> Six<T> {
    let mut sum = [zero(); 6];
    let shapes = point.translation.as_ref().iter().zip(point.rotation.as_ref());
    for ((translation, rotation), eta) in shapes.zip(eta) {
        add_scaled(&mut sum, *eta, &joined(components(translation), components(rotation)));
    }
    sum
}
