"""Evaluate expressions of xacro by an allow-list on the syntax tree.

xacro evaluates `${...}` and `$(eval ...)` with Python's `eval`, from which any code can be reached.
This module interprets the expression instead. It knows plain data, operators, subscripts,
conditional expressions, comprehensions, xacro's own functions and those of `math`. Anything else is
an error. Attribute access is limited to keys of dictionaries, namespaces, and the few methods of
text and dictionaries that are listed below.

The size of every value is limited when it is made. Functions whose cost grows faster than their
arguments have limits of their own, so no step of an expression takes long. An `Allowance` limits
the CPU time and the number of items made of all expressions of one description together.
"""

import ast
import math
import operator
import re
import time
from collections.abc import Callable, Iterable, Iterator, Mapping
from typing import TypeAlias, cast

MAX_EXPRESSION = 5_000
"""Characters of one expression."""
MAX_TEXT = 100_000
"""Characters of a text that an expression makes, or that contains expressions."""
MAX_ITEMS = 100_000
"""Items of a list or dictionary, those inside its items included."""
MAX_BITS = 4_096
"""Bits of a whole number."""
MAX_SECONDS = 4.0
"""s of CPU time for one description."""
MAX_MADE = 5_000_000
"""Items and characters that all expressions of one description may make."""
MAX_DIGITS = 400
"""Places to which a number is rounded: a float has no more."""

Data: TypeAlias = object
Function: TypeAlias = Callable[..., Data]


class ExpressionError(ValueError):
    """An expression that is not allowed, or whose result is too large."""


class Allowance:
    """CPU time (s) and items that one description may use."""

    def __init__(self, seconds: float = MAX_SECONDS, items: int = MAX_MADE) -> None:
        self._end, self._items = time.thread_time() + seconds, items

    def spend(self, items: int = 0) -> None:
        """Take items from what is left.

        Raises ExpressionError if time or items are used up.
        """
        self._items -= items
        if self._items < 0:
            raise ExpressionError("its expressions make too many items")
        if time.thread_time() > self._end:
            raise ExpressionError("it takes too long to expand")

    def take(self, value: Data) -> Data:
        """Return a value that was made, whose size is allowed.

        Raises ExpressionError.
        """
        self.spend(size_of(value))
        return value


def size_of(value: Data) -> int:
    """Return the items and characters of a value.

    Raises ExpressionError if there are too many.
    """
    if isinstance(value, int):
        _limit_bits(value.bit_length())
    elif isinstance(value, str):
        if len(value) > MAX_TEXT:
            raise ExpressionError("a text of the expression is too long")
        return len(value)
    elif isinstance(value, list | tuple | set | frozenset | dict):
        return MAX_ITEMS - _count(value, MAX_ITEMS)
    return 1


def _count(value: Data, left: int) -> int:
    """Return how many of `left` items remain after those of a value, nested ones included."""
    pending = [value]
    while pending:
        item = pending.pop()
        left -= len(item) if isinstance(item, str) else 1
        if left < 0:
            raise ExpressionError("a list or dictionary of the expression is too large")
        if isinstance(item, dict):
            pending.extend(item.keys())
            pending.extend(dict.values(item))
        elif isinstance(item, list | tuple | set | frozenset):
            pending.extend(list.__iter__(item) if isinstance(item, list) else item)
    return left


def _power(base: Data, exponent: Data) -> Data:
    if isinstance(base, int) and isinstance(exponent, int) and exponent > 0:
        _limit_bits(base.bit_length() * exponent)
    return operator.pow(base, exponent)


def _shift(value: Data, places: Data) -> Data:
    if isinstance(value, int) and isinstance(places, int):
        _limit_bits(value.bit_length() + places)
    return operator.lshift(value, places)


def _limit_bits(bits: int) -> None:
    if bits > MAX_BITS:
        raise ExpressionError("a number of the expression is too large")


