"""YAML and project file of rapidgen, and cfg of SYSPAR, in an editor."""

from rapidgen.editor import cfg_files, configuration, project_file
from rapidgen.editor.documents import Document
from rapidgen.editor.workspace import Workspace

ROBOT = "model: irb120\ncontroller:\n  robotware: 6.15\nsignals:\n  grip: {kind: DO}\n"


def found(path, text):
    workspace = Workspace()
    workspace.open(Document(str(path), text, language="yaml"))
    return workspace.findings_of(str(path))


def test_findings_are_of_the_text_in_the_editor(tmp_path):
    path = tmp_path / "robot.yaml"
    path.write_text("model: nothing\n")
    assert found(path, ROBOT) == []
    (finding,) = found(path, ROBOT.replace("irb120", "irb12"))
    assert (finding.span.path, finding.span.line) == (str(path), 1)
    (finding,) = found(path, ROBOT.replace("robotware: 6.15", "robotware: x"))
    assert finding.span.line == 3
    assert found(path, "model: [")[0].span.line == 1


def test_other_yaml_files_have_no_findings(tmp_path):
    for text in ("version: 3\nservices: {}\n", "- a\n", "", "model: x\nimage: y\n"):
        assert found(tmp_path / "compose.yaml", text) == []


def test_findings_follow_edits(tmp_path):
    path = tmp_path / "robot.yaml"
    workspace = Workspace()
    document = Document(str(path), ROBOT, language="yaml")
    workspace.open(document)
    assert [f for _, f in workspace.work()] == [[]]
    document.edit(((0, 7), (0, 13)), "irb12", "utf-16")
    workspace.edited(str(path))
    assert not workspace.is_idle()
    assert [len(f) for _, f in workspace.work()] == [1]


def test_keys_are_offered_where_keys_stand():
    keys, start = configuration.keys_at(ROBOT + "na", 6, 3)
    assert start == 1
    assert {"model", "groups", "name"} <= {key.name for key in keys}
    keys, start = configuration.keys_at("model: irb120\ncontroller:\n  ro", 3, 5)
    assert start == 3
    assert "robotware" in {key.name for key in keys}
    keys, _ = configuration.keys_at("groups:\n  rob1:\n    j", 3, 6)
    assert "joints" in {key.name for key in keys}
    assert configuration.keys_at("model: irb", 1, 11)[0] == []


def test_a_key_has_its_description():
    key, span = configuration.key_at(ROBOT, 3, 5)
    assert key.name == "robotware"
    assert (span.line, span.column, span.end_column) == (3, 3, 12)
    assert key.text
    assert configuration.key_at(ROBOT, 3, 15) is None


def test_links_lead_to_files(tmp_path):
    (tmp_path / "arm.urdf").write_text("<robot/>")
    text = "urdf:\n  file: arm.urdf\njoints:\n  file: none.urdf\n"
    ((span, target),) = configuration.links(str(tmp_path / "r.yaml"), text)
    assert (span.line, span.column, target) == (2, 9, str(tmp_path / "arm.urdf"))


def test_cfg_of_syspar_has_findings_and_instances(tmp_path):
    path = tmp_path / "SYSPAR" / "EIO.cfg"
    text = 'EIO:CFG_1.0:6:1::\n#\nEIO_SIGNAL:\n\n      -Name "doGrip" -SignalType "DO"\n'
    assert configuration.kind_of(str(path), "") == "cfg"
    assert configuration.kind_of(str(tmp_path / "setup.cfg"), "") == ""
    assert configuration.findings(str(path), text, "cfg") == []
    (finding,) = configuration.findings(str(path), "nothing", "cfg")
    assert (finding.code, finding.span.line) == ("RG701", 1)
    assert list(cfg_files.instances(text)) == [("EIO_SIGNAL", "doGrip", 5)]


EIO = """EIO:CFG_1.0:6:1::
#
EIO_SIGNAL:

      -Name "doGrip" -SignalType "DO" -Access "All"\\
      -De

#
SYSSIG_OUT:

      -Status "TaskExecuting" -Signal "doGrip"
      -Status "M"
"""
MOC = """MOC:CFG_1.0:6:0::
#
ARM:

      -name "rob1_1" -upper_joint_bound 2.87979 -odd 3
#
ROBOT:

      -name "ROB_1" -use_joint_4 "rob1_5"
#
EXT_MOTION_DATA:

      -name "default" -ramp_time 2
"""


def cfg_key(text, marker):
    """Hover text in front of a marker's `|`; empty without one."""
    before, _, after = marker.partition("|")
    at = text.index(before + after) + len(before)
    found = cfg_files.key_at(text, text.count("\n", 0, at) + 1, at - text.rfind("\n", 0, at))
    return found[0].text if found is not None else ""


