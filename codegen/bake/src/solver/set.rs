//! What the templates of a set of kinds are filled from.

use precess_codegen::emit::capital;
use precess_codegen::kinds::Kind;
use precess_description::Description;
use serde::Serialize;
use tera::Context;

use crate::error::BakeError;

/// Devices of one kind in a row: an array of the emitted records.
#[derive(Serialize)]
struct Run {
    kind: &'static str,
    upper: String,
    title: String,
    /// Its array.
    member: String,
    /// Names of its devices.
    names: String,
    count: usize,
    /// Its first device, and its first joint.
    device: usize,
    first: usize,
}

/// A joint in the emitted enumeration.
#[derive(Serialize)]
struct JointName {
    name: String,
    doc: String,
    #[serde(skip)]
    of: [String; 2],
}

/// What the files of a set say.
pub(super) fn context(
    description: &Description,
    kinds: &[&'static Kind],
    distinct: &[&'static Kind],
) -> Result<Context, BakeError> {
    let upper = description.name.to_uppercase();
    let (mut runs, mut joints): (Vec<Run>, Vec<JointName>) = (Vec::new(), Vec::new());
    for (number, (device, kind)) in description.device.iter().zip(kinds).enumerate() {
        if let Some(run) = runs.last_mut().filter(|run| run.kind == kind.name) {
            run.count += 1;
            run.names = format!("{}, {}", run.names, device.name);
        } else {
            let before = runs.iter().filter(|run| run.kind == kind.name).count();
            let member = match before {
                0 => kind.name.to_owned(),
                before => format!("{}_{}", kind.name, before + 1),
            };
            runs.push(Run {
                kind: kind.name,
                upper: kind.name.to_uppercase(),
                title: capital(kind.title),
                member,
                names: device.name.clone(),
                count: 1,
                device: number,
                first: joints.len(),
            });
        }
        for link in kind.links {
            let title = link.body.title;
            let name = format!("{upper}_{}_{}", device.name, title.replace([' ', '-'], "_"));
            let (name, of) = (name.to_uppercase(), [device.name.clone(), title.to_owned()]);
            if let Some(other) = joints.iter().find(|joint| joint.name == name) {
                return Err(BakeError::SameName(other.of.clone(), of, name));
            }
            joints.push(JointName { name, doc: format!("{}: {title}", device.name), of });
        }
    }
    let mut context = Context::new();
    let title = if description.title.is_empty() { &description.name } else { &description.title };
    // An end of a comment would be that of C.
    context.insert("title", &title.replace("*/", "* /"));
    context.insert("name", &description.name);
    context.insert("upper", &upper);
    context.insert("devices", &kinds.len());
    context.insert("joints", &joints.len());
    context.insert("joint_names", &joints);
    context.insert("runs", &runs);
    context.insert("kinds", &distinct.iter().map(|kind| kind.name).collect::<Vec<_>>());
    Ok(context)
}
