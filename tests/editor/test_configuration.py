"""YAML of rapidgen and cfg of SYSPAR in an editor."""

from rapidgen.editor import configuration
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
    assert configuration.cfg_instances(text) == [("EIO_SIGNAL", "doGrip", 5)]
