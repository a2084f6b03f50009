//! The search for the input that is not finite.
//!
//! The hot path checks its results instead, which are fewer, and searches only once they fail.

use nalgebra::Vector3;

use crate::attitude::parameterisation::Attitude;
use crate::equations::error::{Quantity, SolveError};
use crate::equations::gravity::Gravity;
use crate::model::mode::{HubMode, Mode};
use crate::numbers::each::{Each, JointStates};
use crate::numbers::real::{Scalar, zero};
use crate::numbers::vec3::{add, components, finite, scale, zeros};
use crate::sets::counts::check_counts;
use crate::sets::devices::Devices;
use crate::solve::inputs::Inputs;
use crate::solve::spacecraft::Spacecraft;
use crate::solve::state::{Accelerations, State};
use crate::solve::structure::StructureEquations;

/// Whether all vectors are finite, by one comparison: a number times zero is zero unless it is
/// infinite or NaN.
#[inline]
pub(crate) fn all_finite<T: Scalar, const N: usize>(vectors: [&Vector3<T>; N]) -> bool {
    let mut vanishing = zeros();
    for vector in vectors {
        vanishing = add(vanishing, scale(zero(), components(vector)));
    }
    let [x, y, z] = vanishing;
    x + y + z == zero()
}

/// Rejects a value that is not finite.
pub(crate) fn reject<T: Scalar>(not_finite: Option<(Quantity, T)>) -> Result<(), SolveError<T>> {
    match not_finite {
        Some((what, value)) => Err(SolveError::NotFinite { what, value }),
        None => Ok(()),
    }
}

impl<D: Devices, S: StructureEquations> Spacecraft<D, S> {
    /// Rejects the first input that is not finite.
    pub(crate) fn reject<A: Attitude<D::Scalar>>(
        &self,
        state: &State<D, A, S>,
        inputs: &Inputs<D, S>,
    ) -> Result<(), SolveError<D::Scalar>> {
        check_counts::<D>(&self.devices, &state.devices, Some(inputs.of_joints()), None)?;
        reject(self.not_finite_in_state(state).or_else(|| self.not_finite_in_inputs(inputs)))?;
        S::reject_state(self, &state.modal)?;
        S::reject_inputs(self, &inputs.modal)
    }

    /// Rejects a state that is not finite, or has another number of devices or modes.
    pub(crate) fn reject_state<A: Attitude<D::Scalar>>(
        &self,
        state: &State<D, A, S>,
    ) -> Result<(), SolveError<D::Scalar>> {
        check_counts::<D>(&self.devices, &state.devices, None, None)?;
        reject(self.not_finite_in_state(state))?;
        S::reject_state(self, &state.modal)
    }

    /// Rejects accelerations that are not finite, or of another number of devices.
    pub(crate) fn reject_accelerations<A>(
        &self,
        state: &State<D, A, S>,
        accelerations: &Accelerations<D, S>,
    ) -> Result<(), SolveError<D::Scalar>> {
        check_counts::<D>(&self.devices, &state.devices, None, Some(&accelerations.devices))?;
        let Accelerations { r_b_n_ddot, omega_dot, devices, modal } = accelerations;
        let joint = || {
            let mut joints = devices.values().zip(self.joints());
            joints.find(|(value, _)| !value.is_finite()).map(|(value, (device, info))| {
                (Quantity::JointAcceleration { device, joint: info.body }, value)
            })
        };
        let hub = not_finite_in_vector(Quantity::HubAcceleration, r_b_n_ddot)
            .or_else(|| not_finite_in_vector(Quantity::HubAcceleration, omega_dot));
        reject(hub.or_else(joint))?;
        S::reject_accelerations(self, modal)
    }

    /// Rejects a state that a step or a stop leads to unless it is finite.
    #[inline]
    pub(crate) fn check_reached<A: Attitude<D::Scalar>>(
        &self,
        state: &State<D, A, S>,
    ) -> Result<(), SolveError<D::Scalar>> {
        let vectors = [&state.r_b_n, &state.r_b_n_dot, &state.omega];
        let finite = vectors.into_iter().all(|v| finite(components(v)))
            && state.attitude.is_valid()
            && state.devices.states().all(|[x, rate]| x.is_finite() && rate.is_finite());
        if !finite {
            return self.reject_reached(state);
        }
        let of_modes = |_| SolveError::Overflow { what: Quantity::ModalAcceleration };
        S::reject_state(self, &state.modal).map_err(of_modes)
    }

    #[cold]
    fn reject_reached<A: Attitude<D::Scalar>>(
        &self,
        state: &State<D, A, S>,
    ) -> Result<(), SolveError<D::Scalar>> {
        let not_finite = self.not_finite_in_state(state);
        not_finite.map_or(Ok(()), |(what, _)| Err(SolveError::Overflow { what }))
    }

