//! Words with pieces of code in them, to be read as mathematics.

use crate::notation::expression;

/// Markdown with its pieces of code set as mathematics, where they are such.
pub(super) fn mathematics(text: &str) -> String {
    let set = |(place, piece): (usize, &str)| {
        if place % 2 == 0 {
            return piece.to_owned();
        }
        match expression("", &squares(piece)) {
            Ok(latex)
                if !latex.contains("\\mathrm{")
                    || piece.contains("sin")
                    || piece.contains("cos") =>
            {
                format!("${latex}$")
            }
            _ => format!("`{piece}`"),
        }
    };
    text.split('`').enumerate().map(set).collect()
}

/// `sq(a)` for `a^2`.
fn squares(code: &str) -> String {
    let square = |factor: &str| {
        let (sign, name) = factor.strip_prefix('-').map_or(("", factor), |name| ("-", name));
        let squared = name.strip_suffix("^2").map(|name| format!("{sign}sq({name})"));
        squared.unwrap_or_else(|| factor.to_owned())
    };
    code.split('*').map(square).collect::<Vec<_>>().join("*")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn code_that_is_an_expression_is_set_and_other_code_stays() {
        assert_eq!(mathematics("no `m_w*d^2` of `fn wheel`"), "no $m_{W}\\,d^{2}$ of `fn wheel`");
        assert_eq!(mathematics("sign of `sin(gamma_i)`"), "sign of $\\mathrm{s}\\,{}^{i}\\gamma$");
    }
}
