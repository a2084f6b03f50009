//! Three imbalanced reaction wheels with motors: a run of Basilisk, our run of the same, and how far
//! they differ.
//!
//! `tests/engines/wheels.py` writes the file, `tests/engines/lumped.py` another one. Both runs are RK4 with the same step, the attitude in
//! MRPs, from the same state, so that they differ by rounding only.

use std::error::Error;

use precess_dynamics::reaction_wheel::{Joints, PerJoint};
use precess_dynamics::{ImbalanceModel, Inputs, Mrp, Passive, ReactionWheel, Spacecraft, State};
use serde::Deserialize;

use crate::blocks::largest;
use crate::stored::{StoredHub, by_rows, symmetric};

/// Written by `tests/engines/wheels.py`.
const TEXT: &str = include_str!("../fixtures/wheels.json");

/// Written by `tests/engines/lumped.py`: their imbalance lumped, and viscous friction.
const LUMPED: &str = include_str!("../fixtures/lumped.json");

/// How many wheels the file has.
pub const WHEELS: usize = 3;

type Set = [ReactionWheel; WHEELS];

/// The file.
#[derive(Clone, Debug, Deserialize)]
pub struct Stored {
    /// The version of Basilisk that gave the values.
    pub basilisk: String,
    /// Length of a step, s.
    pub step: f64,
    /// How many steps.
    pub steps: u32,
    /// Whether the imbalances are forces and torques.
    #[serde(default)]
    lumped: bool,
    hub: StoredHub,
    wheels: [StoredWheel; WHEELS],
    samples: Vec<Sample>,
}

#[derive(Clone, Copy, Debug, Deserialize)]
struct StoredWheel {
    mount: [[f64; 3]; 3],
    r_w_b: [f64; 3],
    m_w: f64,
    axial: f64,
    transverse: f64,
    u_s: f64,
    u_d: f64,
    u_w: f64,
    #[serde(default)]
    viscous: f64,
}

/// The state after some steps: of B in N, and of the wheels.
#[derive(Clone, Copy, Debug, Deserialize)]
struct Sample {
    steps: u32,
    position: [f64; 3],
    velocity: [f64; 3],
    mrp: [f64; 3],
    omega: [f64; 3],
    theta: [f64; WHEELS],
    spin: [f64; WHEELS],
}

/// How far the two runs differ in one quantity.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Difference {
    /// What it is.
    pub quantity: &'static str,
    /// Its unit.
    pub unit: &'static str,
    /// The largest magnitude in the run of Basilisk.
    pub largest: f64,
    /// The largest difference, in units of that.
    pub error: f64,
}

/// Names and units, in the order of [`Sample::blocks`].
const QUANTITIES: [(&str, &str); 6] = [
    ("position of B", "m"),
    ("velocity of B", "m/s"),
    ("attitude (MRPs)", "1"),
    ("angular velocity of the hub", "rad/s"),
    ("angles of the wheels", "rad"),
    ("rates of the wheels", "rad/s"),
];

/// What changes an input by a factor: all wheels alike.
type Change = fn(&mut Stored, f64);

/// The inputs of the run.
const INPUTS: [(&str, Change); 11] = [
    ("hub's mass", |run, factor| run.hub.m_b *= factor),
    ("hub's centre of mass", |run, factor| run.hub.r_bc_b = run.hub.r_bc_b.map(|x| x * factor)),
    ("hub's inertia", |run, factor| run.hub.i_b = run.hub.i_b.map(|x| x * factor)),
    ("positions of the wheels", |run, factor| {
        run.wheels.iter_mut().flat_map(|wheel| &mut wheel.r_w_b).for_each(|x| *x *= factor);
    }),
    ("masses of the wheels", |run, factor| {
        run.wheels.iter_mut().for_each(|wheel| wheel.m_w *= factor);
    }),
    ("axial inertias", |run, factor| {
        run.wheels.iter_mut().for_each(|wheel| wheel.axial *= factor);
    }),
    ("transverse inertias", |run, factor| {
        run.wheels.iter_mut().for_each(|wheel| wheel.transverse *= factor);
    }),
    ("static imbalances", |run, factor| {
        run.wheels.iter_mut().for_each(|wheel| wheel.u_s *= factor);
    }),
    ("dynamic imbalances", |run, factor| {
        run.wheels.iter_mut().for_each(|wheel| wheel.u_d *= factor);
    }),
    ("friction", |run, factor| {
        run.wheels.iter_mut().for_each(|wheel| wheel.viscous *= factor);
    }),
    ("motor torques", |run, factor| {
        run.wheels.iter_mut().for_each(|wheel| wheel.u_w *= factor);
    }),
];

