//! The fuzz target of libFuzzer: any bytes as a scenario file. See `README.md`.
#![no_main]

#[path = "../input.rs"]
mod input;

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| {
    let _ = input::tried(bytes);
});
