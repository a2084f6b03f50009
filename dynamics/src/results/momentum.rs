//! Energy, momentum and centre of mass of the whole spacecraft.
//!
//! With motors running, momentum is conserved and `dE/dt = F . v_B + L_B . omega + sum(u rate)`.
//! Angular momentum is conserved about a point fixed in N or about the centre of mass, not about B.

use nalgebra::Vector3;

use core::convert::Infallible;

use crate::attitude::parameterisation::Attitude;
use crate::equations::device::Device;
use crate::equations::error::{Quantity, SolveError};
use crate::equations::hub::BodySums;
use crate::isolation::carrier::Carrier;
use crate::model::kind::Kind;
use crate::numbers::real::{Real, Scalar, zero};
use crate::numbers::vec3::{
    Columns, Vec3, add, columns, components, cross, finite, neg, rotate, rotate_transposed, scale,
    sub, vector, zeros,
};
use crate::results::structure::StructureResults;
use crate::sets::bundle::Shared;
use crate::sets::carrying::{Carrying, PreparedCarrying};
use crate::sets::devices::{DeviceSet, Devices, Visit};
use crate::sets::per_device::Joints;
use crate::solve::finite::{not_finite_in_vector, reject};
use crate::solve::spacecraft::Spacecraft;
use crate::solve::state::State;

/// The point about which angular momentum is taken.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum About<T = f64> {
    /// The origin of N.
    InertialOrigin,
    /// The spacecraft's centre of mass, with velocities relative to N.
    CentreOfMass,
    /// A point fixed in N, N axes, m.
    Point(Vector3<T>),
}

/// Momenta of the spacecraft.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Momentum<T = f64> {
    /// Linear momentum, N axes, kg m/s.
    pub linear: Vector3<T>,
    /// Angular momentum about the point of the call, N axes, kg m^2/s.
    pub angular: Vector3<T>,
}

/// Kinetic energy and momenta of the spacecraft.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EnergyAndMomentum<T = f64> {
    /// Kinetic energy, J.
    pub energy: T,
    /// Momenta, the angular one about the point of the call.
    pub momentum: Momentum<T>,
}

/// Where the centre of mass is and how it moves seen from B.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CentreOfMass<T = f64> {
    /// `c`, position from B, B axes, m; (9).
    pub c: Vector3<T>,
    /// `c'`, derivative seen from B, B axes, m/s.
    pub c_prime: Vector3<T>,
}

/// Adds kinetic energy and momenta for the velocity of B and the angular velocity, B axes.
pub(crate) struct Addition<'a, T> {
    pub(crate) r_b_n_dot: Vec3<T>,
    pub(crate) omega: Vec3<T>,
    pub(crate) sums: &'a mut BodySums<T>,
}

impl<T: Scalar> Visit<T, Shared<Joints>> for Addition<'_, T> {
    type Error = Infallible;

    fn visit<K: Kind<Scalar = T>>(
        &mut self,
        device: &Device<K>,
        joints: &K::Joints<T>,
    ) -> Result<(), Infallible> {
        device.add_sums(joints, self.r_b_n_dot, self.omega, self.sums);
        Ok(())
    }

    fn visit_carrying<C: Carrier<Scalar = T>, D: DeviceSet<Scalar = T>>(
        &mut self,
        carrying: &PreparedCarrying<C, D>,
        joints: &<Carrying<C, D> as DeviceSet>::Per<Joints>,
    ) -> Result<(), Infallible> {
        let device = &carrying.carrier.device;
        device.add_sums(&joints.carrier, self.r_b_n_dot, self.omega, self.sums);
        let motion = carrying.carrier.moving(&joints.carrier, self.omega);
        let mut sums = BodySums { energy: zero(), linear: zeros(), angular_b: zeros() };
        let r_b_n_dot = motion.velocity(self.r_b_n_dot);
        let mut addition = Addition { r_b_n_dot, omega: motion.omega, sums: &mut sums };
        let Ok(()) =
            D::visit::<Shared<Joints>, _>(&carrying.carried, &joints.carried, &mut addition);
        let BodySums { energy, linear, angular_b } = motion.on_base(&sums);
        self.sums.energy = self.sums.energy + energy;
        self.sums.linear = add(self.sums.linear, linear);
        self.sums.angular_b = add(self.sums.angular_b, angular_b);
        Ok(())
    }
}

