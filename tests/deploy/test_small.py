"""Parts of a deployment alone: fences, keys that are shown, builds in memory."""

import pytest

from rapidgen.client.rws import RwsError
from rapidgen.deploy.cfg import shown_key
from rapidgen.deploy.config_diff import changed_keys
from rapidgen.deploy.driver_set import DriverSet, SetFile
from rapidgen.deploy.online.snapshot import build_in
from rapidgen.system import Attribute, Instance

BUILD = "0123456789ab"


def module(name, *tasks, build=BUILD):
    """A module that carries a build, in some tasks."""
    return SetFile(f"{name}.mod", f'CONST string b := "{build}";'.encode(), "module", tasks)


@pytest.mark.parametrize(
    ("files", "fences"),
    [
        # As few as touch every task: those of the most tasks first, else by their path.
        ([module("a", "T1"), module("b", "T2"), module("common", "T1", "T2")], ["common"]),
        ([module("z", "T1"), module("a", "T1")], ["a"]),
        ([module("a", "T1", "T2"), module("b", "T2", "T3"), module("c", "T2")], ["a", "b"]),
        ([module("common", "T1", "T2", build="other"), module("b", "T2")], ["b"]),
        ([SetFile("SYS.cfg", BUILD.encode(), "cfg"), module("a", "T1")], ["a"]),
    ],
)
def test_fences_are_as_few_modules_as_touch_every_task(files, fences):
    result = DriverSet("cell", BUILD, (6, 15), tuple(files)).blocking_modules()
    assert sorted(result) == [f"{name}.mod" for name in fences]
    assert set(result.values()) == {b'CONST string b := "incomplete--";'}


def instance(**attributes):
    """One instance of cfg, by its attributes."""
    return Instance(
        tuple(
            Attribute(name, value if isinstance(value, tuple) else (value,))
            for name, value in attributes.items()
        )
    )


@pytest.mark.parametrize(
    ("section", "result", "key"),
    [
        ("CAB_TASKS", instance(Type="NORMAL", Name="T_ROB1"), "T_ROB1"),
        ("CAB_TASK_MODULES", instance(Task="T1", Shared=(), file="HOME:/a.mod"), "HOME:/a.mod T1"),
        ("CAB_EXEC_HOOKS", instance(Task="T1", Seq=3, Routine="R", Shelf="START"), "R START T1"),
        ("SYSSIG_OUT", instance(Signal="do1", Status="Error", Arg1=4), "Error do1 4"),
        ("SYSSIG_IN", instance(Action="Start", Name="di1", Arg1="CONT"), "di1 Start"),
        ("EIO_CROSS", instance(Act1="di1", Res="do1"), "do1"),
        # An unknown section without instance names: all of it.
        ("OTHER", instance(A=1, B=("x", 2)), "1 x 2"),
    ],
)
def test_an_instance_is_shown_by_what_tells_it_from_others(section, result, key):
    assert shown_key(section, result) == key


def group(name, **keys):
    """One motion group of a manifest's model."""
    return {"name": name, "ports": {"motion": 11000}, **keys}


def joint(name, kind="revolute", **keys):
    """One joint of it."""
    return {"name": name, "kind": kind, "lower": -1.0, "speed": 2.0, **keys}


@pytest.mark.parametrize(
    ("old", "new", "text"),
    [
        ({"robotware": [6, 15]}, {"robotware": [7, 15]}, ["robotware.0: 6 → 7"]),
        ({"a": 1, "source": "x"}, {"a": 1, "source": "y"}, []),
        ({"gone": True}, {"fresh": None}, ["gone: True → none"]),
        ({"state_period": 0.1}, {"state_period": 0.05}, ["state.rate: 10 → 20"]),
        ({"start_tolerance": 0.0}, {"start_tolerance": 0.5235988}, ["start_tolerance: 0 → 30"]),
        ({"pose_tolerance": 0.001}, {"pose_tolerance": 0.002}, ["pose_tolerance: 1 → 2"]),
        (
            {"tool": {"position": [0.0, 0.1]}},
            {"tool": {"position": [0.0, 0.25]}},
            ["tool.position.1: 100 → 250"],
        ),
        # One group writes its keys at the top, several by their names.
        (
            {"groups": [group("rob1")]},
            {"groups": [group("rob1", ports={"motion": 12000})]},
            ["ports.motion: 11000 → 12000"],
        ),
        (
            {"groups": [group("rob1"), group("rob2")]},
            {"groups": [group("rob1"), group("rob2", ports={"motion": 12000})]},
            ["groups.rob2.ports.motion: 11000 → 12000"],
        ),
        # deg and deg/s of what turns, mm and mm/s of what slides.
        (
            {"joints": [joint("a"), joint("b", "prismatic")]},
            {"joints": [joint("a", speed=1.0), joint("b", "prismatic", lower=-0.5)]},
            ["joints.a.speed: 114.592 → 57.2958", "joints.b.lower: -1000 → -500"],
        ),
        (
            {f"k{n}": 0 for n in range(10)},
            {f"k{n}": 1 for n in range(10)},
            [*(f"k{n}: 0 → 1" for n in range(8)), "and 2 more keys"],
        ),
        (
            {f"k{n}": 0 for n in range(8)},
            {f"k{n}": 1 for n in range(8)},
            [f"k{n}: 0 → 1" for n in range(8)],
        ),
    ],
)
def test_keys_of_a_configuration_that_differ(old, new, text):
    assert changed_keys(old, new) == text


class Memory:
    """Web services that have some symbols, and answer others with a status."""

    def __init__(self, result, status=404):
        self.found, self.status = result, status

    def symbol(self, path):
        if path in self.found:
            return self.found[path]
        raise RwsError(self.status, path, None)


@pytest.mark.parametrize(
    ("result", "build"),
    [
        ({"T1/A/id": BUILD, "T1/B/id": BUILD}, BUILD),
        ({"T1/A/id": BUILD, "T1/B/id": "ba9876543210"}, ""),
        ({"T1/A/id": BUILD}, ""),
        ({"T1/A/id": 3.0, "T1/B/id": 3.0}, ""),
        ({}, ""),
    ],
)
def test_the_build_of_a_task_is_one_that_all_its_modules_carry(result, build):
    assert build_in(Memory(result), "T1", ("A/id", "B/id")) == build
    assert build_in(Memory(result), "T1", ()) == ""


def test_a_controller_that_cannot_answer_is_no_task_without_a_build():
    with pytest.raises(RwsError):
        build_in(Memory({}, status=503), "T1", ("A/id",))
