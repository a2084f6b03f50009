//! [`Settling`]: of each controller the error after its slew, when it settled, time at a limit, least measure of singularity;
//! of samples as they come.

use std::f64::consts::TAU;

use crate::record::Header;
use crate::record::columns::{ControlQuantity, Quantity};
use crate::report::blocks::Fact;
use crate::report::number;
use crate::scenario::{Scenario, Statistic};

/// Of one controller.
#[derive(Clone, Debug)]
pub(in crate::report) struct Settling {
    name: String,
    /// Columns of the angle of the error, of how many commands are at a limit, and of the measure.
    columns: [Option<usize>; 3],
    /// From when the error counts, s: the end of a slew.
    from: f64,
    /// The limit of a requirement on the error, rad, and as it is written.
    limit: Option<(f64, String)>,
    /// The largest error after that time, rad, and when.
    largest: [f64; 2],
    /// The last time at which the error was beyond the limit, s.
    beyond: Option<f64>,
    /// The error at the last sample, rad, and its time.
    last: [f64; 2],
    /// Time with a command at a limit, s, and whether there was one at the last sample.
    limited: (f64, bool),
    /// The least measure of singularity, and when.
    least: [f64; 2],
}

impl Settling {
    /// Of all controllers whose error is recorded.
    pub(in crate::report) fn all(header: &Header, scenario: &Scenario) -> Vec<Self> {
        let controllers = scenario.controllers.iter().enumerate();
        let each = controllers.map(|(index, of)| {
            let column = |quantity| {
                let quantity = Quantity::Control(index, quantity);
                header.columns.iter().position(|column| column.quantity == quantity)
            };
            let name = &of.name;
            let errors = [format!("{name}.error"), format!("{name}.error_angle")];
            let limit = scenario.requirements.iter().find(|requirement| {
                requirement.statistic == Statistic::Peak && errors.contains(&requirement.quantity)
            });
            Self {
                name: name.clone(),
                columns: [
                    column(ControlQuantity::ErrorAngle),
                    column(ControlQuantity::Limited),
                    column(ControlQuantity::Measure),
                ],
                from: of.reference.slew_end().unwrap_or(0.0),
                limit: limit.map(|of| (of.limit, of.written.clone())),
                largest: [0.0; 2],
                beyond: None,
                last: [0.0; 2],
                limited: (0.0, false),
                least: [f64::INFINITY, 0.0],
            }
        });
        each.filter(|of| of.columns[0].is_some()).collect()
    }

    /// Adds a sample at a time, s.
    pub(in crate::report) fn add(&mut self, time: f64, row: &[f64]) {
        let [error, limited, measure] =
            self.columns.map(|column| column.and_then(|column| row.get(column)).copied());
        let error = error.unwrap_or(f64::NAN);
        let [_, before] = self.last;
        let (length, was) = self.limited;
        let length = if was { length + time - before } else { length };
        self.limited = (length, limited.is_some_and(|count| count > 0.0));
        self.last = [error, time];
        // What is no number is no small error.
        let exceeds = |bound: f64| error > bound || error.is_nan();
        if time >= self.from && exceeds(self.largest[0]) {
            self.largest = [error, time];
        }
        if self.limit.as_ref().is_some_and(|(limit, _)| exceeds(*limit)) {
            self.beyond = Some(time);
        }
        if let Some(measure) = measure.filter(|measure| *measure < self.least[0]) {
            self.least = [measure, time];
        }
    }

    /// Lines of the table of facts.
    pub(in crate::report) fn facts(&self) -> Vec<Fact> {
        let name = &self.name;
        let [error, end] = self.last;
        let mut facts = vec![Fact::new(&format!("{name}: error at the end"), angle(error))];
        let [largest, at] = self.largest;
        if end >= self.from {
            let after = if self.from > 0.0 { " after the slew" } else { "" };
            let value = format!("{} at {}\u{a0}s", angle(largest), number::time(at));
            facts.push(Fact::new(&format!("{name}: largest error{after}"), value));
        }
        if let Some((_, written)) = &self.limit {
            let what = format!("{name}: within {} from", written.replace(' ', "\u{a0}"));
            let value = match self.beyond {
                Some(beyond) if beyond >= end => "not at the end".to_owned(),
                Some(beyond) if beyond > self.from && self.from > 0.0 => format!(
                    "{}\u{a0}s on, {}\u{a0}s after the slew",
                    number::time(beyond),
                    number::short(beyond - self.from, 4)
                ),
                Some(beyond) => format!("{}\u{a0}s on", number::time(beyond)),
                None => "the start on".to_owned(),
            };
            facts.push(Fact::new(&what, value));
        }
        if self.columns[1].is_some() {
            let (length, _) = self.limited;
            let value = format!("{}\u{a0}s", number::short(length, 4));
            facts.push(Fact::new(&format!("{name}: time with a command at a limit"), value));
        }
        let [least, at] = self.least;
        if least.is_finite() {
            let value = format!("{} at {}\u{a0}s", number::short(least, 4), number::time(at));
            facts.push(Fact::new(&format!("{name}: least measure of singularity"), value));
        }
        facts
    }
}

/// An angle in the unit in which it is read.
fn angle(radians: f64) -> String {
    let degrees = radians * (360.0 / TAU);
    let (value, unit) = if degrees.abs() >= 0.01 || degrees == 0.0 {
        (degrees, "deg")
    } else {
        (degrees * 3600.0, "arcsec")
    };
    format!("{}\u{a0}{unit}", number::short(value, 4))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn settling() -> Settling {
        Settling {
            name: "aocs".to_owned(),
            columns: [Some(1), Some(2), Some(3)],
            from: 2.0,
            limit: Some((0.1, "0.1 rad".to_owned())),
            largest: [0.0; 2],
            beyond: None,
            last: [0.0; 2],
            limited: (0.0, false),
            least: [f64::INFINITY, 0.0],
        }
    }

    #[test]
    fn the_error_counts_after_the_slew_and_settles_for_good() {
        let mut of = settling();
        for (time, error, limited, measure) in [
            (0.0, 3.0, 1.0, 0.9),
            (1.0, 0.05, 2.0, 0.3),
            (2.0, 0.2, 0.0, 0.4),
            (3.0, 0.3, 0.0, 0.5),
            (4.0, 0.01, 0.0, 0.6),
        ] {
            of.add(time, &[time, error, limited, measure]);
        }
        assert_eq!((of.largest, of.beyond, of.limited.0), ([0.3, 3.0], Some(3.0), 2.0));
        assert_eq!(of.least, [0.3, 1.0]);
        let facts = of.facts();
        let values: Vec<_> = facts.iter().map(|fact| fact.value.as_str()).collect();
        assert_eq!(values[2], "3\u{a0}s on, 1\u{a0}s after the slew");
        of.add(5.0, &[5.0, f64::NAN, 0.0, 0.6]);
        assert_eq!(of.facts()[2].value, "not at the end", "what is no number is not settled");
    }
}
