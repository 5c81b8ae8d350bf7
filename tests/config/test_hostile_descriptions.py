"""Descriptions that try to run code, to read other files, or never to end."""

import os
from functools import partial
from unittest.mock import patch

import pytest

from rapidgen.config.urdf.expand import Request, expand
from rapidgen.config.urdf.expressions import Allowance
from rapidgen.config.urdf.packages import Packages
from rapidgen.diagnostics import DiagnosticError

XACRO = 'xmlns:xacro="http://www.ros.org/wiki/xacro"'
SECRET = "canary-content"
pytestmark = pytest.mark.timeout(60)
"""An input without end fails; docs/develop/performance.md has the time that they take."""

BUILTINS = "g.gi_frame.f_back.f_back.f_builtins['__import__']('os').system('touch {canary}')"
EXPRESSIONS = {
    "generator frame": f"[g := ({BUILTINS} for i in [1]), list(g)]",
    "subclasses": "().__class__.__base__.__subclasses__()",
    "getattr by text": "python.getattr((), '__class__')",
    "type": "python.type(1)",
    "vars": "python.vars()",
    "eval": "eval('1')",
    "exec": "exec('1')",
    "import": "__import__('os').system('touch {canary}')",
    "import expression": "import os",
    "lambda": "(lambda: 1)()",
    "attribute of a function": "load_yaml.__globals__",
    "attribute of a method": "'a'.join.__self__",
    "attribute of a namespace": "math.__loader__",
    "attribute of a namespace by item": "math['__loader__']",
    "function by name": "xacro.load_yaml.__globals__['os']",
    "module of xacro": "xacro.os",
    "format method": "'{{0.__class__}}'.format(1)",
    "format text": "f'{{1:1000000000}}'",
    "wide format": "'%1000000000d' % 1",
    "starred format": "'%*d' % (1000000000, 1)",
    "map of a method": "list(map(str.upper, ['a']))",
    "sorted by a key": "python.sorted([1], key=print)",
    "print": "print(1)",
    "open": "open('{outside}').read()",
    "yaml outside": "xacro.load_yaml('{outside}')",
    "yaml by a link": "xacro.load_yaml('link.yaml')",
    "yaml of a pipe": "xacro.load_yaml('pipe.yaml')",
    "yaml of aliases": "xacro.load_yaml('bomb.yaml')",
    "yaml of a Python object": "xacro.load_yaml('object.yaml')",
    "power": "9**9**9",
    "power of a power": "(9**99)**(9**9)",
    "shift": "1 << 10**12",
    "long text": "'a' * 10**9",
    "long list": "[0] * 10**9",
    "doubled text": "'a' * 99999 + 'a' * 99999",
    "replaced text": "('a' * 9999).replace('a', 'b' * 9999)",
    "joined text": "('b' * 9999).join(['a'] * 9999)",
    "range": "list(range(10**10))",
    "nested ranges": "[0 for a in range(9999) for b in range(9999) for c in range(9999)]",
    "nested lists": "[[[[[0] * 99] * 99] * 99] * 99] * 99",
    "sum of ranges": "sum(range(10**10))",
    "factorial": "factorial(10**7)",
    "comb": "math.comb(10**7, 10**6)",
    "deep expression": "(" * 900 + "1" + ")" * 900,
    "deep signs": "-" * 4900 + "1",
    "long expression": "1+" * 100_000 + "1",
    "large number": "int('9' * 99999)",
    "round to many places": "round(10, -10**9)",
    "product": "math.prod(list(range(1, 99999)))",
    "least common multiple": "math.lcm(*[i**300 for i in range(2, 999)])",
    "sum of lists": "sum([[0]] * 49999, [])",
    "map that makes lists": "list(map(range, [99999] * 9999))",
    "lists in a comprehension": "[list(range(99999)) for i in range(9999)]",
    "format that repeats": "'%(a)s' * 9000 % dict(a='x' * 99999)",
    "yaml of a sexagesimal number": "xacro.load_yaml('sexagesimal.yaml')",
    "yaml of a deep list": "xacro.load_yaml('deep.yaml')",
    "environment": "env('HOME')",
    "assignment": "(a := 1)",
    "await": "await x",
    "star arguments": "max(*range(10**9))",
}
DOCUMENTS = {
    "include": '<xacro:include filename="{outside}"/>',
    "optional include": '<xacro:include filename="{outside}" optional="true"/>',
    "include upwards": '<xacro:include filename="../outside/secret.xacro"/>',
    "include by a link": '<xacro:include filename="link.xacro"/>',
    "include of a pattern": '<xacro:include filename="{folder}/*"/>',
    "include of everything": '<xacro:include filename="/*/*/*/*/*"/>',
    "include of a pipe": '<xacro:include filename="pipe.xacro"/>',
    "include of a device": '<xacro:include filename="/dev/zero"/>',
    "include of itself": '<xacro:include filename="robot.xacro"/>',
    "include by a computed name": "<xacro:include filename=\"${{'/' + '{outside}'[1:]}}\"/>",
    "eval": "<link name=\"$(eval __import__('os').system('touch {canary}'))\"/>",
    "eval of a generator": f'<link name="$(eval list(g := ({BUILTINS} for i in [1])))"/>',
    "eval of a power": '<link name="$(eval 9**9**9)"/>',
    "environment": '<link name="$(env HOME)"/>',
    "macro of itself": '<xacro:macro name="m" params=""><xacro:m/></xacro:macro><xacro:m/>',
    "macros that double": "".join(
        f'<xacro:macro name="m{n}" params=""><xacro:m{n + 1}/><xacro:m{n + 1}/></xacro:macro>'
        for n in range(40)
    )
    + '<xacro:macro name="m40" params=""><link name="l"/></xacro:macro><xacro:m0/>',
    "properties that double": '<xacro:property name="p0" value="aaaaaaaa"/>'
    + "".join(
        f'<xacro:property name="p{n + 1}" value="${{{{p{n}}}}}${{{{p{n}}}}}"/>' for n in range(40)
    )
    + '<link name="${{p40}}"/>',
    "properties in a circle": '<xacro:property name="a" value="${{b}}"/>'
    '<xacro:property name="b" value="${{a}}"/><link name="${{a}}"/>',
    "quotes in parameters": f'<xacro:macro name="m" params="a:={"b" * 60}\'"/>',
    "many quotes in parameters": '<xacro:macro name="m" params="a:=' + "''" * 60 + "'x\"/>",
    "property of a deep name": '<xacro:property name="' + "(" * 5000 + '" value="1"/>',
    "condition": "<xacro:if value=\"${{[].__class__}}\"><link name='a'/></xacro:if>",
    "large file": "<!--" + "a" * 4_100_000 + "-->",
}


