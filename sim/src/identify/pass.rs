//! [`Pass`]: the motion along a record once, with its derivatives: the sum of squares of the weighted residuals, the normal equations,
//! and what each sensor leaves.
//!
//! A residual is divided by its standard deviation. The bias of the gyro walks: of each axis the innovations of the filter with this one
//! state are independent, and so are those of the derivatives, by the same gains (Maybeck, *Stochastic Models, Estimation and Control*,
//! 5.10). Beyond three standard deviations a residual counts by its size and not by its square (Huber, Ann. Math. Statist. 35(1),
//! 1964): of normal noise that is one in 370, and intervals are wider by 0.1 %.

use nalgebra::{DMatrix, DVector, Matrix3, Matrix3xX, Vector3};
use precess_control::rotation;
use precess_craft::Set;
use precess_dynamics::{Each as _, Inputs, JointStates as _, Quaternion, State, Variable};

use super::error::IdentifyError;
use super::model::Model;
use super::noise::SensorNoise;
use super::timeline::{Event, Timeline};

/// A rate beyond this, rad/s, is of a motion that has left all bounds.
const RATE_MAX: f64 = 1e6;
/// Kinds of sensors.
pub(super) const KINDS: usize = 4;

/// What is left of a kind of sensor.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Left {
    pub(super) count: u64,
    /// Weighted squares of residuals within the bound and beyond, each by its variance, cut at that.
    pub(super) squares: f64,
    pub(super) outliers: u64,
}

/// The sums of a pass.
pub(super) struct Pass {
    /// Half of the sum of squares, of outliers Huber's.
    pub(super) cost: f64,
    /// Its second derivatives, first order; upper triangle.
    pub(super) normal: DMatrix<f64>,
    /// The descent: weighted residuals by derivatives.
    pub(super) descent: DVector<f64>,
    /// Gyro, star tracker, tachometers, encoders.
    pub(super) left: [Left; KINDS],
}

/// The filter of the bias of one axis.
struct Walk {
    variance: f64,
    mean: f64,
    slopes: Vec<f64>,
}

struct Running<'a> {
    model: &'a Model,
    noise: &'a SensorNoise,
    inputs: Inputs<Set>,
    state: State<Set>,
    changes: DMatrix<f64>,
    time: f64,
    /// Where the gyro's period began: attitude and its changes.
    began: Option<(Quaternion, Matrix3xX<f64>)>,
    walks: [Walk; 3],
    /// When the gyro was last read.
    read: Option<f64>,
    /// Rows of the state's changes.
    rows: Rows,
    bias: [Option<usize>; 3],
    row: Vec<f64>,
    pass: Pass,
}

struct Rows {
    attitude: Option<usize>,
    omega: Option<usize>,
    coordinates: Vec<Option<usize>>,
    rates: Vec<Option<usize>>,
}

impl Pass {
    /// Along a record until a time, s, with these many unknown numbers; `bias` has the places of the gyro's.
    pub(super) fn run(
        model: &Model,
        timeline: &Timeline,
        noise: &SensorNoise,
        (count, bias): (usize, [Option<usize>; 3]),
        until: f64,
        progress: &mut dyn FnMut(f64) -> bool,
    ) -> Result<Self, IdentifyError> {
        let joints = model.state.devices.states().count();
        let place = |variable| model.states.iter().position(|state| *state == variable);
        let x = precess_dynamics::Axis::X;
        let rows = Rows {
            attitude: place(Variable::Attitude(x)),
            omega: place(Variable::Omega(x)),
            coordinates: (0..joints).map(|joint| place(Variable::Coordinate(joint))).collect(),
            rates: (0..joints).map(|joint| place(Variable::Rate(joint))).collect(),
        };
        let walk = || Walk { variance: 0.0, mean: 0.0, slopes: vec![0.0; count] };
        let mut running = Running {
            model,
            noise,
            inputs: model.inputs.clone(),
            state: model.state.clone(),
            changes: model.changes.clone(),
            time: timeline.start,
            began: None,
            walks: [walk(), walk(), walk()],
            read: None,
            rows,
            bias,
            row: vec![0.0; count],
            pass: Self {
                cost: 0.0,
                normal: DMatrix::zeros(count, count),
                descent: DVector::zeros(count),
                left: [Left::default(); KINDS],
            },
        };
        for (number, (time, event)) in timeline.events.iter().enumerate() {
            if *time > until {
                break;
            }
            if number % 512 == 0 && !progress(*time) {
                return Err(IdentifyError::Interrupted);
            }
            running.advance(*time, timeline.step)?;
            running.event(*time, event);
        }
        let mut pass = running.pass;
        pass.normal.fill_lower_triangle_with_upper_triangle();
        Ok(pass)
    }
}

