"""libscree holds no function of a plugin: no algorithm that a plugin names lives in core.

usage: core_knows_no_plugin.py LIBSCREE PLUGIN_FOLDER
"""

import pathlib
import subprocess
import sys


def functions(library, types):
    """Functions of namespace scree that `library` defines, in nm's symbol types; those of unnamed namespaces are left out."""
    table = subprocess.run(["nm", "--demangle", "--defined-only", library], check=True, capture_output=True, text=True).stdout
    rows = (line.split(" ", 2)[1:] for line in table.splitlines())
    return {name for kind, name in rows if kind in types and name.startswith("scree::") and "(anonymous" not in name}


def main():
    core, folder = functions(sys.argv[1], "T"), pathlib.Path(sys.argv[2])
    plugins = sorted(folder.glob("*.so"))
    of_plugins = {plugin.name: functions(plugin, "tT") for plugin in plugins}
    if len(core) < 50 or not any(of_plugins.values()):
        sys.exit("no symbols to compare; were the libraries stripped?")
    shared = {name: found & core for name, found in of_plugins.items() if found & core}
    for name, found in shared.items():
        print(f"{name}: libscree defines its {', '.join(sorted(found)[:3])} too", file=sys.stderr)
    sys.exit(1 if shared else 0)


main()
