//! Rust expression syntax to values: what the pages are written in, and what the emitter emits.

use rustc_hash::FxHashMap;

use syn::spanned::Spanned;

use super::value::{Value, inner};
use super::{Block, Kind, ReadError};
use crate::graph::{Expr, Graph, Rational, rational};

/// Brackets a person can follow; far below what would exhaust the parser.
const DEPTH: usize = 100;

/// Evaluates expressions in an environment of names.
#[derive(Clone)]
pub struct Reader<'g> {
    graph: &'g Graph,
    names: FxHashMap<String, Value<'g>>,
    /// Whether a symbol of the graph may be named without having been defined.
    symbols: bool,
}

impl<'g> Reader<'g> {
    /// A reader that knows the symbols of `graph` and nothing else.
    #[must_use]
    pub fn new(graph: &'g Graph) -> Self {
        Self { graph, names: FxHashMap::default(), symbols: true }
    }

    /// A reader that knows only what is defined: emitted text names its arguments, `p.m_w`.
    #[must_use]
    pub fn strict(graph: &'g Graph) -> Self {
        Self { symbols: false, ..Self::new(graph) }
    }

    /// Where the symbols live.
    pub(super) fn graph(&self) -> &'g Graph {
        self.graph
    }

    /// Gives `name` a meaning from here on.
    pub fn define(&mut self, name: &str, value: Value<'g>) {
        self.names.insert(name.to_owned(), value);
    }

    /// The value of `let` lines and a final expression; the `let` names end with it.
    ///
    /// # Errors
    /// When it does not parse or does not evaluate.
    pub fn body(&self, body: &str) -> Result<Value<'g>, ReadError> {
        Ok(self.scope(body)?.1)
    }

    /// The value of a body, with a reader that knows its `let` names too.
    ///
    /// # Errors
    /// When it does not parse or does not evaluate.
    pub fn scope(&self, body: &str) -> Result<(Self, Value<'g>), ReadError> {
        if depth(body) > DEPTH {
            return Err(ReadError::Depth(DEPTH));
        }
        let block: syn::Block = syn::parse_str(&format!("{{\n{body}\n}}"))
            .map_err(|error| ReadError::Syntax(error.to_string()))?;
        let mut inside = self.clone();
        let mut last = Err(ReadError::Empty);
        for statement in &block.stmts {
            match statement {
                syn::Stmt::Local(local) => {
                    let (name, value) = inside.binding(local)?;
                    if inside.named(&name).is_ok() {
                        return Err(ReadError::Taken(name));
                    }
                    inside.define(&name, value);
                }
                syn::Stmt::Expr(expr, None) if last.is_err() => last = Ok(inside.value(expr)?),
                other => return Err(ReadError::Form(text(other))),
            }
        }
        Ok((inside, last?))
    }

    /// Name and value of `let name = expr;`.
    ///
    /// # Errors
    /// When it is not of that form or does not evaluate.
    pub fn binding(&self, local: &syn::Local) -> Result<(String, Value<'g>), ReadError> {
        match (&local.pat, &local.init) {
            (syn::Pat::Ident(name), Some(init))
                if local.attrs.is_empty()
                    && name.mutability.is_none()
                    && init.diverge.is_none() =>
            {
                Ok((name.ident.to_string(), self.value(&init.expr)?))
            }
            _ => Err(ReadError::Form(text(local))),
        }
    }

    /// The components of `value` along the axes of its block.
    ///
    /// # Errors
    /// When the value is not of the block's kind or an axis is unknown.
    pub fn resolve(
        &self,
        block: &Block,
        value: Value<'g>,
    ) -> Result<Vec<(String, Expr<'g>)>, ReadError> {
        match (&block.kind, value) {
            (Kind::Scalar, Value::Scalar(e)) => Ok(vec![(String::new(), e)]),
            (Kind::Vector(axes), Value::Vector(v)) => {
                let component = |axis: &String| Ok((axis.clone(), inner(v, self.axis(axis)?)));
                axes.iter().map(component).collect()
            }
            (Kind::Tensor(axes), Value::Tensor(t)) => {
                let mut entries = Vec::new();
                for (i, row) in axes.iter().enumerate() {
                    for (j, column) in axes.iter().enumerate() {
                        let column = self.axis(column)?;
                        let entry = inner(self.axis(row)?, t.map(|row| inner(row, column)));
                        entries.push((format!("{}{}", i + 1, j + 1), entry));
                    }
                }
                Ok(entries)
            }
            (_, value) => Err(ReadError::NotThat(value.kind())),
        }
    }

    fn axis(&self, name: &str) -> Result<[Expr<'g>; 3], ReadError> {
        match self.names.get(&format!("{name}_hat")) {
            Some(Value::Vector(axis)) => Ok(*axis),
            _ => Err(ReadError::Unknown(format!("{name}_hat"))),
        }
    }

    /// The value of one expression.
    ///
    /// # Errors
    /// When a name is unknown, or a form or a combination of kinds has no meaning.
    pub fn value(&self, expr: &syn::Expr) -> Result<Value<'g>, ReadError> {
        match expr {
            syn::Expr::Paren(inside) => self.value(&inside.expr),
            syn::Expr::Lit(literal) => self.literal(&literal.lit),
            syn::Expr::Path(path) => self.named(&text(&path.path)),
            syn::Expr::Field(field) => {
                self.named(&format!("{}.{}", text(&field.base), text(&field.member)))
            }
            syn::Expr::Unary(unary) if matches!(unary.op, syn::UnOp::Neg(_)) => {
                Ok(self.value(&unary.expr)?.negated())
            }
            syn::Expr::Binary(binary) => self.binary(binary),
            syn::Expr::Call(call) => self.call(call),
            syn::Expr::MethodCall(call) => self.method(call),
            other => Err(ReadError::Form(text(other))),
        }
    }

    fn literal(&self, literal: &syn::Lit) -> Result<Value<'g>, ReadError> {
        let form = || ReadError::Form(text(literal));
        let value = match literal {
            syn::Lit::Int(int) => Rational::from(int.base10_parse::<i64>().map_err(|_| form())?),
            syn::Lit::Float(float) => decimal(float.base10_digits()).ok_or_else(form)?,
            _ => return Err(form()),
        };
        let value = rational::bounded(value).ok_or_else(form)?;
        Ok(Value::Scalar(self.graph.constant(value)))
    }

    fn named(&self, name: &str) -> Result<Value<'g>, ReadError> {
        if let Some(value) = self.names.get(name) {
            return Ok(*value);
        }
        let symbol = self.graph.find(name).filter(|_| self.symbols);
        symbol.map(Value::Scalar).ok_or_else(|| ReadError::Unknown(name.to_owned()))
    }

    fn binary(&self, binary: &syn::ExprBinary) -> Result<Value<'g>, ReadError> {
        let (left, right) = (self.value(&binary.left)?, self.value(&binary.right)?);
        let made = match binary.op {
            syn::BinOp::Add(_) => left.plus(right),
            syn::BinOp::Sub(_) => left.plus(right.negated()),
            syn::BinOp::Mul(_) => left.times(right),
            syn::BinOp::Div(_) => match right {
                Value::Scalar(divisor) => left.times(Value::Scalar(divisor.recip())),
                _ => None,
            },
            _ => return Err(ReadError::Form(text(binary))),
        };
        made.ok_or_else(|| ReadError::Kinds(text(binary)))
    }

    fn call(&self, call: &syn::ExprCall) -> Result<Value<'g>, ReadError> {
        let name = text(&call.func);
        if let ("sin" | "cos", Some(angle), 1) = (name.as_str(), call.args.first(), call.args.len())
        {
            return self.named(&format!("{name}_{}", text(angle)));
        }
        if name == "tensor" {
            return self.tensor(call);
        }
        let arguments: Vec<_> =
            call.args.iter().map(|a| self.value(a)).collect::<Result<_, _>>()?;
        Value::call(&name, &arguments).ok_or_else(|| ReadError::Kinds(text(call)))
    }

    /// `tensor(a, b, c, [[..], [..], [..]])`.
    fn tensor(&self, call: &syn::ExprCall) -> Result<Value<'g>, ReadError> {
        let form = || ReadError::Form(text(call));
        let arguments: Vec<_> = call.args.iter().collect();
        let [a, b, c, syn::Expr::Array(rows)] = arguments[..] else { return Err(form()) };
        let mut axes = Vec::new();
        for axis in [a, b, c] {
            let Value::Vector(axis) = self.value(axis)? else { return Err(form()) };
            axes.push(axis);
        }
        let mut entries = Vec::new();
        for row in &rows.elems {
            let syn::Expr::Array(row) = row else { return Err(form()) };
            let mut line = Vec::new();
            for entry in &row.elems {
                let Value::Scalar(entry) = self.value(entry)? else { return Err(form()) };
                line.push(entry);
            }
            entries.push(<[_; 3]>::try_from(line).map_err(|_| form())?);
        }
        let axes = axes.try_into().map_err(|_| form())?;
        Ok(Value::along(axes, entries.try_into().map_err(|_| form())?))
    }

    fn method(&self, call: &syn::ExprMethodCall) -> Result<Value<'g>, ReadError> {
        let form = || ReadError::Form(text(call));
        let Value::Scalar(object) = self.value(&call.receiver)? else { return Err(form()) };
        let mut arguments = Vec::new();
        for argument in &call.args {
            let Value::Scalar(argument) = self.value(argument)? else { return Err(form()) };
            arguments.push(argument);
        }
        let value = match (call.method.to_string().as_str(), arguments.as_slice()) {
            _ if self.symbols => return Err(form()),
            ("recip", []) => object.recip(),
            ("like", [constant]) => *constant,
            _ => return Err(form()),
        };
        Ok(Value::Scalar(value))
    }
}

