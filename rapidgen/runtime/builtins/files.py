"""Files and folders.

Sources: S4 reference, pages Open to ReadBin [manual]: no mode switch means \\Write, \\Bin alone
reads and writes from the end, a line longer than 80 characters is read in pieces, the end of a file
is the string EOF, 9.999E36 or -1. \\Line, \\Status and the layout of WriteAnyBin are assumptions of
this project.
"""

import os
import struct
from collections.abc import Callable
from pathlib import Path
from typing import IO

from rapidgen._reading import read_foreign
from rapidgen.machine.files import CAPACITY as DISK
from rapidgen.machine.files import Directory, IODevice
from rapidgen.machine.scheduler import date_time
from rapidgen.rapid.numbers import MAX_STRING, single
from rapidgen.runtime.builtins.operator import appended
from rapidgen.runtime.errors import RapidError
from rapidgen.runtime.loading import file_path, hold, spend
from rapidgen.runtime.rawbytes import CAPACITY, RawBytes, byte_value, whole
from rapidgen.runtime.registry import builtin, builtins
from rapidgen.runtime.signals import target_of, value_of
from rapidgen.runtime.task.task import Task
from rapidgen.runtime.text import NotALiteral, parse_value
from rapidgen.runtime.values import NUM, Record, Ref, Type, Value, dimensions

_EOF_TEXT = "EOF"
_EOF_NUM = 9.999e36
_EOF_BIN = -1


# -- opening ------------------------------------------------------------------------------------


@builtin("Open", cost="socket")
def open_file(
    task: Task,
    object_: str,
    file: str | None,
    device: IODevice,
    read: bool | None,
    write: bool | None,
    append: bool | None,
    binary: bool | None,
) -> None:
    """Open a file."""
    path = file_path(task, object_, file or "")
    task.controller.files.release(device)
    if path.exists() and not path.is_file():
        raise RapidError("ERR_FILEOPEN", f"{object_} {file or ''} is no regular file")
    if read:
        mode = "rb"
    elif append:
        mode = "ab"
    elif not write and not binary and task.controller.dialect.open_default == "read":
        mode = "rb"
    elif write or not binary:
        mode = "wb"
    else:
        mode = "a+b"
    try:
        # The program closes it (or PP to main does): it outlives this call.
        opened = open(path, mode)  # noqa: SIM115
    except OSError as error:
        raise RapidError("ERR_FILEOPEN", f"{object_} {file or ''}: {error.strerror}") from error
    try:
        hold(task, device)
    except RapidError:
        opened.close()
        raise
    device.file = opened
    device.path = path
    device.binary = bool(binary)
    device.readable = opened.readable()
    device.writable = opened.writable()
    _stamp(task, path, written=device.writable)


@builtin("Close", cost="socket")
def close_file(task: Task, device: IODevice) -> None:
    """Close a file; do nothing if it is closed."""
    was_written = device.file is not None and device.writable
    task.controller.files.release(device)
    _stamp(task, device.path, written=was_written)


def _stamp(task: Task, path: Path, *, written: bool) -> None:
    """Set the time of a written file to the controller's time."""
    if written and task.scheduler.clock == "virtual" and path.exists():
        time = date_time(task.scheduler).timestamp()
        os.utime(path, (time, time))


def _opened(device: IODevice) -> IO[bytes]:
    if device.file is None:
        raise RapidError("ERR_FILEACC", "the file is not open")
    return device.file


def _reader(device: IODevice, *, binary: bool = False) -> IO[bytes]:
    file = _opened(device)
    if not device.readable or (binary and not device.binary):
        raise RapidError("ERR_FILEACC", "the file is not open for this kind of reading")
    return file


def _put(task: Task, device: IODevice, data: bytes, *, binary: bool = False) -> None:
    file = _opened(device)
    if not device.writable or (binary and not device.binary):
        raise RapidError("ERR_FILEACC", "the file is not open for this kind of writing")
    spend(task, len(data))
    try:
        file.write(data)
        file.flush()
    except OSError as error:
        raise RapidError("ERR_FILEACC", str(error.strerror)) from error


# -- writing ------------------------------------------------------------------------------------


