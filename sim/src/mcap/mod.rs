//! [`Mcap`]: samples and the moving bodies as an MCAP file, which Foxglove shows and `PlotJuggler` plots.
//!
//! | topic | schema | when |
//! |---|---|---|
//! | `/GROUP`, of `cmg1.loads` `/cmg1/loads` | `precess.GROUP`: a number for each column of the group | every sample |
//! | `/scene/frames` | `foxglove.FrameTransforms`: N to B, and each joint's parent body to its child body | some [`FRAMES_MAX`] samples and the last |
//! | `/scene/bodies` | `foxglove.SceneUpdate`: shapes that masses and inertias suggest | the first sample |
//! | `/DEVICE/lines` | `precess.lines`: frequencies and amplitudes of what a wheel exerts | with the frames |
//! | `/result/log` | `foxglove.Log`: requirements and events | the end; the time of the event |
//! | `/result/requirements` | `precess.requirements`: value, limit, state | the end |
//!
//! Messages are JSON with JSON Schema, the one encoding that both programs read without a compiler of schemas. A number
//! has the digits that read back the same; NaN, which JSON lacks, is `null`. Times are those of the run, in whole
//! nanoseconds; the column `time` has every digit. Nothing is compressed, and the same run makes the same bytes. The
//! scenario's text is an attachment, name, version and end of the run are the metadata `precess`.
//!
//! Devices at nodes of a flexible structure are drawn where the undeformed structure has them.

mod channels;
mod frames;
mod lines;
mod messages;
mod scene;
#[cfg(test)]
mod tests;

use std::borrow::Cow;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::time::Duration;

use mcap::records::{MessageHeader, Metadata};
use mcap::{Attachment, McapError, WriteOptions, Writer};
use serde::Serialize;

use crate::record::partial::{Partial, Reservation, begin};
use crate::record::{Header, Outcome, RecordError, Recorder, Statistics};
use crate::scenario::Scenario;

use channels::Group;
use frames::Frames;
use lines::WheelLines;
use messages::{Log, Schema, Time};

/// Samples of a run with frames, at most, but for the last one.
pub const FRAMES_MAX: f64 = 1000.0;

/// Writes an MCAP file.
pub struct Mcap {
    path: PathBuf,
    reserved: Option<Reservation>,
    scenario: Scenario,
    statistics: Statistics,
    file: Option<Open>,
}

/// The file in progress.
struct Open {
    writer: Writer<Partial>,
    /// How many messages each channel has, by its number.
    sequences: BTreeMap<u16, u32>,
    groups: Vec<(u16, Group)>,
    frames: Option<(u16, Frames)>,
    wheels: Vec<(u16, WheelLines)>,
    bodies: u16,
    log: u16,
    requirements: u16,
    header: Header,
    /// One in so many samples has frames.
    stride: u64,
    samples: u64,
    /// The last sample, where its frames are not written yet.
    last: Option<Vec<f64>>,
    line: Vec<u8>,
}

impl Mcap {
    /// A file to be written; nothing is until the run begins.
    #[must_use]
    pub fn new(path: &Path, scenario: &Scenario) -> Self {
        let statistics = Statistics::new(&scenario.requirements);
        let (path, scenario) = (path.to_owned(), scenario.clone());
        Self { path, reserved: None, scenario, statistics, file: None }
    }

    /// A file whose name is reserved.
    #[must_use]
    pub fn reserved(reservation: Reservation, scenario: &Scenario) -> Self {
        let empty = Self::new(reservation.path(), scenario);
        Self { reserved: Some(reservation), ..empty }
    }

    fn failure(&self) -> impl FnOnce(McapError) -> RecordError + use<> {
        let path = self.path.clone();
        |error| match error {
            McapError::Io(source) => RecordError::Io { path, source },
            other => RecordError::Format { path, reason: other.to_string() },
        }
    }
}

impl Recorder for Mcap {
    fn begin(&mut self, header: &Header) -> Result<(), RecordError> {
        self.statistics.begin(header)?;
        let file = begin(self.reserved.take(), &self.path);
        let file = file.map_err(RecordError::io(&self.path))?;
        self.file = Some(Open::new(file, header, &self.scenario).map_err(self.failure())?);
        Ok(())
    }

    fn sample(&mut self, row: &[f64]) -> Result<(), RecordError> {
        self.statistics.sample(row)?;
        let failure = self.failure();
        let Some(file) = &mut self.file else { return Ok(()) };
        let expected = file.header.columns.len();
        if row.len() != expected {
            return Err(RecordError::Row { expected, found: row.len() });
        }
        file.sample(row, &self.scenario).map_err(failure)
    }

    fn finish(&mut self, outcome: &Outcome) -> Result<(), RecordError> {
        self.statistics.finish(outcome)?;
        let failure = self.failure();
        let Some(mut file) = self.file.take() else { return Ok(()) };
        file.finish(outcome, self.statistics.verdicts()).map_err(failure)?;
        file.writer.into_inner().finish().map_err(RecordError::io(&self.path))
    }
}

