//! [`JitterReport`]: the page of a jitter budget: verdict and margins first, then contributors, the metrics over the
//! speed, waterfall and Campbell diagram, the two paths, inputs, assumptions.

mod crossings;
mod figures;
mod inputs;
mod peaks;
mod tables;
mod verdict;

use std::f64::consts::TAU;

use super::blocks::{Block, Fact, Section, Summary, table};
use super::error::{DrawError, ReportError};
use super::number::{short, with_unit};
use super::page::{Page, lines};
use super::row_state;
use crate::jitter::budget::{Assessed, Budget};
use crate::jitter::campbell::{Branch, Crossing};
use crate::jitter::coupled::Compared;
use crate::jitter::own_speeds::AtOwnSpeeds;
use crate::jitter::sensitivity::Sensitivity;
use crate::jitter::sweep::{Phases, Sweep};
use crate::names::file_names;
use crate::pointing::Metric;
use crate::scenario::Scenario;
pub(crate) use tables::disagreements;

/// Revolutions per minute of one radian per second.
pub(super) const RPM: f64 = 60.0 / TAU;
/// Contributors that a table shows.
const ROWS_MAX: usize = 24;

/// What the two paths may differ by off resonance, and at it.
pub(crate) const AGREEMENT: [f64; 2] = [0.01, 0.05];

/// Everything that the page shows.
pub(crate) struct JitterReport<'a> {
    pub(crate) scenario: &'a Scenario,
    pub(crate) budget: &'a Budget,
    /// The text of the budget's file.
    pub(crate) text: &'a str,
    pub(crate) sweep: &'a Sweep,
    /// The rotors that have the speed of the sweep, in words.
    pub(crate) rotors: &'a str,
    pub(crate) assessed: &'a [Assessed],
    /// The same with each rotor at its own speed; empty where it is not known.
    pub(crate) at_own_speeds: &'a [AtOwnSpeeds],
    /// Speeds of the branches, rad/s.
    pub(crate) campbell_speeds: &'a [f64],
    pub(crate) branches: &'a [Branch],
    pub(crate) crossings: &'a [Crossing],
    /// Runs of the coupled equations; at resonance or not.
    pub(crate) compared: &'a [(Compared, bool)],
    /// Whether a rotor has tones of its own, which runs of the coupled equations have.
    pub(crate) has_imbalance: bool,
    /// Of each requirement.
    pub(crate) sensitivities: &'a [Vec<Sensitivity>],
    /// The controller whose loop is closed.
    pub(crate) controller: Option<&'a str>,
    pub(crate) warnings: &'a [String],
}

/// A speed in rpm.
pub(crate) fn rpm(speed: f64) -> String {
    format!("{} rpm", short(speed * RPM, 5))
}

/// The speeds of rotors that are as in the scenario, in words.
pub(crate) const OWN_SPEEDS: &str = "its own speeds";

/// The speed at which a metric is largest, in words; of one that does not vary it is the first.
pub(crate) fn worst_speed(speeds: &[f64], worst: usize, is_flat: bool) -> String {
    let same = if is_flat { ", the same at every speed" } else { "" };
    speeds.get(worst).map_or_else(String::new, |speed| format!("{}{same}", rpm(*speed)))
}

/// What a metric is, in words.
pub(crate) fn metric(metric: &Metric) -> String {
    let time = |t: f64| format!("{} s", short(t, 4));
    match metric {
        Metric::Rms => "RMS".to_owned(),
        Metric::BandRms([from, to]) => format!("RMS, {} to {} Hz", short(*from, 4), short(*to, 4)),
        Metric::Displacement(t) => format!("displacement, exposure {}", time(*t)),
        Metric::Smear(t) => format!("smear, exposure {}", time(*t)),
        Metric::Jitter(t) => format!("jitter, exposure {}", time(*t)),
        Metric::Index { index, .. } => index.name().to_owned(),
    }
}

/// Intervals of speed in words.
pub(crate) fn intervals(bands: &[[f64; 2]]) -> String {
    let one =
        |[from, to]: &[f64; 2]| format!("{} to {} rpm", short(from * RPM, 4), short(to * RPM, 4));
    if bands.is_empty() {
        "none".to_owned()
    } else {
        bands.iter().map(one).collect::<Vec<_>>().join(", ")
    }
}

