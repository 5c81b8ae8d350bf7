"""A recording tells everything as it was; a file that is none is refused, wherever it is broken."""

import errno
import io
import itertools
import json
import random
import re
import struct
import zlib
from base64 import b64decode

import pytest
from mcap.opcode import Opcode
from mcap.reader import make_reader

from rapidgen.controller import VirtualController
from rapidgen.diagnostics import DiagnosticError
from rapidgen.viewer.recording.reader import RecordingFile
from rapidgen.viewer.recording.writer import RecordingWriter, record

STEP = 97
"""Of so many bytes one is changed."""

PROGRAM = """MODULE m
  CONST jointtarget a := [[0,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST jointtarget b := [[40,10,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  PERS num passes := 0;
  VAR socketdev server;
  VAR socketdev peer;
  PROC main()
    VAR string text;
    SocketCreate server;
    SocketBind server, "127.0.0.1", 5000;
    SocketListen server;
    SocketAccept server, peer;
    SocketReceive peer \\Str:=text;
    SocketSend peer \\Str:="echo " + text;
    WHILE TRUE DO
      MoveAbsJ a, v200, fine, tool0;
      there;
      passes := passes + 1;
      SetDO do1, passes MOD 2;
    ENDWHILE
  ENDPROC
  PROC there()
    MoveAbsJ b, v200, fine, tool0;
  ENDPROC
ENDMODULE
"""


@pytest.fixture(scope="module")
def recorded(tmp_path_factory):
    """A recording of 12 s, and what was seen meanwhile: time to (positions, signal, line)."""
    folder = tmp_path_factory.mktemp("recorded")
    module, path = folder / "m.mod", folder / "run.mcap"
    module.write_text(PROGRAM)
    cell = folder / "cell.yaml"
    cell.write_text("signals:\n  do1: {kind: DO}\n")
    seen = {}
    with VirtualController.from_files([module], cell=cell) as controller:
        end = record(controller, path, [("T_ROB1", "passes * 2"), ("T_ROB1", "nothing")])
        network = controller.network
        controller.run_for(0.2)
        client = network.connect("127.0.0.1", 5000)
        controller.run_until(lambda: client.connected, timeout=1)
        network.send(client, b"hello")
        controller.log.info(80_001, "Noted", "by hand")
        for _ in range(100):
            controller.run_for(0.12)
            frames = controller.rapid_tasks["T_ROB1"].stack()
            seen[controller.now] = (
                controller.motion.group("rob1").commanded(),
                controller.signals["do1"],
                [place.routine for place in frames],
            )
        end()
    return path, seen


def test_any_moment_is_as_it_was(recorded):
    path, seen = recorded
    with RecordingFile(path) as file:
        assert (file.begin, file.cut) == (0.0, False)
        assert file.end == pytest.approx(12.2, abs=0.1)
        assert [group.name for group in file.robots] == ["rob1"]
        times = list(seen)
        random.Random(1).shuffle(times)
        for time in times:
            commanded, signal, routines = seen[time]
            moment = file.at(time)
            # Samples are 4 ms apart, pointers 17 ms: at 200 mm/s and 0.5 rad/s.
            assert moment.joints["rob1"].commanded == pytest.approx(commanded, abs=0.01)
            assert moment.signals["do1"] == signal
            stack = [entry.routine for entry in file.at(time + 0.017).tasks["T_ROB1"].stack]
            before = [entry.routine for entry in moment.tasks["T_ROB1"].stack]
            assert routines in (stack, before)


def test_pointers_watches_sockets_and_log(recorded):
    path, _ = recorded
    with RecordingFile(path) as file:
        moment = file.at(11.9)
        passes = len(file.signal("do1", 0, 11.9)) - 1
        task = moment.tasks["T_ROB1"]
        assert task.state == "running"
        assert task.motion.module == "m"
        assert moment.watch["T_ROB1", "passes * 2"].text == str(2 * passes)
        assert "not known" in moment.watch["T_ROB1", "nothing"].text
        assert [c.peer.split(":")[0] for c in moment.connections] == ["127.0.0.1"]
        assert file.at(0.1).connections == []
        frames = [(f.change, b64decode(f.data)) for _, f in file.frames(0, 12)]
        assert frames == [("open", b""), ("in", b"hello"), ("out", b"echo hello")]
        assert [line.code for line in moment.log][-1] == 80_001
        assert [(line.title, line.texts) for line in file.log(0.1, 12)] == [("Noted", ("by hand",))]
        assert file.sources(5.0)["T_ROB1", "m"] == PROGRAM
        assert moment.panel.mode == "auto"


def test_positions_are_sampled_250_times_a_second(recorded):
    path, _ = recorded
    with RecordingFile(path) as file:
        samples = file.joints("rob1", 1.0, 2.0)
        assert len(samples) > 200
        steps = {round((b[0] - a[0]) * 1000) for a, b in itertools.pairwise(samples)}
        assert steps >= {4}
        assert len(file.joints("rob1", 0, 12, most=50)) < 120


