"""Unknown names depend on the input: a file, folder, task or system."""

import pytest

from rapidgen.diagnostics import Severity
from rapidgen.rapid import Dialect, check, parse
from rapidgen.rapid.checks import Payload
from rapidgen.system import MechanicalUnitGroup, ModuleFile, SignalSpec, System, TaskSpec


def module(name, body="", data="", entry="main"):
    return f"MODULE {name}\n{data}\nPROC {entry}()\n{body}\nENDPROC\nENDMODULE\n"


def found(given, **options):
    return [(d.severity.value, d.code) for d in check(given, **options)]


def system(*texts, **parts):
    files = tuple(ModuleFile(f"m{k}", f"m{k}.mod", t.encode()) for k, t in enumerate(texts))
    return System("s", (TaskSpec("T_ROB1", modules=files),), **parts)


def test_partly_known_record_accepts_any_component():
    data = "VAR num n;\nPERS partdata part;"
    assert found(module("a", "n := part.validStation;", data)) == [("warning", "RG304")]
    assert found(module("a", "n := part.plcCode;", data)) == []
    assert found(module("a", "n := part.image;", data)) == [("error", "RG307")]


UNKNOWN = {
    "procedure": "OwnThing 1;",
    "function": 'TPWrite "" \\Num:=OwnValue();',
    "trap": "CONNECT INTNO WITH OwnTrap;",
}


@pytest.mark.parametrize("body", ["OwnThing 1;", "own_flag := TRUE;", "IF di_ready = 1 TPErase;"])
def test_single_file_may_use_names_elsewhere(body):
    assert [severity for severity, _ in found(module("a", body))] == ["info"]


def test_note_lists_possible_sources_of_name():
    body = "SetDO doGrip, 1;\nMoveL p10, v100, fine, tGrip;\nIF found = 3 Helper;"
    (data, calls) = check(module("a", body))
    assert data.message == (
        "not declared here: doGrip (signaldo), p10 (robtarget), tGrip (tooldata), found"
    )
    assert (calls.code, calls.message) == ("RG301", "not declared here: Helper")
    assert "option" in calls.notes[0]


@pytest.mark.parametrize(
    ("body", "code", "suggestion"),
    [
        ('TPWrte "x";', "RG301", "TPWrite"),
        ("SocketRecieve s;", "RG301", "SocketReceive"),
        ("cuonter := 1;", "RG302", "counter"),
    ],
)
def test_a_slip_in_a_lone_file_is_a_warning(body, code, suggestion):
    text = module("a", body, "VAR num counter;\nVAR socketdev s;")
    diagnostics = check(text)
    assert [(d.severity, d.code) for d in diagnostics] == [(Severity.WARNING, code)]
    assert suggestion in diagnostics[0].help


def test_other_prefix_of_a_type_is_no_slip():
    data = "VAR num nSpeed;\nVAR num nCount;"
    assert found(module("a", "vSpeed := 1;", data)) == [("info", "RG302")]
    assert found(module("a", "nCuont := 1;", data)) == [("warning", "RG302")]
    assert found(module("a", "nSpeed := 1;", "VAR num Speed;")) == [("info", "RG302")]
    assert found(module("a", "d2_Speed := 1;", "VAR num ld_Speed;")) == [("info", "RG302")]


def test_suggestion_skips_other_types():
    frame = "[[0,0,0],[1,0,0,0]]"
    data = f'VAR robtarget p1;\nPERS wobjdata wCamera := [FALSE,TRUE,"",{frame},{frame}];'
    tool = f"\nPERS tooldata tCamera := [TRUE,{frame},[1,[0,0,1],[1,0,0,0],0,0,0]];"
    move = "MoveL p1, v100, fine, Camera \\WObj:=wCamera;"
    assert found(module("a", move, data)) == [("info", "RG302")]
    (slip,) = check(module("a", move, data + tool))
    assert (slip.severity, slip.help) == (Severity.WARNING, "did you mean 'tCamera'?")


