"""The documentation rule.

- A folder whose CMakeLists.txt adds a plugin has a README.md with a ```toml snippet (fixtures of tests are exempt).
- A folder below examples/ has a scene.toml and a README.md (but examples/support, which they share).
- A relative link in a Markdown file leads to a file or folder of the repository.
- A decision (docs/decisions/NNNN-*.md) has at most 40 lines.
"""

import pathlib
import re

import repository

DECISION_LINES = 40
_ADDS_PLUGIN = re.compile(r"^\s*scree_add_plugin\(", re.MULTILINE)
_LINK = re.compile(r"!?\[[^\]\n]*\]\(\s*<?([^)\s>]+)>?(?:\s+\"[^\"]*\")?\s*\)")
_CODE = re.compile(r"^(```|~~~).*?^\1|`[^`\n]*`", re.MULTILINE | re.DOTALL)


def rule(root):
    names = repository.files(root)
    return _plugins(root, names) + _examples(names) + _links(root, names) + _decisions(root, names)


def _plugins(root, names):
    findings = []
    for name in names:
        path = pathlib.PurePath(name)
        if path.name != "CMakeLists.txt" or "tests" in path.parts or not _ADDS_PLUGIN.search(repository.read(root, name)):
            continue
        readme = str(path.parent / "README.md")
        if readme not in names:
            findings.append(repository.Finding(name, 1, f"the plugin has no {readme}: say its equation, source and parameters."))
        elif "```toml" not in repository.read(root, readme):
            findings.append(repository.Finding(readme, 1, "there is no ```toml snippet: show how a scene uses the plugin."))
    return findings


def _examples(names):
    folders = sorted({pathlib.PurePath(n).parts[1] for n in names if n.startswith("examples/") and n.count("/") > 1}
                     - {"support"})
    return [repository.Finding(f"examples/{folder}", 1, f"the example has no {needed}.")
            for folder in folders for needed in ("scene.toml", "README.md") if f"examples/{folder}/{needed}" not in names]


def _links(root, names):
    findings = []
    for name in names:
        if not name.endswith(".md"):
            continue
        text = _CODE.sub(lambda m: re.sub(r"[^\n]", " ", m.group()), repository.read(root, name))
        for match in _LINK.finditer(text):
            target = match.group(1).split("#")[0]
            if not target or re.match(r"[a-z]+:", target):
                continue
            path = (root / name).parent / target
            if target.startswith("/") or not path.exists():
                line = text.count("\n", 0, match.start()) + 1
                findings.append(repository.Finding(name, line, f"the link to {match.group(1)} leads nowhere."))
    return findings


def _decisions(root, names):
    findings = []
    for name in names:
        if re.fullmatch(r"docs/decisions/\d{4}-.*\.md", name):
            lines = len(repository.read(root, name).splitlines())
            if lines > DECISION_LINES:
                findings.append(repository.Finding(name, lines, f"{lines} lines, a decision has at most {DECISION_LINES}."))
    return findings


if __name__ == "__main__":
    repository.main(rule, __doc__)
