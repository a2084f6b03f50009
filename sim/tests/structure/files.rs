//! Flex text of 42, NPZ, and their errors.

use std::fs;
use std::path::Path;

use nalgebra::{DMatrix, Vector3};
use precess::file::structure_from_file;
use precess::structure::{FileLocation, Structure, flex42, npz, op4};

use super::{FLEX, bytes, example, path};

#[test]
fn a_flex_file_of_42_gives_mass_normalised_modes() {
    let flex = flex42::read(FLEX.as_bytes()).unwrap_or_else(|error| panic!("{error}"));
    assert_eq!(flex.name, "Panel of the example");
    let structure = flex.structure().unwrap_or_else(|error| panic!("{error}"));
    let names: Vec<_> = structure.nodes.iter().map(|node| node.name.as_str()).collect();
    assert_eq!(names, ["1001", "1002"]);
    // Modal mass 4 and stiffness 400: 10 rad/s; damping 0.8 = 2 zeta 4 10. The shape 0.6 becomes 0.3.
    let first = structure.modes[0];
    assert_eq!([first.frequency, first.damping], [10.0, 0.01]);
    assert_eq!(structure.shapes[(2, 0)], 0.3);
    assert_eq!(structure.shapes[(6 + 4, 0)], -0.05);
    assert_eq!([first.linear.z, first.angular.y], [1.0, -2.0]);
    assert_eq!(structure.nodes[1].position, Vector3::new(1.5, 0.0, 0.25));
}

/// The file with M = [2 1; 1 2], K = [3 0; 0 3]: eigenvalues 1 and 3.
fn coupled() -> String {
    FLEX.replace(
        "2                      ! Number of mass elements",
        "4 ! elements\n0 1 1.0 !\n1 0 1.0 !",
    )
    .replace("0 0    4.0", "0 0    2.0")
    .replace("1 1    1.0                    ! mass", "1 1    2.0 !")
    .replace("0 0  400.0", "0 0    3.0")
    .replace("1 1  900.0", "1 1    3.0")
    .replace("0 0    0.8", "0 0    0.0")
    .replace("1 1    0.6", "1 1    0.0")
}

/// The displacement of the nodes by the initial states is that of the file's shapes, whatever the norm
/// of its modes, coupled or not; a scenario starts in them.
#[test]
fn modal_states_of_a_flex_file_are_those_of_a_scenario() {
    let states = [[0.25, -0.5], [0.75, 1.5]];
    let heading = "0.0  0.0                         ! Mode";
    for text in [FLEX.to_owned(), coupled()] {
        let text = text
            .replace(&format!("{heading} 0"), "0.25 -0.5 ! Mode 0")
            .replace(&format!("{heading} 1"), "0.75 1.5 ! Mode 1");
        let flex = flex42::read(text.as_bytes()).unwrap_or_else(|error| panic!("{error}"));
        let shapes = flex.rows([(false, 0), (false, 1)].into_iter());
        let structure = flex.structure().unwrap_or_else(|error| panic!("{error}"));
        let found = structure.states();
        for (of, found) in found.iter().enumerate() {
            let wanted = &shapes * nalgebra::DVector::from_fn(2, |mode, _| states[mode][of]);
            let found = &structure.shapes * nalgebra::DVector::from_column_slice(found);
            assert!(wanted.amax() > 0.1 && (found - wanted).amax() < 1e-14);
        }
        let folder = Path::new(env!("CARGO_TARGET_TMPDIR"));
        fs::write(folder.join("moving-flex.txt"), &text).expect("it is written");
        let scenario = "format = 1\n[hub]\nmass = \"350 kg\"\ninertia = \"80, 70, 60 kg m^2\"\n\
                        [structure]\nfile = \"moving-flex.txt\"\n[[structure.point]]\nname = \"p\"\n\
                        node = \"1001\"\n[run]\nduration = \"1 s\"\n";
        let read = precess::file::from_toml("flex", scenario, folder);
        let (scenario, _) = read.unwrap_or_else(|errors| panic!("{errors}"));
        let modal = scenario.structure.expect("a structure");
        assert_eq!([modal.coordinates, modal.rates], found);
    }
    let at_rest = flex42::read(FLEX.as_bytes()).and_then(flex42::Flex::structure);
    assert!(at_rest.expect("modes").initial.is_empty());
}

#[test]
fn coupled_modal_matrices_of_a_flex_file_are_diagonalised() {
    let flex = flex42::read(coupled().as_bytes()).unwrap_or_else(|error| panic!("{error}"));
    let shapes = flex.rows([(false, 0), (false, 1)].into_iter());
    let structure = flex.structure().unwrap_or_else(|error| panic!("{error}"));
    let found: Vec<f64> = structure.modes.iter().map(|mode| mode.frequency).collect();
    assert!(
        (found[0] - 1.0).abs() < 1e-14 && (found[1] - 3.0_f64.sqrt()).abs() < 1e-14,
        "{found:?}"
    );
    // Phi Phi^T is invariant: that of the file is Phi M^-1 Phi^T.
    let inverse = DMatrix::from_row_slice(2, 2, &[2.0, -1.0, -1.0, 2.0]) / 3.0;
    let wanted = &shapes * inverse * shapes.transpose();
    let found = &structure.shapes * structure.shapes.transpose();
    assert!((found - wanted).amax() < 1e-14);
}

