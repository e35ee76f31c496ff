#!/usr/bin/env python3
"""Checks who may include whom, and that the runtime knows its dialects in rtlib/nc alone (docs/architecture.md):
layering.py [ROOT]; exit 1 and a line for each offence."""
import re
import sys
from pathlib import Path

# Folder -> folders it may include besides itself and EVERYBODYS; the longest matching folder counts. "rtlib/abi" is also
# "rung/NAME.h".
FRONTEND = {"ir/support", "ir/core", "rtlib/abi", "rtlib/nc"}
IR = {"ir/support", "ir/core", "rtlib/abi"}
ALL_IR = IR | {"ir/text", "ir/verify", "ir/shape", "ir/analysis", "ir/transforms", "ir/image", "ir/interp"}
DIALECT = FRONTEND | {"frontend/syntax", "frontend/table", "frontend/sema", "frontend/lower", "frontend/ladder",
                      "frontend/ladder/text", "frontend/network", "frontend/network/lower", "frontend/dialects"}
DIALECTS = {f"frontend/dialects/{name}" for name in ("gsk", "nct", "technol")}
EVERYBODYS = "rtlib/text"  # header files that include nothing of ours
MODULES = {
    EVERYBODYS: set(),
    "rtlib/abi": set(),
    "rtlib/core": {"rtlib/abi"},
    "rtlib/nc": {"rtlib/abi"},
    "rtlib/host": {"rtlib/abi", "rtlib/core"},
    "rtlib/nc/names": {"rtlib/abi", "rtlib/core", "rtlib/nc", "rtlib/host"},
    "rtlib/nc/control": {"rtlib/abi", "rtlib/core", "rtlib/nc", "rtlib/nc/names", "rtlib/host"},
    "rtlib/profile": {"rtlib/abi", "rtlib/core", "rtlib/host"},
    "rtlib/runtime": {"rtlib/abi", "rtlib/core", "rtlib/nc/control", "rtlib/nc/names", "rtlib/host", "rtlib/profile"},
    "ir/support": set(),
    "ir/core": IR,
    "ir/text": IR,
    "ir/verify": IR | {"ir/text"},
    "ir/shape": IR,
    "ir/analysis": IR | {"ir/shape"},
    "ir/transforms": IR | {"ir/text", "ir/verify", "ir/analysis"},
    "ir/image": IR | {"ir/shape", "ir/analysis"},
    "ir/interp": IR | {"ir/shape", "ir/image", "rtlib/core", "rtlib/host"},  # an engine, as codegen/jit is
    "frontend/syntax": FRONTEND,
    "frontend/table": FRONTEND | {"frontend/syntax"},
    "frontend/ladder": FRONTEND | {"frontend/syntax", "frontend/table"},
    "frontend/ladder/text": FRONTEND | {"frontend/syntax", "frontend/table", "frontend/ladder"},
    "frontend/sema": FRONTEND | {"frontend/syntax", "frontend/table"},
    "frontend/lower": IR,
    "frontend/network": {"ir/support", "rtlib/nc", "frontend/syntax", "frontend/table", "frontend/sema", "frontend/ladder",
                         "frontend/ladder/text"},
    "frontend/network/lower": FRONTEND | {"frontend/table", "frontend/sema", "frontend/lower", "frontend/network"},
    "frontend/dialects": DIALECT | DIALECTS,  # its own files list the dialects
    **{dialect: DIALECT for dialect in DIALECTS},  # a dialect never sees another
    "codegen/process": {"ir/support"},
    "codegen/plan": ALL_IR,
    "codegen/cpp": ALL_IR | {"codegen/plan", "codegen/process"},
    "codegen/llvm": ALL_IR | {"codegen/plan"},
    "codegen/jit": ALL_IR | {"codegen/llvm", "rtlib/host"},
    "codegen/plugin": {"ir/support", "ir/shape", "codegen/llvm", "codegen/jit", "rtlib/host"},
    "codegen/clang": ALL_IR | {"codegen/cpp"},
}
# A host of the runtime's library sees its headers alone: neither the simulation nor the compiler, nor the runtime inside.
OURS = ("tools/", "frontend/", "codegen/", "ir/", "rtlib/")
HOSTS = ("tools/rung-hal", "tools/rung-run", "tools/connections", "tools/remote", "tools/sources", "tools/plc", "tools/mapping", "tools/services")
IN_A_HOST_TOO = ("tools/rung-hal/", "tools/rung-run/", "tools/connections/", "tools/command-line/", "tools/remote/",
                 "tools/sources/", "tools/plc/", "tools/mapping/", "tools/toml/", "tools/control-files/", "tools/devices/", "tools/services/", "tools/host-devices/host_devices.h",
                 "tools/host-devices/analog_pins.h", "rtlib/host/alone.h", "rtlib/host/clock.h", "rtlib/host/disk_file.h", "rtlib/host/file.h", "rtlib/host/plugin.h", "rtlib/host/realtime.h", "rtlib/host/trust.h",
                 "rtlib/text/", "ir/support/similar.h")  # the last: spelling suggestions
