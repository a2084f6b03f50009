//! [`FlexibleSpacecraft`]: a structure that bends, and devices on its mounts, checked and
//! precomputed once.

use crate::equations::hub::HubConstants;
use crate::equations::joint_inputs::Environment;
use crate::flexible::basis::Basis;
use crate::flexible::block::{Six, combined, joined};
use crate::flexible::check::{check_modes, check_momenta};
use crate::flexible::devices::Standing;
use crate::flexible::modes::Modes;
use crate::flexible::modes_error::ModesError;
use crate::flexible::mount::MountMotion;
use crate::flexible::on_mount::OnMount;
use crate::flexible::residual::check_residual;
use crate::flexible::stability::OwnLimit;
use crate::flexible::state::FlexibleState;
use crate::flexible::storage::ModalStorage;
use crate::model::parameters::Hub;
use crate::model::wrench::Wrench;
use crate::numbers::real::{Scalar, two, zero};
use crate::numbers::symmetric::Symmetric;
use crate::numbers::vec3::{Vec3, add, components, cross, neg};
use crate::sets::bundle::Shared;
use crate::sets::devices::Devices;
use crate::solve::spacecraft::Spacecraft;
use crate::validation::parameter_error::{ParameterError, Warning};

/// A structure that bends, with devices on its mounts. Never changes.
///
/// The equations are exact for a kinetic energy that is truncated once, `docs/flexible.md`:
/// momentum is conserved and the energy ledger closes to rounding, at any rotation of the mounts;
/// what the model leaves out is of first order in the deformation where the structure turns.
#[derive(Clone, Debug)]
pub struct FlexibleSpacecraft<D: Devices, S: ModalStorage> {
    /// Structure as a rigid hub, and the devices.
    pub(crate) rigid: Spacecraft<D>,
    /// The mount of each device.
    pub(crate) on_mount: D::Per<OnMount>,
    /// Stiffness `w²` and damping `2 zeta w` of each mode.
    pub(crate) passive: S::Modes<[D::Scalar; 2]>,
    /// `Y_0` by its columns: linear above angular momentum integral of each mode.
    pub(crate) momenta: S::Modes<Six<D::Scalar>>,
    pub(crate) mounts: S::Mounts<MountConstants<S, D::Scalar>>,
    pub(crate) basis: Basis<S, D::Scalar>,
    mass: D::Scalar,
    /// How many of the modes, at the end, are residual coordinates.
    residual: usize,
    /// Steps that the structure allows without devices.
    pub(crate) own_limit: OwnLimit<D::Scalar>,
}

/// Constants of a mount.
#[derive(Clone, Debug)]
pub(crate) struct MountConstants<S: ModalStorage, T: Scalar> {
    /// The mount from B, expressed in B.
    pub(crate) position: Vec3<T>,
    /// `Y_k` by its columns: translation above rotation of each mode.
    pub(crate) shapes: S::Modes<Six<T>>,
    /// Constant shares of the devices, less what the model contains of them.
    pub(crate) body: HubConstants<T>,
    /// What the model contains of the devices, to be subtracted.
    pub(crate) contained: Option<HubConstants<T>>,
}

impl<D: Devices, S: ModalStorage> FlexibleSpacecraft<D, S> {
    /// Checks the parameters and computes everything that depends only on them.
    ///
    /// `hub` is the whole structure undeformed, its modes with it. Devices have the parameters that
    /// they have on a rigid hub: places and axes in B, the structure undeformed; `on_mount` names
    /// the mount that carries each.
    ///
    /// # Errors
    ///
    /// [`ModesError`] names the part, the value and the bound.
    pub fn new(
        hub: &Hub<D::Scalar>,
        modes: &Modes<S, D::Scalar>,
        devices: &D,
        on_mount: &D::Per<OnMount>,
    ) -> Result<Self, ModesError<D::Scalar>>
    where
        D::Per<OnMount>: Clone,
    {
        Self::with_residual(hub, modes, 0, devices, on_mount)
    }

