"""An example of each public function and method of the package: what `test_arguments` calls with a wrong argument."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np

import precess
from precess import (
    campaign,
    fit,
    health,
    identification,
    jitter,
    montecarlo,
    pointing,
    spectra,
    sweep,
)

VARY = [{"key": "hub.mass", "distribution": "uniform", "from": "300 kg", "to": "400 kg"}]

Calls = dict[str, tuple[Callable[..., Any], dict[str, Any]]]


def calls(text: str) -> Calls:
    """An example of each public function and method, by name."""
    scenario = precess.Scenario.from_text(text)
    craft = scenario.spacecraft
    state, inputs, result = craft.initial_state(), craft.inputs(), scenario.run()
    batch = precess.Batch(craft)
    several = np.tile(state.to_array(), (3, 1))
    found = craft.accelerations(state)
    weights = np.ones((3, len(found._names)))
    swept = sweep.run(scenario, {"hub.mass": "300, 400 kg"})
    drawn = montecarlo.run(scenario, VARY, 2)
    limited = montecarlo.run(scenario.with_values(LIMIT), VARY, 2)
    signal = np.sin(0.7 * np.arange(256.0))
    psd, lines = spectra.welch(signal, 10.0), spectra.amplitude_spectrum(signal, 10.0)
    run = {"states": several, "dt": 1e-4, "steps": 2, "inputs": None, "every": 1, "history": True}
    of_rows = {"columns": ["omega"], "lines": 0, "start": 0.0, "threads": 1, "progress": None}
    settings = {"rate": 10.0, "window": "hann", "length": 64, "overlap": 32, "detrend": "mean"}
    record = fit.Record(np.zeros((64, 6)), 100.0, 10.0)
    tables = {
        "hub": {"mass": 300.0, "inertia": [80.0, 70.0, 60.0]},
        "run": {"duration": 0.1},
        "output": {"rate": 10.0},
    }
    flown = precess.Scenario.from_text(FLOWN)
    telemetry = flown.run()
    identify: dict[str, Any] = {
        "scenario": flown,
        "data": {name: telemetry[name] for name in telemetry.keys()},
        "unknown": {"unknown": {"hub_moments": "3 kg m^2"}, "noise": {"tachometer": "0.05 rad/s"}},
        "near": True,
    }
    identified = precess.identify(**identify)
    watch: dict[str, Any] = {
        "scenario": flown,
        "data": identify["data"],
        "block": 0.05,
        "learn": 0.25,
        "false_alarms": 1.0,
        "controller": "aocs",
    }
    slopes = montecarlo.Sensitivities(("k",), np.ones(1), {"n": np.ones(1)}, 0.0)
    return {
        "Accelerations.to_array": (found.to_array, {}),
        "Accelerations.__getitem__": (found.__getitem__, {"name": found._names[0]}),
        "AmplitudeSpectrum.strongest": (lines.strongest, {"count": 2}),
        "Batch.__init__": (
            precess.Batch,
            {"spacecraft": craft, "parameters": None, "in_lanes": True, "backend": "cpu"},
        ),
        "Batch.accelerations": (
            batch.accelerations,
            {"states": several, "inputs": inputs, "threads": 1, "progress": None},
        ),
        "Batch.jvp": (
            batch.jvp,
            {"states": several, "dx": None, "du": None, "inputs": inputs, "threads": 1},
        ),
        "Batch.linearize": (
            batch.linearize,
            {"states": several, "inputs": inputs, "threads": 1, "out": None},
        ),
        "Batch.run": (batch.run, {**run, "reduce": ["max"], "threads": 1, "progress": None}),
        "Batch.states": (batch.states, {"n": 2}),
        "Batch.vjp": (
            batch.vjp,
            {"states": several, "weights": weights, "inputs": inputs, "threads": 1},
        ),
        "Identification.design": (identified.design, {"manoeuvres": {"again": flown}}),
        "Identification.to_toml": (identified.to_toml, {}),
        "Inputs.__init__": (precess.Inputs, {"spacecraft": craft}),
        "Inputs.copy": (inputs.copy, {}),
        "Inputs.to_array": (inputs.to_array, {}),
        "Linearization.element": (
            craft.linearize(state, inputs).element,
            {"row": "omega_dot_x", "column": "omega_y"},
        ),
        "Psd.band_rms": (psd.band_rms, {"start": 0.0, "stop": 1.0}),
        "Psd.cumulative_rms": (psd.cumulative_rms, {"backward": True}),
        "Psd.interval": (psd.interval, {"bin": 1, "level": 0.9}),
        "Result.keys": (result.keys, {}),
        "Result.__getitem__": (result.__getitem__, {"name": "omega"}),
        "Result.save": (result.save, {"path": "saved.csv"}),
        "Samples.__getitem__": (drawn.__getitem__, {"name": "omega rms"}),
        "Samples.percentile": (drawn.percentile, {"name": "omega rms", "share": 0.5, "level": 0.9}),
        "Samples.probability": (limited.probability, {"requirement": "slow", "level": 0.9}),
        "Samples.rank_correlation": (
            drawn.rank_correlation,
            {"name": "omega rms", "key": "hub.mass"},
        ),
        "Samples.values": (drawn.values, {"key": "hub.mass"}),
        "Samples.keys": (drawn.keys, {}),
        "Samples.states": (limited.states, {"requirement": "slow"}),
        "Scenario.__init__": (precess.Scenario, tables),
        "Scenario.from_dict": (
            precess.Scenario.from_dict,
            {"tables": tables, "folder": None, "set": {"hub.mass": 301.0}, "name": "one"},
        ),
        "Scenario.from_text": (
            precess.Scenario.from_text,
            {"text": text, "folder": None, "set": {}, "name": "one"},
        ),
        "Scenario.from_toml": (precess.Scenario.from_toml, {"path": "one.toml", "set": {}}),
        "Scenario.run": (
            scenario.run,
            {"progress": None, "formats": [], "out": None, "controllers": None},
        ),
        "Scenario.to_toml": (scenario.to_toml, {}),
        "Scenario.with_values": (scenario.with_values, {"values": {"hub.mass": 301.0}}),
        "Sensitivities.ranked": (slopes.ranked, {"name": "n"}),
        "Spacecraft.__init__": (precess.Spacecraft, {"scenario": scenario}),
        "Spacecraft.accelerations": (craft.accelerations, {"state": state, "inputs": inputs}),
        "Spacecraft.derivative": (craft.derivative, {"t": 0.0, "y": state, "inputs": inputs}),
        "Spacecraft.energy": (craft.energy, {"state": state}),
        "Spacecraft.initial_state": (craft.initial_state, {}),
        "Spacecraft.inputs": (craft.inputs, {"time": 0.0, "state": state}),
        "Spacecraft.ledger": (craft.ledger, {"state": state, "inputs": inputs}),
        "Spacecraft.linearize": (
            craft.linearize,
            {
                "state": state,
                "inputs": inputs,
                "momentum": "origin",
                "loads": True,
                "parameters": ["hub.m_b"],
            },
        ),
        "Spacecraft.linearize_step": (
            craft.linearize_step,
            {"state": state, "dt": 1e-3, "inputs": inputs, "steps": 1, "parameters": []},
        ),
        "Spacecraft.loads": (craft.loads, {"state": state, "inputs": inputs}),
        "Spacecraft.mass_matrix_and_bias": (
            craft.mass_matrix_and_bias,
            {"state": state, "inputs": inputs},
        ),
        "Spacecraft.momentum": (craft.momentum, {"state": state, "about": "origin"}),
        "Spacecraft.no_inputs": (craft.no_inputs, {}),
        "Spacecraft.state": (craft.state, {"values": {"omega": [0.0, 0.0, 0.1]}}),
        "Spacecraft.step": (
            craft.step,
            {"state": state, "dt": 1e-3, "inputs": inputs, "steps": 1},
        ),
        "State.__init__": (precess.State, {"spacecraft": craft, "array": state.to_array()}),
        "State.__getitem__": (state.__getitem__, {"name": "omega_x"}),
        "State.__setitem__": (state.copy().__setitem__, {"name": "omega_x", "value": 0.1}),
        "State.copy": (state.copy, {}),
        "State.from_array": (
            precess.State.from_array,
            {"spacecraft": craft, "array": state.to_array()},
        ),
        "State.replace": (state.replace, {"values": {"omega_x": 0.1}}),
        "State.to_array": (state.to_array, {}),
        "Sweep.__getitem__": (swept.__getitem__, {"name": "omega rms"}),
        "Sweep.keep_out": (swept.keep_out, {"name": "omega rms", "limit": 0.1}),
        "Sweep.keys": (swept.keys, {}),
        "Sweep.states": (
            sweep.run(scenario.with_values(LIMIT), {"hub.mass": "300, 400 kg"}).states,
            {"requirement": "slow"},
        ),
        "campaign.grid": (campaign.grid, {"axes": {"hub.mass": "300, 400 kg"}}),
        "campaign.latin_hypercube": (
            campaign.latin_hypercube,
            {"vary": VARY, "samples": 2, "seed": 1},
        ),
        "campaign.listed": (campaign.listed, {"samples": {"hub.mass": [300.0, 400.0]}}),
        "campaign.monte_carlo": (campaign.monte_carlo, {"vary": VARY, "samples": 2, "seed": 1}),
        "fit.fit": (fit.fit, {"path": "missing.toml"}),
        "fit.fit_records": (
            fit.fit_records,
            {
                "records": [record] * 3,
                "harmonics": [1.0],
                "highest": 5.0,
                "interference": [],
                "speed_accuracy": 1e-3,
                "name": "wheel",
            },
        ),
        "identification.identify": (identification.identify, identify),
        "precess.identify": (precess.identify, identify),
        "health.watch": (health.watch, watch),
        "precess.watch": (precess.watch, watch),
        "jitter.budget": (jitter.budget, {"path": "missing.toml", "set": {}, "threads": 1}),
        "montecarlo.run": (
            montecarlo.run,
            {"scenario": scenario, "vary": VARY, "samples": 2, "seed": 1, "latin": False, **of_rows},
        ),
        "montecarlo.sensitivities": (
            montecarlo.sensitivities,
            {"scenario": "one.toml", "vary": VARY, "set": [], "columns": ["omega"], "start": 0.0},
        ),
        "pointing.exposure": (pointing.exposure, {"signal": signal, "rate": 10.0, "time": 1.0}),
        "pointing.exposure_of_lines": (
            pointing.exposure_of_lines,
            {"frequency": [1.0], "amplitude": [1.0], "time": 1.0},
        ),
        "pointing.exposure_of_psd": (pointing.exposure_of_psd, {"psd": psd, "time": 1.0}),
        "pointing.exposure_of_table": (
            pointing.exposure_of_table,
            {"frequency": [1.0, 2.0], "density": [1.0, 1.0], "time": 1.0},
        ),
        "pointing.index": (
            pointing.index,
            {
                "name": "RPE",
                "runs": signal,
                "rate": 10.0,
                "window": 1.0,
                "stability": None,
                "level": 0.9,
                "interpretation": "mixed",
                "confidence": None,
            },
        ),
        "pointing.index_of_psd": (
            pointing.index_of_psd,
            {"name": "RPE", "psd": psd, "window": 1.0, "stability": None, "level": 0.9},
        ),
        "pointing.weights": (pointing.weights, {"frequency": [1.0], "time": 1.0}),
        "spectra.amplitude_spectrum": (spectra.amplitude_spectrum, {"x": signal, **settings}),
        "spectra.coherence": (spectra.coherence, {"x": signal, "y": signal, **settings}),
        "spectra.cross_spectra": (spectra.cross_spectra, {"signals": [signal, signal], **settings}),
        "spectra.csd": (spectra.csd, {"x": signal, "y": signal, **settings}),
        "spectra.welch": (spectra.welch, {"x": signal, **settings}),
        "sweep.run": (
            sweep.run,
            {"scenario": scenario, "over": {"hub.mass": "300, 400 kg"}, **of_rows},
        ),
    }


#: A spacecraft with three wheels, a controller that holds it and a gyro.
FLOWN = """
format = 1
[hub]
mass = "96 kg"
inertia = "20, 20, 20 kg m^2"
[[device]]
name = "rw"
kind = "reaction_wheel"
layout.pyramid = { count = 3, half_angle = "50 deg", radius = "20 cm" }
[device.wheel]
mass = "4 kg"
inertia = "288, 150, 150 kg cm^2"
rate = "300 rpm"
[[controller]]
name = "aocs"
rate = "100 Hz"
[controller.law]
kind = "eigen_axis"
frequency = "0.03 Hz"
damping_ratio = 0.8
[controller.sensors]
seed = 1
gyro = { angle_random_walk = "0.001 deg/sqrt(h)" }
[run]
duration = "0.5 s"
[output]
rate = "100 Hz"
"""
LIMIT = {
    "requirement": [
        {"name": "slow", "quantity": "omega", "statistic": "peak", "limit": "0.04 rad/s"}
    ]
}
