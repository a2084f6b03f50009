//! The notes after a printed block: how it differs, and how we tell.

use std::fmt;

/// What a note says of the print.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Class {
    /// Block and right form are equal.
    Agrees,
    /// The difference is the paper's.
    Slip,
    /// One small mark that the paper or the scan may have exchanged or added.
    Undecided,
    /// A loss of the scan explains it.
    Scan,
    /// Torn.
    Unreadable,
    /// Gives a symbol its value, names components, or lists what is assumed.
    Definition,
}

/// What a note is about.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Subject {
    /// A term of the right side.
    Value,
    /// The name on the left.
    LeftSide,
    /// How a doubtful mark is read in the block.
    Reading,
    /// A mark without effect on a value.
    Notation,
    /// The text between the equations.
    Wording,
    /// The equation as a whole.
    Remark,
}

/// What the print has, and what belongs there; `0` is nothing.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Change {
    /// As printed, in the syntax of the blocks.
    pub printed: String,
    /// What belongs there.
    pub right: String,
}

/// What a page says of an equation as printed.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Note {
    /// Its class.
    pub class: Class,
    /// What it is about.
    pub subject: Subject,
    /// The entry of a tensor, `23`; its mirror image is meant too.
    pub place: Option<String>,
    /// The term that differs.
    pub change: Option<Change>,
    /// All it says, but for class, evidence and cause.
    pub text: String,
    /// The evidence, from "How we tell:" on.
    pub how: Option<String>,
    /// What it says besides its change, or before its best reading.
    pub words: String,
    /// The letters of the causes it names.
    pub causes: Vec<char>,
    /// Of what is torn: the best reading, in the syntax of the blocks.
    pub best: Option<String>,
    /// Of what is torn: what else was tried.
    pub tried: Option<String>,
    /// Line in the page.
    pub line: usize,
}

impl Note {
    /// Whether it names a term, and so a difference in value.
    #[must_use]
    pub fn changes_value(&self) -> bool {
        self.change.is_some()
    }

    /// Whether it names a difference on the left side.
    #[must_use]
    pub fn changes_left_side(&self) -> bool {
        self.subject == Subject::LeftSide
    }
}

/// The notes among the lines after a block.
///
/// # Errors
/// The first item that begins with a class and is no note, with its line.
pub(super) fn notes(lines: &[(usize, &str)]) -> Result<Vec<Note>, (usize, String)> {
    let mut items: Vec<(usize, String)> = Vec::new();
    let mut open = false;
    for (line, text) in lines {
        if text.starts_with("- `") {
            items.push((*line, (*text).to_owned()));
            open = true;
        } else if let (true, Some(more), Some((_, item))) =
            (open, text.strip_prefix("  "), items.last_mut())
        {
            item.push(' ');
            item.push_str(more.trim());
        } else {
            open = false;
        }
    }
    let read = |(line, item): (usize, String)| note(&item, line).ok_or((line, item));
    items.into_iter().map(read).collect()
}

/// ``- `slip`: at 23: `a` -> `b`, in words. How we tell: evidence. Cause A.``
fn note(item: &str, line: usize) -> Option<Note> {
    let (class, rest) = item.strip_prefix("- `")?.split_once('`')?;
    let class = Class::named(class)?;
    let rest = if rest.is_empty() { rest } else { rest.strip_prefix(": ")? };
    let (rest, causes) = causes(rest);
    let (text, how) = match rest.split_once("How we tell: ") {
        Some((text, how)) => (text.trim_end(), Some(how.to_owned())),
        None => (rest, None),
    };
    let mut note = Note {
        class,
        subject: subject(class, text),
        place: None,
        change: None,
        text: text.to_owned(),
        words: text.to_owned(),
        how,
        causes,
        best: None,
        tried: None,
        line,
    };
    match note.class {
        Class::Unreadable => note.torn()?,
        _ if note.subject == Subject::Value => {
            let (place, rest) = placed(text);
            let (printed, rest) = code(rest)?;
            let (right, rest) = code(rest.strip_prefix(" -> ")?)?;
            (note.place, note.change) = (place, Some(Change { printed, right }));
            let words = rest.trim_start_matches([',', '.', ';', ' ']);
            words.clone_into(&mut note.words);
        }
        _ => {}
    }
    Some(note)
}

impl Note {
    /// `raw; best reading at 23: code; tried: words; belongs there at 23: code`.
    fn torn(&mut self) -> Option<()> {
        let (raw, best) = self.text.split_once("best reading ")?;
        self.words = raw.trim_end_matches([';', ' ']).to_owned();
        let (place, best) = placed(best);
        let (best, rest) = code(best)?;
        let (_, tried) = rest.split_once("tried: ")?;
        let (tried, belongs) = match tried.split_once("; belongs there ") {
            Some((tried, belongs)) => (tried, Some(belongs)),
            None => (tried.trim_end_matches('.'), None),
        };
        self.tried = Some(tried.to_owned());
        if let Some(belongs) = belongs {
            let (right, _) = code(placed(belongs).1)?;
            self.change = Some(Change { printed: "0".to_owned(), right });
        }
        (self.place, self.best) = (place, Some(best));
        Some(())
    }
}

