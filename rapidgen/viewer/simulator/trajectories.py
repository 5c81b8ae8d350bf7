"""Trajectories dropped on the page: checked, shown and executed.

They are checked as by the client, and executed through the simulator's own driver, as from any
other client.
"""

import tempfile
import threading
from collections.abc import Iterable, Iterator, Mapping
from pathlib import Path

import numpy as np

from rapidgen.axes.frames import distance
from rapidgen.axes.kinematics import Posture
from rapidgen.client import Robot, Trajectory
from rapidgen.client.core.checks import CheckedPoints, check_trajectory
from rapidgen.client.core.group import Group
from rapidgen.client.errors import InvalidTrajectory, RobotError
from rapidgen.client.trajectory import Array
from rapidgen.config.model import TrajectoryPolicy
from rapidgen.controller.runner import ControllerRunner
from rapidgen.diagnostics import Diagnostic, Severity
from rapidgen.motion.group import MotionGroup
from rapidgen.viewer.messages import Request, ToPage
from rapidgen.viewer.panel_messages import (
    RemoveTrajectory,
    RunTrajectory,
    TrajectoryFinding,
    UploadedTrajectory,
    UploadTrajectory,
)
from rapidgen.viewer.provider import Handler, RequestRejected
from rapidgen.viewer.robots import ToolAndWorkObject

_AXES = 10
"""Number of values of a frame."""
_PLACES = 2000
"""Approximate number of drawn points, unless the trajectory has more."""
_ANY = TrajectoryPolicy(capacity=1_000_000)
"""Capacity of the check; the driver reports its own."""


