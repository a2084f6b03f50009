//! [`Registers`]: the registers that several numbers are evaluated in, found at run time.

#![expect(clippy::inline_always, reason = "as pulp asks")]

use pulp::{Simd, WithSimd};

/// Up to so many devices are as fast in registers of four, of which less is left empty.
#[cfg(all(feature = "avx512", any(target_arch = "x86", target_arch = "x86_64")))]
const FEW: usize = 4;

/// The proof that this CPU has registers of several numbers.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Registers {
    /// Of AVX-512: eight numbers.
    #[cfg(all(feature = "avx512", any(target_arch = "x86", target_arch = "x86_64")))]
    Eight(pulp::x86::V4),
    /// Of AVX2: four numbers.
    #[cfg(any(target_arch = "x86", target_arch = "x86_64"))]
    Four(pulp::x86::V3),
    /// Of another architecture.
    #[cfg(not(any(target_arch = "x86", target_arch = "x86_64")))]
    Others(pulp::Arch),
}

impl Registers {
    /// The widest of this CPU; none where it has none that a portable build cannot name.
    pub(crate) fn widest() -> Option<Self> {
        #[cfg(all(feature = "avx512", any(target_arch = "x86", target_arch = "x86_64")))]
        if let Some(simd) = pulp::x86::V4::try_new() {
            return Some(Self::Eight(simd));
        }
        #[cfg(any(target_arch = "x86", target_arch = "x86_64"))]
        let found = pulp::x86::V3::try_new().map(Self::Four);
        #[cfg(not(any(target_arch = "x86", target_arch = "x86_64")))]
        let found = Some(pulp::Arch::new())
            .filter(|cpu| !matches!(cpu, pulp::Arch::Scalar))
            .map(Self::Others);
        found
    }

    /// Those that so many devices fill.
    #[cfg_attr(
        not(all(feature = "avx512", any(target_arch = "x86", target_arch = "x86_64"))),
        expect(unused_variables, reason = "there are registers of one width")
    )]
    pub(crate) fn for_devices(devices: usize) -> Option<Self> {
        #[cfg(all(feature = "avx512", any(target_arch = "x86", target_arch = "x86_64")))]
        if devices <= FEW {
            return pulp::x86::V3::try_new().map(Self::Four);
        }
        Self::widest()
    }

    /// How many numbers they hold.
    pub(crate) fn width(self) -> usize {
        self.dispatch(Width)
    }

    /// Does something in a function that may use them.
    #[inline(always)]
    pub(crate) fn dispatch<W: WithSimd>(self, work: W) -> W::Output {
        match self {
            #[cfg(all(feature = "avx512", any(target_arch = "x86", target_arch = "x86_64")))]
            Self::Eight(simd) => Simd::vectorize(simd, work),
            #[cfg(any(target_arch = "x86", target_arch = "x86_64"))]
            Self::Four(simd) => Simd::vectorize(simd, work),
            #[cfg(not(any(target_arch = "x86", target_arch = "x86_64")))]
            Self::Others(arch) => arch.dispatch(work),
        }
    }
}

struct Width;

impl WithSimd for Width {
    type Output = usize;

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) -> usize {
        S::F64_LANES
    }
}
