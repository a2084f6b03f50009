//! [`launch_size`]: threads of a block by the registers of a kernel, and blocks by what the GPU holds at a time. The bits do
//! not depend on it.

/// Registers of a block, on every GPU with 64-bit arithmetic of this decade.
const REGISTERS: u32 = 65_536;
/// Threads that take one instruction together.
const WARP: u32 = 32;
/// The most threads of a block: small blocks end at different times, and the next ones begin.
const THREADS_MAX: u32 = 128;

/// Blocks, and threads of each.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct LaunchSize {
    /// Blocks.
    pub blocks: u32,
    /// Threads of a block.
    pub threads: u32,
}

/// The threads of a block of a kernel with so many registers a thread.
pub(crate) fn threads(registers: u32, threads_max: u32) -> u32 {
    // Registers are given to a warp in steps of eight a thread.
    let own = registers.max(1).next_multiple_of(8);
    let fit = REGISTERS / own;
    (fit.min(threads_max).min(THREADS_MAX) / WARP).max(1) * WARP
}

/// The launch of a kernel with so many registers a thread over states; `resident` blocks of that size are held by the whole
/// GPU at a time. A thread takes more than one state where there are more.
#[must_use]
pub fn launch_size(registers: u32, threads_max: u32, resident: u32, states: u32) -> LaunchSize {
    let threads = threads(registers, threads_max);
    let blocks = states.div_ceil(threads).clamp(1, resident.max(1));
    LaunchSize { blocks, threads }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_block_fits_the_registers() {
        for registers in 1..=255 {
            let threads = threads(registers, 1024);
            assert!(threads.is_multiple_of(WARP) && threads <= THREADS_MAX);
            assert!(threads * registers.next_multiple_of(8) <= REGISTERS, "{registers}");
        }
        assert_eq!(threads(255, 64), 64);
        // A kernel that no block fits is launched with a warp, and the driver says so.
        assert_eq!(threads(4096, 1024), WARP);
    }

    #[test]
    fn there_are_no_more_blocks_than_states_or_than_fit() {
        assert_eq!(launch_size(255, 1024, 264, 1), LaunchSize { blocks: 1, threads: 128 });
        assert_eq!(launch_size(255, 1024, 264, 129), LaunchSize { blocks: 2, threads: 128 });
        assert_eq!(launch_size(255, 1024, 264, 1_000_000).blocks, 264);
        assert_eq!(launch_size(255, 1024, 0, 0).blocks, 1);
    }
}
