//! Turns that a mount is made of, as text: `"z"`, or `"x 90"` where it is whole quarters of a turn.

use serde::{Deserialize, Serialize};

/// A turn about a coordinate axis that turned along with those before it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(into = "String", try_from = "String")]
pub struct Turn {
    /// About which axis.
    pub about: Axis,
    /// By so many quarters of a turn, 1 to 3; none where the angle is in the numbers.
    pub quarters: Option<u8>,
}

/// A coordinate axis.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Axis {
    /// The first.
    X,
    /// The second.
    Y,
    /// The third.
    Z,
}

/// The axes by their letters.
const LETTERS: [(&str, Axis); 3] = [("x", Axis::X), ("y", Axis::Y), ("z", Axis::Z)];

impl From<Turn> for String {
    fn from(turn: Turn) -> Self {
        let letter = LETTERS.iter().find(|(_, axis)| *axis == turn.about);
        let letter = letter.map_or("", |(letter, _)| letter);
        match turn.quarters {
            Some(quarters) => format!("{letter} {}", 90 * u16::from(quarters)),
            None => letter.to_owned(),
        }
    }
}

impl TryFrom<String> for Turn {
    type Error = String;

    fn try_from(text: String) -> Result<Self, String> {
        let (letter, degrees) = match text.split_once(' ') {
            Some((letter, degrees)) => (letter, Some(degrees)),
            None => (text.as_str(), None),
        };
        let about = LETTERS.iter().find(|(own, _)| *own == letter).map(|(_, axis)| *axis);
        let quarters = match degrees {
            None => Some(None),
            Some("90") => Some(Some(1)),
            Some("180") => Some(Some(2)),
            Some("270") => Some(Some(3)),
            Some(_) => None,
        };
        let turn = about.zip(quarters).map(|(about, quarters)| Self { about, quarters });
        turn.ok_or_else(|| {
            format!(
                "`{text}` is no turn; write x, y or z, and 90, 180 or 270 behind it for quarters \
                 of a turn"
            )
        })
    }
}
