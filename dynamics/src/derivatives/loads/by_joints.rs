//! [`ByLoads::fill_matrices`]: all four matrices of a linearised system, where every joint is two states and has an input.
//!
//! A column of the accelerations and that of the slopes are written together, and no variable is looked up. Where only
//! accelerations are wanted, slopes have no rows.

#![expect(clippy::inline_always, reason = "instructions are reached only in what is inlined")]

use nalgebra::DMatrix;

use crate::derivatives::loads::by_loads::{ByLoads, Change};
use crate::derivatives::loads::kernel_loads::{COORDINATE, DRIVE, RATE};
use crate::derivatives::loads::load_columns::JointColumns;
use crate::derivatives::loads::mass_system::{Block, Gains, less};
use crate::derivatives::loads::side_by_side::{Finiteness, HubGroup, Six, TOGETHER};
use crate::derivatives::slopes::{OF_HUB, Slopes};
use crate::derivatives::variable::{Axis, Variable};
use crate::equations::arithmetic::Arithmetic;
use crate::numbers::real::{Scalar, one, zero};
use crate::numbers::vec3::{Columns as Axes, Vec3, rotate_transposed, zeros};

/// By states or inputs: derivatives of the accelerations, and of the slopes of the states.
pub(crate) type Both<'a, T> = [&'a mut DMatrix<T>; 2];

/// Position, attitude and velocity of B: the states of a hub before its angular velocity.
const BEFORE_OMEGA: usize = 9;

/// Columns of both.
type BothColumns<'a, T> = [&'a mut [T]; 2];

/// Columns of both of so many rows, by so many variables.
struct Columned<'a, T> {
    both: BothColumns<'a, T>,
    heights: [usize; 2],
    columns: usize,
}

/// What is filled: `SLOPES` where slopes are wanted, too.
struct Matrices<'a, T, const SLOPES: bool> {
    loads: &'a ByLoads<'a, T>,
    slopes: &'a Slopes<'a, T>,
    by_states: Columned<'a, T>,
    by_inputs: Columned<'a, T>,
}

impl<T: Scalar> ByLoads<'_, T> {
    /// Fills them by all states and inputs, in the order of [`Spacecraft::state_variables`] and
    /// [`Spacecraft::input_variables`]. False, and what was written has no meaning, where a joint is locked or has no input,
    /// and where a number is not finite: which one it is has to be found another way.
    ///
    /// [`Spacecraft::state_variables`]: crate::Spacecraft::state_variables
    /// [`Spacecraft::input_variables`]: crate::Spacecraft::input_variables
    pub(crate) fn fill_matrices(
        &self,
        slopes: &Slopes<'_, T>,
        [by_states, by_inputs]: [Both<'_, T>; 2],
    ) -> bool {
        let [by_states, by_inputs] = [by_states, by_inputs].map(|[accelerations, slopes]| {
            let (heights, columns) = ([accelerations.nrows(), slopes.nrows()], slopes.ncols());
            let both = [accelerations.as_mut_slice(), slopes.as_mut_slice()];
            Columned { both, heights, columns }
        });
        let of = Matrices::<T, true> { loads: self, slopes, by_states, by_inputs };
        let finite = match self.by {
            #[cfg(feature = "lanes")]
            Arithmetic::Dispatched(cpu) => cpu.dispatch(of),
            Arithmetic::Portable => of.fill(),
        };
        finite == Some(true)
    }

    /// The same of only the accelerations.
    pub(crate) fn fill_accelerations(
        &self,
        slopes: &Slopes<'_, T>,
        into: [&mut DMatrix<T>; 2],
    ) -> bool {
        let [by_states, by_inputs] = into.map(|of| {
            let (heights, columns) = ([of.nrows(), 0], of.ncols());
            Columned { both: [of.as_mut_slice(), &mut []], heights, columns }
        });
        let of = Matrices::<T, false> { loads: self, slopes, by_states, by_inputs };
        let finite = match self.by {
            #[cfg(feature = "lanes")]
            Arithmetic::Dispatched(cpu) => cpu.dispatch(of),
            Arithmetic::Portable => of.fill(),
        };
        finite == Some(true)
    }
}

