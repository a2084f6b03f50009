//! The parameters of a kind, and what is left of them where something is assumed.

use super::records::Record;
use crate::derivation::chain::Chain;
use crate::derivation::chain::assumed::{Mount, mount_entry};
use crate::kinds::{Centre, Kind, Link, Motion};
use crate::space::ENTRIES;

/// What a device is made of.
#[must_use]
pub fn parameters(kind: &Kind) -> Record {
    let mut record =
        Record::new("Parameters", "What the device is made of: mount, masses, places, inertias.");
    for (row, column) in (0..3).flat_map(|row| (0..3).map(move |column| (row, column))) {
        let (of, axis) = (["x", "y", "z"][column], ["bx", "by", "bz"][row]);
        let doc = format!("The device's {of} axis expressed in B, {axis} component, 1.");
        record.field(mount_entry(row, column), doc);
    }
    for link in kind.links {
        link_parameters(link, &mut record);
    }
    record
}

/// What is left of the parameters of a chain where something is assumed of them: the turns of the
/// mount for its entries, the coordinates of locked joints, nothing of what is zero.
#[must_use]
pub fn parameters_of(chain: &Chain<'_>) -> Record {
    let mut record = parameters(chain.kind);
    let angle = |record: &mut Record, name: &str, what: &str| {
        record.field(format!("sin_{name}"), format!("Sine of {what}, 1."));
        record.field(format!("cos_{name}"), format!("Cosine of {what}, 1."));
    };
    if let Some(assumed) = &chain.assumed {
        let known = |name: &String| assumed.zero.contains(name) || assumed.equal.contains_key(name);
        record.fields.retain(|field| !known(&field.name));
        if let Mount::Turned { turns, .. } = assumed.mount {
            record.fields.retain(|field| !field.name.starts_with("mount_"));
            for (name, what) in turns.angles().iter().zip(["first", "second"]) {
                angle(&mut record, name, &format!("the {what} turn of the mount"));
            }
        }
    }
    for link in chain.kind.links.iter().filter(|link| link.is_locked()) {
        let (name, title) = (link.joint.coordinate, link.body.title);
        match link.joint.motion {
            Motion::Turn(_) => angle(&mut record, name, &format!("the angle of the {title}")),
            Motion::Slide(_) => record.field(name, format!("Of the {title} along its joint, m.")),
        }
    }
    record
}

fn link_parameters(link: &Link, record: &mut Record) {
    let (joint, body) = (&link.joint, &link.body);
    let [letter, point] = body.letters;
    let mut place = |symbol: &str, names: [&str; 3], what: &str| {
        for (name, axis) in names.into_iter().zip(["first", "second", "third"]) {
            record.field(name, format!("{symbol}: {what}, {axis} component, m."));
        }
    };
    let carrier = format!("origin of the {}, expressed in the parent body's axes", body.title);
    if let Some(origin) = joint.place() {
        place(origin.symbol, origin.names, &carrier);
    }
    match body.centre {
        Centre::Free(triple) => {
            place(triple.symbol, triple.names, &format!("centre of mass of the {}", body.title));
        }
        Centre::On(axis, name) => record.field(
            name,
            format!("{name}: centre of mass of the {} on its {axis:?} axis, m.", body.title),
        ),
        Centre::At => {}
    }
    if let Some(mass) = body.mass {
        record.field(mass, format!("m_{letter}: mass of the {}, kg.", body.title));
    }
    let doc = format!("[I_{{{letter},{point}}}]: inertia of the {}, its own axes", body.title);
    let names = body.inertia.names();
    for (k, name) in names.iter().enumerate() {
        let Some(name) = name.as_ref().filter(|name| !names[..k].contains(&Some((*name).clone())))
        else {
            continue;
        };
        let same = names.iter().zip(ENTRIES).filter(|(other, _)| other.as_ref() == Some(name));
        let entries: Vec<_> = same.map(|(_, entry)| entry).collect();
        let entry = if entries.len() == 1 { "entry" } else { "entries" };
        record.field(name.clone(), format!("{doc}, {entry} {}, kg m².", entries.join(" and ")));
    }
}
