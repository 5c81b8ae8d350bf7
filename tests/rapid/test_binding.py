"""Binding: names, constants, types, arguments, and symbols at a place."""

import pytest

from rapidgen.rapid import parse
from rapidgen.rapid.binding import (
    ArgumentFault,
    BoundModule,
    NotConstant,
    TaskScope,
    builtin,
    constant,
    evaluate,
    first_fit,
    installed_objects,
    match,
    root,
    type_of,
)
from rapidgen.rapid.binding.lookup import scope_at, type_before
from rapidgen.rapid.syntax.nodes import FunctionCall, ProcedureCall
from rapidgen.rapid.syntax.walk import walk


def bind(*texts, installed="", configured=()):
    """Scopes of modules, the installed one last."""
    task = TaskScope(installed_objects(configured))
    scopes = [task.add(parse(text, path=f"{i}.mod")) for i, text in enumerate(texts)]
    if installed:
        scopes.append(task.add(parse(installed, path="installed.sys"), installed=True))
    return scopes


def module(data="", body="", remaining="", name="m"):
    return f"MODULE {name}\n{data}\nPROC main()\n{body}\nENDPROC\n{remaining}\nENDMODULE\n"


def expression(text, data=""):
    """(expression, scope) of a right side in main()."""
    (scope,) = bind(module(data, f"x := {text};"))
    routine = scope.tree.routines[0]
    return routine.body[0].value, scope.routine(routine)


# -- names -----------------------------------------------------------------------------------


def test_the_innermost_scope_wins():
    inner = "VAR num n;\nFOR n FROM 1 TO 2 DO\nq := n;\nENDFOR\nq := n;"
    own, other, installed = bind(
        module("LOCAL CONST num n := 1;\nCONST num v10 := 2;", inner),
        module("CONST num n := 3;\nCONST num far := 4;", "q := n;", name="other"),
        installed="MODULE sys\nCONST num n := 5;\nCONST num far := 6;\nVAR num deep;\nENDMODULE",
        configured=[("n", "signaldo"), ("lamp", "signaldo")],
    )
    routine = own.routine(own.tree.routines[0])
    loop = routine.node.body[0]
    assert routine.find("N").kind == "VAR"
    assert routine.loop(loop).find("n").kind == "LOOP"
    assert own.find("n").node.initial.value == 1
    assert other.find("n").node.initial.value == 3
    assert installed.find("n").node.initial.value == 5
    assert installed.find("far").node.initial.value == 6
    assert own.find("far").module is other
    assert own.find("deep").module is installed
    assert installed.find("main") is None
    assert own.find("lamp").kind == "INSTALLED"
    assert own.find("v10").module is own
    assert other.find("V20") is builtin("v20")


def test_clashes_are_kept_and_the_first_counts():
    one, two = bind(
        module("VAR num a;\nVAR bool A;\nVAR num both;"),
        module("VAR num both;", "", "PROC m()\nENDPROC", name="two"),
    )
    assert [(a.type, b.type) for a, b in one.clashes] == [("num", "bool")]
    assert one.find("a").type == "num"
    pairs = {(a.kind, b.kind, b.module) for a, b in one.task.clashes}
    assert ("VAR", "VAR", two) in pairs
    assert ("MODULE", "PROC", two) in pairs
    assert two.find("both") is two.own["both"]


def test_modules_come_and_go():
    one, two = bind(module("VAR mine x;"), "MODULE two\nRECORD mine\nnum a;\nENDRECORD\nENDMODULE")
    task, x = one.task, one.find("x")
    assert one.type_of(x) == "mine"
    task.remove(two)
    assert (one.find("mine"), one.type_of(x), set(task.modules)) == (None, None, {"m"})


