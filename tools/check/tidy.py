"""Runs clang-tidy on the C++ sources that changed, or on all of them, several at a time.

Changed is what differs from where the branch left origin/main (or main); on that branch itself, from the commit before; and
what is not committed yet. A changed header stands for the sources beside it that include it.
"""

import argparse
import concurrent.futures
import json
import pathlib
import re
import subprocess
import sys

import repository


def git(*arguments):
    """The lines that a git command prints; none when it fails."""
    done = subprocess.run(["git", "-C", str(repository.ROOT), *arguments], capture_output=True, text=True, check=False)
    return done.stdout.splitlines() if done.returncode == 0 else []


def base():
    """The commit that changes are counted from; empty when there is none."""
    head = git("rev-parse", "HEAD")
    for branch in ("origin/main", "main"):
        merge_base = git("merge-base", "HEAD", branch)
        if merge_base and merge_base != head:
            return merge_base[0]
    return (git("rev-parse", "--verify", "HEAD~1") or [""])[0]


def changed():
    """Names of the files that differ from base() or are not committed."""
    since = base()
    names = set(git("diff", "--name-only", since)) if since else set(repository.files(repository.ROOT))
    return names | set(git("ls-files", "--others", "--exclude-standard"))


def sources_of(names, compiled):
    """Those of the compiled sources that changed, or that include a changed header of their own folder."""
    chosen = {name for name in names if name in compiled}
    for header in (pathlib.PurePath(n) for n in names if n.endswith(".hpp")):
        beside = [s for s in compiled if pathlib.PurePath(s).parent == header.parent]
        including = re.compile(rf'#include "[^"]*\b{re.escape(header.name)}"')
        chosen |= {s for s in beside if including.search(repository.read(repository.ROOT, s))}
    return sorted(chosen)


def tidy(build, name):
    command = ["clang-tidy", "-p", str(build), "--quiet", "--extra-arg=-Wno-unknown-warning-option",
               "--extra-arg=-Wno-ignored-optimization-argument", str(repository.ROOT / name)]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    complaint = re.search(r"(warning|error): ", done.stdout) or (done.returncode != 0)
    return name, done.stdout + (done.stderr if done.returncode else "") if complaint else ""


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--all", action="store_true", help="every source, not only the changed ones")
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--build", type=pathlib.Path, default=repository.ROOT / "build/release")
    options = parser.parse_args()
    commands = json.loads((options.build / "compile_commands.json").read_text(encoding="utf-8"))
    compiled = {str(pathlib.Path(c["file"]).relative_to(repository.ROOT)) for c in commands
                if pathlib.Path(c["file"]).is_relative_to(repository.ROOT)}
    compiled = {c for c in compiled if not c.startswith("build/")}
    chosen = sorted(compiled) if options.all else sources_of(changed(), compiled)
    refused = 0
    with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
        for name, complaint in pool.map(lambda n: tidy(options.build, n), chosen):
            if complaint:
                refused += 1
                print(f"-- {name}\n{complaint}")
    print(f"clang-tidy: {len(chosen)} sources, {refused} refused")
    sys.exit(1 if refused else 0)


if __name__ == "__main__":
    main()
