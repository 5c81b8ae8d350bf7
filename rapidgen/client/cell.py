"""Several groups or robots, started together.

When one fails, all are stopped.
"""

import asyncio
import warnings
from collections.abc import Callable, Coroutine, Iterator, Mapping
from concurrent.futures import FIRST_EXCEPTION, Future, ThreadPoolExecutor, wait
from typing import TypeVar

from rapidgen._compat import Self
from rapidgen.client.aio import AsyncExecution, AsyncRobot
from rapidgen.client.core.checks import CheckedPoints
from rapidgen.client.core.download import Download
from rapidgen.client.core.motion import Result
from rapidgen.client.core.robot import Core
from rapidgen.client.core.state import State
from rapidgen.client.errors import InvalidTarget, InvalidTrajectory, RobotError
from rapidgen.client.flows.effects import Flow
from rapidgen.client.flows.motion import (
    control_answers,
    download_accepted,
    ready,
    send_end,
    send_points,
)
from rapidgen.client.sync import Execution, Robot
from rapidgen.client.trajectory import Trajectory
from rapidgen.diagnostics import Diagnostic

T = TypeVar("T")


class _Start:
    """Trajectories that start together."""

    def __init__(self, cores: Mapping[str, Core], trajectories: Mapping[str, Trajectory]) -> None:
        """Check every trajectory and report the faults of all."""
        findings: list[Diagnostic] = []
        self._cores = cores
        self._checked: dict[str, CheckedPoints] = {}
        for name, trajectory in trajectories.items():
            try:
                self._checked[name] = cores[name].check(trajectory, "download")
            except InvalidTrajectory as error:
                findings += error.diagnostics
        if findings:
            raise InvalidTrajectory(findings)
        self.motions: dict[str, Download] = {}

    def steps(self) -> Iterator[tuple[str, Flow[None]]]:
        """Begin all motions; send all points to all robots, then all end frames, then wait."""
        for name, checked in self._checked.items():
            motion = self._cores[name].begin(checked)
            assert isinstance(motion, Download)
            self.motions[name] = motion
        for step in (send_points, send_end, download_accepted):
            for name, motion in self.motions.items():
                yield name, step(self._cores[name], motion)

    def give_up(self, error: RobotError) -> None:
        """Mark all motions as ended."""
        for motion in self.motions.values():
            motion.failed(error)


class Cell:
    """Robots by name. All points go to all robots first, then all end frames."""

    def __init__(self, robots: Mapping[str, Robot]) -> None:
        if not isinstance(robots, Mapping):
            raise InvalidTarget.because(
                "RG607",
                f"a cell is made of robots by name, not of {type(robots).__name__}",
                'such as Cell({"left": Robot(...), "right": Robot(...)})',
                exit_code=2,
            )
        self.robots = dict(robots)

    def __enter__(self) -> Self:
        try:
            for robot in self.robots.values():
                robot.__enter__()
        except BaseException:
            self.close()
            raise
        return self

    def __exit__(self, kind: type[BaseException] | None, *_: object) -> None:
        unfinished = [] if kind is not None else _unfinished(self.robots)
        self.close()
        for text in unfinished:
            warnings.warn(text, RuntimeWarning, stacklevel=2)

    def close(self) -> None:
        """Close all; active motions are stopped first."""
        _each(self.robots, lambda robot: robot.close())

    def stop(self) -> dict[str, State | None]:
        """Stop all at once. Raises the first StopFailed after all were tried."""
        return _each(self.robots, lambda robot: robot.stop())

    def execute(self, trajectories: Mapping[str, Trajectory]) -> "CellExecution":
        """Start trajectories together, by robot name.

        Raises KeyError for a name that no robot has, InvalidTrajectory with the faults of all
        before a byte is sent; if one robot refuses or fails, all are stopped and its error is
        raised.
        """
        moving = _chosen(self.robots, trajectories)
        _each(moving, lambda robot: robot._runner.run(ready(robot._core)))
        start = _Start({name: robot._core for name, robot in moving.items()}, trajectories)
        _each(moving, lambda robot: robot._runner.run(control_answers(robot._core)))
        try:
            for name, flow in start.steps():
                moving[name]._runner.run(flow)
        except (RobotError, KeyboardInterrupt) as error:
            _each(moving, lambda robot: robot.stop())
            if isinstance(error, RobotError):
                start.give_up(error)
            raise
        motions = start.motions.items()
        executions = {name: Execution(moving[name]._runner, one) for name, one in motions}
        return CellExecution(executions, self)


def _unfinished(robots: Mapping[str, Robot] | Mapping[str, AsyncRobot]) -> list[str]:
    descriptions = {name: robot._unfinished() for name, robot in robots.items()}
    return [f"{name}: {text}" for name, text in descriptions.items() if text]


def _chosen(robots: Mapping[str, T], trajectories: Mapping[str, Trajectory]) -> dict[str, T]:
    """Return the robots with a trajectory.

    Raises KeyError for a name that no robot has.
    """
    unknown = sorted(set(trajectories) - set(robots))
    if unknown:
        raise KeyError(f"no robot of this cell is called {unknown[0]!r}")
    return {name: robot for name, robot in robots.items() if name in trajectories}


