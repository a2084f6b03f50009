//! The emitted text held against the derivation: what ships is what is proved.
//!
//! Every function is read twice. *Expanded*, each name stands for all it was made of: where it
//! carries a claim, it is compared with a reference that was derived another way. *Cut*, the blocks
//! of the assembled system and the pivots are symbols, which keeps the factors small enough to be
//! multiplied out again; see [`super::factors`].

use std::collections::{BTreeMap, BTreeSet};
use std::rc::Rc;

use rustc_hash::FxHashMap;

use super::laws::Laws;
use super::modes::divisor;
use super::read_back::{EmittedError, Reading, function, read, returned_names};
use super::unknowns::{Unknowns, moving};
use super::{Comparison, factors, mounted, potential, stages};
use crate::derivation::chain::Chain;
use crate::derivation::chain::assumed::mount_entry;
use crate::derivation::reference;
use crate::graph::{Expr, Stage};
use crate::kernel::{Kernel, kernels, parameters_of};
use crate::normal::Ring;

/// Proves emitted files of one kind. Keeps what the first text of a function was expanded to, so
/// that a second one which differs in one place costs little.
pub struct Prover<'a, 'g> {
    chain: &'a Chain<'g>,
    kernels: Vec<Kernel<'g>>,
    /// Two rings for each function, which keeps the number of variables in each small.
    rings: Vec<[Ring<'g>; 2]>,
    unknowns: Unknowns<'g>,
    laws: Laws<'g>,
    /// The last `prepare`, and what was read of it.
    last: Option<(syn::ItemFn, Rc<Constants<'g>>)>,
}

/// A function in both readings.
struct Readings<'g> {
    expanded: Reading<'g>,
    cut: Reading<'g>,
}

/// `prepare`, and the names at which its cut reading and that of all others stops.
struct Constants<'g> {
    cuts: BTreeSet<String>,
    prepare: Readings<'g>,
}

impl<'a, 'g> Prover<'a, 'g> {
    /// A prover for the kind of `chain`.
    #[must_use]
    pub fn new(chain: &'a Chain<'g>) -> Self {
        let kernels = kernels(chain);
        let rings = kernels.iter().map(|_| [Ring::new(chain.graph), Ring::new(chain.graph)]);
        let unknowns = Unknowns::of_chain(chain);
        let laws = Laws::of_chain(chain);
        Self { chain, rings: rings.collect(), kernels, unknowns, laws, last: None }
    }

    /// One row per claim, per law, per block of the factors and per returned record.
    ///
    /// # Errors
    /// When the text does not parse or holds something that is no kernel.
    pub fn rows(&mut self, text: &str) -> Result<Vec<Comparison>, EmittedError> {
        let file =
            syn::parse_file(text).map_err(|error| EmittedError::Syntax(error.to_string()))?;
        let constants = self.constants(&file)?;
        let mut rows = self.of_constants(&constants);
        for index in 0..self.kernels.len() {
            rows.extend(self.of_kernel(&file, &constants, index, |_| false)?);
        }
        Ok(rows)
    }

    /// The derivation itself against the equations that follow from the kinetic energy only.
    #[must_use]
    pub fn derivation(&self) -> Vec<Comparison> {
        let mut ring = Ring::new(self.chain.graph);
        let named = reference::share(self.chain).named(self.chain.kind, |_| true);
        let entries: BTreeMap<_, _> = named.into_iter().flat_map(|(_, entries)| entries).collect();
        let named = |name: &str| entries.get(name).copied();
        let all: Vec<_> = (0..self.unknowns.len()).collect();
        let mut rows = self.laws.rows(&mut ring, &self.unknowns, &all, "derivation", named);
        rows.extend(self.laws.of_momenta(&mut ring, self.chain));
        rows
    }

    /// The rows of one function of a file.
    ///
    /// # Errors
    /// When the file has no such function or it is no kernel.
    pub fn function(
        &mut self,
        file: &syn::File,
        name: &str,
    ) -> Result<Vec<Comparison>, EmittedError> {
        self.until(file, name, |_| false)
    }

