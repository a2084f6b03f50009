//! Where an attitude or an angle jumps to its other value of the same rotation: modified Rodrigues parameters at the length 1, angles
//! at half a turn. A curve is interrupted there; else it would be a vertical line.

use std::f64::consts::PI;

use super::chart::DrawnCurve;
use crate::record::columns::Quantity;

/// From one sample to the next a component changes by more than this, SI, only by a jump: half of the range of what has one.
///
/// At a jump of three components one of them is at least 1/√3 of their length, and changes by twice that.
pub(super) fn jump(quantity: Quantity) -> Option<f64> {
    match quantity {
        Quantity::Sigma(_) | Quantity::PointSigma(..) => Some(1.0),
        Quantity::HubRotation(_)
        | Quantity::Rotation(..)
        | Quantity::EulerAngle(_)
        | Quantity::OrbitAngle(_) => Some(PI),
        _ => None,
    }
}

/// One jump is found in this many buckets in a row at most: in its own, and by the first sample of the next.
const OF_ONE: usize = 2;

/// Interrupts curves in the buckets in which one of them jumps; their first samples stay. Where more buckets in a row have jumps,
/// the chart does not resolve them: the band stays.
pub(super) fn interrupt(curves: &mut [DrawnCurve], jump: f64) {
    let count = curves.iter().map(|curve| curve.min.len()).max().unwrap_or(0);
    let jumps = |bucket: usize| {
        curves.iter().any(|curve| {
            let at = |values: &[f64], index: usize| values.get(index).copied().unwrap_or(f64::NAN);
            let within = at(&curve.max, bucket) - at(&curve.min, bucket);
            let from = bucket
                .checked_sub(1)
                .map_or(0.0, |before| (at(&curve.first, bucket) - at(&curve.first, before)).abs());
            within > jump || from > jump
        })
    };
    let found: Vec<usize> = (0..count).filter(|bucket| jumps(*bucket)).collect();
    let runs = found.chunk_by(|before, after| before + 1 == *after);
    let found: Vec<usize> = runs.filter(|run| run.len() <= OF_ONE).flatten().copied().collect();
    for curve in curves {
        for bucket in &found {
            for values in [&mut curve.min, &mut curve.max] {
                if let Some(value) = values.get_mut(*bucket) {
                    *value = f64::NAN;
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::run::chart::Curve;

    fn drawn(min: &[f64], max: &[f64], first: &[f64]) -> DrawnCurve {
        let [min, max, first] = [min, max, first].map(<[f64]>::to_vec);
        let (name, label, frame) = (String::new(), String::new(), String::new());
        let curve = Curve { column: 0, name, label, frame, departure: false };
        DrawnCurve { curve, min, max, first, last: 0.0 }
    }

    #[test]
    fn all_curves_are_interrupted_where_one_jumps() {
        let jumping = [0.5, 0.9, -0.9, -0.5];
        let steady = [0.1, 0.2, -0.2, -0.1];
        let mut curves = [&jumping, &steady].map(|values| drawn(values, values, values));
        interrupt(&mut curves, 1.0);
        for (curve, values) in curves.iter().zip([jumping, steady]) {
            let finite: Vec<bool> = curve.min.iter().map(|value| value.is_finite()).collect();
            assert_eq!(finite, [true, true, false, true]);
            assert_eq!(curve.first, values);
        }
        // Within a bucket.
        let mut curves = [drawn(&[0.5, -1.0, -0.8], &[0.7, 1.0, -0.5], &[0.5, 0.8, -0.8])];
        interrupt(&mut curves, 1.2);
        assert!(curves[0].max[1].is_nan() && curves[0].max[0] == 0.7);
        // A turn in each bucket: a band, not a blank chart.
        let mut curves = [drawn(&[-1.0; 5], &[1.0; 5], &[0.5, -0.9, 0.4, -0.2, 0.9])];
        interrupt(&mut curves, 1.0);
        assert!(curves[0].max.iter().all(|value| value.is_finite()));
        assert!(jump(Quantity::Energy).is_none() && jump(Quantity::Sigma(0)).is_some());
    }
}
