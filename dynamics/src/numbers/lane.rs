//! [`Lane`]: lanes of `f64` in the registers of the CPU at hand.
//!
//! A lane carries pulp's token, the proof that its instructions exist: so they are reached in a
//! portable build, without `unsafe` here.

#![expect(clippy::inline_always, reason = "lanes reach wide instructions only in what is inlined")]

use core::ops::{Add, Mul, Neg, Sub};

use pulp::{Simd, WithSimd, bytemuck};

use super::laned::{Block, Number, WIDEST, Work};
use crate::numbers::real::{Angle, Real};
use crate::numbers::sincos::{QuarterTurns, sin_cos};

/// Lanes of `f64`; a lane has the bits that a single `f64` has.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Lane<S: Simd> {
    simd: S,
    numbers: S::f64s,
}

impl<S: Simd> Lane<S> {
    /// The same number in every lane.
    #[inline(always)]
    pub(crate) fn splat(simd: S, number: f64) -> Self {
        Self { simd, numbers: simd.splat_f64s(number) }
    }

    #[inline(always)]
    fn of(self, numbers: S::f64s) -> Self {
        Self { numbers, ..self }
    }
}

impl<S: Simd> PartialEq for Lane<S> {
    fn eq(&self, other: &Self) -> bool {
        self.store() == other.store()
    }
}

impl<S: Simd> Add for Lane<S> {
    type Output = Self;

    #[inline(always)]
    fn add(self, other: Self) -> Self {
        self.of(self.simd.add_f64s(self.numbers, other.numbers))
    }
}

impl<S: Simd> Sub for Lane<S> {
    type Output = Self;

    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        self.of(self.simd.sub_f64s(self.numbers, other.numbers))
    }
}

impl<S: Simd> Mul for Lane<S> {
    type Output = Self;

    #[inline(always)]
    fn mul(self, other: Self) -> Self {
        self.of(self.simd.mul_f64s(self.numbers, other.numbers))
    }
}

impl<S: Simd> Neg for Lane<S> {
    type Output = Self;

    #[inline(always)]
    fn neg(self) -> Self {
        self.of(self.simd.xor_f64s(self.numbers, self.simd.splat_f64s(-0.0)))
    }
}

impl<S: Simd> Real for Lane<S> {
    #[inline(always)]
    fn recip(self) -> Self {
        self.of(self.simd.div_f64s(self.simd.splat_f64s(1.0), self.numbers))
    }

    #[inline(always)]
    fn like(self, value: f64) -> Self {
        Self::splat(self.simd, value)
    }
}

impl<S: Simd> QuarterTurns for Lane<S> {
    #[inline(always)]
    fn turned(count: Self, sine: Self, cosine: Self) -> (Self, Self) {
        let simd = count.simd;
        let (one, two) = (simd.splat_u64s(1), simd.splat_u64s(2));
        let bit = |of, bit| simd.equal_u64s(simd.and_u64s(of, bit), bit);
        let (zero, sign) = (simd.splat_f64s(0.0), simd.splat_f64s(-0.0));
        let k = simd.transmute_u64s_f64s(count.numbers);
        let odd = bit(k, one);
        let sine_sign = simd.select_f64s(bit(k, two), sign, zero);
        let cosine_sign = simd.select_f64s(bit(simd.add_u64s(k, one), two), sign, zero);
        let turned_sine = simd.select_f64s(odd, cosine.numbers, sine.numbers);
        let turned_cosine = simd.select_f64s(odd, sine.numbers, cosine.numbers);
        (
            count.of(simd.xor_f64s(turned_sine, sine_sign)),
            count.of(simd.xor_f64s(turned_cosine, cosine_sign)),
        )
    }
}

impl<S: Simd> Angle for Lane<S> {
    #[inline(always)]
    fn sin_cos(self) -> (Self, Self) {
        sin_cos(self)
    }
}

impl<S: Simd> Number for Lane<S> {
    type Holds = S::m64s;

    const WIDTH: usize = S::F64_LANES;

    #[inline(always)]
    fn load(self, block: &Block) -> Self {
        // A block is as aligned as any lane, and a multiple of it long.
        match bytemuck::try_cast_slice::<f64, S::f64s>(&block.0) {
            Ok([numbers, ..]) => self.of(*numbers),
            _ => self.like(f64::NAN),
        }
    }

    #[inline(always)]
    fn store(self) -> Block {
        let mut block = Block::ZERO;
        if let Ok([numbers, ..]) = bytemuck::try_cast_slice_mut::<f64, S::f64s>(&mut block.0) {
            *numbers = self.numbers;
        }
        block
    }

    #[inline(always)]
    fn sqrt(self) -> Self {
        self.of(self.simd.sqrt_f64s(self.numbers))
    }

    #[inline(always)]
    fn abs(self) -> Self {
        let magnitude = self.simd.splat_u64s(!(1 << 63));
        let bits = self.simd.transmute_u64s_f64s(self.numbers);
        self.of(self.simd.transmute_f64s_u64s(self.simd.and_u64s(bits, magnitude)))
    }

    #[inline(always)]
    fn above(self, other: Self) -> S::m64s {
        self.simd.greater_than_f64s(self.numbers, other.numbers)
    }

    #[inline(always)]
    fn same(self, other: Self) -> S::m64s {
        self.simd.equal_f64s(self.numbers, other.numbers)
    }

    #[inline(always)]
    fn both(self, a: S::m64s, b: S::m64s) -> S::m64s {
        self.simd.and_m64s(a, b)
    }

    #[inline(always)]
    fn either(self, a: S::m64s, b: S::m64s) -> S::m64s {
        self.simd.or_m64s(a, b)
    }

    #[inline(always)]
    fn or(self, holds: S::m64s, other: Self) -> Self {
        self.of(self.simd.select_f64s(holds, self.numbers, other.numbers))
    }

    // Entered by a function without the instructions, which is not inlined: so neither is this.
    #[inline(never)]
    fn apart(self, work: impl Work) {
        self.simd.vectorize(SeparateFunction(work));
    }
}

/// Work in a function of its own.
struct SeparateFunction<W>(W);

impl<W: Work> WithSimd for SeparateFunction<W> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) {
        self.0.run();
    }
}

// A lane is loaded from the front of a block.
const _: () = assert!(size_of::<Block>() == WIDEST * size_of::<f64>());
