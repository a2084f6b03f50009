//! The paper's assembled system from the hand-checked pages, with or without a slip in one name.
//!
//! Nine equations in nine unknowns: (16) for the acceleration of B, (75) for the body rate, and
//! the motor torques (80), (101) and (119). Forces are zero, so (16) reads
//! `0 = r_b_n_ddot - [c~] omega_dot + ..`. The pages state the acceleration of B a second time,
//! solved for it by (15); it is the same equation, and it takes the place of (16) when a slip
//! reaches (15).
//!
//! A slip is followed through the pages in order. A name that carries it keeps its value whatever
//! later forms say, and the first form of another name whose value changes carries it on. So the
//! slip takes every path that the pages offer.

use std::collections::BTreeMap;

use super::{ConsequenceError, Slip};
use precess_codegen::graph::{Expr, Graph};
use precess_codegen::normal::Ring;
use precess_codegen::page::{
    Block, Kind, Note, Page, PageError, ReadError, Reader, Value, blocks, read_on,
};

/// The acceleration of B: an unknown to every equation, and what (15) states.
const ACCELERATION: &str = "r_b_n_ddot";
/// The acceleration of C: given to every equation, and what (16) states.
const TRANSLATION: &str = "r_c_n_ddot";
/// The right side of (75).
const ROTATION: &str = "torque_b";
/// (80), (101) and (119).
const MOTORS: [&str; 3] = ["u_o", "u_i", "u_w"];

/// The nine equations: their left sides, with zero, zero and the motors' torques on the right.
pub(super) type Equations<'g> = [Expr<'g>; 9];

/// The hand-checked pages, read once.
pub(super) struct Pages<'g> {
    graph: &'g Graph,
    statements: Vec<(Block, Value<'g>)>,
    unknown: Value<'g>,
    given: Value<'g>,
    reader: Reader<'g>,
}

impl<'g> Pages<'g> {
    /// Reads the pages; `graph` has the symbols of the chain.
    pub(super) fn read(graph: &'g Graph, pages: &[Page]) -> Result<Self, ConsequenceError> {
        let mut statements = Vec::new();
        for page in pages {
            statements.extend(blocks(&page.name, &page.text, "equation")?);
        }
        // A special case states nothing of its quantity in general.
        statements.retain(|block| block.given.is_empty());
        let (_, mut reader) = read_on(graph, &[])?;
        let mut unknown = None;
        let mut given = None;
        let mut read = Vec::new();
        for block in statements {
            let value = body(&mut reader, &block)?;
            if block.name == ACCELERATION && unknown.is_none() {
                unknown = Some(unknown_acceleration(&mut reader, &block)?);
            }
            if block.name == TRANSLATION {
                given = given.or(Some(value));
            }
            let seen = match block.name.as_str() {
                ACCELERATION => unknown,
                TRANSLATION => given,
                _ => None,
            };
            reader.define(&block.name, seen.unwrap_or(value));
            read.push((block, value));
        }
        let unknown = unknown.ok_or(ConsequenceError::Missing { name: ACCELERATION })?;
        let given = given.ok_or(ConsequenceError::Missing { name: TRANSLATION })?;
        Ok(Self { graph, statements: read, unknown, given, reader })
    }

    /// The value that a printed block gives to its name, every name inside meaning the right one.
    pub(super) fn printed(&mut self, block: &Block) -> Result<Value<'g>, ConsequenceError> {
        let value = body(&mut self.reader, block)?;
        self.reader.resolve(block, value).map_err(|error| at(block, error))?;
        if self.statements.iter().any(|(stated, _)| stated.name == block.name) {
            return Ok(value);
        }
        let Block { page, line, name, .. } = block.clone();
        Err(ConsequenceError::Unstated { page, line, name })
    }

    /// Whether a value of a name is the one that its last form on the pages has.
    pub(super) fn agrees(&self, ring: &mut Ring<'g>, name: &str, value: Value<'g>) -> bool {
        let right = self.statements.iter().rfind(|(block, _)| block.name == name);
        right.is_some_and(|(_, right)| equal(ring, &components(value), &components(*right)))
    }

    /// The right value of a block's name with the changes of some of its notes taken back.
    pub(super) fn with_notes(&self, slip: &Slip<'_>) -> Result<Value<'g>, ConsequenceError> {
        let block = slip.block;
        let right = self.statements.iter().rfind(|(stated, _)| stated.name == block.name);
        let Some((_, right)) = right else {
            let Block { page, line, name, .. } = block.clone();
            return Err(ConsequenceError::Unstated { page, line, name });
        };
        let (inside, _) = self.reader.scope(&block.body).map_err(|error| at(block, error))?;
        let mut value = *right;
        for note in &slip.notes {
            let wrong = |error| PageError { page: block.page.clone(), line: note.line, error };
            let change = change(&inside, block, note).map_err(wrong)?;
            for part in change {
                let kinds = || wrong(ReadError::Kinds(note.text.clone()));
                value = value.plus(part).ok_or_else(kinds)?;
            }
        }
        Ok(value)
    }

    /// The assembled equations, each slip giving a name another value than the right one.
    pub(super) fn assembled(
        &self,
        slips: &[(&str, Value<'g>)],
    ) -> Result<Equations<'g>, ConsequenceError> {
        let (_, mut reader) = read_on(self.graph, &[])?;
        let mut carriers: BTreeMap<&str, Value<'g>> = slips.iter().copied().collect();
        let mut values: BTreeMap<&str, Value<'g>> = carriers.clone();
        for (name, value) in slips {
            reader.define(name, self.seen(name, *value));
        }
        for (block, right) in &self.statements {
            let name = block.name.as_str();
            if carriers.contains_key(name) {
                continue;
            }
            let reached = names(&block.body).any(|name| carriers.contains_key(name));
            let value = if reached { body(&mut reader, block)? } else { *right };
            if !same(value, *right) {
                carriers.insert(name, value);
            }
            values.insert(name, value);
            reader.define(name, self.seen(name, value));
        }
        let explicit = carriers.get(ACCELERATION);
        self.equations(&values, explicit.copied())
    }

    /// What the equations after it take a name for.
    fn seen(&self, name: &str, value: Value<'g>) -> Value<'g> {
        match name {
            ACCELERATION => self.unknown,
            TRANSLATION => self.given,
            _ => value,
        }
    }

    fn equations(
        &self,
        values: &BTreeMap<&str, Value<'g>>,
        explicit: Option<Value<'g>>,
    ) -> Result<Equations<'g>, ConsequenceError> {
        let vector = |name: &'static str| match values.get(name) {
            Some(Value::Vector(components)) => Ok(*components),
            _ => Err(ConsequenceError::Missing { name }),
        };
        let scalar = |name: &'static str| match values.get(name) {
            Some(Value::Scalar(value)) => Ok(*value),
            _ => Err(ConsequenceError::Missing { name }),
        };
        let [x, y, z] = match (self.unknown, explicit) {
            (Value::Vector([a, b, c]), Some(Value::Vector([d, e, f]))) => [a - d, b - e, c - f],
            _ => vector(TRANSLATION)?,
        };
        let [p, q, r] = vector(ROTATION)?;
        let [o, i, w] = MOTORS;
        Ok([x, y, z, p, q, r, scalar(o)?, scalar(i)?, scalar(w)?])
    }
}

