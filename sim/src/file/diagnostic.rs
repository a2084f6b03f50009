//! [`Diagnostic`]: an error or a warning at a place of a scenario file, and how it is shown.

use std::fmt;
use std::ops::Range;
use std::path::PathBuf;

use annotate_snippets::{AnnotationKind, Group, Level, Renderer, Snippet};
use serde::Serialize;

/// Most errors and warnings that are shown: whoever has more mends the first ones.
const SHOWN_MAX: usize = 100;
/// A new one is compared with so many before it.
const COMPARED_MAX: usize = 1000;

/// A text that was read: a file, an override, a text that a program passed.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SourceText {
    /// How it is named in messages.
    pub name: String,
    /// The text.
    pub text: String,
    /// The folder of the file, from which it names others; none of what is no file.
    pub folder: Option<PathBuf>,
    /// What a number without a unit is in it.
    pub numbers: Numbers,
}

/// What a number without a unit is, where a quantity is wanted.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Numbers {
    /// An error: in a file that people read, each number states its unit.
    #[default]
    WithUnits,
    /// In SI units and radians: in what a program passes.
    Si,
}

/// A part of a text, bytes from its start.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Span {
    /// Which text.
    pub source: usize,
    /// Which part.
    pub range: Range<usize>,
}

/// How bad it is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Severity {
    /// The scenario cannot be run.
    Error,
    /// It can, and it may not be what is meant.
    Warning,
}

/// An error or a warning.
#[derive(Clone, Debug, PartialEq)]
pub struct Diagnostic {
    /// How bad it is.
    pub severity: Severity,
    /// Where; none where it belongs to no place of a text.
    pub span: Option<Span>,
    /// What is wrong.
    pub message: String,
    /// The text below the underlined place; may be empty.
    pub label: String,
    /// What to do; may be empty.
    pub help: String,
}

/// Errors and warnings of a scenario, with the texts that they are about.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Diagnostics {
    /// The texts.
    pub sources: Vec<SourceText>,
    /// In the order in which they were found.
    pub all: Vec<Diagnostic>,
}

/// A diagnostic for tools.
#[derive(Serialize)]
struct Entry<'a> {
    severity: Severity,
    file: &'a str,
    line: usize,
    column: usize,
    end_line: usize,
    end_column: usize,
    message: &'a str,
    label: &'a str,
    help: &'a str,
}

impl Diagnostics {
    /// Whether there is an error.
    #[must_use]
    pub fn has_errors(&self) -> bool {
        self.errors() > 0
    }

    /// How many errors there are.
    pub(super) fn errors(&self) -> usize {
        self.all.iter().filter(|diagnostic| diagnostic.severity == Severity::Error).count()
    }

    /// Adds a sentence to the help of the errors from a number on; not of unknown keys, which are where they are written.
    pub(super) fn add_help(&mut self, first: usize, sentence: &str) {
        let wanted = |of: &&mut Diagnostic| {
            of.severity == Severity::Error && !of.message.starts_with("unknown key")
        };
        for error in self.all.iter_mut().skip(first).filter(wanted) {
            if !error.help.is_empty() {
                error.help.push_str("; ");
            }
            error.help.push_str(sentence);
        }
    }

    /// Removes an error of which another one is the cause.
    pub(super) fn retract(&mut self, span: &Span, message: &str) {
        self.all.retain(|of| of.span.as_ref() != Some(span) || of.message != message);
    }

    /// What a number without a unit is at a place.
    pub(super) fn numbers_at(&self, span: &Span) -> Numbers {
        self.sources.get(span.source).map_or(Numbers::WithUnits, |source| source.numbers)
    }

    /// Adds an error.
    pub fn error(&mut self, span: &Span, message: impl Into<String>, label: &str, help: &str) {
        self.add(Severity::Error, Some(span.clone()), message.into(), label, help);
    }

    /// Adds a warning.
    pub fn warn(&mut self, span: &Span, message: impl Into<String>, label: &str, help: &str) {
        self.add(Severity::Warning, Some(span.clone()), message.into(), label, help);
    }

    /// Adds an error that belongs to no place of a text.
    pub fn error_anywhere(&mut self, message: impl Into<String>, help: &str) {
        self.add(Severity::Error, None, message.into(), "", help);
    }

    fn add(
        &mut self,
        severity: Severity,
        span: Option<Span>,
        message: String,
        label: &str,
        help: &str,
    ) {
        let (label, help) = (label.to_owned(), help.to_owned());
        let new = Diagnostic { severity, span, message, label, help };
        // What is said twice is said of one place, and soon again: of very many the first need not be compared.
        let recent = self.all.len().saturating_sub(COMPARED_MAX);
        if !self.all.iter().skip(recent).any(|known| *known == new) {
            self.all.push(new);
        }
    }

    /// Those that are shown, and how many more there are: of very many the first errors.
    fn shown_ones(&self) -> (Vec<&Diagnostic>, usize) {
        let mut shown: Vec<_> = self.all.iter().collect();
        let more = shown.len().saturating_sub(SHOWN_MAX);
        if more > 0 {
            shown.sort_by_key(|diagnostic| diagnostic.severity == Severity::Warning);
            shown.truncate(SHOWN_MAX);
        }
        (shown, more)
    }

