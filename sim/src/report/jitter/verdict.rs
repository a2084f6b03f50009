//! The verdict of a [`JitterReport`], by what the budget assumes of the phases between rotors, and by the other assumptions.

use super::super::blocks::{Block, Verdict, table};
use super::super::number::{short, with_unit};
use super::super::row_state;
use super::{JitterReport, intervals, worst_speed};
use crate::jitter::budget::Assessed;
use crate::jitter::sweep::Phases;

impl JitterReport<'_> {
    pub(super) fn verdict(&self) -> Verdict {
        let unmet: Vec<_> = self.assessed.iter().filter(|of| of.state().is_violated()).collect();
        let missing: Vec<String> = self
            .assessed
            .iter()
            .filter_map(|of| Some(format!("{}: {}", of.limit.name, of.state().reason()?)))
            .collect();
        let all = self.assessed.len();
        let speeds = self.sweep.speeds.len();
        if all == 0 {
            let text = format!("{speeds} speeds. The budget states no requirements.");
            return Verdict { state: "", word: "Complete.".to_owned(), text };
        }
        let beside = self.beside();
        if unmet.is_empty() && !missing.is_empty() {
            let word = format!("{} of {all} requirements not evaluated:", missing.len());
            let met = if missing.len() == all { "" } else { " The others are met." };
            let text = format!("{}.{met} {beside}", missing.join("; "));
            return Verdict { state: "", word, text };
        }
        if unmet.is_empty() {
            let word = match all {
                1 => "The requirement is met".to_owned(),
                all => format!("All {all} requirements are met"),
            };
            let text = format!(
                "at all {speeds} speeds, {}{}. {beside}",
                self.budget.phases.words(),
                self.excesses()
            );
            return Verdict { state: "met", word, text };
        }
        let one = |of: &&Assessed| format!("{} out of {}", of.limit.name, intervals(&of.keep_out));
        let word = format!("{} of {all} requirements violated:", unmet.len());
        let text = format!(
            "{}, {}{}. {beside} Keep the rotors out of these speeds, or change the design.",
            unmet.iter().map(one).collect::<Vec<_>>().join("; ").replace(" out of ", " at "),
            self.budget.phases.words(),
            self.excesses()
        );
        let text = if missing.is_empty() {
            text
        } else {
            format!("{text} Not evaluated: {}.", missing.join("; "))
        };
        Verdict { state: "violated", word, text }
    }

    /// What violates limits that are met by the budget's assumption about phases.
    fn excesses(&self) -> String {
        let one =
            |of: &Assessed| Some(format!("; {} {}", of.limit.name, of.violated_by()?.excess()));
        self.assessed.iter().filter_map(one).collect()
    }

    /// The verdicts by the other assumptions about phases, in a sentence each.
    fn beside(&self) -> String {
        let all = self.assessed.len();
        let one = |(index, phases): (usize, Phases)| {
            let states = self
                .assessed
                .iter()
                .filter_map(|of| Some(of.state_of(&of.by_phases.get(index)?.margin)));
            let states: Vec<_> = states.collect();
            let count = |word: &str| states.iter().filter(|state| state.word() == word).count();
            let (met, unmet) = (count("met"), count("violated"));
            let state = match (met, unmet) {
                (1, 0) if all == 1 => "it is met".to_owned(),
                (met, 0) if met == all => format!("all {all} are met"),
                (met, 0) => format!("{met} of {all} are met, the others not evaluated"),
                (_, unmet) => format!("{unmet} of {all} violated"),
            };
            format!("With {}: {state}.", phases.words())
        };
        let others = self.budget.assumptions().into_iter().enumerate().skip(1);
        others.map(one).collect::<Vec<_>>().join(" ")
    }

    /// A requirement by every assumption about phases: a row for each.
    pub(super) fn by_phases(&self) -> Block {
        let rows = self.assessed.iter().flat_map(|of| {
            let (unit, size) = &of.limit.unit;
            of.by_phases.iter().map(move |by| {
                let state = of.state_of(&by.margin);
                let known = |text: String| {
                    if state.reason().is_some() { "–".to_owned() } else { text }
                };
                let cells = vec![
                    of.limit.name.clone(),
                    by.phases.words().to_owned(),
                    state.word().to_owned(),
                    known(with_unit(by.margin.value / size, 4, unit)),
                    with_unit(of.limit.limit / size, 4, unit),
                    known(format!("{} dB", short(by.margin.decibels(), 3))),
                    known(worst_speed(&self.sweep.speeds, by.worst, by.is_flat)),
                ];
                (row_state(&state), cells)
            })
        });
        let columns = [
            ("Requirement", ""),
            ("Phases between rotors", ""),
            ("State", ""),
            ("Worst", ""),
            ("Limit", ""),
            ("Margin", ""),
            ("At", ""),
        ];
        table("Verdict by what is assumed of the phases", &columns, 3..6, rows)
    }
}
