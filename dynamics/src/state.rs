//! State, torques and accelerations of a hub with N devices: plain data, SI units and radians.
//!
//! A joint's rates are relative to its parent body, so `spin` is the wheel's rate seen from the
//! inner gimbal. `theta` is a state because an imbalanced wheel's angle matters.

use nalgebra::Vector3;

use crate::attitude::Attitude;
use crate::quaternion::Quaternion;
use crate::real::{Scalar, zero};
use crate::vec3::{vector, zeros};

/// State of the hub and of `N` devices; `A` is the attitude's parameterisation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct State<const N: usize, T = f64, A = Quaternion<T>> {
    /// `r_{B/N}`, position of the hub's reference point B from the inertial origin, N axes, m.
    pub r_b_n: Vector3<T>,
    /// Inertial velocity of B, *N axes*, m/s. Its derivative in [`Accelerations`] is along B axes.
    pub r_b_n_dot: Vector3<T>,
    /// Attitude of B with respect to N.
    pub attitude: A,
    /// `omega_{B/N}`, angular velocity of the hub, B axes, rad/s.
    pub omega: Vector3<T>,
    /// Joint angles and rates, device by device.
    pub devices: [Joints<T>; N],
}

/// Angles (rad) and relative rates (rad/s) of one device's joints.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Joints<T = f64> {
    /// Outer gimbal angle, about its z axis.
    pub gamma_o: T,
    /// Inner gimbal angle, about its y axis.
    pub gamma_i: T,
    /// Wheel angle, about its x axis.
    pub theta: T,
    /// Outer gimbal rate, relative to the hub.
    pub gamma_o_dot: T,
    /// Inner gimbal rate, relative to the outer gimbal.
    pub gamma_i_dot: T,
    /// Wheel rate `Omega`, relative to the inner gimbal.
    pub spin: T,
}

/// Forces and torques on the spacecraft and within its devices.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Torques<const N: usize, T = f64> {
    /// External force F through B, B axes, N.
    pub force: Vector3<T>,
    /// `L_B`, external torque about B, B axes, N m.
    pub torque_b: Vector3<T>,
    /// Motor torques, device by device.
    pub motors: [MotorTorques<T>; N],
}

/// Motor torques of one device, N m. Each acts on the body it drives and, reversed, on its parent.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MotorTorques<T = f64> {
    /// `u_z`, hub on outer gimbal.
    pub u_o: T,
    /// `u_y`, outer on inner gimbal.
    pub u_i: T,
    /// `u_x`, inner gimbal on wheel.
    pub u_w: T,
}

/// All second derivatives of the state.
///
/// Mind the axes: `r_b_n_ddot` is along *B* axes, in which the equations are solved, while
/// [`State::r_b_n_dot`] and [`State::r_b_n`] are along *N* axes. To integrate the velocity, rotate
/// first: `[BN]^T r_b_n_ddot`, with [`Attitude::dcm`] for `[BN]`. [`Spacecraft::step`] does so.
///
/// [`Spacecraft::step`]: crate::Spacecraft::step
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Accelerations<const N: usize, T = f64> {
    /// Inertial acceleration of B, *along B axes*, m/s^2: the derivative of
    /// [`State::r_b_n_dot`], which is along N axes, is `[BN]^T` times this.
    pub r_b_n_ddot: Vector3<T>,
    /// Angular acceleration of the hub, B axes, rad/s^2.
    pub omega_dot: Vector3<T>,
    /// Joint accelerations, device by device.
    pub devices: [JointAccelerations<T>; N],
}

/// Relative angular accelerations of one device's joints, rad/s^2.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct JointAccelerations<T = f64> {
    /// Outer gimbal, relative to the hub.
    pub gamma_o_ddot: T,
    /// Inner gimbal, relative to the outer gimbal.
    pub gamma_i_ddot: T,
    /// Wheel, relative to the inner gimbal.
    pub spin_dot: T,
}

impl<const N: usize, T: Scalar, A: Attitude<T>> State<N, T, A> {
    /// Everything at zero: B at the inertial origin, B axes along N axes, nothing moving.
    #[must_use]
    pub fn at_rest() -> Self {
        Self {
            r_b_n: vector(zeros()),
            r_b_n_dot: vector(zeros()),
            attitude: A::identity(),
            omega: vector(zeros()),
            devices: [Joints::at_rest(); N],
        }
    }

    /// The same state with every joint angle brought into `[-pi, pi]`.
    ///
    /// Nothing else changes, and an angle already in that range keeps its bits. An infinite or NaN
    /// angle is left as it is, for the solver to report.
    #[must_use]
    pub fn wrapped(self) -> Self {
        Self { devices: self.devices.map(Joints::wrapped), ..self }
    }
}

