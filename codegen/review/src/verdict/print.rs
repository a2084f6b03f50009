//! The printed blocks as values: against the right ones, against their notes, and mended.

use super::fault::{Fault, VerdictError};
use precess_codegen::graph::{Expr, Graph};
use precess_codegen::normal::{Ring, Term};
use precess_codegen::page::{Block, Class, Kind, Note, PageError, ReadError, Reader, in_the_case};
use precess_codegen::proof::{Comparison, Verdict};

/// Labelled components of a value.
type Components<'g> = Vec<(String, Expr<'g>)>;

/// Evaluates printed blocks with the names of the hand-checked pages.
pub(super) struct Print<'g> {
    graph: &'g Graph,
    ring: Ring<'g>,
    reader: Reader<'g>,
}

impl<'g> Print<'g> {
    /// With the reader of the pages.
    pub(super) fn new(graph: &'g Graph, reader: Reader<'g>) -> Self {
        Self { graph, ring: Ring::new(graph), reader }
    }

    /// The terms in which a block, or another body in its place, differs from what is right.
    pub(super) fn difference(
        &mut self,
        block: &Block,
        body: &str,
    ) -> Result<Vec<(String, Term)>, PageError> {
        let checked = self.value(block, body).map_err(at(block, block.line))?;
        let right = self.right(block).map_err(at(block, block.line))?;
        let row = Comparison::new(&mut self.ring, heading(block, ""), &checked, &right);
        match row.verdict {
            Verdict::Differs(terms) => Ok(terms),
            Verdict::Equal => Ok(Vec::new()),
            // The labels are those of one block, so a side without a normal form is all there is.
            undecided => Err(at(block, block.line)(ReadError::Form(undecided.to_string()))),
        }
    }

    /// That the print is what is right and the differences its notes name, to the last term.
    pub(super) fn against_notes(&mut self, block: &Block) -> Result<Comparison, PageError> {
        let printed = self.value(block, &block.body).map_err(at(block, block.line))?;
        let mut expected = self.right(block).map_err(at(block, block.line))?;
        for note in &block.notes {
            let change = self.change(block, note).map_err(at(block, note.line))?;
            expected = sum(expected, &change);
        }
        let heading = heading(block, "print = page + notes");
        Ok(Comparison::new(&mut self.ring, heading, &printed, &expected).at(block.place()))
    }

    /// That a mended body is what is right, but for what is torn.
    pub(super) fn against_torn(
        &mut self,
        block: &Block,
        body: &str,
    ) -> Result<Comparison, PageError> {
        let mended = self.value(block, body).map_err(at(block, block.line))?;
        let mut expected = self.right(block).map_err(at(block, block.line))?;
        let torn: Vec<_> =
            block.notes.iter().filter(|note| note.class == Class::Unreadable).collect();
        for note in &torn {
            let change = self.change(block, note).map_err(at(block, note.line))?;
            expected = sum(expected, &change);
        }
        let claim = if torn.is_empty() {
            "print, mended = page"
        } else {
            "print, mended = page but torn lines"
        };
        let heading = heading(block, claim);
        Ok(Comparison::new(&mut self.ring, heading, &mended, &expected).at(block.place()))
    }

    /// The components of a body in the block's place.
    fn value(&self, block: &Block, body: &str) -> Result<Components<'g>, ReadError> {
        let components = self.reader.resolve(block, self.reader.body(body)?)?;
        in_the_case(self.graph, &block.given, components)
    }

    /// What the hand-checked pages say in the block's place.
    fn right(&self, block: &Block) -> Result<Components<'g>, ReadError> {
        self.value(block, &block.name)
    }

    /// Printed less right of one note; nothing where it changes no value.
    fn change(&self, block: &Block, note: &Note) -> Result<Components<'g>, ReadError> {
        let Some(change) = &note.change else { return Ok(Vec::new()) };
        let (inside, _) = self.reader.scope(&block.body)?;
        let side = |code: &str| -> Result<Components<'g>, ReadError> {
            let value = if code == "0" { return Ok(Vec::new()) } else { inside.body(code)? };
            let components = match &note.place {
                None => inside.resolve(block, value)?,
                Some(place) => {
                    let entry =
                        inside.resolve(&Block { kind: Kind::Scalar, ..block.clone() }, value)?;
                    let mirrored: String = place.chars().rev().collect();
                    let mut places = vec![place.clone(), mirrored];
                    places.dedup();
                    let entries = places.into_iter().zip(std::iter::repeat(entry[0].1));
                    entries.collect()
                }
            };
            in_the_case(self.graph, &block.given, components)
        };
        let negated = side(&change.right)?.into_iter().map(|(label, e)| (label, -e));
        Ok(side(&change.printed)?.into_iter().chain(negated).collect())
    }
}

/// `components` with what `more` says of each added.
fn sum<'g>(components: Components<'g>, more: &Components<'g>) -> Components<'g> {
    let added = |(label, e): (String, Expr<'g>)| {
        let here = more.iter().filter(|(other, _)| *other == label);
        let e = here.fold(e, |sum, (_, more)| sum + *more);
        (label, e)
    };
    components.into_iter().map(added).collect()
}

fn heading<'b>(block: &'b Block, claim: &'b str) -> [&'b str; 3] {
    [&block.tag, &block.name, claim]
}

/// Gives an error of a block's page its line.
fn at(block: &Block, line: usize) -> impl Fn(ReadError) -> PageError + use<> {
    let page = block.page.clone();
    move |error| PageError { page: page.clone(), line, error }
}

impl VerdictError {
    /// A fault on a block's page.
    pub(super) fn on(block: &Block, line: usize, fault: Fault) -> Self {
        Self { page: block.page.clone(), line, fault }
    }
}
