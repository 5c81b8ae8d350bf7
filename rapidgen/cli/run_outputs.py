"""Additional outputs of `run` and `sim`: trace, profile, coverage, plots of the motion."""

import sys
from contextlib import contextmanager
from dataclasses import dataclass, field, replace
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING

from rapidgen._atomic_write import check_writable, write_whole
from rapidgen.cli.terminal import letters
from rapidgen.diagnostics import refusal

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from rapidgen.controller.boot_targets import Bootable
    from rapidgen.controller.controller import VirtualController
    from rapidgen.controller.cycle_report import CycleRecorder, EarlierRobot
    from rapidgen.controller.runner import ControllerRunner
    from rapidgen.controller.tracing import Coverage, Profile
    from rapidgen.motion.motion import Motion
    from rapidgen.motion.recorder import Recorder
    from rapidgen.viewer.appearance import Appearance

_SAMPLES = 5000
"""Maximum number of samples in a plot; the shortest period is 4 ms."""
_PAGES = (".html", ".htm")
_ROWS = 40
"""Number of rows of a profile on a terminal."""


@dataclass(frozen=True)
class Outputs:
    """The requested outputs. `profile` is a file, or `-` for stderr."""

    trace: bool = False
    profile: str = ""
    coverage: tuple[Path, ...] = ()
    plots: tuple[Path, ...] = ()
    cycle: tuple[Path, ...] = ()
    """Cycle-time reports, .html or .json."""
    compared: str = ""
    """Name of an earlier cycle-time report."""
    earlier: "tuple[EarlierRobot, ...]" = ()
    """Robots of that report."""
    record: Path | None = None
    """Recording of a run, .mcap."""

    @property
    def tracing(self) -> bool:
        """True if the controller has to report every statement."""
        return self.trace or bool(self.profile) or bool(self.coverage) or bool(self.cycle)

    def check_files_writable(self) -> None:
        """Refuse, before anything runs, a file that cannot be written behind it."""
        files = [*self.coverage, *self.cycle, *([self.record] if self.record else [])]
        for path in self.cycle:
            if path.suffix.lower() not in (*_PAGES, ".json"):
                raise refusal(
                    "RG901",
                    None,
                    f"--cycle-report {path}: the suffix is neither .html nor .json",
                    "give the file one of these suffixes",
                )
        if self.plots:
            from rapidgen.viewer.plotting import files_of

            files += [file for plot in self.plots for file in files_of(plot)]
        if self.profile not in ("", "-"):
            files.append(Path(self.profile))
        twice = next((file for file in files if files.count(file) > 1), None)
        if twice is not None:
            raise refusal("RG901", None, f"{twice} would be written twice", "name another file")
        check_files_writable(files)


@dataclass
class Observed:
    """Watches a controller from before its program starts; `write` at the end."""

    controller: "VirtualController"
    requested: Outputs
    _profile: "Profile | None" = None
    _coverage: "Coverage | None" = None
    _recorders: "dict[str, Recorder]" = field(default_factory=dict)
    _cycle: "CycleRecorder | None" = None
    _moved: "dict[str, None]" = field(default_factory=dict)
    """Groups whose robots have moved."""

    def __post_init__(self) -> None:
        from rapidgen.controller.tracing import Coverage, Profile, Trace

        if self.requested.trace:
            Trace(self.controller, sys.stderr)
        if self.requested.profile:
            self._profile = Profile(self.controller)
        if self.requested.coverage:
            self._coverage = Coverage(self.controller)
        if self.requested.plots:
            self._recorders = self.controller.record()
        if self.requested.cycle:
            from rapidgen.controller.cycle_report import CycleRecorder

            self._cycle = CycleRecorder(self.controller)
        for name, group in self.controller.motion.groups.items():
            group.observers.append(partial(self._note_motion, name))

    def _note_motion(self, name: str, motion: "Motion") -> None:
        if motion.end > motion.since:
            self._moved[name] = None

    @property
    def duration(self) -> str:
        """The simulated time with its error; empty if no robot has moved."""
        from rapidgen.motion.accelerations import duration_note

        groups = self.controller.motion.groups
        notes = {name: duration_note(groups[name].config) for name in self._moved}
        if not notes:
            return ""
        texts = dict.fromkeys(notes.values())
        if len(texts) > 1:
            texts = dict.fromkeys(f"{name} {note}" for name, note in notes.items())
        return f"{self.controller.now:.3f} s ({'; '.join(texts)})"

    def write(self) -> None:
        """Write all requested outputs."""
        if self._profile is not None:
            _write_profile(self._profile, self.requested.profile)
        if self._coverage is not None:
            for path in self.requested.coverage:
                page = path.suffix.lower() in _PAGES
                text = _page(self.controller, self._coverage) if page else self._coverage.lcov()
                write_whole(path, text.encode("utf-8", "replace"))
        if self.requested.plots:
            self._draw(self.requested.plots)
        if self._cycle is not None:
            self._write_cycle(self._cycle)

    def _write_cycle(self, recorder: "CycleRecorder") -> None:
        from rapidgen.viewer.cycle_page import cycle_page, summary

        report, earlier = recorder.report(), self.requested.earlier
        for path in self.requested.cycle:
            page = path.suffix.lower() in _PAGES
            text = cycle_page(report, earlier, self.requested.compared) if page else report.json()
            write_whole(path, text.encode("utf-8", "replace"))
        sys.stderr.write(summary(report, earlier))

    def _draw(self, plots: tuple[Path, ...]) -> None:
        from rapidgen.motion.accelerations import duration_note
        from rapidgen.motion.recorder import PERIOD
        from rapidgen.viewer import plot as draw
        from rapidgen.viewer.plotting import files_of

        groups = self.controller.motion.groups
        several = len(self._recorders) > 1
        for group, recorder in self._recorders.items():
            # A wait of an hour leaves as many samples to the motion as none.
            period = max(PERIOD, recorder.moving() / _SAMPLES)
            note = duration_note(groups[group].config)
            title = f"{self.controller.system.name}, {group} (durations {note})"
            made = draw(recorder.recording(period, standing=False), title=title)
            for plot in plots:
                for path in files_of(plot.with_stem(f"{plot.stem}_{group}") if several else plot):
                    made.save(path)


