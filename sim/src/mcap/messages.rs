//! What messages are made of, and their schemas: those of Foxglove by their names, with the fields that are written.

use std::time::Duration;

use nalgebra::{UnitQuaternion, Vector3};
use serde::Serialize;
use serde_json::{Value, json};

use crate::pointing::RequirementState;
use crate::record::{Event, Verdict};
use crate::units::Plain;

/// Levels of `foxglove.Log`.
const INFO: u8 = 2;
const WARNING: u8 = 3;
const ERROR: u8 = 4;

/// A schema and its name.
pub(super) struct Schema {
    pub(super) name: String,
    pub(super) text: String,
}

/// A time of the run, or a length of time.
#[derive(Clone, Copy, Default, Serialize)]
pub(super) struct Time {
    sec: u64,
    nsec: u32,
}

#[derive(Clone, Copy, Serialize)]
pub(super) struct Xyz {
    pub(super) x: f64,
    pub(super) y: f64,
    pub(super) z: f64,
}

/// A unit quaternion, the scalar last.
#[derive(Clone, Copy, Serialize)]
pub(super) struct Orientation {
    pub(super) x: f64,
    pub(super) y: f64,
    pub(super) z: f64,
    pub(super) w: f64,
}

#[derive(Clone, Copy, Serialize)]
pub(super) struct Colour {
    r: f64,
    g: f64,
    b: f64,
    a: f64,
}

/// `foxglove.Log`.
#[derive(Serialize)]
pub(super) struct Log {
    timestamp: Time,
    level: u8,
    message: String,
    name: String,
    file: &'static str,
    line: u32,
}

/// `precess.requirements`.
#[derive(Serialize)]
pub(super) struct Requirements<'a> {
    requirements: Vec<Requirement<'a>>,
}

/// A requirement, its numbers in its unit.
#[derive(Serialize)]
struct Requirement<'a> {
    name: &'a str,
    quantity: &'a str,
    value: Option<f64>,
    limit: f64,
    unit: &'a str,
    state: String,
}

impl Time {
    /// A time, s, to the nearest nanosecond; zero of one before the start.
    pub(super) fn new(seconds: f64) -> Self {
        let time = Duration::try_from_secs_f64(seconds).unwrap_or_default();
        Self { sec: time.as_secs(), nsec: time.subsec_nanos() }
    }

    pub(super) fn nanoseconds(self) -> u64 {
        self.sec.saturating_mul(1_000_000_000).saturating_add(u64::from(self.nsec))
    }
}

impl Colour {
    pub(super) const fn new(r: f64, g: f64, b: f64, a: f64) -> Self {
        Self { r, g, b, a }
    }
}

impl Orientation {
    /// Of Euler parameters, the scalar first.
    pub(super) fn new([w, x, y, z]: [f64; 4]) -> Self {
        Self { x, y, z, w }
    }
}

impl From<UnitQuaternion<f64>> for Orientation {
    fn from(of: UnitQuaternion<f64>) -> Self {
        Self { x: of.i, y: of.j, z: of.k, w: of.w }
    }
}

impl From<Vector3<f64>> for Xyz {
    fn from(of: Vector3<f64>) -> Self {
        Self { x: of.x, y: of.y, z: of.z }
    }
}

impl Log {
    pub(super) fn of_event(timestamp: Time, event: &Event) -> Self {
        let (name, message) = ("event".to_owned(), event.text.clone());
        Self { timestamp, level: INFO, message, name, file: "", line: 0 }
    }

    pub(super) fn of_verdict(timestamp: Time, verdict: &Verdict) -> Self {
        let level = match verdict.state {
            RequirementState::Met => INFO,
            RequirementState::Violated => ERROR,
            RequirementState::NotEvaluated(_) => WARNING,
        };
        let of = Requirement::new(verdict);
        let value = of.value.map_or_else(|| "no value".to_owned(), |of| Plain(of).to_string());
        let message =
            format!("{}: {value}, limit {} {}", of.state, Plain(of.limit), of.unit.trim());
        Self { timestamp, level, message, name: of.name.to_owned(), file: "", line: 0 }
    }
}

impl<'a> Requirements<'a> {
    pub(super) fn new(verdicts: &'a [Verdict]) -> Self {
        Self { requirements: verdicts.iter().map(Requirement::new).collect() }
    }
}

