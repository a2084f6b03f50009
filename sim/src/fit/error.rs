//! [`FitError`]: a measurement that no model can be fitted to: where, what, the bound and the remedy.

use std::fmt;

use super::measurement::{CHANNELS, Group};

/// Why a measurement has no fit.
#[derive(Clone, Debug, PartialEq)]
pub enum FitError {
    /// Too few records.
    Records {
        /// How many there are.
        found: usize,
        /// How many are needed.
        least: usize,
    },
    /// A record with too few or too many samples.
    Samples {
        /// Its name.
        record: String,
        /// How many samples it has.
        found: usize,
        /// Fewest and most.
        range: [usize; 2],
    },
    /// Channels of one record that differ in length.
    Uneven {
        /// Its name.
        record: String,
        /// Samples of each channel.
        found: [usize; CHANNELS],
    },
    /// A sample that is no finite number.
    Sample {
        /// The record's name.
        record: String,
        /// The channel.
        channel: &'static str,
        /// Its index, from 0.
        index: usize,
    },
    /// A number of a record that is out of range.
    Range {
        /// The record's name.
        record: String,
        /// What it is.
        what: &'static str,
        /// Its value, SI.
        value: f64,
        /// Lowest and highest, SI.
        range: [f64; 2],
    },
    /// Index pulses that do not follow the speed of their record.
    Pulses {
        /// The record's name.
        record: String,
        /// How many there are.
        found: usize,
        /// Largest distance of a pulse from a whole turn, turns.
        missed: f64,
        /// The bound, turns.
        bound: f64,
    },
    /// A spin axis and a reference direction that make no axes.
    Axes {
        /// Sine of the angle between them.
        sine: f64,
        /// The bound.
        bound: f64,
    },
    /// Two harmonic numbers that are equal, or one that is out of range.
    Harmonic {
        /// The number.
        number: f64,
        /// Lowest and highest.
        range: [f64; 2],
    },
    /// No line that stands out of the noise.
    NoLines {
        /// The highest statistic of a trial harmonic, standard deviations.
        highest: f64,
        /// The bound.
        bound: f64,
    },
    /// Too few lines for the parameters of a group of channels.
    Few {
        /// The group.
        group: Group,
        /// Line powers that there are.
        found: usize,
        /// Parameters.
        parameters: usize,
    },
    /// Iterations that do not converge.
    Diverged {
        /// The group.
        group: Group,
        /// The bound of iterations.
        iterations: usize,
    },
    /// Parameters that the measurement does not determine.
    Undetermined {
        /// The group.
        group: Group,
    },
    /// A mode that the measurement does not determine.
    Mode {
        /// The group.
        group: Group,
        /// Its frequency, Hz.
        hertz: f64,
        /// Which of its numbers.
        what: &'static str,
        /// The ends of the 95 % interval of that.
        interval: [f64; 2],
    },
    /// Too few records in which a line shows the speed.
    Lost {
        /// Records in which none does.
        lost: usize,
        /// How many there are.
        of: usize,
    },
    /// No record in which h = 1 is measured.
    NoImbalance,
    /// The same samples twice.
    Twice {
        /// Names of the records.
        records: [String; 2],
        /// Their places, from 1.
        places: [usize; 2],
    },
    /// A sweep without a steady step.
    NoSteps {
        /// Largest change of the speed within a step, as a share.
        tolerance: f64,
        /// Shortest step, s.
        shortest: f64,
    },
    /// A waterfall whose arrays do not agree.
    Waterfall {
        /// What is wrong.
        what: &'static str,
        /// What there is.
        found: usize,
        /// What is needed.
        wanted: usize,
    },
}

impl fmt::Display for FitError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Records { found, least } => {
                write!(f, "{found} steady speeds; measure at {least} or more")
            }
            Self::Samples { record, found, range: [least, most] } => {
                write!(f, "{record}: {found} samples; {least} to {most} are possible")
            }
            Self::Uneven { record, found } => {
                write!(f, "{record}: channels of {found:?} samples; make them equal")
            }
            Self::Sample { record, channel, index } => write!(
                f,
                "{record}: sample {index} of {channel} is no finite number; leave the step out or \
                 repair it"
            ),
            Self::Range { record, what, value, range: [low, high] } => {
                write!(f, "{record}: {what} is {value:e}; it is from {low:e} to {high:e}")
            }
            Self::Pulses { record, found, missed, bound } => write!(
                f,
                "{record}: of {found} index pulses one is {missed:.3} turns beside a whole turn, more \
                 than {bound}; check the speed, or leave the pulses out"
            ),
            Self::Axes { sine, .. } if !sine.is_finite() => f.write_str(
                "the spin axis, the reference direction or the position is zero or not finite; give three \
                 finite numbers, of a direction not all zero",
            ),
            Self::Axes { sine, bound } => write!(
                f,
                "the spin axis and the reference direction enclose an angle with the sine {sine:e}, \
                 below {bound:e}; choose a direction across the axis"
            ),
            Self::Harmonic { number, range: [low, high] } => write!(
                f,
                "harmonic number {number} is stated twice or is not within {low} to {high}; state each \
                 line once"
            ),
            Self::NoLines { highest, bound } => write!(
                f,
                "no line follows the speed: the best trial harmonic is {highest:.1} standard deviations \
                 above the noise, below {bound}; check speeds and units, or state the harmonics"
            ),
            Self::Few { group, found, parameters } => write!(
                f,
                "{group}: {found} line powers for {parameters} parameters; measure at more speeds, or \
                 state fewer harmonics and modes"
            ),
            Self::Diverged { group, iterations } => write!(
                f,
                "{group}: no convergence in {iterations} iterations; state the modes, or fewer of them"
            ),
            Self::Undetermined { group } => write!(
                f,
                "{group}: the lines do not determine the modes; state fewer, or measure speeds at which \
                 a line crosses them"
            ),
            Self::Mode { group, hertz, what, interval: [low, high] } => write!(
                f,
                "{group}: the lines do not determine the {what} of a mode at {hertz:.4} Hz: 95 % from {low:.3e} to \
                 {high:.3e}; leave the mode out, or measure speeds at which a line crosses it"
            ),
            Self::Lost { lost, of } => write!(
                f,
                "in {lost} of {of} records no line stands out within `speed_accuracy` of the speed, and the others are too \
                 few; check the speeds, state them more exactly with a lower `speed_accuracy`, or record an index"
            ),
            Self::NoImbalance => write!(
                f,
                "no record shows h = 1: its frequency is from 3 turns a record to 0.45 of the rate, 1.5 bins from other \
                 lines, and its speed is known; check rate, speeds and `speed_accuracy`"
            ),
            Self::Twice { records: [first, second], places: [a, b] } => write!(
                f,
                "{second} (number {b}): the same samples as {first} (number {a}); list each measurement once"
            ),
            Self::NoSteps { tolerance, shortest } => write!(
                f,
                "no stretch of {shortest} s keeps its speed within {tolerance}; raise \
                 `sweep.tolerance`, or lower `sweep.shortest`"
            ),
            Self::Waterfall { what, found, wanted } => {
                write!(f, "the waterfall has {found} {what}; {wanted} are needed")
            }
        }
    }
}

impl std::error::Error for FitError {}
