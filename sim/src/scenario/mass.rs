//! [`MassProperties`] and [`MassMatrix`] of a scenario's spacecraft, joints at their initial
//! coordinates and at rest.
//!
//! ```text
//! I_B e_k  = angular momentum about B at omega = e_k
//! M_kk     = twice the kinetic energy at a unit rate of joint k
//! M^-1 e_k = accelerations at a unit force on coordinate k, less those at none
//! ```
//!
//! Coordinates of M are the position of B and the attitude of the hub, both along B, where the hub
//! is free, then every joint that a motor drives at the start. A joint that is locked or whose motion
//! is prescribed is no unknown there, as in a run: its pose may be solved where nothing outboard of
//! it has inertia.

use nalgebra::{DMatrix, Matrix3, Vector3};
use precess_dynamics::kind::Each;
use precess_dynamics::{
    About, Accelerations, Attitude, BuiltIn, HubMode, Imbalance, Inputs, JointStates, Mode,
    Quaternion, SolveError, Spacecraft, State, WheelImbalance,
};

use super::{Drive, Scenario, Set};

/// Mass, centre of mass and inertia of the whole spacecraft.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MassProperties {
    /// kg.
    pub mass: f64,
    /// Centre of mass from B, B axes, m.
    pub centre_of_mass: Vector3<f64>,
    /// About B, B axes, joints locked, kg m².
    pub inertia_b: Matrix3<f64>,
}

/// How well the equations of motion can be solved in the initial pose.
#[derive(Clone, Debug, PartialEq)]
pub struct MassMatrix {
    /// Of each joint, in the order of the set.
    pub joints: Vec<JointInertia>,
    /// Largest over smallest eigenvalue of the mass matrix scaled to a unit diagonal: its decimal
    /// logarithm is how many digits accelerations lose. None without a coordinate.
    pub condition: Option<f64>,
}

/// The mass or inertia that a joint's motor moves, kg m²; of a sliding joint kg. None of a joint
/// without a motor.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct JointInertia {
    /// With the hub and all other joints held; also of a joint that is locked or prescribed.
    pub held: Option<f64>,
    /// With the hub free, where it is, and all other motors at no torque. Towards none of the one
    /// above, the pose is singular. None of a joint that is locked or prescribed at the start.
    pub free: Option<f64>,
}

/// Coordinates of the hub.
const HUB: usize = 6;

impl MassProperties {
    /// Those of a scenario's spacecraft.
    ///
    /// # Errors
    ///
    /// [`SolveError::Overflow`].
    pub fn from_spacecraft(
        scenario: &Scenario,
        spacecraft: &Spacecraft<Set>,
    ) -> Result<Self, SolveError> {
        let mut state = at_rest(scenario, spacecraft);
        let mut inertia_b = Matrix3::zeros();
        for axis in 0..3 {
            state.omega = Vector3::ith(axis, 1.0);
            let momentum = spacecraft.momentum(&state, About::InertialOrigin)?;
            inertia_b.set_column(axis, &momentum.angular);
        }
        let centre_of_mass = spacecraft.centre_of_mass(&state)?.c;
        Ok(Self { mass: spacecraft.mass(), centre_of_mass, inertia_b })
    }
}

impl MassProperties {
    /// Inertia about the centre of mass, B axes, joints locked, kg m²: `I_B + m tilde(c) tilde(c)`.
    #[must_use]
    pub fn inertia_c(&self) -> Matrix3<f64> {
        let c = self.centre_of_mass.cross_matrix();
        let about_centre = self.inertia_b + self.mass * c * c;
        0.5 * (about_centre + about_centre.transpose())
    }

    /// Principal moments of inertia about the centre of mass, kg m², the least first; and their axes, columns in B axes, right-handed.
    #[must_use]
    pub fn principal(&self) -> (Vector3<f64>, Matrix3<f64>) {
        let eigen = self.inertia_c().symmetric_eigen();
        let mut order = [0, 1, 2];
        order.sort_by(|a, b| eigen.eigenvalues[*a].total_cmp(&eigen.eigenvalues[*b]));
        let axis = |k: usize| {
            let axis: Vector3<f64> = eigen.eigenvectors.column(order[k]).into();
            // Either sense is one: that of the largest component.
            axis * axis[axis.iamax()].signum()
        };
        let (first, second) = (axis(0), axis(1));
        let axes = Matrix3::from_columns(&[first, second, first.cross(&second)]);
        (Vector3::from(order.map(|k| eigen.eigenvalues[k])), axes)
    }
}

