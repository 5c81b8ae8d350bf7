"""The pieces of an MCAP file: found by its index, or one after the other where it has none.

A recording that was cut off has no index; everything up to the cut is read. Whatever a file
contains, reading ends with a `Damaged` at worst: sizes are looked at before anything is unpacked.
"""

import struct
import zlib
from collections import OrderedDict
from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import BinaryIO, Final, NamedTuple

import zstandard
from mcap.data_stream import ReadDataStream
from mcap.exceptions import McapError
from mcap.opcode import Opcode
from mcap.reader import SeekingReader
from mcap.records import Attachment, Channel, Chunk, Metadata

LARGEST_CHUNK: Final = 64 * 1024 * 1024
"""Bytes of a chunk, unpacked."""
_KEPT = 16
"""Chunks that stay unpacked."""
_RECORD = struct.Struct("<BQ")
_MESSAGE = struct.Struct("<HIQQ")
_CHUNK_HEAD = struct.Struct("<QQQI")
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
"""What a file that is none raises: lengths and places that no file has, other bytes than text."""


class Damaged(Exception):
    """The file is no recording, or a part of it cannot be read; the text says which."""


@dataclass(frozen=True, slots=True)
class StoredChunk:
    """A chunk: where it is, and the times (ns) of its messages."""

    offset: int
    begin: int
    end: int


@dataclass(slots=True, eq=False)
class Contents:
    """What a file has, without the messages."""

    pieces: list[StoredChunk] = field(default_factory=list)
    channels: dict[int, str] = field(default_factory=dict)
    """Topics by number."""
    attachments: list[tuple[str, int, bytes]] = field(default_factory=list)
    """Name, time ns, data; in the order of the file."""
    metadata: dict[str, dict[str, str]] = field(default_factory=dict)
    cut: str = ""
    """Why the file has no index: what comes behind its last whole record is lost."""


def look(stream: BinaryIO, size: int) -> Contents:
    """What is in a file. Damaged: it is no MCAP file."""
    if stream.read(len(_MAGIC)) != _MAGIC:
        raise Damaged("it does not begin as an MCAP file does")
    try:
        return _indexed(stream, size)
    except BROKEN as error:
        return _scanned(stream, size, str(error) or type(error).__name__)


def _indexed(stream: BinaryIO, size: int) -> Contents:
    stream.seek(0)
    reader = SeekingReader(stream, record_size_limit=size)
    summary = reader.get_summary()
    if summary is None:
        raise ValueError("there is no index")
    found = Contents()
    for index in summary.chunk_indexes:
        offset = index.chunk_start_offset
        if not 0 < offset < size:
            raise ValueError("a chunk is not in the file")
        found.pieces.append(StoredChunk(offset, index.message_start_time, index.message_end_time))
    found.channels = {number: channel.topic for number, channel in summary.channels.items()}
    found.attachments = [(a.name, a.log_time, a.data) for a in reader.iter_attachments()]
    found.metadata = {one.name: one.metadata for one in reader.iter_metadata()}
    found.pieces.sort(key=lambda piece: (piece.begin, piece.offset))
    return found


def _scanned(stream: BinaryIO, size: int, why: str) -> Contents:
    """Every whole record up to where the file ends or makes no sense."""
    found = Contents(cut=why)
    at = len(_MAGIC)
    while at + _RECORD.size <= size:
        stream.seek(at)
        opcode, length = _RECORD.unpack(stream.read(_RECORD.size))
        behind = at + _RECORD.size + length
        if behind > size or opcode in (0, Opcode.DATA_END, Opcode.FOOTER):
            break
        try:
            _take(found, stream, opcode, at)
        except BROKEN:
            break
        at = behind
    if not found.channels:
        _channels_inside(found, stream)
    found.pieces.sort(key=lambda piece: (piece.begin, piece.offset))
    return found


