//! The command: files, verdict, exit codes, errors.

use std::fmt::Write as _;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

pub(super) fn folder(name: &str) -> PathBuf {
    let path = std::env::temp_dir().join(format!("precess-jitter-{}-{name}", std::process::id()));
    let _ = std::fs::remove_dir_all(&path);
    std::fs::create_dir_all(&path).expect("a folder");
    path
}

pub(super) fn jitter(budget: &Path, out: &Path, more: &[&str]) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_precess"));
    command.arg("jitter").arg(budget).arg("--out").arg(out).args(more);
    command.output().expect("it starts")
}

fn scenarios() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../scenarios")
}

#[test]
#[ignore = "long: `cargo xtask test --all`"]
fn a_budget_is_written_once_and_does_not_depend_on_threads() {
    let out = folder("files");
    let budget = scenarios().join("budgets/imaging-satellite-jitter.toml");
    let first = jitter(&budget, &out, &["--threads", "1"]);
    let text = String::from_utf8_lossy(&first.stdout).into_owned();
    assert_eq!(first.status.code(), Some(2), "{text}{}", String::from_utf8_lossy(&first.stderr));
    for part in ["violated", "met", "keep out of", "largest contributor", "within 5 % at resonance"]
    {
        assert!(text.contains(part), "{part} in:\n{text}");
    }
    let read = |out: &Path, name: &str| std::fs::read(out.join(name)).expect(name);
    let page = read(&out, "imaging-satellite-jitter.html");
    assert!(page.len() < 3_000_000, "{} bytes", page.len());
    let page = String::from_utf8(page).expect("text");
    let at = |part: &str| page.find(part).unwrap_or_else(|| panic!("{part} in the page"));
    assert!(at("requirements violated") < at("Contributors at the worst speeds"));
    assert!(at("Contributors at") < at("Sensitivities</h2>") && at("Assumptions</h2>") > 0);
    // Both assumptions about phases, and the inputs.
    for part in [
        "phases unknown (expected)",
        "worst phases",
        "Inputs</h2>",
        "cmg1.wheel",
        "imaging-satellite-modes.npz",
    ] {
        assert!(page.contains(part), "{part} in the page");
    }
    assert!(text.contains("with worst phases"), "{text}");
    // A second time only by force, with the same bytes on another number of threads.
    let again = jitter(&budget, &out, &[]);
    assert_eq!(again.status.code(), Some(1));
    assert!(String::from_utf8_lossy(&again.stderr).contains("--force"));
    let other = folder("threads");
    assert_eq!(jitter(&budget, &other, &["--threads", "3"]).status.code(), Some(2));
    for name in ["imaging-satellite-jitter.html", "imaging-satellite-jitter-lines.csv"] {
        assert!(read(&out, name) == read(&other, name), "{name}");
    }
    for folder in [out, other] {
        std::fs::remove_dir_all(folder).expect("it was made");
    }
}

#[test]
fn noise_of_a_data_sheet_is_in_the_budget_of_a_rigid_hub() {
    let out = folder("noise");
    let budget = scenarios().join("budgets/wheel-data-sheet-jitter.toml");
    let found = jitter(&budget, &out, &["--no-compare"]);
    let text = String::from_utf8_lossy(&found.stdout).into_owned();
    assert!(found.status.code().is_some_and(|code| code != 1), "{text}");
    assert!(text.contains("broadband noise,"), "{text}");
    assert!(out.join("wheel-data-sheet-jitter-density-1.svg").exists());
    // A balanced wheel has only noise.
    let text = std::fs::read_to_string(scenarios().join("wheel-data-sheet.toml")).expect("a file");
    let start = text.find("[[source]]").expect("sources");
    let noise = text.find("# Noise:").expect("noise");
    let balanced = format!("{}{}", &text[..start], &text[noise..]);
    let balanced =
        balanced.replace("imbalance = { static = \"0.15 g cm\", dynamic = \"2.2 g cm^2\" }\n", "");
    let balanced = balanced.replace("\"source_bearing\", ", "");
    std::fs::write(out.join("balanced.toml"), balanced).expect("it is written");
    let text = std::fs::read_to_string(&budget).expect("a file");
    let text = text.replace("../wheel-data-sheet.toml", "balanced.toml");
    std::fs::write(out.join("alone.toml"), text).expect("it is written");
    let found = jitter(&out.join("alone.toml"), &out, &[]);
    let shown = String::from_utf8_lossy(&found.stdout).into_owned();
    let errors = String::from_utf8_lossy(&found.stderr).into_owned();
    assert_eq!(found.status.code(), Some(0), "{shown}{errors}");
    assert!(shown.contains("broadband noise, 100 %"), "{shown}");
    std::fs::remove_dir_all(out).expect("it was made");
}

