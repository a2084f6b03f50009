//! op4 as pyYeti reads it, Craig and Bampton's model as pyYeti solves it.

use nalgebra::{Complex, Vector3};
use precess::structure::accelerance::{Accelerance, Base};
use precess::structure::op4;
use serde_json::Value;

use super::{FORMS, LAYOUTS, beam, bytes};

fn json(name: &str) -> Value {
    serde_json::from_slice(&bytes(name)).expect("JSON")
}

fn doubles(value: &Value) -> Vec<f64> {
    let list = value.as_array().expect("a list");
    list.iter().map(|number| number.as_f64().expect("a number")).collect()
}

/// Real and imaginary elements, row by row.
fn elements(matrix: &op4::Matrix) -> [Vec<f64>; 2] {
    let size = matrix.rows * matrix.columns;
    let mut found = [vec![0.0; size], vec![0.0; size]];
    let parts = if matrix.complex { 2 } else { 1 };
    for run in &matrix.runs {
        for (k, value) in run.values.iter().enumerate() {
            let place = (run.row + k / parts) * matrix.columns + run.column;
            found[k % parts][place] = *value;
        }
    }
    found
}

#[test]
fn op4_files_of_every_form_are_read_as_pyyeti_reads_them() {
    let stored = json("read.json");
    for layout in LAYOUTS {
        for form in FORMS {
            let name = format!("{layout}-{form}.op4");
            let found = op4::read(&bytes(&name)).unwrap_or_else(|error| panic!("{name}: {error}"));
            let wanted = stored[&name].as_object().expect("matrices");
            assert_eq!(found.len(), wanted.len(), "{name}");
            for (key, wanted) in wanted {
                let matrix = op4::find(&found, key).expect("it is there");
                let shape = [matrix.rows, matrix.columns];
                assert_eq!(shape.map(|n| n as f64).to_vec(), doubles(&wanted["shape"]), "{name}");
                let [real, imaginary] = elements(matrix);
                assert_eq!(real, doubles(&wanted["real"]), "{name} {key}");
                assert_eq!(imaginary, doubles(&wanted["imaginary"]), "{name} {key}");
            }
        }
    }
}

/// Eigenvalues of two solvers of the same problem, relative: rounding of the largest one, which is 1200 times
/// the smallest.
const EIGENVALUES_MAX: f64 = 1e-12;

/// Responses of the same modes by two solvers, of the largest element.
const RESPONSES_MAX: f64 = 1e-10;

#[test]
fn a_craig_bampton_model_has_the_modes_and_responses_of_pyyeti() {
    let stored = json("model.json");
    let wanted = doubles(&stored["eigenvalues"]);
    let models = [
        beam("craig-bampton.op4", "mass = \"MXX\"\nstiffness = \"KXX\""),
        beam("modes.op4", "shapes = \"PHG\"\neigenvalues = \"LAMA\""),
    ];
    for structure in models {
        let found = structure.modes.iter().map(|mode| mode.frequency * mode.frequency);
        for (found, wanted) in found.zip(&wanted[6..]) {
            let error = (found - wanted).abs() / wanted;
            assert!(error < EIGENVALUES_MAX, "{found} {wanted}: {error:e}");
        }
        let mass = structure.mass.expect("six rigid-body modes");
        let whole = stored["mass"].as_f64().expect("a number");
        assert!((mass.mass - whole).abs() < 1e-9 * whole, "{}", mass.mass);
        assert!((mass.centre() - Vector3::new(1.0, 0.0, 0.0)).norm() < 1e-8, "{}", mass.centre());
        let real = doubles(&stored["accelerance_real"]);
        let imaginary = doubles(&stored["accelerance_imaginary"]);
        let accelerance =
            Accelerance::new(&structure, Base::Free, &[0, 1], &[0, 1]).expect("it is");
        for (k, frequency) in doubles(&stored["frequencies_hz"]).iter().enumerate() {
            let found = accelerance.at(std::f64::consts::TAU * frequency).expect("finite");
            let at = |row: usize, column: usize| k * 144 + row * 12 + column;
            let unit = found.map(Complex::norm).amax();
            for row in 0..12 {
                for column in 0..12 {
                    let place = at(row, column);
                    let difference =
                        found[(row, column)] - Complex::new(real[place], imaginary[place]);
                    let error = difference.norm() / unit;
                    assert!(error < RESPONSES_MAX, "{frequency} Hz {row} {column}: {error:e}");
                }
            }
        }
    }
}
