//! Columns of numbers in a file beside a scenario: CSV by the names of its first line, or NPZ by the names
//! of its arrays.

use std::io::Read as _;
use std::path::Path;

use crate::opened::open;
use crate::record::extent::check_rows;
use crate::structure::npz;

/// Most rows of a table.
const ROWS_MAX: usize = 1_000_000;
/// Most bytes of its file: a device has no end.
const BYTES_MAX: u64 = 100_000_000;

/// Columns of numbers, each as long as the others.
pub(super) type Numbers = Vec<Vec<f64>>;

/// The columns of some names, in their order: of an archive where the file's name ends in `.npz`.
///
/// A name may be missing in the file where `needed` says no: its column is empty.
pub(super) fn columns(path: &Path, names: &[(&str, bool)]) -> Result<Numbers, String> {
    if path.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("npz")) {
        return of_npz(path, names);
    }
    of_csv(path, names)
}

fn too_long() -> String {
    format!("more than {BYTES_MAX} bytes")
}

fn no_column(name: &str, known: &[&str]) -> String {
    format!("no column `{name}`; there are {}", known.join(", "))
}

fn of_csv(path: &Path, names: &[(&str, bool)]) -> Result<Numbers, String> {
    let file = open(path).map_err(|error| error.to_string())?;
    let mut reader = csv::ReaderBuilder::new()
        .comment(Some(b'#'))
        .trim(csv::Trim::All)
        .from_reader(file.take(BYTES_MAX));
    let head = reader.headers().map_err(|error| error.to_string())?.clone();
    if reader.position().byte() >= BYTES_MAX {
        return Err(too_long());
    }
    let known: Vec<_> = head.iter().collect();
    let place = |(name, needed): &(&str, bool)| {
        let place = known.iter().position(|column| column == name);
        if place.is_none() && *needed { Err(no_column(name, &known)) } else { Ok(place) }
    };
    let places = names.iter().map(place).collect::<Result<Vec<_>, _>>()?;
    let mut columns = vec![Vec::new(); names.len()];
    let mut rows = 0;
    for record in reader.records() {
        let record = record.map_err(|error| error.to_string())?;
        let line = record.position().map_or(0, csv::Position::line);
        for (column, place) in columns.iter_mut().zip(&places) {
            let Some(place) = place else { continue };
            let text = record.get(*place).unwrap_or_default();
            let number = text.parse::<f64>().ok().filter(|number| number.is_finite());
            column
                .push(number.ok_or_else(|| format!("line {line}: `{text}` is no finite number"))?);
        }
        rows += 1;
        if rows > ROWS_MAX {
            return Err(format!("more than {ROWS_MAX} rows"));
        }
    }
    if reader.position().byte() >= BYTES_MAX {
        return Err(too_long());
    }
    check_rows(path, rows)?;
    Ok(columns)
}

fn of_npz(path: &Path, names: &[(&str, bool)]) -> Result<Numbers, String> {
    let file = open(path).map_err(|error| error.to_string())?;
    let mut bytes = Vec::new();
    file.take(BYTES_MAX + 1).read_to_end(&mut bytes).map_err(|error| error.to_string())?;
    if u64::try_from(bytes.len()).unwrap_or(u64::MAX) > BYTES_MAX {
        return Err(too_long());
    }
    let arrays = npz::columns(&bytes).map_err(|error| error.to_string())?;
    let known: Vec<_> = arrays.iter().map(|(name, _)| name.as_str()).collect();
    let column =
        |(name, needed): &(&str, bool)| match arrays.iter().find(|(known, _)| known == name) {
            None if *needed => Err(no_column(name, &known)),
            None => Ok(Vec::new()),
            Some((_, Err(error))) => Err(error.to_string()),
            Some((_, Ok(numbers))) if numbers.len() > ROWS_MAX => {
                Err(format!("more than {ROWS_MAX} rows"))
            }
            Some((_, Ok(numbers))) => Ok(numbers.clone()),
        };
    names.iter().map(column).collect()
}
