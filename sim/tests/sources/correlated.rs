//! Noise that components share, against the cross-spectra of its own functions of time; sources of a layout; sources that act
//! for a time.

use std::f64::consts::TAU;

use nalgebra::Complex;
use precess::disturbance::{Broadband, CoherentPair, Model};
use precess::spectra::{Detrend, WelchSettings, Window, cross_spectra};

use super::{WHEEL, column, errors, last, ran, read, read_back};

const RATE: f64 = 400.0;
/// Of spectra over 300 segments and 32 bins, of which Hann's window leaves n = 6400 independent, the squared coherence has a
/// standard deviation of `sqrt(2) (1 - g²) g / sqrt n`, 0.007 at its worst (Bendat and Piersol, Random Data, 9.2): three times.
const COHERENCE: f64 = 0.02;
/// The phase has `sqrt(1 - g²) / (g sqrt(2 n))`, 0.014 rad at a coherence of 0.3: three times.
const PHASE: f64 = 0.042;
/// A density has `1 / sqrt n`, 1.3 %: three times.
const DENSITY: f64 = 0.04;

/// Six components, three pairs; force x and moment z each share noise with force y, and none with each other.
fn noise() -> Broadband {
    let pair = |components, coherence: f64, phase: f64| CoherentPair {
        components,
        coherence: vec![coherence],
        phase: vec![phase],
    };
    Broadband {
        band: [10.0, 80.0],
        period: 150.0,
        frequencies: Vec::new(),
        densities: [1.0, 2.0, 0.5, 1.0, 4.0, 1.0].map(|density| vec![density]),
        reference_rate: None,
        pairs: vec![pair([1, 5], 0.6, 2.0), pair([2, 4], 0.3, -0.7), pair([0, 1], 0.3, 0.0)],
    }
}

#[test]
fn noise_has_the_cross_spectra_that_were_put_in() {
    let noise = noise();
    noise.check().expect("a cross-spectral matrix");
    let of_time = noise.realise(7, "rw");
    // A whole period: 60000 samples, 300 segments of half a second.
    let mut signals = vec![Vec::new(); 6];
    for k in 0..60_000_u32 {
        let six = of_time.at(f64::from(k) / RATE, 0.0);
        signals.iter_mut().zip(six).for_each(|(signal, value)| signal.push(value));
    }
    let views: Vec<&[f64]> = signals.iter().map(Vec::as_slice).collect();
    let settings =
        WelchSettings { window: Window::Hann, length: 200, overlap: 0, detrend: Detrend::None };
    let found = cross_spectra(&views, RATE, &settings).expect("signals");
    // Bins of 2 Hz, from 14 to 76 Hz: two bins of Hann's window from the ends of the band.
    let bins: Vec<usize> = (7..=38).collect();
    let count = f64::from(u32::try_from(bins.len()).expect("few bins"));
    let mean = |i: usize, j: usize| -> Complex<f64> {
        let density = found.between(i, j).expect("six signals");
        bins.iter().map(|bin| density[*bin]).sum::<Complex<f64>>() / count
    };
    for (i, density) in noise.densities.iter().enumerate() {
        let own = mean(i, i).re;
        assert!((own / density[0] - 1.0).abs() < DENSITY, "{i}: {own} for {}", density[0]);
    }
    for i in 0..6 {
        for j in i + 1..6 {
            let pair = noise.pairs.iter().find(|pair| pair.components == [i, j]);
            let value = mean(i, j);
            let coherence = value.norm_sqr() / (mean(i, i).re * mean(j, j).re);
            let expected = pair.map_or(0.0, |pair| pair.coherence[0]);
            assert!((coherence - expected).abs() < COHERENCE, "{i} {j}: {coherence} {expected}");
            if let Some(pair) = pair {
                let apart = (value.arg() - pair.phase[0]).rem_euclid(TAU);
                assert!(apart.min(TAU - apart) < PHASE, "{i} {j}: {}", value.arg());
            }
        }
    }
    // Components without a pair have the noise that they have without pairs.
    let alone = Broadband { pairs: Vec::new(), ..noise.clone() };
    assert_eq!(noise.lines(3, 7, "rw"), alone.lines(3, 7, "rw"));
    assert_ne!(noise.lines(5, 7, "rw"), alone.lines(5, 7, "rw"));
    assert_ne!(noise.lines(5, 7, "rw"), noise.lines(5, 8, "rw"));
}

