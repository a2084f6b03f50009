//! The bill of materials of a package: the crates that are linked into it, as `CycloneDX` 1.5. The same crates give the same
//! bytes: neither a time nor a serial number is in it.

use serde_json::{Value, json};

use super::archive::Package;
use super::tool;
use crate::crates_of::{Crate, Metadata};

/// The bill of a package of ours, for what is distributed under a name.
/// `lines` are those of [`linked_by`](crate::crates_of::linked_by).
pub(super) fn bill(
    metadata: &Metadata,
    (package, lines): (&str, &str),
    name: &str,
) -> Result<Package, String> {
    let linked = metadata.linked(lines);
    let crates: Vec<_> = metadata.crates().filter(|one| linked.contains_key(one.id)).collect();
    let reference = |id: &str| crates.iter().find(|one| one.id == id).map(purl).unwrap_or_default();
    let mut components: Vec<_> = crates
        .iter()
        .filter(|one| one.name != package || one.source.is_some())
        .map(component)
        .collect();
    components.sort_by_key(|one| one["bom-ref"].to_string());
    let mut dependencies: Vec<_> = linked
        .iter()
        .map(|(id, needs)| {
            let mut needs: Vec<_> = needs.iter().map(|id| reference(id)).collect();
            needs.sort();
            json!({"ref": reference(id), "dependsOn": needs})
        })
        .collect();
    dependencies.sort_by_key(|one| one["ref"].to_string());
    let mut own = component(&metadata.package(package)?);
    let is_program = [tool::PACKAGE, tool::GENERATOR].contains(&package);
    own["type"] = json!(if is_program { "application" } else { "library" });
    let bill = json!({
        "bomFormat": "CycloneDX",
        "specVersion": "1.5",
        "version": 1,
        "metadata": {"component": own},
        "components": components,
        "dependencies": dependencies,
    });
    let text = serde_json::to_string_pretty(&bill).map_err(|error| format!("{name}: {error}"))?;
    Ok(Package { name: format!("{name}.cdx.json"), bytes: (text + "\n").into_bytes() })
}

fn component(one: &Crate<'_>) -> Value {
    let mut component = json!({
        "type": "library",
        "bom-ref": purl(one),
        "name": one.name,
        "version": one.version,
        "purl": purl(one),
    });
    if !one.licence.is_empty() {
        // What older manifests separate by a slash is a choice.
        component["licenses"] = json!([{"expression": one.licence.replace('/', " OR ")}]);
    }
    component
}

/// Its address in the form of package URLs.
fn purl(one: &Crate<'_>) -> String {
    format!("pkg:cargo/{}@{}", one.name, one.version)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::crates_of::tests::metadata;

    #[test]
    fn a_bill_has_what_is_linked_and_by_what() {
        let bill =
            bill(&metadata(), ("root", "root v0.1.0\na v1.0.0\nc v1.0.0"), "root-0.1.0").unwrap();
        assert_eq!(bill.name, "root-0.1.0.cdx.json");
        let bill: Value = serde_json::from_slice(&bill.bytes).unwrap();
        let names: Vec<_> =
            bill["components"].as_array().unwrap().iter().map(|one| &one["name"]).collect();
        assert_eq!(names, ["a", "c"]);
        assert_eq!(bill["components"][1]["licenses"][0]["expression"], "Zlib OR MIT");
        assert_eq!(bill["metadata"]["component"]["purl"], "pkg:cargo/root@0.1.0");
        assert_eq!(
            bill["dependencies"][0],
            json!({"ref": "pkg:cargo/a@1.0.0", "dependsOn": ["pkg:cargo/c@1.0.0"]})
        );
    }
}
