"""A text of a configuration never becomes RAPID, cfg, JSON or YAML structure.

Every string and every key of a configuration that uses all sections is replaced by every hostile
text. Such a configuration is rejected, or it gives files of the same structure.
"""

import copy
import json
from dataclasses import dataclass

import pytest
import yaml

from rapidgen.config import load_config
from rapidgen.diagnostics import DiagnosticError
from rapidgen.generate import build
from rapidgen.rapid import parse
from rapidgen.rapid.syntax import walk
from rapidgen.system.cfg import parse_cfg

CONFIGURATION = """
name: cell
description: a cell
controller: {type: irc5, robotware: "6.15", cfg_header: {SYS: "6:0"}}
joints:
  joint_1: {axis: rax_1, lower: -165, upper: 165, speed: 250, source: data sheet, unsure: [speed]}
  joint_2: {axis: rax_2, lower: -110, upper: 110, speed: 250}
  joint_3: {axis: rax_3, lower: -110, upper: 70, speed: 250}
  joint_4: {axis: rax_4, lower: -160, upper: 160, speed: 320}
  joint_5: {axis: rax_5, lower: -120, upper: 120, speed: 320}
  joint_6: {axis: rax_6, lower: -400, upper: 400, speed: 420}
coupling: 0
max_payload: 3
task: T_ROB1
mechanical_unit: ROB_1
external_units: [STN_1]
unsure: [coupling]
source: {limits: data sheet, chain: drawing}
chain:
  - {joint: joint_1, xyz: [0, 0, 290], axis: [0, 0, 1]}
  - {joint: joint_2, axis: [0, 1, 0]}
  - {joint: joint_3, xyz: [0, 0, 270], axis: [0, 1, 0]}
  - {joint: joint_4, xyz: [302, 0, 70], axis: [1, 0, 0]}
  - {joint: joint_5, axis: [0, 1, 0]}
  - {joint: joint_6, xyz: [72, 0, 0], axis: [1, 0, 0]}
  - {rpy: [0, 90, 0]}
tool: {name: grip, frame: {position: [0, 0, 100]}, load: {mass: 1, centre: [0, 0, 50]}}
payload: {name: part}
work_object: {name: table, user_frame: {position: [300, 0, 100]}}
tools: [{name: pen, frame: {position: [0, 0, 100]}, load: {mass: 1, centre: [0, 0, 50]}}]
work_objects: [{name: shelf, user_frame: {position: [300, 0, 100]}}]
signals:
  valve: {kind: DO, access: write}
  code: {kind: GI}
routines:
  weld:
    call: "work:weld"
    parameters: [{name: seam, type: num, mode: inout}, {name: note, type: string}]
data:
  "work:count": {type: num, access: write}
trajectory: {zone: z10, corners: zone, too_fast: refuse}
network: {bind: lan, allowed_clients: [192.168.125.1]}
profile: full
main: driver
"""
HOSTILE = [
    'x"; TPWrite "moved',
    "x\nENDMODULE\nMODULE y",
    "x\r! PROC main()\rStop;\rENDPROC",
    "ENDPROC",
    "x%%%\nVERSION:1",
    "-Name x\n-Type y",
    'x" -Value "1',
    "{{ 7 * 7 }}",
    "{% include '/etc/passwd' %}",
    "x\\",
    "a\n",
    "\u2028x\x85y",
    "%x%<SMT>",
    "ROS_common",
    "<script>alert(1)</script>",
    "../../x",
    "x" * 5000,
    "",
]


@dataclass(frozen=True)
class Place:
    """A string value of the configuration, or a key of a mapping."""

    path: tuple[str | int, ...]
    is_key: bool

    def __str__(self):
        return ".".join(map(str, self.path)) + (" as key" if self.is_key else "")


def places(node, path=()):
    if isinstance(node, str):
        yield Place(path, is_key=False)
    elif isinstance(node, dict):
        for key, value in node.items():
            yield Place((*path, key), is_key=True)
            yield from places(value, (*path, key))
    elif isinstance(node, list):
        for index, value in enumerate(node):
            yield from places(value, (*path, index))


def replaced(tree, place, text):
    result = copy.deepcopy(tree)
    node = result
    for step in place.path[:-1]:
        node = node[step]
    last = place.path[-1]
    if place.is_key:
        items = [(text if key == last else key, value) for key, value in node.items()]
        node.clear()
        node.update(items)
    else:
        node[last] = text
    return result


def keys(node):
    """Return the structure of JSON: keys and kinds, without the values."""
    if isinstance(node, dict):
        return {key: keys(value) for key, value in node.items()}
    if isinstance(node, list):
        return [keys(value) for value in node]
    return type(node).__name__


def structure(configuration, path):
    path.write_text(yaml.safe_dump(configuration, allow_unicode=True, sort_keys=False))
    result = {}
    for file in build(load_config(path)).files:
        name = file.path.rsplit("/", 1)[-1]
        if file.kind == "module":
            module = parse(file.data, path=file.path)
            assert not module.diagnostics, file.path
            result[name] = [type(node).__name__ for node in walk.walk(module)]
        elif file.kind == "cfg":
            result[name] = [
                (section.name, [[a.name for a in one.attributes] for one in section.instances])
                for section in parse_cfg(file.data).sections
            ]
        elif name.endswith(".json"):
            json.loads(file.data)
    return result


TREE = yaml.safe_load(CONFIGURATION)
PLACES = list(places(TREE))
FREE = [
    place
    for place in PLACES
    if not place.is_key and not {"description", "source"}.isdisjoint(place.path)
]
"""Texts without a pattern: whatever they hold is written into the files."""
CASES = [(place, number) for place in PLACES for number in range(len(HOSTILE))]


@pytest.fixture(scope="module")
def harmless(tmp_path_factory):
    """The files' structures: a routine may be called with its module, or by its name alone."""
    folder = tmp_path_factory.mktemp("harmless")
    by_name = replaced(TREE, Place(("routines", "weld", "call"), is_key=False), "weld")
    return [structure(tree, folder / "cell.yaml") for tree in (TREE, by_name)]


def is_readable(text):
    """True if the rules of free texts accept it: at most 2000 characters, no line ends but LF."""
    return len(text) < 2000 and "\r" not in text and "\x85" not in text


def check(tree, harmless, folder):
    try:
        result = structure(tree, folder / "cell.yaml")
    except DiagnosticError as refused:
        for one in refused.diagnostics:
            assert one.code.startswith("RG")
            assert len(one.message) < 1000
            assert all(c >= " " or c == "\n" for c in one.message + one.help)
        return False
    assert result in harmless
    return True


def test_free_texts_give_no_structure(harmless, tmp_path):
    tree = TREE
    for place in FREE:
        tree = replaced(tree, place, " ".join(text for text in HOSTILE if is_readable(text)))
    assert check(tree, harmless, tmp_path)


@pytest.mark.parametrize(("place", "number"), CASES, ids=str)
def test_hostile_text_gives_no_structure(place, number, harmless, tmp_path):
    check(replaced(TREE, place, HOSTILE[number]), harmless, tmp_path)
