//! [`ModalLoads`], and the loads of the devices on a flexible structure, and what frame B and modes
//! need beside the inputs, for known accelerations: inverse dynamics.
//!
//! The load of a joint is what all bodies outboard of it need, by Newton and Euler, less the
//! external wrenches on them. A mount moves with the structure, (F5) to (F8), so its own elastic
//! acceleration is part of what its devices need.

use core::convert::Infallible;
use core::fmt::Debug;

use crate::attitude::parameterisation::Attitude;
use crate::equations::device::Device;
use crate::equations::error::{Quantity, SolveError};
use crate::equations::gravity::{Field, at_b};
use crate::equations::joint_inputs::Environment;
use crate::equations::load_sums::{Along, HubAccelerations, LoadSums};
use crate::equations::system::Solution;
use crate::flexible::equations::accelerations::accelerated;
use crate::flexible::equations::block::{Six, combined, dot6, finite, joined, parted};
use crate::flexible::equations::gravity::on_body;
use crate::flexible::equations::mount::MountMotion;
use crate::flexible::modal::storage::{Flexible, ModalStorage};
use crate::isolation::carrier::Carrier;
use crate::model::kind::Kind;
use crate::model::wrench::Wrench;
use crate::numbers::real::{Scalar, two, zero};
use crate::numbers::symmetric::Symmetric;
use crate::numbers::vec3::{
    Columns, Vec3, add, columns, components, cross, neg, rotate_transposed, scale, sub, vector,
    zeros,
};
use crate::results::loads::{LoadAxes, Loads, Weighing as OnBase};
use crate::results::momentum::FirstMoments;
use crate::sets::bundle::{Bundle, Given, Shared, Unique};
use crate::sets::carrying::{Carrying, PreparedCarrying};
use crate::sets::devices::{DeviceSet, Devices, Visit};
use crate::sets::per_device as data;
use crate::sets::per_device::OnMount;
use crate::solve::inputs::Inputs;
use crate::solve::spacecraft::Spacecraft;
use crate::solve::state::{Accelerations, State};

/// Loads of mounts and modes: [`Loads::modal`](crate::Loads::modal) of a flexible structure.
#[derive(Clone, Copy, Debug)]
pub struct ModalLoads<M: ModalStorage, T: Clone + Debug = f64> {
    /// What the structure exerts on the devices of each mount together, about the mount, expressed
    /// in N with [`LoadAxes::Inertial`], otherwise in B. A body that the model contains is not subtracted.
    pub mounts: M::Mounts<Wrench<T>>,
    /// The force that each mode needs beside the inputs, N/sqrt(kg): only rounding with the
    /// spacecraft's own accelerations.
    pub forces: M::Modes<T>,
}

impl<M: ModalStorage, T: Clone + Debug + PartialEq> PartialEq for ModalLoads<M, T> {
    fn eq(&self, other: &Self) -> bool {
        self.mounts.as_ref() == other.mounts.as_ref()
            && self.forces.as_ref() == other.forces.as_ref()
    }
}

/// State, inputs and accelerations of the joints, and what comes of them.
type Weighed = (Shared<data::Joints>, Given, Shared<data::Accelerations>, LoadsOnMount);

/// The loads that come of them, and the mount.
type LoadsOnMount = (Unique<data::Loads>, Shared<OnMount>);

/// A mount with its acceleration and the sums over its devices, expressed in K.
#[derive(Clone, Debug)]
pub(crate) struct MountLoads<T> {
    pub(crate) motion: MountMotion<T>,
    environment: Environment<T>,
    /// The field at K less that at B, expressed in K, which its acceleration is counted without.
    pub(crate) field_beside_b: Vec3<T>,
    /// In the frame that falls with the field at K.
    acceleration: HubAccelerations<T>,
    along: Along<T>,
    pub(crate) totals: LoadSums<T>,
    /// What the contained body needs, and what the gradient of gravity exerts on it.
    pub(crate) contained: [Wrench<T>; 2],
    /// First moment about the origin of K, contained bodies subtracted.
    first_moment: Vec3<T>,
    /// Second moment likewise; only with a central field.
    contained_second_moment: Symmetric<T>,
}

impl<T: Scalar> MountLoads<T> {
    /// What the structure exerts on the devices, about the origin of K.
    fn on_devices(&self) -> Wrench<T> {
        let LoadSums { inertial, applied, gradient, .. } = &self.totals;
        inertial.minus(applied).minus(gradient)
    }