/// A limit between the expected value and the worst: both are in the first line.
#[test]
fn a_verdict_that_worst_phases_violate_says_by_how_much() {
    let out = folder("phases");
    let wheel = |name: &str, x: &str| {
        format!(
            "[[device]]\nname = \"{name}\"\nkind = \"reaction_wheel\"\nposition = \"{x}, 0, 5 cm\"\n\
             mount = {{ spin_axis = [0, 0, 1] }}\nimbalance.static = \"1 g mm\"\n\
             wheel = {{ mass = \"0.2 kg\", inertia = \"7e-5, 4e-5, 4e-5 kg m^2\", rate = \"900 rpm\" }}\n"
        )
    };
    let scenario = format!(
        "format = 1\n[hub]\nmass = \"12 kg\"\ninertia = \"0.1, 0.1, 0.1 kg m^2\"\n{}{}[run]\nduration = \"1 s\"\n",
        wheel("rw1", "5"),
        wheel("rw2", "-5")
    );
    std::fs::write(out.join("two.toml"), scenario).expect("it is written");
    let budget = |limit: f64| {
        let text = format!(
            "format = 1\nscenario = \"two.toml\"\nphases = \"unknown\"\n\
             [speed]\nfrom = \"900 rpm\"\nto = \"3000 rpm\"\ncount = 11\n\
             [[line_of_sight]]\nname = \"camera\"\nnode = \"hub\"\nboresight = [0, 0, 1]\nacross = [1, 0, 0]\n\
             [[requirement]]\nname = \"jitter\"\nmetric = \"rms\"\nlimit = \"{limit} urad\"\n"
        );
        let path = out.join("budget.toml");
        std::fs::write(&path, text).expect("it is written");
        let found = jitter(&path, &out, &["--force", "--no-compare"]);
        let page = std::fs::read_to_string(out.join("budget.html")).expect("a page");
        (found.status.code(), String::from_utf8_lossy(&found.stdout).into_owned(), page)
    };
    // Two equal tones: the worst is the square root of two, 3.0 dB, above the expected value.
    let (_, text, _) = budget(1e-3);
    let value = text.lines().find_map(|line| line.strip_prefix("jitter (RMS)")).expect("a row");
    let words: Vec<&str> = value.split_whitespace().collect();
    let expected: f64 = words[1].parse().expect("a number");
    let (code, text, page) = budget(1.2 * expected);
    assert_eq!(code, Some(0), "{text}");
    let excess =
        format!("violated by {:.1} dB with worst phases", 20.0 * (2.0_f64.sqrt() / 1.2).log10());
    let row = text.lines().find(|line| line.starts_with("jitter (")).expect("a row");
    assert!(row.contains(&format!("met, but {excess}")), "{text}");
    assert!(page.contains(&format!("; jitter {excess}")), "in the page: {excess}");
    let (_, text, page) = budget(1.5 * expected);
    assert!(!text.contains("but violated") && !page.contains("; jitter violated"), "{text}");
    std::fs::remove_dir_all(out).expect("it was made");
}

#[test]
fn what_is_wrong_is_said_with_its_remedy() {
    let out = folder("wrong");
    let write = |name: &str, text: &str| {
        let path = out.join(name);
        std::fs::write(&path, text).expect("it is written");
        path
    };
    let scenario = "format = 1\n[hub]\nmass = \"9 kg\"\ninertia = \"1, 1, 1 kg m^2\"\n[[device]]\n\
                    name = \"rw\"\nkind = \"reaction_wheel\"\nmount = { spin_axis = [1, 0, 0] }\nIMBALANCE\n\
                    [device.wheel]\nmass = \"1 kg\"\ninertia = \"2, 1, 1 g m^2\"\nrate = \"900 rpm\"\n[run]\n\
                    duration = \"1 s\"\n";
    write("balanced.toml", &scenario.replace("IMBALANCE", ""));
    write("wheel.toml", &scenario.replace("IMBALANCE", "imbalance.static = \"1 g cm\""));
    let budget = |scenario: &str, more: &str, node: &str| {
        format!(
            "format = 1\nscenario = \"{scenario}\"\n[speed]\nfrom = \"600 rpm\"\nto = \"900 rpm\"\n{more}\n\
             [[line_of_sight]]\nnode = \"{node}\"\n"
        )
    };
    for (text, parts) in [
        (budget("balanced.toml", "", "hub"), ["no rotor has a tone", "imbalance"]),
        (budget("wheel.toml", "rotors = [\"rw2.wheel\"]", "hub"), ["rw2.wheel", "rw.wheel"]),
        (budget("wheel.toml", "", "camera"), ["camera", "hub"]),
        (budget("none.toml", "", "hub"), ["none.toml", ""]),
    ] {
        let found = jitter(&write("budget.toml", &text), &out.join("out"), &[]);
        let error = String::from_utf8_lossy(&found.stderr).into_owned();
        assert_eq!(found.status.code(), Some(1), "{error}");
        for part in parts {
            assert!(error.contains(part), "{part} in:\n{error}");
        }
        assert!(!out.join("out").exists(), "nothing is left behind");
    }
    std::fs::remove_dir_all(out).expect("it was made");
}

