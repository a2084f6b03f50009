//! The elimination and the accelerations of [`contributions`](super::contributions) joint by joint, for a program that has
//! states and inputs in its own structures: what a joint has is read where a device is eliminated, without a
//! [`State`](crate::State) and [`Inputs`](crate::Inputs) of the set.
//!
//! The same operations in the same order, thus the same bits. What is rejected has no cause here: the caller evaluates
//! [`Spacecraft::eliminate_joints`] or [`Spacecraft::joint_accelerations`], which name it.

use nalgebra::Vector3;

use crate::equations::arithmetic::Arithmetic;
use crate::equations::assembly::Assembly;
use crate::equations::device::Device;
use crate::equations::eliminate::DeviceElimination;
use crate::equations::error::SolveError;
use crate::equations::joint_inputs::{Environment, JointInputs};
use crate::equations::system::Solution;
use crate::generated::hub::BodyAcceleration;
use crate::isolation::carrier::Carrier;
use crate::isolation::carrier_elimination::CarrierElimination;
use crate::model::kind::Kind;
use crate::model::mode::Mode;
use crate::numbers::each::{Each, JointStates};
use crate::numbers::real::{Scalar, zero};
use crate::numbers::vec3::{Vec3, add, components, zeros};
use crate::results::contributions::{DeviceContributions, JointGains};
use crate::sets::bundle::{Bundle, Shared, Unique};
use crate::sets::carrying::{Carrying, PreparedCarrying};
use crate::sets::devices::{DeviceSet, Devices, Visit};
use crate::sets::enumeration::{DeviceEnum, Variant, WithKind};
use crate::sets::per_device as data;
use crate::solve::spacecraft::Spacecraft;

/// State and inputs of one joint.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct JointReading<T = f64> {
    /// Coordinate, rad or m.
    pub coordinate: T,
    /// Rate, rad/s or m/s.
    pub rate: T,
    /// Motor torque or force, N m or N.
    pub motor: T,
    /// Whether it is driven, prescribed or locked.
    pub mode: Mode<T>,
}

impl<D: Devices> Spacecraft<D> {
    /// [`Self::eliminate_joints`] of joints that are read in the order of [`Self::joints`], without wrenches on their bodies,
    /// where the hub has the angular velocity `omega`, expressed in B, rad/s. The gains are those of [`Self::joint_gains`].
    ///
    /// None where that function returns an error, where joints are missing, and where the gains are those of other devices;
    /// gains and what is left of the iterator are then of no use.
    pub fn eliminate_joints_of(
        &self,
        omega: &Vector3<D::Scalar>,
        joints: &mut impl Iterator<Item = JointReading<D::Scalar>>,
        gains: &mut JointGains<D>,
    ) -> Option<DeviceContributions<D::Scalar>> {
        let omega = components(omega);
        let environment = Environment { omega, central: None, impulse: false, reduction: None };
        let mut assembly = Assembly::new(&self.shares, zeros(), zeros());
        let (mut moments, mut vanishing) = ([zeros(); 2], zero());
        let mut elimination = ReadElimination {
            joints,
            environment: &environment,
            assembly: &mut assembly,
            moments: &mut moments,
            vanishing: &mut vanishing,
            device: 0,
            by: self.arithmetic,
        };
        D::visit::<Eliminated, _>(&self.devices, &mut gains.0, &mut elimination).ok()?;
        let [_, prime] = moments;
        let found = DeviceContributions::new(&assembly, omega, prime);
        (vanishing == zero() && found.is_finite()).then_some(found)
    }

    /// [`Self::joint_accelerations`], each written by a function, in the order of [`Self::joints`]. False where that function
    /// returns an error; what is written is then of no use.
    pub fn write_joint_accelerations(
        &self,
        gains: &JointGains<D>,
        a: &Vector3<D::Scalar>,
        omega_dot: &Vector3<D::Scalar>,
        mut write: impl FnMut(D::Scalar),
    ) -> bool {
        let hub = Solution { r_b_n_ddot: components(a), omega_dot: components(omega_dot) };
        let hub_is_finite = hub.is_finite();
        let hub = hub.expressed_in_b();
        let mut substitution =
            WrittenAccelerations { hub, finite: hub_is_finite, write: &mut write };
        let visited = D::visit::<Substituted, _>(&self.devices, &gains.0, &mut substitution);
        visited.is_ok() && substitution.finite
    }
}

