//! Names of columns in `[output]`, `[[requirement]]` and `[[crossing]]`, and the units of their
//! values: what is only known with the devices.

use precess_dynamics::Gravity;

use crate::file::document::Node;
use crate::file::keys::{Keys, Reports};
use crate::nearest::did_you_mean;
use crate::record::columns::{Columns, quantity, state_quantities};
use crate::scenario::Scenario;
use crate::units::{Dimension, measure_of, parse_unit};

/// Reports columns that are unknown, and limits and values in a unit of something else; for a tree
/// that has been read without error.
pub(in crate::file::read) fn check(node: &Node, scenario: &Scenario, reports: &Reports) {
    let Some(keys) = Keys::new(node, "", reports) else { return };
    let all = Columns::all(scenario);
    let all = all.as_slice();
    if let Some(output) = keys.table("output") {
        let selected = Scenario { requirements: Vec::new(), ..scenario.clone() };
        if let Err(error) = Columns::from_scenario(&selected) {
            let orbit = scenario.output.columns.iter().any(|name| name.starts_with("orbit"));
            let central = matches!(scenario.gravity, Gravity::Central { .. });
            let help = if orbit && !central {
                "the columns `orbit` are of a scenario with `[gravity]` and a `central` body"
            } else {
                ""
            };
            output.error("columns", error.to_string(), help);
        }
    }
    for (keys, requirement) in keys.tables("requirement").iter().zip(&scenario.requirements) {
        match quantity(all, &requirement.quantity) {
            Ok(indices) => {
                let column = indices.first().and_then(|index| all.get(*index));
                let unit = column.map_or("1", |column| column.unit);
                compare(keys, "limit", &requirement.quantity, [unit, &requirement.unit.0]);
                if let (Some((key, _)), true) = (requirement.projection.key(), indices.len() < 3) {
                    let message = format!("`{}` is no vector", requirement.quantity);
                    keys.error(
                        key,
                        message,
                        "name a vector, such as `rotation`, or remove the key",
                    );
                }
            }
            Err(error) => keys.error("quantity", error.to_string(), ""),
        }
    }
    let joints = scenario.joints().map(|(_, name, info)| (name, info));
    let state = state_quantities(joints, scenario.mode_count());
    for (keys, crossing) in keys.tables("crossing").iter().zip(&scenario.crossings) {
        let name = &crossing.column;
        let column = all.iter().find(|column| column.name == *name);
        if let Some(column) = column.filter(|_| state.iter().any(|(known, ..)| known == name)) {
            compare(keys, "value", name, [column.unit, &crossing.unit]);
        } else {
            let help = did_you_mean(
                name,
                state.iter().map(|(name, ..)| name.as_str()),
                "name a coordinate, a rate, or a component of `omega`",
            );
            keys.error("column", format!("`{name}` is no column of the state"), &help);
        }
    }
}

/// Reports a value whose unit is not of the dimension of a quantity's.
fn compare(keys: &Keys<'_>, key: &str, name: &str, [wanted, written]: [&str; 2]) {
    // No unit is that of a number.
    let dimension = |unit: &str| parse_unit(unit).map(|(_, found)| found).unwrap_or_default();
    let (wants, has) = (dimension(wanted), dimension(written));
    if wants == has {
        return;
    }
    let named = |dimension: Dimension, unit: &str| match measure_of(dimension) {
        Some(measure) => measure.name.to_owned(),
        None => format!("in {unit}"),
    };
    let message =
        format!("`{name}` is {}, the {key} {}", named(wants, wanted), named(has, written));
    let help = match wanted {
        "1" => "write a number without a unit".to_owned(),
        unit => format!("write it in {unit}, or another unit of it"),
    };
    keys.error(key, message, &help);
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use crate::file::read::from_toml;

    const WHEEL: &str = "format = 1\n[hub]\nmass = \"9 kg\"\ninertia = \"1, 1, 1 kg m^2\"\n\
        [[device]]\nname = \"rw\"\nkind = \"reaction_wheel\"\n\
        wheel = { mass = \"1 kg\", inertia = \"2, 1, 1 g m^2\" }\n[run]\nduration = \"1 s\"\n";

    fn errors(rest: &str) -> String {
        let read = from_toml("test.toml", &format!("{WHEEL}{rest}"), Path::new(""));
        read.map_or_else(|errors| errors.to_string(), |_| String::new())
    }

    fn requirement(quantity: &str, limit: &str) -> String {
        errors(&format!(
            "[[requirement]]\nname = \"a\"\nquantity = \"{quantity}\"\nstatistic = \"peak\"\n\
             limit = {limit}\n"
        ))
    }

    #[test]
    fn a_limit_has_the_unit_of_its_quantity() {
        for (quantity, limit) in [
            ("omega", "\"1 deg/s\""),
            ("rw.mount.force", "\"1 N\""),
            ("angular_momentum_z", "\"1 N m s\""),
            ("acceleration", "\"1 mm/s^2\""),
            ("sigma", "1e-6"),
            ("sigma", "\"1e-6\""),
        ] {
            assert_eq!(requirement(quantity, limit), "", "{quantity} {limit}");
        }
        let shown = requirement("omega", "\"1 deg\"");
        assert!(shown.contains("`omega` is an angular rate, the limit an angle"), "{shown}");
        assert!(shown.contains("test.toml:15"), "{shown}");
        assert!(requirement("omega", "1").contains("the limit a number"));
        assert!(requirement("sigma", "\"1 rad\"").contains("without a unit"));
    }

    #[test]
    fn an_unknown_column_is_an_error_of_the_file() {
        let shown = requirement("rw.spn", "\"1 rpm\"");
        assert!(shown.contains("nearest: `rw.spin`"), "{shown}");
        let shown = errors("[output]\ncolumns = [\"omgea\"]\n");
        assert!(shown.contains("nearest: `omega"), "{shown}");
        let crossing = |column: &str, value: &str| {
            errors(&format!("[[crossing]]\ncolumn = \"{column}\"\nvalue = \"{value}\"\n"))
        };
        assert_eq!(crossing("rw.spin", "3000 rpm"), "");
        assert!(crossing("rw.spin", "50 Hz").contains("the value a frequency"));
        assert!(crossing("energy", "1 J").contains("no column of the state"));
    }
}
