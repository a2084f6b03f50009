//! The mount: what is proved with the device's axes along B's holds along any other.
//!
//! Turn the mount by any rotation C, and with it every input of a statement that is expressed in B;
//! then what the statement computes turns by C, too: vectors as `C v`, tensors as `C T C^T`,
//! numbers not at all. C is three turns with sines and cosines of their own, so `C C^T = 1` is
//! known to the normal forms. Each statement between the first body's axes and B's is taken by
//! itself: what it reads of the others are symbols, and so is everything expressed in the device's
//! own axes.

use std::collections::{BTreeMap, BTreeSet};

use super::Comparison;
use super::read_back::{EmittedError, Reading, function, read};
use crate::derivation::chain::Chain;
use crate::derivation::chain::assumed::mount_entry;
use crate::graph::{Expr, Node, Stage, SymbolId};
use crate::kernel::{Kernel, parameters_of};
use crate::normal::Ring;
use crate::space::{Axis, BodyFrame, ENTRIES, Hub, ParentFrame, Turn, Vector, XYZ};

/// Vectors expressed in B that statements read or make.
fn vectors(chain: &Chain<'_>) -> Vec<String> {
    let tags = || chain.kind.links.iter().map(|link| link.joint.tag);
    let columns = tags().flat_map(|tag| [format!("f_{tag}"), format!("n_{tag}")]);
    let single =
        ["omega", "reach", "r_first_rest", "mr_moving", "f_rates", "n_rates", "constant_mr"];
    single.map(str::to_owned).into_iter().chain(columns).collect()
}

/// Components of a vector expressed in B.
fn components(stem: &str) -> [String; 3] {
    ["bx", "by", "bz"].map(|axis| format!("{stem}_{axis}"))
}

/// One row: every statement of `eliminate` and `constant_share` that leads to B.
pub(super) fn row<'g>(
    chain: &Chain<'g>,
    kernels: &[Kernel<'g>],
    file: &syn::File,
) -> Result<Comparison, EmittedError> {
    let values = values(chain, kernels, file)?;
    let turned = Turned::new(chain);
    let mut checked = Vec::new();
    let mut expected = Vec::new();
    let value = |name: &String| values.get(name).copied().unwrap_or(chain.graph.zero());
    let mut claim = |name: String, is: Expr<'g>, ought: Expr<'g>| {
        checked.push((name.clone(), is));
        expected.push((name, ought));
    };
    for stem in vectors(chain).iter().filter(|stem| *stem != "omega") {
        let names = components(stem);
        let at_unit = names.each_ref().map(|name| turned.at_unit(value(name)));
        for (name, ought) in names.iter().zip(turned.vector(at_unit)) {
            claim(name.clone(), turned.by(value(name)), ought);
        }
    }
    for stem in ["i_moving", "constant_i"] {
        let names = ENTRIES.map(|entry| format!("{stem}_{entry}"));
        let at_unit = names.each_ref().map(|name| turned.at_unit(value(name)));
        for (name, ought) in names.iter().zip(turned.tensor(at_unit)) {
            claim(name.clone(), turned.by(value(name)), ought);
        }
    }
    let frame = chain.kind.links[chain.first_moving()].body.frame;
    let numbers = ["omega_b_n", "r_first_rest"].into_iter();
    let numbers = numbers.flat_map(|stem| XYZ.map(|axis| format!("{stem}_{frame}{axis}")));
    let biases = chain.kind.links.iter().map(|link| format!("u_rest_{}", link.joint.tag));
    for name in numbers.chain(biases).chain(["constant_m".to_owned()]) {
        claim(name.clone(), turned.by(value(&name)), turned.at_unit(value(&name)));
    }
    let heading = ["(mount)", "along B", "fn eliminate turns with the mount"];
    Ok(Comparison::new(&mut Ring::new(chain.graph), heading, &checked, &expected))
}

