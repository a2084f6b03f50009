//! The functions of trackers, and trackers that have an estimate.

use precess_tracker::{DragSample, DragTracker, LineTracker};

use super::{Arguments, Call, bytes, taken};
use crate::tracking::{
    precess_drag_estimate_of, precess_drag_start, precess_drag_update, precess_line_estimate_of,
    precess_line_start, precess_line_update,
};

/// Each of them.
pub(super) fn calls() -> Vec<Call> {
    let line_start: fn(&mut Arguments<'_>) -> i32 = |of| {
        // SAFETY: each pointer is to memory larger than its structure, or is what a function rejects.
        unsafe { precess_line_start(taken(of, "line"), taken(of, "memory")) }
    };
    let line_update: fn(&mut Arguments<'_>) -> i32 = |of| {
        let line = taken(of, "line");
        // SAFETY: as above.
        unsafe { precess_line_update(line, taken(of, "angle"), taken(of, "gain"), 2.0) }
    };
    let line_estimate: fn(&mut Arguments<'_>) -> i32 = |of| {
        // SAFETY: as above.
        unsafe { precess_line_estimate_of(taken(of, "line"), taken(of, "out")) }
    };
    let drag_start: fn(&mut Arguments<'_>) -> i32 = |of| {
        // SAFETY: as above.
        unsafe { precess_drag_start(taken(of, "drag"), 1.0, taken(of, "memory")) }
    };
    let drag_update: fn(&mut Arguments<'_>) -> i32 = |of| {
        // SAFETY: as above.
        unsafe { precess_drag_update(taken(of, "drag"), taken(of, "elapsed"), 0.1, 0.1, 2.0) }
    };
    let drag_estimate: fn(&mut Arguments<'_>) -> i32 = |of| {
        // SAFETY: as above.
        unsafe { precess_drag_estimate_of(taken(of, "drag"), taken(of, "out")) }
    };
    vec![
        Call { name: "precess_line_start", call: line_start },
        Call { name: "precess_line_update", call: line_update },
        Call { name: "precess_line_estimate_of", call: line_estimate },
        Call { name: "precess_drag_start", call: drag_start },
        Call { name: "precess_drag_update", call: drag_update },
        Call { name: "precess_drag_estimate_of", call: drag_estimate },
    ]
}

/// A tracker of a line and one of a drag after ten samples.
pub(super) fn contents() -> [Vec<u8>; 2] {
    let mut line = LineTracker::new(50.0).unwrap();
    let mut drag = DragTracker::new(1.0, 50.0).unwrap();
    for k in 0..10 {
        let (angle, time) = (f64::from(k), 0.1 * f64::from(k));
        line.update(angle, 1.0, angle.cos()).unwrap();
        let sample = DragSample { elapsed: 0.1, torque: 0.0, drag: 0.5, rate: 3.0 - 0.5 * time };
        drag.update(&sample).unwrap();
    }
    [bytes(&line), bytes(&drag)]
}