#[cfg(feature = "lanes")]
impl<T: Scalar, const SLOPES: bool> pulp::WithSimd for Matrices<'_, T, SLOPES> {
    type Output = Option<bool>;

    #[inline(always)]
    fn with_simd<S: pulp::Simd>(self, _: S) -> Option<bool> {
        self.fill()
    }
}

impl<T: Scalar, const SLOPES: bool> Matrices<'_, T, SLOPES> {
    /// Whether all numbers are finite; none where a joint has other variables.
    #[inline(always)]
    fn fill(self) -> Option<bool> {
        let Self { loads, slopes, by_states, by_inputs } = self;
        let joints = loads.joints;
        let (of_hub, given) = if slopes.hub { (OF_HUB, 6) } else { (0, 0) };
        let (states, inputs) = (by_states.columns, by_inputs.columns);
        let regular = slopes.moving.len() == joints.len()
            && states == joints.len().checked_mul(2)?.checked_add(of_hub)?
            && inputs == joints.len().checked_add(given)?;
        if !regular {
            return None;
        }
        let Columned { both: by_states, heights, .. } = by_states;
        let by_inputs = by_inputs.both;
        let (hub, joints_of) = split(by_states, heights, of_hub)?;
        let (by_coordinates, by_rates) = split(joints_of, heights, joints.len())?;
        let (given, by_drives) = split(by_inputs, heights, given)?;
        let turned = (SLOPES && slopes.hub).then_some(&slopes.bn);
        let columns = Columns::<T, SLOPES> { gains: loads.gains, turned };
        let mut all = Finiteness::of_none();
        if slopes.hub {
            loads.fill_hub(slopes, &columns, (hub, heights), &mut all)?;
            for (base, both) in loads.by_hub().iter().zip(each::<T, SLOPES>(given, heights)) {
                columns.fill(base, [zero(); 3], both, &mut all)?;
            }
        }
        let of_states =
            each::<T, SLOPES>(by_coordinates, heights).zip(each::<T, SLOPES>(by_rates, heights));
        let of_joints =
            of_states.zip(each::<T, SLOPES>(by_drives, heights)).zip(joints).enumerate();
        for (joint, (((by_coordinate, [accelerations, slopes]), by_drive), of)) in of_joints {
            let in_n = columns.in_n_of_group(&of.hub);
            of.hub.iter().chain(&in_n).for_each(|row| all.see(row));
            columns.fill_joint(of, &in_n, COORDINATE, by_coordinate, &mut all)?;
            columns.fill_joint(of, &in_n, DRIVE, by_drive, &mut all)?;
            columns.fill_joint(of, &in_n, RATE, [accelerations, &mut *slopes], &mut all)?;
            if SLOPES {
                *slopes.get_mut(of_hub.wrapping_add(joint))? = one();
            }
        }
        Some(all.holds())
    }
}

