//! [`SideBySide`]: some spacecraft whose devices are of one kind, each with parameters of its own,
//! that make the same steps.

use nalgebra::Vector3;
use precess_dynamics::kind::Kind;
use precess_dynamics::lanes::Batch;
use precess_dynamics::{
    BuiltIn, Hub, Inputs, JointStates as _, Quaternion, SolveError, Spacecraft, State, every_kind,
};

use crate::kind_batch::{Set, write_inputs};
use crate::{StateInputs, StateResults, devices_of, in_lanes, one_kind};

/// The state of a spacecraft, of whatever kind its devices are.
#[derive(Clone, Debug)]
pub struct Motion {
    /// Position of B, in N, m.
    pub r_b_n: Vector3<f64>,
    /// Its velocity, in N, m/s.
    pub r_b_n_dot: Vector3<f64>,
    /// Attitude of B with respect to N.
    pub attitude: Quaternion<f64>,
    /// Angular velocity of B, in B, rad/s.
    pub omega: Vector3<f64>,
    /// Coordinate and rate of each joint, in order, rad or m, and by s.
    pub joints: Vec<[f64; 2]>,
}

/// Spacecraft side by side.
pub trait SideBySide: Send {
    /// Advances each by so many steps of RK4 of this length, s, inputs held: the bits of
    /// [`Spacecraft::step`] of each by itself. A state that fails is left as it was before the step
    /// that failed. `at` has one entry for each spacecraft.
    fn advance(
        &mut self,
        at: &mut [(Motion, StateInputs)],
        length: f64,
        steps: usize,
    ) -> StateResults;
}

/// These spacecraft; none where their devices are of several kinds, of a kind without lanes, of different numbers, or
/// none, or where one of them is rejected.
#[must_use]
pub fn side_by_side(crafts: &[(Hub, Vec<BuiltIn>)]) -> Option<Box<dyn SideBySide>> {
    let first = one_kind(crafts)?;
    macro_rules! by_kind {
        ($($kind:ident $module:ident $number:literal;)*) => {
            match first {
                $(BuiltIn::$kind(_) => in_lanes!($kind, of_kind(&devices_of!(crafts, $kind)), None),)*
            }
        };
    }
    every_kind!(by_kind)
}

fn of_kind<K: Kind<Scalar = f64>>(crafts: &[(Hub, Set<K>)]) -> Option<Box<dyn SideBySide>> {
    let made = crafts.iter().map(|(hub, devices)| Spacecraft::new(hub, devices).ok());
    let made = made.collect::<Option<Vec<_>>>()?;
    let first = made.first()?;
    let states = vec![State::at_rest_for(first); made.len()];
    let inputs = vec![Inputs::none_for(first); made.len()];
    Some(Box::new(KindRuns {
        batch: Batch::from_spacecraft(made),
        states,
        inputs,
        ends: Vec::new(),
    }))
}

/// Spacecraft with devices of a kind; what the batch reads and writes.
struct KindRuns<K: Kind<Scalar = f64>> {
    batch: Batch<Set<K>>,
    states: Vec<State<Set<K>>>,
    inputs: Vec<Inputs<Set<K>>>,
    ends: StateResults,
}

impl<K: Kind<Scalar = f64>> SideBySide for KindRuns<K> {
    fn advance(
        &mut self,
        at: &mut [(Motion, StateInputs)],
        length: f64,
        steps: usize,
    ) -> StateResults {
        let Self { batch, states, inputs, ends } = self;
        let Some(shape) = batch.spacecraft().first() else { return Vec::new() };
        if at.len() != states.len() {
            let count = SolveError::Count { expected: states.len(), found: at.len() };
            return vec![Err(count); at.len()];
        }
        for ((motion, acting), (state, inputs)) in
            at.iter().zip(states.iter_mut().zip(&mut *inputs))
        {
            (state.r_b_n, state.r_b_n_dot) = (motion.r_b_n, motion.r_b_n_dot);
            (state.attitude, state.omega) = (motion.attitude, motion.omega);
            state.devices.states_mut().zip(&motion.joints).for_each(
                |([coordinate, rate], from)| {
                    [*coordinate, *rate] = *from;
                },
            );
            write_inputs(shape, acting, inputs);
        }
        if let Err(error) = batch.run(states, &*inputs, length, steps, ends) {
            return vec![Err(error); at.len()];
        }
        for ((motion, _), state) in at.iter_mut().zip(states.iter()) {
            (motion.r_b_n, motion.r_b_n_dot) = (state.r_b_n, state.r_b_n_dot);
            (motion.attitude, motion.omega) = (state.attitude, state.omega);
            motion.joints.iter_mut().zip(state.devices.states()).for_each(|(to, from)| *to = from);
        }
        ends.clone()
    }
}