    /// The first part of a state that is not finite, and its value.
    pub(crate) fn not_finite_in_state<A: Attitude<D::Scalar>>(
        &self,
        state: &State<D, A, S>,
    ) -> Option<(Quantity, D::Scalar)> {
        let attitude = || {
            let spoilt = !state.attitude.is_valid();
            spoilt.then(|| (Quantity::Attitude, state.attitude.extreme()))
        };
        let joint = || {
            let joints = state.devices.states().zip(self.joints());
            let mut fields = joints.flat_map(|([coordinate, rate], (device, info))| {
                [(info.coordinate, coordinate), (info.rate, rate)]
                    .map(|(field, value)| (Quantity::Joint { device, field }, value))
            });
            fields.find(|(_, value)| !value.is_finite())
        };
        not_finite_in_vector(Quantity::Position, &state.r_b_n)
            .or_else(|| not_finite_in_vector(Quantity::Velocity, &state.r_b_n_dot))
            .or_else(attitude)
            .or_else(|| not_finite_in_vector(Quantity::BodyRate, &state.omega))
            .or_else(joint)
    }

    /// The first input that is not finite, and its value.
    pub(crate) fn not_finite_in_inputs(
        &self,
        inputs: &Inputs<D, S>,
    ) -> Option<(Quantity, D::Scalar)> {
        let Inputs { force, torque_b, motors, modes, hub, gravity, bodies, .. } = inputs;
        let hub = || match hub {
            HubMode::Free | HubMode::Fixed => None,
            HubMode::Prescribed { r_b_n_ddot, omega_dot } => {
                not_finite_in_vector(Quantity::HubAcceleration, r_b_n_ddot)
                    .or_else(|| not_finite_in_vector(Quantity::HubAcceleration, omega_dot))
            }
        };
        let gravity = || match gravity {
            Gravity::None => None,
            Gravity::Uniform(g) => not_finite_in_vector(Quantity::Gravity, g),
            Gravity::Central { mu } => {
                Some((Quantity::Gravity, *mu)).filter(|(_, mu)| !mu.is_finite())
            }
        };
        not_finite_in_vector(Quantity::Force, force)
            .or_else(|| not_finite_in_vector(Quantity::TorqueB, torque_b))
            .or_else(|| {
                let mut joints = motors.values().zip(modes.values()).zip(self.joints());
                joints.find_map(|((torque, mode), (device, info))| {
                    let joint = info.body;
                    let prescribed = match mode {
                        Mode::Prescribed(acceleration) => Some(acceleration),
                        Mode::Driven | Mode::Locked => None,
                    };
                    let motor = Some((Quantity::Motor { device, joint }, torque));
                    let mode =
                        prescribed.map(|a| (Quantity::JointAcceleration { device, joint }, a));
                    [motor, mode].into_iter().flatten().find(|(_, value)| !value.is_finite())
                })
            })
            .or_else(hub)
            .or_else(gravity)
            .or_else(|| {
                let wrenches = bodies.iter().flat_map(Each::values);
                let mut wrenches = wrenches.zip(self.joints());
                wrenches.find_map(|(wrench, (device, info))| {
                    let what = Quantity::Wrench { device, body: info.body };
                    not_finite_in_vector(what, &wrench.force)
                        .or_else(|| not_finite_in_vector(what, &wrench.moment))
                })
            })
    }
}

/// The vector's name and its first component that is not finite.
pub(crate) fn not_finite_in_vector<T: Scalar>(
    what: Quantity,
    v: &Vector3<T>,
) -> Option<(Quantity, T)> {
    let value = components(v).into_iter().find(|value| !value.is_finite())?;
    Some((what, value))
}

#[cfg(test)]
mod tests {
    use nalgebra::Matrix3;

    use super::*;
    use crate::attitude::quaternion::Quaternion;
    use crate::{Dgvscmg, Hub};

    type Two = [Dgvscmg; 2];

    fn spacecraft() -> Spacecraft<Two> {
        let hub = Hub { m_b: 1.0, r_bc_b: Vector3::zeros(), i_b_bc: Matrix3::identity() };
        Spacecraft::new(&hub, &[Dgvscmg::bare_wheel(1.0, Matrix3::identity()); 2]).unwrap()
    }

    fn not_finite(change: impl Fn(&mut State<Two>)) -> Option<Quantity> {
        let mut state = State::at_rest();
        change(&mut state);
        spacecraft().not_finite_in_state(&state).map(|(what, _)| what)
    }

