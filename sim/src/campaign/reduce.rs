//! [`Reducer`]: the samples of one run into a row of numbers: statistics of requirements, RMS, peak and lines of chosen
//! columns, values at the end. Memory does not grow with the run beyond the last [`LINE_SAMPLES_MAX`] samples of the
//! chosen columns.

use std::collections::VecDeque;

use crate::record::{Header, Outcome, RecordError, Recorder, Statistics};
use crate::scenario::{Requirement, Scenario};
use crate::spectra::{AmplitudeSpectrum, Detrend, WelchSettings, Window, amplitude_spectrum};

/// Lines are of this many last samples of a run, at most.
pub const LINE_SAMPLES_MAX: usize = 1 << 20;
/// Lines need this many samples.
const LINE_SAMPLES_MIN: usize = 64;
/// A sample is evenly spaced if its distance differs from that of others by this share at most.
const EVEN: f64 = 1e-6;

/// What is computed of each run.
#[derive(Clone, Debug, PartialEq)]
pub struct Selection {
    /// Columns, or vectors such as `omega`, of which RMS, peak and lines are computed.
    pub columns: Vec<String>,
    /// Lines of each of them.
    pub lines: usize,
    /// They are of the samples from this time on, s; requirements have their own windows.
    pub from: f64,
}

/// A number of a row.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Field {
    /// Its name: `camera.omega rms`.
    pub name: String,
    /// Its unit, SI.
    pub unit: String,
}

/// Computes a row.
pub struct Reducer<'a> {
    selection: &'a Selection,
    statistics: Statistics,
    parts: Vec<Part>,
    last: Vec<f64>,
    spacing: f64,
    row: Option<Vec<f64>>,
}

/// What is kept of a quantity.
#[derive(Default)]
struct Part {
    columns: Vec<usize>,
    /// Time and magnitude of the last sample.
    last: Option<[f64; 2]>,
    integral: f64,
    length: f64,
    most: f64,
    samples: Vec<VecDeque<f64>>,
}

impl Selection {
    /// The numbers of a row, in order: for each requirement its statistic, for each column its RMS, peak, and frequency and
    /// amplitude of its lines, the time at the end, and there every recorded column.
    #[must_use]
    pub fn fields(&self, header: &Header, requirements: &[Requirement]) -> Vec<Field> {
        let field = |name: String, unit: &str| Field { name, unit: unit.to_owned() };
        let unit = |name: &str| {
            let first = header.quantity(name).ok().and_then(|columns| columns.first().copied());
            first.and_then(|index| header.columns.get(index)).map_or("1", |column| column.unit)
        };
        let mut fields: Vec<Field> = requirements
            .iter()
            .map(|of| field(format!("requirement {}", of.name), unit(&of.quantity)))
            .collect();
        for name in &self.columns {
            fields.push(field(format!("{name} rms"), unit(name)));
            fields.push(field(format!("{name} peak"), unit(name)));
            for line in 1..=self.lines {
                fields.push(field(format!("{name} line {line} frequency"), "Hz"));
                fields.push(field(format!("{name} line {line} amplitude"), unit(name)));
            }
        }
        let end =
            |column: &crate::record::Column| field(format!("end {}", column.name), column.unit);
        fields.extend(header.columns.iter().map(end));
        fields
    }

    /// Places of the two numbers of each line of a column in a row.
    #[must_use]
    pub fn lines_of(&self, column: usize, requirements: usize) -> Vec<[usize; 2]> {
        let first = self.rms_of(column, requirements) + 2;
        (0..self.lines).map(|line| [first + 2 * line, first + 2 * line + 1]).collect()
    }

    /// Place of the RMS of a column in a row; its peak is the next.
    #[must_use]
    pub fn rms_of(&self, column: usize, requirements: usize) -> usize {
        requirements + column * (2 + 2 * self.lines)
    }
}

impl<'a> Reducer<'a> {
    /// For a scenario's requirements and what is selected.
    #[must_use]
    pub fn new(scenario: &Scenario, selection: &'a Selection) -> Self {
        Self {
            selection,
            statistics: Statistics::new(&scenario.requirements),
            parts: Vec::new(),
            last: Vec::new(),
            spacing: 1.0,
            row: None,
        }
    }

    /// The row, once the run has ended. A number that does not exist is NaN: a line beyond those there are, the statistic
    /// of a window that was not run to its end.
    #[must_use]
    pub fn row(self) -> Option<Vec<f64>> {
        self.row
    }
}

