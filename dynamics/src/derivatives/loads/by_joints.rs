//! [`ByLoads::fill_matrices`]: all four matrices of a linearised system, where every joint is two states and has an input.
//!
//! A column of the accelerations and that of the slopes are written together, and no variable is looked up.

#![expect(clippy::inline_always, reason = "instructions are reached only in what is inlined")]

use nalgebra::DMatrix;

use crate::derivatives::loads::by_loads::{ByLoads, Change, Own};
use crate::derivatives::loads::kernel_loads::{COORDINATE, DRIVE, RATE};
use crate::derivatives::loads::load_columns::JointColumns;
use crate::derivatives::loads::side_by_side::{Finiteness, HubGroup, Six, TOGETHER};
use crate::derivatives::slopes::{OF_HUB, Slopes};
use crate::derivatives::variable::Variable;
use crate::equations::arithmetic::Arithmetic;
use crate::numbers::real::{Scalar, one, zero};
use crate::numbers::vec3::{Columns as Axes, Vec3, rotate_transposed, zeros};

/// By states or inputs: derivatives of the accelerations, and of the slopes of the states.
pub(crate) type Both<'a, T> = [&'a mut DMatrix<T>; 2];

/// Position, attitude and velocity of B: the states of a hub before its angular velocity.
const BEFORE_OMEGA: usize = 9;

/// Columns of both.
type BothColumns<'a, T> = [&'a mut [T]; 2];

/// What is filled.
struct Matrices<'a, T> {
    loads: &'a ByLoads<'a, T>,
    slopes: &'a Slopes<'a, T>,
    states: &'a [Variable],
    inputs: &'a [Variable],
    by_states: Both<'a, T>,
    by_inputs: Both<'a, T>,
}

impl<T: Scalar> ByLoads<'_, T> {
    /// Fills them by these states and inputs. False, and what was written has no meaning, where a joint is locked or
    /// has no input, and where a number is not finite: which one it is has to be found another way.
    pub(crate) fn fill_matrices(
        &self,
        slopes: &Slopes<'_, T>,
        (states, inputs): (&[Variable], &[Variable]),
        [by_states, by_inputs]: [Both<'_, T>; 2],
    ) -> bool {
        let of = Matrices { loads: self, slopes, states, inputs, by_states, by_inputs };
        let finite = match self.by {
            #[cfg(feature = "lanes")]
            Arithmetic::Dispatched(cpu) => cpu.dispatch(of),
            Arithmetic::Portable => of.fill(),
        };
        finite == Some(true)
    }
}

#[cfg(feature = "lanes")]
impl<T: Scalar> pulp::WithSimd for Matrices<'_, T> {
    type Output = Option<bool>;

    #[inline(always)]
    fn with_simd<S: pulp::Simd>(self, _: S) -> Option<bool> {
        self.fill()
    }
}

impl<T: Scalar> Matrices<'_, T> {
    /// Whether all numbers are finite; none where a joint has other variables.
    #[inline(always)]
    fn fill(self) -> Option<bool> {
        let Self { loads, slopes, states, inputs, by_states, by_inputs } = self;
        let joints = loads.devices.joints();
        let of_hub = states.len().checked_sub(joints.len().checked_mul(2)?)?;
        let (states_of_hub, of_joints) = states.split_at_checked(of_hub)?;
        let (coordinates, rates) = of_joints.split_at_checked(joints.len())?;
        let given = inputs.len().checked_sub(joints.len())?;
        let (inputs_of_hub, drives) = inputs.split_at_checked(given)?;
        let lists = coordinates.iter().zip(rates).zip(drives).zip(joints).enumerate();
        let mut regular = true;
        for (joint, (((coordinate, rate), drive), of)) in lists {
            regular &= matches!(coordinate, Variable::Coordinate(own) if *own == joint);
            regular &= matches!(rate, Variable::Rate(own) if *own == joint);
            regular &= match drive {
                Variable::Motor(own) => of.free && *own == joint,
                Variable::Acceleration(own) => !of.free && *own == joint,
                _ => false,
            };
        }
        if !regular {
            return None;
        }
        let [by_states, by_inputs] = [by_states, by_inputs].map(|[accelerations, slopes]| {
            let heights = [accelerations.nrows(), slopes.nrows()];
            ([accelerations.as_mut_slice(), slopes.as_mut_slice()], heights)
        });
        let (by_states, heights) = by_states;
        let (hub, joints_of) = split(by_states, heights, of_hub)?;
        let (by_coordinates, by_rates) = split(joints_of, heights, joints.len())?;
        let (given, by_drives) = split(by_inputs.0, heights, given)?;
        let columns = Columns { loads, turned: slopes.hub.then_some(&slopes.bn) };
        let mut all = Finiteness::of_none();
        let [accelerations, slopes_of] = hub;
        // Most of these stay zero.
        let (still, _) =
            split([&mut *accelerations, &mut *slopes_of], heights, BEFORE_OMEGA.min(of_hub))?;
        for columns in still {
            columns.fill(zero());
        }
        let both = [&mut *accelerations, &mut *slopes_of];
        for (variable, both) in states_of_hub.iter().zip(each(both, heights)) {
            if let Some(change) = loads.change(*variable) {
                columns.fill_hub(change, both, &mut all)?;
            }
        }
        let finite = slopes.of_variables(states_of_hub, heights[1], slopes_of, true).is_ok();
        for (variable, both) in inputs_of_hub.iter().zip(each(given, heights)) {
            columns.fill_hub(loads.change(*variable)?, both, &mut all)?;
        }
        let of_joints = each(by_coordinates, heights).zip(each(by_rates, heights));
        let of_joints = of_joints.zip(each(by_drives, heights)).zip(joints).enumerate();
        for (joint, (((by_coordinate, [accelerations, slopes]), by_drive), of)) in of_joints {
            let in_n = columns.in_n_of_group(&of.hub);
            of.hub.iter().chain(&in_n).for_each(|row| all.see(row));
            columns.fill_joint(of, &in_n, COORDINATE, by_coordinate, &mut all)?;
            columns.fill_joint(of, &in_n, DRIVE, by_drive, &mut all)?;
            columns.fill_joint(of, &in_n, RATE, [accelerations, &mut *slopes], &mut all)?;
            let first = if columns.turned.is_some() { OF_HUB } else { 0 };
            *slopes.get_mut(first.wrapping_add(joint))? = one();
        }
        Some(finite && all.holds())
    }
}

