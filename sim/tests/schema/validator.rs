//! A validator for the keywords of JSON Schema that the schema of scenario files uses: [`faults`].
//!
//! A keyword that it does not know is a fault, so a schema cannot pass by saying more than is
//! checked. (The crate `jsonschema` validates all of them, with 56 crates more to compile.)

use regex::Regex;
use serde_json::{Map, Value};

/// What is wrong with a value, each with its place; nothing if it is valid.
pub(crate) fn faults(schema: &Value, value: &Value) -> Vec<String> {
    let mut found = Vec::new();
    check(schema, schema, value, "", &mut found);
    found
}

fn check(schema: &Value, part: &Value, value: &Value, at: &str, found: &mut Vec<String>) {
    let Value::Object(keywords) = part else {
        found.push(format!("{at}: {part} is no schema"));
        return;
    };
    for (keyword, wanted) in keywords {
        match keyword.as_str() {
            // What they say is not about the value; additionalProperties needs its neighbour.
            "$schema" | "$defs" | "title" | "description" => {}
            "properties" => of_properties(schema, keywords, wanted, value, at, found),
            "additionalProperties" if *wanted == Value::Bool(false) => {}
            "items" => {
                for (index, item) in value.as_array().into_iter().flatten().enumerate() {
                    check(schema, wanted, item, &format!("{at}/{index}"), found);
                }
            }
            "$ref" => match wanted.as_str().and_then(|to| schema.pointer(to.trim_matches('#'))) {
                Some(part) => check(schema, part, value, at, found),
                None => found.push(format!("{at}: no definition {wanted}")),
            },
            "anyOf" => {
                let branches = wanted.as_array().map_or(&[][..], Vec::as_slice);
                let fails = |branch: &Value| {
                    let mut faults = Vec::new();
                    check(schema, branch, value, at, &mut faults);
                    !faults.is_empty()
                };
                if branches.iter().all(fails) {
                    found.push(format!("{at}: {value} is none of {wanted}"));
                }
            }
            _ if holds(keyword, wanted, value) => {}
            _ => found.push(format!("{at}: {value} has not `{keyword}` {wanted}")),
        }
    }
}

/// The keys of a table, each by its part of the schema.
fn of_properties(
    schema: &Value,
    keywords: &Map<String, Value>,
    properties: &Value,
    value: &Value,
    at: &str,
    found: &mut Vec<String>,
) {
    let closed = keywords.get("additionalProperties") == Some(&Value::Bool(false));
    for (key, value) in value.as_object().into_iter().flatten() {
        let at = format!("{at}/{key}");
        match properties.get(key) {
            Some(part) => check(schema, part, value, &at, found),
            None if closed => found.push(format!("{at}: an unknown key")),
            None => {}
        }
    }
}

/// Whether a value has what a keyword without a schema in it wants.
fn holds(keyword: &str, wanted: &Value, value: &Value) -> bool {
    let bound = wanted.as_f64();
    // A keyword for values of another type holds.
    let length = |holds: fn(u64, u64) -> bool| match (value.as_array(), wanted.as_u64()) {
        (Some(list), Some(bound)) => holds(list.len().try_into().unwrap_or(u64::MAX), bound),
        (None, Some(_)) => true,
        (_, None) => false,
    };
    let number = |holds: fn(f64, f64) -> bool| match (value.as_f64(), bound) {
        (Some(number), Some(bound)) => holds(number, bound),
        (None, Some(_)) => true,
        (_, None) => false,
    };
    match keyword {
        "type" => match wanted.as_str() {
            Some("object") => value.is_object(),
            Some("array") => value.is_array(),
            Some("string") => value.is_string(),
            Some("boolean") => value.is_boolean(),
            Some("number") => value.is_number(),
            Some("integer") => value.is_i64() || value.is_u64(),
            _ => false,
        },
        "const" => value == wanted,
        "enum" => wanted.as_array().is_some_and(|words| words.contains(value)),
        "pattern" => match (wanted.as_str().map(Regex::new), value.as_str()) {
            (Some(Ok(pattern)), Some(text)) => pattern.is_match(text),
            (Some(Ok(_)), None) => true,
            _ => false,
        },
        "required" => match (wanted.as_array(), value.as_object()) {
            (Some(keys), Some(table)) => {
                keys.iter().all(|key| key.as_str().is_some_and(|key| table.contains_key(key)))
            }
            (keys, _) => keys.is_some(),
        },
        "minItems" => length(|length, bound| length >= bound),
        "maxItems" => length(|length, bound| length <= bound),
        "minimum" => number(|number, bound| number >= bound),
        "maximum" => number(|number, bound| number <= bound),
        _ => false,
    }
}

#[cfg(test)]
mod tests {
    use serde_json::json;

    use super::faults;

    #[test]
    fn each_keyword_has_a_value_that_it_refuses() {
        let table = json!({ "properties": { "a": { "type": "string" } },
            "additionalProperties": false, "required": ["a"] });
        let by_name = json!({ "$defs": { "one": { "const": 1 } }, "$ref": "#/$defs/one" });
        for (schema, valid, invalid) in [
            (json!({ "type": "integer" }), json!(1), json!(1.5)),
            (json!({ "enum": ["a", "b"] }), json!("b"), json!("c")),
            (json!({ "pattern": "^[a-z]+$" }), json!("ab"), json!("a1")),
            (json!({ "minItems": 2, "maxItems": 3 }), json!([1, 2]), json!([1])),
            (json!({ "minItems": 2, "maxItems": 3 }), json!([1, 2]), json!([1, 2, 3, 4])),
            (json!({ "minimum": 2, "maximum": 3 }), json!(2), json!(1)),
            (json!({ "minimum": 2, "maximum": 3 }), json!(3), json!(4)),
            (json!({ "items": { "type": "number" } }), json!([1, 2.5]), json!([1, "2"])),
            (json!({ "anyOf": [{ "type": "string" }, { "const": 1 }] }), json!(1), json!(2)),
            (table.clone(), json!({ "a": "x" }), json!({})),
            (table.clone(), json!({ "a": "x" }), json!({ "a": "x", "b": 1 })),
            (table, json!({ "a": "x" }), json!({ "a": 1 })),
            (by_name, json!(1), json!(2)),
        ] {
            assert_eq!(faults(&schema, &valid), Vec::<String>::new(), "{schema}");
            assert_ne!(faults(&schema, &invalid), Vec::<String>::new(), "{schema} {invalid}");
        }
        assert_ne!(faults(&json!({ "maxLength": 1 }), &json!("a")), Vec::<String>::new());
    }
}
