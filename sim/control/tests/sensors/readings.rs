//! Readings without noise: bias, quanta, what an integrating gyro counts, latencies, and what is rejected.

use nalgebra::Vector3;
use precess_control::{
    ControlError, DelayLine, Gyro, GyroOutput, GyroParameters, Quantum, StarTracker,
};
use precess_dynamics::{Attitude as _, Quaternion};

fn gyro(output: GyroOutput, quantum: f64) -> Gyro {
    let parameters = GyroParameters {
        output,
        period: 0.1,
        angle_random_walk: 0.0,
        rate_random_walk: 0.0,
        bias: Vector3::new(1e-3, -2e-3, 0.0),
        quantum,
    };
    Gyro::new(&parameters, 1, "imu").unwrap()
}

#[test]
fn without_noise_a_gyro_reads_rate_and_bias() {
    let omega = Vector3::new(0.1, 0.2, -0.3);
    for output in [GyroOutput::Sampled, GyroOutput::Integrating] {
        let mut gyro = gyro(output, 0.0);
        for _ in 0..10 {
            let read = gyro.measure(&omega);
            assert!((read - omega - Vector3::new(1e-3, -2e-3, 0.0)).amax() < 1e-16);
            assert_eq!(gyro.bias(), Vector3::new(1e-3, -2e-3, 0.0));
        }
    }
}

#[test]
fn a_quantum_rounds_to_the_nearest_multiple() {
    let quantum = Quantum::new(0.25).unwrap();
    for (value, read) in [(0.0, 0.0), (0.12, 0.0), (0.13, 0.25), (-0.13, -0.25), (-7.1, -7.0)] {
        assert_eq!(quantum.read(value), read);
    }
    assert_eq!(quantum.read_each(&Vector3::new(0.3, -0.4, 1.0)), Vector3::new(0.25, -0.5, 1.0));
    assert_eq!(Quantum::new(0.0).unwrap().read(0.123), 0.123);
    let mut sampled = gyro(GyroOutput::Sampled, 0.02);
    let read = sampled.measure(&Vector3::new(0.1, 0.2, -0.305));
    assert!((read - Vector3::new(0.1, 0.2, -0.3)).amax() < 1e-15, "{read}");
}

/// What is lost by one sample is counted by the next: the sum of angles stays within half a quantum of the truth.
#[test]
fn an_integrating_gyro_loses_no_angle() {
    let mut gyro = gyro(GyroOutput::Integrating, 1e-4);
    let mut counted = 0.0;
    for k in 1..=1000 {
        let read = gyro.measure(&Vector3::new(0.000_123, 0.0, 0.0)).x * 0.1;
        let steps = read / 1e-4;
        assert!((steps - steps.round()).abs() < 1e-9);
        counted += read;
        let truth = (0.000_123 + 1e-3) * 0.1 * f64::from(k);
        assert!((counted - truth).abs() <= 0.5e-4 * (1.0 + 1e-9), "{k}");
    }
}

#[test]
fn readings_arrive_a_latency_later_and_the_newest_only() {
    let mut line = DelayLine::new(0.25, 0.1).unwrap();
    let mut arrived = Vec::new();
    for k in 0..20_u32 {
        let now = 0.1 * f64::from(k);
        line.put(now, k);
        arrived.push(line.newest(now).map(|(_, reading)| reading));
    }
    // At 0.3 s has arrived what was measured at 0 s.
    let wanted = (0..20_u32).map(|k| k.checked_sub(3));
    assert!(arrived.into_iter().eq(wanted));
    // Read at a lower rate: the newest, and the time at which it was measured.
    let (measured, reading) = line.newest(2.06).unwrap();
    assert_eq!((reading, (measured - 1.8).abs() < 1e-12), (18, true));
    assert_eq!(line.newest(2.06), None);
    // A latency of whole periods, whose sum with a time rounds up.
    let mut whole = DelayLine::new(0.3, 0.1).unwrap();
    whole.put(0.1 + 0.2, ());
    assert!(whole.newest(0.6).is_some());
    // Without latency a reading is there at once.
    let mut none = DelayLine::new(0.0, 0.1).unwrap();
    none.put(1.7, 'x');
    assert_eq!(none.newest(1.7), Some((1.7, 'x')));
}

#[test]
fn parameters_out_of_range_are_rejected() {
    let sound = GyroParameters {
        output: GyroOutput::Sampled,
        period: 0.1,
        angle_random_walk: 0.0,
        rate_random_walk: 0.0,
        bias: Vector3::zeros(),
        quantum: 0.0,
    };
    let rejected = |parameters: GyroParameters| Gyro::new(&parameters, 1, "imu").unwrap_err();
    assert_eq!(
        rejected(GyroParameters { period: 0.0, ..sound }),
        ControlError::NotPositive { what: "sampling period", value: 0.0 }
    );
    assert_eq!(
        rejected(GyroParameters { quantum: -1.0, ..sound }),
        ControlError::Negative { what: "quantum", value: -1.0 }
    );
    assert!(StarTracker::new(Quaternion::identity(), Vector3::repeat(-1.0), 1, "st").is_err());
    let long = DelayLine::<()>::new(1.0, 1e-6).unwrap_err();
    assert_eq!(long.to_string(), "a latency of 1000000 periods is above 10000");
}
