//! [`Slopes`]: how the slopes of the states change, from what the accelerations change by.
//!
//! The slope of the position is the velocity, that of the attitude `-omega x dtheta + domega`, that of a coordinate its
//! rate; the others are accelerations, that of B expressed in N, so that it changes with the attitude.

#![expect(clippy::inline_always, reason = "instructions are reached only in what is inlined")]

#[cfg(feature = "alloc")]
use nalgebra::DMatrix;

use crate::attitude::parameterisation::Attitude;
use crate::derivatives::structure::StructureDerivatives;
use crate::derivatives::variable::{Axis, Variable};
#[cfg(feature = "alloc")]
use crate::equations::arithmetic::Arithmetic;
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
pub(crate) struct Slopes<'a, T> {
    #[cfg(feature = "alloc")]
    pub(crate) by: Arithmetic,
    pub(crate) bn: Columns<T>,
    pub(crate) omega: Vec3<T>,
    r_b_n_ddot: Vec3<T>,
    /// Whether the hub moves: its rows are before those of the joints.
    pub(crate) hub: bool,
    /// The joints that are not locked: their coordinates, then their rates are states.
    pub(crate) moving: &'a [usize],
    pub(crate) joints: usize,
    /// Modal coordinates are states after those of the joints, and then their rates.
    pub(crate) modes: usize,
}

impl<'a, T: Scalar> Slopes<'a, T> {
    pub(crate) fn new<D: Devices<Scalar = T>, A: Attitude<T>, S: StructureDerivatives>(
        craft: &Spacecraft<D, S>,
        state: &State<D, A, S>,
        inputs: &Inputs<D, S>,
        accelerations: &Accelerations<D, S>,
        moving: &'a [usize],
    ) -> Self {
        Self {
            #[cfg(feature = "alloc")]
            by: craft.arithmetic,
            bn: columns(&state.attitude.dcm()),
            omega: components(&state.omega),
            r_b_n_ddot: components(&accelerations.r_b_n_ddot),
            hub: !matches!(inputs.hub, HubMode::Fixed),
            moving,
            joints: inputs.modes.values().count(),
            modes: S::modes(craft),
        }
    }

    /// The joints that are not locked.
    pub(crate) fn moving_joints<D: Devices<Scalar = T>, S: StructureDerivatives>(
        inputs: &Inputs<D, S>,
    ) -> impl Iterator<Item = usize> {
        let modes = inputs.modes.values().enumerate();
        modes.filter(|(_, mode)| *mode != Mode::Locked).map(|(joint, _)| joint)
    }

    /// The change of the acceleration of B, N axes, where the attitude changes by a small rotation.
    pub(crate) fn in_n(&self, r_b_n_ddot: Vec3<T>, attitude: Vec3<T>) -> Vec3<T> {
        rotate_transposed(&self.bn, add(r_b_n_ddot, cross(attitude, self.r_b_n_ddot)))
    }

    /// The slopes of the rates of joints from the accelerations.
    #[inline(always)]
    fn of_rates(&self, joints: &[T], rates: &mut [T]) {
        if rates.len() == joints.len() {
            rates.copy_from_slice(joints);
            return;
        }
        for (rate, joint) in rates.iter_mut().zip(self.moving) {
            *rate = joints.get(*joint).copied().unwrap_or_else(zero);
        }
    }

    /// The number of states.
    pub(crate) fn states(&self) -> usize {
        let of_hub = if self.hub { OF_HUB } else { 0 };
        let of_others = self.moving.len().saturating_add(self.modes).saturating_mul(2);
        of_others.saturating_add(of_hub)
    }
}

#[cfg(feature = "alloc")]
impl<T: Scalar> Slopes<'_, T> {
    /// The columns of variables into `slopes`, from those of the accelerations; the first variable of which the hub's are
    /// not finite.
    pub(crate) fn fill(
        &self,
        by: &[Variable],
        accelerations: &DMatrix<T>,
        slopes: &mut DMatrix<T>,
    ) -> Result<(), usize> {
        let finite = match self.by {
            #[cfg(feature = "lanes")]
            Arithmetic::Dispatched(cpu) => {
                cpu.dispatch(Dispatched { of: self, accelerations, slopes: &mut *slopes })
            }
            Arithmetic::Portable => {
                let accelerations = (accelerations.as_slice(), accelerations.nrows());
                let rows = slopes.nrows();
                self.of_all_accelerations(accelerations, (slopes.as_mut_slice(), rows))
            }
        };
        self.of_variables(by, slopes.nrows(), slopes.as_mut_slice(), finite)
    }

    /// Adds what the variables change slopes by at given accelerations; the first of which the hub's are not finite.
    #[inline(always)]
    fn of_variables(
        &self,
        by: &[Variable],
        rows: usize,
        slopes: &mut [T],
        finite: bool,
    ) -> Result<(), usize> {
        let columns = slopes.chunks_exact_mut(rows.max(1));
        for (number, (variable, to)) in by.iter().zip(columns).enumerate() {
            let turned = self.of_variable(*variable, to);
            if !turned || !finite {
                let hub = self.hub_rows(to);
                if hub.is_some_and(|[_, _, v, _]| !v.iter().all(|number| number.is_finite())) {
                    return Err(number);
                }
            }
        }
        Ok(())
    }

    /// What the accelerations of all columns change slopes by, and zeros; whether those of B in N are finite.
    #[inline(always)]
    fn of_all_accelerations(
        &self,
        (accelerations, height): (&[T], usize),
        (slopes, rows): (&mut [T], usize),
    ) -> bool {
        let from = accelerations.chunks_exact(height.max(1));
        let mut finite = true;
        for (from, to) in from.zip(slopes.chunks_exact_mut(rows.max(1))) {
            finite &= self.of_accelerations(from, to);
        }
        finite
    }

    /// What accelerations change slopes by, and zeros; whether that of B in N is finite.
    #[inline(always)]
    fn of_accelerations(&self, accelerations: &[T], slopes: &mut [T]) -> bool {
        let found = accelerations.split_first_chunk::<6>();
        found.is_none_or(|(of_hub, others)| self.of_hub_and_others(of_hub, others, slopes))
    }
}

