//! Loads: the force and torque across every joint and at every mount, the motor torques, and the
//! wrench that the hub needs, for given accelerations. Inverse dynamics is the same question.
//!
//! The paper names these structural torques in (77), (98), (116) and never solves for them. Each
//! joint carries what all bodies outward of it need, by Newton and Euler, less what acts on them
//! from outside. Gravity's uniform part is a change of frame: accelerations are counted in the frame
//! that falls with it.

use crate::attitude::parameterisation::Attitude;
use crate::model::spacecraft::Spacecraft;
use crate::model::wrench::Wrench;
use crate::numbers::real::{Scalar, zero};
use crate::numbers::symmetric::Symmetric;
use crate::numbers::vec3::{Columns, Vec3, columns, components, sub};
use crate::sets::devices::{Around, Devices, Given};
use crate::solve::error::{Quantity, SolveError};
use crate::solve::gravity::{Field, at_b};
use crate::solve::inputs::Inputs;
use crate::solve::state::{Accelerations, State};

/// The axes along which the loads of joints are told.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum LoadAxes {
    /// Those of the body behind the joint. A rotor that is the same from every angle has those of
    /// what carries it.
    #[default]
    Body,
    /// Those of what carries it; of a first joint, the device's at zero angle.
    Carrier,
    /// B.
    Hub,
    /// N.
    Inertial,
}

/// The loads of a spacecraft.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Loads<D: Devices> {
    /// Device by device; a [`DeviceLoads`] for each.
    pub devices: D::Loads,
    /// What must act on the hub beside the inputs, about B along B axes: nothing but rounding on a
    /// free hub with its own accelerations; on a [fixed](crate::HubMode::Fixed) one, what the table
    /// exerts on it. A dynamometer reads the opposite.
    pub hub: Wrench<D::Scalar>,
}

/// The loads of one device; `W` has a wrench, `U` a number, `P` a [`JointPower`] per joint.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DeviceLoads<W, U, P, T> {
    /// What the hub exerts on the device at its mount, about the origin of its first joint where it
    /// stands now (of a sliding joint it moves along); along N axes if the joints' loads are,
    /// otherwise along B axes. About another point: [`Wrench::moved`].
    pub mount: Wrench<T>,
    /// What its carrier exerts on the body behind each joint, motor, spring and friction included,
    /// about the joint's origin, along the axes asked for.
    pub joints: W,
    /// The motor torque, N m (force, N, of a sliding joint), that each joint's acceleration needs:
    /// the load about its axis less spring and friction. (80), (101), (119).
    pub motors: U,
    /// The power of each joint's motor, spring and friction: the ledger's sums one by one.
    pub powers: P,
}

/// What acts at one joint, as power on the spacecraft's motion, W.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct JointPower<T = f64> {
    /// Of the motor: with the torque that is given, or the one that is found.
    pub motor: T,
    /// Of the spring.
    pub spring: T,
    /// Of friction; not above zero.
    pub friction: T,
}

impl<T: Scalar> JointPower<T> {
    /// Nothing acts.
    pub(crate) fn none() -> Self {
        Self { motor: zero(), spring: zero(), friction: zero() }
    }

    /// Whether all three are finite.
    pub(crate) fn is_finite(&self) -> bool {
        [self.motor, self.spring, self.friction].into_iter().all(Scalar::is_finite)
    }
}

/// Axes for the loads of joints.
#[derive(Clone, Copy, Debug)]
pub enum Along<T> {
    /// The body's own.
    Body,
    /// The carrier's.
    Carrier,
    /// Those along which B axes are the columns; none for B axes themselves.
    Hub(Option<Columns<T>>),
}

/// How the hub moves, along B axes, seen from a frame that falls with gravity.
#[derive(Clone, Copy, Debug)]
pub struct HubMotion<T> {
    pub(crate) r_b_n_ddot: Vec3<T>,
    pub(crate) omega_dot: Vec3<T>,
}

/// What the devices ask of the hub and what their joints transmit, added up.
#[derive(Clone, Copy, Debug)]
pub struct Totals<T> {
    /// What the devices need for their accelerations, about B along B axes.
    pub(crate) inertial: Wrench<T>,
    /// What acts on their bodies from outside.
    pub(crate) applied: Wrench<T>,
    /// What the gradient of gravity exerts on them.
    pub(crate) gradient: Wrench<T>,
    /// Second moment about B; only with a central field.
    pub(crate) second_moment: Symmetric<T>,
    /// Powers of the joints.
    pub(crate) power: JointPowers<T>,
    /// How many joints have been added.
    pub(crate) joints: usize,
    /// The first joint of a device whose loads, motor torques or powers are not all finite.
    pub(crate) overflow: Option<usize>,
}