def test_csv(recorded, tmp_path):
    path, _ = recorded
    with RecordingFile(path) as file:
        file.write_csv(tmp_path / "out.csv")
        with pytest.raises(KeyError):
            file.write_csv(tmp_path / "other.csv", "absent")
    rows = (tmp_path / "out.csv").read_text().splitlines()
    assert rows[0].startswith("time,joint_1")
    assert rows[0].count(",") == 12
    assert len(rows) > 2000


def test_any_reader_of_mcap_understands_it(recorded):
    """Schemas are in the file, messages are JSON."""
    path, _ = recorded
    with path.open("rb") as stream:
        topics = set()
        for schema, channel, message in make_reader(stream).iter_messages():
            assert schema.encoding == "jsonschema"
            value = json.loads(message.data)
            assert_plain(json.loads(schema.data), value)
            topics.add(channel.topic)
    assert topics >= {"/joints/rob1", "/task/T_ROB1", "/signals", "/log", "/sockets", "/watch"}


def assert_plain(schema, value):
    """As Foxglove and Lichtblick read a schema (parseJsonSchema): types alone; else they refuse the
    channel. What is there has that type."""
    kinds = {
        "boolean": bool,
        "string": str,
        "number": int | float,
        "integer": int,
        "object": dict,
        "array": list,
    }
    assert value is None or isinstance(value, kinds[schema["type"]])
    if schema["type"] == "object":
        for name, own in schema["properties"].items():
            assert_plain(own, (value or {}).get(name))
    if schema["type"] == "array":
        for item in value or [None]:
            assert_plain(schema["items"], item)


def changes(controller, seconds):
    """Times at which the signal changed, ns."""
    times = []
    controller.io["do1"].changed.add(lambda: times.append(controller.scheduler.now))
    controller.run_for(seconds)
    return times


def test_recording_changes_no_time(tmp_path):
    text = re.sub("Socket(Accept|Receive|Send)", "!", PROGRAM)
    (tmp_path / "m.mod").write_text(text)
    cell = tmp_path / "cell.yaml"
    cell.write_text("signals:\n  do1: {kind: DO}\n")
    result = []
    for recording in (False, True):
        with VirtualController.from_files([tmp_path / "m.mod"], cell=cell) as controller:
            end = record(controller, tmp_path / "x.mcap") if recording else lambda: None
            result.append(changes(controller, 10.0))
            end()
    assert len(result[0]) > 2
    assert result[0] == result[1]


def test_a_recording_that_was_cut_off_is_read_up_to_there(recorded, tmp_path):
    path, _ = recorded
    data = path.read_bytes()
    for share in (0.3, 0.6, 0.95):
        cut = tmp_path / "cut.mcap"
        cut.write_bytes(data[: int(len(data) * share)])
        with RecordingFile(cut) as file:
            assert file.cut
            assert 0 < file.end < 12.21
            assert file.at(file.end).joints


def tried(path):
    """Open and look at a file; only a diagnostic may come of it: its code, or ""."""
    try:
        with RecordingFile(path) as file:
            for time in (0.0, 3.3, file.end):
                file.at(time)
            list(file.frames(0, 20))
    except DiagnosticError as error:
        return error.diagnostics[0].code
    return ""


def test_hostile_files_are_refused(recorded, tmp_path):
    path, _ = recorded
    data = path.read_bytes()
    chance = random.Random(7)
    refused = 0
    for _ in range(150):
        broken = bytearray(data)
        for _ in range(chance.choice((1, 3, 40))):
            at = chance.randrange(len(broken))
            broken[at] = chance.randrange(256)
        if chance.random() < 0.3:
            begin = chance.randrange(len(broken))
            del broken[begin : begin + chance.randrange(5000)]
        other = tmp_path / "broken.mcap"
        other.write_bytes(broken)
        code = tried(other)
        assert code in ("", "RG930")
        refused += bool(code)
    assert refused > 20
    for text in (b"", b"\x89MCAP0\r\n", b"PK\x03\x04" * 100, data[:100], data[-200:]):
        other.write_bytes(text)
        assert tried(other) == "RG930"
    assert tried(tmp_path / "absent.mcap") == "RG930"


def test_a_bomb_is_not_unpacked(tmp_path):
    """A chunk that says it is small and is not, or says how large it is."""
    import zstandard
    from mcap.data_stream import RecordBuilder
    from mcap.records import Chunk, Header

    for size in (1 << 40, 1 << 20):
        builder = RecordBuilder()
        Header("rapidgen", "x").write(builder)
        packed = zstandard.ZstdCompressor().compress(bytes(100_000_000))
        Chunk("zstd", packed, 10, 0, 0, size).write(builder)
        path = tmp_path / "bomb.mcap"
        path.write_bytes(b"\x89MCAP0\r\n" + builder.end())
        assert tried(path) == "RG930"


