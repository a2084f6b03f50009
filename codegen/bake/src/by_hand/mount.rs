//! A mount that was assumed to be a few turns: `P R Q` with P and Q made of quarter turns.

use super::check::{Assumption, vanishes};

/// A rotation by whole quarter turns, row by row: -1, 0 or 1.
pub(crate) type Exchange = [[i8; 3]; 3];

/// Sines and cosines of the turns of R, which has this many.
pub(crate) struct Turned {
    pub(crate) sin_a: f64,
    pub(crate) cos_a: f64,
    pub(crate) sin_b: f64,
    pub(crate) cos_b: f64,
}

/// The turns of a mount: none, `Rz(a)`, or `Rz(a) Ry(b)`.
pub(crate) fn turned(
    mount: &[[f64; 3]; 3],
    outer: &Exchange,
    inner: &Exchange,
    turns: usize,
) -> Result<Turned, Assumption> {
    let entry = |row: usize, column: usize| {
        let mut sum = 0.0;
        for (i, own) in mount.iter().enumerate() {
            for (j, value) in own.iter().enumerate() {
                sum += f64::from(outer[i][row] * inner[column][j]) * value;
            }
        }
        sum
    };
    let r = [0, 1, 2].map(|row| [0, 1, 2].map(|column| entry(row, column)));
    let (cos_a, sin_a) = match turns {
        0 => (1.0, 0.0),
        1 => (r[0][0], r[1][0]),
        _ => (r[1][1], -r[0][1]),
    };
    let (cos_b, sin_b) = if turns < 2 { (1.0, 0.0) } else { (r[2][2], -r[2][0]) };
    let whole = [
        [cos_a * cos_b, -sin_a, cos_a * sin_b],
        [sin_a * cos_b, cos_a, sin_a * sin_b],
        [-sin_b, 0.0, cos_b],
    ];
    for (own, made) in r.iter().zip(&whole) {
        for (own, made) in own.iter().zip(made) {
            vanishes("mount", "of the turns stated", own - made, 1.0)?;
        }
    }
    Ok(Turned { sin_a, cos_a, sin_b, cos_b })
}
