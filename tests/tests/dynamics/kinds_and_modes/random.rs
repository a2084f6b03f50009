//! Seeded random numbers, rotations and solid bodies within the declared ranges: masses 0.1 to
//! 5000 kg, lengths to 3 m, `|omega|` to 1 rad/s, gimbal rates to 5 rad/s, wheels to 6000 rpm.

use precess_tests::cases;
use std::f64::consts::{PI, TAU};
use std::ops::{Deref, DerefMut};

use nalgebra::{Matrix3, Quaternion, UnitQuaternion, Vector3};
use precess_dynamics::kind::JointInfo;
use precess_tests::bearings::clearance;
use precess_tests::random;

/// Spacecraft `n` of a suite is drawn from `SEED + n`.
const SEED: u64 = 0x1A7_71CE;

/// 6000 rpm.
const FASTEST_WHEEL: f64 = 6000.0 * TAU / 60.0;

/// The suites' generator with the seed it started from, and what mixed spacecraft are drawn from.
#[derive(Clone, Debug)]
pub(crate) struct Random {
    pub(crate) seed: u64,
    numbers: random::Random,
}

impl Deref for Random {
    type Target = random::Random;

    fn deref(&self) -> &random::Random {
        &self.numbers
    }
}

impl DerefMut for Random {
    fn deref_mut(&mut self) -> &mut random::Random {
        &mut self.numbers
    }
}

/// The errors of spacecraft drawn from seed after seed.
#[derive(Debug)]
pub(crate) struct Errors(Vec<(f64, u64)>);

/// The errors over spacecraft drawn from so many seeds; NaN counts as infinite.
pub(crate) fn errors_of(seeds: u64, mut error: impl FnMut(&mut Random) -> f64) -> Errors {
    let of_seed = |seed| {
        let found = error(&mut Random::new(seed));
        (if found.is_nan() { f64::INFINITY } else { found }, seed)
    };
    let mut errors: Vec<_> = (SEED..SEED + cases(seeds)).map(of_seed).collect();
    errors.sort_by(|(a, _), (b, _)| a.total_cmp(b));
    Errors(errors)
}

impl Errors {
    /// Fails with the seed if one exceeds the bound; `--nocapture` shows it if none does.
    #[track_caller]
    pub(crate) fn are_within(&self, bound: f64) {
        let Some((worst, seed)) = self.0.last() else { return };
        let caller = std::panic::Location::caller();
        println!("worst {worst:.1e} of {bound:.1e}, seed {seed:#x}: {caller}");
        assert!(*worst <= bound, "{worst:e} exceeds {bound:e} at seed {seed:#x}");
    }

    /// Fails with its seed if the middle one exceeds the bound.
    #[track_caller]
    pub(crate) fn have_median_within(&self, bound: f64) {
        let (median, seed) = self.0[self.0.len() / 2];
        println!("median {median:.1e} of {bound:.1e}: {}", std::panic::Location::caller());
        assert!(median <= bound, "median {median:e} exceeds {bound:e} at seed {seed:#x}");
    }
}

impl Random {
    pub(crate) fn new(seed: u64) -> Self {
        Self { seed, numbers: random::Random::new(seed) }
    }

    /// An offset of 1 mm to 1 m.
    pub(crate) fn offset(&mut self) -> Vector3<f64> {
        let length = self.log_within(1e-3, 1.0);
        self.vector(length)
    }

    /// A position on the hub, up to 3 m from B.
    pub(crate) fn position(&mut self) -> Vector3<f64> {
        let length = self.within(0.0, 3.0);
        self.vector(length)
    }

    /// A uniform rotation.
    pub(crate) fn rotation(&mut self) -> UnitQuaternion<f64> {
        loop {
            let [w, x, y, z] = std::array::from_fn(|_| self.within(-1.0, 1.0));
            let q = Quaternion::new(w, x, y, z);
            if (0.01..=1.0).contains(&q.norm_squared()) {
                return UnitQuaternion::new_normalize(q);
            }
        }
    }

    /// The inertia of a solid block, turned at random.
    pub(crate) fn block(&mut self, mass: f64) -> Matrix3<f64> {
        let edges = Vector3::from_fn(|_, _| self.log_within(0.1, 3.0));
        let squares = edges.component_mul(&edges);
        let moments = Vector3::from_element(squares.sum()) - squares;
        let turn = self.rotation();
        turned(moments * (mass / 12.0), &turn)
    }

    /// The inertia of a solid disc about nearly the x axis, with its radius.
    pub(crate) fn disc(&mut self, mass: f64) -> (Matrix3<f64>, f64) {
        let radius = self.log_within(0.05, 0.5);
        let thickness = radius * self.within(0.1, 1.0);
        let axial = mass * radius * radius / 2.0;
        let across = axial / 2.0 + mass * thickness * thickness / 12.0;
        let (tilt, direction) = (self.log_within(1e-6, 0.1), self.within(-PI, PI));
        let axis = Vector3::new(0.0, libm::cos(direction), libm::sin(direction)) * tilt;
        let inertia =
            turned(Vector3::new(axial, across, across), &UnitQuaternion::from_scaled_axis(axis));
        (inertia, radius)
    }

    /// Coordinate and rate of a joint.
    pub(crate) fn joint(&mut self, info: &JointInfo) -> [f64; 2] {
        if let Some(largest) = clearance(info) {
            return largest.map(|largest| self.within(-largest, largest));
        }
        if info.slides {
            return [self.within(-0.5, 0.5), self.within(-1.0, 1.0)];
        }
        let fastest = if info.rate == "spin" { FASTEST_WHEEL } else { 5.0 };
        [self.within(-PI, PI), self.within(-fastest, fastest)]
    }
}

/// Principal moments along turned axes: a matrix symmetric to the last bit.
fn turned(moments: Vector3<f64>, turn: &UnitQuaternion<f64>) -> Matrix3<f64> {
    let axes = turn.to_rotation_matrix().into_inner();
    let inertia = axes * Matrix3::from_diagonal(&moments) * axes.transpose();
    (inertia + inertia.transpose()) * 0.5
}
