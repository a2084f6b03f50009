//! From a wheel on a rigid table to its disturbance model: imbalance, harmonics, internal modes and broadband
//! noise, each with its 95 % interval.
//!
//! ```text
//! records at steady speeds, in the wheel's axes about its centre     measurement
//!   -> angle of the wheel over each record                            rotation
//!   -> lines of each record, noise beside them                        lines, noise
//!   -> speeds and drifts that are known to many bins                  speeds
//!   -> harmonic numbers, speeds, drifts of all records at once        orders, detect
//!   -> coefficients and modes by the lines' powers over speed         powers, problem, modes, search
//!   -> phases                                                         phase
//!   -> broadband noise without the lines                              floor
//!   -> what the model does not explain                                discrepancy
//!   -> parts of a scenario                                            device
//! spectra without time series                                         waterfall, lobe
//! ```
//!
//! The model is that of Masterson, Miller and Grogan (J. Sound Vib. 249(3):575, 2002): each force and moment
//! is a sum of harmonics `C_i Omega² |H| sin(2 pi h_i f t + phi_i)`, `f = Omega / 2 pi`, here with the
//! amplification H of the wheel's own modes fitted together with the coefficients, so that a coefficient is
//! separated from a mode that its line crosses. Steps through a stop, run-downs and lines at fixed
//! frequencies (but for those that are stated) are not fitted.

mod detect;
pub mod device;
mod discrepancy;
mod error;
mod estimate;
pub mod example;
mod floor;
mod lines;
mod lobe;
pub mod measurement;
pub mod modes;
mod noise;
mod orders;
mod phase;
pub mod powers;
mod problem;
pub mod rotation;
pub mod samples;
mod search;
mod speeds;
mod waterfall;

pub use discrepancy::{Discrepancy, SQUARES_MAX, squares_bound};
pub use error::FitError;
pub use estimate::{Estimate, student};
pub use floor::Band;
pub use measurement::{CHANNEL_NAMES, CHANNELS, Group, Measurement, Record, TablePose};
pub use modes::{Mode, ModeGuess, amplification};
pub use powers::{FittedMode, GroupFit, Power, Sense};
pub use rotation::Rotation;
pub use waterfall::{WaterfallRow, fit_waterfall};

use detect::{LINES_MAX, Search, detect, remainders};
use discrepancy::Remainder;
use orders::{OrderLines, track};

/// The highest harmonic number that is looked for.
const HIGHEST: f64 = 20.0;
/// Harmonic numbers that may be stated.
const NUMBERS: [f64; 2] = [0.05, 1000.0];
/// What a speed is known to, as a share, without an index.
const ACCURACY: f64 = 1e-3;
/// A coefficient is seen where its power is this many standard deviations above zero.
const SEEN: f64 = 4.0;
/// A number this near to a whole one is whole.
const WHOLE: f64 = 5e-3;

/// What is looked for.
#[derive(Clone, Debug, PartialEq)]
pub struct Options {
    /// Harmonic numbers; empty to find them.
    pub harmonics: Vec<f64>,
    /// The highest number that is looked for.
    pub highest: f64,
    /// Modes; none to find them.
    pub modes: Option<Vec<ModeGuess>>,
    /// Frequencies of lines that follow no speed, Hz: of the mains, of the table.
    pub interference: Vec<f64>,
    /// What the speeds are known to, as a share; 0 where they are exact.
    pub speed_accuracy: f64,
    /// Whether lines that are much larger than the imbalance, and axial and backward ones at h = 1, are discrepancies.
    pub compare_with_imbalance: bool,
}

/// The imbalance of a wheel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FittedImbalance {
    /// `U_s`, kg m.
    pub u_s: Estimate,
    /// `U_d`, kg m².
    pub u_d: Estimate,
    /// By which the torque of `U_d` leads the force of `U_s` about the spin axis, rad; none where one of them
    /// is hidden by noise.
    pub phase: Option<Estimate>,
    /// Angle of the force of `U_s` from the reference direction at the index, rad; none without an index.
    pub angle: Option<Estimate>,
}

/// A coefficient of a line.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Coefficient {
    /// Which forces or moments.
    pub group: Group,
    /// Which way they turn; axial ones are forward.
    pub sense: Sense,
    /// `C`: force or moment by Omega², without modes; kg m or kg m².
    pub c: Estimate,
    /// From the index, rad; none without one, and of a number that is not whole.
    pub phase: Option<Estimate>,
    /// Whether it is above the noise.
    pub seen: bool,
}

