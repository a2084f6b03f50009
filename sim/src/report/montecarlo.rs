//! Picture of a Monte Carlo campaign: the empirical distribution of a number.

use super::draw::picture::Picture;
use super::draw::plane::Plane;
use super::number::with_unit;
use super::sweep::{LIMIT_SHOWN, scaled};
use crate::spectra::float;

/// The share of samples that do not exceed a value, over the value, with the limit as a vertical line.
pub(crate) fn distribution(
    name: &str,
    unit: (&str, f64),
    sorted: &[f64],
    limit: Option<f64>,
) -> Picture {
    let (unit, size) = scaled(unit, sorted.iter().copied());
    let count = float(sorted.len().max(1));
    let mut steps = Vec::new();
    for (index, value) in sorted.iter().enumerate() {
        steps.push([value / size, float(index) / count]);
        steps.push([value / size, float(index + 1) / count]);
    }
    let mut curves = vec![("samples".to_owned(), steps)];
    // A limit far away would leave no room for the samples.
    let most = sorted.iter().map(|value| value.abs()).fold(0.0, f64::max);
    let near = limit.filter(|limit| *limit <= LIMIT_SHOWN * most);
    if let Some(limit) = near {
        curves.push(("limit".to_owned(), vec![[limit / size, 0.0], [limit / size, 1.0]]));
    }
    Picture::Plane(Plane {
        description: format!("Share of samples over {name}, in {unit}."),
        title: match limit.filter(|_| near.is_none()) {
            Some(limit) => {
                let limit = with_unit(limit / size, 6, &unit);
                format!("{name}: distribution of {} samples, limit {limit}", sorted.len())
            }
            None => format!("{name}: distribution of {} samples", sorted.len()),
        },
        axes: [format!("{name} ({unit})"), "Share of samples".to_owned()],
        curves,
        lines: Vec::new(),
        dots: Vec::new(),
        marks: Vec::new(),
        large: true,
        logarithmic: false,
        ranges: [None, Some([0.0, 1.02])],
    })
}
