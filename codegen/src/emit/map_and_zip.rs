//! What changes and joins a record number by number: a call of the dynamics crate's macro `map_and_zip`.

use super::text::{LINE, wrapped};

/// The call for a record with these fields, for its type parameter and what that must be, line by line.
pub(super) fn map_and_zip(
    dynamics: &str,
    record: &str,
    [number, bound]: [&str; 2],
    fields: &[impl AsRef<str>],
) -> Vec<String> {
    let fields: Vec<_> = fields.iter().map(AsRef::as_ref).collect();
    let (head, fields) =
        (format!("{dynamics}::map_and_zip!({record}<{number}: {bound}> {{"), fields.join(", "));
    let line = format!("{head} {fields} }});");
    if line.len() <= LINE {
        return vec![line];
    }
    let fields = wrapped(&format!("{fields},"), LINE - 4);
    let inner = fields.into_iter().map(|line| format!("    {line}"));
    [head].into_iter().chain(inner).chain(["});".to_owned()]).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_long_call_is_broken_between_fields() {
        let call = |fields: &[String]| map_and_zip("crate", "Gains", ["T", "Copy"], fields);
        assert_eq!(call(&["a".into()]), ["crate::map_and_zip!(Gains<T: Copy> { a });"]);
        let fields: Vec<_> = (0..20).map(|k| format!("gain_{k:02}")).collect();
        let lines = call(&fields);
        assert!(lines.len() == 4 && lines.iter().all(|line| line.len() <= LINE), "{lines:#?}");
        assert_eq!(lines[1..3].concat().matches("gain_").count(), 20);
    }
}