impl<'a> Requirement<'a> {
    fn new(verdict: &'a Verdict) -> Self {
        let (unit, size) = &verdict.unit;
        let state = match &verdict.state {
            RequirementState::Met => "met".to_owned(),
            RequirementState::Violated => "violated".to_owned(),
            RequirementState::NotEvaluated(why) => format!("not evaluated: {why}"),
        };
        Self {
            name: &verdict.name,
            quantity: &verdict.quantity,
            value: verdict.value.map(|value| value / size),
            limit: verdict.limit / size,
            unit,
            state,
        }
    }
}

fn object(title: &str, properties: &Value) -> Value {
    json!({ "type": "object", "title": title, "properties": properties })
}

fn list(items: &Value) -> Value {
    json!({ "type": "array", "items": items })
}

fn numbers(title: &str, keys: &[&str]) -> Value {
    let keys = keys.iter().map(|key| ((*key).to_owned(), json!({ "type": "number" })));
    object(title, &Value::Object(keys.collect()))
}

/// `time` or `duration`.
fn time(title: &str) -> Value {
    object(title, &json!({ "sec": { "type": "integer" }, "nsec": { "type": "integer" } }))
}

fn xyz() -> Value {
    numbers("foxglove.Vector3", &["x", "y", "z"])
}

fn orientation() -> Value {
    numbers("foxglove.Quaternion", &["x", "y", "z", "w"])
}

impl Schema {
    fn new(name: &str, properties: &Value) -> Self {
        Self { name: name.to_owned(), text: object(name, properties).to_string() }
    }

    pub(super) fn frames() -> Self {
        let text = json!({ "type": "string" });
        let transform = json!({
            "timestamp": time("time"), "parent_frame_id": text, "child_frame_id": text,
            "translation": xyz(), "rotation": orientation()
        });
        let transforms = list(&object("foxglove.FrameTransform", &transform));
        Self::new("foxglove.FrameTransforms", &json!({ "transforms": transforms }))
    }

    pub(super) fn scene() -> Self {
        let (text, number) = (json!({ "type": "string" }), json!({ "type": "number" }));
        let (any, yes) = (json!({ "type": "object" }), json!({ "type": "boolean" }));
        let pose =
            object("foxglove.Pose", &json!({ "position": xyz(), "orientation": orientation() }));
        let colour = numbers("foxglove.Color", &["r", "g", "b", "a"]);
        let solid =
            |title: &str| object(title, &json!({ "pose": pose, "size": xyz(), "color": colour }));
        let cylinder = json!({
            "pose": pose, "size": xyz(), "color": colour, "bottom_scale": number, "top_scale": number
        });
        let line = json!({
            "type": { "type": "integer" }, "pose": pose, "thickness": number, "scale_invariant": yes,
            "points": list(&numbers("foxglove.Point3", &["x", "y", "z"])), "color": colour,
            "colors": list(&colour), "indices": list(&json!({ "type": "integer" }))
        });
        let entity = json!({
            "timestamp": time("time"), "frame_id": text, "id": text, "lifetime": time("duration"),
            "frame_locked": yes, "metadata": list(&any), "arrows": list(&any),
            "cubes": list(&solid("foxglove.CubePrimitive")),
            "spheres": list(&solid("foxglove.SpherePrimitive")),
            "cylinders": list(&object("foxglove.CylinderPrimitive", &cylinder)),
            "lines": list(&object("foxglove.LinePrimitive", &line)),
            "triangles": list(&any), "texts": list(&any), "models": list(&any)
        });
        let entities = list(&object("foxglove.SceneEntity", &entity));
        let properties = json!({ "deletions": list(&any), "entities": entities });
        Self::new("foxglove.SceneUpdate", &properties)
    }

    pub(super) fn log() -> Self {
        let (text, whole) = (json!({ "type": "string" }), json!({ "type": "integer" }));
        let properties = json!({
            "timestamp": time("time"), "level": whole, "message": text, "name": text, "file": text,
            "line": whole
        });
        Self::new("foxglove.Log", &properties)
    }

    pub(super) fn lines() -> Self {
        let of = numbers("precess.line", &["harmonic", "frequency", "force", "moment"]);
        let turns = json!({ "type": "number", "unit": "Hz" });
        Self::new("precess.lines", &json!({ "turns_per_second": turns, "lines": list(&of) }))
    }

    pub(super) fn requirements() -> Self {
        let (text, number) = (json!({ "type": "string" }), json!({ "type": "number" }));
        let of = json!({
            "name": text, "quantity": text, "value": number, "limit": number, "unit": text, "state": text
        });
        let all = list(&object("precess.requirement", &of));
        Self::new("precess.requirements", &json!({ "requirements": all }))
    }
}
