//! What the page of one run shows: charts, tables, replay, verdicts.

pub(super) mod chart;
mod chart_texts;
mod control_charts;
mod controllers;
pub(super) mod extremes;
pub(super) mod grouping;
pub(super) mod limits;
pub(super) mod load_tables;
pub(super) mod mass;
pub(super) mod replay;
pub(super) mod requirements;
pub(super) mod settling;
mod slow_motion;
pub(super) mod summary;
pub(super) mod tables;
mod wraps;
