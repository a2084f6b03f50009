//! LEON3, a big-endian SPARC V8: a trap table with register windows, a UART, power off.

use core::arch::{asm, global_asm};
use core::fmt::{self, Write};

// 256 traps of four words each, 4 KiB aligned. 0 starts; 5 and 6 spill and fill one of the eight
// register windows, which compiled code needs as soon as calls nest; all others end the program.
global_asm!(
    ".section .traps, \"ax\"",
    ".align 4096",
    ".global _start",
    "_start:",
    // 0: reset.
    "sethi %hi(start), %g4",
    "jmp %g4 + %lo(start)",
    "nop",
    "nop",
    ".rept 4",
    "ba fatal",
    "nop",
    "nop",
    "nop",
    ".endr",
    // 5: window overflow.
    "ba overflow",
    "rd %wim, %l3",
    "nop",
    "nop",
    // 6: window underflow.
    "ba underflow",
    "rd %wim, %l3",
    "nop",
    "nop",
    ".rept 249",
    "ba fatal",
    "nop",
    "nop",
    "nop",
    ".endr",
    ".section .text.start, \"ax\"",
    "start:",
    "set _start, %g1",
    "wr %g1, 0, %tbr",
    "wr %g0, 2, %wim",
    // Floating point unit, supervisor, traps, interrupts masked, window 0.
    "set 0x1fe0, %g1",
    "wr %g1, 0, %psr",
    "nop",
    "nop",
    "nop",
    "set _stack_top, %sp",
    "sub %sp, 96, %sp",
    "call rust_main",
    "nop",
    "fatal:",
    // A trap within a trap stops the emulation; the missing output shows it.
    "rd %psr, %g1",
    "andn %g1, 0x20, %g1",
    "wr %g1, 0, %psr",
    "nop",
    "nop",
    "nop",
    "ta 0",
    "nop",
    "overflow:",
    "mov %g1, %l7",
    "srl %l3, 1, %g1",
    "sll %l3, 7, %l4",
    "or %l4, %g1, %g1",
    "and %g1, 0xff, %g1",
    "save",
    "wr %g1, 0, %wim",
    "nop",
    "nop",
    "nop",
    "std %l0, [%sp + 0]",
    "std %l2, [%sp + 8]",
    "std %l4, [%sp + 16]",
    "std %l6, [%sp + 24]",
    "std %i0, [%sp + 32]",
    "std %i2, [%sp + 40]",
    "std %i4, [%sp + 48]",
    "std %i6, [%sp + 56]",
    "restore",
    "mov %l7, %g1",
    "jmp %l1",
    "rett %l2",
    "underflow:",
    "sll %l3, 1, %l4",
    "srl %l3, 7, %l5",
    "or %l5, %l4, %l5",
    "and %l5, 0xff, %l5",
    "wr %l5, 0, %wim",
    "nop",
    "nop",
    "nop",
    "restore",
    "restore",
    "ldd [%sp + 0], %l0",
    "ldd [%sp + 8], %l2",
    "ldd [%sp + 16], %l4",
    "ldd [%sp + 24], %l6",
    "ldd [%sp + 32], %i0",
    "ldd [%sp + 40], %i2",
    "ldd [%sp + 48], %i4",
    "ldd [%sp + 56], %i6",
    "save",
    "save",
    "jmp %l1",
    "rett %l2",
);

/// The UART: its data and its control register.
const UART: [*mut u32; 2] = [0x8000_0100 as *mut u32, 0x8000_0108 as *mut u32];

/// The UART.
#[derive(Debug)]
pub struct Console;

impl Write for Console {
    fn write_str(&mut self, text: &str) -> fmt::Result {
        for byte in text.bytes() {
            // SAFETY: the registers have these addresses on this board; 2 enables the transmitter,
            // and the emulated UART is always ready.
            unsafe {
                UART[1].write_volatile(2);
                UART[0].write_volatile(u32::from(byte));
            }
        }
        Ok(())
    }
}

/// Ends the program. The emulation has no status: the printed lines have to show it.
pub fn exit(_success: bool) -> ! {
    loop {
        // SAFETY: with traps disabled a trap stops the processor, and with it the emulation.
        unsafe {
            asm!(
                "rd %psr, {psr}",
                "andn {psr}, 0x20, {psr}",
                "wr {psr}, 0, %psr",
                "nop",
                "nop",
                "nop",
                "ta 0",
                psr = out(reg) _,
            );
        }
    }
}
