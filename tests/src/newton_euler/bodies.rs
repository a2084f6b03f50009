//! Frames, points and bodies of one device, by the transport theorem; all seen from B.
//!
//! Primes are derivatives seen from B. Nothing here is typed in from the paper's expanded forms
//! (12)-(14), (36), (49)-(52), (64): positions and angular velocities are stated, the rest follows.

use core::ops::Sub;

use precess_dynamics::dgvscmg::Joints;
use precess_dynamics::{Dgvscmg, Hub, Scalar};

use super::affine::{Affine, GAMMA_I_DDOT, GAMMA_O_DDOT, OMEGA_DOT, SPIN_DOT};
use super::vector::{Tensor, Vector, cross, tilde};

/// A frame turning in B.
#[derive(Clone, Copy, Debug)]
pub struct Frame<T> {
    /// Its axes, as columns along B axes.
    pub axes: Tensor<T>,
    /// `omega_{F/B}`, rad/s.
    pub omega: Vector<T>,
    /// Its derivative seen from B, rad/s^2.
    pub omega_prime: Affine<T>,
}

impl<T: Scalar> Frame<T> {
    /// A frame that does not turn in B.
    fn fixed(axes: Tensor<T>) -> Self {
        Self { axes, omega: Vector::zero(), omega_prime: Affine::known(Vector::zero()) }
    }

    /// The next frame of the chain: turned about this frame's own axis `axis` by `angle`.
    ///
    /// With `a` the axis and `q` the angle: `omega_next = omega + q' a`, hence
    /// `omega_next' = omega' + q'' a + q' (omega x a)`.
    fn turned(self, axis: usize, angle: T, rate: T, unknown: usize) -> Self {
        let a = self.axes.column(axis);
        Self {
            axes: self.axes * elementary_rotation(axis, angle),
            omega: self.omega + a * rate,
            omega_prime: self.omega_prime
                + Affine::unknown(unknown, a)
                + Affine::known(cross(self.omega, a) * rate),
        }
    }
}

/// The active rotation about a coordinate axis: its columns are the turned axes.
fn elementary_rotation<T: Scalar>(axis: usize, angle: T) -> Tensor<T> {
    let (sine, cosine) = angle.sin_cos();
    let (next, last) = ((axis + 1) % 3, (axis + 2) % 3);
    let mut rotation = Tensor::identity();
    rotation.0[next][next] = cosine;
    rotation.0[next][last] = -sine;
    rotation.0[last][next] = sine;
    rotation.0[last][last] = cosine;
    rotation
}

/// A point, from B; or the difference of two points.
#[derive(Clone, Copy, Debug)]
pub struct Point<T> {
    /// Position, m.
    pub r: Vector<T>,
    /// First derivative seen from B, m/s.
    pub r_prime: Vector<T>,
    /// Second derivative seen from B, m/s^2.
    pub r_dprime: Affine<T>,
}

impl<T: Scalar> Point<T> {
    /// A point that does not move in B.
    #[must_use]
    pub fn fixed(r: Vector<T>) -> Self {
        Self { r, r_prime: Vector::zero(), r_dprime: Affine::known(Vector::zero()) }
    }

    /// The point at `offset` (along the frame's axes) from this one, turning with the frame.
    fn with_offset(self, frame: &Frame<T>, offset: Vector<T>) -> Self {
        let arm = frame.axes * offset;
        let arm_prime = cross(frame.omega, arm);
        Self {
            r: self.r + arm,
            r_prime: self.r_prime + arm_prime,
            r_dprime: self.r_dprime
                + frame.omega_prime.map(|alpha| cross(alpha, arm))
                + Affine::known(cross(frame.omega, arm_prime)),
        }
    }

    /// The centre of mass of several bodies, as (9), (89) and (108).
    #[must_use]
    pub fn centre_of_mass(bodies: &[Body<T>]) -> (T, Self) {
        let zero = Self::fixed(Vector::zero());
        let (mut mass, mut sum) = (T::from_f64(0.0), zero);
        for body in bodies {
            mass = mass + body.mass;
            sum.r = sum.r + body.centre.r * body.mass;
            sum.r_prime = sum.r_prime + body.centre.r_prime * body.mass;
            sum.r_dprime = sum.r_dprime + body.centre.r_dprime * body.mass;
        }
        let share = mass.recip();
        let centre =
            Self { r: sum.r * share, r_prime: sum.r_prime * share, r_dprime: sum.r_dprime * share };
        (mass, centre)
    }

    /// First inertial derivative, as (68), (96), (114).
    #[must_use]
    pub fn dot(&self, omega: Vector<T>) -> Vector<T> {
        self.r_prime + cross(omega, self.r)
    }

    /// Second inertial derivative, as (10), (38), (53), (69), (87), (97), (106), (107), (115).
    #[must_use]
    pub fn ddot(&self, omega: Vector<T>) -> Affine<T> {
        let two = T::from_f64(2.0);
        self.r_dprime
            + Affine::unknown_vector(OMEGA_DOT).map(|omega_dot| cross(omega_dot, self.r))
            + Affine::known(cross(omega, self.r_prime) * two)
            + Affine::known(cross(omega, cross(omega, self.r)))
    }
}

