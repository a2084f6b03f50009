//! The equations as printed: each has its verdict, notes add up to it, mends mend it, and what does
//! not fit together is named with its place.

#[path = "../../tests/folder/mod.rs"]
mod folder;

use std::collections::BTreeSet;

use folder::pages;
use precess_codegen::normal::Term;
use precess_codegen::page::Page;
use precess_codegen::proof::{Comparison, Verdict};
use precess_review::verdict::{Counts, HandChecked, JudgementError, Printed, Verdicts, verdicts};

#[test]
fn every_number_has_its_verdict_and_every_row_holds() {
    let made = verdicts(&pages(""), &pages("printed")).unwrap();
    let numbers: Vec<_> = made.entries.iter().filter_map(|entry| entry.number).collect();
    assert_eq!(numbers, (6..=125).collect::<Vec<_>>());
    let asserted = made.entries.iter().filter(|entry| entry.number.is_none());
    let asserted: Vec<_> = asserted.map(|entry| entry.tag.as_str()).collect();
    assert_eq!(asserted, ["(before 18)", "(before 67)", "(before 96)", "(before 114)"]);
    assert_eq!(failed(made.clone()), []);
    for entry in &made.entries {
        let derived = matches!(entry.hand_checked, HandChecked::Proven(_));
        assert!(derived || entry.printed == Printed::Definition, "{}", entry.tag);
    }
    assert_eq!(made.tally().iter().map(|(_, count)| count).sum::<usize>(), 120);

    // All mends together leave what is torn and nothing else.
    let mended = made.causes.iter().flat_map(|cause| &cause.mended);
    let left = mended.clone().filter(|mended| mended.all > 0);
    let left: BTreeSet<_> = left.map(|mended| (mended.tag.as_str(), mended.all)).collect();
    let torn = [("(14)", 4), ("(17)", 5), ("(49)-(52)", 2), ("(54)", 254), ("(64)", 6)];
    assert_eq!(left, BTreeSet::from(torn));
    assert!(mended.clone().all(|mended| mended.before > mended.all), "each has something to mend");

    // One sign runs through several equations.
    let sign = made.cause('A').unwrap();
    assert_eq!(sign.entries, ["(14)", "(17)", "(49)-(52)", "(64)"]);
    let counts: Vec<_> = sign.mended.iter().map(|m| (m.name.as_str(), m.before, m.alone)).collect();
    let signs = [
        ("r_wc_b_dprime", 29, 21),
        ("f_o", 7, 2),
        ("f_tilde", 22, 19),
        ("i_gi_gic_prime", 7, 3),
        ("i_w_wc_prime", 23, 20),
    ];
    assert_eq!(counts[..5], signs);
}

/// The text of a committed page, its lines joined.
fn document(name: &str) -> String {
    let path = format!("{}/../../docs/{name}", env!("CARGO_MANIFEST_DIR"));
    let text = std::fs::read_to_string(path).unwrap();
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}

