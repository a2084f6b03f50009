//! All accelerations of a flexible structure, from state and inputs.

use crate::attitude::parameterisation::Attitude;
use crate::equations::assembly::Assembly;
use crate::equations::error::SolveError;
use crate::equations::hub::HubConstants;
use crate::equations::joint_inputs::Environment;
use crate::equations::system::{Scale, Solution, System};
use crate::flexible::equations::basis::Basis;
use crate::flexible::equations::block::{Six, combined, finite, joined, parted};
use crate::flexible::equations::condense::{Condensed, SmallMass};
use crate::flexible::equations::devices::{
    Eliminated, MountBackSubstitution, MountElimination, MountStage, Substituted,
};
use crate::flexible::equations::gravity::on_body;
use crate::flexible::equations::mount::MountMotion;
use crate::flexible::equations::spacecraft::{MountConstants, magnitudes};
use crate::flexible::modal::storage::{Flexible, ModalStorage};
use crate::model::mode::HubMode;
use crate::model::wrench::Wrench;
use crate::numbers::each::Each;
use crate::numbers::real::{Scalar, two};
use crate::numbers::symmetric::Symmetric;
use crate::numbers::vec3::{Vec3, add, components, cross, scale, sub, zeros};
use crate::sets::counts::check_counts;
use crate::sets::devices::Devices;
use crate::sets::per_device as data;
use crate::solve::accelerations::{EvaluationStart, check_fixed, evaluation_start};
use crate::solve::diagnosis::overflow;
use crate::solve::elimination::Eliminate;
use crate::solve::inputs::Inputs;
use crate::solve::spacecraft::Spacecraft;
use crate::solve::state::{Accelerations, State};

impl<D: Devices, M: ModalStorage> Spacecraft<D, Flexible<M>> {
    /// All second derivatives of the state, (F9), each device eliminated `by` this.
    pub(crate) fn solve_flexible<A: Attitude<D::Scalar>>(
        &self,
        by: impl Eliminate<D::Scalar>,
        state: &State<D, A, Flexible<M>>,
        inputs: &Inputs<D, Flexible<M>>,
        found: &mut Accelerations<D, Flexible<M>>,
    ) -> Result<(), SolveError<D::Scalar>> {
        check_fixed(state, inputs)?;
        let EvaluationStart { environment, at_b } = evaluation_start(state, inputs);
        let omega = environment.omega;
        let mut stages = self.stages(state, inputs, &environment);
        let mut gains = D::new_data(&self.devices, &data::Gains);
        self.eliminate(by, state, inputs, stages.as_mut(), &mut gains)?;

        let forces = self.modal_forces(state, inputs);
        let mut structure = self.structure(state, inputs, omega);
        if let Some(central) = &environment.central {
            let devices = second_moment(stages.as_ref());
            let Wrench { force, moment } = self.gradient(state, central, &devices);
            structure.h_v = add(structure.h_v, components(&force));
            structure.h_w = add(structure.h_w, components(&moment));
        }
        let given = given_hub(&inputs.hub, at_b);
        let hub = self.substitute(stages.as_ref(), &structure, &forces, given, &gains, found)?;
        let finite = found.devices.values().all(Scalar::is_finite);
        found.finish(inputs, &hub, at_b, finite)
    }

    /// Hub and modes together, (F12), then the joints; writes accelerations of modes and joints,
    /// returns that of the hub.
    pub(crate) fn substitute(
        &self,
        stages: &[MountStage<D::Scalar>],
        structure: &System<D::Scalar>,
        forces: &M::Modes<D::Scalar>,
        given: Option<Solution<D::Scalar>>,
        gains: &D::Per<data::Gains>,
        found: &mut Accelerations<D, Flexible<M>>,
    ) -> Result<Solution<D::Scalar>, SolveError<D::Scalar>> {
        let projected = self.structure.basis.projected(forces);
        let mut condensed = Condensed::new(structure, &self.structure.basis, &projected);
        let scale = self.add_mounts_to(&mut condensed, stages, &self.structure.basis);
        let (hub, p) = condensed.solve(given, &scale).map_err(|small| match small {
            SmallMass::Modal(small) => {
                SolveError::ModalMass { pivot: small.pivot, bound: small.bound }
            }
            SmallMass::Hub(small) => small.of(None, None),
        })?;
        found.modal.eta_ddot = self.structure.basis.completed(forces, &p, &projected);
        if !(hub.is_finite() && finite(found.modal.eta_ddot.as_ref())) {
            return Err(overflow());
        }
        self.substitute_joints(stages, &hub, gains, found);
        Ok(hub)
    }

