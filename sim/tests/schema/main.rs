//! The JSON Schema against the reader. Every scenario file, and every one that the tool writes,
//! is valid; an unknown key is refused by both in every table; and in each table both know the same
//! keys.
//!
//! The reader tells which keys it knows: an unknown one that is like none of them lists them all.

mod validator;

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

use precess::file::{from_toml, to_toml};
use serde_json::Value;
use toml::Table;

use validator::faults;

/// Like no key, so that the help of its error lists the known ones.
const UNKNOWN: &str = "QQQQ";
/// Keys that are taken away before the reader sees a table, and where.
const TAKEN: [(&str, &str); 1] = [("", "base")];
/// What the scenario files have not: other ways to write the same, each after a minimal scenario.
const OTHERS: [&str; 53] = [
    "[gravity]\ncentral = \"4e14 m^3/s^2\"\n[initial]\nposition = \"7e6, 0, 0 m\"\nvelocity = \"0, 7.5e3, 0 m/s\"\n\
     relative_to = \"orbit\"\nstate_of = \"centre_of_mass\"",
    "[gravity]\nuniform = \"0, 0, -9.81 m/s^2\"",
    "[initial.attitude]\nmrp = [0.1, 0.2, 0.3]",
    "[initial.attitude]\naxis = [0, 0, 1]\nangle = \"30 deg\"",
    "[initial.attitude]\nquaternion = [1, 0, 0, 0]\nscalar = \"first\"",
    "[initial.attitude]\neuler = \"1, 2, 3 deg\"\nsequence = \"ZYX\"\ndirection = \"N to B\"",
    "[device.mount]\nmatrix = [[1, 0, 0], [0, 1, 0], [0, 0, 1]]",
    "[device.mount]\ndcm = [[1, 0, 0], [0, 1, 0], [0, 0, 1]]",
    "[device.mount]\naxis = [0, 0, 1]\nangle = \"30 deg\"",
    "[device.mount]\neuler = \"1, 2, 3 deg\"\nsequence = \"ZYX\"\ndirection = \"hub to device\"",
    "[device.layout.pyramid]\ncount = 3\nhalf_angle = \"30 deg\"",
    "[device.layout.ring]\ncount = 3\nradius = \"30 cm\"",
    // A layout of each kind with bodies of its own, and keys of its second device.
    "[device.layout.ring]\ncount = 2\n[[device.member]]\nname = \"rw2\"\nimbalance_model = \"lumped\"\n\
     imbalance.static = \"1 g mm\"\nwheel.rate = \"1 rpm\"\n\
     [[device]]\nname = \"v\"\nkind = \"vscmg\"\nlayout.ring.count = 2\n\
     gimbal = { mass = \"1 kg\", inertia = \"1, 1, 1 g m^2\" }\nwheel = { mass = \"1 kg\", inertia = \"2, 1, 1 g m^2\" }\n\
     member = [{ name = \"v2\", gimbal = { rate = \"1 deg/s\" } }]\n\
     [[device]]\nname = \"d\"\nkind = \"dgvscmg\"\nlayout.ring.count = 2\n\
     outer_gimbal = { mass = \"1 kg\", inertia = \"1, 1, 1 g m^2\" }\n\
     inner_gimbal = { mass = \"1 kg\", inertia = \"1, 1, 1 g m^2\" }\nwheel = { mass = \"1 kg\", inertia = \"2, 1, 1 g m^2\" }\n\
     member = [{ name = \"d2\", outer_gimbal = { rate = \"1 deg/s\" } }]\n\
     [[device]]\nname = \"p\"\nkind = \"hinged_panel\"\nlayout.ring.count = 2\n\
     panel = { mass = \"1 kg\", inertia = \"1, 1, 1 g m^2\" }\nmember = [{ name = \"p2\", panel = { angle = \"1 deg\" } }]\n\
     [[device]]\nname = \"s\"\nkind = \"slosh_mass\"\nlayout.ring.count = 2\nslosh_mass = { mass = \"1 kg\" }\n\
     member = [{ name = \"s2\", slosh_mass = { displacement = \"1 cm\" } }]\n\
     [[device]]\nname = \"f\"\nkind = \"flexible_reaction_wheel\"\nlayout.ring.count = 2\n\
     wheel = { mass = \"1 kg\", inertia = \"2, 1, 1 g m^2\" }\nmember = [{ name = \"f2\", tilt_y = { angle = \"1 mrad\" } }]",
    "inertia_axes = { axis = [0, 0, 1], angle = \"30 deg\" }",
    "[device.wheel.inertia_axes]\neuler = \"1, 2, 3 deg\"\nsequence = \"ZYX\"\ndirection = \"body to axes\"",
    "[device.wheel.rate]\nsine = \"1 rad/s\"\nfrequency = \"2 Hz\"\nmean = \"0 rad/s\"",
    "[device.wheel.torque]\nconstant = \"1 mN m\"\nfrom = \"0 s\"\nto = \"1 s\"",
    "[device.wheel.torque]\nstep = \"1 mN m\"\nat = \"1 ms\"\nbefore = \"0 N m\"",
    "[device.wheel.torque]\nramp = \"0, 1 mN m\"\nfrom = \"0 s\"\nto = \"1 s\"",
    "[device.wheel.torque]\nsine = \"1 mN m\"\nfrequency = \"2 Hz\"\nmean = \"0 N m\"",
    "[device.wheel.torque]\nchirp = \"1 mN m\"\nfrequency = \"1, 2 Hz\"\nfrom = \"0 s\"\nto = \"1 s\"",
    "[device.wheel.torque]\ntimes = \"0, 1 s\"\nvalues = \"0, 1 mN m\"\ninterpolation = \"hold\"",
    "[device.wheel.torque]\ntable = \"no.csv\"\ncolumn = \"u\"\nunit = \"N m\"\ninterpolation = \"hold\"",
    "[[device]]\nname = \"other\"\ncopy_of = \"rw\"\nturned_180_about = \"x\"",
    "power_limit = \"30 W\"\nrate_limit = \"6000 rpm\"",
    "[[controller]]\nname = \"a\"\nrate = \"10 Hz\"\noffset = \"0 s\"\ndelay = \"1 ms\"\ndevices = [\"rw\"]\n\
     law = { kind = \"mrp_feedback\", attitude_gain = \"1 N m\", rate_gain = \"1, 2, 3 N m s\", gyroscopic = \"nothing\" }\n\
     reference = { kind = \"hold\", attitude = { mrp = [0, 0, 0] } }\n\
     allocation = { inverse = \"generalised\", lambda = 0.1, dither_frequency = \"1 rad/s\" }\nservo = { gain = \"1 1/s\" }\n\
     [[at]]\ntime = \"1 ms\"\njoint = \"rw.wheel\"\ncontrolled = true",
    "[[controller]]\nname = \"a\"\nrate = \"10 Hz\"\ndevices = \"rw\"\n\
     law = { kind = \"quaternion_feedback\", attitude_gain = \"1 N m\", rate_gain = \"1 N m s\" }\n\
     reference = { kind = \"slew\", turn = { axis = [0, 0, 1], angle = \"9 deg\" }, acceleration_limit = \"1 deg/s^2\" }",
    "[[controller]]\nname = \"a\"\nrate = \"10 Hz\"\nlaw = { kind = \"eigen_axis\", frequency = \"1 Hz\", damping_ratio = 0.7 }\n\
     reference = { kind = \"turning\", angular_velocity = \"0, 1, 0 deg/s\" }",
    "[[controller]]\nname = \"a\"\nrate = \"10 Hz\"\nlaw = { kind = \"rate_damping\", rate_gain = \"1 N m s\" }\n\
     reference = { kind = \"orbit\" }\n[gravity]\ncentral = \"4e14 m^3/s^2\"\n\
     [initial]\nposition = \"7e6, 0, 0 m\"\nvelocity = \"0, 7.5e3, 0 m/s\"",
    "[[controller]]\nname = \"a\"\nrate = \"10 Hz\"\nlaw = { kind = \"rate_damping\", rate_gain = \"1 N m s\" }\n\
     reference = { kind = \"table\", times = \"0, 1 s\", scalar = \"last\", quaternions = [[0, 0, 0, 1], [0, 0, 1, 9]], \
     angular_velocities = [\"0, 0, 0 deg/s\", \"0, 0, 1 deg/s\"] }\n\
     allocation = { keep_out = [\"9, 10 rpm\"], keep_out_gain = \"1 1/s\" }",
    "[[controller]]\nname = \"a\"\nrate = \"10 Hz\"\ndevices = \"g\"\nlaw = { kind = \"rate_damping\", rate_gain = \"1 N m s\" }\n\
     allocation = { preferred_angles = [\"45 deg\"], angle_gain = \"1 1/s\" }\n\
     [[device]]\nname = \"g\"\nkind = \"vscmg\"\ngimbal = { mass = \"1 kg\", inertia = \"1, 1, 1 g m^2\" }\n\
     wheel = { mass = \"1 kg\", inertia = \"2, 1, 1 g m^2\" }",
    "[[controller]]\nname = \"a\"\nrate = \"10 Hz\"\nlaw = { kind = \"program\", command = [\"none\"], time_limit = \"1 s\" }",
    "[[controller]]\nname = \"a\"\nrate = \"10 Hz\"\nlaw = { kind = \"rate_damping\", rate_gain = \"1 N m s\" }\n\
     estimator = { attitude_deviation = \"1 deg\", bias_deviation = \"1 deg/h\" }\n\
     dumping = { gain = \"0.01 1/s\", momentum = \"0, 0, 1 N m s\", torque_limit = \"1 mN m\" }\n\
     [controller.sensors]\nseed = 1\nencoder_quantum = \"1 arcsec\"\ntachometer_quantum = \"0.1 rpm\"\n\
     gyro = { output = \"integrating\", angle_random_walk = \"0.01 deg/sqrt(h)\", rate_random_walk = \"0.1 deg/h/sqrt(h)\", \
     bias = \"1, 0, 0 deg/h\", quantum = \"1 mas\" }\n\
     star_tracker = { mount = { euler = \"1, 2, 3 deg\", sequence = \"ZYX\", direction = \"hub to device\" }, noise = \"1, 1, 5 arcsec\", rate = \"2 Hz\", latency = \"1 ms\" }\n\
     [[controller.filter]]\nkind = \"low_pass\"\nfrequency = \"2 Hz\"\ndamping_ratio = 0.7\n\
     [[controller.filter]]\nsignal = \"torque\"\nkind = \"notch\"\nfrequency = \"3 Hz\"\nzero_damping = 0.1\npole_damping = 0.5\n\
     [[controller.filter]]\nkind = \"first_order_low_pass\"\nfrequency = \"2 Hz\"\n\
     [[controller.filter]]\nkind = \"lead_lag\"\nzero = \"1 Hz\"\npole = \"2 Hz\"",
    "[[at]]\ntime = \"1 ms\"\njoint = \"rw.wheel\"\ntorque = \"1 mN m\"",
    "[[at]]\ntime = \"1 ms\"\njoint = \"tank.slosh_mass\"\nforce = \"1 mN\"\n\
     power_limit = \"30 W\"\nspeed_limit = \"1 m/s\"\n\
     [[device]]\nname = \"tank\"\nkind = \"slosh_mass\"\nslosh_mass = { mass = \"1 kg\" }",
    "[[at]]\ntime = \"1 ms\"\njoint = \"tank.slosh_mass\"\nforce = \"1 mN\"\n\
     [[device]]\nname = \"tank\"\nkind = \"slosh_mass\"\nslosh_mass = { mass = \"1 kg\" }",
    "[[device]]\nname = \"tank\"\nkind = \"slosh_mass\"\nslosh_mass = { mass = \"1 kg\", coulomb = \"1 mN\", \
     static_friction = \"2 mN\", stribeck_rate = \"1 mm/s\", quadratic_drag = \"3 N s^2/m^2\" }",
    "[[device]]\nname = \"tank\"\nkind = \"slosh_mass\"\n\
     slosh_mass = { mass = \"1 kg\", corner_frequency = \"0.5 Hz\", damping_ratio = 0.01 }",
    "[[platform]]\nname = \"iso\"\nmass = \"1 kg\"\ninertia = \"1, 1, 1 g m^2\"\n\
     mount = { axis = [0, 0, 1], angle = \"30 deg\" }\n[platform.coupled]\n\
     rest_turns = \"0, 0, 1 mrad\"\n\
     stiffness.slides = [\"1, 0, 0 N/m\", \"0, 1, 0 N/m\", \"0, 0, 1 N/m\"]\n\
     damping.turns = [\"1, 0, 0 N m s/rad\", \"0, 1, 0 N m s/rad\", \"0, 0, 1 N m s/rad\"]\n\
     [[platform.strut]]\nposition = \"0, 0, 1 cm\"\ndirection = [0, 0, 1]\n\
     length = \"1 cm\"\nstiffness = \"1 N/m\"",
    "[[platform]]\nname = \"iso\"\non = \"hub\"\nmass = \"1 kg\"\n\
     inertia = \"1, 1, 1 g m^2\"\nx_slide = { corner_frequency = \"9 Hz\" }\n\
     z_turn = { torque = \"1 mN m\" }\n\
     mount = { euler = \"1, 2, 3 deg\", sequence = \"ZYX\", direction = \"hub to device\" }",
    "[[platform]]\nname = \"upper\"\non = \"iso\"\nmass = \"1 kg\"\ninertia = \"1, 1, 1 g m^2\"\n\
     position = \"0, 0, 1 cm\"\n[[platform]]\nname = \"iso\"\nmass = \"1 kg\"\ninertia = \"1, 1, 1 g m^2\"",
    "[[point]]\nname = \"a\"\non = \"rw.wheel\"\nposition = \"0, 0, 1 cm\"",
    "[[wrench]]\non = \"hub\"\nforce = { x = \"1 N\" }\nmoment = { z = \"1 N m\" }",
    "[[source]]\nname = \"tones\"\non = \"hub\"\nwheel = \"rw.wheel\"\npoint = \"0, 0, 1 cm\"\n\
     seed = 1\nmount = { axis = [0, 0, 1], angle = \"30 deg\" }\n[[source.harmonic]]\nnumber = 2.5\n\
     radial_force = \"1 g mm\"\naxial_moment = \"1 g mm^2\"\nphase = { radial_force = \"30 deg\" }",
    "[[source]]\nname = \"listed\"\non = \"hub\"\nwheel = \"rw.wheel\"\nseed = 1\n\
     harmonics = { file = \"no.csv\", force_unit = \"g mm\", moment_unit = \"g mm^2\", phase_unit = \"deg\" }",
    "[[source]]\nname = \"turned\"\non = \"hub\"\n\
     mount = { euler = \"1, 2, 3 deg\", sequence = \"ZYX\", direction = \"hub to device\" }\n\
     record = { times = \"0, 1 s\", moment_x = \"0, 1 N m\", interpolation = \"linear\" }",
    "[[source]]\nname = \"noise\"\non = \"rw.wheel\"\naxes = \"parent\"\nspin_axis = \"z\"\nseed = 1\n\
     [source.broadband]\nfrequencies = \"1, 40 Hz\"\nband = \"2, 30 Hz\"\nperiod = \"2 s\"\n\
     force_x = \"1e-9 N^2/Hz\"\nforce_y = \"1e-9 N^2/Hz\"\nreference_rate = \"3000 rpm\"\n\
     [[source.broadband.coherent]]\nbetween = [\"force_x\", \"force_y\"]\ncoherence = 0.5\n\
     phase = \"90 deg\"",
    "[[source]]\nname = \"table\"\non = \"rw\"\nfundamental_removed = true\nmodes_removed = false\n\
     [source.record]\nfile = \"no.csv\"\ntime = \"t\"\ncolumns = { force_x = \"fx\" }\n\
     force_unit = \"mN\"\nmoment_unit = \"mN m\"\ninterpolation = \"cubic\"\nrepeats = true",
    "[structure]\ndamping = 0.01\nmodes = 1\nfrequency_limit = \"9 Hz\"\ncontains_devices = false\n\
     coordinates = 0.1\nrates = [0.1]\n[[structure.point]]\nname = \"camera\"\nnode = \"tip\"\n\
     [[structure.node]]\nname = \"tip\"\nposition = \"0, 0, 1 m\"\n\
     [[structure.mode]]\nfrequency = \"3 Hz\"\ndamping = 0.1\nlinear_momentum = [0, 0, 0]\n\
     angular_momentum = [0, 0, 0]\n[[structure.mode.shape]]\nnode = \"tip\"\n\
     translation = [0, 0, 1]\nrotation = [0, 1, 0]\n[[structure.mode]]\nfrequency = \"1 rad/s\"\n\
     residual = true",
    "[structure]\nfile = \"modes.npz\"\nmodes = 4\nresidual_flexibility = true\nresidual_damping = 0.1\n\
     [[platform]]\nname = \"iso\"\nnode = \"tip\"\nmass = \"1 kg\"\ninertia = \"1, 1, 1 kg m^2\"",
    "[[crossing]]\ncolumn = \"rw.spin\"\nvalue = \"3000 rpm\"",
    "[[requirement]]\nname = \"a\"\nquantity = \"omega\"\nstatistic = \"peak\"\nlimit = \"1 rad/s\"",
    "[[requirement]]\nname = \"a\"\nquantity = \"omega\"\nstatistic = \"pde\"\nwindow = \"10 ms\"\n\
     stability = \"20 ms\"\nlevel = 0.95\nlimit = \"1 rad/s\"",
];
const MINIMAL: &str = "format = 1\n[run]\nduration = \"1 s\"\nintegrator = \"rk4\"\nstep = \"1 ms\"\n\
    [output]\nrate = \"1 kHz\"\n[hub]\nmass = \"9 kg\"\ninertia = \"1, 1, 1 kg m^2\"\n\
    [[device]]\nname = \"rw\"\nkind = \"reaction_wheel\"\n\
    [device.wheel]\nmass = \"1 kg\"\ninertia = \"2, 1, 1 g m^2\"\n";

fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../scenarios")
}

fn schema() -> Value {
    serde_json::from_str(include_str!("../../schema/scenario-1.json")).expect("JSON")
}

/// The scenario files with their names.
fn files() -> Vec<(String, String)> {
    let entries = std::fs::read_dir(folder()).expect("the folder").map(|e| e.expect("an entry"));
    let paths = entries.map(|entry| entry.path());
    let mut files: Vec<_> = paths
        .filter(|path| path.extension().is_some_and(|extension| extension == "toml"))
        .map(|path| (path.display().to_string(), std::fs::read_to_string(&path).expect("text")))
        .collect();
    files.sort();
    assert!(files.len() >= 18, "{} files", files.len());
    files
}

/// The files, and minimal scenarios with what no file has.
fn documents() -> Vec<(String, Table)> {
    let table = |(name, text): (String, String)| {
        let table = text.parse::<Table>().unwrap_or_else(|error| panic!("{name}: {error}"));
        (name, table)
    };
    let others = OTHERS.iter().map(|other| ((*other).to_owned(), format!("{MINIMAL}{other}\n")));
    files().into_iter().chain(others).map(table).collect()
}

fn json(table: &Table) -> Value {
    serde_json::to_value(table).expect("no dates")
}

#[test]
fn every_scenario_file_is_valid_and_so_is_what_the_tool_writes() {
    let schema = schema();
    let check = |name: &str, text: &str| {
        let table = text.parse::<Table>().expect("TOML");
        let faults = faults(&schema, &json(&table));
        assert!(faults.is_empty(), "{name}: {faults:#?}\n{text}");
    };
    for (name, text) in files() {
        check(&name, &text);
        let (scenario, _) = from_toml(&name, &text, &folder()).unwrap_or_else(|e| panic!("{e}"));
        check(&name, &to_toml(&scenario));
    }
    for other in OTHERS {
        check(other, &format!("{MINIMAL}{other}\n"));
    }
}