impl Sample {
    fn blocks(&self) -> [[f64; 3]; 6] {
        [self.position, self.velocity, self.mrp, self.omega, self.theta, self.spin]
    }

    fn state(&self) -> State<Set, Mrp> {
        State {
            r_b_n: self.position.into(),
            r_b_n_dot: self.velocity.into(),
            attitude: Mrp(self.mrp.into()),
            omega: self.omega.into(),
            devices: core::array::from_fn(|k| Joints { theta: self.theta[k], spin: self.spin[k] }),
            modal: (),
        }
    }

    fn from_state(steps: u32, state: &State<Set, Mrp>) -> Self {
        Self {
            steps,
            position: state.r_b_n.into(),
            velocity: state.r_b_n_dot.into(),
            mrp: state.attitude.0.into(),
            omega: state.omega.into(),
            theta: state.devices.map(|joints| joints.theta),
            spin: state.devices.map(|joints| joints.spin),
        }
    }
}

impl StoredWheel {
    fn wheel(&self, model: ImbalanceModel) -> ReactionWheel {
        ReactionWheel {
            mount: by_rows(self.mount),
            r_w_b: self.r_w_b.into(),
            m_w: self.m_w,
            d: self.u_s / self.m_w,
            i_w_wc: symmetric([self.axial, 0.0, self.u_d, self.transverse, 0.0, self.transverse]),
            passive: PerJoint { wheel: Passive::friction(self.viscous, 0.0, 0.0) },
            model,
        }
    }
}

impl Stored {
    /// The file.
    ///
    /// # Errors
    ///
    /// Where it is no such file; write it with `python tests/engines/wheels.py`.
    pub fn read() -> Result<Self, serde_json::Error> {
        serde_json::from_str(TEXT)
    }

    /// The file of the run with lumped imbalances and viscous friction.
    ///
    /// # Errors
    ///
    /// Where it is no such file; write it with `python tests/engines/lumped.py`.
    pub fn read_lumped() -> Result<Self, serde_json::Error> {
        serde_json::from_str(LUMPED)
    }

    /// The same run with each of its inputs changed by a factor, in turn, and which it is.
    pub fn changed(&self, factor: f64) -> impl Iterator<Item = (&'static str, Self)> + '_ {
        INPUTS.iter().map(move |(name, change)| {
            let mut run = self.clone();
            change(&mut run, factor);
            (*name, run)
        })
    }

    /// Our run, from the first state of the file, against all its states.
    ///
    /// # Errors
    ///
    /// Parameters or a state that the solver rejects.
    pub fn differences(&self) -> Result<[Difference; 6], Box<dyn Error>> {
        let ours = self.run()?;
        let numbers = |samples: &[Sample], block: usize| -> Vec<f64> {
            samples.iter().flat_map(|sample| sample.blocks()[block]).collect()
        };
        Ok(core::array::from_fn(|block| {
            let (ours, stored) = (numbers(&ours, block), numbers(&self.samples, block));
            let unit = largest(stored.iter().map(|number| number.abs()));
            let apart = largest(ours.iter().zip(&stored).map(|(a, b)| (a - b).abs()));
            let (quantity, name) = QUANTITIES[block];
            Difference { quantity, unit: name, largest: unit, error: apart / unit }
        }))
    }

    /// Our states after as many steps as those of the file.
    fn run(&self) -> Result<Vec<Sample>, Box<dyn Error>> {
        let model = if self.lumped { ImbalanceModel::Lumped } else { ImbalanceModel::Coupled };
        let wheels = self.wheels.map(|wheel| wheel.wheel(model));
        let spacecraft = Spacecraft::new(&self.hub.hub(), &wheels)?;
        let mut inputs: Inputs<Set> = Inputs::none();
        for (motor, wheel) in inputs.motors.iter_mut().zip(&self.wheels) {
            motor.u_w = wheel.u_w;
        }
        let mut found: Vec<Sample> = Vec::with_capacity(self.samples.len());
        let Some(first) = self.samples.first() else { return Ok(found) };
        let mut state = first.state();
        let mut made = first.steps;
        for sample in &self.samples {
            while made < sample.steps {
                state = spacecraft.step(&state, &inputs, self.step)?;
                made += 1;
            }
            found.push(Sample::from_state(made, &state));
        }
        Ok(found)
    }
}
