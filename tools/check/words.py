"""The words rule: nothing in the repository leans on one person's machine or on papers that are not in it."""

import re

import repository

REFUSED = [
    (re.compile(r"(?<![\w.$}~-])/(?:work|home|Users)/\w"), "a path of one machine; use a path relative to the repository."),
    (re.compile(r"\.\./shared\b"), "a path outside the repository; bring the file in or cite its source."),
    (re.compile(r"\b(?:DESIGN|PHYSICS|STYLE|PEERS)(?:\.md| sections?\b|'s?\b)"),
     "a document that is not in the repository; cite docs/, or the paper and its equation."),
    (re.compile(r"^(?:<{7}|>{7}) "), "a mark that a merge left; choose a side."),
    (re.compile(r"\bCo-authored-by:", re.IGNORECASE), "authors stand in LICENSE, not in files."),
]
THIS_RULE = ("tools/check/words.py", "tools/check/rules_test.py")


def rule(root):
    findings = []
    for name in repository.files(root):
        if name in THIS_RULE or (root / name).stat().st_size > 1_000_000:
            continue
        for number, line in enumerate(repository.read(root, name).splitlines(), 1):
            findings += [repository.Finding(name, number, f'"{match.group()}" is {why}')
                         for pattern, why in REFUSED for match in pattern.finditer(line)]
    return findings


if __name__ == "__main__":
    repository.main(rule, __doc__)
