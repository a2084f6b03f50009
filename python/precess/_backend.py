"""Where batches are computed: the argument `backend`, NVRTC of PyPI, and why a GPU was not used."""

from __future__ import annotations

import warnings

from ._wanted import text

__all__ = ["is_cuda", "warn_of"]

#: Of PyPI, which puts the library where no loader looks.
_PACKAGES = ("nvidia.cuda_nvrtc", "nvidia.cu13")


def is_cuda(backend: str) -> bool:
    """Whether a GPU is wanted."""
    name = text("backend", backend)
    if name not in ("cpu", "cuda"):
        raise ValueError(f"backend is {name!r}; it is 'cpu' or 'cuda'")
    if name == "cuda":
        _load_compiler()
    return name == "cuda"


def _load_compiler() -> None:
    """Loads NVRTC of PyPI, so that it is found by its name; whoever needs it says if it is not there."""
    # Here, so that `import precess` does not take their time.
    import ctypes
    import importlib.util
    from pathlib import Path

    for package in _PACKAGES:
        try:
            found = importlib.util.find_spec(package)
        except ModuleNotFoundError:
            continue
        places = found.submodule_search_locations if found is not None else None
        for place in places or ():
            for library in sorted(Path(place).glob("lib/libnvrtc.so.*")):
                try:
                    ctypes.CDLL(str(library))
                except OSError:
                    continue


def warn_of(reason: str | None, before: str | None, level: int) -> str | None:
    """Says once why the processor computes, to the caller so many calls above."""
    if reason is not None and reason != before:
        text_of = f"backend 'cuda': {reason}; the processor computes, with the same bits"
        warnings.warn(text_of, RuntimeWarning, stacklevel=level + 1)
    return reason
