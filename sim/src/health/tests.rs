//! Cases, their truth, and scores of alarms.

use super::*;
use crate::telemetry::Sensor;

const SEED: u32 = 1;

#[test]
fn cases_are_a_hundred_with_names_of_their_own() {
    let mut names: Vec<_> = HealthCase::all().iter().map(HealthCase::name).collect();
    assert_eq!(names.len(), 100);
    names.sort();
    names.dedup();
    assert_eq!(names.len(), 100);
}

#[test]
fn faults_begin_within_a_block_and_at_a_sample() {
    let timing = Timing::default();
    for case in HealthCase::all() {
        let truth = case.truth(SEED, &timing);
        if case.fault.is_none() {
            assert_eq!(truth.onset.to_bits(), timing.duration.to_bits());
            continue;
        }
        let within = truth.onset - timing.healthy;
        assert!((0.0..timing.block).contains(&within), "{truth:?}");
        let samples = 100.0 * truth.onset;
        assert!((samples - samples.round()).abs() < 1e-9, "{truth:?}");
        assert!(!truth.place.is_empty(), "{truth:?}");
    }
}

fn alarm(time: f64, name: &str, place: &str, change: f64) -> MethodAlarm {
    let (name, place) = (name.to_owned(), place.to_owned());
    MethodAlarm { method: Method::Watch, time, name, place, change: Some([change, 0.1]) }
}

#[test]
fn scores_are_of_the_first_alarm_of_the_right_name() {
    let timing = Timing { learn: 100.0, ..Timing::default() };
    let truth = TrueChange {
        case: "bus-open-drag-medium".to_owned(),
        place: "cmg1".to_owned(),
        quantity: "drag torque of cmg1.wheel".to_owned(),
        onset: 132.0,
        change: 1.0,
    };
    let alarms = [
        alarm(110.0, "drag torque of cmg1.wheel", "cmg1.wheel", 1.0),
        alarm(135.0, "drag torque of cmg12.wheel", "cmg12.wheel", 1.0),
        alarm(140.0, "static imbalance of cmg1", "cmg1", 1.0),
        alarm(142.0, "drag torque of cmg1.wheel", "cmg1.wheel", 1.05),
    ];
    let found = score(&truth, &alarms, &timing);
    assert_eq!(found.false_alarms, 1);
    assert_eq!([found.delay, found.located, found.named], [Some(3.0), Some(8.0), Some(10.0)]);
    assert_eq!(found.misnamed, 1);
    let (size, covered) = found.size.unwrap();
    assert!((size - 0.05).abs() < 1e-12 && covered);
    let point = rates(1.0, &[found]);
    assert!((point.false_alarms - 3600.0 / 32.0).abs() < 1e-9);
    assert_eq!([point.found, point.located], [1.0, 1.0]);
}

#[test]
fn alarms_of_others_are_read_and_what_is_wrong_is_named() {
    let text = "case,time,place,quantity,change,half_width\nbus-open-nominal,120,rw1,drag torque of rw1,1e-4,1e-5\n\
                bus-open-nominal,130,rw1,,,\n";
    let read = alarms_from_csv(text).unwrap();
    assert_eq!(read.len(), 2);
    assert_eq!(read[0].1.change, Some([1e-4, 1e-5]));
    assert_eq!(read[1].1.change, None);
    for (text, part) in [
        ("case,time,place\n", "quantity"),
        ("case,time,place,quantity\na,NaN,b,c\n", "line 2: `NaN`"),
    ] {
        let error = alarms_from_csv(text).unwrap_err().to_string();
        assert!(error.contains(part), "{error}");
    }
}

/// Two seconds, twice: the same bits, with cells of every sensor; of another seed others.
#[test]
fn records_are_the_same_bits_each_time() {
    let timing = Timing { block: 0.5, learn: 1.0, healthy: 1.0, duration: 2.0 };
    let of =
        |name: &str| HealthCase::all().into_iter().find(|of| of.name() == name).expect("a case");
    let case = of("bus-open-phase-large");
    let first = record(&case, SEED, &timing).unwrap();
    let text = first.csv();
    assert_eq!(text, record(&case, SEED, &timing).unwrap().csv());
    assert_ne!(text, record(&case, 2, &timing).unwrap().csv());
    for index in 0..first.sensors.len() {
        assert!(first.readings.iter().filter(|of| of.index == index).count() > 90);
    }
    let finite = |of: &crate::telemetry::Reading| of.value.iter().all(|value| value.is_finite());
    assert!(first.readings.iter().all(finite));
}

/// Of a spacecraft with gimbals all methods have numbers of a short record, in either loop.
#[test]
fn both_loops_of_the_pyramid_are_examined() {
    let timing = Timing { block: 0.5, learn: 1.5, healthy: 1.5, duration: 3.0 };
    for name in ["pyramid-open-nominal", "pyramid-closed-torque-large"] {
        let case = HealthCase::all().into_iter().find(|of| of.name() == name).expect("a case");
        let recorded = record(&case, SEED, &timing).unwrap();
        // The servo holds the gimbals: nothing turns.
        let rates =
            recorded.readings.iter().filter(|of| recorded.sensors[of.index].sensor == Sensor::Gyro);
        let most = rates.flat_map(|of| of.value).fold(0.0, |most: f64, of| most.max(of.abs()));
        assert!(most < 5e-3, "{name}: {most}");
        let found = examine(&case, &recorded, &Examining { timing, false_alarms: vec![1.0] });
        assert_eq!(found.unwrap().alarms.len(), 1);
    }
}

/// Of a spacecraft with copies, too.
#[test]
fn a_fault_is_in_one_device() {
    let timing = Timing::default();
    for case in HealthCase::all() {
        let [before, after] = case.truths(SEED, &timing).unwrap();
        let texts = |of: &crate::scenario::Scenario| -> Vec<(String, String)> {
            of.members().map(|(name, member)| (name.to_owned(), format!("{member:?}"))).collect()
        };
        let changed: Vec<String> = texts(&before)
            .into_iter()
            .zip(texts(&after))
            .filter(|((_, before), (_, after))| before != after)
            .map(|((name, _), _)| name)
            .collect();
        let elsewhere = matches!(
            case.fault,
            None | Some((Fault::TorqueConstant | Fault::GyroBias | Fault::Tachometer, _))
        );
        let expected = if elsewhere { Vec::new() } else { vec![case.truth(SEED, &timing).place] };
        assert_eq!(changed, expected, "{}", case.name());
    }
}
