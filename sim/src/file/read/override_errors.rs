//! Errors at a place of a file that an override causes: their help names it.

use crate::file::diagnostic::{Diagnostic, Diagnostics, Numbers, Severity};
use crate::file::load::Override;

use super::Read;

/// The file is read again without each of up to so many overrides.
const OVERRIDES_MAX: usize = 20;

/// Adds to the help of errors at a place of a file, or at none, which overrides they come from: those without any one of which
/// there is no error, else all of them, where there is no error without them; of many overrides only that it is they. `read`
/// reads the file with some overrides.
pub(super) fn name_overrides(
    mut errors: Diagnostics,
    (overrides, numbers): (&[Override], Numbers),
    read: impl Fn((&[Override], Numbers)) -> Read,
) -> Diagnostics {
    let in_file = |of: &Diagnostic| {
        let source = of.span.as_ref().and_then(|span| errors.sources.get(span.source));
        let of_override = source.is_some_and(|source| source.name.starts_with("--set "));
        of.severity == Severity::Error && !of_override && !of.message.starts_with("--set ")
    };
    let places: Vec<usize> =
        (0..errors.all.len()).filter(|of| errors.all.get(*of).is_some_and(in_file)).collect();
    if overrides.is_empty() || places.is_empty() || read((&[], numbers)).is_err() {
        return errors;
    }
    let without = |at: usize| {
        let mut others = overrides.to_vec();
        others.remove(at);
        read((&others, numbers)).is_ok()
    };
    let sentence = sentence(overrides, without);
    for place in places {
        let Some(error) = errors.all.get_mut(place) else { continue };
        let between = if error.help.is_empty() { "" } else { "; " };
        error.help = format!("{}{between}{sentence}", error.help);
    }
    errors
}

/// Without which overrides there is no error, where there is none without all of them; `without` is whether there is none
/// without that of a number.
fn sentence(overrides: &[Override], without: impl Fn(usize) -> bool) -> String {
    if overrides.len() > OVERRIDES_MAX {
        return "without the overrides the file has no error".to_owned();
    }
    let shown = |text: &Override| format!("`--set {text}`");
    let mut causes: Vec<String> = Vec::new();
    if overrides.len() > 1 {
        let of_one = overrides.iter().enumerate().filter(|(at, _)| without(*at));
        causes.extend(of_one.map(|(_, text)| shown(text)));
    }
    let which = if causes.len() > 1 { "any one of " } else { "" };
    if causes.is_empty() {
        causes.extend(overrides.iter().map(shown));
    }
    format!("without {which}{} the file has no error", causes.join(", "))
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use super::{OVERRIDES_MAX, sentence};
    use crate::file::diagnostic::Numbers;
    use crate::file::{Tables, from_program};

    const FILE: &str = "format = 1\n[run]\nduration = \"1 s\"\n[output]\nrate = \"1 kHz\"\n[hub]\nmass = \"9 kg\"\n\
        inertia = \"1, 1, 1 kg m^2\"\n[[device]]\nname = \"rw\"\nkind = \"reaction_wheel\"\n[device.wheel]\n\
        mass = \"1 kg\"\ninertia = \"2, 1, 1 g m^2\"\ntorque_limit = \"1 N m\"\n";

    fn errors(file: &str, overrides: &[&str]) -> String {
        let overrides: Vec<String> = overrides.iter().map(|text| (*text).to_owned()).collect();
        let (numbers, folder) = (Numbers::WithUnits, Path::new(""));
        let tables = Tables::Text { name: "test.toml", text: file, numbers, folder };
        let read = from_program(tables, &overrides).map(|_| ());
        read.expect_err("an error").to_string()
    }

    #[test]
    fn overrides_of_which_each_causes_an_error_differ_from_those_that_do_together() {
        let both = ["a = 1".to_owned(), "b = 2".to_owned()];
        for (of_one, expected) in [
            ([true, true], "without any one of `--set a = 1`, `--set b = 2` the file has no error"),
            ([false, true], "without `--set b = 2` the file has no error"),
            ([false, false], "without `--set a = 1`, `--set b = 2` the file has no error"),
        ] {
            assert_eq!(sentence(&both, |at| of_one[at]), expected);
        }
        let many = vec!["a = 1".to_owned(); OVERRIDES_MAX + 1];
        assert_eq!(sentence(&many, |_| true), "without the overrides the file has no error");
    }

    #[test]
    fn an_error_at_a_line_of_the_file_names_the_override_that_causes_it() {
        let (locked, heavy) = ("device.rw.wheel.locked = true", "hub.mass = 12");
        let shown = errors(FILE, &[heavy, locked]);
        for part in [
            "the joint has no `torque` to limit",
            "test.toml:15",
            "remove it; without `--set device.rw.wheel.locked = true` the file has no error",
        ] {
            assert!(shown.contains(part), "{part}\n{shown}");
        }
        // Two that are wrong together, and nothing to say of a file that is wrong by itself, or of an override's own text.
        let pair = ["device.rw.wheel.torque_limit = 1", "device.rw.wheel.rate = 2"];
        let of_file = errors(&FILE.replace("\"9 kg\"", "\"-9 kg\""), &pair);
        assert!(!of_file.contains("without `--set"), "{of_file}");
        let own = errors(FILE, &["hub.mass = -12"]);
        assert!(own.contains("--set hub.mass = -12") && !own.contains("without `--set"), "{own}");
        let both = errors(FILE, &["device.rw.wheel.coulomb = 1", "hub.mass = 12"]);
        assert!(both.contains("without `--set device.rw.wheel.coulomb = 1` the file"), "{both}");
    }
}
