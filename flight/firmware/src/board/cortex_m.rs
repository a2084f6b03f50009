//! Cortex-M with a floating point unit: vectors, the unit switched on, semihosting, the SysTick
//! timer.

use core::arch::{asm, global_asm};
use core::fmt::{self, Write};

// The table of vectors: the stack, the start, and one handler of all fourteen faults. `.thumb_func`
// marks the start as Thumb code, so that the linker sets the lowest bit of its address.
global_asm!(
    ".section .vectors, \"a\"",
    ".word _stack_top",
    ".word _start",
    ".rept 14",
    ".word fault",
    ".endr",
    ".section .text._start, \"ax\"",
    ".global _start",
    ".thumb_func",
    "_start:",
    // CPACR: full access to coprocessors 10 and 11, the floating point unit.
    "ldr r0, =0xe000ed88",
    "ldr r1, [r0]",
    "orr r1, r1, #(0xf << 20)",
    "str r1, [r0]",
    "dsb",
    "isb",
    "bl rust_main",
    ".thumb_func",
    "fault:",
    // A fault ends the program without success: semihosting operation 0x18, a word that is not
    // the one of a program that is done.
    "movs r0, #0x18",
    "movs r1, #0",
    "bkpt 0xab",
    "b fault",
);

/// The debugger's console.
#[derive(Debug)]
pub struct Console;

impl Write for Console {
    fn write_str(&mut self, text: &str) -> fmt::Result {
        for byte in text.bytes() {
            // SAFETY: operation 3 reads the one byte that the pointer points to.
            unsafe { semihosting(3, (&raw const byte).cast()) };
        }
        Ok(())
    }
}

/// Ends the program.
pub fn exit(success: bool) -> ! {
    // `ADP_Stopped_ApplicationExit` with the status.
    let block: [usize; 2] = [0x2_0026, usize::from(!success)];
    loop {
        // SAFETY: operation 0x20 reads the two words that the pointer points to.
        unsafe { semihosting(0x20, (&raw const block).cast()) };
    }
}

/// Asks the debugger.
///
/// # Safety
/// The argument points to what the operation reads.
unsafe fn semihosting(operation: usize, argument: *const u8) {
    // SAFETY: the debugger reads what the argument points to, as the caller grants, and returns in
    // r0.
    unsafe {
        asm!("bkpt 0xab", inout("r0") operation => _, in("r1") argument, options(nostack));
    }
}

/// The SysTick timer, counting down from its largest value.
#[derive(Debug)]
pub struct Timer;

/// Largest value of the 24-bit counter.
const WRAP: u32 = 0x00FF_FFFF;

/// SysTick: control, reload, current value.
const SYST: [*mut u32; 3] =
    [0xE000_E010 as *mut u32, 0xE000_E014 as *mut u32, 0xE000_E018 as *mut u32];

impl Timer {
    /// Starts it, by the processor's clock and without an interrupt.
    #[must_use]
    pub fn start() -> Self {
        // SAFETY: the registers are SysTick's own on every Cortex-M, and nothing else uses it here.
        unsafe {
            SYST[1].write_volatile(WRAP);
            SYST[2].write_volatile(0);
            SYST[0].write_volatile(0b101);
        }
        Self
    }

    /// Ticks since the start, up to 2^24.
    #[must_use]
    pub fn ticks(&self) -> u32 {
        // SAFETY: reading the counter changes nothing.
        WRAP - unsafe { SYST[2].read_volatile() }
    }
}