/// A table of a document: the keys and indices that lead to it, and the part of the schema for it.
struct DocumentTable<'a> {
    steps: Vec<Step>,
    /// Tables with one definition are one place: `#/$defs/body`.
    name: String,
    properties: &'a serde_json::Map<String, Value>,
}

#[derive(Clone)]
enum Step {
    Key(String),
    Index(usize),
}

/// Every table of a document with its part of the schema.
fn places<'a>(schema: &'a Value, table: &Table) -> Vec<DocumentTable<'a>> {
    let mut found = Vec::new();
    let value = toml::Value::Table(table.clone());
    walk(schema, (schema, String::new()), &value, &mut Vec::new(), &mut found);
    found
}

fn walk<'a>(
    schema: &'a Value,
    (mut part, mut name): (&'a Value, String),
    value: &toml::Value,
    steps: &mut Vec<Step>,
    found: &mut Vec<DocumentTable<'a>>,
) {
    if let Some(reference) = part["$ref"].as_str() {
        reference.clone_into(&mut name);
        part = schema.pointer(reference.trim_start_matches('#')).expect("a definition");
    }
    if let Some(branches) = part["anyOf"].as_array() {
        // Of the branches, the one for such a value; those for text and numbers have no keys.
        let key = if value.is_table() { "properties" } else { "items" };
        let Some(branch) = branches.iter().find(|branch| branch.get(key).is_some()) else { return };
        part = branch;
    }
    match value {
        toml::Value::Table(table) => {
            let properties = part["properties"].as_object();
            let properties = properties.unwrap_or_else(|| panic!("`{name}` has no table"));
            found.push(DocumentTable { steps: steps.clone(), name: name.clone(), properties });
            for (key, value) in table {
                let part = properties.get(key).unwrap_or_else(|| panic!("`{name}` has no {key}"));
                steps.push(Step::Key(key.clone()));
                walk(schema, (part, format!("{name}/{key}")), value, steps, found);
                steps.pop();
            }
        }
        toml::Value::Array(list) => {
            for (index, value) in list.iter().enumerate() {
                steps.push(Step::Index(index));
                walk(schema, (&part["items"], format!("{name}[]")), value, steps, found);
                steps.pop();
            }
        }
        _ => {}
    }
}

