//! The solver as C99 for a set of kinds: nothing is assumed of the parameters, which stay arguments.
//!
//! Kernels are those of the kinds, as for everybody; to each comes a file that checks, gathers and
//! calls them, and to the set one that adds devices up and takes steps. One emission serves every
//! spacecraft with these kinds in this order, and has the bits of the Rust library.

mod kind;
mod set;

use precess_codegen::emit::{EmittedFile, c as emit_c};
use precess_codegen::kinds::{KINDS, Kind};
use precess_description::Description;

use crate::error::BakeError;
use crate::shape::check_name;
use crate::templates::templates;

/// The templates; one that another includes is before it.
const TEMPLATES: [(&str, &str); 12] = [
    ("kind.h", include_str!("../templates/solver/kind.h.tera")),
    ("kind_jvp.c", include_str!("../templates/solver/kind_jvp.c.tera")),
    ("kind.c", include_str!("../templates/solver/kind.c.tera")),
    ("set.h", include_str!("../templates/solver/set.h.tera")),
    ("set_jvp.c", include_str!("../templates/solver/set_jvp.c.tera")),
    ("stability.c", include_str!("../templates/solver/stability.c.tera")),
    ("step.c", include_str!("../templates/solver/step.c.tera")),
    ("set.c", include_str!("../templates/solver/set.c.tera")),
    ("batch.h", include_str!("../templates/solver/batch.h.tera")),
    ("batch.c", include_str!("../templates/solver/batch.c.tera")),
    ("batch.cu", include_str!("../templates/solver/batch.cu.tera")),
    ("README.md", include_str!("../templates/solver/README.md.tera")),
];

/// The solver of the kinds of a spacecraft, in the order of its devices.
///
/// # Errors
/// When a device is of no kind or has another number of bodies than its kind; when the name is one of the
/// emitted files' or of a header of C; when two joints have the same name in C.
pub fn solver(description: &Description) -> Result<Vec<EmittedFile>, BakeError> {
    let [kinds, distinct] = kinds(description)?;
    let tera = templates(&TEMPLATES);
    let mut files = emit_c::shared()?;
    files.extend(emit_c::solver());
    let mut render = |path: String, template: &str, context: &tera::Context| {
        let text = tera.render(template, context).map_err(|error| BakeError::Emit(error.into()))?;
        files.push(EmittedFile { path, text });
        Ok::<(), BakeError>(())
    };
    for kind in &distinct {
        let context = kind::context(kind)?;
        for end in ["h", "c"] {
            let path = format!("precess_{}_device.{end}", kind.name);
            render(path, &format!("kind.{end}"), &context)?;
        }
    }
    let (name, context) = (&description.name, set::context(description, &kinds, &distinct)?);
    render(format!("{name}.h"), "set.h", &context)?;
    render(format!("{name}.c"), "set.c", &context)?;
    render("README.md".to_owned(), "README.md", &context)?;
    for kind in &distinct {
        files.extend(emit_c::of_kind(kind)?);
    }
    Ok(files)
}

/// What batches of states add to the files of [`solver`]: kernels for CUDA and for a loop in C99.
///
/// # Errors
/// Those of [`solver`].
pub fn batch(description: &Description) -> Result<Vec<EmittedFile>, BakeError> {
    let [kinds, distinct] = kinds(description)?;
    let tera = templates(&TEMPLATES);
    let name = &description.name;
    let mut context = set::context(description, &kinds, &distinct)?;
    let mut files = emit_c::batch();
    let sources = solver(description)?.into_iter().map(|file| file.path);
    let sources = sources.filter(|path| path.rsplit('.').next() == Some("c"));
    let sources: Vec<_> = sources.chain([format!("{name}_batch.c")]).collect();
    context.insert("sources", &sources);
    for end in ["h", "c", "cu"] {
        let text = tera.render(&format!("batch.{end}"), &context);
        let text = text.map_err(|error| BakeError::Emit(error.into()))?;
        files.push(EmittedFile { path: format!("{name}_batch.{end}"), text });
    }
    Ok(files)
}

/// The kinds of the devices, in their order, and each of them once.
fn kinds(description: &Description) -> Result<[Vec<&'static Kind>; 2], BakeError> {
    check_name(&description.name)?;
    let kinds = description.device.iter().map(|device| {
        let unknown = || BakeError::Kind(device.name.clone(), device.kind.clone());
        let kind = *KINDS.iter().find(|kind| kind.name == device.kind).ok_or_else(unknown)?;
        let (expected, found) = (kind.links.len(), device.body.len());
        if expected == found {
            Ok(kind)
        } else {
            Err(BakeError::Bodies(device.name.clone(), expected, found))
        }
    });
    let kinds = kinds.collect::<Result<Vec<&'static Kind>, BakeError>>()?;
    let mut distinct: Vec<&'static Kind> = Vec::new();
    for kind in &kinds {
        if !distinct.iter().any(|known| known.name == kind.name) {
            distinct.push(kind);
        }
    }
    Ok([kinds, distinct])
}
