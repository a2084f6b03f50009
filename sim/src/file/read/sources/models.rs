//! What a source exerts: `[[source.harmonic]]`, `[source.broadband]`, `[source.record]`.

use std::path::{Path, PathBuf};

use super::components::{ComponentEntry, beside, given};
use crate::disturbance::{
    Broadband, COMPONENTS, CoherentPair, Harmonic, Measured, MeasuredInterpolation, RecordFile,
    Six, phases,
};
use crate::file::keys::Keys;
use crate::file::read::values::table_file::columns;
use crate::scenario::Settings;
use crate::units::{Dimension, Measure, parse_unit};

/// The amplitude of a harmonic force over the square of the rate.
const FORCE_COEFFICIENT: Measure = Measure {
    name: "an amplitude of a force over the square of the rate",
    also: Some(over_square_of_angle(Measure::STATIC_IMBALANCE)),
    ..Measure::STATIC_IMBALANCE
};
/// The same of a moment.
const MOMENT_COEFFICIENT: Measure = Measure {
    name: "an amplitude of a moment over the square of the rate",
    also: Some(over_square_of_angle(Measure::DYNAMIC_IMBALANCE)),
    ..Measure::DYNAMIC_IMBALANCE
};

/// `N/rpm^2` beside `kg m`: N/(rad/s)^2 is kg m/rad^2.
const fn over_square_of_angle(of: Measure) -> Dimension {
    Dimension { angle: -2, ..of.dimension }
}

/// The harmonics of a source with a name, a spin axis and a seed.
pub(super) fn harmonics(keys: &Keys<'_>, of: (&str, usize, Option<u32>)) -> Option<Vec<Harmonic>> {
    let tables = keys.tables("harmonic");
    tables.iter().map(|keys| harmonic(keys, of)).collect()
}

pub(super) fn harmonic(
    keys: &Keys<'_>,
    (source, spin_axis, seed): (&str, usize, Option<u32>),
) -> Option<Harmonic> {
    if !keys.has("number") {
        keys.missing("number", "number = 2.0");
    }
    let number = keys.number("number");
    let amplitudes = given(keys, spin_axis, [FORCE_COEFFICIENT, MOMENT_COEFFICIENT]);
    let known = amplitudes.as_deref();
    let written = keys.table("phase").map(|table| {
        let written = beside(&table, spin_axis, known, Measure::ANGLE);
        table.finish();
        written
    });
    keys.finish();
    let number = number?;
    let mut found = Harmonic { number, amplitudes: [0.0; 6], phases: [0.0; 6] };
    let amplitudes = amplitudes?;
    if amplitudes.is_empty() {
        keys.missing("radial_force", "radial_force = \"0.1 g cm\"");
        return None;
    }
    for ComponentEntry { key, components, values } in &amplitudes {
        let [amplitude] = values.as_slice() else {
            keys.error(key, format!("`{key}` has {} numbers", values.len()), "write one");
            return None;
        };
        let of_key = written.iter().flatten().find(|(written, _)| written == key);
        let drawn = || phases(seed?, source, &format!("{number:?} {key}")).next();
        let Some(phase) = of_key.map(|(_, phase)| *phase).or_else(drawn) else {
            let help = format!("write `phase.{key} = \"0 deg\"`, or give the source a `seed`");
            keys.error(key, format!("`{key}` has no phase"), &help);
            return None;
        };
        for (component, behind) in components {
            if let (Some(to), Some(at)) =
                (found.amplitudes.get_mut(*component), found.phases.get_mut(*component))
            {
                (*to, *at) = (*amplitude, phase + behind);
            }
        }
    }
    Some(found)
}

/// `[source.broadband]`: `band`, `period`, `frequencies`, densities, `reference_rate`.
pub(super) fn broadband(
    keys: &Keys<'_>,
    spin_axis: usize,
    settings: Option<&Settings>,
) -> Option<Broadband> {
    let list = |key: &str| match keys.node(key) {
        Some(node) => keys.values_of(node, key, Measure::FREQUENCY),
        None => Some(Vec::new()),
    };
    let frequencies = list("frequencies");
    let band = keys.quantities::<2>("band", Measure::FREQUENCY);
    let ends = frequencies.as_ref().and_then(|list| Some([*list.first()?, *list.last()?]));
    if !keys.has("band") && !keys.has("frequencies") {
        keys.missing("band", "band = \"1, 300 Hz\"");
    }
    let period = if keys.has("period") {
        keys.quantity("period", Measure::TIME)
    } else {
        settings.map(|settings| settings.duration)
    };
    let densities = given(keys, spin_axis, [Measure::FORCE_DENSITY, Measure::MOMENT_DENSITY]);
    let reference_rate = keys.quantity("reference_rate", Measure::ANGULAR_RATE);
    let pairs: Option<Vec<_>> = keys.tables("coherent").iter().map(coherent).collect();
    keys.finish();
    let densities = densities?;
    if densities.is_empty() {
        keys.missing("radial_force", "radial_force = \"1e-8 N^2/Hz\"");
        return None;
    }
    let band = if keys.has("band") { band? } else { ends? };
    Some(Broadband {
        band,
        period: period?,
        frequencies: frequencies?,
        densities: by_component(densities),
        reference_rate,
        pairs: pairs?,
    })
}

