//! The blocks of the pages as mathematics: Rust expression syntax to LaTeX.

use rustc_hash::FxHashMap;

use syn::{BinOp, Expr, UnOp};

use super::name::{Accent, symbol};
use super::tex::{Binding, Term, Tex, Value, aligned, lines};
use precess_codegen::page::ReadError;

/// `left = body` as an aligned display; the body's `let` lines follow it.
///
/// # Errors
/// When the body does not parse or holds a form that no block may hold.
pub fn equation(left: &str, body: &str) -> Result<String, ReadError> {
    let block = block(body)?;
    let mut setter = Setter::default();
    let mut result = Vec::new();
    let mut lets = Vec::new();
    for statement in &block.stmts {
        match statement {
            syn::Stmt::Local(local) => {
                if let Some((name, value)) = setter.binding(local)? {
                    let left = symbol(&name, Accent::Plain);
                    lets.extend(assignment(&left, &setter.terms(&value)?));
                }
            }
            syn::Stmt::Expr(expr, None) => result = assignment(left, &setter.terms(expr)?),
            other => return Err(form(other)),
        }
    }
    let with = if lets.is_empty() { None } else { Some("&\\text{with}".to_owned()) };
    let all: Vec<_> = result.into_iter().chain(with).chain(lets).collect();
    Ok(aligned(&all))
}

/// One expression on one line, in the scope of the block `body`.
///
/// # Errors
/// When it does not parse or holds a form that no block may hold.
pub fn expression(body: &str, text: &str) -> Result<String, ReadError> {
    let expr: Expr = syn::parse_str(text).map_err(|error| syntax(&error))?;
    Ok(Tex::sum(&Setter::within(body)?.terms(&expr)?).text)
}

/// Expressions one above the other, each after its label, as an aligned display; `body` is the
/// block in whose scope they are.
///
/// # Errors
/// When one does not parse or holds a form that no block may hold.
pub fn side_by_side(body: &str, sides: &[(&str, &str)]) -> Result<String, ReadError> {
    let setter = Setter::within(body)?;
    let mut all = Vec::new();
    for (label, text) in sides {
        let expr: Expr = syn::parse_str(text).map_err(|error| syntax(&error))?;
        let mut set = match expr.to_token_text().as_str() {
            "0" => vec!["\\text{nothing}".to_owned()],
            _ => lines(&setter.terms(&expr)?),
        };
        let first = format!("\\text{{{label}: }}& {}", set.remove(0));
        all.push(first);
        all.extend(set.into_iter().map(|line| format!("& {line}")));
    }
    Ok(aligned(&all))
}

fn assignment(left: &str, terms: &[Term]) -> Vec<String> {
    let mut made = lines(terms);
    if let Some(first) = made.first_mut() {
        *first = format!("{left} ={{}}& {first}");
    }
    for line in made.iter_mut().skip(1) {
        *line = format!("&{line}");
    }
    made
}

/// The statements of a body.
fn block(body: &str) -> Result<syn::Block, ReadError> {
    syn::parse_str(&format!("{{\n{body}\n}}")).map_err(|error| syntax(&error))
}

fn syntax(error: &syn::Error) -> ReadError {
    ReadError::Syntax(error.to_string())
}

fn form(piece: &impl quote::ToTokens) -> ReadError {
    ReadError::Form(piece.to_token_stream().to_string())
}

/// Sets expressions, with the names that stand for a sine or a cosine.
#[derive(Default)]
struct Setter {
    short: FxHashMap<String, Tex>,
}

impl Setter {
    /// With the abbreviations of a block.
    fn within(body: &str) -> Result<Self, ReadError> {
        let mut setter = Self::default();
        for statement in &block(body)?.stmts {
            if let syn::Stmt::Local(local) = statement {
                setter.binding(local)?;
            }
        }
        Ok(setter)
    }

