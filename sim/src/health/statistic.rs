//! [`Features`]: numbers of every block, each against its mean and scatter in the first blocks: what the baselines raise alarms by.
//!
//! A number is a prediction of one more of the reference, normal with unknown mean and variance: Student's distribution with as many degrees of
//! freedom as the reference has blocks less one. Its bound is of the same rate of false alarms as that of the watch.

use statrs::distribution::{ContinuousCDF as _, StudentsT};

use super::alarm::{Method, MethodAlarm};
use crate::watch::WatchSettings;

/// Numbers of every block.
#[derive(Clone, Debug, Default)]
pub(super) struct Features {
    /// What each is, and of which device, joint or axis.
    pub(super) names: Vec<[String; 2]>,
    /// The end of a block, s, and the numbers.
    pub(super) blocks: Vec<(f64, Vec<Option<f64>>)>,
}

/// One number while its reference is taken, and after.
#[derive(Clone, Default)]
struct Reference {
    values: Vec<f64>,
    /// Mean, and deviation of one more, once it is taken.
    taken: Option<[f64; 2]>,
}

impl Features {
    /// Alarms at a rate of false alarms, of all numbers together. After an alarm a number has a new reference.
    pub(super) fn alarms(&self, method: Method, settings: &WatchSettings) -> Vec<MethodAlarm> {
        let WatchSettings { block, learn, false_alarms } = *settings;
        #[expect(clippy::cast_precision_loss, reason = "dozens")]
        let alpha = false_alarms * block / 3600.0 / self.names.len().max(1) as f64;
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "positive, bounded"
        )]
        let count = (learn / block).round().clamp(2.0, 1e6) as usize;
        #[expect(clippy::cast_precision_loss, reason = "dozens")]
        let size = count as f64;
        let bound = StudentsT::new(0.0, 1.0, size - 1.0)
            .map_or(f64::INFINITY, |of| -of.inverse_cdf((0.5 * alpha).min(0.5)));
        let mut references = vec![Reference::default(); self.names.len()];
        let mut alarms = Vec::new();
        for (time, values) in &self.blocks {
            for ((value, reference), [name, place]) in
                values.iter().zip(&mut references).zip(&self.names)
            {
                let Some(value) = value else { continue };
                let Some([mean, deviation]) = reference.taken else {
                    reference.values.push(*value);
                    if reference.values.len() == count {
                        let mean = reference.values.iter().sum::<f64>() / size;
                        let squares: f64 =
                            reference.values.iter().map(|of| (of - mean).powi(2)).sum();
                        let deviation = (squares / (size - 1.0) * (1.0 + 1.0 / size)).sqrt();
                        reference.taken = Some([mean, deviation]);
                    }
                    continue;
                };
                if (value - mean).abs() > bound * deviation {
                    *reference = Reference::default();
                    alarms.push(MethodAlarm {
                        method,
                        time: *time,
                        name: name.clone(),
                        place: place.clone(),
                        change: None,
                    });
                }
            }
        }
        alarms
    }
}
