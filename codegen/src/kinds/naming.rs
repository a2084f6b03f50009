//! Which names a kind may have, and how a coordinate is written: what a builder makes is checked
//! here, before any symbol is made of it.

use std::collections::BTreeSet;
use std::fmt;

use rustc_hash::FxHashSet;

use super::{Centre, Kind};

/// Why a kind cannot be made.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum KindError {
    /// Its last link has no body: nothing would have inertia about the last joint.
    NoBody {
        /// The kind.
        kind: String,
        /// The link.
        link: String,
    },
    /// It has more joints than a chain may have.
    Joints {
        /// The kind.
        kind: String,
        /// How many it has.
        count: usize,
    },
    /// It has no link.
    NoLink {
        /// The kind.
        kind: String,
    },
    /// A name is not made of the letters that it may be made of.
    Letters {
        /// What is named.
        what: &'static str,
        /// Its name.
        name: String,
        /// What it may be.
        remedy: &'static str,
    },
    /// A name would stand for two things.
    Taken {
        /// What is named.
        what: &'static str,
        /// Its name.
        name: String,
    },
}

impl fmt::Display for KindError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NoLink { kind } => write!(f, "kind `{kind}` has no link; give it one"),
            Self::Joints { kind, count } => {
                write!(f, "kind `{kind}` has {count} joints, more than {JOINTS}; leave some out")
            }
            Self::NoBody { kind, link } => {
                write!(f, "the last link of kind `{kind}`, {link}, has no body; give it one")
            }
            Self::Letters { what, name, remedy } => {
                write!(f, "`{name}` cannot be the {what}; {remedy}")
            }
            Self::Taken { what, name } => {
                write!(f, "`{name}`, a {what}, is the name of something else; choose another")
            }
        }
    }
}

impl std::error::Error for KindError {}

/// The longest chain: each combination of driven and prescribed joints is proven, and one joint more
/// doubles them.
const JOINTS: usize = 8;

/// Points, frames, assemblies and endings that the derivation itself uses.
const LETTERS: [&str; 9] = ["b", "c", "d", "n", "sc", "rest", "tilde", "all", "bc"];

/// First words of the names that the derivation makes.
const STEMS: [&str; 25] = [
    "angular", "constant", "cos", "diagonal", "driven", "energy", "f", "free", "gain", "given",
    "h", "held", "i", "k", "linear", "m", "mass", "mr", "n", "omega", "pivot", "r", "recip", "sin",
    "u",
];

/// Functions and records of every emitted file, as titles that would give their names.
const TITLES: [&str; 26] = [
    "axes",
    "back substitute",
    "body acceleration",
    "body rate",
    "body velocity",
    "constant share",
    "eliminate",
    "eliminated",
    "energy momentum",
    "external",
    "first moment",
    "gains",
    "gradient",
    "gravity",
    "hub share",
    "joint accelerations",
    "load derivatives",
    "loads",
    "modes",
    "motors",
    "parameters",
    "positions",
    "prepare",
    "prepared",
    "steer",
    "steering",
];

const WORD: &str = "use up to eight letters from a to z, and no keyword";
const WORDS: &str = "use words of letters from a to z, with one underscore between two";
const TITLE: &str = "use words of letters from a to z, with one space between two";

