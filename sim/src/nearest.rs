//! Names near to an unknown one, for errors.

use std::path::{Path, PathBuf};

/// Less alike than this, a name is no likely meaning.
const LIKENESS: f64 = 0.7;
/// Names of which more than this share of the longer one's letters differ are not alike, however they begin: `s` is
/// not meant by `stone`.
const CHANGED_MAX: f64 = 0.6;
/// More than this, a list is not read.
const MOST: usize = 3;

/// Keys that are written for others, by the words of data sheets and of joints that slide or turn: unlike in letters.
const SYNONYMS: [(&str, &str); 14] = [
    ("speed", "rate"),
    ("rate", "speed"),
    ("speed_limit", "rate_limit"),
    ("rate_limit", "speed_limit"),
    ("max_speed", "rate_limit"),
    ("max_rate", "rate_limit"),
    ("max_speed", "speed_limit"),
    ("max_torque", "torque_limit"),
    ("max_force", "force_limit"),
    ("max_power", "power_limit"),
    ("torque", "force"),
    ("torque_limit", "force_limit"),
    ("force", "torque"),
    ("force_limit", "torque_limit"),
];

/// The known name for which an unknown one is a synonym.
pub(crate) fn synonym<'a>(unknown: &str, known: &[&'a str]) -> Option<&'a str> {
    let of = |(word, name): &(&str, &str)| {
        known.iter().copied().find(|known| *word == unknown && known == name)
    };
    SYNONYMS.iter().find_map(of)
}

/// The names most like an unknown one, the most alike first.
pub(crate) fn nearest<N: AsRef<str>>(unknown: &str, names: impl Iterator<Item = N>) -> Vec<String> {
    let mut alike: Vec<(f64, N)> = names
        .map(|name| (strsim::jaro_winkler(unknown, name.as_ref()), name))
        .filter(|(likeness, name)| *likeness >= LIKENESS && is_meant(unknown, name.as_ref()))
        .collect();
    alike.sort_by(|a, b| b.0.total_cmp(&a.0));
    let mut found: Vec<String> = Vec::new();
    for (_, name) in alike {
        let name = name.as_ref();
        if found.len() < MOST && !found.iter().any(|other| other == name) {
            found.push(name.to_owned());
        }
    }
    found
}

/// Whether so few letters differ that one name may be meant by the other.
fn is_meant(unknown: &str, name: &str) -> bool {
    strsim::normalized_damerau_levenshtein(unknown, name) >= 1.0 - CHANGED_MAX
}

/// A question for help: which of the names may be meant; `otherwise` where none is like the unknown one.
pub(crate) fn did_you_mean<N: AsRef<str>>(
    unknown: &str,
    names: impl Iterator<Item = N>,
    otherwise: &str,
) -> String {
    match nearest(unknown, names).as_slice() {
        [] => otherwise.to_owned(),
        near => format!("did you mean `{}`?", near.join("`, `")),
    }
}

/// The same of the TOML files beside one that is missing, named from where `written` names it.
pub(crate) fn did_you_mean_file(written: &str, path: &Path, otherwise: &str) -> String {
    let beside = path.parent().filter(|folder| !folder.as_os_str().is_empty());
    let files = std::fs::read_dir(beside.unwrap_or_else(|| Path::new("."))).ok();
    let names = files.into_iter().flatten().flatten().map(|file| PathBuf::from(file.file_name()));
    let names = names.filter(|name| name.extension() == Some("toml".as_ref()));
    let named = |name: PathBuf| Path::new(written).with_file_name(name).display().to_string();
    did_you_mean(written, names.map(named), otherwise)
}
