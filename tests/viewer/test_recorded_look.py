"""A recording draws robots from the meshes that they had; of a bad file the rest is still drawn."""

import hashlib
import json
from dataclasses import replace
from pathlib import Path

import pytest
from mcap.writer import Writer

from rapidgen.config import load_config
from rapidgen.controller import VirtualController
from rapidgen.diagnostics import DiagnosticError
from rapidgen.viewer.appearance import PLAIN, appearance
from rapidgen.viewer.messages import Pose, SeenShape, SeenThing
from rapidgen.viewer.recording import appearance as looks
from rapidgen.viewer.recording.reader import RecordingFile
from rapidgen.viewer.recording.writer import record
from tests.viewer import mesh_files


@pytest.fixture(scope="module")
def seen(tmp_path_factory):
    """A configuration with three meshes, and its appearance with an object."""
    config = mesh_files.description(
        tmp_path_factory.mktemp("arm"),
        {
            "link_1": ("one.stl", mesh_files.stl()),
            "link_2": ("two.dae", mesh_files.dae()),
            "link_3": ("three.obj", mesh_files.obj()),
            "link_4": ("gone.stl", None),
        },
    )
    groups = load_config(config).groups
    look = appearance(groups, {group.name: config for group in groups})
    assert len(look.files) == 3
    mesh = next(iter(look.files))
    pose = Pose(position=(1.0, 0.0, 0.0), orientation=(1.0, 0.0, 0.0, 0.0))
    shape = SeenShape(kind="mesh", size=(2.0,), pose=pose, mesh=mesh)
    thing = SeenThing(name="<b>table", shapes=(shape,))
    bases = {"t_rob1": ((0.0, 0.5, 0.25), (1.0, 0.0, 0.0, 0.0))}
    return config, groups, replace(look, things=(thing,), bases=bases)


def controller_of(config):
    program = Path(config).with_name("m.mod")
    program.write_text("MODULE m\nPROC main()\nENDPROC\nENDMODULE\n")
    return VirtualController.from_files([program], robot=config)


def test_a_recording_looks_as_what_it_records(seen, tmp_path):
    config, groups, look = seen
    with controller_of(config) as controller:
        end = record(controller, tmp_path / "x.mcap", look=look)
        controller.run_for(0.1)
        end()
    with RecordingFile(tmp_path / "x.mcap") as file:
        assert file.look == look
        assert file.look.of(groups[0]) == look.of(groups[0])
        assert dict(file.look.files) == dict(look.files)
        assert file.sources(0.1)


def test_meshes_beyond_limit_are_omitted_and_reported(seen):
    _, groups, look = seen
    sizes = [*map(len, look.files.values())]
    saved = looks.carried(look, most=sizes[0] + sizes[2])
    names = [*look.files]
    assert [*saved.files] == [names[0], names[2]]
    assert "1 of 3 meshes (0.0 MB) are not in the recording" in saved.faults[-1]
    assert saved.faults[:-1] == look.faults
    urdf = saved.of(groups[0]).urdf
    assert [name in urdf for name in names] == [True, False, True]
    assert [thing.shapes[0].mesh for thing in saved.things] == names[:1]
    assert [*looks.carried(look, most=sizes[1]).files] == [names[0], names[2]]
    assert looks.carried(look, most=0).things == ()
    assert looks.carried(look) == look


def named(data, suffix):
    return f"mesh-{hashlib.sha256(data).hexdigest()[:20]}{suffix}"


ENTITY = b'<!DOCTYPE a [<!ENTITY b SYSTEM "file:///etc/passwd">]><COLLADA>&b;</COLLADA>'


@pytest.mark.parametrize(
    ("name", "data"),
    [
        ("mesh-00000000000000000000.stl", b"other bytes than the name says"),
        ("../../index.html", b"x"),
        ("index.html", b"x"),
        (named(b"x", ".html"), b"x"),
        (named(b"x", ".stl") + "\n", b"x"),
        (named(ENTITY, ".dae"), ENTITY),
    ],
)
def test_a_mesh_that_is_not_what_it_says_is_not_given_out(seen, name, data):
    _, groups, look = seen
    result = looks.read(looks.written(look), {**look.files, name: data}, groups)
    assert result.files == look.files
    assert result.faults == (*look.faults, "1 meshes are damaged")


def forged(look, **changes):
    """The written file with other entries in the drawing."""
    text = json.loads(looks.written(look))
    text["drawings"]["rob1"] |= changes
    return json.dumps(text).encode()


@pytest.mark.parametrize(
    ("changes", "why"),
    [
        ({"movable": ["a", "b"]}, "other joints"),
        ({"passive": [[[0, 1.0]]]}, "other passive joints"),
        ({"movable": [*(f"joint_{i}" for i in range(1, 7)), "p"], "passive": [[[6, 1.0]]]}, "not"),
        ({"movable": [*(f"joint_{i}" for i in range(1, 7)), "p"], "passive": [[[-1, 1.0]]]}, "not"),
        ({"urdf": "<robot>"}, "not well-formed"),
        ({"urdf": '<!DOCTYPE robot [<!ENTITY a "b">]><robot name="r"/>'}, "document type"),
    ],
)
def test_a_drawing_that_does_not_fit_its_robot_is_not_drawn(seen, changes, why):
    _, groups, look = seen
    result = looks.read(forged(look, **changes), look.files, groups)
    assert why in result.faults[-1]
    assert result.of(groups[0]) == replace(PLAIN, bases=look.bases).of(groups[0])


@pytest.mark.parametrize("data", [b"", b"[]", b"\xff", b'{"drawings": {"rob1": 1}}', b"[" * 9999])
def test_a_look_that_cannot_be_read_is_refused(tmp_path, seen, data):
    config, *_ = seen
    path = tmp_path / "x.mcap"

    class Forged(Writer):
        def add_attachment(self, create_time, log_time, name, media_type, given):
            given = data if name == "look.json" else given
            super().add_attachment(create_time, log_time, name, media_type, given)

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr("rapidgen.viewer.recording.writer.Writer", Forged)
        with controller_of(config) as controller:
            record(controller, path)()
    with pytest.raises(DiagnosticError, match="look cannot be read"):
        RecordingFile(path)


def test_a_recording_without_looks_is_drawn_from_its_chains(seen, tmp_path, monkeypatch):
    config, *_ = seen
    monkeypatch.setattr("rapidgen.viewer.recording.messages.LOOK", "other.json")
    with controller_of(config) as controller:
        record(controller, tmp_path / "x.mcap")()
    monkeypatch.undo()
    with RecordingFile(tmp_path / "x.mcap") as file:
        assert file.look == PLAIN
