//! Energy, momenta and power of a snapshot, body by body.

use precess_dynamics::{Accelerations, Scalar};

use crate::case::Set;

use super::bodies::{Body, Point};
use super::vector::{Vector, cross, dot};
use super::{Snapshot, to_list, unknowns_of};

/// Sums over bodies, along N axes, and the sums of the bodies' magnitudes (the units of drifts).
#[derive(Clone, Copy, Debug)]
pub struct Momenta<T> {
    /// Linear momentum, kg m/s.
    pub linear: Vector<T>,
    /// Angular momentum about the inertial origin, kg m^2/s.
    pub angular: Vector<T>,
    /// Sum of the magnitudes of the bodies' linear momenta.
    pub linear_magnitudes: T,
    /// Sum of the magnitudes of the bodies' angular momenta, orbital and spin apart.
    pub angular_magnitudes: T,
}

/// Rate of the kinetic energy, and the power of forces and motors.
#[derive(Clone, Copy, Debug)]
pub struct PowerBalance<T> {
    /// Time derivative of the kinetic energy for these accelerations, W.
    pub energy_dot: T,
    /// `F.v_B + L_B.omega + sum(u * rate)`, W.
    pub power: T,
    /// Sum of the absolute values of all terms of both.
    pub magnitudes: T,
}

impl<T: Scalar> Snapshot<T> {
    /// Inertial velocity of a body's centre of mass along B axes.
    fn velocity(&self, body: &Body<T>) -> Vector<T> {
        self.v_b + body.centre.dot(self.omega)
    }

    /// Kinetic energy, J: `1/2 m v.v + 1/2 omega.I omega` of each body.
    #[must_use]
    pub fn energy(&self) -> T {
        let twice = self.bodies().fold(T::from_f64(0.0), |sum, body| {
            let (v, omega) = (self.velocity(body), body.omega_n(self.omega));
            sum + body.mass * dot(v, v) + dot(omega, body.inertia * omega)
        });
        T::from_f64(0.5) * twice
    }

    /// Linear momentum, and angular momentum about the inertial origin.
    #[must_use]
    pub fn momenta(&self) -> Momenta<T> {
        let (zero, nb) = (T::from_f64(0.0), self.bn.transpose());
        let mut sum = Momenta {
            linear: Vector::zero(),
            angular: Vector::zero(),
            linear_magnitudes: zero,
            angular_magnitudes: zero,
        };
        for body in self.bodies() {
            let linear = nb * self.velocity(body) * body.mass;
            let position = self.r_b_n + nb * body.centre.r;
            let orbital = cross(position, linear);
            let spin = nb * (body.inertia * body.omega_n(self.omega));
            sum.linear = sum.linear + linear;
            sum.angular = sum.angular + orbital + spin;
            sum.linear_magnitudes = sum.linear_magnitudes + linear.norm();
            sum.angular_magnitudes = sum.angular_magnitudes + orbital.norm() + spin.norm();
        }
        sum
    }

    /// Centre of mass of all bodies from B, along B axes, m: (9).
    #[must_use]
    pub fn centre_of_mass(&self) -> (T, Point<T>) {
        let bodies: Vec<_> = self.bodies().copied().collect();
        Point::centre_of_mass(&bodies)
    }

    /// The rate of the kinetic energy for these accelerations, and the power of forces and motors.
    ///
    /// Of each body: `m v.a + omega_{F/N} . H_dot about its centre` (the moment's gyroscopic part
    /// does no work, but is left in). One term is one product of two components, with `a` in the
    /// five parts of (8) and (10) and `H_dot` in the four of (84)-(86). The parts count one by one
    /// because B's acceleration is the unknown: on a hub that turns about a distant centre of
    /// mass, the sums `a` all but vanish, and even exact accelerations, rounded to f64, would
    /// exceed 50 epsilons of their products.
    #[must_use]
    pub fn power_balance<const N: usize>(
        &self,
        accelerations: &Accelerations<Set<N, T>>,
    ) -> PowerBalance<T> {
        let list = to_list(accelerations);
        let omega_dot = Vector([list[3], list[4], list[5]]);
        let mut energy = Terms::new();
        for (index, body) in self.bodies().enumerate() {
            let device = index.saturating_sub(1) / 3;
            let unknowns = unknowns_of(&list, device);
            let momentum = self.velocity(body) * body.mass;
            let Point { r, r_prime, r_dprime } = body.centre;
            energy.product(momentum, Vector([list[0], list[1], list[2]]));
            energy.product(momentum, r_dprime.value(&unknowns));
            energy.product(momentum, cross(omega_dot, r));
            energy.product(momentum, cross(self.omega, r_prime) * T::from_f64(2.0));
            energy.product(momentum, cross(self.omega, cross(self.omega, r)));

            let omega_n = body.omega_n(self.omega);
            let relative = body.frame.omega_prime.value(&unknowns);
            energy.product(omega_n, body.inertia * omega_dot);
            energy.product(omega_n, body.inertia * relative);
            energy.product(omega_n, body.inertia_prime() * omega_n);
            energy.product(omega_n, cross(self.omega, body.inertia * omega_n));
        }
        let mut power = Terms::new();
        power.product(self.force, self.v_b);
        power.product(self.torque_b, self.omega);
        for (torque, rate) in self.motors.iter().flatten() {
            power.add(*torque * *rate);
        }
        PowerBalance {
            energy_dot: energy.sum,
            power: power.sum,
            magnitudes: energy.magnitudes + power.magnitudes,
        }
    }
}

/// A sum, and the sum of the absolute values of its terms.
struct Terms<T> {
    sum: T,
    magnitudes: T,
}

impl<T: Scalar> Terms<T> {
    fn new() -> Self {
        Self { sum: T::from_f64(0.0), magnitudes: T::from_f64(0.0) }
    }

    fn add(&mut self, term: T) {
        self.sum = self.sum + term;
        self.magnitudes = self.magnitudes + term.abs();
    }

    fn product(&mut self, a: Vector<T>, b: Vector<T>) {
        for (a, b) in a.0.into_iter().zip(b.0) {
            self.add(a * b);
        }
    }
}
