"""Mutants of the front end: one small change each, applied and undone.

Three kinds: functions of rapidgen/rapid get a changed code object in place; for tables at module
level the package is imported again; of the built-ins (builtins/*.rapid) one declaration changes.
Equivalent changes are among them.
"""

import ast
import importlib
import importlib.abc
import importlib.util
import inspect
import re
import sys
from collections.abc import Callable
from contextlib import AbstractContextManager, contextmanager
from dataclasses import dataclass
from pathlib import Path
from types import CodeType

import rapidgen.rapid.checks
from rapidgen.rapid.binding import builtin
from rapidgen.rapid.builtins import signatures

ROOT = Path(rapidgen.rapid.checks.__file__).parents[1]
PACKAGE = "rapidgen.rapid"
_SWAPPED = {
    ast.Eq: ast.NotEq, ast.NotEq: ast.Eq, ast.In: ast.NotIn, ast.NotIn: ast.In,
    ast.Is: ast.IsNot, ast.IsNot: ast.Is, ast.Lt: ast.LtE, ast.LtE: ast.Lt,
    ast.Gt: ast.GtE, ast.GtE: ast.Gt, ast.Add: ast.Sub, ast.Sub: ast.Add,
    ast.And: ast.Or, ast.Or: ast.And,
}  # fmt: skip
_ATTRIBUTES = {"WARNING": "ERROR", "ERROR": "WARNING", "warn": "report"}
_TALK = frozenset(("help", "label", "notes", "related"))
"""Arguments with texts that decide nothing."""
_MAX_TEXT = 24
_REGEX = frozenset("(|?*+[-")
_KIND = inspect.CO_GENERATOR | inspect.CO_COROUTINE | inspect.CO_ASYNC_GENERATOR
"""Kinds of functions by code flags: code of another kind cannot replace a function's."""
_SIGN = re.compile(r"\\u....|\\.|.", re.DOTALL)
"""Parts of a regular expression that are left out at once."""


class NoProgram(Exception):
    """The change gives no program that can run."""


@dataclass(frozen=True, eq=False)
class Mutant:
    """A change: place, description, and a context in which it holds.

    `name` is the lower-case name of the changed built-in, if any.
    """

    path: Path
    line: int
    change: str
    made: Callable[[], AbstractContextManager]
    name: str = ""

    def __str__(self):
        return f"{self.path.relative_to(ROOT.parent)}:{self.line}: {self.change}"


# -- changes of Python -----------------------------------------------------------------------


def _changes(node):
    """Yield (description, new node) for each change of one node."""
    if isinstance(node, ast.Compare) and len(node.ops) == 1 and type(node.ops[0]) in _SWAPPED:
        new = ast.Compare(node.left, [_SWAPPED[type(node.ops[0])]()], node.comparators)
        yield f"{_short(node)} -> {_short(new)}", new
    elif isinstance(node, ast.BoolOp):
        yield f"{_short(node)}: and <-> or", ast.BoolOp(_SWAPPED[type(node.op)](), node.values)
        for k, value in enumerate(node.values):
            remaining = node.values[:k] + node.values[k + 1 :]
            new = remaining[0] if len(remaining) == 1 else ast.BoolOp(node.op, remaining)
            yield f"without {_short(value)}", new
    elif isinstance(node, ast.BinOp) and type(node.op) in _SWAPPED:
        new = ast.BinOp(node.left, _SWAPPED[type(node.op)](), node.right)
        yield f"{_short(node)} -> {_short(new)}", new
    elif isinstance(node, ast.BinOp) and isinstance(node.op, ast.BitOr):
        yield f"{_short(node)} -> {_short(node.left)}", node.left
    elif isinstance(node, ast.UnaryOp) and isinstance(node.op, ast.Not):
        yield f"{_short(node)} -> {_short(node.operand)}", node.operand
    elif isinstance(node, ast.If):
        test = ast.UnaryOp(ast.Not(), node.test)
        yield f"if not ({_short(node.test)})", ast.If(test, node.body, node.orelse)
    elif isinstance(node, ast.Expr | ast.Assign | ast.AugAssign | ast.Raise | ast.Continue):
        if not isinstance(getattr(node, "value", None), ast.Constant):
            yield f"without {_short(node)}", ast.Pass()
    elif isinstance(node, ast.Attribute) and node.attr in _ATTRIBUTES:
        new = ast.Attribute(node.value, _ATTRIBUTES[node.attr], node.ctx)
        yield f"{node.attr} -> {new.attr}", new
    elif isinstance(node, ast.Constant):
        yield from _constants(node.value)
    elif isinstance(node, ast.Tuple | ast.List | ast.Set):
        for k, value in enumerate(node.elts):
            remaining = node.elts[:k] + node.elts[k + 1 :]
            new = (
                ast.Set(remaining)
                if isinstance(node, ast.Set)
                else type(node)(remaining, ast.Load())
            )
            yield f"without {_short(value)}", new
    elif isinstance(node, ast.Dict):
        for k, key in enumerate(node.keys):
            new = ast.Dict(
                node.keys[:k] + node.keys[k + 1 :], node.values[:k] + node.values[k + 1 :]
            )
            yield f"without {_short(key or node.values[k])}", new


