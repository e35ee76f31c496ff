"""Compilers of others, where PEERS_DIR names a folder of them: shared objects of generated programs, as they make them."""
import os
from pathlib import Path

from callgrind import Failure, run

SOURCES = Path(__file__).resolve().parent / "peers"
# Mechanisms are not in their languages, signals are bits like others.
KINDS = ("bits", "timers-idle", "timers-running", "counters", "integers", "reals", "indexed", "full")
MOST_RUNGS = 1000  # what they make of a program is one function, which takes compilers too long beyond
LIMIT_S = 1800  # for a compiler
FLAGS = ("-O3", "-w", "-shared", "-fPIC", "-fvisibility=hidden", "-I.")


class Matiec:
    title, folder, glue = "matiec", "matiec", "matiec.c"
    headers = ("lib", "C")
    compilers = {"gcc": ("gcc",), "clang": ("clang-19",)}

    @staticmethod
    def translate(home, folder):
        run(home / "iec2c", "-I", home / "lib", "-T", folder, folder / "program.st")


class Strucpp:
    title, folder, glue = "STruC++", "strucpp", "strucpp.cpp"
    headers = ("src", "runtime", "include")
    compilers = {"g++": ("g++", "-std=c++17"), "clang++": ("clang++-19", "-std=c++17")}

    @staticmethod
    def translate(home, folder):
        run("node", home / "dist" / "node" / "cli.js", folder / "program.st", "-o", folder / "program.cpp", "-O", "2")


KNOWN = (Matiec, Strucpp)


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
        (folder / "program.st").write_text(run(self.generated, "structured-text", kind, size), encoding="ascii")
        (folder / "places.inc").write_text(run(self.generated, "places", kind, size), encoding="ascii")
        peer.translate(self.homes[peer], folder)
        return folder

    def build(self, peer, kind, size):
        folder = self.sources(peer, kind, size)
        headers = self.homes[peer].joinpath(*peer.headers)
        for name, compiler in peer.compilers.items():
            path = folder / f"{name}.so"
            run(*compiler, *FLAGS, f"-I{headers}", "-o", path, SOURCES / peer.glue, cwd=folder, timeout=LIMIT_S)
            yield ("peer", f"{peer.title}, {name}"), path

    def forms(self, kind, size):
        """As those of Programs.straight: ("peer", its name and a compiler): shared object."""
        if kind not in KINDS or size > MOST_RUNGS:
            return {}
        return {key: path for peer in self.homes for key, path in self.build(peer, kind, size)}
