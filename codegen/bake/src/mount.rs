//! The form of a mount: the fewest turns about coordinate axes, between quarter turns.
//!
//! Where the turns are stated, it is a matter of their axes only, and found in integers; else it is
//! found in the numbers, within four epsilons.

use precess_codegen::derivation::chain::assumed::{Exchange, Mount, Turns};
use precess_description::{Axis, Turn};

use crate::parameters::is_rounding;

/// The fewest turns that make a mount, by its numbers.
pub(crate) fn found(mount: &[[f64; 3]; 3]) -> Mount {
    search(mount, 1.0, |off| is_rounding(off, 1.0))
}

/// The fewest turns that make a mount of these turns, whatever their angles are.
pub(crate) fn stated(turns: &[Turn]) -> Mount {
    // Quarter turns go to the front, where they exchange the axes of the turns before them; turns
    // about one axis are one.
    let mut quarters = UNIT;
    let mut axes: Vec<usize> = Vec::new();
    for turn in turns {
        let axis = turn.about as usize;
        let Some(count) = turn.quarters else {
            if axes.last() != Some(&axis) {
                axes.push(axis);
            }
            continue;
        };
        for _ in 0..count {
            let quarter = about(turn.about, [0.0, 1.0], 1.0);
            quarters = product(&quarters, &quarter);
            // Of Qt a Q, the row that is not zero where the axis was.
            let exchanged = |axis: &usize| {
                let row = quarter[*axis].iter().position(|entry| *entry != 0.0);
                row.unwrap_or(*axis)
            };
            axes = axes.iter().map(exchanged).collect();
        }
    }
    if axes.len() > 2 {
        return Mount::Any;
    }
    // Angles that no other form has by chance: cosine and sine 3 / 5 and 4 / 5, 5 / 13 and 12 / 13.
    // Whole numbers times 65, so that equal is equal.
    let mut whole = quarters;
    let mut unit = 1.0;
    for (axis, [cos, sin, scale]) in axes.iter().zip([[3.0, 4.0, 5.0], [5.0, 12.0, 13.0]]) {
        let axis = [Axis::X, Axis::Y, Axis::Z][*axis];
        whole = product(&whole, &about(axis, [cos, sin], scale));
        unit *= scale;
    }
    search(&whole, unit, |off| off == 0.0)
}

const UNIT: [[f64; 3]; 3] = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];

/// A turn of this cosine and sine, all times a scale.
fn about(axis: Axis, [cos, sin]: [f64; 2], scale: f64) -> [[f64; 3]; 3] {
    match axis {
        Axis::X => [[scale, 0.0, 0.0], [0.0, cos, -sin], [0.0, sin, cos]],
        Axis::Y => [[cos, 0.0, sin], [0.0, scale, 0.0], [-sin, 0.0, cos]],
        Axis::Z => [[cos, -sin, 0.0], [sin, cos, 0.0], [0.0, 0.0, scale]],
    }
}

fn product(a: &[[f64; 3]; 3], b: &[[f64; 3]; 3]) -> [[f64; 3]; 3] {
    let entry = |i: usize, j: usize| (0..3).map(|k| a[i][k] * b[k][j]).sum();
    [0, 1, 2].map(|i| [0, 1, 2].map(|j| entry(i, j)))
}

/// The first form, of the fewest turns, that a mount times `unit` has.
fn search(mount: &[[f64; 3]; 3], unit: f64, vanishes: impl Fn(f64) -> bool + Copy) -> Mount {
    let exchanges = Exchange::every();
    for turns in [Turns::None, Turns::One, Turns::Two] {
        for &outer in &exchanges {
            for &inner in &exchanges {
                if has_form(turned(mount, outer, inner), turns, unit, vanishes) {
                    return Mount::Turned { outer, turns, inner };
                }
            }
        }
    }
    Mount::Any
}

/// R of `P R Q`.
fn turned(mount: &[[f64; 3]; 3], outer: Exchange, inner: Exchange) -> [[f64; 3]; 3] {
    let entry = |row: usize, column: usize| {
        // Each column of P and each row of Q has one entry that is not zero.
        let mut sum = 0.0;
        for (i, own) in mount.iter().enumerate() {
            for (j, value) in own.iter().enumerate() {
                sum += f64::from(outer.entry(i, row) * inner.entry(column, j)) * value;
            }
        }
        sum
    };
    [0, 1, 2].map(|row| [0, 1, 2].map(|column| entry(row, column)))
}

