//! Random numbers, rotations and solid bodies, the same for a seed on every host.

use core::f64::consts::PI;
use core::ops::{Deref, DerefMut};

use nalgebra::{Matrix3, Quaternion, UnitQuaternion, Vector3};
use precess_tests::random;

/// All suites start here; spacecraft `n` of a suite is drawn from `SEED + n`.
pub(crate) const SEED: u64 = 0x1AC_17C1;

/// The suites' generator, with the distributions that mixed spacecraft are drawn from.
#[derive(Clone, Debug)]
pub(crate) struct Random(random::Random);

impl Deref for Random {
    type Target = random::Random;

    fn deref(&self) -> &random::Random {
        &self.0
    }
}

impl DerefMut for Random {
    fn deref_mut(&mut self) -> &mut random::Random {
        &mut self.0
    }
}

impl Random {
    /// Starts at a seed; neighbouring seeds give unrelated numbers.
    pub(crate) const fn new(seed: u64) -> Self {
        Self(random::Random::new(seed))
    }

    /// Either sign, log-uniform from a thousandth of `largest`.
    pub(crate) fn signed(&mut self, largest: f64) -> f64 {
        let magnitude = self.log_within(1e-3 * largest, largest);
        if self.chance(0.5) { magnitude } else { -magnitude }
    }

    /// Whether something happens that has this probability.
    pub(crate) fn chance(&mut self, probability: f64) -> bool {
        self.within(0.0, 1.0) < probability
    }

    /// A uniform rotation, orthonormal to rounding.
    pub(crate) fn rotation(&mut self) -> Matrix3<f64> {
        let q = self.unit_quaternion();
        *q.to_rotation_matrix().matrix()
    }

    /// A uniform unit quaternion.
    pub(crate) fn unit_quaternion(&mut self) -> UnitQuaternion<f64> {
        loop {
            let [w, x, y, z] = core::array::from_fn(|_| self.within(-1.0, 1.0));
            let q = Quaternion::new(w, x, y, z);
            if (0.01..=1.0).contains(&q.norm_squared()) {
                return UnitQuaternion::from_quaternion(q);
            }
        }
    }

    /// The inertia of a solid block of given mass, edges of 0.05 to 3 m, turned at random.
    pub(crate) fn block(&mut self, mass: f64) -> Matrix3<f64> {
        let edges = Vector3::from_fn(|_, _| self.log_within(0.05, 3.0));
        let squares = edges.component_mul(&edges);
        let moments = Vector3::from_element(squares.sum()) - squares;
        turned(moments * (mass / 12.0), &self.rotation())
    }

    /// Moments of a solid disc about its axis and across it, with its radius of 0.02 to 0.5 m.
    pub(crate) fn disc(&mut self, mass: f64) -> ([f64; 2], f64) {
        let radius = self.log_within(0.02, 0.5);
        let thickness = radius * self.within(0.1, 1.0);
        let axial = mass * radius * radius / 2.0;
        ([axial, axial / 2.0 + mass * thickness * thickness / 12.0], radius)
    }

    /// The inertia of a solid disc whose axis is tilted from x by 1e-6 to 0.1 rad, with its radius.
    pub(crate) fn tilted_disc(&mut self, mass: f64) -> (Matrix3<f64>, f64) {
        let ([axial, across], radius) = self.disc(mass);
        let (tilt, direction) = (self.log_within(1e-6, 0.1), self.within(-PI, PI));
        let towards = Vector3::new(0.0, libm::cos(direction), libm::sin(direction));
        let tilt = UnitQuaternion::from_scaled_axis(towards * tilt);
        let axes = tilt.to_rotation_matrix();
        (turned(Vector3::new(axial, across, across), axes.matrix()), radius)
    }
}

/// Principal moments along turned axes: a matrix symmetric to the last bit.
fn turned(moments: Vector3<f64>, axes: &Matrix3<f64>) -> Matrix3<f64> {
    let inertia = axes * Matrix3::from_diagonal(&moments) * axes.transpose();
    (inertia + inertia.transpose()) * 0.5
}
