//! The derivation, printed: frames, symbols, and every quantity with its number, its equations, its
//! frame and unit, and the emitted function that computes it.

use std::collections::BTreeSet;

use serde::Serialize;

use super::errata::tag_and_case;
use crate::notation::{Accent, Balance, aligned, equation, expression, frame, symbol, terms, unit};
use precess_codegen::derivation::chain::Chain;
use precess_codegen::derivation::chain::framed_value::FramedValue;
use precess_codegen::derivation::quantities::{Quantity, quantities};
use precess_codegen::graph::Expr;
use precess_codegen::kernel::{Kernel, kernels, parameters};
use precess_codegen::normal::{NormalError, Ring};
use precess_codegen::page::{Block, ReadError, numbers};
use precess_codegen::space::ENTRIES;

/// A quantity is written out by components up to this many terms; a longer one is read in its
/// equation or in the emitted code.
const WRITTEN_OUT: usize = 40;

/// What the template is filled with.
#[derive(Serialize)]
pub(super) struct Derivation {
    kind: String,
    frames: Vec<FrameText>,
    /// The axes that are not primitive, by those that are.
    axes: String,
    symbols: Vec<SymbolText>,
    chapters: Vec<ChapterText>,
    functions: Vec<FunctionText>,
}

#[derive(Serialize)]
struct FrameText {
    letter: String,
    title: String,
    axes: String,
    about: String,
    angle: String,
    rate: String,
    arm: String,
}

#[derive(Serialize)]
struct SymbolText {
    latex: String,
    name: String,
    doc: String,
}

#[derive(Serialize)]
struct ChapterText {
    title: String,
    quantities: Vec<QuantityText>,
}

#[derive(Serialize)]
struct QuantityText {
    name: String,
    latex: String,
    numbers: String,
    unit: String,
    axes: String,
    emitted: String,
    forms: Vec<FormText>,
    /// Given, not derived: there is nothing to write out.
    given: bool,
    /// Written out by components, where short.
    components: Option<String>,
    terms: usize,
}

#[derive(Serialize)]
struct FormText {
    tag: String,
    page: String,
    latex: String,
}

#[derive(Serialize)]
struct FunctionText {
    name: String,
    doc: String,
    sections: Vec<String>,
}

/// Why a page cannot be laid out.
#[derive(Debug)]
pub enum NotationError {
    /// A block cannot be set as mathematics.
    Block(String, ReadError),
    /// A quantity has no normal form.
    Normal(String, NormalError),
    /// A quantity has not one unit.
    Unit {
        /// The quantity.
        name: String,
        /// What is wrong.
        what: String,
    },
}

impl std::fmt::Display for NotationError {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Block(place, error) => write!(f, "{place} cannot be set: {error}"),
            Self::Normal(name, error) => write!(f, "`{name}` cannot be written out: {error}"),
            Self::Unit { name, what } => write!(f, "the unit of `{name}`: {what}"),
        }
    }
}

impl std::error::Error for NotationError {}

/// The derivation of a chain beside the blocks that state it by hand.
pub(super) fn derivation(chain: &Chain<'_>, blocks: &[Block]) -> Result<Derivation, NotationError> {
    let all = quantities(chain);
    let kernels = kernels(chain);
    let mut ring = Ring::new(chain.graph);
    let mut chapters: Vec<ChapterText> = Vec::new();
    for quantity in all.iter().filter(|quantity| quantity.chapter.title != "Axes") {
        let text = quantity_text(chain, &mut ring, quantity, blocks, &kernels)?;
        let title = &quantity.chapter.title;
        match chapters.last_mut().filter(|chapter| chapter.title == *title) {
            Some(chapter) => chapter.quantities.push(text),
            None => chapters.push(ChapterText { title: title.clone(), quantities: vec![text] }),
        }
    }
    let functions = kernels.iter().map(|kernel| FunctionText {
        name: kernel.name.clone(),
        doc: kernel.doc.join(" "),
        sections: kernel
            .sections
            .iter()
            .filter(|section| !section.statements.is_empty())
            .map(|section| section.heading.to_string())
            .collect(),
    });
    Ok(Derivation {
        kind: chain.kind.title.to_owned(),
        frames: frames(chain),
        axes: axes(blocks)?,
        symbols: symbols(chain),
        chapters,
        functions: functions.collect(),
    })
}

