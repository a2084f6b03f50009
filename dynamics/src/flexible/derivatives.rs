//! [`Flexible`] over other numbers, and its variables: modal coordinates, their rates, forces.

use core::convert::Infallible;

#[cfg(feature = "alloc")]
use crate::derivatives::loads::kernel::{Moving, NotEmitted};
#[cfg(feature = "alloc")]
use crate::derivatives::structure::StructureColumns;
use crate::derivatives::structure::StructureDerivatives;
#[cfg(feature = "alloc")]
use crate::derivatives::tree::base_motion::BaseMotion;
#[cfg(feature = "alloc")]
use crate::derivatives::tree::members::Members;
use crate::equations::device::Device;
#[cfg(feature = "alloc")]
use crate::equations::hub::HubConstants;
#[cfg(feature = "alloc")]
use crate::equations::joint_inputs::Environment;
use crate::flexible::equations::spacecraft::{FlexibleConstants, MountConstants};
use crate::flexible::equations::stability::OwnLimit;
use crate::flexible::modal::inputs::ModalInputs;
use crate::flexible::modal::state::{ModalAccelerations, ModalState};
use crate::flexible::modal::storage::{Flexible, ModalStorage};
use crate::isolation::carrier::Carrier;
use crate::model::kind::Kind;
use crate::model::wrench::Wrench;
use crate::numbers::real::Scalar;
use crate::numbers::vec3::map;
#[cfg(feature = "alloc")]
use crate::sets::bundle::Given;
use crate::sets::bundle::{Bundle, Shared, Unique};
use crate::sets::carrying::{Carrying, PreparedCarrying};
use crate::sets::devices::{DeviceSet, Devices, Visit};
#[cfg(feature = "alloc")]
use crate::sets::per_device as data;
use crate::sets::per_device::OnMount;
use crate::sets::with_numbers::WithNumbers;
#[cfg(feature = "alloc")]
use crate::solve::inputs::Inputs;
use crate::solve::spacecraft::Spacecraft;
#[cfg(feature = "alloc")]
use crate::solve::state::{Accelerations, State};

/// The mount of the n-th device or platform.
struct NthMount {
    left: usize,
    mount: usize,
}

impl NthMount {
    fn next(&mut self, mount: usize) {
        if self.left == 0 {
            self.mount = mount;
        }
        self.left = self.left.wrapping_sub(1);
    }
}

impl<T: Scalar> Visit<T, Shared<OnMount>> for NthMount {
    type Error = Infallible;

    fn visit<K: Kind<Scalar = T>>(
        &mut self,
        _: &Device<K>,
        mount: &usize,
    ) -> Result<(), Infallible> {
        self.next(*mount);
        Ok(())
    }

    fn visit_carrying<C: Carrier<Scalar = T>, D: DeviceSet<Scalar = T>>(
        &mut self,
        _: &PreparedCarrying<C, D>,
        mount: <Shared<OnMount> as Bundle<T>>::Of<'_, Carrying<C, D>>,
    ) -> Result<(), Infallible> {
        self.next(mount.carrier);
        Ok(())
    }
}

/// Writes the mount of each device or platform, by its number.
struct WriteMounts<F> {
    device: usize,
    mount: F,
}

impl<F: Fn(usize) -> usize> WriteMounts<F> {
    fn next(&mut self) -> usize {
        let device = self.device;
        self.device = device.wrapping_add(1);
        (self.mount)(device)
    }
}

impl<T: Scalar, F: Fn(usize) -> usize> Visit<T, Unique<OnMount>> for WriteMounts<F> {
    type Error = Infallible;

    fn visit<K: Kind<Scalar = T>>(
        &mut self,
        _: &Device<K>,
        to: &mut usize,
    ) -> Result<(), Infallible> {
        *to = self.next();
        Ok(())
    }

    fn visit_carrying<C: Carrier<Scalar = T>, D: DeviceSet<Scalar = T>>(
        &mut self,
        _: &PreparedCarrying<C, D>,
        to: <Unique<OnMount> as Bundle<T>>::Of<'_, Carrying<C, D>>,
    ) -> Result<(), Infallible> {
        to.carrier = self.next();
        Ok(())
    }
}

/// State, inputs and accelerations of the joints, and the mount.
#[cfg(feature = "alloc")]
type OnMounts = (Shared<data::Joints>, Given, Shared<data::Accelerations>, Shared<OnMount>);

/// Shows each device on its mount, which is the base after the hub's of its number.
#[cfg(feature = "alloc")]
struct EachOnMount<'a, T>(&'a mut Members<T>);

#[cfg(feature = "alloc")]
impl<T: Scalar> Visit<T, OnMounts> for EachOnMount<'_, T> {
    type Error = NotEmitted;

    fn visit<K: Kind<Scalar = T>>(
        &mut self,
        device: &Device<K>,
        (joints, given, accelerations, mount): <OnMounts as Bundle<T>>::Of<'_, K>,
    ) -> Result<(), NotEmitted> {
        self.0.base = mount.saturating_add(1);
        self.0.visit(device, (joints, given, accelerations))
    }

    fn visit_carrying<C: Carrier<Scalar = T>, D: DeviceSet<Scalar = T>>(
        &mut self,
        carrying: &PreparedCarrying<C, D>,
        (joints, given, accelerations, mount): <OnMounts as Bundle<T>>::Of<'_, Carrying<C, D>>,
    ) -> Result<(), NotEmitted> {
        self.0.base = mount.carrier.saturating_add(1);
        self.0.visit_carrying(carrying, (joints, given, accelerations))
    }
}

