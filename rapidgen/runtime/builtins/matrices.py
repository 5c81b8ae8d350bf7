"""MatrixSolve, MatrixSolveQR, MatrixSVD: linear algebra in dnum.

Sources: 3HAC050917 for what they compute and their arguments [manual]; the signs of a factor that
the mathematics leave open are those of LAPACK; ERR_ARGVALERR for matrices that do not fit [mem].
"""

from typing import TYPE_CHECKING

from rapidgen.runtime.errors import RapidError
from rapidgen.runtime.registry import builtin
from rapidgen.runtime.task.task import Task
from rapidgen.runtime.values import Ref, Value

if TYPE_CHECKING:
    from numpy import ndarray

_Rows = dict[int, dict[int, float]]


@builtin("MatrixSolve", cost="string")
def matrix_solve(
    _task: Task, a: _Rows, m: float | None, n: float | None, b: dict[int, float], x: Ref
) -> None:
    """A * x = b: exactly for a square A, by least squares for one with more rows.

    ERR_ARGVALERR: sizes do not fit, or the columns of A depend on each other.
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
    """A = Q * R with Q (m x m) orthogonal and R (m x n) upper triangular."""
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
    """A = U * diag(S) * V'; the singular values fall. \\Econ: U and V without surplus columns."""
    import numpy as np

    left, size, right = np.linalg.svd(_matrix(a, m, n), full_matrices=not economy)
    _put_matrix(u, left)
    _put_vector(s, size)
    _put_matrix(v, right.T)


def _matrix(a: _Rows, m: float | None, n: float | None) -> "ndarray":
    """The first m rows and n columns. ERR_ARGVALERR: there are not so many."""
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
