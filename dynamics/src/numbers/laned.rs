//! [`Number`]: what an evaluation in lanes asks of its lanes beyond the kernels, and [`Block`],
//! what lanes are gathered in.

#![expect(clippy::inline_always, reason = "lanes reach wide instructions only in what is inlined")]

use crate::numbers::real::Angle;

/// Work in lanes that is rarely done, for [`Number::apart`].
pub(crate) trait Work {
    /// Does it.
    fn run(self);
}

/// The widest lanes there are.
pub(crate) const WIDEST: usize = 8;

/// One number for each lane, in memory.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C, align(64))]
pub(crate) struct Block(pub(crate) [f64; WIDEST]);

impl Block {
    /// Zero in every lane.
    pub(crate) const ZERO: Self = Self([0.0; WIDEST]);

    /// Puts a number into one lane; there is none beyond the widest.
    #[inline(always)]
    pub(crate) fn put(&mut self, lane: usize, number: f64) {
        if let Some(place) = self.0.get_mut(lane) {
            *place = number;
        }
    }

    /// The number in one lane.
    #[inline(always)]
    pub(crate) fn at(&self, lane: usize) -> f64 {
        self.0.get(lane).copied().unwrap_or(f64::NAN)
    }
}

/// Several numbers side by side, one per lane.
///
/// Everything is part of what calls it, down to the function that may use the instructions.
pub(crate) trait Number: Angle + 'static {
    /// Whether something holds, lane by lane.
    type Holds: Copy;

    /// How many lanes there are, at most [`WIDEST`].
    const WIDTH: usize;

    /// The first lanes of a block, as numbers of the same kind as `self`.
    #[must_use]
    fn load(self, block: &Block) -> Self;
    /// The lanes as a block; what is beyond the width is zero.
    fn store(self) -> Block;
    /// A number to which those in the lanes are added, one after another.
    #[inline(always)]
    fn added_to(self, number: f64) -> f64 {
        let Block(lanes) = self.store();
        let mut sum = number;
        for lane in lanes.into_iter().take(Self::WIDTH) {
            sum += lane;
        }
        sum
    }
    /// Square root.
    #[must_use]
    fn sqrt(self) -> Self;
    /// Magnitude.
    #[must_use]
    fn abs(self) -> Self;
    /// The larger of two numbers; `self` if either is NaN.
    #[must_use]
    #[inline(always)]
    fn larger(self, other: Self) -> Self {
        other.or(other.above(self), self)
    }
    /// Whether `self > other`, which a NaN never is.
    fn above(self, other: Self) -> Self::Holds;
    /// Whether `self == other`.
    fn same(self, other: Self) -> Self::Holds;
    /// Whether both hold.
    fn both(self, a: Self::Holds, b: Self::Holds) -> Self::Holds;
    /// Whether one of them holds.
    fn either(self, a: Self::Holds, b: Self::Holds) -> Self::Holds;
    /// `self` where it holds, else `other`.
    #[must_use]
    fn or(self, holds: Self::Holds, other: Self) -> Self;
    /// Does some work in a function of its own that has the instructions of these lanes: in the
    /// function that calls it, neither code nor registers are spent on it.
    fn apart(self, work: impl Work);
}
