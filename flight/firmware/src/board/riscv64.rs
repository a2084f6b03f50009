//! RISC-V 64 as QEMU's `virt` board has it: a UART, and a device that ends the emulation.

use core::arch::global_asm;
use core::fmt::{self, Write};

// Floating point on (`mstatus.FS` initial), traps to the end, a stack, the program.
global_asm!(
    ".section .text._start, \"ax\"",
    ".global _start",
    "_start:",
    "la t0, 2f",
    "csrw mtvec, t0",
    "li t0, 0x2000",
    "csrs mstatus, t0",
    "csrw fcsr, zero",
    "la sp, _stack_top",
    "call rust_main",
    ".align 2",
    "2:",
    // 0x3333 and a status in the upper half: ended without success.
    "li t0, 0x100000",
    "li t1, 0x13333",
    "sw t1, 0(t0)",
    "j 2b",
);

/// The UART's transmit register.
const UART: *mut u8 = 0x1000_0000 as *mut u8;

/// The device that ends the emulation.
const TEST: *mut u32 = 0x10_0000 as *mut u32;

/// The UART.
#[derive(Debug)]
pub struct Console;

impl Write for Console {
    fn write_str(&mut self, text: &str) -> fmt::Result {
        for byte in text.bytes() {
            // SAFETY: the register has this address on this board; the emulated UART is always
            // ready.
            unsafe { UART.write_volatile(byte) };
        }
        Ok(())
    }
}

/// Ends the program.
pub fn exit(success: bool) -> ! {
    let word = if success { 0x5555 } else { 0x1_3333 };
    loop {
        // SAFETY: the register has this address on this board.
        unsafe { TEST.write_volatile(word) };
    }
}
