"""Run xacro without access to code, other files and long runs.

Private names of xacro are replaced while it runs, because it has no hooks for this. A test and the
pin `xacro>=2.1.1,<3` check the names. Neither xacro nor this module is thread-safe.

A description can compute (`expressions.py`), call macros, and read files below the folders of
`Packages.allows`. It cannot read environment variables, and it ends within some seconds.
"""

import glob
import keyword
import re
import types
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from typing import TypeVar
from xml.dom import minidom

from rapidgen.config.urdf.expressions import (
    MAX_TEXT,
    Allowance,
    ExpressionError,
    Expressions,
    size_of,
)

MAX_CALLS = 50_000
"""Calls of macros in one description."""
MAX_FILES = 1_000
"""Files that one pattern of an include may name."""
MAX_YAML_BYTES = 1_000_000
_LONGEST_NUMBER = 400
_Made = TypeVar("_Made")
# As in xacro, but each character can be matched in one way only: unbalanced quotes make xacro's own
# pattern try exponentially many.
_MACRO_PARAMETER = re.compile(
    r"""^\s*([^\s:=]+?)\s*:?=\s*(\^\|?)?"""
    r"""((?:\$\{[^}]*\}|\$\([^)]*\)|'[^']*'|"[^"]*"|\$(?![{(])|[^\s'"$])+|)(?:\s+|$)(.*)"""
)


