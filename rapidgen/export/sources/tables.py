"""Tables of joints or poses: CSV, JSON and numpy arrays.

Columns have names, in a header or in `columns`:

- `time` and joint names: a trajectory.
- Joint names alone: moves to joints.
- `x y z` with `q1 q2 q3 q4` (scalar first) or `qx qy qz qw` (names of ROS), with `nx ny nz` (the
  surface's normal: the tool's z axis points against it), or alone; `speed` in units of length per
  s.
"""

import csv
import json
from collections.abc import Sequence
from dataclasses import dataclass, replace
from math import isfinite
from pathlib import Path

import numpy as np

from rapidgen._reading import read_foreign
from rapidgen.axes import frames
from rapidgen.axes.frames import Pose
from rapidgen.diagnostics import Diagnostic, Span, refusal
from rapidgen.export.sources.toolpath import (
    JointPath,
    PathStep,
    SourceOptions,
    Toolpath,
    bad_source,
    checked_steps,
    fixed_orientation,
    need_length,
    read_text,
    reject,
    tool_orientation,
    unit_quaternion,
)

_PLACE, _TURN, _NORMAL = ("x", "y", "z"), ("q1", "q2", "q3", "q4"), ("nx", "ny", "nz")
_ROS = {"qw": "q1", "qx": "q2", "qy": "q3", "qz": "q4"}
_POSE = frozenset((*_PLACE, *_TURN, *_NORMAL, "speed"))
_HEADER = "name the columns: `time,<joint names>`, `<joint names>` or `x,y,z,q1,q2,q3,q4`"
_LARGEST = 256_000_000


@dataclass(frozen=True, slots=True)
class _Table:
    """Rows of numbers with the line of each; a row of an array has its number as line."""

    path: str
    columns: tuple[str, ...]
    rows: list[list[float]]
    lines: list[int]


def read_table(path: Path, options: SourceOptions) -> Toolpath | JointPath:
    """Read a table. Raises DiagnosticError RG760 with all faults, RG761 for a missing option."""
    suffix = path.suffix.lower()
    if suffix in (".npy", ".npz"):
        table = _array(path, options)
    elif suffix == ".json":
        table = _json(path, options)
    else:
        table = _csv(path, options)
    if not table.rows:
        reject([bad_source(str(path), 1, f"{path} has no points", "add at least one")])
    table = replace(table, columns=_known_names(table.columns))
    double = sorted({c for c in table.columns if table.columns.count(c) > 1})
    if double:
        reject([bad_source(str(path), 1, f"column '{double[0]}' is there twice")])
    if _PLACE[0] in table.columns:
        return _poses(table, options)
    return _joints(table, options)


def _known_names(columns: tuple[str, ...]) -> tuple[str, ...]:
    """Return columns with one spelling of time and of quaternions."""
    if set(_ROS) <= set(columns):
        columns = tuple(_ROS.get(name, name) for name in columns)
    return tuple("time" if name.lower() == "time" else name for name in columns)


def _csv(path: Path, options: SourceOptions) -> _Table:
    columns, rows, lines = options.columns, [], []
    findings: list[Diagnostic] = []
    text = read_text(path)
    shortened = text[:2000]
    separator = ";" if shortened.count(";") > shortened.count(",") else ","
    if "," not in shortened and ";" not in shortened:
        separator = " "
    reader = csv.reader(text.splitlines(), delimiter=separator, skipinitialspace=True)
    try:
        for cells in reader:
            cells = [cell.strip() for cell in cells if cell.strip() or separator != " "]
            if not any(cells) or cells[0].startswith("#"):
                continue
            line = reader.line_num
            if not columns:
                if all(_is_number(cell) for cell in cells):
                    help = f"--columns, or a header line: {_HEADER}"
                    reject([bad_source(str(path), line, "the columns have no names", help)])
                columns = tuple(cells)
                continue
            if len(cells) != len(columns):
                message = f"{len(cells)} values for {len(columns)} columns"
                findings.append(bad_source(str(path), line, message))
                continue
            try:
                rows.append([_number(cell) for cell in cells])
                lines.append(line)
            except ValueError as fault:
                findings.append(bad_source(str(path), line, str(fault), "with a decimal point"))
    except csv.Error as fault:
        findings.append(bad_source(str(path), reader.line_num, str(fault)))
    reject(findings)
    return _Table(str(path), columns, rows, lines)


def _is_number(cell: str) -> bool:
    try:
        float(cell)
    except ValueError:
        return False
    return True


def _number(cell: str) -> float:
    """Return a finite number. Raises ValueError for other texts."""
    try:
        value = float(cell) if "_" not in cell else float("nan")
    except ValueError:
        raise ValueError(f"'{cell}' is not a number") from None
    if not isfinite(value):
        raise ValueError(f"'{cell}' is not a finite number")
    return value


