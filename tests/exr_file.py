# SPDX-License-Identifier: BSD-3-Clause
"""Reads the OpenEXR files that metamer writes (scan lines, ZIP or none, half and float), without any library, so that
the tests do not trust the reader they test. Layout: openexr.com, "OpenEXR File Layout"; ZIP: bytes split into even
and odd halves, then differences of neighbors, then deflate."""
import array
import itertools
import struct
import sys
import zlib

MAGIC = 20000630
HALF, FLOAT = 1, 2


def _text(data, at):
    end = data.index(b"\0", at)
    return data[at:end].decode(), end + 1


def _attributes(data):
    if struct.unpack_from("<I", data)[0] != MAGIC:
        raise ValueError("is no OpenEXR file")
    at, found = 8, {}
    while data[at] != 0:
        name, at = _text(data, at)
        kind, at = _text(data, at)
        (size,) = struct.unpack_from("<i", data, at)
        found[name] = (kind, data[at + 4 : at + 4 + size])
        at += 4 + size
    return found, at + 1


def _channels(bytes_):
    at, found = 0, []
    while bytes_[at] != 0:
        name, at = _text(bytes_, at)
        found.append((name, struct.unpack_from("<i", bytes_, at)[0]))
        at += 16
    return found


def _unzip(packed, size):
    if len(packed) == size:
        return packed
    split = zlib.decompress(packed)
    summed = bytes(itertools.accumulate(split, lambda a, b: (a + b - 128) & 255))
    half = (size + 1) // 2
    joined = bytearray(size)
    joined[0::2] = summed[:half]
    joined[1::2] = summed[half:]
    return bytes(joined)


def _row(bytes_, kind):
    if kind == HALF:
        return struct.unpack(f"<{len(bytes_) // 2}e", bytes_)
    row = array.array("f", bytes_)
    if sys.byteorder == "big":
        row.byteswap()
    return row


class Image:
    """width, height, texts (string attributes) and channels (name → array of floats, rows from the top)."""

    def __init__(self, path):
        with open(path, "rb") as stream:
            data = stream.read()
        attributes, at = _attributes(data)
        low_x, low_y, high_x, high_y = struct.unpack("<4i", attributes["dataWindow"][1])
        self.width, self.height = high_x - low_x + 1, high_y - low_y + 1
        self.texts = {name: value.decode() for name, (kind, value) in attributes.items() if kind == "string"}
        kinds = _channels(attributes["channels"][1])
        self.channels = {name: array.array("f") for name, _ in kinds}
        compression = attributes["compression"][1][0]
        rows_per_chunk = {0: 1, 2: 1, 3: 16}[compression]
        row_bytes = self.width * sum(2 if kind == HALF else 4 for _, kind in kinds)
        for chunk in range(-(-self.height // rows_per_chunk)):
            (offset,) = struct.unpack_from("<Q", data, at + 8 * chunk)
            y, size = struct.unpack_from("<2i", data, offset)
            rows = min(rows_per_chunk, high_y + 1 - y)
            chunk_bytes = _unzip(data[offset + 8 : offset + 8 + size], rows * row_bytes)
            self._take_rows(chunk_bytes, rows, kinds)

    def _take_rows(self, bytes_, rows, kinds):
        at = 0
        for _ in range(rows):
            for name, kind in kinds:
                size = self.width * (2 if kind == HALF else 4)
                self.channels[name].extend(_row(bytes_[at : at + size], kind))
                at += size
