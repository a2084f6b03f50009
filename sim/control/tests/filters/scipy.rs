//! Against `tests/fixtures/filters.json`, which `tests/engines/filters.py` writes.

use precess_control::{AnalogSection, Discretisation, Filter, Section};
use serde_json::Value;

const FIXTURE: &str =
    include_str!(concat!(env!("CARGO_MANIFEST_DIR"), "/../../tests/fixtures/filters.json"));

/// Of the largest number of a list. `SciPy` expands polynomials of z, which costs low cutoffs some digits.
const AGREEMENT: f64 = 1e-12;

fn number(of: &Value, key: &str) -> f64 {
    of[key].as_f64().unwrap_or_else(|| panic!("no {key} in {of}"))
}

fn numbers(of: &Value) -> Vec<f64> {
    of.as_array().unwrap().iter().map(|value| value.as_f64().unwrap()).collect()
}

fn designed(case: &Value) -> Section {
    let analog = match case["kind"].as_str().unwrap() {
        "butterworth 1" => AnalogSection::low_pass_of_first_order(number(case, "cutoff")),
        "butterworth 2" => AnalogSection::butterworth(number(case, "cutoff")),
        "notch" => {
            let [frequency, zeros, poles] =
                ["frequency", "zeros", "poles"].map(|key| number(case, key));
            AnalogSection::notch(frequency, zeros, poles)
        }
        "lead-lag" => AnalogSection::lead_lag(number(case, "zero"), number(case, "pole")),
        kind => panic!("{kind}"),
    };
    let by = case["prewarped"].as_f64().map_or(Discretisation::Bilinear, Discretisation::Prewarped);
    analog.unwrap().discrete(1.0 / number(case, "rate"), by).unwrap()
}

/// Differences of two lists, in units of the largest number stored.
fn worst(found: &[f64], stored: &[f64]) -> f64 {
    assert_eq!(found.len(), stored.len());
    let size = stored.iter().fold(0.0_f64, |size, value| size.max(value.abs()));
    let differences = found.iter().zip(stored).map(|(a, b)| (a - b).abs() / size);
    differences.fold(0.0, f64::max)
}

#[test]
fn coefficients_states_and_outputs_are_those_of_scipy() {
    let document: Value = serde_json::from_str(FIXTURE).unwrap();
    let input = numbers(&document["input"]);
    let mut largest = [0.0_f64; 3];
    let filters = document["filters"].as_array().unwrap();
    assert_eq!(filters.len(), 66);
    for case in filters {
        let mut section = designed(case);
        let [b0, b1, b2] = section.numerator();
        let [a1, a2] = section.denominator();
        let coefficients = worst(&[b0, b1, b2, 1.0, a1, a2], &numbers(&case["section"]));
        let output: Vec<f64> = input.iter().map(|x| section.filter(*x)).collect();
        let outputs = worst(&output, &numbers(&case["output"]));
        section.settle(1.0);
        // The state is private: two samples of zero show it.
        let first = section.filter(0.0);
        let second = section.filter(0.0) + a1 * first;
        // In units of the input: the sums of coefficients cancel where the cutoff is low.
        let stored = numbers(&case["settled"]);
        let states = (first - stored[0]).abs().max((second - stored[1]).abs());
        for (largest, found) in largest.iter_mut().zip([coefficients, outputs, states]) {
            assert!(found < AGREEMENT, "{case}: {coefficients:e} {outputs:e} {states:e}");
            *largest = largest.max(found);
        }
    }
    println!(
        "coefficients {:.1e}, outputs {:.1e}, settled states {:.1e}",
        largest[0], largest[1], largest[2]
    );
}

#[test]
fn sections_one_after_another_are_those_of_scipy() {
    let document: Value = serde_json::from_str(FIXTURE).unwrap();
    let chain = &document["chain"];
    let sections = chain["sections"].as_array().unwrap().iter().map(|row| {
        let [b0, b1, b2, _, a1, a2] = numbers(row).try_into().unwrap();
        Section::new([b0, b1, b2], [a1, a2]).unwrap()
    });
    let mut filter = Filter::new(sections.collect());
    assert_eq!(filter.sections().len(), 4);
    let output: Vec<f64> =
        numbers(&document["input"]).iter().map(|input| filter.filter(*input)).collect();
    assert!(worst(&output, &numbers(&chain["output"])) < AGREEMENT);
    // A constant input from the settled state has a constant output, and at rest a filter starts anew.
    let settled = filter.settle(0.7);
    for _ in 0..50 {
        assert!((filter.filter(0.7) - settled).abs() < 1e-12 * settled.abs());
    }
    filter.reset();
    let again: Vec<f64> =
        numbers(&document["input"]).iter().map(|input| filter.filter(*input)).collect();
    assert_eq!(again, output);
}