/// The document with an unknown key in one of its tables.
fn with_unknown_key(table: &Table, steps: &[Step]) -> Table {
    let mut value = toml::Value::Table(table.clone());
    let mut at = &mut value;
    for step in steps {
        at = match step {
            Step::Key(key) => &mut at[key.as_str()],
            Step::Index(index) => &mut at[*index],
        };
    }
    let changed = at.as_table_mut().expect("a table");
    changed.insert(UNKNOWN.to_owned(), toml::Value::Integer(1));
    match value {
        toml::Value::Table(table) => table,
        _ => unreachable!("a document is a table"),
    }
}

/// The keys that the reader lists where it refuses the unknown one.
fn known_keys(name: &str, changed: &Table) -> BTreeSet<String> {
    let text = changed.to_string();
    let errors = from_toml("changed.toml", &text, &folder()).expect_err("an unknown key");
    let unknown = errors.all.iter().find(|error| {
        error.message.starts_with("unknown key") && error.message.ends_with(&format!("{UNKNOWN}`"))
    });
    let unknown = unknown.unwrap_or_else(|| panic!("{name}: no unknown key:\n{errors}\n{text}"));
    let keys = unknown.help.strip_prefix("known here: ").unwrap_or_else(|| panic!("{errors}"));
    keys.split(", ").map(str::to_owned).collect()
}

