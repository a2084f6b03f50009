//! A rigid body by the solver, and random quantities of one.

use nalgebra::{Matrix3, Vector3};
use precess_control::Motion;
use precess_dynamics::{Hub, Inputs, Quaternion, ReactionWheel, Spacecraft, State};

use crate::random::Random;

/// No devices.
type Nothing = [ReactionWheel; 0];

pub(crate) fn vector(random: &mut Random, size: f64) -> Vector3<f64> {
    Vector3::from_fn(|_, _| size * random.signed())
}

/// A symmetric, positive definite matrix.
pub(crate) fn definite(random: &mut Random, size: f64) -> Matrix3<f64> {
    let root = Matrix3::from_fn(|_, _| random.signed());
    let sum = (root * root.transpose() + Matrix3::identity() * 0.3) * size;
    (sum + sum.transpose()) / 2.0
}

/// A body that is run with a torque about its centre of mass.
pub(crate) struct Body {
    spacecraft: Spacecraft<Nothing>,
    state: State<Nothing, Quaternion>,
}

impl Body {
    pub(crate) fn new(inertia: Matrix3<f64>, motion: &Motion) -> Self {
        let hub = Hub { m_b: 500.0, r_bc_b: Vector3::zeros(), i_b_bc: inertia };
        let mut state = State::at_rest();
        (state.attitude, state.omega) = (motion.attitude, motion.omega);
        Self { spacecraft: Spacecraft::new(&hub, &[]).unwrap(), state }
    }

    pub(crate) fn motion(&self) -> Motion {
        Motion { attitude: self.state.attitude, omega: self.state.omega }
    }

    /// Runs for a time with a constant torque, in steps of RK4.
    pub(crate) fn run(&mut self, torque: &Vector3<f64>, time: f64, steps: u32) {
        let inputs = Inputs { torque_b: *torque, ..Inputs::none() };
        for _ in 0..steps {
            let step = time / f64::from(steps);
            self.state = self.spacecraft.step(&self.state, &inputs, step).unwrap();
        }
    }
}