/// Coherence of one and a phase of half a turn: what two components do is opposite at any time.
#[test]
#[ignore = "long: `cargo xtask test --all`"]
fn components_that_share_all_their_noise_are_one_function_of_time() {
    let text = format!(
        "{WHEEL}[[source]]\nname = \"noise\"\non = \"rw\"\nseed = 3\n[source.broadband]\nband = \"5, 50 Hz\"\n\
         force_y = \"1 N^2/Hz\"\nmoment_z = \"4 N^2 m^2/Hz\"\n[[source.broadband.coherent]]\n\
         between = [\"force_y\", \"moment_z\"]\ncoherence = 1\nphase = \"180 deg\"\n"
    );
    read_back(&text);
    let (_, samples) = ran(&read(&text));
    let force = column(&samples, "source_noise.force_y");
    let moment = column(&samples, "source_noise.moment_z");
    let largest = force.iter().fold(0.0_f64, |most, value| most.max(value.abs()));
    assert!(largest > 1.0);
    for (f, m) in force.iter().zip(&moment) {
        assert!((2.0 * f + m).abs() < 1e-6 * largest, "{f} {m}");
    }
    let wrong = |from: &str, to: &str| errors(&text.replace(from, to));
    assert!(wrong("coherence = 1", "coherence = 2").contains("from 0 to 1"));
    assert!(wrong("\"moment_z\"]", "\"moment_y\"]").contains("no density"));
    assert!(wrong("\"moment_z\"]", "\"torque\"]").contains("moment_z"));
}

#[test]
fn a_source_on_a_layout_is_one_on_each_of_its_devices() {
    let text = "format = 1\n[hub]\nmass = \"96 kg\"\ninertia = \"30, 40, 50 kg m^2\"\n[[device]]\nname = \"rw\"\n\
        kind = \"reaction_wheel\"\nlayout.pyramid = { count = 3, half_angle = \"50 deg\", radius = \"20 cm\" }\n\
        [device.wheel]\nmass = \"4 kg\"\ninertia = \"0.2, 0.1, 0.1 kg m^2\"\nrate = \"50 rad/s\"\n\
        [[source]]\nname = \"bearing\"\non = \"rw\"\nseed = 4\nharmonic = [{ number = 2.5, axial_force = \"1 g cm\" }]\n\
        [[source]]\nname = \"web\"\non = \"rw.wheel\"\nwheel = \"rw.wheel\"\nseed = 4\n\
        harmonic = [{ number = 3.5, axial_force = \"1 g cm\" }]\n[run]\nduration = \"0.1 s\"\n";
    let scenario = read(text);
    let names: Vec<&str> = scenario.disturbances.iter().map(|of| of.name.as_str()).collect();
    assert_eq!(names, ["bearing1", "bearing2", "bearing3", "web1", "web2", "web3"]);
    let wheels: Vec<_> = scenario.disturbances.iter().map(|of| of.wheel).collect();
    assert_eq!(wheels, [Some(0), Some(1), Some(2), Some(0), Some(1), Some(2)]);
    let phase = |index: usize| match &scenario.disturbances[index].model {
        Model::Harmonic(tones) => tones[0].phases[0],
        _ => f64::NAN,
    };
    // One seed, and phases of their own; the same in another reading.
    assert!(phase(0) != phase(1) && phase(1) != phase(2) && phase(0) != phase(2));
    assert_eq!(scenario.disturbances, read(text).disturbances);
    read_back(text);
    let error = errors(&text.replace("on = \"rw\"\nseed", "on = \"rx\"\nseed"));
    assert!(error.contains("rx"), "{error}");
}

/// 1 N on 100 kg from 2 to 5 s: 0.03 m/s, and nothing before and after.
#[test]
fn a_source_acts_from_and_to_its_times() {
    let text = format!(
        "{WHEEL}[[source]]\nname = \"push\"\non = \"hub\"\nfrom = \"2 s\"\nto = \"5 s\"\n[source.record]\n\
         times = \"0, 20 s\"\nforce_x = \"1, 1 N\"\ninterpolation = \"linear\"\n"
    );
    read_back(&text);
    let (_, samples) = ran(&read(&text));
    let times = column(&samples, "time");
    let velocity = column(&samples, "velocity_x");
    for (t, v) in times.iter().zip(&velocity) {
        let expected = 0.01 * (t.min(5.0) - 2.0).max(0.0);
        assert!((v - expected).abs() < 1e-12, "{t} s: {v} for {expected}");
    }
    assert!(last(&samples, "velocity_x") > 0.02);
    assert!(errors(&text.replace("from = \"2 s\"", "from = \"6 s\"")).contains("after the start"));
}
