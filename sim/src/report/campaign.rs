//! The page of a sweep or of a Monte Carlo campaign: what became of the requirements, tables, pictures, the scenario.

use super::blocks::{Block, Fact, Section, Summary, Verdict, table};
use super::data::of_curves;
use super::draw::picture::Picture;
use super::error::ReportError;
use super::page::{Page, lines};
use crate::pointing::RequirementState;
use crate::scenario::Scenario;

/// A table of a page, which a terminal shows, too.
#[derive(Clone, Debug)]
pub(crate) struct CampaignTable {
    /// What it shows.
    pub(crate) caption: &'static str,
    /// Heads of its columns.
    pub(crate) heads: Vec<String>,
    /// `met`, `violated` or nothing, and the cells.
    pub(crate) rows: Vec<(&'static str, Vec<String>)>,
    /// The columns that hold numbers.
    pub(crate) numbers: std::ops::Range<usize>,
}

/// What a page of a campaign shows.
pub(crate) struct CampaignPage<'a> {
    /// `sweep`, `Monte Carlo campaign`.
    pub(crate) subject: &'static str,
    pub(crate) scenario: &'a Scenario,
    /// What became of each requirement, with its name.
    pub(crate) states: &'a [(String, RequirementState)],
    /// What was run: names and values.
    pub(crate) facts: Vec<(&'static str, String)>,
    /// Requirements and columns, then other tables.
    pub(crate) tables: Vec<CampaignTable>,
    /// A caption, and the picture.
    pub(crate) pictures: &'a [(String, Picture)],
    /// What has to be said beside.
    pub(crate) warnings: Vec<String>,
    /// The text of the plan, of a Monte Carlo campaign.
    pub(crate) plan: Option<String>,
}

impl CampaignTable {
    /// As rows of text, the heads first.
    pub(crate) fn text(&self) -> Vec<Vec<String>> {
        let rows = self.rows.iter().map(|(_, cells)| cells.clone());
        std::iter::once(self.heads.clone()).chain(rows).collect()
    }

    fn block(&self) -> Block {
        let heads: Vec<(&str, &str)> = self.heads.iter().map(|head| (head.as_str(), "")).collect();
        // A row of a table has a cell in every column.
        let full = |(state, cells): &(&'static str, Vec<String>)| {
            let mut cells = cells.clone();
            cells.resize(heads.len(), String::new());
            (*state, cells)
        };
        table(self.caption, &heads, self.numbers.clone(), self.rows.iter().map(full))
    }
}

impl CampaignPage<'_> {
    /// The page as one HTML file.
    pub(crate) fn html(self) -> Result<String, ReportError> {
        let verdict = self.verdict();
        let pictures = self.pictures.iter().enumerate().map(|(index, (caption, picture))| {
            let number = (index + 1).to_string();
            let id = format!("figure-{number}");
            let (caption, charts) = (caption.clone(), picture.charts());
            Ok(Block::Figure { id, number, caption, svg: picture.inline()?, charts })
        });
        let pictures = pictures.collect::<Result<Vec<_>, ReportError>>()?;
        let tables = self.tables.iter().filter(|table| !table.rows.is_empty());
        let mut sections = vec![
            ("results", "Results", tables.map(CampaignTable::block).collect()),
            ("pictures", "Pictures", pictures),
        ];
        if !self.warnings.is_empty() {
            let (style, items) = ("warnings", self.warnings);
            sections.push(("warnings", "Warnings", vec![Block::List { style, items }]));
        }
        if let Some(plan) = &self.plan {
            sections.push(("plan", "Plan", vec![lines(plan)]));
        }
        let text = &self.scenario.source.text;
        sections.push(("scenario", "Scenario", vec![lines(text)]));
        let sections = Section::filled(sections);
        let page = Page {
            subject: self.subject,
            title: &self.scenario.title,
            name: &self.scenario.name,
            data: of_curves(&self.scenario.name, &self.scenario.title, &sections)?,
            verdict,
            summary: Summary {
                paragraphs: Vec::new(),
                facts: self.facts.into_iter().map(|(name, value)| Fact::new(name, value)).collect(),
            },
            sections,
        };
        page.html()
    }

    fn verdict(&self) -> Verdict {
        let all = self.states.len();
        let names = |of: &dyn Fn(&RequirementState) -> bool| -> Vec<&str> {
            self.states
                .iter()
                .filter(|(_, state)| of(state))
                .map(|(name, _)| name.as_str())
                .collect()
        };
        let violated = names(&RequirementState::is_violated);
        let missing = names(&|state| state.reason().is_some());
        let (state, word, text) = if all == 0 {
            ("", "Complete.".to_owned(), "The scenario states no requirements.".to_owned())
        } else if !violated.is_empty() {
            let word = match all {
                1 => "The requirement is violated:".to_owned(),
                all => format!("{} of {all} requirements violated:", violated.len()),
            };
            ("violated", word, format!("{}.", violated.join(", ")))
        } else if !missing.is_empty() {
            let word = format!("{} of {all} requirements not evaluated:", missing.len());
            ("", word, format!("{}.", missing.join(", ")))
        } else {
            let word = match all {
                1 => "The requirement is met".to_owned(),
                all => format!("All {all} requirements are met"),
            };
            ("met", word, "by every sample.".to_owned())
        };
        Verdict { state, word, text }
    }
}
