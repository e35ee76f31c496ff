"""What the soak tests share: HAL sessions of tests/cnc that a test looks into while they run."""
import contextlib
import subprocess
import sys
import tempfile
from pathlib import Path
from types import SimpleNamespace

HERE = Path(__file__).resolve().parent
CNC = HERE.parent / "cnc"
sys.path.insert(0, str(CNC))
import cnc_test  # noqa: E402  pylint: disable=wrong-import-position
from patience import wait_until  # noqa: E402  pylint: disable=wrong-import-position


def expect(condition, what):
    if not condition:
        raise AssertionError(what)


def wait(what, condition):
    found = wait_until(condition, step=0.002)
    expect(found, f"never came: {what}")
    return found


def compiled(rungc, source, output):
    subprocess.run([rungc, "build", "-q", *([] if source.is_dir() else ["--no-project"]), source, "-o", output], check=True)
    return output


def children(process):
    """Process numbers of all that it has started, the nearest first."""
    found = [process]
    for number in found:
        with contextlib.suppress(OSError):
            for task in Path(f"/proc/{number}/task").iterdir():
                found += [int(word) for word in (task / "children").read_text().split()]
    return found[1:]


def named(process, name):
    """The number of the child with this name; None: there is none."""
    for number in children(process):
        with contextlib.suppress(OSError):
            if Path(f"/proc/{number}/comm").read_text().strip() == name:
                return number
    return None


@contextlib.contextmanager
def folder():
    with tempfile.TemporaryDirectory(dir="/var/tmp", prefix="rung-soak-") as made:
        yield Path(made)


def make_bench(options, place):
    """A folder for sessions with the component and the programs of `options`: module, bin."""
    return cnc_test.Bench(SimpleNamespace(module=options.module, rungc=options.bin / "rungc", libexec=""), place)


@contextlib.contextmanager
def session(bench, *command):
    """A session under way; it ends with the block."""
    line, environment = bench.inside(*command)
    with open(bench.folder / "output.txt", "w", encoding="utf-8") as output:
        process = subprocess.Popen(line, env=environment, stdin=subprocess.DEVNULL, stdout=output, stderr=subprocess.STDOUT)
    try:
        yield process
    finally:
        process.kill()
        process.wait()


def printed(bench):
    return (bench.folder / "output.txt").read_text(encoding="utf-8", errors="replace")


class Figures:
    """What a process has."""

    def __init__(self, process):
        status = dict(line.split(":", 1) for line in Path(f"/proc/{process}/status").read_text().splitlines())
        self.memory = int(status["RssAnon"].split()[0])  # its own: HAL's shared memory is never given back
        self.threads = int(status["Threads"])
        self.files = len(list(Path(f"/proc/{process}/fd").iterdir()))


def check_growth(figures, most):
    """The least of the last quarter is that of the second: something may be open for a moment. `most`: kB more of memory."""
    quarter = len(figures) // 4
    expect(quarter > 0, f"only {len(figures)} figures")

    def least(part):
        return {name: min(getattr(f, name) for f in part) for name in ("memory", "threads", "files")}

    before, after = least(figures[quarter:2 * quarter]), least(figures[-quarter:])
    print(f"in the second quarter {before}, in the last {after}; memory is in kB")
    expect(after["threads"] == before["threads"] and after["files"] == before["files"], "threads or files have become more")
    expect(after["memory"] - before["memory"] <= most, f"more than {most} kB more: {[f.memory for f in figures]}")