/// The gains that come of it.
type Eliminated = Unique<data::Gains>;

/// The gains.
type Substituted = Shared<data::Gains>;

/// What ends a visit.
struct Rejected;

impl<T> From<SolveError<T>> for Rejected {
    fn from(_: SolveError<T>) -> Self {
        Self
    }
}

/// Joints that are read and eliminated device by device.
struct ReadElimination<'a, T, I> {
    joints: &'a mut I,
    environment: &'a Environment<T>,
    assembly: &'a mut Assembly<T>,
    /// First moment of the devices about the origin of their base, and its derivative seen from it.
    moments: &'a mut [Vec3<T>; 2],
    /// Zero where all motor torques are finite: those of joints that are not driven reach no result.
    vanishing: &'a mut T,
    device: usize,
    by: Arithmetic,
}

/// States and inputs of the joints of one device.
struct DeviceReading<K: Kind> {
    joints: K::Joints<K::Scalar>,
    motors: K::Motors,
    modes: K::PerJoint<Mode<K::Scalar>>,
}

impl<T: Scalar, I: Iterator<Item = JointReading<T>>> ReadElimination<'_, T, I> {
    /// Reads the joints of the next device.
    #[inline]
    fn read<K: Kind<Scalar = T>>(&mut self) -> Result<DeviceReading<K>, Rejected> {
        let (mut joints, mut motors) = (K::at_rest(), K::motors_off());
        let mut modes = K::all(Mode::Driven);
        let inputs = motors.values_mut().zip(modes.values_mut());
        for ([coordinate, rate], (motor, mode)) in joints.states_mut().zip(inputs) {
            let read = self.joints.next().ok_or(Rejected)?;
            (*coordinate, *rate, *motor, *mode) =
                (read.coordinate, read.rate, read.motor, read.mode);
            *self.vanishing = *self.vanishing + zero::<T>() * read.motor;
        }
        Ok(DeviceReading { joints, motors, modes })
    }
}

impl<T: Scalar, I: Iterator<Item = JointReading<T>>> Visit<T, Eliminated>
    for ReadElimination<'_, T, I>
{
    type Error = Rejected;

    #[inline]
    fn visit<K: Kind<Scalar = T>>(
        &mut self,
        device: &Device<K>,
        gains: &mut Option<K::Gains<T>>,
    ) -> Result<(), Rejected> {
        let DeviceReading { joints, motors, modes } = self.read::<K>()?;
        let given = JointInputs { motors: &motors, modes: &modes, bodies: None };
        let (environment, assembly) = (self.environment, &mut *self.assembly);
        let (index, joints) = (self.device, &joints);
        self.device = index.wrapping_add(1);
        let of = DeviceElimination { device, index, joints, given, environment, assembly, gains };
        self.by.eliminate(of)?;
        device.add_first_moment(joints, self.moments);
        Ok(())
    }

    fn visit_enum<E: DeviceEnum<Scalar = T> + Devices>(
        &mut self,
        device: &E::Prepared,
        gains: &mut E::Per<data::Gains>,
    ) -> Result<(), Rejected> {
        E::with(device, OfItsKind { gains, visitor: self })
    }

    fn visit_carrying<C: Carrier<Scalar = T>, D: DeviceSet<Scalar = T>>(
        &mut self,
        carrying: &PreparedCarrying<C, D>,
        gains: &mut <Carrying<C, D> as DeviceSet>::Per<data::Gains>,
    ) -> Result<(), Rejected> {
        let DeviceReading { joints, motors, modes } = self.read::<C>()?;
        let (carrier, index) = (&carrying.carrier, self.device);
        let mut eliminating = CarrierElimination::start(carrier, index, &joints, self.environment);
        let mut carried = [zeros(); 2];
        let mut outboard = ReadElimination {
            joints: &mut *self.joints,
            environment: &eliminating.environment,
            assembly: &mut eliminating.assembly,
            moments: &mut carried,
            vanishing: &mut *self.vanishing,
            device: index.wrapping_add(1),
            by: self.by,
        };
        D::visit::<Eliminated, _>(&carrying.carried, &mut gains.carried, &mut outboard)?;
        self.device = outboard.device;
        let given = JointInputs { motors: &motors, modes: &modes, bodies: None };
        gains.carrier = Some(eliminating.finish(given, self.assembly)?);
        carrier.device.add_first_moment(&joints, self.moments);
        let shares = carrier.moving(&joints, zeros()).first_moments(carrier.carried_mass, carried);
        for (sum, share) in self.moments.iter_mut().zip(shares) {
            *sum = add(*sum, share);
        }
        Ok(())
    }

    fn compare(&mut self, expected: usize, found: usize) -> Result<(), Rejected> {
        if expected == found { Ok(()) } else { Err(Rejected) }
    }
}

