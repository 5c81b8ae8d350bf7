"""A line that is cut at one operation, on three kinds of server."""

import os

from rapidgen.deploy import TransportFault
from rapidgen.deploy.transports.folder import FolderTransport

EVERY = 1 if os.environ.get("RAPIDGEN_LONG") else 3
"""The long campaign (benchmarks/deploy.py --cuts) takes every operation of every case; here the
cases that differ most do, the others every third, from another one in each mode."""

CHANGING = ("write", "rename", "delete", "make_folder", "delete_folder")
MODES = ("replace", "move", "none")
"""rename replaces, rename takes only free names, no rename."""


class Cutting(FolderTransport):
    """A folder whose connection fails at one operation and stays down."""

    def __init__(self, root, mode, at=None, how="before"):
        super().__init__(root)
        self.mode, self.at, self.how = mode, at, how
        self.count, self.log, self.dead = 0, [], False

    def _step(self, name, path, action, partial=None):
        if self.dead:
            raise TransportFault("lost", "dead")
        if name in CHANGING:
            self.count += 1
            self.log.append((name, path))
            if self.count == self.at:
                self.dead = True
                if self.how == "after":
                    action()
                elif self.how == "partial" and partial:
                    partial()
                raise TransportFault("lost", f"cut at {name} {path}")
        return action()

    def entries(self, folder):
        return self._step("entries", folder, lambda: FolderTransport.entries(self, folder))

    def read(self, path):
        return self._step("read", path, lambda: FolderTransport.read(self, path))

    def write(self, path, data):
        half = data[: len(data) // 2]
        self._step(
            "write",
            path,
            lambda: FolderTransport.write(self, path, data),
            lambda: FolderTransport.write(self, path, half),
        )

    def rename(self, old, new):
        def act():
            if self.mode == "none":
                raise TransportFault("unsupported", "500 what?")
            if self.mode == "move" and (self._root / new).exists():
                raise TransportFault("denied", "550 exists")
            FolderTransport.rename(self, old, new)

        self._step("rename", old, act)

    def delete(self, path):
        self._step("delete", path, lambda: FolderTransport.delete(self, path))

    def make_folder(self, path):
        self._step("make_folder", path, lambda: FolderTransport.make_folder(self, path))

    def delete_folder(self, path):
        self._step("delete_folder", path, lambda: FolderTransport.delete_folder(self, path))