@pytest.mark.parametrize(
    ("call", "meant"),
    [
        ("MoveL p1, zMax, fine, tool0;", "vmax"),
        ("MoveL p1, v100, zMax, tool0;", None),
        ("WaitTime fines;", None),
        ("SetDO do1, edges;", "edge"),
    ],
)
def test_suggestion_includes_fitting_predefined_names(call, meant):
    (text,) = check(module("a", call, "VAR robtarget p1;\nVAR signaldo do1;"))
    assert text.help == (f"did you mean '{meant}'?" if meant else ""), text
    assert text.severity == (Severity.WARNING if meant else Severity.INFO)


def test_siblings_of_a_slip_are_no_slips():
    text = module("a", "MoveJ p20, v100, fine, tool0;", "VAR robtarget p10;")
    assert found(text) == [("info", "RG302")]


def test_a_folder_may_lack_a_module():
    """Public folders: 34 of 59 errors were names of missing modules."""
    one = parse(module("a", "Helper;\nHelpr;\nIF di_ready = 1 TPErase;"), path="a.mod")
    two = parse("MODULE b\nPROC Helper()\nENDPROC\nENDMODULE\n", path="b.mod")
    assert found([one, two]) == [("warning", "RG301"), ("info", "RG302")]


def test_a_folder_without_an_entry_routine_is_a_part():
    one = parse(module("a", "Missing;", entry="part"), path="a.mod")
    assert found([one]) == [("info", "RG301")]


def test_modules_of_several_tasks_in_a_folder_do_not_clash():
    one, two = (parse(module(n), path=f"{n}.mod") for n in "ab")
    assert found([one, two]) == []


def test_differing_objects_of_tasks_are_not_checked():
    one = parse(module("a", "x := 1;", "PERS num x;"), path="a.mod")
    two = parse(module("b", 'x := "1";', "PERS string x;"), path="b.mod")
    assert found([one, two]) == []


@pytest.mark.parametrize("body", ["WaitDI SENSOR, 1;", "n := Sensor + 1;", "WaitUntil pose = 1;"])
def test_a_signal_may_have_the_name_of_a_predefined_type(body):
    """[code] A program for RobotStudio has an input SENSOR.

    It is not a record there.
    """
    assert found(module("a", body, "VAR num n;")) == [("info", "RG302")]
    complete = system(module("a", body, "VAR num n;"))
    assert "RG306" in {code for _, code in found(complete)}
    assert found(complete, gaps=True) == [("info", "RG302")]


def test_unreadable_module_may_declare_any_name():
    one = parse(module("a", "Missing;"), path="a.mod")
    encoded = parse(b"\xfc\x00\x01", path="b.mod")
    assert found([one, encoded]) == [("info", "RG301"), ("info", "RG219")]


def test_loading_program_may_get_names_of_modules():
    text = module("a", 'Load "HOME:/b.mod";\nMissing;')
    assert found(system(text)) == [("info", "RG301")]


def test_names_of_other_tasks_are_not_called_unknown():
    one = parse(module("a", "Missing;"), path="a.mod")
    assert found([one], elsewhere={"missing"}) == []


def test_a_system_knows_everything():
    text = module("a", "Missing;\nown_flag := TRUE;\nIF di_ready = 1 TPErase;")
    assert found(system(text)) == [("error", "RG301"), ("error", "RG302"), ("error", "RG302")]


def test_a_system_knows_its_signals_units_and_tasks():
    body = """SetDO do_ready, 1;
IF di_ready = 1 AND DOutput(do_ready) = 1 ActUnit STN1;
IF TaskIsActive(T_ROB1Id) TPErase;
SetDO di_ready, 1;"""
    signals = (SignalSpec("di_ready", "DI"), SignalSpec("do_ready", "DO"))
    groups = (MechanicalUnitGroup("rob1", "ROB_1", ("STN1",)),)
    complete = system(module("a", body), signals=signals, groups=groups)
    diagnostics = check(complete)
    assert [(d.code, d.span.line) for d in diagnostics] == [("RG307", 7)]