/// A line.
#[derive(Clone, Debug, PartialEq)]
pub struct Harmonic {
    /// `h`.
    pub number: Estimate,
    /// Its coefficients.
    pub coefficients: Vec<Coefficient>,
}

/// A disturbance model.
#[derive(Clone, Debug)]
pub struct Fitted {
    /// The first harmonic.
    pub imbalance: FittedImbalance,
    /// All harmonics, the first among them.
    pub harmonics: Vec<Harmonic>,
    /// Internal modes.
    pub modes: Vec<FittedMode>,
    /// Broadband noise of each group.
    pub floors: Vec<(Group, Vec<Band>)>,
    /// The fit of each group, with what it was fitted to.
    pub groups: Vec<GroupFit>,
    /// Angle, speed and drift of each record.
    pub rotations: Vec<Rotation>,
    /// Mean PSD of each record and group for a waterfall, units²/Hz, and the width of its bins, Hz.
    pub waterfall: Vec<Spectrum>,
    /// What the model does not explain.
    pub discrepancies: Vec<Discrepancy>,
}

impl Fitted {
    /// Whether the model explains what was measured.
    #[must_use]
    pub fn holds(&self) -> bool {
        !self.discrepancies.iter().any(Discrepancy::fails)
    }
}

/// Spectra of a record.
#[derive(Clone, Debug)]
pub struct Spectrum {
    /// Width of a bin, Hz.
    pub bin: f64,
    /// Mean PSD of the residual, with the lines taken out, by group: N²/Hz or N² m²/Hz of each axis.
    pub groups: [Vec<f64>; 4],
}

impl Default for Options {
    fn default() -> Self {
        Self {
            harmonics: Vec::new(),
            highest: HIGHEST,
            modes: None,
            interference: Vec::new(),
            speed_accuracy: ACCURACY,
            compare_with_imbalance: true,
        }
    }
}

/// Fits a disturbance model.
///
/// # Errors
/// A record that cannot be used or is there twice, stated harmonics that cannot be distinguished, no line, no imbalance, or a
/// group whose parameters the measurement does not determine.
pub fn fit(measurement: &Measurement, options: &Options) -> Result<Fitted, FitError> {
    fit_with_progress(measurement, options, &mut |_| {})
}

/// As [`fit`]; tells what it is doing.
///
/// # Errors
/// As [`fit`].
pub fn fit_with_progress(
    measurement: &Measurement,
    options: &Options,
    progress: &mut dyn FnMut(&str),
) -> Result<Fitted, FitError> {
    measurement.check()?;
    check(options)?;
    let rotations =
        measurement.records.iter().map(Rotation::from_record).collect::<Result<Vec<_>, _>>()?;
    let tracked = tracked(measurement, rotations, options, progress)?;
    let numbers: Vec<f64> = tracked.orders.iter().map(|order| order.value).collect();
    let mut groups = Vec::new();
    for group in Group::ALL {
        progress(&format!("modes: {group}"));
        let points = powers::powers(group, &numbers, &tracked.rotations, &tracked.lines);
        let fitted = match &options.modes {
            Some(modes) => powers::fit(group, numbers.len(), points, modes),
            None => search::search(group, numbers.len(), &points),
        };
        let (lost, of) = (tracked.lost.len(), tracked.lines.len());
        groups.push(fitted.map_err(|error| match error {
            FitError::Few { .. } if lost > 0 => FitError::Lost { lost, of },
            error => error,
        })?);
    }
    progress("what is left");
    let durations: Vec<f64> = measurement.records.iter().map(Record::duration).collect();
    let left = remainders(options.highest, &durations, &tracked);
    let names: Vec<_> = measurement.records.iter().map(|record| record.name.clone()).collect();
    assembled(tracked, groups, &left, &names, options)
}

fn check(options: &Options) -> Result<(), FitError> {
    let mut rising = options.harmonics.clone();
    rising.sort_by(f64::total_cmp);
    let twice = rising.windows(2).find(|pair| pair[1] - pair[0] < 1e-6).map(|pair| pair[0]);
    let outside = |number: &&f64| !(NUMBERS[0]..=NUMBERS[1]).contains(*number);
    let bad = twice.or_else(|| rising.iter().find(outside).copied());
    if let Some(number) = bad {
        return Err(FitError::Harmonic { number, range: NUMBERS });
    }
    Ok(())
}

