//! Loads: the force and torque across every joint and at every mount, the motor torques, and the
//! wrench that the hub needs, for known accelerations: inverse dynamics.
//!
//! The paper names these structural torques in (77), (98), (116) and never solves for them. The
//! load of a joint is what all bodies outboard of it need, by Newton and Euler, less the external
//! wrenches on them. Gravity's uniform part is a change of frame: accelerations are counted in the
//! frame that falls with it.

use core::convert::Infallible;

use crate::attitude::parameterisation::Attitude;
use crate::equations::device::Device;
use crate::equations::error::{Quantity, SolveError};
use crate::equations::gravity::{Field, at_b};
use crate::equations::joint_inputs::Environment;
use crate::equations::load_sums::{Along, HubAccelerations, LoadSums};
use crate::isolation::carrier::Carrier;
use crate::model::kind::Kind;
use crate::model::wrench::Wrench;
use crate::numbers::real::{Scalar, zero};
use crate::numbers::vec3::{Vec3, columns, components, sub};
use crate::results::carried_loads::CarriedLoads;
use crate::results::structure::StructureResults;
use crate::sets::bundle::{Bundle, Given, Shared, Unique};
use crate::sets::carrying::{Carrying, PreparedCarrying, parts};
use crate::sets::devices::{DeviceSet, Devices, Visit};
use crate::sets::per_device as data;
use crate::solve::inputs::Inputs;
use crate::solve::spacecraft::Spacecraft;
use crate::solve::state::{Accelerations, State};
use crate::solve::structure::{Rigid, StructureData};

/// Loads of the devices, what the hub needs beside the inputs, and the sums of both.
type Weights<D> = (
    <D as DeviceSet>::Per<data::Loads>,
    Wrench<<D as DeviceSet>::Scalar>,
    LoadSums<<D as DeviceSet>::Scalar>,
);

/// The axes in which the loads of joints are expressed.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum LoadAxes {
    /// Those of the child body of the joint. A rotor that is the same from every angle has those of
    /// its parent body.
    #[default]
    Body,
    /// Those of its parent body; of a first joint, the device's at zero angle.
    Parent,
    /// B.
    Hub,
    /// N.
    Inertial,
}

/// The loads of a spacecraft.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Loads<D: Devices, S: StructureData = Rigid> {
    /// Device by device; a [`DeviceLoads`](crate::DeviceLoads) for each.
    ///
    /// On a flexible structure the wrench at a device's mount is about its place on the deformed
    /// structure: its parameters say where that is in the axes of the mount, which are those of B
    /// undeformed. It is expressed in N with [`LoadAxes::Inertial`], otherwise in B, as on a rigid hub.
    pub devices: D::Per<data::Loads>,
    /// What must act on the hub in addition to the inputs, about B, expressed in B: only rounding
    /// on a free hub with its own accelerations; on a [fixed](crate::HubMode::Fixed) one, what the
    /// table exerts on it. A dynamometer reads the opposite.
    pub hub: Wrench<D::Scalar>,
    /// Loads of the mounts and modes of a flexible structure; `()` of a rigid hub.
    pub modal: S::Loads<D::Scalar>,
}

/// State, inputs and accelerations of the joints, and the loads that come of them.
pub(crate) type Weighed =
    (Shared<data::Joints>, Given, Shared<data::Accelerations>, Unique<data::Loads>);

/// The loads that the accelerations need; adds what the devices require of the hub.
pub(crate) struct Weighing<'a, T> {
    pub(crate) environment: &'a Environment<T>,
    pub(crate) hub: &'a HubAccelerations<T>,
    pub(crate) along: &'a Along<T>,
    pub(crate) totals: &'a mut LoadSums<T>,
}

impl<T: Scalar> Visit<T, Weighed> for Weighing<'_, T> {
    type Error = Infallible;

    fn visit<K: Kind<Scalar = T>>(
        &mut self,
        device: &Device<K>,
        (joints, given, accelerations, out): <Weighed as Bundle<T>>::Of<'_, K>,
    ) -> Result<(), Infallible> {
        let Self { environment, hub, along, totals } = self;
        *out = device.loads(joints, given, environment, hub, accelerations, along, totals);
        Ok(())
    }

    fn visit_carrying<C: Carrier<Scalar = T>, D: DeviceSet<Scalar = T>>(
        &mut self,
        carrying: &PreparedCarrying<C, D>,
        (joints, given, accelerations, out): <Weighed as Bundle<T>>::Of<'_, Carrying<C, D>>,
    ) -> Result<(), Infallible> {
        let Self { environment, hub, along, totals } = self;
        let carried = CarriedLoads::start(carrying, &joints.carrier, environment, hub);
        let base = carried.base(&accelerations.carrier);
        let (of_carrier, given) = parts::<T, C, D>(given);
        let joint = totals.joints.wrapping_add(C::JOINTS.len());
        let mut sums = LoadSums { joints: joint, ..LoadSums::none() };
        let mut weighing = Weighing {
            environment: &carried.environment,
            hub: &base,
            along: &carried.along(along),
            totals: &mut sums,
        };
        let data = (&joints.carried, given, &accelerations.carried, &mut out.carried);
        let Ok(()) = D::visit::<Weighed, _>(&carrying.carried, data, &mut weighing);
        let added = carried.add::<D>(carrying, &joints.carried, &mut sums, totals);
        out.carrier = carrying.carrier.device.loads_with(
            &joints.carrier,
            of_carrier,
            environment,
            hub,
            &accelerations.carrier,
            along,
            totals,
            Some(&added),
        );
        totals.joints = sums.joints;
        totals.overflow = totals.overflow.or(sums.overflow);
        Ok(())
    }
}

