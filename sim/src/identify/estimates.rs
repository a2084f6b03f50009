//! [`Identified`]: estimates with their intervals, correlations, what each sensor leaves, what the data do not tell.

use nalgebra::{Cholesky, DMatrix, DVector};

use super::amplitude::{about, normal, polar};
use super::component::{Component, Target, wheel_joint};
use super::directions::{Direction, untold};
use super::pass::Left;
use super::solve::{Estimation, Solution};
use crate::fit::Estimate;
use crate::scenario::Scenario;
use crate::telemetry::{Exclusion, Telemetry};

/// The model holds where no sensor has a larger mean square of residuals.
pub const SQUARES_MAX: f64 = 1.5;
/// Quantile of what few residuals reach by chance, once in 10,000.
const CHANCE: f64 = 3.719;
/// Names of the kinds of sensors of a pass.
const SENSORS: [&str; 4] = ["gyro", "star tracker", "tachometers", "encoders"];
/// Correlations from this on are listed.
const CORRELATED: f64 = 0.9;
/// A direction's share of a number, in units of its scale, from which the number is not told.
const SHARE: f64 = 0.1;

/// An estimate with its name.
#[derive(Clone, Debug, PartialEq)]
pub struct NamedEstimate {
    /// `hub.i_b_bc_xx`.
    pub name: String,
    /// SI.
    pub unit: &'static str,
    /// Value and interval.
    pub estimate: Estimate,
    /// Whether the data, or a prior, tell it.
    pub told: bool,
}

/// The imbalance of a wheel.
#[derive(Clone, Debug, PartialEq)]
pub struct WheelEstimate {
    /// The device's name.
    pub device: String,
    /// Its number.
    pub index: usize,
    /// The joint of the wheel: its name.
    pub coordinate: String,
    /// Static imbalance, kg m.
    pub u_s: Estimate,
    /// Dynamic imbalance, kg m².
    pub u_d: Estimate,
    /// By which the torque of `U_d` leads the force of `U_s`, rad; anything within half a turn where noise hides one of them.
    pub phase: Estimate,
    /// The angle of the wheel at the start of the record at which `U_s` is along its y axis, rad; so, too.
    pub angle: Estimate,
    /// Whether noise hides `U_s`, and `U_d`: the interval reaches to zero, and its upper end is a bound.
    pub hidden: [bool; 2],
    /// Whether the data, or a prior, tell all four.
    pub told: bool,
}

/// Two numbers that are known together better than each.
#[derive(Clone, Debug, PartialEq)]
pub struct Correlation {
    /// Their names.
    pub names: [String; 2],
    /// Of their errors.
    pub correlation: f64,
}

/// What the model leaves of a sensor's readings.
#[derive(Clone, Debug, PartialEq)]
pub struct SensorResidual {
    /// The sensor.
    pub sensor: &'static str,
    /// How many numbers.
    pub count: u64,
    /// Their mean square by the stated variance, three standard deviations at most; noise has 0.99.
    pub mean_square: f64,
    /// Beyond three standard deviations.
    pub outliers: u64,
    /// Whether the model explains them.
    pub holds: bool,
}

/// What was found in a record.
#[derive(Clone, Debug, PartialEq)]
pub struct Identified {
    /// All numbers, in order; the initial state among them.
    pub numbers: Vec<NamedEstimate>,
    /// Imbalances of wheels.
    pub wheels: Vec<WheelEstimate>,
    /// Covariance of all numbers, SI.
    pub covariance: DMatrix<f64>,
    /// The strongest first.
    pub correlations: Vec<Correlation>,
    /// Directions that the data do not tell.
    pub untold: Vec<Direction>,
    /// What is left of each kind of sensor.
    pub residuals: Vec<SensorResidual>,
    /// What was no reading.
    pub exclusions: Vec<Exclusion>,
    /// Readings before all motors have a torque, or beyond a gap of one.
    pub outside: usize,
    /// From when to when the record is, s.
    pub span: [f64; 2],
    /// The longest step of the integrator, s.
    pub step: f64,
    /// Steps of the estimation over the whole record.
    pub steps: usize,
    pub(super) components: Vec<Component>,
    /// Of the data, without priors.
    pub(super) information: DMatrix<f64>,
}

