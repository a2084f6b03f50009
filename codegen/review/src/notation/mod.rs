//! How the paper writes things: names, equations, normal forms and units as LaTeX.
//!
//! - `name`: a code name and the symbol it stands for, `r_wc_b_dprime` and `r''_{W_c/B}`;
//! - `tex`: pieces of LaTeX that know their width and how tightly they bind;
//! - `syntax`: the blocks of the pages, from their Rust syntax;
//! - `terms`: normal forms;
//! - `unit`: the unit of an expression, worked out from those of its symbols.

mod name;
mod syntax;
mod terms;
mod tex;
mod unit;

pub use name::{Accent, frame, symbol};
pub use syntax::{equation, expression, side_by_side};
pub use terms::terms;
pub use tex::aligned;
pub use unit::{Balance, Unit, unit};
