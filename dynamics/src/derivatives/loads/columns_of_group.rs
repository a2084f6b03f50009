//! [`GroupColumns`]: joints of devices of one kind eliminated side by side in lanes, from the results of their kernel, with
//! the bits of one after another.

#![expect(clippy::inline_always, reason = "lanes reach wide instructions only in what is inlined")]

use crate::derivatives::loads::device_reduction::{DeviceGroups, DeviceReduction, JointModes};
use crate::derivatives::loads::kernel_in_lanes::Slopes;
use crate::derivatives::loads::kernel_loads::{COORDINATE, OMEGA, OMEGA_DOT, RATE, show};
use crate::derivatives::loads::load_columns::{JointColumns, LoadColumns};
use crate::derivatives::loads::mass_system::set_gains;
use crate::derivatives::loads::side_by_side::{HubGroup, LoadGroup, TOGETHER};
use crate::equations::side_by_side::gather::values_in_lanes;
use crate::equations::side_by_side::group::DeviceGroup;
use crate::model::joint_array::MAX_JOINTS;
use crate::model::kind::{Kind, LoadDerivatives};
use crate::numbers::laned::{Block, Number, WIDEST};
use crate::numbers::real::{Scalar, zero};
use crate::numbers::vec3::Columns;

/// Variables of a group: there is no place to be filled up.
const P: usize = 3;

/// Where a group is added.
pub(crate) struct GroupColumns<'a, K: Kind, T> {
    pub(crate) group: &'a DeviceGroup<K>,
    pub(crate) mount: &'a Columns<T>,
    pub(crate) modes: JointModes,
    pub(crate) slopes: Option<&'a Slopes<K>>,
    pub(crate) columns: &'a mut LoadColumns<K::Scalar>,
}

/// Loads of the devices in lanes, of so many joints.
struct LaneLoads<T, const N: usize> {
    joints: [LoadGroup<T, N, P>; N],
    omega: LoadGroup<T, N, P>,
    omega_dot: LoadGroup<T, N, P>,
}

impl<K: Kind, T: Number> GroupColumns<'_, K, T> {
    /// Adds the devices of a group.
    #[inline(always)]
    pub(crate) fn add(self, zero: T, found: &LoadDerivatives<K, T>) -> Option<()> {
        match const { K::JOINTS.len() } {
            0 | 1 => self.add_joints::<1>(zero, found),
            2 => self.add_joints::<2>(zero, found),
            3 => self.add_joints::<3>(zero, found),
            4 => self.add_joints::<4>(zero, found),
            5 => self.add_joints::<5>(zero, found),
            6 => self.add_joints::<6>(zero, found),
            _ => self.add_joints::<MAX_JOINTS>(zero, found),
        }
    }

    #[inline(always)]
    fn add_joints<const N: usize>(self, zero: T, found: &LoadDerivatives<K, T>) -> Option<()> {
        match T::WIDTH {
            2 => self.add_lanes::<N, 2>(zero, found),
            4 => self.add_lanes::<N, 4>(zero, found),
            _ => self.add_lanes::<N, WIDEST>(zero, found),
        }
    }

    /// Adds the devices, of so many joints, in so many lanes.
    #[inline(always)]
    fn add_lanes<const N: usize, const WIDTH: usize>(
        self,
        zero: T,
        found: &LoadDerivatives<K, T>,
    ) -> Option<()> {
        let Self { group, mount, modes, slopes, columns } = self;
        let devices = group.devices;
        let loads = lane_loads::<K, T, N>(zero, found, slopes);
        let first = columns.next;
        let lanes = columns.next_joints_of_group(const { N.saturating_mul(WIDTH) });
        let lanes = lanes.as_chunks_mut::<N>().0.first_chunk_mut::<WIDTH>()?;
        let groups = DeviceGroups {
            joints: &loads.joints,
            omega: &loads.omega,
            omega_dot: &loads.omega_dot.hub,
        };
        let reduction = DeviceReduction::<T, N, P>::new(
            zero,
            mount,
            &modes,
            &groups,
            #[inline(always)]
            |joint, hub: &HubGroup<T, P>, less: &[[T; P]; N]| {
                let mut device = first;
                for of_lane in lanes.iter_mut() {
                    let Some(to) = of_lane.get_mut(joint) else { return };
                    (to.first, to.count, to.free) = (device, N, modes.free[joint % MAX_JOINTS]);
                    device = device.wrapping_add(N);
                }
                for (row, of) in hub.iter().enumerate() {
                    write_row::<K, T, N, WIDTH>(of, lanes, |to| {
                        to.get_mut(joint)?.hub.get_mut(row)
                    });
                }
                for (row, of) in less.iter().enumerate() {
                    write_row::<K, T, N, WIDTH>(of, lanes, |to| {
                        to.get_mut(joint)?.less.get_mut(row)
                    });
                }
            },
        );
        let DeviceReduction { eliminated, omega, less_by_omega, matrix } = reduction;
        let real = (devices < WIDTH).then(|| zero.load(&group.weight).above(zero));
        for (to, of) in columns.sums.omega.iter_mut().zip(&omega) {
            for (to, number) in to.iter_mut().zip(of) {
                add::<K, T>(to, *number, real);
            }
        }
        for (column, (to, of)) in columns.sums.matrix.iter_mut().zip(&matrix).enumerate() {
            for (to, number) in to.iter_mut().zip(of).take(column.wrapping_add(1)) {
                add::<K, T>(to, *number, real);
            }
        }
        for (joint, (gains, less)) in eliminated.gains.iter().zip(&less_by_omega).enumerate() {
            let mut stored = [Block::ZERO; 9];
            for (to, number) in stored.iter_mut().zip(gains.iter().chain(less)) {
                *to = number.store();
            }
            let mut number = first.wrapping_add(joint);
            for lane in 0..devices.min(WIDTH) {
                let at = |k: usize| K::Scalar::from_f64(stored[k % 9].at(lane));
                let of_hub = [at(0), at(1), at(2), at(3), at(4), at(5)];
                set_gains(&mut columns.gains, number, &of_hub, &[at(6), at(7), at(8)]);
                number = number.wrapping_add(N);
            }
        }
        columns.next = first.wrapping_add(N.wrapping_mul(devices));
        Some(())
    }
}