@builtin("Write", cost="socket")
def write(task: Task, device: IODevice, text: str, *values: Value) -> None:
    """Write a text, a value in the standard format and a line feed."""
    *displayed, no_new_line = values
    line = appended(task, text, *displayed)
    _put(task, device, (line + ("" if no_new_line else "\n")).encode("latin-1"))


@builtin("WriteBin", cost="socket")
def write_bin(task: Task, device: IODevice, buffer: dict[int, float], count: float) -> None:
    """Write the first elements of an array as bytes."""
    number = whole(count, "ERR_ARGVALERR")
    if not 0 <= number <= len(buffer):
        raise RapidError("ERR_ARGVALERR", f"{number} of {len(buffer)} elements")
    data = bytes(byte_value(buffer[i]) for i in range(1, number + 1))
    _put(task, device, data, binary=True)


@builtin("WriteRawBytes", cost="socket")
def write_raw_bytes(task: Task, device: IODevice, raw: RawBytes, count: float | None) -> None:
    """Write valid bytes of a container."""
    number = len(raw.data) if count is None else whole(count, "ERR_ARGVALERR")
    if not 0 <= number <= len(raw.data):
        raise RapidError("ERR_ARGVALERR", f"{number} of {len(raw.data)} bytes")
    _put(task, device, bytes(raw.data[:number]), binary=True)


@builtin("WriteAnyBin", cost="socket")
def write_any_bin(task: Task, device: IODevice, argument: object) -> None:
    """Write a value of any type, to be read by ReadAnyBin."""
    value, kind = value_of(argument)
    body = _encoded(value, kind)
    label = _label(kind, dimensions(value)).encode("latin-1")
    _put(task, device, struct.pack("<BI", len(label), len(body)) + label + body, binary=True)


@builtin("ReadAnyBin", cost="socket")
def read_any_bin(_task: Task, device: IODevice, argument: object, _time: float | None) -> None:
    """Read a value written by WriteAnyBin.

    ERR_RANYBIN_CHK: the value has another type.
    """
    target = target_of(argument)
    file = _reader(device, binary=True)
    head = file.read(5)
    if len(head) < 5:
        raise RapidError("ERR_RANYBIN_EOF")
    label_size, body_size = struct.unpack("<BI", head)
    label, body = file.read(label_size), file.read(body_size)
    if len(label) + len(body) < label_size + body_size:
        raise RapidError("ERR_RANYBIN_EOF")
    if label.decode("latin-1") != _label(target.type, target.dims):
        raise RapidError("ERR_RANYBIN_CHK", f"the file has {label.decode('latin-1')}")
    value, _ = _decoded(body, 0, target.type, target.dims)
    target.set(value)


def _label(type_: Type, dims: tuple[int, ...]) -> str:
    return type_.name + "".join(f"{{{size}}}" for size in dims)


def _encoded(value: Value, type_: Type) -> bytes:
    if value.__class__ is dict:
        return b"".join(_encoded(part, type_) for part in value.values())
    if isinstance(value, Record):
        parts = zip(value.values(), value.rapid_type.components, strict=True)
        return b"".join(_encoded(part, kind) for part, (_, kind) in parts)
    if isinstance(value, str):
        return struct.pack("<B", len(value)) + value.encode("latin-1")
    if isinstance(value, bool):
        return bytes([value])
    return struct.pack("<d", value)


def _decoded(data: bytes, place: int, type_: Type, dims: tuple[int, ...]) -> tuple[Value, int]:
    if dims:
        array = {}
        for i in range(1, dims[0] + 1):
            array[i], place = _decoded(data, place, type_, dims[1:])
        return array, place
    if type_.kind == "record":
        parts = []
        for _, kind in type_.components:
            part, place = _decoded(data, place, kind, ())
            parts.append(part)
        assert type_.make is not None
        return type_.make(*parts), place
    if type_.kind == "string":
        end = place + 1 + data[place]
        return data[place + 1 : end].decode("latin-1"), end
    if type_.kind == "bool":
        return bool(data[place]), place + 1
    number = struct.unpack_from("<d", data, place)[0]
    return single(number) if type_.kind == "num" else number, place + 8


# -- reading ------------------------------------------------------------------------------------


