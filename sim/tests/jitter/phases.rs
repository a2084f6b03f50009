//! Contributors, sensitivities and cumulative curves by what is assumed of the phases: all of them are of the headline.

use precess::jitter::budget::outputs_of;
use precess::jitter::sensitivity::sensitivities;
use precess::jitter::sweep::Phases;
use precess::jitter::weight::Weight;

use super::cubesat::{files, found, jitter};

/// Step of a central difference of an imbalance, as a share.
const STEP: f64 = 1e-4;
/// What a central difference errs by: the square of the step, and rounding by it.
const DIFFERENCE: f64 = 1e-7;

/// A change of one percent of the static and the dynamic imbalance of a wheel, in percent of the metric, by re-runs.
#[test]
fn sensitivities_are_derivatives_by_the_imbalance_with_the_phases_of_the_budget() {
    for phases in ["unknown", "given", "worst"] {
        let folder = files(&format!("sensitivities-{phases}"), phases);
        let of = found(&folder, &[]);
        let names: Vec<String> = of.sweep.contributors.iter().map(|c| c.rotor.clone()).collect();
        for (index, assessed) in of.assessed.iter().enumerate() {
            let speed = of.sweep.speeds[assessed.worst];
            let ranked = sensitivities(&of.model, &of.budget, assessed, speed, &names);
            let ranked = ranked.expect("a rigid hub");
            for wheel in 1..=3 {
                let value = |factor: f64| {
                    let of_wheel = |key: &str, size: f64, unit: &str| {
                        format!(
                            "device.wheel{wheel}.imbalance.{key} = \"{} {unit}\"",
                            size * factor
                        )
                    };
                    let set = [of_wheel("static", 0.5, "g mm"), of_wheel("dynamic", 5.0, "g mm2")];
                    found(&folder, &set).assessed[index].values[assessed.worst]
                };
                let here = assessed.values[assessed.worst];
                let expected = (value(1.0 + STEP) - value(1.0 - STEP)) / (2.0 * STEP * here);
                let name = format!("amplitude of wheel{wheel}.wheel");
                let of = ranked.iter().find(|of| of.parameter == name).expect("a wheel");
                let error = (of.ratio - expected).abs();
                assert!(
                    error < DIFFERENCE,
                    "{phases}, {index}, {name}: {} for {expected}",
                    of.ratio
                );
            }
        }
        std::fs::remove_dir_all(folder).expect("it was made");
    }
}

/// As a newcomer found by re-runs with one percent more, phases given: their difference is of first order in it.
#[test]
fn sensitivities_of_given_phases_are_those_of_re_runs_with_one_percent_more() {
    let folder = files("re-runs", "given");
    let of = found(&folder, &[]);
    let measured = [(0, [0.734, 0.066, 0.205]), (2, [-0.164, 0.172, 1.002])];
    for (index, of_wheels) in measured {
        let assessed = &of.assessed[index];
        for (wheel, expected) in of_wheels.into_iter().enumerate() {
            let share = assessed.shares.iter().find(|(number, _)| *number == wheel);
            let share = share.expect("a wheel").1;
            assert!((share - expected).abs() < 0.01, "{index}, {wheel}: {share} for {expected}");
        }
        let sum: f64 = assessed.shares.iter().map(|(_, share)| share).sum();
        assert!((sum - 1.0).abs() < 1e-12, "{sum}");
    }
    std::fs::remove_dir_all(folder).expect("it was made");
}

#[test]
fn squares_of_all_frequencies_add_up_to_the_metric() {
    for phases in ["unknown", "given", "worst"] {
        let folder = files(&format!("squares-{phases}"), phases);
        let of = found(&folder, &[]);
        for assessed in &of.assessed {
            let (outputs, weight) = (outputs_of(assessed.sight), Weight::one());
            let squares = of.sweep.squares(assessed.worst, &outputs, of.budget.phases, &weight);
            assert_eq!(squares.len(), 1, "wheels of one speed have one frequency");
            let whole: f64 = squares.iter().map(|(_, square)| square).sum();
            let error = (whole.sqrt() / assessed.margin.value - 1.0).abs();
            assert!(error < 1e-14, "{phases}: {error:e}");
        }
        std::fs::remove_dir_all(folder).expect("it was made");
    }
}

/// The ordinates of a curve in the data of a page: base64 of four bytes each, the lowest first.
fn numbers(text: &str) -> Vec<f32> {
    const LETTERS: &[u8] = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    let place = |letter: u8| LETTERS.iter().position(|of| *of == letter);
    let bits: Vec<bool> = text
        .bytes()
        .map_while(place)
        .flat_map(|six| (0..6).rev().map(move |bit| six >> bit & 1 == 1))
        .collect();
    let bytes =
        bits.chunks_exact(8).map(|byte| byte.iter().fold(0, |sum, bit| 2 * sum + u8::from(*bit)));
    let bytes: Vec<u8> = bytes.collect();
    bytes.chunks_exact(4).map(|of| f32::from_le_bytes(of.try_into().expect("four"))).collect()
}

#[test]
fn cumulative_curves_end_at_the_headline() {
    for phases in [Phases::Unknown, Phases::Given, Phases::Worst] {
        let folder = files(&format!("cumulative-{}", phases.word()), phases.word());
        let of = found(&folder, &[]);
        let (code, shown, notes, page) = jitter(&folder, &[]);
        assert_eq!(code, Some(0), "{notes}");
        let (_, data) = page.split_once("id=\"precess-report\">").expect("a data block");
        let data: serde_json::Value =
            serde_json::from_str(data.split_once("</script>").expect("its end").0).expect("JSON");
        let planes = data["planes"].as_array().expect("charts");
        for (index, assessed) in of.assessed.iter().enumerate() {
            let id = format!("figure-cumulative-{}", index + 1);
            let plane =
                planes.iter().find(|plane| plane["static"] == id.as_str()).expect("a chart");
            let curve = |label: &str| {
                let curves = plane["curves"].as_array().expect("curves");
                let curve = curves.iter().find(|curve| curve["label"] == label).expect("a curve");
                numbers(curve["y"].as_str().expect("numbers"))
            };
            // Arc seconds, as the limit.
            let headline = assessed.margin.value / assessed.limit.unit.1;
            let ends = [curve("from below").last().copied(), curve("from above").first().copied()];
            for end in ends.map(|end| end.expect("a point")) {
                // Numbers of a page have seven digits.
                assert!(
                    (f64::from(end) / headline - 1.0).abs() < 1e-6,
                    "{phases:?}: {end} for {headline}"
                );
            }
        }
        assert!(page.contains(&format!("added with {}", phases.words())), "the caption");
        let largest = of.assessed[0].shares[0].1 * 100.0;
        let part = format!(", order 1), {largest:.0} % {}\n", phases.share());
        assert!(shown.contains(&part), "{part} in:\n{shown}");
        std::fs::remove_dir_all(folder).expect("it was made");
    }
}
