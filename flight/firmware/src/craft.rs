//! A spacecraft with its state and inputs, drawn at random: every mode of hub and joints, every
//! gravity, wrenches on bodies.

use core::f64::consts::PI;

use nalgebra::Vector3;
use precess_dynamics::{
    Each, FixedSet, Gravity, Hub, HubMode, Inputs, JointStates, Mode, ParameterError, Quaternion,
    Scalar, Spacecraft, State, Wrench,
};

use crate::random::Random;

/// Gravitational parameter of the Earth, m³/s².
const MU: f64 = 3.986_004_418e14;

/// A spacecraft, where it is and what acts on it.
#[derive(Clone, Debug)]
pub struct Craft<D: FixedSet> {
    /// The spacecraft.
    pub craft: Spacecraft<D>,
    /// Its state.
    pub state: State<D>,
    /// What acts on it.
    pub inputs: Inputs<D>,
}

/// The modes that a drawn spacecraft's hub may have.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum HubModes {
    /// Free, to be run.
    Free,
    /// Free, clamped or prescribed, as drawn.
    Any,
}

impl<D: FixedSet> Craft<D> {
    /// The next spacecraft with these devices.
    ///
    /// # Errors
    /// As [`Spacecraft::new`].
    pub fn drawn(
        devices: &D,
        hub_is: HubModes,
        random: &mut Random,
    ) -> Result<Self, ParameterError<D::Scalar>> {
        let mass = random.within(200.0, 1000.0);
        let hub = Hub {
            m_b: D::Scalar::from_f64(mass),
            r_bc_b: random.vector(0.2),
            i_b_bc: random.block(mass),
        };
        let craft = Spacecraft::new(&hub, devices)?;
        let (mut state, mut inputs) = (State::at_rest(), Inputs::none());
        draw_hub_state(&mut state, &mut inputs, random);
        turn_joints(&mut state, &mut inputs, random);
        inputs.force = random.vector(10.0);
        inputs.torque_b = random.vector(1.0);
        if random.one_of(2) == 0 {
            let mut bodies = Inputs::<D>::no_wrenches();
            for wrench in bodies.values_mut() {
                *wrench = Wrench { force: random.vector(1.0), moment: random.vector(0.1) };
            }
            inputs.bodies = Some(bodies);
        }
        if hub_is == HubModes::Any {
            hold_hub(&mut state, &mut inputs, random);
        }
        Ok(Self { craft, state, inputs })
    }
}

/// Position, velocity, attitude and turning, and the field of gravity that goes with them.
#[inline(never)]
fn draw_hub_state<D: FixedSet>(state: &mut State<D>, inputs: &mut Inputs<D>, random: &mut Random) {
    state.r_b_n = random.vector(100.0);
    state.r_b_n_dot = random.vector(5.0);
    inputs.gravity = match random.one_of(3) {
        0 => Gravity::None,
        1 => Gravity::Uniform(random.vector(9.81)),
        _ => {
            state.r_b_n = Vector3::new(
                random.number(6.8e6, 7.2e6),
                random.number(-1e5, 1e5),
                random.number(-1e5, 1e5),
            );
            state.r_b_n_dot.y = random.number(7e3, 8e3);
            Gravity::Central { mu: D::Scalar::from_f64(MU) }
        }
    };
    let [q0, q1, q2, q3] = random.attitude();
    state.attitude = Quaternion { q0, q1, q2, q3 };
    state.omega = random.vector(0.5);
}

/// Coordinates, rates, motors and modes of the joints: half of the motors driven, a quarter each
/// prescribed and locked.
#[inline(never)]
fn turn_joints<D: FixedSet>(state: &mut State<D>, inputs: &mut Inputs<D>, random: &mut Random) {
    for motor in inputs.motors.values_mut() {
        *motor = random.number(-0.2, 0.2);
    }
    let joints = state.devices.states_mut().zip(inputs.modes.values_mut());
    for (([coordinate, rate], mode), info) in joints.zip(D::joint_infos()) {
        let (reach, speed) = match (info.slides, info.rate) {
            (true, _) => (0.05, 0.1),
            (false, "spin") => (PI, 60.0),
            (false, _) => (PI, 0.5),
        };
        *coordinate = random.number(-reach, reach);
        *rate = random.number(-speed, speed);
        match random.one_of(4) {
            0 if info.driven => *mode = Mode::Prescribed(random.number(-0.1, 0.1)),
            1 if info.driven => (*mode, *rate) = (Mode::Locked, D::Scalar::from_f64(0.0)),
            _ => {}
        }
    }
}

/// Half of the hubs stay free, a quarter each is clamped and prescribed.
#[inline(never)]
fn hold_hub<D: FixedSet>(state: &mut State<D>, inputs: &mut Inputs<D>, random: &mut Random) {
    match random.one_of(4) {
        0 => {
            state.r_b_n_dot = Vector3::from_element(D::Scalar::from_f64(0.0));
            state.omega = state.r_b_n_dot;
            inputs.hub = HubMode::Fixed;
        }
        1 => {
            let (r_b_n_ddot, omega_dot) = (random.vector(0.1), random.vector(0.1));
            inputs.hub = HubMode::Prescribed { r_b_n_ddot, omega_dot };
        }
        _ => {}
    }
}
