"""Compiled RAPID against hand-written Python: nine kernels, ratios.

    python benchmarks/kernels.py [--rounds N]

Columns: no clock (no interrupts possible), block accounting (the default), statement accounting
(trace, replay). Limits: geometric mean 2.2, 3 and 4; no kernel over 6.
"""

import argparse
import gc
import math
import time
from collections.abc import Callable

from rapidgen.controller.controller import VirtualController
from rapidgen.system.model import ModuleFile, System, TaskSpec

RAPID = """
MODULE kernels
  RECORD inner
    num a;
    num b;
  ENDRECORD
  RECORD outer
    inner i;
    pos p;
    num n;
  ENDRECORD
  PROC main()
  ENDPROC

  FUNC num loop()
    VAR num i := 0;
    VAR num s := 0;
    WHILE i < 200000 DO
      i := i + 1;
      IF i MOD 3 = 0 s := s + 1;
    ENDWHILE
    RETURN s;
  ENDFUNC

  FUNC num recurrence()
    VAR num x := 0.4;
    FOR i FROM 1 TO 200000 DO
      x := 3.7 * x * (1 - x);
    ENDFOR
    RETURN x;
  ENDFUNC

  FUNC num sieve()
    VAR bool composite{20000};
    VAR num count := 0;
    VAR num j;
    FOR i FROM 2 TO 20000 DO
      IF NOT composite{i} THEN
        count := count + 1;
        j := i + i;
        WHILE j <= 20000 DO
          composite{j} := TRUE;
          j := j + i;
        ENDWHILE
      ENDIF
    ENDFOR
    RETURN count;
  ENDFUNC

  FUNC num bubble()
    VAR num a{150};
    VAR num t;
    FOR i FROM 1 TO 150 DO
      a{i} := (i * 7919) MOD 1009;
    ENDFOR
    FOR i FROM 1 TO 149 DO
      FOR j FROM 1 TO 150 - i DO
        IF a{j} > a{j+1} THEN
          t := a{j};
          a{j} := a{j+1};
          a{j+1} := t;
        ENDIF
      ENDFOR
    ENDFOR
    RETURN a{75};
  ENDFUNC

  FUNC num matrix()
    VAR num a{20,20};
    VAR num b{20,20};
    VAR num c{20,20};
    VAR num s;
    FOR i FROM 1 TO 20 DO
      FOR j FROM 1 TO 20 DO
        a{i,j} := i / j;
        b{i,j} := j - i;
      ENDFOR
    ENDFOR
    FOR i FROM 1 TO 20 DO
      FOR j FROM 1 TO 20 DO
        s := 0;
        FOR k FROM 1 TO 20 DO
          s := s + a{i,k} * b{k,j};
        ENDFOR
        c{i,j} := s;
      ENDFOR
    ENDFOR
    RETURN c{20,20};
  ENDFUNC

  FUNC num records()
    VAR outer o;
    VAR outer q;
    FOR i FROM 1 TO 20000 DO
      o.i.a := o.i.a + 1;
      o.i.b := o.i.a * 0.5;
      o.p.x := o.i.b - o.p.y;
      o.p.y := o.n;
      q := o;
      o.n := q.i.a - q.p.x;
    ENDFOR
    RETURN o.n;
  ENDFUNC

  FUNC num fib(num n)
    IF n < 2 RETURN n;
    RETURN fib(n - 1) + fib(n - 2);
  ENDFUNC

  FUNC num calls()
    RETURN fib(21);
  ENDFUNC

  FUNC num words()
    VAR string text := "alpha beta gamma delta epsilon zeta eta theta iota kappa lambda mu nu xi";
    VAR string word;
    VAR num from_;
    VAR num to_;
    VAR num total := 0;
    FOR i FROM 1 TO 800 DO
      from_ := 1;
      WHILE from_ <= StrLen(text) DO
        to_ := StrFind(text, from_, " ");
        word := StrPart(text, from_, to_ - from_);
        total := total + StrLen(word);
        from_ := to_ + 1;
      ENDWHILE
    ENDFOR
    RETURN total;
  ENDFUNC

  FUNC num half(num d)
    VAR num r := -1;
    r := 10 / d;
    RETURN r;
  ERROR
    TRYNEXT;
  ENDFUNC

  FUNC num division()
    VAR num total := 0;
    FOR i FROM 1 TO 30000 DO
      total := total + half(i MOD 10);
    ENDFOR
    RETURN total;
  ENDFUNC
ENDMODULE
"""


class Inner:
    __slots__ = ("a", "b")

    def __init__(self, a=0.0, b=0.0):
        self.a, self.b = a, b


class Pos:
    __slots__ = ("x", "y", "z")

    def __init__(self, x=0.0, y=0.0, z=0.0):
        self.x, self.y, self.z = x, y, z


class Outer:
    __slots__ = ("i", "n", "p")

    def __init__(self, i, p, n):
        self.i, self.p, self.n = i, p, n

    def copy(self):
        i, p = self.i, self.p
        return Outer(Inner(i.a, i.b), Pos(p.x, p.y, p.z), self.n)