/// The value of each statement, in symbols of those before it.
fn values<'g>(
    chain: &Chain<'g>,
    kernels: &[Kernel<'g>],
    file: &syn::File,
) -> Result<BTreeMap<String, Expr<'g>>, EmittedError> {
    let graph = chain.graph;
    let along_own =
        ["omega_", "alpha_", "mr_behind_", "i_behind_", "f_rates_", "n_rates_", "field_"];
    // Of what moves, inertia and first moment are made of the same sums: neither is a symbol in the
    // other. The inertia also reads the first joint's own column, of which its trace is a part.
    let column = format!("n_{}", chain.kind.links[chain.first_moving()].joint.tag);
    let made = vectors(chain).into_iter();
    let made = made.filter(|stem| *stem != "mr_moving" && *stem != column);
    let along_b: Vec<_> = made.flat_map(|stem| components(&stem)).collect();
    let stands = |name: &String| {
        along_b.contains(name) || along_own.iter().any(|stem| name.starts_with(stem))
    };
    let cuts: BTreeSet<String> = bound(file).into_iter().filter(stands).collect();
    for name in &cuts {
        if graph.find(name).is_none() {
            let _ = graph.symbol(name, Stage::Rate);
        }
    }
    let symbols = |record: &crate::kernel::Record, letter: &str| -> BTreeMap<String, Expr<'g>> {
        let field = |name: &String| {
            let known = graph.find(name);
            known.unwrap_or_else(|| graph.symbol(name, Stage::Rate))
        };
        let named =
            record.sources().into_iter().map(|name| (format!("{letter}.{name}"), field(&name)));
        named.collect()
    };
    let given = symbols(&parameters_of(chain), "p");
    let prepare = read(graph, function(file, "prepare")?, &given, &cuts)?;
    let mut found = BTreeMap::new();
    // Where a function only returns what `prepare` has computed, the value is the first one's.
    let mut keep = |reading: &Reading<'g>| {
        for (name, value) in &reading.values {
            found.entry(name.clone()).or_insert(*value);
        }
    };
    keep(&prepare);
    for kernel in
        kernels.iter().filter(|k| ["constant_share", "eliminate"].contains(&k.name.as_str()))
    {
        let mut given = BTreeMap::new();
        for (letter, record) in &kernel.inputs {
            given.extend(symbols(record, letter));
        }
        let constants = prepare.returned.iter();
        given.extend(constants.map(|(name, value)| (format!("p.{name}"), *value)));
        let back = read(graph, function(file, &kernel.name)?, &given, &cuts)?;
        keep(&back.returning(&kernel.output).or(kernel.plain()));
    }
    Ok(found)
}

/// Every name that `prepare` and `eliminate` bind.
fn bound(file: &syn::File) -> Vec<String> {
    let functions = ["prepare", "eliminate"].into_iter();
    let functions = functions.filter_map(|name| function(file, name).ok());
    let names = functions.flat_map(|f| &f.block.stmts).filter_map(|statement| match statement {
        syn::Stmt::Local(syn::Local { pat: syn::Pat::Ident(name), .. }) => {
            Some(name.ident.to_string())
        }
        _ => None,
    });
    names.collect()
}

/// A rotation C, and what is read with everything expressed in B turned by it.
struct Turned<'g> {
    /// Its columns.
    axes: [Vector<'g, Hub>; 3],
    along_b: Vec<(SymbolId, Expr<'g>)>,
    unit: Vec<(SymbolId, Expr<'g>)>,
}

impl<'g> Turned<'g> {
    fn new(chain: &Chain<'g>) -> Self {
        let graph = chain.graph;
        let angle = |name: &str| graph.angle(name, graph.zero());
        let back = |axis: Axis, name: &str| {
            let (sin, cos) = angle(name);
            Turn::<ParentFrame, BodyFrame>::about(axis, sin, cos).inverse()
        };
        let axes = [Axis::X, Axis::Y, Axis::Z].map(|axis| {
            let v = Vector::<BodyFrame>::unit(graph, axis).turned(back(Axis::Z, "mount_c"));
            let v = v.relabelled_inboard().turned(back(Axis::Y, "mount_b"));
            v.relabelled_inboard().turned(back(Axis::Z, "mount_a")).on_hub()
        });
        let mut made = Self { axes, along_b: Vec::new(), unit: Vec::new() };
        let symbol = |name: &str| match graph.find(name).map(Expr::node) {
            Some(Node::Symbol(symbol)) => Some(symbol),
            _ => None,
        };
        for (column, axis) in axes.iter().enumerate() {
            for (row, entry) in axis.components().into_iter().enumerate() {
                if let Some(symbol) = symbol(&mount_entry(row, column)) {
                    let unit = graph.constant(i64::from(row == column));
                    made.along_b.push((symbol, entry));
                    made.unit.push((symbol, unit));
                }
            }
        }
        for stem in vectors(chain) {
            let names = components(&stem);
            let own = names.each_ref().map(|name| graph.find(name).unwrap_or(graph.zero()));
            for (name, value) in names.iter().zip(made.vector(own)) {
                made.along_b.extend(symbol(name).map(|symbol| (symbol, value)));
            }
        }
        made
    }

    /// With the mount C and every vector expressed in B turned by it.
    fn by(&self, e: Expr<'g>) -> Expr<'g> {
        e.with(&self.along_b)
    }

    /// With the device's axes along B's.
    fn at_unit(&self, e: Expr<'g>) -> Expr<'g> {
        e.with(&self.unit)
    }

    /// `C v`.
    fn vector(&self, v: [Expr<'g>; 3]) -> [Expr<'g>; 3] {
        let [x, y, z] = v;
        (x * self.axes[0] + y * self.axes[1] + z * self.axes[2]).components()
    }

    /// `C T C^T`.
    fn tensor(&self, t: [Expr<'g>; 6]) -> [Expr<'g>; 6] {
        let [xx, xy, xz, yy, yz, zz] = t;
        let [x, y, z] = [[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]].map(|row| self.vector(row));
        let entry = |i: usize, j: usize| {
            // Row i of C by column: sum over k of C_ik (C T)_jk.
            let [a, b, c] = self.axes.map(|axis| axis.components()[i]);
            a * x[j] + b * y[j] + c * z[j]
        };
        [entry(0, 0), entry(0, 1), entry(0, 2), entry(1, 1), entry(1, 2), entry(2, 2)]
    }
}
