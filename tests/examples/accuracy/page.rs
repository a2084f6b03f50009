//! The page: `docs/accuracy.md`.

use std::error::Error;

use precess_tests::accuracy::{AccuracyAtDistance, SPACECRAFT};
use precess_tests::bounds::{
    ACCELERATIONS_MEDIAN, ACCELERATIONS_WORST, DERIVATIVES_MEDIAN, DERIVATIVES_WORST,
    WHEELS_BESIDE_BASILISK,
};
use precess_tests::random::MOST_DEVICES;
use serde::Serialize;
use tera::{Context, Tera};

use crate::limit::Limit;
use crate::{Beside, Derivatives, Sweeps};

/// A sweep in a line.
#[derive(Serialize)]
struct Line {
    name: &'static str,
    worst_holds: String,
    worst_lost: String,
    median_holds: String,
    median_lost: String,
    rejected: String,
    all_rejected: String,
    power: String,
    /// Whether the error grows as the square of the distance or of its reciprocal.
    square: bool,
}

/// A distance from the pose.
#[derive(Serialize)]
struct Posed {
    distance: String,
    kinds: [Cells; 2],
    square: String,
    linear: String,
}

/// A distance of the centre of mass from B.
#[derive(Serialize)]
struct Moved {
    distance: String,
    whole: Cells,
    r_b_n_ddot: String,
    omega_dot: String,
    joints: String,
    square: String,
}

/// Of all blocks.
#[derive(Serialize)]
struct Cells {
    worst: String,
    median: String,
    rejected: usize,
}

/// A kind without the pose.
#[derive(Serialize)]
struct Other {
    name: &'static str,
    cells: Cells,
}

/// Derivatives by one kind of variable.
#[derive(Serialize)]
struct Differentiated {
    by: &'static str,
    worst: String,
    median: String,
    spacecraft: u64,
}

/// A quantity of the run beside Basilisk.
#[derive(Serialize)]
struct Compared {
    quantity: &'static str,
    largest: String,
    error: String,
}

/// The text of the page.
pub(crate) fn page(
    sweeps: &Sweeps,
    beside: &Beside,
    derivatives: &[Derivatives; 2],
) -> Result<String, Box<dyn Error>> {
    let [dgvscmg, balanced] = [&sweeps.dgvscmg, &sweeps.balanced].map(|rows| Limit::of_rows(rows));
    let offset = Limit::of_rows(&sweeps.offset);
    let mut context = Context::new();
    context.insert("worst", &format!("{ACCELERATIONS_WORST:e}"));
    context.insert("median", &format!("{ACCELERATIONS_MEDIAN:e}"));
    context.insert("spacecraft", &SPACECRAFT);
    context.insert("with_devices", &(SPACECRAFT - SPACECRAFT.div_ceil(MOST_DEVICES as u64 + 1)));
    context.insert("dgvscmg", &line("`dgvscmg`", &dgvscmg, -2.0, radians));
    context.insert("balanced", &line("`balanced_dgvscmg`", &balanced, -2.0, radians));
    context.insert("offset", &line("`dgvscmg`", &offset, 2.0, metres));
    context.insert("posed", &posed(&sweeps.dgvscmg, &sweeps.balanced));
    context.insert("moved", &sweeps.offset.iter().map(moved).collect::<Vec<_>>());
    let others = sweeps.others.iter().map(|(name, row)| Other { name, cells: cells(row) });
    context.insert("others", &others.collect::<Vec<_>>());
    let least = sweeps.others.first().map_or(0.0, |(_, row)| row.distance);
    context.insert("least", &radians(least));
    let names = ["states and inputs", "parameters"];
    let differentiated = names.into_iter().zip(derivatives).map(|(by, of)| Differentiated {
        by,
        worst: error(of.worst),
        median: error(of.median),
        spacecraft: of.spacecraft,
    });
    context.insert("derivatives", &differentiated.collect::<Vec<_>>());
    context.insert("derivatives_worst", &format!("{DERIVATIVES_WORST:e}"));
    context.insert("derivatives_median", &format!("{DERIVATIVES_MEDIAN:e}"));
    let Beside { stored, differences } = beside;
    context.insert("basilisk", &stored.basilisk);
    context.insert("steps", &stored.steps);
    context.insert("step", &format!("{} ms", stored.step * 1e3));
    context.insert("beside_bound", &format!("{WHEELS_BESIDE_BASILISK:e}"));
    let compared = differences.iter().map(|found| Compared {
        quantity: found.quantity,
        largest: format!("{:.3} {}", found.largest, found.unit).trim_end_matches(" 1").to_owned(),
        error: error(found.error),
    });
    context.insert("compared", &compared.collect::<Vec<_>>());
    let mut tera = Tera::default();
    tera.autoescape_on(Vec::<&str>::new());
    tera.add_raw_template("page", include_str!("accuracy.md.tera"))?;
    Ok(tera.render("page", &context)?)
}

fn line(name: &'static str, limit: &Limit, square: f64, unit: fn(f64) -> String) -> Line {
    let of = |distance: Option<f64>| distance.map_or_else(|| "nowhere".to_owned(), unit);
    let power = limit.power.unwrap_or(0.0);
    Line {
        name,
        worst_holds: of(limit.worst.holds),
        worst_lost: of(limit.worst.lost),
        median_holds: of(limit.median.holds),
        median_lost: of(limit.median.lost),
        rejected: of(limit.rejected),
        all_rejected: of(limit.all_rejected),
        power: format!("{power:.2}"),
        square: (power - square).abs() < 0.1,
    }
}

fn posed(dgvscmg: &[AccuracyAtDistance], balanced: &[AccuracyAtDistance]) -> Vec<Posed> {
    let row = |(dgvscmg, balanced): (&AccuracyAtDistance, &AccuracyAtDistance)| Posed {
        distance: shortest(dgvscmg.distance),
        kinds: [cells(dgvscmg), cells(balanced)],
        square: error(f64::EPSILON / (dgvscmg.distance * dgvscmg.distance)),
        linear: error(f64::EPSILON / dgvscmg.distance),
    };
    dgvscmg.iter().zip(balanced).map(row).collect()
}

fn moved(row: &AccuracyAtDistance) -> Moved {
    let worst = |figures: &precess_tests::blocks::Figures| {
        if row.solved == 0 { "-".to_owned() } else { error(figures.worst()) }
    };
    Moved {
        distance: metres(row.distance),
        whole: cells(row),
        r_b_n_ddot: worst(&row.r_b_n_ddot),
        omega_dot: worst(&row.omega_dot),
        joints: worst(&row.joints),
        square: error(f64::EPSILON * row.distance * row.distance),
    }
}

/// A dash where nothing is solved.
fn cells(row: &AccuracyAtDistance) -> Cells {
    let some = |value: f64| if row.solved == 0 { "-".to_owned() } else { error(value) };
    let (worst, median) = (row.worst_block.worst(), row.worst_block.median());
    Cells { worst: some(worst), median: some(median), rejected: row.rejected }
}

fn error(value: f64) -> String {
    format!("{value:.1e}")
}

/// Plain where that is short.
fn shortest(value: f64) -> String {
    if value < 1e-3 { format!("{value:e}") } else { format!("{value}") }
}

fn radians(value: f64) -> String {
    format!("{} rad", shortest(value))
}

fn metres(value: f64) -> String {
    if value < 1e3 { format!("{value} m") } else { format!("{} km", value / 1e3) }
}