    /// Name and value of a `let`; none where it only abbreviates a sine or a cosine.
    fn binding(&mut self, local: &syn::Local) -> Result<Option<(String, Expr)>, ReadError> {
        let (syn::Pat::Ident(name), Some(init)) = (&local.pat, &local.init) else {
            return Err(form(local));
        };
        let name = name.ident.to_string();
        if let Expr::Call(call) = &*init.expr
            && let Some(tex) = trigonometric(call)
        {
            self.short.insert(name, tex);
            return Ok(None);
        }
        Ok(Some((name, (*init.expr).clone())))
    }

    /// The summands of an expression.
    fn terms(&self, expr: &Expr) -> Result<Vec<Term>, ReadError> {
        match expr {
            Expr::Paren(inside) => self.terms(&inside.expr),
            Expr::Binary(binary) if matches!(binary.op, BinOp::Add(_) | BinOp::Sub(_)) => {
                let mut terms = self.terms(&binary.left)?;
                match binary.op {
                    BinOp::Sub(_) => terms.push(self.term(&binary.right, true)?),
                    _ => terms.extend(self.terms(&binary.right)?),
                }
                Ok(terms)
            }
            _ => Ok(vec![self.term(expr, false)?]),
        }
    }

    fn term(&self, expr: &Expr, negative: bool) -> Result<Term, ReadError> {
        if let Expr::Unary(unary) = expr
            && matches!(unary.op, UnOp::Neg(_))
        {
            return self.term(&unary.expr, !negative);
        }
        let mut factors = Vec::new();
        collect(expr, &mut factors);
        // `-(a)*b` is the opposite of a product.
        let mut negative = negative;
        if let Some(Factor::Times(first)) = factors.first_mut()
            && let Expr::Unary(unary) = first
            && matches!(unary.op, UnOp::Neg(_))
        {
            *first = &unary.expr;
            negative = !negative;
        }
        let bracket = factors.iter().position(|factor| factor.sum().is_some());
        let value = match bracket {
            Some(place) => {
                let (before, rest) = factors.split_at(place);
                let [sum, after @ ..] = rest else { return Err(form(expr)) };
                let sum = sum.sum().map_or_else(|| Err(form(expr)), |sum| self.terms(sum))?;
                Value::Bracket { before: self.factors(before)?, sum, after: self.factors(after)? }
            }
            None => Value::Short(Tex::product(self.factors(&factors)?)),
        };
        Ok(Term { negative, value })
    }

