"""Chunks of an MCAP file, found by its index or by scanning.

An interrupted recording has no index; everything up to its end is read. Whatever a file contains,
reading ends with a `RecordingDamaged` at worst: sizes are checked before unpacking, and data with a
wrong checksum is not used.
"""

import struct
import zlib
from collections import OrderedDict
from collections.abc import Iterator
from dataclasses import dataclass, field
from io import BytesIO
from typing import BinaryIO, Final, NamedTuple

import zstandard
from mcap.data_stream import ReadDataStream
from mcap.exceptions import McapError
from mcap.opcode import Opcode
from mcap.reader import SeekingReader
from mcap.records import Attachment, Chunk, Metadata

LARGEST_CHUNK: Final = 64 * 1024 * 1024
"""Largest unpacked chunk, bytes."""
LARGEST_SUMMARY: Final = 256 * 1024 * 1024
LARGEST_ATTACHMENT: Final = 256 * 1024 * 1024
MOST_ATTACHED: Final = 512 * 1024 * 1024
LARGEST_METADATA: Final = 1024 * 1024
"""Largest other part of a file, bytes."""
_KEPT = 16
"""Number of chunks that stay unpacked."""
_RECORD = struct.Struct("<BQ")
_MESSAGE = struct.Struct("<HIQQ")
_CHUNK_HEAD = struct.Struct("<QQQI")
_INDEX_HEAD = struct.Struct("<HI")
_FOOTER = struct.Struct("<BQQQI")
_MAGIC: Final = b"\x89MCAP0\r\n"
BROKEN: Final = (
    McapError,
    struct.error,
    zstandard.ZstdError,
    ValueError,
    KeyError,
    OverflowError,
    MemoryError,
    OSError,
)
"""Exceptions for an invalid file: impossible sizes, invalid text."""


class RecordingDamaged(Exception):
    """The file is not a recording, or a part is unreadable; see the text."""


@dataclass(frozen=True, slots=True)
class StoredChunk:
    """A chunk: its place, and the times (ns) of its messages."""

    offset: int
    begin: int
    end: int


@dataclass(slots=True, eq=False)
class Contents:
    """Index of a file, without the messages."""

    pieces: list[StoredChunk] = field(default_factory=list)
    channels: dict[int, str] = field(default_factory=dict)
    """Topics by number."""
    attachments: list[tuple[str, int, bytes]] = field(default_factory=list)
    """Name, time ns, data; in the order of the file."""
    metadata: dict[str, dict[str, str]] = field(default_factory=dict)
    cut: bool = False
    """True if the end is missing: data after the last whole record is lost."""


def look(stream: BinaryIO, size: int) -> Contents:
    """Read the index of a file.

    RecordingDamaged: it is not an MCAP file, or it was changed.
    """
    if stream.read(len(_MAGIC)) != _MAGIC:
        raise RecordingDamaged("it does not begin as an MCAP file does")
    stream.seek(max(0, size - len(_MAGIC)))
    if stream.read(len(_MAGIC)) != _MAGIC:
        return _scanned(stream, size)
    try:
        return _indexed(stream, size)
    except BROKEN as error:
        raise RecordingDamaged(
            f"its index cannot be read: {error or type(error).__name__}"
        ) from error


def _indexed(stream: BinaryIO, size: int) -> Contents:
    _check_summary(stream, size)
    stream.seek(0)
    summary = SeekingReader(stream, record_size_limit=LARGEST_SUMMARY).get_summary()
    if summary is None:
        raise RecordingDamaged("there is no index")
    result = Contents()
    for index in summary.chunk_indexes:
        offset = index.chunk_start_offset
        if not 0 < offset < size:
            raise RecordingDamaged("a chunk is not in the file")
        result.pieces.append(StoredChunk(offset, index.message_start_time, index.message_end_time))
    result.channels = {number: channel.topic for number, channel in summary.channels.items()}
    for place in summary.attachment_indexes:
        _take_attachment(result, _body(stream, place.offset, Opcode.ATTACHMENT, LARGEST_ATTACHMENT))
    for entry in summary.metadata_indexes:
        _take_metadata(result, _body(stream, entry.offset, Opcode.METADATA, LARGEST_METADATA))
    result.pieces.sort(key=lambda piece: (piece.begin, piece.offset))
    return result


