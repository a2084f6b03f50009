//! The symbols of units: what each is in SI, and which take a prefix.
//!
//! Sources: the SI brochure, 9th edition, for SI and the units used with it; NIST SP 811, appendix
//! B, for inch, foot, pound and ounce, which are exact.

use std::f64::consts::{PI, TAU};

use super::measure::{Dimension, Measure};

/// A symbol in SI: `10^ten * factor` of the SI unit of its dimension.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Symbol {
    pub(super) ten: i32,
    pub(super) factor: f64,
    pub(super) dimension: Dimension,
}

const fn symbol(ten: i32, factor: f64, measure: Measure) -> Symbol {
    Symbol { ten, factor, dimension: measure.dimension }
}

/// Symbols that take a prefix.
const PREFIXED: &[(&str, Symbol)] = &[
    ("g", symbol(-3, 1.0, Measure::MASS)),
    ("m", symbol(0, 1.0, Measure::LENGTH)),
    ("s", symbol(0, 1.0, Measure::TIME)),
    ("rad", symbol(0, 1.0, Measure::ANGLE)),
    ("Hz", symbol(0, 1.0, Measure::FREQUENCY)),
    ("N", symbol(0, 1.0, Measure::FORCE)),
    ("J", symbol(0, 1.0, Measure::ENERGY)),
    ("W", symbol(0, 1.0, Measure::POWER)),
    ("arcsec", symbol(0, PI / 648_000.0, Measure::ANGLE)),
];

/// Symbols that take none.
const PLAIN: &[(&str, Symbol)] = &[
    ("1", symbol(0, 1.0, Measure::NUMBER)),
    ("t", symbol(3, 1.0, Measure::MASS)),
    ("min", symbol(0, 60.0, Measure::TIME)),
    ("h", symbol(2, 36.0, Measure::TIME)),
    ("d", symbol(2, 864.0, Measure::TIME)),
    ("deg", symbol(0, PI / 180.0, Measure::ANGLE)),
    ("°", symbol(0, PI / 180.0, Measure::ANGLE)),
    ("arcmin", symbol(0, PI / 10_800.0, Measure::ANGLE)),
    ("rev", symbol(0, TAU, Measure::ANGLE)),
    ("rpm", symbol(0, PI / 30.0, Measure::ANGULAR_RATE)),
    ("in", symbol(-4, 254.0, Measure::LENGTH)),
    ("ft", symbol(-4, 3048.0, Measure::LENGTH)),
    ("lb", symbol(-8, 45_359_237.0, Measure::MASS)),
    ("oz", symbol(-12, 28_349_523_125.0, Measure::MASS)),
    ("lbf", symbol(-13, 44_482_216_152_605.0, Measure::FORCE)),
    ("ozf", symbol(0, 0.278_013_850_953_781_2, Measure::FORCE)),
];

/// Prefixes, as powers of ten.
const PREFIXES: &[(&str, i32)] = &[
    ("n", -9),
    ("u", -6),
    ("µ", -6),
    ("μ", -6),
    ("m", -3),
    ("c", -2),
    ("k", 3),
    ("M", 6),
    ("G", 9),
];

/// A symbol by its text, prefix included. A symbol that stands by itself has precedence: `min` is
/// the minute, and `m` the metre.
pub(super) fn find(text: &str) -> Option<Symbol> {
    let plain = PLAIN.iter().chain(PREFIXED).find(|(name, _)| *name == text);
    if let Some((_, symbol)) = plain {
        return Some(*symbol);
    }
    PREFIXES.iter().find_map(|(prefix, ten)| {
        let rest = text.strip_prefix(prefix)?;
        let (_, symbol) = PREFIXED.iter().find(|(name, _)| *name == rest)?;
        Some(Symbol { ten: symbol.ten + ten, ..*symbol })
    })
}

/// Prefixes as words.
const PREFIX_WORDS: &[(&str, &str)] = &[
    ("nano", "n"),
    ("micro", "u"),
    ("milli", "m"),
    ("centi", "c"),
    ("kilo", "k"),
    ("mega", "M"),
    ("giga", "G"),
];

/// Units as words.
const UNIT_WORDS: &[(&str, &str)] = &[
    ("radian", "rad"),
    ("gram", "g"),
    ("metre", "m"),
    ("meter", "m"),
    ("second", "s"),
    ("hertz", "Hz"),
    ("newton", "N"),
    ("joule", "J"),
    ("watt", "W"),
    ("degree", "deg"),
    ("minute", "min"),
    ("hour", "h"),
    ("arcsecond", "arcsec"),
    ("arcminute", "arcmin"),
];

/// The symbol of a unit that is written as words, in whole or in part: `microrad`, `µradian`, `Micrometers`.
fn worded(text: &str) -> Option<String> {
    let lower = text.to_lowercase();
    let known =
        |(word, symbol): &(&'static str, &'static str)| Some((*symbol, lower.strip_prefix(word)?));
    let word = PREFIX_WORDS.iter().find_map(known);
    let letter = PREFIXES.iter().find_map(|(letter, _)| known(&(letter, letter)));
    let mut splits = [word, Some(("", lower.as_str())), letter].into_iter().flatten();
    splits.find_map(|(prefix, unit)| {
        let singular = unit.strip_suffix('s').unwrap_or(unit);
        let unit = match UNIT_WORDS.iter().find(|(word, _)| *word == singular) {
            Some((_, symbol)) => symbol,
            // A symbol has its letters as they are written.
            None => text.get(text.len().checked_sub(unit.len())?..)?,
        };
        let symbol = format!("{prefix}{unit}");
        find(&symbol).map(|_| symbol)
    })
}

/// The unit that a text may mean, where it is written as words, or only letter case, a plural or a space is wrong:
/// `microrad`, `RPM`, `kgs`, `mNm`.
pub(super) fn parted(text: &str) -> Option<String> {
    if let Some(symbol) = worded(text) {
        return Some(symbol);
    }
    let lower = text.to_lowercase();
    let singular = text.strip_suffix('s').unwrap_or_default();
    if let Some(known) = [lower.as_str(), singular].into_iter().find(|text| find(text).is_some()) {
        return Some(known.to_owned());
    }
    let splits = text.char_indices().skip(1).map(|(at, _)| text.split_at(at));
    let known = splits.filter(|(first, second)| find(first).is_some() && find(second).is_some());
    // The longest first symbol: of `mNm` the millinewton.
    known.last().map(|(first, second)| format!("{first} {second}"))
}

/// All symbols with every prefix, for suggestions.
pub(super) fn all() -> impl Iterator<Item = String> {
    let bare = PLAIN.iter().chain(PREFIXED).map(|(name, _)| (*name).to_owned());
    let prefixed = PREFIXED
        .iter()
        .flat_map(|(name, _)| PREFIXES.iter().map(move |(prefix, _)| format!("{prefix}{name}")));
    bare.chain(prefixed)
}