    /// The axes of K, columns expressed in B, where a load on the mount is expressed in K.
    fn axes_to_b(&self) -> Option<Columns<T>> {
        match self.along {
            Along::Body | Along::Parent | Along::Hub(None) => Some(self.motion.axes),
            Along::Hub(Some(_)) => None,
        }
    }

    /// What the mount needs of hub and modes beside a wrench on it.
    pub(crate) fn needed(&self, wrench: &Wrench<T>) -> Wrench<T> {
        let [inertial, gradient] = &self.contained;
        self.on_devices().minus(inertial).plus(gradient).minus(wrench)
    }

    /// Second moment about B, contained bodies subtracted; only with a central field.
    pub(crate) fn second_moment(&self, mass: T) -> Symmetric<T> {
        let own = self.totals.second_moment.less(self.contained_second_moment);
        self.motion.second_moment(mass, self.first_moment, &own)
    }
}

/// Computes the loads of the devices, and adds them to the sums of their mounts.
struct Weighing<'a, T> {
    mounts: &'a mut [MountLoads<T>],
    joints: usize,
}

impl<T: Scalar> Visit<T, Weighed> for Weighing<'_, T> {
    type Error = Infallible;

    fn visit<K: Kind<Scalar = T>>(
        &mut self,
        device: &Device<K>,
        (joints, given, accelerations, (out, mount)): <Weighed as Bundle<T>>::Of<'_, K>,
    ) -> Result<(), Infallible> {
        let given = (joints, given, accelerations, &mut *out);
        let to_b = self.on(*mount, |mount, moments| {
            let Ok(()) = mount.visit(device, given);
            moments.visit(device, joints)
        })?;
        out.mount = expressed(to_b.as_ref(), out.mount);
        Ok(())
    }

    fn visit_carrying<C: Carrier<Scalar = T>, D: DeviceSet<Scalar = T>>(
        &mut self,
        carrying: &PreparedCarrying<C, D>,
        (joints, given, accelerations, (out, mount)): <Weighed as Bundle<T>>::Of<
            '_,
            Carrying<C, D>,
        >,
    ) -> Result<(), Infallible> {
        let given = (joints, given, accelerations, &mut *out);
        let to_b = self.on(mount.carrier, |mount, moments| {
            let Ok(()) = mount.visit_carrying(carrying, given);
            moments.visit_carrying(carrying, joints)
        })?;
        out.carrier.mount = expressed(to_b.as_ref(), out.carrier.mount);
        Ok(())
    }
}

impl<T: Scalar> Weighing<'_, T> {
    /// The loads of the next devices, as on a rigid hub, with their mount for it. Returns the axes of
    /// the mount, columns expressed in B, where its load is expressed in them.
    fn on(
        &mut self,
        mount: usize,
        weigh: impl FnOnce(&mut OnBase<'_, T>, &mut FirstMoments<'_, T>) -> Result<(), Infallible>,
    ) -> Result<Option<Columns<T>>, Infallible> {
        let Some(mount) = self.mounts.get_mut(mount) else { return Ok(None) };
        let to_b = mount.axes_to_b();
        let MountLoads { environment, acceleration: hub, along, totals, first_moment, .. } = mount;
        totals.joints = self.joints;
        let mut moments = [*first_moment, zeros()];
        let mut on_base = OnBase { environment, hub, along, totals };
        weigh(&mut on_base, &mut FirstMoments(&mut moments))?;
        self.joints = totals.joints;
        [*first_moment, _] = moments;
        Ok(to_b)
    }
}

/// Loads of the devices, of the mounts, and of B and modes.
pub(crate) struct AllLoads<D: Devices, M: ModalStorage> {
    pub(crate) devices: D::Per<data::Loads>,
    pub(crate) mounts: M::Mounts<MountLoads<D::Scalar>>,
    /// Acceleration of B in the frame that falls with the field at B.
    pub(crate) hub: Solution<D::Scalar>,
    pub(crate) structure: StructureLoads<D::Scalar>,
}

/// What the structure needs by itself, about B, and what acts on it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct StructureLoads<T> {
    /// Of its motion as a rigid body, with the deformed first moment.
    pub(crate) rigid: Wrench<T>,
    /// Of the modes' rates and accelerations.
    pub(crate) bending: Wrench<T>,
    /// Of the gradient of gravity, with the third-order force on the whole.
    pub(crate) gradient: Wrench<T>,
    /// Second moment of the whole about B; only with a central field.
    pub(crate) second_moment: Symmetric<T>,
}