/// `[[source.broadband.coherent]]`: `between`, `coherence`, `phase`.
fn coherent(keys: &Keys<'_>) -> Option<CoherentPair> {
    for (key, example) in
        [("between", "between = [\"force_y\", \"moment_z\"]"), ("coherence", "coherence = 0.5")]
    {
        if !keys.has(key) {
            keys.missing(key, example);
        }
    }
    let names = keys.texts("between");
    let list = |key: &str, measure| match keys.node(key) {
        Some(node) => keys.values_of(node, key, measure),
        None => Some(vec![0.0]),
    };
    let (coherence, phase) = (list("coherence", Measure::NUMBER), list("phase", Measure::ANGLE));
    keys.finish();
    let known = |name: &&str| COMPONENTS.iter().position(|component| component == name);
    let components: Option<Vec<usize>> = names?.iter().map(known).collect();
    let Some(&[first, second]) = components.as_deref() else {
        let help = format!("name two of {}", COMPONENTS.join(", "));
        keys.error("between", "coherence is between two components", &help);
        return None;
    };
    Some(CoherentPair { components: [first, second], coherence: coherence?, phase: phase? })
}

fn by_component(given: Vec<ComponentEntry>) -> Six<Vec<f64>> {
    let mut found: Six<Vec<f64>> = Default::default();
    for ComponentEntry { components, values, .. } in given {
        for (component, _) in components {
            if let Some(to) = found.get_mut(component) {
                to.clone_from(&values);
            }
        }
    }
    found
}

/// `[source.record]`: a `file`, or `times` and components; `interpolation`, `repeats`.
pub(super) fn record(keys: &Keys<'_>, spin_axis: usize, folder: &Path) -> Option<Measured> {
    if !keys.has("interpolation") {
        keys.missing("interpolation", "interpolation = \"linear\"");
    }
    let words =
        [("linear", MeasuredInterpolation::Linear), ("cubic", MeasuredInterpolation::Cubic)];
    let interpolation = keys.choice("interpolation", &words);
    let repeats = keys.boolean("repeats").unwrap_or(false);
    let from_file = file(keys, folder);
    let times = keys.node("times").map(|node| keys.values_of(node, "times", Measure::TIME));
    let inline = given(keys, spin_axis, [Measure::FORCE, Measure::TORQUE]);
    keys.finish();
    let inline = inline?;
    if keys.has("file") && (times.is_some() || !inline.is_empty()) {
        keys.error("file", "a record is in a file, and here", "keep one of them");
        return None;
    }
    let (times, values, file) = match times {
        _ if keys.has("file") => from_file?,
        Some(times) => (times?, by_component(inline), None),
        None => {
            keys.missing("file", "file = \"record.csv\"");
            return None;
        }
    };
    if values.iter().all(Vec::is_empty) {
        let help = format!("name one of {}", COMPONENTS.join(", "));
        keys.error("file", "the record has no force and no moment", &help);
        return None;
    }
    Some(Measured { times, values, interpolation: interpolation?, repeats, file })
}

/// A record with more rows stays in its file when its scenario is written.
const INLINE_ROWS_MAX: usize = 2000;

type Rows = (Vec<f64>, Six<Vec<f64>>, Option<Box<RecordFile>>);

/// The record of a file, by the names of its columns; nothing where none is named.
fn file(keys: &Keys<'_>, folder: &Path) -> Option<Rows> {
    let time = keys.text("time").unwrap_or("time_s");
    let named = keys.table("columns");
    let force = unit(keys, "force_unit", Measure::FORCE);
    let moment = unit(keys, "moment_unit", Measure::TORQUE);
    let names = COMPONENTS.map(|component| match &named {
        // Of the names that are not written those that the file has.
        Some(named) => named.text(component).map_or((component, false), |name| (name, true)),
        None => (component, false),
    });
    if let Some(named) = &named {
        named.finish();
    }
    if !keys.has("file") {
        for key in ["time", "columns", "force_unit", "moment_unit"] {
            if keys.has(key) {
                keys.error(key, format!("`{key}` is of a file"), "give `file`, or remove this");
            }
        }
        return None;
    }
    let read = |(path, name): (PathBuf, String)| {
        let names: Vec<_> = [(time, true)].into_iter().chain(names).collect();
        let found = columns(&path, &names);
        let found = found.map_err(|message| keys.error("file", format!("{name}: {message}"), ""));
        Some((found.ok()?, name))
    };
    let found = keys.file("file", folder).and_then(read);
    let ((force, force_unit), (moment, moment_unit)) = (force?, moment?);
    let (columns, name) = found?;
    let mut columns = columns.into_iter();
    let times = columns.next()?;
    let mut values: Six<Vec<f64>> = Default::default();
    for ((index, to), column) in values.iter_mut().enumerate().zip(columns) {
        let size = if index < 3 { force } else { moment };
        *to = column.into_iter().map(|value| value * size).collect();
    }
    let mut of_file = names
        .iter()
        .zip(&values)
        .map(|((name, _), values)| (!values.is_empty()).then(|| (*name).to_owned()));
    let file = RecordFile {
        name,
        time: time.to_owned(),
        columns: std::array::from_fn(|_| of_file.next().flatten()),
        units: [force_unit, moment_unit].map(str::to_owned),
    };
    let file = (times.len() > INLINE_ROWS_MAX).then(|| Box::new(file));
    Some((times, values, file))
}

/// The unit of columns, and its size in SI; SI where none is written.
fn unit<'a>(keys: &Keys<'a>, key: &str, measure: Measure) -> Option<(f64, &'a str)> {
    if !keys.has(key) {
        return Some((1.0, measure.unit));
    }
    let text = keys.text(key)?;
    match parse_unit(text) {
        Ok((size, dimension)) if dimension == measure.dimension => Some((size, text)),
        Ok(_) => {
            let message = format!("`{text}` is no unit of {}", measure.name);
            keys.error(key, message, &format!("{} is one", measure.usual));
            None
        }
        Err(error) => {
            keys.error(key, format!("`{text}`: {}", error.kind), "");
            None
        }
    }
}