/// What a note says is printed, and the opposite of what it says is right.
fn change<'g>(
    inside: &Reader<'g>,
    block: &Block,
    note: &Note,
) -> Result<Vec<Value<'g>>, ReadError> {
    let Some(change) = &note.change else { return Ok(Vec::new()) };
    let side = |code: &str| match code {
        "0" => Ok(None),
        _ => placed(inside, block, note.place.as_deref(), inside.body(code)?).map(Some),
    };
    let (printed, right) = (side(&change.printed)?, side(&change.right)?);
    Ok(printed.into_iter().chain(right.map(Value::negated)).collect())
}

/// A value in its place: an entry of a tensor is that entry and its mirror image.
fn placed<'g>(
    inside: &Reader<'g>,
    block: &Block,
    place: Option<&str>,
    value: Value<'g>,
) -> Result<Value<'g>, ReadError> {
    let (Some(place), Value::Scalar(entry), Kind::Tensor(axes)) = (place, value, &block.kind)
    else {
        return Ok(value);
    };
    let zero = entry.graph().zero();
    let label = |i: usize, j: usize| format!("{}{}", i + 1, j + 1);
    let entries = [0, 1, 2].map(|i| {
        [0, 1, 2].map(|j| {
            if [label(i, j), label(j, i)].iter().any(|l| l == place) { entry } else { zero }
        })
    });
    let mut units = [[zero; 3]; 3];
    for (unit, axis) in units.iter_mut().zip(axes) {
        if let Value::Vector(components) = inside.body(&format!("{axis}_hat"))? {
            *unit = components;
        }
    }
    Ok(Value::along(units, entries))
}

/// The acceleration of B by its symbols, once the axes of B are known.
fn unknown_acceleration<'g>(
    reader: &mut Reader<'g>,
    block: &Block,
) -> Result<Value<'g>, PageError> {
    let terms = ["x", "y", "z"].map(|a| format!("{ACCELERATION}_b{a}*b_{a}_hat"));
    reader.body(&terms.join(" + ")).map_err(|error| at(block, error))
}

fn body<'g>(reader: &mut Reader<'g>, block: &Block) -> Result<Value<'g>, PageError> {
    reader.body(&block.body).map_err(|error| at(block, error))
}

fn at(block: &Block, error: ReadError) -> PageError {
    PageError { page: block.page.clone(), line: block.line, error }
}

/// The words of an expression that may be names.
fn names(body: &str) -> impl Iterator<Item = &str> {
    body.split(|c: char| !c.is_alphanumeric() && c != '_')
}

/// Whether expressions are equal, one by one. What has no normal form is not shown to be.
pub(super) fn equal<'g>(ring: &mut Ring<'g>, a: &[Expr<'g>], b: &[Expr<'g>]) -> bool {
    let mut pairs = a.iter().zip(b);
    let mut none = |a: Expr<'g>, b: Expr<'g>| ring.normal(a - b).is_ok_and(|rest| rest.is_empty());
    a.len() == b.len() && pairs.all(|(a, b)| none(*a, *b))
}

fn components(value: Value<'_>) -> Vec<Expr<'_>> {
    match value {
        Value::Scalar(e) => vec![e],
        Value::Vector(v) => v.to_vec(),
        Value::Tensor(t) => t.concat(),
    }
}

/// Whether two values are one expression. Expressions are interned: one that is read again without
/// a change is the same.
fn same(a: Value<'_>, b: Value<'_>) -> bool {
    components(a) == components(b)
}
