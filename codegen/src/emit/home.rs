//! Where emitted code stands, and how it finds the dynamics crate from there.

use super::text::LINE;

/// The crate that emitted code is part of.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Home<'a> {
    /// The dynamics crate itself.
    Dynamics,
    /// Another one, which knows the dynamics crate by this name.
    Outside(&'a str),
}

impl Home<'_> {
    /// The path of a file: from the repository's root, or from wherever a user puts it.
    pub(super) fn path(self, name: &str) -> String {
        match self {
            Self::Dynamics => format!("dynamics/src/generated/{name}"),
            Self::Outside(_) => name.to_owned(),
        }
    }

    /// What makes the file again.
    pub(super) fn command(self) -> &'static str {
        match self {
            Self::Dynamics => "cargo xtask regen",
            Self::Outside(_) => "precess_codegen::emit_kind",
        }
    }

    /// The lines that bring in these records of the hub, and `Real`, as `rustfmt` leaves them.
    pub(super) fn imports(self, records: &[String]) -> Vec<String> {
        let list = records.join(", ");
        match self {
            Self::Dynamics => {
                vec![format!("use super::hub::{{{list}}};"), "use crate::Real;".into()]
            }
            Self::Outside(dynamics) => {
                let real = format!("use {dynamics}::Real;");
                let from = format!("use {dynamics}::generated::hub::");
                std::iter::once(real).chain(braced(&from, records)).collect()
            }
        }
    }
}

/// `from {a, b};`, broken where it is too long for a line.
fn braced(from: &str, names: &[String]) -> Vec<String> {
    let line = format!("{from}{{{}}};", names.join(", "));
    if line.len() <= LINE {
        return vec![line];
    }
    let mut lines = vec![format!("{from}{{")];
    let mut inside = String::from("   ");
    for name in names {
        if inside.len() + " ".len() + name.len() + ",".len() > LINE {
            lines.push(std::mem::replace(&mut inside, "   ".to_owned()));
        }
        inside = format!("{inside} {name},");
    }
    lines.extend([inside, "};".to_owned()]);
    lines
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn long_imports_are_broken_and_none_is_lost() {
        let names = ["One", "Two", "Three"].map(str::to_owned);
        assert_eq!(braced("use a::", &names), ["use a::{One, Two, Three};"]);
        let long = names.map(|name| name.repeat(10));
        let [one, two, three] = &long;
        assert_eq!(
            braced("use a::", &long),
            [
                "use a::{".to_owned(),
                format!("    {one}, {two},"),
                format!("    {three},"),
                "};".into()
            ]
        );
    }
}
