//! [`GroupBackSubstitution`]: the joint accelerations of devices of one kind, side by side.

#![expect(clippy::inline_always, reason = "lanes reach wide instructions only in what is inlined")]

use pulp::{Simd, WithSimd};

use super::gains::{GroupGains, Half};
use super::group::DeviceGroup;
use crate::generated::hub::BodyAcceleration;
use crate::model::kind::Kind;
use crate::numbers::lane::Lane;
use crate::numbers::laned::{Block, Number};
use crate::numbers::real::Scalar;

/// Devices whose joint accelerations are to be found.
pub(crate) struct GroupBackSubstitution<'a, K: Kind> {
    pub(crate) group: &'a DeviceGroup<K>,
    pub(crate) gains: &'a mut GroupGains,
    pub(crate) hub: &'a BodyAcceleration<K::Scalar>,
    /// The accelerations, to be written.
    pub(crate) found: &'a mut Option<K::Accelerations<Block>>,
}

impl<K: Kind> GroupBackSubstitution<'_, K> {
    /// Finds the accelerations. Never inlined: one function of a kind and a width for all sets and
    /// services.
    #[inline(never)]
    pub(crate) fn run(self) {
        self.group.registers.dispatch(self);
    }
}

impl<K: Kind> WithSimd for GroupBackSubstitution<'_, K> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        self.substitute(Lane::splat(simd, 0.0));
    }
}

impl<K: Kind> GroupBackSubstitution<'_, K> {
    #[inline(always)]
    fn substitute<T: Number>(self, zero: T) {
        let Self { group, gains, hub, found } = self;
        let Some(shape) = group.shape.get() else { return };
        let gains = read::<K, T>(shape, gains, zero);
        let splat = |number: K::Scalar| zero.like(number.to_f64());
        let hub = BodyAcceleration {
            r_b_n_ddot_bx: splat(hub.r_b_n_ddot_bx),
            r_b_n_ddot_by: splat(hub.r_b_n_ddot_by),
            r_b_n_ddot_bz: splat(hub.r_b_n_ddot_bz),
            omega_dot_bx: splat(hub.omega_dot_bx),
            omega_dot_by: splat(hub.omega_dot_by),
            omega_dot_bz: splat(hub.omega_dot_bz),
        };
        let laned = K::back_substitute(&gains, &hub);
        *found = Some(K::zip_accelerations(&laned, &laned, |number, _| number.store()));
    }
}

/// How many halves a number takes.
const fn halves<T: Number>() -> usize {
    T::WIDTH.div_ceil(Half::ZERO.0.len())
}

/// Writes the gains of a group.
#[inline(always)]
pub(super) fn write<K: Kind, T: Number>(laned: &K::Gains<T>, to: &mut GroupGains) {
    let mut count = 0;
    K::zip_gains(laned, laned, |_, _| count += halves::<T>());
    let mut places = to.next_mut(count).iter_mut();
    K::zip_gains(laned, laned, |number, _| {
        let Block([a, b, c, d, e, f, g, h]) = number.store();
        if let Some(place) = places.next() {
            *place = Half([a, b, c, d]);
        }
        if halves::<T>() > 1
            && let Some(place) = places.next()
        {
            *place = Half([e, f, g, h]);
        }
    });
}

/// Reads them; `shape` has as many.
#[inline(always)]
fn read<K: Kind, T: Number>(shape: &K::Gains<()>, from: &mut GroupGains, zero: T) -> K::Gains<T> {
    let mut count = 0;
    K::zip_gains(shape, shape, |(), ()| count += halves::<T>());
    let mut numbers = from.next(count).iter();
    K::zip_gains(shape, shape, |(), ()| {
        let Half([a, b, c, d]) = numbers.next().copied().unwrap_or(Half::ZERO);
        let Half([e, f, g, h]) = if halves::<T>() > 1 {
            numbers.next().copied().unwrap_or(Half::ZERO)
        } else {
            Half::ZERO
        };
        zero.load(&Block([a, b, c, d, e, f, g, h]))
    })
}
