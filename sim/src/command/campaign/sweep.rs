//! `sweep`: runs of a scenario over the values of one key or two; tables, pictures, worst values, values to keep out of.

use std::fmt::Write as _;

use clap::Args;

use super::{
    CampaignOptions, Prepared, Results, ending, shown, values_of, warnings, without_number,
};
use crate::campaign::{Axis, Finished, Plan, keep_out};
use crate::command::error::CommandError;
use crate::command::exit::Exit;
use crate::command::table::{aligned, six};
use crate::command::terminal::print;
use crate::disturbance::Model as SourceModel;
use crate::jitter::budget::is_flat;
use crate::jitter::campbell::{Oscillation, branches, crossings, oscillations};
use crate::jitter::device::Steady;
use crate::jitter::model::Model;
use crate::names::file_names;
use crate::pointing::{Margin, RequirementState};
use crate::report::Picture;
use crate::report::campaign::{CampaignPage, CampaignTable};
use crate::report::sweep::{Numbers, curve, map, waterfall};
use crate::structure::dynamic_mass::Motor;
use crate::units::Measure;

pub(in crate::command) const HELP: &str = "\
Examples:
  precess sweep bus.toml --over 'device.rw.wheel.rate=600..6000 rpm:181' --column omega
      RMS, peak and lines of omega, and the requirements, over the rate of a wheel
  precess sweep bus.toml --over 'device.rw*.wheel.rate=600..6000 rpm:181'
      one rate for all wheels whose names begin with rw; KEY+KEY names keys one by one
  precess sweep bus.toml --over 'hub.mass=100..1000 kg:log 5' --over 'device.rw.imbalance.static=1,2,5 g cm'
      a map over two keys

A sweep that is ended, even by kill -9, is continued by the same command: finished samples are in its
journal. A sample that failed violates every requirement.";

/// The options of `sweep`.
#[derive(Debug, Args)]
pub(in crate::command) struct Sweep {
    #[command(flatten)]
    options: CampaignOptions,
    /// A key and its values: KEY=FROM..TO UNIT:COUNT, KEY=FROM..TO UNIT:log COUNT, or KEY=1,2,5 UNIT; twice for two axes.
    #[arg(long, value_name = "KEY=VALUES", required = true, num_args = 1, value_parser = axis)]
    over: Vec<Axis>,
}

fn axis(text: &str) -> Result<Axis, String> {
    Axis::parse(text).map_err(|error| error.to_string())
}

impl Sweep {
    pub(in crate::command) fn execute(&self) -> Result<Exit, CommandError> {
        let other = |error: &dyn std::fmt::Display| CommandError::Other(error.to_string());
        if self.over.len() > 2 {
            return Err(other(
                &"a sweep has one --over or two; KEY+KEY or device.rw*.KEY sets several keys together, --set fixes the others",
            ));
        }
        let plan = Plan::of_axes(&self.over).map_err(|error| other(&error))?;
        let prepared = self.options.prepare()?;
        let stem = format!("{}-sweep", prepared.scenario.name);
        let mut outputs = self.options.reserve(&stem, &self.names(&prepared, &stem))?;
        let Some(finished) = self.options.run(&prepared, (&plan, None), &stem)? else {
            return Ok(Exit::Violated);
        };
        let pictures = self.pictures(&prepared, &finished, &stem);
        let found = self.found(&prepared, &plan, &finished);
        let mut texts = Vec::new();
        for (file, (_, picture)) in &pictures {
            texts.push((file.clone(), picture.file().map_err(|error| other(&error))?));
        }
        let pictures: Vec<_> = pictures.into_iter().map(|(_, picture)| picture).collect();
        if !self.options.no_report {
            let page = self.page(&prepared, &plan, &finished, &found, &pictures);
            texts.push((format!("{stem}.html"), page.html().map_err(|error| other(&error))?));
        }
        let files = self.options.files(&stem, texts.len());
        self.options.write(&prepared, &plan, &finished, (&stem, texts), &mut outputs)?;
        let (text, exit) = self.summary(&prepared, &plan, &finished, &found);
        print(&text)?;
        print(&files)?;
        Ok(exit)
    }

    /// The files of the result.
    fn names(&self, prepared: &Prepared, stem: &str) -> Vec<String> {
        let mut names = self.options.names(stem);
        names.extend(self.picture_names(prepared, stem));
        names
    }

    /// The files of the pictures: of each number, then the one of natural frequencies, then of the lines of each column.
    fn picture_names(&self, prepared: &Prepared, stem: &str) -> Vec<String> {
        let mut names: Vec<String> = shown(prepared).map(|(name, ..)| name).collect();
        if self.over.len() == 1 && prepared.selection.lines > 0 {
            names.push("campbell".to_owned());
            names.extend(prepared.selection.columns.iter().map(|name| format!("lines {name}")));
        }
        file_names(names).into_iter().map(|name| format!("{stem}-{name}.svg")).collect()
    }

