"""A client of the language server, in the same process, that checks each answer's type."""

import json
import socket
import threading

from lsprotocol import converters, types

from rapidgen._message_streams import MessageStream
from rapidgen.lsp.server import Server
from rapidgen.wire.framing import MessageSplitter, encode

CONVERTER = converters.get_converter()
FULL = {
    "general": {"positionEncodings": ["utf-16"]},
    "workspace": {
        "workspaceEdit": {"documentChanges": True},
        "configuration": False,
    },
    "textDocument": {
        "publishDiagnostics": {"relatedInformation": True},
        "completion": {"completionItem": {"snippetSupport": True}},
        "documentSymbol": {"hierarchicalDocumentSymbolSupport": True},
        "definition": {"linkSupport": False},
    },
}


class Failed(Exception):
    """An error that the server returns."""

    def __init__(self, error):
        super().__init__(error["message"])
        self.code = error["code"]


class Client:
    """Talks to a server in a thread; `notes` are notifications, oldest first."""

    def __init__(self):
        own, other = socket.socketpair()
        self.own = own
        own.settimeout(20)
        self.server = Server(MessageStream(other.recv, other.sendall))
        self.splitter = MessageSplitter()
        self.notes = []
        self.asked = []
        self.codes = []
        self.count = 0
        self.texts = {}

        def serve():
            self.codes.append(self.server.run())
            other.close()

        self.thread = threading.Thread(target=serve)
        self.thread.start()

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.own.close()
        self.thread.join(20)

    def send(self, message):
        self.own.sendall(encode(message))

    def read(self):
        while (message := self.splitter.next()) is None:
            data = self.own.recv(65536)
            if not data:
                raise EOFError
            self.splitter.feed(data)
        return message

    def notify(self, method, params):
        self.send({"jsonrpc": "2.0", "method": method, "params": params})

    def begin(self, method, params):
        """Send a request and return its id."""
        self.count += 1
        self.send({"jsonrpc": "2.0", "id": self.count, "method": method, "params": params})
        return self.count

    def finish(self, identity):
        """Return the raw result of a request."""
        while True:
            message = self.read()
            if "method" in message:
                self._note(message)
            elif message["id"] == identity:
                if "error" in message:
                    raise Failed(message["error"])
                return message["result"]

    def _note(self, message):
        if "id" in message:
            self.asked.append(message)
            self.send({"jsonrpc": "2.0", "id": message["id"], "result": None})
        else:
            kind = types.METHOD_TO_TYPES[message["method"]][0]
            self.notes.append(CONVERTER.structure(message, kind))

    def request(self, method, params):
        """Return the result of a request as its type of lsprotocol."""
        raw = self.finish(self.begin(method, params))
        answer = types.METHOD_TO_TYPES[method][1]
        data = {"jsonrpc": "2.0", "id": 1, "result": raw}
        return CONVERTER.structure(json.loads(json.dumps(data)), answer).result

    # -- life cycle and documents ------------------------------------------------------------

    def start(self, root=None, capabilities=FULL, options=None):
        result = self.request(
            "initialize",
            {
                "processId": None,
                "rootUri": root.as_uri() if root else None,
                "capabilities": capabilities,
                "initializationOptions": options,
            },
        )
        self.notify("initialized", {})
        return result

    def open(self, path, text=None, language="rapid"):
        """Open a file, with another text than it has if one is given."""
        text = path.read_text() if text is None else text
        self.texts[path] = text
        item = {"uri": path.as_uri(), "languageId": language, "version": 1, "text": text}
        self.notify("textDocument/didOpen", {"textDocument": item})

    def change(self, path, version, *changes):
        """Edit a document; each change is a range of ((line, char), (line, char)) and a text."""
        content = []
        for area, text in changes:
            change = {"text": text}
            if area is not None:
                (a, b), (c, d) = area
                start, end = {"line": a, "character": b}, {"line": c, "character": d}
                change["range"] = {"start": start, "end": end}
            content.append(change)
        document = {"uri": path.as_uri(), "version": version}
        params = {"textDocument": document, "contentChanges": content}
        self.notify("textDocument/didChange", params)

    def at(self, path, marker, **more):
        """Parameters for the place of a marker in a text; `|` in it is the position."""
        before, _, after = marker.partition("|")
        text = self.texts[path]
        start = text.index(before + after) + len(before)
        line = text[:start].count("\n")
        column = len(text[text.rfind("\n", 0, start) + 1 : start].encode("utf-16-le")) // 2
        place = {"line": line, "character": column}
        return {"textDocument": {"uri": path.as_uri()}, "position": place, **more}

    def ask(self, name, path, marker, **more):
        """Send a request about a place."""
        return self.request(f"textDocument/{name}", self.at(path, marker, **more))

    def ask_all(self, name, path, **more):
        """Send a request about a document."""
        return self.request(
            f"textDocument/{name}", {"textDocument": {"uri": path.as_uri()}, **more}
        )

    def findings(self, path):
        """Wait for findings that the server sends about a file."""
        while True:
            for note in self.notes:
                params = note.params
                published = note.method == "textDocument/publishDiagnostics"
                if published and params.uri == path.as_uri():
                    self.notes.remove(note)
                    return params.diagnostics
            self._note(self.read())
