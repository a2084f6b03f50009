//! Harmonics from a CSV file against the same, written out.

use std::fs;
use std::path::Path;

use precess::disturbance::Model;
use precess::file::from_toml;

use super::WHEEL;

const TABLE: &str = "# of a bearing\nnumber,radial_force,axial_moment,phase.radial_force\n\
                     2.5,1.5,0,30\n5.18,0.25,3,-45\n";

const WRITTEN: &str = "[[source]]\nname = \"bearing\"\non = \"rw\"\nspin_axis = \"z\"\nseed = 7\n\
    [[source.harmonic]]\nnumber = 2.5\nradial_force = \"1.5 g mm\"\nphase.radial_force = \"30 deg\"\n\
    [[source.harmonic]]\nnumber = 5.18\nradial_force = \"0.25 g mm\"\naxial_moment = \"3 g mm^2\"\n\
    phase.radial_force = \"-45 deg\"\n";

fn listed(keys: &str) -> String {
    format!(
        "{WHEEL}[[source]]\nname = \"bearing\"\non = \"rw\"\nspin_axis = \"z\"\n{keys}\n\
         harmonics = {{ file = \"bearing.csv\", force_unit = \"g mm\", moment_unit = \"g mm^2\" }}\n"
    )
}

fn folder(table: &str) -> tempfile::TempDir {
    let folder = tempfile::tempdir().expect("a folder");
    fs::write(folder.path().join("bearing.csv"), table).expect("it is written");
    folder
}

fn models(text: &str, folder: &Path) -> Vec<Model> {
    let read = from_toml("listed", text, folder);
    let (scenario, _) = read.unwrap_or_else(|errors| panic!("{errors}"));
    scenario.disturbances.into_iter().map(|of| of.model).collect()
}

#[test]
fn harmonics_of_a_table_are_those_written_one_by_one() {
    let folder = folder(TABLE);
    let found = models(&listed("seed = 7"), folder.path());
    assert_eq!(found, models(&format!("{WHEEL}{WRITTEN}"), folder.path()));
    // The record of a run has them written out, without the file.
    let (scenario, _) =
        from_toml("listed", &listed("seed = 7"), folder.path()).expect("it is read");
    let filled = &scenario.source.filled;
    assert!(!filled.contains("bearing.csv"), "{filled}");
    let again = models(filled, Path::new("nowhere"));
    assert_eq!(again, found);
}

#[test]
fn what_is_wrong_with_a_table_is_said_with_its_row() {
    for (table, keys, parts) in [
        (TABLE, "", ["row 2", "`axial_moment` has no phase"]),
        ("number,radial_force\n0,1\n", "seed = 1", ["0 is not", "bearing"]),
        ("number,radial\n2,1\n", "seed = 1", ["has no column of a component", "radial_force"]),
        ("radial_force\n1\n", "seed = 1", ["number", "bearing.csv"]),
        ("number,force_x,radial_force\n2,1,1\n", "seed = 1", ["gives a component that", "row 1"]),
    ] {
        let folder = folder(table);
        let shown = from_toml("listed", &listed(keys), folder.path()).expect_err("an error");
        let shown = shown.to_string();
        for part in parts {
            assert!(shown.contains(part), "{table}: {part} in\n{shown}");
        }
    }
}
