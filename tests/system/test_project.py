"""The project file: where it is found, its values, and its faults with their places."""

import json
import os
from pathlib import Path

import pytest

from rapidgen.cli.app import main
from rapidgen.diagnostics import DiagnosticError
from rapidgen.system.project import find_project, project_schema, read_project

ALL = """
folders = ["src"]
cfg = ["EIO.cfg"]
robot = "irb1200"
robotware = "6.15"
strict = true
ignore = ["RG324"]

[tasks]
T_ROB1 = ["src"]
T_IO = ["io.mod"]
"""


@pytest.fixture
def folder(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "src" / "deep").mkdir(parents=True)
    (tmp_path / "EIO.cfg").write_text("EIO:CFG_1.0:6:1::\n\nEIO_SIGNAL:\n")
    (tmp_path / "io.mod").write_text("MODULE io\nENDMODULE\n")
    return tmp_path


def faults(folder, text):
    file = folder / "rapidgen.toml"
    file.write_bytes(text if isinstance(text, bytes) else text.encode())
    with pytest.raises(DiagnosticError) as caught:
        read_project(file)
    assert {d.code for d in caught.value.diagnostics} == {"RG730"}
    return [(d.span.line, d.message) for d in caught.value.diagnostics]


def test_every_key_is_read_and_described(folder):
    (folder / "rapidgen.toml").write_text(ALL)
    project = read_project(folder / "rapidgen.toml")
    assert project.folders == (folder / "src",)
    assert project.sources == {
        "T_ROB1": (folder / "src", folder / "EIO.cfg"),
        "T_IO": (folder / "io.mod",),
    }
    assert (project.robot, project.robotware, project.strict) == ("irb1200", "6.15", True)
    assert project.ignore == {"RG324"}
    described = project_schema()["properties"]
    assert set(described) == set(project.places)
    assert all(part["description"] for part in described.values())


def test_the_nearest_file_above_counts(folder):
    inner = folder / "src" / "deep"
    assert find_project(inner) is None or not find_project(inner).path.is_relative_to(folder)
    (folder / "rapidgen.toml").write_text("strict = true\n")
    assert find_project(inner / "a.mod").strict
    (folder / "src" / "rapidgen.toml").write_text("strict = false\n")
    assert not find_project(inner / "a.mod").strict
    assert find_project(folder).strict


def test_a_relative_start_gives_relative_places(folder, monkeypatch):
    (folder / "rapidgen.toml").write_text("folders = ['src']\n")
    monkeypatch.chdir(folder / "src")
    assert find_project(folder / "src").folders == (folder / "src",)
    assert str(find_project(Path()).path) == os.path.join("..", "rapidgen.toml")


@pytest.mark.parametrize(
    ("text", "line", "message"),
    [
        ("\nstrickt = true\n", 2, "unknown key 'strickt'"),
        ("strict = 1\n", 1, "'strict' must be true or false"),
        ("robot = 120\n", 1, "'robot' must be a text"),
        ("robot = ''\n", 1, "'robot' must be a text"),
        ("\n\nrobot = 'none.yaml'\n", 3, "none.yaml does not exist"),
        ("robotware = '6'\n", 1, "'6' is not a single version"),
        ("robotware = 'six'\n", 1, "'six' is not a RobotWare version"),
        ("ignore = ['RG999', ]\n", 1, "'RG999' is no diagnostic code"),
        ("ignore = 'RG324'\n", 1, "'ignore' must be a list"),
        ("folders = ['none']\n", 1, "none does not exist"),
        ("folders = ['..']\n", 1, "the path '..' leaves"),
        ("cfg = ['/etc/passwd']\n", 1, "the path '/etc/passwd' leaves"),
        ("folders = ['away']\n", 1, "'away' is a link that leaves"),
        ('folders = ["a\\u0000b"]\n', 1, "leaves"),
        ("tasks = 1\n", 1, "'tasks' must be a table"),
        ("[tasks]\nT_ROB1 = 1\n", 2, "'T_ROB1' must be a list"),
        ("[tasks]\nT_ROB1 = []\n", 2, "the task T_ROB1 has no file"),
        ("[tasks]\n'T 1' = ['io.mod']\n", 2, "'T 1' is no name of a task"),
        ("tasks = { T_ROB1 = ['none'] }\n", 1, "none does not exist"),
        ("strict = true\nstrict = true\n", 2, "invalid TOML: cannot overwrite a value"),
        ("strict =\n", 1, "invalid TOML: invalid value"),
        (b"strict = true\n# \xff\n", 2, "the file is not UTF-8"),
        ("a = " + "[" * 100_000, 1, "the file is nested too deep"),
        ("a = " + "9" * 10_000, 1, "invalid TOML: a value is out of range"),
        ("# " + "x" * 300_000, 1, "the file has more than 256 KB"),
    ],
)
def test_wrong_contents_are_reported_with_their_place(folder, text, line, message):
    (folder / "away").symlink_to(folder.parent, target_is_directory=True)
    (found, reported), *more = faults(folder, text)
    assert (found, more) == (line, [])
    assert message in reported


def test_all_faults_are_reported_in_one_pass(folder):
    assert [line for line, _ in faults(folder, "strict = 1\nrobot = 1\nx = 1\n")] == [3, 2, 1]


def test_a_pipe_or_a_link_out_of_the_folder_is_not_read(folder):
    os.mkfifo(folder / "src" / "rapidgen.toml")
    with pytest.raises(DiagnosticError, match="RG730"):
        find_project(folder / "src")
    (folder / "rapidgen.toml").symlink_to("/etc/passwd")
    with pytest.raises(DiagnosticError, match="RG730") as caught:
        find_project(folder)
    assert ":0:0:" not in str(caught.value)


def test_the_schema_is_printed(capsys):
    assert main(["schema", "--project"]) == 0
    assert json.loads(capsys.readouterr().out) == project_schema()
    assert main(["schema", "--project", "--cell"]) == 2
