"""Parsing and checking RAPID against a bare token scan of the same text.

python benchmarks/parsing.py [FOLDER]

Without a folder the script generates the text, in the proportions of public programs: positions,
moves, socket and string code, comments. CPU time, best of several rounds.
"""

import gc
import random
import re
import sys
import time
from pathlib import Path

from rapidgen.rapid import check, format_source, parse
from rapidgen.rapid.syntax.lexer import decode
from rapidgen.rapid.syntax.walk import walk
from rapidgen.system import ModuleFile, System, TaskSpec

SCAN = re.compile(r'"(?:[^"\n]|"")*"|![^\n]*|[^\W\d]\w*|\d[\d.]*(?:[eE][+-]?\d+)?|:=|<>|<=|>=|\S')
SUFFIXES = (".mod", ".modx", ".sys", ".sysx", ".prg")
ROUTINE = """
    ! Move number {k} of this module, with a look at the socket in between.
    PROC step_{m}_{k}(num count, \\num wait)
        VAR string text;
        VAR num i := 0;
        FOR n FROM 1 TO count DO
            IF n > {k} AND (NOT done_{m}) THEN
                MoveL Offs(p{m}_{k}, 10 * n, -5, n + 0.5), v{v}, z10, tool0 \\WObj:=wobj0;
                i := i + n * 2;
            ELSEIF Present(wait) THEN
                WaitTime wait;
            ELSE
                MoveJ p{m}_{k}, v1000, fine, tool0;
            ENDIF
        ENDFOR
        text := "step " + NumToStr(i, 2) + " of " + ValToStr(count);
        SocketSend socket_{m} \\Str:=text;
        TEST i
        CASE 1, 2:
            done_{m} := TRUE;
        DEFAULT:
            TPWrite text \\Num:=i;
        ENDTEST
    ERROR
        IF ERRNO = ERR_SOCK_CLOSED THEN
            TRYNEXT;
        ENDIF
        RAISE;
    ENDPROC
"""


def module(m, routines):
    """Return the text of one module."""
    numbers = random.Random(m)
    data = [
        f"    CONST robtarget p{m}_{k} := [[{numbers.uniform(-900, 900):.3f},"
        f"{numbers.uniform(-900, 900):.3f},{numbers.uniform(0, 900):.3f}],[1,0,0,0],"
        "[0,-1,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];"
        for k in range(routines)
    ]
    code = [ROUTINE.format(m=m, k=k, v=(100, 200, 500)[k % 3]) for k in range(routines)]
    head = f"MODULE m{m}\n    VAR bool done_{m};\n    VAR socketdev socket_{m};\n"
    body = "\n".join(data) + "".join(code)
    entry = "    PROC main()\n    ENDPROC\n" if m == 0 else ""
    return f"{head}{body}{entry}ENDMODULE\n"


def best(action, rounds=5):
    """Return CPU seconds of the fastest round."""
    result = []
    for _ in range(rounds):
        gc.collect()
        started = time.process_time()
        action()
        result.append(time.process_time() - started)
    return min(result)


def texts_of(folder):
    """Return texts of a folder's modules that parse without an error."""
    files = [f for f in sorted(folder.rglob("*")) if f.is_file() and f.suffix.lower() in SUFFIXES]
    texts = [decode(f.read_bytes())[0] for f in files]
    return [text for text in texts if not parse(text).diagnostics]


def main():
    texts = (
        texts_of(Path(sys.argv[1])) if len(sys.argv) > 1 else [module(m, 12) for m in range(200)]
    )
    lines = sum(text.count("\n") for text in texts)
    scan = best(lambda: [SCAN.findall(text) for text in texts])
    trees = best(lambda: [parse(text) for text in texts])
    walked = best(lambda: [sum(1 for _ in walk(parse(text))) for text in texts])
    formatted = best(lambda: [format_source(text) for text in texts[:20]], 2)
    print(f"{len(texts)} modules, {lines:,} lines")
    print(f"parse         {trees / scan:5.2f} x scan   {lines / trees:,.0f} lines/s")
    print(f"parse + walk  {walked / scan:5.2f} x scan")
    print(f"format        {sum(t.count(chr(10)) for t in texts[:20]) / formatted:,.0f} lines/s")
    one, ten = module(0, 120), module(0, 1200)
    ratio = best(lambda: parse(ten), 3) / best(lambda: parse(one), 9)
    print(f"{len(ten) / len(one):.1f} x the text takes {ratio:.1f} x the time")
    files = tuple(ModuleFile(f"m{m}", f"m{m}.mod", module(m, 12).encode()) for m in range(200))
    system = System("backup", (TaskSpec("T_ROB1", modules=files),))
    started = time.process_time()
    result = check(system)
    spent = time.process_time() - started
    total = sum(file.data.count(b"\n") for file in files)
    print(f"check of 200 modules ({total:,} lines): {spent:.2f} s, {len(result)} findings")


if __name__ == "__main__":
    main()
