"""What the speed contests of dem with its peers are asked on the command line. Standard library only."""

import argparse
import pathlib
import shutil


def parser(doc, peer, program, beds, pairs):
    """A parser that knows PROGRAM, FOLDER, BED ..., --PEER, --cores, --pairs and --prefix; `beds` is "*" or "+"."""
    found = argparse.ArgumentParser(description=doc.split("\n")[0])
    found.add_argument("program", help="the scree program")
    found.add_argument("folder", type=pathlib.Path, help="for beds, runs and tables")
    found.add_argument("beds", type=pathlib.Path, nargs=beds, metavar="BED")
    found.add_argument(f"--{peer}", default=program, dest="peer", metavar="PROGRAM", help=f"the program of {peer}")
    found.add_argument("--cores", type=lambda text: [int(n) for n in text.split(",")], default=[1, 2])
    found.add_argument("--pairs", type=int, default=pairs)
    found.add_argument("--prefix", default="", help="command put before what is timed")
    return found


def is_missing(program, package):
    """Says so when the peer is not there: the contest then ends with 77, skipped."""
    if shutil.which(program):
        return False
    print(f"{program} is not installed: skipped (Debian's {package} has it)")
    return True