#[test]
#[ignore = "long: `cargo xtask test --all`"]
fn errata_and_letter_state_the_counts_of_the_verdicts() {
    let made = verdicts(&pages(""), &pages("printed")).unwrap();
    let counts = made.counts();
    let Counts { numbered, agree, definitions, differing, papers, copys, .. } = counts.clone();
    assert_eq!(numbered, 120);
    assert_eq!(agree + definitions + differing + counts.lost.len(), numbered);
    assert_eq!(papers + copys, differing);
    assert_eq!(
        (&counts.lost[..], &counts.contradicted[..]),
        (&["(60)".into()][..], &["(122)".into()][..])
    );

    let errata = document("errata.md");
    let summary = errata.split("| cause | energy |").nth(1).unwrap();
    let summary = summary.split("## Equation by equation").next().unwrap();
    let rows = summary.matches(" | (").count();
    assert_eq!(rows, papers + counts.asserted + counts.contradicted.len(), "{summary}");
    let slips = made.slips_of('A');
    assert!(made.causes.iter().all(|cause| made.slips_of(cause.letter) <= slips));
    let letter = document("letter.md");
    for (text, stated) in [
        (
            &errata,
            format!("{differing} of the {numbered} equations (6)-(125) differ as read: {papers} "),
        ),
        (
            &errata,
            format!("and {copys} only by losses of the copy. {agree} agree, {definitions} are"),
        ),
        (&errata, format!("Beside them, {} equalities", counts.asserted)),
        (
            &letter,
            format!("Of {numbered} equations, {agree} agree as printed and {definitions} are"),
        ),
        (&letter, format!("{differing} differ as read: {papers} in a way that is, or may be,")),
        (&letter, format!("the paper's, and {copys} only by losses of the copy. (60) is lost")),
        (&letter, format!("{slips} of the {} differences that we count as slips", counts.slips)),
        (&letter, format!("{} sentences share", counts.asserted)),
        (&letter, format!("tell slip from scan in {}.", counts.open.join(", "))),
    ] {
        assert!(text.contains(&stated), "the page does not say: {stated}");
    }
}

/// The verdicts on the pages with `right`, which is there once, replaced by `wrong`.
fn with(right: &str, wrong: &str) -> Result<Verdicts, JudgementError> {
    let mut found = 0;
    let mut changed = |folder: &str| -> Vec<Page> {
        let page = |page: Page| {
            found += page.text.matches(right).count();
            Page { text: page.text.replace(right, wrong), ..page }
        };
        pages(folder).into_iter().map(page).collect()
    };
    let (hand_checked, printed) = (changed(""), changed("printed"));
    assert_eq!(found, 1, "`{right}`");
    verdicts(&hand_checked, &printed)
}

fn failed(verdicts: Verdicts) -> Vec<Comparison> {
    verdicts.rows.into_iter().filter(|row| !row.holds()).collect()
}

/// The one row that fails.
fn one_failed(right: &str, wrong: &str) -> (String, String, Vec<(String, Term)>) {
    let [row] = failed(with(right, wrong).unwrap()).try_into().expect("one row fails");
    let Verdict::Differs(terms) = row.verdict else { panic!("{row}") };
    (format!("{} {}", row.tag, row.name), row.claim, terms)
}

#[test]
#[ignore = "long: `cargo xtask test --all`"]
fn a_wrong_note_fails_its_row_with_its_terms() {
    let note = "`m_gi*l_o_y*g_x_hat` -> `-m_gi*l_o_y*g_x_hat`";
    let (block, claim, terms) = one_failed(note, "`m_gi*l_o_y*g_x_hat` -> `0`");
    assert_eq!((block.as_str(), claim.as_str()), ("(17) f_o", "print = page + notes"));
    assert_eq!(terms.len(), 2);
    assert!(terms.iter().all(|(_, term)| term.to_string().contains("l_o_y*m_gi")), "{terms:?}");
}

#[test]
#[ignore = "long: `cargo xtask test --all`"]
fn a_wrong_mend_fails_its_row_with_what_it_leaves() {
    let (block, claim, terms) = one_failed(&format!("{MEND}l_i + r_wc_w`"), &format!("{MEND}l_i`"));
    assert_eq!((block.as_str(), claim.as_str()), ("(67) r_wc_b", "print, mended = page"));
    assert!(terms.iter().all(|(_, term)| matches!(term, Term::Missing(_))), "{terms:?}");
}

#[test]
#[ignore = "long: `cargo xtask test --all`"]
fn a_slip_of_the_transcription_fails_notes_and_mends() {
    let right = "m_gi*cross(s_y_hat, r_gic_gi) + m_w*((d*st + l_i_z)*s_x_hat)";
    let made = with(right, &format!("{right} + m_w*d*s_y_hat")).unwrap();
    let added = Verdict::Differs(vec![("s_y".to_owned(), Term::Extra("d*m_w".to_owned()))]);
    let rows: Vec<_> = failed(made).into_iter().map(|row| (row.name, row.verdict)).collect();
    assert_eq!(rows, [("f_i".to_owned(), added.clone()), ("f_i".to_owned(), added)]);
}

