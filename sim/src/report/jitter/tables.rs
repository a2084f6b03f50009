//! Tables of a [`JitterReport`]: the two paths, sensitivities, assumptions.

use super::super::blocks::{Block, table};
use super::super::number::short;
use super::{AGREEMENT, JitterReport, rpm, worst_speed};
use crate::jitter::budget::Assessed;
use crate::jitter::coupled::Compared;
use crate::jitter::sensitivity::Sensitivity;
use crate::jitter::sweep::Phases;
use crate::structure::dynamic_mass::Motor;

/// Sensitivities that a table shows.
const RANKED_MAX: usize = 12;

/// What a run of the coupled equations may differ by, and where it is.
fn bound(resonant: bool) -> (f64, &'static str) {
    let [off, at] = AGREEMENT;
    if resonant { (at, "at resonance") } else { (off, "off resonance") }
}

/// A sentence for each run of the coupled equations that differs by more than its bound.
pub(crate) fn disagreements(compared: &[(Compared, bool)]) -> Vec<String> {
    let one = |(of, resonant): &(Compared, bool)| {
        let ((bound, place), difference) = (bound(*resonant), of.difference());
        (difference > bound).then(|| {
            format!(
                "At {} the coupled run differs from the lines by {} %, above {} % {place}: the linear model does not hold \
                 there, and a verdict by it is not confirmed.",
                rpm(of.speed),
                short(100.0 * difference, 3),
                short(100.0 * bound, 2)
            )
        })
    };
    compared.iter().filter_map(one).collect()
}

impl JitterReport<'_> {
    pub(super) fn paths(&self) -> Vec<Block> {
        if self.compared.is_empty() {
            let text = if self.has_imbalance {
                "No run of the coupled equations was made."
            } else {
                "No run of the coupled equations was made: it is without sources, and no rotor is out of balance."
            };
            return vec![Block::Note { text: text.to_owned() }];
        }
        let rows = self.compared.iter().map(|(of, resonant)| {
            let (bound, word) = bound(*resonant);
            let difference = of.difference();
            let state = if difference <= bound { "met" } else { "violated" };
            let cells = vec![
                rpm(of.speed),
                word.to_owned(),
                format!("{} s", short(of.window, 4)),
                format!("{} %", short(100.0 * bound, 2)),
                format!("{} %", short(100.0 * difference, 3)),
            ];
            (state, cells)
        });
        let columns = [
            ("Speed", ""),
            ("Where", ""),
            ("Window", ""),
            ("Bound", ""),
            ("Largest difference", ""),
        ];
        vec![
            table("Amplitudes of the lines of sight by both paths", &columns, 2..5, rows),
            Block::Note {
                text: "The run is of the nonlinear equations, started in the motion that the lines predict. A difference is in \
                       units of the sum of the magnitudes of the tones of a frequency, or of a thousandth of the magnitudes of \
                       all terms (each component of each force on each mount at each node) where that is more: these do not \
                       vanish where an amplitude cancels. \
                       Where the difference is above its bound the linear model does not hold at that speed."
                    .to_owned(),
            },
        ]
    }

    pub(super) fn ranked(&self) -> Vec<Block> {
        let one = |(of, all): (&Assessed, &Vec<Sensitivity>)| {
            let rows = all
                .iter()
                .take(RANKED_MAX)
                .map(|one| ("", vec![one.parameter.clone(), format!("{} %", short(one.ratio, 3))]));
            let speed = worst_speed(&self.sweep.speeds, of.worst, of.is_flat());
            let columns = [("Parameter", ""), ("Change of the metric for 1 % of it", "")];
            table(&format!("{} at {speed}", of.limit.name), &columns, 1..2, rows)
        };
        let mut blocks: Vec<Block> =
            self.assessed.iter().zip(self.sensitivities).map(one).collect();
        if !blocks.is_empty() {
            let text = "At the worst speed of each requirement, derivatives there, with the phases of the budget: a resonance moves away when its frequency changes \
                        by more than its damping ratio.";
            blocks.push(Block::Note { text: text.to_owned() });
        }
        blocks
    }

    fn sources(&self) -> String {
        let seeded = |of: &crate::disturbance::Disturbance| match of.seed {
            Some(seed) => format!("{} (seed {seed})", of.name),
            None => of.name.clone(),
        };
        let all: Vec<_> = self.scenario.disturbances.iter().map(seeded).collect();
        if all.is_empty() { "none".to_owned() } else { all.join(", ") }
    }

    pub(super) fn assumptions(&self) -> Block {
        let budget = self.budget;
        let phases = match budget.phases {
            Phases::Unknown => "unknown and independent: mean squares are added",
            Phases::Given => "those of the scenario's angles: amplitudes are added",
            Phases::Worst => "the worst: magnitudes are added",
        };
        let motor = match budget.motor {
            Motor::ConstantTorque => "keep their torques: rotors spin freely",
            Motor::ConstantRate => "keep the rates",
        };
        let gimbals = if budget.sprung { "free on their springs, held without" } else { "held" };
        let row = |what: &str, is: String| ("", vec![what.to_owned(), is]);
        let mass = match self.scenario.structure.as_ref().map(|s| s.contains_devices) {
            None => "a rigid hub without the devices",
            Some(false) => "its model is without the devices",
            Some(true) => "its model has the devices as rigid bodies, which are taken off",
        };
        let modes = self.scenario.structure.as_ref().map_or(0, |structure| structure.modes.len());
        let structure = if modes == 0 { mass.to_owned() } else { format!("{modes} modes; {mass}") };
        let closed = |name: &str| {
            let is = format!(
                "that of {name} is closed: lines at their own frequency, and at that at which its samples show them; noise is without it"
            );
            row("Loop", is)
        };
        let mut rows = vec![
            row("Structure", structure),
            row("Devices", "coupled, linearised about steady spin, averaged over a turn; gyroscopic terms exact".to_owned()),
            row("Imbalance", "of the devices' own equations".to_owned()),
            row(
                "Speeds",
                "those of the budget, and more around each crossing of an order and a natural frequency".to_owned(),
            ),
            row(
                "Displacement, smear, jitter",
                "RMS within an exposure; a smear from end to end is sqrt 12 times its RMS".to_owned(),
            ),
            row("Coupled runs", "without sources".to_owned()),
            row("Sources", self.sources()),
            row("Phases between rotors", phases.to_owned()),
            row("Motors", motor.to_owned()),
            row("Other joints", gimbals.to_owned()),
            row("Gravity and disturbances from outside", "none".to_owned()),
        ];
        rows.extend(self.controller.map(closed));
        table("What the numbers rest on", &[("Subject", ""), ("Assumption", "")], 0..0, rows)
    }
}