# Devices know neither a program's memory nor a machine: numbers and structs go in and out. What connects them to a
# program knows no simulation.
DEVICES = ("tools/devices/", "tools/control-files/", "rtlib/text/", "rtlib/nc/", "rtlib/core/ring.h", "rtlib/host/file.h", "rtlib/host/realtime.h", "rtlib/host/disk_file.h")
DEVICE_FOLDERS = {
    "tools/devices": DEVICES,
    "tools/device-requests": ("tools/device-requests/", *DEVICES, "rtlib/host/", "rtlib/core/"),
    "tools/host-devices": ("tools/host-devices/", "tools/device-requests/", *DEVICES, "tools/mapping/file.h", "tools/plc/pin_cell.h", "rtlib/host/",
                           "rtlib/core/", "rtlib/runtime/surroundings.h"),
}
TABLES = ("rtlib/nc/gsk/", "rtlib/nc/nct/", "rtlib/nc/technol/")  # of the dialects: for them, and for tools/services
FREE = ("tools", "tests", "examples")  # may include everything, but nobody includes them

# Foreign headers that only some folders may include; others (std, fmt, ...) are free outside rtlib.
FOREIGN = {
    "llvm/": ("codegen/llvm", "codegen/jit", "codegen/clang"),
    "llvm-c/": (),
    "lld/": ("codegen/llvm", "codegen/jit"),
    "clang/": ("codegen/clang",),
    "fmt/": ("ir", "frontend", "codegen"),
    "nlohmann/": ("ir/support", "codegen"),
    "CLI/": (),
    "expat.h": (),
    "modbus.h": (),
    "pugixml.hpp": (),
    "toml++/": (),
    "utf8proc.h": ("ir/support",),
    "zlib.h": ("rtlib/host",),
    "sodium.h": ("rtlib/host",),
    "gtest/": (),
    "gmock/": (),
    "benchmark/": (),
}
SUFFIXES = {".h", ".hpp", ".cpp", ".c", ".def"}
INCLUDE = re.compile(r'^[ \t]*#[ \t]*include[ \t]+[<"]([^>"]+)[>"]', re.MULTILINE)

# The name of a dialect as a word or a part of an identifier (gskNames, kNctTimeout, TECHNOL's); not in "function".
DIALECT_NAME = re.compile(r"(?<![A-Za-z])(?:gsk|nct|technol)(?![a-z])|(?:Gsk|Nct|Technol)(?![a-z])"
                          r"|(?<![A-Z])(?:GSK|NCT|TECHNOL)(?![A-Z])")

# Lowerings of programs without errors, which report nothing.
CHECKED_BEFORE = ("frontend/dialects/technol/lower",)
REPORT = re.compile(r"\bdiag::\w+|\b[dD]iagnostics\b")


def within(path, folder):
    return path == folder or path.startswith(folder + "/")


def module_of(path):
    return max((m for m in MODULES if within(path, m)), key=len, default=None)