impl<M: ModalStorage> StructureDerivatives for Flexible<M> {
    fn constants<D: WithNumbers, U: Scalar>(
        craft: &Spacecraft<D, Self>,
        devices: &<D::With<U> as DeviceSet>::Prepared,
        number: impl Fn(D::Scalar) -> U + Copy,
    ) -> FlexibleConstants<D::With<U>, M> {
        let FlexibleConstants {
            on_mount,
            passive,
            momenta,
            mounts,
            basis,
            mass,
            residual,
            own_limit: OwnLimit { free, held },
        } = &craft.structure;
        let mut mounts_of_devices = D::With::<U>::new_data(devices, &OnMount);
        let mount = |device| {
            let mut nth = NthMount { left: device, mount: 0 };
            let Ok(()) = D::visit::<Shared<OnMount>, _>(&craft.devices, on_mount, &mut nth);
            nth.mount
        };
        let mut write = WriteMounts { device: 0, mount };
        let Ok(()) =
            D::With::<U>::visit::<Unique<OnMount>, _>(devices, &mut mounts_of_devices, &mut write);
        FlexibleConstants {
            on_mount: mounts_of_devices,
            passive: M::per_mode(passive, |of| of.map(number)),
            momenta: M::per_mode(momenta, |of| of.map(number)),
            mounts: M::per_mount(mounts, |mount| MountConstants {
                position: map(mount.position, number),
                shapes: M::per_mode(&mount.shapes, |of| of.map(number)),
                body: mount.body.map(number),
                contained: mount.contained.as_ref().map(|body| body.map(number)),
            }),
            basis: basis.map(number),
            mass: number(*mass),
            residual: *residual,
            own_limit: OwnLimit { free: number(*free), held: number(*held) },
        }
    }

    fn state<T: Scalar, U: Scalar>(
        state: &ModalState<M, T>,
        number: impl Fn(T) -> U + Copy,
    ) -> ModalState<M, U> {
        let converted = |of| M::per_mode(of, |of| number(*of));
        ModalState { eta: converted(&state.eta), eta_dot: converted(&state.eta_dot) }
    }

    fn inputs<T: Scalar, U: Scalar>(
        inputs: &ModalInputs<M, T>,
        number: impl Fn(T) -> U + Copy,
    ) -> ModalInputs<M, U> {
        ModalInputs {
            forces: M::per_mode(&inputs.forces, |of| number(*of)),
            mounts: M::per_mount(&inputs.mounts, |of| Wrench {
                force: of.force.map(number),
                moment: of.moment.map(number),
            }),
        }
    }

    fn accelerations<T: Scalar, U: Scalar>(
        accelerations: &ModalAccelerations<M, T>,
        number: impl Fn(T) -> U + Copy,
    ) -> ModalAccelerations<M, U> {
        ModalAccelerations { eta_ddot: M::per_mode(&accelerations.eta_ddot, |of| number(*of)) }
    }

    fn modes<D: Devices>(craft: &Spacecraft<D, Self>) -> usize {
        craft.modes()
    }

    fn mounts<D: Devices>(craft: &Spacecraft<D, Self>) -> usize {
        craft.mounts()
    }

    #[cfg(feature = "alloc")]
    fn bases<D: Devices, A>(
        craft: &Spacecraft<D, Self>,
        state: &State<D, A, Self>,
        inputs: &Inputs<D, Self>,
        accelerations: &Accelerations<D, Self>,
        hub: &BaseMotion<D::Scalar>,
        of_b: &Environment<D::Scalar>,
    ) -> StructureColumns<D::Scalar> {
        let wrenches = inputs.modal.mounts.as_ref();
        let bases = craft.mount_bases(state, wrenches, accelerations, hub, of_b);
        (bases, craft.modal_columns(state))
    }

    #[cfg(feature = "alloc")]
    fn body<D: Devices, A>(
        craft: &Spacecraft<D, Self>,
        state: &State<D, A, Self>,
    ) -> HubConstants<D::Scalar> {
        craft.deformed(state)
    }

    #[cfg(feature = "alloc")]
    fn visit_members<D: Devices>(
        craft: &Spacecraft<D, Self>,
        (joints, given, accelerations): <Moving as Bundle<D::Scalar>>::Of<'_, D>,
        members: &mut Members<D::Scalar>,
    ) -> Result<(), NotEmitted> {
        let Some(on_mount) = (!craft.is_rigid()).then_some(&craft.structure.on_mount) else {
            let data = (joints, given, accelerations);
            return D::visit::<Moving, _>(&craft.devices, data, members);
        };
        let data = (joints, given, accelerations, on_mount);
        D::visit::<OnMounts, _>(&craft.devices, data, &mut EachOnMount(members))
    }

    fn coordinates<T: Scalar>(state: &mut ModalState<M, T>) -> [&mut [T]; 2] {
        [state.eta.as_mut(), state.eta_dot.as_mut()]
    }

    fn forces<T: Scalar>(inputs: &mut ModalInputs<M, T>) -> &mut [T] {
        inputs.forces.as_mut()
    }

    fn wrenches<T: Scalar>(inputs: &mut ModalInputs<M, T>) -> &mut [Wrench<T>] {
        inputs.mounts.as_mut()
    }

    fn modal_accelerations<T: Scalar>(of: &ModalAccelerations<M, T>) -> &[T] {
        of.eta_ddot.as_ref()
    }
}
