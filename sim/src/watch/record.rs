//! [`watch`]: a whole record watched at once, in memory: every block, what each quantity was at first, what was left out. The command
//! keeps alarms only.

use super::error::WatchError;
use super::quantity::Watched;
use super::{Block, Watch, WatchSettings};
use crate::scenario::Scenario;
use crate::telemetry::{Exclusion, TelemetryRows};

/// A quantity of a record.
#[derive(Clone, Debug, PartialEq)]
pub struct RecordQuantity {
    /// Its name: `drag torque of rw1`.
    pub name: String,
    /// What it is.
    pub watched: Watched,
    /// Its mean over the reference, and the scatter about it by the stated variance; none where that was not taken.
    pub reference: Option<[f64; 2]>,
}

/// What a record says.
#[derive(Clone, Debug, PartialEq)]
pub struct WatchedRecord {
    /// Every quantity, in the order of [`Block::values`].
    pub quantities: Vec<RecordQuantity>,
    /// The blocks, in the order of time.
    pub blocks: Vec<Block>,
    /// What was left out of the telemetry.
    pub exclusions: Vec<Exclusion>,
    /// What is not watched, with the reason.
    pub remarks: Vec<String>,
}

/// Watches telemetry to its end. `hear` is called at the end of each block with its time, s; where it returns false the watch ends.
///
/// # Errors
///
/// As [`Watch::new`] and [`Watch::next_block`]; telemetry that cannot be read; an end by `hear`.
pub fn watch(
    scenario: &Scenario,
    rows: &mut TelemetryRows,
    settings: &WatchSettings,
    hear: &mut dyn FnMut(f64) -> bool,
) -> Result<WatchedRecord, WatchError> {
    let mut watch = Watch::new(scenario, rows.sensors(), settings)?;
    let mut blocks = Vec::new();
    while let Some(block) =
        watch.next_block(|| rows.next_reading().map_err(WatchError::Telemetry))?
    {
        let [_, end] = block.times;
        blocks.push(block);
        if !hear(end) {
            return Err(WatchError::Interrupted);
        }
    }
    let quantities = watch.quantities().zip(watch.references());
    let quantities = quantities.map(|((name, watched), reference)| RecordQuantity {
        name: name.to_owned(),
        watched: watched.clone(),
        reference,
    });
    Ok(WatchedRecord {
        quantities: quantities.collect(),
        blocks,
        exclusions: rows.exclusions().to_vec(),
        remarks: watch.remarks().to_vec(),
    })
}
