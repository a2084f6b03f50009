//! Random numbers, rotations and solid bodies, the same for a seed on every host.

use core::f64::consts::PI;

use nalgebra::{Matrix3, Quaternion, UnitQuaternion, Vector3};

/// All suites start here; spacecraft `n` of a suite is drawn from `SEED + n`.
pub(crate) const SEED: u64 = 0x1AC_17C1;

/// The generator `SplitMix64`.
#[derive(Clone, Debug)]
pub(crate) struct Random(u64);

impl Random {
    /// Starts at a seed; neighbouring seeds give unrelated numbers.
    pub(crate) const fn new(seed: u64) -> Self {
        Self(seed)
    }

    fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let z = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        z ^ (z >> 31)
    }

    /// Uniform between two bounds.
    #[expect(clippy::cast_precision_loss, reason = "53 bits are exact")]
    pub(crate) fn within(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * ((self.bits() >> 11) as f64 / (1_u64 << 53) as f64)
    }

    /// Log-uniform between two positive bounds.
    pub(crate) fn log_within(&mut self, low: f64, high: f64) -> f64 {
        libm::exp(self.within(libm::log(low), libm::log(high)))
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

    /// A vector of given length in a uniform direction.
    pub(crate) fn vector(&mut self, length: f64) -> Vector3<f64> {
        loop {
            let v = Vector3::from_fn(|_, _| self.within(-1.0, 1.0));
            if (0.01..=1.0).contains(&v.norm_squared()) {
                return v * (length / v.norm());
            }
        }
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