/// A device of an enumeration visited with gains of its kind.
struct OfItsKind<'a, V, G> {
    gains: &'a mut G,
    visitor: &'a mut V,
}

impl<T, E, I> WithKind<E> for OfItsKind<'_, ReadElimination<'_, T, I>, E::Per<data::Gains>>
where
    T: Scalar,
    E: DeviceEnum<Scalar = T>,
    I: Iterator<Item = JointReading<T>>,
{
    type Output = Result<(), Rejected>;

    #[inline]
    fn with<K: Variant<E>>(self, device: &Device<K>) -> Result<(), Rejected> {
        let Self { gains, visitor } = self;
        let mut gains = E::held_mut::<data::Gains, K>(gains).ok_or(Rejected)?;
        visitor.visit(device, gains.refer())
    }
}

/// Accelerations that are written once those of the base are known.
struct WrittenAccelerations<'a, T, F> {
    hub: BodyAcceleration<T>,
    /// Whether all so far are finite.
    finite: bool,
    write: &'a mut F,
}

impl<T: Scalar, F: FnMut(T)> WrittenAccelerations<'_, T, F> {
    #[inline]
    fn write(&mut self, of: impl Iterator<Item = T>) {
        for acceleration in of {
            self.finite &= acceleration.is_finite();
            (self.write)(acceleration);
        }
    }
}

impl<T: Scalar, F: FnMut(T)> Visit<T, Substituted> for WrittenAccelerations<'_, T, F> {
    type Error = Rejected;

    #[inline]
    fn visit<K: Kind<Scalar = T>>(
        &mut self,
        _: &Device<K>,
        gains: <Substituted as Bundle<T>>::Of<'_, K>,
    ) -> Result<(), Rejected> {
        let gains = gains.as_ref().ok_or(Rejected)?;
        self.write(K::back_substitute(gains, &self.hub).values());
        Ok(())
    }

    fn visit_enum<E: DeviceEnum<Scalar = T> + Devices>(
        &mut self,
        device: &E::Prepared,
        gains: &E::Per<data::Gains>,
    ) -> Result<(), Rejected> {
        E::with(device, WrittenOfItsKind { gains, visitor: self })
    }

    fn visit_carrying<C: Carrier<Scalar = T>, D: DeviceSet<Scalar = T>>(
        &mut self,
        carrying: &PreparedCarrying<C, D>,
        gains: &<Carrying<C, D> as DeviceSet>::Per<data::Gains>,
    ) -> Result<(), Rejected> {
        let of_carrier = gains.carrier.as_ref().ok_or(Rejected)?;
        let (joints, [r_b_n_ddot, omega_dot]) = C::outward(of_carrier, &self.hub);
        self.write(joints.values());
        let hub = Solution { r_b_n_ddot, omega_dot }.expressed_in_b();
        let mut outboard =
            WrittenAccelerations { hub, finite: self.finite, write: &mut *self.write };
        D::visit::<Substituted, _>(&carrying.carried, &gains.carried, &mut outboard)?;
        self.finite = outboard.finite;
        Ok(())
    }

    fn compare(&mut self, expected: usize, found: usize) -> Result<(), Rejected> {
        if expected == found { Ok(()) } else { Err(Rejected) }
    }
}

/// A device of an enumeration visited with gains of its kind.
struct WrittenOfItsKind<'a, V, G> {
    gains: &'a G,
    visitor: &'a mut V,
}

impl<T, E, F> WithKind<E>
    for WrittenOfItsKind<'_, WrittenAccelerations<'_, T, F>, E::Per<data::Gains>>
where
    T: Scalar,
    E: DeviceEnum<Scalar = T>,
    F: FnMut(T),
{
    type Output = Result<(), Rejected>;

    #[inline]
    fn with<K: Variant<E>>(self, device: &Device<K>) -> Result<(), Rejected> {
        let Self { gains, visitor } = self;
        let gains = E::held::<data::Gains, K>(gains).ok_or(Rejected)?;
        visitor.visit(device, gains.refer())
    }
}