impl<T: Scalar> ByLoads<'_, T> {
    /// By the states of the hub.
    #[inline(always)]
    fn fill_hub<const SLOPES: bool>(
        &self,
        slopes: &Slopes<'_, T>,
        columns: &Columns<'_, T, SLOPES>,
        (hub, heights): (BothColumns<'_, T>, [usize; 2]),
        finite: &mut Finiteness<T>,
    ) -> Option<()> {
        let ([accelerations, slopes_of], by_omega) = split(hub, heights, BEFORE_OMEGA)?;
        // Most of these stay zero.
        accelerations.fill(zero());
        slopes_of.fill(zero());
        let (_, others) = split([accelerations, slopes_of], heights, 3)?;
        let (by_attitude, [_, by_velocity]) = split(others, heights, 3)?;
        for (axis, [accelerations, slopes_of]) in
            Axis::ALL.into_iter().zip(each::<T, SLOPES>(by_attitude, heights))
        {
            let by = Variable::Attitude(axis);
            if let Some(Change { base, field, .. }) = self.change(by) {
                let field = field.unwrap_or_else(zeros);
                columns.fill(&base, field, [accelerations, &mut *slopes_of], finite)?;
            }
            if !SLOPES {
                continue;
            }
            slopes.of_variable(by, slopes_of);
            let [attitude, velocity] = slopes_of.get(3..9)?.as_chunks::<3>().0 else {
                return None;
            };
            finite.see_each(attitude);
            finite.see_each(velocity);
        }
        for (axis, slopes_of) in by_velocity.chunks_exact_mut(heights[1].max(1)).enumerate() {
            *slopes_of.get_mut(axis)? = one();
        }
        let in_n = columns.in_n_of_group(&self.by_omega);
        self.by_omega.iter().chain(&in_n).for_each(|row| finite.see(row));
        for (axis, [accelerations, slopes_of]) in each::<T, SLOPES>(by_omega, heights).enumerate() {
            let own = |found, block: &_| less(found, block, axis);
            let of = (&self.by_omega, &in_n, axis);
            columns.fill_place(of, own, [accelerations, &mut *slopes_of], finite)?;
            if SLOPES {
                *slopes_of.get_mut(axis.wrapping_add(3))? = one();
            }
        }
        Some(())
    }
}

/// Column by column.
struct Columns<'a, T, const SLOPES: bool> {
    gains: Gains<'a, T>,
    /// `[BN]`; none where the hub is fixed: it has no states. None where slopes are not wanted.
    turned: Option<&'a Axes<T>>,
}

