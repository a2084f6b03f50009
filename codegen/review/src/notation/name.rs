//! Code names to the paper's symbols: `quantity_of_wrt_derivative_component`.

/// What is above the letter of a quantity.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Accent {
    /// Nothing but what the name itself says.
    Plain,
    /// The tensor of the cross product.
    Tilde,
}

/// The symbol of a name, in LaTeX; a name of a page's own is set upright.
#[must_use]
pub fn symbol(name: &str, accent: Accent) -> String {
    if let Some(axis) = name.strip_suffix("_hat").and_then(|rest| rest.split_once('_')) {
        let hat = format!("\\hat{{{}}}", axis.0);
        let hat = if accent == Accent::Tilde { format!("\\tilde{{{hat}}}") } else { hat };
        return format!("{hat}_{{{}}}", axis.1);
    }
    if let Some((function, angle)) =
        name.split_once('_').filter(|(f, _)| ["sin", "cos"].contains(f))
    {
        return format!("\\mathrm{{{}}}\\,{}", &function[..1], symbol(angle, Accent::Plain));
    }
    let (stem, derivative) = derivative(name);
    let parts: Vec<&str> = stem.split('_').collect();
    let made = joint(&parts).or_else(|| motion(&parts)).or_else(|| mass(&parts));
    let Some(Symbol { before, letter, below, bracket }) = made else {
        return format!("\\mathrm{{{}}}", name.replace('_', "\\_"));
    };
    let letter = match (accent, derivative) {
        (Accent::Tilde, Dot(dots)) if !dots.is_empty() => format!("\\tilde{{{dots}{{{letter}}}}}"),
        (Accent::Tilde, _) => format!("\\tilde{{{letter}}}"),
        (Accent::Plain, Dot(dots)) if !dots.is_empty() => format!("{dots}{{{letter}}}"),
        (Accent::Plain, _) => letter,
    };
    let primes = if let Prime(primes) = derivative { primes } else { "" };
    let below = if below.is_empty() { String::new() } else { format!("_{{{below}}}") };
    if bracket {
        return format!("[{before}{letter}{below}]{primes}");
    }
    format!("{before}{letter}{primes}{below}")
}

/// The parts of a symbol.
struct Symbol {
    /// A raised index before the letter.
    before: &'static str,
    letter: String,
    below: String,
    /// Whether it is in brackets: a tensor.
    bracket: bool,
}

fn plain(letter: &str, below: impl Into<String>) -> Symbol {
    Symbol { before: "", letter: letter.to_owned(), below: below.into(), bracket: false }
}

