//! What trackers reject, and that they stay as they were.

use precess_control::{DragSample, DragTracker, LineTracker, TrackerError};

#[test]
fn a_memory_is_from_eight_samples_to_a_thousand_million() {
    for memory in [7.9, 0.0, -1.0, f64::NAN, f64::INFINITY, 1.1e9] {
        assert!(matches!(LineTracker::new(memory), Err(TrackerError::NotWithin { .. })));
        assert!(matches!(DragTracker::new(1.0, memory), Err(TrackerError::NotWithin { .. })));
    }
    for inertia in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        assert!(matches!(DragTracker::new(inertia, 8.0), Err(TrackerError::NotWithin { .. })));
    }
    assert_eq!(
        LineTracker::new(2.0).unwrap_err().to_string(),
        "memory in samples is 2; it must be from 8 to 1000000000"
    );
}

#[test]
fn what_is_not_finite_leaves_a_tracker_as_it_was() {
    let mut line = LineTracker::new(10.0).unwrap();
    let mut drag = DragTracker::new(1.0, 10.0).unwrap();
    let sample = DragSample { elapsed: 0.1, torque: 0.2, drag: 0.3, rate: 4.0 };
    for k in 0..5 {
        line.update(f64::from(k), 1.0, f64::from(k)).unwrap();
        drag.update(&sample).unwrap();
    }
    let before = (line, drag);
    for wrong in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        for numbers in [[wrong, 1.0, 1.0], [1.0, wrong, 1.0], [1.0, 1.0, wrong]] {
            let [angle, gain, signal] = numbers;
            assert!(line.update(angle, gain, signal).is_err());
        }
        for sample in [
            DragSample { elapsed: wrong, ..sample },
            DragSample { torque: wrong, ..sample },
            DragSample { drag: wrong, ..sample },
            DragSample { rate: wrong, ..sample },
            DragSample { elapsed: -1.0, ..sample },
        ] {
            assert!(drag.update(&sample).is_err());
        }
    }
    assert_eq!((line, drag), before);
}
