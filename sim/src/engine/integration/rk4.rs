//! RK4 with fixed steps: that of the flight library, with inputs held from the start of each step.
//!
//! Bit-identical to a loop over `Spacecraft::step`: nothing is reduced, normalised or packed in
//! between. Steps are counted from the start of a segment; the last one is shortened where the
//! segment's length is no multiple.

use precess_control::Checkpoint;
use precess_dynamics::kind::Each;
use precess_dynamics::{JointStates, Mode, SolveError};

use super::Moment;
use super::dop853::same;
use crate::engine::equations::run_quantities::RunQuantities;
use crate::engine::equations::system::{System, work_of};
use crate::record::RunError;
use precess_craft::CraftState;

/// An integration in progress, from the start of a segment to its end.
pub(crate) struct Rk4 {
    step: f64,
    start: f64,
    end: f64,
    /// Steps since the start of the segment.
    count: u64,
    before: (f64, Moment),
    now: (f64, Moment),
    pub(crate) accepted: u64,
}

impl Rk4 {
    pub(crate) fn new(step: f64, moment: Moment) -> Self {
        let now = (0.0, moment);
        Self { step, start: 0.0, end: 0.0, count: 0, before: now.clone(), now, accepted: 0 }
    }

    /// Visits what changes from step to step.
    pub(crate) fn visit(&mut self, checkpoint: &mut Checkpoint<'_>) {
        checkpoint.numbers([&mut self.start, &mut self.end]);
        checkpoint.count(&mut self.count);
        checkpoint.count(&mut self.accepted);
        for (time, moment) in [&mut self.before, &mut self.now] {
            checkpoint.number(time);
            moment.visit(checkpoint);
        }
    }

    /// Begins a segment.
    pub(crate) fn begin(&mut self, [start, end]: [f64; 2], moment: Moment) {
        (self.start, self.end, self.count) = (start, end, 0);
        self.now = (start, moment);
        self.before = self.now.clone();
    }

    /// The end of the step that is so many ahead, and its length.
    fn ahead(&self, steps: u64) -> [f64; 2] {
        #[expect(clippy::cast_precision_loss, reason = "fewer steps than 2^53")]
        let next = self.start + (self.count + steps) as f64 * self.step;
        if same(next, self.end) {
            [self.end, self.step]
        } else if next > self.end {
            [self.end, self.end - self.now.0]
        } else {
            [next, self.step]
        }
    }

    /// One step.
    pub(crate) fn step(&mut self, system: &System<'_>) -> Result<(), RunError> {
        let [next, length] = self.ahead(1);
        let (time, moment) = &self.now;
        let stepped = stepped(system, *time, moment, length);
        let stepped = stepped.map_err(|source| RunError::solve(system, *time, source))?;
        self.before = std::mem::replace(&mut self.now, (next, stepped));
        self.count += 1;
        self.accepted += 1;
        Ok(())
    }

    /// The length of the next step, and how many of that length reach no further than a time, at
    /// least one: the last of a segment by itself.
    #[cfg(feature = "lanes")]
    pub(crate) fn coming(&self, until: f64, most: usize) -> (f64, usize) {
        let [_, length] = self.ahead(1);
        let within = |steps: &u64| {
            let [next, _] = self.ahead(*steps);
            next < self.end && (next <= until || same(next, until))
        };
        (length, (1..=most as u64).take_while(within).count().max(1))
    }

    /// Takes over the state after so many steps of [`Self::coming`] that were made elsewhere. Of several
    /// there is nothing in between: [`Self::at`] is for times within the last step only.
    #[cfg(feature = "lanes")]
    pub(crate) fn take(&mut self, system: &System<'_>, state: CraftState, steps: usize) {
        let steps = steps as u64;
        system.count(4 * steps);
        let [next, _] = self.ahead(steps);
        let reached = (next, Moment { state, integrals: [f64::NAN; 2] });
        self.before = std::mem::replace(&mut self.now, reached);
        self.count += steps;
        self.accepted += steps;
    }

