//! The crate of the emitted code, and the name by which it calls the dynamics crate.

use super::layout::packed;

/// The crate that emitted code is part of.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Home<'a> {
    /// The dynamics crate itself.
    Dynamics,
    /// Another one, which calls the dynamics crate by this name.
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

    /// What the dynamics crate is called there.
    pub(super) fn dynamics(&self) -> &str {
        match self {
            Self::Dynamics => "crate",
            Self::Outside(dynamics) => dynamics,
        }
    }

    /// The lines that bring in these records of the hub, and `Real`, as `rustfmt` leaves them.
    pub(super) fn imports(self, records: &[String]) -> Vec<String> {
        let (dynamics, from) = match self {
            Self::Dynamics => ("crate", "use super::hub::{".to_owned()),
            Self::Outside(dynamics) => (dynamics, format!("use {dynamics}::generated::hub::{{")),
        };
        let list = packed(&from, records, "};");
        let list = list.lines().map(str::to_owned);
        let real = std::iter::once(format!("use {dynamics}::Real;"));
        match self {
            Self::Dynamics => list.chain(real).collect(),
            Self::Outside(_) => real.chain(list).collect(),
        }
    }
}