/// Column by column.
struct Columns<'a, T> {
    loads: &'a ByLoads<'a, T>,
    /// `[BN]`; none where the hub is fixed: it has no states.
    turned: Option<&'a Axes<T>>,
}

impl<T: Scalar> Columns<'_, T> {
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
        [x, y, z]: &[[T; TOGETHER]; 3],
        place: usize,
        both: BothColumns<'_, T>,
        finite: &mut Finiteness<T>,
    ) -> Option<()> {
        let place = place % TOGETHER;
        let [a, b, c, d, e, f] = &of.hub;
        let base = [a[place], b[place], c[place], d[place], e[place], f[place]];
        let in_n = [x[place], y[place], z[place]];
        let [joints, rates] = self.follow(&base, (&base, in_n), both, finite)?;
        let own = joints.get_mut(of.first..)?.iter_mut().zip(rates.get_mut(of.first..)?);
        let mut sum = zero::<T>();
        for (line, (to, rate)) in of.less.get(..of.count)?.iter().zip(own) {
            let found = *to - line[place];
            (*to, *rate) = (found, found);
            sum = sum + found;
        }
        finite.see_each(&[sum]);
        Some(())
    }

    /// By a variable of the hub, but for what it changes slopes by at given accelerations.
    #[inline(always)]
    fn fill_hub(
        &self,
        Change { base, field, own }: Change<'_, T>,
        both: BothColumns<'_, T>,
        finite: &mut Finiteness<T>,
    ) -> Option<()> {
        let ([a, b, c, d, e, f], [x, y, z]) = (base, field.unwrap_or_else(zeros));
        let hub = [a + x, b + y, c + z, d, e, f];
        let of_b = [hub[0], hub[1], hub[2]];
        let in_n = self.turned.map_or_else(zeros, |bn| rotate_transposed(bn, of_b));
        finite.see_each(&of_b);
        finite.see_each(&[d, e, f]);
        finite.see_each(&in_n);
        let [joints, rates] = self.follow(&base, (&hub, in_n), both, finite)?;
        if let Own::All(axis) = own {
            self.loads.devices.gains.subtract_by_omega(axis as usize, joints);
            rates.iter_mut().zip(&*joints).for_each(|(to, from)| *to = *from);
            joints.chunks(TOGETHER).for_each(|joints| finite.see_each(joints));
        }
        Some(())
    }

    /// What follows these accelerations of the base, and the hub's, of B also along N; the rows of the joints of both
    /// columns, of as many each.
    #[inline(always)]
    fn follow<'b>(
        &self,
        base: &Six<T>,
        (hub, [x, y, z]): (&Six<T>, Vec3<T>),
        [accelerations, slopes]: BothColumns<'b, T>,
        finite: &mut Finiteness<T>,
    ) -> Option<BothColumns<'b, T>> {
        let (of_hub, joints) = accelerations.split_first_chunk_mut::<6>()?;
        *of_hub = *hub;
        let mut rest = slopes;
        if self.turned.is_some() {
            let (of_hub, of_joints) = rest.split_first_chunk_mut::<OF_HUB>()?;
            let ([_, _, _, d, e, f], o) = (*hub, zero());
            *of_hub = [o, o, o, o, o, o, x, y, z, d, e, f];
            rest = of_joints;
        }
        let (coordinates, rates) = rest.split_at_mut_checked(joints.len())?;
        let gains = &self.loads.devices.gains;
        gains.follow_twice(base, [&mut *joints, &mut *rates, coordinates], finite);
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

/// Column by column.
#[inline(always)]
fn each<'a, T>(
    [accelerations, slopes]: BothColumns<'a, T>,
    [height, rows]: [usize; 2],
) -> impl Iterator<Item = BothColumns<'a, T>> {
    let columns = accelerations.chunks_exact_mut(height.max(1));
    columns.zip(slopes.chunks_exact_mut(rows.max(1))).map(|(of, slopes)| [of, slopes])
}
