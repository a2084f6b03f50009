//! The torque of gravity on a body with products of inertia.

use nalgebra::{Matrix3, Vector3};

use super::super::{ScenarioRun, within};
use super::largest;

/// Latitude and longitude in deg of ten points at a radius of 6800 km; the torque in B, N m. JEOD,
/// `models/interactions/gravity_torque/docs/tex/gravity_torqueChapters.tex`, tables `testpoints` and `torqueresults`, the
/// column of spherical harmonics. The planet there is twelve points of mass within 4 km of its centre, with the gravitational
/// parameter in `models/environment/gravity/verif/data/src/mass_data.cc`.
const TORQUES: [(f64, f64, [f64; 3]); 10] = [
    (90.0, 120.0, [-6.576_995_906_413_2e-4, 1.269_164_209_592_045e-4, -4.723_482_089_916_854e-4]),
    (
        89.99,
        353.0,
        [-6.577_475_179_730_652e-4, 1.270_487_433_086_179e-4, -4.722_975_646_974_573e-4],
    ),
    (73.0, 9.0, [-4.667_054_619_988_188e-4, 2.230_918_182_780_193e-4, -2.308_991_703_765_578e-4]),
    (13.0, 100.0, [9.643_230_821_702_463e-4, 3.894_826_293_977_236e-4, 1.192_559_213_912_787e-3]),
    (0.0, 0.0, [5.947_635_780_445_906e-5, -1.824_208_387_207_12e-4, -1.311_220_703_920_095e-4]),
    (0.0, 180.0, [5.947_635_779_717_441e-5, -1.824_208_387_253_428e-4, -1.311_220_704_109_403e-4]),
    (
        -26.0,
        210.0,
        [7.585_422_706_336_786e-4, -1.035_277_845_536_193e-3, -5.060_880_799_457_042e-5],
    ),
    (-52.0, 310.0, [5.494_210_701_133_441e-4, 1.890_337_404_179_465e-4, 6.827_228_269_632_132e-4]),
    (-89.99, 10.0, [-6.577_823_003_575_999e-4, 1.268_171_069_274_99e-4, -4.724_987_427_239_774e-4]),
    (
        -90.0,
        160.0,
        [-6.576_995_906_610_781e-4, 1.269_164_210_444_634e-4, -4.723_482_089_531_574e-4],
    ),
];

/// The inertia of the body of three points of mass there, which `masses` puts together; turned by pitch, yaw and roll.
#[test]
fn torques_of_gravity_are_jeods() {
    let inertia = Matrix3::new(630.0, -277.5, 372.5, -277.5, 773.75, 285.0, 372.5, 285.0, 573.75);
    let (mut most, mut greatest) = (0.0_f64, 0.0_f64);
    for (latitude, longitude, known) in TORQUES {
        let (sin, cos) = latitude.to_radians().sin_cos();
        let (east, x) = longitude.to_radians().sin_cos();
        let [x, y, z] = [cos * x, cos * east, sin].map(|share| 6.8e6 * share);
        let text = format!(
            "format = 1\n[hub]\nmass = \"80 kg\"\ninertia = \"630, 773.75, 573.75 kg m^2\"\n\
             products_of_inertia = \"-277.5, 372.5, 285 kg m^2\"\n\
             [gravity]\ncentral = \"3.986004415e14 m^3/s^2\"\n[initial]\nposition = \"{x}, {y}, {z} m\"\n\
             attitude = {{ euler = \"20, 30, 40 deg\", sequence = \"YZX\", direction = \"N to B\" }}\n\
             [run]\nduration = \"1 ms\"\n[output]\ncolumns = [\"omega_dot\"]\n"
        );
        let ran = ScenarioRun::from_text("torque", &text);
        let found = ran.at(0.0, ["omega_dot_x", "omega_dot_y", "omega_dot_z"]);
        let difference = inertia * Vector3::from(found) - Vector3::from(known);
        most = most.max(largest(difference.iter()));
        greatest = greatest.max(largest(&known));
    }
    assert!(greatest > 1e-3, "{greatest:e} N m");
    within("JEOD, torque of gravity, N m", most, TORQUE);
}

/// The table's largest difference between spherical harmonics and points of mass, N m, 4e-7 of the greatest torque; here the
/// planet is a point. Measured: 3.6e-10.
const TORQUE: f64 = 5.2e-10;
