"""The tests as CMake lists them (build/tests.tsv), and which of them selectors of ctest mean."""
import json
import re
import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path

# Selectors by expression, which are understood here, too: only the built program knows the tests of a family.
BY_EXPRESSION = {
    "-R": "name", "--tests-regex": "name", "-E": "not name", "--exclude-regex": "not name",
    "-L": "label", "--label-regex": "label", "-LE": "not label", "--label-exclude": "not label",
}
OTHERS = ("-I", "--tests-information", "-U", "--union", "--rerun-failed", "--tests-from-file", "--exclude-from-file")
SUITE = re.compile(r"^[ \t]*(?:TEST|TEST_F|TEST_P|TYPED_TEST|TYPED_TEST_P)\s*\(\s*(\w+)\s*,", re.MULTILINE)


@dataclass(frozen=True)
class Entry:
    """A test; or a family, whose name is the beginning of the names of its tests, with a dot at its end."""
    family: bool
    name: str
    folder: str
    targets: tuple
    reads: tuple
    label: str

    def listed_when_missing(self):
        """What ctest calls a family whose program is not there."""
        return f"{self.name}NOT_BUILT"


def read(text):
    entries = []
    for line in text.splitlines():
        if line and not line.startswith("#"):
            kind, name, folder, targets, reads, label = line.split("\t")
            entries.append(Entry(kind == "family", name, folder, tuple(targets.split()), tuple(reads.split()), label))
    return entries


def selectors(arguments):
    """{"name": [expression...], ...} and whether there are other selectors."""
    found, others, rest = {kind: [] for kind in BY_EXPRESSION.values()}, False, list(arguments)
    while rest:
        word, equals, value = rest.pop(0).partition("=")
        if word in BY_EXPRESSION:
            if not equals:
                if not rest:
                    sys.exit(f"dev: {word} is without its expression")
                value = rest.pop(0)
            found[BY_EXPRESSION[word]].append(value)
        elif word in OTHERS:
            others = True
    return found, others


def suites(prefix, sources):
    """Names of the tests in the sources of a family's program: one a suite (cmake/suites.cmake)."""
    return [prefix + suite for source in sources for suite in dict.fromkeys(SUITE.findall(source))]


def selects(found, names, labels):
    """Whether one of the names with these labels is selected. Where ctest is stricter, more is built than needed."""
    def matches(expression, texts):
        try:
            return any(re.search(expression, text) for text in texts)
        except re.error:
            return True
    if not all(matches(expression, labels) for expression in found["label"]):
        return False
    if found["not label"] and all(matches(expression, labels) for expression in found["not label"]):
        return False
    named = [name for name in names if not found["name"] or any(matches(text, [name]) for text in found["name"])]
    return any(not found["not name"] or not all(matches(text, [name]) for text in found["not name"]) for name in named)


def owner(entries, name):
    """The entry that a name of ctest's list belongs to, or None."""
    families = []
    for entry in entries:
        if not entry.family and entry.name == name or entry.family and entry.listed_when_missing() == name:
            return entry
        if entry.family and name.startswith(entry.name):
            families.append(entry)
    return max(families, key=lambda entry: len(entry.name), default=None)


def details(build, arguments):
    """The tests that ctest selects, as it describes them; those of a program that is not built are missing."""
    command = ["ctest", "--test-dir", build, "--show-only=json-v1", *arguments]
    done = subprocess.run(command, capture_output=True, text=True)
    if done.returncode != 0 or not done.stdout.startswith("{"):
        sys.exit(f"dev: {' '.join(command)} failed\n{done.stderr}")
    return json.loads(done.stdout)["tests"]


def listed(build, arguments):
    """{name: command} of those tests."""
    return {test["name"]: test.get("command", []) for test in details(build, arguments)}


def needed(entries, arguments, names_listed, sources_of):
    """The entries that the selectors mean, or None: all of them, or something unknown. sources_of(target): texts."""
    found, others = selectors(arguments)
    if not others and not any(found.values()):
        return None
    chosen = [owner(entries, name) for name in names_listed]
    if None in chosen:
        return None
    for entry in entries:
        if entry.family and entry not in chosen and not others:
            names = [entry.name, *suites(entry.name, sources_of(entry.targets[0]))]
            if selects(found, names, [entry.label] if entry.label else []):
                chosen.append(entry)
    return [entry for entry in entries if entry in chosen]


def entries_of(build):
    return read((Path(build) / "tests.tsv").read_text())
