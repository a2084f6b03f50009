//! [`Couplings`]: on which states and inputs the derivative of each state depends, whatever the parameters are.
//!
//! A uniform field accelerates a free spacecraft as a whole: neither it nor the attitude is in the equations of the angular
//! velocity and of the joints. A joint that is locked, or whose rate its kind keeps, has no acceleration.

use precess_dynamics::{Gravity, HubMode};

use super::layout::{HUB_INPUTS, HUB_STATES, Layout};
use crate::scenario::{Drive, Scenario, Target, WrenchAxes};

const POSITION: std::ops::Range<usize> = 0..3;
const ATTITUDE: std::ops::Range<usize> = 6..10;
const OMEGA: std::ops::Range<usize> = 10..13;

/// What gives the rate of a joint.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Given {
    /// The equations of motion.
    Equations,
    /// Nothing: it is constant.
    Kept,
    /// It is locked.
    Locked,
    /// An input, by its number.
    Input(usize),
}

/// What couples the states of a spacecraft.
#[derive(Clone, Debug)]
pub(super) struct Couplings {
    layout: Layout,
    hub: HubMode,
    gravity: Gravity,
    joints: Vec<(Given, bool)>,
    /// Of each wrench whether it acts on the hub, and whether along N.
    wrenches: Vec<(bool, bool)>,
}

impl Couplings {
    pub(super) fn new(scenario: &Scenario, layout: &Layout) -> Self {
        let joints = scenario.joints().zip(&scenario.drives).zip(&layout.motors);
        let joints = joints.map(|(((.., info), drive), input)| {
            let given = match (info.driven, drive, input) {
                (false, ..) => Given::Kept,
                (true, Drive::Acceleration(_), Some(input)) => Given::Input(*input),
                (true, Drive::Torque { .. }, _) => Given::Equations,
                (true, ..) => Given::Locked,
            };
            (given, info.ignorable)
        });
        let wrench = |of: &crate::scenario::AppliedWrench| {
            (!matches!(of.body, Target::Joint(_)), of.axes == WrenchAxes::Inertial)
        };
        Self {
            layout: layout.clone(),
            hub: scenario.hub_mode,
            gravity: scenario.gravity,
            joints: joints.collect(),
            wrenches: scenario.wrenches.iter().map(wrench).collect(),
        }
    }

    /// The places on which the derivative of a state depends, in order, and whether it depends on parameters.
    pub(super) fn of_derivative(&self, state: usize) -> (Vec<usize>, bool) {
        let count = self.joints.len();
        let own = |states: &[usize]| states.iter().map(|of| Layout::state(*of)).collect();
        match state {
            // A hub that is fixed is at rest.
            0..=9 if self.hub == HubMode::Fixed => (Vec::new(), false),
            // Velocity.
            0..=2 => (own(&[state + 3]), false),
            3..=5 => {
                let is_free = self.hub == HubMode::Free;
                let mut all: Vec<usize> = ATTITUDE.map(Layout::state).collect();
                if is_free {
                    all.extend(self.of_motion());
                } else {
                    all.extend((0..3).map(|axis| self.layout.input(axis)));
                }
                (sorted(all), is_free)
            }
            // A quaternion's rate has the other three components.
            6..=9 => (
                sorted(
                    ATTITUDE.chain(OMEGA).filter(|of| *of != state).map(Layout::state).collect(),
                ),
                false,
            ),
            10..=12 => match self.hub {
                HubMode::Fixed => (Vec::new(), false),
                HubMode::Prescribed { .. } => (vec![self.layout.input(state - 7)], false),
                HubMode::Free => (sorted(self.of_motion()), true),
            },
            _ => {
                let joint = state - HUB_STATES;
                if joint < count {
                    let is_locked =
                        self.joints.get(joint).is_some_and(|(of, _)| *of == Given::Locked);
                    if is_locked {
                        return (Vec::new(), false);
                    }
                    return (own(&[state + count]), false);
                }
                match self.joints.get(joint - count) {
                    Some((Given::Input(input), _)) => {
                        (vec![self.layout.input(HUB_INPUTS + input)], false)
                    }
                    Some((Given::Equations, _)) => (sorted(self.of_motion()), true),
                    _ => (Vec::new(), false),
                }
            }
        }
    }

    /// What the accelerations of the equations of motion depend on.
    fn of_motion(&self) -> Vec<usize> {
        let is_free = self.hub == HubMode::Free;
        let central = matches!(self.gravity, Gravity::Central { .. });
        let falls = self.gravity == Gravity::None || (is_free && !central);
        let turned = is_free && self.wrenches.contains(&(true, true));
        let mut all = Vec::new();
        if central {
            all.extend(POSITION.map(Layout::state));
        }
        if !falls || turned {
            all.extend(ATTITUDE.map(Layout::state));
        }
        if self.hub != HubMode::Fixed {
            all.extend(OMEGA.map(Layout::state));
            all.extend((0..HUB_INPUTS).map(|input| self.layout.input(input)));
        }
        let count = self.joints.len();
        for (joint, (given, ignorable)) in self.joints.iter().enumerate() {
            // A spring acts on a joint that is free.
            if !ignorable || *given == Given::Equations {
                all.push(Layout::state(HUB_STATES + joint));
            }
            if *given != Given::Locked {
                all.push(Layout::state(HUB_STATES + count + joint));
            }
        }
        for input in self.layout.motors.iter().flatten() {
            all.push(self.layout.input(HUB_INPUTS + input));
        }
        for (index, (on_hub, _)) in self.wrenches.iter().enumerate() {
            if is_free || !on_hub {
                let first = self.layout.wrench(index);
                all.extend(first..first + 6);
            }
        }
        all
    }
}

fn sorted(mut places: Vec<usize>) -> Vec<usize> {
    places.sort_unstable();
    places.dedup();
    places
}
