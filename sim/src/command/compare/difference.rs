//! [`Differences`] of two results (CSV), column by column over all samples.
//!
//! Both files are read side by side, so memory does not grow with them.

use std::path::Path;

use crate::command::error::CommandError;
use crate::command::result::Rows;

/// The differences of all columns that both results have.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Differences {
    pub(super) columns: Vec<Difference>,
    pub(super) samples: u64,
    /// Names of columns that only the first has, and only the second.
    pub(super) only: [Vec<String>; 2],
}

impl Differences {
    /// Whether a column differs, or only one result has it.
    pub(super) fn any(&self) -> bool {
        self.columns.iter().any(|of| of.differs) || self.only.iter().any(|only| !only.is_empty())
    }
}

/// The difference of one column over all samples.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Difference {
    pub(super) name: String,
    pub(super) unit: String,
    /// Its index in either.
    places: [usize; 2],
    /// Largest magnitude of the difference, and the time of it.
    pub(super) peak: f64,
    pub(super) time: f64,
    /// Sum of squares of the difference.
    square: f64,
    /// Largest magnitude of the column in each.
    pub(super) largest: [f64; 2],
    /// Whether the difference is larger than its tolerance.
    pub(super) differs: bool,
}

impl Difference {
    /// Root mean square over so many samples.
    #[expect(clippy::cast_precision_loss, reason = "fewer samples than 2^53")]
    pub(super) fn rms(&self, samples: u64) -> f64 {
        (self.square / samples.max(1) as f64).sqrt()
    }
}

/// Reads two results.
pub(super) fn differences(a: &Path, b: &Path) -> Result<Differences, CommandError> {
    let (mut a, mut b) = (Rows::open(a)?, Rows::open(b)?);
    let mut columns = Vec::new();
    for (place, (name, unit)) in a.names.iter().zip(&a.units).enumerate().skip(1) {
        if let Some(other) = b.names.iter().position(|known| known == name) {
            columns.push(Difference {
                name: name.clone(),
                unit: unit.clone(),
                places: [place, other],
                ..Difference::default()
            });
        }
    }
    let missing = |of: &[String], other: &[String]| -> Vec<String> {
        of.iter().filter(|name| !other.contains(*name)).cloned().collect()
    };
    let only = [missing(&a.names, &b.names), missing(&b.names, &a.names)];
    let (mut row_a, mut row_b) = (Vec::new(), Vec::new());
    let mut samples = 0;
    loop {
        let more = [a.next(&mut row_a)?, b.next(&mut row_b)?];
        match more {
            [false, false] => break,
            [true, true] => {}
            _ => {
                let message = "one result has more samples than the other; compare runs of one \
                               duration and rate";
                return Err(CommandError::Other(message.to_owned()));
            }
        }
        let value = |row: &[f64], place: usize| row.get(place).copied().unwrap_or(f64::NAN);
        let [time_a, time_b] = [value(&row_a, 0), value(&row_b, 0)];
        if time_a != time_b {
            let message = format!(
                "sample {samples} is at {time_a} s in one and at {time_b} s in the other; compare \
                 runs of one rate"
            );
            return Err(CommandError::Other(message));
        }
        for d in &mut columns {
            let [of_a, of_b] = [value(&row_a, d.places[0]), value(&row_b, d.places[1])];
            // Infinities and numbers that are none differ from others, and not from themselves.
            let is_same = of_a == of_b || (of_a.is_nan() && of_b.is_nan());
            let off = if is_same { 0.0 } else { (of_a - of_b).abs() };
            if off > d.peak || (off.is_nan() && !d.peak.is_nan()) {
                (d.peak, d.time) = (off, time_a);
            }
            d.square += off * off;
            let [a, b] = d.largest;
            d.largest = [a.max(of_a.abs()), b.max(of_b.abs())];
        }
        samples += 1;
    }
    Ok(Differences { columns, samples, only })
}