    /// The rows of one function of a file to the first that is sought: what would come after it is not computed.
    ///
    /// # Errors
    /// As [`Prover::function`].
    pub fn until(
        &mut self,
        file: &syn::File,
        name: &str,
        sought: fn(&Comparison) -> bool,
    ) -> Result<Vec<Comparison>, EmittedError> {
        let constants = self.constants(file)?;
        if name == "prepare" {
            return Ok(self.of_constants(&constants));
        }
        let missing = || EmittedError::NoFunction(name.to_owned());
        let index = self.kernels.iter().position(|k| k.name == name).ok_or_else(missing)?;
        self.of_kernel(file, &constants, index, sought)
    }

    /// The rows of a kernel's function, which reads these constants, to the first that is sought.
    fn of_kernel(
        &mut self,
        file: &syn::File,
        constants: &Constants<'g>,
        index: usize,
        sought: fn(&Comparison) -> bool,
    ) -> Result<Vec<Comparison>, EmittedError> {
        let kernel = &self.kernels[index];
        let text = function(file, &kernel.name)?;
        let reading = |prepare: &Reading<'g>, cuts: &BTreeSet<String>| {
            let given = self.arguments(kernel, prepare);
            let back = read(self.chain.graph, text, &given, cuts)?;
            let values = prepare.values.iter().map(|(name, value)| (name.clone(), *value));
            let back = back.returning(&kernel.output).or(values).or(kernel.plain());
            Ok::<_, EmittedError>(back.sharing(&kernel.sections, self.chain.graph, cuts))
        };
        let back = Readings {
            expanded: reading(&constants.prepare.expanded, &BTreeSet::new())?,
            cut: reading(&constants.prepare.cut, &constants.cuts)?,
        };
        let assembled = if self.chain.is_rigid() {
            let Reading { values, returned, .. } = &back.expanded;
            self.unknowns.with_hub(self.chain, values, returned)
        } else if kernel.name == "eliminate" {
            let constant_share = function(file, "constant_share")?;
            let given = self.arguments(kernel, &constants.prepare.expanded);
            let constant_share = read(self.chain.graph, constant_share, &given, &BTreeSet::new())?;
            self.unknowns.with_hub(self.chain, &back.expanded.values, &constant_share.returned)
        } else {
            back.expanded.values.clone()
        };
        let [expanded, cut] = &mut self.rings[index];
        let mut rows = claims(expanded, kernel, &assembled, sought);
        if !rows.iter().any(sought) {
            match kernel.name.as_str() {
                "eliminate" => {
                    let named = |name: &str| assembled.get(name).copied();
                    let solved = self.unknowns.solved();
                    let who = "fn eliminate";
                    rows.extend(self.laws.rows(expanded, &self.unknowns, &solved, who, named));
                    let row = factors::of_elimination;
                    rows.extend(row(cut, self.chain, &self.unknowns, &back.cut));
                }
                "constant_share" if !self.chain.mount_is_turned() => {
                    rows.push(mounted::row(self.chain, &self.kernels, file)?);
                }
                "back_substitute" => {
                    let row = factors::of_back_substitution;
                    rows.push(row(cut, self.chain, &self.unknowns, &back.cut));
                }
                "gravity" => {
                    let named = |name: &str| back.expanded.values.get(name).copied();
                    rows.extend(potential::rows(expanded, self.chain, named));
                }
                _ => {}
            }
            rows.push(result(cut, kernel, &back.cut));
        }
        expanded.settle();
        cut.settle();
        Ok(rows)
    }

    /// What the functions of a file share: read once while neither `prepare` nor the cuts change.
    fn constants(&mut self, file: &syn::File) -> Result<Rc<Constants<'g>>, EmittedError> {
        let (text, cuts) = (function(file, "prepare")?, self.cuts(file)?);
        if let Some((last, constants)) = &self.last
            && constants.cuts == cuts
            && last == text
        {
            return Ok(Rc::clone(constants));
        }
        let constants = Rc::new(Constants { prepare: self.prepare(text, &cuts)?, cuts });
        self.last = Some((text.clone(), Rc::clone(&constants)));
        Ok(constants)
    }

    /// The rows of `prepare`.
    fn of_constants(&self, Constants { cuts, prepare }: &Constants<'g>) -> Vec<Comparison> {
        vec![self.prepared_row(prepare), self.cut_constants(prepare, cuts)]
    }

    /// The names at which the cut reading stops: blocks of the system, stages of their elimination,
    /// pivots, and what a joint divides by; none where no joint moves.
    fn cuts(&self, file: &syn::File) -> Result<BTreeSet<String>, EmittedError> {
        let Some(kernel) = self.kernels.iter().find(|kernel| kernel.name == "eliminate") else {
            return Ok(BTreeSet::new());
        };
        let claims = kernel.claims.iter();
        let blocks = claims.flat_map(|claim| &claim.components).map(|(name, _)| name.clone());
        let blocks = blocks.chain(moving().into_iter().flatten());
        let returned = returned_names(function(file, "eliminate")?);
        let pivots = returned.into_iter().filter_map(|(field, name)| {
            let tag = field.strip_prefix("pivot_")?;
            Some([name, divisor(tag)])
        });
        Ok(blocks.chain(pivots.flatten()).chain(stages::all(&self.unknowns)).collect())
    }

    fn prepare(
        &self,
        text: &syn::ItemFn,
        cuts: &BTreeSet<String>,
    ) -> Result<Readings<'g>, EmittedError> {
        let raw = parameters_of(self.chain)
            .fields
            .into_iter()
            .filter_map(|field| Some((format!("p.{}", field.name), self.parameter(&field.name)?)));
        let given = raw.collect();
        Ok(Readings {
            expanded: read(self.chain.graph, text, &given, &BTreeSet::new())?,
            cut: read(self.chain.graph, text, &given, cuts)?,
        })
    }

    /// The symbol of a parameter; of the mount, what it is where the device's axes are B's. That
    /// any other does the same along other axes is shown by itself, see [`super::mounted`].
    fn parameter(&self, name: &str) -> Option<Expr<'g>> {
        let graph = self.chain.graph;
        let places = (0..3).flat_map(|row| (0..3).map(move |column| (row, column)));
        let entry = places.into_iter().find(|(row, column)| mount_entry(*row, *column) == name);
        let unit = entry.map(|(row, column)| graph.constant(i64::from(row == column)));
        unit.or_else(|| graph.find(name))
    }

    /// Every field of a kernel's arguments, with the constants for `p`.
    fn arguments(&self, kernel: &Kernel<'g>, prepare: &Reading<'g>) -> BTreeMap<String, Expr<'g>> {
        let graph = self.chain.graph;
        let mut given = BTreeMap::new();
        for (letter, record) in &kernel.inputs {
            if record.name == "Prepared" {
                let constants = prepare.returned.iter();
                given.extend(constants.map(|(name, value)| (format!("{letter}.{name}"), *value)));
            }
            for (name, _) in record.leaves() {
                let symbol = graph.find(&name);
                let symbol = symbol.unwrap_or_else(|| graph.symbol(&name, Stage::Rate));
                given.insert(format!("{letter}.{name}"), symbol);
            }
        }
        given
    }

    /// Raw parameters pass through `prepare` unchanged, computed fields under their own names. One
    /// that no statement names is read by kernels, whose claims are about its value.
    fn prepared_row(&self, prepare: &Readings<'g>) -> Comparison {
        let raw = parameters_of(self.chain);
        let mut checked = Vec::new();
        let mut reference = Vec::new();
        for (name, value) in &prepare.cut.returned {
            let given = raw.fields.iter().any(|field| field.name == *name);
            let symbol = if given { self.parameter(name) } else { None };
            checked.push((name.clone(), *value));
            let own = if given { None } else { Some(*value) };
            let expected = symbol.or_else(|| prepare.cut.stands_for(name)).or(own);
            reference.extend(expected.map(|expected| (name.clone(), expected)));
        }
        let heading = ["(record)", "Prepared", "fn prepare returns its values"];
        Comparison::new(&mut Ring::new(self.chain.graph), heading, &checked, &reference)
    }

    /// What is cut in `prepare` is claimed by a kernel: there, too, it must be what it is called.
    fn cut_constants(&self, prepare: &Readings<'g>, cuts: &BTreeSet<String>) -> Comparison {
        let claims = self.kernels.iter().flat_map(|kernel| &kernel.claims);
        let claimed: BTreeMap<_, _> = claims.flat_map(|claim| claim.components.clone()).collect();
        let mut checked = Vec::new();
        let mut reference = Vec::new();
        // What moves is claimed together with the constant share of the hub.
        let parts: Vec<_> = moving().concat();
        for name in cuts.iter().filter(|name| !parts.contains(name)) {
            if let Some(value) = prepare.expanded.values.get(name) {
                checked.push((name.clone(), *value));
                reference.extend(claimed.get(name).map(|expected| (name.clone(), *expected)));
            }
        }
        let heading = ["(constants)", "Prepared", "fn prepare = derivation"];
        Comparison::new(&mut Ring::new(self.chain.graph), heading, &checked, &reference)
    }
}

