//! [`Sensing`]: what a controller reads of the truth at a sample: sensors, estimator, filter of the rate.
//!
//! ```text
//! truth -> gyro, star tracker -> estimator, or the last readings -> filter of the rate -> law
//! ```

use std::f64::consts::PI;

use nalgebra::Vector3;
use precess_control::{
    Checkpoint, Filter, GyroOutput, Mekf, MomentumDumping, Motion, Noise, rotation,
};
use precess_craft::CraftState;
use precess_dynamics::{Attitude as _, ListedModes, ModalPoint, Quaternion};

use super::clock::Clock;
use super::specific_force::{Place, specific_force};
use crate::control::ControllerError;
use crate::engine::equations::commands::MeasuredValues;
use crate::engine::equations::system::System;
use crate::scenario::{BuiltSensors, EstimatorSettings, SampledController, Scenario};

/// A node of a structure.
type Node = ModalPoint<ListedModes>;

/// The sensors of a controller in a run.
pub(super) struct Sensing {
    built: BuiltSensors,
    output: GyroOutput,
    /// Where gyro and star tracker stand; none for the hub.
    nodes: [Option<Box<Node>>; 2],
    /// Where the accelerometer stands.
    place: Option<Place>,
    period: f64,
    /// When the star tracker measures.
    measures: Option<Clock>,
    estimator: Option<(EstimatorSettings, Noise)>,
    mekf: Option<Mekf>,
    /// How many samples there were.
    samples: usize,
    /// Attitude of the gyro at the sample before.
    before: Option<Quaternion>,
    /// The last attitude that has arrived.
    arrived: Option<Quaternion>,
}

/// What was read at a sample.
pub(super) struct Measured {
    /// What the law reads.
    pub(super) motion: Motion,
    /// For the columns.
    pub(super) values: MeasuredValues,
    /// The reading of the accelerometer, m/s²; none without one.
    pub(super) specific_force: Option<Vector3<f64>>,
}

impl Sensing {
    pub(super) fn new(
        scenario: &Scenario,
        of: &SampledController,
    ) -> Result<Self, ControllerError> {
        let built = of.built_sensors().map_err(|(_, error)| ControllerError::Parameter(error))?;
        let sensors = &of.sensors;
        let node = |node: Option<usize>| {
            let structure = scenario.structure.as_ref()?;
            structure.nodes.get(node?).map(|node| Box::new(node.point()))
        };
        let noise = || Noise::new(u64::from(sensors.seed), &format!("{}.estimator", of.name));
        let place = sensors
            .accelerometer
            .map(|of| node(of.node).map_or(Place::Hub(of.position), Place::Node));
        Ok(Self {
            built,
            place,
            output: sensors.gyro.map(|gyro| gyro.output).unwrap_or_default(),
            nodes: [
                node(sensors.gyro.and_then(|of| of.node)),
                node(sensors.star_tracker.and_then(|of| of.node)),
            ],
            period: 1.0 / of.rate,
            measures: sensors
                .star_tracker
                .map(|star| Clock::new(of.offset, star.rate.unwrap_or(of.rate))),
            estimator: of.estimator.map(|settings| (settings, noise())),
            mekf: None,
            samples: 0,
            before: None,
            arrived: None,
        })
    }

    /// Lets the bias of the gyro jump, rad/s.
    pub(super) fn add_gyro_bias(&mut self, jump: &Vector3<f64>) {
        if let Some(gyro) = &mut self.built.gyro {
            gyro.add_bias(jump);
        }
    }

