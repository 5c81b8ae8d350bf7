"""Files of a controller's volumes: paths are `HOME/folder/file`."""

from rapidgen.client.rws.core import RwsCore
from rapidgen.client.rws.effects import Flow
from rapidgen.client.rws.flows.request import ask
from rapidgen.client.rws.model import FileInfo
from rapidgen.wire.rws import operations as ops
from rapidgen.wire.rws.bodies import Generation


def volume(core: RwsCore, path: str) -> str:
    """Return a path in the controller's spelling.

    `$HOME/a` in RWS 1.0, `HOME/a` in 2.0.
    """
    bare = path.strip("/").removeprefix("$")
    return f"${bare}" if core.generation is Generation.ONE else bare


def list_files(core: RwsCore, path: str = "HOME") -> Flow[tuple[FileInfo, ...]]:
    """List the entries of a folder."""
    body, _ = yield from ask(core, ops.READ_FILE, {"path": volume(core, path)})
    return tuple(
        FileInfo(i.title, i.kind != "fs-file", i.whole("fs-size"))
        for i in body.all("fs-file", "fs-dir")
    )


def read_file(core: RwsCore, path: str) -> Flow[bytes]:
    """Return the content of a file."""
    _, response = yield from ask(core, ops.READ_FILE, {"path": volume(core, path)})
    return response.body


def write_file(core: RwsCore, path: str, data: bytes) -> Flow[bool]:
    """Write a whole file; return True if it is new."""
    _, response = yield from ask(core, ops.WRITE_FILE, {"path": volume(core, path)}, data=data)
    return response.status == 201


def delete_file(core: RwsCore, path: str) -> Flow[bool]:
    """Delete a file, or a folder with its content; False if it is missing."""
    _, response = yield from ask(
        core, ops.DELETE_FILE, {"path": volume(core, path)}, accepted=(404,)
    )
    return response.status != 404


def make_folder(core: RwsCore, path: str) -> Flow[None]:
    """Create a folder in an existing one."""
    parent, _, name = path.strip("/").rpartition("/")
    yield from _act(core, ops.CREATE_FOLDER, "create", parent, name)


def copy_file(core: RwsCore, path: str, name: str) -> Flow[None]:
    """Copy a file to another name in its folder."""
    yield from _act(core, ops.COPY_FILE, "copy", path, name)


def rename_file(core: RwsCore, path: str, name: str) -> Flow[None]:
    """Rename a file in its folder."""
    yield from _act(core, ops.RENAME_FILE, "rename", path, name)


def _act(core: RwsCore, two: ops.RwsOperation, action: str, path: str, name: str) -> Flow[None]:
    form = {"fs-newname": name}
    operation = two
    if core.generation is Generation.ONE:
        operation, form = ops.FILE_ACTION, {"fs-action": action, **form}
    yield from ask(core, operation, {"path": volume(core, path)}, form)
