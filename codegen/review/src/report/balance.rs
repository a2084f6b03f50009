//! Printed equations whose units do not balance.

use crate::notation::{Balance as Weight, unit};
use precess_codegen::graph::Graph;
use precess_codegen::page::{Block, Page, PageError, blocks, read_on};

/// The printed blocks whose terms are of different units: what no author means.
pub(super) struct Balance(Vec<String>);

impl Balance {
    /// Reads the print and weighs every component.
    pub(super) fn of_pages(
        graph: &Graph,
        pages: &[Page],
        printed: &[Page],
    ) -> Result<Self, PageError> {
        let (_, reader) = read_on(graph, pages)?;
        let mut unbalanced = Vec::new();
        for page in printed {
            let stated = blocks(&page.name, &page.text, "printed")?;
            for block in stated.iter().filter(|block| !block.is_words()) {
                let wrong = |error| PageError { page: page.name.clone(), line: block.line, error };
                let value = reader.body(&block.body).map_err(wrong)?;
                let components = reader.resolve(block, value).map_err(wrong)?;
                let units = components.iter().map(|(_, component)| unit(*component));
                // A symbol without a unit is nothing that the print could be blamed for.
                let all = units.flatten().fold(Weight::Any, Weight::with);
                if all == Weight::Not {
                    unbalanced.push(block.place());
                }
            }
        }
        Ok(Self(unbalanced))
    }
}

impl Balance {
    /// Whether a block is among them.
    pub(super) fn fails(&self, block: &Block) -> bool {
        self.0.contains(&block.place())
    }
}
