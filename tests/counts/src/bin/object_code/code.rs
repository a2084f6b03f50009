//! [`Program`]: the machine code of the functions of an executable, by the addresses that they have
//! while it runs.

use std::error::Error;

use object::{Object, ObjectSection, ObjectSymbol, SymbolKind};

/// An executable file, and where it was loaded.
pub(crate) struct Program<'a> {
    file: object::File<'a>,
    /// Address of a function while the program runs, less its address in the file.
    offset: u64,
}

impl<'a> Program<'a> {
    /// The program whose file this is; `anchor` is the address of its function `run`.
    pub(crate) fn new(file: &'a [u8], anchor: usize) -> Result<Self, Box<dyn Error>> {
        let file = object::File::parse(file)?;
        // A program is moved by whole pages, so the low bits of the address are those of the file.
        let page = 0xfff;
        let anchor = anchor as u64;
        let found = file.symbols().find(|symbol| {
            let name = symbol.name().unwrap_or_default();
            name.contains("object_code")
                && name.contains("run")
                && symbol.address() & page == anchor & page
        });
        let found = found.ok_or("the program has no symbols")?;
        let offset = anchor.wrapping_sub(found.address());
        Ok(Self { file, offset })
    }

    /// The machine code of the function at an address of the running program.
    pub(crate) fn function(&self, address: usize) -> Option<&'a [u8]> {
        let address = (address as u64).wrapping_sub(self.offset);
        let symbol = self.file.symbols().find(|symbol| {
            symbol.kind() == SymbolKind::Text && symbol.address() == address && symbol.size() > 0
        })?;
        let section = self.file.section_by_index(symbol.section_index()?).ok()?;
        section.data_range(address, symbol.size()).ok()?
    }
}