def _check_summary(stream: BinaryIO, size: int) -> None:
    """Compare the checksum of summary and footer. Raises RecordingDamaged."""
    at = size - len(_MAGIC) - _FOOTER.size
    if at < len(_MAGIC):
        raise RecordingDamaged("there is no index")
    stream.seek(at)
    footer = stream.read(_FOOTER.size)
    opcode, length, start, _, checksum = _FOOTER.unpack(footer)
    if opcode != Opcode.FOOTER or length != _FOOTER.size - _RECORD.size:
        raise RecordingDamaged("there is no footer")
    if not len(_MAGIC) <= start <= at or at - start > LARGEST_SUMMARY:
        raise RecordingDamaged("its index has no place, or is too large")
    stream.seek(start)
    if zlib.crc32(footer[:-4], zlib.crc32(stream.read(at - start))) != checksum:
        raise RecordingDamaged("its index has been changed: its checksum is wrong")


def _body(stream: BinaryIO, offset: int, expected: Opcode, limit: int) -> bytes:
    """Return the content of a record at a position.

    RecordingDamaged: another one is there, or it is too large.
    """
    stream.seek(offset)
    opcode, length = _RECORD.unpack(stream.read(_RECORD.size))
    if opcode != expected:
        raise RecordingDamaged(f"{expected.name.lower()} is not where the index says")
    if length > limit:
        raise RecordingDamaged(f"{expected.name.lower()} of {length:,} bytes")
    data = stream.read(length)
    if len(data) != length:
        raise RecordingDamaged(f"{expected.name.lower()} is longer than the file")
    return data


def _take_attachment(result: Contents, body: bytes) -> None:
    if zlib.crc32(body[:-4]) != int.from_bytes(body[-4:], "little"):
        raise RecordingDamaged("an attachment has been changed: its checksum is wrong")
    one = Attachment.read(_stream(body))
    result.attachments.append((one.name, one.log_time, one.data))
    if sum(len(data) for _, _, data in result.attachments) > MOST_ATTACHED:
        raise RecordingDamaged(f"attachments of more than {MOST_ATTACHED:,} bytes")


def _take_metadata(result: Contents, body: bytes) -> None:
    one = Metadata.read(_stream(body))
    result.metadata[one.name] = one.metadata


def _stream(body: bytes) -> ReadDataStream:
    return ReadDataStream(BytesIO(body))


def _scanned(stream: BinaryIO, size: int) -> Contents:
    """Yield the whole records of an interrupted file.

    Only data with a checksum is used: times and channels are those inside the chunks.
    """
    result = Contents(cut=True)
    at = len(_MAGIC)
    while at + _RECORD.size <= size:
        stream.seek(at)
        opcode, length = _RECORD.unpack(stream.read(_RECORD.size))
        after = at + _RECORD.size + length
        if after > size:
            break
        try:
            if not _take(result, stream, opcode, at, length):
                break
        except (*BROKEN, RecordingDamaged):
            break
        at = after
    result.pieces.sort(key=lambda piece: (piece.begin, piece.offset))
    return result


def _take(result: Contents, stream: BinaryIO, opcode: int, at: int, length: int) -> bool:
    """Add the data of a record; False: not a data record.

    Raises RecordingDamaged.
    """
    match opcode:
        case Opcode.CHUNK:
            _take_chunk(result, stream, at)
        case Opcode.ATTACHMENT:
            _take_attachment(result, _body(stream, at, Opcode.ATTACHMENT, LARGEST_ATTACHMENT))
        case Opcode.METADATA:
            _take_metadata(result, _body(stream, at, Opcode.METADATA, LARGEST_METADATA))
        case Opcode.MESSAGE_INDEX:
            # A chunk with a changed opcode is not skipped.
            _, listed = _INDEX_HEAD.unpack(stream.read(_INDEX_HEAD.size))
            return bool(length == _INDEX_HEAD.size + listed)
        case Opcode.HEADER:
            return at == len(_MAGIC)
        case _:
            return False
    return True


