//! Names of a scenario's parts: the one rule that they meet, and the names of files and columns that are made of them.
//!
//! | name | rule |
//! |---|---|
//! | of a device, platform, source, recorded point | begins a column's name: lower-case letters, digits, `_` |
//! | of anything else: requirement, line of sight, node, crossing, change, wrench | any text in one line |
//!
//! Either has at most [`NAME_MAX`] letters. A name in a file's name has only lower-case letters, digits and hyphens, so
//! two names may become one: [`file_names`] numbers them.

use std::collections::{HashMap, HashSet};
use std::fmt;

/// Most letters of a name. With the scenario's, of as many, and an ending it is the name of a file.
pub(crate) const NAME_MAX: usize = 100;

/// Why a text is no name.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum NameFault {
    /// It has no letter.
    Empty,
    /// It has this many letters.
    Long(usize),
    /// It has a letter that is not shown: a line's end, a control character, one that turns the direction of writing.
    Hidden(char),
    /// It begins or ends with a space.
    Margin,
    /// It is no name of columns.
    Column,
}

impl fmt::Display for NameFault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Empty => f.write_str("a name has at least one letter"),
            Self::Long(found) => {
                write!(
                    f,
                    "a name of {found} letters; at most {NAME_MAX} fit into the names of files"
                )
            }
            Self::Hidden(letter) => write!(
                f,
                "the name has U+{:04X}, which is not shown; a name is text in one line",
                u32::from(*letter)
            ),
            Self::Margin => f.write_str("the name begins or ends with a space; remove it"),
            Self::Column => {
                f.write_str("the name is not lower-case letters, digits and underscores")
            }
        }
    }
}

/// What is wrong with a name of anything.
pub(crate) fn name_fault(name: &str) -> Option<NameFault> {
    let hidden = |c: &char| {
        let invisible = matches!(
            c,
            '\u{ad}' | '\u{200b}'..='\u{200f}' | '\u{2028}'..='\u{202e}' | '\u{2060}'..='\u{206f}' | '\u{feff}'
        );
        c.is_control() || invisible
    };
    let letters = name.chars().count();
    if letters == 0 {
        Some(NameFault::Empty)
    } else if letters > NAME_MAX {
        Some(NameFault::Long(letters))
    } else if let Some(letter) = name.chars().find(hidden) {
        Some(NameFault::Hidden(letter))
    } else if name.trim() != name {
        Some(NameFault::Margin)
    } else {
        None
    }
}

/// What is wrong with a name that columns begin with.
pub(crate) fn column_name_fault(name: &str) -> Option<NameFault> {
    let plain = |c: char| c.is_ascii_lowercase() || c.is_ascii_digit() || c == '_';
    let is_column = name.starts_with(|c: char| c.is_ascii_lowercase()) && name.chars().all(plain);
    name_fault(name).or_else(|| (!is_column).then_some(NameFault::Column))
}

/// A name for a file of each name, in order, no two of them the same: lower-case letters, digits, hyphens. Where several
/// names become one, the later ones have a number.
#[cfg_attr(
    not(any(feature = "tool", test)),
    expect(dead_code, reason = "commands and reports write files")
)]
pub(crate) fn file_names<N: AsRef<str>>(names: impl IntoIterator<Item = N>) -> Vec<String> {
    let letter = |c: char| if c.is_ascii_alphanumeric() { c.to_ascii_lowercase() } else { '-' };
    distinct(names.into_iter().map(|name| name.as_ref().chars().map(letter).collect()), '-')
}

/// A head for a column of each name, in order, no two of them the same: what separates cells becomes `_`.
#[cfg_attr(
    not(any(feature = "tool", test)),
    expect(dead_code, reason = "commands and reports write files")
)]
pub(crate) fn column_heads<N: AsRef<str>>(names: impl IntoIterator<Item = N>) -> Vec<String> {
    distinct(names.into_iter().map(|name| name.as_ref().replace([' ', ',', '"'], "_")), '_')
}

/// A name of its own for each that has none: a word, and from the second on its number. `taken` are not given again.
pub(crate) fn numbered(word: &str, taken: &mut HashSet<String>) -> String {
    let mut numbers =
        (1_u32..).map(|n| if n == 1 { word.to_owned() } else { format!("{word} {n}") });
    let own = numbers.find(|name| !taken.contains(name)).unwrap_or_else(|| word.to_owned());
    taken.insert(own.clone());
    own
}

/// The texts, and with a number those that were there before.
fn distinct(texts: impl Iterator<Item = String>, sign: char) -> Vec<String> {
    let texts: Vec<String> = texts.collect();
    let all: HashSet<&str> = texts.iter().map(String::as_str).collect();
    let mut used: HashSet<String> = HashSet::new();
    let mut next: HashMap<&str, u32> = HashMap::new();
    let mut found = Vec::with_capacity(texts.len());
    for text in &texts {
        let mut own = text.clone();
        while !used.insert(own.clone()) {
            let number = next.entry(text).or_insert(1);
            *number += 1;
            own = format!("{text}{sign}{number}");
            // One that is a name itself stays with it.
            if all.contains(own.as_str()) {
                own.clone_from(text);
            }
        }
        found.push(own);
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_of_files_are_distinct_whatever_the_names_are() {
        let names = ["a b", "a-b", "a-b-2", "A,B", "é", "è", "a b", "plain"];
        let found = file_names(names);
        assert_eq!(found, ["a-b", "a-b-3", "a-b-2", "a-b-4", "-", "--2", "a-b-5", "plain"]);
        let different: HashSet<_> = found.iter().collect();
        assert_eq!(different.len(), names.len());
        assert_eq!(column_heads(["a b", "a,b", "c"]), ["a_b", "a_b_2", "c"]);
        let many = vec!["x"; 20_000];
        assert_eq!(file_names(many).last().map(String::as_str), Some("x-20000"));
    }

    #[test]
    fn a_name_is_short_text_in_one_line() {
        let long = "r".repeat(NAME_MAX + 1);
        for (name, fault) in [
            ("", NameFault::Empty),
            (long.as_str(), NameFault::Long(NAME_MAX + 1)),
            ("a\nb", NameFault::Hidden('\n')),
            ("a\u{1b}[31m", NameFault::Hidden('\u{1b}')),
            ("a\u{202e}b", NameFault::Hidden('\u{202e}')),
            (" a", NameFault::Margin),
        ] {
            assert_eq!(name_fault(name), Some(fault), "{name:?}");
        }
        for name in ["0.1 deg", "a,b", "Kamera über Bord", "\"quoted\""] {
            assert_eq!(
                (name_fault(name), column_name_fault(name)),
                (None, Some(NameFault::Column))
            );
        }
        assert_eq!(column_name_fault("cmg_1"), None);
    }
}