def _line(file: IO[bytes], delimiters: bytes, *, skip: bool = False) -> str | None:
    """Read up to the next delimiter, at most 80 characters.

    Returns None at the end of the file.
    """
    text = bytearray()
    while len(text) < MAX_STRING:
        byte = file.read(1)
        if not byte:
            return text.decode("latin-1") if text else None
        if byte not in delimiters:
            text += byte
        elif text or not skip:
            return text.decode("latin-1")
    return text.decode("latin-1")


def _goes_on(file: IO[bytes], text: str, ends: bytes) -> bool:
    """Return True if the last text read is the beginning of a line."""
    if len(text) < MAX_STRING:
        return False
    following = file.read(1)
    file.seek(-len(following), 1)
    return bool(following) and following not in ends


@builtin("ReadStr", cost="socket")
def read_str(
    task: Task,
    device: IODevice,
    delimiters: str | None,
    remove_cr: bool | None,
    discard: bool | None,
    _time: float | None,
    line_number: float | None,
    status: Ref | None,
) -> str:
    """Return the next line, or the string EOF.

    `status` becomes REMAIN if a line of more than 80 characters goes on, else empty.
    """
    file = _reader(device)
    alone = task.controller.dialect.delimiters == "alone"
    ends = (delimiters + "\n" * (not alone) if delimiters else "\n").encode("latin-1")
    skipped: str | None = ""
    if line_number is not None:
        file.seek(0)
        for _ in range(1, whole(line_number, "ERR_ARGVALERR")):
            skipped = _line(file, ends)
    text = None if skipped is None else _line(file, ends, skip=bool(discard))
    if status is not None:
        status.set("REMAIN" if text is not None and _goes_on(file, text, ends) else "")
    if text is None:
        return _EOF_TEXT
    return text.rstrip("\r") if remove_cr else text


@builtin("ReadNum", cost="socket")
def read_num(_task: Task, device: IODevice, delimiters: str | None, _time: float | None) -> float:
    """Return the number on the next line, or 9.999E36 at the end."""
    ends = ("\n" + (delimiters or "")).encode("latin-1")
    text = _line(_reader(device), ends)
    if text is None:
        return single(_EOF_NUM)
    try:
        number: float = parse_value(text.strip(), NUM)
    except NotALiteral as error:
        raise RapidError("ERR_RCVDATA", f"'{text}' is no number") from error
    return number


@builtin("ReadStrBin", cost="socket")
def read_str_bin(_task: Task, device: IODevice, count: float, _time: float | None) -> str:
    """Return the next bytes as a string, or the string EOF."""
    number = whole(count, "ERR_ARGVALERR")
    if not 0 <= number <= MAX_STRING:
        raise RapidError("ERR_ARGVALERR", f"{number} characters")
    data = _reader(device, binary=True).read(number)
    return data.decode("latin-1") if data or not number else _EOF_TEXT


# -- the disk -----------------------------------------------------------------------------------


@builtin("RemoveDir", cost="socket")
def remove_dir(task: Task, path: str) -> None:
    """Remove an empty folder, except the root of a disk."""
    place = file_path(task, path)
    if place.parent == task.controller.files.folder:
        raise RapidError("ERR_FILEACC", f"{path} is a disk")
    _disk(place.rmdir, path)


@builtin("RenameFile", cost="socket")
def rename_file(task: Task, old: str, new: str) -> None:
    """Rename a file; ERR_FILEEXIST: the new name exists."""
    source, target = _pair(task, old, new)
    _disk(lambda: source.rename(target), old)


@builtin("CopyFile", cost="socket")
def copy_file(task: Task, old: str, new: str) -> None:
    """Copy a file; ERR_FILEEXIST: the new name exists."""
    source, target = _pair(task, old, new)
    try:
        data = read_foreign(source, task.controller.files.free_space)
        spend(task, len(data))
        target.write_bytes(data)
    except OSError as error:
        raise RapidError("ERR_FILEACC", f"{old}: {error.strerror}") from error
    _stamp(task, target, written=True)


def _pair(task: Task, old: str, new: str) -> tuple[Path, Path]:
    source, target = file_path(task, old), file_path(task, new)
    if not source.is_file():
        raise RapidError("ERR_FILEACC", f"there is no file {old}")
    if target.exists():
        raise RapidError("ERR_FILEEXIST", new)
    return source, target


def _disk(action: Callable[[], object], path: str) -> None:
    try:
        action()
    except OSError as error:
        raise RapidError("ERR_FILEACC", f"{path}: {error.strerror}") from error


