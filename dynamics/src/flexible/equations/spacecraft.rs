//! A spacecraft with a [`Flexible`] structure, and devices on its mounts, checked and precomputed
//! once.

use crate::equations::hub::HubConstants;
use crate::equations::joint_inputs::Environment;
use crate::flexible::equations::basis::Basis;
use crate::flexible::equations::block::{Six, combined, joined};
use crate::flexible::equations::check::{check_modes, check_momenta};
use crate::flexible::equations::devices::Standing;
use crate::flexible::equations::mount::MountMotion;
use crate::flexible::equations::residual::check_residual;
use crate::flexible::equations::stability::OwnLimit;
use crate::flexible::modal::modes::Modes;
use crate::flexible::modal::modes_error::ModesError;
use crate::flexible::modal::storage::{Flexible, ModalStorage};
use crate::model::parameters::Hub;
use crate::model::wrench::Wrench;
use crate::numbers::real::{Scalar, two, zero};
use crate::numbers::symmetric::Symmetric;
use crate::numbers::vec3::{Vec3, add, components, cross, neg};
use crate::sets::bundle::Shared;
use crate::sets::devices::Devices;
use crate::sets::per_device::OnMount;
use crate::solve::spacecraft::Spacecraft;
use crate::solve::state::State;
use crate::validation::parameter_error::ParameterError;

/// What is computed of a structure with modes once.
#[derive(Clone, Debug)]
pub struct FlexibleConstants<D: Devices, M: ModalStorage> {
    /// The mount of each device.
    pub(crate) on_mount: D::Per<OnMount>,
    /// Stiffness `w²` and damping `2 zeta w` of each mode.
    pub(crate) passive: M::Modes<[D::Scalar; 2]>,
    /// `Y_0` by its columns: linear above angular momentum integral of each mode.
    pub(crate) momenta: M::Modes<Six<D::Scalar>>,
    pub(crate) mounts: M::Mounts<MountConstants<M, D::Scalar>>,
    pub(crate) basis: Basis<M, D::Scalar>,
    /// Of structure and devices, contained bodies subtracted.
    pub(crate) mass: D::Scalar,
    /// How many of the modes, at the end, are residual coordinates.
    pub(crate) residual: usize,
    /// Steps that the structure allows without devices.
    pub(crate) own_limit: OwnLimit<D::Scalar>,
}

/// Constants of a mount.
#[derive(Clone, Debug)]
pub(crate) struct MountConstants<M: ModalStorage, T: Scalar> {
    /// The mount from B, expressed in B.
    pub(crate) position: Vec3<T>,
    /// `Y_k` by its columns: translation above rotation of each mode.
    pub(crate) shapes: M::Modes<Six<T>>,
    /// Constant shares of the devices, less what the model contains of them.
    pub(crate) body: HubConstants<T>,
    /// What the model contains of the devices, to be subtracted.
    pub(crate) contained: Option<HubConstants<T>>,
}

impl<D: Devices, M: ModalStorage> Spacecraft<D, Flexible<M>> {
    /// A flexible structure with devices on its mounts: checks the parameters and computes everything
    /// that depends only on them.
    ///
    /// The equations are exact for a kinetic energy that is truncated once, `docs/flexible.md`:
    /// momentum is conserved and the energy ledger closes to rounding, at any rotation of the mounts;
    /// what the model leaves out is of first order in the deformation where the structure turns.
    ///
    /// `hub` is the whole structure undeformed, its modes with it. Devices have the parameters that
    /// they have on a rigid hub: places and axes in B, the structure undeformed; `on_mount` names
    /// the mount that carries each.
    ///
    /// # Errors
    ///
    /// [`ModesError`] names the part, the value and the bound.
    pub fn flexible(
        hub: &Hub<D::Scalar>,
        modes: &Modes<M, D::Scalar>,
        devices: &D,
        on_mount: &D::Per<OnMount>,
    ) -> Result<Self, ModesError<D::Scalar>> {
        Self::flexible_with_residual(hub, modes, 0, devices, on_mount)
    }

