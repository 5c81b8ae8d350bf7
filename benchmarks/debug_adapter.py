"""Debug adapter: steps per second through a client on TCP, and the CPU time until `initialize`.

The client sends `next`, waits for `stopped` and reads the innermost frame, as an editor does for
each step. Both processes share the machine.
"""

import argparse
import resource
import socket
import subprocess
import sys
import tempfile
import time
from pathlib import Path

from rapidgen._message_streams import MessageStream

PROGRAM = """MODULE steps
  PROC main()
    VAR num i := 0;
    WHILE TRUE DO
      i := i + 1;
      work i;
    ENDWHILE
  ENDPROC
  PROC work(num n)
    VAR robtarget p;
    p.trans.x := n;
  ENDPROC
ENDMODULE
"""


class Editor:
    """The client: requests, and events until an expected one."""

    def __init__(self, stream: MessageStream) -> None:
        self._stream = stream
        self._seq = 0

    def send(self, command: str, **arguments: object) -> None:
        """Send a request."""
        self._seq += 1
        self._stream.write(
            {"seq": self._seq, "type": "request", "command": command, "arguments": arguments}
        )

    def wait(self, kind: str, name: str) -> dict:
        """Read messages until an event or a response."""
        while (message := self._stream.read()) is not None:
            if message["type"] == kind and name in (message.get("event"), message.get("command")):
                assert message.get("success", True), message
                return message
        raise SystemExit("the adapter has gone")

    def ask(self, command: str, **arguments: object) -> dict:
        """Send a request and return its response."""
        self.send(command, **arguments)
        return self.wait("response", command)


def steps(editor: Editor, program: Path, number: int) -> float:
    """Return the seconds of `number` steps."""
    editor.ask("launch", program=str(program), stopOnEntry=True)
    editor.wait("event", "initialized")
    editor.send("configurationDone")
    editor.wait("event", "stopped")
    begin = time.perf_counter()
    for i in range(number):
        editor.send(("next", "stepIn")[i % 2], threadId=1)
        editor.wait("event", "stopped")
        editor.ask("stackTrace", threadId=1, startFrame=0, levels=1)
    return time.perf_counter() - begin


def main() -> None:
    """Print both figures."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--steps", type=int, default=2000)
    arguments = parser.parse_args()
    command = [sys.executable, "-m", "rapidgen", "dap", "--tcp", "0"]
    with (
        tempfile.TemporaryDirectory() as folder,
        subprocess.Popen(command, stderr=subprocess.PIPE, text=True) as process,
    ):
        assert process.stderr is not None
        program = Path(folder, "steps.mod")
        program.write_text(PROGRAM)
        port = int(process.stderr.readline().rpartition(":")[2])
        with socket.create_connection(("127.0.0.1", port)) as own:
            own.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
            editor = Editor(MessageStream(own.recv, own.sendall))
            editor.ask("initialize", adapterID="rapidgen")
            seconds = steps(editor, program, arguments.steps)
            print(f"{arguments.steps / seconds:.0f} steps/s ({arguments.steps} steps)")
            editor.ask("disconnect")
        process.terminate()
    data = b'{"seq":1,"type":"request","command":"initialize","arguments":{}}'
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    subprocess.run(
        command[:-2],
        input=b"Content-Length: %d\r\n\r\n%b" % (len(data), data),
        check=True,
        capture_output=True,
    )
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    cpu = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    print(f"initialize answered and ended: {cpu * 1e3:.0f} ms of CPU")


if __name__ == "__main__":
    main()
