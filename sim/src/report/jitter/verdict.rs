//! The verdict of a [`JitterReport`], by what the budget assumes of the phases between rotors, and by the other assumptions.

use super::super::blocks::{Block, Verdict, table};
use super::super::number::{short, with_unit};
use super::{JitterReport, intervals, rpm};
use crate::jitter::budget::Assessed;
use crate::jitter::sweep::Phases;

impl JitterReport<'_> {
    pub(super) fn verdict(&self) -> Verdict {
        let unmet: Vec<_> = self.assessed.iter().filter(|of| !of.margin.is_met()).collect();
        let all = self.assessed.len();
        let speeds = self.sweep.speeds.len();
        if all == 0 {
            let text = format!("{speeds} speeds. The budget states no requirements.");
            return Verdict { state: "", word: "Complete.".to_owned(), text };
        }
        let beside = self.beside();
        if unmet.is_empty() {
            let word = format!("All {all} requirements are met");
            let text = format!("at all {speeds} speeds, {}. {beside}", self.budget.phases.words());
            return Verdict { state: "met", word, text };
        }
        let one = |of: &&Assessed| format!("{} out of {}", of.limit.name, intervals(&of.keep_out));
        let word = format!("{} of {all} requirements violated:", unmet.len());
        let text = format!(
            "{}, {}. {beside} Keep the rotors out of these speeds, or change the design.",
            unmet.iter().map(one).collect::<Vec<_>>().join("; ").replace(" out of ", " at "),
            self.budget.phases.words()
        );
        Verdict { state: "violated", word, text }
    }

    /// The verdicts by the other assumptions about phases, in a sentence each.
    fn beside(&self) -> String {
        let all = self.assessed.len();
        let one = |(index, phases): (usize, Phases)| {
            let of = self.assessed.iter().filter_map(|of| of.by_phases.get(index));
            let unmet = of.filter(|of| !of.margin.is_met()).count();
            let state = if unmet == 0 {
                format!("all {all} are met")
            } else {
                format!("{unmet} of {all} violated")
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
                let state = if by.margin.is_met() { "met" } else { "violated" };
                let cells = vec![
                    of.limit.name.clone(),
                    by.phases.words().to_owned(),
                    state.to_owned(),
                    with_unit(by.margin.value / size, 4, unit),
                    with_unit(of.limit.limit / size, 4, unit),
                    format!("{} dB", short(20.0 * by.margin.ratio().log10(), 3)),
                    self.sweep.speeds.get(by.worst).map_or_else(String::new, |speed| rpm(*speed)),
                ];
                (state, cells)
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
