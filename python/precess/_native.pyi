"""Names and signatures of the native module, which only this package uses."""

from collections.abc import Callable, Sequence
from os import PathLike
from typing import TypeAlias, final

import numpy as np
import numpy.typing as npt

__all__ = [
    "NativeAmplitudes",
    "NativeBatch",
    "NativeBudget",
    "NativeEvaluator",
    "NativeFit",
    "NativeFunction",
    "NativeIdentified",
    "NativeInputs",
    "NativePsd",
    "NativeResult",
    "NativeScenario",
    "NativeWatched",
    "estimate_percentile",
    "estimate_probability",
    "fit_file",
    "fit_records",
    "identify",
    "jitter_budget",
    "keep_out",
    "limits",
    "plan_keys",
    "plan_of_axes",
    "plan_of_draws",
    "plan_of_probabilities",
    "plan_sensitivities",
    "pointing_index",
    "pointing_index_of_psd",
    "pointing_of_history",
    "pointing_of_lines",
    "pointing_of_psd",
    "pointing_of_table",
    "pointing_weights",
    "rank_correlation",
    "row_fields",
    "rows",
    "run",
    "side_by_side",
    "spectrum_amplitudes",
    "spectrum_cross",
    "spectrum_welch",
    "version",
    "watch",
    "xla_functions",
]

_Array: TypeAlias = npt.NDArray[np.float64]
_Path: TypeAlias = str | PathLike[str]
_Three: TypeAlias = Sequence[float]
_Column: TypeAlias = tuple[str, str, str | None, str, str, str | None]
_Failures: TypeAlias = list[tuple[int, Exception]]
_Estimate: TypeAlias = tuple[float, float, float, float]
_Parts: TypeAlias = tuple[float, float, float]
_Outcome: TypeAlias = tuple[
    tuple[str, str, float | None, bool],
    float,
    tuple[int, int, int],
    int,
    tuple[list[tuple[float, str]], int],
    list[float],
    tuple[float | None, float | None, float | None],
    float,
]
_About: TypeAlias = tuple[int, int, float, float, float]
_Plan: TypeAlias = tuple[list[str], list[tuple[list[float], list[str]]]]
_Index: TypeAlias = tuple[str, float | None, float | None]
_IndexValue: TypeAlias = tuple[float, float | None, int, int]

def version() -> str: ...

@final
class NativeScenario:
    @staticmethod
    def from_file(path: _Path, overrides: Sequence[str]) -> NativeScenario: ...
    @staticmethod
    def from_text(
        name: str, text: str, folder: _Path, overrides: Sequence[str], si: bool
    ) -> NativeScenario: ...
    @staticmethod
    def from_filled(filled: str, path: str, text: str) -> NativeScenario: ...
    @property
    def name(self) -> str: ...
    @property
    def title(self) -> str: ...
    @property
    def description(self) -> str: ...
    @property
    def duration(self) -> float: ...
    @property
    def filled(self) -> str: ...
    @property
    def source(self) -> tuple[str, str]: ...
    @property
    def members(self) -> list[tuple[str, str]]: ...
    @property
    def controllers(self) -> list[str]: ...
    @property
    def all_columns(self) -> list[_Column]: ...
    @property
    def columns(self) -> list[_Column]: ...
    @property
    def warnings(self) -> list[str]: ...

@final
class NativeInputs:
    def copy(self) -> NativeInputs: ...
    @property
    def force(self) -> list[float]: ...
    @force.setter
    def force(self, force: _Three) -> None: ...
    @property
    def torque(self) -> list[float]: ...
    @torque.setter
    def torque(self, torque: _Three) -> None: ...
    @property
    def motors(self) -> _Array: ...
    @motors.setter
    def motors(self, motors: Sequence[float]) -> None: ...
    @property
    def modes(self) -> list[tuple[str, float]]: ...
    @modes.setter
    def modes(self, modes: Sequence[tuple[str, float]]) -> None: ...
    @property
    def hub(self) -> tuple[str, list[float], list[float]]: ...
    @hub.setter
    def hub(self, hub: tuple[str, _Three, _Three]) -> None: ...
    @property
    def gravity(self) -> tuple[list[float] | None, float | None]: ...
    @gravity.setter
    def gravity(self, gravity: tuple[_Three | None, float | None]) -> None: ...
    @property
    def wrenches(self) -> _Array | None: ...
    @wrenches.setter
    def wrenches(self, wrenches: Sequence[Sequence[float]] | None) -> None: ...
    @property
    def modal(self) -> _Array: ...
    @modal.setter
    def modal(self, modal: Sequence[float]) -> None: ...

