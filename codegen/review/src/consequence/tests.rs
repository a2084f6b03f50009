//! The hand-checked pages run, and print that is made up for the purpose has its consequence.

use super::assembled::Pages;
use super::ledger::Accountant;
use super::run::run;
use super::*;
use precess_codegen::page::PageError;

// The integration tests read the same pages.
#[path = "../../../tests/folder/mod.rs"]
mod folder;

use folder::pages;

/// A printed page of one block that claims to differ.
fn print(heading: &str, body: &str) -> Vec<Page> {
    let text = format!("```printed\n{heading}\n{body}\n```\n\n- `slip`: `a` -> `b`.\n");
    vec![Page { name: "print.md".to_owned(), text }]
}

fn effect(heading: &str, body: &str) -> Effect {
    let found = consequences(&pages(""), &print(heading, body)).unwrap();
    let [Consequence { effect, .. }] = found[..] else { panic!("{found:?}") };
    effect
}

/// (34) with a dot lost, as it is printed.
const PRINTED_34: &str = "i_go_goc*(omega_dot + gamma_o_dot*s_z_hat) + i_go_goc_prime*omega_go_n
    + tilde(omega)*i_go_goc*omega_go_n + m_go*cross(r_goc_b, r_goc_b_ddot)";

#[test]
fn the_right_system_conserves_to_the_integrators_error() {
    let Drift { energy, linear, angular } = floor(&pages("")).unwrap();
    // A hundredth of what counts as a drift, so that it cannot be taken for one; 4e-12 is reached.
    let bound = RESOLUTION / 100.0;
    assert!(energy < bound && linear < bound && angular < bound, "{energy} {linear} {angular}");
}

#[test]
fn the_right_systems_drift_falls_sixteen_fold_per_halved_step() {
    let graph = Graph::new();
    let chain = Chain::new(&graph, &DGVSCMG);
    let right = Pages::read(&graph, &pages("")).unwrap().assembled(&[]).unwrap();
    let mut accountant = Accountant::new(&chain).unwrap();
    // Coarse enough that rounding, 1e-14, is nothing beside it.
    let [coarse, fine] =
        [500, 1000].map(|steps| match run(&graph, &mut accountant, &right, steps).unwrap() {
            Effect::Drift(drift) => drift,
            effect => panic!("{effect}"),
        });
    let ratios = [coarse.linear / fine.linear, coarse.angular / fine.angular];
    // 2^4, the order of the method.
    assert!(ratios.iter().all(|ratio| (14.0..18.0).contains(ratio)), "{ratios:?}");
}

#[test]
fn a_name_that_is_given_its_own_value_leaves_every_expression_as_it_is() {
    let graph = Graph::new();
    let _chain = Chain::new(&graph, &DGVSCMG);
    let texts = pages("");
    let mut pages = Pages::read(&graph, &texts).unwrap();
    let right = pages.assembled(&[]).unwrap();
    for tag in ["(12)", "(14)", "(36)", "(57)", "(81)", "(119)"] {
        let mut stated =
            texts.iter().flat_map(|page| blocks(&page.name, &page.text, "equation").unwrap());
        let block = stated.find(|block| block.tag == tag).unwrap();
        let value = pages.printed(&block).unwrap();
        assert_eq!(pages.assembled(&[(&block.name, value)]).unwrap(), right, "{tag}");
    }
}

#[test]
fn a_form_that_is_right_does_not_enter() {
    let pages = pages("");
    // Every hand-checked block as if it were printed, with a note that claims a slip.
    let printed = pages.iter().map(|Page { name, text }| {
        let text = text.replace("```equation\n", "```printed\n");
        let text = text.replace("\n```\n", "\n```\n\n- `slip`: `a` -> `b`.\n");
        Page { name: name.clone(), text }
    });
    let mut found = consequences(&pages, &printed.collect::<Vec<_>>()).unwrap();
    // A definition gives a symbol its meaning: there is nothing to slip in.
    found.retain(|consequence| consequence.tag != "(definition)");
    assert!(found.len() > 100, "only {} blocks", found.len());
    for Consequence { tag, name, effect, .. } in found {
        assert_eq!(effect, Effect::Unchanged, "{tag} {name}");
    }
}

#[test]
fn a_slip_in_34_enters_through_the_momentum_of_the_outer_gimbal() {
    let slipped = effect("(34) h_go_b_dot: vector along b_x b_y b_z", PRINTED_34);
    let torque = format!(
        "let slipped = {PRINTED_34};
        m_sc*tilde(c)*r_b_n_ddot + h_b_b_dot + slipped + h_gi_b_dot + h_w_b_dot"
    );
    assert_eq!(effect("(75) torque_b: vector along b_x b_y b_z", &torque), slipped);
    let Effect::Drift(drift) = slipped else { panic!("{slipped}") };
    assert!(drift.angular > RESOLUTION && drift.energy > RESOLUTION, "{slipped}");
    assert!(drift.linear < RESOLUTION, "{slipped}");
}

