"""The units rule: a number in a public header says its unit, in square brackets.

It holds in core/scree/**/*.hpp (not in folders named `detail`) for

- every public data member and every constant whose type is double, float, Vec3 or Mat3, or a span, vector, array or
  optional of one: `double radius = 0.0;  ///< of the roll [m]`, with [1] for a pure number. The unit may also stand in the
  comment above the member, or above its struct, where it then holds for all members ([any unit] for Vec3 itself);
- every function declared in core/scree/interfaces that takes or returns such a type: its comment, or one that ends a
  line of its declaration, names at least one unit. Functions without an empty line between them share the comment above the first.
"""

import re

import cpp_text
import repository

_NUMBER = r"(?:double|float|Vec3|Mat3)"
_VALUE = rf"(?:{_NUMBER}|std::(?:span|vector|array|optional)<\s*(?:const\s+)?{_NUMBER}\b[^;()]*>)"
_MEMBER = re.compile(rf"^(?:(?:static|inline|constexpr|const|mutable)\s+)*{_VALUE}\s*[&*]?\s*(?!operator\b)([A-Za-z]\w*)\s*(?:[={{;,\[]|$)")
_UNIT = re.compile(r"\[[^\]\n]*[A-Za-z0-9%][^\]\n]*\]")
_FUNCTION = re.compile(r"([A-Za-z_]\w*|operator\S+)\s*\(")
_HAS_NUMBER = re.compile(rf"\b{_NUMBER}\b")


def rule(root):
    findings = []
    for name in repository.files(root):
        if name.startswith("core/scree/") and name.endswith(".hpp") and "/detail/" not in name:
            text = repository.read(root, name)
            findings += [repository.Finding(name, line, sentence)
                         for line, sentence in check(text, name.startswith("core/scree/interfaces/"))]
    return findings


def check(text, functions_too):
    """(line, sentence) for each declaration of a number without a unit."""
    lines = text.splitlines()
    found = []
    for statement in cpp_text.declarations(text):
        if not statement.public or any(_comment_has_unit(lines, first, first) for first in statement.scope_lines):
            continue
        words = " ".join(re.sub(r"\[\[\w+\]\]", "", statement.text).split())
        member = _MEMBER.match(words)
        if member and not member.group(1).endswith("_"):
            if not _comment_has_unit(lines, statement.first, statement.last):
                found.append((statement.first, f"{member.group(1)} has no unit: end its comment with one in square brackets, "
                              "[1] for a pure number."))
        elif functions_too and _is_function(words) and not _comment_has_unit(
                lines, _first_of_group(lines, statement.first), statement.last):
            name = _FUNCTION.search(words).group(1)
            found.append((statement.first, f"{name}() takes or returns a number, but its comment names no unit in square brackets."))
    return found


def _is_function(words):
    return bool(_FUNCTION.search(words) and _HAS_NUMBER.search(words)) and not words.startswith(("using ", "friend ", "return "))


def _first_of_group(lines, first):
    """The first line of the declarations that stand above line `first` without a gap or a comment between them."""
    while first > 1 and lines[first - 2].rstrip().endswith(";"):
        first -= 1
    return first


def _comment_has_unit(lines, first, last):
    """Whether the /// lines above line `first`, or the comments at the ends of the lines to `last`, name a unit."""
    comments = []
    above = first - 2
    while above >= 0 and lines[above].strip().startswith(("///", "template")):
        comments.append(lines[above])
        above -= 1
    for number in range(first - 1, min(last, len(lines))):
        comments.append(lines[number].partition("//")[2])
    below = last
    while below < len(lines) and lines[below].strip().startswith("///<"):
        comments.append(lines[below])
        below += 1
    return any(_UNIT.search(comment) for comment in comments)


if __name__ == "__main__":
    repository.main(rule, __doc__)