/// The hub's frame and that of every body.
fn frames(chain: &Chain<'_>) -> Vec<FrameText> {
    let hub = FrameText {
        letter: "\\mathcal{B}".to_owned(),
        title: "hub".to_owned(),
        axes: triad(chain.triad(0)),
        about: String::new(),
        angle: String::new(),
        rate: String::new(),
        arm: String::new(),
    };
    let bodies = chain.kind.links.iter().enumerate().map(|(k, link)| {
        let carrier = chain.triad(k);
        let axis = carrier[link.joint.motion.axis().cycle()[0]];
        FrameText {
            letter: frame(link.body.frame).unwrap_or_default().to_owned(),
            title: link.body.title.to_owned(),
            axes: triad(link.body.triad),
            about: math(&symbol(&format!("{axis}_hat"), Accent::Plain)),
            angle: math(&symbol(link.joint.coordinate, Accent::Plain)),
            rate: math(&symbol(link.joint.rate, Accent::Plain)),
            arm: math(&symbol(link.joint.origin.name, Accent::Plain)),
        }
    });
    std::iter::once(hub).chain(bodies).collect()
}

/// The unit vectors that a page defines, in one display.
fn axes(blocks: &[Block]) -> Result<String, NotationError> {
    let defined = blocks.iter().filter(|block| block.name.ends_with("_hat"));
    let line = |block: &Block| {
        let place = format!("{}:{}", block.page, block.line);
        let set =
            expression("", &block.body).map_err(|error| NotationError::Block(place, error))?;
        Ok(format!("{} ={{}}& {set}", symbol(&block.name, Accent::Plain)))
    };
    let lines = defined.map(line).collect::<Result<Vec<_>, _>>()?;
    Ok(aligned(&lines))
}

fn triad(axes: [&str; 3]) -> String {
    let hats = axes.map(|axis| symbol(&format!("{axis}_hat"), Accent::Plain));
    math(&hats.join(", "))
}

fn math(latex: &str) -> String {
    format!("${latex}$")
}

/// The parameters of the device.
fn symbols(chain: &Chain<'_>) -> Vec<SymbolText> {
    let fields = parameters(chain.kind).fields.into_iter();
    fields
        .map(|field| SymbolText {
            latex: symbol(&field.name, Accent::Plain),
            doc: field.doc.split_once(": ").map_or(field.doc.as_str(), |(_, what)| what).to_owned(),
            name: field.name,
        })
        .collect()
}

fn quantity_text<'g>(
    chain: &Chain<'g>,
    ring: &mut Ring<'g>,
    quantity: &Quantity<'g>,
    blocks: &[Block],
    kernels: &[Kernel<'g>],
) -> Result<QuantityText, NotationError> {
    let name = &quantity.name;
    let latex = symbol(name, Accent::Plain);
    let stated: Vec<_> = blocks.iter().filter(|block| block.name == *name).collect();
    let form = |block: &&Block| {
        let place = format!("{}:{}", block.page, block.line);
        let set =
            equation(&latex, &block.body).map_err(|error| NotationError::Block(place, error))?;
        Ok(FormText { tag: tag_and_case(block), page: block.page.clone(), latex: set })
    };
    let forms = stated.iter().map(form).collect::<Result<Vec<_>, _>>()?;
    let named = stated.iter().flat_map(|block| numbers(&block.tag)).filter(|named| named.numbered);
    let named: BTreeSet<u16> = named.map(|named| named.number).collect();
    let named: Vec<_> = named.iter().map(|number| format!("({number})")).collect();
    let (components, terms) = written_out(chain, ring, quantity)?;
    Ok(QuantityText {
        numbers: named.join(", "),
        unit: unit_of(quantity)?,
        axes: axes_of(chain, quantity.value),
        emitted: emitted(chain, quantity, &stated, kernels),
        components: (terms <= WRITTEN_OUT).then_some(components),
        given: stated.iter().any(|block| block.tag == "(definition)"),
        name: name.clone(),
        latex,
        forms,
        terms,
    })
}

