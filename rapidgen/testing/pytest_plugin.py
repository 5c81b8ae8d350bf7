"""pytest plugin: virtual controllers in tests, with seeds.

    def test_moves(virtual_controller):
        controller = virtual_controller("rapid_out/irb120")
        controller.run_for(1.0)
        assert controller.task("T_ROB1").state == "running"

    @pytest.mark.virtual_seeds(50)
    def test_no_race(virtual_controller):       # 50 tests, one for each seed
        controller = virtual_controller("cell", switch_at_pers=True)

`--virtual-seed N` runs just that seed: a failing one replays exactly.
"""

from collections.abc import Callable, Iterator, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Unpack

import pytest

if TYPE_CHECKING:
    from rapidgen.controller.controller import Choices, VirtualController
    from rapidgen.system.model import System

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
    """One test for each seed."""
    mark = metafunc.definition.get_closest_marker(MARK)
    if mark is None or "virtual_seed" not in metafunc.fixturenames:
        return
    chosen = metafunc.config.getoption("--virtual-seed")
    seeds = range(*mark.args) if chosen is None else (chosen,)
    metafunc.parametrize("virtual_seed", seeds, ids=lambda seed: f"seed{seed}", indirect=True)


@pytest.fixture
def virtual_seed(request: pytest.FixtureRequest) -> int:
    """The seed of this test's controllers."""
    if hasattr(request, "param"):
        return int(request.param)
    chosen = request.config.getoption("--virtual-seed")
    return 0 if chosen is None else int(chosen)


@pytest.fixture
def virtual_controller(
    virtual_seed: int,
) -> "Iterator[Callable[..., VirtualController]]":
    """Makes virtual controllers: `virtual_controller(target, **options)`.

    `target` is a generated folder, a backup, module files (a list, or a mapping from task to
    list), or a `System`; options are those of `VirtualController`. All are closed after the test.
    """
    from rapidgen.controller.controller import VirtualController
    from rapidgen.system.model import System

    made: list[VirtualController] = []

    def make(
        target: "str | Path | System | Mapping[str, Sequence[str | Path]] | Sequence[str | Path]",
        **options: "Unpack[Choices]",
    ) -> VirtualController:
        options.setdefault("seed", virtual_seed)
        if isinstance(target, System):
            controller = VirtualController(target, **options)
        elif isinstance(target, str | Path) and Path(target).is_dir():
            controller = VirtualController.from_folder(target, **options)
        elif isinstance(target, str | Path):
            controller = VirtualController.from_files([target], **options)
        else:
            controller = VirtualController.from_files(target, **options)
        made.append(controller)
        return controller

    yield make
    for controller in made:
        controller.close()
