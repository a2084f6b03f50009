//! [`design`]: which of some manoeuvres would tell what a record does not, and how much narrower it would make each interval: by
//! Fisher's information of each, at what was estimated.
//!
//! A manoeuvre is a scenario of the same spacecraft. Its run gives the torques of the motors; along them the motion with the estimated
//! numbers has the derivatives of what its sensors would read. State, bias and angles of wheels without an encoder at its start
//! are unknown, each within its usual size, and the information of the rest is that of Schur's complement
//!
//! ```text
//! I = N_ss - N_sn (N_nn + S^-2)^-1 N_ns        s the spacecraft's numbers, n those of the start, S their sizes
//! ```
//!
//! which adds to that of the record. Nothing is read, so no noise is drawn for it.

use std::ops::ControlFlow;

use nalgebra::{Cholesky, DMatrix, DVector};

use super::Unknowns;
use super::component::{Component, Start, Target, components, wheel_joint};
use super::directions::{Direction, untold};
use super::error::IdentifyError;
use super::estimates::Identified;
use super::model;
use super::noise::SensorNoise;
use super::solve::{Estimation, TOLD, scaled};
use super::timeline::Timeline;
use crate::engine::run;
use crate::record::Histories;
use crate::scenario::Scenario;
use crate::telemetry::{Sensor, Telemetry, TelemetryLayout, controller_of};

/// Information, of numbers of unit scale, that is rounding.
const ROUNDING: f64 = 1e-9;
/// A direction's share of a number from which the number is not told.
const SHARE: f64 = 0.1;

/// A manoeuvre.
#[derive(Clone, Copy, Debug)]
pub struct Manoeuvre<'a> {
    /// What it is called.
    pub name: &'a str,
    /// Its run, of the same spacecraft.
    pub scenario: &'a Scenario,
}

/// Standard deviations of a number.
#[derive(Clone, Debug, PartialEq)]
pub struct NumberDesign {
    /// Its name.
    pub name: String,
    /// SI.
    pub unit: &'static str,
    /// With the record alone; infinite where nothing tells it.
    pub alone: f64,
    /// With the record and each manoeuvre.
    pub with: Vec<f64>,
}

/// A direction that the record does not tell.
#[derive(Clone, Debug, PartialEq)]
pub struct DirectionDesign {
    /// The direction.
    pub direction: Direction,
    /// Its standard deviation by the data of the record and each manoeuvre, in units of the scale.
    pub with: Vec<f64>,
}

impl DirectionDesign {
    /// Whether a manoeuvre tells it.
    #[must_use]
    pub fn is_told_by(&self, manoeuvre: usize) -> bool {
        self.with.get(manoeuvre).is_some_and(|deviation| *deviation * deviation * TOLD <= 1.0)
    }
}

/// What manoeuvres would add.
#[derive(Clone, Debug, PartialEq)]
pub struct Design {
    /// Their names.
    pub manoeuvres: Vec<String>,
    /// Their lengths, s.
    pub durations: Vec<f64>,
    /// What the record does not tell of the spacecraft.
    pub directions: Vec<DirectionDesign>,
    /// The numbers of the spacecraft.
    pub numbers: Vec<NumberDesign>,
}

