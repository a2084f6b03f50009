//! Axes and units of the readings against the model, before anything is estimated: a wrong one would end as wrong numbers.
//!
//! - **Gyro.** The scenario's own spacecraft under the measured torques, from the first readings on, explains a share of the variance of
//!   the readings. Where it is below a half as they are, and above four fifths for other axes, signs or a usual unit, these are named.
//! - **Tachometers.** A first reading that is the scenario's rate in rpm or revolutions a second.
//! - **Motors.** The rate of a wheel against the integral of its torque by its moment of inertia, and against those of other
//!   wheels, whose columns may be exchanged.
//! - **Wheels.** Where all columns of two wheels are exchanged, each torque still agrees with its rate; the motion does not. Of the variance
//!   that the motion leaves, more than three quarters are explained with the two exchanged.

use nalgebra::Vector3;
use precess_craft::Set;
use precess_dynamics::{Each as _, Inputs, JointStates as _, State};

use super::component::{tip_of, wheel_joint};
use super::error::IdentifyError;
use super::model::Model;
use super::timeline::{Event, Timeline};
use crate::scenario::Scenario;
use crate::telemetry::{Sensor, Series, Telemetry};

/// What of the record is compared, s; readings are averaged over blocks of this length.
const SPAN: f64 = 10.0;
const BLOCK: f64 = 0.25;
/// Shares of the variance: below the first the axes are in doubt, above the second others are right.
const DOUBTFUL: f64 = 0.5;
const RIGHT: f64 = 0.8;
/// Above this share nothing is in doubt; below it two wheels are exchanged where that leaves this share of what is left.
const SURE: f64 = 0.9;
const LEFT: f64 = 0.25;
/// A ratio this near to that of two units is one.
const NEAR: f64 = 0.1;
/// Units in which a gyro may read.
const RATES: [(f64, &str); 3] = [
    (1.0, "rad/s"),
    (std::f64::consts::PI / 180.0, "deg/s"),
    (std::f64::consts::PI / 180e3, "mdeg/s"),
];
const SPINS: [(f64, &str); 2] =
    [(30.0 / std::f64::consts::PI, "rpm"), (0.5 / std::f64::consts::PI, "Hz")];
const LETTERS: [char; 3] = ['x', 'y', 'z'];
const ORDERS: [[usize; 3]; 6] = [[0, 1, 2], [0, 2, 1], [1, 0, 2], [1, 2, 0], [2, 0, 1], [2, 1, 0]];

/// Compares readings with the model. `of` has the state at the start as the sensors have it, `stated` that of the file.
///
/// # Errors
/// [`IdentifyError::Axes`], [`IdentifyError::Unit`].
pub(super) fn check(
    stated: &Scenario,
    of: &Scenario,
    telemetry: &Telemetry,
    timeline: &Timeline,
) -> Result<(), IdentifyError> {
    tachometers(stated, telemetry)?;
    motors(stated, telemetry)?;
    exchanged(stated, telemetry)?;
    gyro(of, telemetry, timeline)
}

fn tachometers(scenario: &Scenario, telemetry: &Telemetry) -> Result<(), IdentifyError> {
    let rates: Vec<f64> = scenario.initial.devices.states().map(|[_, rate]| rate).collect();
    for series in &telemetry.series {
        let Sensor::Tachometer(joint) = series.sensor else { continue };
        let (Some(rate), Some(value)) = (rates.get(joint), series.values.first()) else { continue };
        let ratio = value[0] / rate;
        let near = |of: f64| (ratio / of - 1.0).abs() < NEAR;
        if let Some((_, unit)) = SPINS.into_iter().find(|(of, _)| near(*of)) {
            let sensor = series.name.clone();
            return Err(IdentifyError::Unit { sensor, unit, key: "telemetry.rate_unit", ratio });
        }
    }
    Ok(())
}

