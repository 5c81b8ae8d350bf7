"""Socket peers of an inferred cell send the expected messages."""

import pytest

from rapidgen.controller import VirtualController
from rapidgen.controller.boot_targets import BootOptions, load_target
from rapidgen.controller.inference.restarts import run_past_stops

SERVER = """MODULE server
 VAR socketdev s;
 VAR socketdev c;
 VAR string reply;
 VAR num code;
 VAR bool ok;
 PROC main()
  SocketCreate s;
  SocketBind s, "192.168.125.1", 5000;
  SocketListen s;
  SocketAccept s, c;
  WHILE reply <> "quit" DO
   SocketReceive c \\Str:=reply;
   ok := StrToVal(StrPart(reply, 1, 1), code);
   IF StrPart(reply, 1, 1) = "G" TPWrite "go";
   IF ok THEN
    TEST code
    CASE 7:
     TPWrite "seven";
    DEFAULT:
     TPWrite "unknown";
    ENDTEST
   ENDIF
   SocketSend c \\Str:="ok";
  ENDWHILE
  SocketClose c;
  SocketClose s;
 ENDPROC
ENDMODULE
"""
CLIENT = """MODULE client
 VAR socketdev s;
 VAR string reply;
 PROC main()
  SocketCreate s;
  SocketConnect s, "10.0.0.7", 4000;
  SocketSend s \\Str:="where";
  SocketReceive s \\Str:=reply \\ReadNoOfBytes:=12;
  TPWrite "got " + ValToStr(StrLen(reply));
  SocketReceive s \\Str:=reply \\Time:=WAIT_MAX;
  SocketReceive s \\Str:=reply \\Time:=WAIT_MAX;
  SocketReceive s \\Str:=reply \\Time:=WAIT_MAX;
 ENDPROC
ENDMODULE
"""


def run(tmp_path, text, **options):
    path = tmp_path / "program.mod"
    path.write_text(text)
    displayed: list[str] = []
    with VirtualController.from_files([path], cycle="once", **options) as controller:
        controller.operator.subscribe(lambda _task, line: displayed.append(line))
        finished = controller.run(max_time=120)
        return finished, displayed, controller.where(), controller


def test_server_receives_words_numbers_and_end_last(tmp_path):
    finished, displayed, _, controller = run(tmp_path, SERVER, cell="infer")
    assert finished == "finished"
    assert displayed[:4] == ["unknown", "seven", "unknown", "go"], "with more behind it"
    assert "seven" in displayed[4:], "alone"
    message = [text for what, text in controller.guessed.answered if what == "SocketReceive"]
    assert any(text.startswith("7 ") for text in message), "a number with more behind it"
    assert message[-1] == "quit"


COUNTING = """MODULE counting
 CONST num MOVE := 3;
 VAR socketdev s;
 VAR socketdev c;
 VAR string reply;
 VAR num code;
 VAR num params{10};
 VAR num n;
 PROC main()
  SocketCreate s;
  SocketBind s, "192.168.125.1", 5000;
  SocketListen s;
  SocketAccept s, c;
  WHILE code <> 99 DO
   SocketReceive c \\Str:=reply;
   cut;
   TEST code
   CASE MOVE:
    IF n = 6 THEN
     MoveAbsJ [[params{1},params{2},params{3},params{4},params{5},params{6}],
      [9E9,9E9,9E9,9E9,9E9,9E9]], v1000, fine, tool0;
     TPWrite "moved";
    ENDIF
   CASE 5:
    IF n <> 2 RETURN;
    IF params{1} = 1 TPWrite "on";
    IF params{1} = 0 TPWrite "off";
   ENDTEST
  ENDWHILE
 ENDPROC
 PROC cut()
  VAR num at := 1;
  VAR num next;
  VAR num found;
  VAR bool ok;
  n := -1;
  IF StrPart(reply, StrLen(reply), 1) <> "#" RETURN;
  WHILE at < StrLen(reply) DO
   next := StrFind(reply, at, " ");
   ok := StrToVal(StrPart(reply, at, next - at), found);
   n := n + 1;
   IF n = 0 THEN
    code := found;
   ELSE
    params{n} := found;
   ENDIF
   at := next + 1;
  ENDWHILE
 ENDPROC
ENDMODULE
"""


