//! The symbols of units: what each is in SI, and which take a prefix.
//!
//! Sources: the SI brochure, 9th edition, for SI and the units used with it; NIST SP 811, appendix
//! B, for inch, foot, pound and ounce, which are exact.

use std::f64::consts::{PI, TAU};

use super::measure::{Dimension, Measure};
use crate::nearest::nearest;

/// A symbol in SI: `10^ten * factor` of the SI unit of its dimension.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Symbol {
    pub(super) ten: i32,
    pub(super) factor: f64,
    pub(super) dimension: Dimension,
    /// One of hertz, which are cycles or turns per second; zero of all others.
    pub(super) hertz: i8,
}

const fn symbol(ten: i32, factor: f64, measure: Measure) -> Symbol {
    Symbol { ten, factor, dimension: measure.dimension, hertz: 0 }
}

/// Symbols that take a prefix.
const PREFIXED: &[(&str, Symbol)] = &[
    ("g", symbol(-3, 1.0, Measure::MASS)),
    ("m", symbol(0, 1.0, Measure::LENGTH)),
    ("s", symbol(0, 1.0, Measure::TIME)),
    ("rad", symbol(0, 1.0, Measure::ANGLE)),
    ("Hz", Symbol { hertz: 1, ..symbol(0, 1.0, Measure::FREQUENCY) }),
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
    ("mas", symbol(-3, PI / 648_000.0, Measure::ANGLE)),
    ("uas", symbol(-6, PI / 648_000.0, Measure::ANGLE)),
    ("µas", symbol(-6, PI / 648_000.0, Measure::ANGLE)),
    ("rev", symbol(0, TAU, Measure::ANGLE)),
    ("rpm", symbol(0, PI / 30.0, Measure::ANGULAR_RATE)),
    ("in", symbol(-4, 254.0, Measure::LENGTH)),
    ("ft", symbol(-4, 3048.0, Measure::LENGTH)),
    ("lb", symbol(-8, 45_359_237.0, Measure::MASS)),
    ("lbm", symbol(-8, 45_359_237.0, Measure::MASS)),
    // lbf s²/ft.
    ("slug", symbol(0, 4.448_221_615_260_5 / 0.3048, Measure::MASS)),
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

/// A symbol by its text, prefix included. A symbol by itself has precedence: `min` is
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

/// What a text of letters is.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Spelling {
    /// A symbol, or the way in which data sheets spell one: `rpm`, `RPM`, `degrees`.
    One(Symbol),
    /// The product of two: `gcm`, `mNm`.
    Product([Symbol; 2]),
    /// More than one unit, as symbols: `Nms` is `N m s` or `N ms`.
    Several(Vec<String>),
    /// None, with what may be meant.
    Unknown(Option<String>),
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

/// Units as words, in the singular.
const UNIT_WORDS: &[(&str, &str)] = &[
    ("radian", "rad"),
    ("gram", "g"),
    ("metre", "m"),
    ("meter", "m"),
    ("second", "s"),
    ("sec", "s"),
    ("hertz", "Hz"),
    ("newton", "N"),
    ("joule", "J"),
    ("watt", "W"),
    ("degree", "deg"),
    ("minute", "min"),
    ("hour", "h"),
    ("hr", "h"),
    ("arcsec", "arcsec"),
    ("arcsecond", "arcsec"),
    ("arcminute", "arcmin"),
    ("revolution", "rev"),
    ("inch", "in"),
    ("foot", "ft"),
    ("feet", "ft"),
];

/// Spellings of data sheets with one reading.
const SPELLINGS: &[(&str, &str)] =
    &[("Kg", "kg"), ("RPM", "rpm"), ("Rpm", "rpm"), ("r", "rev"), ("micron", "um")];

/// Spellings with another reading than the usual one, or none of their own, and what to write.
const OFFERED: &[(&str, &[&str])] = &[
    ("gm", &["g", "g m"]),
    ("gms", &["g"]),
    ("rps", &["rev/s", "rad/s"]),
    ("NM", &["N m", "nm"]),
    ("NMS", &["N m s"]),
];

/// What a text of letters is.
pub(super) fn spelling(text: &str) -> Spelling {
    let alias = || SPELLINGS.iter().find(|(spelling, _)| *spelling == text);
    let symbol = find(text).or_else(|| find(alias()?.1)).or_else(|| find(&worded(text)?));
    if let Some(symbol) = symbol {
        return Spelling::One(symbol);
    }
    if let Some((_, readings)) = OFFERED.iter().find(|(spelling, _)| *spelling == text) {
        return Spelling::Several(readings.iter().map(|reading| (*reading).to_owned()).collect());
    }
    // A plural, and not a product with the second.
    if let Some(singular) = text.strip_suffix('s').filter(|singular| is_counted(singular)) {
        return Spelling::Unknown(Some(singular.to_owned()));
    }
    let products = products(text);
    match &products[..] {
        [[first, second]] => match (find(first), find(second), parted(second)) {
            (.., Some([second_of, third])) => Spelling::Several(vec![
                format!("{first} {second_of} {third}"),
                format!("{first} {second}"),
            ]),
            (Some(first), Some(second), None) => Spelling::Product([first, second]),
            _ => Spelling::Unknown(None),
        },
        [] => Spelling::Unknown(near(text)),
        _ => Spelling::Several(products.iter().map(|pair| pair.join(" ")).collect()),
    }
}

/// Whether a word says how a unit is multiplied: `milli`, or `arc`.
pub(super) fn is_prefix_word(text: &str) -> bool {
    let lower = text.to_lowercase();
    lower == "arc" || PREFIX_WORDS.iter().any(|(word, _)| *word == lower)
}

/// Whether a symbol is said in the plural.
fn is_counted(symbol: &str) -> bool {
    let of = |measure: Measure, found: Symbol| found.dimension == measure.dimension;
    let measures = [Measure::MASS, Measure::LENGTH, Measure::ANGLE, Measure::ANGULAR_RATE];
    find(symbol).is_some_and(|found| measures.into_iter().any(|measure| of(measure, found)))
}

/// The pairs of symbols that a text without a space is made of, as data sheets write them: a mass, a force, an energy or a
/// power and a length or a time (`gcm`, `Ns`), or a foot or inch and a weight (`ftlb`).
fn products(text: &str) -> Vec<[&str; 2]> {
    let measures = |of: &str, all: &[Measure]| {
        find(of).is_some_and(|found| all.iter().any(|measure| measure.dimension == found.dimension))
    };
    let quantity = [Measure::MASS, Measure::FORCE, Measure::ENERGY, Measure::POWER];
    let is_pair = |first: &str, second: &str| {
        let arm =
            matches!(first, "in" | "ft") && matches!(second, "lb" | "lbm" | "oz" | "lbf" | "ozf");
        let times = first != "t"
            && measures(first, &quantity)
            && measures(second, &[Measure::LENGTH, Measure::TIME]);
        arm || times
    };
    let splits = text.char_indices().skip(1).map(|(at, _)| text.split_at(at));
    let pairs = splits.filter(|(first, second)| is_pair(first, second));
    pairs.map(|(first, second)| [first, second]).collect()
}

/// The two symbols that a symbol may also be read as: of `ms` metre and second, but of `mm` nothing.
fn parted(text: &str) -> Option<[&str; 2]> {
    let splits = text.char_indices().skip(1).map(|(at, _)| text.split_at(at));
    let mut known = splits.filter(|(first, second)| {
        first != second && find(first).is_some() && find(second).is_some()
    });
    known.next().map(|(first, second)| [first, second])
}

/// The symbol of a unit that is written as words, in whole or in part: `microrad`, `µradian`, `Micrometers`.
fn worded(text: &str) -> Option<String> {
    let lower = text.to_lowercase();
    let tail = |word: &str| text.get(text.len().checked_sub(lower.len() - word.len())?..);
    let of_word = PREFIX_WORDS.iter().find(|(word, _)| lower.starts_with(word));
    let of_word = of_word.and_then(|(word, prefix)| Some((*prefix, tail(word)?)));
    // A letter has its case as it is written: of `Mradian` the mega.
    let letter =
        PREFIXES.iter().find_map(|(letter, _)| Some((*letter, text.strip_prefix(letter)?)));
    let mut splits = [of_word, Some(("", text)), letter].into_iter().flatten();
    splits.find_map(|(prefix, unit)| {
        let lower = unit.to_lowercase();
        let singular = lower.strip_suffix("es").filter(|word| *word == "inch");
        let singular = singular.or_else(|| lower.strip_suffix('s')).unwrap_or(&lower);
        let word = UNIT_WORDS.iter().find(|(word, _)| *word == singular || *word == lower);
        // A prefix as a word may be before a symbol, whose letters are as they are written.
        let unit = match word {
            Some((_, symbol)) => *symbol,
            None => unit,
        };
        let symbol = format!("{prefix}{unit}");
        find(&symbol).map(|_| symbol)
    })
}

/// The unit that may be meant by a text that is none.
fn near(text: &str) -> Option<String> {
    let lower = text.to_lowercase();
    let of_case = all().find(|known| known.to_lowercase() == lower);
    of_case.or_else(|| nearest(text, all()).into_iter().next())
}

/// All symbols with every prefix, for suggestions.
pub(super) fn all() -> impl Iterator<Item = String> {
    let bare = PLAIN.iter().chain(PREFIXED).map(|(name, _)| (*name).to_owned());
    let prefixed = PREFIXED
        .iter()
        .flat_map(|(name, _)| PREFIXES.iter().map(move |(prefix, _)| format!("{prefix}{name}")));
    bare.chain(prefixed)
}