    /// As [`Self::flexible`], where the last `residual` modes are residual coordinates, (F16): the static
    /// response of the modes left out, without a mass of its own.
    ///
    /// A residual coordinate rho has the energy `½ (w rho)²` and the shapes `w psi`, of which the
    /// compliance is the sum `psi psiᵀ`; w may be any number above zero. Its damping ratio is that
    /// of its own vibration with the devices, joints and B held. `Modes::add_residual` (feature
    /// `alloc`) makes them of a compliance.
    ///
    /// # Errors
    ///
    /// As [`Self::flexible`], and [`ModesError::Residual`].
    pub fn flexible_with_residual(
        hub: &Hub<D::Scalar>,
        modes: &Modes<M, D::Scalar>,
        residual: usize,
        devices: &D,
        on_mount: &D::Per<OnMount>,
    ) -> Result<Self, ModesError<D::Scalar>> {
        let rigid = Spacecraft::new(hub, devices)?;
        check_modes(modes)?;
        check_residual(modes, residual)?;
        let mut mass = rigid.mass();
        let mut bodies = M::mounts(modes.mounts.as_ref().len(), &nothing());
        for (body, mount) in bodies.as_mut().iter_mut().zip(modes.mounts.as_ref()) {
            if let Some(contained) = &mount.contained {
                *body = negative(&HubConstants::new(&contained.hub()));
                mass = mass - contained.mass;
            }
        }
        let mut standing = Standing { bodies: bodies.as_mut(), device: 0 };
        D::visit::<Shared<OnMount>, _>(&rigid.devices, on_mount, &mut standing)?;
        if !(mass > zero() && mass.is_finite()) {
            return Err(ModesError::Rigid(ParameterError::TotalMass { value: mass }));
        }

        let integrals = modes.linear.as_ref().iter().zip(modes.angular.as_ref());
        let mut momenta = M::modes(modes.frequencies.as_ref().len(), &[zero(); 6]);
        for (to, (linear, angular)) in momenta.as_mut().iter_mut().zip(integrals) {
            *to = joined(components(linear), components(angular));
        }
        check_momenta(&rigid.hub, momenta.as_ref())?;
        let mut bodies = bodies.as_ref().iter();
        let mounts = M::per_mount(&modes.mounts, |mount| {
            let mut shapes = M::modes(momenta.as_ref().len(), &[zero(); 6]);
            let columns =
                mount.point.translation.as_ref().iter().zip(mount.point.rotation.as_ref());
            for (to, (translation, rotation)) in shapes.as_mut().iter_mut().zip(columns) {
                *to = joined(components(translation), components(rotation));
            }
            MountConstants {
                position: components(&mount.point.position),
                shapes,
                body: bodies.next().copied().unwrap_or_else(nothing),
                contained: mount.contained.as_ref().map(|body| HubConstants::new(&body.hub())),
            }
        });
        let mut passive = M::per_mode(&modes.frequencies, |w| [*w * *w, *w]);
        for ([_, damping], zeta) in passive.as_mut().iter_mut().zip(modes.damping.as_ref()) {
            *damping = two::<D::Scalar>() * *zeta * *damping;
        }
        let shapes = M::per_mount(&mounts, |mount: &MountConstants<M, _>| mount.shapes.clone());
        let basis = Basis::new(&shapes, &momenta, residual);
        let on_mount = on_mount.clone();
        let own_limit = OwnLimit { free: zero(), held: zero() };
        let mut craft: Self = rigid.with_structure(FlexibleConstants {
            on_mount,
            passive,
            momenta,
            mounts,
            basis,
            mass,
            residual,
            own_limit,
        });
        craft.damp_residual(modes.damping.as_ref())?;
        craft.structure.own_limit = craft.own_limit();
        Ok(craft)
    }

    /// The number of modes.
    #[must_use]
    pub fn modes(&self) -> usize {
        self.structure.momenta.as_ref().len()
    }

    /// The number of modes that have a modal mass: those before the residual coordinates.
    #[must_use]
    pub fn massive(&self) -> usize {
        self.modes().saturating_sub(self.structure.residual)
    }