@builtin("IsFile", cost="socket")
def is_file(
    task: Task,
    path: str,
    directory: bool | None,
    fifo: bool | None,
    regular: bool | None,
    block: bool | None,
    char: bool | None,
) -> bool:
    """Return True if a file exists, and has the given kind."""
    place = file_path(task, path)
    if directory:
        return place.is_dir()
    if regular:
        return place.is_file()
    if fifo or block or char:
        return False
    return place.exists()


@builtin("FSSize", cost="socket")
def fs_size(
    task: Task,
    name: str,
    total: bool | None,
    _free: bool | None,
    kilobytes: bool | None,
    megabytes: bool | None,
) -> float:
    """Return the size of a disk, or its free space."""
    file_path(task, name)
    size = DISK if total else task.controller.files.free_space
    return single(size / (1_048_576 if megabytes else 1024 if kilobytes else 1))


@builtin("FileTime", cost="socket")
def file_time(task: Task, path: str, *parts: Value) -> float:
    """Return the time of a file in seconds since 1970.

    A num has a resolution of 128 s today; \\StrDig has 1 s.
    """
    return single(file_time_dnum(task, path, *parts))


@builtin("FileTimeDnum", cost="socket")
def file_time_dnum(
    task: Task,
    path: str,
    _modify: bool | None,
    access: bool | None,
    status: bool | None,
    digits: Ref | None,
) -> int:
    """Return the time of a file in seconds since 1970."""
    result = _status(task, path)
    seconds = int(result.st_atime if access else result.st_ctime if status else result.st_mtime)
    if status and task.scheduler.clock == "virtual":
        # The operating system alone sets this one; a run has to be the same every time.
        seconds = int(result.st_mtime)
    if digits is not None:
        digits.set(str(seconds))
    return seconds


def _status(task: Task, path: str) -> os.stat_result:
    try:
        return file_path(task, path).stat()
    except OSError as error:
        raise RapidError("ERR_FILEACC", f"there is no file {path}") from error


@builtin("OpenDir", cost="socket")
def open_dir(task: Task, device: Directory, path: str) -> None:
    """Open a folder for ReadDir."""
    task.controller.files.release(device)
    place = file_path(task, path)
    if not place.is_dir():
        raise RapidError("ERR_FILEACC", f"there is no folder {path}")
    hold(task, device)
    try:
        names = sorted(os.listdir(place))
    except OSError as error:
        task.controller.files.release(device)
        raise RapidError("ERR_FILEACC", f"{path}: {error.strerror}") from error
    displayed = [name.encode("latin-1", "replace").decode("latin-1") for name in names]
    device.names = [".", "..", *displayed]


@builtin("ReadDir", cost="socket")
def read_dir(_task: Task, device: Directory, name: Ref) -> bool:
    """Return the next name, including `.` and `..`.

    Returns FALSE after the last one.
    """
    if device.names is None:
        raise RapidError("ERR_FILEACC", "the folder is not open")
    if not device.names:
        return False
    name.set(device.names.pop(0)[:MAX_STRING])
    return True


def _next_byte(device: IODevice) -> int:
    byte = _reader(device, binary=True).read(1)
    return byte[0] if byte else _EOF_BIN


def _refill(raw: RawBytes, device: IODevice) -> None:
    raw.data[:] = _reader(device, binary=True).read(CAPACITY)


# ClearIOBuff discards received data of a serial line. A file has none.
_FILES: dict[str, Callable[..., Value]] = {
    "Rewind": lambda _, device: _opened(device).seek(0),
    "ClearIOBuff": lambda _, device: _opened(device),
    "WriteStrBin": lambda t, device, text: _put(t, device, text.encode("latin-1"), binary=True),
    "ReadBin": lambda _, device, _time: _next_byte(device),
    "ReadRawBytes": lambda _, device, raw, _time: _refill(raw, device),
    "MakeDir": lambda task, path: _disk(file_path(task, path).mkdir, path),
    "RemoveFile": lambda task, path: _disk(file_path(task, path).unlink, path),
    "FileSize": lambda task, path: single(_status(task, path).st_size),
    "CloseDir": lambda task, device: task.controller.files.release(device),
}
builtins(_FILES, cost="socket")