    /// Visits what it keeps from sample to sample.
    pub(super) fn visit(&mut self, checkpoint: &mut Checkpoint<'_>) {
        let Self { built, measures, samples, before, arrived, .. } = self;
        let BuiltSensors { gyro, star_tracker, accelerometer, arriving, filters, .. } = built;
        if let Some(gyro) = gyro {
            gyro.visit(checkpoint);
        }
        if let Some(star_tracker) = star_tracker {
            star_tracker.visit(checkpoint);
        }
        if let Some(accelerometer) = accelerometer {
            accelerometer.visit(checkpoint);
        }
        if let Some(arriving) = arriving {
            let blank = || (0, Quaternion::identity());
            arriving.visit(checkpoint, blank, |checkpoint, (sample, attitude)| {
                checkpoint.index(sample, usize::MAX);
                checkpoint.attitude(attitude);
            });
        }
        for filter in filters.as_flattened_mut() {
            filter.visit(checkpoint);
        }
        if let Some(clock) = measures {
            clock.visit(checkpoint);
        }
        checkpoint.index(samples, usize::MAX);
        for attitude in [before, arrived] {
            checkpoint.optional(attitude, Quaternion::identity, Checkpoint::attitude);
        }
        self.visit_estimator(checkpoint);
    }

    /// The estimator, which there is from the first sample on.
    fn visit_estimator(&mut self, checkpoint: &mut Checkpoint<'_>) {
        let mut is_there = self.mekf.is_some();
        checkpoint.flag(&mut is_there);
        if !is_there {
            self.mekf = None;
            return;
        }
        if let (None, Some((settings, _)), Some(parameters)) =
            (&self.mekf, &self.estimator, &self.built.estimator)
        {
            self.mekf = Mekf::new(parameters, &settings.at(Quaternion::identity())).ok();
        }
        match &mut self.mekf {
            Some(mekf) => mekf.visit(checkpoint),
            None => checkpoint.refuse(),
        }
    }

    /// The external torque at a momentum of the devices, N m, B; none without dumping.
    pub(super) fn external(&self, momentum: &Vector3<f64>) -> Option<Vector3<f64>> {
        self.built.dumping.as_ref().map(|of: &MomentumDumping| of.torque(momentum))
    }

    /// Coordinate and rate of a commanded joint as they are read.
    pub(super) fn joint(&self, [coordinate, rate]: [f64; 2]) -> [f64; 2] {
        [self.built.encoder.read(coordinate), self.built.tachometer.read(rate)]
    }

    /// The torque that is commanded, filtered.
    pub(super) fn torque(&mut self, torque: &Vector3<f64>) -> Vector3<f64> {
        let [_, filters] = &mut self.built.filters;
        filtered(filters, torque, self.samples == 1)
    }

    /// Reads the state at the next sample.
    pub(super) fn measure(
        &mut self,
        system: &System<'_>,
        time: f64,
        state: &CraftState,
    ) -> Result<Measured, ControllerError> {
        let first = self.samples == 0;
        let truth = Motion { attitude: state.attitude, omega: state.omega };
        let [gyro, star] = self.nodes.each_ref().map(|node| {
            node.as_ref().map_or(Ok(truth), |node| motion_of_node(system, node, state))
        });
        let (gyro, star) = (gyro?, star?);
        let mut values = MeasuredValues::default();
        let mut force = None;
        if let (Some(place), Some(of)) = (&self.place, &mut self.built.accelerometer) {
            let truth =
                specific_force(system, place, time, state).map_err(ControllerError::Node)?;
            let reading = of.measure(&truth);
            values.accelerometer = reading.into();
            force = Some(reading);
        }
        let reading = self.read_gyro(&gyro)?;
        if let (Some(reading), Some(of)) = (reading, &self.built.gyro) {
            (values.gyro, values.gyro_bias) = (reading.into(), of.bias().into());
        }
        if let (true, Some((settings, noise)), Some(parameters)) =
            (first, &self.estimator, &self.built.estimator)
        {
            let [x, y, z, ..] = noise.at(0);
            let error = Vector3::new(x, y, z) * settings.attitude_deviation;
            let start = rotation::product(&truth.attitude, &rotation::from_vector(&error));
            self.mekf = Some(Mekf::new(parameters, &settings.at(start))?);
        }
        if let (false, Some(mekf), Some(reading)) = (first, &mut self.mekf, &reading) {
            mekf.propagate(reading);
        }
        self.read_star_tracker(time, &star)?;
        let mut motion = Motion {
            attitude: self.arrived.unwrap_or(truth.attitude),
            omega: reading.unwrap_or(truth.omega),
        };
        if let (Some(mekf), Some(reading)) = (&self.mekf, reading) {
            let estimate = mekf.estimate();
            motion = Motion { attitude: estimate.attitude, omega: reading - estimate.bias };
            values.estimated_bias = estimate.bias.into();
            let variances = estimate.covariance.attitude.diagonal();
            values.deviation = variances.map(|variance| libm::sqrt(variance.max(0.0))).into();
        }
        self.samples += 1;
        let [filters, _] = &mut self.built.filters;
        motion.omega = filtered(filters, &motion.omega, first);
        values.omega = motion.omega.into();
        let q = motion.attitude;
        values.attitude = [q.q0, q.q1, q.q2, q.q3];
        let error = rotation::product(&rotation::inverse(&motion.attitude), &truth.attitude);
        values.error = rotation::to_vector(&error).into();
        Ok(Measured { motion, values, specific_force: force })
    }

