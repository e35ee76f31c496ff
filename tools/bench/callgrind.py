"""Programs under callgrind, and what its profiles say."""
import os
import re
import subprocess
from pathlib import Path

TARGET = "x86_64-linux-gnu"  # that programs are built for
# No copies by AVX or by microcode, which callgrind would count element by element.
PLAIN_COPIES = "glibc.cpu.hwcaps=-AVX_Fast_Unaligned_Load,-AVX2,-AVX512F,-ERMS,-FSRM"
CACHE = "16777216,16"  # so large that it misses a line once: at its first use


class Failure(Exception):
    pass


def run(*words, **options):
    try:
        done = subprocess.run([str(word) for word in words], capture_output=True, text=True, check=False, **options)
    except (OSError, subprocess.TimeoutExpired) as problem:
        raise Failure(str(problem)) from problem
    if done.returncode != 0:
        raise Failure(f"{' '.join(str(word) for word in words)}:\n{done.stdout}{done.stderr}")
    return done.stdout


def callgrind(options, *words):
    return run("valgrind", "--tool=callgrind", *options, *words, env={**os.environ, "GLIBC_TUNABLES": PLAIN_COPIES})


def counted(profile, *words, options=()):
    """Runs it; what it collects, and dumps where it says so, is in `profile` and `profile.N`. Gives what it prints."""
    return callgrind(["--collect-atstart=no", f"--callgrind-out-file={profile}", *options], *words)


# For `code_lines`, of what `counted` runs.
BY_ADDRESS = ("--dump-instr=yes", "--compress-pos=no")


def by_object(path):
    """Each line of a profile, with the file whose code it is about (the format of callgrind's profiles)."""
    names, within = {}, ""
    for line in path.read_text(encoding="utf-8", errors="replace").splitlines():
        if found := re.match(r"(c?)ob=\((\d+)\)(?: (.*))?", line):  # cob: of what is called
            name = names.setdefault(found[2], found[3])
            within = within if found[1] else name
        else:
            yield within, line


def code_lines(path, name):
    """Lines of 64 bytes of the code of that file which ran; the profile is by address."""
    found = (re.match(r"0x([0-9a-f]+) ", line) for within, line in by_object(path) if within and within.endswith(name))
    return len({int(each[1], 16) // 64 for each in found if each})


def touched(line, folder, *words):
    """Lines of that many bytes that the instrumented part touches: of code, of data."""
    profile = Path(folder) / "touched"
    caches = [f"--{cache}={CACHE},{line}" for cache in ("I1", "D1", "LL")]
    callgrind(["--instr-atstart=no", "--cache-sim=yes", *caches, f"--callgrind-out-file={profile}"], *words)
    text = profile.read_text(encoding="utf-8", errors="replace")
    events = re.search(r"^events: (.*)$", text, re.M)[1].split()
    totals = dict(zip(events, map(int, re.search(r"^totals: (.*)$", text, re.M)[1].split())))
    return totals.get("I1mr", 0), totals.get("D1mr", 0) + totals.get("D1mw", 0)


def self_costs(path):
    """Instructions by the file of the code, calls not included."""
    costs, skip = {}, False
    for within, line in by_object(path):
        if line.startswith("calls="):
            skip = True  # the next line is what the call costs, callee included
        elif found := re.match(r"[+\-*\d]\S* (\d+)$", line):
            if not skip:
                costs[within] = costs.get(within, 0) + int(found[1])
            skip = False
    return costs


def inclusive_cost(path, names):
    """Instructions of calls to functions whose names begin with one of these, with all that they call; and which of the
    names were seen. Calls among these functions would count twice."""
    known, seen, cost, callee, is_cost = {}, set(), 0, None, False
    for line in path.read_text(encoding="utf-8", errors="replace").splitlines():
        if found := re.match(r"(c?)fn=\((\d+)\)(?: (.*))?", line):
            name = known.setdefault(found[2], found[3])
            callee = next((each for each in names if name.startswith(each)), None) if found[1] else None
        elif line.startswith("calls="):
            is_cost = True
        elif is_cost:
            is_cost = False
            if callee is not None:
                seen.add(callee)
                cost += int(line.split()[1])
    return cost, seen