fn tracked(
    measurement: &Measurement,
    rotations: Vec<Rotation>,
    options: &Options,
    progress: &mut dyn FnMut(&str),
) -> Result<OrderLines, FitError> {
    let fixed = &options.interference;
    if options.harmonics.is_empty() {
        let highest = options.highest.clamp(1.0, NUMBERS[1]);
        let accuracy = options.speed_accuracy;
        return detect(&Search { measurement, rotations, fixed, accuracy, highest }, progress);
    }
    progress("lines");
    let mut numbers = options.harmonics.clone();
    if !numbers.contains(&1.0) {
        numbers.push(1.0);
    }
    numbers.sort_by(f64::total_cmp);
    numbers.truncate(LINES_MAX);
    let found = track(measurement, rotations, &numbers, fixed, options.speed_accuracy);
    found.ok_or(FitError::NoLines { highest: 0.0, bound: 0.0 })
}

/// Puts together what was fitted, of records with these names and with lines that are left in the residuals.
fn assembled(
    tracked: OrderLines,
    groups: Vec<GroupFit>,
    left: &[Remainder],
    names: &[String],
    options: &Options,
) -> Result<Fitted, FitError> {
    let of = |group: Group| groups.iter().find(|fit| fit.group == group);
    let first = tracked.orders.iter().position(|order| order.value == 1.0).unwrap_or(0);
    let forward = |group: Group| {
        let power = of(group).and_then(|fit| fit.powers.get(first)?[0]);
        power.map(Estimate::root).ok_or(FitError::NoImbalance)
    };
    let force_and_torque = of(Group::RadialForce).zip(of(Group::RadialTorque));
    let imbalance = FittedImbalance {
        u_s: forward(Group::RadialForce)?,
        u_d: forward(Group::RadialTorque)?,
        phase: force_and_torque.and_then(|(f, t)| phase::torque_from_force(f, t, first)),
        angle: of(Group::RadialForce)
            .and_then(|fit| phase::from_index(fit, first, Sense::Forward, &tracked.rotations)),
    };
    let mut harmonics = Vec::new();
    for (line, number) in tracked.orders.iter().enumerate() {
        let mut coefficients = Vec::new();
        for fit in &groups {
            for (sense, power) in
                [Sense::Forward, Sense::Backward].into_iter().zip(fit.powers[line])
            {
                let Some(power) = power else { continue };
                let whole = (number.value - number.value.round()).abs() < WHOLE;
                let seen = power.value > SEEN * power.deviation;
                let phase = (whole && seen)
                    .then(|| phase::from_index(fit, line, sense, &tracked.rotations))
                    .flatten();
                let (group, c) = (fit.group, power.root());
                coefficients.push(Coefficient { group, sense, c, phase, seen });
            }
        }
        harmonics.push(Harmonic { number: *number, coefficients });
    }
    let floors = groups
        .iter()
        .map(|fit| {
            let modes = fit.shapes();
            (fit.group, floor::floor(fit.group, &tracked.lines, &tracked.rotations, &modes))
        })
        .collect();
    let waterfall = tracked.lines.iter().map(|found| Spectrum {
        bin: found.bin,
        groups: Group::ALL.map(|group| {
            let [a, b] = group.channels().map(|channel| &found.spectra[channel]);
            a.iter().zip(b).map(|(a, b)| 0.5 * (a + b)).collect()
        }),
    });
    let mut discrepancies = discrepancy::of_residuals(&groups, &harmonics, names);
    let compared = options.compare_with_imbalance;
    discrepancies.extend(discrepancy::of_lines(&harmonics, left, compared));
    if !tracked.lost.is_empty() {
        let lost = tracked.lost.iter().filter_map(|record| names.get(*record).cloned());
        discrepancies.push(Discrepancy::Lost { records: lost.collect(), of: names.len() });
    }
    Ok(Fitted {
        imbalance,
        harmonics,
        modes: groups.iter().flat_map(|fit| fit.modes.clone()).collect(),
        floors,
        waterfall: waterfall.collect(),
        rotations: tracked.rotations,
        groups,
        discrepancies,
    })
}