/// A mend on the page of causes, up to the right piece.
const MEND: &str = "```mend\n(67) r_wc_b\n`r_gic_gi` -> `";

/// What is said of the pages with `right` replaced by `wrong`: a place and a fault.
fn assert_error(right: &str, wrong: &str, page: &str, fault: &str) {
    let message = with(right, wrong).expect_err(fault).to_string();
    let (place, said) = message.split_once(": ").unwrap();
    assert_eq!(place.split(':').next(), Some(page), "{message}");
    assert!(place.split(':').nth(1).unwrap().parse::<usize>().unwrap() > 1, "{message}");
    assert!(said.contains(fault), "{message}");
}

#[test]
fn a_mend_of_what_is_not_printed_is_named() {
    let (page, none) = ("causes.md", "`r_gic_go` occurs 0 times in the block, not once");
    assert_error(MEND, &MEND.replace("gi`", "go`"), page, none);
    let more = |block: &str| format!("{}0`\n```\n\n{MEND}", MEND.replace("(67) r_wc_b", block));
    assert_error(MEND, &more("(67) r_wc"), page, "there is no printed block (67) r_wc;");
    let unnamed = "cause I mends (23) h_b_bc, and no note there names it";
    assert_error(MEND, &more("(23) h_b_bc"), page, unnamed);
}

#[test]
fn a_missing_number_is_named() {
    let page = "3.2.1-hub-outer.md";
    let heading = "### (33) outer gimbal's momentum about B\n";
    assert_error(heading, "", page, "equation (33) has no entry");
    assert_error(heading, &heading.replace("33", "32"), page, "(32) has an entry already");
    let asserted = heading.replace("33", "before 33");
    assert_error(heading, &format!("{asserted}\n{heading}"), page, "(before 33) has no block");
    let heading = "### (before 67) W fixed in B\n";
    assert_error(heading, "", "3.2.4-wheel-system.md", "(before 67) has no entry");
}

#[test]
fn an_equation_that_nobody_derived_is_named() {
    let right = "(before 67) r_wc_b_prime: vector along s_x s_y g_z\ncross(omega_go_b, l_o)";
    let fault = "(before 67) is printed and no hand-checked block states it";
    let wrong = right.replace("(before 67)", "(step)");
    assert_error(right, &wrong, "3.2.4-wheel-system.md", fault);
}

#[test]
fn an_unused_an_unknown_and_a_forgotten_cause_are_named() {
    let right = "## M. Without";
    assert_error(
        right,
        &format!("## X. No\n\nIn short: no.\n\n{right}"),
        "causes.md",
        "no note names cause X",
    );
    let (right, page) = ("(14) has the same square. Cause E.", "3.1b-translation.md");
    let with = |cause: &str| right.replace(" Cause E.", cause);
    assert_error(right, &with(" Cause Z."), page, "cause Z is not on the page of causes");
    assert_error(right, &with(""), page, "the note names a term and no cause");
    assert_error(right, &with(" Cause G."), page, "cause G, which the note names, has no mend");
}

#[test]
#[ignore = "long: `cargo xtask test --all`"]
fn what_is_said_to_agree_must_and_what_is_equal_must_be_said_to() {
    let page = "3.2.4-wheel-system.md";
    let case = "given j_12 = 0, j_13 = 0, j_23 = 0, j_33 = j_22, theta = 0;\nlet j_a";
    assert_error(case, "let j_a", page, "the block is said to agree and differs in 40 terms");
    let agrees = "tilde(omega)*tilde(r_wc_b)*r_wc_b_prime\n```\n\n- `agrees`\n";
    let silent = agrees.replace("- `agrees`\n", "");
    assert_error(agrees, &silent, page, "(74) is equal and no note says `agrees`");
}
