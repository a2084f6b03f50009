//! [`Spacecraft`]: a hub and its devices, checked and prepared once, and their accelerations.
//!
//! Devices meet only in the hub's six equations: each is eliminated into them, they are solved, and
//! each device's own accelerations follow. `N` is a loop bound and nothing else: the loops run over
//! slices, and the scratch is one array on the stack.

use crate::attitude::Attitude;
use crate::device::{Device, check_pivots};
use crate::error::SolveError;
use crate::finite::{culprit_in_state, culprit_in_torques};
use crate::generated::dgvscmg::Eliminated;
use crate::hub::PreparedHub;
use crate::parameter_error::{ParameterError, Part, Warning};
use crate::parameters::{Dgvscmg, Hub};
use crate::real::{Scalar, zero};
use crate::solve::{Solution, System};
use crate::state::{Accelerations, JointAccelerations, Joints, MotorTorques, State, Torques};
use crate::validation::{check_device, check_hub};
use crate::vec3::{Vec3, components, finite, vector};

/// A rigid hub with `N` devices, prepared for evaluation. Never changes; `N = 0` is a plain hub.
#[derive(Clone, Copy, Debug)]
pub struct Spacecraft<const N: usize, T = f64> {
    pub(crate) hub: PreparedHub<T>,
    pub(crate) devices: [Device<T>; N],
    mass: T,
    hub_excess: T,
    device_excesses: [[T; 3]; N],
}

impl<const N: usize, T: Scalar> Spacecraft<N, T> {
    /// Checks the parameters and computes everything that depends on them alone.
    ///
    /// # Errors
    ///
    /// [`ParameterError`] names the body, the value and the bound: a number that is not finite, a
    /// mass of hub or wheel that is not above zero, a negative mass of a gimbal, an inertia that is
    /// not symmetric or has a negative principal moment, a mount that is not a right-handed
    /// rotation; or it tells that the total mass or a principal moment is not finite. Deviations up
    /// to 4096 epsilons of the largest element count as rounding.
    pub fn new(hub: &Hub<T>, devices: &[Dgvscmg<T>; N]) -> Result<Self, ParameterError<T>> {
        let hub_excess = check_hub(hub)?;
        let mut device_excesses = [[zero(); 3]; N];
        for (index, (device, excess)) in devices.iter().zip(&mut device_excesses).enumerate() {
            *excess = check_device(index, device)?;
        }
        let prepared = devices.each_ref().map(Device::new);
        let mass = prepared.iter().fold(hub.m_b, |sum, device| sum + device.mass);
        if !mass.is_finite() {
            return Err(ParameterError::TotalMass { value: mass });
        }
        Ok(Self {
            hub: PreparedHub::new(hub),
            devices: prepared,
            mass,
            hub_excess,
            device_excesses,
        })
    }

    /// What is odd about the parameters without being wrong; see [`Warning`].
    #[must_use = "warnings do nothing unless they are read"]
    pub fn warnings(&self) -> impl Iterator<Item = Warning<T>> + '_ {
        let devices = self.device_excesses.iter().enumerate().flat_map(|(device, excess)| {
            let [outer, inner, wheel] = *excess;
            [
                (Part::OuterGimbal { device }, outer),
                (Part::InnerGimbal { device }, inner),
                (Part::Wheel { device }, wheel),
            ]
        });
        core::iter::once((Part::Hub, self.hub_excess))
            .chain(devices)
            .filter(|&(_, excess)| excess > zero())
            .map(|(part, excess)| Warning::Triangle { part, excess })
    }

    /// `m_sc`, mass of hub and devices, kg.
    #[must_use]
    pub fn mass(&self) -> T {
        self.mass
    }

    /// All second derivatives of the state: `6 + 3 N` numbers from (16), (75), (80), (101), (119).
    ///
    /// # Errors
    ///
    /// [`SolveError::Singular`] where a joint or the hub is left without inertia,
    /// [`SolveError::NotFinite`] naming the first input that is infinite or NaN (also one that the
    /// accelerations do not depend on, such as the position), [`SolveError::Overflow`] where the
    /// result is not finite though every input is.
    pub fn accelerations<A: Attitude<T>>(
        &self,
        state: &State<N, T, A>,
        torques: &Torques<N, T>,
    ) -> Result<Accelerations<N, T>, SolveError<T>> {
        if !(finite(components(&state.r_b_n))
            && finite(components(&state.r_b_n_dot))
            && state.attitude.is_valid())
        {
            return Err(diagnosis(state, torques, SolveError::Overflow));
        }
        self.solve(state, torques).map_err(|failure| diagnosis(state, torques, failure))
    }

    /// [`Self::accelerations`] without the search for a culprit.
    pub(crate) fn solve<A: Attitude<T>>(
        &self,
        state: &State<N, T, A>,
        torques: &Torques<N, T>,
    ) -> Result<Accelerations<N, T>, SolveError<T>> {
        let omega = components(&state.omega);
        let mut system =
            self.hub.system(omega, components(&torques.force), components(&torques.torque_b));

        let mut shares: [Option<Eliminated<T>>; N] = [None; N];
        let inputs =
            Inputs { devices: &self.devices, joints: &state.devices, motors: &torques.motors };
        inputs.eliminate(omega, &mut shares, &mut system)?;

        let hub = system.solve().map_err(|small| SolveError::Singular {
            device: None,
            joint: None,
            pivot: small.pivot,
            bound: small.bound,
        })?;
        if !(finite(hub.r_b_n_ddot) && finite(hub.omega_dot)) {
            return Err(SolveError::Overflow);
        }

        let mut joints = [JointAccelerations::none(); N];
        back_substitute(&self.devices, &shares, &hub, &mut joints)?;
        Ok(Accelerations {
            r_b_n_ddot: vector(hub.r_b_n_ddot),
            omega_dot: vector(hub.omega_dot),
            devices: joints,
        })
    }
}

