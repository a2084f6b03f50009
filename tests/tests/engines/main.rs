//! The solver against engines that nobody of this project wrote. The stored values need no Python;
//! `cargo xtask engines` computes them anew.

mod dgvscmg;
mod gyros;
mod kinds;
mod wheels;
