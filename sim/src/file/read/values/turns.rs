//! The turns that a mount is written as: which there are about coordinate axes, whatever their
//! angles. Numbers say so within rounding only; the words of a scenario say it exactly.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use nalgebra::{Matrix3, Vector3};
use precess_description::{Axis, Turn};

/// A mount, whose columns are the device's axes at zero angles, expressed in B.
#[derive(Clone, Debug)]
pub(in crate::file::read) struct Mount {
    pub(in crate::file::read) matrix: Matrix3<f64>,
    /// First from the hub; none where it is written as numbers, or about another axis.
    pub(in crate::file::read) turns: Option<Vec<Turn>>,
}

/// A product of at most this many epsilons is rounding of zero.
const RIGHT_ANGLE: f64 = 4.0 * f64::EPSILON;

/// A turn by an angle about a coordinate axis; nothing where it is none.
pub(in crate::file::read) fn turn(axis: usize, angle: f64) -> Option<Turn> {
    match quarters(angle) {
        Some(0) => None,
        quarters => Some(Turn { about: named(axis), quarters }),
    }
}

/// Whole quarter turns; nothing where it is zero turns.
pub(in crate::file::read) fn by_quarters(axis: usize, quarters: u8) -> Option<Turn> {
    let quarters = quarters % 4;
    (quarters > 0).then(|| Turn { about: named(axis), quarters: Some(quarters) })
}

/// How many quarter turns an angle is, to the bit of one of the units that it is written in.
fn quarters(angle: f64) -> Option<u8> {
    (-8_i8..=8).find_map(|k| {
        let (turns, degrees) = (f64::from(k) / 4.0, f64::from(k) * 90.0);
        let ways = [f64::from(k) * FRAC_PI_2, degrees * (PI / 180.0), turns * TAU];
        let whole = u8::try_from(k.rem_euclid(4)).unwrap_or_default();
        ways.contains(&angle).then_some(whole)
    })
}

fn named(axis: usize) -> Axis {
    match axis % 3 {
        0 => Axis::X,
        1 => Axis::Y,
        _ => Axis::Z,
    }
}

/// The coordinate axis that a vector is along, and whether it is against it.
pub(in crate::file::read) fn coordinate(v: &Vector3<f64>) -> Option<(usize, bool)> {
    let mut others = (0..3).filter(|k| v[*k] != 0.0);
    match (others.next(), others.next()) {
        (Some(axis), None) => Some((axis, v[axis] < 0.0)),
        _ => None,
    }
}

/// The turn about an axis, where that is a coordinate axis.
pub(in crate::file::read) fn about(axis: &Vector3<f64>, angle: f64) -> Option<Vec<Turn>> {
    let (axis, against) = coordinate(axis)?;
    Some(turn(axis, if against { -angle } else { angle }).into_iter().collect())
}

/// The turns of a mount two of whose columns, by their numbers, are along these vectors. Of a
/// component that is zero as written it is known that it is; none where there is no such.
pub(in crate::file::read) fn of_columns(
    columns: [usize; 2],
    vectors: [&Vector3<f64>; 2],
) -> Option<Vec<Turn>> {
    let [v, w] = vectors.map(|v| *v);
    if let (Some(first), Some(second)) = (coordinate(&v), coordinate(&w)) {
        return Some(exchange(columns, [first, second]));
    }
    for ([a, b], [v, _]) in [(columns, [v, w]), ([columns[1], columns[0]], [w, v])] {
        // One along an axis: the other turns about it.
        if let Some((axis, against)) = coordinate(&v) {
            let free = Turn { about: named(axis), quarters: None };
            let rest = exchange([a, b], [(axis, against), ((axis + 1) % 3, false)]);
            return Some([vec![free], rest].concat());
        }
    }
    for ([a, b], [v, w]) in [(columns, [v, w]), ([columns[1], columns[0]], [w, v])] {
        // One across an axis s: turned about s from the next axis p, and the other about p.
        let Some(s) = (0..3).find(|k| v[*k] == 0.0) else { continue };
        let (p, q) = ((s + 1) % 3, (s + 2) % 3);
        let first = Turn { about: named(s), quarters: None };
        if w[s] == 0.0 {
            let against = v.cross(&w)[s] < 0.0;
            let rest = exchange([a, b], [(p, false), (q, against)]);
            return Some([vec![first], rest].concat());
        }
        let second = Turn { about: named(p), quarters: None };
        let rest = exchange([a, b], [(p, false), (q, false)]);
        return Some([vec![first, second], rest].concat());
    }
    None
}

