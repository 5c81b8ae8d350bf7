"""Numbers and matrices."""

import math
from collections.abc import Callable
from typing import TYPE_CHECKING

from rapidgen.rapid.numbers import single, to_places
from rapidgen.runtime.errors import RapidError
from rapidgen.runtime.rawbytes import whole
from rapidgen.runtime.registry import builtin, builtins
from rapidgen.runtime.task.task import Task
from rapidgen.runtime.values import Ref, Value

if TYPE_CHECKING:
    from numpy import ndarray


# -- Numbers ---------------------------------------------------------------------------------------
#
# Numbers: rounding, powers, trigonometry in degrees, counters; num and dnum twins.
#
# Sources: the S4 reference's page of each name [manual]; argument errors: switch `argument_error`.


_LARGEST_NUM_INTEGER = 8_388_608
_SMALLEST_NUM_INTEGER = -8_388_607


def _one(name: str, function: Callable[[float], float]) -> None:
    """Bind a function of one number, as num and as dnum."""
    builtin(name, pure=True)(lambda _task, value: single(function(value)))
    builtin(name + "Dnum", pure=True)(lambda _task, value: function(value))


def _two(name: str, function: Callable[[float, float], float]) -> None:
    """Bind a function of two numbers, as num and as dnum."""
    builtin(name, pure=True)(lambda _task, one, two: single(function(one, two)))
    builtin(name + "Dnum", pure=True)(lambda _task, one, two: function(one, two))


def _square_root(value: float) -> float:
    if value < 0:
        raise RapidError("ERR_ARGVALERR", f"Sqrt({value:g})")
    return math.sqrt(value)


def _power(base: float, exponent: float) -> float:
    if (base < 0 and exponent != int(exponent)) or (base == 0 and exponent <= 0):
        raise RapidError("ERR_ARGVALERR", f"Pow({base:g}, {exponent:g})")
    return math.pow(base, exponent)


def _within_one(value: float) -> float:
    if not -1 <= value <= 1:
        raise RapidError("ERR_ARGVALERR", f"{value:g} is not within -1 to 1")
    return value


def _rounded(value: float, decimals: float | None, *, truncate: bool = False) -> float:
    """Round to a number of decimals, or truncate.

    Halves are rounded away from zero; truncation is towards zero.
    """
    places = 0 if decimals is None else whole(decimals, "ERR_ARGVALERR")
    if not 0 <= places <= 15:
        raise RapidError("ERR_ARGVALERR", f"\\Dec:={places}")
    number = to_places(value, places, truncate=truncate)
    return int(number) if places == 0 else float(number)


_one("Abs", abs)
_one("Sqrt", _square_root)
_two("Pow", _power)
_one("Sin", lambda angle: math.sin(math.radians(angle)))
_one("Cos", lambda angle: math.cos(math.radians(angle)))
_one("Tan", lambda angle: math.tan(math.radians(angle)))
_one("ASin", lambda value: math.degrees(math.asin(_within_one(value))))
_one("ACos", lambda value: math.degrees(math.acos(_within_one(value))))
_one("ATan", lambda value: math.degrees(math.atan(value)))
_two("ATan2", lambda y, x: math.degrees(math.atan2(y, x)))
_two("Round", _rounded)
_two("Trunc", lambda value, decimals: _rounded(value, decimals, truncate=True))


def _target(num: Ref | None, dnum: Ref | None) -> Ref:
    target = num if num is not None else dnum
    assert target is not None
    return target


def _increase(target: Ref, amount: float) -> None:
    target.set(target.get() + amount)


@builtin("Add")
def add(
    _task: Task,
    num: Ref | None,
    dnum: Ref | None,
    value: float | None,
    dnum_value: float | None,
) -> None:
    """Add a value."""
    target = _target(num, dnum)
    amount = value if value is not None else dnum_value
    assert amount is not None
    _increase(target, amount)


@builtin("TryInt", pure=True)
def try_int(_task: Task, num: float | None, dnum: float | None) -> None:
    """Raise ERR_INT_NOTVAL if the value is not whole."""
    value = num if num is not None else dnum
    assert value is not None
    whole(value, "ERR_INT_NOTVAL")


@builtin("DnumToNum", pure=True)
def dnum_to_num(_task: Task, value: float, integer: bool | None) -> float:
    """Return the nearest num.

    \\Integer requires a whole number that a num represents exactly.
    """
    if integer:
        number = whole(value, "ERR_INT_NOTVAL")
        if not _SMALLEST_NUM_INTEGER <= number <= _LARGEST_NUM_INTEGER:
            raise RapidError("ERR_INT_MAXVAL", f"{value:g}")
        return number
    try:
        return single(value)
    except OverflowError as error:
        raise RapidError("ERR_ARGVALERR", f"{value:g} does not fit a num") from error


