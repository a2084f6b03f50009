//! State and accelerations of a hub with its devices: numbers, SI units and radians.
//!
//! A joint's rates are relative to its parent body, so `spin` is the wheel's rate seen from the
//! gimbal. `theta` is a state because an imbalanced wheel's angle matters.

use nalgebra::Vector3;

use crate::attitude::parameterisation::Attitude;
use crate::attitude::quaternion::Quaternion;
use crate::numbers::each::JointStates;
use crate::numbers::real::{Scalar, zero};
use crate::numbers::vec3::{vector, zeros};
use crate::sets::devices::{DeviceSet, Devices, FixedSet, JointInfos, Passives};
use crate::sets::per_device as data;
use crate::solve::spacecraft::Spacecraft;
use crate::solve::structure::{Rigid, StructureData, StructureEquations};

/// State of the hub and of its devices; `A` is the attitude's parameterisation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct State<D: Devices, A = Quaternion<<D as DeviceSet>::Scalar>, S: StructureData = Rigid> {
    /// `r_{B/N}`, position of the hub's reference point B from the inertial origin, expressed in N,
    /// m.
    pub r_b_n: Vector3<D::Scalar>,
    /// Inertial velocity of B, *expressed in N*, m/s. Its derivative in [`Accelerations`] is
    /// expressed in B.
    pub r_b_n_dot: Vector3<D::Scalar>,
    /// Attitude of B with respect to N.
    pub attitude: A,
    /// `omega_{B/N}`, angular velocity of the hub, expressed in B, rad/s.
    pub omega: Vector3<D::Scalar>,
    /// Joint coordinates and rates, device by device.
    pub devices: D::Per<data::Joints>,
    /// Modal coordinates and rates of a flexible structure; `()` of a rigid hub.
    pub modal: S::State<D::Scalar>,
}

/// All second derivatives of the state.
///
/// Mind the axes: `r_b_n_ddot` is expressed in *B*, in which the equations are solved, while
/// [`State::r_b_n_dot`] and [`State::r_b_n`] are expressed in *N*. To integrate the velocity,
/// rotate first: `[BN]^T r_b_n_ddot`, with [`Attitude::dcm`] for `[BN]`. [`Spacecraft::step`] does
/// so.
///
/// [`Spacecraft::step`]: crate::Spacecraft::step
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Accelerations<D: Devices, S: StructureData = Rigid> {
    /// Inertial acceleration of B, *expressed in B*, m/s^2: the derivative of
    /// [`State::r_b_n_dot`], which is expressed in N, is `[BN]^T` times this.
    pub r_b_n_ddot: Vector3<D::Scalar>,
    /// Angular acceleration of the hub, expressed in B, rad/s^2.
    pub omega_dot: Vector3<D::Scalar>,
    /// Joint accelerations, device by device.
    pub devices: D::Per<data::Accelerations>,
    /// Those of the modal coordinates of a flexible structure; `()` of a rigid hub.
    pub modal: S::Accelerations<D::Scalar>,
}

impl<D: Devices, S: StructureData> Accelerations<D, S> {
    /// The same accelerations of hub and joints, with the modal part of another structure.
    #[must_use]
    pub fn with_modal<R: StructureData>(
        self,
        modal: R::Accelerations<D::Scalar>,
    ) -> Accelerations<D, R> {
        let Self { r_b_n_ddot, omega_dot, devices, .. } = self;
        Accelerations { r_b_n_ddot, omega_dot, devices, modal }
    }
}

impl<D: FixedSet, A: Attitude<D::Scalar>> State<D, A> {
    /// Everything at zero: B at the inertial origin, B's axes those of N, nothing moving.
    #[must_use]
    pub fn at_rest() -> Self {
        Self::with(D::at_rest(), ())
    }
}

impl<D: Devices, A: Attitude<D::Scalar>, S: StructureEquations> State<D, A, S> {
    /// As [`State::at_rest`], for a set whose devices are known only at run time, and for a flexible
    /// structure, undeformed.
    #[must_use]
    pub fn at_rest_for(spacecraft: &Spacecraft<D, S>) -> Self {
        Self::with(D::new_data(&spacecraft.devices, &data::Joints), S::at_rest(spacecraft))
    }

    /// The same motion of hub and joints, with the modal part of another structure.
    #[must_use]
    pub fn with_modal<R: StructureEquations>(self, modal: R::State<D::Scalar>) -> State<D, A, R> {
        let Self { r_b_n, r_b_n_dot, attitude, omega, devices, .. } = self;
        State { r_b_n, r_b_n_dot, attitude, omega, devices, modal }
    }

    /// The same state with joint angles brought into `[-pi, pi]` where whole turns change nothing:
    /// the angle of a joint with a spring stays, because its spring counts the turns.
    ///
    /// Nothing else changes, and an angle already in that range keeps its bits. An infinite or NaN
    /// angle is left as it is, for the solver to report.
    #[must_use]
    pub fn wrapped(mut self, spacecraft: &Spacecraft<D, S>) -> Self {
        let joints = D::list::<JointInfos>(&spacecraft.devices)
            .zip(D::list::<Passives>(&spacecraft.devices));
        for ([coordinate, _], (info, passive)) in self.devices.states_mut().zip(joints) {
            if !info.slides && passive.stiffness == zero() {
                *coordinate = wrapped(*coordinate);
            }
        }
        self
    }

    fn with(devices: D::Per<data::Joints>, modal: S::State<D::Scalar>) -> Self {
        Self {
            r_b_n: vector(zeros()),
            r_b_n_dot: vector(zeros()),
            attitude: A::identity(),
            omega: vector(zeros()),
            devices,
            modal,
        }
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

    use nalgebra::Matrix3;

    use super::*;
    use crate::{Dgvscmg, Hub, SloshMass, dgvscmg};

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

    fn spacecraft(stiffness: f64) -> Spacecraft<(Dgvscmg, SloshMass)> {
        let hub = Hub { m_b: 9.0, r_bc_b: Vector3::zeros(), i_b_bc: Matrix3::identity() };
        let mut device = Dgvscmg::bare_wheel(1.0, Matrix3::identity());
        device.passive.wheel.stiffness = stiffness;
        Spacecraft::new(&hub, &(device, SloshMass::bare_slosh_mass(1.0))).unwrap()
    }

    #[test]
    fn wrapping_a_state_changes_angles_only() {
        let mut state = State::<(Dgvscmg, SloshMass)>::at_rest();
        state.r_b_n.x = 7.0;
        state.omega.z = 8.0;
        state.devices.0 = dgvscmg::Joints {
            gamma_o: 10.0,
            gamma_i: -20.0,
            theta: 1e6,
            gamma_o_dot: 30.0,
            gamma_i_dot: 40.0,
            spin: 50.0,
        };
        state.devices.1.x = 60.0;
        let wrapped = state.wrapped(&spacecraft(0.0));
        let angles = |d: &dgvscmg::Joints| [d.gamma_o, d.gamma_i, d.theta];
        let (found, given) = (angles(&wrapped.devices.0), angles(&state.devices.0));
        assert!(found.iter().zip(&given).all(|(found, given)| found != given));
        let [gamma_o, gamma_i, theta] = given;
        let device = dgvscmg::Joints { gamma_o, gamma_i, theta, ..wrapped.devices.0 };
        assert_eq!(State { devices: (device, wrapped.devices.1), ..wrapped }, state);

        // A spring counts the turns of its own joint.
        let sprung = state.wrapped(&spacecraft(1e-3)).devices.0;
        assert_eq!(sprung, dgvscmg::Joints { theta, ..wrapped.devices.0 });
    }
}
