//! [`SteeringTerms`]: what the rates and the accelerations of all joints require about B, expressed in B.

use nalgebra::{Matrix3, Vector3};

use crate::attitude::parameterisation::Attitude;
use crate::equations::assembly::expressed_in_b;
use crate::equations::device::Device;
use crate::equations::error::{Quantity, SolveError};
use crate::isolation::carrier::Carrier;
use crate::model::kind::{Kind, Steering};
use crate::numbers::each::{Each, JointStates};
use crate::numbers::real::{Scalar, zero};
use crate::numbers::symmetric::Symmetric;
use crate::numbers::vec3::{
    Columns, Vec3, add, columns, components, cross, finite, rotate, rotate_transposed, scale,
    vector, zeros,
};
use crate::sets::bundle::Shared;
use crate::sets::carrying::{Carrying, PreparedCarrying};
use crate::sets::devices::{DeviceSet, Devices, JointInfos, Visit};
use crate::sets::per_device as data;
use crate::solve::spacecraft::Spacecraft;
use crate::solve::state::State;
use crate::steering::error::SteeringError;
use crate::steering::matrix::product;

/// The moment about B that the hub exerts on all devices, term by term, expressed in B; the torque on the hub is the
/// opposite. `N` is the number of joints, in the order of [`Spacecraft::joints`], or more: the rest is zero.
///
/// It is `sum by_rate q' + sum by_acceleration q'' + inertia omega' + first_moment x r_B'' + gyroscopic`, (75), without
/// an approximation: imbalances, offsets and gimbal inertias are in it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SteeringTerms<T, const N: usize> {
    /// Moment per rate of each joint at these rates, `dH/dq + omega x n`, N m s; N s of a sliding joint.
    pub by_rate: [Vector3<T>; N],
    /// Moment per acceleration of each joint, `n`, kg m^2; kg m of a sliding joint.
    pub by_acceleration: [Vector3<T>; N],
    /// The rates, rad/s or m/s.
    pub rates: [T; N],
    /// Angular momentum of the devices about B relative to the hub, kg m^2/s.
    pub momentum: Vector3<T>,
    /// First moment of the devices about B, kg m.
    pub first_moment: Vector3<T>,
    /// Inertia of the devices about B, kg m^2.
    pub inertia: Matrix3<T>,
    /// `omega x inertia omega`, N m.
    pub gyroscopic: Vector3<T>,
}

impl<T: Scalar, const N: usize> SteeringTerms<T, N> {
    fn none() -> Self {
        let none = vector(zeros());
        Self {
            by_rate: [none; N],
            by_acceleration: [none; N],
            rates: [zero(); N],
            momentum: none,
            first_moment: none,
            inertia: Matrix3::from_element(zero()),
            gyroscopic: none,
        }
    }

    /// The moment for accelerations of the joints, of the hub and of B (inertial, B axes), N m.
    #[must_use]
    pub fn moment(
        &self,
        accelerations: &[T; N],
        omega_dot: &Vector3<T>,
        r_b_n_ddot: &Vector3<T>,
    ) -> Vector3<T> {
        let mut sum = components(&self.gyroscopic);
        for (column, rate) in self.by_rate.iter().zip(self.rates) {
            sum = add(sum, scale(rate, components(column)));
        }
        for (column, acceleration) in self.by_acceleration.iter().zip(*accelerations) {
            sum = add(sum, scale(acceleration, components(column)));
        }
        let columns = columns(&self.inertia);
        sum = add(sum, rotate(&columns, components(omega_dot)));
        vector(add(sum, cross(components(&self.first_moment), components(r_b_n_ddot))))
    }

    /// What is a sum over all devices: the momentum by their columns, and what the hub's rate requires.
    fn sum_up(&mut self, omega: Vec3<T>, inertia: &Symmetric<T>) {
        let momentum = product(&self.by_acceleration, &self.rates);
        self.momentum = vector(momentum);
        self.gyroscopic = vector(cross(omega, inertia.times(omega)));
        let Symmetric { xx, xy, xz, yy, yz, zz } = *inertia;
        self.inertia = Matrix3::new(xx, xy, xz, xy, yy, yz, xz, yz, zz);
    }

    fn is_finite(&self) -> bool {
        let vectors = [self.momentum, self.first_moment, self.gyroscopic];
        let all = self.by_rate.iter().chain(&self.by_acceleration).chain(&vectors);
        let inertia = columns(&self.inertia);
        all.map(components).chain(inertia).all(finite)
    }
}

