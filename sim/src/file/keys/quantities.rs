//! Quantities of [`Keys`]: numbers with their units.

use nalgebra::Vector3;

use super::super::diagnostic::Numbers;
use super::super::document::{Node, Value};
use super::Keys;
use crate::units::{Measure, Plain, Quantity, parse_quantity};

impl Keys<'_> {
    /// A pure number.
    pub(in crate::file) fn number(&self, key: &str) -> Option<f64> {
        self.quantity(key, Measure::NUMBER)
    }

    /// Pure numbers, a known count of them.
    pub(in crate::file) fn numbers<const N: usize>(&self, key: &str) -> Option<[f64; N]> {
        let node = self.node(key)?;
        let Value::List(list) = &node.value else {
            return self.other_type(key, node, &format!("write a list of {N} numbers"));
        };
        let numbers: Vec<_> = list
            .iter()
            .filter_map(|node| match node.value {
                Value::Number(value, _) if value.is_finite() => Some(value),
                _ => None,
            })
            .collect();
        let found = <[f64; N]>::try_from(numbers).ok().filter(|_| list.len() == N);
        if found.is_none() {
            let message = format!("`{}` is no list of {N} finite numbers", self.path_of(key));
            self.error(key, message, "");
        }
        found
    }

    /// One quantity of a measure.
    pub(in crate::file) fn quantity(&self, key: &str, measure: Measure) -> Option<f64> {
        let node = self.node(key)?;
        let values = self.values_of(node, &self.path_of(key), measure)?;
        if let [value] = values.as_slice() {
            Some(*value)
        } else {
            let message = format!("`{}` has {} numbers", self.path_of(key), values.len());
            self.error(key, message, "write one number and its unit");
            None
        }
    }

    /// One quantity of a measure that must be there; reports where it is not.
    pub(in crate::file) fn required(&self, key: &str, measure: Measure) -> Option<f64> {
        if !self.has(key) {
            self.missing(key, &example(key, measure));
            return None;
        }
        self.quantity(key, measure)
    }

    /// A quantity over the root of a time, as of a random walk, or of a frequency, as of a density: `"0.1 deg/sqrt(h)"`.
    pub(in crate::file) fn per_root(
        &self,
        key: &str,
        measure: Measure,
        root: Measure,
    ) -> Option<f64> {
        let node = self.node(key)?;
        let path = self.path_of(key);
        let usual = if root == Measure::TIME { "h" } else { root.usual };
        let example =
            format!("write for example `{key} = \"0.1 {}/sqrt({usual})\"`", measure.usual);
        let Value::Text(text) = &node.value else { return self.other_type(key, node, &example) };
        let parts = text.trim().strip_suffix(')').and_then(|text| text.rsplit_once("/sqrt("));
        let one = |text: &str, measure: Measure| {
            let quantity = parse_quantity(text).ok().filter(|of| of.is(measure))?;
            <[f64; 1]>::try_from(quantity.values).ok()
        };
        let found = parts.and_then(|(of, unit)| {
            let ([of], [time]) = (one(of, measure)?, one(&format!("1 {unit}"), root)?);
            Some(of / libm::sqrt(time))
        });
        if found.is_none() {
            let message = format!(
                "`{path}` is no {} over the root of {}",
                without_article(measure.name),
                root.name
            );
            self.error(key, message, &example);
        }
        found
    }

    /// Some quantities of one measure: `"1, 2, 3 cm"`, or `["1 cm", "2 cm", "3 cm"]`.
    pub(in crate::file) fn quantities<const N: usize>(
        &self,
        key: &str,
        measure: Measure,
    ) -> Option<[f64; N]> {
        let node = self.node(key)?;
        let path = self.path_of(key);
        let values = match &node.value {
            Value::List(list) => {
                let each = list.iter().map(|node| self.values_of(node, &path, measure));
                each.collect::<Option<Vec<_>>>()?.concat()
            }
            _ => self.values_of(node, &path, measure)?,
        };
        let count = values.len();
        let found = <[f64; N]>::try_from(values).ok();
        if found.is_none() {
            let unit = measure.usual;
            let numbers = ["1", "2", "3", "4", "5", "6"];
            let numbers = numbers.get(..N).unwrap_or(&numbers).join(", ");
            let message = format!("`{path}` has {count} numbers where {N} are wanted");
            self.error(key, message, &format!("write for example `{key} = \"{numbers} {unit}\"`"));
        }
        found
    }

    pub(in crate::file) fn vector(&self, key: &str, measure: Measure) -> Option<Vector3<f64>> {
        self.quantities::<3>(key, measure).map(Vector3::from)
    }

    /// A quantity of any measure, with its unit; a bare number is a pure number.
    pub(in crate::file) fn any_quantity(&self, key: &str) -> Option<Quantity> {
        let node = self.node(key)?;
        if let Value::Number(value, _) = node.value
            && value.is_finite()
        {
            let (values, dimension) = (vec![value], Measure::NUMBER.dimension);
            return Some(Quantity { values, dimension, unit: String::new() });
        }
        let Value::Text(text) = &node.value else {
            let help = "write a number and its unit in quotation marks";
            return self.other_type(key, node, help);
        };
        self.parsed(node, text, &self.path_of(key), "a number and its unit are wanted")
    }

    /// The quantities of a node, of a measure.
    pub(in crate::file) fn values_of(
        &self,
        node: &Node,
        path: &str,
        measure: Measure,
    ) -> Option<Vec<f64>> {
        let Measure { name, usual, .. } = measure;
        let wanted = if usual.is_empty() {
            format!("{name} is wanted")
        } else {
            format!("{name} is wanted, in {usual} for example")
        };
        let text = match &node.value {
            Value::Text(text) => text,
            Value::Number(value, _) if !value.is_finite() => {
                let message = format!("`{path}` is {value}, which is no finite number");
                self.report(node, message, "", &wanted);
                return None;
            }
            Value::Number(value, _) if measure == Measure::NUMBER => return Some(vec![*value]),
            Value::Number(value, _)
                if self.reports.borrow().numbers_at(&node.span) == Numbers::Si =>
            {
                return Some(vec![*value]);
            }
            Value::Number(value, _) => {
                let value = Plain(*value);
                let message = format!("`{path}` has no unit");
                let help = if measure.unit == usual {
                    format!("write `\"{value} {usual}\"`, or another unit")
                } else {
                    format!("write `\"{value} {}\"` or `\"{value} {usual}\"`", measure.unit)
                };
                self.report(node, message, &wanted, &help);
                return None;
            }
            other => {
                let message = format!("`{path}` is {}", other.what());
                self.report(node, message, "", &format!("{wanted}, in quotation marks"));
                return None;
            }
        };
        let quantity = self.parsed(node, text, path, &wanted)?;
        if quantity.is(measure) {
            return Some(quantity.values);
        }
        let found = quantity.name();
        let message = if quantity.unit.is_empty() {
            format!("`{path}` has no unit")
        } else {
            format!("`{path}` is {found}, where {name} is wanted")
        };
        let units = if measure.unit == usual {
            usual.to_owned()
        } else {
            format!("{usual}, {}", measure.unit)
        };
        let help = other_reading(&quantity, text, measure)
            .unwrap_or_else(|| format!("write it in {units}, or another unit of it"));
        self.report(node, message, "", &help);
        None
    }

    fn parsed(&self, node: &Node, text: &str, path: &str, wanted: &str) -> Option<Quantity> {
        match parse_quantity(text) {
            Ok(quantity) => Some(quantity),
            Err(error) => {
                // Within the quotation marks, where the text is written without escapes.
                let mut span = node.span.clone();
                if span.range.len() == text.len() + 2 {
                    let start = span.range.start + 1;
                    span.range = start + error.at.start..start + error.at.end.max(error.at.start);
                }
                let message = format!("`{path}`: {}", error.kind);
                self.reports.borrow_mut().error(&span, message, "", wanted);
                None
            }
        }
    }

    fn report(&self, node: &Node, message: String, label: &str, help: &str) {
        self.reports.borrow_mut().error(&node.span, message, label, help);
    }
}

