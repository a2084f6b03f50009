//! Peak, RMS and final value of every recorded motor torque and load.

use crate::record::columns::Quantity;
use crate::report::blocks::{Block, table};
use crate::report::{Report, number};

/// The table; empty where neither torques nor loads are recorded.
pub(in crate::report) fn loads(report: &Report) -> Vec<Block> {
    let Some(collected) = &report.collected else { return Vec::new() };
    let columns = collected.header.columns.iter().zip(&collected.extremes).enumerate();
    let rows: Vec<_> = columns
        .filter(|(_, (column, _))| {
            matches!(column.quantity, Quantity::Torque(_)) || column.quantity.is_load()
        })
        .map(|(index, (column, extremes))| {
            let last = collected.row.get(index).copied().unwrap_or(f64::NAN);
            let cells = vec![
                column.name.clone(),
                column.frame.clone().unwrap_or_default(),
                column.unit.to_owned(),
                number::significant(extremes.peak, 4),
                number::time(extremes.peak_time),
                number::significant(extremes.rms(), 4),
                number::significant(last, 4),
            ];
            ("", cells)
        })
        .collect();
    if rows.is_empty() {
        return Vec::new();
    }
    let headings = [
        ("Column", ""),
        ("Expressed in", ""),
        ("Unit", ""),
        ("Largest magnitude", ""),
        ("At", "s"),
        ("RMS", ""),
        ("At the end", ""),
    ];
    let mut blocks = vec![table("Motor torques and loads across joints", &headings, 3..7, rows)];
    if !collected.header.columns.iter().any(|column| column.quantity.is_load()) {
        let text = "Loads across joints and mounts are recorded where output.columns lists \
                    `loads` or a device's `name.loads`.";
        blocks.push(Block::Note { text: text.to_owned() });
    }
    blocks
}
