//! The simulator's engine behind the C interface of `precess_engine.h`, for functional mock-up units.
//!
//! A run is one allocation, which its caller owns: the scenario, and the run that borrows it. `unsafe` is where a pointer
//! becomes a value, and where a run borrows what lies beside it. Whatever goes wrong is a message; what would unwind into C is
//! caught, and the run is not used again.
//!
//! No pointer may be null but where the header says so: its one caller is the C of the unit.
#![allow(unsafe_code, reason = "C calls these functions, and gives pointers")]

use std::ffi::{c_char, c_int};
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::{ptr, slice};

use precess::engine::CoupledRun;
use precess::file::from_filled;
use precess::scenario::Scenario;

/// A run in progress.
pub struct Engine {
    /// Borrows what `scenario` points to, and is dropped first.
    run: Option<CoupledRun<'static>>,
    /// Of `Box::into_raw`.
    scenario: *mut Scenario,
    /// Why it does not go on.
    failed: Option<String>,
    /// The last bytes that were saved.
    saved: Vec<u8>,
}

impl Engine {
    /// The run of a scenario.
    fn begin(text: &[u8]) -> Result<Self, String> {
        let text = str::from_utf8(text).map_err(|error| format!("the scenario: {error}"))?;
        let read = from_filled("scenario", text);
        let (scenario, _) = read.map_err(|errors| format!("the scenario: {errors}"))?;
        let scenario = Box::into_raw(Box::new(scenario));
        let mut engine = Self { run: None, scenario, failed: None, saved: Vec::new() };
        engine.begin_again()?;
        Ok(engine)
    }

    /// The run anew.
    fn begin_again(&mut self) -> Result<(), String> {
        self.run = None;
        // SAFETY: it is what `Box::into_raw` has made, is not changed, and is freed after the run, which alone refers to it.
        let scenario: &'static Scenario = unsafe { &*self.scenario };
        self.run = Some(CoupledRun::new(scenario).map_err(|error| error.to_string())?);
        Ok(())
    }

    /// Goes on from a checkpoint, also once it has failed.
    fn restore(&mut self, bytes: &[u8]) -> Result<(), String> {
        if self.failed.is_some() {
            // What has failed may have left anything.
            catch(|| self.begin_again())?;
        }
        let Some(run) = &mut self.run else { return Err("there is no run".to_owned()) };
        catch(|| run.restore(bytes).map_err(|error| error.to_string()))?;
        self.failed = None;
        Ok(())
    }

    /// What a function makes of the run; once it has failed, why.
    fn with<T>(
        &mut self,
        call: impl FnOnce(&mut CoupledRun<'static>) -> Result<T, String>,
    ) -> Result<T, String> {
        if let Some(why) = &self.failed {
            return Err(why.clone());
        }
        let Some(run) = &mut self.run else { return Err("there is no run".to_owned()) };
        let found = catch(|| call(run));
        if let Err(why) = &found {
            self.failed = Some(why.clone());
        }
        found
    }
}

impl Drop for Engine {
    fn drop(&mut self) {
        self.run = None;
        // SAFETY: it is what `Box::into_raw` has made, and nothing refers to it any more.
        drop(unsafe { Box::from_raw(self.scenario) });
    }
}

/// A call, and what would unwind from it as a message.
fn catch<T>(call: impl FnOnce() -> Result<T, String>) -> Result<T, String> {
    catch_unwind(AssertUnwindSafe(call))
        .unwrap_or_else(|_| Err("the engine has failed; this is an error of Precess".to_owned()))
}

/// One of well, else zero with the message as far as there is room.
///
/// # Safety
///
/// `why` points to `room` bytes, at least one.
unsafe fn answer(found: Result<(), String>, why: *mut c_char, room: usize) -> c_int {
    let Err(message) = found else { return 1 };
    let mut length = message.len().min(room - 1);
    while !message.is_char_boundary(length) {
        length -= 1;
    }
    // SAFETY: by contract; no more than `room` bytes with the zero.
    unsafe {
        ptr::copy_nonoverlapping(message.as_ptr(), why.cast(), length);
        *why.add(length) = 0;
    }
    0
}

/// See `precess_engine.h`.
///
/// # Safety
///
/// `scenario` points to `size` bytes and `why` to `room`, at least one.
// SAFETY: no other symbol has the name.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn precess_engine_new(
    scenario: *const u8,
    size: usize,
    why: *mut c_char,
    room: usize,
) -> *mut Engine {
    // SAFETY: by contract.
    let text = unsafe { slice::from_raw_parts(scenario, size) };
    match catch(|| Engine::begin(text)) {
        Ok(engine) => Box::into_raw(Box::new(engine)),
        Err(message) => {
            // SAFETY: by contract.
            unsafe { answer(Err(message), why, room) };
            ptr::null_mut()
        }
    }
}

