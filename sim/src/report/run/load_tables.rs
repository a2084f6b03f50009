//! Peak, RMS and final value of every recorded motor torque and load.

use crate::record::columns::Quantity;
use crate::report::blocks::{Block, table};
use crate::report::{Report, number};

/// The column of frames, and how many columns of numbers there are after the unit.
const FRAME: usize = 1;
const NUMBERS: usize = 4;

/// The table; empty where neither torques nor loads are recorded.
pub(in crate::report) fn loads(report: &Report) -> Vec<Block> {
    let Some(collected) = &report.collected else { return Vec::new() };
    let columns = collected.header.columns.iter().zip(&collected.extremes).enumerate();
    let mut rows: Vec<_> = columns
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
    let mut headings = vec![
        ("Column", ""),
        ("Expressed in", ""),
        ("Unit", ""),
        ("Largest magnitude", ""),
        ("At", "s"),
        ("RMS", ""),
        ("At the end", ""),
    ];
    // Torques about the axes of joints are in no frame: a column for frames only beside loads.
    if rows.iter().all(|(_, cells)| cells.get(FRAME).is_none_or(String::is_empty)) {
        headings.remove(FRAME);
        for (_, cells) in &mut rows {
            cells.remove(FRAME);
        }
    }
    let numbers = headings.len() - NUMBERS..headings.len();
    let mut blocks = vec![table("Motor torques and loads across joints", &headings, numbers, rows)];
    if !collected.header.columns.iter().any(|column| column.quantity.is_load()) {
        let text = "Loads across joints and mounts are recorded where output.columns lists \
                    `loads` or a device's `name.loads`.";
        blocks.push(Block::Note { text: text.to_owned() });
    }
    blocks
}
