"""The reference of scene files, docs/how-to/scene_file.md, made from what the program says of itself.

    scene_reference.py PROGRAM PAGE           ends with 1 when the page differs from what `PROGRAM schema` says (a test runs this)
    scene_reference.py PROGRAM PAGE --write   writes the page
"""

import json
import pathlib
import re
import subprocess
import sys

HEAD = """# The scene file, key by key

Made by `tools/docs/scene_reference.py` from `scree schema`: every table of a scene, every type it can have, every setting. The same is
printed by `scree plugins show KIND:NAME` for one plugin, and `scree schema > scene.schema.json` lets an editor complete and check scenes.

- A number is SI; a string carries its unit: `0.003` or `"3 mm"`. The unit in a row is what the number means and the string must have.
- *required* stands where a setting has no default. A dash: left out, the setting has no effect.
- Where a value is a table of some type, the type alone is one with all its defaults: `shape = "sphere"`, unless something in it is *required*.
- `[[name]]` may be there several times; `[name.NAME]` is referred to by its NAME; `[name]` is there once.
- `include = "other.toml"` builds on another scene; what is said here replaces what it says. How scenes are run:
  [run a scene](run_a_scene.md).
"""


UNIT = re.compile(r' \[([^\]"]*)\]"')  # at the end of a description


def words(values):
    return ", ".join(f"`{json.dumps(value)}`" for value in values)


def kind_of(schema):
    """In words, what a value must be."""
    if "enum" in schema:
        return words(schema["enum"])
    if "anyOf" in schema:
        return choice_of(schema["anyOf"])
    kind = schema.get("type")
    if kind == "array":
        least, most = schema.get("minItems"), schema.get("maxItems")
        count = f"{least} of: " if least is not None and least == most else "list of: "
        return count + kind_of(schema["items"])
    if kind == "object":
        return "table" if "properties" in schema else "table, NAME = value"
    if kind == "number":
        return "number" + limits(schema)
    if kind == "integer":
        return "integer" + limits(schema)
    return {"string": "text", "boolean": "`true` or `false`"}.get(kind, "any")


def choice_of(choices):
    """What a number or a text with a unit, a table with a `type`, or one of several forms is called."""
    if [c.get("type") for c in choices] == ["number", "string"]:
        return kind_of(choices[0])
    types = [c["title"] for c in choices if c.get("type") == "object" and "title" in c]
    forms = ["a table of type " + words(types)] if types else []
    forms += [kind_of(c) for c in choices if "title" not in c and "enum" not in c]
    lists = {f"list of: {form}": form for form in forms}
    several = {form for name, form in lists.items() if name in forms}
    return " or ".join(form + (", or a list of such" if form in several else "")
                       for form in dict.fromkeys(forms) if form not in lists)


def limits(schema):
    """ > 0, >= 0, <= 1, as far as stated."""
    signs = (("exclusiveMinimum", ">"), ("minimum", ">="), ("maximum", "<="))
    found = [f"{sign} {schema[key]:g}" for key, sign in signs if key in schema]
    return f" {', '.join(found)}" if found else ""


def inner_tables(schema):
    """The tables that a value is made of, each once: [(type or "", schema)]. A list of them and one alone are the same."""
    if "anyOf" in schema:
        found = []
        for table in (table for choice in schema["anyOf"] for table in inner_tables(choice)):
            if table not in found:
                found.append(table)
        return found
    if schema.get("type") == "array":
        return inner_tables(schema["items"])
    if schema.get("type") != "object":
        return []
    if "properties" in schema:
        return [(schema.get("title", ""), schema)]
    columns = schema.get("additionalProperties")
    return inner_tables(columns) if isinstance(columns, dict) else []


def escaped(text):
    """Text for a cell of a table."""
    return re.sub(r"\s+", " ", text).replace("|", "\\|")


def rows(properties, required):
    """Rows of settings, with those of tables inside a setting below it, as `setting.inner` or `setting (type).inner`."""
    found = []
    for name, value in properties:
        if "const" in value:
            continue
        default = f"`{json.dumps(value['default'])}`" if "default" in value else "*required*" if name in required else "-"
        help_text = value.get("description", "")
        unit = re.search(r" \[([^\]]*)\]$", help_text)
        if unit:
            help_text = help_text[:unit.start()]
        cells = [f"`{name}`", kind_of(value), unit.group(1) if unit else "", default, help_text]
        found.append("| " + " | ".join(escaped(cell) for cell in cells) + " |")
    return found