def test_aliases_resolve_to_types():
    (scope,) = bind(
        module(
            "RECORD pair\nnum a;\nerrnum b;\nENDRECORD\nALIAS pair twin;\n"
            "RECORD door\nsignaldo lock;\nENDRECORD\n"
            "VAR twin x{2,3};\nVAR intnum i;\nVAR nowhere n;"
        )
    )
    assert scope.type_of(scope.find("x")) == "pair{*,*}"
    assert scope.type_of(scope.find("i")) == "num"
    assert scope.type_of(scope.find("n")) is None
    assert scope.components("pair") == {"a": "num", "b": "num"}
    assert scope.components("pose") == {"trans": "pos", "rot": "orient"}
    assert scope.components("num") is None
    assert scope.type_symbol("twin") is scope.find("pair")
    assert [scope.type_class(t) for t in ("pair", "door", "signaldi", "socketdev")] == [
        "value", "nonvalue", "semivalue", "nonvalue",
    ]  # fmt: skip


def test_recursive_record_has_no_class():
    (scope,) = bind("MODULE m\nRECORD r\nr inner;\nENDRECORD\nENDMODULE")
    assert scope.type_class("r") == "value"


# -- constants -------------------------------------------------------------------------------

DATA = """
RECORD pair
num a;
string b;
ENDRECORD
CONST num n := 0.1;
CONST dnum d := 0.1;
CONST pair p := [7, "seven"];
CONST num row{3} := [4, 5, 6];
CONST pos here := [1, 2, 3];
CONST num again := p.a;
CONST num loop_a := loop_b;
CONST num loop_b := loop_a;
VAR num v := 1;
"""


@pytest.mark.parametrize(
    ("text", "kind", "value"),
    [
        ("0.1", "num", 0.10000000149011612),
        ("n", "num", 0.10000000149011612),
        ("0.1", "dnum", 0.1),
        ("d", "dnum", 0.1),
        ("d = 0.1", "bool", True),
        ("16777217", "num", 16777216),
        ("7 DIV 2", "num", 3),
        ("-7 DIV 2", "num", -3),
        ("-7 MOD 2", "num", -1),
        ("7 / 2", "num", 3.5),
        ("2 * (3 - 1)", "num", 4),
        ("p.a", "num", 7),
        ("p.B", "string", "seven"),
        ("row{2}", "num", 5),
        ("here + [1, 1, 1]", "pos", (2, 3, 4)),
        ("-here", "pos", (-1, -2, -3)),
        ("here.y > 1 AND NOT FALSE", "bool", True),
        ("TRUE XOR TRUE", "bool", False),
        ("[[1, 2, 3], [1, 0, 0, 0]]", "pose", ((1, 2, 3), (1, 0, 0, 0))),
        ("[[1, 2], [3, 4]]", "num{*,*}", ((1, 2), (3, 4))),
        ('"a" + "b"', "string", "ab"),
        ("again", "num", 7),
        ("WAIT_MAX", "num", 9999999),
    ],
)
def test_values_before_the_run(text, kind, value):
    node, scope = expression(text, DATA)
    assert evaluate(node, scope, kind) == value


@pytest.mark.parametrize(
    ("text", "why"),
    [
        ("v", "v is no constant"),
        ("missing", "missing is not known"),
        ("loop_a", "loop_a has no value that is known"),
        ("Abs(n)", "this is no constant expression"),
        ("1 / 0", "this cannot be evaluated (division by zero)"),
        ("1.5 DIV 1", "this cannot be evaluated (ERR_NOTINTVAL)"),
        ("1 MOD -2", "this cannot be evaluated (ERR_NEGARG)"),
        ("row{4}", "the index is outside the array"),
        ("p.c", "there is no component c"),
        ('"text"', "the value is string, not num"),
        ("1E39", "num cannot hold this"),
        ("[1]", "an aggregate is no num"),
        ("NOT 1", "NOT takes bool"),
    ],
)
def test_run_time_expressions_have_no_value(text, why):
    node, scope = expression(text, DATA)
    with pytest.raises(NotConstant) as error:
        evaluate(node, scope, "num")
    assert str(error.value) == why
    if text != '"text"' and text != "1E39":
        assert constant(node, scope) is None


