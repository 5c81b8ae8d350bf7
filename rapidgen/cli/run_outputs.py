"""What `run` and `sim` write of a run beside its output: trace, profile, coverage, a plot of the
motion."""

import sys
from contextlib import contextmanager
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import TYPE_CHECKING

from rapidgen._atomic_write import check_writable, write_whole
from rapidgen.diagnostics import refusal

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from rapidgen.controller.controller import VirtualController
    from rapidgen.controller.runner import ControllerRunner
    from rapidgen.controller.tracing import Coverage, Profile
    from rapidgen.motion.recorder import Recorder

_SAMPLES = 5000
"""Of a plot, at most; of short runs every 4 ms."""
_ROWS = 40
"""Of a profile on the screen."""


@dataclass(frozen=True)
class Outputs:
    """What a user asked for. `profile` is a file, or `-` for stderr."""

    trace: bool = False
    profile: str = ""
    coverage: tuple[Path, ...] = ()
    plots: tuple[Path, ...] = ()

    @property
    def tracing(self) -> bool:
        """Whether every statement is to be told of."""
        return self.trace or bool(self.profile) or bool(self.coverage)

    def refuse_unwritable(self) -> None:
        """Refuse, before anything runs, a file that cannot be written behind it."""
        files = list(self.coverage)
        if self.plots:
            from rapidgen.viewer.plotting import files_of

            files += [file for plot in self.plots for file in files_of(plot)]
        if self.profile not in ("", "-"):
            files.append(Path(self.profile))
        twice = next((file for file in files if files.count(file) > 1), None)
        if twice is not None:
            raise refusal("RG901", None, f"{twice} would be written twice", "name another file")
        refuse_unwritable(files)


@dataclass
class Observed:
    """Watches a controller from before its program starts; `write` at the end."""

    controller: "VirtualController"
    wanted: Outputs
    _profile: "Profile | None" = None
    _coverage: "Coverage | None" = None
    _recorders: "dict[str, Recorder]" = field(default_factory=dict)

    def __post_init__(self) -> None:
        from rapidgen.controller.tracing import Coverage, Profile, Trace

        if self.wanted.trace:
            Trace(self.controller, sys.stderr)
        if self.wanted.profile:
            self._profile = Profile(self.controller)
        if self.wanted.coverage:
            self._coverage = Coverage(self.controller)
        if self.wanted.plots:
            self._recorders = self.controller.record()

    def write(self) -> None:
        """Write all that was asked for."""
        if self._profile is not None:
            _write_profile(self._profile, self.wanted.profile)
        if self._coverage is not None:
            for path in self.wanted.coverage:
                page = path.suffix.lower() in (".html", ".htm")
                text = _page(self.controller, self._coverage) if page else self._coverage.lcov()
                write_whole(path, text.encode("utf-8", "replace"))
        if self.wanted.plots:
            self._draw(self.wanted.plots)

    def _draw(self, plots: tuple[Path, ...]) -> None:
        from rapidgen.motion.recorder import PERIOD
        from rapidgen.viewer import plot as draw
        from rapidgen.viewer.plotting import files_of

        period = max(PERIOD, self.controller.now / _SAMPLES)
        several = len(self._recorders) > 1
        for group, recorder in self._recorders.items():
            title = f"{self.controller.system.name}, {group}"
            made = draw(recorder.recording(period), title=title)
            for plot in plots:
                for path in files_of(plot.with_stem(f"{plot.stem}_{group}") if several else plot):
                    made.save(path)


@contextmanager
def observing(runner: "ControllerRunner", requested: Outputs) -> "Iterator[None]":
    """Write what was asked for when a controller is switched off, and when it restarts: then under
    names of their own, `F-1.html`, since nothing of before is in it any more."""
    now = Observed(runner.controller, requested)

    def before() -> None:
        now.wanted = replace(
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


def refuse_unwritable(files: "Sequence[Path]") -> None:
    """Refuse a file that could not be written later. Raises DiagnosticError RG901."""
    for path in files:
        try:
            check_writable(path)
        except OSError as fault:
            raise refusal(
                "RG901",
                None,
                f"cannot write {path}: {fault.strerror}",
                "name a file in a folder that exists and may be written",
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