#[test]
fn an_error_has_line_value_bound_and_remedy() {
    let cases = [
        (
            "[Mode] [Axis] out",
            "  0  0  2  0.6",
            "  0  0  3  0.6",
            "line 20: 3 as index of an axis; 0 to 2",
        ),
        ("number", "0 0  400.0", "0 0  4o0.0", "line 32: `0 0  4o0.0"),
        ("stiffness", "0 0  400.0", "0 0  -400.0", "modal stiffness of mode 1 is -4e2; it is from"),
    ];
    for (what, from, to, message) in cases {
        assert!(FLEX.contains(from), "{what}");
        let text = FLEX.replacen(from, to, 1);
        let error = flex42::read(text.as_bytes()).and_then(flex42::Flex::structure);
        let error = error.expect_err(what).to_string();
        assert!(error.contains(message), "{what}: {error}");
    }
    let cut = &bytes("dense-little.op4")[..100];
    let error = op4::read(cut).expect_err("cut off");
    assert!(
        matches!(error.place, FileLocation::Byte(_)) && error.to_string().contains("cut off"),
        "{error}"
    );
    let error = structure_from_file(&path("dense-ascii.op4")).expect_err("no nodes").to_string();
    assert!(error.contains("maps rows to nodes"), "{error}");
}

#[test]
fn a_written_npz_reads_back_the_same_to_the_bit() {
    let whole = example();
    let bare =
        Structure { mass: None, mass_matrix: None, residual: None, has_devices: None, ..example() };
    for structure in [whole, bare] {
        let bytes = npz::write(&structure).expect("it is written");
        assert_eq!(bytes, npz::write(&structure).expect("it is written"));
        assert_eq!(npz::read(&bytes).unwrap_or_else(|error| panic!("{error}")), structure);
    }
}

#[test]
fn a_member_that_is_missing_is_named() {
    let bytes = npz::write(&example()).expect("it is written");
    let at = bytes.windows(11).position(|part| part == b"damping.npy").expect("its name");
    let mut broken = bytes.clone();
    broken[at] = b'D';
    // The central directory has the name again.
    let again = broken.windows(11).rposition(|part| part == b"damping.npy").expect("its name");
    broken[again] = b'D';
    let error = npz::read(&broken).expect_err("it is missing").to_string();
    assert!(error.contains("`damping` is missing; there are"), "{error}");
}

#[test]
fn a_table_names_the_points_of_a_flex_file_without_locations() {
    let located = FLEX.split_once("****************** Analysis Node Loc").expect("a section");
    let joints = located.1.find("****************** Joint Node").expect("the next section");
    let text = located.0.to_owned() + &located.1[joints..];
    let error =
        flex42::read(text.as_bytes()).and_then(flex42::Flex::structure).expect_err("no positions");
    assert!(error.to_string().contains("3 nodes without positions"), "{error}");
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("flex-table");
    fs::create_dir_all(&folder).expect("a folder");
    fs::write(folder.join("flex.txt"), text).expect("a file");
    let table = |joint: u32| {
        let text = format!(
            "format = 1\nname = \"panel\"\nfile = \"flex.txt\"\nhas_devices = true\n\
             [rigid]\nmass = \"12 kg\"\ncentre_of_mass = \"50, 0, 0 cm\"\ninertia = \"1, 4, 5 kg m^2\"\n\
             [[node]]\nname = \"tip\"\nposition = \"1.5, 0, 0.25 m\"\nnode = 1\n\
             [[node]]\nname = \"hinge\"\nposition = \"0, 0, 0 m\"\njoint = {joint}\n"
        );
        fs::write(folder.join("panel.toml"), text).expect("a table");
        structure_from_file(&folder.join("panel.toml"))
    };
    let structure = table(1).unwrap_or_else(|error| panic!("{error}"));
    assert_eq!([structure.shapes[(2, 0)], structure.shapes[(6 + 2, 0)]], [0.5, 0.1]);
    let mass = structure.mass.expect("given");
    assert_eq!([mass.mass, mass.first_moment.x, mass.inertia.m22], [12.0, 6.0, 4.0 + 3.0]);
    assert_eq!((structure.name.as_str(), structure.has_devices), ("panel", Some(true)));
    let error = table(7).expect_err("no such joint").to_string();
    assert!(
        error.contains("shape of joint 7") && error.contains("joint 1, node 0, node 1"),
        "{error}"
    );
}
