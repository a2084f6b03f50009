//! [`AlongInLanes`], [`WeightsInLanes`]: products of the derivatives of the loads of devices of one kind side by side in
//! lanes, with the bits of one after another.

#![expect(clippy::inline_always, reason = "lanes reach wide instructions only in what is inlined")]

use pulp::{Simd, WithSimd};

use crate::derivatives::loads::kernel_in_lanes::{LanedKernel, within};
use crate::derivatives::products::device_products::{LoadChange, LoadGradient};
use crate::equations::side_by_side::gather::{joints_in_lanes, values_in_lanes};
use crate::equations::side_by_side::group::DeviceGroup;
use crate::model::kind::Kind;
use crate::numbers::lane::Lane;
use crate::numbers::laned::{Block, Number, WIDEST};
use crate::numbers::real::Scalar;
use crate::numbers::vec3::{Columns, Vec3, rotate};

/// Force and moment, or other pairs of vectors.
type Two<T> = [Vec3<T>; 2];

/// Devices and a direction; lanes without a device repeat the last.
pub(crate) struct AlongInLanes<'a, K: Kind> {
    pub(crate) kernel: LanedKernel<'a, K>,
    pub(crate) direction: [&'a K::Joints<K::Scalar>; WIDEST],
    /// The direction of the angular velocity, B axes.
    pub(crate) omega: Vec3<K::Scalar>,
    /// What force and moment change by, B axes: added to.
    pub(crate) hub: &'a mut Two<K::Scalar>,
}

impl<K: Kind> AlongInLanes<'_, K> {
    /// What the motors exert more in each lane; none, and nothing added, where lanes do not support the devices.
    ///
    /// Never inlined: one function of a kind and a width for all sets.
    #[inline(never)]
    pub(crate) fn run(self) -> Option<K::PerJoint<Block>> {
        self.kernel.group.registers.dispatch(self)
    }
}

impl<K: Kind> WithSimd for AlongInLanes<'_, K> {
    type Output = Option<K::PerJoint<Block>>;

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) -> Self::Output {
        let Self { kernel, direction, omega, hub } = self;
        let (zero, group) = (Lane::splat(simd, 0.0), kernel.group);
        let (found, mount) = kernel.evaluate(zero)?;
        let direction = joints_in_lanes::<K, _>(zero, direction);
        let omega = within(zero, &mount, omega);
        let change = LoadChange::<K, _>::along(zero, &found, &direction, omega);
        add_turned(group, &mount, &change.hub, hub, false);
        Some(stored::<K, _>(&change.joints))
    }
}

/// Devices and weights; lanes without a device repeat the last.
pub(crate) struct WeightsInLanes<'a, K: Kind> {
    pub(crate) kernel: LanedKernel<'a, K>,
    /// Of force and moment about B, B axes.
    pub(crate) hub: Two<K::Scalar>,
    pub(crate) weights: &'a [K::PerJoint<f64>; WIDEST],
    /// The gradient by the angular velocity, B axes: added to.
    pub(crate) by_omega: &'a mut Vec3<K::Scalar>,
    /// By the accelerations of the hub, B axes: what it exerts is subtracted.
    pub(crate) by_hub: &'a mut Two<K::Scalar>,
}

/// By coordinates, by rates, by accelerations.
type OfJoints<K> = [<K as crate::model::kernels::Kernels>::PerJoint<Block>; 3];

impl<K: Kind> WeightsInLanes<'_, K> {
    /// The gradient of each lane; none, and nothing added, where lanes do not support the devices.
    ///
    /// Never inlined: one function of a kind and a width for all sets.
    #[inline(never)]
    pub(crate) fn run(self) -> Option<OfJoints<K>> {
        self.kernel.group.registers.dispatch(self)
    }
}

impl<K: Kind> WithSimd for WeightsInLanes<'_, K> {
    type Output = Option<OfJoints<K>>;

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) -> Self::Output {
        let Self { kernel, hub: [force, moment], weights, by_omega, by_hub } = self;
        let (zero, group) = (Lane::splat(simd, 0.0), kernel.group);
        let (found, mount) = kernel.evaluate(zero)?;
        let weights = values_in_lanes::<K, _>(zero, weights.each_ref());
        let hub = [within(zero, &mount, force), within(zero, &mount, moment)];
        let gradient = LoadGradient::<K, _>::new(zero, &found, hub, &weights);
        let mut omega = [*by_omega];
        add_turned(group, &mount, &[gradient.omega], &mut omega, false);
        [*by_omega] = omega;
        add_turned(group, &mount, &gradient.hub, by_hub, true);
        let LoadGradient { coordinates, rates, accelerations, .. } = &gradient;
        Some([stored::<K, _>(coordinates), stored::<K, _>(rates), stored::<K, _>(accelerations)])
    }
}

/// Adds vectors of the devices to sums of B axes, device by device, or subtracts them.
#[inline(always)]
fn add_turned<K: Kind, T: Number, const N: usize>(
    group: &DeviceGroup<K>,
    mount: &Columns<T>,
    of: &[Vec3<T>; N],
    to: &mut [Vec3<K::Scalar>; N],
    less: bool,
) {
    for (to, of) in to.iter_mut().zip(of) {
        for (to, number) in to.iter_mut().zip(rotate(mount, *of)) {
            // Minus zero changes no sum.
            let number = if less { -number } else { number };
            let real = number.like(0.0).load(&group.weight).above(number.like(0.0));
            let number = number.or(real, number.like(-0.0));
            *to = K::Scalar::from_f64(number.added_to(to.to_f64()));
        }
    }
}

#[inline(always)]
fn stored<K: Kind, T: Number>(numbers: &K::PerJoint<T>) -> K::PerJoint<Block> {
    K::zip_per_joint(
        numbers,
        numbers,
        #[inline(always)]
        |number, _| number.store(),
    )
}
