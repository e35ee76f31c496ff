"""Which tests the change of some files can affect: by what is built of the files, and by what the tests read.

The answer is never too small: what is not known to be harmless runs everything.
"""
import ast
import fnmatch
import functools
import os
import re
from pathlib import Path

import folders

# What decides how everything is built or chosen.
EVERYTHING = ("CMakeLists.txt", "*/CMakeLists.txt", "*.cmake", "cmake/*", "CMakePresets.json", "dev", ".ci/*", "tools/dev/*")
# What only tests read that look at the whole tree (READS .).
HARMLESS = ("*.md", "LICENSE", ".gitignore", "*/.gitignore", ".clang-tidy", ".clang-format", "debian/*", "packaging/*")
# Where a file of C or C++ that nothing is built from is no known case, no matter which test reads it.
PRODUCT = tuple(f"{folder}/" for folder in folders.PRODUCT)
INCLUDED = (".h", ".hpp", ".hxx", ".def", ".inc")
COMPILED = (".c", ".cc", ".cpp")
NAMED = re.compile(r"(?<![\w./-])(?:[A-Z]+\.md|LICENSE|(?:%s)(?:/[\w.+-]+)*)(?=(/?))" % "|".join(folders.ALL))
INCLUDE = re.compile(r'^\s*#\s*include.*$', re.MULTILINE)
LITERAL = re.compile(r'"((?:[^"\\\n]|\\.)*)"|\'((?:[^\'\\\n]|\\.)*)\'')


def matches(path, patterns):
    return any(fnmatch.fnmatchcase(path, pattern) for pattern in patterns)


def named_paths(text, exists):
    """Files and folders of the repository that a text names in its literals; the folder of a file, as files include their
    neighbours, but a page alone. exists(path) -> "file", "folder" or None. A folder at the top is meant where it stands
    alone; within a sentence, "tools" are just tools, but "examples" may be a word of a command."""
    found = set()
    for one, other in LITERAL.findall(INCLUDE.sub("", text)):
        literal = one or other
        for match in NAMED.finditer(literal):
            path = match[0]
            if "/" not in path and exists(path) == "file":
                found.add(path)
                continue
            if "/" not in path and not match[1] and literal != path and path != "examples":
                continue
            while exists(path) is None and "/" in path:  # the rest is a pattern, or made at run time
                path = os.path.dirname(path)
            if exists(path) is not None:
                includes = exists(path) == "file" and not path.endswith(".md")
                found.add(os.path.dirname(path) if includes else path)
    return found


def imported(text):
    """Names of modules that a Python file imports."""
    names = set()
    try:
        nodes = ast.walk(ast.parse(text))
    except SyntaxError:
        return names
    for node in nodes:
        if isinstance(node, ast.Import):
            names |= {alias.name.partition(".")[0] for alias in node.names}
        elif isinstance(node, ast.ImportFrom) and node.module:
            names.add(node.module.partition(".")[0])
    return names


class Reader:
    """What a test reads: the folder it is declared in, what it states, and what its scripts and sources name.

    files: all of the repository; sources_of(target): the sources of a program; commands: {name of a test: words}, by paths
    in the repository."""

    def __init__(self, root, files, sources_of, commands):
        self.root, self.files, self.sources_of = Path(root), files, sources_of
        self.folders = {parent.as_posix() for file in files for parent in Path(file).parents}
        self.modules = {}  # name of a module -> files
        for file in files:
            if file.endswith(".py"):
                self.modules.setdefault(Path(file).stem, []).append(file)
        self.started = {name: [word for word in words if word in files and word.endswith(".py")]
                        for name, words in commands.items()}
        self.started_by_any = {script for scripts in self.started.values() for script in scripts}

    def exists(self, path):
        return "file" if path in self.files else "folder" if path in self.folders else None

    @functools.cache
    def text(self, file):
        try:
            return (self.root / file).read_text(errors="replace")
        except OSError:
            return ""

    @functools.cache
    def named_in(self, file):
        return named_paths(self.text(file), self.exists)

    @functools.cache
    def scripts(self, entry):
        """The Python files that a test starts, and those that they import, by the names of modules."""
        found, queue = set(), list(self.started.get(entry.name, ()))
        while queue:
            file = queue.pop()
            if file not in found:
                found.add(file)
                queue += [other for name in imported(self.text(file)) for other in self.modules.get(name, ())]
        return found

    @functools.cache
    def paths(self, entry):
        """Files and folders; not what `READS .` means. The own folder is not meant where a part of it is stated; that of
        families holds many, and each reads the folders of its sources."""
        found = {path for path in entry.reads if path != "."}
        if not entry.family and not any(path.startswith(entry.folder + "/") for path in found):
            found.add(entry.folder)
        found |= {os.path.dirname(path) for path in found if self.exists(path) == "file"}  # files include their neighbours
        for script in self.scripts(entry):
            found |= self.named_in(script) | {script}
        for target in entry.targets:
            for source in self.sources_of(target):
                if source.startswith("tests/"):
                    found |= self.named_in(source) | {os.path.dirname(source)}
        return found

    def reads(self, entry, file):
        if file in self.started_by_any and file.startswith(entry.folder + "/") and not entry.family:
            return file in self.scripts(entry)  # not the script of another test in the same folder
        return any(file == path or file.startswith(path + "/") for path in self.paths(entry))


def choose(changed, entries, graph, node_of, reader):
    """{entry: why} or, where all tests are to be run, the reason as a text. node_of(path): its name in the graph."""
    for file in changed:
        if matches(file, EVERYTHING):
            return f"{file} decides how everything is built or tested"
    unknown = "an object whose headers are not known"
    headers = [file for file in changed if not file.endswith(COMPILED) and
               (graph.knows(node_of(file)) or file.endswith(INCLUDED))]
    starts = {node_of(file): file for file in changed}
    if headers:
        starts.update({name: f"{headers[0]}, {unknown}" for name in graph.unknown})
    reached = graph.reached(starts)

    chosen = {}
    for entry in entries:
        for target in entry.targets:
            if target in reached:
                chosen.setdefault(entry, f"{starts[reached[target]]} -> {target}")
    for file in changed:
        readers = [entry for entry in entries if reader.reads(entry, file)]
        built = graph.knows(node_of(file))
        of_product = file.startswith(PRODUCT) and file.endswith(INCLUDED + COMPILED)
        is_test = file.endswith("_test.cpp") and reader.text(file)  # one that is gone affects nothing
        if not built and (of_product or is_test):
            return f"nothing known is built from {file}"
        if not built and not readers and not matches(file, HARMLESS):
            return f"nothing says which tests {file} concerns"
        for entry in readers:
            chosen.setdefault(entry, f"{file} is read")
        for entry in entries:
            if "." in entry.reads:
                chosen.setdefault(entry, f"{file}: reads the whole tree")
    return chosen


def expression(entries):
    """One for ctest -R."""
    def escaped(name):
        return re.sub(r"([^\w-])", r"\\\1", name)
    return "^(" + "|".join(escaped(entry.name) + ("" if entry.family else "$") for entry in entries) + ")"