class Full(io.BytesIO):
    """A disk with space for so many bytes."""

    def write(self, data):
        if self.tell() + len(data) > 100_000:
            raise OSError(errno.ENOSPC, "No space left on device")
        return super().write(data)


def test_a_full_disk_ends_the_recording_alone(tmp_path):
    text = re.sub("Socket(Accept|Receive|Send)", "!", PROGRAM).replace("SetDO", "!")
    (tmp_path / "m.mod").write_text(text)
    with VirtualController.from_files([tmp_path / "m.mod"]) as controller:
        writer = RecordingWriter(controller, Full())
        controller.run_for(30.0)
        assert [e.texts for e in controller.log if e.title == "Recording ended"] == [
            ("No space left on device",)
        ]
        assert controller.task("T_ROB1").state == "running"
        writer.close()


def test_the_writer_can_be_closed_twice(tmp_path):
    (tmp_path / "m.mod").write_text("MODULE m\nPROC main()\nENDPROC\nENDMODULE\n")
    with VirtualController.from_files([tmp_path / "m.mod"]) as controller:
        with (tmp_path / "x.mcap").open("wb") as file:
            writer = RecordingWriter(controller, file)
            controller.run_for(0.1)
            writer.close()
            writer.close()
            controller.run_for(1.0)
        assert not controller.sockets.listeners


def everything(path):
    """All that can be read from a recording, but whether it was cut off; or a diagnostic's code."""
    try:
        with RecordingFile(path) as file:
            result = [file.title, file.begin, file.end, file.robots, file.signals, file.look]
            result += [dict(file.look.files), file.sources(file.end)]
            result += [file.at(time) for time in (0.0, 0.7, file.end)]
            result += [list(file.frames(0, 9)), file.log(0, 9), file.signal("do1", 0, 9)]
            return repr([*result, file.joints("rob1", 0, 9), file.joints("rob1", 0, 9, most=1)])
    except DiagnosticError as error:
        return error.diagnostics[0].code


@pytest.fixture
def short(tmp_path, monkeypatch):
    """A short recording of several chunks."""
    monkeypatch.setattr("rapidgen.viewer.recording.writer._CHUNK", 20_000)
    module, cell, path = tmp_path / "m.mod", tmp_path / "cell.yaml", tmp_path / "run.mcap"
    module.write_text(re.sub("Socket(Accept|Receive|Send)", "!", PROGRAM))
    cell.write_text("signals:\n  do1: {kind: DO}\n")
    with VirtualController.from_files([module], cell=cell) as controller:
        end = record(controller, path)
        controller.run_for(1.2)
        end()
    return path


def test_a_changed_byte_changes_nothing_silently(short, tmp_path):
    """The recording is refused, or it is the same."""
    data = short.read_bytes()
    complete = everything(short)
    assert "rob1" in complete
    changed = tmp_path / "changed.mcap"
    chance = random.Random(5)
    refused = 0
    for at in range(chance.randrange(STEP), len(data), STEP):
        other = bytearray(data)
        other[at] ^= 1 << chance.randrange(8)
        changed.write_bytes(other)
        result = everything(changed)
        assert result in ("RG930", complete), f"byte {at} of {len(data)}"
        refused += result == "RG930"
    assert refused > len(data) / STEP / 2


def test_the_data_section_has_a_checksum(short):
    """Tools that check a file as a whole find a changed byte anywhere in its data."""
    data = short.read_bytes()
    footer = struct.unpack("<BQQQI8s", data[-37:])
    record = footer[2] - struct.calcsize("<BQI")
    opcode, length, checksum = struct.unpack_from("<BQI", data, record)
    assert (opcode, length) == (Opcode.DATA_END, 4)
    assert checksum == zlib.crc32(data[:record])


def until_the_cut(path):
    """Samples of a robot; none where it is refused."""
    try:
        with RecordingFile(path) as file:
            return file.joints("rob1", 0, 20, most=1_000_000)[:-1]
    except DiagnosticError:
        return []


def test_a_recording_that_was_cut_off_and_damaged_ends_at_the_damage(short, tmp_path):
    """No chunk is left out between others."""
    data = short.read_bytes()
    data = data[: int(len(data) * 0.7)]
    cut = tmp_path / "cut.mcap"
    cut.write_bytes(data)
    complete = until_the_cut(cut)
    chance = random.Random(6)
    read = set()
    for _ in range(60):
        changed = bytearray(data)
        changed[chance.randrange(8, len(data))] ^= 1 << chance.randrange(8)
        cut.write_bytes(changed)
        result = until_the_cut(cut)
        assert result == complete[: len(result)]
        read.add(len(result))
    assert len(read) > 2
