//! Chains that no kind is: joints that slide and joints that turn carry one another, inertias are
//! diagonal or symmetric about another axis. The derivation walks any list, so every proof that a
//! kind gets holds for these.

use precess_codegen::derivation::chain::Chain;
use precess_codegen::emit::{EmittedFile, files};
use precess_codegen::graph::Graph;
use precess_codegen::kinds::{
    Body, Centre, HINGED_PANEL, Inertia, Joint, Kind, Link, Motion, REACTION_WHEEL, SLOSH_MASS,
    Triple, VSCMG,
};
use precess_codegen::proof::{Comparison, Prover, prove_kind};
use precess_codegen::space::Axis;

const PANEL: Link = HINGED_PANEL.links[0];
const SLOSH: Link = SLOSH_MASS.links[0];
const WHEEL: Link = REACTION_WHEEL.links[0];
const ARM: Triple = Triple { symbol: "A", name: "l_a", names: ["l_a_x", "l_a_y", "l_a_z"] };

/// A rigid body that slides along y on a hinged panel.
const SLIDER_ON_A_PANEL: Kind = Kind {
    name: "slider_on_a_panel",
    title: "slider on a panel",
    source: "",
    links: &[
        PANEL,
        Link {
            joint: Joint { motion: Motion::Slide(Axis::Y), origin: ARM, ..SLOSH.joint },
            body: Body {
                title: "slider",
                centre: Centre::On(Axis::Z, "d"),
                inertia: Inertia::Diagonal("i_s"),
                ..SLOSH.body
            },
            assembly: "s",
        },
    ],
};

/// A wheel on a carriage that slides along z.
const WHEEL_ON_A_CARRIAGE: Kind = Kind {
    name: "wheel_on_a_carriage",
    title: "wheel on a carriage",
    source: "",
    links: &[
        Link {
            joint: Joint { motion: Motion::Slide(Axis::Z), ..SLOSH.joint },
            body: Body {
                title: "carriage",
                centre: PANEL.body.centre,
                inertia: Inertia::Full("i_s"),
                ..SLOSH.body
            },
            assembly: "d",
        },
        Link { joint: Joint { origin: ARM, ..WHEEL.joint }, assembly: "w", ..WHEEL },
    ],
};

/// A rotor that is symmetric, but not about the axis of its joint.
const TILTED_ROTOR: Kind = Kind {
    name: "tilted_rotor",
    title: "tilted rotor",
    source: "",
    links: &[Link {
        body: Body { inertia: Inertia::Symmetric(Axis::Z, "j"), centre: Centre::At, ..WHEEL.body },
        ..WHEEL
    }],
};

fn emitted(chain: &Chain<'_>) -> Vec<EmittedFile> {
    files(std::slice::from_ref(chain)).unwrap()
}

#[test]
fn any_chain_of_joints_is_derived_emitted_and_proven() {
    for kind in [&SLIDER_ON_A_PANEL, &WHEEL_ON_A_CARRIAGE, &TILTED_ROTOR] {
        let graph = Graph::new();
        let chain = Chain::new(&graph, kind);
        let rows = prove_kind(&chain, &emitted(&chain)).unwrap();
        let failed: Vec<_> =
            rows.iter().filter(|row| !row.holds()).map(Comparison::to_string).collect();
        assert!(failed.is_empty(), "{}:\n{}", kind.name, failed.join("\n"));
        assert!(rows.len() > 30, "{}: {} rows", kind.name, rows.len());
    }
}

/// Four joints, the inner two of which slide: the mass that slides is a sum that two functions
/// make in another order, and one constant of both.
#[test]
fn a_long_chain_that_begins_with_slides_is_derived_emitted_and_proven() {
    let kind = Kind::builder("rotor_on_bearings", "rotor on bearings")
        .link(Link::sliding("p", "frame", Axis::Y, "eta"))
        .link(Link::sliding("q", "carriage", Axis::Z, "zeta"))
        .link(Link::turning("k", "fork", Axis::Y, "beta"))
        .link(Link::turning("r", "rotor", Axis::X, "phi").centre_on(Axis::Y, "e"))
        .build()
        .unwrap();
    assert_proven(kind);
}

/// A rotor on a fork that slides along three axes and turns about two, within gimbals.
fn soft_rotor(gimbals: &[(&str, &str, Axis, &str)]) -> &'static Kind {
    let mut kind = Kind::builder("soft_rotor", "soft rotor");
    for (letter, title, axis, coordinate) in gimbals {
        kind = kind.link(Link::turning(letter, title, *axis, coordinate).diagonal().centred());
    }
    kind.link(Link::sliding("p", "slide x", Axis::X, "xi").point())
        .link(Link::sliding("q", "slide y", Axis::Y, "eta").point())
        .link(Link::sliding("h", "slide z", Axis::Z, "zeta").point())
        .link(Link::turning("k", "fork", Axis::Y, "beta").point())
        .link(Link::turning("l", "ring", Axis::Z, "lambda").point())
        .link(Link::turning("r", "rotor", Axis::X, "phi").centre_on(Axis::Y, "e"))
        .build()
        .unwrap()
}

fn assert_proven(kind: &'static Kind) {
    let graph = Graph::new();
    let chain = Chain::new(&graph, kind);
    let rows = prove_kind(&chain, &emitted(&chain)).unwrap();
    let failed: Vec<_> =
        rows.iter().filter(|row| !row.holds()).map(Comparison::to_string).collect();
    assert!(failed.is_empty(), "{}", failed.join("\n"));
    assert!(rows.len() > 150, "{} rows", rows.len());
}