def _constants(value):
    if isinstance(value, bool):
        yield f"{value} -> {not value}", ast.Constant(not value)
    elif isinstance(value, int):
        yield f"{value} -> {value + 1}", ast.Constant(value + 1)
    elif isinstance(value, str):
        words = value.split()
        if len(words) > 3:
            for k, word in enumerate(words):
                yield f"without {word}", ast.Constant(" ".join(words[:k] + words[k + 1 :]))
        elif len(value) > 1 and _REGEX & set(value):
            for sign in _SIGN.finditer(value):
                remaining = value[: sign.start()] + value[sign.end() :]
                around = value[max(0, sign.start() - 12) : sign.end() + 12]
                yield f"pattern without {sign[0]} in ...{around}...", ast.Constant(remaining)
        elif 0 < len(value) <= _MAX_TEXT:
            yield f"{value!r} -> {value + 'x'!r}", ast.Constant(value + "x")


def _short(node):
    text = " ".join(ast.unparse(node).split())
    return text if len(text) <= 60 else text[:57] + "..."


def _points(node, *, patterns=False):
    """Yield (holder, key, old, new, description) for changes below a node.

    The holder is a list or a node. Types, docstrings and messages are left out; texts with values
    in them are messages, unless they are `patterns`.
    """
    for name, value in ast.iter_fields(node):
        if name in ("annotation", "returns", "decorator_list", "ctx") or (
            name == "args" and not isinstance(node, ast.Call)
        ):
            continue
        holder = value if isinstance(value, list) else node
        keys = range(len(value)) if isinstance(value, list) else (name,)
        for key in keys:
            child = value[key] if isinstance(value, list) else value
            if not isinstance(child, ast.AST):
                continue
            if isinstance(child, ast.JoinedStr) and not patterns:
                continue
            if isinstance(child, ast.keyword) and child.arg in _TALK:
                continue
            for what, new in _changes(child):
                ast.copy_location(new, child)
                yield holder, key, child, ast.fix_missing_locations(new), what
            yield from _points(child, patterns=patterns)


def _set(holder, key, node):
    if isinstance(holder, list):
        holder[key] = node
    else:
        setattr(holder, key, node)


def _sources(root=ROOT, package=PACKAGE):
    """Yield (module name, path, tree) of each module of a package."""
    for path in sorted(root.rglob("*.py")):
        parts = path.relative_to(root).with_suffix("").parts
        name = ".".join((package, *(p for p in parts if p != "__init__")))
        yield name, path, ast.parse(path.read_text("utf-8"))


# -- functions -------------------------------------------------------------------------------


def of_functions(expected=None, *, root=ROOT, package=PACKAGE):
    """Yield mutants of functions and methods.

    Of the modules in `expected` (paths) if given. `root` and `package` replace the front end's.
    """
    for module, path, tree in _sources(root, package):
        if expected is not None and path not in expected:
            continue
        for node in tree.body:
            if isinstance(node, ast.FunctionDef):
                yield from _of_function(module, path, None, node)
            elif isinstance(node, ast.ClassDef):
                for method in node.body:
                    if isinstance(method, ast.FunctionDef):
                        yield from _of_function(module, path, node, method)


def _of_function(module, path, owner, function):
    for holder, key, old, new, what in _points(function):
        made = _swapped_code(module, path, owner, function, (holder, key, old, new))
        yield Mutant(path, old.lineno, what, made)


def _swapped_code(module, path, owner, function, change):
    holder, key, old, new = change

    @contextmanager
    def made():
        _set(holder, key, new)
        try:
            code = _compiled(path, owner, function)
        except (SyntaxError, ValueError) as error:
            raise NoProgram from error
        finally:
            _set(holder, key, old)
        live = _live(module, owner, function)
        before = live.__code__
        saved = code.co_freevars == before.co_freevars
        if not saved or (code.co_flags ^ before.co_flags) & _KIND:
            raise NoProgram
        live.__code__ = code
        _forget(module)
        try:
            yield
        finally:
            live.__code__ = before
            _forget(module)

    return made


def _compiled(path, owner, function):
    """Return the compiled code of one function or method of the tree."""
    body = function
    if owner is not None:
        body = ast.ClassDef(owner.name, owner.bases, owner.keywords, [function], [])
        ast.copy_location(body, owner)
    code = compile(ast.Module([body], []), str(path), "exec")
    if owner is not None:
        code = next(c for c in code.co_consts if isinstance(c, CodeType))
    return next(c for c in code.co_consts if isinstance(c, CodeType) and c.co_name == function.name)


