//! [`MarginRequirement`]: what a margin of a controller's loop has to be at least.

use super::check::range;
use super::{Scenario, ScenarioError};

/// A margin of a loop.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LoopMargin {
    /// Of each axis, upwards and downwards.
    Gain,
    /// Of each axis.
    Phase,
    /// How much longer the delay may become.
    Delay,
}

/// A limit on a margin, from below. `margins` evaluates it, a run does not.
#[derive(Clone, Debug, PartialEq)]
pub struct MarginRequirement {
    /// What a report calls it.
    pub name: String,
    /// The name of the controller.
    pub controller: String,
    /// Which margin.
    pub margin: LoopMargin,
    /// Lower bound: dB of a gain, rad of a phase, s of a delay.
    pub least: f64,
    /// The bound as it was written: `6 dB`.
    pub written: String,
}

impl LoopMargin {
    /// All of them, with their words.
    pub const WORDS: [(&'static str, Self); 3] =
        [("gain", Self::Gain), ("phase", Self::Phase), ("delay", Self::Delay)];

    /// Its word.
    #[must_use]
    pub const fn word(self) -> &'static str {
        match self {
            Self::Gain => "gain",
            Self::Phase => "phase",
            Self::Delay => "delay",
        }
    }
}

/// Decibels that are not negative: `6 dB`, `6`.
#[must_use]
pub fn decibels(text: &str) -> Option<f64> {
    let number: f64 = text.trim().trim_end_matches("dB").trim().parse().ok()?;
    (number >= 0.0 && number.is_finite()).then_some(number)
}

impl Scenario {
    pub(super) fn check_margin_requirements(&self) -> Vec<ScenarioError> {
        let mut errors = Vec::new();
        for of in &self.margin_requirements {
            let key = |key: &str| format!("requirement.{}.{key}", of.name);
            if !self.controllers.iter().any(|known| known.name == of.controller) {
                let known: Vec<_> = self.controllers.iter().map(|of| of.name.as_str()).collect();
                let message = if known.is_empty() {
                    "the scenario has no `[[controller]]` whose loop has margins; add one"
                        .to_owned()
                } else {
                    let known = known.join(", ");
                    format!("no controller is named `{}`; write one of {known}", of.controller)
                };
                errors.push(range(&key("controller"), message));
            }
            if !(of.least >= 0.0 && of.least.is_finite()) {
                let message = format!("the least margin {} is not 0 or above", of.written);
                errors.push(range(&key("least"), message));
            }
        }
        errors
    }
}