impl<T: Scalar> Sub for Point<T> {
    type Output = Self;

    fn sub(self, other: Self) -> Self {
        Self {
            r: self.r - other.r,
            r_prime: self.r_prime - other.r_prime,
            r_dprime: self.r_dprime - other.r_dprime,
        }
    }
}

/// A rigid body: the hub, a gimbal or a wheel.
#[derive(Clone, Copy, Debug)]
pub struct Body<T> {
    /// Mass, kg.
    pub mass: T,
    /// Inertia about its own centre of mass, along B axes, kg m^2.
    pub inertia: Tensor<T>,
    /// Its frame.
    pub frame: Frame<T>,
    /// Its centre of mass, from B.
    pub centre: Point<T>,
}

impl<T: Scalar> Body<T> {
    fn new(mass: T, inertia: Tensor<T>, frame: Frame<T>, centre: Point<T>) -> Self {
        Self { mass, inertia: inertia.resolved_from(frame.axes), frame, centre }
    }

    /// `omega_{F/N}`, (31), (44), (59).
    #[must_use]
    pub fn omega_n(&self, omega: Vector<T>) -> Vector<T> {
        omega + self.frame.omega
    }

    /// Derivative of the inertia seen from B, in frame-independent form, (36), (49), (64).
    #[must_use]
    pub fn inertia_prime(&self) -> Tensor<T> {
        let turning = tilde(self.frame.omega);
        turning * self.inertia - self.inertia * turning
    }

    /// Inertial derivative of the angular momentum about its own centre of mass,
    /// (84)-(86): `I (omega_dot + omega_{F/B}') + I' omega_{F/N} + omega x I omega_{F/N}`.
    #[must_use]
    pub fn h_dot_about_centre(&self, omega: Vector<T>) -> Affine<T> {
        let omega_n = self.omega_n(omega);
        let alpha = Affine::unknown_vector(OMEGA_DOT) + self.frame.omega_prime;
        alpha.map(|a| self.inertia * a)
            + Affine::known(self.inertia_prime() * omega_n)
            + Affine::known(cross(omega, self.inertia * omega_n))
    }

    /// Inertial derivative of the angular momentum about another point of the spacecraft, relative
    /// to that point: (25), (34), (47), (62) about B; (81)-(83), (102), (103) about D and V.
    #[must_use]
    pub fn h_dot_about(&self, point: &Point<T>, omega: Vector<T>) -> Affine<T> {
        let arm = self.centre - *point;
        let moment = arm.ddot(omega).map(|acceleration| cross(arm.r, acceleration)) * self.mass;
        self.h_dot_about_centre(omega) + moment
    }
}

/// The hub as a body.
#[must_use]
pub fn hub_body<T: Scalar>(hub: &Hub<T>) -> Body<T> {
    let frame = Frame::fixed(Tensor::identity());
    let centre = Point::fixed(Vector::from(&hub.r_bc_b));
    Body::new(hub.m_b, Tensor::from(&hub.i_b_bc), frame, centre)
}

/// One device: three bodies, three joint origins, three joint axes.
#[derive(Clone, Copy, Debug)]
pub struct Device<T> {
    /// Outer gimbal, inner gimbal, wheel.
    pub bodies: [Body<T>; 3],
    /// The points Go, Gi and W.
    pub origins: [Point<T>; 3],
    /// `s_z`, `s_y`, `s_x`.
    pub axes: [Vector<T>; 3],
}

impl<T: Scalar> Device<T> {
    /// Positions, rates and accelerations of one device in one state.
    #[must_use]
    pub fn new(device: &Dgvscmg<T>, joints: &Joints<T>) -> Self {
        let base = Frame::fixed(Tensor::from(&device.mount));
        let outer = base.turned(2, joints.gamma_o, joints.gamma_o_dot, GAMMA_O_DDOT);
        let inner = outer.turned(1, joints.gamma_i, joints.gamma_i_dot, GAMMA_I_DDOT);
        let wheel = inner.turned(0, joints.theta, joints.spin, SPIN_DOT);

        let go = Point::fixed(Vector::from(&device.r_go_b));
        let gi = go.with_offset(&outer, Vector::from(&device.l_o));
        let w = gi.with_offset(&inner, Vector::from(&device.l_i));

        let goc = go.with_offset(&outer, Vector::from(&device.r_goc_go));
        let gic = gi.with_offset(&inner, Vector::from(&device.r_gic_gi));
        let wc = w.with_offset(&wheel, Vector::unit(1) * device.d);

        Self {
            bodies: [
                Body::new(device.m_go, Tensor::from(&device.i_go_goc), outer, goc),
                Body::new(device.m_gi, Tensor::from(&device.i_gi_gic), inner, gic),
                Body::new(device.m_w, Tensor::from(&device.i_w_wc), wheel, wc),
            ],
            origins: [go, gi, w],
            axes: [base.axes.column(2), outer.axes.column(1), inner.axes.column(0)],
        }
    }
}