/// Adds the first moment about B and its derivative seen from B, B axes.
pub(crate) struct FirstMoments<'a, T>(pub(crate) &'a mut [Vec3<T>; 2]);

impl<T: Scalar> Visit<T, Shared<Joints>> for FirstMoments<'_, T> {
    type Error = Infallible;

    fn visit<K: Kind<Scalar = T>>(
        &mut self,
        device: &Device<K>,
        joints: &K::Joints<T>,
    ) -> Result<(), Infallible> {
        device.add_first_moment(joints, self.0);
        Ok(())
    }

    fn visit_carrying<C: Carrier<Scalar = T>, D: DeviceSet<Scalar = T>>(
        &mut self,
        carrying: &PreparedCarrying<C, D>,
        joints: &<Carrying<C, D> as DeviceSet>::Per<Joints>,
    ) -> Result<(), Infallible> {
        let carrier = &carrying.carrier;
        carrier.device.add_first_moment(&joints.carrier, self.0);
        let carried = first_moments::<D>(&carrying.carried, &joints.carried);
        let motion = carrier.moving(&joints.carrier, zeros());
        let shares = motion.first_moments(carrier.carried_mass, carried);
        for (sum, share) in self.0.iter_mut().zip(shares) {
            *sum = add(*sum, share);
        }
        Ok(())
    }
}

/// First moment of the devices of a set about the origin of their base, and its derivative seen from
/// the base, base axes.
pub(crate) fn first_moments<D: DeviceSet>(
    devices: &D::Prepared,
    joints: &D::Per<Joints>,
) -> [Vec3<D::Scalar>; 2] {
    let mut moments = [zeros(); 2];
    let Ok(()) = D::visit::<Shared<Joints>, _>(devices, joints, &mut FirstMoments(&mut moments));
    moments
}

/// Sums over all bodies at a state.
pub(crate) struct MotionSums<T> {
    /// `[BN]`, by its columns.
    pub(crate) bn: Columns<T>,
    /// Energy and momenta, expressed in B.
    pub(crate) bodies: BodySums<T>,
    /// First moment about B, expressed in B, where it was computed.
    pub(crate) first_moment: Option<Vec3<T>>,
}

impl<D: Devices, S: StructureResults> Spacecraft<D, S> {
    /// Kinetic energy of hub or structure and devices, J; of a flexible structure (F3). Gravity and
    /// springs have theirs in the [ledger](Self::ledger).
    ///
    /// # Errors
    ///
    /// [`SolveError::NotFinite`] naming the part of the state that is infinite or NaN,
    /// [`SolveError::Overflow`], [`SolveError::ModalCount`] for a list of another length.
    pub fn energy<A: Attitude<D::Scalar>>(
        &self,
        state: &State<D, A, S>,
    ) -> Result<D::Scalar, SolveError<D::Scalar>> {
        self.reject_state(state)?;
        kinetic(&S::sums(self, state).bodies)
    }

    /// Linear momentum, and angular momentum about a point.
    ///
    /// # Errors
    ///
    /// [`SolveError::NotFinite`] naming the part of the state (or the point) that is infinite or
    /// NaN, or [`SolveError::Overflow`].
    pub fn momentum<A: Attitude<D::Scalar>>(
        &self,
        state: &State<D, A, S>,
        about: About<D::Scalar>,
    ) -> Result<Momentum<D::Scalar>, SolveError<D::Scalar>> {
        self.reject_state(state)?;
        reject(not_finite_in_point(&about))?;
        self.momentum_of(state, &S::sums(self, state), about)
    }

    /// [`Self::energy`] and [`Self::momentum`], the same bits, at the cost of one of them.
    ///
    /// # Errors
    ///
    /// As [`Self::momentum`].
    pub fn energy_and_momentum<A: Attitude<D::Scalar>>(
        &self,
        state: &State<D, A, S>,
        about: About<D::Scalar>,
    ) -> Result<EnergyAndMomentum<D::Scalar>, SolveError<D::Scalar>> {
        self.reject_state(state)?;
        reject(not_finite_in_point(&about))?;
        let sums = S::sums(self, state);
        let momentum = self.momentum_of(state, &sums, about)?;
        Ok(EnergyAndMomentum { energy: kinetic(&sums.bodies)?, momentum })
    }