@contextmanager
def observing(runner: "ControllerRunner", requested: Outputs) -> "Iterator[None]":
    """Write the outputs at the end and before each restart.

    A restart discards the data. The names of the files before it have a number: `F-1.html`.
    """
    now = Observed(runner.controller, requested)

    def before() -> None:
        now.requested = replace(
            requested, coverage=numbered(requested.coverage), plots=numbered(requested.plots)
        )
        now.write()

    def numbered(paths: tuple[Path, ...]) -> tuple[Path, ...]:
        return tuple(path.with_stem(f"{path.stem}-{runner.restarts + 1}") for path in paths)

    def again() -> None:
        nonlocal now
        now = Observed(runner.controller, requested)

    runner.on_restart.append(before)
    runner.on_boot.append(again)
    try:
        yield
    finally:
        now.write()


def read_appearance(target: "Bootable") -> "Appearance":
    """Return the appearance of the robots; report what cannot be drawn."""
    from rapidgen.viewer.appearance import appearance

    look = appearance(target.groups, target.described, target.overrides, target.cell)
    for fault in look.faults:
        sys.stderr.write(f"not drawn as described: {letters(fault)}\n")
    return look


@contextmanager
def recording(
    controller: "VirtualController", path: Path | None, target: "Bootable"
) -> "Iterator[None]":
    """Record a run on the virtual clock, if a file is given."""
    if path is None:
        yield
        return
    from rapidgen.viewer.recording.appearance import carried
    from rapidgen.viewer.recording.writer import record

    end = record(controller, path, (), carried(read_appearance(target)))
    try:
        yield
    finally:
        end()


def read_earlier(path: Path) -> "tuple[EarlierRobot, ...]":
    """Return the robots of an earlier cycle-time report. Raises DiagnosticError RG901."""
    from rapidgen.controller.cycle_report import read_report

    try:
        return tuple(read_report(path))
    except (OSError, ValueError) as fault:
        reason = (fault.strerror if isinstance(fault, OSError) else None) or fault
        raise refusal(
            "RG901",
            None,
            f"--compare {path}: {reason}",
            "write the report of the earlier run with `--cycle-report FILE.json`",
        ) from fault


def check_files_writable(files: "Sequence[Path]") -> None:
    """Check that files can be written. Raises DiagnosticError RG901."""
    for path in files:
        try:
            check_writable(path)
        except OSError as fault:
            raise refusal(
                "RG901",
                None,
                f"cannot write {path}: {fault.strerror}",
                "use a file in an existing folder with write permission",
            ) from fault


def _page(controller: "VirtualController", coverage: "Coverage") -> str:
    from rapidgen.viewer.coverage import CoveredFile, coverage_page

    hits = coverage.lines()
    texts = {
        module.file.path: module.tree.source.text
        for task in controller.rapid_tasks.values()
        for module in task.program.modules.values()
    }
    files = [CoveredFile(path, texts[path], lines) for path, lines in hits.items()]
    return coverage_page(f"Coverage of {controller.system.name}", files)


def _write_profile(profile: "Profile", target: str) -> None:
    import json

    rows = profile.as_data()
    if target != "-":
        write_whole(Path(target), (json.dumps(rows, indent=1) + "\n").encode())
        return
    sys.stderr.write(f"{'seconds':>12} {'passes':>9}  line\n")
    for row in rows[:_ROWS]:
        sys.stderr.write(
            f"{row['seconds']:12.6f} {row['passes']:9}  "
            f"{row['task']} {row['module']}/{row['routine']}:{row['line']}\n"
        )