def _live(module, owner, function):
    """Return the function object, without decorators."""
    result = vars(sys.modules[module])
    if owner is not None:
        result = vars(result[owner.name])
    live = result[function.name]
    live = getattr(live, "fget", live)
    return getattr(live, "__wrapped__", live)


def _forget(module):
    if module == signatures.__name__:
        for cached in (
            signatures._headers, signatures.routine, signatures.routines,
            signatures._types, signatures.predefined, signatures.option_names,
            signatures.marked, builtin,
        ):  # fmt: skip
            cached.cache_clear()


# -- tables ----------------------------------------------------------------------------------


def of_tables():
    """Yield mutants of module data other than functions."""
    for module, path, tree in _sources():
        body = [n for n in tree.body if isinstance(n, ast.Assign | ast.AnnAssign)]
        for statement in body:
            if statement.value is None:
                continue
            for holder, key, old, new, what in _points(
                ast.Expression(statement.value), patterns=True
            ):
                if isinstance(holder, ast.Expression):
                    holder, key = statement, "value"
                made = _imported_anew(module, path, tree, (holder, key, old, new))
                yield Mutant(path, old.lineno, what, made)


class _Changed(importlib.abc.MetaPathFinder, importlib.abc.Loader):
    """Imports one module from a code object."""

    def __init__(self, name, path, code):
        self.name, self.path, self.code = name, path, code

    def find_spec(self, name, path, target=None):
        if name != self.name:
            return None
        packages = [str(self.path.parent)] if self.path.name == "__init__.py" else None
        spec = importlib.util.spec_from_loader(name, self, origin=str(self.path))
        spec.submodule_search_locations = packages
        return spec

    def exec_module(self, module):
        exec(self.code, vars(module))


def _import():
    try:
        importlib.import_module(f"{PACKAGE}.checks")
    except Exception as error:  # for any error of a module with a changed table
        raise NoProgram from error


def _imported_anew(name, path, tree, change):
    holder, key, old, new = change

    @contextmanager
    def made():
        _set(holder, key, new)
        try:
            code = compile(tree, str(path), "exec")
        except (SyntaxError, ValueError) as error:
            raise NoProgram from error
        finally:
            _set(holder, key, old)
        saved = {
            k: v for k, v in sys.modules.items() if k == PACKAGE or k.startswith(PACKAGE + ".")
        }
        finder = _Changed(name, path, code)
        sys.meta_path.insert(0, finder)
        for k in saved:
            del sys.modules[k]
        try:
            _import()
            yield
        finally:
            sys.meta_path.remove(finder)
            for k in [k for k in sys.modules if k == PACKAGE or k.startswith(PACKAGE + ".")]:
                del sys.modules[k]
            sys.modules.update(saved)
            rapidgen.rapid = saved[PACKAGE]

    return made


# -- built-ins -------------------------------------------------------------------------------

_HEADER = re.compile(r"^(?:PROC|FUNC \w+) (\w+)\(.*?\)(?:[ ]+![^\n]*)?$", re.MULTILINE | re.DOTALL)
_RECORD = re.compile(r"^RECORD (\w+)\n.*?^ENDRECORD", re.MULTILINE | re.DOTALL)
_SINGLE = re.compile(r"^(?:ALIAS \w+|(?:CONST|VAR|PERS) \w+) (\w+).*;$", re.MULTILINE)
_CLASS = re.compile(
    r"^!(?:value|nonvalue|semivalue|procedures|functions|types|values) (.*)$", re.MULTILINE
)
_WORD = re.compile(r"\w+")


def of_builtins():
    """Yield mutants of built-ins' declarations.

    Each word is changed or left out.
    """
    for path in sorted((ROOT / "builtins").glob("*.rapid")):
        text = path.read_text("utf-8")
        for pattern in (_HEADER, _RECORD, _SINGLE):
            for result in pattern.finditer(text):
                for word in _WORD.finditer(text, result.start(), result.end()):
                    yield from _of_word(path, text, result[1].lower(), word)
        for result in _CLASS.finditer(text):
            for word in _WORD.finditer(text, result.start(1), result.end()):
                yield from _of_word(path, text, word[0].lower(), word)


def _of_word(path, text, name, word):
    if word[0] in ("VAR", "PERS", "INOUT"):
        others = ("",)
    elif word[0] in ("CONST", "PROC", "FUNC", "ALIAS", "RECORD", "ENDRECORD", "since", "until"):
        return
    else:
        others = ("string" if word[0] == "num" else "num", word[0] + "x")
    for other in others:
        changed = text[: word.start()] + other + text[word.end() :]
        line = text.count("\n", 0, word.start()) + 1
        change = f"{name}: {word[0]} -> {other or 'nothing'}"
        yield Mutant(path, line, change, _read_changed(path, changed), name)


def _read_changed(path, text):
    @contextmanager
    def made():
        read = signatures._read
        signatures._read = lambda name: text if name == path.stem else read(name)
        _forget(signatures.__name__)
        try:
            yield
        finally:
            signatures._read = read
            _forget(signatures.__name__)

    return made
