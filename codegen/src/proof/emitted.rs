//! The emitted text, read back and held against the derivation: what ships is what is proved.
//!
//! Every `let` is read twice. *Expanded*, each name stands for all it was made of: where it carries
//! a claim, it is compared with a reference that was derived another way. *Cut*, the entries of the
//! assembled system are symbols: each step of the elimination is compared with its identity, which
//! would have far too many terms expanded.

use std::collections::{HashMap, HashSet};
use std::fmt;

use super::Row;
use crate::derivation::chain::Chain;
use crate::graph::Expr;
use crate::kernel::{Field, Kernel, Record, Source, kernels, parameters};
use crate::normal::Ring;
use crate::page::{ReadError, Reader, Value};

/// Why emitted text cannot be read back.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum EmittedError {
    /// It does not parse.
    Syntax(String),
    /// A function is missing.
    NoFunction(String),
    /// A statement has no meaning here.
    Statement(String, ReadError),
}

impl fmt::Display for EmittedError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Syntax(error) => write!(f, "emitted text does not parse: {error}"),
            Self::NoFunction(name) => write!(f, "emitted text has no function `{name}`"),
            Self::Statement(name, error) => write!(f, "in function `{name}`: {error}"),
        }
    }
}

impl std::error::Error for EmittedError {}

/// One function as read back.
struct ReadBack<'g> {
    /// The fields of the returned literal, nested ones in line.
    result: HashMap<String, syn::Expr>,
    expanded: Names<'g>,
    cut: Names<'g>,
}

/// One reading of a function.
struct Names<'g> {
    reader: Reader<'g>,
    /// The value of each `let` as written.
    values: HashMap<String, Expr<'g>>,
}

/// The fields of `Prepared` in either reading.
#[derive(Default)]
struct Constants<'g> {
    expanded: HashMap<String, Value<'g>>,
    cut: HashMap<String, Value<'g>>,
}

/// Proves emitted files of one kind. Keeps what it has expanded, so that a second text which
/// differs in one place costs next to nothing.
pub struct Prover<'a, 'g> {
    chain: &'a Chain<'g>,
    kernels: Vec<Kernel<'g>>,
    /// Two rings for each function, which keeps the number of variables in each small.
    rings: Vec<[Ring<'g>; 2]>,
}

impl<'a, 'g> Prover<'a, 'g> {
    /// A prover for the kind of `chain`.
    #[must_use]
    pub fn new(chain: &'a Chain<'g>) -> Self {
        let kernels = kernels(chain);
        let rings = kernels.iter().map(|_| [Ring::new(chain.graph), Ring::new(chain.graph)]);
        Self { chain, rings: rings.collect(), kernels }
    }

    /// One row per claim, per step of the elimination and per returned record.
    ///
    /// # Errors
    /// When the text does not parse or holds something that is no kernel.
    pub fn rows(&mut self, text: &str) -> Result<Vec<Row>, EmittedError> {
        let file =
            syn::parse_file(text).map_err(|error| EmittedError::Syntax(error.to_string()))?;
        let mut rows = self.function(&file, "prepare")?;
        let names: Vec<_> = self.kernels.iter().map(|kernel| kernel.name.clone()).collect();
        for name in names {
            rows.extend(self.function(&file, &name)?);
        }
        Ok(rows)
    }

    /// The rows of one function of a file.
    ///
    /// # Errors
    /// When the file has no such function or it is no kernel.
    pub fn function(&mut self, file: &syn::File, name: &str) -> Result<Vec<Row>, EmittedError> {
        let (prepare, constants) = self.prepare(file)?;
        let missing = || EmittedError::NoFunction(name.to_owned());
        if name == "prepare" {
            return Ok(vec![prepared_row(self.chain, &prepare, &constants)]);
        }
        let index = self.kernels.iter().position(|k| k.name == name).ok_or_else(missing)?;
        let kernel = &self.kernels[index];
        let [expanded, cut] = &mut self.rings[index];
        let mut back = read_back(self.chain, file, name, &cut_names(kernel), &constants)?;
        for (name, value) in &prepare.expanded.values {
            back.expanded.values.entry(name.clone()).or_insert(*value);
        }
        let mut rows = claims(expanded, kernel, &back);
        rows.extend(identities(cut, kernel, &back));
        rows.push(result(cut, kernel, &back));
        Ok(rows)
    }

