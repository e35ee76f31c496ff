#!/usr/bin/env python3
"""Checks who may include whom, that a folder has one namespace, and that the runtime knows its dialects in rtlib/nc alone
(docs/architecture.md): layering.py [ROOT]; exit 1 and a line for each offence."""
import re
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "tools/dev"))
import folders

# What a host sees of the runtime: its headers, and what works with files and the clock of this computer.
HOST = ("rtlib/abi", "rtlib/text", "rtlib/load", "rtlib/run/clock.h", "rtlib/run/realtime.h")

DIALECTS = ("fanuc", "gsk", "nct", "technol")

# Folder -> what it may include besides itself; the longest folder that a file is in counts. "rung/NAME.h" is rtlib/abi.
LAYERS = {
    "rtlib": (),
    "ir": ("rtlib/abi", "rtlib/text"),
    "frontend": ("ir/support", "ir/core", "rtlib/abi", "rtlib/text", "rtlib/nc"),
    "codegen": ("ir", "rtlib/abi", "rtlib/text", "rtlib/load", "rtlib/run"),
    "compiler": ("frontend", "codegen", "ir", "rtlib"),
    "machine": HOST,
    "sim": ("machine/host", "machine/io", "machine/rung-run/simulation_plugin.h", "rtlib"),
    "tools": ("compiler", "sim", "machine/host", "machine/command-line", "machine/control/client.h", "machine/compile/source_paths.h",
              "machine/compile/sources.h", "machine/rung-compile/collect.h",
              "frontend", "codegen", "ir", "rtlib"),
    # Walls within them.
    "rtlib/text": ("rtlib/text",),
    "rtlib/abi": (),
    "rtlib/core": ("rtlib/abi",),
    "rtlib/nc": ("rtlib/abi", "rtlib/text"),
    "rtlib/nc/names": ("rtlib/abi", "rtlib/text", "rtlib/core", "rtlib/load", "rtlib/run", "rtlib/nc"),
    "rtlib/nc/control": ("rtlib/abi", "rtlib/text", "rtlib/core", "rtlib/load", "rtlib/run", "rtlib/change", "rtlib/retain", "rtlib/nc",
                         "rtlib/nc/names"),
    **{f"rtlib/{folder}": ("rtlib/abi", "rtlib/text", "rtlib/core", "rtlib/load", "rtlib/run", "rtlib/change", "rtlib/retain",
                           "rtlib/record") for folder in ("load", "run", "change", "retain", "record")},
    "ir/support": ("rtlib/text",),
    "ir/core": ("ir/support", "rtlib/abi", "rtlib/text"),
    "ir/interp": ("ir", "rtlib/abi", "rtlib/text", "rtlib/core", "rtlib/load", "rtlib/run"),  # an engine, as codegen/jit is
    **{f"frontend/{folder}": ("frontend/syntax", "frontend/table", "frontend/sema", "frontend/ladder", "frontend/lower", "ir/support", "ir/core",
                              "rtlib/abi", "rtlib/text", "rtlib/nc") for folder in ("syntax", "table", "sema", "chart", "ladder", "lower")},
    "frontend/network": ("frontend/syntax", "frontend/table", "frontend/sema", "frontend/ladder", "ir/support", "rtlib/nc/signal.h", "rtlib/nc/signals.h", "rtlib/text"),
    "frontend/network/rows": ("frontend", "ir/support", "rtlib/text"),
    "frontend/network/lower": ("frontend", "ir/support", "ir/core", "rtlib/nc/service.h", "rtlib/nc/pmc", "rtlib/nc/config_key.h", "rtlib/abi", "rtlib/text"),
    **{f"frontend/dialects/{dialect}": ("frontend/syntax", "frontend/table", "frontend/sema", "frontend/chart", "frontend/lower", "frontend/ladder",
                                        "frontend/network", "frontend/network/lower", "frontend/network/rows", "frontend/dialects/dialect.h", "ir/support", "ir/core", "rtlib/abi", "rtlib/text",
                                        "rtlib/nc") for dialect in DIALECTS},
    "machine/host": ("rtlib/abi", "rtlib/text", "rtlib/core/handover.h", "rtlib/load", "rtlib/run", "rtlib/nc", "rtlib/nc/control"),
    "machine/io": ("machine/host", "rtlib"),
    **{f"machine/{folder}": ("machine/host", "machine/io", "machine/control", "machine/compile", "machine/command-line", *HOST)
       for folder in ("compile", "control", "rung-run", "rung-hal")},
    "machine/rung-compile": ("machine/compile", "compiler", "frontend", "codegen", "ir", "rtlib"),
    "machine/rungctl": ("machine", "machine/rung-compile/collect.h", "rtlib"),
    "tools/imported": ("ir/support", "rtlib/nc/pmc/slot.h", "rtlib/text"),
    "tools/report": ("compiler", "frontend", "codegen", "ir", "rtlib"),  # what drives programs is in tools/scenario
}
FREE = ("tests", "examples")  # may include everything, but nobody includes them