impl Running<'_> {
    fn advance(&mut self, time: f64, longest: f64) -> Result<(), IdentifyError> {
        let span = time - self.time;
        if span <= 0.0 {
            return Ok(());
        }
        let parts = (span / longest).ceil().max(1.0);
        let length = span / parts;
        let of = (&self.model.hub, &self.model.devices);
        let mut part = 0.0;
        while part < parts {
            let at = (&self.state, &self.inputs);
            let found = precess_craft::step_along(
                &self.model.craft,
                of,
                at,
                length,
                &self.changes,
                &self.model.directions,
            )?;
            let Some((state, changes)) = found else {
                let what = "a lumped imbalance or another device without exact derivatives";
                return Err(IdentifyError::Unsupported { what });
            };
            (self.state, self.changes) = (state, changes);
            part += 1.0;
        }
        let rates = self.state.devices.states().map(|[_, rate]| rate.abs());
        let fastest = rates.fold(self.state.omega.amax(), f64::max);
        if !fastest.is_finite() || fastest > RATE_MAX {
            return Err(IdentifyError::Diverged { time });
        }
        self.time = time;
        Ok(())
    }

    fn event(&mut self, time: f64, event: &Event) {
        match event {
            Event::GyroBegins => {
                let attitude = self.attitude_changes(&self.changes);
                self.began = Some((self.state.attitude, attitude));
            }
            Event::Gyro(reading) => self.gyro(time, reading),
            Event::StarTracker(reading) => self.star_tracker(reading),
            Event::Tachometer(joint, reading) => {
                let rate = self.state.devices.states().nth(*joint).map_or(0.0, |of| of[1]);
                let row = self.rows.rates.get(*joint).copied().flatten();
                self.scalar(reading - rate, self.noise.tachometer, row, 2);
            }
            Event::Encoder(joint, reading) => {
                let coordinate = self.state.devices.states().nth(*joint).map_or(0.0, |of| of[0]);
                let row = self.rows.coordinates.get(*joint).copied().flatten();
                self.scalar(reading - coordinate, self.noise.encoder, row, 3);
            }
            Event::Motor(joint, torque) => {
                if let Some(motor) = self.inputs.motors.values_mut().nth(*joint) {
                    *motor = *torque;
                }
            }
        }
    }

    /// Three rows of the changes from one on; zeros where the hub has no such state.
    fn three(changes: &DMatrix<f64>, first: Option<usize>) -> Matrix3xX<f64> {
        first.map_or_else(
            || Matrix3xX::zeros(changes.ncols()),
            |first| changes.fixed_rows::<3>(first).into_owned(),
        )
    }

    fn attitude_changes(&self, changes: &DMatrix<f64>) -> Matrix3xX<f64> {
        Self::three(changes, self.rows.attitude)
    }

    fn gyro(&mut self, time: f64, reading: &[f64; 3]) {
        let (predicted, slopes) = if let Some(period) = self.noise.mean_over {
            let Some((before, changes)) = self.began.take() else { return };
            let turn = rotation::product(&rotation::inverse(&before), &self.state.attitude);
            let vector = rotation::to_vector(&turn);
            // exp(-d0) q exp(d1) = q exp(d1 - R^T d0), and the inverse of the right Jacobian.
            let own = self.attitude_changes(&self.changes) - transposed(&vector) * changes;
            (vector / period, inverse_jacobian(&vector) * own / period)
        } else {
            (self.state.omega, Self::three(&self.changes, self.rows.omega))
        };
        let passed = self.read.replace(time).map_or(0.0, |read| time - read);
        let white = self.noise.gyro * self.noise.gyro;
        let walk = self.noise.walk * self.noise.walk * passed;
        for axis in 0..3 {
            let mut residual = reading[axis] - predicted[axis] - self.model.bias[axis];
            self.row.fill(0.0);
            for (to, from) in self.model.moved.iter().zip(slopes.row(axis).iter()) {
                self.row[*to] = *from;
            }
            if let Some(place) = self.bias[axis] {
                self.row[place] = 1.0;
            }
            let filter = &mut self.walks[axis];
            filter.variance += walk;
            let mut total = white;
            if filter.variance > 0.0 {
                residual -= filter.mean;
                for (to, from) in self.row.iter_mut().zip(&filter.slopes) {
                    *to -= from;
                }
                total += filter.variance;
                // An outlier moves the bias no farther than the bound does.
                let size = residual.abs() / total.sqrt();
                let bound = self.noise.bound;
                let weight = if size > bound { bound / size } else { 1.0 };
                let gain = weight * filter.variance / total;
                filter.mean += gain * residual;
                for (to, innovation) in filter.slopes.iter_mut().zip(&self.row) {
                    *to += gain * innovation;
                }
                filter.variance *= 1.0 - gain;
            }
            self.add(residual, total.sqrt(), 0);
        }
    }

    fn star_tracker(&mut self, reading: &[f64; 4]) {
        let [q0, q1, q2, q3] = *reading;
        let measured = Quaternion { q0, q1, q2, q3 };
        let turn = rotation::product(&rotation::inverse(&self.state.attitude), &measured);
        let to_s = self.noise.star_mount.transpose();
        // The error turns by less than the attitude's change by its square.
        let error = to_s * rotation::to_vector(&turn);
        let slopes = to_s * self.attitude_changes(&self.changes);
        for axis in 0..3 {
            self.row.fill(0.0);
            for (to, from) in self.model.moved.iter().zip(slopes.row(axis).iter()) {
                self.row[*to] = *from;
            }
            self.add(error[axis], self.noise.star[axis], 1);
        }
    }

    fn scalar(&mut self, residual: f64, deviation: f64, row: Option<usize>, kind: usize) {
        self.row.fill(0.0);
        if let Some(row) = row {
            for (to, from) in self.model.moved.iter().zip(self.changes.row(row).iter()) {
                self.row[*to] = *from;
            }
        }
        self.add(residual, deviation, kind);
    }

    /// A residual whose derivatives are in `row`.
    fn add(&mut self, residual: f64, deviation: f64, kind: usize) {
        let r = residual / deviation;
        let size = r.abs();
        let bound = self.noise.bound;
        let outlies = size > bound;
        let weight = if outlies { bound / size } else { 1.0 };
        self.pass.cost += if outlies { bound * (size - 0.5 * bound) } else { 0.5 * r * r };
        let left = &mut self.pass.left[kind];
        left.count += 1;
        left.squares += size.min(bound) * size.min(bound);
        left.outliers += u64::from(outlies);
        let inverse = deviation.recip();
        // Few of the numbers move a reading.
        for (column, a) in self.row.iter().enumerate() {
            if *a == 0.0 {
                continue;
            }
            let scaled = weight * a * inverse;
            self.pass.descent[column] += scaled * r;
            let scaled = scaled * inverse;
            let mut into = self.pass.normal.column_mut(column);
            for (to, b) in into.iter_mut().zip(&self.row).take(column + 1) {
                *to += scaled * b;
            }
        }
    }
}

/// The transpose of the rotation by a vector: `R^T d0` is that of B before in B after.
fn transposed(vector: &Vector3<f64>) -> Matrix3<f64> {
    nalgebra::Rotation3::new(*vector).matrix().transpose()
}

/// `v(exp(v) exp(d)) = v + J d` for small d: `I + [v]/2 + [v]²/12`, to the fourth power of v.
fn inverse_jacobian(vector: &Vector3<f64>) -> Matrix3<f64> {
    let tilde = vector.cross_matrix();
    Matrix3::identity() + tilde * 0.5 + tilde * tilde / 12.0
}