    #[test]
    fn every_field_of_a_state_is_searched() {
        const BAD: f64 = f64::NAN;
        let joint = |field| Some(Quantity::Joint { device: 1, field });
        assert_eq!(not_finite(|_| ()), None);
        assert_eq!(not_finite(|s| s.r_b_n.y = BAD), Some(Quantity::Position));
        assert_eq!(not_finite(|s| s.r_b_n_dot.z = f64::INFINITY), Some(Quantity::Velocity));
        assert_eq!(
            not_finite(|s| s.attitude = Quaternion { q0: 0.0, q1: 0.0, q2: 0.0, q3: 0.0 }),
            Some(Quantity::Attitude)
        );
        assert_eq!(not_finite(|s| s.omega.x = BAD), Some(Quantity::BodyRate));
        assert_eq!(not_finite(|s| s.devices[1].gamma_o = BAD), joint("gamma_o"));
        assert_eq!(not_finite(|s| s.devices[1].gamma_i = BAD), joint("gamma_i"));
        assert_eq!(not_finite(|s| s.devices[1].theta = BAD), joint("theta"));
        assert_eq!(not_finite(|s| s.devices[1].gamma_o_dot = BAD), joint("gamma_o_dot"));
        assert_eq!(not_finite(|s| s.devices[1].gamma_i_dot = BAD), joint("gamma_i_dot"));
        assert_eq!(not_finite(|s| s.devices[1].spin = BAD), joint("spin"));
    }

    #[test]
    fn every_field_of_the_inputs_is_searched() {
        const BAD: f64 = f64::NAN;
        let not_finite = |change: fn(&mut Inputs<Two>)| {
            let mut inputs = Inputs::none();
            change(&mut inputs);
            spacecraft().not_finite_in_inputs(&inputs).map(|(what, _)| what)
        };
        let motor = |joint| Some(Quantity::Motor { device: 0, joint });
        assert_eq!(not_finite(|_| ()), None);
        assert_eq!(not_finite(|t| t.force.x = BAD), Some(Quantity::Force));
        assert_eq!(not_finite(|t| t.torque_b.z = BAD), Some(Quantity::TorqueB));
        assert_eq!(not_finite(|t| t.motors[0].u_i = BAD), motor("inner gimbal"));
        assert_eq!(not_finite(|t| t.motors[0].u_o = BAD), motor("outer gimbal"));
        assert_eq!(not_finite(|t| t.motors[0].u_w = BAD), motor("wheel"));
        assert_eq!(
            not_finite(|t| t.modes[1].wheel = Mode::Prescribed(BAD)),
            Some(Quantity::JointAcceleration { device: 1, joint: "wheel" })
        );
        let prescribed = |t: &mut Inputs<Two>| {
            let r_b_n_ddot = Vector3::new(0.0, BAD, 0.0);
            t.hub = HubMode::Prescribed { r_b_n_ddot, omega_dot: Vector3::zeros() };
        };
        assert_eq!(not_finite(prescribed), Some(Quantity::HubAcceleration));
        assert_eq!(
            not_finite(|t| t.gravity = Gravity::Central { mu: BAD }),
            Some(Quantity::Gravity)
        );
        let wrench = |t: &mut Inputs<Two>| {
            let mut bodies = Inputs::<Two>::no_wrenches();
            bodies[1].inner_gimbal.moment.y = BAD;
            t.bodies = Some(bodies);
        };
        assert_eq!(not_finite(wrench), Some(Quantity::Wrench { device: 1, body: "inner gimbal" }));
    }

    /// Infinite values, since NaN equals nothing.
    #[test]
    fn the_value_comes_with_the_name() {
        let (up, down) = (f64::INFINITY, f64::NEG_INFINITY);
        let spacecraft = spacecraft();
        let mut state = State::<Two>::at_rest();
        state.devices[0].spin = up;
        let spin = Quantity::Joint { device: 0, field: "spin" };
        assert_eq!(spacecraft.not_finite_in_state(&state), Some((spin, up)));
        state.omega = Vector3::new(1.0, down, up);
        assert_eq!(spacecraft.not_finite_in_state(&state), Some((Quantity::BodyRate, down)));
        state.attitude = Quaternion { q2: down, ..Quaternion::identity() };
        assert_eq!(spacecraft.not_finite_in_state(&state), Some((Quantity::Attitude, down)));

        let mut inputs = Inputs::<Two>::none();
        inputs.motors[0].u_w = down;
        let motor = Quantity::Motor { device: 0, joint: "wheel" };
        assert_eq!(spacecraft.not_finite_in_inputs(&inputs), Some((motor, down)));
        inputs.torque_b.z = up;
        assert_eq!(spacecraft.not_finite_in_inputs(&inputs), Some((Quantity::TorqueB, up)));
    }
}