def _each(robots: Mapping[str, Robot], do: Callable[[Robot], T]) -> dict[str, T]:
    """Do the same for all robots at once.

    Raises the first error after all were tried.
    """
    with ThreadPoolExecutor(max(1, len(robots))) as pool:
        futures = {name: pool.submit(do, robot) for name, robot in robots.items()}
    return {name: future.result() for name, future in futures.items()}


class CellExecution:
    """Trajectories executed together."""

    def __init__(self, executions: Mapping[str, Execution], cell: Cell) -> None:
        self.executions = dict(executions)
        self._cell = cell

    @property
    def is_over(self) -> bool:
        """True if all trajectories have ended."""
        return all(execution.is_over for execution in self.executions.values())

    def cancel(self) -> dict[str, State | None]:
        """Stop all."""
        return self._cell.stop()

    def result(self, timeout: float | None = None) -> dict[str, Result]:
        """Wait for all robots.

        The first error stops all others and is raised; so does Ctrl-C.
        """
        with ThreadPoolExecutor(max(1, len(self.executions))) as pool:
            try:
                futures: dict[str, Future[Result]] = {
                    name: pool.submit(execution.result, timeout)
                    for name, execution in self.executions.items()
                }
                done, waiting = wait(futures.values(), return_when=FIRST_EXCEPTION)
            except KeyboardInterrupt:
                self._cell.stop()
                raise
            failed = [future for future in done if future.exception() is not None]
            if failed and waiting:
                self._cell.stop()
        for future in failed:
            future.result()
        return {name: future.result() for name, future in futures.items()}


class AsyncCell:
    """`Cell` with awaitable methods, for AsyncRobots of one loop."""

    def __init__(self, robots: Mapping[str, AsyncRobot]) -> None:
        self.robots = dict(robots)

    async def __aenter__(self) -> Self:
        try:
            for robot in self.robots.values():
                await robot.__aenter__()
        except BaseException:
            await self.close()
            raise
        return self

    async def __aexit__(self, kind: type[BaseException] | None, *_: object) -> None:
        unfinished = [] if kind is not None else _unfinished(self.robots)
        await self.close()
        for text in unfinished:
            warnings.warn(text, RuntimeWarning, stacklevel=2)

    async def close(self) -> None:
        """Close all; active motions are stopped first."""
        await _gather({name: robot.close() for name, robot in self.robots.items()})

    async def stop(self) -> dict[str, State | None]:
        """Stop all at once. Raises the first StopFailed after all were tried."""
        return await _gather({name: robot.stop() for name, robot in self.robots.items()})

    async def execute(self, trajectories: Mapping[str, Trajectory]) -> "AsyncCellExecution":
        """Start trajectories together, by robot name; see `Cell.execute`."""
        moving = _chosen(self.robots, trajectories)
        await _gather({name: r._runner.run(ready(r._core)) for name, r in moving.items()})
        start = _Start({name: robot._core for name, robot in moving.items()}, trajectories)
        await _gather({name: r._runner.run(control_answers(r._core)) for name, r in moving.items()})
        try:
            for name, flow in start.steps():
                await moving[name]._runner.run(flow)
        except (RobotError, asyncio.CancelledError) as error:
            await _gather({name: robot.stop() for name, robot in moving.items()})
            if isinstance(error, RobotError):
                start.give_up(error)
            raise
        motions = start.motions.items()
        executions = {name: AsyncExecution(moving[name]._runner, one) for name, one in motions}
        return AsyncCellExecution(executions, self)


async def _gather(waiting: Mapping[str, Coroutine[None, None, T]]) -> dict[str, T]:
    """Await all; raise the first error after all were tried."""
    outcomes = await asyncio.gather(*waiting.values(), return_exceptions=True)
    results: dict[str, T] = {}
    for name, outcome in zip(waiting, outcomes, strict=True):
        if isinstance(outcome, BaseException):
            raise outcome
        results[name] = outcome
    return results


class AsyncCellExecution:
    """`CellExecution` with awaitable methods."""

    def __init__(self, executions: Mapping[str, AsyncExecution], cell: AsyncCell) -> None:
        self.executions = dict(executions)
        self._cell = cell

    @property
    def is_over(self) -> bool:
        """True if all trajectories have ended."""
        return all(execution.is_over for execution in self.executions.values())

    async def cancel(self) -> dict[str, State | None]:
        """Stop all."""
        return await self._cell.stop()

    async def result(self, timeout: float | None = None) -> dict[str, Result]:
        """Wait for all robots.

        The first error stops all others and is raised; so does cancelling.
        """
        tasks = {
            name: asyncio.ensure_future(execution.result(timeout))
            for name, execution in self.executions.items()
        }
        try:
            done, waiting = await asyncio.wait(tasks.values(), return_when=asyncio.FIRST_EXCEPTION)
        except asyncio.CancelledError:
            for task in tasks.values():
                task.cancel()
            await asyncio.gather(*tasks.values(), return_exceptions=True)
            raise
        failed = [task for task in done if task.exception() is not None]
        if failed and waiting:
            await self._cell.stop()
            await asyncio.gather(*waiting, return_exceptions=True)
        for task in failed:
            task.result()
        return {name: task.result() for name, task in tasks.items()}