def _take(found: Contents, stream: BinaryIO, opcode: int, at: int) -> None:
    if opcode == Opcode.CHUNK:
        begin, end, *_ = _CHUNK_HEAD.unpack(stream.read(_CHUNK_HEAD.size))
        found.pieces.append(StoredChunk(at, begin, end))
    elif opcode == Opcode.CHANNEL:
        channel = Channel.read(ReadDataStream(stream))
        found.channels[channel.id] = channel.topic
    elif opcode == Opcode.ATTACHMENT:
        one = Attachment.read(ReadDataStream(stream))
        found.attachments.append((one.name, one.log_time, one.data))
    elif opcode == Opcode.METADATA:
        known = Metadata.read(ReadDataStream(stream))
        found.metadata[known.name] = known.metadata


def _channels_inside(found: Contents, stream: BinaryIO) -> None:
    """Without an index channels are told in the chunks alone, each before its first message."""
    whole = []
    for piece in found.pieces:
        try:
            data = _unpacked(stream, piece)
            for opcode, begin, _ in _records(data):
                if opcode == Opcode.CHANNEL:
                    number, _, length = struct.unpack_from("<HHI", data, begin)
                    found.channels[number] = data[begin + 8 : begin + 8 + length].decode()
                elif opcode == Opcode.MESSAGE:
                    break
        except (*BROKEN, Damaged):
            continue
        whole.append(piece)
    found.pieces = whole


def _unpacked(stream: BinaryIO, piece: StoredChunk) -> bytes:
    stream.seek(piece.offset)
    head = stream.read(_RECORD.size + _CHUNK_HEAD.size)
    opcode, _ = _RECORD.unpack_from(head)
    if opcode != Opcode.CHUNK:
        raise Damaged("a chunk is not where the index says")
    _, _, size, _ = _CHUNK_HEAD.unpack_from(head, _RECORD.size)
    if size > LARGEST_CHUNK:
        raise Damaged(f"a chunk of {size} bytes")
    stream.seek(piece.offset + _RECORD.size)
    chunk = Chunk.read(ReadDataStream(stream))
    match chunk.compression:
        case "":
            data: bytes = chunk.data
        case "zstd":
            told = zstandard.frame_content_size(chunk.data)
            if told != size:
                raise Damaged("a chunk is not as large as it says")
            data = zstandard.ZstdDecompressor().decompress(chunk.data, max_output_size=size)
        case other:
            raise Damaged(f"compression {other!r} is not that of rapidgen's recordings")
    if chunk.uncompressed_crc and zlib.crc32(data) != chunk.uncompressed_crc:
        raise Damaged("a chunk has been changed: its checksum is wrong")
    return data


def _records(data: bytes) -> Iterator[tuple[int, int, int]]:
    """Opcode, begin and end of each record."""
    at, size = 0, len(data)
    while at + _RECORD.size <= size:
        opcode, length = _RECORD.unpack_from(data, at)
        begin = at + _RECORD.size
        at = begin + length
        if at > size:
            raise Damaged("a record is longer than its chunk")
        yield opcode, begin, at


class StoredMessage(NamedTuple):
    """One message, not yet decoded."""

    time: int
    channel: int
    order: tuple[int, int]
    """Of two messages at one time the one that was written first."""
    data: bytes


class Chunks:
    """Messages of the pieces of a file, which stay unpacked for a while."""

    def __init__(self, stream: BinaryIO) -> None:
        self._stream = stream
        self._kept: OrderedDict[int, tuple[StoredMessage, ...]] = OrderedDict()

    def messages(self, piece: StoredChunk) -> tuple[StoredMessage, ...]:
        """In the order of their times. Damaged: the piece cannot be read."""
        found = self._kept.get(piece.offset)
        if found is None:
            try:
                found = self._read(piece)
            except BROKEN as error:
                raise Damaged(str(error) or type(error).__name__) from error
            self._kept[piece.offset] = found
            if len(self._kept) > _KEPT:
                self._kept.popitem(last=False)
        else:
            self._kept.move_to_end(piece.offset)
        return found

    def _read(self, piece: StoredChunk) -> tuple[StoredMessage, ...]:
        data = _unpacked(self._stream, piece)
        found = []
        for opcode, begin, end in _records(data):
            if opcode == Opcode.MESSAGE:
                channel, _, time, _ = _MESSAGE.unpack_from(data, begin)
                body = data[begin + _MESSAGE.size : end]
                found.append(StoredMessage(time, channel, (piece.offset, begin), body))
        found.sort(key=lambda message: (message.time, message.order))
        return tuple(found)