def test_only_globals_of_a_task_clash():
    one = module("a", data="VAR num x;\nLOCAL VAR num y;\nVAR num z;")
    two = module(
        "b", "y := 1;\nz := y;", data="VAR num x;\nVAR num y;\nLOCAL VAR num z;", entry="b2"
    )
    diagnostics = check(system(one, two))
    errors = [(d.code, d.span.path, d.span.line) for d in diagnostics if "x" in d.message]
    assert errors == [("RG305", "m1.mod", 2)]


def test_a_local_hides_a_global_of_another_module():
    one = module("a", "x := 1;", data="LOCAL VAR num x;")
    two = module("b", 'x := "1";', data="VAR string x;", entry="b2")
    assert [c for _, c in found(system(one, two))] == ["RG324"]  # the LOCAL is only written


def test_the_same_module_in_two_tasks_is_reported_once():
    file = ModuleFile("a", "a.sys", module("a", data="VAR num x := TRUE;").encode())
    tasks = tuple(TaskSpec(name, modules=(file,)) for name in ("T_ROB1", "T_COM"))
    assert found(System("s", tasks)) == [("error", "RG307")]


def test_records_of_other_modules_are_known():
    one = module("a", "r.x := 1;\nr.y := 1;", data="VAR rec r;")
    two = "MODULE b\nRECORD rec\nnum x;\nENDRECORD\nENDMODULE\n"
    assert found(system(one, two)) == [("error", "RG304")]


def test_dialects():
    text = module("a", "d := NumToDnum(1);\nEGMGetId e;", "VAR dnum d;\nVAR egmident e;")
    codes = [d.code for d in check(text, dialect=Dialect((5, 0)))]
    assert codes == ["RG325", "RG325", "RG325"]
    assert found(text, dialect=Dialect((6, 0))) == []
    assert found(text, dialect=Dialect((7, 0))) == []


def test_system_is_checked_for_its_robotware():
    text = module("a", "x := 0x1F;", "VAR num x;")
    assert [c for _, c in found(system(text, robotware=(5, 0)))] == ["RG205"]
    assert found(system(text, robotware=(7, 2))) == []
    assert [c for _, c in found(system(text), dialect=Dialect((5, 0)))] == ["RG205"]


def test_findings_of_the_parser_come_with_those_of_the_checker():
    text = module("a", "x := 1;\ny := 2;\nVAR num z;\nz := TRUE;", "VAR num x;\nVAR num y;")
    assert [c for _, c in found(text)] == ["RG213", "RG324", "RG307"]


def test_duplicate_module_gives_single_finding():
    text = module("a", "x := y;", data="VAR num x;\nVAR num y;")
    clashes = [d for d in check(system(text, text)) if d.code == "RG305"]
    assert [(d.message, d.span.path) for d in clashes] == [
        ("'a' is declared twice in this task", "m1.mod")
    ]


@pytest.mark.parametrize(
    ("routine", "expected"),
    [
        ("PROC main()\nENDPROC", []),
        ("PROC MAIN()\nENDPROC", []),
        ("PROC other()\nENDPROC", [("warning", "RG331")]),
        ("VAR num main;", [("warning", "RG331")]),
        ("LOCAL PROC main()\nENDPROC", [("info", "RG324"), ("warning", "RG331")]),
        ("PROC main(num speed)\nENDPROC", [("error", "RG331")]),
        ("PROC main(\\num speed)\nENDPROC", [("error", "RG331")]),
        ("FUNC num main()\nRETURN 1;\nENDFUNC", [("error", "RG331")]),
        ("TRAP main\nENDTRAP", [("error", "RG331")]),
    ],
)
def test_a_task_starts_in_a_procedure_without_parameters(routine, expected):
    """[K §9]: one task module has the entry routine, without parameters."""
    assert sorted(found(system(f"MODULE a\n{routine}\nENDMODULE\n"))) == expected


