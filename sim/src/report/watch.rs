//! [`WatchReport`]: the page of a record that was watched: alarms, each quantity over the time beside its reference, what was left
//! out.

use precess_dynamics::units::{to_g_cm, to_g_cm2};

use super::blocks::{Block, Fact, Section, Summary, Verdict, table};
use super::data::of_curves;
use super::draw::curves::{ChartCurve, CurveAxis, CurveChart};
use super::draw::figure::{Band, Figure, LimitLine, Line};
use super::error::ReportError;
use super::number::{short, time};
use super::page::Page;
use super::run::grouping::capitalised;
use crate::record::Decimate;
use crate::telemetry::Exclusion;
use crate::watch::{Alarm, WatchSettings, Watched};

/// Buckets of the figures, each of one block or of more.
pub(crate) const BUCKETS: usize = 600;

/// A quantity with its reference: mean, and by what factor its variance is that of white noise of the sensors.
pub(crate) type WatchedQuantity = (String, Watched, Option<[f64; 2]>);

/// Everything that the page shows.
pub(crate) struct WatchReport<'a> {
    /// In names of files.
    pub(crate) name: &'a str,
    /// The heading.
    pub(crate) title: &'a str,
    pub(crate) settings: &'a WatchSettings,
    pub(crate) blocks: u64,
    /// Start of the first block and end of the last one, s.
    pub(crate) span: [f64; 2],
    pub(crate) quantities: &'a [WatchedQuantity],
    /// The middle of each block, s, and each quantity; NaN where a block does not determine it.
    pub(crate) history: &'a Decimate,
    pub(crate) alarms: &'a [Alarm],
    /// Alarms that were counted and not kept.
    pub(crate) further: u64,
    pub(crate) exclusions: &'a [Exclusion],
}

/// A number of a quantity in the unit that people use.
pub(crate) fn shown(watched: &Watched, value: f64) -> (f64, &'static str) {
    match watched {
        Watched::StaticImbalance | Watched::BearingStiffness => (to_g_cm(value), "g cm"),
        Watched::DynamicImbalance => (to_g_cm2(value), "g cm^2"),
        Watched::StaticPhase | Watched::DynamicPhase => (value.to_degrees(), "deg"),
        Watched::TorqueConstant | Watched::TachometerScale => (100.0 * value, "%"),
        Watched::Drag | Watched::GyroJump => (value, watched.unit()),
    }
}

