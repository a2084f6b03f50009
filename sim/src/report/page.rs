//! The page: sections in their order, filled into sim/report/shell.html with the script, the
//! stylesheet and their hashes.

use std::fmt::Write as _;

use serde::{Deserialize, Serialize};
use tera::{Context, Tera};

use super::blocks::{Block, Item, ScenarioLine, Section, Summary, Verdict};
use super::data::{data, figure_id};
use super::error::ReportError;
use super::run::chart::{Part, ScaledChart};
use super::run::replay::{Collector, ReplayData};
use super::run::{load_tables, mass, requirements, summary, tables};
use super::{Report, number};
use crate::record::Outcome;

const SHELL: &str = include_str!("../../report/shell.html");
const SCRIPT: &str = include_str!("../../report/dist/report.js");
const STYLE: &str = include_str!("../../report/dist/report.css");
const HASHES: &str = include_str!("../../report/dist/hashes.json");

/// Most events on the page; the outcome may have ten thousand.
const EVENTS_MAX: usize = 60;

/// What dist/hashes.json holds.
#[derive(Deserialize)]
struct Hashes {
    script: String,
    style: String,
}

/// A page to be rendered.
#[derive(Serialize)]
pub(super) struct Page<'a> {
    /// What it is: `report of a run`.
    pub(super) subject: &'static str,
    /// Its heading.
    pub(super) title: &'a str,
    /// The name of the scenario.
    pub(super) name: &'a str,
    /// The data block.
    pub(super) data: String,
    pub(super) verdict: Verdict,
    pub(super) summary: Summary,
    pub(super) sections: Vec<Section>,
}

/// A page with what every page has.
#[derive(Serialize)]
struct RenderedPage<'a> {
    #[serde(flatten)]
    page: &'a Page<'a>,
    made: String,
    style: &'static str,
    script: &'static str,
    style_hash: String,
    script_hash: String,
}

impl Page<'_> {
    /// The page as one HTML file.
    pub(super) fn html(&self) -> Result<String, ReportError> {
        let hashes: Hashes = serde_json::from_str(HASHES)?;
        let whole = RenderedPage {
            page: self,
            made: format!(
                "Written by precess {}. This page holds everything it shows and fetches nothing.",
                env!("CARGO_PKG_VERSION")
            ),
            style: STYLE,
            script: SCRIPT,
            style_hash: hashes.style,
            script_hash: hashes.script,
        };
        let mut tera = Tera::new();
        tera.add_raw_template("shell.html", SHELL)?;
        Ok(tera.render("shell.html", &Context::from_serialize(&whole)?)?)
    }
}

/// The page of a run.
pub(super) fn page(report: &Report, outcome: &Outcome) -> Result<String, ReportError> {
    let scenario = &report.scenario;
    let drawn = report.drawn();
    let replay =
        report.collected.as_ref().and_then(|c| c.replay.as_ref().and_then(Collector::data));
    let events = &outcome.events[..outcome.events.len().min(EVENTS_MAX)];
    let buckets = report.collected.as_ref().map_or(&[][..], |c| c.history.buckets());
    let time: Vec<_> = buckets.iter().map(|bucket| bucket.start).collect();
    let page = Page {
        subject: "report of a run",
        title: &scenario.title,
        name: &scenario.name,
        data: data(scenario, &time, outcome.end_time, &drawn, events, replay.as_ref())?,
        verdict: summary::verdict(report, outcome),
        summary: summary::summary(report, outcome),
        sections: sections(report, outcome, &drawn, replay.as_ref())?,
    };
    page.html()
}

fn sections(
    report: &Report,
    outcome: &Outcome,
    drawn: &[ScaledChart],
    replay: Option<&ReplayData>,
) -> Result<Vec<Section>, ReportError> {
    let mut number = 0;
    let mut figures = |part: Part| -> Result<Vec<Block>, ReportError> {
        let of_part = drawn.iter().filter(|drawn| drawn.part == part);
        of_part
            .map(|drawn| {
                number += 1;
                Ok(Block::Figure {
                    id: figure_id(drawn),
                    number: number.to_string(),
                    caption: caption(drawn),
                    svg: drawn.figure().inline()?,
                    charts: Vec::new(),
                })
            })
            .collect()
    };
    let mut histories = events(outcome);
    histories.extend(figures(Part::Histories)?);
    histories.extend(zero_note(report));
    let mut energy = tables::energy(report, outcome);
    energy.extend(figures(Part::Energy)?);
    let mut loads = load_tables::loads(report);
    loads.extend(figures(Part::Loads)?);
    let sections = [
        ("requirements", "Requirements", requirements::table_of(report)),
        ("histories", "Time histories", histories),
        ("energy", "Energy, momentum and drifts", energy),
        ("replay", "Replay", replay_blocks(report, replay)),
        ("mass", "Mass properties", mass::blocks(&report.scenario)),
        ("loads", "Joint torques and loads", loads),
        ("warnings", "Warnings", warnings(report)),
        ("scenario", "Scenario", scenario_text(report)),
    ];
    let sections = sections.into_iter().filter(|(_, _, blocks)| !blocks.is_empty());
    Ok(sections.map(|(id, title, blocks)| Section { id, title, blocks }).collect())
}