# Foreign headers that only some folders may include; others (std, fmt, ...) are free outside rtlib.
FOREIGN = {
    "llvm/": ("codegen/llvm", "codegen/jit", "codegen/clang"),
    "llvm-c/": (),
    "lld/": ("codegen/llvm", "codegen/jit"),
    "clang/": ("codegen/clang",),
    "fmt/": ("ir", "frontend", "codegen", "compiler", "machine", "sim", "tools"),
    "nlohmann/": ("ir/support", "codegen", "compiler", "machine", "sim/plugin", "tools"),
    "civetweb.h": ("tools/web",),
    "CLI/": ("machine/command-line",),
    "ncurses.h": ("machine/rungctl",),
    "expat.h": ("machine/host",),
    "modbus.h": ("machine/io/connections",),
    "modbus/": ("machine/io/connections",),
    "pugixml.hpp": ("tools/rungc",),
    "toml++/": ("rtlib/text",),
    "utf8proc.h": ("ir/support",),
    "zlib.h": ("rtlib/load", "rtlib/retain", "rtlib/record", "compiler"),
    "sodium.h": ("rtlib/load", "rtlib/retain", "machine/control", "machine/compile"),
    "gtest/": (),
    "gmock/": (),
    "benchmark/": (),
}
SUFFIXES = {".h", ".hpp", ".cpp", ".c", ".def"}
INCLUDE = re.compile(r'^[ \t]*#[ \t]*include[ \t]+[<"]([^>"]+)[>"]', re.MULTILINE)

# Folder -> its namespace; the longest folder counts. A file may open that one, and one inside it, and no other of ours.
NAMESPACES = {
    "rtlib/text": "text", "rtlib/core": "core", "rtlib/nc": "nc", "rtlib/api": "api",
    **{f"rtlib/{folder}": "runtime" for folder in ("load", "run", "change", "retain", "record")},
    "ir": "ir", "ir/support": "", "frontend": "frontend", "frontend/ladder": "frontend::ladder", "frontend/chart": "frontend::chart",
    "frontend/network": "frontend::network",
    **{f"frontend/dialects/{dialect}": f"frontend::{dialect}" for dialect in DIALECTS},
    "codegen": "codegen", "compiler": "compiler",
    "machine/host": "host", "machine/io": "io", "machine/control": "control", "machine/compile": "compile", "machine/rung-compile": "rung_compile",
    "machine/command-line": "cli", "machine/rung-run": "rung_run", "machine/rung-hal": "hal", "machine/rungctl": "rungctl",
    "sim": "sim", "sim/plugin": "rung_run",  # what rung-run declares, it defines
    "tools/rungc": "rungc", "tools/scenario": "scenario", "tools/report": "report", "tools/replay": "replay", "tools/source": "source", "tools/lsp": "lsp", "tools/view": "view", "tools/web": "web", "tools/bind": "bind", "tools/imported": "imported",
    "tools/bench": "bench",
}
NAMESPACE = re.compile(r"^namespace rung(?:::([\w:]+))?(?= *\{)", re.MULTILINE)