def loop():
    i = s = 0
    while i < 200000:
        i += 1
        if i % 3 == 0:
            s += 1
    return s


def recurrence():
    x = 0.4
    for _ in range(200000):
        x = 3.7 * x * (1 - x)
    return x


def sieve():
    composite = [False] * 20001
    count = 0
    for i in range(2, 20001):
        if not composite[i]:
            count += 1
            j = i + i
            while j <= 20000:
                composite[j] = True
                j += i
    return count


def bubble():
    a = [(i * 7919) % 1009 for i in range(1, 151)]
    for i in range(1, 150):
        for j in range(150 - i):
            if a[j] > a[j + 1]:
                a[j], a[j + 1] = a[j + 1], a[j]
    return a[74]


def matrix():
    n = 20
    a = [[(i + 1) / (j + 1) for j in range(n)] for i in range(n)]
    b = [[j - i for j in range(n)] for i in range(n)]
    c = [[0.0] * n for _ in range(n)]
    for i in range(n):
        for j in range(n):
            s = 0.0
            for k in range(n):
                s += a[i][k] * b[k][j]
            c[i][j] = s
    return c[19][19]


def records():
    o = Outer(Inner(), Pos(), 0.0)
    for _ in range(20000):
        o.i.a += 1
        o.i.b = o.i.a * 0.5
        o.p.x = o.i.b - o.p.y
        o.p.y = o.n
        q = o.copy()
        o.n = q.i.a - q.p.x
    return o.n


def fib(n):
    if n < 2:
        return n
    return fib(n - 1) + fib(n - 2)


def calls():
    return fib(21)


def words():
    text = "alpha beta gamma delta epsilon zeta eta theta iota kappa lambda mu nu xi"
    total = 0
    for _ in range(800):
        start = 0
        while start < len(text):
            end = text.find(" ", start)
            if end < 0:
                end = len(text)
            word = text[start:end]
            total += len(word)
            start = end + 1
    return total


def half(d):
    r = -1.0
    try:
        r = 10 / d
    except ZeroDivisionError:
        return r
    return r


def division():
    total = 0.0
    for i in range(1, 30001):
        total += half(i % 10)
    return total


KERNELS = (loop, recurrence, sieve, bubble, matrix, records, calls, words, division)
LIMITS = {"none": 2.2, "block": 3.0, "statement": 4.0}


def _controller(accounting: str) -> VirtualController:
    module = ModuleFile("kernels", "kernels.mod", RAPID.encode())
    task = TaskSpec("T_ROB1", modules=(module,))
    return VirtualController(
        System("kernels", (task,)), accounting=accounting, autostart=False, cycle="once"
    )


def _ratio(rapid: Callable[[], object], python: Callable[[], object], rounds: int) -> float:
    """Return the ratio of the best processor times, measured in turn."""
    best = [math.inf, math.inf]
    for _ in range(rounds):
        for i, function in enumerate((rapid, python)):
            start = time.process_time()
            function()
            best[i] = min(best[i], time.process_time() - start)
    return best[0] / best[1]


def measure(rounds: int) -> dict[str, dict[str, float]]:
    """Return ratios of RAPID to Python by accounting and kernel."""
    results: dict[str, dict[str, float]] = {}
    gc.disable()
    for accounting in LIMITS:
        results[accounting] = {}
        with _controller(accounting) as controller:
            task = controller.rapid_tasks["T_ROB1"]

            def body(task=task, results=results[accounting]):
                for kernel in KERNELS:
                    name = kernel.__name__
                    value, expected = task.call(name), kernel()
                    if not math.isclose(value, expected, rel_tol=0.5, abs_tol=1.0):
                        raise SystemExit(f"{name}: {value} is not {expected}")
                    results[name] = _ratio(lambda name=name: task.call(name), kernel, rounds)

            task.launch(body)
            controller.scheduler.advance()
    gc.enable()
    return results


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--rounds", type=int, default=9)
    rounds = parser.parse_args().rounds
    results = measure(rounds)
    print(f"{'kernel':<12}" + "".join(f"{name:>12}" for name in LIMITS))
    for kernel in KERNELS:
        row = [results[a][kernel.__name__] for a in LIMITS]
        print(f"{kernel.__name__:<12}" + "".join(f"{value:12.2f}" for value in row))
    bad = False
    means = []
    for accounting, limit in LIMITS.items():
        values = list(results[accounting].values())
        mean = math.exp(sum(map(math.log, values)) / len(values))
        means.append(mean)
        bad = bad or mean > limit or max(values) > 6
    print(f"{'mean':<12}" + "".join(f"{mean:12.2f}" for mean in means))
    print(f"{'limit':<12}" + "".join(f"{limit:12.2f}" for limit in LIMITS.values()))
    raise SystemExit(1 if bad else 0)


if __name__ == "__main__":
    main()