# The argument is a num or a dnum.
_COUNTING: dict[str, Callable[..., Value]] = {
    "Incr": lambda _, num, dnum: _increase(_target(num, dnum), 1),
    "Decr": lambda _, num, dnum: _increase(_target(num, dnum), -1),
    "Clear": lambda _, num, dnum: _target(num, dnum).set(0),
}
builtins(_COUNTING)
_PURE: dict[str, Callable[..., Value]] = {
    "Exp": lambda _, exponent: single(math.exp(exponent)),
    "Max": lambda _, one, two: max(one, two),
    "Min": lambda _, one, two: min(one, two),
    "NumToDnum": lambda _, value: single(value),
}
builtins(_PURE, pure=True)


# -- Matrices --------------------------------------------------------------------------------------
#
# MatrixSolve, MatrixSolveQR, MatrixSVD: linear algebra in dnum.
#
# Sources: 3HAC050917 for what they compute and their arguments [manual]; the signs of a factor that
# the mathematics leave open are those of LAPACK; ERR_ARGVALERR for matrices that do not fit [mem].


_Rows = dict[int, dict[int, float]]


@builtin("MatrixSolve", cost="string")
def matrix_solve(
    _task: Task, a: _Rows, m: float | None, n: float | None, b: dict[int, float], x: Ref
) -> None:
    """Solve A * x = b, by least squares if A has more rows.

    ERR_ARGVALERR: the sizes do not match, or the columns of A are linearly dependent.
    """
    import numpy as np

    matrix = _matrix(a, m, n)
    rows, columns = matrix.shape
    if len(b) < rows or len(x.get()) < columns or rows < columns:
        raise RapidError("ERR_ARGVALERR", f"{rows} x {columns}, b{{{len(b)}}}, x{{{len(x.get())}}}")
    right = np.array([b[i] for i in range(1, rows + 1)], dtype=float)
    solved, _, rank, _ = np.linalg.lstsq(matrix, right, rcond=None)
    if rank < columns:
        raise RapidError("ERR_ARGVALERR", "the columns of A depend on each other")
    _put_vector(x, solved)


@builtin("MatrixSolveQR", cost="string")
def matrix_solve_qr(
    _task: Task, a: _Rows, m: float | None, n: float | None, q: Ref, r: Ref
) -> None:
    """Compute A = Q * R: Q (m x m) orthogonal, R (m x n) triangular."""
    import numpy as np

    left, right = np.linalg.qr(_matrix(a, m, n), mode="complete")
    _put_matrix(q, left)
    _put_matrix(r, right)


@builtin("MatrixSVD", cost="string")
def matrix_svd(
    _task: Task,
    a: _Rows,
    m: float | None,
    n: float | None,
    u: Ref,
    s: Ref,
    v: Ref,
    economy: bool | None,
) -> None:
    """Compute A = U * diag(S) * V' with falling singular values.

    \\Econ: U and V without surplus columns.
    """
    import numpy as np

    left, size, right = np.linalg.svd(_matrix(a, m, n), full_matrices=not economy)
    _put_matrix(u, left)
    _put_vector(s, size)
    _put_matrix(v, right.T)


def _matrix(a: _Rows, m: float | None, n: float | None) -> "ndarray":
    """Return the first m rows and n columns, or raise ERR_ARGVALERR."""
    import numpy as np

    rows = len(a) if m is None else int(m)
    columns = len(a[1]) if n is None else int(n)
    if not (1 <= rows <= len(a) and 1 <= columns <= len(a[1])):
        raise RapidError("ERR_ARGVALERR", f"{rows} x {columns} of {len(a)} x {len(a[1])}")
    return np.array([[a[i][j] for j in range(1, columns + 1)] for i in range(1, rows + 1)])


def _put_matrix(target: Ref, result: "ndarray") -> None:
    saved: Value = target.get()
    rows, columns = result.shape
    if len(saved) < rows or len(saved[1]) < columns:
        raise RapidError("ERR_ARGVALERR", f"{target.name} is smaller than {rows} x {columns}")
    for i in range(rows):
        for j in range(columns):
            saved[i + 1][j + 1] = float(result[i, j])


def _put_vector(target: Ref, result: "ndarray") -> None:
    saved: Value = target.get()
    if len(saved) < len(result):
        raise RapidError("ERR_ARGVALERR", f"{target.name} has less than {len(result)} elements")
    for i, value in enumerate(result, start=1):
        saved[i] = float(value)
