//! What is compared between machines: accelerations and runs of every set of devices, in bits.
//!
//! ```text
//! dgvscmg 1 accelerations: hash of all evaluations, then the last one's numbers
//! dgvscmg 1 steps: hash of the states after each step, then the last one's numbers
//! end: 35 lines
//! ```
//!
//! A program that stops early prints no last line, so a short output cannot pass for a whole one.

use core::fmt::{self, Display, LowerExp, Write};

use precess_dynamics::{
    Accelerations, Each, FixedSet, Flexible, Inputs, JointStates, ModesError, ParameterError,
    Quaternion, Scalar, SolveError, Spacecraft, State, StructureData,
};

use crate::bits::{Bits, Hash, write};
use crate::craft::{Craft, HubModes};
use crate::random::Random;
use crate::sets::{EachSet, each_set};
use crate::structure::{Storage, Structure, Wheels};

/// Spacecraft evaluated per set.
pub const EVALUATIONS: u64 = 32;

/// Steps of a run.
pub const STEPS: u32 = 1000;

/// Length of a step, s.
const STEP: f64 = 1e-3;

/// Sines and cosines in the sweep, of each size.
const ANGLES: usize = 512;

/// How large angles may be, rad.
const SIZES: [f64; 5] = [1.0, 1e3, 1e7, 1e15, 1e22];

/// Why the program stopped.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Stop<T> {
    /// The console took no more.
    Console,
    /// A drawn spacecraft was rejected.
    Parameters(ParameterError<T>),
    /// A drawn structure was rejected.
    Modes(ModesError<T>),
    /// A drawn state was rejected.
    Solve(SolveError<T>),
}

impl<T: Scalar + Display + LowerExp> Display for Stop<T> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Console => write!(f, "the console took no more"),
            Self::Parameters(error) => write!(f, "a drawn spacecraft was rejected: {error}"),
            Self::Modes(error) => write!(f, "a drawn structure was rejected: {error}"),
            Self::Solve(error) => write!(f, "a drawn state was rejected: {error}"),
        }
    }
}

impl<T> From<fmt::Error> for Stop<T> {
    fn from(_: fmt::Error) -> Self {
        Self::Console
    }
}

impl<T> From<ParameterError<T>> for Stop<T> {
    fn from(error: ParameterError<T>) -> Self {
        Self::Parameters(error)
    }
}

impl<T> From<ModesError<T>> for Stop<T> {
    fn from(error: ModesError<T>) -> Self {
        Self::Modes(error)
    }
}

impl<T> From<SolveError<T>> for Stop<T> {
    fn from(error: SolveError<T>) -> Self {
        Self::Solve(error)
    }
}

/// Prints every line for numbers of one type; `nudge` changes one component of the first
/// run's angular velocity by one unit in the last place, which has to be found.
///
/// # Errors
/// [`Stop`] where a spacecraft is rejected: none should be.
pub fn report<T: Bits>(out: &mut dyn Write, nudge: bool) -> Result<(), Stop<T>> {
    let mut lines = Lines { out, nudge, printed: 0 };
    lines.angles::<T>()?;
    each_set::<T, _>(&mut lines)?;
    lines.bending::<T>()?;
    Ok(writeln!(lines.out, "end: {} lines", lines.printed)?)
}

/// Prints lines and counts them.
struct Lines<'a> {
    out: &'a mut dyn Write,
    nudge: bool,
    printed: u32,
}