impl<D: Devices> Spacecraft<D> {
    /// What the rates and the accelerations of all joints require about B. `N` is the number of joints, or more where
    /// their number is known only when the program runs: what is beyond the last joint is zero.
    ///
    /// # Errors
    ///
    /// [`SteeringError::Joints`] where there are more than `N` joints, [`SteeringError::Platform`], and the errors of
    /// [`Self::momentum`].
    pub fn steering_terms<A: Attitude<D::Scalar>, const N: usize>(
        &self,
        state: &State<D, A>,
    ) -> Result<SteeringTerms<D::Scalar, N>, SteeringError<D::Scalar>> {
        self.reject_joints(N)?;
        self.reject_state(state)?;
        let mut terms = SteeringTerms::none();
        for (to, [_, rate]) in terms.rates.iter_mut().zip(state.devices.states()) {
            *to = rate;
        }
        let omega = components(&state.omega);
        let inertia = Symmetric::zero();
        let mut sum = Sum { omega, device: 0, joint: 0, inertia, terms: &mut terms };
        D::visit::<Shared<data::Joints>, _>(&self.devices, &state.devices, &mut sum)?;
        let inertia = sum.inertia;
        terms.sum_up(omega, &inertia);
        if terms.is_finite() {
            Ok(terms)
        } else {
            Err(SolveError::Overflow { what: Quantity::Momentum }.into())
        }
    }
}

impl<D: Devices> Spacecraft<D> {
    /// Rejects arrays that are shorter than there are joints.
    pub(super) fn reject_joints(&self, found: usize) -> Result<(), SteeringError<D::Scalar>> {
        let expected = D::list::<JointInfos>(&self.devices).count();
        if expected <= found { Ok(()) } else { Err(SteeringError::Joints { expected, found }) }
    }
}

/// Adds the terms of each device.
struct Sum<'a, T, const N: usize> {
    omega: Vec3<T>,
    device: usize,
    /// The next joint.
    joint: usize,
    /// Of the devices so far, about B, expressed in B.
    inertia: Symmetric<T>,
    terms: &'a mut SteeringTerms<T, N>,
}

impl<T: Scalar, const N: usize> Visit<T, Shared<data::Joints>> for Sum<'_, T, N> {
    type Error = SteeringError<T>;

    fn visit<K: Kind<Scalar = T>>(
        &mut self,
        device: &Device<K>,
        joints: &K::Joints<T>,
    ) -> Result<(), SteeringError<T>> {
        let omega = expressed_in_b(rotate_transposed(&device.mount, self.omega));
        let found = K::steer(&device.constants, &K::pose(joints), joints, &omega);
        let Some(found) = found else {
            return Err(SteeringError::Platform { device: self.device });
        };
        self.device = self.device.wrapping_add(1);
        self.add(&found, &device.mount);
        Ok(())
    }

    fn visit_carrying<C: Carrier<Scalar = T>, D: DeviceSet<Scalar = T>>(
        &mut self,
        _: &PreparedCarrying<C, D>,
        _: &<Carrying<C, D> as DeviceSet>::Per<data::Joints>,
    ) -> Result<(), SteeringError<T>> {
        Err(SteeringError::Platform { device: self.device })
    }
}

impl<T: Scalar, const N: usize> Sum<'_, T, N> {
    /// The terms of a device, turned from its axes to B.
    fn add<K: Kind<Scalar = T>>(&mut self, found: &Steering<K>, mount: &Columns<T>) {
        let along_b = |v: &Vector3<T>| rotate(mount, components(v));
        let terms = &mut *self.terms;
        for joint in found.joints.values() {
            let to =
                terms.by_rate.get_mut(self.joint).zip(terms.by_acceleration.get_mut(self.joint));
            if let Some((by_rate, by_acceleration)) = to {
                *by_rate = vector(along_b(&joint.by_rate));
                *by_acceleration = vector(along_b(&joint.by_acceleration));
            }
            self.joint = self.joint.wrapping_add(1);
        }
        let first_moment = along_b(&found.first_moment);
        terms.first_moment = vector(add(components(&terms.first_moment), first_moment));
        let [xx, xy, xz, yy, yz, zz] = found.inertia;
        let inertia = Symmetric { xx, xy, xz, yy, yz, zz }.rotated(mount);
        self.inertia = self.inertia.plus(inertia);
    }
}