/// The inputs of all devices, as slices of one length.
struct Inputs<'a, T> {
    devices: &'a [Device<T>],
    joints: &'a [Joints<T>],
    motors: &'a [MotorTorques<T>],
}

impl<T: Scalar> Inputs<'_, T> {
    /// Eliminates every device's joints, keeps what back substitution needs, adds to the hub.
    fn eliminate(
        &self,
        omega: Vec3<T>,
        shares: &mut [Option<Eliminated<T>>],
        system: &mut System<T>,
    ) -> Result<(), SolveError<T>> {
        let inputs = self.devices.iter().zip(self.joints).zip(self.motors);
        for (index, (((device, joints), motors), share)) in inputs.zip(shares).enumerate() {
            let eliminated = share.insert(device.eliminate(joints, motors, omega));
            check_pivots(index, eliminated)?;
            device.add_to(system, &eliminated.share);
        }
        Ok(())
    }
}

/// The accelerations of every device's joints, checked finite.
fn back_substitute<T: Scalar>(
    devices: &[Device<T>],
    shares: &[Option<Eliminated<T>>],
    hub: &Solution<T>,
    joints: &mut [JointAccelerations<T>],
) -> Result<(), SolveError<T>> {
    for ((device, share), joint) in devices.iter().zip(shares.iter().flatten()).zip(joints) {
        let found = device.back_substitute(share, hub);
        if !finite([found.gamma_o_ddot, found.gamma_i_ddot, found.spin_dot]) {
            return Err(SolveError::Overflow);
        }
        *joint = found;
    }
    Ok(())
}

/// What to report for a failed evaluation: an input that is not finite explains everything else,
/// and a pivot that is not finite is an overflow, not a singularity.
#[cold]
pub(crate) fn diagnosis<const N: usize, T: Scalar, A: Attitude<T>>(
    state: &State<N, T, A>,
    torques: &Torques<N, T>,
    failure: SolveError<T>,
) -> SolveError<T> {
    if let Some((what, value)) = culprit_in_state(state).or_else(|| culprit_in_torques(torques)) {
        return SolveError::NotFinite { what, value };
    }
    match failure {
        SolveError::Singular { pivot, bound, .. } if !(pivot.is_finite() && bound.is_finite()) => {
            SolveError::Overflow
        }
        failure => failure,
    }
}

#[cfg(test)]
mod tests {
    use std::string::ToString;

    use nalgebra::{Matrix3, Vector3};

    use super::*;
    use crate::error::{Joint, JointField, Quantity};
    use crate::momentum::{About, Momentum};
    use crate::mrp::Mrp;

    /// A few dozen rounded operations on numbers of size 1 to 1000.
    const ROUNDING: f64 = 1e-12;

    fn hub() -> Hub {
        Hub {
            m_b: 20.0,
            r_bc_b: Vector3::new(0.1, -0.2, 0.3),
            i_b_bc: Matrix3::new(4.0, 0.3, -0.2, 0.3, 5.0, 0.6, -0.2, 0.6, 7.0),
        }
    }

    fn wheel() -> Dgvscmg {
        let disc = Matrix3::from_diagonal(&Vector3::new(0.2, 0.1, 0.1));
        Dgvscmg { r_go_b: Vector3::new(0.3, 0.0, 0.1), ..Dgvscmg::bare_wheel(4.0, disc) }
    }

