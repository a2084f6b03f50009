//! The functions of a record that change it number by number, whatever the numbers are.

use super::layout::fitted;

/// `map` and `zip` of a record with these fields; `of` is its type parameter and what that must be.
pub(super) fn by_number(record: &str, of: &str, fields: &[&str]) -> Vec<String> {
    let number = of.split(':').next().unwrap_or(of);
    let joined: Vec<_> = fields
        .iter()
        .map(|field| {
            let operands = ["self", "other"].map(|record| format!("{record}.{field}"));
            // Where the line would be too long, as `rustfmt` breaks it.
            fitted(12, &format!("{field}: join("), &operands, ")")
                .trim_start()
                .replace("\n            ", "\n")
        })
        .collect();
    let map = fitted(
        4,
        "pub fn map<U: Copy>(",
        &["&self".to_owned(), format!("mut change: impl FnMut({number}) -> U")],
        &format!(") -> {record}<U> {{"),
    );
    let zip = fitted(
        4,
        "pub fn zip<U: Copy, W>(",
        &[
            "&self".to_owned(),
            format!("other: &{record}<U>"),
            format!("mut join: impl FnMut({number}, U) -> W"),
        ],
        &format!(") -> {record}<W> {{"),
    );
    let text = format!(
        "impl<{of}> {record}<{number}> {{\n    \
         /// The record with each of its numbers changed.\n    #[inline(always)]\n    \
         #[must_use]\n{map}\n        self.zip(self, |number, _| change(number))\n    }}\n\n    \
         /// Two records joined number by number.\n    #[inline(always)]\n    #[must_use]\n\
         {zip}\n{}\n    }}\n}}",
        fitted(8, &format!("{record} {{"), &joined, "}")
    );
    text.lines().map(str::to_owned).collect()
}