impl Scenario {
    /// Takes position and velocity of the initial state for those of the centre of mass, joints at their initial coordinates and
    /// rates, and puts those of B there.
    ///
    /// # Errors
    ///
    /// Parameters that the solver rejects; [`SolveError::Overflow`].
    pub fn start_from_centre_of_mass(&mut self) -> Result<(), Box<dyn std::error::Error>> {
        let spacecraft = self.spacecraft()?;
        let state = &self.initial;
        let centre = spacecraft.centre_of_mass(state)?.c;
        let momentum = spacecraft.momentum(state, About::InertialOrigin)?;
        // Both from B, in N.
        let place = state.attitude.dcm().transpose() * centre;
        let velocity = momentum.linear / spacecraft.mass() - state.r_b_n_dot;
        self.initial.r_b_n -= place;
        self.initial.r_b_n_dot -= velocity;
        Ok(())
    }
}

impl MassMatrix {
    /// That of a scenario's spacecraft.
    ///
    /// # Errors
    ///
    /// [`SolveError::Singular`] with the joint, where the pose has no accelerations.
    pub fn from_spacecraft(
        scenario: &Scenario,
        spacecraft: &Spacecraft<Set>,
    ) -> Result<Self, SolveError> {
        let (inverse, motors) = inverse(scenario, spacecraft)?;
        // Not positive definite: singular but for rounding, which the solver's bound let through.
        let matrix = inverse.clone().cholesky().map(|factors| factors.inverse());
        let hub = if scenario.hub_mode == HubMode::Free { HUB } else { 0 };
        let joints = scenario.joints().enumerate().map(|(joint, (_, _, info))| {
            let coordinate = motors.iter().position(|motor| *motor == joint);
            let free = coordinate.map(|k| inverse[(hub + k, hub + k)].recip());
            let held = if info.driven { Some(held(scenario, spacecraft, joint)?) } else { None };
            Ok(JointInertia { held, free })
        });
        let joints: Vec<_> = joints.collect::<Result<_, SolveError>>()?;
        let condition = matrix.filter(|matrix| !matrix.is_empty()).map(|matrix| {
            let size = matrix.diagonal().map(f64::sqrt);
            let scaled = inverse.map_with_location(|i, j, value| size[i] * value * size[j]);
            let eigenvalues = scaled.symmetric_eigenvalues();
            eigenvalues.max() / eigenvalues.min()
        });
        Ok(Self { joints, condition })
    }
}

/// Sum of the angular momenta of the hub and of each joint by itself, about the centre of mass, in the initial state, N m s: what a
/// total that cancels is compared with. None where they cannot be computed.
#[cfg(feature = "tool")]
pub(crate) fn momentum_size(scenario: &Scenario) -> Option<f64> {
    let spacecraft = scenario.spacecraft().ok()?;
    let size = |state: &State<Set>| {
        let momentum = spacecraft.momentum(state, About::CentreOfMass).ok()?;
        Some(momentum.angular.norm())
    };
    let at_rest = at_rest(scenario, &spacecraft);
    let mut hub = at_rest.clone();
    hub.omega = scenario.initial.omega;
    let mut sum = size(&hub)?;
    for (joint, [_, rate]) in scenario.initial.devices.states().enumerate() {
        let mut state = at_rest.clone();
        if let Some([_, own]) = state.devices.states_mut().nth(joint) {
            *own = rate;
        }
        sum += size(&state)?;
    }
    Some(sum)
}

/// The initial pose with B at the inertial origin, its axes along the inertial ones, at rest.
fn at_rest(scenario: &Scenario, spacecraft: &Spacecraft<Set>) -> State<Set> {
    let mut state: State<Set, Quaternion> = State::at_rest_for(spacecraft);
    let initial = scenario.initial.devices.states();
    for ([own, _], [coordinate, _]) in state.devices.states_mut().zip(initial) {
        *own = coordinate;
    }
    state
}

/// What a joint's motor moves with hub and all other joints held: twice the kinetic energy at a unit
/// rate.
fn held(
    scenario: &Scenario,
    spacecraft: &Spacecraft<Set>,
    joint: usize,
) -> Result<f64, SolveError> {
    let mut state = at_rest(scenario, spacecraft);
    if let Some([_, rate]) = state.devices.states_mut().nth(joint) {
        *rate = 1.0;
    }
    Ok(2.0 * spacecraft.energy(&state)?)
}

