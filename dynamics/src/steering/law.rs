//! [`SteeringLaw`]: commands for a torque on the hub, and motion that gives none.

use nalgebra::Vector3;

use crate::numbers::real::{Scalar, one, zero};
use crate::numbers::vec3::{Vec3, add, components, dot, neg, sub, vector, zeros};
use crate::steering::error::{SteeringError, finite};
use crate::steering::matrix::{Steered, SteeringMatrix, gram, product, solved};

/// How the steering matrix Q is inverted, with weights W: `x = W Q^T (Q W Q^T + ...)^-1 d`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Inverse<T = f64> {
    /// Nothing added: exact, and an error where the devices are singular. Schaub, Vadali, Junkins (1998) with weights of
    /// gimbals and wheels. Rounding grows with the square of the condition of Q.
    Exact,
    /// `lambda reference^2 1` with `lambda exp(-mu measure)`: bounded commands, a torque that is not exact. Of a torque
    /// along the singular direction it commands nothing. Nakamura and Hanafusa (1986); the exponential as in Wie (2001).
    SingularityRobust {
        /// Largest lambda, dimensionless.
        lambda: T,
        /// How fast it falls with [`SteeringMatrix::measure`].
        mu: T,
    },
    /// `lambda reference^2 E`, E symmetric with a dither beside its diagonal of ones: leaves singular poses in which the
    /// torque is along the singular direction. Wie (2001).
    Generalised {
        /// Largest lambda.
        lambda: T,
        /// How fast it falls with [`SteeringMatrix::measure`].
        mu: T,
        /// Elements 23, 13 and 12 of E, such as [`Dither::at`] a time; each below one half.
        dither: [T; 3],
    },
}

/// `amplitude sin(frequency t + phase)`, once per element.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Dither<T = f64> {
    /// Dimensionless.
    pub amplitude: T,
    /// rad/s.
    pub frequency: T,
    /// rad.
    pub phases: [T; 3],
}

impl<T: Scalar> Dither<T> {
    /// At a time, s.
    #[must_use]
    pub fn at(&self, time: T) -> [T; 3] {
        self.phases.map(|phase| self.amplitude * (self.frequency * time + phase).sin_cos().0)
    }
}

/// A steering law for `N` joints.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SteeringLaw<T, const N: usize> {
    /// The inverse.
    pub inverse: Inverse<T>,
    /// W: how readily each joint moves; zero for one that does not. Rates and accelerations have different units, so
    /// their weights say how they are exchanged.
    pub weights: [T; N],
    /// The momentum that makes lambda and the measure dimensionless, kg m^2/s: that of one wheel.
    pub reference: T,
}

/// What a law commands.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Allocation<T, const N: usize> {
    /// Rates, rad/s (m/s), and accelerations, rad/s^2 (m/s^2); zero where nothing is commanded.
    pub commands: [T; N],
    /// The torque on the hub that they give less the one that was demanded, N m.
    pub torque_error: Vector3<T>,
    /// How many commands are at a bound.
    pub bounded: usize,
}

/// Weights for gimbals and wheels together: wheels help near singular poses of the gimbals, `wheel exp(-mu measure)`, of
/// which [`Dual`](crate::Dual) numbers keep no derivative. Schaub, Vadali, Junkins (1998), whose measure is
/// [`SteeringMatrix::measure`] of a matrix in which the gimbals only are commanded, with the mean momentum of a wheel.
#[must_use]
pub fn steering_weights<T: Scalar, const N: usize>(
    steered: &[Steered; N],
    [gimbal, wheel]: [T; 2],
    mu: T,
    measure: T,
) -> [T; N] {
    let near = wheel * exponential(-(mu * measure));
    steered.map(|steered| match steered {
        Steered::Rate => gimbal,
        Steered::Acceleration => near,
        Steered::Nothing => zero(),
    })
}

impl<T: Scalar, const N: usize> SteeringLaw<T, N> {
    /// The exact inverse with weights of one.
    #[must_use]
    pub fn exact() -> Self {
        Self { inverse: Inverse::Exact, weights: [one(); N], reference: one() }
    }

    /// Commands that give a torque on the hub, N m, B axes; what is not commanded is compensated.
    ///
    /// # Errors
    ///
    /// [`SteeringError::Singular`] of the exact inverse, [`SteeringError::Argument`], [`SteeringError::Overflow`].
    pub fn allocate(
        &self,
        matrix: &SteeringMatrix<T, N>,
        torque: &Vector3<T>,
    ) -> Result<Allocation<T, N>, SteeringError<T>> {
        let demand = self.demand(matrix, torque)?;
        let commands = self.inverted(matrix, &self.weights, demand)?;
        allocation(matrix, commands, demand, 0)
    }

    /// The part of a preferred motion that gives no torque: `p - W Q^T (Q W Q^T)^-1 Q p`. Towards gimbal angles `q*`, p
    /// is `k (q* - q)`; away from wheel speeds, [`KeepOut::acceleration`](crate::KeepOut::acceleration). It is added to
    /// commands.
    ///
    /// # Errors
    ///
    /// As [`Self::allocate`] of the exact inverse.
    pub fn null_motion(
        &self,
        matrix: &SteeringMatrix<T, N>,
        preferred: &[T; N],
    ) -> Result<[T; N], SteeringError<T>> {
        finite("preferred motion", *preferred)?;
        self.check()?;
        let mut motion = *preferred;
        for ((motion, weight), column) in motion.iter_mut().zip(self.weights).zip(&matrix.columns) {
            if weight == zero() || components(column).iter().all(|of| *of == zero()) {
                *motion = zero();
            }
        }
        let exact = Self { inverse: Inverse::Exact, ..*self };
        let given = product(&matrix.columns, &motion);
        let back = exact.inverted(matrix, &self.weights, given)?;
        for (motion, back) in motion.iter_mut().zip(back) {
            *motion = *motion - back;
        }
        if motion.iter().all(|motion| motion.is_finite()) {
            Ok(motion)
        } else {
            Err(SteeringError::Overflow)
        }
    }