    fn prepare(&self, file: &syn::File) -> Result<(ReadBack<'g>, Constants<'g>), EmittedError> {
        let cuts: HashSet<_> = self.kernels.iter().flat_map(cut_names).collect();
        let prepare = read_back(self.chain, file, "prepare", &cuts, &Constants::default())?;
        let mut constants = Constants::default();
        for (name, expr) in &prepare.result {
            let value = |names: &Names<'g>| {
                let wrong = |error| EmittedError::Statement("prepare".to_owned(), error);
                names.reader.value(expr).map_err(wrong)
            };
            constants.expanded.insert(name.clone(), value(&prepare.expanded)?);
            constants.cut.insert(name.clone(), value(&prepare.cut)?);
        }
        Ok((prepare, constants))
    }
}

fn cut_names(kernel: &Kernel<'_>) -> HashSet<String> {
    let statements = kernel.sections.iter().flat_map(|section| &section.statements);
    statements.filter(|s| s.cut.is_some()).map(|s| s.name.clone()).collect()
}

/// Reads a function's statements in order, with the constants besides the symbols.
fn read_back<'g>(
    chain: &Chain<'g>,
    file: &syn::File,
    name: &str,
    cuts: &HashSet<String>,
    constants: &Constants<'g>,
) -> Result<ReadBack<'g>, EmittedError> {
    let function = file.items.iter().find_map(|item| match item {
        syn::Item::Fn(function) if function.sig.ident == name => Some(function),
        _ => None,
    });
    let missing = || EmittedError::NoFunction(name.to_owned());
    let wrong = |error| EmittedError::Statement(name.to_owned(), error);
    let function = function.ok_or_else(missing)?;
    let mut expanded = Names::new(chain, &constants.expanded);
    let mut cut = Names::new(chain, &constants.cut);
    let mut result = None;
    for statement in &function.block.stmts {
        match statement {
            syn::Stmt::Local(local) => {
                let (name, value) = expanded.reader.binding(local).map_err(wrong)?;
                expanded.take(&name, value, value);
                let (name, value) = cut.reader.binding(local).map_err(wrong)?;
                let symbol = cuts.get(&name).and_then(|name| chain.graph.find(name));
                cut.take(&name, value, symbol.map_or(value, Value::Scalar));
            }
            syn::Stmt::Expr(syn::Expr::Struct(literal), None) => result = Some(literal),
            other => {
                let text = quote::ToTokens::to_token_stream(other).to_string();
                return Err(wrong(ReadError::Form(text)));
            }
        }
    }
    let result = fields(result.ok_or_else(missing)?);
    Ok(ReadBack { result, expanded, cut })
}

impl<'g> Names<'g> {
    fn new(chain: &Chain<'g>, given: &HashMap<String, Value<'g>>) -> Self {
        let mut reader = Reader::new(chain.graph);
        for (name, value) in given {
            reader.define(name, *value);
        }
        Self { reader, values: HashMap::new() }
    }

    /// Remembers the value of a name and what it stands for from here on.
    fn take(&mut self, name: &str, value: Value<'g>, stands_for: Value<'g>) {
        if let Value::Scalar(expr) = value {
            self.values.insert(name.to_owned(), expr);
        }
        self.reader.define(name, stands_for);
    }

    /// The value of an expression where it is a number.
    fn scalar(&self, expr: &syn::Expr) -> Option<Expr<'g>> {
        match self.reader.value(expr) {
            Ok(Value::Scalar(value)) => Some(value),
            _ => None,
        }
    }

    /// The value a name has at the end.
    fn named(&self, name: &str) -> Option<Expr<'g>> {
        self.scalar(&syn::parse_str(name).ok()?)
    }
}

