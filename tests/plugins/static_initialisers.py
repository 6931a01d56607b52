"""Plugins run no code while they are opened: the section .init_array of each holds one entry, the tool chain's own.

usage: static_initialisers.py PLUGIN_FOLDER CONTROL.so
CONTROL is a plugin that has a static initialiser; the test must notice it.
"""

import pathlib
import re
import subprocess
import sys

POINTER = 8  # bytes of an entry


def initialisers(library):
    """Number of functions that opening `library` runs, beyond the tool chain's frame_dummy."""
    sections = subprocess.run(["readelf", "--section-headers", "--wide", library], check=True, capture_output=True, text=True).stdout
    sizes = {name: int(size, 16) for name, size in re.findall(r"\] (\.\S+) +\S+ +[0-9a-f]+ [0-9a-f]+ ([0-9a-f]+)", sections)}
    return sizes.get(".init_array", 0) // POINTER + sizes.get(".ctors", 0) // POINTER - 1


def main():
    folder, control = pathlib.Path(sys.argv[1]), sys.argv[2]
    if initialisers(control) != 1:
        sys.exit(f"{control}: has one static initialiser, found {initialisers(control)}; this test sees nothing")
    libraries = sorted(folder.glob("*.so"))
    if not libraries:
        sys.exit(f"{folder}: holds no plugin")
    guilty = [library.name for library in libraries if initialisers(library) != 0]
    if guilty:
        sys.exit("these plugins run code while they are opened (a global std::string, std::map, <iostream>?): " + ", ".join(guilty))
    print(f"{len(libraries)} plugins without static initialisers")


main()
