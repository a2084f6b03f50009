//! [`ModalLedger`], and the energy ledger of a flexible structure.
//!
//! As for a rigid hub, `dT/dt` is what the accelerations require of every body, times the
//! velocities; the powers are each source's own force times the same. The structure's strain
//! counts with the springs, its damping with friction.

use crate::attitude::parameterisation::Attitude;
use crate::equations::error::SolveError;
use crate::equations::gravity::at_b;
use crate::equations::load_sums::Along;
use crate::flexible::equations::block::{dot6, joined};
use crate::flexible::modal::storage::{Flexible, ModalStorage};
use crate::flexible::results::loads::{AllLoads, MountLoads, StructureLoads};
use crate::flexible::results::momentum::WholeSums;
use crate::model::mode::HubMode;
use crate::model::wrench::Wrench;
use crate::numbers::real::{Scalar, half, zero};
use crate::numbers::vec3::{Vec3, components, dot, rotate, vector};
use crate::results::ledger::{Ledger, Power};
use crate::results::momentum::{About, MotionSums};
use crate::sets::devices::{DeviceSet, Devices};
use crate::solve::inputs::Inputs;
use crate::solve::spacecraft::Spacecraft;
use crate::solve::state::{Accelerations, State};

/// Energy and powers of the modes: [`Ledger::modal`](crate::Ledger::modal) of a flexible structure.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ModalLedger<T = f64> {
    /// Strain energy of the structure, `½ sum (w eta)²`, J.
    pub strain: T,
    /// Power of the structure's stiffness, W.
    pub stiffness: T,
    /// Power of the structure's damping, W; not above zero.
    pub damping: T,
}

/// The ledger of a flexible structure.
type FlexibleLedger<D, M> = Ledger<<D as DeviceSet>::Scalar, Flexible<M>>;

/// Sums of powers, and of the magnitudes of their terms.
struct Sums<T> {
    power: Power<T>,
    inertial: T,
    magnitude: T,
    stored: T,
    /// Force and moment about B that the hub needs beside the inputs.
    hub: Wrench<T>,
}

impl<D: Devices, M: ModalStorage> Spacecraft<D, Flexible<M>> {
    /// [`Self::ledger`] of what is finite, or whose overflow shows in the result.
    pub(crate) fn ledger_flexible<A: Attitude<D::Scalar>>(
        &self,
        state: &State<D, A, Flexible<M>>,
        inputs: &Inputs<D, Flexible<M>>,
        accelerations: &Accelerations<D, Flexible<M>>,
    ) -> Result<FlexibleLedger<D, M>, SolveError<D::Scalar>> {
        let whole = self.sums_flexible(state);
        let MotionSums { bn, bodies, .. } = &whole.motion;
        let velocity = rotate(bn, components(&state.r_b_n_dot));
        let omega = components(&state.omega);
        let field = inputs.gravity.field(bn, &state.r_b_n);
        let all = self.all_loads(state, inputs, accelerations, field.as_ref(), |_| Along::Body);
        let mut sums = self.structure_powers(state, inputs, accelerations, &all, velocity);
        self.add_mounts(inputs, &whole, &all, [velocity, omega], &mut sums)?;

        // Accelerations were counted in the frame that falls with the field: its power comes back.
        let uniform = dot(at_b(field.as_ref()), bodies.linear);
        sums.power.gravity = sums.power.gravity + uniform;
        sums.inertial = sums.inertial + uniform;
        sums.magnitude = sums.magnitude + uniform.abs() + uniform.abs();
        if let HubMode::Prescribed { .. } = inputs.hub {
            sums.power.hub = sums.hub.power(velocity, omega);
            sums.magnitude = sums.magnitude + sums.power.hub.abs();
        }
        let (strain, stiffness, damping) = self.strain(state);
        sums.power.springs = sums.power.springs + stiffness;
        sums.power.friction = sums.power.friction + damping;
        sums.magnitude = sums.magnitude + stiffness.abs() + damping.abs();

        let kinetic_rate = sums.inertial;
        let r_b = rotate(bn, components(&state.r_b_n));
        let [moment, _] = whole.first_moment;
        let gravity = field.as_ref().map_or_else(zero, |field| {
            field.potential(self.mass(), moment, &all.structure.second_moment, r_b)
        });
        let ledger = Ledger {
            kinetic: bodies.energy.max(zero()),
            gravity,
            springs: sums.stored + strain,
            kinetic_rate,
            power: sums.power,
            residual: kinetic_rate - sums.power.total(),
            magnitude: sums.magnitude,
            momentum: self.momentum_of(state, &whole.motion, About::InertialOrigin)?,
            modal: ModalLedger { strain, stiffness, damping },
        };
        ledger.finite()
    }