impl Identified {
    pub(super) fn new(
        scenario: &Scenario,
        estimation: &Estimation<'_>,
        solution: Solution,
        telemetry: &Telemetry,
    ) -> Self {
        let Solution { values, pass, steps } = solution;
        let components = estimation.components;
        let residuals = residuals(&pass.left);
        let mut information = pass.normal.clone();
        for (index, of) in components.iter().enumerate() {
            if let Some([_, deviation]) = of.prior {
                information[(index, index)] -= (deviation * deviation).recip();
            }
        }
        let untold = untold(&information, components);
        // What the model does not explain makes all intervals wider.
        let worst = residuals.iter().filter(|of| !of.holds).map(|of| of.mean_square);
        let factor = worst.fold(1.0, f64::max);
        let covariance = covariance(&pass.normal, components, &untold) * factor;
        let unknown = |index: usize| {
            let own = untold.iter().filter(|of| !of.has_prior);
            own.into_iter().any(|of| of.vector.get(index).is_some_and(|share| share.abs() > SHARE))
        };
        let estimate = |index: usize, value: f64| {
            let variance = covariance.get((index, index)).copied().unwrap_or_default();
            normal(value, variance.max(0.0).sqrt())
        };
        let numbers = components.iter().zip(&values).enumerate();
        let numbers = numbers.map(|(index, (of, value))| NamedEstimate {
            name: of.name.clone(),
            unit: of.unit,
            estimate: estimate(index, *value),
            told: !unknown(index),
        });
        let numbers: Vec<_> = numbers.collect();
        let wheels = wheels(scenario, components, &values, &covariance, &numbers);
        let correlations = correlations(components, &covariance);
        let timeline = estimation.timeline;
        Self {
            numbers,
            wheels,
            covariance,
            correlations,
            untold,
            residuals,
            exclusions: telemetry.exclusions.clone(),
            outside: timeline.left_out,
            span: [timeline.start, timeline.end],
            step: timeline.step,
            steps,
            components: components.to_vec(),
            information,
        }
    }

    /// Whether the model explains the readings of every sensor.
    #[must_use]
    pub fn holds(&self) -> bool {
        self.residuals.iter().all(|of| of.holds)
    }

    /// Whether data or priors tell all that is unknown.
    #[must_use]
    pub fn is_told(&self) -> bool {
        self.untold.iter().all(|of| of.has_prior)
    }

    /// The estimate of a name.
    #[must_use]
    pub fn number(&self, name: &str) -> Option<&NamedEstimate> {
        self.numbers.iter().find(|of| of.name == name)
    }
}

fn residuals(left: &[Left]) -> Vec<SensorResidual> {
    let of = |(sensor, left): (&'static str, &Left)| {
        #[expect(clippy::cast_precision_loss, reason = "numbers of readings")]
        let count = left.count as f64;
        let mean_square = left.squares / count;
        let bound = SQUARES_MAX.max(1.0 + CHANCE * (2.0 / count).sqrt());
        let (count, outliers) = (left.count, left.outliers);
        SensorResidual { sensor, count, mean_square, outliers, holds: mean_square <= bound }
    };
    SENSORS.into_iter().zip(left).filter(|(_, left)| left.count > 0).map(of).collect()
}

/// The inverse of the normal matrix; along what nothing tells, the variance of the scale.
fn covariance(
    normal: &DMatrix<f64>,
    components: &[Component],
    untold: &[Direction],
) -> DMatrix<f64> {
    let (mut scaled, scales) = super::solve::scaled(normal, components);
    for direction in untold.iter().filter(|of| !of.has_prior) {
        let vector = DVector::from_column_slice(&direction.vector);
        scaled += &vector * vector.transpose();
    }
    let size = scaled.nrows();
    let inverse = Cholesky::new(scaled)
        .map_or_else(|| DMatrix::from_element(size, size, f64::INFINITY), |of| of.inverse());
    DMatrix::from_fn(size, size, |row, column| {
        inverse[(row, column)] * scales[row] * scales[column]
    })
}