/// The unit that all components have.
fn unit_of(quantity: &Quantity<'_>) -> Result<String, NotationError> {
    let wrong = |what: String| NotationError::Unit { name: quantity.name.clone(), what };
    let mut all = Balance::Any;
    for component in quantity.value.components() {
        all = all.with(unit(component).map_err(|name| wrong(format!("`{name}` has no unit")))?);
    }
    match all {
        Balance::Is(unit) => Ok(unit.to_string()),
        Balance::Any => Ok("zero".to_owned()),
        Balance::Not => Err(wrong("terms of two units are added".to_owned())),
    }
}

fn axes_of(chain: &Chain<'_>, value: FramedValue<'_>) -> String {
    value.frame().map(|frame| triad(chain.triad(frame))).unwrap_or_default()
}

/// The components as an aligned display, and how many terms they have.
fn written_out<'g>(
    chain: &Chain<'g>,
    ring: &mut Ring<'g>,
    quantity: &Quantity<'g>,
) -> Result<(String, usize), NotationError> {
    let labels: Vec<String> = match quantity.value {
        FramedValue::Scalar(_) => vec![String::new()],
        FramedValue::Vector(_, frame) => chain.triad(frame).map(hat).to_vec(),
        FramedValue::Tensor(..) => ENTRIES.map(|entry| format!("{{}}_{{{entry}}}")).to_vec(),
    };
    let mut shown = Vec::new();
    let mut count = 0;
    for (label, component) in labels.into_iter().zip(quantity.value.components()) {
        let (lines, terms) = component_lines(ring, component)
            .map_err(|error| NotationError::Normal(quantity.name.clone(), error))?;
        count += terms;
        let mut lines = lines.into_iter();
        let first = lines.next().unwrap_or_default();
        let colon = if label.is_empty() { "" } else { ":\\quad" };
        shown.push(format!("{label}{colon}& {first}"));
        shown.extend(lines.map(|line| format!("& {line}")));
    }
    Ok((aligned(&shown), count))
}

fn hat(axis: &str) -> String {
    symbol(&format!("{axis}_hat"), Accent::Plain)
}

fn component_lines<'g>(
    ring: &mut Ring<'g>,
    component: Expr<'g>,
) -> Result<(Vec<String>, usize), NormalError> {
    let normal = ring.normal(component)?;
    // A long one is only counted.
    let lines = if normal.len() > WRITTEN_OUT { Vec::new() } else { terms(ring, &normal) };
    Ok((lines, normal.len()))
}

/// Where the emitted code computes a quantity: by its name, else by its number, else where the
/// equation is that it goes into.
fn emitted<'g>(
    chain: &Chain<'g>,
    quantity: &Quantity<'g>,
    stated: &[&Block],
    kernels: &[Kernel<'g>],
) -> String {
    let name = &quantity.name;
    let tags: Vec<_> = chain.kind.links.iter().map(|link| link.joint.tag).collect();
    let by_name = |claim: &str| {
        claim == name
            || claim
                .strip_prefix(&format!("{name}_"))
                .is_some_and(|rest| rest == "rest" || tags.contains(&rest))
    };
    let mut found = claims(kernels, |_, claim| by_name(claim));
    let numbered = |tag: &str| tag != "(step)" && stated.iter().any(|block| block.tag == tag);
    if !found.is_empty() {
        return format!("Computed by {}", found.join("; "));
    }
    found = claims(kernels, |tag, _| numbered(tag));
    if !found.is_empty() {
        return format!(
            "Not computed by itself; one device's share of it, or its part, by {}",
            found.join("; ")
        );
    }
    match quantity.chapter.goes_into.as_str() {
        "" => "Computed by the solver itself".to_owned(),
        equations => format!("Not computed by itself: it goes into {equations}"),
    }
}

/// `fn` and names of the claims that fit: of a vector its own, of a scalar the emitted one.
pub(super) fn claims(kernels: &[Kernel<'_>], fits: impl Fn(&str, &str) -> bool) -> Vec<String> {
    let of_kernel = |kernel: &Kernel<'_>| {
        let names = kernel.claims.iter().filter(|claim| fits(&claim.tag, &claim.name));
        let names = names.map(|claim| match &claim.components[..] {
            [(emitted, _)] => format!("`{emitted}`"),
            _ => format!("`{}`", claim.name),
        });
        let names: Vec<_> = names.collect();
        (!names.is_empty()).then(|| format!("`fn {}`: {}", kernel.name, names.join(", ")))
    };
    kernels.iter().filter_map(of_kernel).collect()
}
