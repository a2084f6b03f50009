"""Rows as Parquet: the same bytes for the same rows, and a file that has its name only when it is complete."""

from __future__ import annotations

import contextlib
import os
import socket
from collections.abc import Callable, Iterator, Sequence
from pathlib import Path
from typing import Any

import numpy as np
import pyarrow as pa
import pyarrow.parquet as pq

from .job import Row
from .plan import Plan

__all__ = [
    "WRITER",
    "atomic",
    "atomic_text",
    "merge",
    "remove_partial",
    "schema",
    "table",
    "write",
]

#: What the bytes of a file depend on beside its rows.
WRITER = f"pyarrow {pa.__version__}, format 1"

#: This machine, in the name of a file that is being written: several may write to one folder.
_HOST = "".join(letter for letter in socket.gethostname() if letter.isalnum() or letter == "-")

#: Fixed, so that another default of another version is seen.
_OPTIONS: dict[str, Any] = {
    "version": "2.6",
    "data_page_version": "1.0",
    "compression": "zstd",
    "compression_level": 3,
    "use_dictionary": ["state"],
    "write_statistics": True,
    "store_schema": True,
}


def schema(plan: Plan, fields: Sequence[tuple[str, str]], about: dict[str, str]) -> pa.Schema:
    """The columns: ``sample``, the varied keys, ``state``, the numbers with their units."""
    keys = [pa.field(label, _type(plan, index), False) for index, label in enumerate(plan.labels)]
    numbers = [pa.field(name, pa.float64(), True, {"unit": unit}) for name, unit in fields]
    first = pa.field("sample", pa.int64(), False)
    return pa.schema([first, *keys, pa.field("state", pa.string(), False), *numbers], about)


def table(columns: pa.Schema, plan: Plan, start: int, rows: Sequence[Row]) -> pa.Table:
    """The rows of consecutive samples. Numbers that do not exist are null; so are those of a sample that failed."""
    stop = start + len(rows)
    keys = len(plan.labels)
    arrays = [pa.array(range(start, stop), pa.int64())]
    for index in range(keys):
        of_type = columns.field(1 + index).type
        values = [row[index] for row in plan.values[start:stop]]
        text = pa.types.is_string(of_type)
        arrays.append(pa.array([str(v) if text else float(v) for v in values], of_type))
    arrays.append(pa.array(["ok" if message is None else message for _, message in rows]))
    missing = [float("nan")] * (len(columns) - keys - 2)
    numbers = np.array([missing if row is None else row for row, _ in rows], dtype=float)
    for index in range(len(missing)):
        arrays.append(pa.array(numbers[:, index], from_pandas=True))
    return pa.Table.from_arrays(arrays, schema=columns)


def write(rows: pa.Table, path: Path) -> None:
    """Writes a partition."""
    with atomic(path) as partial:
        pq.write_table(rows, partial, row_group_size=max(len(rows), 1), **_OPTIONS)


def merge(parts: Sequence[Path], columns: pa.Schema, path: Path) -> None:
    """Writes one file of some partitions in order, each a row group; only one is in memory."""
    with atomic(path) as partial, pq.ParquetWriter(partial, columns, **_OPTIONS) as writer:
        for part in parts:
            rows = pq.read_table(part)
            # What the file says of itself is that of the campaign.
            writer.write_table(rows.replace_schema_metadata(columns.metadata), len(rows))


def atomic_text(path: Path, text: str) -> None:
    """Writes a text."""
    with atomic(path) as partial:
        partial.write_text(text, encoding="utf-8", newline="\n")


@contextlib.contextmanager
def atomic(path: Path) -> Iterator[Path]:
    """A file to write that gets its name when the block ends; an error leaves none behind."""
    partial = path.with_name(f".{path.name}.{_HOST}.{os.getpid()}.partial")
    try:
        yield partial
        _sync(partial, os.O_RDWR)
        os.replace(partial, path)
        if os.name == "posix":
            _sync(path.parent, os.O_RDONLY)
    finally:
        _quietly(lambda: partial.unlink(missing_ok=True))


def remove_partial(folder: Path) -> None:
    """Removes what processes of this machine that were ended while they wrote have left in a folder."""
    for partial in folder.glob(f".*.{_HOST}.*.partial"):
        number = partial.name.split(".")[-2]
        if number.isdecimal() and not _lives(int(number)):
            with contextlib.suppress(OSError):
                partial.unlink(missing_ok=True)


def _lives(process: int) -> bool:
    """Whether a process is there; true where that cannot be found out."""
    if os.name != "posix":
        return True
    try:
        os.kill(process, 0)
    except ProcessLookupError:
        return False
    except OSError:
        return True
    return True


def _sync(path: Path, flags: int) -> None:
    handle = os.open(path, flags)
    try:
        os.fsync(handle)
    finally:
        os.close(handle)


def _quietly(action: Callable[[], None]) -> None:
    with contextlib.suppress(OSError):
        action()


def _type(plan: Plan, index: int) -> pa.DataType:
    """Numbers, unless one of the values is a text."""
    numbers = all(
        isinstance(row[index], int | float | np.number) and not isinstance(row[index], bool)
        for row in plan.values
    )
    return pa.float64() if numbers else pa.string()