/// Writes the modes that the scenario's drives give the joints at the start. A joint that its kind
/// keeps at its rate keeps its mode.
pub(super) fn drive_at_start(scenario: &Scenario, modes: &mut impl Each<Mode>) {
    let joints = modes.values_mut().zip(scenario.joints()).zip(&scenario.drives);
    for ((mode, _), drive) in joints.filter(|((_, (_, _, info)), _)| info.driven) {
        *mode = match drive {
            Drive::Torque { .. } => Mode::Driven,
            Drive::Acceleration(profile) => Mode::Prescribed(profile.at(0.0, false)),
            Drive::Locked => Mode::Locked,
        };
    }
}

/// The inverse of the mass matrix, symmetric to the last bit, and the joints that are coordinates.
fn inverse(
    scenario: &Scenario,
    spacecraft: &Spacecraft<Set>,
) -> Result<(DMatrix<f64>, Vec<usize>), SolveError> {
    let state = at_rest(scenario, spacecraft);
    let mut inputs = Inputs::none_for(spacecraft);
    drive_at_start(scenario, &mut inputs.modes);
    let hub = scenario.hub_mode == HubMode::Free;
    if !hub {
        inputs.hub = HubMode::Fixed;
    }
    let motors: Vec<usize> = inputs
        .modes
        .values()
        .enumerate()
        .filter_map(|(joint, mode)| (mode == Mode::Driven).then_some(joint))
        .collect();
    let solve = |inputs: &Inputs<Set>| spacecraft.accelerations(&state, inputs);
    let flat = |found: &Accelerations<Set>| -> Vec<f64> {
        let of_hub = found.r_b_n_ddot.iter().chain(&found.omega_dot).copied();
        let of_joints: Vec<f64> = found.devices.values().collect();
        let driven = motors.iter().filter_map(|joint| of_joints.get(*joint).copied());
        of_hub.filter(|_| hub).chain(driven).collect()
    };
    let none = flat(&solve(&inputs)?);
    let mut inverse = DMatrix::zeros(none.len(), none.len());
    for coordinate in 0..none.len() {
        let mut unit = inputs.clone();
        match coordinate.checked_sub(if hub { HUB } else { 0 }) {
            Some(index) => {
                let motor =
                    motors.get(index).and_then(|joint| unit.motors.values_mut().nth(*joint));
                if let Some(torque) = motor {
                    *torque = 1.0;
                }
            }
            None if coordinate < 3 => unit.force[coordinate] = 1.0,
            None => unit.torque_b[coordinate - 3] = 1.0,
        }
        let found = flat(&solve(&unit)?);
        for (row, (with, without)) in found.iter().zip(&none).enumerate() {
            inverse[(row, coordinate)] = with - without;
        }
    }
    Ok(((&inverse + inverse.transpose()) * 0.5, motors))
}

