//! [`Projection`]: which components of a vector a requirement limits.

use std::ops::{Add, Mul};

use nalgebra::{Unit, Vector3};

/// Which components of a vector a requirement limits.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Projection {
    /// All of them; of a column, itself.
    #[default]
    None,
    /// The one along a direction: of a rotation vector the rotation about it.
    Along(Unit<Vector3<f64>>),
    /// Those at right angles to a direction: of a rotation vector how far a line of sight in that direction turns.
    Across(Unit<Vector3<f64>>),
}

impl Projection {
    /// Its key in a scenario file, and the direction.
    #[must_use]
    pub fn key(&self) -> Option<(&'static str, Unit<Vector3<f64>>)> {
        match self {
            Self::None => None,
            Self::Along(direction) => Some(("along", *direction)),
            Self::Across(direction) => Some(("across", *direction)),
        }
    }

    /// A vector with the direction, in words: `rotation across [0, 0, 1]`.
    #[must_use]
    pub fn of_quantity(&self, quantity: &str) -> String {
        self.key().map_or_else(
            || quantity.to_owned(),
            |(key, n)| {
                let [x, y, z] = [n.x, n.y, n.z].map(|part| (1e4 * part).round() / 1e4 + 0.0);
                format!("{quantity} {key} [{x}, {y}, {z}]")
            },
        )
    }

    /// Components of a vector as components that are limited; numbers of another count as they are.
    pub(crate) fn of(&self, values: Vec<f64>) -> Vec<f64> {
        self.of_numbers(values, |number| number)
    }

    /// The same of numbers with derivatives.
    pub(crate) fn of_numbers<T>(&self, values: Vec<T>, constant: impl Fn(f64) -> T) -> Vec<T>
    where
        T: Copy + Add<Output = T> + Mul<Output = T>,
    {
        let &[x, y, z] = values.as_slice() else { return values };
        let along = |n: &Vector3<f64>| x * constant(n.x) + y * constant(n.y) + z * constant(n.z);
        match self {
            Self::None => values,
            Self::Along(n) => vec![along(n)],
            Self::Across(n) => across(n).iter().map(along).collect(),
        }
    }

    /// How many components there are of a quantity of so many columns.
    pub(crate) fn components(&self, columns: usize) -> usize {
        match self {
            Self::Along(_) if columns == 3 => 1,
            Self::Across(_) if columns == 3 => 2,
            _ => columns,
        }
    }
}

/// Two directions at right angles to one, and to each other.
fn across(n: &Unit<Vector3<f64>>) -> [Vector3<f64>; 2] {
    // From the axis that is the farthest from it.
    let first = n.cross(&Vector3::ith(n.iamin(), 1.0)).normalize();
    [first, n.cross(&first)]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn along_and_across_are_the_components_of_a_vector() {
        let n = Unit::new_normalize(Vector3::new(1.0, -2.0, 2.0));
        let v = Vector3::new(0.3, 0.5, -0.7);
        let along = Projection::Along(n).of(v.as_slice().to_vec());
        assert!((along[0] - v.dot(&n)).abs() < 1e-15);
        let across = Projection::Across(n).of(v.as_slice().to_vec());
        assert_eq!([along.len(), across.len()], [1, 2]);
        let whole = [along[0], across[0], across[1]].iter().map(|part| part * part).sum::<f64>();
        assert!((whole - v.norm_squared()).abs() < 1e-15);
    }
}
