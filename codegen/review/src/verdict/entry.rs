//! What is said of one equation of the paper.

use precess_codegen::normal::Term;
use precess_codegen::page::{Block, Class, Note};
use precess_codegen::proof::Comparison;

/// Equations that the derivation states as the page does: Newton's and Euler's laws, sums, momenta
/// of single bodies, the parallel axis theorem, mass ratios and differences of positions.
const STATED: [u16; 28] = [
    6, 8, 9, 20, 21, 22, 23, 29, 32, 35, 40, 45, 48, 55, 60, 63, 71, 75, 76, 78, 92, 93, 94, 95,
    99, 111, 112, 113,
];

/// One number of the paper, or one equality that its text asserts.
#[derive(Clone, Debug)]
pub struct Entry {
    /// The number; `None` for an asserted equality.
    pub number: Option<u16>,
    /// `(14)`, `(52)`, `(before 67)`.
    pub tag: String,
    /// What it states, in a few words of Markdown.
    pub title: String,
    /// The finding in one line of Markdown, where there is one.
    pub in_short: Option<String>,
    /// The derivation against the hand-checked pages.
    pub hand_checked: HandChecked,
    /// The print against the hand-checked pages.
    pub printed: Printed,
    /// The printed blocks, in order.
    pub forms: Vec<Form>,
}

/// The derivation against the hand-checked pages.
#[derive(Clone, Debug)]
pub enum HandChecked {
    /// Nothing to derive: a definition, or words.
    Definition,
    /// The blocks that state it, each proven equal to the derivation.
    Proven(Vec<Block>),
    /// The blocks that state it, and the rows that are no proof.
    Differs(Vec<Block>, Vec<Comparison>),
}

/// The print against the hand-checked pages.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Printed {
    /// Gives a symbol its value, names components, or lists what is assumed.
    Definition,
    /// Equal, left side included.
    Agrees,
    /// Something differs.
    Differs {
        /// Terms, by components; empty when only a left side or a doubtful mark differs.
        components: Vec<Component>,
        /// Classes of the notes that say so.
        classes: Vec<Class>,
        /// Letters of the causes, in order.
        causes: Vec<char>,
    },
    /// All that differs is torn.
    Unreadable {
        /// The terms that are lost with it, by components.
        components: Vec<Component>,
        /// The best reading, in the syntax of the blocks.
        best: String,
        /// What else was tried, in Markdown.
        tried: String,
    },
}

/// The differing terms of one component of one block.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Component {
    /// The block's quantity: `f_o`.
    pub name: String,
    /// `s_x`, `22`, empty for a scalar.
    pub label: String,
    /// The terms.
    pub terms: Vec<Term>,
}

/// One printed block beside the right one.
#[derive(Clone, Debug)]
pub struct Form {
    /// The block, with the notes that concern the entry.
    pub block: Block,
    /// The hand-checked block to set beside it: of the same number, else of the same name.
    pub right: Option<Block>,
    /// Of a block that several numbers share, the entries that are this one's.
    pub entries: Vec<String>,
    /// What differs.
    pub components: Vec<Component>,
}

impl Entry {
    /// All notes that concern this entry, in order.
    pub fn notes(&self) -> impl Iterator<Item = &Note> {
        self.forms.iter().flat_map(|form| &form.block.notes)
    }

    /// What ties derivation and page together: a proof, or the same words on both sides.
    #[must_use]
    pub fn derivation(&self) -> &'static str {
        match self.hand_checked {
            HandChecked::Proven(_) if self.number.is_some_and(|n| STATED.contains(&n)) => {
                "stated alike"
            }
            _ => self.hand_checked.label(),
        }
    }

    /// Whether print and page differ, left side included, as the print is read; what is lost
    /// altogether cannot differ.
    #[must_use]
    pub fn differs(&self) -> bool {
        match &self.printed {
            Printed::Agrees | Printed::Definition => false,
            Printed::Differs { .. } => true,
            Printed::Unreadable { components, .. } => !components.is_empty(),
        }
    }

    /// Whether nothing of the equation is left.
    #[must_use]
    pub fn is_lost(&self) -> bool {
        matches!(self.printed, Printed::Unreadable { .. }) && !self.differs()
    }

    /// Whether it differs in a way that is, or may be, the paper's.
    #[must_use]
    pub fn is_papers(&self) -> bool {
        let of_paper = |class: &Class| matches!(class, Class::Slip | Class::Undecided);
        matches!(&self.printed, Printed::Differs { classes, .. } if classes.iter().any(of_paper))
    }

    /// Whether it is a definition that the paper contradicts elsewhere.
    #[must_use]
    pub fn is_contradicted(&self) -> bool {
        self.printed == Printed::Definition && self.notes().any(|note| note.class == Class::Slip)
    }

    /// How many terms of the print differ.
    #[must_use]
    pub fn differing(&self) -> usize {
        let components = self.forms.iter().flat_map(|form| &form.components);
        components.map(|component| component.terms.len()).sum()
    }
}

impl HandChecked {
    /// `definition`, `proven equal`, `DIFFERS`.
    #[must_use]
    pub fn label(&self) -> &'static str {
        match self {
            Self::Definition => "definition",
            Self::Proven(_) => "proven equal",
            Self::Differs(..) => "DIFFERS",
        }
    }

    /// The hand-checked blocks.
    #[must_use]
    pub fn blocks(&self) -> &[Block] {
        match self {
            Self::Definition => &[],
            Self::Proven(blocks) | Self::Differs(blocks, _) => blocks,
        }
    }
}

impl Printed {
    /// `definition`, `agrees`, `slip + unreadable`.
    #[must_use]
    pub fn label(&self) -> String {
        match self {
            Self::Definition => Class::Definition.to_string(),
            Self::Agrees => Class::Agrees.to_string(),
            Self::Unreadable { .. } => Class::Unreadable.to_string(),
            Self::Differs { classes, .. } => {
                classes.iter().map(Class::to_string).collect::<Vec<_>>().join(" + ")
            }
        }
    }

    /// Letters of the causes, in order.
    #[must_use]
    pub fn causes(&self) -> &[char] {
        match self {
            Self::Differs { causes, .. } => causes,
            _ => &[],
        }
    }
}

/// Differing terms by component; a mirror image that differs alike is left out.
pub(super) fn by_component(name: &str, terms: Vec<(String, Term)>) -> Vec<Component> {
    let mut made: Vec<Component> = Vec::new();
    for (label, term) in terms {
        match made.last_mut() {
            Some(last) if last.label == label => last.terms.push(term),
            _ => made.push(Component { name: name.to_owned(), label, terms: vec![term] }),
        }
    }
    let mirrored = |component: &Component| {
        let [row, column] = component.label.as_bytes() else { return false };
        let image = made.iter().find(|other| other.label.as_bytes() == [*column, *row]);
        row > column && image.is_some_and(|image| image.terms == component.terms)
    };
    let doubled: Vec<_> = made.iter().map(mirrored).collect();
    made.into_iter().zip(doubled).filter(|(_, doubled)| !doubled).map(|(made, _)| made).collect()
}