class Inner:
    """Paragraphs on the tables that settings hold, and on those inside them; what was said before is referred to."""

    def __init__(self, definitions):
        self.said = {}
        self.types = {json.dumps(one): name for name, section in definitions.items() for one in section.get("oneOf", [])}

    def lines(self, name, properties):
        found = []
        for key, value in properties:
            where, tables = f"{name}.{key}", inner_tables(value)
            text = json.dumps(tables)
            before, units = self.said.setdefault(UNIT.sub('"', text), (where, UNIT.findall(text)))
            if tables and before != where:
                other = dict.fromkeys(f"{a} in place of {b}" for a, b in zip(UNIT.findall(text), units) if a != b)
                found += ["", f"**{where}**: as **{before}**" + (", with " + ", ".join(other) if other else "") + "."]
                continue
            if tables and all(json.dumps(inner) in self.types for _, inner in tables):
                found += ["", f"**{where}**: each type as in **{self.types[json.dumps(tables[0][1])]}: TYPE**."]
                continue
            for title, inner in tables:
                found += self.table(where, title, inner)
        return found

    def table(self, where, title, inner):
        help_text = inner.get("description", "") if title else ""
        place = f"**{where}**, type `{title}`" if title else f"**{where}**"
        members = list(inner["properties"].items())
        lines = ["", place + (f": {help_text}" if help_text else ""), ""]
        if all("const" in value for _, value in members):
            return lines[:2]
        return lines + settings(members, inner.get("required", [])) + self.lines(f"{where}.{title}" if title else where, members)


def settings(properties, required):
    found = rows(properties, required)
    if not found:
        return ["No settings."]
    return ["| setting | value | unit | default | meaning |", "|---|---|---|---|---|"] + found


def heading(name, section):
    if section.get("type") == "object" and "additionalProperties" in section and "properties" not in section:
        return f"[{name}.NAME]"
    return f"[[{name}]]" if "anyOf" in section else f"[{name}]"


def section_lines(name, section, definition, inner):
    """One table of a scene: settings that all its types share, then those of each."""
    lines = ["", f"## {heading(name, section)}", "", section.get("description", "")]
    types = definition.get("oneOf")
    if types is None:
        members = list(definition["properties"].items())
        return lines + [""] + settings(members, definition.get("required", [])) + inner.lines(name, members)
    shared = [key for key in types[0]["properties"] if key != "type"
              and all(other["properties"].get(key) == types[0]["properties"][key] for other in types)] if len(types) > 1 else []
    if shared:
        members = [(key, types[0]["properties"][key]) for key in shared]
        lines += ["", "All types:", ""] + settings(members, types[0].get("required", [])) + inner.lines(name, members)
    for one in sorted(types, key=lambda t: t["title"]):
        members = [(key, value) for key, value in one["properties"].items() if key not in shared]
        lines += ["", f"### {name}: {one['title']}", "", one.get("description", ""), ""]
        lines += settings(members, one.get("required", [])) + inner.lines(f"{name}: {one['title']}", members)
    return lines


def contents(name, section, definition):
    """A row that leads to a table of scenes and to its types."""
    title = heading(name, section)
    types = sorted(one["title"] for one in definition.get("oneOf", []))
    links = ", ".join(f"[{one}](#{name}-{one})" for one in types)
    return f"| [`{title}`](#{title.translate(str.maketrans('', '', '[].')).lower()}) | {escaped(section.get('description', ''))} | {links} |"


def page(schema):
    lines = HEAD.splitlines()
    definitions, inner = schema["$defs"], Inner(schema["$defs"])
    lines += ["", "| table | what it is | types |", "|---|---|---|"]
    lines += [contents(name, schema["properties"][name], definitions[name]) for name in definitions]
    for name in definitions:
        lines += section_lines(name, schema["properties"][name], definitions[name], inner)
    return "\n".join(lines) + "\n"


def main(program, path, mode=""):
    schema = json.loads(subprocess.run([program, "schema"], check=True, capture_output=True, text=True).stdout)
    made, file = page(schema), pathlib.Path(path)
    if mode == "--write":
        file.write_text(made)
    elif not file.exists() or file.read_text() != made:
        sys.exit(f"{path} is not what `scree schema` says; write it anew: {sys.argv[0]} {program} {path} --write")


if __name__ == "__main__":
    if len(sys.argv) not in (3, 4) or sys.argv[3:] not in ([], ["--write"]):
        sys.exit(__doc__)
    main(*sys.argv[1:])