/// Checks every name of a kind.
///
/// # Errors
/// When there is no link, or for the first name that cannot be.
pub(super) fn check(kind: &Kind) -> Result<(), KindError> {
    if kind.links.is_empty() {
        return Err(KindError::NoLink { kind: kind.name.to_owned() });
    }
    if kind.links.len() > JOINTS {
        return Err(KindError::Joints { kind: kind.name.to_owned(), count: kind.links.len() });
    }
    if let Some(link) = kind.links.last().filter(|link| link.body.mass.is_none()) {
        let link = link.body.title.to_owned();
        return Err(KindError::NoBody { kind: kind.name.to_owned(), link });
    }
    words(kind.name, '_', ["name of the kind", WORDS])?;
    words(kind.title.replace('-', " ").as_str(), ' ', ["title of the kind", TITLE])?;
    let mut titles = Names::new("title", TITLES.into_iter().chain(["trig", "rates", "wrenches"]));
    let mut letters = Names::new("letter", LETTERS);
    let mut given = Names::new("name", []);
    for link in kind.links {
        let (joint, body) = (&link.joint, &link.body);
        if joint.tag.len() > 8
            || words(joint.tag, '_', ["", ""]).is_err()
            || joint.tag.contains('_')
        {
            return Err(letters_error(["letter of a link", WORD], joint.tag));
        }
        words(body.title, ' ', ["title of a link", TITLE])?;
        titles.add(body.title)?;
        for letter in BTreeSet::from([body.frame, body.origin, body.point, link.assembly]) {
            // The device as a whole is D, whatever comes first in it.
            if letter != "d" || letter == body.frame {
                letters.add(letter)?;
            }
        }
        own_word(joint.coordinate, "coordinate")?;
        [joint.coordinate, joint.rate, joint.acceleration]
            .into_iter()
            .try_for_each(|name| given.add(name))?;
        match body.centre {
            Centre::On(_, distance) => {
                own_word(distance, "distance")?;
                given.add(distance)?;
            }
            // Named after the body's letter, or not at all.
            Centre::Free(_) | Centre::At => {}
        }
    }
    pairs(kind)
}

/// Entries of the joints' mass matrix are named after two letters: no two alike.
fn pairs(kind: &Kind) -> Result<(), KindError> {
    let mut names = Names::new("pair of letters", []);
    for (k, first) in kind.links.iter().enumerate() {
        for second in &kind.links[k..] {
            names.add(&format!("{}{}", first.joint.tag, second.joint.tag))?;
        }
    }
    Ok(())
}

/// A name that a user chooses whole.
fn own_word(name: &str, what: &'static str) -> Result<(), KindError> {
    words(name, '_', [what, WORDS])?;
    let stem = name.split('_').next().unwrap_or_default();
    let reserved = STEMS.contains(&stem) && name != stem || ["dot", "ddot"].contains(&stem);
    // What every structure of parameters has beside the kind's own.
    let stated = ["mount", "passive", "model"].contains(&name);
    let ending = ["_dot", "_ddot", "_prime", "_dprime"].iter().any(|end| name.ends_with(end));
    if reserved || ending || stated {
        return Err(KindError::Taken { what, name: name.to_owned() });
    }
    Ok(())
}