    /// The number of mounts.
    #[must_use]
    pub fn mounts(&self) -> usize {
        self.structure.mounts.as_ref().len()
    }

    /// Whether nothing deforms: there are no modes and no mounts.
    pub(crate) fn is_rigid(&self) -> bool {
        self.modes() == 0 && self.mounts() == 0
    }

    /// The structure as a rigid hub, undeformed, with the devices on it.
    #[must_use]
    pub fn undeformed(&self) -> Spacecraft<D> {
        self.clone().with_structure(())
    }
}

#[cfg(feature = "alloc")]
impl<D: Devices> Spacecraft<D, Flexible<crate::ListedModes>> {
    /// A rigid hub as a structure without modes and mounts: results have the bits of the rigid hub,
    /// and state, inputs and accelerations empty lists of modes.
    #[must_use]
    pub fn from_rigid(rigid: Spacecraft<D>) -> Self {
        let (mounts, momenta) = (alloc::vec::Vec::new(), alloc::vec::Vec::new());
        let structure = FlexibleConstants {
            on_mount: D::new_data(&rigid.devices, &OnMount),
            passive: alloc::vec::Vec::new(),
            basis: Basis::of_modes(&mounts, &momenta, 0),
            momenta,
            mounts: alloc::vec::Vec::new(),
            mass: rigid.mass(),
            residual: 0,
            own_limit: OwnLimit { free: zero(), held: zero() },
        };
        rigid.with_structure(structure)
    }
}

impl<M: ModalStorage, T: Scalar> MountConstants<M, T> {
    /// The motion of the mount, on a frame B that turns at `omega`.
    pub(crate) fn motion<D: Devices<Scalar = T>, A>(
        &self,
        state: &State<D, A, Flexible<M>>,
        omega: Vec3<T>,
    ) -> MountMotion<T> {
        let q = combined(self.shapes.as_ref(), state.modal.eta.as_ref());
        let q_dot = combined(self.shapes.as_ref(), state.modal.eta_dot.as_ref());
        MountMotion::new(self.position, &q, &q_dot, omega)
    }

    /// A wrench about the mount, about the origin of K.
    pub(crate) fn about_origin(&self, wrench: &Wrench<T>) -> Wrench<T> {
        let force = components(&wrench.force);
        Wrench::of(force, add(components(&wrench.moment), cross(self.position, force)))
    }

    /// The motion of the mount and gravity in its frame K, for motion and gravity of B. The
    /// acceleration of K is counted in the frame that falls with the field at K.
    pub(crate) fn surroundings<D: Devices<Scalar = T>, A>(
        &self,
        state: &State<D, A, Flexible<M>>,
        of_b: &Environment<T>,
    ) -> (MountMotion<T>, Environment<T>) {
        let mut motion = self.motion(state, of_b.omega);
        if let Some(central) = &of_b.central {
            motion = motion.falling(central);
        }
        let central = of_b.central.map(|central| central.turned(&motion.axes));
        (
            motion,
            Environment {
                omega: motion.omega,
                central,
                impulse: of_b.impulse,
                reduction: of_b.reduction,
            },
        )
    }
}

/// No body.
pub(crate) fn nothing<T: Scalar>() -> HubConstants<T> {
    HubConstants { m_b: zero(), first_moment: [zero(); 3], i_b_b: Symmetric::zero() }
}

/// A body to be subtracted.
pub(crate) fn negative<T: Scalar>(body: &HubConstants<T>) -> HubConstants<T> {
    HubConstants {
        m_b: -body.m_b,
        first_moment: neg(body.first_moment),
        i_b_b: Symmetric::zero().less(body.i_b_b),
    }
}

/// Adds the magnitudes of a scale.
pub(crate) fn magnitudes<T: Scalar>(
    (mass, moments): (T, Vec3<T>),
    (other, more): (T, Vec3<T>),
) -> (T, Vec3<T>) {
    (mass + other.abs(), add(moments, more.map(Scalar::abs)))
}
