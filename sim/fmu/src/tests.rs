//! The functions, as C calls them.

use super::*;

/// A wheel that is driven, on a free hub.
const SCENARIO: &str = r#"format = 1
[hub]
mass = "90 kg"
inertia = "20, 21, 22 kg m^2"
[[device]]
name = "rw"
kind = "reaction_wheel"
position = "20, 10, 0 cm"
mount = { spin_axis = [0, 0, 1] }
imbalance = { static = "1 g cm", dynamic = "20 g cm^2" }
wheel = { mass = "4 kg", inertia = "288, 150, 150 kg cm^2" }
[run]
duration = "0.1 s"
integrator = "rk4"
step = "1 ms"
[output]
rate = "1 kHz"
"#;

/// What a function writes of why.
fn said(why: &[c_char]) -> String {
    let bytes: Vec<u8> =
        why.iter().map(|of| of.cast_unsigned()).take_while(|of| *of != 0).collect();
    String::from_utf8(bytes).expect("a text")
}

fn begun(text: &str) -> (*mut Engine, String) {
    let mut why = [0; 64];
    // SAFETY: so many bytes, both.
    let engine =
        unsafe { precess_engine_new(text.as_ptr(), text.len(), why.as_mut_ptr(), why.len()) };
    (engine, said(&why))
}

#[test]
fn a_scenario_that_is_none_is_a_message_as_long_as_there_is_room() {
    let (engine, why) = begun("format = 1\n[hub]\nmass = \"90 m\"\n");
    assert!(engine.is_null() && why.starts_with("the scenario: ") && why.len() == 63, "{why}");
}

#[test]
fn a_start_that_is_to_be_completed_is_refused() {
    let text = SCENARIO.replace("[run]", "[initial]\nsettled = true\n[run]");
    let (engine, why) = begun(&text);
    assert!(engine.is_null() && why.contains("is not complete"), "{why}");
}

#[test]
fn a_run_takes_inputs_and_ends_with_its_duration() {
    let (engine, why) = begun(SCENARIO);
    assert!(!engine.is_null(), "{why}");
    let inputs = [0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.5];
    let (mut is_over, mut why) = (0, [0; 64]);
    let mut outputs = vec![0.0; 35];
    // SAFETY: of the function above, once; so many numbers.
    unsafe {
        for (time, over) in [(0.05, 0), (0.2, 1)] {
            let is_well = precess_engine_advance(
                engine,
                inputs.as_ptr(),
                7,
                time,
                &raw mut is_over,
                why.as_mut_ptr(),
                64,
            );
            assert_eq!((is_well, is_over), (1, over), "{}", said(&why));
        }
        let is_well = precess_engine_outputs(
            engine,
            inputs.as_ptr(),
            7,
            outputs.as_mut_ptr(),
            35,
            why.as_mut_ptr(),
            64,
        );
        assert_eq!(is_well, 1, "{}", said(&why));
        precess_engine_free(engine);
    }
    assert!(outputs.iter().any(|of| *of != 0.0), "{outputs:?}");
}

#[test]
fn what_fails_once_fails_again() {
    let (engine, _) = begun(SCENARIO);
    let (mut is_over, mut why) = (0, [0; 64]);
    // SAFETY: of the function above, once; so many numbers.
    unsafe {
        for inputs in [&[f64::NAN; 7], &[0.0; 7]] {
            let is_well = precess_engine_advance(
                engine,
                inputs.as_ptr(),
                7,
                0.01,
                &raw mut is_over,
                why.as_mut_ptr(),
                64,
            );
            assert_eq!(is_well, 0);
            assert!(said(&why).contains("inputs"), "{}", said(&why));
        }
        precess_engine_free(engine);
    }
}

/// Runs to a time without torques; the outputs.
fn outputs_at(engine: *mut Engine, time: f64) -> Vec<f64> {
    let inputs = [0.0; 7];
    let (mut is_over, mut why) = (0, [0; 64]);
    let mut outputs = vec![0.0; 35];
    let (of, to, message) = (inputs.as_ptr(), outputs.as_mut_ptr(), why.as_mut_ptr());
    // SAFETY: of the function above; so many numbers.
    let are_well = unsafe {
        [
            precess_engine_advance(engine, of, 7, time, &raw mut is_over, message, 64),
            precess_engine_outputs(engine, of, 7, to, 35, message, 64),
        ]
    };
    assert_eq!(are_well, [1, 1], "{}", said(&why));
    outputs
}

#[test]
fn a_run_goes_on_from_its_bytes_also_once_it_has_failed() {
    let (engine, _) = begun(SCENARIO);
    let mut why = [0; 64];
    outputs_at(engine, 0.03);
    // SAFETY: of the function above, freed once; so many bytes.
    unsafe {
        let mut size = 0;
        let bytes = precess_engine_save(engine, &raw mut size, why.as_mut_ptr(), 64);
        assert!(!bytes.is_null(), "{}", said(&why));
        let bytes = slice::from_raw_parts(bytes, size).to_vec();
        let later = outputs_at(engine, 0.06);
        let restore = |bytes: &[u8], why: &mut [c_char; 64]| {
            precess_engine_restore(engine, bytes.as_ptr(), bytes.len(), why.as_mut_ptr(), 64)
        };
        // Bytes that are damaged change nothing.
        let mut damaged = bytes.clone();
        damaged[20] ^= 1;
        assert_eq!(restore(&damaged, &mut why), 0);
        assert!(said(&why).contains("no state of a run"), "{}", said(&why));
        assert_eq!(outputs_at(engine, 0.06), later);
        let mut is_over = 0;
        let fails = |is_over: &mut c_int, why: &mut [c_char; 64]| {
            let inputs = [f64::NAN; 7];
            precess_engine_advance(engine, inputs.as_ptr(), 7, 0.07, is_over, why.as_mut_ptr(), 64)
        };
        assert_eq!(fails(&mut is_over, &mut why), 0);
        let nothing = precess_engine_save(engine, &raw mut size, why.as_mut_ptr(), 64);
        assert!(nothing.is_null() && said(&why).contains("inputs"), "{}", said(&why));
        assert_eq!(restore(&damaged, &mut why), 0);
        assert_eq!(restore(&bytes, &mut why), 1, "{}", said(&why));
        assert_eq!(outputs_at(engine, 0.06), later);
        precess_engine_free(engine);
    }
}