/// What the devices of a rigid hub are in, and how it moves.
pub(crate) fn base<D: Devices, S: StructureData>(
    omega: Vec3<D::Scalar>,
    accelerations: &Accelerations<D, S>,
    field: Option<&Field<D::Scalar>>,
) -> (Environment<D::Scalar>, HubAccelerations<D::Scalar>) {
    let hub = HubAccelerations {
        r_b_n_ddot: sub(components(&accelerations.r_b_n_ddot), at_b(field)),
        omega_dot: components(&accelerations.omega_dot),
    };
    let central = field.and_then(|field| field.central);
    (Environment { omega, central, impulse: false, reduction: None }, hub)
}

impl<D: Devices, S: StructureResults> Spacecraft<D, S> {
    /// The loads that these accelerations need: inverse dynamics.
    ///
    /// With what [`Self::accelerations`] found for the same state and inputs, these are the loads
    /// at that instant, the elastic motion of mounts included, and the torques that prescribed and locked joints need are in
    /// [`DeviceLoads::motors`](crate::DeviceLoads::motors). With desired accelerations, they are
    /// the motor torques and the wrench on the hub that produce them. Motor torques and modes in
    /// `inputs` are not read; forces, torques, modal forces and gravity are.
    ///
    /// # Errors
    ///
    /// [`SolveError::NotFinite`] naming an input or acceleration, [`SolveError::Overflow`],
    /// [`SolveError::Count`] and [`SolveError::ModalCount`] for a list of another length.
    pub fn loads<A: Attitude<D::Scalar>>(
        &self,
        state: &State<D, A, S>,
        inputs: &Inputs<D, S>,
        accelerations: &Accelerations<D, S>,
        axes: LoadAxes,
    ) -> Result<Loads<D, S>, SolveError<D::Scalar>> {
        self.reject(state, inputs)?;
        self.reject_accelerations(state, accelerations)?;
        S::loads(self, state, inputs, accelerations, axes)
            .map_err(|failure| self.diagnosis(state, inputs, failure))
    }

    /// [`Self::loads`] of a hub that does not deform.
    pub(crate) fn loads_rigid<A: Attitude<D::Scalar>>(
        &self,
        state: &State<D, A, S>,
        inputs: &Inputs<D, S>,
        accelerations: &Accelerations<D, S>,
        axes: LoadAxes,
        modal: S::Loads<D::Scalar>,
    ) -> Result<Loads<D, S>, SolveError<D::Scalar>> {
        let bn = columns(&state.attitude.dcm());
        let along = match axes {
            LoadAxes::Body => Along::Body,
            LoadAxes::Parent => Along::Parent,
            LoadAxes::Hub => Along::Hub(None),
            LoadAxes::Inertial => Along::Hub(Some(bn)),
        };
        let field = inputs.gravity.field(&bn, &state.r_b_n);
        let (devices, hub, totals) =
            self.loads_and_sums(state, inputs, accelerations, field.as_ref(), &along);
        self.check_joints(&totals)?;
        if hub.is_finite() {
            Ok(Loads { devices, hub, modal })
        } else {
            Err(SolveError::Overflow { what: Quantity::HubLoad })
        }
    }

    /// Loads of the devices, what the hub needs in addition to the inputs, and the sums of both.
    pub(crate) fn loads_and_sums<A>(
        &self,
        state: &State<D, A, S>,
        inputs: &Inputs<D, S>,
        accelerations: &Accelerations<D, S>,
        field: Option<&Field<D::Scalar>>,
        along: &Along<D::Scalar>,
    ) -> Weights<D> {
        let (environment, hub) = base(components(&state.omega), accelerations, field);
        let Environment { omega, central, .. } = environment;
        let given = inputs.of_joints();
        let mut devices = D::new_data(&self.devices, &data::Loads);
        let mut totals = LoadSums::none();
        let data = (&state.devices, given, &accelerations.devices, &mut devices);
        let mut weighing =
            Weighing { environment: &environment, hub: &hub, along, totals: &mut totals };
        let Ok(()) = D::visit::<Weighed, _>(&self.devices, data, &mut weighing);
        let own = self.hub.needs(omega, hub.r_b_n_ddot, hub.omega_dot);
        totals.inertial = totals.inertial.plus(&own);
        if let Some(central) = central {
            let second = self.hub.second_moment();
            let (force, moment) = central.wrench(self.hub.first_moment, &second);
            totals.second_moment = totals.second_moment.plus(second);
            let whole = central.third_order(&totals.second_moment);
            totals.gradient = totals.gradient.plus(&Wrench::of(force, moment));
            totals.gradient = totals.gradient.plus(&Wrench::of(whole, [zero(); 3]));
        }
        let inputs = Wrench { force: inputs.force, moment: inputs.torque_b };
        let needed = totals.inertial.minus(&totals.applied).minus(&totals.gradient).minus(&inputs);
        (devices, needed, totals)
    }

    /// Rejects loads of a joint that are not finite.
    pub(crate) fn check_joints(
        &self,
        totals: &LoadSums<D::Scalar>,
    ) -> Result<(), SolveError<D::Scalar>> {
        let joint = totals.overflow.and_then(|joint| self.joints().nth(joint));
        joint.map_or(Ok(()), |(device, info)| {
            Err(SolveError::Overflow { what: Quantity::Load { device, joint: info.body } })
        })
    }
}