impl<T: Scalar, const SLOPES: bool> Columns<'_, T, SLOPES> {
    /// The acceleration of B along N, of some columns; zeros where the hub is fixed.
    #[inline(always)]
    fn in_n_of_group(&self, [a, b, c, ..]: &HubGroup<T>) -> [[T; TOGETHER]; 3] {
        let mut found = [[zero(); TOGETHER]; 3];
        for (to, [x, y, z]) in found.iter_mut().zip(self.turned.into_iter().flatten()) {
            for (k, to) in to.iter_mut().enumerate() {
                *to = *x * a[k] + *y * b[k] + *z * c[k];
            }
        }
        found
    }

    /// By the variable of a joint in this place, with the acceleration of B along N; sees those of the joints.
    #[inline(always)]
    fn fill_joint(
        &self,
        of: &JointColumns<T>,
        in_n: &[[T; TOGETHER]; 3],
        place: usize,
        both: BothColumns<'_, T>,
        finite: &mut Finiteness<T>,
    ) -> Option<()> {
        let [joints, rates] =
            self.fill_place((&of.hub, in_n, place), |found, _| found, both, finite)?;
        let last = of.first.wrapping_add(of.count);
        let own = joints.get_mut(of.first..last)?.iter_mut();
        let mut sum = zero::<T>();
        if !SLOPES {
            for (line, to) in of.less.iter().zip(own) {
                *to = *to - line[place % TOGETHER];
                sum = sum + *to;
            }
            finite.see_each(&[sum]);
            return Some(());
        }
        let own = own.zip(rates.get_mut(of.first..last)?);
        for (line, (to, rate)) in of.less.iter().zip(own) {
            let found = *to - line[place % TOGETHER];
            (*to, *rate) = (found, found);
            sum = sum + found;
        }
        finite.see_each(&[sum]);
        Some(())
    }

    /// What follows the hub's accelerations in a place of a group, as `own` changes it.
    #[inline(always)]
    fn fill_place<'b>(
        &self,
        (hub, [x, y, z], place): (&HubGroup<T>, &[[T; TOGETHER]; 3], usize),
        own: impl Fn([T; TOGETHER], &Block<T>) -> [T; TOGETHER],
        both: BothColumns<'b, T>,
        finite: &mut Finiteness<T>,
    ) -> Option<BothColumns<'b, T>> {
        let place = place % TOGETHER;
        let [a, b, c, d, e, f] = hub;
        let base = [a[place], b[place], c[place], d[place], e[place], f[place]];
        self.follow(&base, (&base, [x[place], y[place], z[place]]), own, both, finite)
    }

    /// What follows these accelerations of the hub, to which those of the field are added.
    #[inline(always)]
    fn fill(
        &self,
        base: &Six<T>,
        [x, y, z]: Vec3<T>,
        both: BothColumns<'_, T>,
        finite: &mut Finiteness<T>,
    ) -> Option<()> {
        let [a, b, c, d, e, f] = *base;
        let hub = [a + x, b + y, c + z, d, e, f];
        let of_b = [hub[0], hub[1], hub[2]];
        let in_n = self.turned.map_or_else(zeros, |bn| rotate_transposed(bn, of_b));
        finite.see_each(&of_b);
        finite.see_each(&[d, e, f]);
        finite.see_each(&in_n);
        self.follow(base, (&hub, in_n), |found, _| found, both, finite)?;
        Some(())
    }

    /// What follows these accelerations of the base, and the hub's, of B also along N; the rows of the joints of both
    /// columns, of as many each.
    #[inline(always)]
    fn follow<'b>(
        &self,
        base: &Six<T>,
        (hub, [x, y, z]): (&Six<T>, Vec3<T>),
        own: impl Fn([T; TOGETHER], &Block<T>) -> [T; TOGETHER],
        [accelerations, slopes]: BothColumns<'b, T>,
        finite: &mut Finiteness<T>,
    ) -> Option<BothColumns<'b, T>> {
        let (of_hub, joints) = accelerations.split_first_chunk_mut::<6>()?;
        *of_hub = *hub;
        if !SLOPES {
            self.gains.follow_changed(base, own, &mut *joints, finite);
            return Some([joints, slopes]);
        }
        let mut rest = slopes;
        if self.turned.is_some() {
            let (of_hub, of_joints) = rest.split_first_chunk_mut::<OF_HUB>()?;
            let ([_, _, _, d, e, f], o) = (*hub, zero());
            *of_hub = [o, o, o, o, o, o, x, y, z, d, e, f];
            rest = of_joints;
        }
        let (coordinates, rates) = rest.split_at_mut_checked(joints.len())?;
        self.gains.follow_twice(base, own, [&mut *joints, &mut *rates, coordinates], finite);
        (rates.len() == joints.len()).then_some([joints, rates])
    }
}

/// The first columns of both, and the others.
#[inline(always)]
fn split<'a, T>(
    [accelerations, slopes]: BothColumns<'a, T>,
    [height, rows]: [usize; 2],
    columns: usize,
) -> Option<(BothColumns<'a, T>, BothColumns<'a, T>)> {
    let (first, others) = accelerations.split_at_mut_checked(height.checked_mul(columns)?)?;
    let (first_slopes, other_slopes) = slopes.split_at_mut_checked(rows.checked_mul(columns)?)?;
    Some(([first, first_slopes], [others, other_slopes]))
}

/// Column by column; without slopes, those are empty.
#[inline(always)]
fn each<'a, T, const SLOPES: bool>(
    [accelerations, slopes]: BothColumns<'a, T>,
    [height, rows]: [usize; 2],
) -> impl Iterator<Item = BothColumns<'a, T>> {
    let mut slopes = slopes.chunks_exact_mut(rows.max(1));
    let columns = accelerations.chunks_exact_mut(height.max(1));
    columns.map_while(move |of| {
        let slopes = if SLOPES { slopes.next()? } else { &mut [] };
        Some([of, slopes])
    })
}
