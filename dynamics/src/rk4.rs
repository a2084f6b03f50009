//! The classical fourth-order Runge-Kutta step, the integrator on board.
//!
//! Fixed cost, no error estimate: four evaluations and one normalisation of the attitude. The step
//! must resolve the fastest wheel; a tenth of a radian of `theta` per step is a sound start.

use crate::accelerations::sound;
use crate::attitude::Attitude;
use crate::devices::Devices;
use crate::each::{Each, JointStates};
use crate::error::{Quantity, SolveError};
use crate::inputs::Inputs;
use crate::ledger::Power;
use crate::real::{Real, Scalar, half, one};
use crate::spacecraft::Spacecraft;
use crate::state::{Accelerations, State};
use crate::vec3::{Vec3, add, columns, components, rotate_transposed, scale, vector, zeros};

/// Time derivative of a state; of the joints, rates stand for coordinates and accelerations for
/// rates.
#[derive(Clone)]
struct Slope<T, J, R> {
    r_b_n: Vec3<T>,
    r_b_n_dot: Vec3<T>,
    omega: Vec3<T>,
    devices: J,
    attitude: R,
}

/// What a step leaves, and what it took.
#[derive(Clone, Debug, PartialEq)]
pub struct Stepped<D: Devices, A> {
    /// The state after the step.
    pub state: State<D, A>,
    /// Work of each source during the step, J.
    pub work: Power<D::Scalar>,
}

/// What becomes of a stage of a step.
type Evaluated<D> = Result<Accelerations<D>, SolveError<<D as Devices>::Scalar>>;

/// The slope of a state.
type SlopeOf<D, A> = Slope<
    <D as Devices>::Scalar,
    <D as Devices>::Joints,
    <A as Attitude<<D as Devices>::Scalar>>::Rate,
>;

impl<D: Devices> Spacecraft<D> {
    /// The state after `dt` seconds, with the inputs constant along the axes they stand along.
    ///
    /// The attitude is normalised at the end of the step: a quaternion gets unit length, MRPs
    /// beyond a half turn become their shadow set. Joint angles run on; see [`State::wrapped`].
    ///
    /// # Errors
    ///
    /// As [`Spacecraft::accelerations`], and [`Quantity::TimeStep`] for a `dt` that is not finite.
    pub fn step<A: Attitude<D::Scalar>>(
        &self,
        state: &State<D, A>,
        inputs: &Inputs<D>,
        dt: D::Scalar,
    ) -> Result<State<D, A>, SolveError<D::Scalar>> {
        self.stepped(state, inputs, dt, |_, stage| self.solve(stage, inputs))
    }

    /// [`Self::step`], with the work of each source during the step: what the ledger calls power, in
    /// J, integrated to the order of the step.
    ///
    /// # Errors
    ///
    /// As [`Self::step`].
    pub fn step_with_work<A: Attitude<D::Scalar>>(
        &self,
        state: &State<D, A>,
        inputs: &Inputs<D>,
        dt: D::Scalar,
    ) -> Result<Stepped<D, A>, SolveError<D::Scalar>> {
        let mut work = Power::none();
        let state = self.stepped(state, inputs, dt, |time, stage| {
            let found = self.solve(stage, inputs)?;
            let power = self.ledger(stage, inputs, &found)?.power;
            work = work.plus_scaled(time, &power);
            Ok(found)
        })?;
        Ok(Stepped { state, work })
    }

    /// The step, by whatever evaluates a stage; it is told for how long the stage counts.
    pub(crate) fn stepped<A: Attitude<D::Scalar>>(
        &self,
        state: &State<D, A>,
        inputs: &Inputs<D>,
        dt: D::Scalar,
        evaluate: impl FnMut(D::Scalar, &State<D, A>) -> Evaluated<D>,
    ) -> Result<State<D, A>, SolveError<D::Scalar>> {
        if !dt.is_finite() {
            return Err(SolveError::NotFinite { what: Quantity::TimeStep, value: dt });
        }
        if !sound(state, inputs) {
            return Err(self.diagnosis(state, inputs, SolveError::Overflow));
        }
        let next = self.advance(state, dt, evaluate);
        next.map_err(|failure| self.diagnosis(state, inputs, failure))
    }

