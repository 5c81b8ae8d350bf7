"""cfg text: layout of real controllers' files, and round trip."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from rapidgen.diagnostics import DiagnosticError
from rapidgen.system import Attribute, CfgText, Instance, Section, parse_cfg, write_cfg

BACKUP = """SYS:CFG_1.0:6:0::\r
\r
#\r
CAB_TASKS:\r
\r
      -Name "T_ROB1" -Type "NORMAL" -BindRef 0\\\r
      -Entry "main" -UseMechanicalUnitGroup "rob1" -MotionTask\r
\r
      -Name "T_SRV" -TrustLevel "None"\r
#\r
CAB_TASK_MODULES:\r
\r
      -File "HOME:\\ros\\a.sys" -Task "T_ROB1"\r
"""


def test_layout_of_a_controllers_file():
    cfg = parse_cfg(BACKUP.encode("latin-1"), path="SYS.cfg")
    assert (cfg.domain, cfg.version) == ("SYS", (6, 0))
    assert [s.name for s in cfg.sections] == ["CAB_TASKS", "CAB_TASK_MODULES"]
    robot, server = cfg.instances("CAB_TASKS")
    assert robot.text("Entry") == "main"
    assert robot.flag("MotionTask")
    assert not server.flag("MotionTask")
    assert robot.number("BindRef", 7) == 0
    assert server.text("TrustLevel") == "None"
    assert (robot.line, server.line) == (6, 9)
    (module,) = cfg.instances("CAB_TASK_MODULES")
    assert module.text("File") == "HOME:\\ros\\a.sys"


ABBS = """SYS:CFG_1.0:7:0::
# Modules
sysSig_Out:
-Name "doA" -Status "MotorOn"
# between two
   -name "doB" -STATUS "Error" -Arg2 "T_ROB1"
CAB_TASKS:
      -Name "T_SRV" -TrustLevel "None"
#CTRL_SIGNATURE:0123456789ABCDEF0123456789ABCDEF
"""


@pytest.mark.parametrize("end", ["\n", "\r\n"])
def test_layout_of_files_that_abb_writes(end):
    """No blank lines, any indentation, comments anywhere, a signature; names without case."""
    cfg = parse_cfg(ABBS.replace("\n", end))
    one, other = cfg.instances("SYSSIG_OUT")
    assert (one.text("name"), other.text("Name"), other.text("arg2")) == ("doA", "doB", "T_ROB1")
    assert [task.text("Name") for task in cfg.instances("cab_tasks")] == ["T_SRV"]


@pytest.mark.parametrize(
    ("written", "is_set"),
    [
        ("-MotionTask", True),
        ("-motiontask", True),
        ("-MotionTask 1", True),
        ('-MotionTask "TRUE"', True),
        ("-MotionTask true", True),
        ("-MotionTask 0", False),
        ('-MotionTask "FALSE"', False),
        ("-Other", False),
    ],
)
def test_a_flag_is_bare_or_says_so(written, is_set):
    (task,) = parse_cfg(f"SYS:CFG_1.0:6:0::\nCAB_TASKS:\n  {written}\n").instances("CAB_TASKS")
    assert task.flag("MotionTask") is is_set


def test_a_flag_is_written_bare():
    task = Instance(
        (Attribute("Name", ("T_ROB1",)), Attribute("MotionTask"), Attribute("Slot", (1,)))
    )
    written = write_cfg(CfgText("SYS", (6, 0), (Section("CAB_TASKS", (task,)),)))
    assert written.splitlines()[-1].strip() == '-Name "T_ROB1" -MotionTask -Slot 1'


@pytest.mark.parametrize(
    ("text", "code", "line"),
    [
        ("CAB_TASKS:\n", "RG701", 1),
        ("", "RG701", 1),
        ('SYS:CFG_1.0:6:0::\nCAB_TASKS:\n  -Name "T_ROB1\n', "RG702", 3),
        ('SYS:CFG_1.0:6:0::\n  -Name "T_ROB1"\n', "RG702", 2),
        ("SYS:CFG_1.0:6:0::\nCAB_TASKS:\nnonsense\n", "RG702", 3),
    ],
)
def test_faults_have_a_place(text, code, line):
    with pytest.raises(DiagnosticError) as caught:
        parse_cfg(text, path="X.cfg")
    (result,) = caught.value.diagnostics
    assert (result.code, result.span.line, result.span.path) == (code, line, "X.cfg")


def test_a_quote_cannot_be_written():
    cfg = CfgText(
        "EIO", (6, 1), (Section("EIO_SIGNAL", (Instance((Attribute("Name", ('a"b',)),)),)),)
    )
    with pytest.raises(DiagnosticError) as caught:
        write_cfg(cfg)
    assert caught.value.diagnostics[0].code == "RG703"


NAMES = st.from_regex(r"[A-Za-z][A-Za-z0-9_]{0,30}", fullmatch=True)
TEXTS = st.text(st.characters(min_codepoint=32, max_codepoint=255, exclude_characters='"'))
VALUES = TEXTS | st.integers(-(10**17), 10**17) | st.floats(allow_nan=False, allow_infinity=False)
ATTRIBUTES = st.builds(Attribute, NAMES, st.lists(VALUES, max_size=2).map(tuple))
INSTANCES = st.lists(ATTRIBUTES, min_size=1, max_size=8).map(lambda a: Instance(tuple(a)))
SECTIONS = st.lists(
    st.builds(Section, NAMES, st.lists(INSTANCES, max_size=3).map(tuple)), max_size=3
)


@given(SECTIONS)
def test_written_text_is_read_back(sections):
    written = write_cfg(CfgText("SYS", (7, 0), tuple(sections)))
    read = parse_cfg(written)
    plain = [(s.name, [i.attributes for i in s.instances]) for s in read.sections]
    assert plain == [(s.name, [i.attributes for i in s.instances]) for s in sections]
    # A line breaks before an attribute that does not fit; a longer one stands alone.
    for line in written.splitlines():
        if len(line) > 81:
            (alone,) = parse_cfg(f"SYS:CFG_1.0:7:0::\nX:\n{line}").instances("X")
            assert len(alone.attributes) == 1


def test_attribute_longer_than_a_line_has_its_own_line():
    attributes = (Attribute("A", (1,)), Attribute("B" * 31, (-1.5e-300, 10**40)), Attribute("C"))
    cfg = CfgText("SYS", (7, 0), (Section("S", (Instance(attributes),)),))
    lines = write_cfg(cfg).splitlines()[4:]
    assert [line[:9] for line in lines] == ["      -A ", "      -BB", "      -C"]
    assert len(lines[1]) > 81
