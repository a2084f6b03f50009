//! Servo: motor torques for commanded rates and accelerations.

use crate::attitude::parameterisation::Attitude;
use crate::equations::device::Device;
use crate::equations::error::{Quantity, SolveError};
use crate::equations::joint_inputs::Environment;
use crate::equations::load_sums::HubAccelerations;
use crate::isolation::carrier::Carrier;
use crate::model::kind::Kind;
use crate::model::mode::Mode;
use crate::numbers::each::{Each, JointStates};
use crate::numbers::real::{Scalar, zero};
use crate::numbers::vec3::{columns, components};
use crate::results::loads::base;
use crate::sets::bundle::{Bundle, Given, Shared};
use crate::sets::carrying::{Carrying, PreparedCarrying};
use crate::sets::devices::{DeviceSet, Devices, Visit};
use crate::sets::per_device as data;
use crate::solve::inputs::Inputs;
use crate::solve::spacecraft::Spacecraft;
use crate::solve::state::{Accelerations, State};
use crate::steering::error::{SteeringError, finite};
use crate::steering::matrix::Steered;

/// Gains and limits of the motors of `N` joints.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Servo<T, const N: usize> {
    /// What is commanded of each joint.
    pub steered: [Steered; N],
    /// Rate feedback, 1/s: the acceleration of a gimbal is `gain (commanded rate - rate)` and its feed-forward.
    pub gains: [T; N],
    /// Largest torque of each motor, N m (force, N); infinite where there is none.
    pub limits: [T; N],
}

/// What a servo demands of the motors.
#[derive(Clone, Debug, PartialEq)]
pub struct ServoTorques<D: Devices, const N: usize> {
    /// Motor torques within their limits, N m (N); of a joint that is not commanded that of the inputs.
    pub torques: [D::Scalar; N],
    /// How many are at their limit.
    pub limited: usize,
    /// What accelerates where no torque is limited.
    pub accelerations: Accelerations<D>,
}

impl<D: Devices> Spacecraft<D> {
    /// Motor torques for commands: rates of gimbals, accelerations of wheels. By an evaluation in which the commanded
    /// joints have their accelerations prescribed, and inverse dynamics of its accelerations: coupling, imbalance, springs and
    /// friction are compensated as far as the model has them.
    ///
    /// A commanded joint is prescribed whatever mode the inputs have for it: to apply its torque, drive it.
    ///
    /// `feed_forward` is the derivative of each commanded rate, rad/s². Forces, gravity and the modes of joints that
    /// are not commanded are those of `inputs`.
    ///
    /// # Errors
    ///
    /// [`SteeringError::Joints`], [`SteeringError::Platform`], [`SteeringError::Argument`], and those of
    /// [`Self::accelerations`].
    pub fn servo<A: Attitude<D::Scalar>, const N: usize>(
        &self,
        servo: &Servo<D::Scalar, N>,
        state: &State<D, A>,
        inputs: &Inputs<D>,
        commands: &[D::Scalar; N],
        feed_forward: &[D::Scalar; N],
    ) -> Result<ServoTorques<D, N>, SteeringError<D::Scalar>> {
        self.reject_joints(N)?;
        finite("command", *commands)?;
        finite("feed-forward", *feed_forward)?;
        finite("gain", servo.gains)?;
        for (index, limit) in servo.limits.iter().enumerate() {
            // False of NaN too; an infinite limit is none.
            let sound = *limit >= zero();
            if !sound {
                return Err(SteeringError::Argument { what: "torque limit", index, value: *limit });
            }
        }
        let mut prescribed = inputs.clone();
        let wanted = servo.steered.iter().zip(servo.gains).zip(commands.iter().zip(feed_forward));
        let joints = prescribed.modes.values_mut().zip(state.devices.states());
        for ((mode, [_, rate]), ((steered, gain), (command, forward))) in joints.zip(wanted) {
            match steered {
                Steered::Rate => *mode = Mode::Prescribed(*forward + gain * (*command - rate)),
                Steered::Acceleration => *mode = Mode::Prescribed(*command),
                Steered::Nothing => {}
            }
        }
        let accelerations = self.accelerations(state, &prescribed)?;
        let bn = columns(&state.attitude.dcm());
        let field = prescribed.gravity.field(&bn, &state.r_b_n);
        let (environment, hub) = base(components(&state.omega), &accelerations, field.as_ref());
        let mut motors = Motors {
            environment: &environment,
            hub: &hub,
            joint: 0,
            device: 0,
            torques: [zero(); N],
        };
        let data = (&state.devices, prescribed.of_joints(), &accelerations.devices);
        D::visit::<Moving, _>(&self.devices, data, &mut motors)?;
        if let Some(joint) = motors.torques.iter().position(|torque| !torque.is_finite()) {
            let failure = self.overflow(joint);
            return Err(self.diagnosis(state, &prescribed, failure).into());
        }
        let (mut torques, mut limited) = (motors.torques, 0);
        let given = inputs.motors.values();
        let joints = torques.iter_mut().zip(servo.limits).zip(servo.steered);
        for (((torque, limit), steered), given) in joints.zip(given) {
            if steered == Steered::Nothing {
                *torque = given;
            } else if torque.abs() > limit {
                *torque = if *torque < zero() { -limit } else { limit };
                limited += 1;
            }
        }
        Ok(ServoTorques { torques, limited, accelerations })
    }

    /// The error of a torque that is not finite.
    fn overflow(&self, joint: usize) -> SolveError<D::Scalar> {
        let what = self.joints().nth(joint).map_or(Quantity::HubLoad, |(device, info)| {
            Quantity::Load { device, joint: info.body }
        });
        SolveError::Overflow { what }
    }
}

/// State, inputs and accelerations of the joints.
type Moving = (Shared<data::Joints>, Given, Shared<data::Accelerations>);

/// The motor torques of each device.
struct Motors<'a, T, const N: usize> {
    environment: &'a Environment<T>,
    hub: &'a HubAccelerations<T>,
    joint: usize,
    device: usize,
    torques: [T; N],
}

impl<T: Scalar, const N: usize> Visit<T, Moving> for Motors<'_, T, N> {
    type Error = SteeringError<T>;

    fn visit<K: Kind<Scalar = T>>(
        &mut self,
        device: &Device<K>,
        (joints, given, accelerations): <Moving as Bundle<T>>::Of<'_, K>,
    ) -> Result<(), SteeringError<T>> {
        let bodies = given.bodies;
        let torques =
            device.motor_torques(joints, bodies, self.environment, self.hub, accelerations);
        for motor in torques.values() {
            if let Some(torque) = self.torques.get_mut(self.joint) {
                *torque = motor;
            }
            self.joint = self.joint.wrapping_add(1);
        }
        self.device = self.device.wrapping_add(1);
        Ok(())
    }

    fn visit_carrying<C: Carrier<Scalar = T>, D: DeviceSet<Scalar = T>>(
        &mut self,
        _: &PreparedCarrying<C, D>,
        _: <Moving as Bundle<T>>::Of<'_, Carrying<C, D>>,
    ) -> Result<(), SteeringError<T>> {
        Err(SteeringError::Platform { device: self.device })
    }
}
