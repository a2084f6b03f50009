//! Two programs that do the same: read numbers, hand them to every kernel of every kind, write what
//! comes out. One is C over the emitted C, the other Rust over the committed Rust.

use precess_codegen::emit::c::{Signature, function, signatures, tag};
use precess_codegen::kernel::{Record, Source};
use precess_codegen::kinds::{KINDS, Kind};

/// The kernels of one kind and the records that they read, each of which is read once for all.
pub(crate) struct Plan {
    pub(crate) kind: &'static Kind,
    kernels: Vec<Signature>,
    read: Vec<Record>,
}

/// What the programs do, kind by kind.
pub(crate) fn plans() -> Vec<Plan> {
    KINDS.into_iter().map(plan).collect()
}

fn plan(kind: &'static Kind) -> Plan {
    let kernels = signatures(kind).unwrap();
    let mut read: Vec<Record> = Vec::new();
    for (_, record) in kernels.iter().flat_map(|kernel| &kernel.inputs) {
        if !read.iter().any(|known| known.name == record.name) {
            read.push(record.clone());
        }
    }
    Plan { kind, kernels, read }
}

impl Plan {
    /// How many numbers one round of the kind reads.
    pub(crate) fn inputs(&self) -> usize {
        self.read.iter().map(|record| record.fields.len()).sum()
    }

    /// What one round writes: `dgvscmg eliminate share.m_vv_11`.
    pub(crate) fn outputs(&self) -> Vec<String> {
        let of = |kernel: &Signature| {
            let start = format!("{} {} ", self.kind.name, kernel.name);
            places(&kernel.output).into_iter().map(move |place| format!("{start}{place}"))
        };
        self.kernels.iter().flat_map(of).collect()
    }

    /// How many kernels there are.
    pub(crate) fn kernels(&self) -> usize {
        self.kernels.len()
    }
}

/// The numbers of a record, from the outermost field inwards.
fn places(record: &Record) -> Vec<String> {
    let of = |field: &precess_codegen::kernel::Field| match &field.source {
        Source::Nested(inner) => {
            places(inner).into_iter().map(|place| format!("{}.{place}", field.name)).collect()
        }
        Source::Own | Source::Named(_) => vec![field.name.clone()],
    };
    record.fields.iter().flat_map(of).collect()
}

/// The name of the variable that holds a record.
fn variable(record: &Record) -> String {
    format!("in_{}", record.name.to_lowercase())
}

/// What every C program begins with, behind its headers.
const C_START: &str = "\
static double next(void)
{
    double x;

    if (fread(&x, sizeof x, 1, stdin) != 1) {
        exit(2);
    }
    return x;
}

static void give(double x)
{
    if (fwrite(&x, sizeof x, 1, stdout) != 1) {
        exit(3);
    }
}
";

/// The C program: `rounds` of each kind.
pub(crate) fn c(plans: &[Plan], rounds: usize) -> String {
    let headers = plans.iter().map(|plan| format!("precess_{}.h", plan.kind.name));
    let mut lines = ["#include <stdio.h>", "#include <stdlib.h>"].map(str::to_owned).to_vec();
    lines.extend(headers.map(|header| format!("#include \"{header}\"")));
    lines.push(C_START.to_owned());
    for Plan { kind: Kind { name: kind, .. }, kernels, read } in plans {
        lines.push(format!("static void of_{kind}(void)\n{{"));
        let declared = |record| format!("struct {} {};", tag(kind, record), variable(record));
        lines.extend(read.iter().map(declared));
        let found = |k: &Signature| format!("struct {} of_{};", tag(kind, &k.output), k.name);
        lines.extend(kernels.iter().map(found));
        for record in read {
            let name = variable(record);
            lines.extend(record.fields.iter().map(|f| format!("{name}.{} = next();", f.name)));
        }
        for Signature { name, inputs, output } in kernels {
            let call = function(kind, name);
            lines.push(format!("{call}({}, &of_{name});", arguments(inputs)));
            let given = places(output).into_iter().map(|at| format!("give(of_{name}.{at});"));
            lines.extend(given);
        }
        lines.push("}\n".to_owned());
    }
    lines.push("int main(void)\n{\nint k;".to_owned());
    let kinds = plans.iter().map(|plan| plan.kind.name);
    lines.extend(kinds.map(|kind| format!("for (k = 0; k < {rounds}; k++) {{ of_{kind}(); }}")));
    lines.push("return 0;\n}\n".to_owned());
    lines.join("\n")
}

/// What every Rust program begins with.
const RUST_START: &str = "\
use precess_dynamics::generated as g;
use std::io::{Read, Write};
type Next<'a> = &'a mut dyn FnMut() -> f64;
type Give<'a> = &'a mut dyn FnMut(f64);
";

/// What every Rust program reads.
const RUST_READ: &str = "\
fn main() {
let mut bytes = Vec::new();
std::io::stdin().read_to_end(&mut bytes).unwrap();
let mut numbers = bytes.chunks_exact(8).map(|b| f64::from_ne_bytes(b.try_into().unwrap()));
let mut next = || numbers.next().unwrap();
let mut found = Vec::new();
let mut give = |x: f64| found.extend(x.to_ne_bytes());
";

/// The Rust program: likewise.
pub(crate) fn rust(plans: &[Plan], rounds: usize) -> String {
    let mut lines = vec![RUST_START.to_owned()];
    for Plan { kind: Kind { name: kind, .. }, kernels, read } in plans {
        lines.push(format!("fn of_{kind}(next: Next, give: Give) {{"));
        for record in read {
            let module = if record.shared { "hub" } else { kind };
            let fields = record.fields.iter().map(|field| format!("{}: next(), ", field.name));
            let (name, fields) = (&record.name, fields.collect::<String>());
            lines.push(format!("let {} = g::{module}::{name} {{ {fields} }};", variable(record)));
        }
        for Signature { name, inputs, output } in kernels {
            lines.push(format!("let of_{name} = g::{kind}::{name}({});", arguments(inputs)));
            let given = places(output).into_iter().map(|at| format!("give(of_{name}.{at});"));
            lines.extend(given);
        }
        lines.push("}".to_owned());
    }
    lines.push(RUST_READ.to_owned());
    let kinds = plans.iter().map(|plan| plan.kind.name);
    let calls = kinds.map(|kind| format!("of_{kind}(&mut next, &mut give);"));
    lines.extend(calls.map(|call| format!("for _ in 0..{rounds} {{ {call} }}")));
    lines.push("std::io::stdout().write_all(&found).unwrap();\n}\n".to_owned());
    lines.join("\n")
}

/// The variables of these records, each by its address.
fn arguments(inputs: &[(&str, Record)]) -> String {
    let addresses = inputs.iter().map(|(_, record)| format!("&{}", variable(record)));
    addresses.collect::<Vec<_>>().join(", ")
}
