//! [`Cpu`]: instructions for single numbers that not every CPU of the target has.
//!
//! On x86-64 three operands instead of two. Not the widest registers: among single numbers the
//! compiler finds vectors to fill them with, and gathering those takes longer than it saves.

use pulp::WithSimd;

/// The proof that this CPU has them.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Cpu(Instructions);

#[cfg(target_arch = "x86_64")]
type Instructions = pulp::x86::V3;

#[cfg(not(target_arch = "x86_64"))]
type Instructions = pulp::Arch;

impl Cpu {
    /// Asks this CPU.
    pub(crate) fn detected() -> Option<Self> {
        #[cfg(target_arch = "x86_64")]
        let found = pulp::x86::V3::try_new();
        #[cfg(not(target_arch = "x86_64"))]
        let found = Some(pulp::Arch::new()).filter(|cpu| !matches!(cpu, pulp::Arch::Scalar));
        found.map(Self)
    }

    /// Does something in a function that may use them.
    #[inline]
    pub(crate) fn dispatch<W: WithSimd>(self, work: W) -> W::Output {
        #[cfg(target_arch = "x86_64")]
        let found = pulp::Simd::vectorize(self.0, work);
        #[cfg(not(target_arch = "x86_64"))]
        let found = self.0.dispatch(work);
        found
    }
}
