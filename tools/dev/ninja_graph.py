"""What is made of what: build.ninja and the log of included headers, as a graph of names.

Names are those of build.ninja: paths below the folder of the build, absolute paths outside it, names of targets.
"""
import collections
import os
import re
import subprocess
from pathlib import Path

PART = re.compile(r"(?:\$[ :$]|[^ $:|\n]|\$(?=\{))+")  # a name; CMake escapes blanks and colons


def unescaped(name):
    return re.sub(r"\$([ :$])", r"\1", name)


def canonical(name, build):
    """One name for each file: the compiler's cache writes `../ir/x.h`, CMake writes paths below the build in full, too."""
    name = name.removeprefix("${cmake_ninja_workdir}")
    path = os.path.normpath(os.path.join(build, name))
    return os.path.relpath(path, build) if path.startswith(build + "/") else path


def statements(text):
    """(outputs, inputs) of each `build` statement; inputs of all three kinds: what only has to be there before counts, too,
    since programs start and load it."""
    text = text.replace("$\n", "")
    for line in text.splitlines():
        if line.startswith("build "):
            made, _, of = re.sub(r"\|+", " ", line[6:].replace("$:", "\0")).partition(":")
            outputs = [unescaped(name.replace("\0", "$:")) for name in PART.findall(made)]
            inputs = [unescaped(name.replace("\0", "$:")) for name in PART.findall(of)]
            yield outputs, inputs[1:]  # the first is the rule


def logged_headers(text):
    """{object: [header...]} of what `ninja -t deps` prints, without what is older than its object (STALE)."""
    found, names = {}, []
    for line in text.splitlines():
        if line.startswith("    "):
            names.append(line.strip())
        elif line.strip():
            names = []
            if line.endswith("(VALID)"):
                found[line.rpartition(": #deps")[0]] = names
    return found


class Graph:
    """Built of (outputs, inputs), {object: headers}, and the objects whose headers are not known."""

    def __init__(self, made, headers, unknown=()):
        self.consumers = collections.defaultdict(set)
        self.inputs = collections.defaultdict(list)
        for outputs, inputs in made:
            for output in outputs:
                self.inputs[output] += inputs
                for name in inputs:
                    self.consumers[name].add(output)
        for output, names in headers.items():
            for name in names:
                self.consumers[name].add(output)
        self.unknown = set(unknown)

    def knows(self, name):
        return name in self.consumers

    def reached(self, names):
        """{everything that is made of one of the names, directly or not: the name it was reached from}"""
        origin = {name: name for name in names}
        queue = collections.deque(names)
        while queue:
            name = queue.popleft()
            for output in self.consumers.get(name, ()):
                if output not in origin:
                    origin[output] = origin[name]
                    queue.append(output)
        return origin

    def sources(self, target):
        """The sources that a program, given by the name of its target, is compiled of; not those of libraries."""
        found = []
        for program in [target, *self.inputs.get(target, ())]:
            for name in self.inputs.get(program, ()):
                if name.endswith(".o"):
                    found += [source for source in self.inputs[name] if source.endswith((".cpp", ".c", ".cc"))][:1]
        return found


def newest(names, build, times):
    latest = 0
    for name in names:
        if name not in times:
            try:
                times[name] = os.stat(os.path.join(build, name)).st_mtime_ns
            except OSError:
                times[name] = 1 << 63  # gone: whatever included it is to be made anew
        latest = max(latest, times[name])
    return latest


def load(build):
    """The graph of a configured folder. The headers of an object that was never compiled, or is older than a file it was
    compiled from, are not known: what it includes now may differ."""
    build = os.path.abspath(build)
    made = [([canonical(name, build) for name in outputs], [canonical(name, build) for name in inputs])
            for outputs, inputs in statements((Path(build) / "build.ninja").read_text())]
    listed = subprocess.run(["ninja", "-C", build, "-t", "deps"], capture_output=True, text=True, check=True).stdout
    headers = {canonical(name, build): [canonical(header, build) for header in names]
               for name, names in logged_headers(listed).items()}
    times, unknown = {}, []
    for outputs, inputs in made:
        if outputs[0].endswith((".o", ".pch")):
            name = outputs[0]
            sources = [source for source in inputs if os.path.isabs(source)]
            if name not in headers or not os.path.exists(os.path.join(build, name)) or \
                    newest(sources + headers[name], build, times) > os.stat(os.path.join(build, name)).st_mtime_ns:
                unknown.append(name)
    return Graph(made, headers, unknown)
