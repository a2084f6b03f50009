//! What a seed draws: against another program, in any order, and its distribution.

use nalgebra::Vector3;
use precess_control::{Gyro, GyroOutput, GyroParameters, Noise};

/// By SHA-256 of Python's `hashlib`, `ChaCha8` in thirty lines of Python, and its `math`: a seed means the same with any
/// version of the crates.
const BY_PYTHON: [(u64, [f64; 8]); 2] = [
    (
        0,
        [
            -1.076_789_194_738_928,
            -1.079_392_151_921_985_8,
            0.132_951_446_316_637_3,
            -0.298_073_995_691_678_2,
            -0.800_635_081_334_963_5,
            -0.971_216_662_542_968_5,
            -0.755_369_147_686_510_4,
            0.357_128_083_312_213_2,
        ],
    ),
    (
        8_589_934_592,
        [
            -1.180_800_636_232_407_3,
            1.622_360_557_263_564,
            -0.399_176_521_736_546_1,
            0.471_520_727_763_344_36,
            -0.989_965_692_990_151_6,
            0.248_673_146_338_262_54,
            -1.914_156_869_972_724_5,
            -2.230_615_066_916_155,
        ],
    ),
];

/// Logarithm, sine and root round by one unit at most, in either program.
const ROUNDING: f64 = 4e-15;

#[test]
fn the_numbers_of_a_sample_are_those_of_another_program() {
    let noise = Noise::new(7, "gyro");
    for (sample, stored) in BY_PYTHON {
        for (found, stored) in noise.at(sample).iter().zip(stored) {
            assert!((found - stored).abs() < ROUNDING, "{found} {stored}");
        }
    }
}

#[test]
fn a_sample_draws_the_same_in_any_order_and_on_any_thread() {
    let noise = Noise::new(3, "st");
    let forward: Vec<_> = (0..100).map(|k| noise.at(k)).collect();
    let mut backward: Vec<_> = (0..100).rev().map(|k| noise.at(k)).collect();
    backward.reverse();
    assert_eq!(forward, backward);
    let parts: Vec<_> = std::thread::scope(|scope| {
        let threads = [0..50, 50..100].map(|part| {
            scope.spawn(|| part.map(|k| Noise::new(3, "st").at(k)).collect::<Vec<_>>())
        });
        threads.into_iter().flat_map(|thread| thread.join().unwrap()).collect()
    });
    assert_eq!(forward, parts);
}

#[test]
fn other_seeds_and_sensors_draw_other_numbers() {
    let one = Noise::new(1, "a").at(5);
    for other in [Noise::new(2, "a").at(5), Noise::new(1, "b").at(5), Noise::new(1, "a").at(6)] {
        assert!(one.iter().zip(&other).all(|(a, b)| a != b));
    }
}

/// Moments of normal numbers, and their independence, within five standard deviations: exceeded once in two million seeds.
#[test]
fn the_numbers_are_normal_and_independent() {
    const COUNT: u32 = 20_000;
    let noise = Noise::new(11, "imu");
    let drawn: Vec<[f64; 8]> = (0..u64::from(COUNT)).map(|k| noise.at(k)).collect();
    let mean = |of: &dyn Fn(&[f64; 8]) -> f64| drawn.iter().map(of).sum::<f64>() / f64::from(COUNT);
    let bound = |variance: f64| 5.0 * (variance / f64::from(COUNT)).sqrt();
    for i in 0..8 {
        assert!(mean(&|n| n[i]).abs() < bound(1.0));
        assert!((mean(&|n| n[i].powi(2)) - 1.0).abs() < bound(2.0));
        assert!(mean(&|n| n[i].powi(3)).abs() < bound(15.0));
        assert!((mean(&|n| n[i].powi(4)) - 3.0).abs() < bound(96.0));
        // 4.55 % are beyond two standard deviations.
        let beyond = mean(&|n| f64::from(u8::from(n[i].abs() > 2.0)));
        assert!((beyond - 0.0455).abs() < bound(0.0455 * 0.9545));
        for j in 0..i {
            assert!(mean(&|n| n[i] * n[j]).abs() < bound(1.0));
        }
    }
    let next = drawn.windows(2).map(|pair| pair[0][0] * pair[1][0]).sum::<f64>();
    assert!((next / f64::from(COUNT)).abs() < bound(1.0));
}

/// Two gyros of one seed and name read the same bits, whatever is between.
#[test]
fn a_sensor_reads_the_same_bits_again() {
    let parameters = GyroParameters {
        output: GyroOutput::Integrating,
        period: 0.1,
        angle_random_walk: 1e-5,
        rate_random_walk: 1e-7,
        bias: Vector3::new(1e-5, -2e-5, 3e-5),
        quantum: 1e-7,
    };
    let read = || {
        let mut gyro = Gyro::new(&parameters, 5, "imu").unwrap();
        (0..50).map(|k| gyro.measure(&Vector3::new(0.01, 0.0, f64::from(k)))).collect::<Vec<_>>()
    };
    let first = read();
    let mut other = Gyro::new(&parameters, 6, "imu").unwrap();
    let _ = other.measure(&Vector3::zeros());
    assert_eq!(first, read());
}