def _take_chunk(result: Contents, stream: BinaryIO, at: int) -> None:
    data = _unpacked(stream, StoredChunk(at, 0, 0))
    times = []
    for opcode, begin, _ in _records(data):
        if opcode == Opcode.CHANNEL:
            number, _, length = struct.unpack_from("<HHI", data, begin)
            result.channels[number] = data[begin + 8 : begin + 8 + length].decode()
        elif opcode == Opcode.MESSAGE:
            times.append(_MESSAGE.unpack_from(data, begin)[2])
    if times:
        result.pieces.append(StoredChunk(at, min(times), max(times)))


def _unpacked(stream: BinaryIO, piece: StoredChunk) -> bytes:
    body = _body(stream, piece.offset, Opcode.CHUNK, LARGEST_CHUNK)
    _, _, size, _ = _CHUNK_HEAD.unpack_from(body)
    if size > LARGEST_CHUNK:
        raise RecordingDamaged(f"a chunk of {size} bytes")
    chunk = Chunk.read(_stream(body))
    match chunk.compression:
        case "":
            data: bytes = chunk.data
        case "zstd":
            text = zstandard.frame_content_size(chunk.data)
            if text != size:
                raise RecordingDamaged("a chunk has a wrong size")
            data = zstandard.ZstdDecompressor().decompress(chunk.data, max_output_size=size)
        case other:
            raise RecordingDamaged(f"compression {other!r} is not that of rapidgen's recordings")
    if zlib.crc32(data) != chunk.uncompressed_crc:
        raise RecordingDamaged("a chunk has been changed: its checksum is wrong")
    return data


def _records(data: bytes) -> Iterator[tuple[int, int, int]]:
    """Yield opcode, begin and end of each record."""
    at, size = 0, len(data)
    while at + _RECORD.size <= size:
        opcode, length = _RECORD.unpack_from(data, at)
        begin = at + _RECORD.size
        at = begin + length
        if at > size:
            raise RecordingDamaged("a record is longer than its chunk")
        yield opcode, begin, at


class StoredMessage(NamedTuple):
    """One encoded message."""

    time: int
    channel: int
    order: tuple[int, int]
    """Order of writing for messages with the same time."""
    data: bytes


class Chunks:
    """Messages of the chunks of a file, some of which stay unpacked."""

    def __init__(self, stream: BinaryIO) -> None:
        self._stream = stream
        self._kept: OrderedDict[int, tuple[StoredMessage, ...]] = OrderedDict()

    def messages(self, piece: StoredChunk) -> tuple[StoredMessage, ...]:
        """Yield messages in the order of their times.

        RecordingDamaged: a chunk cannot be read.
        """
        match = self._kept.get(piece.offset)
        if match is None:
            try:
                match = self._read(piece)
            except BROKEN as error:
                raise RecordingDamaged(str(error) or type(error).__name__) from error
            self._kept[piece.offset] = match
            if len(self._kept) > _KEPT:
                self._kept.popitem(last=False)
        else:
            self._kept.move_to_end(piece.offset)
        return match

    def _read(self, piece: StoredChunk) -> tuple[StoredMessage, ...]:
        data = _unpacked(self._stream, piece)
        result = []
        for opcode, begin, end in _records(data):
            if opcode == Opcode.MESSAGE:
                channel, _, time, _ = _MESSAGE.unpack_from(data, begin)
                body = data[begin + _MESSAGE.size : end]
                result.append(StoredMessage(time, channel, (piece.offset, begin), body))
        result.sort(key=lambda message: (message.time, message.order))
        return tuple(result)