/// Eight joints bring more stages of the elimination than a normal form has variables: no identity
/// has the stages of all entries.
#[test]
#[ignore = "long: `cargo xtask test --all`"]
fn chains_of_six_and_eight_joints_are_derived_emitted_and_proven() {
    let gimbals =
        [("a", "outer gimbal", Axis::Z, "alpha"), ("g", "inner gimbal", Axis::Y, "gamma")];
    assert_proven(soft_rotor(&[]));
    assert_proven(soft_rotor(&gimbals));
}

/// Stages from the first to the last, each with the product left out, added, or of another entry.
#[test]
#[ignore = "long: `cargo xtask test --all`"]
fn a_wrong_stage_of_a_long_elimination_is_caught() {
    let graph = Graph::new();
    let chain = Chain::new(&graph, soft_rotor(&[]));
    let right = emitted(&chain);
    let text = &right.iter().find(|file| file.path.ends_with("/soft_rotor.rs")).unwrap().text;
    let mut prover = Prover::new(&chain);
    let done = ["r", "rl", "rlk", "rlkh", "rlkhq"];
    let stages = text.lines().map(str::trim).filter_map(|line| {
        let (name, value) = line.strip_prefix("let ")?.split_once(" = ")?;
        let stage = done.contains(&name.rsplit_once('_')?.1);
        let difference: syn::ExprBinary = syn::parse_str(value.strip_suffix(';')?).ok()?;
        let (before, taken) = (difference.left, difference.right);
        let is_stage = stage && matches!(difference.op, syn::BinOp::Sub(_));
        is_stage.then(|| (line, name, quote::quote!(#before), quote::quote!(#taken)))
    });
    let stages: Vec<_> = stages.collect();
    assert!(stages.len() > 50, "{} stages", stages.len());
    for (number, (line, name, before, taken)) in stages.into_iter().step_by(5).enumerate() {
        let wrong = match number % 3 {
            0 => format!("{before};"),
            1 => format!("{before} + {taken};"),
            _ => format!("{before} - {before} * {before};"),
        };
        let text = text.replace(line, &format!("let {name} = {wrong}"));
        let file = syn::parse_file(&text).unwrap();
        let fails = |row: &Comparison| !row.holds();
        let rows = prover.until(&file, "eliminate", fails).unwrap();
        assert!(rows.iter().any(fails), "{name} = {wrong}");
    }
}

/// The wheel of a balanced kind is recognised only by its names: no sine or cosine of theta is an
/// argument, and every proof holds without one.
#[test]
fn a_rotor_knows_its_angle_unless_it_is_symmetric_about_its_joint() {
    for (kind, known) in
        [(&TILTED_ROTOR, true), (&REACTION_WHEEL, true), (&VSCMG, true)].into_iter().chain([
            (&precess_codegen::kinds::BALANCED_REACTION_WHEEL, false),
            (&precess_codegen::kinds::BALANCED_VSCMG, false),
        ])
    {
        let graph = Graph::new();
        let files = emitted(&Chain::new(&graph, kind));
        let text = &files
            .iter()
            .find(|file| file.path.ends_with(&format!("/{}.rs", kind.name)))
            .unwrap()
            .text;
        assert_eq!(
            text.contains("sin_theta") && text.contains("cos_theta"),
            known,
            "{}",
            kind.name
        );
    }
}

/// Each changed sign or factor of a sliding kernel, and a gain that is left out.
#[test]
fn a_wrong_sliding_kernel_is_caught() {
    let graph = Graph::new();
    let chain = Chain::new(&graph, &SLOSH_MASS);
    let right = emitted(&chain);
    for (good, bad) in [
        ("let arm_s_dx = p.r_s_b_bx + s.x;", "let arm_s_dx = p.r_s_b_bx - s.x;"),
        ("pivot_s: p.m_s,", "pivot_s: p.m_s + p.m_s,"),
        ("let m_vv_11 = p.f_s_bx * gain_s_v1;", "let m_vv_11 = zero;"),
        ("+ p.r_s_b_bz * p.mount_13;", "+ p.r_s_b_bz * p.mount_31;"),
        ("let divisor_s = m.held_s + p.m_s;", "let divisor_s = p.m_s;"),
        ("let recip_s = m.driven_s * divisor_s.recip();", "let recip_s = divisor_s.recip();"),
        ("let free_s = m.given_s + tau_s * recip_s;", "let free_s = tau_s * recip_s;"),
        ("let m_vv_12 = p.f_s_by * gain_s_v1;", "let m_vv_12 = p.m_s;"),
        ("let gain_s_w2 = n_s_by * recip_s;", "let gain_s_w2 = n_s_bz * recip_s;"),
        (" - a.omega_dot_by * e.gain_s_w2", ""),
        ("let n_s_bz = p.f_s_by * reach_bx", "let n_s_bz = p.f_s_by * reach_by"),
        ("let f_s_by = p.m_s * p.mount_21;", "let f_s_by = p.m_s * p.mount_12;"),
        ("gain_s_w3, free_s", "free_s"),
    ] {
        let mut wrong = right.clone();
        let file = wrong.iter_mut().find(|file| file.path.ends_with("/slosh_mass.rs")).unwrap();
        assert!(file.text.contains(good), "{good}");
        file.text = file.text.replace(good, bad);
        let rows = prove_kind(&chain, &wrong);
        assert!(rows.is_err() || rows.unwrap().iter().any(|row| !row.holds()), "{bad}");
    }
}
