//! Arrays of wheels: the least largest command, and speeds to keep out of.

use nalgebra::Vector3;

use crate::numbers::real::{Scalar, zero};
use crate::numbers::vec3::{Vec3, components, cross, dot, scale, sub};
use crate::steering::error::SteeringError;
use crate::steering::law::{Allocation, SteeringLaw, allocation};
use crate::steering::matrix::{SteeringMatrix, product};

/// Speeds at which a wheel shakes what it must not, rad/s.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct KeepOut<T = f64> {
    /// Lower end.
    pub lower: T,
    /// Upper end.
    pub upper: T,
}

impl<T: Scalar> KeepOut<T> {
    /// The acceleration that leaves the band past its nearer end, rad/s^2: `gain` times the distance to a point that is a
    /// tenth of the band's width beyond it; zero outside. Speeds have a sign: a band of both turns is two. For
    /// [`SteeringLaw::null_motion`].
    #[must_use]
    pub fn acceleration(&self, speed: T, gain: T) -> T {
        if speed > self.lower && speed < self.upper {
            let (below, above) = (speed - self.lower, self.upper - speed);
            let beyond = T::from_f64(0.1) * (self.upper - self.lower);
            if below < above { -(gain * (below + beyond)) } else { gain * (above + beyond) }
        } else {
            zero()
        }
    }
}

impl<T: Scalar, const N: usize> SteeringMatrix<T, N> {
    /// Commands of which the largest is as small as it can be: the whole envelope of torque is used before one saturates.
    ///
    /// The largest command is `max |n . d| / sum |n . q|` over the normals n of planes through two columns (linear
    /// programming: a vertex of its dual). All columns outside that plane are at the largest command; those in it have
    /// the same problem in the plane. Markley, Reynolds, Liu, Lebsock (2010), Yoon (2014). The work grows as `N^3`.
    ///
    /// # Errors
    ///
    /// [`SteeringError::Singular`] where the columns are in one plane, [`SteeringError::Argument`],
    /// [`SteeringError::Overflow`].
    pub fn least_largest(&self, torque: &Vector3<T>) -> Result<Allocation<T, N>, SteeringError<T>> {
        let demand = SteeringLaw::exact().demand(self, torque)?;
        // Columns of order one: the normals below are products of several of them.
        let columns = self.columns.each_ref().map(components);
        let largest = columns.iter().fold(zero(), |most: T, q| most.max(dot(*q, *q))).sqrt();
        if !(largest.is_finite() && largest > zero()) {
            return Err(SteeringError::Singular { pivot: largest, bound: zero() });
        }
        let per = largest.recip();
        let q: [Vec3<T>; N] = columns.map(|column| scale(per, column));
        let demand = scale(per, demand);
        let mut commands = [zero(); N];
        let mut inside = [true; N];
        // The normal of a plane, then of a line in that plane; of what is along the line, the line itself.
        let (mut found, mut at) = (zero(), None);
        for (k, first) in q.iter().enumerate() {
            for second in q.iter().skip(k.saturating_add(1)) {
                let Some(normal) = unit_normal(*first, *second) else { continue };
                better(&q, &inside, normal, demand, &mut found, &mut at);
            }
        }
        let Some(normal) = at else {
            return Err(SteeringError::Singular { pivot: zero(), bound: zero() });
        };
        let mut left = settle(&q, &mut inside, normal, demand, &mut commands);
        let (mut found, mut at) = (zero(), None);
        for (column, _) in q.iter().zip(inside).filter(|(_, inside)| *inside) {
            let Some(across) = unit_normal(normal, *column) else { continue };
            better(&q, &inside, across, left, &mut found, &mut at);
        }
        if let Some(across) = at {
            left = settle(&q, &mut inside, across, left, &mut commands);
            let line = cross(across, normal);
            settle(&q, &mut inside, line, left, &mut commands);
        }
        // What rounding has left, by all of them.
        let law = SteeringLaw::exact();
        let demand = scale(largest, demand);
        let rest =
            law.inverted(self, &law.weights, sub(demand, product(&self.columns, &commands)))?;
        for (command, rest) in commands.iter_mut().zip(rest) {
            *command = *command + rest;
        }
        allocation(self, commands, demand, 0)
    }
}

/// Whether a column has a part along a unit normal. Two columns of a degree between them make a normal that is known to
/// some 60 epsilons.
fn is_across<T: Scalar>(column: Vec3<T>, normal: Vec3<T>) -> bool {
    dot(column, normal).abs() > T::from_f64(4096.0) * T::EPSILON
}

/// The unit normal of two directions; none where they are parallel to a hundredth of a degree, whose normal is rounding.
fn unit_normal<T: Scalar>(a: Vec3<T>, b: Vec3<T>) -> Option<Vec3<T>> {
    let normal = cross(a, b);
    let size = dot(normal, normal).sqrt();
    let both = (dot(a, a) * dot(b, b)).sqrt();
    (size > T::from_f64(2e-4) * both).then(|| scale(size.recip(), normal))
}

/// Keeps the direction along which the demand is the largest share of what the columns inside give.
fn better<T: Scalar, const N: usize>(
    q: &[Vec3<T>; N],
    inside: &[bool; N],
    normal: Vec3<T>,
    demand: Vec3<T>,
    found: &mut T,
    at: &mut Option<Vec3<T>>,
) {
    let along =
        q.iter().zip(inside).filter(|(column, inside)| **inside && is_across(**column, normal));
    let sum = along.fold(zero(), |sum: T, (column, _)| sum + dot(*column, normal).abs());
    if sum > zero() {
        let share = dot(demand, normal).abs() * sum.recip();
        if at.is_none() || share > *found {
            (*found, *at) = (share, Some(normal));
        }
    }
}

/// Sets the commands of the columns across a direction so that together they give the demand along it, all alike, and
/// returns what the others have to give.
fn settle<T: Scalar, const N: usize>(
    q: &[Vec3<T>; N],
    inside: &mut [bool; N],
    normal: Vec3<T>,
    demand: Vec3<T>,
    commands: &mut [T; N],
) -> Vec3<T> {
    let across = |column: &Vec3<T>, inside: bool| inside && is_across(*column, normal);
    let columns = q.iter().zip(inside.iter()).filter(|(column, inside)| across(column, **inside));
    let sum = columns.fold(zero(), |sum: T, (column, _)| sum + dot(*column, normal).abs());
    if sum == zero() {
        return demand;
    }
    let size = dot(demand, normal) * sum.recip();
    let mut left = demand;
    for ((column, inside), command) in q.iter().zip(inside).zip(commands) {
        if across(column, *inside) {
            *command = if dot(*column, normal) < zero() { -size } else { size };
            *inside = false;
            left = sub(left, scale(*command, *column));
        }
    }
    left
}