impl WatchReport<'_> {
    /// The page.
    pub(crate) fn html(&self) -> Result<String, ReportError> {
        let sections = Section::filled([
            ("alarms", "Alarms", self.alarms()),
            ("quantities", "Quantities over the time", self.figures()?),
            ("references", "References", vec![self.references()]),
        ]);
        let page = Page {
            subject: "what has changed, from telemetry",
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
        let count = self.further + u64::try_from(self.alarms.len()).unwrap_or(u64::MAX);
        let (state, word, text) = match (self.blocks, count) {
            (0, _) => ("", "Nothing was watched:", "the telemetry is shorter than a block.".into()),
            (_, 0) => {
                let rate = short(self.settings.false_alarms, 3);
                ("met", "No alarm", format!("by tests with {rate} false alarms an hour."))
            }
            (_, count) => {
                let mut names: Vec<&str> = Vec::new();
                for alarm in self.alarms {
                    if !names.contains(&alarm.name.as_str()) {
                        names.push(&alarm.name);
                    }
                }
                let what = if count == 1 { "1 alarm".into() } else { format!("{count} alarms") };
                ("violated", "Changed:", format!("{} ({what}).", names.join(", ")))
            }
        };
        Verdict { state, word: word.to_owned(), text }
    }

    fn summary(&self) -> Summary {
        let WatchSettings { block, learn, false_alarms } = self.settings;
        let [from, to] = self.span;
        let facts = vec![
            Fact::new("Time", format!("{} s to {} s", time(from), time(to))),
            Fact::new("Blocks", format!("{} of {} s", self.blocks, time(*block))),
            Fact::new("Reference", format!("the first {} s", time(*learn))),
            Fact::new("Quantities", self.quantities.len().to_string()),
            Fact::new("False alarms an hour, at most", short(*false_alarms, 3)),
        ];
        let mut paragraphs = vec![
            "The coupled model along the telemetry; quantities of each block by least squares."
                .into(),
        ];
        paragraphs.extend(self.exclusions.iter().map(|of| format!("Left out: {of}.")));
        Summary { paragraphs, facts }
    }

    fn alarms(&self) -> Vec<Block> {
        let row = |alarm: &Alarm| {
            let shift = &alarm.shift;
            let of = |value: f64| short(shown(&alarm.watched, value).0, 4);
            let (change, half) = (shift.change, shift.half_width);
            let cells = vec![
                alarm.name.clone(),
                time(alarm.time),
                time(shift.onset),
                of(shift.before),
                of(change),
                of(change - half),
                of(change + half),
                shown(&alarm.watched, 0.0).1.to_owned(),
                shift.test.name().to_owned(),
                alarm.alike.join("; "),
            ];
            ("", cells)
        };
        if self.alarms.is_empty() {
            return Vec::new();
        }
        let columns = [
            ("Quantity", ""),
            ("Alarm", "s"),
            ("Since", "s"),
            ("Before", ""),
            ("Change", ""),
            ("From", ""),
            ("To", ""),
            ("Unit", ""),
            ("Test", ""),
            ("The same to these sensors", ""),
        ];
        let caption = "What has changed, with the interval of 95 % at the onset that was found";
        let mut blocks = vec![table(caption, &columns, 1..7, self.alarms.iter().map(row))];
        if self.further > 0 {
            blocks.push(Block::Note { text: format!("And {} further alarms.", self.further) });
        }
        blocks
    }

    fn references(&self) -> Block {
        // A torque constant is found in the series of drag.
        let tested = self.quantities.iter().filter(|(_, of, _)| *of != Watched::TorqueConstant);
        let row = |(name, watched, reference): &WatchedQuantity| {
            let (state, mean, scatter) = match reference {
                Some([mean, scatter]) => {
                    ("", short(shown(watched, *mean).0, 4), short(scatter.sqrt(), 3))
                }
                None => ("violated", "not enough blocks determine it".to_owned(), String::new()),
            };
            (state, vec![name.clone(), mean, shown(watched, 0.0).1.to_owned(), scatter])
        };
        let columns =
            [("Quantity", ""), ("Mean", ""), ("Unit", ""), ("Scatter, of white noise's", "")];
        let caption = "Of the first blocks; bounds are as much wider as blocks scatter more than noise of the sensors";
        table(caption, &columns, 1..2, tested.map(row))
    }

    /// Figures of what some block determines: first what has changed.
    fn figures(&self) -> Result<Vec<Block>, ReportError> {
        let has_alarm = |(_, (name, watched, _)): &(usize, &WatchedQuantity)| {
            self.alarms.iter().any(|alarm| is_of_series(alarm, name, watched))
        };
        let all = self.quantities.iter().enumerate();
        let (changed, others): (Vec<_>, Vec<_>) = all.partition(has_alarm);
        let figures = changed.into_iter().chain(others);
        let figures = figures.map(|(index, of)| self.figure(index + 1, of));
        let drawn = figures.filter(|figure| figure.lines.iter().any(Line::is_drawn));
        let block = |(index, figure): (usize, Figure)| {
            Ok(Block::Figure {
                id: format!("figure-{}", index + 1),
                number: (index + 1).to_string(),
                caption: figure.description.clone(),
                svg: figure.inline()?,
                charts: vec![chart(&figure)],
            })
        };
        drawn.enumerate().map(block).collect()
    }

    /// The curve of a column of the history with its reference, and what it has been since each onset.
    fn figure(&self, column: usize, (name, watched, reference): &WatchedQuantity) -> Figure {
        let unit = shown(watched, 0.0).1;
        let of = |value: f64| shown(watched, value).0;
        let at = |values: &[f64]| of(values.get(column).copied().unwrap_or(f64::NAN));
        let buckets = self.history.buckets().iter();
        let bands = buckets.map(|bucket| Band {
            time: 0.5 * (bucket.start + bucket.end),
            min: at(&bucket.min),
            max: at(&bucket.max),
        });
        let [from, to] = self.span;
        let mut limits = Vec::new();
        if let Some([mean, _]) = reference {
            let (values, window) = (vec![of(*mean)], [from, to]);
            limits.push(LimitLine { name: "reference".into(), values, window });
        }
        // The first one: later ones of the same quantity are told from the new reference.
        let alarm = self.alarms.iter().find(|alarm| alarm.name == *name);
        if let Some(Alarm { shift, .. }) = alarm {
            let (values, window) = (vec![of(shift.before + shift.change)], [shift.onset, to]);
            limits.push(LimitLine { name: "since the onset".into(), values, window });
        }
        let unit = if unit == "1" { "" } else { unit };
        Figure {
            description: format!("{} over the time, block by block.", capitalised(name)),
            title: capitalised(name),
            axis: "Value",
            unit,
            span: self.span,
            lines: vec![Line { name: "blocks".into(), bands: bands.collect() }],
            limits,
        }
    }
}

