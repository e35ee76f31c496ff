#!/usr/bin/env python3
"""Do tests read only what ./dev test --changed believes they read? reads.py BUILD [SELECTOR of ctest...]

Runs the selected tests under strace, and lists the files of the repository that a test has opened although neither its
rung_test_needs() states them nor a script or a source of it names them. Tests that use the debugging interface of the kernel
themselves (gdb) fail under strace, which is said and is no failure.
"""
import os
import re
import subprocess
import sys
import tempfile
from pathlib import Path

import ninja_graph
import test_list
import tests

ROOT = tests.ROOT
OPENED = re.compile(r'open(?:at)?\((?:(?:AT_FDCWD|\d+)<([^>]*)>, )?"((?:[^"\\]|\\.)*)", (\S+)(?:, \d+)?\) = \d+')


def opened(log, others):
    """Paths in the repository that were opened to be read, without those below `others`."""
    found = set()
    for folder, path, flags in OPENED.findall(log):
        path = os.path.normpath(os.path.join(folder or ROOT, path))
        if "WRONLY" in flags or not path.startswith(f"{ROOT}/") or "__pycache__" in path:
            continue
        path = os.path.relpath(path, ROOT)
        if path.partition("/")[0] not in others and os.path.exists(ROOT / path):
            found.add(path + "/" if (ROOT / path).is_dir() else path)
    return found


def run(test, log):
    """Whether it passes."""
    properties = {entry["name"]: entry["value"] for entry in test.get("properties", [])}
    environment = dict(os.environ, **dict(pair.partition("=")[::2] for pair in properties.get("ENVIRONMENT", [])))
    done = subprocess.run(["strace", "-f", "-qq", "-y", "--seccomp-bpf", "-e", "trace=open,openat", "-o", log, *test["command"]],
                          cwd=properties.get("WORKING_DIRECTORY", ROOT), env=environment, stdin=subprocess.DEVNULL,
                          capture_output=True)
    return done.returncode in (0, properties.get("SKIP_RETURN_CODE", 0))


def main(build, selectors):
    build = os.path.abspath(build)
    entries = test_list.entries_of(build)
    reader = tests.reader(build, ninja_graph.load(build), [])
    others = {os.path.relpath(build, ROOT), "out", ".git", ".cache"}
    done, wrong = set(), 0
    for test in test_list.details(build, selectors):
        entry = test_list.owner(entries, test["name"])
        if entry is None or entry in done or "command" not in test or "." in entry.reads:
            continue
        done.add(entry)
        if entry.family:
            test["command"] = test["command"][:1]  # all of its tests at once
        with tempfile.NamedTemporaryFile() as log:
            passed = run(test, log.name)
            paths = opened(Path(log.name).read_text(errors="replace"), others)
        unsaid = sorted(path for path in paths if not reader.reads(entry, path + "any" if path.endswith("/") else path))
        unsaid = [path for path in unsaid if not path.endswith("/") or not any(other.startswith(path) for other in reader.paths(entry))]
        print(f"{entry.name}: reads {len(paths)}{'' if passed else ', fails under strace'}", flush=True)
        for path in unsaid:
            print(f"  {path} is not stated", flush=True)
        wrong += len(unsaid)
    if not done:
        sys.exit("dev: no test is selected")
    sys.exit(1 if wrong else 0)


if __name__ == "__main__":
    main(sys.argv[1], sys.argv[2:])