#[test]
fn keys_of_the_budget_are_replaced_by_their_prefix() {
    let out = folder("set");
    let budget = scenarios().join("budgets/wheel-data-sheet-jitter.toml");
    let run = |set: &[&str]| {
        let sets: Vec<&str> = set.iter().flat_map(|set| ["--set", set]).collect();
        let found = jitter(&budget, &out, &[&["--no-compare", "--force"][..], &sets].concat());
        let shown = String::from_utf8_lossy(&found.stdout).into_owned();
        (found.status.code(), shown, String::from_utf8_lossy(&found.stderr).into_owned())
    };
    let few = ["budget.speed.count=11", "budget.requirement.vibration.limit=1 mrad"];
    let (_, shown, error) = run(&few);
    assert!(shown.contains("1 mrad"), "{shown}{error}");
    let page = std::fs::read_to_string(out.join("wheel-data-sheet-jitter.html")).expect("a page");
    assert!(page.contains("# --set budget.speed.count=11"));
    // Its figures are charts: each is in the place of a figure that is there.
    let (_, data) = page.split_once("id=\"precess-report\">").expect("a data block");
    let data: serde_json::Value =
        serde_json::from_str(data.split_once("</script>").expect("its end").0).expect("JSON");
    let planes = data["planes"].as_array().expect("charts");
    // Two requirements: each over the speed and cumulative, and of its noise density and RMS.
    assert_eq!(planes.len(), 8);
    for plane in planes {
        assert!(page.contains(&format!("<figure id={}>", plane["static"])), "{plane}");
    }
    let axes = data["axes"].as_array().expect("axes");
    let names: Vec<_> =
        axes.iter().map(|axis| (axis["name"].as_str(), axis["log"].as_bool())).collect();
    let [speed, frequency] = ["Speed", "Frequency"].map(Some);
    assert_eq!(names, [(speed, Some(false)), (frequency, Some(false)), (frequency, Some(true))]);
    // A rigid hub with a rigid wheel: its slow motion is far below the orders.
    assert!(page.contains("No Campbell diagram is drawn") && !page.contains("figure-campbell"));
    assert!(!out.join("wheel-data-sheet-jitter-campbell.svg").exists());
    let (code, _, error) = run(&["speed.count=11"]);
    assert!(code == Some(1) && error.contains("write budget.speed.count=11"), "{error}");
    let (code, _, error) = run(&["budget.speed.cuont=11"]);
    assert!(code == Some(1) && error.contains("cuont") && error.contains("count"), "{error}");
    let (code, _, error) = run(&["budget.speed.count=11", "hub.maas=3 kg"]);
    assert!(code == Some(1) && error.contains("maas"), "{error}");
    std::fs::remove_dir_all(out).expect("it was made");
}

#[test]
fn files_of_a_base_in_another_folder_are_beside_the_base() {
    let out = folder("base");
    let scenario = out.join("derived.toml");
    let base = scenarios().join("imaging-satellite-flexible.toml");
    let text = format!("format = 1\nbase = \"{}\"\ntitle = \"derived\"\n", base.display());
    std::fs::write(&scenario, text).expect("it is written");
    let (found, _) = precess::file::from_file(&scenario, &[]).unwrap_or_else(|e| panic!("{e}"));
    assert_eq!(found.structure.expect("of the base").modes.len(), 20);
    std::fs::remove_dir_all(out).expect("it was made");
}