def test_entry_routine_is_that_of_configuration():
    file = ModuleFile("a", "a.mod", module("a", entry="start").encode())
    assert found(System("s", (TaskSpec("T_ROB1", entry="Start", modules=(file,)),))) == []
    assert found(System("s", (TaskSpec("T_ROB1", modules=(file,)),))) == [("warning", "RG331")]
    assert found(System("s", (TaskSpec("T_ROB1"),))) == []


def test_no_entry_is_missed_where_modules_are_missing():
    loads = module("a", 'Load "HOME:/b.mod";', entry="other")
    assert found(system(loads)) == []


@pytest.mark.parametrize("flag", ["installed", "shared"])
def test_program_hides_names_of_installed_modules(flag):
    tools = "MODULE tools\nVAR num count;\nPROC Grip()\ncount := ours;\nENDPROC\nENDMODULE\n"
    program = module("p", "Grip;\ncount := TRUE;", "VAR bool count;\nVAR num ours;")
    files = (
        ModuleFile("tools", "tools.sys", tools.encode(), **{flag: True}),
        ModuleFile("p", "p.mod", program.encode()),
    )
    diagnostics = check(System("s", (TaskSpec("T_ROB1", modules=files),)))
    assert [(d.code, d.span.path) for d in diagnostics] == [("RG302", "tools.sys")]
    alike = tuple(ModuleFile(f.name, f.path, f.data) for f in files)
    assert ("error", "RG305") in found(System("s", (TaskSpec("T_ROB1", modules=alike),)))


def test_missing_module_may_hide_built_in_without_arguments():
    assert found(module("a", "Reset;")) == [("warning", "RG311")]
    assert found(module("a", "Reset 1, 2;"))[0][0] == "error"
    assert found(system(module("a", "Reset;"))) == [("error", "RG311")]


def test_missing_routine_gives_arguments_the_type():
    body = "a := elsewhere([1, 2, 3] - [a, 2, 3]);\nother [1, 2, 3] + [a, 2, b];"
    assert {code for _, code in found(module("a", body, "VAR num a;"))} == {"RG301", "RG302"}


def test_backup_without_exact_release_accepts_any_minor():
    text = module("a", "d := GInputDnum(gi1);\nd := 1;", "VAR dnum d;\nVAR signalgi gi1;")
    exact = system(text, robotware=(5, 7))
    some = system(text, robotware=(5, 0), is_robotware_known=False)
    assert ("error", "RG325") in found(exact)
    assert "error" not in {severity for severity, _ in found(some)}


IRB = Payload("irb120", 3)
LOAD = "[{},[0,0,50],[1,0,0,0],0,0,0]"
TOOL = "[TRUE,[[0,0,0],[1,0,0,0]],{}]"


def tool(mass):
    return TOOL.format(LOAD.format(mass))