def offence(root, path, target):
    """What is wrong with `path` including `target`, or None."""
    if any(within(path, folder) for folder in FREE):
        return None
    for prefix, allowed in FOREIGN.items():
        if target.startswith(prefix):
            return None if any(within(path, folder) for folder in allowed) else f"may not include {target}"
    if target.startswith("rung/"):
        target = "rtlib/abi/" + target
    if not (root / target).is_file():
        beside = "/" not in target and (root / path).parent.joinpath(target).is_file()
        return f"writes {target} without its folder" if beside else None
    source, used = module_of(path), module_of(target)
    if used is None:
        return f"may not include {target}"
    if source is None:
        return "is in no known module"
    if within(source, "frontend/network") and target.startswith(TABLES):
        return f"({source}) may not include {target}"
    return None if used in (source, EVERYBODYS) or used in MODULES[source] else f"({source}) may not include {target}"


def check_hosts(root):
    """What ships with a machine is built on the library."""
    found = []
    for file in sorted(file for folder in HOSTS for file in (root / folder).rglob("*")):
        if file.suffix in SUFFIXES:
            for match in INCLUDE.finditer(file.read_text(encoding="utf-8")):
                target = match.group(1)
                allowed = IN_A_HOST_TOO + (TABLES if within(file.relative_to(root).as_posix(), "tools/services") else ())
                if target.startswith(OURS) and not target.startswith(allowed):
                    found.append(f"{file.relative_to(root).as_posix()}: may not include {target}")
    return found


def check_devices(root):
    found = []
    for folder, allowed in DEVICE_FOLDERS.items():
        for file in sorted(file for file in (root / folder).rglob("*") if file.suffix in SUFFIXES):
            for match in INCLUDE.finditer(file.read_text(encoding="utf-8")):
                if match.group(1).startswith(OURS) and not match.group(1).startswith(allowed):
                    found.append(f"{file.relative_to(root).as_posix()}: may not include {match.group(1)}")
    return found


def check_dialect_names(root):
    """Code, comments and file names of rtlib outside rtlib/nc."""
    found = []
    for file in sorted((root / "rtlib").rglob("*")):
        path = file.relative_to(root).as_posix()
        if within(path, "rtlib/nc") or not file.is_file():
            continue
        for match in DIALECT_NAME.finditer(path):
            found.append(f"{path}: names a dialect ({match.group()}): belongs in rtlib/nc")
        text = file.read_text(encoding="utf-8")
        for match in DIALECT_NAME.finditer(text):
            line = text.count("\n", 0, match.start()) + 1
            found.append(f"{path}:{line}: names a dialect ({match.group()}): belongs in rtlib/nc")
    return found


def check_lowerings(root):
    """What is wrong with a program is reported before it is lowered."""
    found = []
    for file in sorted(file for folder in CHECKED_BEFORE for file in (root / folder).rglob("*")):
        text = file.read_text(encoding="utf-8")
        for match in REPORT.finditer(text):
            line = text.count("\n", 0, match.start()) + 1
            found.append(f"{file.relative_to(root).as_posix()}:{line}: reports ({match.group()}): belongs in the check")
    return found


def check(root):
    found = check_hosts(root) + check_devices(root) + check_dialect_names(root) + check_lowerings(root)
    for top in ("frontend", "ir", "codegen", "rtlib"):
        for file in sorted((root / top).rglob("*")):
            if file.suffix not in SUFFIXES:
                continue
            path = file.relative_to(root).as_posix()
            if module_of(path) is None:
                found.append(f"{path}: is in no known module")
                continue
            text = file.read_text(encoding="utf-8")
            for match in INCLUDE.finditer(text):
                if problem := offence(root, path, match.group(1)):
                    found.append(f"{path}:{text.count(chr(10), 0, match.start(1)) + 1}: {problem}")
    return found


def main():
    root = Path(sys.argv[1] if len(sys.argv) > 1 else ".")
    found = check(root)
    print("\n".join(found) or "include directions are right, and no dialect is named in rtlib outside rtlib/nc")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
