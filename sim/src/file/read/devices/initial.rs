//! The initial state: `[initial]` of the hub, and the joints' own keys.

use nalgebra::{Matrix3, Rotation3, UnitQuaternion, Vector3};
use precess_control::rotation::product;
use precess_dynamics::{Attitude, JointStates, Mrp, Quaternion, State};

use super::device::Device;
use crate::file::keys::Keys;
use crate::file::read::values::mount::{axis_and_angle, euler};
use crate::scenario::{OrbitalFrame, Set};
use crate::units::{Measure, Plain};

/// A quaternion whose norm is off by more is an error; by less, rounding of what was typed.
const NORM_MAX: f64 = 1e-4;
/// One whose norm is off by less has all its digits: it is taken unchanged, to the bit.
const NORM_EXACT: f64 = 1e-14;

/// What position and velocity are of: whether the centre of mass.
const STATE_OF: [(&str, bool); 2] = [("B", false), ("centre_of_mass", true)];

/// How an attitude is written.
const WAYS: [&str; 4] = ["quaternion", "mrp", "euler", "axis"];

/// The initial state, and the attitude that rotations are from: that of the file, before a vibration is added to it.
pub(in crate::file::read) fn initial(
    keys: &Keys<'_>,
    devices: &[Device],
) -> (State<Set>, Quaternion) {
    let mut state = at_rest(devices);
    let mut reference = None;
    if let Some(initial) = keys.table("initial") {
        let vector = |key, measure| initial.vector(key, measure).unwrap_or_else(Vector3::zeros);
        state.r_b_n = vector("position", Measure::LENGTH);
        state.r_b_n_dot = vector("velocity", Measure::VELOCITY);
        state.omega = vector("angular_velocity", Measure::ANGULAR_RATE);
        if let Some(attitude) = initial.table("attitude") {
            if let Some(found) = attitude_of(&attitude) {
                state.attitude = found;
            }
            attitude.finish();
        }
        let frames = [("inertial", false), ("orbit", true)];
        if initial.choice("relative_to", &frames) == Some(true) {
            from_orbit(&initial, &mut state);
        }
        if let Some(attitude) = initial.table("rotation_from") {
            reference = attitude_of(&attitude);
            attitude.finish();
        }
        // Of the whole scenario: see `whole`.
        initial.boolean("settled");
        initial.choice("state_of", &STATE_OF);
        initial.finish();
    }
    let given = devices.iter().flat_map(|device| device.state.iter().copied());
    for ([coordinate, rate], [q, q_dot]) in state.devices.states_mut().zip(given) {
        (*coordinate, *rate) = (q, q_dot);
    }
    let reference = reference.unwrap_or(state.attitude);
    (state, reference)
}

/// Attitude and angular velocity with respect to N of those with respect to the orbital frame.
fn from_orbit(keys: &Keys<'_>, state: &mut State<Set>) {
    let Some(frame) = OrbitalFrame::new(&state.r_b_n, &state.r_b_n_dot) else {
        let message = "position and velocity are parallel or zero, so there is no orbital frame";
        keys.error("relative_to", message, "give the `position` and `velocity` of an orbit");
        return;
    };
    let of_frame = of_axes(&frame.axes.transpose());
    state.attitude = product(&of_frame, &state.attitude).normalised();
    state.omega += state.attitude.dcm() * frame.omega;
}

/// What of `[initial]` is of the whole spacecraft.
#[derive(Clone, Copy, Debug, Default)]
pub(in crate::file::read) struct WholeState {
    /// Whether position and velocity are those of the centre of mass.
    pub(in crate::file::read) of_centre: bool,
    /// Whether the run starts in the vibration of its rotors, about the state of the file.
    pub(in crate::file::read) settled: bool,
}

pub(in crate::file::read) fn whole(keys: &Keys<'_>) -> WholeState {
    let Some(initial) = keys.table("initial") else { return WholeState::default() };
    WholeState {
        of_centre: initial.choice("state_of", &STATE_OF).unwrap_or(false),
        settled: initial.boolean("settled").unwrap_or(false),
    }
}

/// Everything at rest, for these devices.
fn at_rest(devices: &[Device]) -> State<Set> {
    use precess_dynamics::{Hub, Spacecraft};
    let set = super::rows::set(devices);
    let hub = Hub { m_b: 1.0, r_bc_b: Vector3::zeros(), i_b_bc: Matrix3::identity() };
    // Devices that the solver rejects are reported with the whole; their state is not read.
    match Spacecraft::new(&hub, &set) {
        Ok(spacecraft) => State::at_rest_for(&spacecraft),
        Err(_) => State {
            r_b_n: Vector3::zeros(),
            r_b_n_dot: Vector3::zeros(),
            attitude: Quaternion::identity(),
            omega: Vector3::zeros(),
            devices: Default::default(),
            modal: (),
        },
    }
}

/// The attitude of B with respect to N; nothing where it is wrong, which has been reported.
pub(in crate::file::read) fn attitude_of(keys: &Keys<'_>) -> Option<Quaternion> {
    let ways: Vec<_> = WAYS.into_iter().filter(|way| keys.has(way)).collect();
    match ways.as_slice() {
        ["quaternion"] => quaternion(keys),
        ["mrp"] => {
            let sigma = Vector3::from(keys.numbers::<3>("mrp")?);
            Some(Quaternion::from(Mrp(sigma)))
        }
        ["euler"] => Some(of_axes(&euler(keys, ["N to B", "B to N"])?.matrix)),
        ["axis"] => Some(of_axes(&axis_and_angle(keys)?.matrix)),
        _ => {
            let message = format!("the attitude is given in {} ways", ways.len());
            let help = "give one of `quaternion` with `scalar`, `mrp`, `euler` with `sequence` and \
                        `direction`, or `axis` with `angle`";
            keys.reports().borrow_mut().error(keys.span(), message, "", help);
            None
        }
    }
}

fn quaternion(keys: &Keys<'_>) -> Option<Quaternion> {
    let numbers = keys.numbers::<4>("quaternion");
    if !keys.has("scalar") {
        keys.missing("scalar", "scalar = \"first\"");
    }
    let first = keys.choice("scalar", &[("first", true), ("last", false)]);
    let numbers = numbers?;
    let [q0, q1, q2, q3] =
        if first? { numbers } else { [numbers[3], numbers[0], numbers[1], numbers[2]] };
    let norm = Vector3::new(q1, q2, q3).norm().hypot(q0);
    if (norm - 1.0).abs() > NORM_MAX {
        keys.error(
            "quaternion",
            format!("its norm is {}", Plain(norm)),
            "a unit quaternion has norm 1",
        );
        return None;
    }
    let given = Quaternion { q0, q1, q2, q3 };
    Some(if (norm - 1.0).abs() < NORM_EXACT { given } else { given.normalised() })
}

/// The attitude of axes whose columns are the new axes in the old ones.
pub(in crate::file::read) fn of_axes(axes: &Matrix3<f64>) -> Quaternion {
    let turn = UnitQuaternion::from_rotation_matrix(&Rotation3::from_matrix_unchecked(*axes));
    let [q1, q2, q3, q0] = turn.coords.into();
    Quaternion { q0, q1, q2, q3 }.normalised()
}