    /// As [`Self::new`], where the last `residual` modes are residual coordinates, (F16): the static
    /// response of the modes left out, without a mass of its own.
    ///
    /// A residual coordinate rho has the energy `½ (w rho)²` and the shapes `w psi`, of which the
    /// compliance is the sum `psi psiᵀ`; w may be any number above zero. Its damping ratio is that
    /// of its own vibration with the devices, joints and B held. `Modes::add_residual` (feature
    /// `alloc`) makes them of a compliance.
    ///
    /// # Errors
    ///
    /// As [`Self::new`], and [`ModesError::Residual`].
    pub fn with_residual(
        hub: &Hub<D::Scalar>,
        modes: &Modes<S, D::Scalar>,
        residual: usize,
        devices: &D,
        on_mount: &D::Per<OnMount>,
    ) -> Result<Self, ModesError<D::Scalar>>
    where
        D::Per<OnMount>: Clone,
    {
        let rigid = Spacecraft::new(hub, devices)?;
        check_modes(modes)?;
        check_residual(modes, residual)?;
        let mut mass = rigid.mass();
        let mut bodies = S::mounts(modes.mounts.as_ref().len(), &nothing());
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
        let mut momenta = S::modes(modes.frequencies.as_ref().len(), &[zero(); 6]);
        for (to, (linear, angular)) in momenta.as_mut().iter_mut().zip(integrals) {
            *to = joined(components(linear), components(angular));
        }
        check_momenta(&rigid.hub, momenta.as_ref())?;
        let mut bodies = bodies.as_ref().iter();
        let mounts = S::per_mount(&modes.mounts, |mount| {
            let mut shapes = S::modes(momenta.as_ref().len(), &[zero(); 6]);
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
        let mut passive = S::per_mode(&modes.frequencies, |w| [*w * *w, *w]);
        for ([_, damping], zeta) in passive.as_mut().iter_mut().zip(modes.damping.as_ref()) {
            *damping = two::<D::Scalar>() * *zeta * *damping;
        }
        let shapes = S::per_mount(&mounts, |mount: &MountConstants<S, _>| mount.shapes.clone());
        let basis = Basis::new(&shapes, &momenta, residual);
        let on_mount = on_mount.clone();
        let own_limit = OwnLimit { free: zero(), held: zero() };
        let mut craft =
            Self { rigid, on_mount, passive, momenta, mounts, basis, mass, residual, own_limit };
        craft.damp_residual(modes.damping.as_ref())?;
        let own_limit = craft.own_limit();
        Ok(Self { own_limit, ..craft })
    }

    /// Mass of structure and devices, kg.
    #[must_use]
    pub fn mass(&self) -> D::Scalar {
        self.mass
    }

    /// The number of modes.
    #[must_use]
    pub fn modes(&self) -> usize {
        self.momenta.as_ref().len()
    }

    /// The number of modes that have a modal mass: those before the residual coordinates.
    #[must_use]
    pub fn massive(&self) -> usize {
        self.modes().saturating_sub(self.residual)
    }

    /// The number of mounts.
    #[must_use]
    pub fn mounts(&self) -> usize {
        self.mounts.as_ref().len()
    }

    /// The structure as a rigid hub, undeformed, with the devices on it.
    #[must_use]
    pub fn rigid(&self) -> &Spacecraft<D> {
        &self.rigid
    }

    /// Unusual parameters that are accepted; see [`Warning`].
    #[must_use = "warnings do nothing unless they are read"]
    pub fn warnings(&self) -> impl Iterator<Item = Warning<D::Scalar>> + '_ {
        self.rigid.warnings()
    }
}

impl<S: ModalStorage, T: Scalar> MountConstants<S, T> {
    /// The motion of the mount, on a frame B that turns at `omega`.
    pub(crate) fn motion<D: Devices<Scalar = T>, A>(
        &self,
        state: &FlexibleState<D, S, A>,
        omega: Vec3<T>,
    ) -> MountMotion<T> {
        let q = combined(self.shapes.as_ref(), state.eta.as_ref());
        let q_dot = combined(self.shapes.as_ref(), state.eta_dot.as_ref());
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
        state: &FlexibleState<D, S, A>,
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
