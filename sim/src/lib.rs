//! The desktop tool: scenarios, runs and reports.