    fn advance<A: Attitude<D::Scalar>>(
        &self,
        state: &State<D, A>,
        dt: D::Scalar,
        mut evaluate: impl FnMut(D::Scalar, &State<D, A>) -> Evaluated<D>,
    ) -> Result<State<D, A>, SolveError<D::Scalar>> {
        let middle = half::<D::Scalar>() * dt;
        let sixth = dt * D::Scalar::from_f64(6.0).recip();
        let third = dt * D::Scalar::from_f64(3.0).recip();

        let mut slope = |weight: D::Scalar, stage: &State<D, A>| {
            let found = evaluate(weight, stage)?;
            Ok::<_, SolveError<D::Scalar>>(slope_of(stage, &found))
        };
        let k_1 = slope(sixth, state)?;
        let k_2 = slope(third, &self.moved(state, [(middle, &k_1)]))?;
        let k_3 = slope(third, &self.moved(state, [(middle, &k_2)]))?;
        let k_4 = slope(sixth, &self.moved(state, [(dt, &k_3)]))?;
        let terms = [(sixth, &k_1), (third, &k_2), (third, &k_3), (sixth, &k_4)];
        let mut next = self.moved(state, terms);
        next.attitude = next.attitude.normalised();
        match self.culprit_in_state(&next) {
            Some(_) => Err(SolveError::Overflow),
            None => Ok(next),
        }
    }

    /// The state plus the sum of `time * slope`, the sum taken before it meets the state.
    fn moved<const TERMS: usize, A: Attitude<D::Scalar>>(
        &self,
        state: &State<D, A>,
        terms: [(D::Scalar, &SlopeOf<D, A>); TERMS],
    ) -> State<D, A> {
        let mut sum = Slope {
            r_b_n: zeros(),
            r_b_n_dot: zeros(),
            omega: zeros(),
            devices: D::at_rest_for(&self.devices),
            attitude: (),
        };
        for (time, slope) in terms {
            sum.r_b_n = add(sum.r_b_n, scale(time, slope.r_b_n));
            sum.r_b_n_dot = add(sum.r_b_n_dot, scale(time, slope.r_b_n_dot));
            sum.omega = add(sum.omega, scale(time, slope.omega));
            add_scaled(&mut sum.devices, time, &slope.devices);
        }
        let mut devices = state.devices.clone();
        add_scaled(&mut devices, one(), &sum.devices);
        State {
            r_b_n: vector(add(components(&state.r_b_n), sum.r_b_n)),
            r_b_n_dot: vector(add(components(&state.r_b_n_dot), sum.r_b_n_dot)),
            attitude: state.attitude.advanced(&terms.map(|(time, slope)| (time, slope.attitude))),
            omega: vector(add(components(&state.omega), sum.omega)),
            devices,
        }
    }
}

/// The slope of a state with its accelerations.
fn slope_of<D: Devices, A: Attitude<D::Scalar>>(
    state: &State<D, A>,
    found: &Accelerations<D>,
) -> SlopeOf<D, A> {
    let bn = columns(&state.attitude.dcm());
    let mut devices = state.devices.clone();
    for ([coordinate, rate], acceleration) in devices.states_mut().zip(found.devices.values()) {
        *coordinate = *rate;
        *rate = acceleration;
    }
    Slope {
        r_b_n: components(&state.r_b_n_dot),
        r_b_n_dot: rotate_transposed(&bn, components(&found.r_b_n_ddot)),
        omega: components(&found.omega_dot),
        devices,
        attitude: state.attitude.rate(&state.omega),
    }
}

/// `a + time * slope`, joint by joint.
fn add_scaled<T: Scalar, J: JointStates<T>>(a: &mut J, time: T, slope: &J) {
    for ([coordinate, rate], [of_coordinate, of_rate]) in a.states_mut().zip(slope.states()) {
        *coordinate = *coordinate + time * of_coordinate;
        *rate = *rate + time * of_rate;
    }
}

#[cfg(test)]
mod tests {
    use nalgebra::{Matrix3, Vector3};

    use super::*;
    use crate::Dgvscmg;
    use crate::momentum::{About, Momentum};
    use crate::mrp::Mrp;
    use crate::parameters::Hub;
    use crate::quaternion::Quaternion;

    /// A whole turn of the body takes about 4 s; the run covers two.
    const DURATION: f64 = 8.0;

    fn hub() -> Spacecraft<[Dgvscmg; 0]> {
        let hub = Hub {
            m_b: 20.0,
            r_bc_b: Vector3::new(0.1, -0.2, 0.3),
            i_b_bc: Matrix3::new(4.0, 0.3, -0.2, 0.3, 5.0, 0.6, -0.2, 0.6, 7.0),
        };
        Spacecraft::new(&hub, &[]).unwrap()
    }