    /// As JSON, one object each, of the first hundred, for tools: lines and columns count from 1.
    #[must_use]
    pub fn json(&self) -> String {
        let (shown, more) = self.shown_ones();
        let mut entries: Vec<_> = shown.into_iter().map(|of| self.entry(of)).collect();
        let rest = Diagnostic {
            severity: Severity::Error,
            span: None,
            message: more_of_them(more),
            label: String::new(),
            help: String::new(),
        };
        if more > 0 {
            entries.push(self.entry(&rest));
        }
        // Texts and numbers only: writing to memory cannot fail.
        serde_json::to_string_pretty(&entries).unwrap_or_default()
    }

    fn entry<'a>(&'a self, diagnostic: &'a Diagnostic) -> Entry<'a> {
        let source = diagnostic.span.as_ref().and_then(|span| self.sources.get(span.source));
        let text = source.map_or("", |source| &source.text);
        let range = diagnostic.span.as_ref().map_or(0..0, |span| span.range.clone());
        let ((line, column), (end_line, end_column)) =
            (place(text, range.start), place(text, range.end));
        Entry {
            severity: diagnostic.severity,
            file: source.map_or("", |source| &source.name),
            line,
            column,
            end_line,
            end_column,
            message: &diagnostic.message,
            label: &diagnostic.label,
            help: &diagnostic.help,
        }
    }

    fn shown(&self, diagnostic: &Diagnostic) -> String {
        let level = match diagnostic.severity {
            Severity::Error => Level::ERROR,
            Severity::Warning => Level::WARNING,
        };
        let title = level.primary_title(diagnostic.message.as_str());
        let source = diagnostic.span.as_ref().and_then(|span| {
            self.sources.get(span.source).map(|source| (source, clipped(&source.text, span)))
        });
        let main = match &source {
            Some((source, range)) => {
                let mark = AnnotationKind::Primary.span(range.clone());
                let mark = if diagnostic.label.is_empty() {
                    mark
                } else {
                    mark.label(diagnostic.label.as_str())
                };
                let snippet = Snippet::source(source.text.as_str()).path(source.name.as_str());
                title.element(snippet.line_start(1).fold(true).annotation(mark))
            }
            None => Group::with_title(title),
        };
        let mut groups = vec![main];
        if !diagnostic.help.is_empty() {
            let help = Level::HELP.secondary_title(diagnostic.help.as_str());
            groups.push(Group::with_title(help));
        }
        Renderer::plain().render(&groups)
    }
}

/// What is said of those that are not shown.
fn more_of_them(more: usize) -> String {
    format!("{more} more errors and warnings; mend the first ones")
}

/// The span within its text, on the borders of characters, its first line only.
fn clipped(text: &str, span: &Span) -> Range<usize> {
    let floor = |mut at: usize| {
        at = at.min(text.len());
        while !text.is_char_boundary(at) {
            at -= 1;
        }
        at
    };
    let (start, end) = (floor(span.range.start), floor(span.range.end));
    let line = text.get(start..end).unwrap_or_default();
    let first = line.find('\n').map_or(end, |at| start + at);
    start..first.max(start)
}

/// Line and column of a byte, from 1; columns count characters.
fn place(text: &str, at: usize) -> (usize, usize) {
    let before = text.get(..at.min(text.len())).unwrap_or(text);
    let line = before.bytes().filter(|byte| *byte == b'\n').count() + 1;
    let start = before.rfind('\n').map_or(0, |at| at + 1);
    (line, before.get(start..).unwrap_or_default().chars().count() + 1)
}

impl fmt::Display for Diagnostics {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (shown, more) = self.shown_ones();
        for (index, diagnostic) in shown.iter().enumerate() {
            if index > 0 {
                f.write_str("\n")?;
            }
            writeln!(f, "{}", self.shown(diagnostic))?;
        }
        if more > 0 {
            writeln!(f, "\n{}", more_of_them(more))?;
        }
        Ok(())
    }
}

impl std::error::Error for Diagnostics {}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_error_shows_file_line_mark_and_remedy() {
        let text = "[hub]\nmas = \"4 kg\"\n".to_owned();
        let sources = vec![SourceText {
            name: "bus.toml".to_owned(),
            text,
            folder: None,
            numbers: Numbers::WithUnits,
        }];
        let mut diagnostics = Diagnostics { sources, all: Vec::new() };
        let span = Span { source: 0, range: 6..9 };
        diagnostics.error(&span, "unknown key `mas`", "", "did you mean `mass`?");
        let shown = diagnostics.to_string();
        for part in
            ["error: unknown key `mas`", "bus.toml:2:1", "^^^", "help: did you mean `mass`?"]
        {
            assert!(shown.contains(part), "{shown}");
        }
        let json = diagnostics.json();
        assert!(json.contains("\"line\": 2") && json.contains("\"end_column\": 4"), "{json}");
    }

    #[test]
    fn a_span_beyond_its_text_is_clipped() {
        let sources = vec![SourceText {
            name: "a".to_owned(),
            text: "é".to_owned(),
            folder: None,
            numbers: Numbers::WithUnits,
        }];
        let mut diagnostics = Diagnostics { sources, all: Vec::new() };
        diagnostics.error(&Span { source: 0, range: 1..900 }, "wrong", "here", "");
        assert!(diagnostics.to_string().contains("wrong"));
    }
}