impl<T: Scalar> Joints<T> {
    /// All angles and rates zero.
    #[must_use]
    pub fn at_rest() -> Self {
        Self {
            gamma_o: zero(),
            gamma_i: zero(),
            theta: zero(),
            gamma_o_dot: zero(),
            gamma_i_dot: zero(),
            spin: zero(),
        }
    }

    /// The same joints with every angle brought into `[-pi, pi]`; see [`State::wrapped`].
    #[must_use]
    pub fn wrapped(self) -> Self {
        Self {
            gamma_o: wrapped(self.gamma_o),
            gamma_i: wrapped(self.gamma_i),
            theta: wrapped(self.theta),
            ..self
        }
    }
}

impl<const N: usize, T: Scalar> Torques<N, T> {
    /// No force, no torque, motors off.
    #[must_use]
    pub fn none() -> Self {
        Self {
            force: vector(zeros()),
            torque_b: vector(zeros()),
            motors: [MotorTorques::none(); N],
        }
    }
}

impl<T: Scalar> MotorTorques<T> {
    /// All motors off.
    #[must_use]
    pub fn none() -> Self {
        Self { u_o: zero(), u_i: zero(), u_w: zero() }
    }
}

impl<T: Scalar> JointAccelerations<T> {
    pub(crate) fn none() -> Self {
        Self { gamma_o_ddot: zero(), gamma_i_ddot: zero(), spin_dot: zero() }
    }
}

/// The angle in `[-pi, pi]` with the same sine and cosine.
///
/// The guess comes from the arc tangent in `f64`; one Newton step, `y + sin(x - y)`, takes it to
/// the accuracy of `T`'s own sine, since what it leaves is the cube of the guess's error. No
/// multiple of pi is subtracted, so a large angle loses nothing that its sine has not lost already.
fn wrapped<T: Scalar>(angle: T) -> T {
    if !angle.is_finite() || angle.abs() <= T::from_f64(core::f64::consts::PI) {
        return angle;
    }
    let (sin, cos) = angle.sin_cos();
    let guess = T::from_f64(libm::atan2(sin.to_f64(), cos.to_f64()));
    let (sin_guess, cos_guess) = guess.sin_cos();
    guess + (sin * cos_guess - cos * sin_guess)
}

#[cfg(test)]
mod tests {
    use core::f64::consts::PI;

    use super::*;

    /// Half a unit in the last place of pi, plus the rounding of two sines.
    const ROUNDING: f64 = 6e-16;

    #[test]
    fn wrapped_angle_is_in_range_and_has_the_same_sine_and_cosine() {
        for angle in [3.2, -3.2, 6.5, 100.0, -1e3, 1e6, -1e6, 123_456_789.0, 1e22, PI + 1e-15] {
            let y = wrapped(angle);
            assert!(y.abs() <= PI, "{angle} became {y}");
            let ((s, c), (sy, cy)) = (libm::sincos(angle), libm::sincos(y));
            assert!((s - sy).abs() <= ROUNDING && (c - cy).abs() <= ROUNDING, "{angle} became {y}");
        }
        for angle in [4.0_f32, -700.0, 1e6] {
            let y = wrapped(angle);
            assert!(y.abs() <= core::f32::consts::PI);
            assert!((libm::sinf(angle) - libm::sinf(y)).abs() <= 3e-7);
            assert!((libm::cosf(angle) - libm::cosf(y)).abs() <= 3e-7);
        }
    }

    #[test]
    fn angle_in_range_keeps_its_bits() {
        for angle in [0.0, -0.0, 1.0, PI, -PI, f64::MIN_POSITIVE] {
            assert_eq!(wrapped(angle).to_bits(), angle.to_bits());
        }
    }

    #[test]
    fn infinite_angle_is_left_for_the_solver() {
        assert_eq!(wrapped(f64::INFINITY), f64::INFINITY);
        assert!(wrapped(f64::NAN).is_nan());
    }

    #[test]
    fn wrapping_a_state_changes_angles_only() {
        let mut state = State::<2>::at_rest();
        state.r_b_n.x = 7.0;
        state.omega.z = 8.0;
        state.devices[1] = Joints {
            gamma_o: 10.0,
            gamma_i: -20.0,
            theta: 1e6,
            gamma_o_dot: 30.0,
            gamma_i_dot: 40.0,
            spin: 50.0,
        };
        let wrapped = state.wrapped();
        assert_ne!(wrapped.devices[1].gamma_o, 10.0);
        assert_ne!(wrapped.devices[1].gamma_i, -20.0);
        assert_ne!(wrapped.devices[1].theta, 1e6);
        let back = State {
            devices: [
                wrapped.devices[0],
                Joints { gamma_o: 10.0, gamma_i: -20.0, theta: 1e6, ..wrapped.devices[1] },
            ],
            ..wrapped
        };
        assert_eq!(back, state);
    }
}
