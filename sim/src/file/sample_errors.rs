//! Errors of a scenario whose keys a campaign sets: at the entry of the plan that draws the value, or at `--over`.

use std::cell::RefCell;
use std::path::Path;

use super::diagnostic::{Diagnostics, Severity, SourceText, Span};
use super::keys::Keys;
use super::load::{Override, load_file};
use super::template::Template;

/// Where a plan has the keys that it draws.
#[derive(Clone, Debug)]
pub struct PlanPlaces {
    sources: Vec<SourceText>,
    keys: Vec<(String, Span)>,
}

impl PlanPlaces {
    /// Those of a plan that [`variations_from_toml`](super::variations_from_toml) reads; none where it cannot be read.
    #[must_use]
    pub fn from_toml(path: &Path) -> Option<Self> {
        let mut reports = Diagnostics::default();
        let node = load_file(path, &mut reports);
        let cell = RefCell::new(reports);
        let keys = {
            let of_plan = Keys::new(&node, "", &cell)?;
            let place =
                |table: &Keys<'_>| Some((table.text("key")?.to_owned(), table.place("key")));
            of_plan.tables("vary").iter().filter_map(place).collect()
        };
        Some(Self { sources: cell.into_inner().sources, keys })
    }

    /// The place of a key, in texts of which so many are before those of the plan.
    fn place(&self, key: &str, before: usize) -> Option<Span> {
        let (_, span) = self.keys.iter().find(|(of, _)| of == key)?;
        Some(Span { source: span.source + before, range: span.range.clone() })
    }
}

impl Template {
    /// The errors of [`Template::scenario`] for a sample, whose own overrides are the last ones: errors in the text of an
    /// override are shown at the entry of the plan that draws the value, or named after `--over`; others say which values the
    /// sample has.
    #[must_use]
    pub fn sample_errors(
        &self,
        mut errors: Diagnostics,
        (sample, overrides): (usize, &[Override]),
        plan: Option<&PlanPlaces>,
    ) -> Diagnostics {
        let before = errors.sources.len();
        let written = if plan.is_some() { "draws" } else { "has" };
        for text in overrides {
            let Some((key, _)) = text.split_once(" = ") else { continue };
            let names = self.keys_of(key).unwrap_or_else(|_| vec![key.to_owned()]);
            let is_own = |source: &SourceText| {
                let own = source.name.strip_prefix("--set ").unwrap_or_default();
                let own = own.split([' ', '=']).next().unwrap_or_default();
                let vector = |name: &str| name.split('[').next() == Some(own);
                source.folder.is_none() && !own.is_empty() && names.iter().any(|name| vector(name))
            };
            let own: Vec<usize> = (0..before)
                .filter(|source| errors.sources.get(*source).is_some_and(is_own))
                .collect();
            let place = plan.and_then(|plan| plan.place(key, before));
            for error in &mut errors.all {
                if error.span.as_ref().is_some_and(|span| own.contains(&span.source)) {
                    error.label = format!("sample {sample} {written} {text}");
                    error.span = place.clone().or(error.span.take());
                }
            }
            for source in own {
                if let Some(source) = errors.sources.get_mut(source) {
                    source.name =
                        source.name.replacen("--set", "--over", usize::from(plan.is_none()));
                }
            }
        }
        let places = before..;
        errors.sources.extend(plan.into_iter().flat_map(|plan| plan.sources.iter().cloned()));
        let values = format!("sample {sample} {written} {}", overrides.join(", "));
        for error in errors.all.iter_mut().filter(|error| error.severity == Severity::Error) {
            let at_plan = error.span.as_ref().is_some_and(|span| places.contains(&span.source));
            if !at_plan && error.label.is_empty() {
                let between = if error.help.is_empty() { "" } else { "; " };
                error.help = format!("{}{between}{values}", error.help);
            }
        }
        errors
    }
}