    /// Adds the equations of each mount to those of hub and modal directions; returns what the hub's
    /// pivots are checked against.
    pub(crate) fn add_mounts_to(
        &self,
        condensed: &mut Condensed<M, D::Scalar>,
        stages: &[MountStage<D::Scalar>],
        basis: &Basis<M, D::Scalar>,
    ) -> Scale<D::Scalar> {
        let mut scale = self.structure_scale();
        let mounts = stages.iter().zip(self.structure.mounts.as_ref());
        for ((stage, constants), coupling) in mounts.zip(basis.mounts.as_ref()) {
            let MountStage { motion, assembly, .. } = stage;
            let (mass, moments) = assembly.scale(&constants.body);
            let of_mount = (mass.abs(), moments.map(Scalar::abs));
            scale = magnitudes(scale, of_mount);
            let coupling = coupling.as_ref().get(..basis.count).unwrap_or_default();
            condensed.add(motion, &assembly.system(motion.omega), of_mount, coupling);
        }
        scale
    }

    /// The accelerations of the joints, from those of hub and modes.
    pub(crate) fn substitute_joints(
        &self,
        stages: &[MountStage<D::Scalar>],
        hub: &Solution<D::Scalar>,
        gains: &D::Per<data::Gains>,
        found: &mut Accelerations<D, Flexible<M>>,
    ) {
        let mut moving = stages.iter().zip(self.structure.mounts.as_ref());
        let accelerations = M::per_mount(&self.structure.mounts, |_| {
            let still = || Solution { r_b_n_ddot: zeros(), omega_dot: zeros() };
            moving.next().map_or_else(still, |(stage, constants)| {
                accelerated(&stage.motion, hub, constants, found.modal.eta_ddot.as_ref())
            })
        });
        let mut substitution = MountBackSubstitution(accelerations.as_ref());
        let data = (gains, &mut found.devices, &self.structure.on_mount);
        let Ok(()) = D::visit::<Substituted, _>(&self.devices, data, &mut substitution);
    }

    /// Motion of each mount, and its equations before any device is evaluated.
    pub(crate) fn stages<A>(
        &self,
        state: &State<D, A, Flexible<M>>,
        inputs: &Inputs<D, Flexible<M>>,
        of_b: &Environment<D::Scalar>,
    ) -> M::Mounts<MountStage<D::Scalar>> {
        let mut wrenches = inputs.modal.mounts.as_ref().iter();
        M::per_mount(&self.structure.mounts, |mount| {
            let (motion, environment) = mount.surroundings(state, of_b);
            let wrench = wrenches.next().copied().unwrap_or_else(Wrench::none);
            let wrench = mount.about_origin(&wrench);
            let (force, moment) = (components(&wrench.force), components(&wrench.moment));
            let mut assembly = Assembly::new(&mount.body, force, moment);
            if let (Some(central), Some(contained)) = (&environment.central, &mount.contained) {
                let Wrench { force, moment } = Wrench::none().minus(&on_body(central, contained));
                assembly.add_wrench(components(&force), components(&moment));
                let second = contained.second_moment();
                assembly.second_moment = assembly.second_moment.less(second);
            }
            MountStage { motion, environment, assembly }
        })
    }

    /// Eliminates every device into the equations of its mount.
    pub(crate) fn eliminate<A>(
        &self,
        by: impl Eliminate<D::Scalar>,
        state: &State<D, A, Flexible<M>>,
        inputs: &Inputs<D, Flexible<M>>,
        stages: &mut [MountStage<D::Scalar>],
        gains: &mut D::Per<data::Gains>,
    ) -> Result<(), SolveError<D::Scalar>> {
        let (joints, given) = (&state.devices, inputs.of_joints());
        check_counts::<D>(&self.devices, joints, Some(given), None)?;
        let mut elimination = MountElimination { mounts: stages, device: 0, by };
        let data = (joints, given, gains, &self.structure.on_mount);
        D::visit::<Eliminated, _>(&self.devices, data, &mut elimination)
    }

