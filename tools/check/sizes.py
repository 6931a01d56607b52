"""The size rule: a header has at most 200 lines, any other source 400, a function 60. Small things can be read whole."""

import ast
import pathlib

import cpp_text
import repository

HEADER_LINES = 200
SOURCE_LINES = 400
FUNCTION_LINES = 60
HEADERS = {".hpp", ".h"}
SOURCES = {".cpp", ".py", ".sh", ".cmake", ".js", ".ts"}
ALSO_SOURCES = {"CMakeLists.txt", "dev"}


def rule(root):
    findings = []
    for name in repository.files(root):
        path = pathlib.PurePath(name)
        limit = _line_limit(path)
        if limit is None:
            continue
        text = repository.read(root, name)
        lines = len(text.splitlines())
        if lines > limit:
            findings.append(repository.Finding(name, lines, f"{lines} lines, at most {limit} are allowed: split the file."))
        findings += [
            repository.Finding(name, first, f"{function} has {last - first + 1} lines, at most {FUNCTION_LINES} are allowed: "
                               "split the function.")
            for function, first, last in _functions(path, text) if last - first + 1 > FUNCTION_LINES]
    return findings


def _line_limit(path):
    if path.suffix in HEADERS:
        return HEADER_LINES
    return SOURCE_LINES if path.suffix in SOURCES or path.name in ALSO_SOURCES else None


def _functions(path, text):
    if path.suffix in HEADERS or path.suffix == ".cpp":
        return cpp_text.functions(text)
    if path.suffix == ".py":
        return [(node.name, node.lineno, node.end_lineno) for node in ast.walk(ast.parse(text))
                if isinstance(node, (ast.FunctionDef, ast.AsyncFunctionDef))]
    return []


if __name__ == "__main__":
    repository.main(rule, __doc__)
