//! The pages of our own equations, (D1) to (D13), against the kernels that rest on them.
//!
//! A block is compared with the statements of its name. Composites, Coriolis wrenches and joint
//! rows are compared expanded: they are on the paper's pages, and a second block of a name states
//! it by the paper's equations. The elimination is compared as the kernel has it: what was named
//! before is a symbol, and so is each entry and divisor once its block is read.

use rustc_hash::FxHashMap;

use super::Comparison;
use super::pages::frame_of;
use crate::derivation::chain::Chain;
use crate::derivation::chain::assumed::mount_entry;
use crate::derivation::elimination::is_of_elimination;
use crate::derivation::heading::Heading;
use crate::derivation::script::Statement;
use crate::graph::{Expr, Node, SymbolId};
use crate::kernel::kernels;
use crate::normal::Ring;
use crate::page::{
    Block, Equation, Kind, Page, PageError, ReadError, Reader, Value, in_the_case, read_on,
};
use crate::space::XYZ;

/// The kernels whose statements the pages derive.
const KERNELS: [&str; 3] = ["constant_share", "eliminate", "back_substitute"];
const CLAIM: &str = "kernel = page";

/// One group of pages, and the statements that it derives.
pub struct KernelPages<'a, 'g> {
    chain: &'a Chain<'g>,
    statements: FxHashMap<String, Statement<'g>>,
    /// Names of statements whose headings cite our own equations, in order.
    ours: Vec<String>,
    /// Symbols that are substituted in both sides before these are compared.
    expanded: Vec<(SymbolId, Expr<'g>)>,
    equations: Vec<Equation<'g>>,
    /// Knows every name of the pages.
    reader: Reader<'g>,
}

impl<'a, 'g> KernelPages<'a, 'g> {
    /// The pages of composites and joint rows, read after the paper's.
    ///
    /// # Errors
    /// The first block that is malformed or uses an unknown name.
    pub fn composites(
        chain: &'a Chain<'g>,
        paper: &[Page],
        pages: &[Page],
    ) -> Result<Self, PageError> {
        let reader = read_on(chain.graph, paper)?.1;
        let mut made = Self::new(chain, reader, |heading| !is_of_elimination(heading));
        // A cut value may hold symbols that were cut before it.
        let cuts = made.statements.values().filter_map(|s| Some((symbol(s.cut?)?, s.value)));
        let cuts: Vec<_> = cuts.collect();
        let whole = |value: Expr<'g>| value.with(&cuts).with(&cuts);
        made.expanded = cuts.iter().map(|(symbol, value)| (*symbol, whole(*value))).collect();
        let equations = made.reader.pages(pages, |_, value| value)?;
        Ok(made.with(equations))
    }

    /// The pages of the elimination, read by themselves. Vectors are expressed in B.
    ///
    /// # Errors
    /// The first block that is malformed or uses an unknown name.
    pub fn elimination(chain: &'a Chain<'g>, pages: &[Page]) -> Result<Self, PageError> {
        let mut made = Self::new(chain, Reader::new(chain.graph), is_of_elimination);
        for (axis, letter) in XYZ.into_iter().enumerate() {
            made.reader.define(&format!("b_{letter}_hat"), Value::unit(chain.graph, axis));
        }
        let tags = chain.kind.links.iter().map(|link| link.joint.tag);
        let blocks =
            tags.chain(["rates"]).flat_map(|tag| ["f", "n"].map(|of| format!("{of}_{tag}")));
        let hub = ["r_b_n_ddot", "omega_dot"].map(str::to_owned);
        for name in blocks.chain(hub) {
            let names = XYZ.map(|axis| format!("{name}_b{axis}"));
            if let Some(value) = vector(names.map(|name| chain.graph.find(&name))) {
                made.reader.define(&name, value);
            }
        }
        let named = made.statements.values().filter(|statement| statement.cut.is_none());
        let named = named.filter_map(|s| Some((symbol(chain.graph.find(&s.name)?)?, s.value)));
        made.expanded = named.collect();
        let mut reader = made.reader.clone();
        let meaning = |block: &Block, value| made.symbols(block).unwrap_or(value);
        let equations = reader.pages(pages, meaning)?;
        made.reader = reader;
        Ok(made.with(equations))
    }

    fn new(chain: &'a Chain<'g>, reader: Reader<'g>, chosen: impl Fn(&Heading) -> bool) -> Self {
        let (mut statements, mut ours) = (FxHashMap::default(), Vec::new());
        let unit = mount(chain);
        for kernel in kernels(chain).iter().filter(|kernel| KERNELS.contains(&&*kernel.name)) {
            for section in kernel.sections.iter().filter(|section| chosen(&section.heading)) {
                let equations = section.heading.equations();
                let own = equations.iter().any(|equation| equation.starts_with("(D"));
                for statement in &section.statements {
                    let value = statement.value.with(&unit);
                    let name = statement.name.clone();
                    if own && !ours.contains(&name) {
                        ours.push(name.clone());
                    }
                    statements.insert(name, Statement { value, ..statement.clone() });
                }
            }
        }
        Self { chain, statements, ours, expanded: Vec::new(), equations: Vec::new(), reader }
    }

    fn with(mut self, mut equations: Vec<Equation<'g>>) -> Self {
        for (_, component) in equations.iter_mut().flat_map(|equation| &mut equation.components) {
            *component = component.with(&self.expanded);
        }
        self.equations = equations;
        self
    }

    /// Every block, in order.
    #[must_use]
    pub fn equations(&self) -> &[Equation<'g>] {
        &self.equations
    }

