"""Trajectories in files: CSV, JSON, and ROS messages as dicts.

The CSV has the columns `time,<joint names>`.
"""

import io
import json
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from rapidgen._reading import read_foreign
from rapidgen.client.errors import InvalidTrajectory, fault
from rapidgen.diagnostics import Diagnostic, Span, error

Array = npt.NDArray[np.float64]
_SHOWN = 20
"""Findings of one file that are worth reading."""
_LARGEST = 256_000_000
"""Bytes of a trajectory."""
_MCAP = b"\x89MCAP"
"""First columns of a recording of `rapidgen sim --record`."""


class Content(NamedTuple):
    """Content of a file, with the arguments of a Trajectory."""

    times: npt.ArrayLike
    positions: npt.ArrayLike
    names: tuple[str, ...]
    path: str
    lines: tuple[int, ...] = ()


def _bad(
    message: str, path: Path, line: int = 1, column: int = 1, help: str = "", width: int = 0
) -> Diagnostic:
    end = column + width if width else 0
    span = Span(str(path), line, column, line if width else 0, end)
    return error("RG610", span, message, help)


def _read(path: Path) -> str:
    try:
        return read_foreign(path, _LARGEST).decode("utf-8-sig")
    except OSError as raised:
        reason = (raised.strerror or str(raised)).lower()
        raise InvalidTrajectory.because(
            "RG610",
            f"cannot read {path}: {reason}",
            "give the path of a CSV or JSON file",
            exit_code=2,
        ) from raised
    except UnicodeDecodeError as raised:
        help = "save it as UTF-8"
        if raised.object.startswith(_MCAP):
            help = f"it is a recording: `rapidgen view {path} --csv FILE.csv` writes its positions"
        raise InvalidTrajectory.because(
            "RG610", f"{path} is not text in UTF-8", help, exit_code=2
        ) from raised


def read_csv(path: Path) -> Content:
    """Read `time,<joint names>`; skip empty lines and lines starting with #."""
    text = _read(path)
    help = "the first line is `time,<joint names>`; then s and rad (m), with a decimal point"
    names: list[str] = []
    rows: list[list[float]] = []
    lines: list[int] = []
    findings: list[Diagnostic] = []
    for number, line in enumerate(text.splitlines(), 1):
        if not line.strip() or line.lstrip().startswith("#"):
            continue
        cells = line.split(",")
        if not names:
            names = [cell.strip() for cell in cells]
            if names[0] != "time" or len(names) < 2 or "" in names:
                raise InvalidTrajectory(
                    _bad("the header is not `time,<joint names>`", path, number, help=help),
                    exit_code=2,
                )
            double = sorted({name for name in names if names.count(name) > 1})
            findings += [_bad(f"column '{name}' is there twice", path, number) for name in double]
            continue
        if len(cells) != len(names):
            message = f"{len(cells)} values, the header has {len(names)}"
            findings.append(_bad(message, path, number, help=help if not findings else ""))
            continue
        row = []
        column = 1
        for cell in cells:
            try:
                row.append(_number(cell))
            except ValueError:
                message = f"'{cell.strip()}' is not a number"
                place = (path, number, column)
                help = "s, rad and m, with a decimal point" if not findings else ""
                findings.append(_bad(message, *place, width=max(1, len(cell)), help=help))
            column += len(cell) + 1
        if len(row) == len(names):
            rows.append(row)
            lines.append(number)
    if not names:
        raise InvalidTrajectory(_bad("the file is empty", path, help=help), exit_code=2)
    if findings:
        if len(findings) > _SHOWN:
            remaining = fault(
                "RG610", f"{len(findings) - _SHOWN} more faults of this kind in {path}"
            )
            findings = [*findings[:_SHOWN], remaining]
        raise InvalidTrajectory(findings, exit_code=2)
    table = np.array(rows, dtype=np.float64).reshape(len(rows), len(names))
    return Content(table[:, 0], table[:, 1:], tuple(names[1:]), str(path), tuple(lines))


def _number(cell: str) -> float:
    """Parse a number of a table.

    Spellings that only Python accepts (`1_0`) raise ValueError.
    """
    if "_" in cell:
        raise ValueError(cell)
    return float(cell)