def test_constants_of_a_routine_know_those_above():
    (scope,) = bind(
        module("CONST num a := 1;", "CONST num a := 5;\nCONST num b := a + 1;\nx := b;")
    )
    routine = scope.routine(scope.tree.routines[0])
    assert constant(routine.node.body[0].value, routine) == 6


# -- types of expressions --------------------------------------------------------------------


@pytest.mark.parametrize(
    ("text", "result"),
    [
        ("1", "number"),
        ("1 + n", "num"),
        ("d * 2", "dnum"),
        ("n + d", None),
        ("here * 2", "pos"),
        ("here + [1, 2, 3]", "pos"),
        ("row", "num{*}"),
        ("row{1}", "num"),
        ("row{1, 1}", None),
        ("p.b", "string"),
        ("p.c", None),
        ("lamp", "num"),
        ("clock1", None),
        ("StrLen(p.b)", "num"),
        ("main", None),
        ("NOT TRUE", "bool"),
        ("n < 2", "bool"),
        ("-(n)", "num"),
        ("[1, 2]", "aggregate"),
    ],
)
def test_types_of_expressions(text, result):
    (scope,) = bind(module(DATA, f"x := {text};"), configured=[("lamp", "signaldo")])
    routine = scope.tree.routines[0]
    assert type_of(routine.body[0].value, scope.routine(routine)) == result


def test_root_of_reference_is_first_symbol():
    node, scope = expression("row{1}", DATA)
    assert root(node, scope).name == "row"
    assert root(*expression("1", DATA)) is None


# -- arguments -------------------------------------------------------------------------------

ROUTINE = (
    "PROC p(num a \\switch s, string b \\num x | bool y \\num z)\nENDPROC\nPROC q(\\num o)\nENDPROC"
)


def matched(call, routine=ROUTINE):
    """Parameter of each argument with what is wrong, and the missing ones."""
    (scope,) = bind(module("", "", f"{routine}\nPROC caller(\\num o)\n{call}\nENDPROC"))
    routine = scope.routine(scope.tree.routines[-1])
    node = next(n for n in walk(routine.node) if isinstance(n, ProcedureCall | FunctionCall))
    symbol = routine.find(node.name)
    parameters = symbol.parameters

    def fitting(argument, alternatives):
        types = [scope.base(parameters[k].type) for k in alternatives]
        return first_fit(type_of(argument.value, routine), alternatives, types)

    result = match(parameters, node.arguments, fitting)
    names = [parameters[k].name for k in result.missing]
    pairs = [(parameters[p.parameter].name if p.parameter >= 0 else None) for p in result.pairs]
    return pairs, [m for p in result.pairs for m in p.misfits], names


@pytest.mark.parametrize(
    ("call", "pairs", "misfits", "missing"),
    [
        ('p 1, "b";', ["a", "b"], [], []),
        ('p 1 \\s, "b" \\y:=TRUE \\z:=1;', ["a", "s", "b", "y", "z"], [], []),
        ('p a:=1, B:="b";', ["a", "b"], [], []),
        ('p 1, "b" \\x?o \\y?o;', ["a", "b", "x", "y"], [], []),
        ("p 1;", ["a"], [], ["b"]),
        ('p 1, "b", 3;', ["a", "b", None], [ArgumentFault.SURPLUS], []),
        ('p 1, "b" \\t;', ["a", "b", None], [ArgumentFault.UNKNOWN], []),
        ('p 1, "b" \\a:=1;', ["a", "b", None], [ArgumentFault.UNKNOWN], []),
        ('p 1, "b" \\s;', ["a", "b", "s"], [ArgumentFault.ORDER], []),
        ('p 1, "b", b:="c";', ["a", "b", "b"], [ArgumentFault.TWICE], []),
        ('p 1, "b" \\x:=1 \\y:=TRUE;', ["a", "b", "x", "y"], [ArgumentFault.EXCLUSIVE], []),
        (
            'p 1, "b" \\y:=TRUE \\x:=1;',
            ["a", "b", "y", "x"],
            [ArgumentFault.ORDER, ArgumentFault.EXCLUSIVE],
            [],
        ),
        ("q;", [], [], []),
    ],
)
def test_arguments_are_matched(call, pairs, misfits, missing):
    assert matched(call) == (pairs, misfits, missing)