impl Open {
    fn new(file: Partial, header: &Header, scenario: &Scenario) -> Result<Self, McapError> {
        let library = format!("precess {}", header.version);
        let mut writer = Writer::with_options(file, WriteOptions::new().library(library))?;
        let mut channel = |topic: &str, schema: &Schema| -> Result<u16, McapError> {
            let id = writer.add_schema(&schema.name, "jsonschema", schema.text.as_bytes())?;
            writer.add_channel(id, topic, "json", &BTreeMap::new())
        };
        let groups = Group::all(&header.columns).into_iter();
        let groups = groups.map(|group| Ok((channel(&group.topic, &group.schema())?, group)));
        let groups = groups.collect::<Result<_, McapError>>()?;
        let frames = match Frames::new(header, scenario) {
            Some(frames) => Some((channel("/scene/frames", &Schema::frames())?, frames)),
            None => None,
        };
        let wheels = WheelLines::all(header, scenario).into_iter();
        let wheels = wheels.map(|of| Ok((channel(&of.topic, &Schema::lines())?, of)));
        let wheels = wheels.collect::<Result<_, McapError>>()?;
        let bodies = channel("/scene/bodies", &Schema::scene())?;
        let log = channel("/result/log", &Schema::log())?;
        let requirements = channel("/result/requirements", &Schema::requirements())?;
        let expected = header.rate * header.duration / FRAMES_MAX;
        let stride = Duration::try_from_secs_f64(expected.ceil());
        let mut open = Self {
            writer,
            sequences: BTreeMap::new(),
            groups,
            frames,
            wheels,
            bodies,
            log,
            requirements,
            header: header.clone(),
            stride: stride.map_or(u64::MAX, |whole| whole.as_secs()).max(1),
            samples: 0,
            last: None,
            line: Vec::new(),
        };
        open.attach()?;
        Ok(open)
    }

    /// The scenario's text.
    fn attach(&mut self) -> Result<(), McapError> {
        if self.header.scenario.is_empty() {
            return Ok(());
        }
        self.writer.attach(&Attachment {
            log_time: 0,
            create_time: 0,
            name: format!("{}.toml", self.header.name),
            media_type: "application/toml".to_owned(),
            data: Cow::Borrowed(self.header.scenario.as_bytes()),
        })
    }

    fn sample(&mut self, row: &[f64], scenario: &Scenario) -> Result<(), McapError> {
        let time = Time::new(row.first().copied().unwrap_or_default());
        if self.samples == 0 {
            self.message(self.bodies, time, &scene::update(time, scenario))?;
        }
        let mut line = std::mem::take(&mut self.line);
        for index in 0..self.groups.len() {
            let Some((channel, group)) = self.groups.get(index) else { break };
            let channel = *channel;
            group.write(row, &mut line);
            self.bytes(channel, time, &line)?;
        }
        self.line = line;
        if self.samples.is_multiple_of(self.stride) {
            self.last = None;
            self.motion(row)?;
        } else {
            self.last = Some(row.to_vec());
        }
        self.samples += 1;
        Ok(())
    }

    /// Frames of the bodies and lines of the wheels.
    fn motion(&mut self, row: &[f64]) -> Result<(), McapError> {
        let time = Time::new(row.first().copied().unwrap_or_default());
        if let Some((channel, frames)) = &self.frames {
            let (channel, message) = (*channel, frames.message(time, row));
            self.message(channel, time, &message)?;
        }
        for index in 0..self.wheels.len() {
            let Some((channel, wheel)) = self.wheels.get(index) else { break };
            let (channel, message) = (*channel, wheel.message(row));
            self.message(channel, time, &message)?;
        }
        Ok(())
    }

    fn finish(
        &mut self,
        outcome: &Outcome,
        verdicts: &[crate::record::Verdict],
    ) -> Result<(), McapError> {
        if let Some(row) = self.last.take() {
            self.motion(&row)?;
        }
        for event in &outcome.events {
            let time = Time::new(event.time);
            self.message(self.log, time, &Log::of_event(time, event))?;
        }
        let time = Time::new(outcome.end_time);
        for verdict in verdicts {
            self.message(self.log, time, &Log::of_verdict(time, verdict))?;
        }
        if !verdicts.is_empty() {
            self.message(self.requirements, time, &messages::Requirements::new(verdicts))?;
        }
        let header = &self.header;
        let pairs = [
            ("name", header.name.clone()),
            ("title", header.title.clone()),
            ("version", header.version.to_owned()),
            ("sha256", header.sha256.clone().unwrap_or_default()),
            ("end", outcome.end.to_string()),
        ];
        let metadata = pairs.into_iter().map(|(key, value)| (key.to_owned(), value)).collect();
        self.writer.write_metadata(&Metadata { name: "precess".to_owned(), metadata })?;
        self.writer.finish().map(drop)
    }

    fn message<M: Serialize>(
        &mut self,
        channel: u16,
        time: Time,
        message: &M,
    ) -> Result<(), McapError> {
        let bytes = serde_json::to_vec(message).map_err(std::io::Error::other)?;
        self.bytes(channel, time, &bytes)
    }

    fn bytes(&mut self, channel_id: u16, time: Time, bytes: &[u8]) -> Result<(), McapError> {
        let next = self.sequences.entry(channel_id).or_default();
        let sequence = *next;
        *next = next.wrapping_add(1);
        let log_time = time.nanoseconds();
        let header = MessageHeader { channel_id, sequence, log_time, publish_time: log_time };
        self.writer.write_to_known_channel(&header, bytes)
    }
}