    #[test]
    fn plain_hub_obeys_newton_and_euler_about_its_centre_of_mass() {
        let spacecraft = Spacecraft::<0>::new(&hub(), &[]).unwrap();
        let omega = Vector3::new(0.3, -0.5, 0.2);
        let state = State::<0> { omega, ..State::at_rest() };
        let force = Vector3::new(1.0, 2.0, -3.0);
        let torque_b = Vector3::new(-0.4, 0.1, 0.6);
        let torques = Torques { force, torque_b, motors: [] };
        let found = spacecraft.accelerations(&state, &torques).unwrap();

        let Hub { m_b, r_bc_b: c, i_b_bc } = hub();
        let at_c = found.r_b_n_ddot + found.omega_dot.cross(&c) + omega.cross(&omega.cross(&c));
        assert!((at_c * m_b - force).amax() <= ROUNDING);
        let euler = i_b_bc * found.omega_dot + omega.cross(&(i_b_bc * omega));
        assert!((euler - (torque_b - c.cross(&force))).amax() <= ROUNDING);
    }

    #[test]
    fn mass_and_centre_of_mass_count_every_body() {
        let device = Dgvscmg { m_go: 1.0, m_gi: 2.0, ..wheel() };
        let spacecraft = Spacecraft::new(&hub(), &[device, wheel()]).unwrap();
        assert_eq!(spacecraft.mass(), 20.0 + 7.0 + 4.0);
        let found = spacecraft.centre_of_mass(&State::<2>::at_rest()).unwrap();
        let expected = (hub().r_bc_b * 20.0 + wheel().r_go_b * 11.0) / 31.0;
        assert!((found.c - expected).amax() <= ROUNDING);
        assert!(found.c_prime.amax() <= ROUNDING);
    }

    #[test]
    fn total_mass_must_be_finite() {
        let text = |heaviest: fn(&mut Hub, &mut Dgvscmg)| {
            let (mut hub, mut device) = (hub(), wheel());
            heaviest(&mut hub, &mut device);
            let error = Spacecraft::new(&hub, &[wheel(), device]).unwrap_err();
            assert_eq!(error, ParameterError::TotalMass { value: f64::INFINITY });
            error.to_string()
        };
        // Beyond f64 within one device, and with the hub only.
        let expected = "total mass inf kg is not finite; check the units of the masses";
        assert_eq!(text(|_, device| (device.m_go, device.m_gi) = (1e308, 1e308)), expected);
        assert_eq!(text(|hub, device| (hub.m_b, device.m_go) = (1e308, 1e308)), expected);
    }

    #[test]
    fn mount_turns_the_wheel_axis_into_the_hub() {
        // The wheel's axis along b_z: the columns are the outer gimbal's x, y, z along B.
        let mount = Matrix3::new(0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 1.0, 0.0, 0.0);
        let plain = Hub { r_bc_b: Vector3::zeros(), ..hub() };
        let device = Dgvscmg { mount, r_go_b: Vector3::zeros(), ..wheel() };
        let spacecraft = Spacecraft::new(&plain, &[device]).unwrap();
        let mut state = State::<1>::at_rest();
        state.devices[0].spin = 10.0;
        let Momentum { angular, .. } = spacecraft.momentum(&state, About::CentreOfMass).unwrap();
        assert!((angular - Vector3::new(0.0, 0.0, 2.0)).amax() <= ROUNDING);
        assert!((spacecraft.energy(&state).unwrap() - 10.0).abs() <= ROUNDING);
    }

    #[test]
    fn motor_accelerates_wheel_and_hub_against_each_other() {
        let plain = Hub {
            r_bc_b: Vector3::zeros(),
            i_b_bc: Matrix3::from_diagonal(&Vector3::new(4.0, 5.0, 7.0)),
            ..hub()
        };
        let device = Dgvscmg { r_go_b: Vector3::zeros(), ..wheel() };
        let spacecraft = Spacecraft::new(&plain, &[device]).unwrap();
        let mut torques = Torques::<1>::none();
        torques.motors[0].u_w = 0.6;
        let found = spacecraft.accelerations(&State::<1>::at_rest(), &torques).unwrap();
        assert!((found.omega_dot - Vector3::new(-0.15, 0.0, 0.0)).amax() <= ROUNDING);
        assert!((found.devices[0].spin_dot - (3.0 + 0.15)).abs() <= ROUNDING);
    }