#[test]
fn a_slip_is_carried_on_by_the_first_form_that_uses_it() {
    // (38) reaches (75) by (34); (39), (41) and (43), read later, do not use it.
    let slipped = "2*r_goc_b_dprime";
    let through = format!(
        "let slipped = {slipped};
        i_go_goc*(omega_dot + gamma_o_ddot*s_z_hat) + i_go_goc_prime*omega_go_n
            + tilde(omega)*i_go_goc*omega_go_n + m_go*cross(r_goc_b, slipped)"
    );
    assert_eq!(
        effect("(38) r_goc_b_ddot: vector along b_x b_y b_z", slipped),
        effect("(34) h_go_b_dot: vector along b_x b_y b_z", &through),
    );
}

#[test]
fn equations_15_and_16_carry_a_slip_alike() {
    // The same slip on either side of the same equation.
    let explicit = "r_c_n_ddot - 2*c_dprime + tilde(c)*omega_dot - 2*tilde(omega)*c_prime
        - tilde(omega)*tilde(omega)*c";
    let implicit = "r_b_n_ddot - tilde(c)*omega_dot + 2*c_dprime
        + 2*tilde(omega)*c_prime + tilde(omega)*tilde(omega)*c";
    let [explicit, implicit] = [("(15) r_b_n_ddot", explicit), ("(16) r_c_n_ddot", implicit)]
        .map(|(name, body)| effect(&format!("{name}: vector along b_x b_y b_z"), body));
    let (Effect::Drift(a), Effect::Drift(b)) = (explicit, implicit) else {
        panic!("{explicit}, {implicit}")
    };
    for (a, b) in [(a.energy, b.energy), (a.linear, b.linear), (a.angular, b.angular)] {
        assert!(a > RESOLUTION);
        // Other terms in other order: rounding, far below the two digits that are printed.
        assert!((a - b).abs() < 1e-6 * a, "{a} {b}");
    }
}

#[test]
fn equations_that_determine_nothing_are_singular_from_the_start() {
    let effect = effect("(75) torque_b: vector along b_x b_y b_z", "0*c");
    assert_eq!(effect, Effect::Singular { at: 0.0 });
    assert_eq!(effect.to_string(), "singular after 0.00 s");
}

#[test]
fn a_run_that_blows_up_has_a_time_and_no_figure() {
    // The wheel's rate feeds its own acceleration: it is infinite after 1 / (20 * 52 rad/s).
    let effect = effect("(119) u_w: scalar", "spin_dot - 20*sq(spin)");
    let Effect::Diverges { at } = effect else { panic!("{effect}") };
    assert!((0.0005..0.003).contains(&at), "{at}");
}

#[test]
fn what_table_1_sets_to_zero_vanishes() {
    let effect = effect("(17) f_i: vector along s_x s_y g_z", "f_i + m_w*l_i_x*g_z_hat");
    assert_eq!(effect, Effect::Vanishes);
}

#[test]
#[ignore = "long: `cargo xtask test --all`"]
fn every_block_that_differs_has_its_consequence_beyond_doubt() {
    let found = consequences(&pages(""), &pages("printed")).unwrap();
    assert!(found.len() > 30, "only {} blocks", found.len());
    for Consequence { tag, name, effect, .. } in &found {
        let Effect::Drift(Drift { energy, linear, angular }) = effect else { continue };
        for drift in [*energy, *linear, *angular] {
            // Between the largest of the integrator's errors and the smallest of a slip's figures.
            let doubtful = (RESOLUTION / 10.0..RESOLUTION * 2.0).contains(&drift);
            assert!(!doubtful, "{tag} {name}: {drift:e}");
        }
        // Motor torques act inside: whatever stands for them, the momenta stay.
        if ["(81)", "(88)", "(102)"].contains(&tag.as_str()) {
            assert!(linear.max(*angular) < RESOLUTION && *energy > RESOLUTION, "{tag}: {effect}");
        }
    }
    let of = |tag| found.iter().find(|c| c.tag == tag).unwrap().effect;
    let Effect::Drift(wheel) = of("(14)") else { panic!("{}", of("(14)")) };
    assert!(wheel.energy.min(wheel.linear).min(wheel.angular) > RESOLUTION, "{wheel}");
    assert_eq!(of("(99)"), Effect::Unchanged);
}

#[test]
fn what_cannot_be_followed_is_named_with_its_place() {
    let error = |pages: &[Page], heading: &str, body: &str| {
        consequences(pages, &print(heading, body)).unwrap_err()
    };
    let pages = pages("");
    let unstated = error(&pages, "(1) torque: scalar", "m_b");
    assert_eq!(
        unstated.to_string(),
        "print.md:1: no hand-checked page states `torque`; add its block, or mark this one as a \
         definition"
    );
    let unknown = error(&pages, "(75) torque_b: vector along b_x b_y b_z", "nothing");
    assert!(matches!(unknown, ConsequenceError::Page(PageError { line: 1, .. })), "{unknown}");
    let missing = error(&pages[..1], "(75) torque_b: vector along b_x b_y b_z", "c");
    assert_eq!(missing, ConsequenceError::Missing { name: "r_b_n_ddot" });
    let square = error(&pages, "(119) u_w: scalar", "j_11*sq(spin_dot)");
    assert_eq!(square, ConsequenceError::Symbol { name: "spin_dot".to_owned() });
}
