//! Whichever input of a spacecraft changes, the comparison with the engines notices.

use precess_tests::blocks::largest;
use precess_tests::bounds::ACCELERATIONS_WORST;
use serde_json::Value;

use super::claim::Blocks;
use super::solver::Case;
use super::stored::{self, Evaluated};

/// What every input is changed by, of its magnitude or of [`LEAST`]: a thousand times
/// [`ACCELERATIONS_WORST`].
const CHANGE: f64 = 1e-8;

/// The least magnitude that is drawn at unit scales; a product of inertia may come out smaller.
const LEAST: f64 = 0.3;

/// The inputs of a stored spacecraft.
const INPUTS: [&str; 7] = ["hub", "devices", "omega", "r_b_n_dot", "force", "torque_b", "gravity"];

/// At unit scales no contribution is hidden by a larger one.
#[test]
fn comparison_notices_every_input_of_every_kind_at_unit_scales() {
    let file: Value = serde_json::from_str(&stored::text()).expect("JSON");
    let crafts = file["spacecraft"].as_array().expect("a list");
    let with_everything = crafts.iter().filter(|craft| {
        craft["group"] == "passive" && craft["name"].as_str().is_some_and(|n| n.contains("unit"))
    });
    let mut seen = 0;
    for craft in with_everything {
        seen += 1;
        let mut inputs = Vec::new();
        for part in INPUTS {
            collect_numbers(&craft[part], &format!("/{part}"), &mut inputs);
        }
        // The mount is the identity, and a quaternion of another length is the same mount.
        inputs.retain(|pointer| !pointer.contains("/mount/"));
        // The second transverse moment of a balanced wheel changes with the first.
        inputs.retain(|pointer| {
            let joint = pointer.strip_suffix("/inertia/5").and_then(|joint| craft.pointer(joint));
            joint.is_none_or(|joint| !is_balanced(&joint["inertia"]))
        });
        let mut least = (f64::INFINITY, String::new());
        for pointer in inputs {
            let mut changed = craft.clone();
            if !change(&mut changed, &pointer) {
                continue;
            }
            // A balanced wheel has one transverse moment.
            if let Some(of_wheel) = pointer.strip_suffix("/inertia/3")
                && is_balanced(&craft.pointer(of_wheel).expect("a joint")["inertia"])
            {
                change(&mut changed, &format!("{of_wheel}/inertia/5"));
            }
            let changed: Evaluated = serde_json::from_value(changed).expect("numbers for numbers");
            let noticed = noticed(&changed);
            assert!(
                noticed > ACCELERATIONS_WORST,
                "{}: {pointer} changed by {CHANGE:e} moves nothing by more than {noticed:e}",
                changed.craft.name
            );
            if noticed < least.0 {
                least = (noticed, pointer);
            }
        }
        println!("{}: least noticed {}, by {:.1e}", craft["name"], least.1, least.0);
    }
    if stored::is_stored() {
        assert_eq!(seen, 14, "one spacecraft of each kind");
    }
}

/// Changes a number that is not zero, and returns whether there is one.
fn change(craft: &mut Value, pointer: &str) -> bool {
    let number = craft.pointer_mut(pointer).expect("collected from this very value");
    let value = number.as_f64().expect("a number");
    *number = (value + CHANGE * value.abs().max(LEAST)).into();
    value != 0.0
}

/// Whether an inertia has no products.
fn is_balanced(inertia: &Value) -> bool {
    [1, 2, 4].into_iter().all(|product| inertia[product] == 0.0)
}

/// The largest error of any claim.
fn noticed(changed: &Evaluated) -> f64 {
    let (case, engine) = (Case::new(&changed.craft), &changed.pinocchio.engine);
    let pairs = [
        (Blocks::of_solver(&case), Blocks::of_engine(engine)),
        (Blocks::of_sums(&case), Blocks::of_engines_sums(engine)),
        (Blocks::of_loads(&case, &changed.craft), Blocks::of_engines_loads(changed)),
    ];
    largest(pairs.iter().flat_map(|(a, b)| a.errors(b).map(|(_, error)| error)))
}

/// JSON pointers of all numbers within a value.
fn collect_numbers(value: &Value, pointer: &str, found: &mut Vec<String>) {
    match value {
        Value::Number(_) => found.push(pointer.to_owned()),
        Value::Array(items) => {
            for (index, item) in items.iter().enumerate() {
                collect_numbers(item, &format!("{pointer}/{index}"), found);
            }
        }
        Value::Object(fields) => {
            for (key, field) in fields {
                collect_numbers(field, &format!("{pointer}/{key}"), found);
            }
        }
        Value::Null | Value::Bool(_) | Value::String(_) => {}
    }
}