@pytest.mark.parametrize(
    ("value", "name"), [("n", "Name"), ("d", "Dname"), ("1", "Name"), ("missing", "Name")]
)
def test_required_alternatives_go_by_the_type(value, name):
    assert matched(f"VAR num n;\nVAR dnum d;\nIncr {value};") == ([name], [], [])


def test_arguments_in_the_order_of_the_parameters():
    (scope,) = bind(module("", "", f'{ROUTINE}\nPROC caller()\np 1, "b" \\z:=3;\nENDPROC'))
    call = scope.tree.routines[-1].body[0]
    findings = match(scope.find("p").parameters, call.arguments, lambda _, these: these[0])
    values = [a and a.value.value for a in findings.in_order(6)]
    assert values == [1, None, "b", None, None, 3]


# -- places ----------------------------------------------------------------------------------

TEXT = """MODULE places
  RECORD pair
    num a;
    twin b;
  ENDRECORD
  ALIAS num twin;
  VAR pair both;
  PROC work(num count \\twin often)
    VAR num i := 0;
    FOR i FROM i TO count DO
      both.a := i + far; GOTO again;
    ENDFOR
    GOTO again;
    again:
    work count:=i \\often:=Answer();
    WaitTime\\InPos, 1;
    %"work"% 1;
    CONNECT far WITH later;
  ENDPROC
  FUNC twin Answer()
    RETURN both.b;
  ENDFUNC
  TRAP later
  ENDTRAP
ENDMODULE
"""


@pytest.fixture(scope="module")
def places():
    scope, other = bind(TEXT, "MODULE other\nVAR intnum far;\nENDMODULE")
    return BoundModule(scope), BoundModule(other)


def place(line, word, nth=0):
    """Line and column of a word in TEXT."""
    text = TEXT.splitlines()[line - 1]
    column = -1
    for _ in range(nth + 1):
        column = text.index(word, column + 1)
    return line, column + 1


@pytest.mark.parametrize(
    ("at", "kind", "declared"),
    [
        (place(1, "places"), "MODULE", (1, 8)),
        (place(2, "pair"), "RECORD", (2, 10)),
        (place(4, "twin"), "ALIAS", (6, 13)),
        (place(6, "twin"), "ALIAS", (6, 13)),
        (place(7, "pair"), "RECORD", (2, 10)),
        (place(8, "work"), "PROC", (8, 8)),
        (place(8, "count"), "PARAMETER", (8, 17)),
        (place(8, "twin"), "ALIAS", (6, 13)),
        (place(9, "i "), "VAR", (9, 13)),
        (place(10, "i "), "LOOP", (10, 9)),
        (place(10, "i ", 1), "VAR", (9, 13)),
        (place(11, "i "), "LOOP", (10, 9)),
        (place(11, "far"), "VAR", (2, 12)),
        (place(13, "again"), "LABEL", (14, 5)),
        (place(14, "again"), "LABEL", (14, 5)),
        (place(15, "count"), "PARAMETER", (8, 17)),
        (place(15, "i "), "VAR", (9, 13)),
        (place(15, "often"), "PARAMETER", (8, 29)),
        (place(15, "Answer"), "FUNC", (20, 13)),
        (place(17, '"work"'), "PROC", (8, 8)),
        (place(18, "later"), "TRAP", (23, 8)),
        (place(20, "twin"), "ALIAS", (6, 13)),
        (place(21, "both"), "VAR", (7, 12)),
    ],
)
def test_symbol_at_place_is_found(places, at, kind, declared):
    symbol = places[0].at(*at)
    assert (symbol.kind, symbol.declared_at.line, symbol.declared_at.column) == (kind, *declared)