    /// Modal forces: from outside, of stiffness and of damping.
    pub(crate) fn modal_forces<A>(
        &self,
        state: &State<D, A, Flexible<M>>,
        inputs: &Inputs<D, Flexible<M>>,
    ) -> M::Modes<D::Scalar> {
        let mut forces = inputs.modal.forces.clone();
        let motion = state.modal.eta.as_ref().iter().zip(state.modal.eta_dot.as_ref());
        let passive = self.structure.passive.as_ref().iter().zip(motion);
        for (force, ([stiffness, damping], (eta, rate))) in forces.as_mut().iter_mut().zip(passive)
        {
            *force = *force - *stiffness * *eta - *damping * *rate;
        }
        forces
    }

    /// The structure as a rigid body whose first moment its deformation changes, (F3).
    pub(crate) fn deformed<A>(&self, state: &State<D, A, Flexible<M>>) -> HubConstants<D::Scalar> {
        let (shift, _) =
            parted(&combined(self.structure.momenta.as_ref(), state.modal.eta.as_ref()));
        let hub = self.hub;
        HubConstants { first_moment: add(hub.first_moment, shift), ..hub }
    }

    /// Rows of the structure's own hub equations, (F4).
    pub(crate) fn structure<A>(
        &self,
        state: &State<D, A, Flexible<M>>,
        inputs: &Inputs<D, Flexible<M>>,
        omega: Vec3<D::Scalar>,
    ) -> System<D::Scalar> {
        let rates = combined(self.structure.momenta.as_ref(), state.modal.eta_dot.as_ref());
        let (linear, angular) = parted(&rates);
        let (force, moment) = (components(&inputs.force), components(&inputs.torque_b));
        let own = self.deformed(state).system(omega, force, moment);
        let coriolis = scale(two(), cross(omega, linear));
        System { h_v: sub(own.h_v, coriolis), h_w: sub(own.h_w, cross(omega, angular)), ..own }
    }

    /// What the pivots of the hub are checked against, of the structure.
    fn structure_scale(&self) -> Scale<D::Scalar> {
        let hub = &self.hub;
        (hub.m_b, scale(two(), hub.i_b_b.diagonal()))
    }
}

/// Second moment about B of everything on the mounts, less what the model contains, once every
/// device is eliminated.
fn second_moment<T: Scalar>(stages: &[MountStage<T>]) -> Symmetric<T> {
    stages.iter().fold(Symmetric::zero(), |sum, MountStage { motion, assembly, .. }| {
        let body = assembly.body();
        sum.plus(motion.second_moment(body.m_b, body.first_moment, &assembly.second_moment))
    })
}

/// The acceleration of a hub that is held, in the frame that falls with the field at B.
fn given_hub<T: Scalar>(hub: &HubMode<T>, at_b: Vec3<T>) -> Option<Solution<T>> {
    match hub {
        HubMode::Free => None,
        HubMode::Fixed => Some(Solution { r_b_n_ddot: sub(zeros(), at_b), omega_dot: zeros() }),
        HubMode::Prescribed { r_b_n_ddot, omega_dot } => Some(Solution {
            r_b_n_ddot: sub(components(r_b_n_ddot), at_b),
            omega_dot: components(omega_dot),
        }),
    }
}

/// The acceleration of the frame K of a mount, expressed in K, (F8).
pub(crate) fn accelerated<M: ModalStorage, T: Scalar>(
    motion: &MountMotion<T>,
    hub: &Solution<T>,
    constants: &MountConstants<M, T>,
    eta_ddot: &[T],
) -> Solution<T> {
    let shape: Six<T> = combined(constants.shapes.as_ref(), eta_ddot);
    let of_hub = motion.of_hub.times(&joined(hub.r_b_n_ddot, hub.omega_dot));
    let of_shape = motion.of_shape.times(&shape);
    let mut sum = motion.bias;
    for (to, (a, b)) in sum.iter_mut().zip(of_hub.into_iter().zip(of_shape)) {
        *to = a + (b + *to);
    }
    let (r_b_n_ddot, omega_dot) = parted(&sum);
    Solution { r_b_n_ddot, omega_dot }
}
