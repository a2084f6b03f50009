//! Emitted functions read back, strictly: every name is a `let` before it or a field of an
//! argument, no `let` is repeated, and nothing else is in a function but the returned record.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt;

use rustc_hash::FxHashMap;

use quote::ToTokens;

use crate::derivation::script::Section;
use crate::graph::{Expr, Graph, NodeId};
use crate::kernel::Record;
use crate::page::{ReadError, Reader, Value};

/// Why emitted text cannot be read back.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum EmittedError {
    /// It does not parse.
    Syntax(String),
    /// There is no emitted file for a kind.
    NoFile(String),
    /// A function is missing, or there are two.
    NoFunction(String),
    /// A `let` of a name that there is already.
    Repeated(String, String),
    /// A statement has no meaning here.
    Statement(String, ReadError),
}

impl fmt::Display for EmittedError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Syntax(error) => write!(f, "emitted text does not parse: {error}"),
            Self::NoFile(name) => write!(f, "no file was emitted for kind `{name}`"),
            Self::NoFunction(name) => write!(f, "emitted text has not one function `{name}`"),
            Self::Repeated(function, name) => {
                write!(f, "in function `{function}`: `{name}` is bound twice")
            }
            Self::Statement(name, error) => write!(f, "in function `{name}`: {error}"),
        }
    }
}

impl std::error::Error for EmittedError {}

/// One function as read.
pub(super) struct Reading<'g> {
    /// The value of each `let` as written.
    pub(super) values: FxHashMap<String, Expr<'g>>,
    /// The value of each returned number.
    pub(super) returned: BTreeMap<String, Expr<'g>>,
    /// Names that the text has not, each with the one that stands for the same value there.
    pub(super) shared: FxHashMap<String, String>,
    reader: Reader<'g>,
}

impl<'g> Reading<'g> {
    /// Adds values that the text does not name but takes from elsewhere.
    pub(super) fn or(mut self, values: impl IntoIterator<Item = (String, Expr<'g>)>) -> Self {
        for (name, value) in values {
            self.values.entry(name).or_insert(value);
        }
        self
    }

    /// Adds names of the derivation that the text has not, since another name has their value: the
    /// same expression is written once.
    pub(super) fn sharing(
        mut self,
        sections: &[Section<'g>],
        graph: &'g Graph,
        cuts: &BTreeSet<String>,
    ) -> Self {
        let all: Vec<_> = sections.iter().flat_map(|section| &section.statements).collect();
        let mut named: FxHashMap<NodeId, &str> = FxHashMap::default();
        for statement in all.iter().filter(|s| self.values.contains_key(&s.name)) {
            named.entry(statement.value.id()).or_insert(&statement.name);
        }
        for statement in all {
            let other = named.get(&statement.value.id());
            let Some(other) = other.filter(|_| !self.values.contains_key(&statement.name)) else {
                continue;
            };
            let symbol = graph.find(other).filter(|_| cuts.contains(*other));
            let value = symbol.unwrap_or(self.values[*other]);
            self.values.insert(statement.name.clone(), value);
            self.shared.insert(statement.name.clone(), (*other).to_owned());
        }
        self
    }

    /// Adds the values of results that are written where they are returned, by the names that
    /// the record's fields have in the derivation: no `let` names them.
    pub(super) fn returning(mut self, output: &Record) -> Self {
        for (field, source) in output.leaves() {
            if let Some(value) = self.returned.get(&field) {
                self.values.entry(source).or_insert(*value);
            }
        }
        self
    }

    /// What a name stands for at the end of the function.
    pub(super) fn stands_for(&self, name: &str) -> Option<Expr<'g>> {
        match self.reader.value(&syn::parse_str(name).ok()?) {
            Ok(Value::Scalar(value)) => Some(value),
            _ => None,
        }
    }
}

/// The only function called `name`.
pub(super) fn function<'a>(
    file: &'a syn::File,
    name: &str,
) -> Result<&'a syn::ItemFn, EmittedError> {
    let mut found = file.items.iter().filter_map(|item| match item {
        syn::Item::Fn(function) if function.sig.ident == name => Some(function),
        _ => None,
    });
    match (found.next(), found.next()) {
        (Some(function), None) => Ok(function),
        _ => Err(EmittedError::NoFunction(name.to_owned())),
    }
}

/// Reads a function. `given` are the fields of its arguments, `p.m_w`; a name of `cuts` becomes a
/// symbol once its value is noted.
pub(super) fn read<'g>(
    graph: &'g Graph,
    function: &syn::ItemFn,
    given: &BTreeMap<String, Expr<'g>>,
    cuts: &BTreeSet<String>,
) -> Result<Reading<'g>, EmittedError> {
    let name = function.sig.ident.to_string();
    let wrong = |error| EmittedError::Statement(name.clone(), error);
    let mut reader = Reader::strict(graph);
    for (name, value) in given {
        reader.define(name, Value::Scalar(*value));
    }
    let mut values = FxHashMap::default();
    let mut literal = None;
    for statement in &function.block.stmts {
        match statement {
            syn::Stmt::Local(local) if literal.is_none() => {
                let (bound, value) = reader.binding(local).map_err(wrong)?;
                let Value::Scalar(expr) = value else {
                    return Err(wrong(ReadError::NotThat(value.kind())));
                };
                let symbol = graph.find(&bound).filter(|_| cuts.contains(&bound));
                reader.define(&bound, Value::Scalar(symbol.unwrap_or(expr)));
                if values.insert(bound.clone(), expr).is_some() {
                    return Err(EmittedError::Repeated(name, bound));
                }
            }
            syn::Stmt::Expr(syn::Expr::Struct(found), None) if literal.is_none() => {
                literal = Some(found);
            }
            other => return Err(wrong(ReadError::Form(other.to_token_stream().to_string()))),
        }
    }
    let literal = literal.ok_or_else(|| EmittedError::NoFunction(name.clone()))?;
    let mut returned = BTreeMap::new();
    for (field, expr) in fields(literal).map_err(wrong)? {
        match reader.value(&expr).map_err(wrong)? {
            Value::Scalar(value) => returned.insert(field, value),
            other => return Err(wrong(ReadError::NotThat(other.kind()))),
        };
    }
    Ok(Reading { values, returned, shared: FxHashMap::default(), reader })
}

/// The names of the values of the fields of the returned literal, where they are plain names.
pub(super) fn returned_names(function: &syn::ItemFn) -> BTreeMap<String, String> {
    let literal = function.block.stmts.iter().find_map(|statement| match statement {
        syn::Stmt::Expr(syn::Expr::Struct(literal), None) => fields(literal).ok(),
        _ => None,
    });
    let named = literal.into_iter().flatten().map(|(field, expr)| {
        let name = expr.to_token_stream().to_string();
        (field, name)
    });
    named.collect()
}

/// The fields of a literal, nested ones in line.
fn fields(literal: &syn::ExprStruct) -> Result<Vec<(String, syn::Expr)>, ReadError> {
    let mut list = Vec::new();
    let mut pending = vec![literal];
    while let Some(literal) = pending.pop() {
        if literal.dot2_token.is_some() {
            return Err(ReadError::Form("..".to_owned()));
        }
        for field in &literal.fields {
            match (&field.member, &field.expr) {
                (_, syn::Expr::Struct(nested)) => pending.push(nested),
                (syn::Member::Named(member), expr) => list.push((member.to_string(), expr.clone())),
                (syn::Member::Unnamed(_), expr) => {
                    return Err(ReadError::Form(expr.to_token_stream().to_string()));
                }
            }
        }
    }
    Ok(list)
}