class TrajectoryProvider:
    """The trajectory of the page, common to all viewers."""

    def __init__(self, runner: ControllerRunner) -> None:
        self._runner = runner
        self._controller = runner.controller
        self._shown = self._last_sent = UploadedTrajectory()
        self._checked: CheckedPoints | None = None

    def whole(self) -> Iterable[ToPage]:
        """Return the trajectory, if there is one."""
        yield self._shown

    def changes(self) -> Iterable[ToPage]:
        """Return the trajectory if it or its state is new."""
        if self._shown is not self._last_sent:
            self._last_sent = self._shown
            yield self._shown

    def handlers(self) -> Mapping[type, Handler]:
        """Handlers that check, execute and drop a trajectory."""
        return {
            UploadTrajectory: self._drop,
            RunTrajectory: self._run,
            RemoveTrajectory: self._forget,
        }

    # -- checking -----------------------------------------------------------------------------

    def _drop(self, request: Request) -> str:
        assert isinstance(request, UploadTrajectory)
        self._rests()
        group = self._controller.motion.groups.get(request.group)
        if group is None:
            raise RequestRejected(f"there is no robot {request.group}")
        self._checked = None
        name = Path(request.file).name
        try:
            trajectory = _read(request)
            start = [*group.positions(), *[0.0] * _AXES][:_AXES]
            expected = Group(group.name, group.map, _ANY)
            self._checked = check_trajectory(trajectory, expected, start=start)
        except InvalidTrajectory as wrong:
            self._shown = UploadedTrajectory(
                group=group.name,
                file=name,
                findings=tuple(_finding(result, ()) for result in wrong.diagnostics),
                state="refused",
            )
            return ""
        self._shown = self._described(group, name, self._checked)
        return ""

    def _described(
        self, group: MotionGroup, name: str, checked: CheckedPoints
    ) -> UploadedTrajectory:
        steps = max(1, min(20, _PLACES // len(checked.wire)))
        way = tuple(_way(group, _between(checked.wire, steps)))
        times = np.repeat(checked.durations[1:] / steps, steps).tolist()
        legs = zip(way, way[1:], times, strict=False)
        lines = checked.trajectory.lines
        clearance, met = self._collisions(group, checked, steps)
        findings = [_finding(result, lines) for result in checked.warnings]
        if any(one.severity is Severity.ERROR for one in met):
            self._checked = None
        return UploadedTrajectory(
            group=group.name,
            file=name,
            seconds=float(checked.durations.sum()),
            points=len(checked.trajectory),
            way=way,
            pace=(0.0, *(distance(a, b) / s for a, b, s in legs)) if way else (),
            steps=steps,
            clearance=clearance if way else (),
            findings=(*findings, *(_finding(result, ()) for result in met)),
            state="checked" if self._checked is not None else "refused",
        )

    def _collisions(
        self, group: MotionGroup, checked: CheckedPoints, steps: int
    ) -> tuple[tuple[float, ...], tuple[Diagnostic, ...]]:
        """Return the clearance at each drawn place, and findings; nothing without detection.

        Other robots stand where they are. The corners of the driver are not part of the path.
        """
        monitor = self._controller.collisions
        if monitor is None:
            return (), ()
        from rapidgen.collision.check import LIMIT, check_path, clearances
        from rapidgen.collision.path import Path as CheckedPath

        world, count = monitor.world, len(group.config.joints)
        rows = np.array(list(_between(checked.wire, steps)))[:, :count]
        groups = self._controller.motion.groups
        postures = {
            name: np.repeat([groups[name].positions()], len(rows), axis=0)
            for name in world.columns
            if name != group.name
        }
        values = world.values({group.name: rows, **postures})
        legs = np.repeat(np.maximum(checked.durations[1:], 1e-6) / steps, steps)
        times = np.concatenate([[0.0], legs.cumsum()])
        path = CheckedPath.linear(times, values)
        curve = np.minimum(clearances(world.scene, path, times).curve(), LIMIT)
        report = check_path(
            world, path, lambda at: (f"after point {int(at // steps)}", None), Severity.ERROR
        )
        return tuple(curve.tolist()), report.diagnostics

    # -- executing ----------------------------------------------------------------------------

    def _run(self, _request: Request) -> str:
        self._rests()
        checked = self._checked
        if checked is None:
            raise RequestRejected("there is no trajectory that could be executed")
        group = self._controller.motion.groups[self._shown.group]
        listeners, ports = self._controller.network.listeners, group.config.ports
        if ports.motion not in listeners or ports.state not in listeners:
            raise RequestRejected("this program is not a driver: it accepts no trajectories")
        numbers = (ports.motion, ports.state, ports.control)
        known = [str(listeners[port][1]) for port in numbers if port in listeners]
        address = f"{listeners[ports.motion][0]}:{','.join(known)}"
        self._shown = self._shown.model_copy(update={"state": "running", "detail": ""})
        trajectory = Trajectory(checked.trajectory.times, checked.trajectory.positions)
        threading.Thread(target=self._execute, args=(address, trajectory), daemon=True).start()
        return ""

    def _execute(self, address: str, trajectory: Trajectory) -> None:
        """Execute on a separate thread, as a client.

        The controller's thread has to answer meanwhile.
        """
        text = ""
        try:
            with Robot(address) as robot:
                robot.execute(trajectory).result()
        except RobotError as error:
            text = "; ".join(found.message for found in error.diagnostics)

        def end() -> None:
            state = "failed" if text else "done"
            self._shown = self._shown.model_copy(update={"state": state, "detail": text})

        self._runner.post(end)

    def _forget(self, _request: Request) -> str:
        self._rests()
        self._shown, self._checked = UploadedTrajectory(), None
        return ""

    def _rests(self) -> None:
        if self._shown.state == "running":
            raise RequestRejected("the trajectory is being executed")


def _read(request: UploadTrajectory) -> Trajectory:
    """Parse the text. Raises InvalidTrajectory."""
    is_json = request.file.lower().endswith(".json")
    with tempfile.TemporaryDirectory(prefix="rapidgen-view-") as folder:
        path = Path(folder) / ("dropped.json" if is_json else "dropped.csv")
        path.write_text(request.text, encoding="utf-8", errors="replace")
        return Trajectory.from_json(path) if is_json else Trajectory.from_csv(path)


def _between(wire: Array, steps: int) -> Iterator[Posture]:
    """Return the points and interpolated ones: straight in joint space."""
    places = np.arange((len(wire) - 1) * steps + 1) / steps
    columns = [np.interp(places, np.arange(len(wire)), column) for column in wire.T]
    return (tuple(row) for row in np.array(columns).T.tolist())


def _way(group: MotionGroup, wire: Iterable[Posture]) -> Iterable[tuple[float, float, float]]:
    """Places of the configured TCP."""
    carried, count = ToolAndWorkObject.configured(group.config), len(group.config.joints)
    for values in wire:
        tcp = carried.tcp(group.kinematics, values[:count])
        if tcp is not None:
            yield tcp[0]


def _finding(findings: Diagnostic, lines: tuple[int, ...]) -> TrajectoryFinding:
    line = findings.span.line if findings.span is not None else None
    return TrajectoryFinding(
        code=findings.code,
        severity=findings.severity.name.lower(),
        message=findings.message,
        help=findings.help,
        line=line,
        point=lines.index(line) if line in lines else None,
    )