impl JitterReport<'_> {
    /// The page as one HTML file.
    pub(crate) fn html(&self) -> Result<String, ReportError> {
        let mut sections = vec![("requirements", "Requirements", self.requirements()?)];
        sections.push(("contributors", "Contributors at the worst speeds", self.contributors()));
        sections.push(("speeds", "Lines over the speed", self.waterfalls()?));
        sections.push(("crossings", "Natural frequencies and orders", self.campbell()?));
        sections.push(("paths", "Frequency domain beside the coupled run", self.paths()));
        sections.push(("sensitivities", "Sensitivities", self.ranked()));
        sections.push(("inputs", "Inputs", self.inputs()));
        sections.push(("assumptions", "Assumptions", vec![self.assumptions()]));
        if !self.warnings.is_empty() {
            let items = self.warnings.to_vec();
            sections.push(("warnings", "Warnings", vec![Block::List { style: "warnings", items }]));
        }
        sections.push(("budget", "Budget", vec![lines(self.text)]));
        let sections = Section::filled(sections);
        let page = Page {
            subject: "jitter budget",
            title: &self.budget.title,
            name: &self.scenario.name,
            data: super::data::of_curves(&self.scenario.name, &self.budget.title, &sections)?,
            verdict: self.verdict(),
            summary: self.summary(),
            sections,
        };
        page.html()
    }

    /// The pictures as files: a name and the text of the SVG file.
    pub(crate) fn figures(&self) -> Result<Vec<(String, String)>, DrawError> {
        let mut files = Vec::new();
        for (index, of) in self.assessed.iter().enumerate() {
            files.push((format!("requirement-{}", index + 1), self.over_speed(of).file()?));
        }
        let names = file_names(self.budget.sights.iter().map(|of| &of.name));
        for (sight, name) in names.iter().enumerate() {
            files.push((format!("waterfall-{name}"), self.waterfall(sight).file()?));
        }
        for (index, of) in self.assessed.iter().enumerate() {
            files.push((format!("cumulative-{}", index + 1), self.cumulative(of).file()?));
        }
        for (index, of) in self.assessed.iter().enumerate() {
            if let Some(figure) = self.density(of) {
                files.push((format!("density-{}", index + 1), figure.file()?));
            }
        }
        if let Some(diagram) = self.campbell_diagram() {
            files.push(("campbell".to_owned(), diagram.file()?));
        }
        Ok(files)
    }

    fn summary(&self) -> Summary {
        let [from, to] = self.budget.speeds;
        let title = self.scenario.title.trim_end_matches('.');
        let mut paragraphs = vec![format!("Spacecraft: {title}.")];
        paragraphs.extend(disagreements(self.compared));
        let mut facts = vec![
            Fact::new(
                "Speeds",
                format!("{} at {} to {}", self.sweep.speeds.len(), rpm(from), rpm(to)),
            ),
            Fact::new("Rotors", self.rotors.to_owned()),
            Fact::new("Tones", self.sweep.contributors.len().to_string()),
            Fact::new("Modes of the structure", self.modes()),
        ];
        facts.extend(self.controller.map(|name| Fact::new("Loop closed", name)));
        Summary { paragraphs, facts }
    }

    pub(super) fn modes(&self) -> String {
        let modes = self.scenario.structure.as_ref().map_or(0, |s| s.massive().len());
        if modes == 0 { "none, a rigid hub".to_owned() } else { modes.to_string() }
    }

    fn requirements(&self) -> Result<Vec<Block>, DrawError> {
        if self.assessed.is_empty() {
            return Ok(Vec::new());
        }
        let rows = self.assessed.iter().enumerate().flat_map(|(index, of)| {
            let (unit, size) = &of.limit.unit;
            let state = of.state();
            let missing = of.no_data.is_some();
            let known = |text: String| if missing { "–".to_owned() } else { text };
            let sight = self.budget.sights.get(of.sight).map_or("", |sight| sight.name.as_str());
            let cells = vec![
                of.limit.name.clone(),
                state.to_string(),
                known(with_unit(of.margin.value / size, 4, unit)),
                with_unit(of.limit.limit / size, 4, unit),
                known(format!("{} dB", short(of.margin.decibels(), 3))),
                known(worst_speed(&self.sweep.speeds, of.worst, of.is_flat())),
                format!("{}, {sight}", metric(&of.limit.metric)),
                known(intervals(&of.keep_out)),
            ];
            std::iter::once((row_state(&state), cells)).chain(self.as_in_scenario(index, of))
        });
        let columns = [
            ("Requirement", ""),
            ("State", ""),
            ("Worst", ""),
            ("Limit", ""),
            ("Margin", ""),
            ("At", ""),
            ("Metric", ""),
            ("Speeds to keep out of", ""),
        ];
        let mut blocks = vec![table(
            "Requirements: the worst speed of each, and the scenario as it is",
            &columns,
            2..5,
            rows,
        )];
        blocks.push(self.by_phases());
        blocks.extend(self.peaks());
        for (index, of) in self.assessed.iter().enumerate() {
            let figure = self.over_speed(of);
            blocks.push(Block::Figure {
                id: format!("figure-requirement-{}", index + 1),
                number: format!("{}", index + 1),
                caption: format!("{} over the speed, with its limit.", of.limit.name),
                svg: figure.inline()?,
                charts: figure.chart().into_iter().collect(),
            });
        }
        Ok(blocks)
    }

    /// The row of a requirement with each rotor at its own speed; none where it is not known.
    fn as_in_scenario(&self, index: usize, of: &Assessed) -> Option<(&'static str, Vec<String>)> {
        let own = self.at_own_speeds.get(index)?;
        let (_, margin) = own.by_phases.first()?;
        let (unit, size) = &of.limit.unit;
        let state = own.state(margin);
        let known = |text: String| if state.reason().is_some() { "–".to_owned() } else { text };
        let cells = vec![
            format!("{}, as in the scenario", of.limit.name),
            state.word().to_owned(),
            known(with_unit(margin.value / size, 4, unit)),
            with_unit(of.limit.limit / size, 4, unit),
            known(format!("{} dB", short(margin.decibels(), 3))),
            OWN_SPEEDS.to_owned(),
            String::new(),
            String::new(),
        ];
        Some((row_state(&state), cells))
    }

    fn contributors(&self) -> Vec<Block> {
        let one = |of: &Assessed| {
            let rows = of.shares.iter().take(ROWS_MAX).filter_map(|(index, share)| {
                let contributor = self.sweep.contributors.get(*index)?;
                let line = self.sweep.lines.get(of.worst)?.get(*index)?;
                let cells = vec![
                    contributor.rotor.clone(),
                    format!("{}, order {}", contributor.cause, short(contributor.order, 6)),
                    format!("{} Hz", short(line.frequency / TAU, 5)),
                    format!("{} %", short(100.0 * share, 3)),
                ];
                Some(("", cells))
            });
            let noise = (of.noise > 0.0).then(|| {
                let share = format!("{} %", short(100.0 * of.noise, 3));
                (
                    "",
                    vec![
                        "all sources".to_owned(),
                        "broadband noise".to_owned(),
                        String::new(),
                        share,
                    ],
                )
            });
            let rows = rows.chain(noise);
            let speed = worst_speed(&self.sweep.speeds, of.worst, of.is_flat());
            let columns =
                [("Rotor", ""), ("Cause", ""), ("Frequency", ""), ("Share of the mean square", "")];
            table(&format!("{} at {speed}", of.limit.name), &columns, 2..4, rows)
        };
        let mut blocks: Vec<Block> = self.assessed.iter().map(one).collect();
        if !blocks.is_empty() {
            let text = match self.budget.phases {
                Phases::Unknown => {
                    "Mean squares are added: the share of a tone is its own. Shares add up to 100 %."
                }
                Phases::Given => {
                    "Amplitudes of one frequency are added as the angles of the scenario have them: the share of a tone is its \
                     projection on the sum, and negative where it opposes the sum. Shares add up to 100 %."
                }
                Phases::Worst => {
                    "Magnitudes of one frequency are added: the share of a tone is its part of the sum. Shares add up to 100 %."
                }
            };
            blocks.push(Block::Note { text: text.to_owned() });
        }
        for (index, of) in self.assessed.iter().enumerate() {
            let figure = self.cumulative(of);
            if let Ok(svg) = figure.inline() {
                blocks.push(Block::Figure {
                    id: format!("figure-cumulative-{}", index + 1),
                    number: format!("C{}", index + 1),
                    caption: format!(
                        "{}: the metric of all lines up to a frequency, and from it, at the worst speed; lines of one frequency are \
                         added with {}, mean squares of several.",
                        of.limit.name,
                        self.budget.phases.words()
                    ),
                    svg,
                    charts: figure.chart().into_iter().collect(),
                });
            }
        }
        for (index, of) in self.assessed.iter().enumerate() {
            let figure = self.density(of);
            if let Some((figure, Ok(svg))) = figure.map(|figure| {
                let svg = figure.inline();
                (figure, svg)
            }) {
                blocks.push(Block::Figure {
                    id: format!("figure-density-{}", index + 1),
                    number: format!("D{}", index + 1),
                    caption: format!(
                        "{}: density by broadband noise near the worst speed; below, what of it counts in the metric, from below, and the limit.",
                        of.limit.name
                    ),
                    svg,
                    charts: figure.charts(),
                });
            }
        }
        blocks
    }

    fn waterfalls(&self) -> Result<Vec<Block>, DrawError> {
        let mut blocks = Vec::new();
        for (sight, of) in self.budget.sights.iter().enumerate() {
            blocks.push(Block::Figure {
                id: format!("figure-waterfall-{sight}"),
                number: format!("W{}", sight + 1),
                caption: format!("{}: {}", of.name, self.drawn_lines()),
                svg: self.waterfall(sight).inline()?,
                charts: Vec::new(),
            });
        }
        Ok(blocks)
    }
}
