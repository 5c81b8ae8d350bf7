"""Modules with thousands of targets: constants are made on first need, trees are shared."""

import gc
import weakref

import pytest

from rapidgen.controller import VirtualController
from rapidgen.diagnostics import DiagnosticError
from rapidgen.rapid import Dialect, check, module_trees
from rapidgen.rapid.module_trees import SMALL, tree_of
from rapidgen.system.model import ModuleFile
from tests.runtime.booting import boot, system

COUNT = 1500
TARGETS = "".join(f"CONST pos p{k}:=[{k},-{k}.5,9E+09];\n" for k in range(COUNT))


def large(body: str, data: str = "") -> str:
    return f"{TARGETS}{data}PROC main()\n{body}\nENDPROC\n!" + "!" * SMALL


def printed(text: str) -> list[str]:
    controller, lines = boot(text, cycle="once")
    with controller:
        controller.start_program()
        controller.run(max_time=10)
    return lines


def test_constants_of_large_module_have_their_values():
    body = f"TPWrite ValToStr(p0);\nTPWrite ValToStr(p7);\nTPWrite ValToStr(p{COUNT - 1}.y);"
    assert printed(large(body)) == ["[0,-0.5,9E+09]", "[7,-7.5,9E+09]", "-1499.5"]


def test_constant_of_large_module_is_found_by_name():
    body = 'VAR pos a;\nGetDataVal "p9", a;\nTPWrite ValToStr(a.x);'
    assert printed(large(body)) == ["9"]


def test_constants_that_need_others_have_their_values():
    data = "CONST num n:=3;\nCONST pos q:=[n,n,n];\nCONST pos r{2}:=[[1,2,3],[4,5,6]];\n"
    assert printed(large("TPWrite ValToStr(q);\nTPWrite ValToStr(r{2});", data)) == [
        "[3,3,3]",
        "[4,5,6]",
    ]


@pytest.mark.parametrize("value", ["[1,2]", "[1,[2],3]", "[[1,2,3]]"])
def test_wrong_aggregate_of_large_module_is_an_error_at_load(value):
    with pytest.raises(DiagnosticError):
        boot(large("", f"CONST pos wrong:={value};\n"))


@pytest.mark.parametrize(
    ("value", "codes"),
    [
        ("[1,2,3]", []),
        ("[1,-2,3]", []),
        ("[1,2]", ["RG330"]),
        ("[1,2,16777217]", ["RG319"]),
        ("[1,2,1E39]", ["RG319"]),
        ("[1,[2],3]", ["RG330"]),
        ('[1,"2",3]', ["RG307"]),
    ],
)
def test_aggregates_after_equal_ones_are_checked(value, codes):
    text = f"MODULE m\nCONST pos a:=[4,5,6];\nCONST pos b:={value};\nENDMODULE\n"
    assert [d.code for d in check(text)] == codes


def test_aggregate_of_same_shape_and_other_type_is_checked():
    text = "MODULE m\nCONST pos a:=[4,5,6];\nCONST orient b:=[4,5,6];\nENDMODULE\n"
    assert [d.code for d in check(text)] == ["RG330"]


def test_tree_of_large_module_lives_with_its_file():
    file = ModuleFile("m", "m.mod", f"MODULE m\n{large('')}\nENDMODULE\n".encode())
    gone = weakref.ref(file)
    assert tree_of(file, Dialect()) is tree_of(file, Dialect((7, 0)))
    assert tree_of(file, Dialect()) is not tree_of(file, Dialect((5, 0)))
    del file
    gc.collect()
    assert gone() is None


def test_check_and_boot_parse_a_module_once(monkeypatch):
    parsed = []
    parse = module_trees.parse

    def counted(*arguments, **named):
        parsed.append(named["path"])
        return parse(*arguments, **named)

    monkeypatch.setattr(module_trees, "parse", counted)
    one = system({"T_ROB1": large("TPErase;")})
    check(one)
    with VirtualController(one):
        assert len(parsed) == 1