def test_server_receives_counted_values_of_start_pose(tmp_path):
    path = tmp_path / "counting.mod"
    path.write_text(COUNTING)
    displayed: list[str] = []
    with VirtualController.from_files([path], cell="infer", cycle="once") as controller:
        controller.operator.subscribe(lambda _task, line: displayed.append(line))
        run_past_stops(controller, max_time=300)
        message = [text for what, text in controller.guessed.answered if what == "SocketReceive"]
    assert "3 0 0 0 0 30 0 #" in message
    assert {"moved", "on", "off"} <= set(displayed)


BINARY = """MODULE binary
 RECORD letter
  num kind;
  rawbytes rest;
 ENDRECORD
 VAR socketdev s;
 VAR socketdev c;
 VAR letter one;
 VAR num phase;
 VAR num angle;
 PROC main()
  SocketCreate s;
  SocketBind s, "192.168.125.1", 5000;
  SocketListen s;
  SocketAccept s, c;
  WHILE TRUE DO
   take one;
   IF one.kind = 300 THEN
    IF RawBytesLen(one.rest) < 10 Stop;
    UnpackRawBytes one.rest, 1, phase, \\IntX:=INT;
    UnpackRawBytes one.rest, 5, angle, \\Float4;
    TEST phase
    CASE -1:
     TPWrite "begin";
    CASE 7:
     TPWrite "end " + ValToStr(angle);
    DEFAULT:
     TPWrite "between";
    ENDTEST
   ELSE
    TPWrite "unknown";
   ENDIF
  ENDWHILE
 ENDPROC
 PROC take(VAR letter got)
  VAR rawbytes buffer;
  VAR num length;
  SocketReceive c \\RawData:=buffer \\ReadNoOfBytes:=2 \\Time:=WAIT_MAX;
  UnpackRawBytes buffer \\Network, 1, length, \\IntX:=UINT;
  SocketReceive c \\RawData:=buffer \\ReadNoOfBytes:=length \\Time:=WAIT_MAX;
  UnpackRawBytes buffer \\Network, 1, got.kind, \\IntX:=UDINT;
  ClearRawBytes got.rest;
  CopyRawBytes buffer, 5, got.rest, 1;
 ENDPROC
ENDMODULE
"""


def test_server_receives_binary_lengths_and_tested_numbers(tmp_path):
    """Length first, in the byte order of the program [S4 UnpackRawBytes]."""
    finished, displayed, where, controller = run(tmp_path, BINARY, cell="infer")
    assert displayed[:4] == ["begin", "between", "end 0", "unknown"]
    assert (finished, "waits for bytes" in where[0]) == ("deadlock", True)
    message = [text for what, text in controller.guessed.answered if what == "SocketReceive"]
    assert message[0] == "00 0e 00 00 01 2c ff ff 00 00 00 00 00 00 00 00"


FIELDS = """MODULE fields
 VAR socketdev s;
 VAR string reply;
 VAR num a;
 VAR num b;
 VAR num x;
 VAR string side;
 VAR string code;
 VAR num job;
 VAR bool ok;
 PROC main()
  SocketCreate s;
  SocketConnect s, "10.0.0.7", 4000;
  WHILE TRUE DO
   SocketReceive s \\Str:=reply \\Time:=WAIT_MAX;
   IF StrPart(reply, 1, 1) = "J" THEN
    fixed;
   ELSE
    cut;
   ENDIF
  ENDWHILE
 ENDPROC
 PROC cut()
  a := StrFind(reply, 1, ";");
  b := StrFind(reply, a + 1, ";");
  ok := StrToVal(StrPart(reply, 1, a - 1), x);
  side := StrPart(reply, a + 1, b - a - 1);
  IF NOT ok OR x < 200 OR x > 300 RETURN;
  IF side = "left" TPWrite "left";
  IF side = "right" TPWrite "right";
 ENDPROC
 PROC fixed()
  code := StrPart(reply, 1, 1);
  IF NOT StrToVal(StrPart(reply, 3, 3), job) RETURN;
  IF code = "J" AND job = 12 TPWrite "twelve";
 ENDPROC
ENDMODULE
"""