/// Whether an alarm is of this quantity, or of another cause of what its blocks show.
fn is_of_series(alarm: &Alarm, name: &str, watched: &Watched) -> bool {
    if alarm.name == name {
        return true;
    }
    let place = |name: &str| name.rsplit_once(" of ").map(|(_, of)| of.to_owned());
    watched.other_cause().as_ref() == Some(&alarm.watched) && place(&alarm.name) == place(name)
}

/// What the page's script draws in the place of a figure.
fn chart(figure: &Figure) -> CurveChart {
    let axis = |name: &str, unit: &str| CurveAxis {
        name: name.to_owned(),
        unit: unit.to_owned(),
        logarithmic: false,
        range: None,
    };
    let of_line = |line: &Line| {
        let points = line.bands.iter().map(|band| [band.time, 0.5 * (band.min + band.max)]);
        let mut curve = ChartCurve::line(&line.name, points.collect());
        curve.interval = line.bands.iter().map(|band| [band.min, band.max]).collect();
        curve
    };
    let of_limit = |limit: &LimitLine| {
        let value = limit.values.first().copied().unwrap_or(f64::NAN);
        let mut curve = ChartCurve::line(&limit.name, limit.window.map(|t| [t, value]).to_vec());
        curve.limit = true;
        curve
    };
    CurveChart {
        title: figure.title.clone(),
        axes: [axis("Time", "s"), axis(figure.axis, figure.unit)],
        curves: figure
            .lines
            .iter()
            .map(of_line)
            .chain(figure.limits.iter().map(of_limit))
            .collect(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::record::Recorder as _;
    use crate::watch::{Shift, Test};

    #[test]
    fn what_has_changed_is_drawn_first_and_what_no_block_determines_is_not() {
        let mut history = Decimate::new(BUCKETS);
        for block in 0..20_u32 {
            let drag = if block < 10 { 1e-4 } else { 2e-4 };
            let row = [f64::from(block), 1e-5, f64::NAN, drag];
            history.sample(&row).unwrap();
        }
        let quantities = [
            ("static imbalance of rw1".to_owned(), Watched::StaticImbalance, Some([1e-5, 1.0])),
            ("torque constant of rw1".to_owned(), Watched::TorqueConstant, None),
            ("drag torque of rw1".to_owned(), Watched::Drag, Some([1e-4, 1.0])),
        ];
        let settings = WatchSettings { block: 1.0, learn: 8.0, false_alarms: 1.0 };
        let page = |alarms: &[Alarm]| {
            let report = WatchReport {
                name: "bus",
                title: "Bus",
                settings: &settings,
                blocks: 20,
                span: [0.0, 20.0],
                quantities: &quantities,
                history: &history,
                alarms,
                further: 0,
                exclusions: &[],
            };
            report.html().unwrap()
        };
        let (quiet, changed) = (page(&[]), page(&[drag_alarm()]));
        let at = |page: &str, text: &str| page.find(text).unwrap_or(usize::MAX);
        let [drag, imbalance, constant] = ["Drag torque", "Static imbalance", "Torque constant"]
            .map(|name| format!("{name} of rw1 over the time"));
        assert!(at(&quiet, &imbalance) < at(&quiet, &drag));
        assert!(at(&changed, &drag) < at(&changed, &imbalance));
        assert!(at(&quiet, &drag) < usize::MAX && !quiet.contains(&constant));
        assert!(quiet.contains("No alarm") && !quiet.contains("Changed:"));
        assert!(changed.contains("drag torque of rw1 (1 alarm)"), "{changed}");
        assert!(changed.contains("an offset of the telemetered torque"));
        assert_eq!(changed, page(&[drag_alarm()]));
    }

    fn drag_alarm() -> Alarm {
        let shift = Shift {
            test: Test::CumulativeSum,
            onset: 10.0,
            before: 1e-4,
            change: 1e-4,
            half_width: 1e-5,
        };
        Alarm {
            name: "drag torque of rw1".to_owned(),
            watched: Watched::Drag,
            of: "rw1".to_owned(),
            time: 12.0,
            shift,
            alike: vec!["an offset of the telemetered torque".to_owned()],
        }
    }
}