#[derive(Clone, Copy)]
enum Derivative {
    Dot(&'static str),
    Prime(&'static str),
}
use Derivative::{Dot, Prime};

fn derivative(name: &str) -> (String, Derivative) {
    let endings = [
        ("ddot", Dot("\\ddot")),
        ("dot", Dot("\\dot")),
        ("dprime", Prime("''")),
        ("prime", Prime("'")),
    ];
    let parts: Vec<&str> = name.split('_').collect();
    for (ending, derivative) in endings {
        // A component may follow: `r_wc_b_dprime_gix`.
        if let Some(place) = parts.iter().position(|part| *part == ending) {
            let rest: Vec<_> = [&parts[..place], &parts[place + 1..]].concat();
            return (rest.join("_"), derivative);
        }
    }
    (name.to_owned(), Dot(""))
}

/// Angles, rates and motor torques.
fn joint(parts: &[&str]) -> Option<Symbol> {
    Some(match parts {
        ["gamma", "o"] => Symbol { before: "{}^{o}", ..plain("\\gamma", "") },
        ["gamma", "i"] => Symbol { before: "{}^{i}", ..plain("\\gamma", "") },
        ["gamma"] => plain("\\gamma", ""),
        ["phi"] => plain("\\varphi", ""),
        ["theta"] => plain("\\theta", ""),
        ["x" | "y" | "z"] => plain(parts[0], ""),
        ["tilt", axis] => plain("\\vartheta", *axis),
        ["spin"] => plain("\\Omega", ""),
        ["u", "o"] => plain("u", "z"),
        ["u", "i"] => plain("u", "y"),
        ["u", "w"] => plain("u", "x"),
        ["u", joint @ ("g" | "p" | "s" | "sx" | "sy" | "sz" | "ty" | "tz")] => plain("u", *joint),
        _ => return None,
    })
}

/// Positions, angular velocities, momenta and torques.
fn motion(parts: &[&str]) -> Option<Symbol> {
    Some(match parts {
        ["r", rest @ ..] if rest.len() >= 2 => place(rest)?,
        [first, _, ..] if point(first).is_some() && place(parts).is_some() => place(parts)?,
        ["omega"] => plain("\\omega", ""),
        ["omega", component] => plain("\\omega", axis(component)?),
        ["omega", of, wrt, rest @ ..] => {
            let frames = format!("{}/{}", frame(of)?, frame(wrt)?);
            plain("\\omega", with_axis(frames, rest)?)
        }
        ["alpha", of] => plain("\\alpha", frame(of)?),
        // The device's axes in the hub.
        ["mount", entry] => plain("\\mathcal{B}", *entry),
        ["h", of, wrt] => plain("H", format!("{},{}", point(of)?, point(wrt)?)),
        ["l", arm @ ("o" | "i" | "g")] => plain(&format!("L^{{{arm}}}"), ""),
        ["l", arm @ ("o" | "i" | "g"), component] => plain(&format!("L^{{{arm}}}"), *component),
        ["torque" | "l", of] => plain("L", point(of)?),
        ["force"] => plain("F", ""),
        ["c"] => plain("c", ""),
        ["f", "tilde"] => plain("\\tilde f", ""),
        ["f", joint @ ("o" | "i" | "w" | "g" | "p" | "s")] => plain("f", *joint),
        ["d" | "p" | "q" | "r"] => plain(parts[0], ""),
        ["wheel", component] => plain("w", *component),
        _ => return None,
    })
}

/// Masses, their ratios and inertias.
fn mass(parts: &[&str]) -> Option<Symbol> {
    let tensor = |of: &str, wrt: &str| {
        Some(Symbol { bracket: true, ..plain("I", format!("{},{}", point(of)?, centre(wrt)?)) })
    };
    Some(match parts {
        ["m", of] => plain("m", point(of)?),
        ["rho", "go"] => Symbol { before: "{}^{o}", ..plain("\\rho", "") },
        ["rho", "gi", of] => Symbol { before: "{}^{i}", ..plain("\\rho", point(of)?) },
        ["rho", "w", of] => Symbol { before: "{}^{w}", ..plain("\\rho", point(of)?) },
        ["j", entry] => plain("J", *entry),
        ["t", entry] => plain("t", *entry),
        ["i", entry] if entry.starts_with(char::is_numeric) => plain("I", *entry),
        ["i", of, entry] if entry.starts_with(char::is_numeric) => {
            plain("I", format!("{},{entry}", point(of)?))
        }
        ["i", of, wrt] => tensor(of, wrt)?,
        _ => return None,
    })
}

/// `r_{of/wrt}`, with an axis where one component is meant.
fn place(parts: &[&str]) -> Option<Symbol> {
    let [of, wrt, rest @ ..] = parts else { return None };
    let points = format!("{}/{}", centre(of)?, point(wrt)?);
    Some(plain("r", with_axis(points, rest)?))
}

fn with_axis(below: String, rest: &[&str]) -> Option<String> {
    match rest {
        [] => Some(below),
        [component] => Some(format!("{below},{}", axis(component)?)),
        _ => None,
    }
}

/// `bx`, `gix`: the axis only, for the frame is in the table of symbols.
fn axis(component: &str) -> Option<&str> {
    let (frame, axis) = component.split_at_checked(component.len().checked_sub(1)?)?;
    let known =
        ["b", "go", "gi", "g", "w", "p", "s"].contains(&frame) && ["x", "y", "z"].contains(&axis);
    known.then_some(axis)
}

/// Points that cannot be of the spacecraft as a whole: there, `sc` is the slosh mass's centre.
fn centre(name: &str) -> Option<&'static str> {
    if name == "sc" { Some("S_c") } else { point(name) }
}

/// Points and bodies.
fn point(name: &str) -> Option<&'static str> {
    Some(match name {
        "b" => "B",
        "bc" => "B_c",
        "go" => "G^o",
        "goc" => "G^o_c",
        "gi" => "G^i",
        "gic" => "G^i_c",
        "g" => "G",
        "gc" => "G_c",
        "p" => "P",
        "pc" => "P_c",
        "s" => "S",
        // Bearings.
        "sx" => "S_x",
        "sy" => "S_y",
        "sz" => "S_z",
        "ty" => "T_y",
        "tz" => "T_z",
        "w" => "W",
        "wc" => "W_c",
        "d" => "D",
        "dc" => "D_c",
        "v" => "V",
        "vc" => "V_c",
        "c" => "C",
        "n" => "N",
        "sc" => "sc",
        _ => return None,
    })
}