@pytest.mark.parametrize(
    ("at", "name"),
    [(place(3, "num"), "num"), (place(16, "WaitTime"), "WaitTime"), (place(16, "InPos"), "InPos")],
)
def test_built_in_names_have_no_place(places, at, name):
    symbol = places[0].at(*at)
    assert (symbol.name, symbol.declared_at) == (name, None)


@pytest.mark.parametrize("at", [(1, 1), (1, 7), (7, 1), (9, 18), (40, 1), (0, 0)])
def test_place_without_name_has_no_symbol(places, at):
    assert places[0].at(*at) is None


def test_name_extends_to_position_after_last_letter(places):
    line, column = place(7, "both")
    result = [places[0].at(line, c) for c in (column, column + 3, column + 4)]
    assert [s.name for s in result] == ["both"] * 3


def test_all_uses_of_a_name(places):
    here, other = places
    work = here.at(*place(8, "work"))
    assert [(s.line, s.column) for s in here.uses(work)] == [(15, 5), (17, 6)]
    far = here.at(*place(11, "far"))
    assert [s.line for s in here.uses(far)] == [11, 18]
    assert other.uses(far) == []
    again = here.at(*place(14, "again"))
    assert [(s.line, s.column) for s in here.uses(again)] == [(11, 31), (13, 10)]
    i = here.at(*place(9, "i "))
    assert [(s.line, s.column) for s in here.uses(i)] == [(10, 16), (15, 17)]


def test_parameters_of_a_routine(places):
    work = places[0].at(*place(8, "work"))
    assert [p.name for p in work.parameters] == ["count", "often"]
    assert [p.name for p in builtin("waittime").parameters] == ["InPos", "Time"]


# -- components and unfinished text ----------------------------------------------------------


def symbol_at(scope, marked):
    """The symbol at the text between two `@`, which are taken out by the caller."""
    source = scope.tree.source
    return BoundModule(scope).at(*source.position(source.text.index(marked)))


def test_components_of_records_are_symbols():
    text = """MODULE m
RECORD part num size; robtarget place; ENDRECORD
VAR part list{3};
PROC main()
list{2}.place.trans.x := list{1}.size;
ENDPROC
ENDMODULE"""
    (scope,) = bind(text)
    size = symbol_at(scope, "size;")
    assert (size.kind, size.type, size.record.name) == ("COMPONENT", "num", "part")
    assert symbol_at(scope, "size;\nENDPROC") is size
    assert [s.line for s in BoundModule(scope).uses(size)] == [5]
    assert symbol_at(scope, "trans").record.name == "robtarget"
    assert symbol_at(scope, "x :=").record.name == "pos"


@pytest.mark.parametrize("statement", ["p.trans.x := ;", "IF p.trans.x THEN", "MoveL p.trans.x"])
def test_names_of_a_broken_statement_have_symbols(statement):
    (scope,) = bind(module("VAR robtarget p;", statement))
    assert symbol_at(scope, "p.").kind == "VAR"
    assert symbol_at(scope, "x").record.name == "pos"


def test_the_scope_of_an_unfinished_loop_has_its_variable():
    (scope,) = bind(module("", "FOR i FROM 1 TO 3 DO\nq := i"))
    tokens = scope.tree.source.tokens
    assert scope_at(scope, len(tokens) - 2).find("i").kind == "LOOP"
    assert scope_at(scope, 1) is scope


def test_types_before_a_component():
    (scope,) = bind(module("VAR robtarget p{2};\nVAR pose q;", "x := 1;"))
    inside = scope.routine(scope.tree.routines[0])
    for text, expected in [
        ("p{1}", "robtarget"),
        ("q.trans", "pos"),
        ("a := CRobT(\\Tool:=t)", "robtarget"),
        ("1", None),
        (")", None),
    ]:
        tokens = parse(f"MODULE m {text}").source.tokens
        assert type_before(tokens, len(tokens) - 1, inside) == expected