    pub(crate) fn time(&self) -> f64 {
        self.now.0
    }

    pub(crate) fn time_before(&self) -> f64 {
        self.before.0
    }

    pub(crate) fn now(&self) -> &Moment {
        &self.now.1
    }

    /// The state within the last step, by a shorter step from the start of it.
    pub(crate) fn at(&self, system: &System<'_>, time: f64) -> Result<Moment, RunError> {
        let (from, moment) = &self.before;
        if time >= self.now.0 || same(time, self.now.0) {
            return Ok(self.now.1.clone());
        }
        if time <= *from || same(time, *from) {
            return Ok(moment.clone());
        }
        stepped(system, *from, moment, time - from)
            .map_err(|source| RunError::solve(system, *from, source))
    }
}

/// The moment after a step.
fn stepped(
    system: &System<'_>,
    time: f64,
    moment: &Moment,
    length: f64,
) -> Result<Moment, SolveError> {
    system.count(4);
    let Moment { state, integrals: [work, throughput] } = moment;
    if system.acting.friction.vary() {
        return stepped_with_friction(system, time, moment, length);
    }
    let inputs = system.inputs(time, state);
    if system.quantities == RunQuantities::Motion {
        let next = system.craft.step(state, &inputs, length)?;
        return Ok(Moment { state: next, integrals: [f64::NAN; 2] });
    }
    let rates_times_torques = |next: &CraftState| {
        let coordinates = |of: &CraftState| -> Vec<f64> {
            of.devices.states().map(|[coordinate, _]| coordinate).collect()
        };
        let moved = coordinates(next).into_iter().zip(coordinates(state));
        let torques = inputs.motors.values().zip(inputs.modes.values()).zip(moved);
        torques.fold([0.0, 0.0], |[sum, magnitudes], ((torque, mode), (to, from))| {
            // Held over the step, so the step's own quadrature of the rate is the coordinate.
            let work = if mode == Mode::Driven { torque * (to - from) } else { 0.0 };
            [sum + work, magnitudes + work.abs()]
        })
    };
    if !system.needs_ledger() && !system.acting.has_wrenches() {
        let next = system.craft.step(state, &inputs, length)?;
        let [by, magnitudes] = rates_times_torques(&next);
        return Ok(Moment { state: next, integrals: [work + by, throughput + magnitudes] });
    }
    let (next, power) = system.craft.step_with_work(state, &inputs, length)?;
    let [driven, magnitudes] = rates_times_torques(&next);
    let others = (power.motors - driven).abs() + power.friction.abs() + power.hub.abs();
    let integrals = [work + work_of(&power), throughput + magnitudes + others];
    Ok(Moment { state: next, integrals })
}

/// The same with friction that follows the rates of joints within the step; other inputs are held.
fn stepped_with_friction(
    system: &System<'_>,
    time: f64,
    moment: &Moment,
    length: f64,
) -> Result<Moment, SolveError> {
    let held = system.inputs_without_friction(time, &moment.state);
    // Rejects a step that is too long for springs and dampers.
    system.craft.step(&moment.state, &held, length)?;
    let start = system.layout.pack(&moment.state, moment.integrals);
    let ahead = |rates: &[f64], by: f64| -> Vec<f64> {
        start.iter().zip(rates).map(|(y, rate)| y + by * rate).collect()
    };
    let mut sum = vec![0.0; start.len()];
    let mut rates = vec![0.0; start.len()];
    let mut y = start.clone();
    for (weight, next) in [(1.0, 0.5), (2.0, 0.5), (2.0, 1.0), (1.0, 0.0)] {
        system.held_rates(&held, &y, &mut rates)?;
        sum.iter_mut().zip(&rates).for_each(|(sum, rate)| *sum += weight * rate);
        y = ahead(&rates, next * length);
    }
    let reached = ahead(&sum, length / 6.0);
    let mut next = moment.clone();
    system.layout.unpack(&reached, &mut next.state);
    next.integrals = system.layout.integrals(&reached);
    Ok(next)
}
