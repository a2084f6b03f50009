//! The state of a run and the names under which expressions know it.

use super::table1::{OMEGA, RATES};

/// What the equations of motion depend on, in the order of [`State::inputs`].
pub(super) const INPUTS: [&str; 12] = [
    "sin_gamma_o",
    "cos_gamma_o",
    "sin_gamma_i",
    "cos_gamma_i",
    "sin_theta",
    "cos_theta",
    "gamma_o_dot",
    "gamma_i_dot",
    "spin",
    "omega_bx",
    "omega_by",
    "omega_bz",
];

/// What energy and momenta depend on besides.
pub(super) const VELOCITY: [&str; 3] = ["r_b_n_dot_bx", "r_b_n_dot_by", "r_b_n_dot_bz"];

/// A state, or its slope.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct State {
    /// `gamma_o`, `gamma_i`, `theta`, rad.
    pub(super) angles: [f64; 3],
    /// Their rates, rad/s.
    pub(super) rates: [f64; 3],
    /// Body rate along B, rad/s.
    pub(super) omega: [f64; 3],
    /// Inertial velocity of B along B, m/s.
    pub(super) velocity: [f64; 3],
    /// Quaternion from B components to inertial ones, scalar first.
    pub(super) attitude: [f64; 4],
    /// Integral of sum u rate, J.
    pub(super) work: f64,
    /// Integral of sum |u rate|, J.
    pub(super) throughput: f64,
}

impl State {
    /// Table 1.
    pub(super) fn initial() -> Self {
        Self {
            angles: [0.0; 3],
            rates: RATES,
            omega: OMEGA,
            velocity: [0.0; 3],
            attitude: [1.0, 0.0, 0.0, 0.0],
            work: 0.0,
            throughput: 0.0,
        }
    }

    /// The numbers of [`INPUTS`]; sines from `libm`, so that bits do not depend on the host.
    pub(super) fn inputs(&self) -> [f64; 12] {
        let [(so, co), (si, ci), (st, ct)] = self.angles.map(libm::sincos);
        let ([o, i, w], [x, y, z]) = (self.rates, self.omega);
        [so, co, si, ci, st, ct, o, i, w, x, y, z]
    }

    /// `self + h slope`.
    pub(super) fn moved(&self, h: f64, slope: &Self) -> Self {
        Self {
            angles: plus(self.angles, h, slope.angles),
            rates: plus(self.rates, h, slope.rates),
            omega: plus(self.omega, h, slope.omega),
            velocity: plus(self.velocity, h, slope.velocity),
            attitude: plus(self.attitude, h, slope.attitude),
            work: self.work + h * slope.work,
            throughput: self.throughput + h * slope.throughput,
        }
    }

    /// `v` along B axes, along inertial axes.
    pub(super) fn inertial(&self, v: [f64; 3]) -> [f64; 3] {
        // v + 2 q0 (q x v) + 2 q x (q x v), for a quaternion of any length divided by its square.
        let [q0, q1, q2, q3] = self.attitude;
        let q = [q1, q2, q3];
        let square = q0 * q0 + q1 * q1 + q2 * q2 + q3 * q3;
        let once = cross(q, v);
        plus(plus(v, 2.0 * q0 / square, once), 2.0 / square, cross(q, once))
    }
}

/// `a + h b`.
pub(super) fn plus<const N: usize>(a: [f64; N], h: f64, b: [f64; N]) -> [f64; N] {
    std::array::from_fn(|k| a[k] + h * b[k])
}

/// `a x b`.
pub(super) fn cross([a, b, c]: [f64; 3], [x, y, z]: [f64; 3]) -> [f64; 3] {
    [b * z - c * y, c * x - a * z, a * y - b * x]
}

/// The derivative of a quaternion whose frame turns at `omega` along its own axes.
pub(super) fn turning([q0, q1, q2, q3]: [f64; 4], [x, y, z]: [f64; 3]) -> [f64; 4] {
    [
        -0.5 * (q1 * x + q2 * y + q3 * z),
        0.5 * (q0 * x + q2 * z - q3 * y),
        0.5 * (q0 * y + q3 * x - q1 * z),
        0.5 * (q0 * z + q1 * y - q2 * x),
    ]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn attitude_turns_as_the_body_does() {
        // A quarter turn about z in a thousand steps of the tangent: y of B becomes -x.
        let omega = [0.0, 0.0, std::f64::consts::FRAC_PI_2];
        let mut state = State { omega, ..State::initial() };
        for _ in 0..1000 {
            state.attitude = plus(state.attitude, 1e-3, turning(state.attitude, omega));
        }
        let [x, y, z] = state.inertial([0.0, 1.0, 0.0]);
        // Euler's rule stretches the quaternion and turns it too little, by h^2 omega^3 / 12.
        assert!((x + 1.0).abs() + y.abs() + z.abs() < 1e-6, "{x} {y} {z}");
    }
}
