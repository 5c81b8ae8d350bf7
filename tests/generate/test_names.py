"""Names without case: a module's names meet those of its task [K §2.3, 2.12]."""

from pathlib import Path

import pytest

from rapidgen.config import load_config, shipped_names
from rapidgen.generate import build, layout, make_system
from rapidgen.rapid import check, format_source, parse
from rapidgen.rapid.builtins import signatures
from rapidgen.rapid.syntax import nodes

ROBOTS = ["irb120", "irb14000"]
CELL = Path(__file__).parents[2] / "tools" / "cell.yaml"


def declared(module):
    """(name, is local) of everything at module level, the module itself included."""
    yield module.name, False
    for declaration in module.declarations:
        yield declaration.name, declaration.scope == "LOCAL"


@pytest.mark.parametrize("name", ROBOTS)
def test_no_two_objects_of_a_task_share_a_name(name):
    output = build(load_config(name))
    trees = {f.path: parse(f.data, path=f.path) for f in output.files if f.kind == "module"}
    tasks = {task for f in output.files for task in f.tasks}
    assert len(tasks) == len(layout.ROLES) * (2 if name == "irb14000" else 1)
    for task in tasks:
        seen = {}
        for file in (f for f in output.files if task in f.tasks):
            own = set()
            for word, local in declared(trees[file.path]):
                key = word.casefold()
                assert key not in own, f"{word} twice in {file.path}"
                own.add(key)
                if not local:
                    assert key not in seen, f"{word} of {file.path} is also in {seen[key]}"
                    seen[key] = file.path


@pytest.mark.parametrize("name", ROBOTS)
def test_no_routine_hides_a_name_that_it_might_mean(name):
    for file in build(load_config(name)).files:
        if file.kind != "module":
            continue
        module = parse(file.data, path=file.path)
        outer = {word.casefold() for word, _ in declared(module)}
        for routine in module.routines:
            inner = [d.name.casefold() for d in [*routine.parameters, *routine.data]]
            assert len(set(inner)) == len(inner), routine.name
            assert not outer & set(inner), (routine.name, outer & set(inner))


@pytest.mark.parametrize("name", [*ROBOTS, str(CELL)])
def test_no_name_hides_one_of_rapids_own(name):
    """RAPID allows it [K §2.3]; who reads `Close` thinks of a file."""
    rapids = {*signatures.routine_names(), *signatures.type_names(), *signatures.predefined()}
    own = {word.casefold() for word in rapids}
    for file in build(load_config(name)).files:
        if file.kind != "module":
            continue
        module = parse(file.data, path=file.path)
        words = {word for word, _ in declared(module)}
        for routine in module.routines:
            words |= {d.name for d in [*routine.parameters, *routine.data]}
        assert not own & {word.casefold() for word in words}, file.path


@pytest.mark.parametrize("name", ROBOTS)
def test_groups_share_no_persistent(name):
    """PERS are one object for all tasks that declare the name [K §14.4]."""
    config = load_config(name)
    owner = {}
    for file in build(config).files:
        if file.kind != "module":
            continue
        folder = file.path.rpartition("/")[0]
        for data in parse(file.data, path=file.path).data:
            if data.kind == "PERS" and data.scope == "":
                assert owner.setdefault(data.name.casefold(), folder) == folder
                assert data.initial is None, data.name
    assert len(set(owner.values())) == len(config.groups)


def test_tree_matches_the_written_text():
    for file in build(load_config("irb120")).files:
        if file.kind == "module":
            module = parse(file.data, path=file.path)
            assert module.diagnostics == []
            assert module.name == file.path.rpartition("/")[2].partition(".")[0]
            assert isinstance(module, nodes.Module)


@pytest.mark.parametrize("name", shipped_names())
def test_the_checker_finds_nothing(name):
    config = load_config(name)
    assert check(make_system(config, build(config))) == []


@pytest.mark.parametrize(
    "override",
    [
        "trajectory.too_fast=slow_down",
        "network.receive_timeout=5",
        "network.allowed_clients=[10.0.0.1, 10.0.0.2]",
        "network.bind=service",
        "network.bind=10.0.0.3",
        "commissioning=true",
        "tcp_speed_limit=250",
        "trajectory.capacity=2",
        "trajectory.zone=fine",
        "trajectory.corners=tight",
    ],
)
def test_the_checker_finds_nothing_in_variants(override):
    config = load_config("irb120", overrides=[override])
    assert check(make_system(config, build(config))) == []


@pytest.mark.parametrize("name", ROBOTS)
def test_modules_are_laid_out_as_the_formatter_does(name):
    for file in build(load_config(name)).files:
        if file.kind == "module":
            text = file.data.decode("latin-1")
            assert format_source(text) == text, file.path
