//! The local vertical and horizontal frame, and attitudes from it, of JEOD.

use nalgebra::Vector3;
use precess_dynamics::Attitude as _;

use super::super::{ScenarioRun, within};
use super::{dcm, largest, read, rows, turned};

/// Time in s, `Q_parent_this` (scalar, vector) and rate about y in rad/s of the frame of a point that moves from (10, 0, 0) m
/// at (2, 1, 0) m/s without gravity: JEOD, `models/utils/lvlh_frame/verif/SIM_LVLH_Frame`,
/// `SET_test_val/RUN_test/log_LvlhState.csv`. Its rates about x and z are zero.
const FRAMES: [(f64, [f64; 4], f64); 8] = [
    (0.0, [0.5, 0.5, 0.5, -0.5], -0.1),
    (
        1.0,
        [
            0.478_788_711_266_843_7,
            0.478_788_711_266_843_7,
            0.520_347_355_103_718_2,
            -0.520_347_355_103_718_1,
        ],
        -0.068_965_517_241_379_31,
    ),
    (
        2.0,
        [
            0.463_297_594_360_981_6,
            0.463_297_594_360_981_6,
            0.534_186_614_451_660_8,
            -0.534_186_614_451_660_9,
        ],
        -0.05,
    ),
    (
        5.0,
        [
            0.435_162_146_493_599_3,
            0.435_162_146_493_599_3,
            0.557_345_410_189_303_7,
            -0.557_345_410_189_303_8,
        ],
        -0.023_529_411_764_705_88,
    ),
    (
        10.0,
        [
            0.413_452_607_315_264_7,
            0.413_452_607_315_264_8,
            0.573_634_850_322_231_9,
            -0.573_634_850_322_232,
        ],
        -0.01,
    ),
    (
        20.0,
        [
            0.396_424_432_788_235_3,
            0.396_424_432_788_235_3,
            0.585_531_953_943_186_6,
            -0.585_531_953_943_186_5,
        ],
        -0.003_448_275_862_068_965,
    ),
    (
        50.0,
        [
            0.382_817_533_460_399_3,
            0.382_817_533_460_399_4,
            0.594_517_229_418_371,
            -0.594_517_229_418_370_9,
        ],
        -0.000_684_931_506_849_315_1,
    ),
    (
        100.0,
        [
            0.377_513_714_852_736_3,
            0.377_513_714_852_736_3,
            0.597_899_151_277_276,
            -0.597_899_151_277_275_9,
        ],
        -0.000_184_842_883_548_983_4,
    ),
];

/// Euler parameters of JEOD's quaternion.
fn parameters([scalar, x, y, z]: [f64; 4]) -> [f64; 4] {
    [scalar, -x, -y, -z]
}

/// A hub at rest in the frame has the frame's attitude and rate.
#[test]
fn the_orbital_frame_is_jeods() {
    let (mut attitude, mut rate) = (0.0_f64, 0.0_f64);
    for (time, quaternion, about_y) in FRAMES {
        let text = format!(
            "format = 1\n[hub]\nmass = \"1 kg\"\ninertia = \"1, 1, 1 kg m^2\"\n[initial]\n\
             position = \"{}, {time}, 0 m\"\nvelocity = \"2, 1, 0 m/s\"\nrelative_to = \"orbit\"\n\
             [run]\nduration = \"1 s\"\n",
            10.0 + 2.0 * time
        );
        let start = read("frame", &text).initial;
        let difference = start.attitude.dcm() - dcm(parameters(quaternion));
        attitude = attitude.max(largest(difference.iter()));
        rate = rate.max(largest((start.omega - Vector3::new(0.0, about_y, 0.0)).iter()));
    }
    within("JEOD, orbital frame, attitude", attitude, ROUNDING);
    within("JEOD, orbital frame, rate, rad/s", rate, ROUNDING);
}

/// A hub that starts at the frame's attitude, at rest in N: the columns turn back as the frame turns.
#[test]
fn columns_follow_jeods_orbital_frame() {
    let ran = ScenarioRun::from_text(
        "frame",
        r#"format = 1
[hub]
mass = "1 kg"
inertia = "0.2, 0.3, 0.4 kg m^2"
[gravity]
central = "0 m^3/s^2"
[initial]
position = "10, 0, 0 m"
velocity = "2, 1, 0 m/s"
relative_to = "orbit"
angular_velocity = "0, 0.1, 0 rad/s"
[run]
duration = "100 s"
tolerance = 1e-13
[output]
rate = "2 Hz"
columns = ["orbit", "omega"]
"#,
    );
    let (_, start, _) = FRAMES[0];
    let names = [
        "orbit.yaw",
        "orbit.pitch",
        "orbit.roll",
        "orbit.omega_x",
        "orbit.omega_y",
        "orbit.omega_z",
    ];
    let (mut attitude, mut rate) = (0.0_f64, 0.0_f64);
    for (time, quaternion, about_y) in FRAMES {
        let [yaw, pitch, roll, x, y, z] = ran.at(time, names);
        let known = dcm(parameters(start)) * dcm(parameters(quaternion)).transpose();
        attitude = attitude.max(largest((turned(yaw, pitch, roll) - known).iter()));
        rate = rate.max(largest(&[x, y + about_y, z]));
    }
    within("JEOD, columns `orbit`, attitude", attitude, ROUNDING);
    within("JEOD, columns `orbit`, rate, rad/s", rate, ROUNDING);
}

