"""NaN, which raw bytes of a socket can contain, in arguments of built-ins.

No public source says what a controller does. Here the strictest answer: ERR_ARGVALERR, a RAPID
error that a handler takes, and no motion.
"""

import pytest

from rapidgen.config import load_config
from rapidgen.controller.controller import VirtualController

PROGRAM = r"""MODULE m
VAR num n; VAR num r; VAR socketdev s; VAR socketdev c; VAR rawbytes q;
PROC main()
PackRawBytes 0, q, 1 \Hex1;
PackRawBytes 0, q, 2 \Hex1;
PackRawBytes 192, q, 3 \Hex1;
PackRawBytes 127, q, 4 \Hex1;
UnpackRawBytes q, 1, n \Float4;
@statement
TPWrite "executed";
ERROR
IF ERRNO = ERR_ARGVALERR TPWrite "rejected";
ENDPROC
ENDMODULE
"""
TARGET = "[[5,0,0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]]"


@pytest.mark.parametrize(
    "statement",
    [
        r"WaitUntil FALSE \MaxTime:=n;",
        "WaitTime n;",
        r'SocketCreate s; SocketConnect s, "127.0.0.1", 4001 \Time:=n;',
        "r := Round(1 \\Dec:=n);",
        'TPWrite StrPart("abc", n, 1);',
        "r := BitLSh(1, n);",
        r"PackRawBytes n, q, 1 \IntX:=DINT;",
        rf"MoveAbsJ {TARGET}, v100 \T:=n, fine, tool0;",
        rf"MoveAbsJ {TARGET}, v100 \V:=n, fine, tool0;",
        rf"MoveAbsJ {TARGET}, v100, z10 \Z:=n, tool0;",
        f"MoveAbsJ {TARGET}, [n,500,5000,1000], fine, tool0;",
        "MoveL Offs(CRobT(), n, 0, 0), v100, fine, tool0;",
    ],
)
def test_no_number_is_rejected(tmp_path, statement):
    (tmp_path / "m.mod").write_text(PROGRAM.replace("@statement", statement.replace("; ", ";\n")))
    with VirtualController.from_files(
        {"T_ROB1": [tmp_path / "m.mod"]}, robots=load_config("irb120").groups, cycle="once"
    ) as controller:
        group = next(iter(controller.motion.groups.values()))
        before = group.positions()
        controller.run_for(2)
        assert list(controller.operator.rows) == ["rejected"]
        assert group.positions() == before
