"""Reads arrays out of the VTP files that the vtk observer writes (binary appended, zlib). Standard library only."""

import re
import struct
import zlib
from array import array

CODES = {"Float64": "d", "Float32": "f"}


def read_arrays(path, names):
    """The named floating-point arrays of a file, flat, by name."""
    raw = path.read_bytes()
    start = raw.index(b'<AppendedData encoding="raw">')
    header, data = raw[:start].decode(), raw.index(b"_", start) + 1
    found = {}
    for tag in re.findall(r"<DataArray [^>]*>", header):
        fields = dict(re.findall(r'(\w+)="([^"]*)"', tag))
        if fields.get("Name") in names:
            found[fields["Name"]] = array(CODES[fields["type"]], inflate(raw, data + int(fields["offset"])))
    return found


def inflate(raw, at):
    """One array: number of blocks, their size, size of the last, compressed sizes, blocks."""
    blocks = struct.unpack_from("<Q", raw, at)[0]
    sizes = struct.unpack_from(f"<{blocks}Q", raw, at + 24)
    at += 24 + 8 * blocks
    whole = b""
    for size in sizes:
        whole += zlib.decompress(raw[at:at + size])
        at += size
    return whole
