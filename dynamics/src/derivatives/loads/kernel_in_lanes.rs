//! [`GroupKernel`]: the kernel `load_derivatives` of devices of one kind side by side in lanes, with the bits of one after
//! another.

#![expect(clippy::inline_always, reason = "lanes reach wide instructions only in what is inlined")]

use pulp::{Simd, WithSimd};

use crate::derivatives::loads::columns_of_group::GroupColumns;
use crate::derivatives::loads::device_reduction::JointModes;
use crate::derivatives::loads::kernel_loads::{KernelLoads, show};
use crate::derivatives::loads::load_columns::LoadColumns;
use crate::equations::assembly::expressed_in_b;
use crate::equations::load_sums::HubAccelerations;
use crate::equations::side_by_side::checks::within_reach;
use crate::equations::side_by_side::gather::{accelerations_in_lanes, joints_in_lanes};
use crate::equations::side_by_side::group::DeviceGroup;
use crate::equations::system::Solution;
use crate::model::kernels::Kernels;
use crate::model::kind::{Kind, LoadDerivatives};
use crate::numbers::lane::Lane;
use crate::numbers::laned::{Block, Number, WIDEST};
use crate::numbers::real::Scalar;
use crate::numbers::vec3::{Columns, Vec3, map, rotate_transposed};

/// Devices whose kernel is to be evaluated; lanes without a device repeat the last.
pub(crate) struct LanedKernel<'a, K: Kind> {
    pub(crate) group: &'a DeviceGroup<K>,
    pub(crate) joints: [&'a K::Joints<K::Scalar>; WIDEST],
    pub(crate) accelerations: [&'a K::Accelerations<K::Scalar>; WIDEST],
    /// How their base moves, in its axes.
    pub(crate) omega: Vec3<K::Scalar>,
    pub(crate) hub: HubAccelerations<K::Scalar>,
}

impl<K: Kind> LanedKernel<'_, K> {
    /// The derivatives, along the axes of the device of each lane, which are the other. None where lanes do not support
    /// the devices or the angles.
    #[inline(always)]
    pub(crate) fn evaluate<T: Number>(
        self,
        zero: T,
    ) -> Option<(LoadDerivatives<K, T>, Columns<T>)> {
        let Self { group, joints, accelerations, omega, hub } = self;
        if group.blocks.is_lumped() {
            return None;
        }
        let joints = joints_in_lanes::<K, T>(zero, joints);
        let holds = zero.like(1.0).or(within_reach::<K, T>(zero, &joints), zero).store();
        if (0..T::WIDTH).any(|lane| holds.at(lane) != 1.0) {
            return None;
        }
        let accelerations = accelerations_in_lanes::<K, T>(zero, accelerations);
        let mount = group.blocks.loads_in_lanes(zero).mount;
        let hub = Solution {
            r_b_n_ddot: within(zero, &mount, hub.r_b_n_ddot),
            omega_dot: within(zero, &mount, hub.omega_dot),
        };
        let (hub, omega) = (hub.expressed_in_b(), expressed_in_b(within(zero, &mount, omega)));
        let pose = K::pose(&joints);
        let constants = group.blocks.in_lanes(zero).constants;
        let found = K::load_derivatives(&constants, &pose, &joints, &omega, &hub, &accelerations)?;
        Some((found, mount))
    }
}

/// Devices, and where their derivatives are written.
pub(crate) struct GroupKernel<'a, K: Kind> {
    pub(crate) kernel: LanedKernel<'a, K>,
    pub(crate) to: Found<'a, K>,
}

/// What is to be written.
pub(crate) enum Found<'a, K: Kind> {
    /// Of the device of each lane, but for springs and friction.
    Loads(&'a mut [KernelLoads<K::Scalar>]),
    /// Of all devices, their joints eliminated, of which all devices have the same modes.
    Eliminated {
        modes: JointModes,
        /// None where there are no springs and no friction.
        slopes: Option<&'a Slopes<K>>,
        columns: &'a mut LoadColumns<K::Scalar>,
    },
}

/// The slopes of springs and friction of the device of each lane: by coordinates, by rates.
pub(crate) type Slopes<K> = [[<K as Kernels>::PerJoint<f64>; WIDEST]; 2];

impl<K: Kind> GroupKernel<'_, K> {
    /// Evaluates it. None where lanes do not support the devices or the angles: then nothing was written.
    ///
    /// Never inlined: one function of a kind and a width for all sets.
    #[inline(never)]
    pub(crate) fn run(self) -> Option<()> {
        self.kernel.group.registers.dispatch(self)
    }
}

impl<K: Kind> WithSimd for GroupKernel<'_, K> {
    type Output = Option<()>;

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) -> Option<()> {
        self.evaluate(Lane::splat(simd, 0.0))
    }
}