    /// What the structure's own accelerations require, and the powers of the inputs on it.
    fn structure_powers<A>(
        &self,
        state: &State<D, A, Flexible<M>>,
        inputs: &Inputs<D, Flexible<M>>,
        accelerations: &Accelerations<D, Flexible<M>>,
        all: &AllLoads<D, M>,
        velocity: Vec3<D::Scalar>,
    ) -> Sums<D::Scalar> {
        let omega = components(&state.omega);
        let (eta_dot, eta_ddot) =
            (state.modal.eta_dot.as_ref(), accelerations.modal.eta_ddot.as_ref());
        let StructureLoads { rigid, bending, gradient, .. } = &all.structure;
        let needed = rigid.plus(bending);
        let given = Wrench { force: inputs.force, moment: inputs.torque_b };

        let mut power = Power::none();
        power.external = given.power(velocity, omega);
        power.gravity = gradient.power(velocity, omega);
        let mut inertial = needed.power(velocity, omega);
        let wrenches = [*rigid, *bending, given, *gradient];
        let of_wrenches = wrenches.iter().map(|wrench| magnitude_of(wrench, velocity, omega));
        let mut magnitude = of_wrenches.fold(zero(), |sum, size| sum + size);
        let u = joined(all.hub.r_b_n_ddot, all.hub.omega_dot);
        let modal = self.structure.momenta.as_ref().iter().zip(eta_ddot).zip(eta_dot);
        let massive = self.massive();
        for (mode, (((column, acceleration), rate), force)) in
            modal.zip(inputs.modal.forces.as_ref()).enumerate()
        {
            let coupled = dot6(column, &u) * *rate;
            let own = if mode < massive { *acceleration * *rate } else { zero() };
            inertial = inertial + (coupled + own);
            power.external = power.external + *force * *rate;
            magnitude = magnitude + coupled.abs() + own.abs() + (*force * *rate).abs();
        }
        Sums {
            power,
            inertial,
            magnitude,
            stored: zero(),
            hub: needed.minus(gradient).minus(&given),
        }
    }

    /// Adds what the devices require, and their powers, for the velocity of B and its angular
    /// velocity.
    fn add_mounts(
        &self,
        inputs: &Inputs<D, Flexible<M>>,
        whole: &WholeSums<M, D::Scalar>,
        all: &AllLoads<D, M>,
        [velocity, omega]: [Vec3<D::Scalar>; 2],
        sums: &mut Sums<D::Scalar>,
    ) -> Result<(), SolveError<D::Scalar>> {
        let constants = self.structure.mounts.as_ref().iter().zip(inputs.modal.mounts.as_ref());
        let mounts = all.mounts.as_ref().iter().zip(whole.mounts.as_ref());
        for ((mount, moving), (constants, wrench)) in mounts.zip(constants) {
            let MountLoads { motion, totals, .. } = mount;
            self.check_joints(totals)?;
            let (v, w) = (motion.velocity(velocity, omega), motion.omega);
            let wrench = constants.about_origin(wrench);
            let [contained, of_contained] = &mount.contained;
            let needed = totals.inertial.minus(contained);
            let outside = totals.applied.plus(&wrench);
            let gradient = totals.gradient.minus(of_contained);
            // The field at K beside that at B, which the acceleration of K is counted without.
            let beside = dot(mount.field_beside_b, moving.sums.linear);

            let joints = &totals.power;
            sums.inertial = sums.inertial + needed.power(v, w) + joints.inertial + beside;
            let power = &mut sums.power;
            power.external = power.external + outside.power(v, w) + joints.applied;
            power.gravity = power.gravity + gradient.power(v, w) + joints.gradient + beside;
            power.motors = power.motors + joints.motors;
            power.springs = power.springs + joints.springs;
            power.friction = power.friction + joints.friction;
            sums.stored = sums.stored + joints.stored;
            let wrenches = [
                totals.inertial,
                *contained,
                totals.applied,
                wrench,
                totals.gradient,
                *of_contained,
            ];
            let of_wrenches = wrenches.iter().map(|wrench| magnitude_of(wrench, v, w));
            let start = sums.magnitude + joints.magnitude + beside.abs() + beside.abs();
            sums.magnitude = of_wrenches.fold(start, |sum, size| sum + size);
            let on_hub = mount.needed(&wrench).turned(&motion.axes);
            sums.hub = sums.hub.plus(&on_hub.moved(&vector(motion.origin)));
        }
        Ok(())
    }

    /// Strain energy, power of stiffness, power of damping.
    fn strain<A>(&self, state: &State<D, A, Flexible<M>>) -> (D::Scalar, D::Scalar, D::Scalar) {
        let motion = state.modal.eta.as_ref().iter().zip(state.modal.eta_dot.as_ref());
        let mut sums = (zero(), zero(), zero());
        for ([stiffness, damping], (eta, rate)) in
            self.structure.passive.as_ref().iter().zip(motion)
        {
            sums.0 = sums.0 + half::<D::Scalar>() * *stiffness * *eta * *eta;
            sums.1 = sums.1 - *stiffness * *eta * *rate;
            sums.2 = sums.2 - *damping * *rate * *rate;
        }
        sums
    }
}

/// Sum of the magnitudes of the power of force and moment.
fn magnitude_of<T: Scalar>(wrench: &Wrench<T>, velocity: Vec3<T>, omega: Vec3<T>) -> T {
    dot(components(&wrench.force), velocity).abs() + dot(components(&wrench.moment), omega).abs()
}