@final
class NativeEvaluator:
    def __new__(cls, scenario: NativeScenario) -> NativeEvaluator: ...
    @property
    def state_columns(self) -> list[_Column]: ...
    @property
    def joints(
        self,
    ) -> list[tuple[str, str, str, str, str, tuple[str, str, str, str], bool, bool]]: ...
    @property
    def acceleration_names(self) -> list[str]: ...
    @property
    def load_columns(self) -> list[_Column]: ...
    @property
    def parameters(self) -> list[tuple[str, str, str, float | None]]: ...
    @property
    def is_flexible(self) -> bool: ...
    @property
    def mass(self) -> float: ...
    def initial(self) -> _Array: ...
    def at_rest(self) -> _Array: ...
    def no_inputs(self) -> NativeInputs: ...
    def inputs(self, time: float, y: _Array) -> NativeInputs: ...
    def accelerations(self, y: _Array, inputs: NativeInputs) -> _Array: ...
    def derivative(self, time: float, y: _Array, inputs: NativeInputs | None = None) -> _Array: ...
    def energy_and_momentum(self, y: _Array, about: str) -> tuple[float, _Array, _Array]: ...
    def ledger(self, y: _Array, inputs: NativeInputs) -> list[tuple[str, float]]: ...
    def loads(self, y: _Array, inputs: NativeInputs) -> tuple[_Array, _Array]: ...
    def mass_matrix(self, y: _Array, inputs: NativeInputs) -> tuple[list[str], _Array, _Array]: ...
    def linearize(
        self,
        y: _Array,
        inputs: NativeInputs,
        momentum: str | None,
        loads: bool,
        parameters: Sequence[str],
    ) -> tuple[list[str], list[str], list[str], list[str], list[_Array]]: ...
    def linearize_steps(
        self,
        y: _Array,
        inputs: NativeInputs,
        length: float,
        steps: int,
        parameters: Sequence[str],
    ) -> tuple[_Array, list[str], list[str], list[str], list[_Array]]: ...
    def step(self, y: _Array, inputs: NativeInputs, length: float, steps: int) -> _Array: ...

@final
class NativeBatch:
    def __new__(
        cls,
        evaluator: NativeEvaluator,
        parameters: tuple[Sequence[str], _Array] | None = None,
        scenarios: Sequence[NativeScenario] | None = None,
        lanes: bool = True,
        cuda: bool = False,
    ) -> NativeBatch: ...
    @property
    def is_laned(self) -> bool: ...
    @property
    def fallback(self) -> str | None: ...
    def accelerations(
        self,
        y: _Array,
        inputs: NativeInputs,
        u: _Array | None = None,
        threads: int = 0,
        progress: Callable[[float], object] | None = None,
    ) -> tuple[_Array, _Failures]: ...
    def run(
        self,
        y: _Array,
        inputs: NativeInputs,
        u: _Array | None,
        dt: float,
        steps: int,
        every: int,
        history: bool,
        reductions: Sequence[str],
        threads: int = 0,
        progress: Callable[[float], object] | None = None,
    ) -> tuple[_Array, _Array | None, list[_Array], _Failures]: ...
    def linearize(
        self,
        y: _Array,
        inputs: NativeInputs,
        u: _Array | None = None,
        threads: int = 0,
        out: tuple[_Array, _Array] | None = None,
    ) -> tuple[list[str], list[str], list[str], _Array, _Array, _Failures]: ...
    def jvp(
        self,
        y: _Array,
        inputs: NativeInputs,
        dx: _Array | None,
        du: _Array | None,
        u: _Array | None = None,
        threads: int = 0,
    ) -> tuple[_Array, _Failures]: ...
    def vjp(
        self, y: _Array, inputs: NativeInputs, weights: _Array, u: _Array | None = None, threads: int = 0
    ) -> tuple[_Array, _Array, _Failures]: ...