def test_attributes_of_cfg_files_have_meaning_unit_range_and_default():
    assert cfg_key(EIO, "EIO_SIG|NAL:").startswith("EIO: ")
    assert "`DI`, `DO`" in cfg_key(EIO, "-Signal|Type")
    assert "Default: `Default`" in cfg_key(EIO, "-Acc|ess")
    assert "Unit: rad or m." in cfg_key(MOC, "-upper_|joint_bound")
    assert "first axis" in cfg_key(MOC, "-use_joint|_4")
    assert "Name of the instance." in cfg_key(MOC.replace("ARM:", "CABLE:"), '-na|me "rob1_1"')
    uses = MOC.replace("-odd 3", '-use_robot "ROB_1" -use_cable "c"')
    assert "Name of the ROBOT that" in cfg_key(uses, "-use_ro|bot")
    assert cfg_key(uses, "-use_ca|ble") == ""
    assert "Range: 0.005 to 10." in cfg_key(MOC, "-ramp|_time")
    assert "Default: `0.5` (source: manual)." in cfg_key(MOC, "-ramp|_time")


def test_cfg_has_nothing_to_say_about_unknown_attributes_and_names():
    assert cfg_key(MOC, "-od|d 3") == ""
    assert cfg_key(MOC, '"rob1|_1"') == ""
    assert cfg_key(EIO.replace("EIO_SIGNAL:", "OTHER:"), "-Signal|Type") == ""
    assert cfg_files.key_at(EIO, 99, 1) is None
    assert cfg_files.key_at("", 1, 1) is None


def test_system_signals_name_their_argument_and_release():
    """docs/rapid/cfg.md: backups give TaskExecuting its task in Arg2; RobotWare 7: SYS."""
    assert cfg_key(EIO, '"Task|Executing"') == (
        "Takes a DO. The task is in `-Arg2`, which is necessary."
    )
    seven = EIO.replace("EIO:CFG_1.0:6:1", "SYS:CFG_1.0:7:0")
    assert "EmStop" not in cfg_key(seven, "-Sta|tus")
    assert "EmStop" in cfg_key(EIO, "-Sta|tus")


def cfg_names(text, marker):
    at = text.index(marker) + len(marker)
    keys, start = cfg_files.keys_at(text, text.count("\n", 0, at) + 1, at - text.rfind("\n", 0, at))
    return {key.name for key in keys}, start


def test_attributes_words_and_types_of_cfg_files_are_offered():
    names, start = cfg_names(EIO, "\n      -De")
    assert {"Device", "Default"} <= names
    assert not {"Name", "SignalType"} & names
    assert start == 7
    words, start = cfg_names(EIO, '-Status "M')
    assert {"MotorOn", "TaskExecuting"} <= words
    assert start == 16
    types, _ = cfg_names(EIO + "E", EIO + "E")
    assert {"EIO_SIGNAL", "EIO_CROSS"} <= types
    assert cfg_names(EIO, '-Name "do') == (set(), 14)


TOML = """robot = "irb1200"
ignore = [
    "RG324",
    "RG"
]
[tasks]
T_ROB1 = ["src"]
"""


def test_findings_of_the_project_file_are_of_the_text_in_the_editor(tmp_path):
    path = tmp_path / "rapidgen.toml"
    path.write_text("robot = 1\n")
    (tmp_path / "src").mkdir()
    assert found(path, TOML.replace('    "RG"\n', "")) == []
    (finding,) = found(path, TOML)
    assert (finding.code, finding.span.path, finding.span.line) == ("RG730", str(path), 2)
    (finding,) = found(path, 'robot = "\n')
    assert (finding.code, finding.span.line) == ("RG730", 1)
    assert configuration.kind_of(str(tmp_path / "pyproject.toml"), "toml") == ""


def test_keys_and_values_of_the_project_file_are_offered():
    names = {key.name for key in project_file.keys_at("str", 1, 4)[0]}
    assert {"strict", "tasks", "folders"} <= names
    keys, start = project_file.keys_at(TOML, 4, 8)
    assert "RG324" in {key.insert for key in keys}
    assert start == 6
    assert {key.insert for key in project_file.keys_at("strict = ", 1, 10)[0]} == {"true", "false"}
    assert "robot" not in {key.name for key in project_file.keys_at("st\n" + TOML, 1, 3)[0]}
    assert project_file.keys_at(TOML + "T_", 8, 3)[0] == []
    assert project_file.keys_at("robot = i", 1, 10)[0] == []


def test_keys_and_codes_of_the_project_file_have_a_description():
    key, span = project_file.key_at(TOML, 2, 3)
    assert (key.name, span.column, span.end_column) == ("ignore", 1, 7)
    assert 'Example: `ignore = ["RG324"]`' in key.text
    key, _ = project_file.key_at(TOML, 6, 4)
    assert key.name == "tasks"
    key, span = project_file.key_at(TOML, 3, 8)
    assert (key.name, span.column, bool(key.text)) == ("RG324", 6, True)
    assert project_file.key_at(TOML, 7, 3) is None
    assert project_file.key_at(TOML, 20, 1) is None
