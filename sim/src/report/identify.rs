//! [`IdentifyReport`]: the page of an identification: whether the model holds, numbers with their intervals, what the data do not
//! tell, correlations, what each sensor leaves, what was left out.

use std::f64::consts::PI;

use super::blocks::{Block, Fact, Section, Summary, Verdict, table};
use super::data::of_curves;
use super::error::ReportError;
use super::number::short;
use super::page::{Page, lines};
use crate::fit::Estimate;
use crate::identify::{Identified, SQUARES_MAX};

/// Correlations that are shown.
const SHOWN: usize = 20;

/// Everything that the page shows.
pub(crate) struct IdentifyReport<'a> {
    /// In names of files.
    pub(crate) name: &'a str,
    /// The heading.
    pub(crate) title: &'a str,
    /// The text of the file of unknowns.
    pub(crate) text: &'a str,
    pub(crate) found: &'a Identified,
}

impl IdentifyReport<'_> {
    /// The page.
    pub(crate) fn html(&self) -> Result<String, ReportError> {
        let sections = Section::filled([
            ("parameters", "Numbers with 95 % intervals", self.numbers()),
            ("untold", "What the data do not tell", self.untold()),
            ("residuals", "Residuals", self.residuals()),
            ("correlations", "Correlations", self.correlations()),
            ("assumptions", "Assumptions", vec![assumptions(self.found)]),
            ("unknowns", "File of unknowns", vec![lines(self.text)]),
        ]);
        let page = Page {
            subject: "identification from telemetry",
            title: self.title,
            name: self.name,
            data: of_curves(self.name, self.title, &sections)?,
            verdict: self.verdict(),
            summary: self.summary(),
            sections,
        };
        page.html()
    }

    fn verdict(&self) -> Verdict {
        let found = self.found;
        let (state, word, text) = match (found.holds(), found.is_told()) {
            (true, true) => (
                "met",
                "The model holds:",
                format!(
                    "no sensor has a mean square of weighted residuals above {}; noise has 1. Data and priors tell all unknowns.",
                    short(SQUARES_MAX, 3)
                ),
            ),
            (true, false) => (
                "violated",
                "Not all is told:",
                "the data do not tell some unknowns, which have no prior.".to_owned(),
            ),
            (false, _) => {
                let of = found.residuals.iter().filter(|of| !of.holds);
                let named: Vec<String> =
                    of.map(|of| format!("{} {}", of.sensor, short(of.mean_square, 3))).collect();
                let text = format!("mean squares of weighted residuals: {}.", named.join(", "));
                ("violated", "The model does not hold:", text)
            }
        };
        Verdict { state, word: word.to_owned(), text }
    }

    fn summary(&self) -> Summary {
        let found = self.found;
        let [from, to] = found.span;
        let readings: u64 = found.residuals.iter().map(|of| of.count).sum();
        let facts = vec![
            Fact::new("Record", format!("{} s", short(to - from, 6))),
            Fact::new("Numbers that were read", readings.to_string()),
            Fact::new("Numbers that were estimated", found.numbers.len().to_string()),
            Fact::new("Steps over the whole record", found.steps.to_string()),
            Fact::new("Longest step of the motion", format!("{} s", short(found.step, 3))),
        ];
        let mut paragraphs = vec!["Maximum likelihood by the coupled model.".to_owned()];
        paragraphs.extend(found.exclusions.iter().map(|of| format!("Left out: {of}.")));
        if found.outside > 0 {
            paragraphs.push(format!(
                "{} readings are outside the time in which every motor's torque is known.",
                found.outside
            ));
        }
        Summary { paragraphs, facts }
    }

    fn numbers(&self) -> Vec<Block> {
        let row = |of: &str, what: &str, estimate: &Estimate, unit: &str, told: bool| {
            let [low, high] = estimate.interval;
            let mut cells = vec![of.to_owned(), what.to_owned()];
            if told {
                cells.extend([estimate.value, low, high].map(|value| short(value, 6)));
            } else {
                cells.extend(["not told", "", ""].map(str::to_owned));
            }
            cells.push(unit.to_owned());
            ("", cells)
        };
        let mut rows = Vec::new();
        for wheel in &self.found.wheels {
            let (name, told) = (wheel.device.as_str(), wheel.told);
            let degrees = |angle: &Estimate| angle.times(180.0 / PI);
            // 1 kg m is 1e5 g cm, 1 kg m² is 1e7 g cm².
            let [u_s, u_d] = wheel.hidden;
            for (what, estimate, unit, hidden) in [
                ("U_s", wheel.u_s.times(1e5), "g cm", u_s),
                ("U_d", wheel.u_d.times(1e7), "g cm²", u_d),
                ("phase of U_d", degrees(&wheel.phase), "deg", u_s || u_d),
                ("angle at the start", degrees(&wheel.angle), "deg", u_s),
            ] {
                let (state, mut cells) = row(name, what, &estimate, unit, told);
                if let (true, true, Some(cell)) = (told, hidden, cells.get_mut(2)) {
                    "hidden by noise".clone_into(cell);
                }
                rows.push((state, cells));
            }
        }
        for of in &self.found.numbers {
            rows.push(row("", &of.name, &of.estimate, of.unit, of.told));
        }
        let columns =
            [("Of", ""), ("Number", ""), ("Value", ""), ("From", ""), ("To", ""), ("Unit", "")];
        vec![table("Wheels, then all numbers that were estimated", &columns, 2..5, rows)]
    }

    fn untold(&self) -> Vec<Block> {
        let rows = self.found.untold.iter().map(|of| {
            let state = if of.has_prior { "met" } else { "violated" };
            let by = if of.has_prior { "its prior" } else { "nothing" };
            (state, vec![of.to_string(), short(of.deviation, 3), by.to_owned()])
        });
        let rows: Vec<_> = rows.collect();
        if rows.is_empty() {
            return Vec::new();
        }
        let columns = [("Direction", ""), ("Deviation, of this step", ""), ("Told by", "")];
        let caption = "Changes of unknowns, by any multiple, that the readings do not show";
        vec![table(caption, &columns, 1..2, rows)]
    }

    fn residuals(&self) -> Vec<Block> {
        let rows = self.found.residuals.iter().map(|of| {
            let state = if of.holds { "met" } else { "violated" };
            let cells = vec![
                of.sensor.to_owned(),
                of.count.to_string(),
                of.outliers.to_string(),
                short(of.mean_square, 4),
            ];
            (state, cells)
        });
        let columns = [
            ("Sensor", ""),
            ("Numbers", ""),
            ("Beyond three deviations", ""),
            ("Mean square by variance", ""),
        ];
        vec![table("Weighted residuals", &columns, 1..4, rows)]
    }

    fn correlations(&self) -> Vec<Block> {
        let rows = self.found.correlations.iter().take(SHOWN).map(|of| {
            let [a, b] = &of.names;
            ("", vec![a.clone(), b.clone(), short(of.correlation, 4)])
        });
        let rows: Vec<_> = rows.collect();
        if rows.is_empty() {
            return Vec::new();
        }
        let columns = [("Number", ""), ("And", ""), ("Correlation", "")];
        vec![table("Correlations of 0.9 and more of the errors", &columns, 2..3, rows)]
    }
}

/// What the numbers rest on.
fn assumptions(found: &Identified) -> Block {
    let row = |what: &str, is: String| ("", vec![what.to_owned(), is]);
    let rows = vec![
        row(
            "Motion",
            "the scenario's spacecraft under the torques of motors as they were read".to_owned(),
        ),
        row("External torques", "none that the scenario does not have".to_owned()),
        row("Noise", "white, as the sensors state it; the gyro's bias walks".to_owned()),
        row("Steps", format!("RK4 of at most {} s", short(found.step, 3))),
    ];
    table("What the numbers rest on", &[("Subject", ""), ("Assumption", "")], 0..0, rows)
}