    fn factors(&self, factors: &[Factor<'_>]) -> Result<Vec<Tex>, ReadError> {
        let mut made: Vec<Tex> = Vec::new();
        for factor in factors {
            match factor {
                Factor::Times(expr) => made.push(self.single(expr)?),
                Factor::Over(expr) => {
                    let below = self.single(expr)?;
                    let above = made.pop().unwrap_or_else(|| Tex::atom("1"));
                    let width = above.width.max(below.width);
                    let text = format!("\\frac{{{}}}{{{}}}", above.text, below.text);
                    made.push(Tex::new(text, width, Binding::Atom));
                }
            }
        }
        Ok(made)
    }

    /// Anything that is no product.
    fn single(&self, expr: &Expr) -> Result<Tex, ReadError> {
        match expr {
            Expr::Paren(inside) => self.single(&inside.expr),
            Expr::Lit(literal) => Ok(Tex::atom(quote::quote!(#literal).to_string())),
            Expr::Path(path) => {
                let name = path.path.require_ident().map_err(|_| form(expr))?.to_string();
                let short = self.short.get(&name).cloned();
                Ok(short.unwrap_or_else(|| Tex::atom(symbol(&name, Accent::Plain))))
            }
            Expr::Call(call) => self.call(call),
            Expr::Binary(_) | Expr::Unary(_) => Ok(Tex::sum(&self.terms(expr)?)),
            _ => Err(form(expr)),
        }
    }

    fn call(&self, call: &syn::ExprCall) -> Result<Tex, ReadError> {
        if let Some(tex) = trigonometric(call) {
            return Ok(tex);
        }
        let function = call.func.to_token_text();
        let arguments: Vec<&Expr> = call.args.iter().collect();
        match (function.as_str(), &arguments[..]) {
            ("sq", [a]) => {
                let base = self.single(a)?;
                let width = base.width + 1;
                let text = match base.text.split_once("\\,{}") {
                    // The square of a sine is written after the s.
                    Some((function, angle)) if base.text.starts_with("\\mathrm") => {
                        format!("{function}^{{2}}\\,{{}}{angle}")
                    }
                    _ if base.text.starts_with("\\mathrm") => base.text.replacen('}', "}^{2}", 1),
                    _ => format!("{}^{{2}}", base.within(Binding::Product).text),
                };
                Ok(Tex::new(text, width, Binding::Atom))
            }
            ("cross" | "dot", [a, b]) => {
                let (a, b) = (
                    self.single(a)?.within(Binding::Cross),
                    self.single(b)?.within(Binding::Cross),
                );
                let sign = if function == "cross" { "\\times" } else { "\\cdot" };
                let text = format!("{} {sign} {}", a.text, b.text);
                Ok(Tex::new(text, a.width + b.width + 3, Binding::Cross))
            }
            ("tilde", [Expr::Path(path)]) => {
                let name = path.path.require_ident().map_err(|_| form(call))?.to_string();
                Ok(Tex::atom(format!("[{}]", symbol(&name, Accent::Tilde))))
            }
            ("tilde", [a]) => {
                let inside = self.single(a)?;
                let text = format!("[({})^{{\\sim}}]", inside.text);
                Ok(Tex::new(text, inside.width + 5, Binding::Atom))
            }
            ("transpose", [a]) => {
                let inside = self.single(a)?.within(Binding::Product);
                Ok(Tex::new(format!("{}^{{T}}", inside.text), inside.width + 1, Binding::Atom))
            }
            ("tensor", [a, b, c, Expr::Array(rows)]) => self.tensor([a, b, c], rows),
            _ => Err(form(call)),
        }
    }

    fn tensor(&self, axes: [&Expr; 3], rows: &syn::ExprArray) -> Result<Tex, ReadError> {
        let mut shown = Vec::new();
        let mut width = 4;
        for row in &rows.elems {
            let Expr::Array(row) = row else { return Err(form(row)) };
            let cells: Vec<Tex> = row
                .elems
                .iter()
                .map(|cell| Ok(Tex::sum(&self.terms(cell)?)))
                .collect::<Result<_, ReadError>>()?;
            width = width.max(cells.iter().map(|cell| cell.width + 2).sum());
            shown.push(cells.into_iter().map(|cell| cell.text).collect::<Vec<_>>().join(" & "));
        }
        let axes = axes.map(TokenText::to_token_text);
        let frame = match axes.each_ref().map(String::as_str) {
            ["b_x_hat", "b_y_hat", "b_z_hat"] => "\\mathcal{B}",
            ["g_x_hat", "s_y_hat", "s_z_hat"] => "\\mathcal{G}^o",
            ["s_x_hat", "s_y_hat", "g_z_hat"] => "\\mathcal{G}^i",
            ["s_x_hat", "w_y_hat", "w_z_hat"] => "\\mathcal{W}",
            _ => return Err(ReadError::Form(axes.join(", "))),
        };
        let text =
            format!("{{}}^{{{frame}}}\\begin{{bmatrix}} {} \\end{{bmatrix}}", shown.join(" \\\\ "));
        Ok(Tex::new(text, width, Binding::Atom))
    }
}

/// A factor of a product, above or below the line.
#[derive(Clone, Copy)]
enum Factor<'a> {
    Times(&'a Expr),
    Over(&'a Expr),
}

impl<'a> Factor<'a> {
    /// The sum in brackets that this factor is.
    fn sum(self) -> Option<&'a Expr> {
        let Self::Times(Expr::Paren(inside)) = self else { return None };
        let sum = matches!(&*inside.expr, Expr::Binary(b) if matches!(b.op, BinOp::Add(_) | BinOp::Sub(_)));
        sum.then_some(&*inside.expr)
    }
}

/// The factors of a product, from left to right.
fn collect<'a>(expr: &'a Expr, factors: &mut Vec<Factor<'a>>) {
    match expr {
        Expr::Binary(binary) if matches!(binary.op, BinOp::Mul(_)) => {
            collect(&binary.left, factors);
            collect(&binary.right, factors);
        }
        Expr::Binary(binary) if matches!(binary.op, BinOp::Div(_)) => {
            collect(&binary.left, factors);
            factors.push(Factor::Over(&binary.right));
        }
        _ => factors.push(Factor::Times(expr)),
    }
}

/// `sin(gamma_i)` and its kin.
fn trigonometric(call: &syn::ExprCall) -> Option<Tex> {
    let function = call.func.to_token_text();
    let angle = call.args.first().filter(|_| ["sin", "cos"].contains(&function.as_str()))?;
    Some(Tex::atom(symbol(&format!("{function}_{}", angle.to_token_text()), Accent::Plain)))
}

trait TokenText {
    fn to_token_text(&self) -> String;
}

impl<T: quote::ToTokens> TokenText for T {
    fn to_token_text(&self) -> String {
        self.to_token_stream().to_string()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn expressions_read_like_the_paper() {
        for (text, latex) in [
            (
                "m_go*cross(r_goc_b, r_goc_b_dot)",
                "m_{G^o}\\,(r_{G^o_c/B} \\times \\dot{r}_{G^o_c/B})",
            ),
            (
                "2*transpose(tilde(r_goc_b_prime))*omega",
                "2\\,[\\tilde{r}'_{G^o_c/B}]^{T}\\,\\omega",
            ),
            (
                "-d*sq(gamma_o_dot)*sin(gamma_i)*s_x_hat",
                "-d\\,{}^{o}\\dot{\\gamma}^{2}\\,\\mathrm{s}\\,{}^{i}\\gamma\\,\\hat{s}_{x}",
            ),
            ("1/m_sc*(a_b - c)", "\\frac{1}{m_{sc}}\\,(\\mathrm{a\\_b} - c)"),
            ("sq(sin(gamma_i))", "\\mathrm{s}^{2}\\,{}^{i}\\gamma"),
            ("sq(sin(theta))", "\\mathrm{s}^{2}\\,\\theta"),
            ("c - (f_o - f_i)", "c - (f_{o} - f_{i})"),
            ("-(f_o + f_i)*d", "-(f_{o} + f_{i})\\,d"),
        ] {
            assert_eq!(expression("", text).as_deref(), Ok(latex), "{text}");
        }
    }

    #[test]
    fn the_frame_of_a_tensor_is_that_of_its_axes() {
        let wheel = "tensor(s_x_hat, w_y_hat, w_z_hat, [[t_11, 0, 0], [0, 0, 0], [0, 0, 0]])";
        assert!(expression("", wheel).is_ok_and(|latex| latex.starts_with("{}^{\\mathcal{W}}")));
        let mixed = "tensor(s_x_hat, s_y_hat, w_z_hat, [[0, 0, 0], [0, 0, 0], [0, 0, 0]])";
        assert_eq!(
            expression("", mixed),
            Err(ReadError::Form("s_x_hat, s_y_hat, w_z_hat".to_owned()))
        );
    }

    #[test]
    fn let_lines_follow_and_sines_are_put_in() {
        let body = "let si = sin(gamma_i);\nlet p = spin - gamma_o_dot*si;\nj_12*p";
        let lines = [
            "x ={}& J_{12}\\,p",
            "&\\text{with}",
            "p ={}& \\Omega - {}^{o}\\dot{\\gamma}\\,\\mathrm{s}\\,{}^{i}\\gamma",
        ];
        let expected = format!("\\begin{{aligned}}\n{}\n\\end{{aligned}}", lines.join(" \\\\\n"));
        assert_eq!(equation("x", body), Ok(expected));
    }
}
