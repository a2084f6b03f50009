//! Kernels of one spacecraft: derived, proven and emitted with what its parameters say beforehand.
//!
//! A spacecraft knows more than a kind: offsets that are zero, moments that are equal, mounts that
//! are none or a few turns, joints that are locked for good, devices that are alike. [`bake`] finds
//! that in a [`Description`], derives each kernel with it by the same generator, proves what it
//! emits against the general derivation under the same substitution, and lays out a crate without
//! dependencies or C99. Values stay parameters: the emitted constructor takes them, and refuses
//! those that break what was assumed. With [`Options::constants`] they are folded, too.
//!
//! Pure: no file is read or written here.

mod assumed;
#[allow(unreachable_pub, reason = "public where they are emitted")]
mod by_hand;
mod c;
mod constants;
mod error;
mod evaluate;
mod fold;
mod mount;
mod numbers;
mod options;
mod parameters;
mod records_c;
mod reference;
mod rust;
mod shape;
mod solver;
mod sources;
mod spacecraft;
mod templates;
mod test_values;
mod values;

use precess_codegen::emit::EmittedFile;
use precess_codegen::proof::Comparison;
pub use precess_description::Description;

pub use error::BakeError;
pub use options::{Language, Options};
pub use shape::{HUB_OPERATIONS, Operations, SUM_OPERATIONS};
pub use solver::{batch, solver};

/// What is emitted of a spacecraft.
pub struct Baked {
    /// The files, by paths from the folder that they are for.
    pub files: Vec<EmittedFile>,
    /// One row for each claim.
    pub proof: Vec<Comparison>,
    /// What is assumed, a line for each.
    pub assumptions: Vec<String>,
    /// Operations of an evaluation.
    pub operations: Operations,
}

/// Derives, proves and lays out the kernels of a spacecraft.
///
/// # Errors
/// When a device is of no kind, has another number of bodies than its kind, or breaks what the kind
/// itself says; when a claim does not hold, which is a fault of the generator.
pub fn bake(description: &Description, options: Options) -> Result<Baked, BakeError> {
    let shapes = shape::shapes(description)?;
    let derived = shapes.iter().map(|shape| shape.derived(options));
    let derived: Vec<_> = derived.collect::<Result<_, _>>()?;
    let proof: Vec<Comparison> =
        derived.iter().flat_map(|derived| derived.proof.iter().cloned()).collect();
    if let Some(row) = proof.iter().find(|row| !row.holds()) {
        return Err(BakeError::NotProven(row.to_string()));
    }
    let operations = shape::operations(&shapes, &derived)?;
    let assumptions = shapes.iter().flat_map(shape::Shape::assumptions).collect();
    let mut whole =
        spacecraft::context(description, &shapes, &derived, operations, options.constants);
    if options.constants {
        constants::fold(description, &shapes, &derived, &mut whole)?;
    }
    let files = match options.language {
        Language::Rust => rust::files(description, &shapes, &derived, &whole)?,
        Language::C => c::files(description, &shapes, &derived, whole)?,
    };
    Ok(Baked { files, proof, assumptions, operations })
}
