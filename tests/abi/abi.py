#!/usr/bin/env python3
"""The ABI of the libraries and of program files, held to its descriptions beside this file: docs/abi.md.

    abi.py check FOLDER    FOLDER has the built libraries; a difference is a failure
    abi.py record          writes the descriptions anew

The libraries carry no types in their debug information, so a description is that of a stand-in: the functions of the
header with empty bodies, linked as the library is. The library itself then has to export the same symbols.
"""
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
HERE = Path(__file__).resolve().parent
INCLUDES = [ROOT / "rtlib/abi", ROOT / "compiler"]
HEADERS = ["rung/program.h", "rung/runtime.h", "rung/compiler.h"]
# By library: its header, the mark of its functions, its version script.
LIBRARIES = {
    "librung-runtime.so.0": ("rung/runtime.h", "RUNG_API", ROOT / "rtlib/api/exports.txt"),
    "librung-compiler.so.0": ("rung/compiler.h", "RUNG_COMPILER_API", ROOT / "compiler/exports.txt"),
}
VALUES = "rung-values.so"  # what no function of the libraries names: enumerations and constants; the data of an image


def fail(text):
    sys.exit(f"abi: {text}")


def run(*command, allowed=(0,)):
    done = subprocess.run([str(part) for part in command], capture_output=True, text=True)
    if done.returncode not in allowed:
        fail(f"{command[0]} failed:\n{done.stdout}{done.stderr}")
    return done


def path_of(header):
    return next(folder / header for folder in INCLUDES if (folder / header).exists())


def text_of(header):
    return re.sub(r"/\*.*?\*/", "", path_of(header).read_text(), flags=re.S)


def library_source(header, mark):
    functions = re.findall(rf"^{mark} ([^;#]+?\));", text_of(header), flags=re.S | re.M)
    if not functions:
        fail(f"{header} has no function")
    return f'#include "{header}"\n' + "".join(f"{function} {{ return 0; }}\n" for function in functions)


def values_source():
    texts = [text_of(header) for header in HEADERS]
    enumerations = [name for text in texts for name in re.findall(r"^enum (\w+) \{", text, flags=re.M)]
    constants = [name for text in texts
                 for name in re.findall(r"^#define (RUNG_\w+) +(?:0x)?[0-9A-F]+u\b", text, flags=re.M)]
    lines = [f'#include "{header}"' for header in HEADERS]
    lines += [f"enum {name} enum_{name};" for name in enumerations]
    lines += ["enum constants {", *[f"  value_of_{name} = {name}," for name in constants], "} constants;"]
    return "\n".join([*lines, "const rung_program rung_program_table;"]) + "\n"


def link(name, source, folder, script=None):
    """The stand-in as a shared object."""
    (folder / "source.c").write_text(source)
    options = [f"-Wl,--version-script={script}"] if script else []
    run("clang-19", "-std=c11", "-g", f"-ffile-prefix-map={folder}=.", "-shared", "-fPIC", "-nostdlib",
        f"-Wl,-soname,{name}", *[f"-I{include}" for include in INCLUDES], *options, folder / "source.c",
        "-o", folder / name)
    return folder / name


def stand_ins(folder):
    for name, (header, mark, script) in LIBRARIES.items():
        yield link(name, library_source(header, mark), folder, script)
    yield link(VALUES, values_source(), folder)


def description_of(name):
    return HERE / (name.split(".")[0] + ".abi")


def describe(stand_in, path):
    run("abidw", "--no-corpus-path", "--no-comp-dir-path", "--no-show-locs", "--no-write-default-sizes",
        "--type-id-style", "hash", "--out-file", path, stand_in)


def difference(stand_in):
    """From its description; "" where there is none."""
    done = run("abidiff", "--harmless", "--no-show-locs", description_of(stand_in.name), stand_in, allowed=range(16))
    if done.returncode & 3:
        fail(f"abidiff failed:\n{done.stdout}{done.stderr}")
    return done.stdout if done.returncode else ""


def exports(library):
    listed = run("nm", "--dynamic", "--defined-only", "--with-symbol-versions", library).stdout
    return {line.split()[-1] for line in listed.splitlines() if line.split()[-2] != "A"}


def soname(library):
    return re.search(r"SONAME.*\[(.*)\]", run("readelf", "--dynamic", library).stdout).group(1)


def check(built):
    wrong = []
    with tempfile.TemporaryDirectory() as temporary:
        for stand_in in stand_ins(Path(temporary)):
            name = stand_in.name
            if found := difference(stand_in):
                wrong.append(f"{name} is not what {description_of(name).name} describes:\n{found}")
            if name not in LIBRARIES:
                continue
            library = built / name
            if soname(library) != name:
                wrong.append(f"the SONAME of {library} is {soname(library)}")
            for symbol in sorted(exports(library) ^ exports(stand_in)):
                where = "library" if symbol in exports(library) else "header"
                wrong.append(f"{symbol} is in the {where} of {name} alone")
    if wrong:
        fail("\n".join(wrong) + "\nWhat may change, and how: docs/abi.md. ./dev abi records a change that is meant.")


def record():
    with tempfile.TemporaryDirectory() as temporary:
        for stand_in in stand_ins(Path(temporary)):
            describe(stand_in, description_of(stand_in.name))


if __name__ == "__main__":
    if not shutil.which("abidiff"):
        fail("abidiff is not installed; ./dev setup --check does it")
    if sys.argv[1:2] == ["check"] and len(sys.argv) == 3:
        check(Path(sys.argv[2]))
    elif sys.argv[1:] == ["record"]:
        record()
    else:
        sys.exit(__doc__)
