//! A locked platform is a part of what it stands on: of the platform below, and of the hub.

use nalgebra::{Matrix3, Rotation3, Vector3};
use precess::record::Samples;

use super::stacked::{RUN, WHEEL, diagonal, ran};

/// A body: mass, centre of mass, inertia about it.
#[derive(Clone, Copy)]
struct Body(f64, Vector3<f64>, Matrix3<f64>);

impl Body {
    /// In the axes of what it is fixed to.
    fn placed(self, position: Vector3<f64>, axes: &Matrix3<f64>) -> Self {
        Self(self.0, position + axes * self.1, axes * self.2 * axes.transpose())
    }

    /// Both as one.
    fn with(self, other: Self) -> Self {
        let mass = self.0 + other.0;
        let centre = (self.1 * self.0 + other.1 * other.0) / mass;
        let about = |of: Self| {
            let r = (of.1 - centre).cross_matrix();
            of.2 - of.0 * r * r
        };
        Self(mass, centre, about(self) + about(other))
    }

    fn keys(&self) -> String {
        let Self(mass, c, j) = self;
        format!(
            "mass = \"{mass:?} kg\"\ncentre_of_mass = \"{:?}, {:?}, {:?} m\"\n\
             inertia = \"{:?}, {:?}, {:?} kg m^2\"\nproducts_of_inertia = \"{:?}, {:?}, {:?} kg m^2\"\n",
            c.x, c.y, c.z, j.m11, j.m22, j.m33, j.m12, j.m13, j.m23
        )
    }
}

/// A place: position and axes.
type Place = (Vector3<f64>, Matrix3<f64>);

fn keys(on: &str, (position, axes): &Place) -> String {
    let row = |k: usize| format!("[{:?}, {:?}, {:?}]", axes[(k, 0)], axes[(k, 1)], axes[(k, 2)]);
    format!(
        "on = \"{on}\"\nposition = \"{:?}, {:?}, {:?} m\"\nmount = {{ dcm = [{}, {}, {}] }}\n",
        position.x,
        position.y,
        position.z,
        row(0),
        row(1),
        row(2)
    )
}

fn moved(outer: &Place, inner: &Place) -> Place {
    (outer.0 + outer.1 * inner.0, outer.1 * inner.1)
}

/// Locked at displacements and angles beside zero, both in the axes of the mount.
fn locked(of: &Place, slides: [f64; 3], z_turn: f64) -> (String, Place) {
    let turn = Rotation3::from_axis_angle(&Vector3::z_axis(), z_turn);
    let [x, y, z] = slides;
    let text = format!(
        "x_slide = {{ locked = true, displacement = \"{x:?} m\" }}\n\
         y_slide = {{ locked = true, displacement = \"{y:?} m\" }}\n\
         z_slide = {{ locked = true, displacement = \"{z:?} m\" }}\n\
         x_turn = {{ locked = true }}\ny_turn = {{ locked = true }}\n\
         z_turn = {{ locked = true, angle = \"{z_turn:?} rad\" }}\n"
    );
    (text, moved(of, &(Vector3::from(slides), turn.into_inner())))
}

const SPRINGS: &str = "x_slide = { stiffness = \"8 N/mm\", damping = \"20 N s/m\", displacement = \"0.2 mm\" }\n\
    y_slide = { stiffness = \"7 N/mm\" }\nz_slide = { stiffness = \"9 N/mm\" }\n\
    x_turn = { stiffness = \"150 N m/rad\" }\ny_turn = { stiffness = \"160 N m/rad\", rate = \"0.01 rad/s\" }\n\
    z_turn = { stiffness = \"170 N m/rad\" }\n";

fn craft(hub: &Body, rest: &str) -> Samples {
    let start = "[initial]\nangular_velocity = \"0.02, -0.01, 0.03 rad/s\"\n";
    ran(&format!("format = 1\n[hub]\n{}{start}{rest}{RUN}", hub.keys()))
}

/// The largest difference of a column, by its largest value.
fn apart(a: &Samples, b: &Samples, name: &str) -> f64 {
    let [a, b] = [a, b].map(|of| of.column(name).unwrap_or_else(|| panic!("no {name}")));
    let largest = a.iter().fold(0.0_f64, |most, value| most.max(value.abs()));
    assert!(largest > 0.0, "{name} stays at zero");
    a.iter().zip(&b).fold(0.0_f64, |most, (a, b)| most.max((a - b).abs())) / largest
}

/// Of runs of 50 steps: their sums are in another order, and angles of the wheel are reduced by turns.
const ROUNDING: f64 = 1e-10;

fn assert_same(a: &Samples, b: &Samples, names: &[&str]) {
    for name in names {
        let apart = apart(a, b, name);
        assert!(apart < ROUNDING, "{name}: {apart:e}");
    }
}

#[test]
fn a_locked_platform_is_a_part_of_the_platform_below_and_both_of_the_hub() {
    let axes = |x: f64, y: f64, z: f64| Rotation3::from_euler_angles(x, y, z).into_inner();
    let hub = Body(300.0, Vector3::new(0.01, 0.0, 0.02), diagonal(90.0, 80.0, 60.0));
    let base = Body(6.0, Vector3::new(0.0, 0.01, 0.02), diagonal(0.1, 0.12, 0.15));
    let iso = Body(2.0, Vector3::new(0.01, 0.0, 0.02), diagonal(0.03, 0.02, 0.04));
    let on_hub: Place = (Vector3::new(0.1, -0.2, 0.4), axes(0.4, -0.3, 0.2));
    let on_base: Place = (Vector3::new(0.1, 0.2, 0.05), axes(-0.5, 0.1, 0.7));
    let on_iso: Place = (Vector3::new(0.0, 0.1, 0.1), axes(0.2, 0.3, -0.9));
    let platform =
        |name: &str, body: &Body| format!("[[platform]]\nname = \"{name}\"\n{}", body.keys());

    // The inner platform is locked.
    let (held, at) = locked(&on_base, [1e-3, -2e-3, 3e-3], 0.3);
    let outer = |body: &Body| platform("base", body) + &keys("hub", &on_hub) + SPRINGS;
    let inner = platform("iso", &iso) + &keys("base", &on_base) + &held;
    let stacked = craft(&hub, &(outer(&base) + &inner + WHEEL + &keys("iso", &on_iso)));
    let whole = base.with(iso.placed(at.0, &at.1));
    let one = craft(&hub, &(outer(&whole) + WHEEL + &keys("base", &moved(&at, &on_iso))));
    let moving = ["omega_x", "omega_y", "omega_z", "base.x", "base.z", "base.beta", "base.gamma"];
    assert_same(&stacked, &one, &moving);
    assert_same(&stacked, &one, &["rw.spin", "energy"]);

    // Both are.
    let (outer, place) = locked(&on_hub, [-2e-3, 1e-3, 1e-3], -0.4);
    let outer = platform("base", &base) + &keys("hub", &on_hub) + &outer;
    let both = craft(&hub, &(outer + &inner + WHEEL + &keys("iso", &on_iso)));
    let rigid = hub.with(whole.placed(place.0, &place.1));
    let on_hub = moved(&place, &moved(&at, &on_iso));
    let none = craft(&rigid, &(WHEEL.to_owned() + &keys("hub", &on_hub)));
    assert_same(&both, &none, &["omega_x", "omega_y", "omega_z", "rw.spin", "energy"]);
}
