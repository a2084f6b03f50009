//! Spectra of a small record of integers by `welch`, `csd` and `coherence` of `SciPy` 1.17.1, and ours beside them. The
//! arrays are printed by `sim/tests/spectra/scipy_values.py`.

use super::{Detrend, WelchSettings, Window, cross_spectra, psd};

const HANN: [f64; 17] = [
    49.9575626674867,
    133.76431067704067,
    129.06406280306993,
    82.25553416273688,
    58.34076846317396,
    47.057489932592844,
    105.94730383825731,
    101.6012493816525,
    213.3280817143922,
    270.4206837929199,
    134.0547573132257,
    72.5008342519676,
    120.62927929145607,
    47.3650988061312,
    187.85299150814222,
    140.01184849189067,
    54.950387911007304,
];
const FLAT_TOP: [f64; 17] = [
    70.60661844091517,
    125.7367976098465,
    113.34435774204125,
    114.57797763060991,
    98.44370392573502,
    91.51958224672649,
    108.34279360783849,
    146.72487351503113,
    196.2118906280282,
    192.8363473293247,
    146.68574333468314,
    99.96436912764864,
    91.83878058562165,
    113.88195121767423,
    134.65982749294858,
    150.55754094205471,
    68.96018378451139,
];
const ODD: [f64; 17] = [
    38.864684092634015,
    157.02094996031107,
    155.2136888285976,
    86.57553083490319,
    47.57398379139169,
    49.7966819431502,
    110.9953239679169,
    121.54182625280025,
    158.8866968410004,
    213.3780639283985,
    194.82004287851922,
    84.15554320336402,
    121.60832436048591,
    54.61885113096997,
    148.4867774525182,
    115.03848770525127,
    85.01526838803568,
];
const CROSS_RE: [f64; 17] = [
    55.59818099436893,
    144.2011208720348,
    183.85883173673324,
    74.02107211443415,
    -25.153729481251208,
    -23.078735656960607,
    -71.939583233499,
    -37.223595880617125,
    -101.71022016993811,
    -115.80543257394969,
    -50.06566500148429,
    41.24289082204647,
    -55.426024602988925,
    34.23532739479019,
    78.54263605121258,
    58.42119198003501,
    24.28184868466027,
];
const CROSS_IM: [f64; 17] = [
    0.0,
    -37.929826913326686,
    -80.09164580179899,
    -69.2942076986488,
    -94.2151310577958,
    -36.91586482020414,
    42.28105958117622,
    -28.83471492749753,
    7.021610103100115,
    100.84856496007643,
    62.76621485562655,
    89.61697638386988,
    88.67358289412113,
    17.1149181838232,
    118.84919044245171,
    45.113333880770305,
    0.0,
];
const COHERENCE: [f64; 17] = [
    0.9824837003986189,
    0.8874255472368747,
    0.8994817622733537,
    0.4519664959436587,
    0.3831417007869292,
    0.17395695874551967,
    0.4737132822028909,
    0.2984304659281063,
    0.2729401062233084,
    0.5089851839808911,
    0.35549076308406946,
    0.571008547044221,
    0.2551593714871326,
    0.24079715829770912,
    0.6535850741814034,
    0.3608862423025632,
    0.17928733922996357,
];

/// Two transforms of 32 samples, each rounded, by the largest value.
const ROUNDING: f64 = 1e-14;
const RATE: f64 = 12.0;

/// The record, and a second one.
fn record() -> [Vec<f64>; 2] {
    let value = |i: i32| f64::from((i * i * 37 + i * 11) % 101 - 50);
    let x: Vec<f64> = (0..96).map(value).collect();
    let own = |i: i32| f64::from((i * i * 53 + i * 29) % 97 - 48);
    let y = (0..96).map(|i| own(i) + value((i + 94) % 96)).collect();
    [x, y]
}

fn assert_near(found: impl IntoIterator<Item = f64>, expected: &[f64]) {
    let largest = expected.iter().fold(0.0_f64, |most, value| most.max(value.abs()));
    let found: Vec<f64> = found.into_iter().collect();
    assert_eq!(found.len(), expected.len());
    for (bin, (found, expected)) in found.iter().zip(expected).enumerate() {
        let off = (found - expected).abs() / largest;
        assert!(off < ROUNDING, "bin {bin}: {found} for {expected}");
    }
}

#[test]
fn densities_are_those_of_scipy() {
    let [x, _] = record();
    let flat_top = WelchSettings {
        window: Window::FlatTop,
        length: 32,
        overlap: 20,
        detrend: Detrend::Linear,
    };
    let odd = WelchSettings { overlap: 16, ..WelchSettings::hann(33) };
    for (settings, expected) in
        [(WelchSettings::hann(32), &HANN), (flat_top, &FLAT_TOP), (odd, &ODD)]
    {
        assert_near(psd(&x, RATE, &settings).expect("a density").density, expected);
    }
}

#[test]
fn cross_spectrum_and_coherence_are_those_of_scipy() {
    let [x, y] = record();
    let cross = cross_spectra(&[&x, &y], RATE, &WelchSettings::hann(32)).expect("spectra");
    let between = cross.between(0, 1).expect("two signals");
    assert_near(between.iter().map(|value| value.re), &CROSS_RE);
    assert_near(between.iter().map(|value| value.im), &CROSS_IM);
    assert_near(cross.coherence(0, 1).expect("averages"), &COHERENCE);
    assert_near(cross.psd(0).expect("a density").density, &HANN);
}
