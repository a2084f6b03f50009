//! Deliberately bad libraries, one per feature: what the gates of `cargo xtask flight` must catch.
//!
//! Without a feature it is valid: its export does correctly what the bad ones do wrongly.

#![no_std]

#[cfg(feature = "allocates")]
extern crate alloc;

use core::hint::black_box;

#[panic_handler]
fn panic(_: &core::panic::PanicInfo<'_>) -> ! {
    loop {}
}

/// An element, if there is one.
// SAFETY: no other symbol has the name.
#[cfg(not(any(feature = "incomplete", feature = "panics")))]
#[unsafe(no_mangle)]
pub extern "C" fn precess_twin(numbers: &[f64; 8], index: usize) -> f64 {
    numbers.get(index).copied().unwrap_or(0.0) + worse(index)
}

/// An element, if there is one; else a panic.
// SAFETY: no other symbol has the name.
#[cfg(feature = "panics")]
#[unsafe(no_mangle)]
pub extern "C" fn precess_twin(numbers: &[f64; 8], index: usize) -> f64 {
    numbers[index] + worse(index)
}

/// Nothing more.
#[cfg(not(any(feature = "deep", feature = "recursive", feature = "indirect")))]
fn worse(_: usize) -> f64 {
    black_box(0.0)
}

/// With 64 KiB of stack.
#[cfg(feature = "deep")]
fn worse(index: usize) -> f64 {
    let numbers = black_box([0.0; 8192]);
    numbers.get(index).copied().unwrap_or(0.0)
}

/// By calling itself.
#[cfg(feature = "recursive")]
#[inline(never)]
fn worse(index: usize) -> f64 {
    if index == 0 { black_box(0.0) } else { black_box(worse(black_box(index - 1))) + 1.0 }
}

/// Through a pointer that nothing is known of.
#[cfg(feature = "indirect")]
fn worse(index: usize) -> f64 {
    let call: fn(usize) -> f64 = black_box(|index| if index == 0 { 0.0 } else { 1.0 });
    call(index)
}
