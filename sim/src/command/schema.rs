//! `schema`: the JSON Schema of scenario files.

use super::error::CommandError;
use super::exit::Exit;
use super::terminal::print;

/// The schema, as published.
pub(crate) const SCHEMA: &str = include_str!("../../schema/scenario-1.json");

pub(super) fn execute() -> Result<Exit, CommandError> {
    print(SCHEMA)?;
    Ok(Exit::Success)
}

#[cfg(test)]
mod tests {
    use precess_dynamics::BuiltInKind;
    use serde_json::Value;

    use super::SCHEMA;
    use crate::scenario::body_key;

    #[test]
    fn the_schema_has_every_kind_and_body() {
        let schema: Value = serde_json::from_str(SCHEMA).expect("JSON");
        let device = &schema["$defs"]["device"]["properties"];
        let listed = device["kind"]["enum"].as_array().expect("a list");
        let mut listed: Vec<_> = listed.iter().filter_map(Value::as_str).collect();
        let mut kinds: Vec<_> = BuiltInKind::ALL.iter().map(|kind| kind.name()).collect();
        listed.sort_unstable();
        kinds.sort_unstable();
        assert_eq!(listed, kinds);
        for joint in BuiltInKind::ALL.iter().flat_map(|kind| kind.joints()) {
            assert!(device.get(body_key(joint)).is_some(), "{}", joint.body);
        }
    }
}