impl Lines<'_> {
    /// Sine and cosine, of angles beyond the range of the polynomials too.
    fn angles<T: Bits>(&mut self) -> Result<(), Stop<T>> {
        let (mut random, mut hash) = (Random::new(0), Hash::EMPTY);
        let mut last = (T::from_f64(0.0), T::from_f64(0.0));
        for size in SIZES {
            for _ in 0..ANGLES {
                last = random.number::<T>(-size, size).sin_cos();
                hash.take(last.0);
                hash.take(last.1);
            }
        }
        self.line("sin_cos", SIZES.len() * ANGLES, "sweep", hash, [last.0, last.1].into_iter())
    }

    /// A flexible structure.
    fn bending<T: Bits>(&mut self) -> Result<(), Stop<T>> {
        let mut hash = Hash::EMPTY;
        let mut last = None;
        for seed in 0..EVALUATIONS {
            let Structure { craft, state, inputs } = Structure::<T>::drawn(&mut Random::new(seed))?;
            let found = craft.accelerations(&state, &inputs)?;
            numbers(&found).chain(found.modal.eta_ddot).for_each(|number| hash.take(number));
            last = Some(found);
        }
        let last = last.iter().flat_map(|found| numbers(found).chain(found.modal.eta_ddot));
        self.line("bending", 2, "accelerations", hash, last)?;

        let Structure { craft, mut state, inputs } =
            Structure::drawn(&mut Random::new(EVALUATIONS))?;
        let mut hash = Hash::EMPTY;
        for _ in 0..STEPS {
            state = craft.step(&state, &inputs, T::from_f64(STEP))?;
            bent(&state).for_each(|number| hash.take(number));
        }
        self.line("bending", 2, "steps", hash, bent(&state))
    }

    fn line<T: Bits>(
        &mut self,
        name: &str,
        devices: usize,
        what: &str,
        hash: Hash,
        last: impl Iterator<Item = T>,
    ) -> Result<(), Stop<T>> {
        write!(self.out, "{name} {devices} {what}: {:016x}", hash.0)?;
        for number in last {
            write(self.out, number)?;
        }
        writeln!(self.out)?;
        self.printed += 1;
        Ok(())
    }
}

impl<T: Bits> EachSet<T> for Lines<'_> {
    type Error = Stop<T>;

    fn visit<D: FixedSet<Scalar = T>>(
        &mut self,
        name: &str,
        devices: usize,
        draw: impl Fn(&mut Random) -> D,
    ) -> Result<(), Stop<T>> {
        let mut hash = Hash::EMPTY;
        let mut last = None;
        for seed in 0..EVALUATIONS {
            let mut random = Random::new(seed);
            let set = draw(&mut random);
            let drawn = Craft::drawn(&set, HubModes::Any, &mut random)?;
            let found = drawn.craft.accelerations(&drawn.state, &drawn.inputs)?;
            numbers(&found).for_each(|number| hash.take(number));
            last = Some(found);
        }
        let last = last.iter().flat_map(numbers);
        self.line(name, devices, "accelerations", hash, last)?;

        let mut random = Random::new(EVALUATIONS);
        let set = draw(&mut random);
        let Craft { craft, mut state, inputs } = Craft::drawn(&set, HubModes::Free, &mut random)?;
        if core::mem::take(&mut self.nudge) {
            state.omega.x = state.omega.x.next();
        }
        let mut hash = Hash::EMPTY;
        for _ in 0..STEPS {
            state = stepped(&craft, &state, &inputs)?;
            of_state(&state).for_each(|number| hash.take(number));
        }
        self.line(name, devices, "steps", hash, of_state(&state))
    }
}

/// One step, out of line: one copy per set is enough.
#[inline(never)]
fn stepped<D: FixedSet>(
    craft: &Spacecraft<D>,
    state: &State<D>,
    inputs: &Inputs<D>,
) -> Result<State<D>, SolveError<D::Scalar>> {
    craft.step(state, inputs, D::Scalar::from_f64(STEP))
}

/// The numbers of an evaluation in order.
fn numbers<D: FixedSet, S: StructureData>(
    found: &Accelerations<D, S>,
) -> impl Iterator<Item = D::Scalar> {
    let hub = [&found.r_b_n_ddot, &found.omega_dot].into_iter();
    hub.flat_map(|vector| vector.iter().copied()).chain(found.devices.values())
}

/// The numbers of the state of a flexible structure in order.
fn bent<T: Bits>(
    state: &State<Wheels<T>, Quaternion<T>, Flexible<Storage>>,
) -> impl Iterator<Item = T> {
    of_state(state).chain(state.modal.eta).chain(state.modal.eta_dot)
}

/// The numbers of a state in order.
fn of_state<D: FixedSet, S: StructureData>(
    state: &State<D, Quaternion<D::Scalar>, S>,
) -> impl Iterator<Item = D::Scalar> {
    let q = &state.attitude;
    let hub = [&state.r_b_n, &state.r_b_n_dot, &state.omega].into_iter();
    hub.flat_map(|vector| vector.iter().copied())
        .chain([q.q0, q.q1, q.q2, q.q3])
        .chain(state.devices.states().flatten())
}