    #[test]
    fn momentum_about_points_differs_by_the_arm() {
        let spacecraft = Spacecraft::new(&hub(), &[wheel()]).unwrap();
        let mut state = State::<1, f64, Mrp> {
            r_b_n: Vector3::new(5.0, -3.0, 2.0),
            r_b_n_dot: Vector3::new(0.2, 0.7, -0.1),
            attitude: Mrp::from_components(0.1, 0.3, -0.2),
            omega: Vector3::new(0.3, -0.5, 0.2),
            ..State::at_rest()
        };
        state.devices[0].spin = 30.0;
        let about = |point| spacecraft.momentum(&state, point).unwrap();
        let origin = about(About::InertialOrigin);
        let point = Vector3::new(1.0, 2.0, 3.0);
        let shifted = about(About::Point(point));
        assert_eq!(origin.linear, shifted.linear);
        let expected = origin.angular - point.cross(&origin.linear);
        assert!((shifted.angular - expected).amax() <= 10.0 * ROUNDING);
        // The centre of mass as a point fixed in N gives the same.
        let c = spacecraft.centre_of_mass(&state).unwrap().c;
        let c_n = state.r_b_n + state.attitude.dcm().transpose() * c;
        let centre = about(About::CentreOfMass).angular;
        assert!((centre - about(About::Point(c_n)).angular).amax() <= 10.0 * ROUNDING);
        let lost = spacecraft.momentum(&state, About::Point(point * f64::INFINITY));
        let (what, value) = (Quantity::ReferencePoint, f64::INFINITY);
        assert_eq!(lost, Err(SolveError::NotFinite { what, value }));
    }

    #[test]
    fn wheel_that_breaks_the_triangle_inequality_is_accepted_with_a_warning() {
        let mut printed = wheel();
        printed.i_w_wc[(0, 2)] = 0.0154;
        printed.i_w_wc[(2, 0)] = 0.0154;
        let spacecraft = Spacecraft::new(&hub(), &[wheel(), printed]).unwrap();
        let mut warnings = spacecraft.warnings();
        let Some(Warning::Triangle { part, excess }) = warnings.next() else {
            panic!("no warning");
        };
        assert_eq!(part, Part::Wheel { device: 1 });
        // Largest minus the others, of the block 0.2, 0.0154, 0.1 and the 0.1 beside it.
        let root = (0.05_f64.powi(2) + 0.0154_f64.powi(2)).sqrt();
        assert!((excess - (2.0 * root - 0.1)).abs() <= ROUNDING);
        assert_eq!(warnings.next(), None);
    }

    #[test]
    fn input_that_is_not_finite_is_named() {
        /// Not NaN, which equals nothing.
        const BAD: f64 = f64::NEG_INFINITY;
        let spacecraft = Spacecraft::new(&hub(), &[wheel(), wheel()]).unwrap();
        let found = |change: fn(&mut State<2>, &mut Torques<2>)| {
            let (mut state, mut torques) = (State::at_rest(), Torques::none());
            change(&mut state, &mut torques);
            spacecraft.accelerations(&state, &torques)
        };
        let refused = |what| Err(SolveError::NotFinite { what, value: BAD });
        let joint = |field| Quantity::Joint { device: 1, field };
        assert!(found(|_, _| ()).is_ok());
        assert_eq!(found(|s, _| s.r_b_n.x = BAD), refused(Quantity::Position));
        assert_eq!(found(|s, _| s.attitude.q0 = BAD), refused(Quantity::Attitude));
        assert_eq!(found(|s, _| s.omega.z = BAD), refused(Quantity::BodyRate));
        for (field, result) in [
            (JointField::GammaO, found(|s, _| s.devices[1].gamma_o = BAD)),
            (JointField::GammaI, found(|s, _| s.devices[1].gamma_i = BAD)),
            (JointField::Theta, found(|s, _| s.devices[1].theta = BAD)),
            (JointField::GammaODot, found(|s, _| s.devices[1].gamma_o_dot = BAD)),
            (JointField::GammaIDot, found(|s, _| s.devices[1].gamma_i_dot = BAD)),
            (JointField::Spin, found(|s, _| s.devices[1].spin = BAD)),
        ] {
            assert_eq!(result, refused(joint(field)));
        }
        let motor = Quantity::Motor { device: 0, joint: Joint::InnerGimbal };
        assert_eq!(found(|_, t| t.motors[0].u_i = BAD), refused(motor));
        assert_eq!(found(|_, t| t.torque_b.y = BAD), refused(Quantity::TorqueB));
        // The square of this rate is beyond f64.
        assert_eq!(found(|s, _| s.omega.x = 1e200), Err(SolveError::Overflow));
    }

    #[test]
    fn massless_gimbals_are_singular_at_a_quarter_turn_only() {
        let spacecraft = Spacecraft::new(&hub(), &[wheel()]).unwrap();
        let mut state = State::<1>::at_rest();
        state.devices[0].gamma_i = 1.5;
        assert!(spacecraft.accelerations(&state, &Torques::none()).is_ok());
        state.devices[0].gamma_i = core::f64::consts::FRAC_PI_2;
        let found = spacecraft.accelerations(&state, &Torques::none());
        let Err(SolveError::Singular { device, joint, pivot, bound }) = found else {
            panic!("{found:?} is not a singular pose");
        };
        assert_eq!((device, joint), (Some(0), Some(Joint::OuterGimbal)));
        assert!(pivot <= bound && bound < 1e-13);
    }
}