/// The rows of a kernel's claims, to the first that is sought.
fn claims<'g>(
    ring: &mut Ring<'g>,
    kernel: &Kernel<'g>,
    values: &FxHashMap<String, Expr<'g>>,
    sought: fn(&Comparison) -> bool,
) -> Vec<Comparison> {
    let mut rows = Vec::new();
    for claim in &kernel.claims {
        let mut emitted = Vec::new();
        let mut reference = Vec::new();
        for (name, expected) in &claim.components {
            let value = values.get(name);
            emitted.extend(value.map(|value| (name.clone(), *value)));
            // What is identically zero need not be emitted.
            let zero = ring.normal(*expected).is_ok_and(|normal| normal.is_empty());
            if value.is_some() || !zero {
                reference.push((name.clone(), *expected));
            }
        }
        let claimed = format!("fn {} = derivation", kernel.name);
        let heading = [claim.tag.as_str(), &claim.name, &claimed];
        rows.push(Comparison::new(ring, heading, &emitted, &reference));
        if rows.last().is_some_and(sought) {
            break;
        }
    }
    rows
}

/// The returned record holds the values its fields are named after. Where the text has no such
/// name, the value is the field's own: it must be one that a claim or an identity is about.
fn result<'g>(ring: &mut Ring<'g>, kernel: &Kernel<'g>, back: &Reading<'g>) -> Comparison {
    let claimed: BTreeSet<_> =
        kernel.claims.iter().flat_map(|claim| &claim.components).map(|(name, _)| name).collect();
    // The claims on the whole system read the constant share, the identities the other two.
    let together = ["constant_share", "eliminate", "back_substitute"];
    let together = together.contains(&kernel.name.as_str());
    let mut reference = Vec::new();
    for (field, source) in kernel.output.leaves() {
        let own = back.returned.get(&field).filter(|_| together || claimed.contains(&source));
        let value = back.stands_for(&source).or(own.copied());
        reference.extend(value.map(|value| (field, value)));
    }
    reference.sort_by(|a, b| a.0.cmp(&b.0));
    let checked: Vec<_> =
        back.returned.iter().map(|(name, value)| (name.clone(), *value)).collect();
    let heading =
        ["(record)", &kernel.output.name, &format!("fn {} returns its values", kernel.name)];
    Comparison::new(ring, heading, &checked, &reference)
}
