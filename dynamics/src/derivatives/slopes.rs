//! [`Slopes`]: how the slopes of the states change, from what the accelerations change by.
//!
//! The slope of the position is the velocity, that of the attitude `-omega x dtheta + domega`, that of a coordinate its
//! rate; the others are accelerations, that of B expressed in N, so that it changes with the attitude.

use alloc::vec::Vec;

use crate::attitude::parameterisation::Attitude;
use crate::derivatives::structure::StructureDerivatives;
use crate::derivatives::variable::{Axis, Variable};
use crate::model::mode::{HubMode, Mode};
use crate::numbers::each::Each;
use crate::numbers::real::{Scalar, one, zero};
use crate::numbers::vec3::{Columns, Vec3, add, columns, components, cross, rotate_transposed};
use crate::sets::devices::Devices;
use crate::solve::inputs::Inputs;
use crate::solve::spacecraft::Spacecraft;
use crate::solve::state::{Accelerations, State};

/// Rows of the hub's state: position, attitude, velocity, angular velocity.
pub(crate) const OF_HUB: usize = 12;

/// What the slopes at a state depend on, and the order of the states.
#[derive(Debug)]
pub(crate) struct Slopes<T> {
    bn: Columns<T>,
    pub(crate) omega: Vec3<T>,
    r_b_n_ddot: Vec3<T>,
    /// Whether the hub moves: its rows are before those of the joints.
    pub(crate) hub: bool,
    /// The joints that are not locked: their coordinates, then their rates are states.
    pub(crate) moving: Vec<usize>,
    pub(crate) joints: usize,
    /// Modal coordinates are states after those of the joints, and then their rates.
    pub(crate) modes: usize,
}

/// A column in the rows of the accelerations, as they are in `c`, taken apart.
pub(crate) struct Rows<'a, T> {
    pub(crate) r_b_n_ddot: Vec3<T>,
    pub(crate) omega_dot: Vec3<T>,
    pub(crate) joints: &'a [T],
    pub(crate) modes: &'a [T],
}

/// A column in the rows of the states, taken apart; the hub's are none where it is fixed.
pub(crate) struct StateRows<'a, T> {
    pub(crate) hub: Option<[&'a mut Vec3<T>; 4]>,
    pub(crate) coordinates: &'a mut [T],
    pub(crate) rates: &'a mut [T],
    pub(crate) modes: &'a mut [T],
    pub(crate) modal_rates: &'a mut [T],
}

impl<T: Scalar> Slopes<T> {
    pub(crate) fn new<D: Devices<Scalar = T>, A: Attitude<T>, S: StructureDerivatives>(
        craft: &Spacecraft<D, S>,
        state: &State<D, A, S>,
        inputs: &Inputs<D, S>,
        accelerations: &Accelerations<D, S>,
    ) -> Self {
        let modes = inputs.modes.values().enumerate();
        let mut found = Self {
            bn: columns(&state.attitude.dcm()),
            omega: components(&state.omega),
            r_b_n_ddot: components(&accelerations.r_b_n_ddot),
            hub: !matches!(inputs.hub, HubMode::Fixed),
            moving: Vec::with_capacity(inputs.modes.values().count()),
            joints: inputs.modes.values().count(),
            modes: S::modes(craft),
        };
        found.moving.extend(modes.filter(|(_, mode)| *mode != Mode::Locked).map(|(k, _)| k));
        found
    }

    /// The rows of a column of accelerations; what else is differentiated comes after them.
    pub(crate) fn rows<'a>(&self, column: &'a [T]) -> Option<Rows<'a, T>> {
        let (r_b_n_ddot, rest) = column.split_first_chunk::<3>()?;
        let (omega_dot, rest) = rest.split_first_chunk::<3>()?;
        let (joints, rest) = rest.split_at_checked(self.joints)?;
        let modes = rest.get(..self.modes)?;
        Some(Rows { r_b_n_ddot: *r_b_n_ddot, omega_dot: *omega_dot, joints, modes })
    }

    /// The rows of a column of states.
    pub(crate) fn state_rows<'a>(&self, column: &'a mut [T]) -> Option<StateRows<'a, T>> {
        let (hub, rest) = column.split_at_mut_checked(if self.hub { OF_HUB } else { 0 })?;
        let (coordinates, rest) = rest.split_at_mut_checked(self.moving.len())?;
        let (rates, rest) = rest.split_at_mut_checked(self.moving.len())?;
        let (modes, modal_rates) = rest.split_at_mut_checked(self.modes)?;
        let hub = match hub.as_chunks_mut::<3>().0 {
            [position, attitude, velocity, omega] => Some([position, attitude, velocity, omega]),
            _ => None,
        };
        Some(StateRows { hub, coordinates, rates, modes, modal_rates })
    }

    /// The change of the acceleration of B, N axes, where the attitude changes by a small rotation.
    pub(crate) fn in_n(&self, r_b_n_ddot: Vec3<T>, attitude: Vec3<T>) -> Vec3<T> {
        rotate_transposed(&self.bn, add(r_b_n_ddot, cross(attitude, self.r_b_n_ddot)))
    }

    /// The slopes of the rates of joints from the accelerations.
    pub(crate) fn of_rates(&self, joints: &[T], rates: &mut [T]) {
        if rates.len() == joints.len() {
            rates.copy_from_slice(joints);
            return;
        }
        for (rate, joint) in rates.iter_mut().zip(&self.moving) {
            *rate = joints.get(*joint).copied().unwrap_or_else(zero);
        }
    }

    /// The column of a variable into `slopes`, from that of the accelerations; whether the hub's are finite.
    pub(crate) fn fill(&self, by: Variable, accelerations: &[T], slopes: &mut [T]) -> bool {
        let unit = |axis: Axis| Axis::ALL.map(|other| if other == axis { one() } else { zero() });
        let Some(from) = self.rows(accelerations) else { return true };
        let Some(to) = self.state_rows(slopes) else { return true };
        let mut finite = true;
        if let Some([position, attitude, velocity, omega]) = to.hub {
            let (mut moves, mut turns, mut turned) = ([zero(); 3], [zero(); 3], [zero(); 3]);
            match by {
                Variable::Velocity(axis) => moves = unit(axis),
                Variable::Attitude(axis) => {
                    turned = unit(axis);
                    turns = cross(turned, self.omega);
                }
                Variable::Omega(axis) => turns = unit(axis),
                _ => {}
            }
            (*position, *attitude, *omega) = (moves, turns, from.omega_dot);
            *velocity = self.in_n(from.r_b_n_ddot, turned);
            finite = velocity.iter().all(|number| number.is_finite());
        }
        to.coordinates.fill(zero());
        to.modes.fill(zero());
        self.of_rates(from.joints, to.rates);
        to.modal_rates.copy_from_slice(from.modes);
        let moved = match by {
            Variable::Rate(joint) => {
                let place = self.moving.iter().position(|moving| *moving == joint);
                place.and_then(|place| to.coordinates.get_mut(place))
            }
            Variable::ModalRate(mode) => to.modes.get_mut(mode),
            _ => None,
        };
        if let Some(moved) = moved {
            *moved = one();
        }
        finite
    }
}