impl<D: Devices, M: ModalStorage> Spacecraft<D, Flexible<M>> {
    /// The loads that these accelerations need.
    pub(crate) fn loads_flexible<A: Attitude<D::Scalar>>(
        &self,
        state: &State<D, A, Flexible<M>>,
        inputs: &Inputs<D, Flexible<M>>,
        accelerations: &Accelerations<D, Flexible<M>>,
        axes: LoadAxes,
    ) -> Result<Loads<D, Flexible<M>>, SolveError<D::Scalar>> {
        let bn = columns(&state.attitude.dcm());
        let field = inputs.gravity.field(&bn, &state.r_b_n);
        let along = |motion: &MountMotion<D::Scalar>| mount_axes(axes, motion, &bn);
        let all = self.all_loads(state, inputs, accelerations, field.as_ref(), along);
        for mount in all.mounts.as_ref() {
            self.check_joints(&mount.totals)?;
        }

        let given = Wrench { force: inputs.force, moment: inputs.torque_b };
        let StructureLoads { rigid, bending, gradient, .. } = &all.structure;
        let mut hub = rigid.plus(bending).minus(gradient).minus(&given);
        let mut modal = self.modal_needs(state, inputs, accelerations, &all.hub);
        let constants = self.structure.mounts.as_ref().iter().zip(inputs.modal.mounts.as_ref());
        for (mount, (constants, wrench)) in all.mounts.as_ref().iter().zip(constants) {
            let needed = mount.needed(&constants.about_origin(wrench));
            let on_hub = needed.turned(&mount.motion.axes).moved(&vector(mount.motion.origin));
            hub = hub.plus(&on_hub);
            let needed = joined(components(&needed.force), components(&needed.moment));
            let of_shape = mount.motion.of_shape.transposed_times(&needed);
            for (sum, shape) in modal.as_mut().iter_mut().zip(constants.shapes.as_ref()) {
                *sum = *sum + dot6(shape, &of_shape);
            }
        }
        let mut places = self.structure.mounts.as_ref().iter().map(|mount| mount.position);
        let mounts = M::per_mount(&all.mounts, |mount| {
            let place = places.next().unwrap_or_else(zeros);
            let about_mount = mount.on_devices().moved(&vector(neg(place)));
            match &mount.along {
                Along::Hub(Some(columns)) => about_mount.turned_back(columns),
                Along::Body | Along::Parent | Along::Hub(None) => {
                    about_mount.turned(&mount.motion.axes)
                }
            }
        });
        let overflow = |what| Err(SolveError::Overflow { what });
        if !(hub.is_finite() && mounts.as_ref().iter().all(Wrench::is_finite)) {
            return overflow(Quantity::HubLoad);
        }
        if !finite(modal.as_ref()) {
            return overflow(Quantity::ModalAcceleration);
        }
        let modal = ModalLoads { mounts, forces: modal };
        Ok(Loads { devices: all.devices, hub, modal })
    }