@final
class NativeFunction:
    def __new__(cls, batch: NativeBatch, inputs: NativeInputs) -> NativeFunction: ...
    @property
    def number(self) -> int: ...
    @property
    def linearized(self) -> tuple[list[str], list[str], list[str]]: ...
    @property
    def calls(self) -> tuple[int, int]: ...

@final
class NativeResult:
    @property
    def columns(self) -> list[_Column]: ...
    @property
    def end(self) -> str: ...
    @property
    def is_complete(self) -> bool: ...
    @property
    def end_time(self) -> float: ...
    @property
    def steps(self) -> tuple[int, int, int]: ...
    @property
    def events(self) -> list[tuple[float, str]]: ...
    @property
    def drift(self) -> tuple[float | None, float | None, float | None]: ...
    @property
    def energy_lost(self) -> float: ...
    @property
    def verdicts(
        self,
    ) -> list[
        tuple[str, str, float | None, float, tuple[str, float], bool, str, str | None]
    ]: ...
    @property
    def outcome(self) -> _Outcome: ...
    @staticmethod
    def restored(scenario: NativeScenario, outcome: _Outcome) -> NativeResult: ...
    def save(self, format: str, path: _Path, columns: Sequence[_Array]) -> None: ...
    def raise_error(self) -> None: ...

def run(
    scenario: NativeScenario,
    progress: Callable[[float], bool | None] | None,
    files: Sequence[tuple[str, _Path]],
    controllers: Sequence[tuple[str, Callable[..., object]]],
) -> tuple[NativeResult, list[_Array]]: ...

@final
class NativeBudget:
    @property
    def title(self) -> str: ...
    @property
    def speeds(self) -> list[float]: ...
    @property
    def contributors(self) -> list[tuple[str, str, float]]: ...
    @property
    def left_out(self) -> list[str]: ...
    @property
    def requirements(
        self,
    ) -> list[
        tuple[
            tuple[str, str, str, float, str, float],
            tuple[list[float], int],
            tuple[list[tuple[int, float]], float],
            list[list[float]],
            tuple[str, str | None],
        ]
    ]: ...

def jitter_budget(path: _Path, overrides: Sequence[str], threads: int) -> NativeBudget: ...

@final
class NativePsd:
    @property
    def density(self) -> _Array: ...
    @property
    def about(self) -> _About: ...
    def band_rms(self, start: float, stop: float) -> float: ...
    def cumulative_rms(self, forward: bool) -> _Array: ...
    def interval(self, bin: int, level: float) -> tuple[float, float]: ...

@final
class NativeAmplitudes:
    @property
    def amplitude(self) -> _Array: ...
    @property
    def about(self) -> _About: ...
    def strongest(self, count: int) -> list[tuple[float, float, int, float]]: ...

def spectrum_welch(
    x: _Array, rate: float, settings: tuple[str, int, int, str]
) -> NativePsd: ...
def spectrum_amplitudes(
    x: _Array, rate: float, settings: tuple[str, int, int, str]
) -> NativeAmplitudes: ...
def spectrum_cross(
    signals: _Array, rate: float, settings: tuple[str, int, int, str]
) -> tuple[_About, npt.NDArray[np.complex128], _Array | None]: ...
def pointing_of_history(
    components: _Array, rate: float, exposure: float
) -> tuple[_Parts, _Parts, int, int]: ...
def pointing_of_psd(psd: NativePsd, exposure: float) -> _Parts: ...
def pointing_of_table(points: Sequence[Sequence[float]], exposure: float) -> _Parts: ...
def pointing_of_lines(lines: Sequence[Sequence[float]], exposure: float) -> _Parts: ...
def pointing_weights(frequency: float, exposure: float) -> _Parts: ...
def pointing_index(
    index: _Index,
    runs: Sequence[_Array],
    rate: float,
    interpretation: str,
    level: float,
    confidence: float | None = None,
) -> _IndexValue: ...
def pointing_index_of_psd(index: _Index, psd: NativePsd, level: float) -> _IndexValue: ...