@pytest.mark.parametrize(
    ("data", "body", "masses"),
    [
        (f"PERS loaddata l := {LOAD.format(-1)};", "GripLoad l;", ["-1"]),
        (f"LOCAL PERS tooldata t := {tool('-0.5')};", "GripLoad t.tload;", ["-0.5"]),
        (f"PERS tooldata t := {tool('3.5')};", "", ["3.5"]),
        (f"PERS tooldata t := {tool('1.2E3')};", "", ["1200"]),
        (f"CONST num kg := 2;\nCONST loaddata l := {LOAD.format('kg * 2')};", "", ["4"]),
        (
            f"PERS loaddata l{{2}} := [{LOAD.format(-1)},{LOAD.format(5)}];",
            "GripLoad l{1};",
            ["-1", "5"],
        ),
        (
            f"RECORD part\nnum n;\nloaddata load;\nENDRECORD\nPERS part p := [1,{LOAD.format(9)}];",
            "",
            ["9"],
        ),
        ("PERS tooldata t;", f"t := {tool(9)};", ["9"]),
        ("PERS tooldata t;", f"t.tload := {LOAD.format(-2)};", ["-2"]),
        ("PERS tooldata t;", "t.tload.mass := 1200;", ["1200"]),
        ("PERS loaddata l{2};", "l{2}.mass := -3;", ["-3"]),
        ("PERS loaddata l;", "IF TRUE l.mass := -3;", ["-3"]),
        (
            "ALIAS loaddata weight;\nPERS weight w := " + LOAD.format(-1) + ";",
            "GripLoad w;",
            ["-1"],
        ),
        (f"PERS loaddata unused := {LOAD.format(-1)};", "", []),
        # What is right, or not known before it runs.
        (f"PERS loaddata l := {LOAD.format(3)};", "", []),
        (f"PERS loaddata l := {LOAD.format(0)};", "", []),
        ("PERS loaddata l;\nVAR num n := -1;", "l.mass := n;", []),
        ("RECORD own\nnum mass;\nENDRECORD\nVAR own o;", "o.mass := -1;", []),
        ("PERS loaddata l;", "l.cog.x := -1200;", []),
    ],
)
def test_excessive_loads_are_reported(data, body, masses):
    for given, task in (
        (module("a", body, data), ""),
        (system(module("a", body, data)), "t_rob1"),
    ):
        diagnostics = [d for d in check(given, payloads={task: IRB}) if d.code == "RG333"]
        assert [d.severity for d in diagnostics] == [Severity.WARNING] * len(masses)
        for diagnostic, mass in zip(diagnostics, masses, strict=True):
            assert diagnostic.message.startswith(f"a load of {mass} kg")
            assert ("irb120 carries, 3 kg" in diagnostic.message) == (mass[0] != "-")


def test_an_unknown_component_of_a_load_is_reported_once():
    data = "PERS tooldata t;"
    assert found(module("a", "t.tlod.mass := -1;", data)) == [("error", "RG304")]
    assert found(module("a", "u.tload.mass := -1;", data)) == [("info", "RG302")]


def test_where_no_robot_is_known_only_a_negative_mass_is_wrong():
    data = f"PERS loaddata l := {LOAD.format('9E6')};\nPERS loaddata m := {LOAD.format(-1)};"
    assert found(module("a", "GripLoad m;", data)) == [("warning", "RG333")]
    task = system(module("a", "GripLoad m;", data))
    assert found(task, payloads={"t_rob2": IRB}) == [("warning", "RG333")]


def test_a_handler_behind_its_routine_is_reported_once():
    text = "MODULE m\nPROC p()\nENDPROC\n%s\nTRYNEXT;\nENDPROC\nPROC q()\nENDPROC\nENDMODULE\n"
    for handler in ("ERROR", "UNDO", "BACKWARD"):
        (one,) = check(text % handler)
        assert (one.code, one.span.line, one.related[0].span.line) == ("RG216", 4, 3)
        assert handler in one.message


@pytest.mark.parametrize(
    ("severity", "given"),
    [("warning", lambda text: text), ("error", lambda text: system(text))],
)
def test_a_datum_of_another_routine_is_named(severity, given):
    trap = "TRAP t\nn := 1;\nENDTRAP\n"
    text = module("m", "n := 2;\nTPWrite ValToStr(n);\nCONNECT i WITH t;", "VAR intnum i;")
    text = text.replace("PROC main()\n", "PROC main()\nVAR num n;\n")
    (one,) = check(given(text.replace("ENDMODULE", trap + "ENDMODULE")))
    assert (one.severity.value, one.code) == (severity, "RG302")
    assert "'main'" in one.message
    assert one.related[0].span.line == 4


