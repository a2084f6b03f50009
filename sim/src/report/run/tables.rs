//! The energy ledger, momentum at start and end, and the drifts with the meaning of their units.

use crate::record::columns::Quantity;
use crate::record::{Drift, Outcome};
use crate::report::blocks::{Block, table};
use crate::report::{Collected, Report, number};

/// What a drift is counted in.
const ENERGY_UNIT: &str = "largest sum of the terms of kinetic energy, ½ m (|v_B| + |ω × c|)² and so on, \
    plus the integral of Σ|u q̇|";
const MOMENTUM_UNIT: &str = "largest sum over the bodies of the magnitudes of the terms of their \
    momenta, as m (|v_B| + |ω × c|)";
/// What drifts say.
const MEANING: &str = "A drift is the largest departure from the start over a unit that cannot \
    vanish by cancellation. It measures the integration, not the model: rounding by itself gives 10⁻¹⁶ \
    to 10⁻¹³, and what exceeds that by far is the tolerance or the step.";
const NOT_CONSERVED: &str = "Momentum is not conserved here: gravity, a wrench, a source, a lumped \
    imbalance or what holds the hub acts from outside.";

/// The blocks of the energy section before its figures.
pub(in crate::report) fn energy(report: &Report, outcome: &Outcome) -> Vec<Block> {
    let mut blocks = vec![drifts(&outcome.drift)];
    let mut note = MEANING.to_owned();
    if outcome.drift.angular.is_none() {
        note = format!("{note} {NOT_CONSERVED}");
    }
    blocks.push(Block::Note { text: note });
    if let Some(collected) = &report.collected {
        blocks.extend(ledger(collected));
        blocks.extend(momentum(collected));
    }
    blocks
}

fn drifts(drift: &Drift) -> Block {
    let three = [
        ("Energy and losses less work", drift.energy, ENERGY_UNIT),
        ("Linear momentum", drift.linear, MOMENTUM_UNIT),
        ("Angular momentum about the inertial origin", drift.angular, MOMENTUM_UNIT),
    ];
    let rows = three.into_iter().map(|(what, drift, unit)| {
        let drift = drift.map_or_else(|| "–".to_owned(), |drift| number::significant(drift, 2));
        ("", vec![what.to_owned(), drift, unit.to_owned()])
    });
    let columns = [("Quantity", ""), ("Drift", ""), ("In units of the", "")];
    table("Drift of what is conserved", &columns, 1..2, rows)
}

fn ledger(collected: &Collected) -> Option<Block> {
    let of = collected.ledger?;
    let (first, last) = (&collected.first, &collected.row);
    let at = |row: &[f64], column: usize| row.get(column).copied().unwrap_or(f64::NAN);
    let lost = of.lost.map_or(0.0, |lost| at(last, lost));
    let sum = collected.header.columns.len();
    let rows = [
        ("Energy at the start", at(first, of.energy)),
        ("Work since the start", at(last, of.work)),
        ("Losses in brakes and end stops", lost),
        ("Energy at the end", at(last, of.energy)),
        ("Energy and losses less work, departure", at(last, sum) - at(first, sum)),
    ];
    let rows = rows.map(|(what, value)| ("", vec![what.to_owned(), number::significant(value, 9)]));
    let columns = [("Entry", ""), ("Energy", "J")];
    Some(table("Energy ledger of the whole run", &columns, 1..2, rows))
}

fn momentum(collected: &Collected) -> Option<Block> {
    let index = |quantity: Quantity| {
        collected.header.columns.iter().position(|column| column.quantity == quantity)
    };
    let two = [
        ("Linear", "kg m/s", Quantity::Linear as fn(usize) -> Quantity),
        ("Angular, about the inertial origin", "N m s", Quantity::Angular),
    ];
    let mut rows = Vec::new();
    for (what, unit, of) in two {
        let columns: Option<Vec<_>> = (0..3).map(|axis| index(of(axis))).collect();
        let Some(columns) = columns else { continue };
        for (when, row) in [("start", &collected.first), ("end", &collected.row)] {
            let values: Vec<_> =
                columns.iter().map(|c| row.get(*c).copied().unwrap_or(f64::NAN)).collect();
            let size = values.iter().map(|value| value * value).sum::<f64>().sqrt();
            let mut cells = vec![format!("{what}, at the {when}"), unit.to_owned()];
            cells.extend(values.iter().chain([&size]).map(|v| number::significant(*v, 9)));
            rows.push(("", cells));
        }
    }
    let columns =
        [("Momentum", ""), ("Unit", ""), ("x", ""), ("y", ""), ("z", ""), ("Magnitude", "")];
    (!rows.is_empty()).then(|| table("Momentum, expressed in N", &columns, 2..6, rows))
}