@pytest.fixture
def place(tmp_path):
    folder = tmp_path / "robot"
    folder.mkdir()
    outside = tmp_path / "outside"
    outside.mkdir()
    for name in ("secret.xacro", "secret.yaml"):
        (outside / name).write_text(f"<robot><link name='{SECRET}'/></robot>")
    (folder / "link.xacro").symlink_to(outside / "secret.xacro")
    (folder / "link.yaml").symlink_to(outside / "secret.yaml")
    os.mkfifo(folder / "pipe.xacro")
    os.mkfifo(folder / "pipe.yaml")
    rows = ["a0: &a0 [x, x, x, x, x, x, x, x, x]"]
    rows += [f"a{n}: &a{n} [{', '.join([f'*a{n - 1}'] * 9)}]" for n in range(1, 20)]
    (folder / "bomb.yaml").write_text("\n".join(rows))
    (folder / "sexagesimal.yaml").write_text("a: 1" + ":1" * 300_000)
    (folder / "deep.yaml").write_text("[" * 100_000)
    (folder / "object.yaml").write_text("!!python/object/apply:os.system ['touch canary']")
    return folder


def describe(place, content):
    """Write the description and expand it; the places in `content` are filled in."""
    canary = place.parent / "canary"
    content = content.replace("{{", "\0").replace("}}", "\1")
    content = content.replace("{canary}", str(canary)).replace("{folder}", str(place.parent))
    content = content.replace("{outside}", str(place.parent / "outside" / "secret.xacro"))
    content = content.replace("\0", "{").replace("\1", "}")
    path = place / "robot.xacro"
    path.write_text(f'<robot name="r" {XACRO}>{content}</robot>')
    return expand(Request(path, Packages({}, (), place, environment={})))