/// The worked example of the page: its two files, and the verdict that it shows.
#[test]
#[ignore = "long: `cargo xtask test --all`"]
fn the_example_of_the_page_has_the_verdict_of_the_page() {
    let out = folder("page");
    let page = std::fs::read_to_string(scenarios().join("../docs/jitter.md")).expect("the page");
    let blocks = |language: &str| -> Vec<String> {
        let fence = format!("```{language}\n");
        let parts = page.split(fence.as_str()).skip(1);
        parts.filter_map(|rest| rest.split("```").next()).map(str::to_owned).collect()
    };
    let [scenario, budget, ..] = &blocks("toml")[..] else { panic!("two files on the page") };
    let base = "imaging-satellite-flexible.toml";
    let path = scenarios().join(base);
    let scenario = scenario.replace(base, path.to_str().expect("text"));
    std::fs::write(out.join("new-wheel.toml"), scenario).expect("it is written");
    std::fs::write(out.join("camera.toml"), budget).expect("it is written");
    let found = jitter(&out.join("camera.toml"), &out, &["--no-compare"]);
    let shown = String::from_utf8_lossy(&found.stdout).into_owned();
    assert_eq!(found.status.code(), Some(0), "{shown}{}", String::from_utf8_lossy(&found.stderr));
    let verdict = blocks("text").into_iter().find(|text| text.starts_with("Camera\n"));
    let verdict = verdict.expect("the verdict on the page");
    // The last line is of the coupled run, which is left out here.
    for line in verdict.lines().filter(|line| !line.starts_with("coupled run")) {
        assert!(shown.lines().any(|found| found.trim_end() == line), "{line}\n{shown}");
    }
    std::fs::remove_dir_all(out).expect("it was made");
}

/// Each mistake is named once, with its remedy.
#[test]
fn files_of_another_kind_and_files_that_are_not_there_are_named() {
    let out = folder("mistaken");
    let message = |budget: &Path| {
        let found = jitter(budget, &out, &[]);
        assert_eq!(found.status.code(), Some(1));
        String::from_utf8_lossy(&found.stderr).into_owned()
    };
    let found = message(&scenarios().join("imaging-satellite-flexible.toml"));
    assert!(found.contains("is of a scenario") && found.contains("precess run"), "{found}");
    assert_eq!(found.matches("error").count(), 1, "{found}");

    let budget = out.join("budget.toml");
    let page = scenarios().join("budgets/imaging-satellite-jitter.toml");
    let text = std::fs::read_to_string(page).expect("a budget");
    let wrong = text.replace("../imaging-satellite-flexible.toml", "imaging-satelite.toml");
    assert_ne!(wrong, text);
    std::fs::write(&budget, wrong).expect("it is written");
    std::fs::write(out.join("imaging-satellite.toml"), "format = 1\n").expect("it is written");
    let found = message(&budget);
    assert!(found.contains("there is no scenario"), "{found}");
    assert!(found.contains("did you mean `imaging-satellite.toml`?"), "{found}");
    std::fs::remove_dir_all(out).expect("it was made");
}

/// What no body can have, and a speed outside the budget, is said on the terminal, too.
#[test]
#[ignore = "long: `cargo xtask test --all`"]
fn warnings_of_the_scenario_are_printed() {
    let out = folder("warnings");
    let budget = scenarios().join("budgets/imaging-satellite-jitter.toml");
    let set = ["--set", "device.cmg.imbalance.static=\"0.2 kg m\"", "--compare", "9000 rpm"];
    let found = jitter(&budget, &out, &set);
    let text = String::from_utf8_lossy(&found.stderr).into_owned();
    assert!(text.contains("off its spin axis"), "{text}");
    assert!(text.contains("9000 rpm is not within the speeds of the budget"), "{text}");
    std::fs::remove_dir_all(out).expect("it was made");
}

