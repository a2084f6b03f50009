//! Kernels of a spacecraft whose values are folded: what computes constants is for the tests.

/// Items that only compute constants: a line that each has, below its documentation.
const CONSTRUCT: [&str; 3] =
    ["pub struct Parameters<T> {", "pub fn prepare<", "pub fn constant_share<"];
/// The line above it: an attribute.
const ABOVE: [&str; 2] = ["#[derive(", "#[must_use]"];
/// What only they read of the hub's records.
const SHARE: &str = "ConstantShare";
/// Where that is imported.
const IMPORT: &str = "use super::hub::{";

/// The text with these items in tests only.
pub(crate) fn only_tested(text: &str) -> String {
    let mut lines: Vec<String> = Vec::new();
    for line in text.lines() {
        if let Some(records) = line.strip_prefix(IMPORT).and_then(|rest| rest.strip_suffix("};")) {
            let others: Vec<_> = records.split(", ").filter(|name| *name != SHARE).collect();
            lines.push(format!("{IMPORT}{}}};", others.join(", ")));
            lines.push("#[cfg(test)]".to_owned());
            lines.push(format!("use super::hub::{SHARE};"));
            continue;
        }
        if CONSTRUCT.iter().any(|item| line.starts_with(item)) {
            let attribute = |line: &String| ABOVE.iter().any(|above| line.starts_with(above));
            let above = lines.iter().rposition(|line| !attribute(line)).map_or(0, |k| k + 1);
            lines.insert(above, "#[cfg(test)]".to_owned());
        }
        lines.push(line.to_owned());
    }
    lines.join("\n") + "\n"
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_computes_constants_is_tested_only() {
        let text = "use super::hub::{BodyRate, ConstantShare, HubShare};\n\n/// One.\n\
                    #[derive(Clone)]\npub struct Parameters<T> {\n}\n\n/// Two.\n#[must_use]\n\
                    pub fn prepare<T>() {\n}\n\npub fn eliminate<T>() {\n}\n";
        let expected = "use super::hub::{BodyRate, HubShare};\n#[cfg(test)]\n\
                        use super::hub::ConstantShare;\n\n/// One.\n#[cfg(test)]\n\
                        #[derive(Clone)]\npub struct Parameters<T> {\n}\n\n/// Two.\n#[cfg(test)]\n\
                        #[must_use]\npub fn prepare<T>() {\n}\n\npub fn eliminate<T>() {\n}\n";
        assert_eq!(only_tested(text), expected);
    }
}