    fn tumbling<A: Attitude<f64>>() -> State<[Dgvscmg; 0], A> {
        State {
            r_b_n_dot: Vector3::new(0.5, 0.1, -0.2),
            omega: Vector3::new(1.2, -0.7, 0.9),
            ..State::at_rest()
        }
    }

    fn run<A: Attitude<f64>>(steps: u32) -> State<[Dgvscmg; 0], A> {
        let dt = DURATION / f64::from(steps);
        let torques = Inputs::none();
        (0..steps).fold(tumbling(), |state, _| hub().step(&state, &torques, dt).unwrap())
    }

    /// Drifts of energy and of angular momentum about the inertial origin, J and kg m^2/s.
    fn drifts(steps: u32) -> (f64, f64) {
        let (before, after) = (tumbling::<Quaternion>(), run::<Quaternion>(steps));
        let momentum = |s| -> Momentum { hub().momentum(s, About::InertialOrigin).unwrap() };
        let energy = |s| hub().energy(s).unwrap();
        (
            (energy(&after) - energy(&before)).abs(),
            (momentum(&after).angular - momentum(&before).angular).norm(),
        )
    }

    #[test]
    fn free_rigid_hub_keeps_energy_and_momentum_to_fourth_order() {
        let (energy, momentum) = drifts(200);
        let (energy_half, momentum_half) = drifts(400);
        for (whole, halved) in [(energy, energy_half), (momentum, momentum_half)] {
            assert!((14.0..18.0).contains(&(whole / halved)), "{whole} to {halved}");
        }
        // Of 25 J and 20 kg m^2/s: small, so that the ratios are those of converged runs.
        assert!(energy_half < 1e-6 && momentum_half < 1e-6, "{energy_half} {momentum_half}");
    }

    #[test]
    fn error_of_the_state_falls_sixteenfold_per_halved_step() {
        let reference = run::<Quaternion>(3200);
        let error = |steps| {
            let state = run::<Quaternion>(steps);
            (state.omega - reference.omega).norm() + (state.r_b_n - reference.r_b_n).norm()
        };
        let ratio = error(100) / error(200);
        assert!((14.0..18.0).contains(&ratio), "{ratio}");
    }

    #[test]
    fn mrps_and_quaternions_run_alike_through_shadow_switches() {
        let (mrp, quaternion) = (run::<Mrp>(1600), run::<Quaternion>(1600));
        assert!(mrp.attitude.0.norm() <= 1.0);
        assert!((quaternion.attitude.norm() - 1.0).abs() < 4.0 * f64::EPSILON);
        // Both carry a fourth-order error of about the step's fourth power.
        assert!((mrp.attitude.dcm() - quaternion.attitude.dcm()).amax() < 1e-8);
        assert_eq!(mrp.omega, quaternion.omega);
    }

    #[test]
    fn negative_step_leads_back() {
        let start = tumbling::<Quaternion>();
        let there = hub().step(&start, &Inputs::none(), 0.01).unwrap();
        let back = hub().step(&there, &Inputs::none(), -0.01).unwrap();
        // One step's error is of the fifth power of 0.01 s times rates of order 1.
        assert!((back.omega - start.omega).norm() < 1e-11);
        assert!((back.r_b_n - start.r_b_n).norm() < 1e-11);
    }

    #[test]
    fn step_that_is_not_finite_is_refused() {
        let step = |dt| hub().step(&tumbling::<Mrp>(), &Inputs::none(), dt);
        let what = Quantity::TimeStep;
        for value in [f64::INFINITY, f64::NEG_INFINITY] {
            assert_eq!(step(value), Err(SolveError::NotFinite { what, value }));
        }
        let refused = step(f64::NAN).unwrap_err();
        assert!(matches!(refused, SolveError::NotFinite { value, .. } if value.is_nan()));
        assert_eq!(step(1e200), Err(SolveError::Overflow));
    }

    #[test]
    fn step_names_the_input_that_is_not_finite() {
        let mut state = tumbling::<Mrp>();
        state.r_b_n.x = f64::INFINITY;
        let (what, value) = (Quantity::Position, f64::INFINITY);
        let refused = Err(SolveError::NotFinite { what, value });
        assert_eq!(hub().step(&state, &Inputs::none(), 0.1), refused);
    }
}
