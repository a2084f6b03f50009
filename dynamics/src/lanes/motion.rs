//! [`Motion`]: position and attitude of the hub with their rates, whatever the numbers are.

#![expect(clippy::inline_always, reason = "lanes reach wide instructions only in what is inlined")]

use super::laned_set::LanedSet;
use crate::attitude::quaternion::Quaternion;
use crate::equations::gravity::Gravity;
use crate::equations::side_by_side::gather::{joined, wide};
use crate::numbers::laned::{Block, Number, WIDEST};
use crate::numbers::vec3::{Vec3, components, vector};
use crate::solve::inputs::Inputs;
use crate::solve::state::State;

/// The hub's part of a state, or of its slope.
#[derive(Clone, Copy, Debug)]
pub(super) struct Motion<T> {
    /// Position of B, N axes.
    pub(super) r: Vec3<T>,
    /// Its velocity, N axes.
    pub(super) v: Vec3<T>,
    /// The quaternion, scalar first.
    pub(super) q: [T; 4],
    /// Angular velocity, B axes.
    pub(super) omega: Vec3<T>,
}

impl<T: Copy> Motion<T> {
    /// Each number changed.
    #[inline(always)]
    pub(super) fn map<U>(&self, mut change: impl FnMut(T) -> U) -> Motion<U> {
        self.zip(self, |number, _| change(number))
    }

    /// Two motions joined number by number.
    #[inline(always)]
    pub(super) fn zip<U: Copy, W>(
        &self,
        other: &Motion<U>,
        mut join: impl FnMut(T, U) -> W,
    ) -> Motion<W> {
        // One by one: an array's own `map` is a call, which lanes must not make.
        let ([a, b, c], [d, e, f]) = (self.r, other.r);
        let r = [join(a, d), join(b, e), join(c, f)];
        let ([a, b, c], [d, e, f]) = (self.v, other.v);
        let v = [join(a, d), join(b, e), join(c, f)];
        let ([a, b, c, d], [w, x, y, z]) = (self.q, other.q);
        let q = [join(a, w), join(b, x), join(c, y), join(d, z)];
        let ([a, b, c], [d, e, f]) = (self.omega, other.omega);
        Motion { r, v, q, omega: [join(a, d), join(b, e), join(c, f)] }
    }
}

/// What acts on the hub.
#[derive(Clone, Copy, Debug)]
pub(super) struct Forces<T> {
    /// Force through B, B axes.
    pub(super) force: Vec3<T>,
    /// Torque about B, B axes.
    pub(super) torque_b: Vec3<T>,
    /// A uniform field, N axes.
    pub(super) field: Vec3<T>,
    /// Zero where there is none, which is `0.0` at B, never `-0.0`; minus zero, which changes
    /// nothing, where there is one.
    pub(super) none: T,
}

impl<T: Copy> Forces<T> {
    /// Each number changed.
    #[inline(always)]
    pub(super) fn map<U>(&self, mut change: impl FnMut(T) -> U) -> Forces<U> {
        self.zip(self, |number, _| change(number))
    }

    /// Two of them joined number by number.
    #[inline(always)]
    fn zip<U: Copy, W>(&self, other: &Forces<U>, mut join: impl FnMut(T, U) -> W) -> Forces<W> {
        let ([a, b, c], [d, e, f]) = (self.force, other.force);
        let force = [join(a, d), join(b, e), join(c, f)];
        let ([a, b, c], [d, e, f]) = (self.torque_b, other.torque_b);
        let torque_b = [join(a, d), join(b, e), join(c, f)];
        let ([a, b, c], [d, e, f]) = (self.field, other.field);
        let field = [join(a, d), join(b, e), join(c, f)];
        Forces { force, torque_b, field, none: join(self.none, other.none) }
    }
}

/// Puts numbers into one lane of blocks, in place: a block that is moved while its lanes are
/// written one by one costs more than an evaluation.
fn put<const N: usize>(blocks: &mut [Block; N], lane: usize, numbers: [f64; N]) {
    for (block, number) in blocks.iter_mut().zip(numbers) {
        block.put(lane, number);
    }
}

/// The numbers in one lane of blocks.
pub(super) fn at<const N: usize>(blocks: &[Block; N], lane: usize) -> [f64; N] {
    blocks.each_ref().map(|block| block.at(lane))
}

impl<T: Number> Motion<T> {
    /// The same number everywhere.
    pub(super) fn filled(number: T) -> Self {
        Self { r: [number; 3], v: [number; 3], q: [number; 4], omega: [number; 3] }
    }

    /// The hub's part of as many states as the widest lanes have.
    #[inline(always)]
    pub(super) fn in_lanes<D: LanedSet>(
        like: T,
        [a, b, c, d, e, f, g, h]: [&State<D>; WIDEST],
    ) -> Self {
        let two = |a, b| Motion::of(a).zip(&Motion::of(b), |a, b| [a, b]);
        let four = |a, b, c, d| two(a, b).zip(&two(c, d), |[a, b], [c, d]| [a, b, c, d]);
        let low = four(a, b, c, d);
        let high = if wide::<T>() { four(e, f, g, h) } else { low };
        low.zip(&high, |low, high| joined(like, low, high))
    }
}

impl Motion<f64> {
    /// The hub's part of a state.
    #[inline(always)]
    fn of<D: LanedSet>(state: &State<D>) -> Self {
        let Quaternion { q0, q1, q2, q3 } = state.attitude;
        let (r, v) = (components(&state.r_b_n), components(&state.r_b_n_dot));
        Self { r, v, q: [q0, q1, q2, q3], omega: components(&state.omega) }
    }
}

impl Motion<Block> {
    /// Takes the hub's part of a state out of one lane.
    pub(super) fn take<D: LanedSet>(&self, lane: usize, state: &mut State<D>) {
        let [q0, q1, q2, q3] = at(&self.q, lane);
        state.r_b_n = vector(at(&self.r, lane));
        state.r_b_n_dot = vector(at(&self.v, lane));
        state.attitude = Quaternion { q0, q1, q2, q3 };
        state.omega = vector(at(&self.omega, lane));
    }
}

impl Forces<Block> {
    /// Zero in every lane.
    pub(super) const ZERO: Self = Self {
        force: [Block::ZERO; 3],
        torque_b: [Block::ZERO; 3],
        field: [Block::ZERO; 3],
        none: Block::ZERO,
    };

    /// Puts what acts on the hub into one lane.
    pub(super) fn put<D: LanedSet>(&mut self, lane: usize, inputs: &Inputs<D>) {
        put(&mut self.force, lane, components(&inputs.force));
        put(&mut self.torque_b, lane, components(&inputs.torque_b));
        let (field, none) = match &inputs.gravity {
            Gravity::Uniform(field) => (components(field), -0.0),
            Gravity::None | Gravity::Central { .. } => ([0.0; 3], 0.0),
        };
        put(&mut self.field, lane, field);
        self.none.put(lane, none);
    }
}