fn motors(scenario: &Scenario, telemetry: &Telemetry) -> Result<(), IdentifyError> {
    let kinds = scenario.devices_on_hub().unwrap_or_default();
    for series in &telemetry.series {
        let Sensor::Motor(joint) = series.sensor else { continue };
        let Some(rates) = telemetry.of(Sensor::Tachometer(joint)) else { continue };
        let device = scenario.joints().nth(joint).map_or(0, |(device, ..)| device);
        // Of a gimbal the inertia depends on what it carries.
        if wheel_joint(scenario, device) != Some(joint) {
            continue;
        }
        let Some(own) = kinds.get(device) else { continue };
        let parameters = own.parameters();
        let tip = tip_of(own).and_then(|tip| parameters.bodies.get(tip));
        let inertia = tip.map_or(0.0, |body| body.inertia.m11);
        let (slope, explained) = by_integral(series, rates, inertia);
        if explained > RIGHT && (slope * 1e3 - 1.0).abs() < 2.0 * NEAR {
            let sensor = series.name.clone();
            let (unit, key) = ("mN m", "telemetry.torque_unit");
            return Err(IdentifyError::Unit { sensor, unit, key, ratio: 1e3 });
        }
    }
    Ok(())
}

/// Rates of wheels that are explained by the torques of others, and not by their own.
fn exchanged(scenario: &Scenario, telemetry: &Telemetry) -> Result<(), IdentifyError> {
    let all: Vec<(&Series, &Series)> = telemetry
        .series
        .iter()
        .filter_map(|motor| {
            let Sensor::Motor(joint) = motor.sensor else { return None };
            Some((motor, telemetry.of(Sensor::Tachometer(joint))?))
        })
        .collect();
    let column = |of: &Series| of.name.rsplit(' ').next().unwrap_or_default().to_owned();
    let mut what: Vec<String> = Vec::new();
    let mut shares = [0.0_f64, 1.0];
    for (torque, own) in &all {
        let (_, share) = by_integral(torque, own, 1.0);
        // A torque that does not act explains nothing.
        if share >= DOUBTFUL || scenario.joints().count() < 2 {
            continue;
        }
        let others = all.iter().filter(|(of, _)| of.sensor != torque.sensor);
        let best = others
            .map(|(_, rates)| (by_integral(torque, rates, 1.0).1, rates))
            .max_by(|a, b| a.0.total_cmp(&b.0));
        if let Some((so, rates)) = best.filter(|(so, _)| *so > RIGHT) {
            what.push(format!("{} is the column {}", column(own), column(rates)));
            shares = [shares[0].max(share), shares[1].min(so)];
        }
    }
    // One alone is a wheel whose torque is by chance that of another.
    if what.len() < 2 {
        return Ok(());
    }
    let of = "rates of wheels by the integrals of their torques";
    Err(IdentifyError::Wheels { what: what.join(" and "), of, explained: shares })
}

/// Slope and explained share of the changes of a rate by the integral of a torque over a moment of inertia.
fn by_integral(torque: &Series, rates: &Series, inertia: f64) -> (f64, f64) {
    let Some(first) = rates.values.first() else { return (1.0, 0.0) };
    let (mut next, mut integral, mut held, mut last) = (0, 0.0, 0.0, f64::NAN);
    let [mut xx, mut xy, mut yy] = [0.0; 3];
    let mut zero = None;
    for (time, value) in rates.times.iter().zip(&rates.values) {
        while let Some(change) = torque.times.get(next).filter(|change| *change <= time) {
            if last.is_finite() {
                integral += held * (change - last);
            }
            last = *change;
            held = torque.values.get(next).map_or(0.0, |value| value[0]);
            next += 1;
        }
        if last.is_finite() {
            integral += held * (time - last);
            last = *time;
        }
        let [zero_x, zero_y] = *zero.get_or_insert([integral, first[0]]);
        let (x, y) = ((integral - zero_x) / inertia, value[0] - zero_y);
        (xx, xy, yy) = (xx + x * x, xy + x * y, yy + y * y);
    }
    if xx > 0.0 && yy > 0.0 { (xy / xx, xy * xy / (xx * yy)) } else { (1.0, 0.0) }
}