def check(place, content):
    # The limit is 4 s: a test has no need to spend them.
    with (
        patch("rapidgen.config.urdf.sandbox.Allowance", partial(Allowance, seconds=0.5)),
        pytest.raises(DiagnosticError) as refused,
    ):
        describe(place, content)
    assert not (place.parent / "canary").exists()
    texts = [f"{d.message} {d.help} {d.label}" for d in refused.value.diagnostics]
    assert not [text for text in texts if SECRET in text or "Traceback" in text]
    assert max(map(len, texts)) < 1000


@pytest.mark.parametrize("name", EXPRESSIONS)
def test_hostile_expression_is_rejected(name, place):
    expression = EXPRESSIONS[name].replace("&", "&amp;").replace("<", "&lt;").replace('"', "&quot;")
    check(
        place, f'<link name="${{{{{expression}}}}}"/>'.replace("{{{{", "{{").replace("}}}}", "}}")
    )


@pytest.mark.parametrize("name", DOCUMENTS)
def test_hostile_document_is_rejected(name, place):
    check(place, DOCUMENTS[name])


# Expressions of public support packages are of these kinds.
@pytest.mark.parametrize(
    ("expression", "value"),
    [
        ("1 + 2 * 3", "7"),
        ("pi / 2", "1.5707963267948966"),
        ("radians(180)", "3.141592653589793"),
        ("math.sqrt(4)", "2.0"),
        ("-5 if True else 1", "-5"),
        ("'a' + str(1)", "a1"),
        ("values['x'][1]", "3"),
        ("values.x[-1]", "3"),
        ("[v * 2 for v in values.x]", "[4, 6]"),
        ("' '.join([str(v) for v in values.x])", "2 3"),
        ("list(map(float, '1 2'.split()))", "[1.0, 2.0]"),
        ("max([1, 5, 2])", "5"),
        ("'%.3f' % 1.5", "1.500"),
        ("len(values['x']) == 2 and not False", "True"),
        ("'left' in 'left_arm'", "True"),
        ("dict(a=1)['a']", "1"),
        ("xacro.arg('side')", "left"),
        ("values.get('y', 7)", "7"),
        ("2 ** 10", "1024"),
    ],
)
def test_ordinary_expression_is_evaluated(expression, value, place):
    (place / "values.yaml").write_text("x: [2, 3]\n")
    made = describe(
        place,
        '<xacro:arg name="side" default="left"/>'
        '<xacro:property name="values" value="${{xacro.load_yaml(\'values.yaml\')}}"/>'
        f'<link name="${{{{{expression}}}}}"/>'.replace("{{{{", "{{").replace("}}}}", "}}"),
    )
    assert f'<link name="{value}"/>' in made.text


@pytest.mark.parametrize(
    "params", ["a:=${{1 + 1}}/${{'x y'}}", "a:='x y' b:=$(arg side)", "*origin a:=^|0"]
)
def test_defaults_of_parameters_are_those_of_xacro(params):
    import xacro

    from rapidgen.config.urdf.sandbox import _MACRO_PARAMETER

    text = params.replace("{{", "{").replace("}}", "}")
    found = [re.match(text) for re in (xacro.re_macro_arg, _MACRO_PARAMETER)]
    assert [match and match.groups() for match in found] == [found[0] and found[0].groups()] * 2


def test_folder_of_a_package_path_may_be_included(place):
    path = place / "robot.xacro"
    path.write_text(
        f'<robot name="r" {XACRO}><xacro:include filename="../outside/secret.xacro"/></robot>'
    )
    request = Request(path, Packages({}, (place.parent / "outside",), place, environment={}))
    assert SECRET in expand(request).text


def test_names_of_xacro_are_as_before(place):
    import xacro
    from xacro import substitution_args

    before = [dict(vars(module)) for module in (xacro, substitution_args)]
    with pytest.raises(DiagnosticError):
        describe(place, '<link name="${{unknown}}"/>')
    after = [dict(vars(module)) for module in (xacro, substitution_args)]
    changes = {"filestack", "macrostack", "substitution_args_context", "all_includes", "verbosity"}
    for old, new in zip(before, after, strict=True):
        assert {n for n in new if new[n] is not old.get(n)} <= changes
