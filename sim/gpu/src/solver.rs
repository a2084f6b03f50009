//! [`Solver`]: one spacecraft by the solver in Rust, state by state: what computes states that kernels refuse, and all of
//! them without a GPU.

use precess_dynamics::{
    Accelerations, BuiltIn, Each as _, Hub, Inputs, JointStates as _, ParameterError, Quaternion,
    Spacecraft, State,
};

use crate::layout::{HUB, normalise};
use crate::samples::StateSamples;
use crate::{ActingInputs, StateError};

type Set = Vec<BuiltIn>;

/// A spacecraft.
pub(crate) struct Solver {
    craft: Spacecraft<Set>,
    joints: Vec<usize>,
}

impl Solver {
    pub(crate) fn new(hub: &Hub, devices: &Set) -> Result<Self, ParameterError> {
        let joints = devices.iter().map(|device| device.kind().joints().len()).collect();
        Ok(Self { craft: Spacecraft::new(hub, devices)?, joints })
    }

    /// Places of coordinate and rate of each joint in a row.
    fn places(&self) -> impl Iterator<Item = [usize; 2]> {
        let mut next = HUB;
        self.joints.iter().flat_map(move |count| {
            let first = next;
            next += 2 * count;
            (0..*count).map(move |joint| [first + joint, first + count + joint])
        })
    }

    fn state(&self, row: &[f64]) -> State<Set> {
        let at = |index: usize| row.get(index).copied().unwrap_or(f64::NAN);
        let vector = |index| nalgebra::Vector3::new(at(index), at(index + 1), at(index + 2));
        let mut state = State::at_rest_for(&self.craft);
        (state.r_b_n, state.r_b_n_dot, state.omega) = (vector(0), vector(3), vector(10));
        state.attitude = Quaternion { q0: at(6), q1: at(7), q2: at(8), q3: at(9) };
        for ([coordinate, rate], [of, of_rate]) in state.devices.states_mut().zip(self.places()) {
            (*coordinate, *rate) = (at(of), at(of_rate));
        }
        state
    }

    fn write(&self, state: &State<Set>, row: &mut [f64]) {
        let q = state.attitude;
        let hub = state.r_b_n.iter().chain(state.r_b_n_dot.iter()).copied();
        let hub = hub.chain([q.q0, q.q1, q.q2, q.q3]).chain(state.omega.iter().copied());
        row.iter_mut().zip(hub).for_each(|(to, from)| *to = from);
        for ([coordinate, rate], [to, to_rate]) in state.devices.states().zip(self.places()) {
            for (place, number) in [(to, coordinate), (to_rate, rate)] {
                if let Some(to) = row.get_mut(place) {
                    *to = number;
                }
            }
        }
    }

    fn inputs(&self, acting: &ActingInputs) -> Inputs<Set> {
        acting.inputs(&self.craft)
    }

    /// Accelerations of a state whose attitude is normalised first.
    pub(crate) fn accelerations(
        &self,
        row: &[f64],
        acting: &ActingInputs,
        out: &mut [f64],
    ) -> Result<(), StateError> {
        let mut row = row.to_vec();
        normalise(&mut row);
        let found: Accelerations<Set> = self
            .craft
            .accelerations(&self.state(&row), &self.inputs(acting))
            .map_err(StateError::Solve)?;
        let hub = found.r_b_n_ddot.iter().chain(found.omega_dot.iter()).copied();
        let numbers = hub.chain(found.devices.values());
        out.iter_mut().zip(numbers).for_each(|(to, from)| *to = from);
        Ok(())
    }

    /// Steps of a state; `row` is that at their end. One that fails is the last one before.
    pub(crate) fn run(
        &self,
        row: &mut [f64],
        acting: &ActingInputs,
        ((dt, steps), every, normalises): ((f64, usize), usize, bool),
        samples: &mut StateSamples<'_>,
        go: &(dyn Fn() -> bool + Sync),
    ) -> Result<(), StateError> {
        samples.take(row);
        if normalises {
            normalise(row);
        }
        let (mut state, inputs) = (self.state(row), self.inputs(acting));
        let mut end = Ok(());
        for step in 1..=steps {
            if step % 256 == 0 && !go() {
                break;
            }
            match self.craft.step(&state, &inputs, dt) {
                Ok(next) => state = next,
                Err(error) => {
                    end = Err(StateError::Solve(error));
                    break;
                }
            }
            if step % every == 0 {
                self.write(&state, row);
                samples.take(row);
            }
        }
        self.write(&state, row);
        samples.end();
        end
    }
}
