//! [`SpectrumError`]: samples or settings of which no spectrum can be computed.

use std::fmt;

/// Samples or settings of which no spectrum can be computed.
#[derive(Clone, Debug, PartialEq)]
pub enum SpectrumError {
    /// The sampling rate is not a positive number, 1/s.
    Rate(f64),
    /// A segment is too short, longer than the record, or longer than is supported.
    Segment {
        /// Samples of the segment.
        length: usize,
        /// Fewest and most that there may be.
        bounds: [usize; 2],
    },
    /// Segments overlap by more than 63/64 of their length.
    Overlap {
        /// Samples that two segments share.
        overlap: usize,
        /// Samples of a segment.
        length: usize,
    },
    /// A sample is not finite.
    Sample {
        /// Number of the signal.
        signal: usize,
        /// Number of the sample.
        index: usize,
        /// Its value.
        value: f64,
    },
    /// Signals of one matrix have different numbers of samples.
    Lengths {
        /// Number of the signal.
        signal: usize,
        /// Samples of the first signal.
        expected: usize,
        /// Samples of this one.
        found: usize,
    },
    /// A result would have too many numbers, or none.
    Size {
        /// Numbers of the result.
        numbers: usize,
        /// Most that there may be.
        most: usize,
    },
    /// A signal or an entry of a matrix that there is not.
    Index {
        /// Its number.
        index: usize,
        /// How many there are.
        count: usize,
    },
    /// A band of frequencies is not rising, or not within 0 Hz and half the rate.
    Band {
        /// The band, Hz.
        band: [f64; 2],
        /// Half the sampling rate, Hz.
        highest: f64,
    },
    /// Coherence or an interval of fewer averages than two.
    Averages(f64),
    /// A level of confidence is not above zero and at most 0.9999.
    Level(f64),
    /// An order is not a positive finite number.
    Order(f64),
    /// The columns of a least-squares fit are not independent.
    Dependent {
        /// First sample of the window.
        start: usize,
        /// Least by largest diagonal entry of the triangular factor.
        ratio: f64,
        /// Least ratio that is accepted.
        bound: f64,
    },
    /// The transform failed.
    Transform {
        /// Samples of the segment.
        length: usize,
    },
}

impl fmt::Display for SpectrumError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Rate(rate) => {
                write!(f, "a sampling rate of {rate} 1/s; it is a positive finite number")
            }
            Self::Segment { length, bounds: [least, most] } if least > most => write!(
                f,
                "a segment of {length} samples of a record of {most}; at least {least} are needed: \
                 record a longer run or at a higher rate"
            ),
            Self::Segment { length, bounds: [least, most] } => write!(
                f,
                "a segment of {length} samples is not within {least} and {most}; choose another \
                 length, or record a longer run"
            ),
            Self::Overlap { overlap, length } => write!(
                f,
                "an overlap of {overlap} samples is above 63/64 of the segment's {length}; choose a \
                 smaller one"
            ),
            Self::Sample { signal, index, value } => {
                write!(
                    f,
                    "sample {index} of signal {signal} is {value}; spectra need finite samples"
                )
            }
            Self::Lengths { signal, expected, found } => write!(
                f,
                "signal {signal} has {found} samples and the first one {expected}; give signals of \
                 one length"
            ),
            Self::Size { numbers, most } => write!(
                f,
                "a result of {numbers} numbers is not within 1 and {most}; give fewer signals, or \
                 shorter segments"
            ),
            Self::Index { index, count } => {
                write!(f, "number {index} of {count}; they count from 0")
            }
            Self::Band { band: [from, to], highest } => write!(
                f,
                "the band {from} Hz to {to} Hz is not rising within 0 Hz and {highest} Hz, half the \
                 sampling rate; raise the rate"
            ),
            Self::Averages(averages) => write!(
                f,
                "{averages:.3} averages are below 2; choose shorter segments, or record a longer run"
            ),
            Self::Level(level) => {
                write!(
                    f,
                    "a level of confidence of {level} is not above 0 and at most 0.9999; write 0.95"
                )
            }
            Self::Order(order) => write!(f, "an order of {order}; it is a positive finite number"),
            Self::Dependent { start, ratio, bound } => write!(
                f,
                "orders are not separated in the window from sample {start}: {ratio:.1e} is below \
                 {bound:.0e}; choose a longer window, or orders that are farther apart"
            ),
            Self::Transform { length } => write!(
                f,
                "the transform of {length} samples failed; this is a fault of the program"
            ),
        }
    }
}

impl std::error::Error for SpectrumError {}
