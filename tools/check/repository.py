"""What every rule shares: the files of the repository, a finding, and the main function of a rule."""

import argparse
import pathlib
import subprocess
import sys
from dataclasses import dataclass

ROOT = pathlib.Path(__file__).resolve().parents[2]


@dataclass(frozen=True)
class Finding:
    """One place that a rule refuses, and the sentence that says why."""

    path: str
    line: int
    sentence: str

    def __str__(self):
        return f"{self.path}:{self.line}: {self.sentence}"


def files(root):
    """Paths, relative to root, that are tracked or could be: whatever git does not ignore; all files without git."""
    listed = subprocess.run(
        ["git", "-C", str(root), "ls-files", "--cached", "--others", "--exclude-standard"],
        capture_output=True, text=True, check=False)
    if listed.returncode == 0:
        names = listed.stdout.splitlines()
    else:
        names = [str(p.relative_to(root)) for p in root.rglob("*") if p.relative_to(root).parts[0] not in ("build", "results")]
    return sorted(name for name in set(names) if (root / name).is_file())


def read(root, name):
    return (root / name).read_text(encoding="utf-8", errors="replace")


def main(rule, description):
    """Runs rule(root) -> list of Finding, prints what it found, and ends with 1 if there was anything."""
    parser = argparse.ArgumentParser(description=description)
    parser.add_argument("root", nargs="?", default=ROOT, type=pathlib.Path, help="folder of the repository")
    findings = rule(parser.parse_args().root)
    for finding in findings:
        print(finding)
    sys.exit(1 if findings else 0)


if __name__ == "__main__":
    # repository.py .SUFFIX...: the files with these endings, one a line, for tools that take a list.
    print("\n".join(name for name in files(ROOT) if name.endswith(tuple(sys.argv[1:]))))
