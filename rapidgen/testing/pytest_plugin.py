"""pytest plugin: programs on virtual controllers in tests, with cells, clients, faults and seeds.

    def test_grips(virtual_controller, virtual_cell, virtual_client):
        cell = virtual_cell("signals: {doGrip: {kind: DO}, diPart: {kind: DI}}")
        controller = virtual_controller("main.mod", robot="irb1200", cell=cell)
        client = virtual_client(controller, 5000)
        client.send(b"PICK\\n")
        controller.signals["diPart"] = 1
        assert client.receive(until=b"\\n") == b"OK\\n"
        assert controller.signals["doGrip"] == 1
        assert controller.positions("rob1")["joint_1"] == pytest.approx(0.5)

    @pytest.mark.virtual_seeds(50)
    def test_no_race(virtual_controller):       # 50 tests, one for each seed
        controller = virtual_controller("irb120", switch_at_pers=True)

`--virtual-seed N` runs just that seed: a failing one replays exactly.
"""

import warnings
from collections.abc import Callable, Iterator, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Literal

import pytest

from rapidgen._compat import Unpack
from rapidgen.diagnostics import Diagnostic, render

if TYPE_CHECKING:
    from rapidgen.collision.check import Clearances
    from rapidgen.controller.boot_targets import Bootable
    from rapidgen.controller.collisions import CollisionWatch
    from rapidgen.controller.controller import ControllerOptions, VirtualController
    from rapidgen.controller.faults import FaultPlan
    from rapidgen.system.model import System
    from rapidgen.testing.client import Client

MARK = "virtual_seeds"


def pytest_addoption(parser: pytest.Parser) -> None:
    """Add `--virtual-seed`."""
    group = parser.getgroup("rapidgen", "virtual ABB controllers")
    group.addoption(
        "--virtual-seed",
        type=int,
        default=None,
        metavar="N",
        help="seed of virtual controllers; tests with several seeds run this one only",
    )


def pytest_configure(config: pytest.Config) -> None:
    """Declare the mark."""
    config.addinivalue_line(
        "markers", f"{MARK}(count): run the test once for each of the seeds 0 to count - 1"
    )


def pytest_generate_tests(metafunc: pytest.Metafunc) -> None:
    """Parametrize a test over its seeds."""
    marker = metafunc.definition.get_closest_marker(MARK)
    if marker is None or "virtual_seed" not in metafunc.fixturenames:
        return
    chosen = metafunc.config.getoption("--virtual-seed")
    if len(marker.args) != 1 or marker.kwargs or not isinstance(marker.args[0], int):
        given = ", ".join(
            [*map(repr, marker.args), *(f"{k}={v!r}" for k, v in marker.kwargs.items())]
        )
        what = f"{metafunc.definition.nodeid}: {MARK}({given}) is no number of seeds"
        pytest.fail(f"{what}: write @pytest.mark.{MARK}(50)", pytrace=False)
    seeds = range(marker.args[0]) if chosen is None else (chosen,)
    metafunc.parametrize("virtual_seed", seeds, ids=lambda seed: f"seed{seed}", indirect=True)


@pytest.fixture
def virtual_seed(request: pytest.FixtureRequest) -> int:
    """Return the seed of this test's controllers."""
    if hasattr(request, "param"):
        return int(request.param)
    chosen = request.config.getoption("--virtual-seed")
    return 0 if chosen is None else int(chosen)