def _multiply(left: Data, right: Data) -> Data:
    for sequence, times in ((left, right), (right, left)):
        if (
            isinstance(sequence, str | list | tuple)
            and isinstance(times, int)
            and len(sequence) * times > MAX_TEXT
        ):
            raise ExpressionError("a text or list of the expression is too long")
    return operator.mul(left, right)


def _remainder(left: Data, right: Data) -> Data:
    if isinstance(left, str):
        _check_format(left)
        # Each field of the format may produce the whole value.
        if left.count("%") * size_of(right) > MAX_TEXT and not isinstance(right, tuple):
            raise ExpressionError("a text of the expression is too long")
    return operator.mod(left, right)


def _check_format(text: str) -> None:
    """Check the widths of a format; three digits are enough for any robot.

    A width takes memory.
    """
    if re.search(r"%[^a-zA-Z%]*(\*|\d{4})", text):
        raise ExpressionError("a format of the expression is too wide")


_BINARY: dict[type[ast.operator], Function] = {
    ast.Add: operator.add,
    ast.Sub: operator.sub,
    ast.Mult: _multiply,
    ast.Div: operator.truediv,
    ast.FloorDiv: operator.floordiv,
    ast.Mod: _remainder,
    ast.Pow: _power,
    ast.LShift: _shift,
    ast.RShift: operator.rshift,
    ast.BitAnd: operator.and_,
    ast.BitOr: operator.or_,
    ast.BitXor: operator.xor,
}
_UNARY: dict[type[ast.unaryop], Function] = {
    ast.UAdd: operator.pos,
    ast.USub: operator.neg,
    ast.Not: operator.not_,
    ast.Invert: operator.invert,
}
_COMPARISONS: dict[type[ast.cmpop], Function] = {
    ast.Eq: operator.eq,
    ast.NotEq: operator.ne,
    ast.Lt: operator.lt,
    ast.LtE: operator.le,
    ast.Gt: operator.gt,
    ast.GtE: operator.ge,
    ast.Is: operator.is_,
    ast.IsNot: operator.is_not,
    ast.In: lambda item, of: item in of,
    ast.NotIn: lambda item, of: item not in of,
}


def _range(*arguments: int) -> list[int]:
    numbers = range(*arguments)
    if len(numbers) > MAX_ITEMS:
        raise ExpressionError("a range of the expression is too long")
    return list(numbers)


def _int(value: Data = 0, base: Data = None) -> int:
    # Older Pythons convert long texts in quadratic time.
    if isinstance(value, str) and len(value) > MAX_BITS:
        raise ExpressionError("a number of the expression is too large")
    return int(value) if base is None else int(value, base)  # type: ignore[call-overload,no-any-return]


def _small(function: Function, largest: int) -> Function:
    def limited(*numbers: int) -> Data:
        if any(number > largest for number in numbers):
            raise ExpressionError("a number of the expression is too large")
        return function(*numbers)

    return limited


def _round(number: Data, digits: Data = None) -> Data:
    if isinstance(digits, int) and abs(digits) > MAX_DIGITS:
        raise ExpressionError("a number is rounded to too many places")
    return round(cast(float, number), cast(int | None, digits))


def _sum(items: Iterable[Data], start: Data = 0) -> Data:
    # Python would copy lists once for each of them.
    if not isinstance(start, int | float):
        raise ExpressionError("'sum' takes numbers")
    return sum(cast(Iterable[float], items), start)


def _product(function: Function) -> Function:
    """Return a function that limits the bits of its result.

    The result may have the bits of all its arguments together.
    """

    def limited(*arguments: Data, **named: Data) -> Data:
        numbers = [*arguments, *named.values()]
        for value in arguments:
            if isinstance(value, list | tuple | set | frozenset):
                numbers.extend(value)
        _limit_bits(sum(n.bit_length() for n in numbers if isinstance(n, int)))
        return function(*arguments, **named)

    return limited


