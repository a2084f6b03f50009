//! [`MarginsReport`]: the page of a loop: verdict and margins first, then Bode, Nichols and Nyquist plots, sensitivity, poles, lines of
//! rotors and their aliases, noise, assumptions, the scenario's text.

mod figures;
mod tables;

pub(crate) use tables::margin;

use super::blocks::{Block, Fact, Section, Summary, Verdict};
use super::error::{DrawError, ReportError};
use super::number::short;
use super::page::{Page, lines};
use crate::margins::analysis::{AXES, LoopAnalysis};
use crate::margins::lines::ClosedLine;
use crate::margins::measurement::ReadingNoise;
use crate::margins::noise::NoiseGains;
use crate::margins::requirements::MarginVerdict;
use crate::pointing::RequirementState;
use crate::scenario::{SampledController, Scenario};

/// What margins have to be at least.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct LeastMargins {
    /// dB, upwards and downwards.
    pub(crate) gain: f64,
    /// rad.
    pub(crate) phase: f64,
}

/// Everything that the page shows.
pub(crate) struct MarginsReport<'a> {
    pub(crate) scenario: &'a Scenario,
    pub(crate) controller: &'a SampledController,
    pub(crate) analysis: &'a LoopAnalysis,
    pub(crate) lines: &'a [ClosedLine],
    /// What noise of one does; none of a loop that is not stable.
    pub(crate) noise: Option<&'a NoiseGains>,
    pub(crate) measured: ReadingNoise,
    pub(crate) least: LeastMargins,
    /// Of the scenario's requirements on its margins.
    pub(crate) verdicts: &'a [MarginVerdict<'a>],
    pub(crate) notes: &'a [String],
    pub(crate) warnings: &'a [String],
}

/// A gain in decibels.
pub(crate) fn decibels(value: f64) -> f64 {
    20.0 * value.log10()
}

impl MarginsReport<'_> {
    /// The state of the gain margin and of the phase margin of each axis.
    pub(crate) fn states(&self) -> Vec<[RequirementState; 2]> {
        let state =
            |met: bool| if met { RequirementState::Met } else { RequirementState::Violated };
        let violated = || [RequirementState::Violated, RequirementState::Violated];
        let Some(axes) = &self.analysis.axes else {
            return AXES.iter().map(|_| violated()).collect();
        };
        let of = |axis: &precess_control::AxisMargins| {
            let up = axis.gain_up.is_none_or(|up| decibels(up.value) >= self.least.gain);
            let down = axis.gain_down.is_none_or(|down| -decibels(down.value) >= self.least.gain);
            let phase = axis.phase.is_none_or(|phase| phase.value >= self.least.phase);
            [state(up && down), state(phase)]
        };
        axes.iter().map(of).collect()
    }

    /// The page as one HTML file.
    pub(crate) fn html(&self) -> Result<String, ReportError> {
        let mut sections = vec![
            ("margins", "Margins", vec![self.margins(), self.whole()]),
            ("requirements", "Requirements", self.requirement_table()),
            ("loop", "Open loop", self.loop_figures()?),
            ("sensitivity", "Sensitivity", self.sensitivity_figures()?),
            ("poles", "Poles", self.poles()),
            ("lines", "Lines of rotors", self.line_tables()),
            ("noise", "Noise of what is measured", self.noise_tables()),
            ("assumptions", "Assumptions", vec![self.assumptions()]),
        ];
        if !self.warnings.is_empty() {
            let items = self.warnings.to_vec();
            sections.push(("warnings", "Warnings", vec![Block::List { style: "warnings", items }]));
        }
        if !self.scenario.source.text.is_empty() {
            sections.push(("scenario", "Scenario", vec![lines(&self.scenario.source.text)]));
        }
        let sections = Section::filled(sections);
        let page = Page {
            subject: "margins of a loop",
            title: &self.scenario.title,
            name: &self.scenario.name,
            data: super::data::of_curves(&self.scenario.name, &self.scenario.title, &sections)?,
            verdict: self.verdict(),
            summary: self.summary(),
            sections,
        };
        page.html()
    }

    /// The pictures as files: a name and the text of the SVG file.
    pub(crate) fn figures(&self) -> Result<Vec<(String, String)>, DrawError> {
        Ok(vec![
            ("bode".to_owned(), self.bode().file()?),
            ("nichols".to_owned(), self.nichols().file()?),
            ("nyquist".to_owned(), self.nyquist().file()?),
            ("singular-values".to_owned(), self.whole_loop().file()?),
            ("sensitivity".to_owned(), self.sensitivity().file()?),
        ])
    }

    fn verdict(&self) -> Verdict {
        let of = &self.controller.name;
        let limits = format!(
            "{} dB and {} deg",
            short(self.least.gain, 3),
            short(self.least.phase.to_degrees(), 3)
        );
        if !self.analysis.stable {
            let text = format!("The loop of {of} has poles outside the unit circle.");
            return Verdict { state: "violated", word: "Not stable.".to_owned(), text };
        }
        let states = self.states();
        let missed = states.iter().zip(AXES);
        let missed = missed.filter(|(states, _)| states.iter().any(RequirementState::is_violated));
        let below: Vec<String> = missed.map(|(_, axis)| format!("axis {axis}")).collect();
        let violated = self.verdicts.iter().filter(|of| of.state.is_violated());
        let violated: Vec<String> =
            violated.map(|of| format!("Violated: {}.", of.requirement.name)).collect();
        if below.is_empty() && violated.is_empty() {
            let text = format!("Every axis of {of} has at least {limits}, the others closed.");
            return Verdict { state: "met", word: "Stable, with its margins.".to_owned(), text };
        }
        let mut parts = violated;
        if !below.is_empty() {
            let axes = below.join(", ");
            parts.insert(0, format!("{axes} of {of}: below {limits}, the others closed."));
        }
        let text = parts.join(" ");
        Verdict { state: "violated", word: "Stable, but margins are missed:".to_owned(), text }
    }

    fn summary(&self) -> Summary {
        let of = self.controller;
        let title = self.scenario.title.trim_end_matches('.');
        let facts = vec![
            Fact::new("Controller", of.name.clone()),
            Fact::new("Samples", format!("{} Hz", short(of.rate, 5))),
            Fact::new("Delay", format!("{} ms", short(1e3 * of.delay, 4))),
            Fact::new("Commanded joints", of.joints.len().to_string()),
            Fact::new(
                "Servo",
                match of.servo.rate {
                    None => "once a sample".to_owned(),
                    Some(rate) => format!("{} Hz", short(rate, 5)),
                },
            ),
        ];
        Summary { paragraphs: vec![format!("Spacecraft: {title}.")], facts }
    }

    fn assumptions(&self) -> Block {
        let mut items = vec![
            "Small motions about rest at the reference, without external torques; limits of motors and of the integral are not reached.".to_owned(),
            "Rotors at their initial rates, equations averaged over their turns.".to_owned(),
            "Gimbals that no controller commands and no spring holds are locked.".to_owned(),
            "The loop is open at the torque of the law; an axis is seen with the others closed.".to_owned(),
        ];
        if let Some(periodic) = self.analysis.periodic {
            items.push(format!(
                "Loads beside a motion that averaging leaves out, at its frequency and those of rotors together, are at most {} of the devices' inertial ones at {} Hz, the highest crossover.",
                short(periodic.value, 3),
                short(periodic.omega / std::f64::consts::TAU, 4)
            ));
        }
        items.extend(self.notes.iter().cloned());
        Block::List { style: "plain", items }
    }
}
