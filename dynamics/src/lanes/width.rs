//! Which registers serve how many devices.

use pulp::{Arch, Simd, WithSimd};

/// Up to so many devices are as fast in registers of four, of which less is left empty.
const FEW: usize = 4;

/// The widest registers of the CPU at hand that so many devices fill.
pub(super) fn lanes_for(devices: usize) -> Arch {
    #[cfg(any(target_arch = "x86", target_arch = "x86_64"))]
    if let (true, Some(simd)) = (devices <= FEW, pulp::x86::V3::try_new()) {
        return Arch::V3(simd);
    }
    Arch::new()
}

/// Does something in the registers that so many devices were given, in code for no others.
#[inline(always)]
#[expect(clippy::inline_always, reason = "as pulp asks")]
pub(super) fn dispatch<W: WithSimd, const DEVICES: usize>(lanes: Arch, work: W) -> W::Output {
    #[cfg(target_arch = "x86_64")]
    if const { DEVICES <= FEW } {
        return match lanes {
            Arch::V3(simd) => Simd::vectorize(simd, work),
            _ => Simd::vectorize(pulp::Scalar, work),
        };
    }
    lanes.dispatch(work)
}

/// Does something in the widest registers of the CPU at hand, those of every batch; gives it back where there are none.
#[inline(always)]
#[expect(clippy::inline_always, reason = "as pulp asks")]
pub(super) fn widest<W: WithSimd>(work: W) -> Result<W::Output, W> {
    #[cfg(any(target_arch = "x86", target_arch = "x86_64"))]
    {
        #[cfg(feature = "avx512")]
        if let Some(simd) = pulp::x86::V4::try_new() {
            return Ok(Simd::vectorize(simd, work));
        }
        // No copy for single numbers: the scalar path has the same bits.
        match pulp::x86::V3::try_new() {
            Some(simd) => Ok(Simd::vectorize(simd, work)),
            None => Err(work),
        }
    }
    #[cfg(not(any(target_arch = "x86", target_arch = "x86_64")))]
    Ok(Arch::new().dispatch(work))
}

/// How many numbers the registers of [`widest`] hold.
pub(super) fn widest_width() -> usize {
    widest(Width).unwrap_or(1)
}

/// How many numbers they hold.
pub(super) fn width(lanes: Arch) -> usize {
    lanes.dispatch(Width)
}

struct Width;

impl WithSimd for Width {
    type Output = usize;

    #[inline(always)]
    #[expect(clippy::inline_always, reason = "as pulp asks")]
    fn with_simd<S: Simd>(self, _: S) -> usize {
        S::F64_LANES
    }
}
