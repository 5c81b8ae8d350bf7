"""Faults of a program are reported and do not affect other tasks.

Bad clients: tests/runtime/builtins/test_contained.py.
"""

import pytest

from tests.runtime.booting import boot

COUNT = """
  PERS num n := 0;
  PROC main()
    WHILE TRUE DO
      n := n + 1;
      WaitTime 0.1;
    ENDWHILE
  ENDPROC
"""
ENDLESS = {
    "loop": "WHILE TRUE DO\n ENDWHILE",
    "jump": "again:\n GOTO again;",
    "deadlock": "WaitTestAndSet held;",
    "wait": "WaitUntil FALSE;",
}
STOPPING = {
    "recursion": ("deeper 1;", "194027"),
    "recursion of a function": ("x := deepest(1);", "194027"),
    "a thousand sockets": (
        "FOR i FROM 1 TO 1000 DO\n SocketCreate many{i};\n ENDFOR",
        "ERR_SOCK_UNSPEC",
    ),
    "a path out of HOME:": ('Open "HOME:/../../etc/passwd", file \\Read;', "ERR_FILEACC"),
    "a folder out of HOME:": ('MakeDir "HOME:/../outside";', "ERR_FILEACC"),
    "a module from outside": ('Load "/etc/passwd";', "ERR_"),
    "a full disk": (
        'Open "HOME:/big", file \\Bin;\n WHILE TRUE DO\n WriteRawBytes file, block;\n ENDWHILE',
        "ERR_FILEACC",
    ),
    "too long a text": (
        'text := "0123456789";\n WHILE TRUE DO\n text := text + text;\n ENDWHILE',
        "ERR_STRTOOLNG",
    ),
}
BAD = """
  PERS bool held := TRUE;
  VAR socketdev many{1000};
  VAR iodev file;
  VAR rawbytes block;
  VAR string text;
  VAR num x;
  PROC main()
    PackRawBytes 0, block, 1021 \\IntX:=DINT;
    BODY
  ENDPROC
  PROC deeper(num n)
    deeper n + 1;
  ENDPROC
  FUNC num deepest(num n)
    RETURN 1 + deepest(n);
  ENDFUNC
"""


def together(body: str, **options):
    """Return a task that counts, and a faulty background task."""
    specs = {"T2": {"type": "STATIC", "trust": "NoSafety"}}
    controller, _ = boot(COUNT, BAD.replace("BODY", body), specs=specs, **options)
    controller.start_program()
    return controller


@pytest.mark.parametrize("body", ENDLESS.values(), ids=ENDLESS.keys())
def test_endless_program_blocks_no_other_task(body: str) -> None:
    with together(body) as controller:
        controller.run_for(3)
        assert controller.task("T1")["n"] >= 28
        assert [t.state for t in controller.tasks.values()] == ["running"] * 2
        assert any("T2" in line for line in controller.where())


@pytest.mark.parametrize(("body", "error"), STOPPING.values(), ids=STOPPING.keys())
def test_failing_task_stops_alone(body: str, error: str, monkeypatch) -> None:
    monkeypatch.setattr("rapidgen.machine.files.CAPACITY", 100_000)
    with together(body) as controller:
        controller.run_until(lambda: controller.task("T2").state == "error", timeout=600)
        before = controller.task("T1")["n"]
        controller.run_for(3)
        assert controller.task("T1").state == "running"
        assert controller.task("T1")["n"] - before >= 28
        fault = controller.task("T2").fault
        assert fault is not None
        name = fault.cause.name if fault.cause is not None else str(fault.event)
        assert name.startswith(error)
        assert any(event.code == fault.event and event.task == "T2" for event in controller.log)