    /// `Q x` that is demanded: that of the devices, opposite to the torque on the hub, less the drift.
    pub(super) fn demand(
        &self,
        matrix: &SteeringMatrix<T, N>,
        torque: &Vector3<T>,
    ) -> Result<Vec3<T>, SteeringError<T>> {
        finite("torque component", components(torque))?;
        finite("drift component", components(&matrix.drift))?;
        self.check()?;
        Ok(neg(add(components(torque), components(&matrix.drift))))
    }

    fn check(&self) -> Result<(), SteeringError<T>> {
        let weights = self.weights.iter().enumerate();
        for (index, weight) in weights {
            if !(weight.is_finite() && *weight >= zero()) {
                return Err(SteeringError::Argument { what: "weight", index, value: *weight });
            }
        }
        let parameters = match self.inverse {
            Inverse::Exact => [zero(); 5],
            Inverse::SingularityRobust { lambda, mu } => [lambda, mu, zero(), zero(), zero()],
            Inverse::Generalised { lambda, mu, dither: [a, b, c] } => [lambda, mu, a, b, c],
        };
        finite("parameter of the inverse", parameters)?;
        let [lambda, _, dither @ ..] = parameters;
        if lambda < zero() {
            return Err(SteeringError::Argument { what: "lambda", index: 0, value: lambda });
        }
        // With every element below one half, E is positive definite.
        let half = T::from_f64(0.5);
        let large = dither.into_iter().enumerate().find(|(_, element)| element.abs() >= half);
        if let Some((index, value)) = large {
            return Err(SteeringError::Argument { what: "dither", index, value });
        }
        if self.reference.is_finite() && self.reference > zero() {
            Ok(())
        } else {
            let value = self.reference;
            Err(SteeringError::Argument { what: "reference momentum", index: 0, value })
        }
    }

    /// `W Q^T S^-1 d`; the exact inverse once more for what rounding has left.
    pub(super) fn inverted(
        &self,
        matrix: &SteeringMatrix<T, N>,
        weights: &[T; N],
        demand: Vec3<T>,
    ) -> Result<[T; N], SteeringError<T>> {
        let q = &matrix.columns;
        let mut s = gram(q, weights);
        self.add_robustness(&mut s, matrix, weights);
        let back = |d: Vec3<T>| -> Result<[T; N], SteeringError<T>> {
            let solution = solved(s, d)?;
            let mut commands = *weights;
            for (command, column) in commands.iter_mut().zip(q) {
                *command = *command * dot(components(column), solution);
            }
            Ok(commands)
        };
        let mut commands = back(demand)?;
        if self.inverse == Inverse::Exact {
            let left = back(sub(demand, product(q, &commands)))?;
            for (command, left) in commands.iter_mut().zip(left) {
                *command = *command + left;
            }
        }
        Ok(commands)
    }

    /// Adds `lambda reference^2 E`.
    fn add_robustness(
        &self,
        s: &mut [Vec3<T>; 3],
        matrix: &SteeringMatrix<T, N>,
        weights: &[T; N],
    ) {
        let ([lambda, mu], [e_23, e_13, e_12]) = match self.inverse {
            Inverse::Exact => return,
            Inverse::SingularityRobust { lambda, mu } => ([lambda, mu], [zero(); 3]),
            Inverse::Generalised { lambda, mu, dither } => ([lambda, mu], dither),
        };
        // Of the joints that may move.
        let mut moving = *matrix;
        for (column, weight) in moving.columns.iter_mut().zip(weights) {
            if *weight == zero() {
                *column = vector(zeros());
            }
        }
        let measure = moving.measure(self.reference);
        let size = lambda * exponential(-(mu * measure)) * self.reference * self.reference;
        let one = one();
        let e = [[one, e_12, e_13], [e_12, one, e_23], [e_13, e_23, one]];
        for (row, e) in s.iter_mut().zip(e) {
            *row = add(*row, e.map(|element| size * element));
        }
    }
}

/// Commands with their torque error; an error where they are not finite.
pub(super) fn allocation<T: Scalar, const N: usize>(
    matrix: &SteeringMatrix<T, N>,
    commands: [T; N],
    demand: Vec3<T>,
    bounded: usize,
) -> Result<Allocation<T, N>, SteeringError<T>> {
    let torque_error = sub(demand, product(&matrix.columns, &commands));
    if commands.iter().chain(&torque_error).all(|number| number.is_finite()) {
        Ok(Allocation { commands, torque_error: vector(torque_error), bounded })
    } else {
        Err(SteeringError::Overflow)
    }
}

/// e to a power, by its nearest `f64`: a weight, of which no derivative is kept.
fn exponential<T: Scalar>(power: T) -> T {
    T::from_f64(libm::exp(power.to_f64()))
}
