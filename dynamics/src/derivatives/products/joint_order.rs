//! [`HubDirection`], [`HubGradient`]: what lists in the order of [`Spacecraft::state_variables`] and
//! [`Spacecraft::input_variables`] have of the hub; of the joints it goes to data of the set and back.
//!
//! Of a rigid hub without wrenches on bodies: there are no other variables.

use crate::derivatives::structure::StructureDerivatives;
use crate::model::mode::{HubMode, Mode};
use crate::numbers::each::{Each, JointStates};
use crate::numbers::vec3::{Vec3, zeros};
use crate::sets::devices::Devices;
use crate::sets::per_device as data;
use crate::solve::inputs::Inputs;
use crate::solve::spacecraft::Spacecraft;

/// A direction of the hub, B axes.
#[derive(Clone, Copy, Debug)]
pub(crate) struct HubDirection<T> {
    pub(crate) attitude: Vec3<T>,
    pub(crate) omega: Vec3<T>,
    /// Of force and torque of a free hub, of the accelerations of a prescribed one.
    pub(crate) given: [Vec3<T>; 2],
}

/// A gradient by what the hub has, B axes. By position and velocity of B it is zero.
#[derive(Clone, Copy, Debug)]
pub(crate) struct HubGradient<T> {
    pub(crate) attitude: Vec3<T>,
    pub(crate) omega: Vec3<T>,
    pub(crate) given: [Vec3<T>; 2],
}

impl<D: Devices, S: StructureDerivatives> Spacecraft<D, S> {
    /// A direction, that of the joints into coordinates, rates, and motor torques or given accelerations.
    pub(crate) fn scattered(
        &self,
        inputs: &Inputs<D, S>,
        (states, by_inputs): (&[D::Scalar], &[D::Scalar]),
        joints: &mut D::Per<data::Joints>,
        driven: &mut D::Per<data::Accelerations>,
    ) -> HubDirection<D::Scalar> {
        let (of_hub, acting) = of_hub(inputs);
        let (hub, of_joints) = states.split_at_checked(of_hub).unwrap_or_default();
        let (given, of_motors) = by_inputs.split_at_checked(acting).unwrap_or_default();
        let three = |list: &[D::Scalar], place: usize| {
            list.as_chunks::<3>().0.get(place).copied().unwrap_or_else(zeros)
        };
        let half = of_joints.len() / 2;
        let (coordinates, rates) = of_joints.split_at_checked(half).unwrap_or_default();
        let mut moving = coordinates.iter().zip(rates);
        let mut motors = of_motors.iter();
        let modes = inputs.modes.values().zip(self.joints());
        let each = joints.states_mut().zip(driven.values_mut()).zip(modes);
        for (([coordinate, rate], driven), (mode, (_, info))) in each {
            if mode != Mode::Locked
                && let Some((q, q_dot)) = moving.next()
            {
                (*coordinate, *rate) = (*q, *q_dot);
            }
            if is_input(&mode, info.driven)
                && let Some(motor) = motors.next()
            {
                *driven = *motor;
            }
        }
        HubDirection {
            attitude: three(hub, 1),
            omega: three(hub, 3),
            given: [three(given, 0), three(given, 1)],
        }
    }

    /// A gradient into the lists.
    pub(crate) fn gathered(
        &self,
        inputs: &Inputs<D, S>,
        of: &HubGradient<D::Scalar>,
        joints: &D::Per<data::Joints>,
        driven: &D::Per<data::Accelerations>,
        (states, by_inputs): (&mut [D::Scalar], &mut [D::Scalar]),
    ) {
        let (of_hub, acting) = of_hub(inputs);
        let (hub, of_joints) = states.split_at_mut_checked(of_hub).unwrap_or_default();
        let (given, of_motors) = by_inputs.split_at_mut_checked(acting).unwrap_or_default();
        let threes = [zeros(), of.attitude, zeros(), of.omega];
        hub.as_chunks_mut::<3>().0.iter_mut().zip(threes).for_each(|(to, from)| *to = from);
        given.as_chunks_mut::<3>().0.iter_mut().zip(of.given).for_each(|(to, from)| *to = from);
        let half = of_joints.len() / 2;
        let (coordinates, rates) = of_joints.split_at_mut_checked(half).unwrap_or_default();
        let mut moving = coordinates.iter_mut().zip(rates);
        if all_driven(inputs) {
            moving.zip(joints.states()).for_each(|((q, q_dot), [coordinate, rate])| {
                (*q, *q_dot) = (coordinate, rate);
            });
            of_motors.iter_mut().zip(driven.values()).for_each(|(motor, driven)| *motor = driven);
            return;
        }
        let mut motors = of_motors.iter_mut();
        let modes = inputs.modes.values().zip(self.joints());
        let each = joints.states().zip(driven.values()).zip(modes);
        for (([coordinate, rate], driven), (mode, (_, info))) in each {
            if mode != Mode::Locked
                && let Some((q, q_dot)) = moving.next()
            {
                (*q, *q_dot) = (coordinate, rate);
            }
            if is_input(&mode, info.driven)
                && let Some(motor) = motors.next()
            {
                *motor = driven;
            }
        }
    }
}

/// Whether every joint is driven: two states and an input.
pub(crate) fn all_driven<D: Devices, S: StructureDerivatives>(inputs: &Inputs<D, S>) -> bool {
    inputs.modes.values().all(|mode| mode == Mode::Driven)
}

/// How many of the states, and of the inputs, are the hub's.
fn of_hub<D: Devices, S: StructureDerivatives>(inputs: &Inputs<D, S>) -> (usize, usize) {
    if matches!(inputs.hub, HubMode::Fixed) { (0, 0) } else { (12, 6) }
}

/// Whether a joint has an input.
fn is_input<T>(mode: &Mode<T>, driven: bool) -> bool {
    match mode {
        Mode::Driven => true,
        Mode::Prescribed(_) => driven,
        Mode::Locked => false,
    }
}