#[test]
fn an_unknown_key_is_refused_in_every_table_and_both_know_the_same_keys() {
    let schema = schema();
    // By table: the keys that the reader knows in any document, and those of the schema.
    let mut known: BTreeMap<String, BTreeSet<String>> = BTreeMap::new();
    let mut listed: BTreeMap<String, BTreeSet<String>> = BTreeMap::new();
    for (name, table) in documents() {
        for place in places(&schema, &table) {
            let changed = with_unknown_key(&table, &place.steps);
            let faults = faults(&schema, &json(&changed));
            let unknown = |fault: &String| fault.contains(UNKNOWN) || fault.contains("none of");
            assert!(faults.iter().any(unknown), "{name}: {}: {faults:?}", place.name);
            let keys = known_keys(&name, &changed);
            known.entry(place.name.clone()).or_default().extend(keys);
            let properties = place.properties.keys().cloned();
            listed.entry(place.name).or_default().extend(properties);
        }
    }
    for (place, key) in TAKEN {
        assert!(known.entry(place.to_owned()).or_default().insert(key.to_owned()), "{key} is read");
    }
    for (place, keys) in &listed {
        assert_eq!(&known[place], keys, "`{place}`: the reader's keys, those of the schema");
    }
    // Every table of the schema is in some document.
    let tables = tables(&schema);
    println!("{} tables: {:?}", listed.len(), listed.keys());
    assert_eq!(listed.len(), tables, "{:?}", listed.keys());
}

