//! [`BroadbandError`], [`MeasuredError`]: noise that cannot be realised and records that cannot be played:
//! what is wrong, the bound and the remedy.

use std::fmt;

use super::broadband::CYCLES_MAX;
use super::measured::{BREAKS_MAX, ROWS_MAX};
use crate::units::Plain;

/// Noise that cannot be realised.
#[derive(Clone, Debug, PartialEq)]
pub enum BroadbandError {
    /// A band that does not end above where it starts, or starts below zero.
    Band([f64; 2]),
    /// A period that is not positive, has no line in the band, or too many.
    Period {
        /// The period, s.
        period: f64,
        /// Cycles of the lowest and the highest frequency in it.
        cycles: [f64; 2],
    },
    /// Frequencies that do not grow from above zero.
    Frequencies {
        /// One, Hz.
        before: f64,
        /// The next one.
        after: f64,
    },
    /// A band beyond the table.
    Beyond {
        /// The band, Hz.
        band: [f64; 2],
        /// The table's first and last frequency, Hz.
        table: [f64; 2],
    },
    /// Another number of densities than of frequencies.
    Count {
        /// The component's name.
        component: &'static str,
        /// Its densities.
        found: usize,
        /// Frequencies.
        frequencies: usize,
    },
    /// A density that is negative or not finite.
    Density {
        /// The component's name.
        component: &'static str,
        /// The density.
        value: f64,
    },
    /// A reference rate that is zero or not finite, rad/s.
    Reference(f64),
    /// A pair of components that cannot share noise.
    Pair {
        /// Their names.
        components: [&'static str; 2],
        /// What is wrong, and the remedy.
        reason: &'static str,
    },
    /// Pairs that no noise has.
    Indefinite {
        /// The frequency, Hz.
        frequency: f64,
        /// The component at which the factor ends.
        component: &'static str,
        /// The pivot there, of one.
        pivot: f64,
    },
}

impl fmt::Display for BroadbandError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Band([from, to]) => {
                write!(
                    f,
                    "a band from {from} Hz to {to} Hz; it starts above 0 Hz and ends above that",
                    from = Plain(*from),
                    to = Plain(*to)
                )
            }
            Self::Period { period, cycles: [from, to] } => {
                let remedy = if *to > CYCLES_MAX { "shorter" } else { "longer" };
                write!(
                    f,
                    "a period of {period} s has {from} to {to} cycles of the band; it needs a whole \
                     number of cycles in it, from 1 to {CYCLES_MAX}; write a {remedy} `period`",
                    from = Plain(*from),
                    to = Plain(*to),
                    period = Plain(*period)
                )
            }
            Self::Frequencies { before, after } => {
                write!(
                    f,
                    "frequency {after} Hz after {before} Hz; they grow from above 0 Hz",
                    after = Plain(*after),
                    before = Plain(*before)
                )
            }
            Self::Beyond { band: [from, to], table: [first, last] } => write!(
                f,
                "the band, {from} Hz to {to} Hz, is not within the table, {first} Hz to {last} Hz; \
                 shorten it",
                from = Plain(*from),
                to = Plain(*to),
                first = Plain(*first),
                last = Plain(*last)
            ),
            Self::Count { component, found, frequencies: 0 } => write!(
                f,
                "{found} densities of {component}; write one, or `frequencies` with as many"
            ),
            Self::Count { component, found, frequencies } => write!(
                f,
                "{found} densities of {component} for {frequencies} frequencies; write one, or one for \
                 each"
            ),
            Self::Density { component, value } => {
                write!(
                    f,
                    "a density of {component} is {value}; it is finite and not negative",
                    value = Plain(*value)
                )
            }
            Self::Pair { components: [a, b], reason } => {
                write!(f, "coherence between {a} and {b}: {reason}")
            }
            Self::Indefinite { frequency, component, pivot } => write!(
                f,
                "at {frequency} Hz the cross-spectral matrix is not positive semidefinite: the pivot of \
                 {component} is {pivot:.3} below 0; lower the coherences of {component}, or correct their phases",
                frequency = Plain(*frequency)
            ),
            Self::Reference(rate) => {
                write!(
                    f,
                    "a reference rate of {rate} rad/s; it is finite and not zero",
                    rate = Plain(*rate)
                )
            }
        }
    }
}

impl std::error::Error for BroadbandError {}

/// A record that cannot be played.
#[derive(Clone, Debug, PartialEq)]
pub enum MeasuredError {
    /// Fewer than two rows, or too many.
    Rows(usize),
    /// Another number of values than of rows.
    Count {
        /// The component's name.
        component: &'static str,
        /// Its values.
        found: usize,
        /// Rows.
        rows: usize,
    },
    /// A time or a value that is not finite.
    NotFinite {
        /// `times`, or the component's name.
        what: &'static str,
        /// The row, from 1.
        row: usize,
        /// The number.
        value: f64,
    },
    /// A time that is not above the one before.
    Order {
        /// The row of the later one, from 1.
        row: usize,
        /// Both, s.
        times: [f64; 2],
    },
    /// More times at which a step has to end than a run may have.
    Breaks {
        /// How many.
        found: f64,
    },
}

impl fmt::Display for MeasuredError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Rows(rows) => write!(f, "{rows} rows; a record has 2 to {ROWS_MAX}"),
            Self::Count { component, found, rows } => {
                write!(f, "{found} values of {component} for {rows} rows; give one for each")
            }
            Self::NotFinite { what, row, value } => {
                write!(
                    f,
                    "{what} of row {row} is {value}; give a finite number",
                    value = Plain(*value)
                )
            }
            Self::Order { row, times: [before, after] } => write!(
                f,
                "the time of row {row}, {after} s, is not after that of the row before, {before} s; \
                 sort the record",
                after = Plain(*after),
                before = Plain(*before)
            ),
            Self::Breaks { found } => write!(
                f,
                "{found:e} times in the run at which a step ends, of at most {BREAKS_MAX:e}; shorten \
                 the run, thin the record, or take `interpolation = \"cubic\"`"
            ),
        }
    }
}

impl std::error::Error for MeasuredError {}
