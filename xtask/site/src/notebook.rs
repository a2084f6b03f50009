//! A Jupyter notebook as Markdown: its texts as they are, its code in blocks. Notebooks are kept without results, which
//! the tests compute anew; a page therefore says how to run it.

use serde::Deserialize;

#[derive(Deserialize)]
struct Notebook {
    cells: Vec<Cell>,
}

#[derive(Deserialize)]
struct Cell {
    cell_type: String,
    source: Source,
}

/// The text of a cell: whole, or line by line.
#[derive(Deserialize)]
#[serde(untagged)]
enum Source {
    Whole(String),
    Lines(Vec<String>),
}

/// The notebook of a file as one text.
pub(crate) fn markdown(source: &str, text: &str) -> Result<String, String> {
    let notebook: Notebook =
        serde_json::from_str(text).map_err(|error| format!("{source} is no notebook: {error}"))?;
    let name = source.rsplit('/').next().unwrap_or(source);
    let run = format!(
        "\n\nTo run it: `jupyter lab {name}`, in the folder `{}` of the repository.\n",
        folder(source)
    );
    let mut text = String::new();
    for (cell, index) in notebook.cells.into_iter().zip(0..) {
        let written = match cell.source {
            Source::Whole(text) => text,
            Source::Lines(lines) => lines.concat(),
        };
        match cell.cell_type.as_str() {
            "code" => {
                put!(text, "\n\n```python\n{written}\n```\n");
            }
            _ => {
                put!(text, "\n\n{written}\n");
            }
        }
        if index == 0 {
            text.push_str(&run);
        }
    }
    Ok(text)
}

fn folder(source: &str) -> &str {
    source.rsplit_once('/').map_or("", |(folder, _)| folder)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn texts_and_code_come_in_order() {
        let text = r##"{"cells": [{"cell_type": "markdown", "source": ["# A\n", "b"]},
                       {"cell_type": "code", "source": "print(1)", "outputs": []}], "nbformat": 4}"##;
        let text = markdown("python/notebooks/a.ipynb", text).unwrap();
        assert!(text.starts_with("\n\n# A\nb\n"), "{text}");
        assert!(text.contains("`jupyter lab a.ipynb`, in the folder `python/notebooks`"), "{text}");
        assert!(text.ends_with("```python\nprint(1)\n```\n"), "{text}");
        assert!(markdown("a.ipynb", "{}").unwrap_err().starts_with("a.ipynb is no notebook"));
    }
}