@pytest.mark.parametrize(
    ("called", "tasks", "expected"),
    [
        ("go;", ("T_ROB1", "T_IO"), ["RG336"]),
        ("CONNECT i WITH fires;", ("T_ROB1", "T_IO"), ["RG336"]),
        ("IDelete i;", ("T_ROB1", "T_IO"), []),
        ("go;", ("T_IO", "T_ROB1"), []),
    ],
)
def test_a_move_in_a_task_without_a_robot_is_reported(called, tasks, expected):
    """Event 194901 of such a program at run time; only calls from the entry count."""
    moves = (
        "PROC go()\nMoveAbsJ [[0,0,0,0,30,0],[0,0,0,0,0,0]],v100,fine,tool0;\nENDPROC\n"
        "TRAP fires\ngo;\nENDTRAP\n"
    )
    text = module("b", called, "VAR intnum i;").replace("ENDMODULE", moves + "ENDMODULE")
    texts = {tasks[0]: module("a"), tasks[1]: text}
    specs = tuple(
        TaskSpec(name, motion=name == "T_ROB1", modules=(ModuleFile(name, name, text.encode()),))
        for name, text in texts.items()
    )
    codes = [d.code for d in check(System("s", specs))]
    assert [code for code in codes if code == "RG336"] == expected


def test_a_receiver_of_a_value_is_used():
    assert found(module("m", "a := CJointT();", "LOCAL VAR jointtarget a;")) == []
    unused = module("m", "a := 1;", "LOCAL VAR num a;")
    assert found(unused) == [("info", "RG324")]
    assert found(unused, strict=True) == [("warning", "RG324")]


def test_unused_data_of_a_routine_are_one_note():
    (note,) = check(module("m", "VAR num a;\nVAR num b;\nVAR num c;\nb := c;"))
    assert (note.code, note.message) == ("RG324", "'a', 'b' are never read")


def test_a_task_with_system_modules_alone_has_no_program():
    modules = system("MODULE user(SYSMODULE)\nENDMODULE\n")
    assert found(modules) == [("info", "RG331")]


@pytest.mark.parametrize(
    ("body", "severity"),
    [
        ("TPErase;\nRETURN;\nMoveAbsJ home, v100, fine, tool0;", "info"),
        ("IF n = 1 THEN\nRETURN;\nTPErase;\nENDIF", "warning"),
        ("RAISE 1;\nTPErase;", "warning"),
        ("EXIT;\nStop;\nTPErase;", "warning"),
    ],
)
def test_statements_disabled_by_a_return_are_a_note(body, severity):
    text = module("m", body, "VAR num n := 1;\nVAR jointtarget home;")
    assert found(text) == [(severity, "RG323")]
    assert found(text, strict=True) == [("warning", "RG323")]


@pytest.mark.parametrize("leaving", ["RETRY;", "TRYNEXT;", "RETURN;", "RAISE;"])
def test_leaving_twice_is_no_finding(leaving):
    text = module("m", f"TPErase;\nERROR\nExitCycle;\n{leaving}")
    assert found(text) == []


def test_the_source_of_an_alias_is_a_signal_of_the_configuration():
    text = module("m", "AliasIO voClear, svoClear;\nSetDO svoClear, 1;", "VAR signaldo svoClear;")
    assert found(text, strict=True) == [("info", "RG302")]
    assert found(system(text)) == [("error", "RG302")]
    assert found(module("m", "TPWrite Type(voClear);"), strict=True) == [("error", "RG302")]


def test_a_return_behind_an_endless_loop_is_expected():
    loop = "WHILE TRUE DO\nStop;\nENDWHILE\n%s\n"
    function = f"FUNC num f()\n{loop}ENDFUNC\nENDMODULE"
    text = module("m", "TPWrite ValToStr(f());").replace("ENDMODULE", function)
    assert found(text % "RETURN 0;") == []
    assert found(text % "TPErase;\nRETURN 0;") == [("info", "RG323")]
    assert found(module("m", loop % "RETURN;")) == []
    assert found(module("m", loop % "RETURN;\nStop;\nTPErase;")) == [("info", "RG323")]