/// Adds the numbers of lanes, of those that have a device.
#[inline(always)]
fn add<K: Kind, T: Number>(to: &mut K::Scalar, number: T, real: Option<T::Holds>) {
    // Minus zero changes no sum.
    let number = match real {
        Some(real) => number.or(real, number.like(-0.0)),
        None => number,
    };
    *to = K::Scalar::from_f64(number.added_to(to.to_f64()));
}

/// The results of the kernel with springs and friction.
#[inline(always)]
fn lane_loads<K: Kind, T: Number, const N: usize>(
    zero: T,
    found: &LoadDerivatives<K, T>,
    slopes: Option<&Slopes<K>>,
) -> LaneLoads<T, N> {
    let none = LoadGroup::none(zero);
    let mut loads = LaneLoads { joints: [none; N], omega: none, omega_dot: none };
    show(
        found,
        #[inline(always)]
        |[group, row, place], number: T| match group {
            OMEGA => loads.omega.put(row, place, number),
            OMEGA_DOT => loads.omega_dot.put(row, place, number),
            joint => {
                if let Some(group) = loads.joints.get_mut(joint) {
                    group.put(row, place, number);
                }
            }
        },
    );
    let without = <K as Kind>::all(zero);
    let [stiffness, damping] = match slopes {
        Some([stiffness, damping]) => [
            values_in_lanes::<K, T>(zero, stiffness.each_ref()),
            values_in_lanes::<K, T>(zero, damping.each_ref()),
        ],
        None => [without, without],
    };
    let mut joint = 0;
    K::zip_per_joint(
        &stiffness,
        &damping,
        #[inline(always)]
        |stiffness, damping| {
            let own = loads.joints.get_mut(joint).and_then(|of| of.joints.get_mut(joint));
            if let Some(own) = own {
                own[COORDINATE] = own[COORDINATE] + stiffness;
                own[RATE] = own[RATE] + damping;
            }
            joint = joint.wrapping_add(1);
        },
    );
    loads
}

/// Writes a row of the records of each lane.
#[inline(always)]
fn write_row<K: Kind, T: Number, const N: usize, const WIDTH: usize>(
    of: &[T; P],
    lanes: &mut [[JointColumns<K::Scalar>; N]; WIDTH],
    row: impl Fn(&mut [JointColumns<K::Scalar>; N]) -> Option<&mut [K::Scalar; TOGETHER]>,
) {
    let [Block(a), Block(b), Block(c)] = [of[0].store(), of[1].store(), of[2].store()];
    for (lane, ((a, b), c)) in lanes.iter_mut().zip(a.iter().zip(&b).zip(&c)) {
        if let Some(to) = row(lane) {
            let number = K::Scalar::from_f64;
            *to = [number(*a), number(*b), number(*c), zero()];
        }
    }
}
