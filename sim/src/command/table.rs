//! Text in columns, for the terminal.

/// Where a text is in the width of its column.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Side {
    Left,
    Right,
}

/// Rows with their cells one under the other: the first column to the left, the others to the
/// right. Rows of one cell are headings.
pub(super) fn aligned(rows: &[Vec<String>]) -> String {
    columns(rows, Side::Right)
}

/// Rows of text: every column to the left.
pub(super) fn aligned_left(rows: &[Vec<String>]) -> String {
    columns(rows, Side::Left)
}

fn columns(rows: &[Vec<String>], others: Side) -> String {
    let count = rows.iter().map(Vec::len).max().unwrap_or(0);
    let width = |column: usize| {
        let cells = rows.iter().filter(|row| row.len() > 1).filter_map(|row| row.get(column));
        cells.map(|cell| cell.chars().count()).max().unwrap_or(0)
    };
    let widths: Vec<_> = (0..count).map(width).collect();
    let mut text = String::new();
    for row in rows {
        let mut line = String::new();
        for (column, (cell, width)) in row.iter().zip(&widths).enumerate() {
            let space = " ".repeat(width.saturating_sub(cell.chars().count()));
            let side = if column == 0 { Side::Left } else { others };
            line.push_str(if column == 0 { "" } else { "  " });
            let [before, after] = match side {
                Side::Left => ["", &space],
                Side::Right => [&space, ""],
            };
            line.extend([before, cell, after]);
        }
        text.push_str(line.trim_end());
        text.push('\n');
    }
    text
}

/// A number in six digits.
pub(super) fn six(value: f64) -> String {
    if value == 0.0 {
        return "0".to_owned();
    }
    let size = value.abs();
    if (1e-3..1e6).contains(&size) {
        #[expect(clippy::cast_possible_truncation, reason = "a decimal exponent from -3 to 5")]
        let digits = 5 - size.log10().floor() as i32;
        #[expect(clippy::cast_sign_loss, reason = "not below zero")]
        let digits = digits.max(0) as usize;
        let text = format!("{value:.digits$}");
        if text.contains('.') {
            return text.trim_end_matches('0').trim_end_matches('.').to_owned();
        }
        return text;
    }
    format!("{value:.5e}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn six_digits_whatever_the_size() {
        let shown = [0.0, 1.5, -1234.5678, 0.001_234_567_8, 1e-9, 862.0].map(six);
        assert_eq!(shown, ["0", "1.5", "-1234.57", "0.00123457", "1.00000e-9", "862"]);
    }

    #[test]
    fn cells_stand_under_each_other() {
        let rows = [vec!["a".to_owned(), "10".to_owned()], vec!["bc".to_owned(), "5".to_owned()]];
        assert_eq!(aligned(&rows), "a   10\nbc   5\n");
    }
}
