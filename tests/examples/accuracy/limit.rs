//! Summary of a sweep: where the bound holds and is exceeded, where the solver rejects.

use precess_tests::accuracy::AccuracyAtDistance;
use precess_tests::bounds::{ACCELERATIONS_MEDIAN, ACCELERATIONS_WORST};

/// The figures of a sweep that runs from where the bound holds to where it is lost.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Limit {
    /// Worst error and its bound.
    pub(crate) worst: Bound,
    /// Median error and its bound.
    pub(crate) median: Bound,
    /// The first distance at which the solver rejects a spacecraft.
    pub(crate) rejected: Option<f64>,
    /// The first distance at which it rejects all.
    pub(crate) all_rejected: Option<f64>,
    /// By which power of the distance the median error grows where its bound is lost.
    pub(crate) power: Option<f64>,
}

/// Where a bound holds and is lost.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Bound {
    /// The last distance up to which it holds.
    pub(crate) holds: Option<f64>,
    /// The first distance at which it is lost.
    pub(crate) lost: Option<f64>,
}

impl Limit {
    pub(crate) fn of_rows(rows: &[AccuracyAtDistance]) -> Self {
        let first = |is: &dyn Fn(&AccuracyAtDistance) -> bool| rows.iter().find(|row| is(row));
        Self {
            worst: bound(rows, &|row| row.worst_block.worst() > ACCELERATIONS_WORST),
            median: bound(rows, &|row| row.worst_block.median() > ACCELERATIONS_MEDIAN),
            rejected: first(&|row| row.rejected > 0).map(|row| row.distance),
            all_rejected: first(&|row| row.solved == 0).map(|row| row.distance),
            power: power(rows),
        }
    }
}

fn bound(rows: &[AccuracyAtDistance], exceeds: &dyn Fn(&AccuracyAtDistance) -> bool) -> Bound {
    let lost = rows.iter().position(exceeds);
    let solved = rows.iter().filter(|row| row.rejected == 0).count();
    let holds = lost.unwrap_or(solved).checked_sub(1).and_then(|last| rows.get(last));
    Bound {
        holds: holds.map(|row| row.distance),
        lost: lost.and_then(|first| rows.get(first)).map(|row| row.distance),
    }
}

/// The slope of the straight line through the medians, by least squares of the logarithms, over the
/// distances at which the bound of the median is lost and nothing is rejected.
#[expect(clippy::cast_precision_loss, reason = "a sweep has few distances")]
fn power(rows: &[AccuracyAtDistance]) -> Option<f64> {
    let lost = |row: &&AccuracyAtDistance| {
        row.rejected == 0 && row.worst_block.median() > ACCELERATIONS_MEDIAN
    };
    let points: Vec<_> = rows
        .iter()
        .filter(lost)
        .map(|row| [row.distance, row.worst_block.median()].map(libm::log10))
        .collect();
    let mean = |k: usize| points.iter().map(|point| point[k]).sum::<f64>() / points.len() as f64;
    let [x, y] = [mean(0), mean(1)];
    let along = |f: &dyn Fn(f64, f64) -> f64| points.iter().map(|p| f(p[0] - x, p[1] - y)).sum();
    let (products, squares): (f64, f64) = (along(&|x, y| x * y), along(&|x, _| x * x));
    (points.len() > 2).then(|| products / squares)
}