impl<K: Kind> GroupKernel<'_, K> {
    #[inline(always)]
    fn evaluate<T: Number>(self, zero: T) -> Option<()> {
        let Self { kernel, to } = self;
        let group = kernel.group;
        let (found, mount) = kernel.evaluate(zero)?;
        match to {
            Found::Loads(loads) => match T::WIDTH {
                2 => write::<K, T, 2>(&found, loads),
                4 => write::<K, T, 4>(&found, loads),
                _ => write::<K, T, WIDEST>(&found, loads),
            },
            Found::Eliminated { modes, slopes, columns } => {
                let to = GroupColumns { group, mount: &mount, modes, slopes, columns };
                to.add(zero, &found)
            }
        }
    }
}

/// Writes the results of each lane.
#[inline(always)]
fn write<K: Kind, T: Number, const WIDTH: usize>(
    found: &LoadDerivatives<K, T>,
    loads: &mut [KernelLoads<K::Scalar>],
) -> Option<()> {
    let loads = loads.first_chunk_mut::<WIDTH>()?;
    show(
        found,
        #[inline(always)]
        |place, number: T| {
            let Block(lanes) = number.store();
            for (to, number) in loads.iter_mut().zip(lanes) {
                to.put(place, K::Scalar::from_f64(number));
            }
        },
    );
    Some(())
}

/// A vector in the axes of the device of each lane.
#[inline(always)]
pub(crate) fn within<U: Scalar, T: Number>(like: T, mount: &Columns<T>, v: Vec3<U>) -> Vec3<T> {
    rotate_transposed(mount, map(v, |number| like.like(number.to_f64())))
}

#[cfg(test)]
mod tests {
    use nalgebra::{DMatrix, Matrix3, Rotation3, Vector3};

    use crate::equations::side_by_side::registers::Registers;
    use crate::numbers::each::{Each, JointStates};
    use crate::{Devices, Dgvscmg, Hub, Inputs, Outputs, Spacecraft, State};

    type One = [Dgvscmg; 1];

    fn device(number: u8) -> Dgvscmg {
        let k = f64::from(number);
        let inertia = Matrix3::new(0.2, 0.001, -0.002, 0.001, 0.11, 0.003, -0.002, 0.003, 0.12);
        Dgvscmg {
            mount: Rotation3::from_euler_angles(0.7 * k, 0.3, -0.2 * k).into_inner(),
            r_go_b: Vector3::new(0.3, 0.1 * k, 0.5),
            l_o: Vector3::new(0.02, 0.01, -0.03),
            m_gi: 0.9,
            i_gi_gic: inertia * 0.3,
            d: 0.001,
            ..Dgvscmg::bare_wheel(4.0, inertia)
        }
    }

    /// The matrices of a hub with these devices.
    fn matrices<D: Devices<Scalar = f64> + crate::set::WithNumbers>(
        devices: &D,
    ) -> [DMatrix<f64>; 4] {
        let hub = Hub { m_b: 80.0, r_bc_b: Vector3::zeros(), i_b_bc: Matrix3::identity() * 9.0 };
        let craft = Spacecraft::new(&hub, devices).unwrap();
        let (mut state, mut inputs) =
            (State::<D>::at_rest_for(&craft), Inputs::<D>::none_for(&craft));
        state.omega = Vector3::new(0.1, -0.2, 0.3);
        let mut k = 0.0;
        for [coordinate, rate] in state.devices.states_mut() {
            (*coordinate, *rate) = (0.3 * k - 0.5, 2.0 - k);
            k += 1.0;
        }
        for motor in inputs.motors.values_mut() {
            *motor = 0.1 * k - 0.2;
            k -= 1.0;
        }
        let found = craft.linearize(&state, &inputs, &Outputs::accelerations()).unwrap();
        [found.a, found.b, found.c, found.d]
    }

    #[test]
    fn devices_side_by_side_have_the_bits_of_one_after_another() {
        let devices = [0, 1, 2, 3].map(device);
        let hub = Hub { m_b: 80.0, r_bc_b: Vector3::zeros(), i_b_bc: Matrix3::identity() * 9.0 };
        let craft = Spacecraft::new(&hub, &devices).unwrap();
        let [first, ..] = &craft.devices;
        assert_eq!(first.group.is_some(), Registers::widest().is_some());
        let [a, b, c, d] = devices;
        // Sets of one device each: no row, and so no group.
        let apart: (One, One, One, One) = ([a], [b], [c], [d]);
        let bits = |of: [DMatrix<f64>; 4]| of.map(|of| of.map(f64::to_bits));
        assert_eq!(bits(matrices(&devices)), bits(matrices(&apart)));
    }
}