@final
class NativeFit:
    @property
    def name(self) -> str: ...
    @property
    def imbalance(
        self,
    ) -> tuple[_Estimate, _Estimate, _Estimate | None, _Estimate | None]: ...
    @property
    def harmonics(
        self,
    ) -> list[tuple[_Estimate, list[tuple[str, str, _Estimate, _Estimate | None, bool]]]]: ...
    @property
    def modes(self) -> list[tuple[str, _Estimate, _Estimate, _Estimate, _Estimate]]: ...
    @property
    def floors(self) -> list[tuple[str, list[tuple[float, float, _Estimate]]]]: ...
    @property
    def residuals(self) -> list[tuple[str, float, float]]: ...
    @property
    def discrepancies(self) -> list[tuple[str, bool]]: ...
    def parts(
        self, name: str, rotor: tuple[float, float, float] | None = None
    ) -> tuple[str, str]: ...

def fit_file(path: _Path) -> NativeFit: ...
def fit_records(
    name: str,
    records: Sequence[tuple[str, float, float, float, Sequence[float], _Array]],
    harmonics: Sequence[float],
    interference: Sequence[float],
    highest: float | None = None,
    speed_accuracy: float | None = None,
) -> NativeFit: ...
_Direction: TypeAlias = tuple[list[tuple[str, float, str]], float, bool]

@final
class NativeIdentified:
    @property
    def numbers(self) -> list[tuple[str, str, _Estimate, bool]]: ...
    @property
    def wheels(self) -> list[tuple[str, list[_Estimate], list[bool], bool]]: ...
    @property
    def covariance(self) -> list[list[float]]: ...
    @property
    def untold(self) -> list[_Direction]: ...
    @property
    def residuals(self) -> list[tuple[str, int, float, int, bool]]: ...
    @property
    def exclusions(self) -> list[str]: ...
    @property
    def verdict(self) -> tuple[bool, bool]: ...
    @property
    def span(self) -> tuple[float, float, int]: ...
    def parts(self) -> str: ...
    def design(
        self, manoeuvres: Sequence[tuple[str, NativeScenario]]
    ) -> tuple[
        list[float],
        list[tuple[str, str, float, list[float]]],
        list[tuple[_Direction, list[float]]],
    ]: ...

def identify(
    scenario: NativeScenario,
    unknown: _Path,
    columns: Sequence[tuple[str, _Array]],
    data: _Path | None,
    is_near: bool,
) -> NativeIdentified: ...

@final
class NativeWatched:
    @property
    def alarms(self) -> list[tuple[str, str, list[float], str, list[str]]]: ...
    @property
    def quantities(self) -> list[tuple[str, str, tuple[float, float] | None]]: ...
    def times(self) -> tuple[_Array, _Array]: ...
    def series(self, quantity: int) -> tuple[_Array, _Array]: ...
    @property
    def exclusions(self) -> list[str]: ...
    @property
    def remarks(self) -> list[str]: ...

def watch(
    scenario: NativeScenario,
    columns: Sequence[tuple[str, _Array]],
    data: _Path | None,
    controller: str | None,
    lengths: Sequence[float],
    false_alarms: float,
) -> NativeWatched: ...
def plan_of_axes(axes: Sequence[str]) -> _Plan: ...
def plan_of_draws(path: _Path, samples: int, seed: int, latin: bool) -> _Plan: ...
def plan_of_probabilities(path: _Path, probabilities: Sequence[Sequence[float]]) -> _Plan: ...
def plan_keys(path: _Path) -> list[str]: ...
def plan_sensitivities(
    path: _Path,
    overrides: Sequence[str],
    plan: _Path,
    columns: Sequence[str],
    start: float,
) -> tuple[list[str], list[float], list[list[float] | None], float]: ...
def row_fields(
    scenario: NativeScenario, columns: Sequence[str], lines: int
) -> list[tuple[str, str]]: ...
def side_by_side() -> int: ...
def rows(
    scenarios: Sequence[NativeScenario], columns: Sequence[str], lines: int, start: float
) -> list[tuple[list[float] | None, str | None]]: ...
def limits(scenario: NativeScenario) -> list[tuple[str, float]]: ...
def keep_out(
    values: Sequence[float], statistic: Sequence[float | None], limit: float
) -> list[tuple[float, float]]: ...
def estimate_percentile(
    sorted: Sequence[float], share: float, level: float
) -> tuple[float, float, float] | None: ...
def estimate_probability(
    met: int, count: int, level: float, unknown: int
) -> tuple[float, float, float] | None: ...
def rank_correlation(x: Sequence[float], y: Sequence[float]) -> float | None: ...
def xla_functions() -> list[tuple[str, int]]: ...