/// Whether R, times a unit, has this form.
fn has_form(
    r: [[f64; 3]; 3],
    turns: Turns,
    unit: f64,
    vanishes: impl Fn(f64) -> bool + Copy,
) -> bool {
    let [[xx, xy, _], [yx, yy, _], [zx, _, zz]] = r;
    let (ca, sa, cb, sb) = match turns {
        Turns::None => (unit, 0.0, unit, 0.0),
        Turns::One => (xx, yx, unit, 0.0),
        Turns::Two => (yy, -xy, zz, -zx),
    };
    let whole = [
        [ca * cb, -sa * unit, ca * sb],
        [sa * cb, ca * unit, sa * sb],
        [-sb * unit, 0.0, cb * unit],
    ];
    let mut pairs = r.as_flattened().iter().zip(whole.as_flattened());
    pairs.all(|(entry, made)| vanishes(entry * unit - made))
}

#[cfg(test)]
mod tests {
    use precess_description::Axis;

    use super::*;

    fn product(a: [[f64; 3]; 3], b: [[f64; 3]; 3]) -> [[f64; 3]; 3] {
        let entry = |i: usize, j: usize| (0..3).map(|k| a[i][k] * b[k][j]).sum();
        [0, 1, 2].map(|i| [0, 1, 2].map(|j| entry(i, j)))
    }

    fn about_z(angle: f64) -> [[f64; 3]; 3] {
        let (s, c) = angle.sin_cos();
        [[c, -s, 0.0], [s, c, 0.0], [0.0, 0.0, 1.0]]
    }

    fn about_y(angle: f64) -> [[f64; 3]; 3] {
        let (s, c) = angle.sin_cos();
        [[c, 0.0, s], [0.0, 1.0, 0.0], [-s, 0.0, c]]
    }

    fn turns(of: &[[f64; 3]; 3]) -> Option<Turns> {
        match found(of) {
            Mount::Any => None,
            Mount::Turned { turns, .. } => Some(turns),
        }
    }

    #[test]
    fn a_mount_is_found_to_be_the_fewest_turns() {
        let quarter = about_z(std::f64::consts::FRAC_PI_2);
        assert_eq!(turns(&quarter), Some(Turns::None));
        assert_eq!(turns(&product(quarter, about_y(0.3))), Some(Turns::One));
        let two = product(about_z(0.7), about_y(0.3));
        assert_eq!(turns(&two), Some(Turns::Two));
        assert_eq!(turns(&product(two, about_z(0.2))), None);
        // Axes exchanged before and after: each form is found in any place.
        let cyclic = [[0.0, 1.0, 0.0], [0.0, 0.0, 1.0], [1.0, 0.0, 0.0]];
        assert_eq!(turns(&product(product(cyclic, two), cyclic)), Some(Turns::Two));
    }

    #[test]
    fn a_mount_of_stated_turns_has_their_form_whatever_the_angles() {
        use precess_description::Axis::{X, Y, Z};
        let turn = |(about, quarters): (Axis, u8)| {
            let quarters = Some(quarters).filter(|quarters| *quarters > 0);
            Turn { about, quarters }
        };
        let form = |list: &[(Axis, u8)]| stated(&list.iter().map(|t| turn(*t)).collect::<Vec<_>>());
        let count = |list: &[(Axis, u8)]| match form(list) {
            Mount::Any => None,
            Mount::Turned { turns, .. } => Some(turns.angles().len()),
        };
        assert_eq!(count(&[]), Some(0));
        assert_eq!(count(&[(X, 1), (Z, 3), (Y, 2)]), Some(0));
        assert_eq!(count(&[(X, 1), (Z, 0), (Y, 2)]), Some(1));
        // About the same axis, also by a quarter turn between them.
        assert_eq!(count(&[(X, 0), (X, 0), (X, 1)]), Some(1));
        assert_eq!(count(&[(Z, 0), (X, 1), (Y, 0)]), Some(1));
        assert_eq!(count(&[(Z, 0), (X, 1), (Z, 0)]), Some(2));
        assert_eq!(count(&[(Z, 0), (Y, 0), (X, 3)]), Some(2));
        assert_eq!(count(&[(Z, 0), (Y, 0), (X, 0)]), None);
        // The form is the one that is found in numbers with these turns.
        let two = product(about_z(0.7), about_y(0.3));
        assert_eq!(form(&[(Z, 0), (Y, 0)]), found(&two));
        let cyclic = [[0.0, 1.0, 0.0], [0.0, 0.0, 1.0], [1.0, 0.0, 0.0]];
        let exchanged = product(about_z(0.7), product(cyclic, about_z(0.4)));
        assert_eq!(form(&[(Z, 0), (Y, 3), (Z, 3), (Z, 0)]), found(&exchanged));
    }

    #[test]
    fn a_mount_off_by_more_than_rounding_is_any() {
        let mut nearly = about_z(0.7);
        nearly[0][2] = 1e-14;
        assert_eq!(turns(&nearly), None);
    }
}
