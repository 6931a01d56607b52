"""Plugins run no code of their own while they are opened: the section .init_array of each holds one entry, the tool chain's.

A library whose headers include <iostream> (FCL) brings one more, which makes the standard streams ready and does nothing else: that is
looked for in its instructions and let pass.

usage: static_initialisers.py PLUGIN_FOLDER CONTROL.so
CONTROL is a plugin that has a static initialiser; the test must notice it.
"""

import pathlib
import re
import subprocess
import sys

POINTER = 8  # bytes of an entry
STREAMS = {"_ZNSt8ios_base4InitC1Ev", "__cxa_atexit"}


def output(*command):
    return subprocess.run(command, check=True, capture_output=True, text=True).stdout


def stream_initialisers(library):
    """Number of initialisers of `library` that call nothing but what makes the standard streams ready."""
    parts = re.split(r"^[0-9a-f]+ <(\S+)>:$", output("objdump", "--disassemble", "--no-show-raw-insn", library), flags=re.MULTILINE)
    count = 0
    for name, code in zip(parts[1::2], parts[2::2]):
        if name.startswith("_GLOBAL__sub_I_"):
            calls = set(re.findall(r"\b(?:call|jmp)\s+[0-9a-f]+ <([^@$+>]+)", code))
            count += calls == STREAMS
    return count


def initialisers(library):
    """Number of functions of its own that opening `library` runs, beyond the tool chain's frame_dummy."""
    sections = output("readelf", "--section-headers", "--wide", library)
    sizes = {name: int(size, 16) for name, size in re.findall(r"\] (\.\S+) +\S+ +[0-9a-f]+ [0-9a-f]+ ([0-9a-f]+)", sections)}
    found = sizes.get(".init_array", 0) // POINTER + sizes.get(".ctors", 0) // POINTER - 1
    return found - stream_initialisers(library) if found else 0


def main():
    folder, control = pathlib.Path(sys.argv[1]), sys.argv[2]
    if initialisers(control) != 1:
        sys.exit(f"{control}: has one static initialiser, found {initialisers(control)}; this test sees nothing")
    libraries = sorted(folder.glob("*.so"))
    if not libraries:
        sys.exit(f"{folder}: holds no plugin")
    guilty = [library.name for library in libraries if initialisers(library) != 0]
    if guilty:
        sys.exit("these plugins run code while they are opened (a global std::string, std::map?): " + ", ".join(guilty))
    print(f"{len(libraries)} plugins without static initialisers")


main()