#[test]
fn warnings_are_printed_once_and_are_in_the_report() {
    let out = folder("warnings");
    let base = scenarios().join("wheel-data-sheet.toml");
    // A source that acts on the hub is left out.
    let text = format!(
        "format = 1\nbase = \"{}\"\n[[source]]\nname = \"pump\"\non = \"hub\"\nwheel = \"rw.wheel\"\nseed = 1\n\
         [[source.harmonic]]\nnumber = 2\nradial_force = \"1 g mm\"\n",
        base.display()
    );
    std::fs::write(out.join("scenario.toml"), text).expect("it is written");
    let budget = "format = 1\nscenario = \"scenario.toml\"\n[speed]\nfrom = \"600 rpm\"\nto = \"900 rpm\"\ncount = 5\n\
                  [[line_of_sight]]\nnode = \"hub\"\n";
    std::fs::write(out.join("budget.toml"), budget).expect("it is written");
    let found = jitter(&out.join("budget.toml"), &out, &["--compare", "1000 rpm"]);
    let error = String::from_utf8_lossy(&found.stderr).into_owned();
    assert_eq!(found.status.code(), Some(0), "{error}");
    let page = std::fs::read_to_string(out.join("budget.html")).expect("a page");
    for part in ["pump", "1000 rpm is not within the speeds of the budget"] {
        let warned =
            error.lines().filter(|line| line.starts_with("warning: ") && line.contains(part));
        assert_eq!(warned.count(), 1, "{part} in:\n{error}");
        assert!(page.contains(part), "{part} in the page");
    }
    std::fs::remove_dir_all(out).expect("it was made");
}

/// The numbers of an attribute of all elements of one name.
fn numbers(svg: &str, element: &str, attribute: &str) -> Vec<f64> {
    let start = format!("<{element}");
    let elements = svg.split(&start).skip(1);
    let value = |element: &str| {
        let (_, rest) = element.split_once(&format!(" {attribute}=\""))?;
        rest.split_once('"')?.0.parse().ok()
    };
    elements.filter_map(value).collect()
}

#[test]
#[ignore = "long: `cargo xtask test --all`"]
fn a_campbell_diagram_of_many_orders_is_large_with_few_circles_and_labels_apart() {
    let out = folder("campbell");
    let base = scenarios().join("imaging-satellite-flexible.toml");
    let mut text = format!(
        "format = 1\nbase = \"{}\"\n[[source]]\nname = \"bearing\"\non = \"cmg\"\nspin_axis = \"z\"\nseed = 1\n",
        base.display()
    );
    for order in ["0.42", "2.0", "2.97", "3.0", "4.0", "4.2", "5.22"] {
        let _ =
            writeln!(text, "[[source.harmonic]]\nnumber = {order}\nradial_force = \"8e-8 kg m\"");
    }
    std::fs::write(out.join("many.toml"), text).expect("it is written");
    let budget = "format = 1\nscenario = \"many.toml\"\n[speed]\nfrom = \"600 rpm\"\nto = \"6000 rpm\"\ncount = 61\n\
                  [[line_of_sight]]\nnode = \"camera\"\n[[requirement]]\nlimit = \"1 mrad\"\n";
    std::fs::write(out.join("budget.toml"), budget).expect("it is written");
    let found = jitter(&out.join("budget.toml"), &out, &["--no-compare"]);
    assert_eq!(found.status.code(), Some(0), "{}", String::from_utf8_lossy(&found.stderr));
    let svg = std::fs::read_to_string(out.join("budget-campbell.svg")).expect("a diagram");
    assert!(numbers(&svg, "svg", "width")[0] > 750.0);
    let page = std::fs::read_to_string(out.join("budget.html")).expect("a page");
    let (_, words) = page.split_once("10 % or more of the largest amplitude, ").expect("a caption");
    let (circled, rest) = words.split_once(" of ").expect("two numbers");
    let all = rest.split_once(';').expect("two numbers").0.parse::<usize>().expect("a number");
    assert!(
        all > 50 && page.matches(" whirl, ").count() + page.matches("<td>mode, ").count() == all,
        "{all}"
    );
    let places: Vec<_> =
        numbers(&svg, "circle", "cx").into_iter().zip(numbers(&svg, "circle", "cy")).collect();
    assert!((1..=circled.parse().expect("a number")).contains(&places.len()), "{places:?}");
    let [x, y, width, height] = ["x", "y", "width", "height"].map(|of| numbers(&svg, "rect", of));
    // The first two rectangles are the background and the frame.
    assert_eq!(x.len(), 2 + 8, "a label of each order");
    for a in 2..x.len() {
        for b in 2..a {
            let apart = x[a] + width[a] <= x[b]
                || x[b] + width[b] <= x[a]
                || y[a] + height[a] <= y[b]
                || y[b] + height[b] <= y[a];
            assert!(apart, "labels {a} and {b}");
        }
    }
    assert!(
        page.contains("without those below 10\u{207b}\u{2074} of the largest of all"),
        "what is drawn"
    );
    std::fs::remove_dir_all(out).expect("it was made");
}