    /// The files of the pictures, each with its caption.
    fn pictures(
        &self,
        prepared: &Prepared,
        finished: &Finished,
        stem: &str,
    ) -> Vec<(String, (String, Picture))> {
        let mut files = Vec::new();
        let over: Vec<&str> = self.over.iter().map(|axis| axis.key.as_str()).collect();
        let over = over.join(" and ");
        let mut names = self.picture_names(prepared, stem).into_iter();
        for ((name, field, unit, limit), file) in shown(prepared).zip(names.by_ref()) {
            let values = values_of(finished, field);
            let unit = (unit.0.as_str(), unit.1);
            let numbers = Numbers { name: &name, unit, values: &values, limit };
            let picture = match &self.over[..] {
                [axis] => curve(axis, &numbers),
                [first, second] => map([first, second], &numbers),
                _ => continue,
            };
            files.push((file, (format!("{name} over {over}."), picture)));
        }
        let ([axis], true) = (&self.over[..], prepared.selection.lines > 0) else {
            return files;
        };
        let requirements = prepared.scenario.requirements.len();
        let file = names.next().unwrap_or_default();
        if let Some(picture) = campbell(prepared, axis) {
            let caption = format!("Natural frequencies over {over}, with the orders of its rotor.");
            files.push((file, (caption, picture)));
        }
        for ((column, name), file) in prepared.selection.columns.iter().enumerate().zip(names) {
            let mut lines = Vec::new();
            for [frequency, amplitude] in prepared.selection.lines_of(column, requirements) {
                let pairs = values_of(finished, frequency).into_iter();
                let pairs = pairs.zip(values_of(finished, amplitude)).zip(&axis.values);
                lines.extend(pairs.filter_map(|((f, a), value)| Some([*value, f?, a?])));
            }
            let field = prepared.selection.rms_of(column, requirements);
            let unit = prepared.fields.get(field).map_or("", |field| field.unit.as_str());
            let picture = waterfall(axis, name, unit, &lines, &orders(prepared, axis));
            let caption = format!("The strongest lines of {name} over {over} and frequency.");
            files.push((file, (caption, picture)));
        }
        files
    }