/// What may be meant by a quantity of another measure than the one that is wanted: turns or radians per second by
/// hertz, a weight by the unit of a mass.
fn other_reading(found: &Quantity, text: &str, wanted: Measure) -> Option<String> {
    let unit = found.unit.as_str();
    let numbers = text.trim().strip_suffix(unit)?.trim_end();
    if found.is(Measure::FREQUENCY) && wanted == Measure::ANGULAR_RATE {
        // Of `1/min`, too.
        let per = unit.strip_prefix("1/").or((unit == "Hz").then_some("s"));
        return Some(match per {
            Some(time) => format!(
                "write `{numbers} rev/{time}` for turns, `{numbers} rad/{time}` for radians"
            ),
            None => "write it in rev/s for turns per second, in rad/s for radians".to_owned(),
        });
    }
    let weight = ["oz", "lb"]
        .into_iter()
        .find(|mass| unit.split(|c: char| !c.is_alphabetic()).any(|symbol| symbol == *mass))?;
    let meant = format!("{numbers} {}", unit.replace(weight, &format!("{weight}f")));
    let fits = parse_quantity(&meant).is_ok_and(|meant| meant.is(wanted));
    fits.then(|| format!("`{weight}` is a mass, `{weight}f` its weight: write `{meant}`"))
}

/// A line that would do.
fn example(key: &str, measure: Measure) -> String {
    match measure.usual {
        "" => format!("{key} = 1"),
        unit => format!("{key} = \"1 {unit}\""),
    }
}

/// A name without its article.
fn without_article(name: &str) -> &str {
    name.strip_prefix("an ").or_else(|| name.strip_prefix("a ")).unwrap_or(name)
}
