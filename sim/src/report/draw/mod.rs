//! Figures as SVG: axes and what is drawn over them.
//!
//! Invariant: equal numbers give equal bytes.

pub(super) mod axes;
pub(in crate::report) mod bode;
pub mod cells;
pub(super) mod curves;
pub(super) mod figure;
pub(super) mod fitted_lines;
mod legend;
pub(super) mod log_panel;
pub(crate) mod mode_shapes;
mod phases;
pub(crate) mod picture;
pub(crate) mod plane;
pub(crate) mod response;
mod scale_bar;
pub(crate) mod spectrum;
pub(super) mod ticks;
pub(super) mod waterfall;