    /// [`Self::momentum`] from the sums over the bodies.
    pub(crate) fn momentum_of<A: Attitude<D::Scalar>>(
        &self,
        state: &State<D, A, S>,
        MotionSums { bn, bodies, first_moment }: &MotionSums<D::Scalar>,
        about: About<D::Scalar>,
    ) -> Result<Momentum<D::Scalar>, SolveError<D::Scalar>> {
        let BodySums { linear, angular_b, .. } = *bodies;
        let linear_n = rotate_transposed(bn, linear);
        let about_b = rotate_transposed(bn, angular_b);
        // H about P is H_B + r_{B/P} x p, for any motion of B.
        let r_b_n = components(&state.r_b_n);
        let r_b_p = match about {
            About::InertialOrigin => r_b_n,
            About::Point(point) => sub(r_b_n, components(&point)),
            About::CentreOfMass => {
                let moment = first_moment.unwrap_or_else(|| S::first_moment(self, state)[0]);
                neg(rotate_transposed(bn, scale(self.mass().recip(), moment)))
            }
        };
        let angular_n = add(about_b, cross(r_b_p, linear_n));
        let found = Momentum { linear: vector(linear_n), angular: vector(angular_n) };
        checked(Quantity::Momentum, found, finite(linear_n) && finite(angular_n))
    }

    /// Centre of mass of hub or structure and devices.
    ///
    /// # Errors
    ///
    /// As [`Self::energy`].
    pub fn centre_of_mass<A: Attitude<D::Scalar>>(
        &self,
        state: &State<D, A, S>,
    ) -> Result<CentreOfMass<D::Scalar>, SolveError<D::Scalar>> {
        self.reject_state(state)?;
        let per_mass = self.mass().recip();
        let [c, c_prime] = S::first_moment(self, state).map(|moment| scale(per_mass, moment));
        let found = CentreOfMass { c: vector(c), c_prime: vector(c_prime) };
        checked(Quantity::CentreOfMass, found, finite(c) && finite(c_prime))
    }

    /// Sums over a hub that does not deform and its devices.
    pub(crate) fn sums_rigid<A: Attitude<D::Scalar>>(
        &self,
        state: &State<D, A, S>,
    ) -> MotionSums<D::Scalar> {
        let bn = columns(&state.attitude.dcm());
        let r_b_n_dot = rotate(&bn, components(&state.r_b_n_dot));
        let omega = components(&state.omega);
        let mut bodies = self.hub.sums(r_b_n_dot, omega);
        let mut addition = Addition { r_b_n_dot, omega, sums: &mut bodies };
        let Ok(()) = D::visit::<Shared<Joints>, _>(&self.devices, &state.devices, &mut addition);
        MotionSums { bn, bodies, first_moment: None }
    }

    /// First moment about B of a hub that does not deform and its devices, and its derivative seen
    /// from B, expressed in B.
    pub(crate) fn first_moment_rigid<A>(&self, state: &State<D, A, S>) -> [Vec3<D::Scalar>; 2] {
        let mut moment = [self.hub.first_moment, zeros()];
        let mut addition = FirstMoments(&mut moment);
        let Ok(()) = D::visit::<Shared<Joints>, _>(&self.devices, &state.devices, &mut addition);
        moment
    }
}

/// Kinetic energy: a sum of squares, but for the rounding of what cancels in it.
pub(crate) fn kinetic<T: Scalar>(sums: &BodySums<T>) -> Result<T, SolveError<T>> {
    checked(Quantity::Energy, sums.energy.max(zero()), sums.energy.is_finite())
}

pub(crate) fn not_finite_in_point<T: Scalar>(about: &About<T>) -> Option<(Quantity, T)> {
    match about {
        About::Point(point) => not_finite_in_vector(Quantity::ReferencePoint, point),
        About::InertialOrigin | About::CentreOfMass => None,
    }
}

/// With every input finite, a result that is not has overflowed.
pub(crate) fn checked<R, T: Scalar>(
    what: Quantity,
    result: R,
    is_finite: bool,
) -> Result<R, SolveError<T>> {
    if is_finite { Ok(result) } else { Err(SolveError::Overflow { what }) }
}