def write_csv(path: Path, times: Array, positions: Array, names: Sequence[str]) -> None:
    """Write `time,<joint names>`. Raises OSError."""
    # Imported late: moving a robot does not need it and must start fast.
    import csv

    from rapidgen._atomic_write import write_whole

    names = names or [f"joint_{i + 1}" for i in range(positions.shape[1])]
    out = io.StringIO()
    writer = csv.writer(out, lineterminator="\n")
    writer.writerow(["time", *names])
    for time, row in zip(times.tolist(), positions.tolist(), strict=True):
        writer.writerow([repr(time), *(repr(value) for value in row)])
    write_whole(path, out.getvalue().encode())


def read_json(path: Path) -> Content:
    """Read JSON: `joint_names`, `times`, `positions`, or a JointTrajectory.

    A JointTrajectory has `points`.
    """
    text = _read(path)
    try:
        content = json.loads(text)
    except json.JSONDecodeError as raised:
        raise InvalidTrajectory(
            _bad(f"not JSON: {raised.msg.lower()}", path, raised.lineno, raised.colno), exit_code=2
        ) from raised
    except RecursionError as raised:
        raise InvalidTrajectory(_bad("nested too deep", path), exit_code=2) from raised
    if not isinstance(content, dict):
        raise InvalidTrajectory(_bad("the file holds no JSON object", path), exit_code=2)
    if "points" in content:
        return from_ros(content, path=str(path))
    missing = [key for key in ("times", "positions") if key not in content]
    if missing:
        raise InvalidTrajectory(
            _bad(
                f"'{missing[0]}' is missing",
                path,
                help="`joint_names`, `times` and `positions`, or `joint_names` and `points`",
            ),
            exit_code=2,
        )
    names = _names(content.get("joint_names", []), str(path))
    return Content(content["times"], content["positions"], names, str(path))


def from_ros(message: Mapping[str, Any], *, path: str = "") -> Content:
    """A trajectory_msgs/JointTrajectory as ROS 1 or 2 tools print it.

    `time_from_start` is a number of s or a dict with `secs`/`nsecs` or `sec`/`nanosec`. Only
    positions and times are used. Raises InvalidTrajectory, all faults.
    """
    where = f" in {path}" if path else ""
    points = message.get("points")
    if not isinstance(points, Sequence) or isinstance(points, str):
        raise InvalidTrajectory.because("RG610", f"'points' is not a list{where}", exit_code=2)
    names = _names(message.get("joint_names", []), path)
    times: list[float] = []
    positions: list[list[float]] = []
    findings: list[Diagnostic] = []
    for index, point in enumerate(points):
        try:
            times.append(_seconds(point["time_from_start"]))
            row = [float(value) for value in point["positions"]]
        except (KeyError, TypeError, ValueError) as raised:
            what = f"{raised} is missing" if isinstance(raised, KeyError) else str(raised)
            findings.append(fault("RG610", f"point {index}{where}: {what}"))
            continue
        if positions and len(row) != len(positions[0]):
            findings.append(fault("RG610", f"point {index}{where}: {len(row)} positions"))
            continue
        positions.append(row)
    if findings:
        raise InvalidTrajectory(findings[:_SHOWN], exit_code=2)
    width = len(positions[0]) if positions else len(names)
    return Content(times, np.array(positions).reshape(len(positions), width), names, path)


def _names(names: object, path: str) -> tuple[str, ...]:
    if not isinstance(names, Sequence) or not all(isinstance(name, str) for name in names):
        where = f" in {path}" if path else ""
        raise InvalidTrajectory.because(
            "RG610", f"'joint_names' is not a list of texts{where}", exit_code=2
        )
    return tuple(names)


def _seconds(value: object) -> float:
    if isinstance(value, Mapping):
        for complete, part in (("secs", "nsecs"), ("sec", "nanosec")):
            if complete in value:
                return float(value[complete]) + 1e-9 * float(value.get(part, 0))
        raise ValueError("time_from_start has neither secs nor sec")
    if isinstance(value, int | float) and not isinstance(value, bool):
        return float(value)
    raise ValueError("time_from_start is not a time")