/// Of two components: length, angle and their gradients; of none of the angle no finite one.
fn gradients(of: [f64; 2]) -> ([f64; 2], [[f64; 2]; 2]) {
    let length = of[0].hypot(of[1]);
    if length <= 0.0 {
        return ([0.0; 2], [[1.0, 0.0], [0.0, f64::INFINITY]]);
    }
    let [cosine, sine] = of.map(|x| x / length);
    ([length, sine.atan2(cosine)], [[cosine, sine], [-sine / length, cosine / length]])
}

/// `U_s`, `U_d` and angles of each wheel, from its four numbers.
fn wheels(
    scenario: &Scenario,
    components: &[Component],
    values: &[f64],
    covariance: &DMatrix<f64>,
    numbers: &[NamedEstimate],
) -> Vec<WheelEstimate> {
    let mut wheels = Vec::new();
    for (index, name) in scenario.names.iter().enumerate() {
        let place = |target| components.iter().position(|of| of.target == target);
        let places = [
            place(Target::Static(index, 0)),
            place(Target::Static(index, 1)),
            place(Target::Dynamic(index, 0)),
            place(Target::Dynamic(index, 1)),
        ];
        let [Some(y), Some(z), Some(j12), Some(j13)] = places else { continue };
        let places = [y, z, j12, j13];
        let at = |place: usize| values.get(place).copied().unwrap_or_default();
        let own = DMatrix::from_fn(4, 4, |row, column| covariance[(places[row], places[column])]);
        let ([u_s, angle], [by_u_s, by_angle]) = gradients([at(y), at(z)]);
        // The torque is along `J_13 w_y - J_12 w_z`.
        let ([u_d, torque], [by_u_d, by_torque]) = gradients([at(j13), -at(j12)]);
        let deviation = |gradient: [f64; 4]| {
            let gradient = DVector::from_column_slice(&gradient);
            let squared = gradient.dot(&(&own * &gradient));
            if squared.is_nan() { f64::INFINITY } else { squared.max(0.0).sqrt() }
        };
        let of_static = |[y, z]: [f64; 2]| deviation([y, z, 0.0, 0.0]);
        let of_dynamic = |[y, z]: [f64; 2]| deviation([0.0, 0.0, -z, y]);
        let phase = deviation([-by_angle[0], -by_angle[1], -by_torque[1], by_torque[0]]);
        let found_static = polar([u_s, angle], [of_static(by_u_s), of_static(by_angle)]);
        let found_dynamic = polar([u_d, torque], [of_dynamic(by_u_d), of_dynamic(by_torque)]);
        let hidden = [found_static.hidden, found_dynamic.hidden];
        let joint = wheel_joint(scenario, index).unwrap_or_default();
        let coordinate = scenario
            .joints()
            .nth(joint)
            .map(|(_, device, info)| format!("{device}.{}", info.coordinate));
        let nominal = precess_dynamics::JointStates::states(&scenario.initial.devices)
            .nth(joint)
            .map_or(0.0, |of| of[0]);
        let told = places.iter().all(|place| numbers.get(*place).is_some_and(|of| of.told));
        wheels.push(WheelEstimate {
            device: name.clone(),
            index,
            coordinate: coordinate.unwrap_or_default(),
            u_s: found_static.length,
            u_d: found_dynamic.length,
            phase: about(wrapped(torque - angle), phase, hidden[0] || hidden[1]),
            angle: about(wrapped(nominal + angle), of_static(by_angle), hidden[0]),
            hidden,
            told,
        });
    }
    wheels
}

/// Within half a turn.
pub(super) fn wrapped(angle: f64) -> f64 {
    let (sine, cosine) = angle.sin_cos();
    sine.atan2(cosine)
}

fn correlations(components: &[Component], covariance: &DMatrix<f64>) -> Vec<Correlation> {
    let mut all = Vec::new();
    for (row, a) in components.iter().enumerate() {
        for (column, b) in components.iter().enumerate().take(row) {
            let product = covariance[(row, row)] * covariance[(column, column)];
            let correlation = covariance[(row, column)] / product.sqrt();
            if correlation.abs() >= CORRELATED {
                all.push(Correlation { names: [b.name.clone(), a.name.clone()], correlation });
            }
        }
    }
    all.sort_by(|a, b| b.correlation.abs().total_cmp(&a.correlation.abs()));
    all
}
