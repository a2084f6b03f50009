//! Writes docs/imbalance-map.md and its picture: where the usual `U_s Omega^2` errs.
//!
//! ```text
//! cargo run --release -p precess --example imbalance_map
//! ```
//!
//! `cargo test -p precess --test jitter map` compares both with what this writes.

mod page;
mod picture;

use std::path::Path;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let docs = Path::new(env!("CARGO_MANIFEST_DIR")).join("../docs");
    std::fs::write(docs.join("imbalance-map.md"), page::page()?)?;
    std::fs::write(docs.join("imbalance-map.svg"), picture::picture()?)?;
    Ok(())
}