/// How deep brackets are nested.
fn depth(text: &str) -> usize {
    let (mut now, mut deepest) = (0_usize, 0);
    for c in text.chars() {
        match c {
            '(' | '[' | '{' => now += 1,
            ')' | ']' | '}' => now = now.saturating_sub(1),
            _ => {}
        }
        deepest = deepest.max(now);
    }
    deepest
}

/// The exact value of a decimal literal such as `0.5`.
fn decimal(digits: &str) -> Option<Rational> {
    let (whole, part) = digits.split_once('.').unwrap_or((digits, ""));
    let scale = 10_i64.checked_pow(u32::try_from(part.len()).ok()?)?;
    let numerator = format!("{whole}{part}").parse::<i64>().ok()?;
    Some(Rational::new(numerator, scale))
}

/// The source of a piece of syntax, for messages.
fn text(piece: &(impl Spanned + quote::ToTokens)) -> String {
    piece.to_token_stream().to_string()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::graph::Stage;
    use crate::normal::Ring;
    use crate::page::{Page, read};

    fn page(text: &str) -> Vec<Page> {
        vec![Page { name: "p.md".into(), text: format!("```equation\n{text}\n```\n") }]
    }

    fn components(graph: &Graph, text: &str) -> Vec<(String, String)> {
        let equations = read(graph, &page(text)).unwrap();
        let mut ring = Ring::new(graph);
        let mut shown = Vec::new();
        for (label, e) in equations.into_iter().flat_map(|equation| equation.components) {
            let polynomial = ring.normal(e).unwrap();
            let terms: Vec<_> = polynomial.terms().map(|(m, k)| ring.show(m, *k)).collect();
            shown.push((label, terms.join(" ")));
        }
        shown
    }

    #[test]
    fn a_vector_equation_is_read_by_components() {
        let g = Graph::new();
        let _ = g.symbol("d", Stage::Parameter);
        let text =
            "(1) r: vector along s_x s_y g_z\nlet a = 2*d;\ncross(a*s_x_hat, s_y_hat) - s_x_hat/d";
        let expected = [("s_x", "-1/d"), ("s_y", ""), ("g_z", "2*d")];
        assert_eq!(components(&g, text), expected.map(|(a, b)| (a.to_owned(), b.to_owned())));
    }

    #[test]
    fn a_tensor_times_a_vector_is_a_vector() {
        let g = Graph::new();
        let text =
            "(1) r: vector along s_x s_y g_z\ntilde(s_x_hat)*transpose(tilde(s_x_hat))*s_y_hat";
        assert_eq!(components(&g, text)[1].1, "1");
    }

    #[test]
    fn unknown_names_and_wrong_kinds_are_refused() {
        let g = Graph::new();
        let error = |text: &str| read(&g, &page(text)).unwrap_err().to_string();
        assert_eq!(
            error("(1) r: scalar\nq + 1"),
            "p.md:1: `q` is neither a symbol nor defined above; define it first"
        );
        assert_eq!(
            error("(1) r: scalar\ns_x_hat + 1"),
            "p.md:1: `s_x_hat + 1` is not defined for these kinds"
        );
        assert_eq!(
            error("(1) r: scalar\ns_x_hat"),
            "p.md:1: the expression is a vector, the heading says otherwise"
        );
    }

    #[test]
    fn decimals_are_exact() {
        assert_eq!(decimal("0.5"), Some(Rational::new(1, 2)));
        assert_eq!(decimal("3"), Some(Rational::from(3)));
    }
}