    /// The page.
    fn page<'a>(
        &self,
        prepared: &'a Prepared,
        plan: &Plan,
        finished: &Finished,
        found: &'a Results,
        pictures: &'a [(String, Picture)],
    ) -> CampaignPage<'a> {
        let mut facts = vec![("Samples", plan.samples.len().to_string())];
        for axis in &self.over {
            let ends =
                |of: fn(f64, f64) -> f64| axis.values.iter().copied().reduce(of).unwrap_or(0.0);
            let [from, to] = [ends(f64::min), ends(f64::max)].map(six);
            let count = axis.values.len();
            let unit = &axis.unit;
            facts.push(("Key", format!("{}: {count} values, {from} to {to} {unit}", axis.key)));
        }
        facts.extend(prepared.facts());
        CampaignPage {
            subject: "sweep",
            scenario: &prepared.scenario,
            states: &found.states,
            facts,
            tables: vec![found.table.clone()],
            pictures,
            warnings: warnings(prepared, plan, finished),
            plan: None,
        }
    }

    /// For the terminal; and what became of the requirements.
    fn summary(
        &self,
        prepared: &Prepared,
        plan: &Plan,
        finished: &Finished,
        found: &Results,
    ) -> (String, Exit) {
        let mut text = format!("{}: {} samples\n", prepared.scenario.name, plan.samples.len());
        for axis in &self.over {
            let keys = prepared.template.keys_of(&axis.key).unwrap_or_default();
            if keys.len() > 1 {
                let _ = writeln!(text, "{} is {}", axis.key, keys.join(", "));
            }
        }
        text.push_str(&aligned(&found.table.text()));
        let (rest, exit) = ending((prepared, plan, finished), found);
        (text + &rest, exit)
    }

    /// Of each requirement and column the worst sample.
    fn found(&self, prepared: &Prepared, plan: &Plan, finished: &Finished) -> Results {
        let mut states = Vec::new();
        let mut rows = Vec::new();
        for (name, field, (unit, size), limit) in shown(prepared) {
            let values = values_of(finished, field);
            let known =
                values.iter().enumerate().filter_map(|(index, value)| Some((index, (*value)?)));
            let every: Option<Vec<f64>> = values.iter().copied().collect();
            let is_flat = every.is_some_and(|every| is_flat(&every));
            let mut known = known.peekable();
            let first = known.peek().copied();
            let largest = known.max_by(|a, b| a.1.total_cmp(&b.1).then(b.0.cmp(&a.0)));
            let worst = if is_flat { first } else { largest };
            let at = |sample: usize| {
                let values = plan.samples.get(sample).map_or(&[][..], |sample| &sample.values);
                let pairs = self.over.iter().zip(values);
                let words: Vec<_> =
                    pairs.map(|(axis, value)| format!("{} {}", six(*value), axis.unit)).collect();
                let same = if is_flat { ", the same at every value" } else { "" };
                format!("{}{same}", words.join(", ").trim_end())
            };
            let mut row = vec![name.clone(), String::new()];
            let mut state = "";
            row.push(
                worst.map_or_else(
                    || "none".to_owned(),
                    |(_, v)| format!("{} {unit}", six(v / size)),
                ),
            );
            if let Some(limit) = limit {
                let of_all = RequirementState::from_numbers(&values, limit);
                state = if of_all.reason().is_some() { "" } else { of_all.word() };
                states.push((name, of_all));
                let violated = values.iter().flatten().filter(|value| **value > limit).count();
                let missing = without_number(finished, field).len();
                let failed = values.iter().filter(|value| value.is_none()).count() - missing;
                let parts =
                    [(violated, "violated by"), (missing, "not evaluated by"), (failed, "failed")];
                let parts = parts.into_iter().filter(|(count, _)| *count > 0);
                let parts: Vec<_> = parts.map(|(count, word)| format!("{word} {count}")).collect();
                if let Some(state) = row.get_mut(1) {
                    *state = if parts.is_empty() { "met".to_owned() } else { parts.join(", ") };
                }
                row.push(format!("{} {unit}", six(limit / size)));
                let margin = worst.map(|(_, value)| Margin { value, limit }.ratio());
                row.push(margin.map_or_else(String::new, |m| format!("{:.1}", 20.0 * m.log10())));
            } else {
                row.extend([String::new(), String::new()]);
            }
            row.push(worst.map_or_else(String::new, |(sample, _)| at(sample)));
            let bands = match (&self.over[..], limit) {
                ([axis], Some(limit)) => keep_out(&axis.values, &values, limit),
                _ => Vec::new(),
            };
            let unit = self.over.first().map_or("", |axis| axis.unit.as_str());
            let bands =
                bands.iter().map(|[from, to]| format!("{} to {} {unit}", six(*from), six(*to)));
            let bands = bands.collect::<Vec<_>>().join("; ").trim_end().to_owned();
            let none = bands.is_empty() && limit.is_some() && self.over.len() == 1;
            row.push(if none { "none".to_owned() } else { bands });
            rows.push((state, row));
        }
        let heads = ["", "state", "worst", "limit", "margin dB", "at", "keep out of"];
        let caption = "Requirements and columns, and the worst sample of each";
        let heads = heads.map(str::to_owned).into();
        Results { states, table: CampaignTable { caption, heads, rows, numbers: 2..5 } }
    }
}

/// Natural frequencies of structure and devices over the key, rotors at their initial rates, with the orders of a rate; none
/// where there are none, or where the spacecraft has no linear model.
fn campbell(prepared: &Prepared, axis: &Axis) -> Option<Picture> {
    // No rotor is swept: each keeps the rate of its scenario.
    let steady = Steady { motor: Motor::ConstantTorque, sprung: true, swept: None };
    let mut values: Vec<f64> = axis.values.clone();
    values.sort_by(f64::total_cmp);
    let natural = |value: &f64| -> Option<Vec<Oscillation>> {
        let overrides = [&prepared.overrides[..], &[axis.set(*value)]].concat();
        let (scenario, _) = prepared.template.scenario(&overrides).ok()?;
        let model = Model::new(&scenario, &[], &steady).ok()?;
        oscillations(&model, 1.0).ok()
    };
    let found = values.iter().map(natural).collect::<Option<Vec<_>>>()?;
    let speeds: Vec<f64> = values.iter().map(|value| value * axis.size).collect();
    let branches = branches(&speeds, &found);
    if branches.is_empty() {
        return None;
    }
    let orders = orders(prepared, axis);
    let crossings = crossings(&speeds, &branches, &orders);
    Some(crate::report::sweep::campbell(axis, &values, &branches, &orders, &crossings))
}

/// Orders of a wheel whose rate is swept: one, two, and those of its sources; none of another key.
fn orders(prepared: &Prepared, axis: &Axis) -> Vec<f64> {
    let is_rate = axis.key.rsplit('.').next() == Some("rate")
        && axis.key.starts_with("device.")
        && axis.dimension == Measure::ANGULAR_RATE.dimension;
    if !is_rate {
        return Vec::new();
    }
    let mut orders = vec![1.0, 2.0];
    for source in &prepared.scenario.disturbances {
        if let SourceModel::Harmonic(tones) = &source.model {
            orders.extend(tones.iter().map(|tone| tone.number));
        }
    }
    orders.sort_by(f64::total_cmp);
    orders.dedup();
    orders
}