/// See `precess_engine.h`.
///
/// # Safety
///
/// `engine` is null, or of [`precess_engine_new`] and not used again.
// SAFETY: no other symbol has the name.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn precess_engine_free(engine: *mut Engine) {
    if !engine.is_null() {
        // SAFETY: by contract.
        let engine = unsafe { Box::from_raw(engine) };
        let _ = catch(|| {
            drop(engine);
            Ok(())
        });
    }
}

/// See `precess_engine.h`.
///
/// # Safety
///
/// `engine` is of [`precess_engine_new`]; `inputs` points to so many numbers, `is_over` to one, `why` to `room` bytes, at least
/// one.
// SAFETY: no other symbol has the name.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn precess_engine_advance(
    engine: *mut Engine,
    inputs: *const f64,
    input_count: usize,
    time: f64,
    is_over: *mut c_int,
    why: *mut c_char,
    room: usize,
) -> c_int {
    // SAFETY: by contract.
    let (engine, inputs) = unsafe { (&mut *engine, slice::from_raw_parts(inputs, input_count)) };
    let reached = engine.with(|run| run.advance(inputs, time).map_err(|error| error.to_string()));
    let found = reached.map(|reached| {
        // SAFETY: by contract.
        unsafe { *is_over = c_int::from(!reached) };
    });
    // SAFETY: by contract.
    unsafe { answer(found, why, room) }
}

/// See `precess_engine.h`.
///
/// # Safety
///
/// `engine` is of [`precess_engine_new`]; `inputs` and `outputs` point to so many numbers, `why` to `room` bytes, at least one.
// SAFETY: no other symbol has the name.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn precess_engine_outputs(
    engine: *mut Engine,
    inputs: *const f64,
    input_count: usize,
    outputs: *mut f64,
    output_count: usize,
    why: *mut c_char,
    room: usize,
) -> c_int {
    // SAFETY: by contract.
    let (engine, inputs, outputs) = unsafe {
        (
            &mut *engine,
            slice::from_raw_parts(inputs, input_count),
            slice::from_raw_parts_mut(outputs, output_count),
        )
    };
    let found = engine.with(|run| {
        let row = run.outputs(inputs).map_err(|error| error.to_string())?;
        // The time is the importer's.
        match row.get(1..) {
            Some(row) if row.len() == outputs.len() => outputs.copy_from_slice(row),
            _ => return Err(format!("the scenario has {} columns", row.len())),
        }
        Ok(())
    });
    // SAFETY: by contract.
    unsafe { answer(found, why, room) }
}

/// See `precess_engine.h`.
///
/// # Safety
///
/// `engine` is of [`precess_engine_new`]; `size` points to a number and `why` to `room` bytes, at least one.
// SAFETY: no other symbol has the name.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn precess_engine_save(
    engine: *mut Engine,
    size: *mut usize,
    why: *mut c_char,
    room: usize,
) -> *const u8 {
    // SAFETY: by contract.
    let engine = unsafe { &mut *engine };
    match engine.with(|run| run.checkpoint().map_err(|error| error.to_string())) {
        Ok(bytes) => {
            engine.saved = bytes;
            // SAFETY: by contract.
            unsafe { *size = engine.saved.len() };
            engine.saved.as_ptr()
        }
        Err(message) => {
            // SAFETY: by contract.
            unsafe { answer(Err(message), why, room) };
            ptr::null()
        }
    }
}

/// See `precess_engine.h`.
///
/// # Safety
///
/// `engine` is of [`precess_engine_new`]; `bytes` points to `size` bytes and `why` to `room`, at least one.
// SAFETY: no other symbol has the name.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn precess_engine_restore(
    engine: *mut Engine,
    bytes: *const u8,
    size: usize,
    why: *mut c_char,
    room: usize,
) -> c_int {
    // SAFETY: by contract.
    let (engine, bytes) = unsafe { (&mut *engine, slice::from_raw_parts(bytes, size)) };
    // SAFETY: by contract.
    unsafe { answer(engine.restore(bytes), why, room) }
}

#[cfg(test)]
mod tests;
