"""Compilers of others, where PEERS_DIR names a folder of them: shared objects of generated programs, as they make them;
and an interpreter."""
import os
from pathlib import Path

from callgrind import Failure, run

SOURCES = Path(__file__).resolve().parent / "peers"
MOST_RUNGS = 1000  # what they make of a program is one function, whose compilation grows faster than its size
LIMIT_S = 1800  # for a compiler
FLAGS = ("-O3", "-w", "-shared", "-fPIC", "-fvisibility=hidden", "-I.")
C = {"gcc": ("gcc",), "clang": ("clang-19",)}
CPP = {"g++": ("g++", "-std=c++17"), "clang++": ("clang++-19", "-std=c++17")}


class StructuredText:
    # Mechanisms are not in the language, signals are bits like others.
    kinds = ("bits", "timers-idle", "timers-running", "counters", "integers", "reals", "indexed", "full")
    text = ("structured-text", "program.st")


class Matiec(StructuredText):
    title, folder, glue = "matiec", "matiec", "matiec.c"
    compilers, headers, defines = C, ("lib/C",), ()

    @staticmethod
    def translate(home, folder):
        run(home / "iec2c", "-I", home / "lib", "-T", folder, folder / "program.st")


class Strucpp(StructuredText):
    title, folder, glue = "STruC++", "strucpp", "strucpp.cpp"
    compilers, headers, defines = CPP, ("src/runtime/include",), ()

    @staticmethod
    def translate(home, folder):
        run("node", home / "dist/node/cli.js", folder / "program.st", "-o", folder / "program.cpp", "-O", "2")


class ClassicLadder:
    """An interpreter, with the options of its real-time module; arithmetic is text to it, which it reads in every scan."""
    title, folder, glue = "ClassicLadder", "classicladder", "classicladder.c"
    kinds = ("bits",)
    text = ("rungs", "rungs.inc")
    compilers, headers = C, ("src/hal/classicladder", "src/rtapi")
    defines = ("-DRTAPI", "-DSEQUENTIAL_SUPPORT", "-DOLD_TIMERS_MONOS_SUPPORT")

    @staticmethod
    def translate(home, folder):
        pass  # the rungs are its data


KNOWN = (Matiec, Strucpp, ClassicLadder)


def named():
    """{peer: its folder} of those that are there."""
    if not os.environ.get("PEERS_DIR"):
        return {}
    folder = Path(os.environ["PEERS_DIR"]).resolve()
    found = {peer: folder / peer.folder for peer in KNOWN if (folder / peer.folder).is_dir()}
    if not found:
        raise Failure(f"PEERS_DIR={folder} has none of the folders {', '.join(peer.folder for peer in KNOWN)}")
    return found


def version(home):
    if not (home / ".git").exists():
        return "of an unknown version"
    return run("git", "-C", home, "log", "-1", "--format=%h of %cs").strip()


def versions():
    return {peer.title: version(home) for peer, home in named().items()}


class Peers:
    """Programs as all peers make them, in a folder."""

    def __init__(self, generated, folder):
        self.generated, self.folder, self.homes = generated, Path(folder), named()

    def sources(self, peer, kind, size):
        """The folder of them."""
        folder = self.folder / f"{peer.folder}-{kind}-{size}"
        folder.mkdir()
        command, file = peer.text
        (folder / file).write_text(run(self.generated, command, kind, size), encoding="ascii")
        (folder / "places.inc").write_text(run(self.generated, "places", kind, size), encoding="ascii")
        peer.translate(self.homes[peer], folder)
        return folder

    def build(self, peer, kind, size):
        folder = self.sources(peer, kind, size)
        headers = [f"-I{self.homes[peer] / each}" for each in peer.headers]
        for name, compiler in peer.compilers.items():
            path = folder / f"{name}.so"
            run(*compiler, *FLAGS, *headers, *peer.defines, "-o", path, SOURCES / peer.glue, cwd=folder, timeout=LIMIT_S)
            yield ("peer", f"{peer.title}, {name}"), path

    def forms(self, kind, size):
        """As those of Programs.straight: ("peer", its name and a compiler): shared object."""
        if size > MOST_RUNGS:
            return {}
        return {key: path for peer in self.homes if kind in peer.kinds for key, path in self.build(peer, kind, size)}
