//! [`FitReport`]: the page of a fit to table measurements: how well the model holds, parameters with their intervals,
//! lines over speed, a spectrum with the fitted lines, residuals, waterfalls.

mod figures;

use std::f64::consts::TAU;

use super::blocks::{Block, Fact, Section, Summary, Verdict, table};
use super::data::of_curves;
use super::error::{DrawError, ReportError};
use super::number::short;
use super::page::{Page, lines};
use crate::fit::{
    Coefficient, Discrepancy, Estimate, Fitted, GroupFit, SQUARES_MAX, Sense, squares_bound,
};
use figures::{Drawing, drawings};

/// Everything that the page shows.
pub(crate) struct FitReport<'a> {
    /// In names of files.
    pub(crate) name: &'a str,
    /// The heading.
    pub(crate) title: &'a str,
    /// The text of the measurement's file.
    pub(crate) text: &'a str,
    pub(crate) fitted: &'a Fitted,
    /// Whether the fit is to spectra.
    pub(crate) of_spectra: bool,
}

impl FitReport<'_> {
    /// Names and texts of the files: the page, and its figures.
    pub(crate) fn files(&self) -> Result<Vec<(String, String)>, ReportError> {
        let drawings = drawings(self.title, self.fitted);
        let mut files = vec![(format!("{}-fit.html", self.name), self.html(&drawings)?)];
        for drawing in &drawings {
            files.push((format!("{}-{}.svg", self.name, drawing.slug), drawing.figure.file()?));
        }
        Ok(files)
    }

    fn html(&self, drawings: &[Drawing]) -> Result<String, ReportError> {
        let of = |kind: &str| -> Result<Vec<Block>, DrawError> {
            let of_kind = drawings.iter().filter(|drawing| drawing.slug.starts_with(kind));
            let numbered = of_kind.zip(1..);
            numbered
                .map(|(drawing, number)| {
                    Ok(Block::Figure {
                        id: format!("figure-{}", drawing.slug),
                        number: format!("{}{number}", kind[..1].to_uppercase()),
                        caption: drawing.caption.clone(),
                        svg: drawing.figure.inline()?,
                        charts: drawing.figure.charts(),
                    })
                })
                .collect()
        };
        let sections = Section::filled([
            ("parameters", "Parameters with 95 % intervals", self.parameters()),
            ("lines", "Lines over the speed", of("lines")?),
            ("spectra", "Spectra with the fitted lines", of("spectrum")?),
            ("residuals", "Residuals", self.residuals(of("residuals")?)),
            ("waterfalls", "Waterfalls", of("waterfall")?),
            ("assumptions", "Assumptions", vec![assumptions()]),
            ("measurement", "Measurement", vec![lines(self.text)]),
        ]);
        let page = Page {
            subject: "fit of a wheel",
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
        let mean = |fit: &GroupFit| fit.squares / fit.freedom;
        let named = |fit: &GroupFit| format!("{} {}", fit.group, short(mean(fit), 3));
        if self.fitted.holds() {
            let largest = self.fitted.groups.iter().max_by(|a, b| mean(a).total_cmp(&mean(b)));
            let bound = short(largest.map_or(SQUARES_MAX, |fit| squares_bound(fit.freedom)), 3);
            let text = format!(
                "no group has a mean square of weighted residuals above {bound}; pure noise has 1. The largest: {}.",
                largest.map_or_else(|| "none".to_owned(), named)
            );
            return Verdict { state: "met", word: "The model holds:".to_owned(), text };
        }
        let text = self.discrepancies(true).join("; ");
        Verdict { state: "violated", word: "The model does not hold:".to_owned(), text }
    }

    fn discrepancies(&self, fails: bool) -> Vec<String> {
        let own = self.fitted.discrepancies.iter().filter(|d| d.fails() == fails);
        own.map(Discrepancy::to_string).collect()
    }

    fn summary(&self) -> Summary {
        let fitted = self.fitted;
        let speeds = || fitted.rotations.iter().map(|of| of.speed.abs() * 60.0 / TAU);
        let (low, high) = (speeds().fold(f64::INFINITY, f64::min), speeds().fold(0.0, f64::max));
        // 1 kg m is 1e5 g cm, 1 kg m² is 1e7 g cm².
        let of = |estimate: Estimate, unit: &str| {
            let half = 0.5 * (estimate.interval[1] - estimate.interval[0]);
            // As many digits as the half-width tells.
            let digits = (estimate.value / half).abs().log10().ceil().clamp(1.0, 9.0);
            #[expect(
                clippy::cast_possible_truncation,
                clippy::cast_sign_loss,
                reason = "one to nine"
            )]
            let digits = digits as usize + 1;
            format!("{} \u{b1} {} {unit}", short(estimate.value, digits), short(half, 2))
        };
        let facts = vec![
            Fact::new("Static imbalance U_s", of(fitted.imbalance.u_s.times(1e5), "g cm")),
            Fact::new("Dynamic imbalance U_d", of(fitted.imbalance.u_d.times(1e7), "g cm²")),
            Fact::new("Lines", fitted.harmonics.len().to_string()),
            Fact::new("Internal modes", fitted.modes.len().to_string()),
            Fact::new("Records", fitted.rotations.len().to_string()),
            Fact::new("Speeds", format!("{} to {} rpm", short(low, 5), short(high, 5))),
        ];
        let text = if self.of_spectra {
            "Fitted to spectra: no phases, all radial lines count as forward."
        } else {
            "Fitted to time series of force and moment on a rigid table."
        };
        let mut paragraphs = vec![text.to_owned()];
        paragraphs.extend(self.discrepancies(false));
        Summary { paragraphs, facts }
    }

    fn parameters(&self) -> Vec<Block> {
        let fitted = self.fitted;
        let degrees = |angle: &Estimate| angle.times(360.0 / TAU);
        let row = |of: String, what: &str, estimate: &Estimate, unit: &str| {
            let [low, high] = estimate.interval;
            let mut cells = vec![of, what.to_owned()];
            cells.extend([estimate.value, low, high].map(|value| short(value, 6)));
            cells.push(unit.to_owned());
            ("", cells)
        };
        let imbalance = &fitted.imbalance;
        let own = "imbalance".to_owned();
        let mut rows = vec![
            row(own.clone(), "U_s", &imbalance.u_s.times(1e5), "g cm"),
            row(own.clone(), "U_d", &imbalance.u_d.times(1e7), "g cm²"),
        ];
        if let Some(phase) = &imbalance.phase {
            rows.push(row(own.clone(), "phase of U_d", &degrees(phase), "deg"));
        }
        if let Some(angle) = &imbalance.angle {
            rows.push(row(own, "angle of U_s", &degrees(angle), "deg"));
        }
        for harmonic in &fitted.harmonics {
            let first = harmonic.number.value == 1.0;
            let name = format!("harmonic {}", short(harmonic.number.value, 5));
            if !first {
                rows.push(row(name.clone(), "h", &harmonic.number, ""));
            }
            // Of h = 1 those beside the imbalance.
            let imbalance =
                |c: &&Coefficient| first && c.group.is_radial() && c.sense == Sense::Forward;
            for c in harmonic.coefficients.iter().filter(|c| c.seen && !imbalance(c)) {
                let sense = match (c.group.is_radial(), c.sense) {
                    (false, _) => "",
                    (true, Sense::Forward) => ", forward",
                    (true, Sense::Backward) => ", backward",
                };
                let what = format!("C, {}{sense}", c.group);
                rows.push(row(
                    name.clone(),
                    &what,
                    &c.c,
                    &c.group.coefficient_unit().replace("^2", "²"),
                ));
                if let Some(phase) = &c.phase {
                    rows.push(row(name.clone(), "its phase", &degrees(phase), "deg"));
                }
            }
        }
        for mode in &fitted.modes {
            let name = format!("mode of the {}", mode.group);
            rows.push(row(name.clone(), "frequency", &mode.frequency.times(1.0 / TAU), "Hz"));
            rows.push(row(name.clone(), "damping ratio", &mode.damping, ""));
            if mode.inertia_ratio.value != 0.0 {
                rows.push(row(name.clone(), "I_s / I_r", &mode.inertia_ratio, ""));
            }
            if mode.share.deviation > 0.0 {
                rows.push(row(name, "share", &mode.share, ""));
            }
        }
        let columns =
            [("Of", ""), ("Parameter", ""), ("Value", ""), ("From", ""), ("To", ""), ("Unit", "")];
        let mut blocks =
            vec![table("Imbalance, harmonics and internal modes", &columns, 2..5, rows)];
        let rows = fitted.floors.iter().flat_map(|(group, bands)| {
            let unit = if group.is_torque() { "N² m²/Hz" } else { "N²/Hz" };
            bands.iter().map(move |band| {
                let [from, to] = band.range;
                let [low, high] = band.density.interval;
                let mut cells = vec![group.to_string()];
                cells.extend([from, to].map(|value| short(value, 4)));
                cells.extend([band.density.value, low, high].map(|value| short(value, 3)));
                cells.push(unit.to_owned());
                ("", cells)
            })
        });
        let columns = [
            ("Group", ""),
            ("From (Hz)", ""),
            ("To (Hz)", ""),
            ("Density", ""),
            ("From", ""),
            ("To", ""),
            ("Unit", ""),
        ];
        blocks.push(table(
            "Broadband noise of each axis, mean over the speeds",
            &columns,
            1..6,
            rows,
        ));
        blocks
    }

    fn residuals(&self, figures: Vec<Block>) -> Vec<Block> {
        let fails = |fit: &GroupFit| {
            let own = |d: &Discrepancy| matches!(d, Discrepancy::Residuals { group, .. } if *group == fit.group);
            self.fitted.discrepancies.iter().any(own)
        };
        let rows = self.fitted.groups.iter().map(|fit| {
            let state = if fails(fit) { "violated" } else { "met" };
            let mean = short(fit.squares / fit.freedom, 4);
            (state, vec![fit.group.to_string(), short(fit.freedom, 6), mean])
        });
        let columns = [("Group", ""), ("Degrees of freedom", ""), ("Mean square by variance", "")];
        let caption = format!(
            "Weighted residuals of the powers; bound of the mean square: {}, or of few what noise exceeds once in 10,000",
            short(SQUARES_MAX, 3)
        );
        let mut blocks = vec![table(&caption, &columns, 1..3, rows)];
        blocks.extend(figures);
        blocks
    }
}

/// What the numbers rest on.
fn assumptions() -> Block {
    let row = |what: &str, is: &str| ("", vec![what.to_owned(), is.to_owned()]);
    let rows = vec![
        row("Lines", "C Omega^2 |H|: coefficients constant over the speed but for the modes"),
        row(
            "Weights",
            "those of the model; intervals of Student's distribution, times the root of the mean square of the residuals where that is above 1",
        ),
        row(
            "Noise",
            "with that of the table; divided by the squared amplification of the modes where that is above 1",
        ),
        row("Modes", "of the wheel by itself: those of the table are above its range"),
    ];
    table("What the numbers rest on", &[("Subject", ""), ("Assumption", "")], 0..0, rows)
}
