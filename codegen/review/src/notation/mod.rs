//! How the paper writes things: names, equations and normal forms as LaTeX; units are those of
//! [`precess_codegen::unit`].
//!
//! - `name`: a code name and the symbol it stands for, `r_wc_b_dprime` and `r''_{W_c/B}`;
//! - `tex`: pieces of LaTeX that know their width and how tightly they bind;
//! - `syntax`: the blocks of the pages, from their Rust syntax;
//! - `terms`: normal forms.

mod name;
mod syntax;
mod terms;
mod tex;

pub use name::{Accent, frame, symbol};
pub use precess_codegen::unit::{Balance, Unit, unit};
pub use syntax::{equation, expression, side_by_side};
pub use terms::terms;
pub use tex::aligned;