/// Words of letters that make an identifier.
fn words(name: &str, between: char, [what, remedy]: [&'static str; 2]) -> Result<(), KindError> {
    let word = |word: &str| !word.is_empty() && word.bytes().all(|byte| byte.is_ascii_lowercase());
    let identifier = name.replace(between, "_");
    if name.split(between).all(word) && syn::parse_str::<syn::Ident>(&identifier).is_ok() {
        return Ok(());
    }
    Err(letters_error([what, remedy], name))
}

fn letters_error([what, remedy]: [&'static str; 2], name: &str) -> KindError {
    KindError::Letters { what, name: name.to_owned(), remedy }
}

/// Names that are taken.
struct Names {
    what: &'static str,
    taken: FxHashSet<String>,
}

impl Names {
    fn new<'a>(what: &'static str, taken: impl IntoIterator<Item = &'a str>) -> Self {
        Self { what, taken: taken.into_iter().map(str::to_owned).collect() }
    }

    fn add(&mut self, name: &str) -> Result<(), KindError> {
        if self.taken.insert(name.to_owned()) {
            return Ok(());
        }
        Err(KindError::Taken { what: self.what, name: name.to_owned() })
    }
}

/// A coordinate as it is written, with dots above its first letter: `γ_o` for `gamma_o`.
pub(super) fn written(name: &str, dots: &str) -> String {
    const GREEK: [(&str, &str); 23] = [
        ("alpha", "α"),
        ("beta", "β"),
        ("gamma", "γ"),
        ("delta", "δ"),
        ("epsilon", "ε"),
        ("zeta", "ζ"),
        ("eta", "η"),
        ("theta", "θ"),
        ("iota", "ι"),
        ("kappa", "κ"),
        ("lambda", "λ"),
        ("mu", "μ"),
        ("nu", "ν"),
        ("xi", "ξ"),
        ("pi", "π"),
        ("rho", "ρ"),
        ("sigma", "σ"),
        ("tau", "τ"),
        ("upsilon", "υ"),
        ("phi", "φ"),
        ("chi", "χ"),
        ("psi", "ψ"),
        ("omega", "ω"),
    ];
    let (stem, below) = name.split_at(name.find('_').unwrap_or(name.len()));
    let greek = GREEK.iter().find(|(word, _)| *word == stem);
    let stem = greek.map_or(stem, |(_, letter)| letter);
    let mut letters = stem.chars();
    let first = letters.next().map(String::from).unwrap_or_default();
    format!("{first}{dots}{}{below}", letters.as_str())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::kinds::Link;
    use crate::space::Axis;

    fn refused(letter: &str, title: &str, coordinate: &str) -> String {
        let link = Link::turning(letter, title, Axis::Z, coordinate);
        Kind::builder("arm", "arm").link(link).build().unwrap_err().to_string()
    }

    #[test]
    fn a_name_that_cannot_be_is_told_with_its_remedy() {
        let none = Kind::builder("arm", "arm").build().unwrap_err();
        assert_eq!(none.to_string(), "kind `arm` has no link; give it one");
        let long = ["a", "e", "f", "g", "h", "i", "j", "k", "l"].into_iter();
        let long = long.fold(Kind::builder("arm", "arm"), |kind, letter| {
            kind.link(Link::turning(letter, "arm", Axis::Z, "phi"))
        });
        let message = "kind `arm` has 9 joints, more than 8; leave some out";
        assert_eq!(long.build().unwrap_err().to_string(), message);
        let axes = Link::turning("a", "arm", Axis::Z, "phi").bodiless();
        let none = Kind::builder("arm", "arm").link(axes).build().unwrap_err();
        assert_eq!(none.to_string(), "the last link of kind `arm`, arm, has no body; give it one");
        let message = "`fn` cannot be the letter of a link; use up to eight letters from a to z, and \
                       no keyword";
        assert_eq!(refused("fn", "arm", "phi"), message);
        assert!(refused("A", "arm", "phi").starts_with("`A` cannot be the letter of a link"));
        assert!(refused("a", "Arm", "phi").starts_with("`Arm` cannot be the title of a link"));
        assert!(refused("a", "upper  arm", "phi").contains("one space between two"));
        assert!(refused("a", "arm", "phi 2").starts_with("`phi 2` cannot be the coordinate"));
    }

    #[test]
    fn a_name_that_stands_for_something_is_refused() {
        for (letter, title, coordinate) in [
            ("b", "arm", "phi"),
            ("d", "arm", "phi"),
            ("rest", "arm", "phi"),
            ("a", "prepare", "phi"),
            ("a", "arm", "m_a"),
            ("a", "arm", "phi_dot"),
        ] {
            let message = refused(letter, title, coordinate);
            assert!(
                message.ends_with("is the name of something else; choose another"),
                "{message}"
            );
        }
        let twice = Kind::builder("arms", "arms")
            .link(Link::turning("a", "arm", Axis::Z, "phi"))
            .link(Link::turning("f", "hand", Axis::Z, "phi"));
        let error = twice.build().unwrap_err();
        assert_eq!(error, KindError::Taken { what: "name", name: "phi".to_owned() });
    }

    #[test]
    fn greek_letters_are_written_as_such() {
        assert_eq!(written("gamma_o", "\u{307}"), "γ\u{307}_o");
        assert_eq!(written("x", ""), "x");
        assert_eq!(written("tilt", "\u{308}"), "t\u{308}ilt");
    }
}
