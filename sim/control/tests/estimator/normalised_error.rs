//! The normalised squared error of attitude and bias over a hundred seeded runs against its 95 % band.

use crate::truth::Run;

const RUNS: u32 = 100;

/// 2.5 % and 97.5 % quantiles of chi-square with 600 degrees of freedom, over a hundred.
const BAND: [f64; 2] = [5.3402, 6.6977];

/// Means over the runs at the times at which a measured attitude has arrived.
fn means(every: u32, latency: usize, samples: u32, believed: f64) -> Vec<f64> {
    let mut sums: Vec<f64> = Vec::new();
    for seed in 0..u64::from(RUNS) {
        let mut run = Run::new(seed, every, latency, believed);
        let mut arrived = 0;
        for _ in 0..samples {
            if run.step() {
                let error = run.normalised_error();
                match sums.get_mut(arrived) {
                    Some(sum) => *sum += error,
                    None => sums.push(error),
                }
                arrived += 1;
            }
        }
    }
    sums.iter().map(|sum| sum / f64::from(RUNS)).collect()
}

fn outside(means: &[f64]) -> usize {
    means.iter().filter(|mean| !(BAND[0]..BAND[1]).contains(mean)).count()
}

/// At 24 times, of which 1.2 are expected outside the band; neighbours are correlated, so that three may be.
#[test]
fn the_normalised_error_stays_in_its_band() {
    for latency in [0, 3] {
        let means = means(5, latency, 120 + u32::try_from(latency).unwrap(), 1.0);
        println!("latency {latency}: {means:.2?}");
        assert_eq!(means.len(), 24);
        assert!(outside(&means) <= 3, "{} of {:.2?}", outside(&means), means);
    }
}

/// The band sees a filter that takes its star tracker for better than it is.
#[test]
fn the_band_is_left_by_a_filter_with_half_the_variance() {
    let means = means(5, 0, 120, 0.5);
    assert!(outside(&means) > 20, "{means:.2?}");
}
