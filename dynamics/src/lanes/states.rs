//! [`States`]: the joints of as many states as the widest lanes have, as data of a set.

#![expect(clippy::inline_always, reason = "lanes reach wide instructions only in what is inlined")]

use crate::numbers::laned::WIDEST;
use crate::sets::bundle::{Bundle, Part};
use crate::sets::devices::DeviceSet;
use crate::sets::enumeration::{DeviceEnum, Variant};
use crate::sets::per_device::Joints;

/// The joints of as many states as the widest lanes have.
pub(super) struct States;

impl Bundle<f64> for States {
    type Of<'a, D: DeviceSet<Scalar = f64>> = [&'a D::Per<Joints>; WIDEST];
    type Typed<'a, K: Variant<E>, E: DeviceEnum<Scalar = f64>> = [K::Joints<f64>; WIDEST];

    #[inline(always)]
    fn part<'b, 'a: 'b, W: DeviceSet<Scalar = f64>, P: Part<W>>(
        [a, b, c, d, e, f, g, h]: &'b mut Self::Of<'a, W>,
        part: P,
    ) -> Option<Self::Of<'b, P::Of>> {
        let [a, b, c, d] = [part.of::<Joints>(a)?, part.of(b)?, part.of(c)?, part.of(d)?];
        Some([a, b, c, d, part.of::<Joints>(e)?, part.of(f)?, part.of(g)?, part.of(h)?])
    }

    #[inline(always)]
    fn counts<W: DeviceSet<Scalar = f64>>(_: &Self::Of<'_, W>, _: &mut impl FnMut(usize)) {}

    fn get<'a, K: Variant<E>, E: DeviceEnum<Scalar = f64>>(
        _: Self::Of<'a, E>,
    ) -> Option<Self::Typed<'a, K, E>> {
        None
    }

    #[inline(always)]
    fn refer<'b, K: Variant<E>, E: DeviceEnum<Scalar = f64>>(
        typed: &'b mut Self::Typed<'_, K, E>,
    ) -> Self::Of<'b, K> {
        typed.each_ref()
    }

    fn put<K: Variant<E>, E: DeviceEnum<Scalar = f64>>(_: Self::Typed<'_, K, E>) {}
}
