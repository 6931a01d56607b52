"""C++ as text: enough of a reader to find declarations and function bodies without compiling anything."""

import re
from dataclasses import dataclass, field

_PIECES = re.compile(
    r"""(?P<comment>//[^\n]*|/\*.*?\*/)
      | (?P<raw>R"(?P<mark>[^\s()\\]{0,16})\(.*?\)(?P=mark)")
      | (?P<string>"(?:\\.|[^"\\\n])*")
      | (?P<number>\b\d[\w.']*)
      | (?P<char>'(?:\\.|[^'\\\n])+')
      | (?P<directive>^[ \t]*\#(?:[^\n\\]|\\.|\\\n)*)""",
    re.VERBOSE | re.DOTALL | re.MULTILINE)
_OPENS_SCOPE = re.compile(r"(?:^|[\s;])(?:namespace|class|struct|union|enum|extern)\b(?![^{]*\))|^\s*(?:namespace|extern)\b")


def blank(piece):
    """The same number of characters and lines, all of them space."""
    return re.sub(r"[^\n]", " ", piece)


def without_comments(text):
    """The text with comments, strings, characters and preprocessor lines blanked; offsets and lines stay."""
    return _PIECES.sub(lambda m: m.group() if m.group("number") else blank(m.group()), text)


def line_of(text, offset):
    return text.count("\n", 0, offset) + 1


@dataclass
class Scope:
    """What an open brace stands for: `scope` (namespace, class), `function`, `value`, or `inner` (inside of those two)."""

    kind: str
    head: str
    begin: int
    public: bool = True


@dataclass
class Declaration:
    """A statement of a namespace or class: its text, its lines, the first lines of the classes around it."""

    text: str
    first: int
    last: int
    public: bool
    scope_lines: list = field(default_factory=list)


def functions(text):
    """(name, first line, last line) of each function definition that is not inside another function."""
    return [(_name(d.text), d.first, d.last) for d in _statements(text) if d.text.endswith("}")]


def declarations(text):
    """Every declaration that is not inside a function; function definitions without their bodies."""
    result = []
    for statement in _statements(text):
        if statement.text.endswith("}"):
            statement.text = statement.text[:-1]
            statement.last = statement.first + statement.text.count("\n")
        result.append(statement)
    return result


def _statements(text):
    """Declarations; the text of a function definition is its head and a closing brace."""
    code = without_comments(text)
    found, scopes, start = [], [], 0
    for match in re.finditer(r"[{};]|\b(?:public|private|protected)\s*:(?!:)", code):
        outside = all(s.kind == "scope" for s in scopes)
        token = match.group()
        if token == "{":
            head = code[start:match.start()]
            kind = _kind(head) if outside else "inner"
            scopes.append(Scope(kind, head, start, not head.strip().startswith("class")))
            if kind == "scope":
                start = match.end()
        elif token == "}" and scopes:
            closed = scopes.pop()
            if closed.kind == "function":
                found.append(_declaration(code, closed.begin, closed.head + "}", match.start(), scopes))
            if closed.kind in ("scope", "function"):
                start = match.end()
        elif outside and token == ";":
            if code[start:match.start()].strip():
                found.append(_declaration(code, start, code[start:match.end()], match.start(), scopes))
            start = match.end()
        elif outside and token.endswith(":"):
            scopes[-1].public = token.startswith("public")
            start = match.end()
    return found


def _declaration(code, start, words, end, scopes):
    first = line_of(code, start + len(words) - len(words.lstrip()))
    heads = [line_of(code, s.begin + len(s.head) - len(s.head.lstrip())) for s in scopes if "namespace" not in s.head]
    return Declaration(words.strip(), first, line_of(code, end), all(s.public for s in scopes), heads)


def _kind(head):
    """What a brace after this head opens, outside functions: another scope, a function, or a value."""
    head = re.sub(r"\balignas\s*\([^()]*\)|\[\[.*?\]\]|__attribute__\s*\(\(.*?\)\)", " ", head)
    if _OPENS_SCOPE.search(head):
        return "scope"
    return "function" if "(" in head or not head.strip() or head.lstrip().startswith(",") else "value"


def _name(head):
    match = re.search(r"(?P<test>TEST\w*\s*\([^()]*\))|(?P<name>[A-Za-z_~][\w:~]*)\s*\(", head)
    return (match.group("test") or match.group("name")) if match else "a function"