fn caption(drawn: &ScaledChart) -> String {
    let banded = drawn.curves.iter().any(|curve| curve.min != curve.max);
    let mut frames: Vec<_> = drawn.curves.iter().map(|curve| curve.curve.frame.as_str()).collect();
    frames.dedup();
    let mut caption = drawn.title.clone();
    if let ([frame], false) = (frames.as_slice(), frames == [""]) {
        caption = format!("{caption}, expressed in {frame}");
    }
    caption.push('.');
    if banded {
        caption.push_str(" Bands: least to greatest sample.");
    }
    for same in drawn.equal() {
        let _ = write!(
            caption,
            " Only one of these curves is seen, since they lie on one another: {}.",
            same.join(", ")
        );
    }
    let peak = drawn.peak();
    for limit in drawn.limits.iter().filter(|limit| limit.near(peak).is_empty()) {
        let _ = write!(caption, " Beyond the axis: {}, {}.", limit.label, limit.written);
    }
    caption
}

fn events(outcome: &Outcome) -> Vec<Block> {
    if outcome.events.is_empty() {
        return Vec::new();
    }
    let item = |event: &crate::record::Event| Item {
        time: format!("{} s", number::time(event.time)),
        text: event.text.clone(),
    };
    let mut blocks =
        vec![Block::Events { items: outcome.events.iter().take(EVENTS_MAX).map(item).collect() }];
    let more = u64::try_from(outcome.events.len().saturating_sub(EVENTS_MAX)).unwrap_or(0);
    let more = more + outcome.events_omitted;
    if more > 0 {
        let text = format!("{} later events are not listed.", number::count(more));
        blocks.push(Block::Note { text });
    }
    blocks
}

fn zero_note(report: &Report) -> Option<Block> {
    let zero = report.zero_charts();
    let text = || format!("Zero throughout, and not drawn: {}.", zero.join("; "));
    (!zero.is_empty()).then(|| Block::Note { text: text() })
}

fn replay_blocks(report: &Report, replay: Option<&ReplayData>) -> Vec<Block> {
    match replay {
        Some(replay) => {
            let mut blocks = vec![Block::Replay];
            if replay.step > std::f64::consts::PI {
                let text = "Between two pictures of the whole run the hub makes more than half a \
                            turn: its turning is not shown as it was.";
                blocks.push(Block::Note { text: text.to_owned() });
            }
            blocks
        }
        None if report.collected.is_some() => vec![Block::Note {
            text: "No replay: it needs two samples or more, of the attitude, angular velocity, \
                   angular momentum and all joints; output.columns leaves some of them out."
                .to_owned(),
        }],
        None => Vec::new(),
    }
}

fn warnings(report: &Report) -> Vec<Block> {
    if report.warnings.is_empty() {
        return vec![Block::Text { text: "There are no warnings.".to_owned() }];
    }
    let items = report.warnings.iter().map(|text| number::with_powers(text)).collect();
    vec![Block::List { style: "warnings", items }]
}

fn scenario_text(report: &Report) -> Vec<Block> {
    let source = &report.scenario.source;
    let mut blocks = Vec::new();
    if !source.text.is_empty() {
        let digest = report.collected.as_ref().and_then(|c| c.header.sha256.as_deref());
        // In groups, so that a narrow page can break it.
        let groups = |digest: &str| {
            let groups = digest.as_bytes().chunks(16);
            groups.map(String::from_utf8_lossy).collect::<Vec<_>>().join(" ")
        };
        let digest = digest.map_or_else(String::new, |d| format!(" SHA-256: {}.", groups(d)));
        blocks.push(Block::Note { text: format!("As it was read.{digest}") });
        blocks.push(lines(&source.text));
    }
    if !source.filled.is_empty() {
        let text = "In SI units, with layouts, copies, data sheets and defaults written out; it gives the same run. What has no default is here only if it was given: a torque limit, an end stop, gravity.".to_owned();
        blocks.push(Block::Note { text });
        blocks.push(lines(&source.filled));
    }
    if blocks.is_empty() {
        let text = "The scenario was built by a program; there is no file.".to_owned();
        blocks.push(Block::Note { text });
    }
    blocks
}

/// The text of a file.
pub(super) fn lines(text: &str) -> Block {
    let line = |line: &str| ScenarioLine { text: line.to_owned(), filled: false };
    Block::Scenario { lines: text.lines().map(line).collect() }
}
