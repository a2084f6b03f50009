//! [`ActingInputs`]: what acts on a spacecraft, joints in order; [`BatchInputs`]: on every state of a batch.

use nalgebra::Vector3;
use precess_dynamics::{
    BuiltIn, Devices, Each as _, Gravity, HubMode, Inputs, Mode, Spacecraft, StructureData, Wrench,
};

/// What acts on a spacecraft with any set of devices.
#[derive(Clone, Debug, PartialEq)]
pub struct ActingInputs {
    /// External force through B, in B, N.
    pub force: Vector3<f64>,
    /// External torque about B, in B, N m.
    pub torque_b: Vector3<f64>,
    /// Motor torques or forces.
    pub motors: Vec<f64>,
    /// Modes.
    pub modes: Vec<Mode<f64>>,
    /// Mode of the hub.
    pub hub: HubMode<f64>,
    /// Gravity.
    pub gravity: Gravity<f64>,
    /// Wrenches on the bodies, where there are any.
    pub bodies: Option<Vec<Wrench<f64>>>,
}

impl ActingInputs {
    /// Those of a spacecraft with any set of devices.
    #[must_use]
    pub fn new<D: Devices<Scalar = f64>, S: StructureData>(inputs: &Inputs<D, S>) -> Self {
        Self {
            force: inputs.force,
            torque_b: inputs.torque_b,
            motors: inputs.motors.values().collect(),
            modes: inputs.modes.values().collect(),
            hub: inputs.hub,
            gravity: inputs.gravity,
            bodies: inputs.bodies.as_ref().map(|bodies| bodies.values().collect()),
        }
    }

    /// As the solver takes them.
    pub(crate) fn inputs(&self, craft: &Spacecraft<Vec<BuiltIn>>) -> Inputs<Vec<BuiltIn>> {
        let mut inputs = Inputs::none_for(craft);
        (inputs.force, inputs.torque_b) = (self.force, self.torque_b);
        (inputs.hub, inputs.gravity) = (self.hub, self.gravity);
        inputs.motors.values_mut().zip(&self.motors).for_each(|(to, from)| *to = *from);
        inputs.modes.values_mut().zip(&self.modes).for_each(|(to, from)| *to = *from);
        if let Some(bodies) = &self.bodies {
            let mut all = Inputs::no_wrenches_for(craft);
            all.values_mut().zip(bodies).for_each(|(to, from)| *to = *from);
            inputs.bodies = Some(all);
        }
        inputs
    }

    /// The numbers that differ from state to state: force, torque, and of each joint the torque of its motor, its
    /// acceleration where it is prescribed.
    #[must_use]
    pub fn row(&self) -> Vec<f64> {
        let motors = self.motors.iter().zip(&self.modes).map(|(motor, mode)| match mode {
            Mode::Prescribed(acceleration) => *acceleration,
            _ => *motor,
        });
        self.force.iter().chain(&self.torque_b).copied().chain(motors).collect()
    }

    /// The same with the numbers of a row.
    #[must_use]
    pub fn with_row(&self, row: &[f64]) -> Self {
        let mut inputs = self.clone();
        let mut numbers = row.iter().copied();
        let hub = inputs.force.iter_mut().chain(inputs.torque_b.iter_mut());
        hub.zip(&mut numbers).for_each(|(to, from)| *to = from);
        for ((motor, mode), number) in inputs.motors.iter_mut().zip(&mut inputs.modes).zip(numbers)
        {
            match mode {
                Mode::Prescribed(acceleration) => *acceleration = number,
                _ => *motor = number,
            }
        }
        inputs
    }

    /// As the kernel `prepare` reads them: see `NAME_batch.h`.
    pub(crate) fn shared(&self) -> Vec<f64> {
        let mut numbers: Vec<f64> = self.force.iter().chain(&self.torque_b).copied().collect();
        for (motor, mode) in self.motors.iter().zip(&self.modes) {
            let (mode, acceleration) = match mode {
                Mode::Driven => (0.0, 0.0),
                Mode::Prescribed(acceleration) => (1.0, *acceleration),
                Mode::Locked => (2.0, 0.0),
            };
            numbers.extend([mode, *motor, acceleration]);
        }
        let zero = Vector3::zeros();
        let (freedom, r_b_n_ddot, omega_dot) = match self.hub {
            HubMode::Free => (0.0, zero, zero),
            HubMode::Fixed => (1.0, zero, zero),
            HubMode::Prescribed { r_b_n_ddot, omega_dot } => (2.0, r_b_n_ddot, omega_dot),
        };
        numbers.push(freedom);
        numbers.extend(r_b_n_ddot.iter().chain(&omega_dot));
        let (field, uniform, mu) = match self.gravity {
            Gravity::None => (0.0, zero, 0.0),
            Gravity::Uniform(uniform) => (1.0, uniform, 0.0),
            Gravity::Central { mu } => (2.0, zero, mu),
        };
        numbers.push(field);
        numbers.extend(uniform.iter());
        numbers.push(mu);
        numbers.push(f64::from(u8::from(self.bodies.is_some())));
        let none = Vec::new();
        let bodies = self.bodies.as_ref().unwrap_or(&none).iter().copied();
        let bodies = bodies.chain(std::iter::repeat(Wrench::none())).take(self.motors.len());
        for Wrench { force, moment } in bodies {
            numbers.extend(force.iter().chain(&moment));
        }
        numbers
    }

    /// Whether all but the numbers of a row are those of others, to the bit.
    #[must_use]
    pub fn shares_with(&self, other: &Self) -> bool {
        let row = vec![0.0; 6 + self.motors.len()];
        let bits = |of: &Self| -> Vec<u64> {
            of.with_row(&row).shared().into_iter().map(f64::to_bits).collect()
        };
        self.motors.len() == other.motors.len() && bits(self) == bits(other)
    }
}

/// What acts on every state.
#[derive(Clone, Copy, Debug)]
pub struct BatchInputs<'a> {
    /// On all.
    pub base: &'a ActingInputs,
    /// In place of its numbers those of each state, as [`ActingInputs::row`] orders them, one row after another; empty where
    /// they are the same for all.
    pub rows: &'a [f64],
}