/// The letter of a frame, in LaTeX.
#[must_use]
pub fn frame(name: &str) -> Option<&'static str> {
    Some(match name {
        "b" => "\\mathcal{B}",
        "go" => "\\mathcal{G}^o",
        "gi" => "\\mathcal{G}^i",
        "g" => "\\mathcal{G}",
        "p" => "\\mathcal{P}",
        "s" => "\\mathcal{S}",
        "sx" => "\\mathcal{S}_x",
        "sy" => "\\mathcal{S}_y",
        "sz" => "\\mathcal{S}_z",
        "ty" => "\\mathcal{T}_y",
        "tz" => "\\mathcal{T}_z",
        "w" => "\\mathcal{W}",
        "n" => "\\mathcal{N}",
        _ => return None,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::notation::{Balance, unit};
    use precess_codegen::derivation::chain::Chain;
    use precess_codegen::derivation::quantities::quantities;
    use precess_codegen::graph::Graph;
    use precess_codegen::kernel::{joint_accelerations, motors, parameters, pose, rates};
    use precess_codegen::kinds::{DGVSCMG, KINDS};
    use rustc_hash::FxHashSet;

    #[test]
    fn names_are_the_papers_symbols() {
        for (name, latex) in [
            ("r_wc_b_dprime", "r''_{W_c/B}"),
            ("r_c_n_ddot_bx", "\\ddot{r}_{C/N,x}"),
            ("gamma_o_ddot", "{}^{o}\\ddot{\\gamma}"),
            ("spin_dot", "\\dot{\\Omega}"),
            ("omega_gi_n", "\\omega_{\\mathcal{G}^i/\\mathcal{N}}"),
            ("i_w_wc_prime", "[I_{W,W_c}]'"),
            ("i_go_12", "I_{G^o,12}"),
            ("h_sc_b_dot", "\\dot{H}_{sc,B}"),
            ("l_i_z", "L^{i}_{z}"),
            ("l_gi", "L_{G^i}"),
            ("sin_gamma_i", "\\mathrm{s}\\,{}^{i}\\gamma"),
            ("s_x_hat", "\\hat{s}_{x}"),
            ("gic_go", "r_{G^i_c/G^o}"),
            ("rho_gi_d", "{}^{i}\\rho_{D}"),
            ("m_sc", "m_{sc}"),
            ("nonsense_name", "\\mathrm{nonsense\\_name}"),
        ] {
            assert_eq!(symbol(name, Accent::Plain), latex, "{name}");
        }
        assert_eq!(symbol("s_z_hat", Accent::Tilde), "\\tilde{\\hat{s}}_{z}");
        assert_eq!(symbol("r_wc_b_prime", Accent::Tilde), "\\tilde{r}'_{W_c/B}");
    }

    #[test]
    fn every_quantity_and_every_symbol_has_its_own() {
        let graph = Graph::new();
        let chain = Chain::new(&graph, &DGVSCMG);
        let derived = quantities(&chain).into_iter().map(|quantity| quantity.name);
        for name in derived {
            let latex = symbol(&name, Accent::Plain);
            assert!(!latex.starts_with("\\mathrm"), "{name} is set as {latex}");
        }
    }

    /// What `regen` prints of a kind: parameters, pose, rates, drives, accelerations, origins.
    #[test]
    fn every_symbol_of_every_kind_has_its_own_and_a_unit() {
        for kind in KINDS {
            let graph = Graph::new();
            let chain = Chain::new(&graph, kind);
            let pose = pose(kind).into_iter().map(|(_, record)| record);
            let records = pose.chain([
                parameters(kind),
                rates(kind),
                motors(kind),
                joint_accelerations(kind),
            ]);
            let mut seen = FxHashSet::default();
            for field in records.flat_map(|record| record.fields) {
                let latex = symbol(&field.name, Accent::Plain);
                let upright = latex.starts_with("\\mathrm") && !latex.starts_with("\\mathrm{s}\\,");
                let upright = upright && !latex.starts_with("\\mathrm{c}\\,");
                assert!(!upright, "{}: {} is set as {latex}", kind.name, field.name);
                assert!(seen.insert(latex), "{}: {} is not the only one", kind.name, field.name);
                let known = unit(graph.find(&field.name).unwrap());
                let Ok(Balance::Is(unit)) = known else { panic!("{}: {known:?}", field.name) };
                // The emitted text states the same unit, sines and cosines apart.
                let stated = field.doc.ends_with(&format!(", {unit}."));
                let angle = ["sin_", "cos_"].iter().any(|start| field.name.starts_with(start));
                assert!(stated || angle, "{}: {}: {unit}", kind.name, field.doc);
            }
            for link in chain.kind.links {
                for name in [link.joint.origin.name, link.joint.coordinate] {
                    assert!(!symbol(name, Accent::Plain).starts_with("\\mathrm"), "{name}");
                }
                assert!(frame(link.body.frame).is_some(), "{}", link.body.frame);
            }
        }
    }
}