def _listed(function: Callable[..., Iterable[Data]]) -> Function:
    """Return a function with a list as result: lists have a size."""
    return lambda *arguments: list(function(*arguments))


_MATH: dict[str, Data] = {
    name: value for name, value in vars(math).items() if not name.startswith("_")
}
_MATH |= {
    "factorial": _small(math.factorial, 300),
    "comb": _small(math.comb, 1_000),
    "lcm": _product(math.lcm),
    "perm": _small(math.perm, 300),
    "prod": _product(math.prod),
}
_PYTHON: dict[str, Data] = {
    "abs": abs,
    "all": all,
    "any": any,
    "bool": bool,
    "dict": dict,
    "divmod": divmod,
    "enumerate": _listed(enumerate),
    "float": float,
    "int": _int,
    "len": len,
    "list": list,
    "max": max,
    "min": min,
    "range": _range,
    "reversed": _listed(reversed),
    "round": _round,
    "set": set,
    "sorted": sorted,
    "str": str,
    "sum": _sum,
    "tuple": tuple,
    "zip": _listed(zip),
    "True": True,
    "False": False,
}
PLAIN: dict[str, Data] = {**_MATH, **_PYTHON, "true": True, "false": False}
"""Names without a namespace."""
NAMESPACES: dict[str, Mapping[str, Data]] = {"math": _MATH, "python": _PYTHON}

_TEXT_METHODS = frozenset(
    {
        "capitalize",
        "count",
        "endswith",
        "find",
        "index",
        "isalnum",
        "isalpha",
        "isdigit",
        "islower",
        "isupper",
        "join",
        "lower",
        "lstrip",
        "replace",
        "rfind",
        "rsplit",
        "rstrip",
        "split",
        "splitlines",
        "startswith",
        "strip",
        "title",
        "upper",
    }
)
_LIST_METHODS = frozenset({"count", "index"})
_DICT_METHODS = frozenset({"get", "items", "keys", "values"})


class Expressions:
    """Evaluates expressions whose names a function looks up."""

    def __init__(self, functions: Mapping[str, Data], allowance: Allowance) -> None:
        """Create an evaluator with `functions` of xacro.

        They are available by plain name, and as the namespace `xacro`.
        """
        own: dict[str, Data] = {"map": self._map, "filter": self._filter}
        self._plain = {**PLAIN, **own, **functions}
        python = {**NAMESPACES["python"], **own}
        self._namespaces: dict[str, Mapping[str, Data]] = {
            **NAMESPACES,
            "python": python,
            "xacro": functions,
        }
        self._functions = frozenset(
            id(value)
            for names in (self._plain, *self._namespaces.values())
            for value in names.values()
            if callable(value)
        )
        self._allowance = allowance

    def evaluate(self, text: str, names: Mapping[str, Data]) -> Data:
        """Return the value of an expression.

        `names` are the properties and arguments; they hide functions of the same name. Raises
        ExpressionError, SyntaxError, NameError, and what operators and functions raise.
        """
        text = text.strip()
        if len(text) > MAX_EXPRESSION:
            raise ExpressionError(f"an expression is longer than {MAX_EXPRESSION:,} characters")
        try:
            tree = ast.parse(text, "<expression>", "eval")
        except MemoryError:
            raise SyntaxError("the expression nests too deep") from None
        return _Evaluation(self, names, {}).value(tree.body)

    def _map(self, function: Function, *lists: Iterable[Data]) -> list[Data]:
        """Return a list; each item is charged to the allowance when made."""
        return [self._allowance.take(function(*items)) for items in zip(*lists, strict=False)]

    def _filter(self, function: Function | None, items: Iterable[Data]) -> list[Data]:
        chosen = []
        for item in items:
            self._allowance.spend(1)
            if item if function is None else function(item):
                chosen.append(item)
        return chosen

    def _name(self, name: str, names: Mapping[str, Data]) -> Data:
        if name.startswith("__"):
            raise ExpressionError(f"the name '{name}' is not allowed")
        if name in names:
            return names[name]
        if name in self._namespaces:
            return self._namespaces[name]
        if name in self._plain:
            return self._plain[name]
        raise NameError(f"name '{name}' is not defined")