/// What each manoeuvre would add to a record of which this was found, with these unknowns.
///
/// # Errors
///
/// As [`identify`](super::identify), of a manoeuvre; [`IdentifyError::NothingOfSpacecraft`]; [`IdentifyError::Manoeuvre`] of one whose run fails or that is of another spacecraft.
pub fn design(
    scenario: &Scenario,
    of: &Unknowns,
    found: &Identified,
    manoeuvres: &[Manoeuvre<'_>],
) -> Result<Design, IdentifyError> {
    let own: Vec<Component> =
        found.components.iter().filter(|of| of.is_of_spacecraft()).cloned().collect();
    if own.is_empty() {
        return Err(IdentifyError::NothingOfSpacecraft);
    }
    let record = of_spacecraft(&found.information, &found.components);
    let mut informations = Vec::new();
    let mut durations = Vec::new();
    for manoeuvre in manoeuvres {
        let (information, duration) = information(scenario, of, found, manoeuvre)?;
        informations.push(&record + information);
        durations.push(duration);
    }
    let with = |direction: &Direction| {
        let along = DVector::from_column_slice(&direction.vector);
        let deviation = |all: &DMatrix<f64>| {
            let eigen = all.clone().symmetric_eigen();
            let parts = eigen.eigenvalues.iter().zip(eigen.eigenvectors.column_iter());
            let variance = |(value, vector): (&f64, nalgebra::DVectorView<'_, f64>)| {
                vector.dot(&along).powi(2) / value.max(ROUNDING)
            };
            parts.map(variance).sum::<f64>().sqrt()
        };
        informations.iter().map(deviation).collect()
    };
    // In units of the scales already.
    let unit: Vec<Component> =
        own.iter().map(|of| Component { scale: 1.0, ..of.clone() }).collect();
    let directions = untold(&record, &unit).into_iter().map(|direction| {
        let with = with(&direction);
        DirectionDesign { direction: direction.in_units_of(&own), with }
    });
    let directions = directions.collect();
    let alone = deviations(&record, &own);
    let with: Vec<Vec<f64>> = informations.iter().map(|all| deviations(all, &own)).collect();
    let numbers = own.iter().zip(alone).enumerate().map(|(index, (of, alone))| NumberDesign {
        name: of.name.clone(),
        unit: of.unit,
        alone,
        with: with.iter().filter_map(|all| all.get(index).copied()).collect(),
    });
    let numbers = numbers.collect();
    let manoeuvres = manoeuvres.iter().map(|of| of.name.to_owned()).collect();
    Ok(Design { manoeuvres, durations, directions, numbers })
}

/// Standard deviations, SI, of all numbers with this information in units of the scales, and the priors; infinite of what
/// nothing tells.
fn deviations(information: &DMatrix<f64>, components: &[Component]) -> Vec<f64> {
    let mut all = information.clone();
    for (index, of) in components.iter().enumerate() {
        if of.prior.is_some() {
            all[(index, index)] += 1.0;
        }
    }
    let eigen = all.symmetric_eigen();
    let of_number = |(index, of): (usize, &Component)| {
        let mut variance = 0.0;
        for (value, vector) in eigen.eigenvalues.iter().zip(eigen.eigenvectors.column_iter()) {
            let share = vector[index];
            if *value < TOLD && share.abs() > SHARE {
                return f64::INFINITY;
            }
            variance += share * share / value.max(ROUNDING);
        }
        of.scale * variance.sqrt()
    };
    components.iter().enumerate().map(of_number).collect()
}

/// The information of a normal matrix on the numbers of the spacecraft, in units of their scales.
fn of_spacecraft(normal: &DMatrix<f64>, components: &[Component]) -> DMatrix<f64> {
    let (scaled, _) = scaled(normal, components);
    let (own, start): (Vec<usize>, Vec<usize>) =
        (0..components.len()).partition(|place| components[*place].is_of_spacecraft());
    let part = |rows: &[usize], columns: &[usize]| {
        DMatrix::from_fn(rows.len(), columns.len(), |row, column| {
            scaled[(rows[row], columns[column])]
        })
    };
    let mut of_start = part(&start, &start);
    for place in 0..start.len() {
        of_start[(place, place)] += 1.0;
    }
    let across = part(&start, &own);
    let explained = Cholesky::new(of_start).map_or_else(
        || DMatrix::zeros(own.len(), own.len()),
        |of| across.tr_mul(&of.solve(&across)),
    );
    part(&own, &own) - explained
}

/// The information of a manoeuvre on the numbers of the spacecraft, in units of their scales, and its length, s.
fn information(
    scenario: &Scenario,
    of: &Unknowns,
    found: &Identified,
    manoeuvre: &Manoeuvre<'_>,
) -> Result<(DMatrix<f64>, f64), IdentifyError> {
    let failed = |reason: String| {
        let name = manoeuvre.name.to_owned();
        IdentifyError::Manoeuvre { name, reason }
    };
    let flown = manoeuvre.scenario;
    model::check(flown)?;
    let kinds = |of: &Scenario| -> Vec<_> {
        of.devices_on_hub()
            .unwrap_or_default()
            .iter()
            .map(precess_dynamics::BuiltIn::kind)
            .collect()
    };
    if flown.names != scenario.names || kinds(flown) != kinds(scenario) {
        return Err(failed("its devices are others than those of the scenario".to_owned()));
    }
    let controller = controller_of(flown, of.controller.as_deref())?;
    let telemetry = telemetry(flown, controller.rate, of.controller.as_deref(), &failed)?;
    let mut noise = SensorNoise::new(controller, &of.noise, &telemetry)?;
    // The run is of the scenario's numbers, the prediction of the estimated ones: a difference is no outlier.
    noise.bound = f64::INFINITY;
    let few = || IdentifyError::Few { found: 0, needed: of.unknowns.len() };
    let timeline = Timeline::new(flown, &telemetry, &noise).ok_or_else(few)?;
    let components = with_start(flown, of, found, &telemetry)?;
    let values: Vec<f64> = components
        .iter()
        .map(|own| {
            let place = found.components.iter().position(|of| of.target == own.target);
            let estimate = place.and_then(|place| found.numbers.get(place));
            estimate.filter(|_| own.is_of_spacecraft()).map_or(own.start, |of| of.estimate.value)
        })
        .collect();
    let estimation =
        Estimation { scenario: flown, components: &components, timeline: &timeline, noise: &noise };
    let pass = estimation.pass(&values, timeline.end, &mut |_| true)?;
    Ok((of_spacecraft(&pass.normal, &components), timeline.end - timeline.start))
}

/// The numbers of the spacecraft as in a record, and those of the start of a manoeuvre.
fn with_start(
    flown: &Scenario,
    of: &Unknowns,
    found: &Identified,
    telemetry: &Telemetry,
) -> Result<Vec<Component>, IdentifyError> {
    use precess_dynamics::JointStates as _;
    let joints = flown.initial.devices.states().enumerate().map(|(joint, [coordinate, rate])| {
        let has = |sensor| telemetry.of(sensor).is_some();
        (
            has(Sensor::Encoder(joint)).then_some(coordinate),
            has(Sensor::Tachometer(joint)).then_some(rate),
        )
    });
    let start = Start {
        omega: flown.initial.omega,
        attitude: telemetry.of(Sensor::StarTracker).is_some(),
        joints: joints.collect(),
    };
    let mut all = components(flown, &of.unknowns, &start)?;
    for own in &mut all {
        let place = found.components.iter().find(|of| of.target == own.target);
        if let Some(of_record) = place.filter(|_| own.is_of_spacecraft()) {
            own.clone_from(of_record);
        }
    }
    // Where a wheel is at the start of another record nobody knows.
    for device in 0..flown.names.len() {
        let of_wheel =
            |of: &Component| matches!(of.target, Target::Static(own, _) if own == device);
        let joint = wheel_joint(flown, device).filter(|_| all.iter().any(of_wheel));
        let Some(joint) = joint else { continue };
        if !all.iter().any(|of| of.target == Target::Coordinate(joint)) {
            all.extend(Component::free_coordinate(flown, joint));
        }
    }
    Ok(all)
}

/// What the sensors of a run read.
fn telemetry(
    flown: &Scenario,
    rate: f64,
    controller: Option<&str>,
    failed: &dyn Fn(String) -> IdentifyError,
) -> Result<Telemetry, IdentifyError> {
    let mut own = flown.clone();
    own.output.rate = rate;
    own.output.columns.clear();
    own.requirements.clear();
    let mut samples = Histories::default();
    let ran = run(&own, &mut samples, &mut |_| ControlFlow::Continue(()));
    let outcome = ran.map_err(|error| failed(error.to_string()))?;
    if !outcome.end.is_complete() {
        return Err(failed(outcome.end.to_string()));
    }
    let names = samples.header.map(|of| of.columns).unwrap_or_default();
    let columns = names.into_iter().map(|of| of.name).zip(samples.columns).collect();
    let layout = TelemetryLayout::of_scenario(flown, controller)?;
    Telemetry::of_columns("the run", columns, &layout).map_err(|error| failed(error.to_string()))
}
