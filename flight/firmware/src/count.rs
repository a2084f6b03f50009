//! Instructions of calls, counted by a Cortex-M's timer, of a spacecraft in general motion.
//!
//! QEMU's `-icount shift=0` makes an instruction a nanosecond; SysTick counts at 25 MHz, a tick
//! every 40 instructions.

use core::fmt::{self, Display, Write};

use nalgebra::{Matrix3, Vector3};
use precess_dynamics::{
    DerivativeError, Each, FixedSet, Hub, Inputs, JointStates, ParameterError, SolveError, State,
};

use crate::board::Timer;
use crate::random::Random;

/// Instructions in a tick of the timer.
const PER_TICK: u32 = 40;

/// Calls per count: a tick more or less is less than half an instruction.
const CALLS: u32 = 100;

/// Why counting stopped.
#[derive(Debug)]
pub enum Stop {
    /// The console took no more.
    Console,
    /// A spacecraft was rejected.
    Parameters(ParameterError<f64>),
    /// A state was rejected.
    Solve(SolveError<f64>),
    /// A linearisation was rejected.
    Derivatives(DerivativeError<f64>),
    /// A call was rejected.
    Rejected,
}

impl Display for Stop {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Console => write!(f, "the console took no more"),
            Self::Parameters(error) => write!(f, "{error}"),
            Self::Solve(error) => write!(f, "{error}"),
            Self::Derivatives(error) => write!(f, "{error}"),
            Self::Rejected => write!(f, "a call was rejected"),
        }
    }
}

impl From<fmt::Error> for Stop {
    fn from(_: fmt::Error) -> Self {
        Self::Console
    }
}

/// Prints counts, and counts the lines.
pub struct Counts<'a> {
    /// Where they are printed.
    pub out: &'a mut dyn Write,
    lines: u32,
}

impl<'a> Counts<'a> {
    /// None yet.
    pub fn new(out: &'a mut dyn Write) -> Self {
        Self { out, lines: 0 }
    }

    /// Prints what a call takes, by name.
    ///
    /// # Errors
    /// [`Stop::Rejected`] where it does not succeed, [`Stop::Console`].
    pub fn line(&mut self, name: &str, mut call: impl FnMut() -> bool) -> Result<(), Stop> {
        let timer = Timer::start();
        let mut done = true;
        for _ in 0..CALLS {
            done &= call();
        }
        let ticks = timer.ticks();
        if !done {
            return Err(Stop::Rejected);
        }
        self.lines += 1;
        // To the nearest.
        Ok(writeln!(self.out, "{name}: {}", (ticks * PER_TICK + CALLS / 2) / CALLS)?)
    }

    /// The last line, which says how many there were.
    ///
    /// # Errors
    /// [`Stop::Console`].
    pub fn end(self) -> Result<(), Stop> {
        Ok(writeln!(self.out, "end: {} lines", self.lines)?)
    }
}

/// The hub of what is counted.
#[must_use]
pub fn hub() -> Hub {
    Hub {
        m_b: 800.0,
        r_bc_b: Vector3::new(0.1, -0.2, 0.3),
        i_b_bc: Matrix3::new(900.0, 50.0, 30.0, 50.0, 800.0, 20.0, 30.0, 20.0, 600.0),
    }
}

/// General motion: nothing is zero, no gimbal is in a pose in which it has no inertia.
pub fn moving<D: FixedSet<Scalar = f64>>(state: &mut State<D>, inputs: &mut Inputs<D>) {
    let random = &mut Random::new(0x1AC_17C1);
    let mut number = |size: f64| random.within(0.5 * size, size);
    state.r_b_n = Vector3::from_fn(|_, _| number(100.0));
    state.r_b_n_dot = Vector3::from_fn(|_, _| number(10.0));
    state.omega = Vector3::from_fn(|_, _| number(0.5));
    inputs.force = Vector3::from_fn(|_, _| number(10.0));
    inputs.torque_b = Vector3::from_fn(|_, _| number(1.0));
    for [coordinate, rate] in state.devices.states_mut() {
        (*coordinate, *rate) = (number(1.0), number(2.0));
    }
    for motor in inputs.motors.values_mut() {
        *motor = number(0.2);
    }
}
