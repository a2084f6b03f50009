//! [`Row`]: the numbers of a sample. Only what the columns need is computed: no accelerations, no
//! loads, no momenta where no column shows them.

use precess_dynamics::kind::Each;
use precess_dynamics::{
    About, Accelerations, Attitude, Inputs, LoadAxes, Loads, Mode, Momentum, Mrp, SolveError,
};

use super::drift::energies;
use super::integrator::Moment;
use super::system::System;
use crate::record::columns::{Columns, Quantity};
use crate::scenario::Set;

/// The numbers of a sample, and what has to be computed for them.
#[expect(clippy::struct_excessive_bools, reason = "each is computed or not, independently")]
pub(crate) struct Row {
    quantities: Vec<Quantity>,
    numbers: Vec<f64>,
    accelerations: bool,
    torques: bool,
    loads: bool,
    energy: bool,
    momentum: bool,
    inputs: Option<Inputs<Set>>,
}

/// What is computed of a sample.
struct Computed<'a> {
    moment: &'a Moment,
    turns: &'a [f64],
    time: f64,
    lost: f64,
    energy: f64,
    mrp: Mrp,
    momentum: Option<Momentum>,
    accelerations: Option<&'a Accelerations<Set>>,
    inputs: Option<&'a Inputs<Set>>,
    loads: Option<Loads<Set>>,
}

impl Row {
    pub(crate) fn new(columns: Columns) -> Self {
        let quantities: Vec<_> = columns.into_iter().map(|column| column.quantity).collect();
        let any = |of: fn(&Quantity) -> bool| quantities.iter().any(of);
        let loads = any(Quantity::is_load);
        let torques = any(|q| matches!(q, Quantity::Torque(_)));
        Self {
            numbers: vec![0.0; quantities.len()],
            accelerations: any(Quantity::is_acceleration),
            torques,
            loads,
            energy: any(|q| matches!(q, Quantity::Energy)),
            momentum: any(|q| matches!(q, Quantity::Linear(_) | Quantity::Angular(_))),
            inputs: None,
            quantities,
        }
    }

    /// The numbers at a time, with inputs held from another.
    pub(crate) fn fill(
        &mut self,
        system: &System<'_>,
        [time, held_from]: [f64; 2],
        moment: &Moment,
        turns: &[f64],
        lost: f64,
    ) -> Result<&[f64], SolveError> {
        let state = &moment.state;
        let mut found = None;
        let mut loads = None;
        let mut inputs = None;
        if self.accelerations || self.torques || self.loads {
            let filled = self.inputs.get_or_insert_with(|| system.inputs(held_from, state));
            system.acting.fill(held_from, state, filled);
            let computed = |mode| mode != Mode::Driven;
            let needs_loads = self.loads || (self.torques && filled.modes.values().any(computed));
            if self.accelerations || needs_loads {
                found = Some(system.spacecraft.accelerations(state, filled)?);
                system.count(1);
            }
            if let (true, Some(found)) = (needs_loads, &found) {
                loads = Some(system.spacecraft.loads(state, filled, found, LoadAxes::Body)?);
            }
            inputs = Some(&*filled);
        }
        let evaluated = inputs.zip(found.as_ref());
        let (energy, known) = if self.energy {
            let ([kinetic, potential], momentum) = energies(system, time, state, evaluated)?;
            (kinetic + potential, momentum)
        } else {
            (f64::NAN, None)
        };
        let momentum = match known {
            None if self.momentum => {
                Some(system.spacecraft.momentum(state, About::InertialOrigin)?)
            }
            known => known,
        };
        let computed = Computed {
            moment,
            turns,
            time,
            lost,
            energy,
            mrp: Mrp::from(state.attitude),
            momentum,
            accelerations: found.as_ref(),
            inputs,
            loads,
        };
        for (number, quantity) in self.numbers.iter_mut().zip(&self.quantities) {
            *number = computed.number(system, *quantity);
        }
        Ok(&self.numbers)
    }
}

impl Computed<'_> {
    /// One number; NaN of what was not computed, which no column shows.
    fn number(&self, system: &System<'_>, quantity: Quantity) -> f64 {
        let Moment { state, integrals: [work, _] } = self.moment;
        let joint = |joint: usize| system.layout.joint(joint, state, self.turns);
        let place = |joint: usize| {
            let place = &system.layout.joints[joint];
            (place.device, place.info.index)
        };
        let q = state.attitude;
        let known = match quantity {
            Quantity::Time => Some(self.time),
            Quantity::Position(axis) => Some(state.r_b_n[axis]),
            Quantity::Velocity(axis) => Some(state.r_b_n_dot[axis]),
            Quantity::Quaternion(index) => Some([q.q0, q.q1, q.q2, q.q3][index]),
            Quantity::Sigma(axis) => Some(self.mrp.0[axis]),
            Quantity::Omega(axis) => Some(state.omega[axis]),
            Quantity::Coordinate(index) => Some(joint(index)[0]),
            Quantity::Rate(index) => Some(joint(index)[1]),
            Quantity::Energy => Some(self.energy),
            Quantity::Work => Some(*work),
            Quantity::Lost => Some(self.lost),
            Quantity::Linear(axis) => self.momentum.map(|momentum| momentum.linear[axis]),
            Quantity::Angular(axis) => self.momentum.map(|momentum| momentum.angular[axis]),
            Quantity::HubAcceleration(axis) => self
                .accelerations
                .map(|found| state.attitude.dcm().column(axis).dot(&found.r_b_n_ddot)),
            Quantity::OmegaDot(axis) => self.accelerations.map(|found| found.omega_dot[axis]),
            Quantity::JointAcceleration(joint) => self.accelerations.map(|found| {
                let (device, index) = place(joint);
                found.devices[device].as_slice()[index]
            }),
            Quantity::Torque(joint) => self.inputs.map(|inputs| {
                let (device, index) = place(joint);
                let driven = inputs.modes[device].as_slice()[index] == Mode::Driven;
                match &self.loads {
                    Some(loads) if !driven => loads.devices[device].motors.as_slice()[index],
                    _ => inputs.motors[device].as_slice()[index],
                }
            }),
            Quantity::MountForce(device, axis) => {
                self.loads.as_ref().map(|loads| loads.devices[device].mount.force[axis])
            }
            Quantity::MountMoment(device, axis) => {
                self.loads.as_ref().map(|loads| loads.devices[device].mount.moment[axis])
            }
            Quantity::LoadForce(joint, axis) => self.loads.as_ref().map(|loads| {
                let (device, index) = place(joint);
                loads.devices[device].joints.as_slice()[index].force[axis]
            }),
            Quantity::LoadMoment(joint, axis) => self.loads.as_ref().map(|loads| {
                let (device, index) = place(joint);
                loads.devices[device].joints.as_slice()[index].moment[axis]
            }),
        };
        known.unwrap_or(f64::NAN)
    }
}
