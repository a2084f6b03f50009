//! What the page's template is filled with: sections of blocks, as sim/report/DATA.md states them.

use serde::Serialize;

use super::draw::curves::CurveChart;

/// A section.
#[derive(Serialize)]
pub(super) struct Section {
    /// Its place in the page.
    pub(super) id: &'static str,
    /// Its heading.
    pub(super) title: &'static str,
    /// What it holds; never empty.
    pub(super) blocks: Vec<Block>,
}

impl Section {
    /// Those of these places, headings and blocks that hold something.
    pub(super) fn filled(
        all: impl IntoIterator<Item = (&'static str, &'static str, Vec<Block>)>,
    ) -> Vec<Self> {
        let filled = all.into_iter().filter(|(_, _, blocks)| !blocks.is_empty());
        filled.map(|(id, title, blocks)| Self { id, title, blocks }).collect()
    }
}

/// A part of a section.
#[derive(Serialize)]
#[serde(tag = "kind", rename_all = "lowercase")]
pub(super) enum Block {
    /// A paragraph.
    Text { text: String },
    /// A paragraph in smaller type.
    Note { text: String },
    /// A table.
    Table { caption: String, columns: Vec<Heading>, rows: Vec<TableRow> },
    /// A static figure, and what the script draws in its place.
    Figure {
        id: String,
        number: String,
        caption: String,
        svg: String,
        #[serde(skip)]
        charts: Vec<CurveChart>,
    },
    /// Events, numbered from 1.
    Events { items: Vec<Item> },
    /// A list; `style` is `warnings` or `plain`.
    List { style: &'static str, items: Vec<String> },
    /// The text of a scenario.
    Scenario { lines: Vec<ScenarioLine> },
    /// Where the replay is drawn.
    Replay,
}

/// The head of a column.
#[derive(Serialize)]
pub(super) struct Heading {
    pub(super) title: String,
    pub(super) unit: String,
    pub(super) number: bool,
}

/// A row of a table; `state` is `met`, `violated` or empty.
#[derive(Serialize)]
pub(super) struct TableRow {
    pub(super) state: &'static str,
    pub(super) cells: Vec<Cell>,
}

/// A cell; the first one of a row is its heading.
#[derive(Serialize)]
pub(super) struct Cell {
    pub(super) text: String,
    pub(super) number: bool,
    /// Whether it has the colour of its row's state.
    pub(super) state: bool,
}

/// An event: the time with its unit.
#[derive(Serialize)]
pub(super) struct Item {
    pub(super) time: String,
    pub(super) text: String,
}

/// A line of a scenario's text; `filled` where it is a default.
#[derive(Serialize)]
pub(super) struct ScenarioLine {
    pub(super) text: String,
    pub(super) filled: bool,
}

/// The sentence above everything.
#[derive(Serialize)]
pub(super) struct Verdict {
    /// `met`, `violated` or empty.
    pub(super) state: &'static str,
    /// Printed in bold.
    pub(super) word: String,
    /// What follows.
    pub(super) text: String,
}

/// The first section.
#[derive(Serialize)]
pub(super) struct Summary {
    pub(super) paragraphs: Vec<String>,
    pub(super) facts: Vec<Fact>,
}

/// A line of the summary.
#[derive(Serialize)]
pub(super) struct Fact {
    pub(super) name: String,
    pub(super) value: String,
}

impl Fact {
    pub(super) fn new(name: &str, value: impl Into<String>) -> Self {
        Self { name: name.to_owned(), value: value.into() }
    }
}

/// A table: titles of columns with units, texts in rows. The columns from `numbers` on hold numbers. A row's state is shown by the
/// colour of the cell that says it in words, else of the last one.
pub(super) fn table(
    caption: &str,
    columns: &[(&str, &str)],
    numbers: std::ops::Range<usize>,
    rows: impl IntoIterator<Item = (&'static str, Vec<String>)>,
) -> Block {
    let heading = |(index, (title, unit)): (usize, &(&str, &str))| Heading {
        title: (*title).to_owned(),
        unit: (*unit).to_owned(),
        number: numbers.contains(&index),
    };
    let row = |(state, texts): (&'static str, Vec<String>)| {
        let last = texts.len().saturating_sub(1);
        let said = texts.iter().position(|text| text == state).unwrap_or(last);
        let cell = |(index, text)| Cell {
            text,
            number: numbers.contains(&index),
            state: !state.is_empty() && index == said,
        };
        TableRow { state, cells: texts.into_iter().enumerate().map(cell).collect() }
    };
    Block::Table {
        caption: caption.to_owned(),
        columns: columns.iter().enumerate().map(heading).collect(),
        rows: rows.into_iter().map(row).collect(),
    }
}