/// Powers at the joints, W: the part of each source that the joints' rates take up.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct JointPowers<T> {
    pub(crate) inertial: T,
    pub(crate) applied: T,
    pub(crate) gradient: T,
    pub(crate) motors: T,
    pub(crate) springs: T,
    pub(crate) friction: T,
    /// Energy of the springs, J.
    pub(crate) stored: T,
    /// Sum of the powers' magnitudes.
    pub(crate) magnitude: T,
}

impl<T: Scalar> JointPowers<T> {
    fn none() -> Self {
        Self {
            inertial: zero(),
            applied: zero(),
            gradient: zero(),
            motors: zero(),
            springs: zero(),
            friction: zero(),
            stored: zero(),
            magnitude: zero(),
        }
    }
}

impl<T: Scalar> Totals<T> {
    pub(crate) fn none() -> Self {
        let none = Wrench::none();
        let power = JointPowers::none();
        let second_moment = Symmetric::zero();
        Self {
            inertial: none,
            applied: none,
            gradient: none,
            second_moment,
            power,
            joints: 0,
            overflow: None,
        }
    }
}

impl<D: Devices> Spacecraft<D> {
    /// The loads that these accelerations need: inverse dynamics.
    ///
    /// With what [`Self::accelerations`] found for the same state and inputs, these are the loads at
    /// that instant, and prescribed and locked joints find the torque they need in
    /// [`DeviceLoads::motors`]. With accelerations that are wished for, they are the motor torques
    /// and the wrench on the hub that fulfil the wish. Motor torques and modes in `inputs` are not
    /// asked; forces, torques and gravity are.
    ///
    /// # Errors
    ///
    /// [`SolveError::NotFinite`] naming an input or acceleration, [`SolveError::Overflow`],
    /// [`SolveError::Count`] for a list of another length.
    pub fn loads<A: Attitude<D::Scalar>>(
        &self,
        state: &State<D, A>,
        inputs: &Inputs<D>,
        accelerations: &Accelerations<D>,
        axes: LoadAxes,
    ) -> Result<Loads<D>, SolveError<D::Scalar>> {
        self.refuse(state, inputs)?;
        self.refuse_accelerations(state, accelerations)?;
        let bn = columns(&state.attitude.dcm());
        let along = match axes {
            LoadAxes::Body => Along::Body,
            LoadAxes::Carrier => Along::Carrier,
            LoadAxes::Hub => Along::Hub(None),
            LoadAxes::Inertial => Along::Hub(Some(bn)),
        };
        let field = inputs.gravity.field(&bn, &state.r_b_n);
        let (devices, hub, totals) =
            self.weigh(state, inputs, accelerations, field.as_ref(), &along);
        let finite = self.check_joints(&totals).and_then(|()| {
            let what = Quantity::HubLoad;
            if hub.is_finite() { Ok(()) } else { Err(SolveError::Overflow { what }) }
        });
        match finite {
            Ok(()) => Ok(Loads { devices, hub }),
            Err(failure) => Err(self.diagnosis(state, inputs, failure)),
        }
    }

    /// Rejects loads of a joint that are not finite.
    pub(crate) fn check_joints(
        &self,
        totals: &Totals<D::Scalar>,
    ) -> Result<(), SolveError<D::Scalar>> {
        let joint = totals.overflow.and_then(|joint| self.joints().nth(joint));
        joint.map_or(Ok(()), |(device, info)| {
            Err(SolveError::Overflow { what: Quantity::Load { device, joint: info.body } })
        })
    }

    /// Loads of the devices, what the hub needs beside the inputs, and the sums of both.
    pub(crate) fn weigh<A>(
        &self,
        state: &State<D, A>,
        inputs: &Inputs<D>,
        accelerations: &Accelerations<D>,
        field: Option<&Field<D::Scalar>>,
        along: &Along<D::Scalar>,
    ) -> (D::Loads, Wrench<D::Scalar>, Totals<D::Scalar>) {
        let omega = components(&state.omega);
        let falling = at_b(field);
        let hub = HubMotion {
            r_b_n_ddot: sub(components(&accelerations.r_b_n_ddot), falling),
            omega_dot: components(&accelerations.omega_dot),
        };
        let central = field.and_then(|field| field.central);
        let around = Around { omega, central, impulse: false };
        let given = Given::of(inputs);
        let mut devices = D::no_loads_for(&self.devices);
        let mut totals = Totals::none();
        D::loads(
            &self.devices,
            &state.devices,
            given,
            &around,
            &hub,
            &accelerations.devices,
            along,
            &mut devices,
            &mut totals,
        );
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
}