impl<T: Scalar> Slopes<'_, T> {
    /// What accelerations of the hub, and of joints and modes, change slopes by, and zeros; whether that of B in N is
    /// finite.
    #[inline(always)]
    pub(crate) fn of_hub_and_others(
        &self,
        of_hub: &[T; 6],
        joints: &[T],
        slopes: &mut [T],
    ) -> bool {
        let (mut to, mut finite) = (slopes, true);
        if self.hub {
            let Some((hub, rest)) = to.split_first_chunk_mut::<OF_HUB>() else { return true };
            to = rest;
            let ([a, b, c, d, e, f], o) = (*of_hub, zero());
            let [x, y, z] = rotate_transposed(&self.bn, [a, b, c]);
            *hub = [o, o, o, o, o, o, x, y, z, d, e, f];
            finite = ((x + y + z) * zero()).is_finite();
        }
        let moving = self.moving.len();
        let Some((coordinates, to)) = to.split_at_mut_checked(moving) else { return true };
        let Some((rates, to)) = to.split_at_mut_checked(moving) else { return true };
        let Some((joints, rest)) = joints.split_at_checked(self.joints) else { return true };
        coordinates.fill(zero());
        self.of_rates(joints, rates);
        if self.modes > 0
            && let Some((coordinates, rates)) = to.split_at_mut_checked(self.modes)
            && let Some(of_modes) = rest.get(..self.modes)
        {
            coordinates.fill(zero());
            rates.iter_mut().zip(of_modes).for_each(|(to, from)| *to = *from);
        }
        finite
    }

    /// Adds what a variable changes slopes by at given accelerations; false where that of B in N is among it.
    #[inline(always)]
    pub(crate) fn of_variable(&self, by: Variable, slopes: &mut [T]) -> bool {
        let unit = |axis: Axis| Axis::ALL.map(|other| if other == axis { one() } else { zero() });
        let of_joints = if self.hub { OF_HUB } else { 0 };
        let moved = match by {
            Variable::Velocity(axis) if self.hub => slopes.get_mut(axis as usize),
            Variable::Omega(axis) if self.hub => slopes.get_mut((axis as usize).wrapping_add(3)),
            Variable::Attitude(axis) => {
                if let Some([_, attitude, velocity, _]) = self.hub_rows(slopes) {
                    *attitude = cross(unit(axis), self.omega);
                    *velocity = add(*velocity, self.in_n([zero(); 3], unit(axis)));
                }
                return false;
            }
            Variable::Rate(joint) => {
                let all = self.moving.len() == self.joints;
                let place = if all { Ok(joint) } else { self.moving.binary_search(&joint) };
                place.ok().and_then(|place| slopes.get_mut(of_joints.wrapping_add(place)))
            }
            Variable::ModalRate(mode) => {
                let of_modes = self.moving.len().wrapping_mul(2).wrapping_add(of_joints);
                slopes.get_mut(of_modes.wrapping_add(mode))
            }
            _ => None,
        };
        if let Some(moved) = moved {
            *moved = one();
        }
        true
    }

    /// The hub's rows of a column of states; none where it is fixed.
    fn hub_rows<'b>(&self, slopes: &'b mut [T]) -> Option<[&'b mut Vec3<T>; 4]> {
        let (hub, _) = slopes.split_at_mut_checked(OF_HUB).filter(|_| self.hub)?;
        match hub.as_chunks_mut::<3>().0 {
            [position, attitude, velocity, omega] => Some([position, attitude, velocity, omega]),
            _ => None,
        }
    }
}

/// Slopes by the instructions of this CPU.
#[cfg(feature = "lanes")]
struct Dispatched<'a, T> {
    of: &'a Slopes<'a, T>,
    accelerations: &'a DMatrix<T>,
    slopes: &'a mut DMatrix<T>,
}

#[cfg(feature = "lanes")]
impl<T: Scalar> pulp::WithSimd for Dispatched<'_, T> {
    type Output = bool;

    #[inline(always)]
    fn with_simd<S: pulp::Simd>(self, _: S) -> bool {
        let accelerations = (self.accelerations.as_slice(), self.accelerations.nrows());
        let rows = self.slopes.nrows();
        self.of.of_all_accelerations(accelerations, (self.slopes.as_mut_slice(), rows))
    }
}
