"""Malicious meshes and descriptions are not drawn, and are reported."""

import os
import time

import pytest

from rapidgen.config import load_config
from rapidgen.diagnostics import DiagnosticError
from rapidgen.viewer.appearance import appearance
from tests.viewer import mesh_files

LIMIT = 5.0
"""s of CPU time for each."""
SECRET = b"canary-content"
BOMB = '<!DOCTYPE a [<!ENTITY a0 "aaaaaaaaaa">' + "".join(
    f'<!ENTITY a{n} "{f"&a{n - 1};" * 10}">' for n in range(1, 12)
)
NAMES = {
    "upwards": "../outside/secret.stl",
    "upwards twice": "a/../../outside/secret.stl",
    "upwards in percent": "%2e%2e/outside/secret.stl",
    "upwards with backslashes": "..\\outside\\secret.stl",
    "absolute": "{outside}/secret.stl",
    "file": "file://{outside}/secret.stl",
    "file in percent": "file://{outside}/%73ecret.stl",
    "file of a host": "file://host{outside}/secret.stl",
    "unknown package": "package://absent/secret.stl",
    "package upwards": "package://../outside/secret.stl",
    "web": "http://127.0.0.1:9/secret.stl",
    "no mesh": "/etc/passwd",
    "link": "link.stl",
    "linked folder": "way/secret.stl",
    "link to a text": "text.stl",
    "pipe": "pipe.stl",
    "device": "device.stl",
    "circle": "circle.stl",
    "folder": "folder.stl",
    "too large": "large.stl",
    "long name": "a" * 5000 + ".stl",
    "no name": "",
    "missing": "nothing.obj",
}
COLLADA = {
    "entities": BOMB + "]><a>&a11;</a>",
    "entity of a file": '<!DOCTYPE a [<!ENTITY x SYSTEM "file:///etc/passwd">]><a>&x;</a>',
    "type of a file": '<!DOCTYPE a SYSTEM "http://127.0.0.1:9/a.dtd"><a/>',
    "entities in UTF-16": (BOMB + "]><a>&a11;</a>").encode("utf-16"),
    "undeclared entity": "<a>&x;</a>",
    "deep": "<a>" * 300_000,
    "many attributes": "<a " + "".join(f"a{n}='' " for n in range(99_999)),
    "unknown encoding": "<?xml version='1.0' encoding='x-user'?><a/>",
    "many bytes a character": "<?xml version='1.0' encoding='gb18030'?><a/>",
    "noise": os.urandom(1000),
    "empty": "",
}
DESCRIPTIONS = {
    "entities": BOMB + "]><robot name='&a11;'/>",
    "entity of a file": '<!DOCTYPE a [<!ENTITY x SYSTEM "/etc/passwd">]><robot name="&x;"/>',
    "deep": "<robot>" + "<a>" * 300_000,
    "long attribute": "<robot name='" + "a" * 15_000_000 + "'/>",
    "many links": "<robot name='r'>" + "<link name='a'/>" * 50_000 + "</robot>",
    "many children": "<robot name='r'>" + "<a/>" * 300_000 + "</robot>",
    "comments": "<robot name='r'>" + "<!---->" * 300_000 + "</robot>",
    "unknown encoding": "<?xml version='1.0' encoding='x-user'?><robot name='r'/>",
    "many bytes a character": "<?xml version='1.0' encoding='gb18030'?><robot name='r'/>",
    "xacro in an unknown encoding": "<?xml version='1.0' encoding='x-user'?>"
    "<robot name='r' xmlns:xacro='http://www.ros.org/wiki/xacro'/>",
    "xacro of many bytes a character": "<?xml version='1.0' encoding='gb18030'?>"
    "<robot name='r' xmlns:xacro='http://www.ros.org/wiki/xacro'/>",
    "instruction": "<?xml-stylesheet href='file:///etc/passwd'?><robot/>",
    "inclusion": "<robot xmlns:xi='http://www.w3.org/2001/XInclude'><xi:include href='/etc/passwd'"
    " parse='text'/></robot>",
    "open comments": "<robot name='r'>" + "<!--" * 300_000,
    "open macros": "<robot xmlns:xacro='x'>" + "<xacro:macro " * 300_000,
    "long word in a macro": "<robot xmlns:xacro='x'><xacro:macro " + "a" * 300_000 + "></robot>",
    "open arguments": "<robot xmlns:xacro='x'>" + "<xacro:arg " * 300_000,
    "left over": "<robot name='r'>" + "${" * 300_000 + "</robot>",
    "empty": "",
}


@pytest.fixture
def place(tmp_path):
    folder, outside = tmp_path / "arm", tmp_path / "outside"
    folder.mkdir()
    outside.mkdir()
    (outside / "secret.stl").write_bytes(SECRET)
    (outside / "secret.txt").write_bytes(SECRET)
    (folder / "link.stl").symlink_to(outside / "secret.stl")
    (folder / "text.stl").symlink_to(outside / "secret.txt")
    (folder / "way").symlink_to(outside)
    (folder / "device.stl").symlink_to("/dev/zero")
    (folder / "circle.stl").symlink_to("circle.stl")
    (folder / "folder.stl").mkdir()
    os.mkfifo(folder / "pipe.stl")
    with (folder / "large.stl").open("wb") as file:
        file.truncate(1 << 36)
    return folder


def check(config):
    """Check that a description reads only the robot's own files."""
    began = time.thread_time()
    groups = load_config(config).groups
    look = appearance(groups, {group.name: config for group in groups})
    assert time.thread_time() - began < LIMIT
    assert not look.files
    assert look.faults


@pytest.mark.parametrize("name", NAMES)
def test_hostile_name_of_a_mesh(place, name):
    mesh = NAMES[name].replace("{outside}", str(place.parent / "outside"))
    check(mesh_files.description(place, {"link_1": (mesh, None)}))


@pytest.mark.parametrize("name", COLLADA)
def test_hostile_collada(place, name):
    data = COLLADA[name]
    data = data if isinstance(data, bytes) else data.encode()
    check(mesh_files.description(place, {"link_1": ("a.dae", data)}))


@pytest.mark.parametrize("name", DESCRIPTIONS)
def test_hostile_description(tmp_path, name):
    (tmp_path / "r.urdf").write_text(DESCRIPTIONS[name])
    (tmp_path / "r.yaml").write_text("urdf: {file: r.urdf}\n")
    began = time.thread_time()
    with pytest.raises(DiagnosticError) as refused:
        load_config(tmp_path / "r.yaml")
    assert time.thread_time() - began < LIMIT
    for result in refused.value.diagnostics:
        assert "root:" not in result.message + result.help
        assert len(result.message) < 6000