# The name of a dialect as a word or a part of an identifier (gskNames, kNctTimeout, TECHNOL's); not in "function".
DIALECT_NAME = re.compile("|".join((rf"(?<![A-Za-z])(?:{'|'.join(DIALECTS)})(?![a-z])",
                                    rf"(?:{'|'.join(name.capitalize() for name in DIALECTS)})(?![a-z])",
                                    rf"(?<![A-Z])(?:{'|'.join(DIALECTS).upper()})(?![A-Z])")))

# Lowerings of programs without errors, which report nothing.
CHECKED_BEFORE = ("frontend/dialects/technol/lower",)
REPORT = re.compile(r"\bdiag::\w+|\b[dD]iagnostics\b")


def within(path, folder):
    return path == folder or path.startswith(folder + "/")


def longest(path, table):
    return max((folder for folder in table if within(path, folder)), key=len, default=None)


def offence(root, path, target):
    """What is wrong with `path` including `target`, or None."""
    for prefix, allowed in FOREIGN.items():
        if target.startswith(prefix):
            return None if any(within(path, folder) for folder in allowed) else f"may not include {target}"
    if target.startswith("rung/"):
        compiler_api = target == "rung/compiler.h"
        target = ("compiler/" if compiler_api else "rtlib/abi/") + target
    if not (root / target).is_file():
        beside = "/" not in target and (root / path).parent.joinpath(target).is_file()
        return f"writes {target} without its folder" if beside else None
    layer = longest(path, LAYERS)
    if any(covers(allowed, target) for allowed in (layer, *LAYERS[layer])):
        return None
    return f"({layer}) may not include {target}"


def covers(allowed, target):
    """A folder at the top is allowed as a whole; another one without the walls inside it, which are named for themselves."""
    walls = [wall for wall in LAYERS if wall != allowed and within(wall, allowed)] if "/" in allowed else ()
    return within(target, allowed) and not any(within(target, wall) for wall in walls)


def lines(root, *folders):
    for folder in folders:
        for file in sorted((root / folder).rglob("*")):
            if file.suffix in SUFFIXES:
                yield file.relative_to(root).as_posix(), file.read_text(encoding="utf-8")


def line_of(text, at):
    return text.count("\n", 0, at) + 1


def check_includes(root):
    for path, text in lines(root, *folders.PRODUCT):
        for match in INCLUDE.finditer(text):
            if problem := offence(root, path, match.group(1)):
                yield f"{path}:{line_of(text, match.start(1))}: {problem}"


def check_namespaces(root):
    for path, text in lines(root, *folders.PRODUCT):
        folder = longest(path, NAMESPACES)
        if folder is None:
            continue
        expected = NAMESPACES[folder]
        for match in NAMESPACE.finditer(text):
            found = match[1] or ""
            if expected and found != expected and not found.startswith(expected + "::"):
                yield f"{path}:{line_of(text, match.start())}: namespace rung::{found}, in a folder of rung::{expected}"


def check_dialect_names(root):
    """Code, comments and file names of rtlib outside rtlib/nc."""
    for file in sorted((root / "rtlib").rglob("*")):
        path = file.relative_to(root).as_posix()
        if within(path, "rtlib/nc") or not file.is_file():
            continue
        for match in DIALECT_NAME.finditer(path):
            yield f"{path}: names a dialect ({match.group()}): belongs in rtlib/nc"
        text = file.read_text(encoding="utf-8")
        for match in DIALECT_NAME.finditer(text):
            yield f"{path}:{line_of(text, match.start())}: names a dialect ({match.group()}): belongs in rtlib/nc"


def check_lowerings(root):
    """What is wrong with a program is reported before it is lowered."""
    for path, text in lines(root, *CHECKED_BEFORE):
        for match in REPORT.finditer(text):
            yield f"{path}:{line_of(text, match.start())}: reports ({match.group()}): belongs in the check"


def check(root):
    return [*check_includes(root), *check_namespaces(root), *check_dialect_names(root), *check_lowerings(root)]


def main():
    root = Path(sys.argv[1] if len(sys.argv) > 1 else ".")
    found = check(root)
    print("\n".join(found) or "include directions are right, a folder has one namespace, and no dialect is named in rtlib outside rtlib/nc")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