def _json(path: Path, options: SourceOptions) -> _Table:
    try:
        content = json.loads(read_text(path))
    except json.JSONDecodeError as fault:
        message = f"not JSON: {fault.msg.lower()}"
        reject([bad_source(str(path), fault.lineno, message, column=fault.colno)])
    except RecursionError:
        reject([bad_source(str(path), 1, "nested too deep")])
    columns: Sequence[object] = options.columns
    if isinstance(content, dict):
        if {"joint_names", "times", "positions"} <= set(content):
            columns = ["time", *_list(content["joint_names"])]
            pairs = zip(_list(content["times"]), _list(content["positions"]), strict=False)
            content = [[time, *_list(row)] for time, row in pairs]
        else:
            columns = _list(content.get("columns", columns))
            content = content.get("rows")
    if not isinstance(content, list) or not columns:
        help = '{"columns": [names], "rows": [[numbers]]}, or joint_names, times and positions'
        reject([bad_source(str(path), 1, "the file has no table", help)])
    if not all(isinstance(name, str) for name in columns):
        reject([bad_source(str(path), 1, "the names of columns are texts")])
    rows, findings = [], []
    for number, row in enumerate(content):
        try:
            values = [_number(str(value)) for value in _list(row)]
            if len(values) != len(columns):
                raise ValueError(f"{len(values)} values for {len(columns)} columns")
            rows.append(values)
        except ValueError as fault:
            findings.append(bad_source(str(path), 0, f"{path}: row {number}: {fault}"))
    reject(findings)
    return _Table(str(path), tuple(map(str, columns)), rows, [])


def _list(value: object) -> list[object]:
    return list(value) if isinstance(value, list | tuple) else []


def _array(path: Path, options: SourceOptions) -> _Table:
    import io

    try:
        # Pickled objects would be executed: they are refused by allow_pickle.
        loaded = np.load(io.BytesIO(read_foreign(path, _LARGEST)), allow_pickle=False)
        array = loaded if isinstance(loaded, np.ndarray) else loaded[loaded.files[0]]
        values = np.asarray(array, dtype=np.float64)
    except OSError as fault:
        reason = (fault.strerror or str(fault)).lower()
        raise refusal("RG760", None, f"cannot read {path}: {reason}", "name a file") from fault
    except (ValueError, EOFError, IndexError, KeyError, TypeError) as fault:
        raise refusal("RG760", None, f"{path} is no array of numbers: {fault}") from fault
    if not options.columns:
        raise refusal("RG761", None, f"{path}: the columns have no names", f"--columns: {_HEADER}")
    if values.ndim != 2 or values.shape[1] != len(options.columns):
        message = f"{path} has the shape {values.shape}, not (n, {len(options.columns)})"
        raise refusal("RG760", None, message, "one row for each point")
    wrong = np.flatnonzero(~np.isfinite(values).all(axis=1))
    reject([bad_source(str(path), 0, f"{path}: row {n} is not finite") for n in wrong.tolist()])
    return _Table(str(path), options.columns, values.tolist(), [])


def _span(table: _Table, number: int) -> Span:
    # Arrays and JSON have no lines: the number of the row stands for it.
    return Span(table.path, table.lines[number] if table.lines else number + 1, 1)


def _joints(table: _Table, options: SourceOptions) -> Toolpath | JointPath:
    """Return rows of joints. Angles are rad unless the user gives another unit."""
    names = tuple(column for column in table.columns if column not in ("time", "speed"))
    places = [table.columns.index(name) for name in names]
    angle = options.angle
    if "time" not in table.columns and angle is None:
        raise refusal(
            "RG761", _span(table, 0), "the unit of angles is not given", "--angles rad or deg"
        )
    factor = 1.0 if angle is None else angle
    positions = tuple(tuple(row[i] * factor for i in places) for row in table.rows)
    if "time" in table.columns:
        at = table.columns.index("time")
        times = tuple(row[at] for row in table.rows)
        return JointPath(times, positions, names, table.path, tuple(table.lines))
    steps = tuple(
        PathStep("joints", _span(table, n), joints=joints, speed=options.speed)
        for n, joints in enumerate(positions)
    )
    reject(checked_steps(steps, table.path))
    return Toolpath(steps, names)


def _poses(table: _Table, options: SourceOptions) -> Toolpath:
    columns = table.columns
    unknown = sorted(set(columns) - _POSE)
    if unknown:
        message = f"column '{unknown[0]}' is unknown in a table of poses"
        reject([bad_source(table.path, 1, message, f"columns: {', '.join(sorted(_POSE))}")])
    groups = [group for group in (_PLACE, _TURN, _NORMAL) if set(group) & set(columns)]
    missing = [name for group in groups for name in group if name not in columns]
    if missing:
        reject([bad_source(table.path, 1, f"column '{missing[0]}' is missing")])
    unit = need_length(options, table.path, table.lines[0] if table.lines else 1)
    index = {name: columns.index(name) for name in columns}
    fixed = None
    if _TURN not in groups and _NORMAL not in groups:
        fixed = fixed_orientation(options, table.path)
    elif _NORMAL in groups and options.turn is None:
        message = "the rotation about the tool's axis is not given"
        raise refusal("RG761", _span(table, 0), message, "--turn 0, in degrees")
    steps, findings = [], []
    for number, row in enumerate(table.rows):
        span = _span(table, number)
        place = tuple(row[index[name]] * unit for name in _PLACE)
        try:
            if fixed is not None:
                turned = fixed
            elif _TURN in groups:
                turned = unit_quaternion([row[index[name]] for name in _TURN])
            else:
                nx, ny, nz = (row[index[name]] for name in _NORMAL)
                turned = tool_orientation((-nx, -ny, -nz), options.turn or 0.0)
        except (ValueError, ZeroDivisionError) as fault:
            reason = str(fault) if isinstance(fault, ValueError) else "the normal has length 0"
            findings.append(bad_source(table.path, span.line, reason))
            continue
        pose: Pose = frames.compose(options.origin, ((place[0], place[1], place[2]), turned))
        speed = row[index["speed"]] * unit if "speed" in index else options.speed
        steps.append(PathStep("line", span, pose=pose, speed=speed))
    reject([*findings, *checked_steps(steps, table.path)] if steps else findings)
    return Toolpath(tuple(steps))