fn subject(class: Class, text: &str) -> Subject {
    let begins = [
        ("left side ", Subject::LeftSide),
        ("reading: ", Subject::Reading),
        ("notation: ", Subject::Notation),
        ("wording: ", Subject::Wording),
    ];
    match begins.into_iter().find(|(begin, _)| text.starts_with(begin)) {
        Some((_, subject)) => subject,
        None if matches!(class, Class::Agrees | Class::Definition) => Subject::Remark,
        None => Subject::Value,
    }
}

/// Splits `at 23: ` off.
fn placed(text: &str) -> (Option<String>, &str) {
    let place = text.strip_prefix("at ").and_then(|rest| rest.split_once(": "));
    place.map_or((None, text), |(place, rest)| (Some(place.to_owned()), rest))
}

/// One or more pieces of code, joined, and what follows them.
fn code(text: &str) -> Option<(String, &str)> {
    let (first, mut rest) = text.strip_prefix('`')?.split_once('`')?;
    let mut code = first.to_owned();
    while let Some((piece, behind)) = rest.strip_prefix(" `").and_then(|rest| rest.split_once('`'))
    {
        code.push(' ');
        code.push_str(piece);
        rest = behind;
    }
    Some((code, rest))
}

/// Splits `Cause A.` or `Causes A, C.` off the end.
fn causes(text: &str) -> (&str, Vec<char>) {
    let list = |(rest, list): (&'_ str, &str)| {
        let letters = list.strip_suffix('.')?.split(", ");
        let one = |piece: &str| match piece.chars().collect::<Vec<_>>()[..] {
            [letter] if letter.is_ascii_uppercase() => Some(letter),
            _ => None,
        };
        Some((rest.len(), letters.map(one).collect::<Option<Vec<_>>>()?))
    };
    let found = text.rsplit_once("Cause ").or_else(|| text.rsplit_once("Causes ")).and_then(list);
    found.map_or((text, Vec::new()), |(end, letters)| (text[..end].trim_end(), letters))
}

impl Class {
    const NAMES: [(&'static str, Self); 6] = [
        ("agrees", Self::Agrees),
        ("slip", Self::Slip),
        ("undecided", Self::Undecided),
        ("scan", Self::Scan),
        ("unreadable", Self::Unreadable),
        ("definition", Self::Definition),
    ];

    fn named(name: &str) -> Option<Self> {
        Self::NAMES.into_iter().find(|(known, _)| *known == name).map(|(_, class)| class)
    }
}

impl fmt::Display for Class {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let name = Self::NAMES.into_iter().find(|(_, class)| class == self);
        f.pad(name.map_or("", |(name, _)| name))
    }
}

impl fmt::Display for Subject {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(match self {
            Self::Value | Self::Remark => "",
            Self::LeftSide => "left side",
            Self::Reading => "reading",
            Self::Notation => "notation",
            Self::Wording => "wording",
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn one(text: &str) -> Note {
        let lines: Vec<_> = (1..).zip(text.lines()).collect();
        let [note] = notes(&lines).unwrap().try_into().unwrap();
        note
    }

    #[test]
    fn a_wrapped_note_is_read_whole() {
        let note = one("- `slip`: at 23: `a` `+ b\n  + c` -> `0`, in words. How we tell: it\n  \
                        shows. Causes A, C.\n");
        let change = Change { printed: "a + b + c".into(), right: "0".into() };
        assert_eq!((note.class, note.subject), (Class::Slip, Subject::Value));
        assert_eq!((note.place.as_deref(), note.change), (Some("23"), Some(change)));
        assert_eq!((note.how.as_deref(), &note.causes[..]), (Some("it shows."), &['A', 'C'][..]));
        assert_eq!(note.text, "at 23: `a` `+ b + c` -> `0`, in words.");
    }

    #[test]
    fn what_is_torn_has_a_reading_and_what_was_tried() {
        let note = one(
            "- `unreadable`: `~~`; best reading at 23: `a`; tried: b; belongs there at 23: `c`.",
        );
        let change = Change { printed: "0".into(), right: "c".into() };
        assert_eq!((note.place.as_deref(), note.change), (Some("23"), Some(change)));
        assert_eq!((note.best.as_deref(), note.tried.as_deref()), (Some("a"), Some("b")));
        let lost = one("- `unreadable`: all; best reading `a`; tried: nothing else.");
        assert_eq!((lost.changes_value(), lost.tried.as_deref()), (false, Some("nothing else")));
    }

    #[test]
    fn readings_and_left_sides_change_no_value() {
        assert_eq!(one("- `scan`: left side $a$ -> $b$.").subject, Subject::LeftSide);
        assert_eq!(one("- `scan`: reading: `a`; read b.").subject, Subject::Reading);
        assert_eq!(one("- `agrees`: with `a` put in.").subject, Subject::Remark);
        assert!(!one("- `slip`: notation: `a` -> `b`.").changes_value());
    }

    #[test]
    fn a_note_without_a_change_is_refused_with_its_line() {
        let item = "- `slip`: something is wrong.";
        assert_eq!(notes(&[(7, item)]), Err((7, item.to_owned())));
        assert!(notes(&[(1, "- `smudge`: `a` -> `b`.")]).is_err());
    }
}
