//! Every term counts: drop or flip one term of any equation, on either side, and the proof names
//! exactly that term.

mod emitted;
#[path = "../folder/mod.rs"]
mod folder;
mod kernel_pages;
mod pages;
mod sites;

use precess_codegen::page::Page;

/// The hand-checked pages.
fn hand_checked() -> Vec<Page> {
    folder::pages("")
}
