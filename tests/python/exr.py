"""Uncompressed scanline OpenEXR of float32 and float16 channels: as much as tests exchange with the command."""
import struct

import numpy as np

_TYPES = {1: np.dtype("<f2"), 2: np.dtype("<f4")}


def write(path, channels):
    """channels: (height, width) arrays by name."""
    channels = dict(sorted(channels.items()))
    height, width = next(iter(channels.values())).shape
    kinds = {np.dtype(np.float16): 1, np.dtype(np.float32): 2}
    listed = b"".join(name.encode() + b"\0" + struct.pack("<iiii", kinds[values.dtype], 0, 1, 1)
                      for name, values in channels.items()) + b"\0"
    window = struct.pack("<iiii", 0, 0, width - 1, height - 1)
    header = struct.pack("<ii", 20000630, 2)
    for name, kind, value in (("channels", "chlist", listed), ("compression", "compression", b"\0"),
                              ("dataWindow", "box2i", window), ("displayWindow", "box2i", window),
                              ("lineOrder", "lineOrder", b"\0"), ("pixelAspectRatio", "float", struct.pack("<f", 1)),
                              ("screenWindowCenter", "v2f", struct.pack("<ff", 0, 0)),
                              ("screenWindowWidth", "float", struct.pack("<f", 1))):
        header += name.encode() + b"\0" + kind.encode() + b"\0" + struct.pack("<i", len(value)) + value
    header += b"\0"
    rows = [b"".join(values[y].astype(values.dtype.newbyteorder("<")).tobytes() for values in channels.values())
            for y in range(height)]
    first = len(header) + 8 * height
    with open(path, "wb") as file:
        file.write(header)
        file.write(struct.pack(f"<{height}Q", *(first + y * (8 + len(rows[0])) for y in range(height))))
        for y, row in enumerate(rows):
            file.write(struct.pack("<ii", y, len(row)) + row)


def read(path):
    """(height, width) arrays by channel."""
    with open(path, "rb") as file:
        data = file.read()

    def text(at):
        end = data.index(b"\0", at)
        return data[at:end].decode(), end + 1

    at, attributes = 8, {}
    while data[at]:
        name, at = text(at)
        _, at = text(at)
        size, = struct.unpack_from("<i", data, at)
        attributes[name] = data[at + 4:at + 4 + size]
        at += 4 + size
    assert attributes["compression"] == b"\0", "the file is compressed"
    listed, place, names = attributes["channels"], 0, []
    while listed[place]:
        end = listed.index(b"\0", place)
        names.append((listed[place:end].decode(), _TYPES[struct.unpack_from("<i", listed, end + 1)[0]]))
        place = end + 17
    left, top, right, bottom = struct.unpack("<iiii", attributes["dataWindow"])
    width, height = right - left + 1, bottom - top + 1
    found = {name: np.empty((height, width), kind.newbyteorder("=")) for name, kind in names}
    for offset in struct.unpack_from(f"<{height}Q", data, at + 1):
        y, _ = struct.unpack_from("<ii", data, offset)
        place = offset + 8
        for name, kind in names:
            found[name][y - top] = np.frombuffer(data, kind, width, place)
            place += width * kind.itemsize
    return found