/// The imbalance of a device's wheel; none of a kind that is balanced or has no wheel.
#[must_use]
pub fn imbalance(device: &BuiltIn) -> Option<Imbalance> {
    match device {
        BuiltIn::ReactionWheel(device) => device.imbalance().ok(),
        BuiltIn::Sgcmg(device) => device.imbalance().ok(),
        BuiltIn::Vscmg(device) => device.imbalance().ok(),
        BuiltIn::Dgcmg(device) => device.imbalance().ok(),
        BuiltIn::Dgvscmg(device) => device.imbalance().ok(),
        BuiltIn::FlexibleReactionWheel(_) | BuiltIn::FlexibleVscmg(_) => {
            let bodies = device.parameters().bodies;
            let mut rotors = device.kind().joints().iter().zip(&bodies);
            let (_, rotor) = rotors.find(|(info, _)| info.body == "wheel")?;
            let (j_12, j_13) = (rotor.inertia[(0, 1)], rotor.inertia[(0, 2)]);
            WheelImbalance { d: rotor.centre[1], j_12, j_13 }.lumped(rotor.mass).ok()
        }
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use precess_dynamics::BuiltIn;

    use super::*;
    use crate::engine::tests::{panel, scenario, wheel};

    fn mass_of(devices: Vec<BuiltIn>) -> (MassProperties, MassMatrix) {
        let names = ["a", "b"];
        let scenario = scenario(&names[..devices.len()], devices, 1.0);
        let spacecraft = scenario.spacecraft().expect("accepted");
        let properties = MassProperties::from_spacecraft(&scenario, &spacecraft).expect("finite");
        (properties, MassMatrix::from_spacecraft(&scenario, &spacecraft).expect("regular"))
    }

    /// A rotor of 0.2 kg m^2 about the hub's first axis through B, where the hub has 30 kg m^2.
    #[test]
    fn a_rotor_on_a_free_hub_has_its_reduced_inertia() {
        let (properties, matrix) = mass_of(vec![wheel().into()]);
        assert_eq!(properties.mass, 104.0);
        assert!(
            (properties.inertia_b - Matrix3::from_diagonal(&Vector3::new(30.2, 40.1, 50.1))).amax()
                < 1e-14
        );
        let [joint] = matrix.joints[..] else { panic!("{matrix:?}") };
        assert!(joint.held.is_some_and(|held| (held - 0.2).abs() < 1e-15), "{joint:?}");
        let reduced = 0.2 * 30.0 / 30.2;
        assert!(joint.free.is_some_and(|free| (free - reduced).abs() < 1e-15), "{joint:?}");
        // Only wheel and hub about b_x are coupled, by c = sqrt(0.2 / 30.2).
        let c = (0.2_f64 / 30.2).sqrt();
        let condition = (1.0 + c) / (1.0 - c);
        assert!(matrix.condition.is_some_and(|found| (found / condition - 1.0).abs() < 1e-13));
    }

    /// Hub of 100 kg and wheel of 4 kg, centres 0.26 m apart along the first axis: 100 x 4 / 104 x 0.26^2 kg m^2 more across it.
    #[test]
    fn the_inertia_about_the_centre_of_mass_is_by_the_reduced_mass() {
        let mut scenario = scenario(&["a"], vec![wheel().into()], 1.0);
        scenario.hub.r_bc_b = Vector3::new(0.26, 0.0, 0.0);
        let spacecraft = scenario.spacecraft().expect("accepted");
        let found = MassProperties::from_spacecraft(&scenario, &spacecraft).expect("finite");
        assert!((found.centre_of_mass - Vector3::new(0.25, 0.0, 0.0)).norm() < 1e-15);
        let across = 100.0 * 4.0 / 104.0 * 0.26 * 0.26;
        let diagonal = Vector3::new(30.2, 40.1 + across, 50.1 + across);
        assert!((found.inertia_c() - Matrix3::from_diagonal(&diagonal)).amax() < 1e-13);
        assert!((found.principal().0 - diagonal).norm() < 1e-13);
    }

    #[test]
    fn a_joint_without_a_motor_has_no_inertia_of_its_own() {
        let kind = BuiltIn::from(precess_dynamics::Sgcmg::bare_wheel(
            4.0,
            Matrix3::from_diagonal(&Vector3::new(0.2, 0.1, 0.1)),
        ));
        let (_, matrix) = mass_of(vec![panel().into(), kind]);
        let has: Vec<_> = matrix.joints.iter().map(|joint| joint.held.is_some()).collect();
        assert_eq!(has, [true, true, false]);
    }

    /// A locked joint moves no coordinate, but its motor would move what it moved before.
    #[test]
    fn a_locked_joint_is_no_coordinate() {
        let mut locked = scenario(&["wheel"], vec![wheel().into()], 1.0);
        locked.drives = vec![Drive::Locked];
        let spacecraft = locked.spacecraft().expect("accepted");
        let matrix = MassMatrix::from_spacecraft(&locked, &spacecraft).expect("regular");
        let [joint] = matrix.joints[..] else { panic!("{matrix:?}") };
        assert!(joint.held.is_some_and(|held| (held - 0.2).abs() < 1e-15), "{joint:?}");
        assert_eq!(joint.free, None);
    }

    #[test]
    fn nothing_but_a_clamped_hub_has_no_condition() {
        let mut clamped = scenario(&[], vec![], 1.0);
        clamped.hub_mode = HubMode::Fixed;
        let spacecraft = clamped.spacecraft().expect("accepted");
        let matrix = MassMatrix::from_spacecraft(&clamped, &spacecraft).expect("no equations");
        assert_eq!(matrix, MassMatrix { joints: vec![], condition: None });
    }
}