/// The words of a part of the schema.
fn words<'a>(schema: &'a Value, mut part: &'a Value) -> Vec<&'a str> {
    if let Some(reference) = part["$ref"].as_str() {
        part = schema.pointer(reference.trim_start_matches('#')).expect("a definition");
    }
    let own = part["enum"].as_array().into_iter().flatten().filter_map(Value::as_str);
    let branches = part["anyOf"].as_array().into_iter().flatten();
    own.chain(branches.flat_map(|branch| words(schema, branch))).collect()
}

/// Where the schema lists the words of a key, the reader takes these and no other.
#[test]
fn both_know_the_same_words_of_every_key() {
    let schema = schema();
    let mut compared: BTreeMap<String, usize> = BTreeMap::new();
    for (name, table) in documents() {
        for place in places(&schema, &table) {
            for (key, part) in place.properties {
                let known = words(&schema, part);
                let at = format!("{}/{key}", place.name);
                let with = |word: &str| with_word(&table, &place.steps, key, word);
                let Some(other) = with(UNKNOWN).filter(|_| !known.is_empty()) else { continue };
                if compared.contains_key(&at) {
                    continue;
                }
                let reads = |changed: &Table| {
                    let read = from_toml("changed.toml", &changed.to_string(), &folder());
                    read.err().map_or_else(String::new, |errors| errors.to_string())
                };
                assert!(!reads(&other).is_empty(), "{name}: {at} takes any word");
                assert!(!faults(&schema, &json(&other)).is_empty(), "{name}: {at}");
                for word in &known {
                    let changed = with(word).expect("the key is there");
                    let refused = format!("is \"{word}\"\n");
                    let shown = reads(&changed);
                    assert!(!shown.contains(&refused), "{name}: {at} = {word}\n{shown}");
                }
                compared.insert(at, known.len());
            }
        }
    }
    println!("{compared:?}");
    for at in ["#/$defs/device/kind", "/hub/mode"] {
        assert!(compared.contains_key(at), "{at} in {compared:?}");
    }
}

/// The document with a word for a key of one of its tables; none where that key is not there or is no text.
fn with_word(table: &Table, steps: &[Step], key: &str, word: &str) -> Option<Table> {
    let mut value = toml::Value::Table(table.clone());
    let mut at = &mut value;
    for step in steps {
        at = match step {
            Step::Key(key) => &mut at[key.as_str()],
            Step::Index(index) => &mut at[*index],
        };
    }
    let entry = at.as_table_mut()?.get_mut(key).filter(|value| value.is_str())?;
    *entry = toml::Value::String(word.to_owned());
    match value {
        toml::Value::Table(table) => Some(table),
        _ => None,
    }
}

/// How many tables a schema has.
fn tables(part: &Value) -> usize {
    match part {
        Value::Object(map) => {
            let below: usize =
                map.iter().filter(|(key, _)| *key != "properties").map(|(_, v)| tables(v)).sum();
            let own = map.get("properties").and_then(Value::as_object);
            below + own.map_or(0, |own| 1 + own.values().map(tables).sum::<usize>())
        }
        Value::Array(list) => list.iter().map(tables).sum(),
        _ => 0,
    }
}