fn gyro(
    scenario: &Scenario,
    telemetry: &Telemetry,
    timeline: &Timeline,
) -> Result<(), IdentifyError> {
    let model = Model::new(scenario, &[], &[])?;
    let readings = blocks(timeline);
    let (Some(first), true) = (readings.first(), readings.len() > 8) else { return Ok(()) };
    let same = [0; 2];
    let share = |turn: &dyn Fn(&Vector3<f64>) -> Vector3<f64>, pair: [usize; 2]| {
        let start = turn(&first.1);
        let turned: Vec<_> = readings.iter().map(|(time, of)| (*time, turn(of))).collect();
        explained(&model, timeline, (start, pair), &turned)
    };
    let as_it_is = share(&|of| *of, same);
    if as_it_is >= SURE {
        return Ok(());
    }
    let mut wheels = (as_it_is, same);
    for pair in pairs(telemetry) {
        let found = share(&|of| *of, pair);
        if found > wheels.0 {
            wheels = (found, pair);
        }
    }
    let axes = if as_it_is < DOUBTFUL { axes(as_it_is, &|turn| share(turn, same)) } else { None };
    let least = axes.as_ref().map_or(as_it_is, |(found, _)| *found).max(RIGHT);
    if wheels.0 > least && 1.0 - wheels.0 < LEFT * (1.0 - as_it_is) {
        let name = |joint: usize| scenario.joints().nth(joint).map_or("", |(_, name, _)| name);
        let [a, b] = wheels.1.map(name);
        let what = format!("{a} has the columns of {b} and {b} has the columns of {a}");
        let explained = [as_it_is, wheels.0];
        return Err(IdentifyError::Wheels { what, of: "the gyro", explained });
    }
    match axes.filter(|(found, _)| *found > RIGHT) {
        Some((found, what)) => Err(IdentifyError::Axes { what, explained: [as_it_is, found] }),
        None => Ok(()),
    }
}

/// Joints of wheels with torques and rates, two by two.
fn pairs(telemetry: &Telemetry) -> Vec<[usize; 2]> {
    let joint = |of: &Series| match of.sensor {
        Sensor::Motor(joint) if telemetry.of(Sensor::Tachometer(joint)).is_some() => Some(joint),
        _ => None,
    };
    let joints: Vec<usize> = telemetry.series.iter().filter_map(joint).collect();
    let later = |place: usize| joints.get(place + 1..).unwrap_or_default().iter();
    let all = joints.iter().enumerate();
    all.flat_map(|(place, a)| later(place).map(move |b| [*a, *b])).collect()
}

/// A gyro's reading in other axes and another unit.
type Turn<'a> = dyn Fn(&Vector3<f64>) -> Vector3<f64> + 'a;

