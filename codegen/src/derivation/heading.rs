//! What a section of a derivation computes, as data: quantity, equations, axes, units, point.
//!
//! Comments over the statements of emitted Rust and C, documentation of constants, tags of mutants
//! and the pages on the derivation are written from it.

use std::fmt;

/// Quantity, equations, axes and units of the statements under it.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Heading {
    what: String,
    /// What is written before the equations: nothing where they state it as it is, else `as in`, `see`.
    relation: &'static str,
    equations: Vec<String>,
    axes: String,
    parts: Vec<[String; 2]>,
    about: String,
    note: String,
}

impl Heading {
    /// A quantity, in words or by its symbol.
    #[must_use]
    pub fn new(what: impl Into<String>) -> Self {
        Self { what: what.into(), ..Self::default() }
    }

    /// The equations that state it, by their numbers, separated by commas.
    #[must_use]
    pub fn equation(mut self, numbers: &str) -> Self {
        // A kind of another crate need not be in the paper.
        let numbers = numbers.split(", ").filter(|number| !["", "(none)"].contains(number));
        self.equations.extend(numbers.map(str::to_owned));
        self
    }

    /// Equations that state something near to it, and how: `as in`, `see`.
    #[must_use]
    pub fn cited(self, relation: &'static str, numbers: &str) -> Self {
        Self { relation, ..self.equation(numbers) }
    }

    /// The axes that it is expressed in.
    #[must_use]
    pub fn axes(self, axes: impl Into<String>) -> Self {
        Self { axes: axes.into(), ..self }
    }

    /// The unit of the quantity itself.
    #[must_use]
    pub fn unit(self, unit: &str) -> Self {
        self.part("", unit)
    }

    /// One of several quantities and its unit; no unit where it is none or not one.
    #[must_use]
    pub fn part(mut self, what: impl Into<String>, unit: impl Into<String>) -> Self {
        self.parts.push([what.into(), unit.into()]);
        self
    }

    /// Force and moment, about a point.
    #[must_use]
    pub fn wrench(self, units: [&str; 2], about: &str) -> Self {
        self.part("force", units[0]).part("moment", units[1]).about(about)
    }

    /// The point that moments are about.
    #[must_use]
    pub fn about(self, point: &str) -> Self {
        Self { about: point.to_owned(), ..self }
    }

    /// What else belongs to the parts: the end of the sentence.
    #[must_use]
    pub fn note(self, note: impl Into<String>) -> Self {
        Self { note: note.into(), ..self }
    }

    /// The quantity, in words or by its symbol.
    #[must_use]
    pub fn quantity(&self) -> &str {
        &self.what
    }

    /// The numbers of its equations, one by one or in ranges.
    #[must_use]
    pub fn equations(&self) -> &[String] {
        &self.equations
    }

    /// Quantity, equations and axes, without units.
    #[must_use]
    pub fn label(&self) -> String {
        let Self { what, relation, equations, axes, .. } = self;
        let eq = if equations.len() == 1 { "eq." } else { "eqs." };
        let cited = [*relation, eq, &equations.join(", ")].join(" ");
        let cited =
            if equations.is_empty() { String::new() } else { format!(", {}", cited.trim()) };
        let axes = if axes.is_empty() { String::new() } else { format!(", expressed in {axes}") };
        format!("{what}{cited}{axes}")
    }
}

/// The whole sentence.
impl fmt::Display for Heading {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}", self.label())?;
        for (place, [what, unit]) in self.parts.iter().enumerate() {
            let (last, few) = (place + 1 == self.parts.len(), self.parts.len() < 3);
            let separator = match (place, last, few) {
                _ if what.is_empty() => "",
                (0, ..) => ": ",
                (_, true, true) => ", and ",
                (_, true, false) => "; and ",
                (_, false, _) => "; ",
            };
            write!(f, "{separator}{what}")?;
            if !unit.is_empty() {
                write!(f, ", {unit}")?;
            }
        }
        if !self.about.is_empty() {
            write!(f, ", about {}", self.about)?;
        }
        if !self.note.is_empty() {
            write!(f, ", {}", self.note)?;
        }
        write!(f, ".")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_quantity_is_followed_by_its_unit() {
        let heading = Heading::new("ω_{W/N}").equation("(59)").axes("its own axes").unit("rad/s");
        assert_eq!(heading.to_string(), "ω_{W/N}, eq. (59), expressed in its own axes, rad/s.");
        assert_eq!(heading.label(), "ω_{W/N}, eq. (59), expressed in its own axes");
    }

    #[test]
    fn several_quantities_have_a_unit_each() {
        let heading = Heading::new("On W").equation("(16), (75)").wrench(["N", "N m"], "B");
        assert_eq!(
            heading.to_string(),
            "On W, eqs. (16), (75): force, N, and moment, N m, about B."
        );
        assert_eq!(heading.equations(), ["(16)", "(75)"]);
        let heading = Heading::new("Share").part("mass", "kg").part("first moment", "kg m");
        let heading = heading.part("inertia", "kg m²").about("B").note("as given");
        assert_eq!(
            heading.to_string(),
            "Share: mass, kg; first moment, kg m; and inertia, kg m², about B, as given."
        );
    }

    #[test]
    fn what_is_not_in_the_paper_cites_nothing() {
        let heading = Heading::new("Its derivative").cited("as in", "(none)").unit("rad/s²");
        assert_eq!(heading.to_string(), "Its derivative, rad/s².");
        let heading = Heading::new("G").cited("as in", "(D16)");
        assert_eq!(heading.to_string(), "G, as in eq. (D16).");
    }
}