    /// A block with another body.
    ///
    /// # Errors
    /// When the body does not evaluate, or not to what the block is.
    pub fn restated(&self, block: &Block, body: &str) -> Result<Equation<'g>, ReadError> {
        let components = self.reader.resolve(block, self.reader.body(body)?)?;
        let components = in_the_case(self.chain.graph, &block.given, components)?;
        let freed = components.into_iter().map(|(label, e)| (label, e.with(&self.expanded)));
        Ok(Equation { block: block.clone(), components: freed.collect() })
    }

    /// One row per block, and one for each statement under our own equations that no block states.
    #[must_use]
    pub fn rows(&self) -> Vec<Comparison> {
        let mut rings = FxHashMap::default();
        let stated = self.equations.iter().map(|equation| {
            let ring = rings.entry(equation.block.page.clone());
            self.row(ring.or_insert_with(|| Ring::new(self.chain.graph)), equation)
        });
        let mut rows: Vec<_> = stated.collect();
        let own = |equation: &Equation<'g>| equation.block.given.is_empty();
        let blocks = self.equations.iter().filter(|equation| own(equation));
        let stated: Vec<_> = blocks.flat_map(|equation| self.names(&equation.block)).collect();
        let lacking = self.ours.iter().filter(|name| !stated.iter().any(|(_, own)| own == *name));
        rows.extend(lacking.map(|name| Comparison::absent(["(missing)", name, CLAIM])));
        rows
    }

    /// The row of one block.
    #[must_use]
    pub fn row(&self, ring: &mut Ring<'g>, equation: &Equation<'g>) -> Comparison {
        let block = &equation.block;
        let heading = [block.tag.as_str(), &block.name, CLAIM];
        let value = |(label, name): (String, String)| {
            Some((label, self.statements.get(&name)?.value.with(&self.expanded)))
        };
        let reference: Vec<_> = self.names(block).into_iter().filter_map(value).collect();
        let row = match in_the_case(self.chain.graph, &block.given, reference) {
            Ok(reference) => Comparison::new(ring, heading, &reference, &equation.components),
            Err(_) => Comparison::absent(heading),
        };
        row.at(block.place())
    }

    /// Label and statement of each component of a block: `s_y` and `mr_behind_w_giy`.
    #[must_use]
    pub fn names(&self, block: &Block) -> Vec<(String, String)> {
        let name = &block.name;
        match &block.kind {
            Kind::Text => Vec::new(),
            Kind::Scalar => vec![(String::new(), name.clone())],
            Kind::Vector(axes) => {
                let labels = axes.iter().cloned();
                self.components(name, axes).map_or(Vec::new(), |names| labels.zip(names).collect())
            }
            Kind::Tensor(_) => {
                let places = (1..=3).flat_map(|i| (1..=3).map(move |j| (i, j)));
                let entry = |(i, j)| {
                    let [own, mirrored] = [(i, j), (j, i)].map(|(i, j)| format!("{name}_{i}{j}"));
                    let known = self.statements.contains_key(&own);
                    (format!("{i}{j}"), if known { own } else { mirrored })
                };
                places.map(entry).collect()
            }
        }
    }

    /// The statements of a vector, by the ways in which their names are made.
    fn components(&self, name: &str, axes: &[String; 3]) -> Option<[String; 3]> {
        let frame = match frame_of(self.chain, axes)?.checked_sub(1) {
            None => "b",
            Some(k) => self.chain.kind.links[k].body.frame,
        };
        let (head, tail) = name.rsplit_once('_').unwrap_or((name, ""));
        let ways = [
            XYZ.map(|axis| format!("{name}_{frame}{axis}")),
            XYZ.map(|axis| format!("{head}_{frame}{axis}_{tail}")),
            // The first joint's origin, expressed in the device's axes.
            XYZ.map(|axis| format!("{name}_d{axis}")),
            ["1", "2", "3"].map(|number| format!("{name}{number}")),
            ["1", "2", "3"].map(|number| format!("{name}_{number}")),
        ];
        ways.into_iter().find(|names| names.iter().all(|name| self.statements.contains_key(name)))
    }

    /// The symbols that stand for the statements of a block from there on.
    fn symbols(&self, block: &Block) -> Option<Value<'g>> {
        let symbol = |(_, name): &(String, String)| self.chain.graph.find(name);
        let names = self.names(block);
        match (&block.kind, &names[..]) {
            (Kind::Scalar, [name]) => symbol(name).map(Value::Scalar),
            (Kind::Vector(_), [a, b, c]) => vector([a, b, c].map(symbol)),
            _ => None,
        }
    }
}

fn vector(components: [Option<Expr<'_>>; 3]) -> Option<Value<'_>> {
    let [Some(x), Some(y), Some(z)] = components else { return None };
    Some(Value::Vector([x, y, z]))
}

fn symbol(e: Expr<'_>) -> Option<SymbolId> {
    match e.node() {
        Node::Symbol(symbol) => Some(symbol),
        _ => None,
    }
}

/// The mount where the device's axes are those of B.
fn mount<'g>(chain: &Chain<'g>) -> Vec<(SymbolId, Expr<'g>)> {
    let places = (0..3).flat_map(|row| (0..3).map(move |column| (row, column)));
    let entry = |(row, column)| {
        let entry = symbol(chain.graph.find(&mount_entry(row, column))?)?;
        Some((entry, chain.graph.constant(i64::from(row == column))))
    };
    places.filter_map(entry).collect()
}