/// The axes, signs and unit of the gyro that explain the most, with their share; none where these are as they are.
fn axes(as_it_is: f64, share: &dyn Fn(&Turn<'_>) -> f64) -> Option<(f64, String)> {
    let mut best = (as_it_is, String::new());
    for (size, unit) in RATES {
        for order in ORDERS {
            for signs in 0..8_u8 {
                let sign = |axis: usize| if signs >> axis & 1 == 1 { -size } else { size };
                let turn =
                    |of: &Vector3<f64>| Vector3::from_fn(|axis, _| sign(axis) * of[order[axis]]);
                let found = share(&turn);
                if found > best.0 {
                    let mut what: Vec<String> = Vec::new();
                    for axis in 0..3 {
                        let minus = if sign(axis) < 0.0 { "-" } else { "" };
                        if order[axis] != axis || sign(axis) < 0.0 {
                            let (to, from) = (LETTERS[axis], LETTERS[order[axis]]);
                            what.push(format!("{to} is the column {minus}{from}"));
                        }
                    }
                    if size != 1.0 {
                        what.push(format!("its unit is {unit}"));
                    }
                    best = (found, what.join(" and "));
                }
            }
        }
    }
    Some(best).filter(|(_, what)| !what.is_empty())
}

/// Means of the gyro's readings over blocks, with the times of their middles.
fn blocks(timeline: &Timeline) -> Vec<(f64, Vector3<f64>)> {
    let mut blocks: Vec<(f64, Vector3<f64>)> = Vec::new();
    let (mut sum, mut times, mut count, mut begins) = (Vector3::zeros(), 0.0, 0.0, timeline.start);
    for (time, event) in &timeline.events {
        let Event::Gyro(reading) = event else { continue };
        if *time > timeline.start + SPAN {
            break;
        }
        if *time > begins + BLOCK && count > 0.0 {
            blocks.push((times / count, sum / count));
            (sum, times, count) = (Vector3::zeros(), 0.0, 0.0);
            begins = *time;
        }
        sum += Vector3::from(*reading);
        times += time;
        count += 1.0;
    }
    blocks
}

/// Share of the variance of readings that the motion from an angular velocity on explains, with the columns of a pair of joints
/// exchanged.
fn explained(
    model: &Model,
    timeline: &Timeline,
    (start, [a, b]): (Vector3<f64>, [usize; 2]),
    readings: &[(f64, Vector3<f64>)],
) -> f64 {
    let mean = readings.iter().map(|(_, of)| of).sum::<Vector3<f64>>();
    #[expect(clippy::cast_precision_loss, reason = "numbers of blocks")]
    let mean = mean / readings.len() as f64;
    let (mut state, mut inputs) = (model.state.clone(), model.inputs.clone());
    state.omega = start;
    let rates: Vec<f64> = state.devices.states().map(|[_, rate]| rate).collect();
    let other = |joint: usize| match joint {
        joint if joint == a => b,
        joint if joint == b => a,
        joint => joint,
    };
    for (joint, [_, rate]) in state.devices.states_mut().enumerate() {
        *rate = rates.get(other(joint)).copied().unwrap_or(*rate);
    }
    let [mut squares, mut variance] = [0.0; 2];
    let mut events = timeline.events.iter().peekable();
    let mut now = timeline.start;
    for (time, reading) in readings {
        while let Some((at, event)) = events.next_if(|(at, _)| at <= time) {
            let Event::Motor(joint, torque) = event else { continue };
            let moved = advance(model, state, &inputs, (at - now, timeline.step));
            let Some(moved) = moved else { return f64::NEG_INFINITY };
            (state, now) = (moved, *at);
            if let Some(motor) = inputs.motors.values_mut().nth(other(*joint)) {
                *motor = *torque;
            }
        }
        let Some(moved) = advance(model, state, &inputs, (time - now, timeline.step)) else {
            return f64::NEG_INFINITY;
        };
        (state, now) = (moved, *time);
        squares += (reading - state.omega).norm_squared();
        variance += (reading - mean).norm_squared();
    }
    if variance > 0.0 { 1.0 - squares / variance } else { 1.0 }
}

/// A state some time later; none where the motion is not finite.
fn advance(
    model: &Model,
    mut state: State<Set>,
    inputs: &Inputs<Set>,
    (span, longest): (f64, f64),
) -> Option<State<Set>> {
    if span <= 0.0 {
        return Some(state);
    }
    let parts = (span / longest).ceil().max(1.0);
    let mut part = 0.0;
    while part < parts {
        state = model.craft.step(&state, inputs, span / parts).ok()?;
        part += 1.0;
    }
    state.omega.iter().all(|rate| rate.is_finite() && rate.abs() < 1e3).then_some(state)
}
