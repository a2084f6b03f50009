//! [`DeviceReduction`]: derivatives of the loads of a device with its joints eliminated, of numbers or of lanes.

#![expect(clippy::inline_always, reason = "instructions are reached only in what is inlined")]

use crate::derivatives::loads::joint_elimination::JointElimination;
use crate::derivatives::loads::kernel_loads::DRIVE;
use crate::derivatives::loads::side_by_side::{HubGroup, LoadGroup, Six, by_b, turned};
use crate::model::joint_array::MAX_JOINTS;
use crate::model::kind::Kind;
use crate::model::mode::Mode;
use crate::numbers::each::Each;
use crate::numbers::real::Real;
use crate::numbers::vec3::Columns;

/// What is given of the joints of a device.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct JointModes {
    /// Which joints have an acceleration that is not given.
    pub(crate) free: [bool; MAX_JOINTS],
    /// Which have one that is prescribed.
    pub(crate) accelerated: [bool; MAX_JOINTS],
}

impl JointModes {
    /// Of a device whose joints have these modes.
    pub(crate) fn of<K: Kind>(modes: &K::PerJoint<Mode<K::Scalar>>) -> Self {
        let (mut free, mut accelerated) = ([false; MAX_JOINTS], [false; MAX_JOINTS]);
        let modes = modes.values().zip(K::JOINTS);
        for ((free, accelerated), (mode, info)) in free.iter_mut().zip(&mut accelerated).zip(modes)
        {
            *free = mode == Mode::Driven && info.driven;
            *accelerated = matches!(mode, Mode::Prescribed(_)) && info.driven;
        }
        Self { free, accelerated }
    }
}

/// Loads of a device in its axes, by some variables side by side; arrays have room for `ROOM` joints.
pub(crate) struct DeviceGroups<'a, T, const ROOM: usize, const P: usize> {
    /// By coordinate, rate and acceleration of each joint.
    pub(crate) joints: &'a [LoadGroup<T, ROOM, P>],
    /// By the hub's angular velocity.
    pub(crate) omega: &'a LoadGroup<T, ROOM, P>,
    /// Of the hub, by its angular acceleration.
    pub(crate) omega_dot: &'a HubGroup<T, P>,
}

/// What is left of a device of so many joints.
pub(crate) struct DeviceReduction<T, const N: usize, const P: usize> {
    pub(crate) eliminated: JointElimination<T, N>,
    /// By the hub's angular velocity, B axes: what is left for the hub, on the right side of its equations, and by how
    /// much less the joints accelerate.
    pub(crate) omega: HubGroup<T, P>,
    pub(crate) less_by_omega: [[T; P]; N],
    /// What is added to the hub's matrix, by columns, what is not below the diagonal.
    pub(crate) matrix: [Six<T>; 6],
}

impl<T: Real, const N: usize, const P: usize> DeviceReduction<T, N, P> {
    /// Of a device of this mount. Shows of each joint, by coordinate, rate and drive, what is left for the hub, on the
    /// right side of its equations, and by how much less the joints accelerate.
    #[inline(always)]
    pub(crate) fn new<const ROOM: usize>(
        zero: T,
        mount: &Columns<T>,
        JointModes { free, accelerated }: &JointModes,
        loads: &DeviceGroups<'_, T, ROOM, P>,
        mut show: impl FnMut(usize, &HubGroup<T, P>, &[[T; P]; N]),
    ) -> Self {
        let mut groups = [[[zero; P]; 6]; N];
        let (mut mass, mut coupling) = ([[zero; N]; N], [[zero; 6]; N]);
        for (joint, (group, of)) in groups.iter_mut().zip(loads.joints).enumerate() {
            *group = turned(zero, &of.hub, mount);
            for (to, row) in mass[joint].iter_mut().zip(&of.joints) {
                *to = row[DRIVE];
            }
            for (to, row) in coupling[joint].iter_mut().zip(&*group) {
                *to = row[DRIVE];
            }
        }
        let eliminated = JointElimination::new(zero, &mass, &coupling, *free);
        for (joint, (group, of)) in groups.iter_mut().zip(loads.joints).enumerate() {
            let mut less = eliminated.reduce_together(zero, group, &of.joints);
            if free[joint] {
                eliminated.motor(joint, group, &mut less);
            } else if accelerated[joint] {
                less[joint][DRIVE] = zero.like(-1.0);
            } else {
                for row in group.iter_mut().chain(&mut less) {
                    row[DRIVE] = zero;
                }
            }
            show(joint, group, &less);
        }
        let mut omega = turned(zero, &by_b(zero, &loads.omega.hub, mount), mount);
        let of_joints = by_b(zero, &loads.omega.joints, mount);
        let less_by_omega = eliminated.reduce_together(zero, &mut omega, &of_joints);
        let by_omega_dot = turned(zero, &by_b(zero, loads.omega_dot, mount), mount);
        let mut matrix = eliminated.taken_over(zero);
        for (row, by_axes) in by_omega_dot.iter().enumerate() {
            for (number, (column, entry)) in (3_usize..).zip(matrix.iter_mut().skip(3).zip(by_axes))
            {
                if row <= number {
                    column[row] = column[row] + *entry;
                }
            }
        }
        Self { eliminated, omega, less_by_omega, matrix }
    }
}