def test_text_fields_have_compared_values(tmp_path):
    path = tmp_path / "fields.mod"
    path.write_text(FIELDS)
    displayed: list[str] = []
    with VirtualController.from_files([path], cell="infer", cycle="once") as controller:
        controller.operator.subscribe(lambda _task, line: displayed.append(line))
        run_past_stops(controller, max_time=300)
        message = [text for what, text in controller.guessed.answered if what == "SocketReceive"]
    assert message[:3] == ["250;left;", "250;right;", "J;012;"]
    assert displayed[:3] == ["left", "right", "twelve"]


def test_awaited_client_of_two_sends(tmp_path):
    two = (
        "MODULE two\n VAR socketdev s;\n VAR socketdev c;\n VAR socketdev d;\n VAR string reply;\n"
        ' PROC main()\n  SocketCreate s;\n  SocketBind s, "127.0.0.1", 5000;\n'
        "  SocketListen s;\n  SocketAccept s, c;\n  SocketAccept s, d;\n"
        '  SocketReceive d \\Str:=reply;\n  IF reply = "a" TPWrite reply;\n ENDPROC\nENDMODULE\n'
    )
    finished, displayed, _, _ = run(tmp_path, two, cell="infer")
    assert finished == "finished"
    assert displayed == ["a"]


def test_copy_of_message_is_compared_without_error_texts(tmp_path):
    text = SERVER.replace(
        '   IF StrPart(reply, 1, 1) = "G" TPWrite "go";\n',
        '   also := reply;\n   IF also = "gate" AND ERRNO <> ERR_SOCK_TIMEOUT TPWrite "gate";\n',
    ).replace(" VAR bool ok;", " VAR bool ok;\n VAR string also;")
    _, displayed, _, controller = run(tmp_path, text, cell="infer")
    assert "gate" in displayed
    assert "1161" not in str(controller.guessed.answered)


def test_client_gets_answers_then_silence(tmp_path):
    finished, displayed, where, _ = run(tmp_path, CLIENT, cell="infer")
    assert displayed == ["got 12"], "as many bytes as it reads"
    assert finished == "deadlock"
    assert "waits for bytes" in where[0]


def test_program_stopped_by_answer_restarts_with_next(tmp_path):
    path = tmp_path / "server.mod"
    path.write_text(
        SERVER.replace('"quit"', '"long" AND reply <> "short"').replace(
            "   SocketSend c", "   TPWrite reply + StrPart(reply, 5, 1);\n   SocketSend c"
        )
    )
    displayed: list[str] = []
    with VirtualController.from_files([path], cell="infer", cycle="once") as controller:
        controller.operator.subscribe(lambda _task, line: displayed.append(line))
        finished = run_past_stops(controller, max_time=120)
        assert finished == "finished"
        assert ("server.mod:24", "ERR_OUTOFBND") in controller.guessed.stopped
        assert "shortt" in displayed, "the one behind that which stopped it"


def test_program_stopped_by_itself_is_not_restarted(tmp_path):
    path = tmp_path / "wrong.mod"
    path.write_text(
        'MODULE wrong\n PROC main()\n  TPWrite StrPart("a", 5, 1);\n ENDPROC\nENDMODULE\n'
    )
    with VirtualController.from_files([path], cell="infer", cycle="once") as controller:
        run_past_stops(controller, max_time=120)
        assert "ERR_OUTOFBND" in str(controller.task("T_ROB1").fault)
        assert controller.guessed.stopped == []


@pytest.mark.parametrize("text", [SERVER, CLIENT])
def test_socket_without_inference_has_no_peer(tmp_path, text):
    _, displayed, _, controller = run(tmp_path, text)
    assert displayed == []
    assert "ERR_SOCK" in str(controller.task("T_ROB1").fault)


def test_real_socket_has_no_inferred_peer(tmp_path):
    path = tmp_path / "server.mod"
    path.write_text(SERVER)
    result = load_target([path], BootOptions(cell="infer"))
    with VirtualController.boot(result, host="127.0.0.1", cycle="once") as controller:
        controller.run(max_time=10)
        assert controller.sockets.on_awaited is None
