#!/usr/bin/env python3
"""rung-run with a CAN interface of a Linux that has one, in Debian's user-mode Linux: in_uml.py BIN

The kernel of many machines, and of containers, has no CAN. That of the package user-mode-linux runs as a process without
any rights, has the file system of its host as its own, and CAN as modules. It runs vcan_test.py with the programs of BIN;
what has not booted, or has not come to its end, has failed. The kernel 6.1 of that package has no room for the registers of a
processor with AMX: "ptrace set fp regs failed"."""
import os
import shlex
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
PROGRAMS = ("can", "can-orders-1", "can-orders-2", "can-orders-3")  # of the scenarios
MODULES = ("can", "can-raw", "can-dev", "vcan", "sch_tbf")
PATIENCE = 300  # seconds; it takes some 20
INIT = """#!/bin/sh
export PATH=/usr/sbin:/usr/bin:/sbin:/bin
exec >{folder}/boot 2>&1
mount -t proc proc /proc
mount -t sysfs sysfs /sys
mount -t tmpfs tmpfs /run
for module in {modules}; do insmod "$(find /usr/lib/uml/modules/$(uname -r) -name $module.ko)"; done
ip link set lo up
cd {root}
TMPDIR=/run RUNG_SOCKETS=/run/rung python3 tests/can/vcan_test.py {bin} {folder} >{folder}/log 2>&1
echo $? >{folder}/status
echo o >/proc/sysrq-trigger
sleep 60
"""


def boot(folder):
    """Until it has switched itself off."""
    init = folder / "init"
    arguments = ["linux.uml", "root=/dev/root", "rootfstype=hostfs", "rootflags=/", "rw", "mem=512M", "quiet",
                 f"init={init}", "con=null", "con0=null,fd:1", f"uml_dir={folder}"]
    with open(folder / "kernel", "w", encoding="utf-8") as log:
        try:
            subprocess.run(arguments, stdin=subprocess.DEVNULL, stdout=log, stderr=subprocess.STDOUT, timeout=PATIENCE, check=False)
        except subprocess.TimeoutExpired:
            log.write(f"it has not ended within {PATIENCE} s\n")


def contents(folder, *names):
    """What has been written of these files, the last lines of each."""
    for name in names:
        path = folder / name
        if path.exists():
            lines = [line for line in path.read_text(encoding="utf-8", errors="replace").splitlines() if not line.startswith(" [<")]
            print(f"-- {name}", *lines[-40:], sep="\n")


def main():
    programs = Path(sys.argv[1]).resolve()
    if shutil.which("linux.uml") is None:
        print("no user-mode Linux: install the package user-mode-linux (./dev setup --check)")
        return 1
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        for program in PROGRAMS:
            subprocess.run([programs / "rungc", "build", "-q", ROOT / f"tests/scenarios/technol/{program}.plc", "-o", folder / f"{program}.so"],
                           check=True)
        words = {"folder": folder, "root": ROOT, "bin": programs}
        init = folder / "init"
        init.write_text(INIT.format(modules=" ".join(MODULES), **{key: shlex.quote(str(value)) for key, value in words.items()}),
                        encoding="utf-8")
        init.chmod(0o755)
        boot(folder)
        status = folder / "status"
        good = status.exists() and status.read_text(encoding="utf-8").strip() == "0"
        contents(folder, "log", *(() if good else ("boot", "kernel")))
        if not status.exists():
            print("the user-mode Linux has not booted, or the tests have not ended")
        return 0 if good else 1


if __name__ == "__main__":
    os.chdir(ROOT)
    sys.exit(main())
