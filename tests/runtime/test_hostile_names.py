"""Names and texts of RAPID stay names and texts in Python code."""

import builtins
import keyword

from rapidgen.controller import VirtualController
from rapidgen.rapid import parse

TEXTS = [
    "@REST@", "@OWN@", "'''", "';import os;'", "\\\\", "\\\\N{DASH}", "\\\\x41", "{x}", "{{", "%s",
    "{0}", "'", "#", "'+X+'", "\N{NO-BREAK SPACE}", "\x85", "\xff",
]  # fmt: skip
OURS = set(
    [
        "b",
        "R",
        "F",
        "E",
        "BOX",
        "PART",
        "ARRAY",
        "ERRS",
        "_e",
        "_h",
        "_k",
        "_l",
        "self",
        "args",
        "task0",
        "a_",
        "__class__",
        "__import__",
    ]
)


def names():
    """Words of Python, and of what is compiled, that are names in RAPID."""
    for word in [*keyword.kwlist, *keyword.softkwlist, *dir(builtins), *sorted(OURS)]:
        text = f"MODULE m\nVAR num {word};\nPROC main()\nENDPROC\nENDMODULE\n"
        if not parse(text).diagnostics:
            yield word


def test_hostile_names_stay_names_and_texts(tmp_path):
    used, known = [], set()
    for word in names():
        if word.lower() not in known and word.lower() not in ("m", "main", "text"):
            known.add(word.lower())
            used.append(word)
    assert {"class", "lambda", "import", "b", "R", "eval"} <= set(used)
    lines = ["MODULE zz"]
    lines += [f"VAR num {word} := 1;" for word in used]
    lines += ["PERS num zztotal := 0;", "PERS num zzlengths := 0;", "PROC main()"]
    lines += [f'VAR string zz{n} := "{text}";' for n, text in enumerate(TEXTS)]
    lines += [f"{word} := {word} + 1;\nzztotal := zztotal + {word};" for word in used]
    lines += [f"zzlengths := zzlengths + StrLen(zz{n});" for n in range(len(TEXTS))]
    lines += [f'zz0 := "{text}";\nzzlengths := zzlengths + StrLen(zz0);' for text in TEXTS]
    lines += ["WaitTime 1000;", "ENDPROC", "ENDMODULE", ""]
    (tmp_path / "zz.mod").write_bytes("\n".join(lines).encode("latin-1"))
    with VirtualController.from_files([tmp_path / "zz.mod"]) as controller:
        controller.run_for(1.0)
        task = controller.task("T_ROB1")
        assert controller.rapid_tasks["T_ROB1"].fault is None
        assert task["zztotal"] == 2 * len(used)
        assert task["zzlengths"] == 2 * sum(len(text.replace("\\\\", "\\")) for text in TEXTS)