/// Position and velocity of the cases, which are in `set_trans_init_typical`; attitudes from the frame by three
/// turns; `T_parent_this` and `ang_vel_this` at the time 0. JEOD, `verif/SIM_dyncomp`, `Modified_data/state.py`,
/// `SET_test/RUN_8B` and `RUN_10A`, `SET_test_val/RUN_8A` and `RUN_10A/log_state_ASCII.csv` (the rate of the first from
/// `SET_test_val_rh8/RUN_8B`).
const STARTS: [Start; 2] = [
    Start {
        what: "8B, yaw, pitch, roll",
        attitude: r#"{ euler = "0, -11.6, 0 deg", sequence = "ZYX", direction = "N to B" }"#,
        t: [
            [0.141_230_717_585_433_5, -0.989_278_273_689_727_5, 0.037_180_392_894_323_68],
            [-0.772_691_975_098_125, -0.133_633_122_324_270_3, -0.620_555_638_308_786_4],
            [0.618_870_742_586_254_7, 0.058_912_526_879_597_25, -0.783_280_484_978_017_5],
        ],
        omega: [0.0, -0.001_134_454_274_550_824, 0.0],
    },
    Start {
        what: "10A, roll, pitch, yaw",
        attitude: r#"{ euler = "0, 85, 1 deg", sequence = "XYZ", direction = "N to B" }"#,
        t: [
            [-0.644_391_227_093_127_4, 0.052_842_101_906_756_09, 0.762_868_048_034_186_4],
            [-0.761_561_787_047_150_6, -0.134_575_840_716_120_9, -0.633_966_077_645_405_2],
            [0.069_163_508_839_301_89, -0.989_493_332_651_425_9, 0.126_962_016_695_587_5],
        ],
        omega: [-1.979_895_708_397_46e-5, -0.001_134_281_491_669_957, 0.0],
    },
];

struct Start {
    what: &'static str,
    attitude: &'static str,
    t: [[f64; 3]; 3],
    omega: [f64; 3],
}

/// Three turns, in two sequences, from the orbital frame.
#[test]
fn attitudes_from_the_orbital_frame_are_jeods() {
    for Start { what, attitude, t, omega } in STARTS {
        let text = format!(
            "format = 1\n[hub]\nmass = \"1 kg\"\ninertia = \"1, 1, 1 kg m^2\"\n[initial]\n\
             position = \"-4292653.41, 955168.47, 5139356.57 m\"\n\
             velocity = \"109.649663, -7527.726490, 1484.521489 m/s\"\n\
             relative_to = \"orbit\"\nattitude = {attitude}\n[run]\nduration = \"1 s\"\n"
        );
        let start = read("start", &text).initial;
        let found = largest((start.attitude.dcm() - rows(t)).iter());
        within(&format!("JEOD, {what}, attitude"), found, ROUNDING);
        let found = largest((start.omega - Vector3::from(omega)).iter());
        within(&format!("JEOD, {what}, rate, rad/s"), found, ROUNDING);
    }
}

/// The rate of the frame of the ISS, -0.06556131568278 deg/s about y. JEOD,
/// `models/dynamics/body_action/verif/SIM_orbinit`, `Modified_data/ISS`: `lvlh_rate_def.py`, for the state of
/// `reference_inertial_trans_state.py`.
#[test]
fn the_rate_of_the_orbital_frame_of_the_iss_is_jeods() {
    let text = r#"format = 1
[hub]
mass = "400000 kg"
inertia = "1, 1, 1 kg m^2"
[initial]
position = "1244540.53, 5655938.85, 3425643.22 m"
velocity = "-6003.833051, -1469.496044, 4590.511776 m/s"
relative_to = "orbit"
[run]
duration = "1 s"
"#;
    let [x, y, z] = <[f64; 3]>::from(read("iss", text).initial.omega).map(f64::to_degrees);
    within("JEOD, ISS, rate, deg/s", largest(&[x, y + 0.065_561_315_682_78, z]), DIGITS);
}

/// Nine roundings. Measured: 4.4e-16.
const ROUNDING: f64 = 2e-15;
/// Half a unit of the last printed decimal, deg/s. Measured: 1.7e-15.
const DIGITS: f64 = 5e-15;
