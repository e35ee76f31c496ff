#!/usr/bin/env python3
"""docs/first-cnc.md, word by word: page_test.py --module rung_hal.so --rungc RUNGC

Its blocks ```sh run one after the other as one person types them, in a LinuxCNC of the test's own; the lines of its blocks
```text are in what they print, in their order; … is any text. Exit status 77: cannot be tried here, and why.
"""
import argparse
import re
import shutil
import tempfile
from pathlib import Path

import cnc_test

ROOT = Path(__file__).resolve().parents[2]
PAGE = ROOT / "docs" / "first-cnc.md"
PROGRAMS = ("rungc", "rungctl")


def blocks(language):
    return re.findall(rf"^```{language}\n(.*?)^```$", PAGE.read_text(encoding="utf-8"), re.DOTALL | re.MULTILINE)


def check_printed(output):
    at = 0
    for line in "".join(blocks("text")).splitlines():
        found = re.compile(f"^{re.escape(line).replace('…', '.*')}$", re.MULTILINE).search(output, at)
        cnc_test.expect(found is not None, f"not printed, or not in this place: {line}")
        at = found.end()


def check_trace(path):
    """The lamp goes off and comes on again."""
    lines = path.read_text(encoding="ascii").splitlines()
    lamp = next(line.split()[3] for line in lines if line.startswith("$var") and "COOLANT_LAMP" in line)
    values = [line[0] for line in lines if line in (f"0{lamp}", f"1{lamp}")]
    cnc_test.expect(values == ["1", "0", "1"], f"the lamp in the trace: {values}")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--module", default="", help="the component; empty when it was not built")
    parser.add_argument("--rungc", required=True)
    parser.add_argument("--libexec", required=True, help="the folder in which the component looks for its compiler")
    options = parser.parse_args()
    cnc_test.check_machine(options.module)
    with tempfile.TemporaryDirectory(dir="/var/tmp", prefix="rung-cnc-") as folder:
        bench = cnc_test.Bench(options, folder)
        shutil.copytree(ROOT / "examples" / "first-cnc", bench.home / "examples" / "first-cnc")
        for name in PROGRAMS:
            shutil.copy(Path(options.rungc).parent / name, bench.home)
        bench.file("page.sh", "set -eu\n" + "".join(blocks("sh")))
        done = bench.run("bash", "page.sh")
        log = bench.home / "mill" / "linuxcnc.log"
        if log.exists():
            print(log.read_text(encoding="utf-8", errors="replace"))
        cnc_test.expect(done.returncode == 0, f"a command of the page fails ({done.returncode})")
        check_printed(done.stdout)
        check_trace(bench.home / "mill" / "coolant.vcd")
    print("passed")


if __name__ == "__main__":
    main()
