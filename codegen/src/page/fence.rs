//! Fenced blocks of Markdown, with the text between them.

use super::{PageError, ReadError};

/// One fenced block.
pub(super) struct Fence<'t> {
    /// Line of the opening fence, from one.
    pub(super) line: usize,
    /// The lines inside.
    pub(super) inside: Vec<&'t str>,
    /// The lines after it, up to the next block of this fence, with their numbers.
    pub(super) after: Vec<(usize, &'t str)>,
}

/// The blocks of `text` that are fenced as `fence`, in order.
///
/// # Errors
/// When a fence is not closed.
pub(super) fn fences<'t>(
    page: &str,
    text: &'t str,
    fence: &str,
) -> Result<Vec<Fence<'t>>, PageError> {
    let mut found: Vec<Fence<'t>> = Vec::new();
    let mut lines = (1..).zip(text.lines());
    while let Some((line, text)) = lines.next() {
        if text.trim().strip_prefix("```") == Some(fence) {
            let mut inside = Vec::new();
            loop {
                match lines.next() {
                    Some((_, text)) if text.trim() == "```" => break,
                    Some((_, text)) => inside.push(text),
                    None => {
                        let page = page.to_owned();
                        return Err(PageError { page, line, error: ReadError::OpenFence });
                    }
                }
            }
            found.push(Fence { line, inside, after: Vec::new() });
        } else if let Some(last) = found.last_mut() {
            last.after.push((line, text));
        }
    }
    Ok(found)
}