impl Recorder for Reducer<'_> {
    fn begin(&mut self, header: &Header) -> Result<(), RecordError> {
        self.statistics.begin(header)?;
        self.spacing = 1.0 / header.rate;
        self.parts.clear();
        for name in &self.selection.columns {
            let columns = header.quantity(name)?;
            let samples = columns.iter().map(|_| VecDeque::new()).collect();
            self.parts.push(Part { columns, samples, ..Part::default() });
        }
        Ok(())
    }

    fn sample(&mut self, row: &[f64]) -> Result<(), RecordError> {
        self.statistics.sample(row)?;
        self.last.clear();
        self.last.extend_from_slice(row);
        let time = row.first().copied().unwrap_or_default();
        if time >= self.selection.from {
            let keeps = self.selection.lines > 0;
            let spacing = self.spacing;
            self.parts.iter_mut().for_each(|part| part.add(time, row, spacing, keeps));
        }
        Ok(())
    }

    fn finish(&mut self, outcome: &Outcome) -> Result<(), RecordError> {
        self.statistics.finish(outcome)?;
        let verdicts = self.statistics.verdicts().iter();
        let mut row: Vec<f64> = verdicts
            .map(|verdict| verdict.value.filter(|_| verdict.complete).unwrap_or(f64::NAN))
            .collect();
        for part in &mut self.parts {
            part.enter(&mut row, self.selection.lines, 1.0 / self.spacing);
        }
        row.extend(&self.last);
        self.row = Some(row);
        Ok(())
    }
}

impl Part {
    fn add(&mut self, time: f64, row: &[f64], spacing: f64, keeps: bool) {
        let value = |column: &usize| row.get(*column).copied().unwrap_or(f64::NAN);
        let magnitude = self.columns.iter().map(|c| value(c) * value(c)).sum::<f64>().sqrt();
        // A NaN is no small value.
        if magnitude > self.most || magnitude.is_nan() {
            self.most = magnitude;
        }
        let mut even = true;
        if let Some([before, last]) = self.last {
            let step = time - before;
            self.integral += 0.5 * step * (last * last + magnitude * magnitude);
            self.length += step;
            even = (step / spacing - 1.0).abs() < EVEN;
        }
        self.last = Some([time, magnitude]);
        if !(even && keeps) {
            return;
        }
        for (samples, column) in self.samples.iter_mut().zip(&self.columns) {
            if samples.len() == LINE_SAMPLES_MAX {
                samples.pop_front();
            }
            samples.push_back(value(column));
        }
    }

    /// Enters RMS, peak and lines into a row.
    fn enter(&mut self, row: &mut Vec<f64>, lines: usize, rate: f64) {
        let Some([_, last]) = self.last else {
            row.extend(std::iter::repeat_n(f64::NAN, 2 + 2 * lines));
            return;
        };
        row.push(if self.length > 0.0 { (self.integral / self.length).sqrt() } else { last });
        row.push(self.most);
        let spectrum = if lines > 0 { self.spectrum(rate) } else { None };
        let found = spectrum.map(|spectrum| spectrum.strongest(lines)).unwrap_or_default();
        for index in 0..lines {
            let line = found.get(index);
            row.push(line.map_or(f64::NAN, |line| line.frequency));
            row.push(line.map_or(f64::NAN, |line| line.amplitude));
        }
    }

    /// Amplitudes by one segment, Hann's window, the straight line removed; of a vector the root of the sum of squares.
    fn spectrum(&mut self, rate: f64) -> Option<AmplitudeSpectrum> {
        let length = self.samples.first()?.len() & !1;
        if length < LINE_SAMPLES_MIN {
            return None;
        }
        let window = Window::Hann;
        let settings = WelchSettings { window, length, overlap: 0, detrend: Detrend::Linear };
        let mut sum: Option<AmplitudeSpectrum> = None;
        for samples in &mut self.samples {
            let samples = samples.make_contiguous();
            let samples = samples.get(samples.len() - length..)?;
            let found = amplitude_spectrum(samples, rate, &settings).ok()?;
            match &mut sum {
                None => sum = Some(found),
                Some(sum) => {
                    let pairs = sum.amplitude.iter_mut().zip(&found.amplitude);
                    pairs.for_each(|(a, b)| *a = (*a * *a + b * b).sqrt());
                }
            }
        }
        sum
    }
}