class ControllerFactory:
    """Creates virtual controllers, and checks their robots for collisions."""

    def __init__(self, seed: int) -> None:
        self._seed = seed
        self._made: list[VirtualController] = []
        self._watched: list[tuple[VirtualController, CollisionWatch, bool]] = []

    def __call__(
        self,
        target: "str | Path | System | Mapping[str, Sequence[str | Path]] | Sequence[str | Path]",
        *,
        robot: str = "",
        entry: str = "",
        cell: Path | str = "",
        start: Sequence[float] = (),
        collisions: Literal["error", "warn", "off"] = "off",
        **options: "Unpack[ControllerOptions]",
    ) -> "VirtualController":
        """Create a controller: see `virtual_controller`."""
        from rapidgen.controller.boot_targets import BootOptions, load_target
        from rapidgen.controller.controller import VirtualController
        from rapidgen.system.model import System

        options.setdefault("seed", self._seed)
        if isinstance(target, System):
            self._made.append(VirtualController(target, **options))
            return self._made[-1]
        tasks = target if isinstance(target, Mapping) else {}
        files = [target] if isinstance(target, str | Path) else [] if tasks else list(target)
        boot_options = BootOptions(tasks, robot=robot, entry=entry, cell=cell, start=start)
        booted = load_target(files, boot_options)
        controller = VirtualController.boot(booted, **options)
        self._made.append(controller)
        if collisions != "off":
            self._watch(controller, booted, collisions)
        return controller

    def _watch(
        self, controller: "VirtualController", booted: "Bootable", mode: Literal["error", "warn"]
    ) -> None:
        from rapidgen.controller.collisions import CollisionWatch

        if booted.cell is None:
            raise ValueError("collisions need a cell: virtual_controller(..., cell=FILE)")
        setup = booted.collisions(mode)
        assert setup is not None
        watch = CollisionWatch(controller, setup)
        self._watched.append((controller, watch, mode == "error"))

    def clearance(self, controller: "VirtualController") -> "Clearances":
        """Return the clearances of a controller's robots so far: m, s.

        Raises ValueError for a controller without `collisions`.
        """
        for own, watch, _ in self._watched:
            if own is controller:
                return watch.clearance()
        raise ValueError('the controller was created without collisions="error"')

    def close(self) -> None:
        """Close all controllers, and fail the test for collisions."""
        found: list[Diagnostic] = []
        for _, watch, is_error in self._watched:
            diagnostics = watch.report().diagnostics
            if is_error:
                found += diagnostics
            elif diagnostics:
                warnings.warn(render(diagnostics), stacklevel=2)
        for controller in self._made:
            controller.close()
        if found:
            pytest.fail(render(found), pytrace=False)


@pytest.fixture
def virtual_controller(virtual_seed: int) -> "Iterator[ControllerFactory]":
    """Create virtual controllers: `virtual_controller(target, **options)`.

    `target` is an argument of `rapidgen sim` (a shipped name, a configuration, a generated folder,
    a backup, a module, a folder of modules), a list of module files, a mapping from task to such a
    list, or a `System`. `robot`, `entry`, `cell` and `start` are those of `rapidgen run`, all other
    options those of `VirtualController`. All are closed after the test. With `collisions="error"`
    the test fails at its end if a path does not keep the clearances of the cell;
    `virtual_controller.clearance(controller)` has them.
    """
    factory = ControllerFactory(virtual_seed)
    yield factory
    factory.close()


@pytest.fixture
def virtual_cell(tmp_path: Path) -> "Callable[[str], Path]":
    """Create a cell file from its YAML text: `cell=virtual_cell("signals: ...")`."""

    def make(text: str) -> Path:
        path = tmp_path / f"cell_{len(list(tmp_path.glob('cell_*.yaml')))}.yaml"
        path.write_text(text, encoding="utf-8")
        return path

    return make


@pytest.fixture
def virtual_faults(tmp_path: Path) -> "Callable[[str], FaultPlan]":
    """Create a fault plan from its YAML text, for the option `faults`."""
    from rapidgen.controller.faults import read_plan

    def make(text: str) -> "FaultPlan":
        path = tmp_path / "faults.yaml"
        path.write_text(text, encoding="utf-8")
        return read_plan(path)

    return make


@pytest.fixture
def virtual_client() -> "Iterator[Callable[..., Client]]":
    """Create clients: `virtual_client(controller, port)`.

    See `rapidgen.testing.client`.
    """
    from rapidgen.testing.client import Client

    made: list[Client] = []

    def connect(controller: "VirtualController", port: int, *, timeout: float = 10.0) -> Client:
        made.append(Client(controller, port, timeout=timeout))
        return made[-1]

    yield connect
    for client in made:
        client.close()