@contextmanager
def restricted(
    find: Callable[[str], str],
    read: Callable[[Path], str],
    allowed: Callable[[Path], bool],
    handle_unknown: Callable[[minidom.Element], bool],
) -> Iterator[None]:
    """Run xacro with limits.

    `find` returns the folder of a package, `read` the text of a file, and `allowed` is True for a
    file that may be read. `handle_unknown` gets the call of an unknown macro and returns True if
    it has dealt with it. The names of xacro are restored when the context ends.
    """
    import xacro
    from xacro import substitution_args

    allowance = Allowance()
    calls = 0

    def load_yaml(name: str) -> object:
        path = _file(xacro.abs_filename_spec(name), allowed)
        text = read(path)
        if len(text) > MAX_YAML_BYTES:
            raise ExpressionError(f"{path.name} is larger than {MAX_YAML_BYTES:,} characters")
        import yaml

        class Loader(yaml.SafeLoader):  # type: ignore[misc]
            """A loader without numbers that take long to convert, as `1:1:1:...` does."""

            def construct_scalar(self, node: yaml.ScalarNode) -> str:
                if node.tag.endswith((":int", ":float")) and len(node.value) > _LONGEST_NUMBER:
                    raise ExpressionError(f"{path.name} has a number of too many digits")
                scalar: str = super().construct_scalar(node)
                return scalar

        for unit in xacro.ConstructUnits:
            Loader.add_constructor(unit.value.tag, unit.constructor)
        try:
            return xacro.YamlListWrapper.wrap(allowance.take(yaml.load(text, Loader=Loader)))
        except yaml.YAMLError as fault:
            place = getattr(fault, "problem_mark", None)
            line = f" in line {place.line + 1}" if place else ""
            raise ExpressionError(f"{path.name} is not YAML{line}") from None

    def argument(name: str) -> object:
        return xacro.substitution_args_context["arg"][name]

    def fatal(*words: object) -> None:
        raise ExpressionError(" ".join(map(str, words)))

    # Messages of a description are not shown: their content is not trusted.
    functions: dict[str, object] = {
        "abs_filename": xacro.abs_filename_spec,
        "arg": argument,
        "dotify": xacro.YamlDictWrapper,
        "error": lambda *_, **__: "",
        "fatal": fatal,
        "load_yaml": load_yaml,
        "message": lambda *_, **__: "",
        "print_location": lambda *_, **__: "",
        "tokenize": lambda text, sep=",; ", skip_empty=True: [
            part for part in re.split(f"[{re.escape(sep)}]", text) if part or not skip_empty
        ],
        "warning": lambda *_, **__: "",
    }
    expressions = Expressions(functions, allowance)

    def evaluate(text: str, symbols: object, local: object = None) -> object:
        return expressions.evaluate(text, _Names(symbols, xacro._global_symbols))

    def evaluate_argument(text: str, context: dict[str, dict[str, str]]) -> str:
        arguments = context.setdefault("arg", {})
        names = {n: substitution_args.convert_value(v, "auto") for n, v in arguments.items()}
        rules = Expressions(
            {"arg": names.__getitem__, "find": find, "dirname": lambda: _folder(context)}, allowance
        )
        return str(rules.evaluate(text, names))

    def _folder(context: Mapping[str, object]) -> str:
        return str(Path(str(context.get("filename") or xacro.filestack[-1])).absolute().parent)

    def no_environment(name: str, *_: object, **__: object) -> str:
        raise ExpressionError(
            f"the environment variable {name} is not available to a description: "
            "use an argument of xacro"
        )

    def optional_environment(name: str, default: str = "") -> str:
        return default

    def eval_text(text: object, symbols: object) -> object:
        allowance.spend()
        if isinstance(text, str) and len(text) > MAX_TEXT and "$" in text:
            raise ExpressionError(f"a text with expressions is longer than {MAX_TEXT:,} characters")
        value = original["eval_text"](text, symbols)
        size_of(value)
        return value

    def handle_macro_call(node: minidom.Element, *tables: object) -> object:
        nonlocal calls
        calls += 1
        if calls > MAX_CALLS:
            raise ExpressionError(f"it calls more than {MAX_CALLS:,} macros")
        allowance.spend()
        name: str = node.tagName
        if name.startswith("xacro:") and name != "xacro:call":
            try:
                xacro.resolve_macro(name.removeprefix("xacro:"), *tables)
            except KeyError:
                if handle_unknown(node):
                    return True
        return original["handle_macro_call"](node, *tables)

    def list_files(pattern: str) -> list[str]:
        fixed = re.split(r"[*?\[]", pattern)[0]
        if not allowed(Path(fixed).parent if not fixed.endswith("/") else Path(fixed)):
            raise ExpressionError(_outside(pattern))
        names = []
        for name in glob.iglob(pattern):
            names.append(name)
            allowance.spend()
            if len(names) > MAX_FILES:
                raise ExpressionError(f"'{pattern}' names more than {MAX_FILES:,} files")
        return names

    replaced: dict[types.ModuleType, dict[str, object]] = {
        xacro: {
            "safe_eval": evaluate,
            "eval_text": eval_text,
            "handle_macro_call": handle_macro_call,
            "is_valid_name": lambda name: name.isidentifier() and not keyword.iskeyword(name),
            "re_macro_arg": _MACRO_PARAMETER,
            "glob": types.SimpleNamespace(glob=list_files),
        },
        substitution_args: {
            "_eval": evaluate_argument,
            "_eval_env": no_environment,
            "_eval_optenv": optional_environment,
            "_eval_find": find,
        },
    }
    original = {name: getattr(xacro, name) for name in replaced[xacro]}
    before = [
        (module, name, getattr(module, name)) for module, new in replaced.items() for name in new
    ]
    for module, new in replaced.items():
        for name, value in new.items():
            setattr(module, name, value)
    try:
        yield
    finally:
        for module, name, value in before:
            setattr(module, name, value)


class _Names(Mapping[str, object]):
    """The properties of a description, without xacro's common functions."""

    def __init__(self, symbols: object, functions: Mapping[str, object]) -> None:
        self._symbols, self._functions = symbols, functions

    def __getitem__(self, name: str) -> object:
        value = self._symbols[name]  # type: ignore[index]
        if name in self._functions and value is self._functions[name]:
            raise KeyError(name)
        return value

    def __contains__(self, name: object) -> bool:
        symbols = self._symbols
        while symbols is not self._functions and isinstance(symbols, dict):
            if dict.__contains__(symbols, name):
                return True
            symbols = getattr(symbols, "parent", None)
        return False

    def __iter__(self) -> Iterator[str]:
        return iter(())

    def __len__(self) -> int:
        return 0


def _file(name: str, allowed: Callable[[Path], bool]) -> Path:
    path = Path(name)
    if not allowed(path):
        raise ExpressionError(_outside(name))
    return path


def _outside(name: str) -> str:
    return f"'{name}' is outside the folders of the description and its packages"
