#!/usr/bin/env python3
"""Which tests, and what they need to be built: for ./dev test.

tests.py targets BUILD SELECTOR...   prints the targets that the selected tests need, one a line, or `all`
tests.py changed BUILD [COMMIT]      prints an expression for ctest -R: the tests that a change since COMMIT can affect, or
                                     `all`; nothing where there is none. Why each is chosen goes to stderr. Without COMMIT:
                                     since the branch left the one it follows, or else since the last commit.
"""
import functools
import os
import re
import subprocess
import sys
from pathlib import Path

import affected
import ninja_graph
import test_list

ROOT = Path(__file__).resolve().parents[2]


def git(*words, check=True):
    done = subprocess.run(["git", "-C", ROOT, *words], capture_output=True, text=True)
    if check and done.returncode != 0:
        sys.exit(f"dev: git {' '.join(words)}: {done.stderr.strip()}")
    return done.stdout if done.returncode == 0 else ""


def files(text):
    return [name for name in text.split("\0") if name]


def below_root(path):
    return os.path.relpath(path, ROOT)


def targets(build, selectors):
    graph = ninja_graph.Graph(ninja_graph.statements((Path(build) / "build.ninja").read_text()), {})

    def sources_of(target):
        return [Path(build, source).read_text(errors="replace") for source in graph.sources(target)
                if Path(build, source).exists()]
    entries = test_list.entries_of(build)
    needed = test_list.needed(entries, selectors, test_list.listed(build, selectors), sources_of)
    if needed is None:
        print("all")
    elif not needed:
        sys.exit("dev: no test is selected")
    else:
        print("\n".join(sorted({target for entry in needed for target in entry.targets})))


def reader(build, graph, more):
    """Of what the tests read; `more`: files that git does not know yet."""
    here = set(files(git("ls-files", "-z"))) | set(more)

    @functools.cache
    def sources_of(target):
        return [below_root(os.path.join(build, source)) for source in graph.sources(target)]
    commands = {name: [below_root(os.path.join(ROOT, word)) for word in words]
                for name, words in test_list.listed(build, []).items()}
    return affected.Reader(ROOT, here, sources_of, commands)


def changed(build, commit):
    if not commit:
        commit = git("merge-base", "HEAD", "@{upstream}", check=False).strip() or "HEAD"
    paths = files(git("diff", "--no-renames", "--name-only", "-z", commit, "--"))
    paths += files(git("ls-files", "--others", "--exclude-standard", "-z"))
    say = functools.partial(print, file=sys.stderr)
    say(f"{len(paths)} files have changed since {git('describe', '--always', commit).strip()}")
    if not paths:
        return
    configured = re.search(r"^CMAKE_HOME_DIRECTORY:INTERNAL=(.*)$", (Path(build) / "CMakeCache.txt").read_text(), re.MULTILINE)
    if configured and Path(configured[1]) != ROOT:
        say(f"all tests: the build was configured in {configured[1]}, which is another name of {ROOT}")
        print("all")
        return
    graph = ninja_graph.load(build)
    entries = test_list.entries_of(build)
    chosen = affected.choose(sorted(paths), entries, graph, lambda path: str(ROOT / path), reader(build, graph, paths))
    if isinstance(chosen, str):
        say(f"all tests: {chosen}")
        print("all")
        return
    for entry, why in chosen.items():
        say(f"{entry.name}{'*' if entry.family else ''}: {why}")
    say(f"{len(chosen)} of {len(entries)} tests and families of tests")
    if chosen:
        print(affected.expression(chosen))


if __name__ == "__main__":
    command, folder, *rest = sys.argv[1:]
    if command == "targets":
        targets(folder, rest)
    else:
        changed(folder, rest[0] if rest else None)
