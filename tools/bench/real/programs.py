"""The nine real programs: eight of grinding machines and FANUC's base program, out of checkouts of their repositories.

The environment variable FANUC_PROGRAMS names a folder with both checkouts, bare or not, whose history is complete:
  app-mnc-tool   github.com/Meglutz/app-mnc-tool: eight versions of a mnemonic file, as blobs of its history
  BasePMC        github.com/MarkusFANUC/BasePMC, at the tag v3.0.1: sources for sed and a C preprocessor
"""
import os
import re
import subprocess
from pathlib import Path

MNEMONIC_FILES = ("247a0902", "303d1ff6", "4ff58b75", "7f5513ff", "9056ec02", "977c208d", "d13b04ac", "dcc2e6c9")
BASE = "BasePMC"
BASE_COMMIT = "07994c6691bd830fae2ea022ce1c017e8944b1e6"  # v3.0.1
NAMES = (*MNEMONIC_FILES, BASE)


def folder():
    """That of the checkouts; nothing where there are none."""
    return Path(os.environ["FANUC_PROGRAMS"]) if os.environ.get("FANUC_PROGRAMS") else None


def git(repository, *words):
    for place in (repository / ".git", repository):
        if (place / "HEAD").exists():
            return subprocess.run(["git", "-C", place, *words], capture_output=True, check=True).stdout
    raise FileNotFoundError(f"{repository} is not a checkout")


def extract(to):
    """Writes all programs into a folder; the files of each by its name."""
    files = {}
    for name in MNEMONIC_FILES:
        files[name] = [to / f"{name}.mnc"]
        files[name][0].write_bytes(git(folder() / "app-mnc-tool", "cat-file", "blob", name))
    files[BASE] = base_program(to / "base")
    return files


# BasePMC is written for Windows: names of files without regard to case, \\ in paths. Its own scripts copy sources for
# each path by sed, and a C preprocessor makes the three files of one program; utility/*.cmd and make_mem.cmd say how.


def base_program(to):
    unpack(to)
    for script in ("makesrc.cmd", "makesymbol.cmd"):
        for line in (to / "utility" / script).read_text("latin-1").splitlines():
            if line.startswith("sed "):
                substitute(to, line)
    preprocess(to, "source/sysprm.src", "sysprm.mne")
    preprocess(to, "symbol/symbol.sym", "symbol.mne")
    preprocess(to, "source/base.src", "base.mne")
    symbols = to / "symbol.mne"
    symbols.write_text(re.sub(" *, *", ",", symbols.read_text("latin-1")), "latin-1")
    return [to / "sysprm.mne", symbols, to / "base.mne"]


def unpack(to):
    repository = folder() / "BasePMC"
    for line in git(repository, "ls-tree", "-r", "-z", BASE_COMMIT).decode("utf-8").split("\0"):
        if not line:
            continue
        details, name = line.split("\t")
        data = git(repository, "cat-file", "blob", details.split()[2]).replace(b"\r\n", b"\n")
        data = re.sub(rb'(#\s*include\s*")([^"]*)"', lambda found: found[1] + found[2].replace(b"\\", b"/").lower() + b'"', data)
        path = to / name.lower()
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(data)


def substitute(to, line):
    """A line of the scripts: sed -e s/A/B/g -e s/C/D/g ..\\source\\FILE > ..\\include\\FILE"""
    words, target = line.split(">")[0].split(), line.split(">")[1]
    local = [to / name.strip().replace("..\\", "").replace("\\", "/").lower() for name in (words[-1], target)]
    if not local[0].exists():
        return
    text = local[0].read_text("latin-1")
    for expression in (word for before, word in zip(words, words[1:]) if before == "-e"):
        _, old, new, _ = expression.split("/")
        text = re.sub(old, new, text)
    local[1].parent.mkdir(exist_ok=True)
    local[1].write_text(text.replace("\\", "/") if "include" in text else text, "latin-1")


def preprocess(to, source, target):
    made = subprocess.run(["cpp", "-P", "-std=c99", "-w", "-I", ".", source], cwd=to, capture_output=True, check=False).stdout
    lines = [line for line in made.decode("latin-1").splitlines() if re.search(r"[%@()0-9A-Za-z]", line)]
    (to / target).write_text("\n".join(lines) + "\n", "latin-1")
