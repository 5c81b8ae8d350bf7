"""CPU time of the language server: after an edit, at the start, and its memory.

    python benchmarks/editor.py [--rounds N]

The texts are those of parsing.py. An edit changes one letter of a module of 2,000 lines, which
stands among 50 modules of a folder; each answer includes the new parse. All times are CPU times of
this process, medians of the rounds; the start is that of a process of its own.
"""

import argparse
import gc
import resource
import statistics
import subprocess
import sys
import tempfile
import time
from pathlib import Path

from parsing import module

from rapidgen.editor.workspace import Workspace
from rapidgen.lsp.conversion import client_of
from rapidgen.lsp.methods import NOTIFICATIONS, REQUESTS, Session
from rapidgen.wire.framing import encode

CAPABILITIES = {"textDocument": {"completion": {"completionItem": {"snippetSupport": True}}}}


def cpu(action):
    """Return the milliseconds of an action."""
    start = time.process_time()
    action()
    return 1e3 * (time.process_time() - start)


def opened(session, path):
    """Open a module in a session."""
    document = {"uri": path.as_uri(), "languageId": "rapid", "version": 1}
    params = {"textDocument": {**document, "text": path.read_text()}}
    NOTIFICATIONS["textDocument/didOpen"](session, params)


class Edited:
    """A module under edit: one digit of a comparison changes."""

    def __init__(self, session, path):
        self.session = session
        self.identity = {"uri": path.as_uri()}
        lines = path.read_text().splitlines()
        self.line = next(i for i, line in enumerate(lines) if "IF n > 7 " in line)
        self.column = lines[self.line].index("7")
        self.call = next(i for i, line in enumerate(lines) if i > self.line and "MoveL" in line)
        self.version = 1

    def edit(self):
        """Replace the digit."""
        self.version += 1
        start = {"line": self.line, "character": self.column}
        end = {"line": self.line, "character": self.column + 1}
        change = {"range": {"start": start, "end": end}, "text": str(self.version % 10)}
        document = {**self.identity, "version": self.version}
        params = {"textDocument": document, "contentChanges": [change]}
        NOTIFICATIONS["textDocument/didChange"](self.session, params)

    def ask(self, method, **more):
        """Edit, then send a request; return the milliseconds of both."""

        def action():
            self.edit()
            REQUESTS[f"textDocument/{method}"](
                self.session, {"textDocument": self.identity, **more}
            )

        return cpu(action)

    def place(self, character):
        """Return parameters for a character of the line with a call."""
        return {"position": {"line": self.call, "character": character}}


def after_edit(folder, rounds):
    """Print the medians of answers after an edit."""
    session = new_session()
    path = folder / "m0.mod"
    opened(session, path)
    for _ in session.workspace.work():
        pass
    REQUESTS["textDocument/completion"](
        session,
        {"textDocument": {"uri": path.as_uri()}, "position": {"line": 0, "character": 0}},
    )
    edited = Edited(session, path)
    print(f"module of {len(path.read_text().splitlines())} lines among 50")
    start, end = {"line": 0, "character": 0}, {"line": 50, "character": 0}
    everything = {"range": {"start": start, "end": end}}
    for method, more in (
        ("diagnostic", {}),
        ("completion", edited.place(40)),
        ("definition", edited.place(28)),
        ("hover", edited.place(28)),
        ("signatureHelp", edited.place(40)),
        ("references", {**edited.place(28), "context": {"includeDeclaration": True}}),
        ("semanticTokens/full", {}),
        ("documentSymbol", {}),
        ("inlayHint", everything),
    ):
        times = [edited.ask(method, **more) for _ in range(rounds)]
        print(f"  {method:22} median {statistics.median(times):6.1f} ms, worst {max(times):6.1f}")


def new_session():
    """Return a session of a client with snippets."""
    return Session(Workspace(), client_of(CAPABILITIES))


def ready(folder, what):
    """Print the time until the first module of a folder has its findings, and all have."""
    gc.collect()
    session = new_session()
    path = folder / "m0.mod"
    first = cpu(
        lambda: (
            opened(session, path),
            session.workspace.findings_of(str(path)),
        )
    )
    whole = cpu(lambda: list(session.workspace.work()))
    lines = sum(len(p.read_text().splitlines()) for p in folder.glob("*.mod"))
    print(
        f"{what}, {lines:,} lines: open module ready {first:.0f} ms, all {first + whole:.0f} ms, "
        f"memory {resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024:.0f} MB"
    )


def start():
    """Print the CPU time of a process until it has answered `initialize`."""
    messages = [
        {"jsonrpc": "2.0", "id": 1, "method": "initialize", "params": {"capabilities": {}}},
        {"jsonrpc": "2.0", "id": 2, "method": "shutdown"},
        {"jsonrpc": "2.0", "method": "exit"},
    ]
    times = []
    for _ in range(3):
        before = resource.getrusage(resource.RUSAGE_CHILDREN)
        subprocess.run(
            [sys.executable, "-m", "rapidgen", "lsp"],
            input=b"".join(map(encode, messages)),
            stdout=subprocess.DEVNULL,
            check=True,
        )
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
        times.append(after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime)
    print(f"start to the answer of `initialize` and exit: {min(times):.2f} s of CPU")


def main():
    """Run all parts."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--rounds", type=int, default=15)
    given = parser.parse_args()
    start()
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        for number in range(50):
            routines = 68 if number == 0 else 5
            (folder / f"m{number}.mod").write_text(module(number, routines))
        after_edit(folder, given.rounds)
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        for number in range(200):
            (folder / f"m{number}.mod").write_text(module(number, 10))
        ready(folder, "200 modules")


if __name__ == "__main__":
    main()