/// The fields of a literal, nested ones in line.
fn fields(literal: &syn::ExprStruct) -> HashMap<String, syn::Expr> {
    let mut list = HashMap::new();
    let mut pending = vec![literal];
    while let Some(literal) = pending.pop() {
        for field in &literal.fields {
            match (&field.member, &field.expr) {
                (_, syn::Expr::Struct(nested)) => pending.push(nested),
                (syn::Member::Named(member), expr) => {
                    list.insert(member.to_string(), expr.clone());
                }
                (syn::Member::Unnamed(_), _) => {}
            }
        }
    }
    list
}

fn claims<'g>(ring: &mut Ring<'g>, kernel: &Kernel<'g>, back: &ReadBack<'g>) -> Vec<Row> {
    let mut rows = Vec::new();
    for claim in &kernel.claims {
        let mut emitted = Vec::new();
        let mut reference = Vec::new();
        for (name, expected) in &claim.components {
            let value = back.expanded.values.get(name);
            emitted.extend(value.map(|value| (name.clone(), *value)));
            // What is identically zero need not be emitted.
            let zero = ring.normal(*expected).is_ok_and(|normal| normal.is_empty());
            if value.is_some() || !zero {
                reference.push((name.clone(), *expected));
            }
        }
        let claimed = format!("fn {} = derivation", kernel.name);
        let heading = [claim.tag.as_str(), &claim.name, &claimed];
        rows.push(Row::compare(ring, heading, &emitted, &reference));
    }
    rows
}

/// The steps of the elimination: `M = L D L^T`, entry by entry.
fn identities<'g>(ring: &mut Ring<'g>, kernel: &Kernel<'g>, back: &ReadBack<'g>) -> Option<Row> {
    let mut checked = Vec::new();
    let mut reference = Vec::new();
    for identity in &kernel.identities {
        if let Some(value) = back.cut.values.get(&identity.name) {
            let scaled = *value * identity.factor;
            let sum = identity.addends.iter().fold(scaled, |sum, addend| sum + *addend);
            checked.push((identity.name.clone(), sum));
        }
        reference.push((identity.name.clone(), identity.before));
    }
    let heading = ["(L D Lᵀ)", "every step", &format!("fn {} = identity", kernel.name)];
    let row = || Row::compare(ring, heading, &checked, &reference);
    (!kernel.identities.is_empty()).then(row)
}

/// The returned record holds the values its fields are named after.
fn result<'g>(ring: &mut Ring<'g>, kernel: &Kernel<'g>, back: &ReadBack<'g>) -> Row {
    let mut checked = Vec::new();
    let mut reference = Vec::new();
    for (field, source) in leaves(&kernel.output) {
        let returned = back.result.get(&field).and_then(|expr| back.cut.scalar(expr));
        checked.extend(returned.map(|value| (field.clone(), value)));
        reference.extend(back.cut.named(&source).map(|value| (field.clone(), value)));
    }
    let heading =
        ["(record)", &kernel.output.name, &format!("fn {} returns its values", kernel.name)];
    Row::compare(ring, heading, &checked, &reference)
}

/// Field and value name of every number of a record.
fn leaves(record: &Record) -> Vec<(String, String)> {
    let leaf = |field: &Field| match &field.source {
        Source::Own => vec![(field.name.clone(), field.name.clone())],
        Source::Named(name) => vec![(field.name.clone(), name.clone())],
        Source::Nested(record) => leaves(record),
    };
    record.fields.iter().flat_map(leaf).collect()
}

/// Raw parameters pass through `prepare` unchanged, computed fields under their own names.
fn prepared_row<'g>(chain: &Chain<'g>, prepare: &ReadBack<'g>, constants: &Constants<'g>) -> Row {
    let raw = parameters(chain.kind);
    let mut names: Vec<_> = constants.cut.keys().collect();
    names.sort_unstable();
    let mut checked = Vec::new();
    let mut reference = Vec::new();
    for name in names {
        let given = raw.fields.iter().any(|field| field.name == *name);
        let expected = if given { chain.graph.find(name) } else { prepare.cut.named(name) };
        if let (Value::Scalar(value), Some(expected)) = (constants.cut[name], expected) {
            checked.push((name.clone(), value));
            reference.push((name.clone(), expected));
        }
    }
    let heading = ["(record)", "Prepared", "fn prepare returns its values"];
    Row::compare(&mut Ring::new(chain.graph), heading, &checked, &reference)
}