    /// Loads of the devices and of the structure, for a field at B.
    pub(crate) fn all_loads<A: Attitude<D::Scalar>>(
        &self,
        state: &State<D, A, Flexible<M>>,
        inputs: &Inputs<D, Flexible<M>>,
        accelerations: &Accelerations<D, Flexible<M>>,
        field: Option<&Field<D::Scalar>>,
        along: impl Fn(&MountMotion<D::Scalar>) -> Along<D::Scalar>,
    ) -> AllLoads<D, M> {
        let omega = components(&state.omega);
        let central = field.and_then(|field| field.central);
        let hub = Solution {
            r_b_n_ddot: sub(components(&accelerations.r_b_n_ddot), at_b(field)),
            omega_dot: components(&accelerations.omega_dot),
        };
        let of_b = Environment { omega, central, impulse: false, reduction: None };
        let eta_ddot = accelerations.modal.eta_ddot.as_ref();
        let mut mounts = M::per_mount(&self.structure.mounts, |constants| {
            let (motion, environment) = constants.surroundings(state, &of_b);
            let Solution { r_b_n_ddot, omega_dot } =
                accelerated(&motion, &hub, constants, eta_ddot);
            let mut contained = [Wrench::none(); 2];
            let (mut first_moment, mut second_moment) = (zeros(), Symmetric::zero());
            if let Some(body) = &constants.contained {
                contained[0] = body.needs(motion.omega, r_b_n_ddot, omega_dot);
                first_moment = neg(body.first_moment);
                if let Some(central) = &environment.central {
                    contained[1] = on_body(central, body);
                    second_moment = body.second_moment();
                }
            }
            MountLoads {
                along: along(&motion),
                field_beside_b: central
                    .as_ref()
                    .map_or_else(zeros, |central| motion.field_beside_b(central)),
                motion,
                environment,
                acceleration: HubAccelerations { r_b_n_ddot, omega_dot },
                totals: LoadSums::none(),
                contained,
                first_moment,
                contained_second_moment: second_moment,
            }
        });
        let mut devices = D::new_data(&self.devices, &data::Loads);
        let mut weighing = Weighing { mounts: mounts.as_mut(), joints: 0 };
        let (joints, given) = (&state.devices, inputs.of_joints());
        let of_joints = &accelerations.devices;
        let data = (joints, given, of_joints, (&mut devices, &self.structure.on_mount));
        let Ok(()) = D::visit::<Weighed, _>(&self.devices, data, &mut weighing);

        let (linear, angular) =
            parted(&combined(self.structure.momenta.as_ref(), state.modal.eta_dot.as_ref()));
        let (linear_rate, angular_rate) =
            parted(&combined(self.structure.momenta.as_ref(), eta_ddot));
        let bending = Wrench::of(
            add(linear_rate, scale(two(), cross(omega, linear))),
            add(angular_rate, cross(omega, angular)),
        );
        let rigid = self.deformed(state).needs(omega, hub.r_b_n_ddot, hub.omega_dot);
        let mut structure = StructureLoads {
            rigid,
            bending,
            gradient: Wrench::none(),
            second_moment: Symmetric::zero(),
        };
        if let Some(central) = &central {
            let pairs = mounts.as_ref().iter().zip(self.structure.mounts.as_ref());
            let of_devices = pairs.fold(Symmetric::zero(), |sum, (mount, constants)| {
                sum.plus(mount.second_moment(constants.body.m_b))
            });
            structure.gradient = self.gradient(state, central, &of_devices);
            structure.second_moment = of_devices.plus(self.hub.second_moment());
        }
        AllLoads { devices, mounts, hub, structure }
    }

    /// The force that each mode needs for the structure's own motion, beside its inputs, (F4).
    fn modal_needs<A>(
        &self,
        state: &State<D, A, Flexible<M>>,
        inputs: &Inputs<D, Flexible<M>>,
        accelerations: &Accelerations<D, Flexible<M>>,
        hub: &Solution<D::Scalar>,
    ) -> M::Modes<D::Scalar> {
        let u: Six<D::Scalar> = joined(hub.r_b_n_ddot, hub.omega_dot);
        let mut needed = self.modal_forces(state, inputs);
        let own = self.structure.momenta.as_ref().iter().zip(accelerations.modal.eta_ddot.as_ref());
        let massive = self.massive();
        for (mode, (force, (column, acceleration))) in
            needed.as_mut().iter_mut().zip(own).enumerate()
        {
            let own = if mode < massive { *acceleration } else { zero() };
            *force = (dot6(column, &u) + own) - *force;
        }
        needed
    }
}

/// A wrench expressed in the axes of these columns, or as it is.
fn expressed<T: Scalar>(to_b: Option<&Columns<T>>, wrench: Wrench<T>) -> Wrench<T> {
    to_b.map_or(wrench, |axes| wrench.turned(axes))
}

/// The axes for the loads of a mount's devices. K takes the place of B on a rigid hub.
fn mount_axes<T: Scalar>(axes: LoadAxes, motion: &MountMotion<T>, bn: &Columns<T>) -> Along<T> {
    let [x, y, z] = motion.axes;
    let kb = [[x[0], y[0], z[0]], [x[1], y[1], z[1]], [x[2], y[2], z[2]]];
    match axes {
        LoadAxes::Body => Along::Body,
        LoadAxes::Parent => Along::Parent,
        LoadAxes::Hub => Along::Hub(Some(kb)),
        LoadAxes::Inertial => {
            Along::Hub(Some(bn.map(|column| rotate_transposed(&motion.axes, column))))
        }
    }
}