class _Evaluation:
    """One expression with the variables of its comprehensions."""

    def __init__(
        self, rules: Expressions, names: Mapping[str, Data], variables: dict[str, Data]
    ) -> None:
        self._rules, self._names, self._variables = rules, names, variables

    def value(self, node: ast.expr) -> Data:
        """Return the value of a part."""
        allowance = self._rules._allowance
        # The value of a name or a key was counted when it was made.
        if isinstance(node, ast.Name | ast.Attribute | ast.Constant):
            allowance.spend()
            return self._value(node)
        return allowance.take(self._value(node))

    def _value(self, node: ast.expr) -> Data:
        match node:
            case ast.Constant(value=bool() | int() | float() | str() | None):
                return node.value
            case ast.Name():
                if node.id in self._variables:
                    return self._variables[node.id]
                return self._rules._name(node.id, self._names)
            case ast.UnaryOp():
                return _UNARY[type(node.op)](self.value(node.operand))
            case ast.BinOp() if type(node.op) in _BINARY:
                return _BINARY[type(node.op)](self.value(node.left), self.value(node.right))
            case ast.BoolOp():
                return self._boolean(node)
            case ast.Compare():
                return self._comparison(node)
            case ast.IfExp():
                return self.value(node.body if self.value(node.test) else node.orelse)
            case ast.List():
                return [self.value(item) for item in node.elts]
            case ast.Tuple():
                return tuple(self.value(item) for item in node.elts)
            case ast.Set():
                return {self.value(item) for item in node.elts}
            case ast.Dict():
                return self._dictionary(node)
            case ast.ListComp() | ast.GeneratorExp() | ast.SetComp():
                items = [inner.value(node.elt) for inner in self._passes(node.generators)]
                return set(items) if isinstance(node, ast.SetComp) else items
            case ast.DictComp():
                passes = self._passes(node.generators)
                return {inner.value(node.key): inner.value(node.value) for inner in passes}
            case ast.Subscript():
                return self._subscript(node)
            case ast.Attribute():
                return self._attribute(node)
            case ast.Call():
                return self._call(node)
        raise ExpressionError(f"'{ast.unparse(node)[:60]}' is not allowed in an expression")

    def _boolean(self, node: ast.BoolOp) -> Data:
        value: Data = None
        for part in node.values:
            value = self.value(part)
            if bool(value) is isinstance(node.op, ast.Or):
                break
        return value

    def _comparison(self, node: ast.Compare) -> bool:
        left = self.value(node.left)
        for sign, part in zip(node.ops, node.comparators, strict=True):
            right = self.value(part)
            if not _COMPARISONS[type(sign)](left, right):
                return False
            left = right
        return True

    def _dictionary(self, node: ast.Dict) -> dict[Data, Data]:
        made: dict[Data, Data] = {}
        for key, item in zip(node.keys, node.values, strict=True):
            if key is None:
                raise ExpressionError("'**' is not allowed in an expression")
            made[self.value(key)] = self.value(item)
        return made

    def _passes(self, generators: list[ast.comprehension]) -> Iterator["_Evaluation"]:
        """Yield an evaluation with the variables of each pass of a comprehension."""
        first, *others = generators
        items = self.value(first.iter)
        if first.is_async or not isinstance(items, str | list | tuple | set | frozenset | dict):
            raise ExpressionError("a comprehension takes a list, text or dictionary")
        for number, item in enumerate(list(items)):
            if number >= MAX_ITEMS:
                raise ExpressionError("a list of the expression is too long")
            inner = _Evaluation(self._rules, self._names, dict(self._variables))
            inner._bind(first.target, item)
            if all(inner.value(condition) for condition in first.ifs):
                yield from inner._passes(others) if others else [inner]

    def _bind(self, target: ast.expr, item: Data) -> None:
        if isinstance(target, ast.Name):
            self._variables[target.id] = item
        elif isinstance(target, ast.Tuple) and isinstance(item, list | tuple):
            for part, value in zip(target.elts, item, strict=True):
                self._bind(part, value)
        else:
            raise ExpressionError("a comprehension assigns to names only")

    def _subscript(self, node: ast.Subscript) -> Data:
        of = self.value(node.value)
        if not isinstance(of, str | list | tuple | dict):
            raise ExpressionError(f"'{ast.unparse(node.value)[:60]}' has no items")
        if isinstance(node.slice, ast.Slice):
            parts = (node.slice.lower, node.slice.upper, node.slice.step)
            place: Data = slice(*(None if part is None else self.value(part) for part in parts))
        else:
            place = self.value(node.slice)
        return of[place]  # type: ignore[call-overload,index]

    def _attribute(self, node: ast.Attribute) -> Data:
        name, of = node.attr, self.value(node.value)
        if name.startswith("_"):
            raise ExpressionError(f"the name '{name}' is not allowed")
        # A key of a dictionary, a function of a namespace, a property of an included file.
        if isinstance(of, Mapping):
            if name in of:
                return of[name]
            if isinstance(of, dict) and name in _DICT_METHODS:
                return _Method(lambda *given: _of_dictionary(of, name, *given))
            raise NameError(f"name '{name}' is not defined")
        if isinstance(of, str) and name in _TEXT_METHODS:
            return _Method(lambda *given: _of_text(of, name, *given))
        if isinstance(of, list | tuple) and name in _LIST_METHODS:
            return _Method(getattr(of, name))
        raise ExpressionError(f"'{ast.unparse(node)[:60]}' is not allowed in an expression")

    def _call(self, node: ast.Call) -> Data:
        called = self.value(node.func)
        if not isinstance(called, _Method) and id(called) not in self._rules._functions:
            raise ExpressionError(f"'{ast.unparse(node.func)[:60]}' is not a function")
        arguments: list[Data] = []
        for part in node.args:
            if isinstance(part, ast.Starred):
                items = self.value(part.value)
                if not isinstance(items, list | tuple):
                    raise ExpressionError("'*' takes a list")
                arguments.extend(items)
            else:
                arguments.append(self.value(part))
        named: dict[str, Data] = {}
        for keyword in node.keywords:
            if keyword.arg is None or keyword.arg == "key":
                raise ExpressionError("an argument of a function is not allowed")
            named[keyword.arg] = self.value(keyword.value)
        function = called.function if isinstance(called, _Method) else called
        assert callable(function)
        return function(*arguments, **named)


class _Method:
    """A method of text, list or dictionary that can only be called."""

    def __init__(self, function: Function) -> None:
        self.function = function


def _of_text(text: str, name: str, *value: Data) -> Data:
    """Call a method of a text whose result is not too long."""
    if name == "replace" and isinstance(value[0], str) and isinstance(value[1], str):
        if len(text) + text.count(value[0]) * len(value[1]) > MAX_TEXT:
            raise ExpressionError("a text of the expression is too long")
    elif name == "join":
        items = value[0] if value else ()
        if not isinstance(items, list | tuple):
            raise ExpressionError("'join' takes a list")
        if len(text) * len(items) > MAX_TEXT:
            raise ExpressionError("a text of the expression is too long")
    method: Function = getattr(text, name)
    return method(*value)


def _of_dictionary(of: dict[Data, Data], name: str, *value: Data) -> Data:
    if name == "get":
        return of[value[0]] if value[0] in of else value[1] if len(value) > 1 else None
    if name == "keys":
        return list(of)
    return [of[key] if name == "values" else (key, of[key]) for key in of]