/// Of two directions at right angles within rounding, whether their zeros are as written.
pub(in crate::file::read) fn are_at_right_angles(product: f64) -> bool {
    product.abs() <= RIGHT_ANGLE
}

/// Quarter turns that put columns along coordinate axes, or against them.
pub(in crate::file::read) fn exchange(columns: [usize; 2], along: [(usize, bool); 2]) -> Vec<Turn> {
    let is_so = |m: &Matrix3<i8>| {
        let pairs = columns.iter().zip(along);
        pairs.into_iter().all(|(column, (row, against))| {
            m[(row % 3, column % 3)] == if against { -1 } else { 1 }
        })
    };
    let every = (0..4).flat_map(|z| (0..4).flat_map(move |y| (0..4).map(move |x| [z, y, x])));
    let found = every
        .into_iter()
        .find(|[z, y, x]| is_so(&(quarter(2, *z) * quarter(1, *y) * quarter(0, *x))));
    let turns = found.into_iter().flat_map(|quarters| [2, 1, 0].into_iter().zip(quarters));
    turns.filter_map(|(axis, count)| by_quarters(axis, count)).collect()
}

/// So many quarter turns about an axis.
fn quarter(axis: usize, count: u8) -> Matrix3<i8> {
    let mut one = Matrix3::zeros();
    let [a, b] = [1, 2].map(|k| (axis + k) % 3);
    (one[(axis, axis)], one[(a, b)], one[(b, a)]) = (1, -1, 1);
    (0..count).fold(Matrix3::identity(), |made, _| made * one)
}

#[cfg(test)]
mod tests {
    use nalgebra::Rotation3;

    use super::*;

    fn rotation(turns: &[Turn], angles: &[f64]) -> Matrix3<f64> {
        let mut angles = angles.iter();
        turns.iter().fold(Matrix3::identity(), |made, turn| {
            let angle = match turn.quarters {
                Some(quarters) => f64::from(quarters) * FRAC_PI_2,
                None => *angles.next().expect("an angle for each turn"),
            };
            let axis = Vector3::ith_axis(turn.about as usize);
            made * Rotation3::from_axis_angle(&axis, angle).into_inner()
        })
    }

    #[test]
    fn quarter_turns_are_known_in_each_unit_and_nothing_near_is() {
        let degrees = |x: f64| x * (PI / 180.0);
        for (angle, count) in [(0.0, 0), (degrees(90.0), 1), (degrees(-90.0), 3), (PI, 2)] {
            assert_eq!(quarters(angle), Some(count), "{angle}");
        }
        assert_eq!(quarters(degrees(270.0)), Some(3));
        assert_eq!(quarters(1e-17), None);
        assert_eq!(quarters(FRAC_PI_2 * (1.0 + 4.0 * f64::EPSILON)), None);
    }

    #[test]
    fn two_columns_along_axes_are_exchanged() {
        let signs = [false, true];
        for (a, row) in (0..3).flat_map(|a| (0..3).map(move |row| (a, row))) {
            for (first, second) in signs.iter().flat_map(|f| signs.iter().map(move |s| (*f, *s))) {
                let (columns, rows) = ([a, (a + 1) % 3], [row, (row + 2) % 3]);
                let turns = exchange(columns, [(rows[0], first), (rows[1], second)]);
                let made = rotation(&turns, &[]);
                for (k, sign) in [first, second].into_iter().enumerate() {
                    let expected = if sign { -1.0 } else { 1.0 };
                    assert!((made[(rows[k], columns[k])] - expected).abs() < 1e-15);
                }
            }
        }
    }

    #[test]
    fn zeros_of_directions_are_turns() {
        let [x, slant, skew] =
            [[1.0, 0.0, 0.0], [0.6, 0.8, 0.0], [1.0, 2.0, 3.0]].map(Vector3::from);
        let count = |v: &Vector3<f64>, w: &Vector3<f64>| {
            let turns = of_columns([0, 1], [v, w])?;
            Some(turns.iter().filter(|turn| turn.quarters.is_none()).count())
        };
        assert_eq!(count(&x, &Vector3::z()), Some(0));
        assert_eq!(count(&x, &Vector3::new(0.0, 3.0, -1.0)), Some(1));
        assert_eq!(count(&slant, &Vector3::new(-0.8, 0.6, 0.0)), Some(1));
        assert_eq!(count(&slant, &Vector3::new(-0.8, 0.6, 5.0)), Some(2));
        assert_eq!(count(&skew, &Vector3::new(0.0, 3.0, -2.0)), Some(2));
        assert_eq!(count(&skew, &Vector3::new(1.0, 1.0, -1.0)), None);
    }
}
