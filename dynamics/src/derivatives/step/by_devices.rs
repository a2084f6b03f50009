//! [`Spacecraft::step_by_devices`]: derivatives of a step of devices on a rigid hub in a uniform field, where every joint moves
//! and has an input: device by device, with the changes of the hub's accelerations between them.
//!
//! In a chain through the stages every state changes with every state. Here the joints of a device change with few terms
//! ([`DeviceChain`]), and only the hub has rows of all columns; those of the joints are written once.

#![cfg_attr(
    feature = "lanes",
    expect(clippy::inline_always, reason = "instructions are reached only in what is inlined")
)]

use nalgebra::DMatrix;

use crate::attitude::quaternion::Quaternion;
use crate::derivatives::linearization::columns_of;
use crate::derivatives::loads::by_loads::ByLoads;
use crate::derivatives::loads::load_columns::JointColumns;
use crate::derivatives::loads::side_by_side::are_finite;
use crate::derivatives::slopes::{OF_HUB, Slopes};
use crate::derivatives::step::device_chain::{DeviceChain, Stage};
use crate::derivatives::step::hub_accelerations::{OF_HUB as ACCELERATIONS, StageAccelerations};
use crate::derivatives::step::linearization::{StepStage, turn};
use crate::derivatives::step::stage_chain::{Numbers, StageChain, numbers};
use crate::derivatives::step::workspace::DevicesWorkspace;
use crate::derivatives::structure::StructureDerivatives;
use crate::derivatives::workspace::Workspace;
use crate::equations::arithmetic::Arithmetic;
use crate::model::mode::HubMode;
use crate::numbers::each::Each;
use crate::sets::with_numbers::WithNumbers;
use crate::solve::inputs::Inputs;
use crate::solve::spacecraft::Spacecraft;

impl<D: WithNumbers<Scalar = f64>, S: StructureDerivatives> Spacecraft<D, S> {
    /// Writes the derivatives of the state after a step of these stages by the state before it and by the inputs. None, and
    /// what was written has no meaning, where there are other states and inputs or no emitted derivatives, and where a
    /// number is not finite. `of_stage` lists the joints that are not locked.
    pub(crate) fn step_by_devices(
        &self,
        inputs: &Inputs<D, S>,
        stages: &[StepStage<D, S>],
        [a, b]: [&mut DMatrix<f64>; 2],
        (workspace, of_stage): (&mut DevicesWorkspace, &mut Workspace<f64>),
    ) -> Option<()> {
        let DevicesWorkspace { hub, accelerations, devices } = workspace;
        let Workspace { loads: workspace, moving, .. } = of_stage;
        let joints = moving.len();
        let regular = !matches!(inputs.hub, HubMode::Fixed)
            && joints == inputs.modes.values().count()
            && a.ncols() == joints.checked_mul(2)?.checked_add(OF_HUB)?
            && b.ncols() == joints.checked_add(ACCELERATIONS)?;
        if !regular {
            return None;
        }
        let attitude = stages.first()?.1.attitude;
        let (mut last, mut before) = (numbers(attitude), 0.0);
        hub.begin_step([OF_HUB, a.ncols(), b.ncols()], attitude, true);
        accelerations.begin(hub.width(), joints);
        for (number, (times, stage, found)) in stages.iter().enumerate() {
            let loads = &ByLoads::new(self, stage, inputs, found, workspace)?;
            if number == 0 {
                devices.begin(loads.joints);
            }
            let slopes = &Slopes::new(self, stage, inputs, found, moving);
            let [weight, offset] = *times;
            let at = Stage { number, weight, offset, before };
            let attitude = stage.attitude;
            let through = Through { loads, slopes, attitude, at, hub, accelerations, devices };
            match loads.by {
                #[cfg(feature = "lanes")]
                Arithmetic::Dispatched(cpu) => cpu.dispatch(through),
                Arithmetic::Portable => through.run(),
            }
            before = offset;
            turn(&mut last, times, stage);
        }
        let joints = workspace.columns.joints();
        let into = [&mut *a, &mut *b];
        let rows = AllRows { last, hub, accelerations, devices, joints, into };
        match self.arithmetic {
            #[cfg(feature = "lanes")]
            Arithmetic::Dispatched(cpu) => cpu.dispatch(rows),
            Arithmetic::Portable => rows.write(),
        }
        columns_of(a).chain(columns_of(b)).all(|column| are_finite(column)).then_some(())
    }
}

/// A stage that is gone through.
struct Through<'a, 'b> {
    loads: &'a ByLoads<'b, f64>,
    slopes: &'a Slopes<'b, f64>,
    attitude: Quaternion,
    at: Stage,
    hub: &'a mut StageChain,
    accelerations: &'a mut StageAccelerations,
    devices: &'a mut DeviceChain,
}

impl Through<'_, '_> {
    #[cfg_attr(feature = "lanes", inline(always))]
    fn run(self) {
        let Self { loads, slopes, attitude, at, hub, accelerations, devices } = self;
        hub.begin_stage(attitude, slopes, 0);
        accelerations.through((loads, devices), at, hub.rotation());
        let found = accelerations.of_hub(loads, at.number, hub.rotation());
        hub.hub((slopes, numbers(attitude)), found, [at.weight, at.offset]);
    }
}

/// The derivatives of the step, to be written.
struct AllRows<'a> {
    /// The quaternion after the step before it is normalised.
    last: Numbers,
    hub: &'a mut StageChain,
    accelerations: &'a mut StageAccelerations,
    devices: &'a DeviceChain,
    joints: &'a [JointColumns<f64>],
    into: [&'a mut DMatrix<f64>; 2],
}

impl AllRows<'_> {
    #[cfg_attr(feature = "lanes", inline(always))]
    fn write(self) {
        let Self { last, hub, accelerations, devices, joints, into: [a, b] } = self;
        hub.finish(last, true, [&mut *a, &mut *b]);
        accelerations.finish(joints, devices, [a, b]);
    }
}

#[cfg(feature = "lanes")]
impl pulp::WithSimd for Through<'_, '_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: pulp::Simd>(self, _: S) {
        self.run();
    }
}

#[cfg(feature = "lanes")]
impl pulp::WithSimd for AllRows<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: pulp::Simd>(self, _: S) {
        self.write();
    }
}
