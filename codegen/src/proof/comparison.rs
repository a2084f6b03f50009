//! One row of the proof: what was held against what, and how it went.

use std::fmt;
use std::rc::Rc;

use crate::graph::Expr;
use crate::kinds::Kind;
use crate::normal::{Difference, NormalError, Polynomial, Ring, Term};

/// The normal forms of two expressions.
fn both<'g>(
    ring: &mut Ring<'g>,
    a: Expr<'g>,
    b: Expr<'g>,
) -> Result<[Rc<Polynomial>; 2], NormalError> {
    Ok([ring.normal(a)?, ring.normal(b)?])
}

/// How a comparison went.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Verdict {
    /// The normal forms of all components are equal.
    Equal,
    /// Components with their differing terms.
    Differs(Vec<(String, Term)>),
    /// The other side does not have this quantity, or not in these components.
    Absent,
    /// A side has no normal form.
    NoNormalForm(NormalError),
}

/// One equation, held against its reference.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Comparison {
    /// The paper's number, or what stands for it.
    pub tag: String,
    /// The quantity in code.
    pub name: String,
    /// What was held against what.
    pub claim: String,
    /// Terms in all components of the reference.
    pub terms: usize,
    /// How it went.
    pub verdict: Verdict,
    /// Page and line of what was checked, where it is on a page.
    pub place: Option<String>,
    /// The kind whose derivation and text it is about; none where it is about the paper only.
    pub kind: Option<&'static str>,
}

impl Comparison {
    /// The same with the place of the checked side.
    #[must_use]
    pub fn at(mut self, place: String) -> Self {
        self.place = Some(place);
        self
    }

    /// The same as a row about a kind.
    #[must_use]
    pub fn about(mut self, kind: &Kind) -> Self {
        self.kind = Some(kind.name);
        self
    }

    /// Holds labelled components against the reference's, label by label.
    #[must_use]
    pub fn new<'g>(
        ring: &mut Ring<'g>,
        [tag, name, claim]: [&str; 3],
        checked: &[(String, Expr<'g>)],
        reference: &[(String, Expr<'g>)],
    ) -> Self {
        let mut row = Self {
            tag: tag.to_owned(),
            name: name.to_owned(),
            claim: claim.to_owned(),
            terms: 0,
            verdict: Verdict::Equal,
            place: None,
            kind: None,
        };
        let labels = |side: &[(String, Expr<'g>)]| -> Vec<String> {
            side.iter().map(|(label, _)| label.clone()).collect()
        };
        if labels(checked) != labels(reference) {
            row.verdict = Verdict::Absent;
            return row;
        }
        let mut differing = Vec::new();
        for ((label, checked), (_, reference)) in checked.iter().zip(reference) {
            let mut normal = both(ring, *checked, *reference);
            // What does not fit beside the other components has variables of its own.
            let mut own = Ring::new(ring.graph);
            let ring = if matches!(normal, Err(NormalError::Variables(_))) {
                normal = both(&mut own, *checked, *reference);
                &mut own
            } else {
                &mut *ring
            };
            match normal {
                Ok([checked, reference]) => {
                    row.terms += reference.len();
                    if checked == reference {
                        continue;
                    }
                    let difference = Difference::between(ring, &checked, &reference);
                    differing.extend(difference.terms.into_iter().map(|t| (label.clone(), t)));
                }
                Err(error) => {
                    row.verdict = Verdict::NoNormalForm(error);
                    return row;
                }
            }
        }
        if !differing.is_empty() {
            row.verdict = Verdict::Differs(differing);
        }
        row
    }

    /// A row for something the other side lacks.
    #[must_use]
    pub fn absent([tag, name, claim]: [&str; 3]) -> Self {
        let [tag, name, claim] = [tag, name, claim].map(str::to_owned);
        Self { tag, name, claim, terms: 0, verdict: Verdict::Absent, place: None, kind: None }
    }

    /// Whether this row is a proof.
    #[must_use]
    pub fn holds(&self) -> bool {
        self.verdict == Verdict::Equal
    }
}

impl Comparison {
    /// The heading of a table of rows.
    #[must_use]
    pub fn heading() -> String {
        let [tag, name, claim, terms] = ["equation", "quantity", "claim", "terms"];
        format!("{tag:<12} {name:<20} {claim:<36} {terms:>6}  verdict")
    }
}

impl fmt::Display for Comparison {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { tag, name, claim, terms, verdict, place, .. } = self;
        write!(f, "{tag:<12} {name:<20} {claim:<36} {terms:>6}  {verdict}")?;
        match place {
            Some(place) if !self.holds() => write!(f, "\n    stated at {place}"),
            _ => Ok(()),
        }
    }
}

impl fmt::Display for Verdict {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Equal => write!(f, "proven equal"),
            Self::Absent => write!(f, "absent: the other side has no such quantity"),
            Self::NoNormalForm(error) => write!(f, "not decided: {error}"),
            Self::Differs(terms) => {
                let plural = if terms.len() == 1 { "" } else { "s" };
                write!(f, "DIFFERS in {} term{plural}", terms.len())?;
                for (label, term) in terms {
                    let along = if label.is_empty() { "" } else { " along " };
                    write!(f, "\n    {term}{along}{label}")?;
                }
                Ok(())
            }
        }
    }
}
