#!/usr/bin/env python3
"""Random edits of an example in the language server; after each its diagnostics are those of a fresh `rungc check`.

random_edits.py RUNGC EXAMPLE [--edits N] [--seed S]: characters are typed and deleted, lines pasted, cut and moved, and now and then
the file is as it was. EXAMPLE is the folder of a project.
"""
import argparse
import json
import random
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "support"))
from patience import patience

from client import Client

TYPED = "|-+[](){}/@;\"'.,:#*_ \n0123456789ABCDEXYZabcdexyzäß🟢"


def checked(rungc, folder):
    """File, code, line and column, from 0, of each diagnostic."""
    result = subprocess.run([rungc, "check", "--json", str(folder)], capture_output=True, text=True, timeout=patience())
    return sorted((Path(one["file"]).name or "rung.toml", one["code"], max(one["line"], 1) - 1, max(one["column"], 1) - 1) for one in json.loads(result.stdout))


def served(client):
    return sorted((name, one.get("code", ""), one["range"]["start"]["line"], one["range"]["start"]["character"])
                  for name, list_of_file in client.diagnostics.items() for one in list_of_file)


def position(text, offset):
    return {"line": text.count("\n", 0, offset), "character": offset - (text.rfind("\n", 0, offset) + 1)}


def lines_of(text, generator):
    lines = text.splitlines(keepends=True)
    begin = generator.randrange(len(lines) + 1)
    end = min(len(lines), begin + generator.randrange(1, 6))
    return sum(map(len, lines[:begin])), sum(map(len, lines[:end]))


def edit_of(text, generator):
    """The characters that are replaced, and by what."""
    kind = generator.choice(("type", "type", "delete", "paste", "cut"))
    if kind in ("type", "delete"):
        at = generator.randrange(len(text) + 1)
        return (at, at, generator.choice(TYPED)) if kind == "type" else (at, min(len(text), at + generator.choice((1, 1, 1, 5))), "")
    begin, end = lines_of(text, generator)
    if kind == "cut":
        return begin, end, ""
    at, _ = lines_of(text, generator)
    return at, at, text[begin:end]


def run(options, folder):
    generator = random.Random(options.seed)
    client = Client(options.rungc, folder, ["utf-32"])
    originals = {path.name: path.read_text(encoding="utf-8") for path in sorted(folder.iterdir()) if path.suffix in (".lad", ".pmc", ".plc", ".mne", ".mnc", ".sym")}
    name, text = None, None
    for count in range(options.edits):
        if count % 20 == 0:  # another file, and the former one as it was
            if name:
                (folder / name).write_text(originals[name], encoding="utf-8")
                client.close(name)
            name = generator.choice(sorted(originals))
            text = originals[name]
            client.open(name)
        begin, end, new = edit_of(text, generator)
        client.change(name, ({"start": position(text, begin), "end": position(text, end)}, new))
        text = text[:begin] + new + text[end:]
        (folder / name).write_text(text, encoding="utf-8", newline="")
        client.wait_for_diagnostics(name)
        client.request("textDocument/foldingRange", {"textDocument": {"uri": client.uri(name)}})  # all is published before the answer
        expected, found = checked(options.rungc, folder), served(client)
        if expected != found:
            sys.exit(f"edit {count} of seed {options.seed}, {name}: the server says {found}, check {expected}")
    memory = int(Path(f"/proc/{client.process.pid}/status").read_text(encoding="ascii").split("VmHWM:")[1].split()[0])
    status = client.end()
    print(f"{options.example.name}: {options.edits} edits, {memory // 1024} MB")
    return status


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("rungc", type=lambda path: str(Path(path).resolve()))
    parser.add_argument("example", type=lambda path: Path(path).resolve())
    parser.add_argument("--edits", type=int, default=100)
    parser.add_argument("--seed", type=int, default=1)
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as place:
        folder = Path(place).resolve() / options.example.name
        shutil.copytree(options.example, folder, ignore=shutil.ignore_patterns("linuxcnc", "*.retained"))
        sys.exit(run(options, folder))


if __name__ == "__main__":
    main()
