//! Pieces of LaTeX: how wide they are and how tightly they bind, and long sums in lines.

/// How tightly a piece binds.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Binding {
    Sum,
    /// A cross or dot product, which needs brackets beside any other factor.
    Cross,
    Product,
    Atom,
}

/// A piece of LaTeX.
#[derive(Clone, Debug)]
pub(super) struct Tex {
    pub(super) text: String,
    /// In signs as they are set, roughly.
    pub(super) width: usize,
    pub(super) binding: Binding,
}

/// One summand.
#[derive(Clone, Debug)]
pub(super) struct Term {
    pub(super) negative: bool,
    pub(super) value: Value,
}

/// What a summand is: short enough for one line, or a bracketed sum between factors.
#[derive(Clone, Debug)]
pub(super) enum Value {
    Short(Tex),
    Bracket { before: Vec<Tex>, sum: Vec<Term>, after: Vec<Tex> },
}

/// As wide as a line gets before it is broken, in signs.
const LINE: usize = 64;

impl Tex {
    pub(super) fn new(text: impl Into<String>, width: usize, binding: Binding) -> Self {
        Self { text: text.into(), width, binding }
    }

    /// A symbol; its width is that of what remains without markup.
    pub(super) fn atom(text: impl Into<String>) -> Self {
        let text = text.into();
        Self { width: width(&text), text, binding: Binding::Atom }
    }

    /// In brackets unless it binds more tightly than `than`.
    pub(super) fn within(self, than: Binding) -> Self {
        if self.binding > than {
            return self;
        }
        Self::new(format!("({})", self.text), self.width + 2, Binding::Atom)
    }

    /// Factors side by side.
    pub(super) fn product(factors: Vec<Self>) -> Self {
        let mut factors = factors;
        if factors.len() == 1
            && let Some(single) = factors.pop()
        {
            return single;
        }
        let parts: Vec<_> =
            factors.into_iter().map(|factor| factor.within(Binding::Cross)).collect();
        let text = parts.iter().map(|part| part.text.as_str()).collect::<Vec<_>>().join("\\,");
        Self::new(text, parts.iter().map(|part| part.width).sum(), Binding::Product)
    }

    /// Summands on one line.
    pub(super) fn sum(terms: &[Term]) -> Self {
        let mut text = String::new();
        let mut width = 0;
        for term in terms {
            let value = term.value.inline();
            let sign = match (term.negative, text.is_empty()) {
                (true, true) => "-",
                (true, false) => " - ",
                (false, true) => "",
                (false, false) => " + ",
            };
            // A sum cannot be a summand without brackets after a minus.
            let value = if term.negative { value.within(Binding::Sum) } else { value };
            text = text + sign + &value.text;
            width += sign.len() + value.width;
        }
        let single = terms.len() == 1 && !terms[0].negative;
        let binding = if single { terms[0].value.inline().binding } else { Binding::Sum };
        Self::new(text, width, binding)
    }
}

impl Value {
    pub(super) fn inline(&self) -> Tex {
        match self {
            Self::Short(tex) => tex.clone(),
            Self::Bracket { before, sum, after } => {
                let middle = [Tex::sum(sum)];
                Tex::product(before.iter().chain(&middle).chain(after).cloned().collect())
            }
        }
    }
}

/// The summands in lines, each with the sign it begins with.
pub(super) fn lines(terms: &[Term]) -> Vec<String> {
    let mut made: Vec<(String, usize)> = Vec::new();
    for (place, term) in terms.iter().enumerate() {
        let first = place == 0;
        let sign = match (term.negative, first) {
            (true, true) => "-",
            (true, false) => "- ",
            (false, true) => "",
            (false, false) => "+ ",
        };
        match &term.value {
            Value::Bracket { before, sum, after } if term.value.inline().width > LINE => {
                let factor = |factors: &[Tex]| match factors {
                    [] => String::new(),
                    _ => Tex::product(factors.to_vec()).within(Binding::Cross).text,
                };
                let mut inner = lines(sum);
                let last = inner.pop().unwrap_or_default();
                let open = format!("{sign}{}\\bigl(", factor(before));
                let indented = inner.iter().map(|line| format!("\\quad {line}"));
                made.push((open, LINE));
                made.extend(indented.map(|line| (line, LINE)));
                made.push((format!("\\quad {last}\\bigr)\\,{}", factor(after)), LINE));
            }
            value => {
                let value = value.inline();
                let value = if term.negative { value.within(Binding::Sum) } else { value };
                let text = format!("{sign}{}", value.text);
                match made.last_mut() {
                    Some((line, width)) if *width + value.width < LINE => {
                        *line = format!("{line} {text}");
                        *width += value.width + 3;
                    }
                    _ => made.push((text, value.width)),
                }
            }
        }
    }
    made.into_iter().map(|(line, _)| line).collect()
}

/// Lines as a display in which they are aligned.
#[must_use]
pub fn aligned(lines: &[String]) -> String {
    format!("\\begin{{aligned}}\n{}\n\\end{{aligned}}", lines.join(" \\\\\n"))
}

/// Signs that remain when markup is taken away.
fn width(text: &str) -> usize {
    let mut signs = 0;
    let mut rest = text.chars().peekable();
    while let Some(c) = rest.next() {
        match c {
            '\\' => {
                let mut command = String::new();
                while let Some(letter) = rest.next_if(char::is_ascii_alphabetic) {
                    command.push(letter);
                }
                let sets = ["gamma", "theta", "omega", "Omega", "rho", "alpha"];
                signs += usize::from(sets.contains(&command.as_str()));
            }
            c if c.is_alphanumeric() || "/[]+-=".contains(c) => signs += 1,
            _ => {}
        }
    }
    signs
}

#[cfg(test)]
mod tests {
    use super::*;

    fn short(text: &str) -> Term {
        Term { negative: false, value: Value::Short(Tex::atom(text)) }
    }

    #[test]
    fn a_sum_beside_a_factor_stands_in_brackets() {
        let sum = Tex::sum(&[short("a"), Term { negative: true, ..short("b") }]);
        assert_eq!(sum.text, "a - b");
        assert_eq!(Tex::product(vec![Tex::atom("m"), sum]).text, "m\\,(a - b)");
    }

    #[test]
    fn a_long_bracket_is_broken_inside() {
        let sum: Vec<_> = (0..40).map(|k| short(&format!("a{k}"))).collect();
        let value =
            Value::Bracket { before: vec![Tex::atom("m")], sum, after: vec![Tex::atom("v")] };
        let broken = lines(&[Term { negative: true, value }]);
        assert!(broken.len() > 3);
        assert_eq!(broken[0], "-m\\bigl(");
        assert!(broken.last().is_some_and(|line| line.ends_with("\\bigr)\\,v")));
    }
}