    /// The reading of the gyro; none without one.
    fn read_gyro(&mut self, truth: &Motion) -> Result<Option<Vector3<f64>>, ControllerError> {
        let before = self.before.replace(truth.attitude);
        let Some(gyro) = &mut self.built.gyro else { return Ok(None) };
        let omega = match before {
            Some(before) if self.output == GyroOutput::Integrating => {
                if truth.omega.norm() * self.period >= PI {
                    let rate = truth.omega.norm();
                    return Err(ControllerError::HalfTurn { rate, largest: PI / self.period });
                }
                let turn = rotation::product(&rotation::inverse(&before), &truth.attitude);
                rotation::to_vector(&turn) / self.period
            }
            _ => truth.omega,
        };
        Ok(Some(gyro.measure(&omega)))
    }

    /// Measures where it is time to, and takes what has arrived.
    fn read_star_tracker(&mut self, time: f64, truth: &Motion) -> Result<(), ControllerError> {
        let (Some(star), Some(arriving), Some(clock)) =
            (&mut self.built.star_tracker, &mut self.built.arriving, &mut self.measures)
        else {
            return Ok(());
        };
        let mut measures = false;
        while clock.due(time) {
            measures = true;
        }
        if measures {
            arriving.put(time, (self.samples, star.measure(&truth.attitude)));
        }
        if let Some((_, (sample, attitude))) = arriving.newest(time) {
            if let Some(mekf) = &mut self.mekf {
                mekf.update(&attitude, self.samples - sample)?;
            }
            self.arrived = Some(attitude);
        } else if self.arrived.is_none() {
            // Until the first one has arrived: the attitude of the start is known.
            self.arrived = Some(truth.attitude);
        }
        Ok(())
    }
}

/// Each component filtered; the first one as if it had been there before.
fn filtered(filters: &mut [Filter; 3], of: &Vector3<f64>, first: bool) -> Vector3<f64> {
    let mut found = *of;
    for (value, filter) in found.iter_mut().zip(filters) {
        *value = if first { filter.settle(*value) } else { filter.filter(*value) };
    }
    found
}

/// Attitude and angular velocity of the axes of a node, expressed in them.
fn motion_of_node(
    system: &System<'_>,
    node: &Node,
    state: &CraftState,
) -> Result<Motion, ControllerError> {
    let motion = system.craft.structure().point_motion(node, state)?;
    let turn = rotation::from_vector(&motion.rotation);
    Ok(Motion {
        attitude: rotation::product(&state.attitude, &turn),
        omega: motion.axes.tr_mul(&motion.omega),
    })
}
