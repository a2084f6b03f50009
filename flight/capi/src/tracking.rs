//! Trackers of a rotor: its imbalance line, its drag torque. In memory of the caller, without a spacecraft.

use precess_tracker::{DragSample, DragTracker, LineTracker, TrackerError};

use crate::error::Code;
use crate::memory::{OutputPointer, Plain, read};

/// `precess_line_estimate`.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C)]
pub struct LineEstimate {
    /// In the unit of the signal.
    pub mean: f64,
    /// By the gain.
    pub amplitude: f64,
    /// rad.
    pub phase: f64,
    /// Of cosine and sine.
    pub parts: [f64; 2],
    /// Variances of the parts, and their covariance.
    pub covariance: [f64; 3],
    /// Standard deviation.
    pub noise: f64,
}

/// `precess_drag_estimate`.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C)]
pub struct DragEstimate {
    /// By the expected drag.
    pub coefficient: f64,
    /// Of the coefficient.
    pub variance: f64,
    /// rad/s.
    pub rate: f64,
    /// Standard deviation, rad/s.
    pub noise: f64,
}

// As many numbers as the header has.
const _: () = assert!(size_of::<LineTracker>() == 27 * size_of::<f64>());
const _: () = assert!(size_of::<DragTracker>() == 16 * size_of::<f64>());

// SAFETY: floating-point numbers, as their `repr(C)` has them.
unsafe impl Plain for LineTracker {}
// SAFETY: as above.
unsafe impl Plain for DragTracker {}
// SAFETY: as above.
unsafe impl Plain for LineEstimate {}
// SAFETY: as above.
unsafe impl Plain for DragEstimate {}

impl From<TrackerError> for Code {
    fn from(error: TrackerError) -> Self {
        match error {
            TrackerError::NotFinite { .. } => Self::NotFinite,
            TrackerError::NotWithin { .. } => Self::Range,
        }
    }
}

/// The code of a call.
fn code(done: Result<(), Code>) -> i32 {
    done.err().unwrap_or(Code::Ok) as i32
}

/// Writes a tracker that was made.
///
/// # Safety
///
/// The pointer is null, misaligned or to a tracker.
unsafe fn started<T: Plain>(tracker: *mut T, made: Result<T, TrackerError>) -> i32 {
    // SAFETY: by contract.
    let to = unsafe { OutputPointer::new(tracker) };
    code(to.and_then(|to| {
        to.write(made?);
        Ok(())
    }))
}

/// Changes a tracker in place; one that rejects its sample stays as it was.
///
/// # Safety
///
/// The pointer is null, misaligned or to a tracker.
unsafe fn updated<T: Plain>(
    tracker: *mut T,
    update: impl FnOnce(&mut T) -> Result<(), TrackerError>,
) -> i32 {
    // SAFETY: by contract.
    let now = unsafe { read(tracker) };
    code(now.and_then(|mut now| {
        update(&mut now)?;
        // SAFETY: by contract.
        unsafe { OutputPointer::new(tracker) }?.write(now);
        Ok(())
    }))
}

/// Writes what a tracker estimates, where it does and it is finite.
///
/// # Safety
///
/// The pointers are null, misaligned or to their structures.
unsafe fn estimated<T: Plain, E: Plain>(
    tracker: *const T,
    out: *mut E,
    estimate: impl FnOnce(&T) -> Option<(E, [f64; 2])>,
) -> i32 {
    // SAFETY: by contract.
    let pointers =
        unsafe { read(tracker).and_then(|tracker| Ok((tracker, OutputPointer::new(out)?))) };
    code(pointers.and_then(|(tracker, out)| {
        let (found, numbers) = estimate(&tracker).ok_or(Code::Undetermined)?;
        if numbers.iter().any(|number| !number.is_finite()) {
            return Err(Code::Overflow);
        }
        out.write(found);
        Ok(())
    }))
}

/// See `precess_tracking.h`.
///
/// # Safety
///
/// `line` points to a tracker.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn precess_line_start(line: *mut LineTracker, memory: f64) -> i32 {
    // SAFETY: by contract.
    unsafe { started(line, LineTracker::new(memory)) }
}

/// See `precess_tracking.h`.
///
/// # Safety
///
/// `line` points to a tracker.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn precess_line_update(
    line: *mut LineTracker,
    angle: f64,
    gain: f64,
    signal: f64,
) -> i32 {
    // SAFETY: by contract.
    unsafe { updated(line, |line| line.update(angle, gain, signal)) }
}

/// See `precess_tracking.h`.
///
/// # Safety
///
/// `line` points to a tracker, `out` to its structure.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn precess_line_estimate_of(
    line: *const LineTracker,
    out: *mut LineEstimate,
) -> i32 {
    let estimate = |line: &LineTracker| {
        let found = line.estimate()?;
        let precess_tracker::LineEstimate { mean, amplitude, phase, parts, covariance, noise } =
            found;
        let to = LineEstimate { mean, amplitude, phase, parts, covariance, noise };
        Some((
            to,
            [mean + amplitude + phase, covariance[0] + covariance[1] + covariance[2] + noise],
        ))
    };
    // SAFETY: by contract.
    unsafe { estimated(line, out, estimate) }
}

/// See `precess_tracking.h`.
///
/// # Safety
///
/// `drag` points to a tracker.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn precess_drag_start(
    drag: *mut DragTracker,
    inertia: f64,
    memory: f64,
) -> i32 {
    // SAFETY: by contract.
    unsafe { started(drag, DragTracker::new(inertia, memory)) }
}

/// See `precess_tracking.h`.
///
/// # Safety
///
/// `drag` points to a tracker.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn precess_drag_update(
    drag: *mut DragTracker,
    elapsed: f64,
    torque: f64,
    expected: f64,
    rate: f64,
) -> i32 {
    let sample = DragSample { elapsed, torque, drag: expected, rate };
    // SAFETY: by contract.
    unsafe { updated(drag, |drag| drag.update(&sample)) }
}

/// See `precess_tracking.h`.
///
/// # Safety
///
/// `drag` points to a tracker, `out` to its structure.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn precess_drag_estimate_of(
    drag: *const DragTracker,
    out: *mut DragEstimate,
) -> i32 {
    let estimate = |drag: &DragTracker| {
        let found = drag.estimate()?;
        let precess_tracker::DragEstimate { coefficient, variance, rate, noise } = found;
        let to = DragEstimate { coefficient, variance, rate, noise };
        Some((to, [coefficient + rate, variance + noise]))
    };
    // SAFETY: by contract.
    unsafe { estimated(drag, out, estimate) }
}
