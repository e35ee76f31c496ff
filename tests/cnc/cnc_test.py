#!/usr/bin/env python3
"""Tests of the LinuxCNC component in LinuxCNC itself: cnc_test.py CASE --module rung_hal.so --rungc RUNGC.

Every case has its own namespaces: several run at once, nothing of the machine is touched and nothing is left behind.
Exit status 77: cannot be tried here, and why.
"""
import argparse
import os
import pty
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

HERE = Path(__file__).resolve().parent
MODULES = Path("/usr/lib/linuxcnc/modules")  # LinuxCNC loads from nowhere else
SKIPPED = 77
TIMEOUT = 270  # seconds that a session takes at most, on a machine without other work
TIME = r"\d{4}-\d\d-\d\d \d\d:\d\d:\d\d"  # at the beginning of what the component writes
PATIENCE = HERE.parent / "support" / "patience.py"  # what waits, in a session as outside
sys.path.insert(0, str(PATIENCE.parent))
from patience import patience  # noqa: E402  pylint: disable=wrong-import-position

# LinuxCNC refuses root. Its lock file lies in /tmp, HAL's shared memory is System V's, its servers have fixed ports.
INSIDE = """
ip link set lo up
mount --bind "$D/tmp" /tmp
mount --bind {modules} "$D/original"
mount --bind "$D/modules" {modules}
if [ -n "{libexec}" ]; then mkdir -p "{libexec}"; mount --bind "$D/libexec" "{libexec}"; fi
cd "$D/home"
exec runuser -u nobody -- env -i PATH="$D/home:/usr/bin:/bin" HOME="$D/home" LANG=C.UTF-8 "$@"
"""


def skip(reason):
    print(f"skipped: {reason}")
    sys.exit(SKIPPED)


def check_machine(module):
    if not shutil.which("linuxcnc") or not MODULES.is_dir():
        skip("LinuxCNC is not installed")
    if not module:
        skip("the component was not built: LinuxCNC's headers were missing, or a sanitizer is on")
    if os.geteuid() != 0:
        skip("needs root, to give each test its own namespaces")
    for tool in ("unshare", "ip", "runuser", "mount"):
        if not shutil.which(tool):
            skip(f"{tool} is not installed")
    if subprocess.run(unshare(["mount", "--bind", "/tmp", "/tmp"]), capture_output=True, check=False).returncode != 0:
        skip("this system does not allow namespaces")


def unshare(command):
    return ["unshare", "--mount", "--ipc", "--pid", "--net", "--fork", "--kill-child", "--mount-proc", *command]


class Bench:
    """A folder with all that a session needs, readable by an ordinary user."""

    def __init__(self, options, folder):
        self.folder = Path(folder)
        self.home = self.folder / "home"
        for name in ("home", "tmp", "modules", "original"):
            (self.folder / name).mkdir()
        self.folder.chmod(0o755)
        (self.folder / "tmp").chmod(0o1777)
        for original in MODULES.iterdir():
            (self.folder / "modules" / original.name).symlink_to(self.folder / "original" / original.name)
        link = self.folder / "modules" / "rung_hal.so"
        link.unlink(missing_ok=True)
        shutil.copy(options.module, link)
        shutil.copy(PATIENCE, self.home)
        self.rungc = options.rungc
        self.libexec = options.libexec
        self.programs = set()
        if self.libexec:  # where the component looks for its compiler
            (self.folder / "libexec").mkdir()
            shutil.copy(Path(options.rungc).parent / "rung-compile", self.folder / "libexec")

    def program(self, source, name="program.so"):
        subprocess.run([self.rungc, "build", source, "-o", self.home / name], check=True)
        self.programs.add(self.home / name)

    def file(self, name, text):
        path = self.home / name
        path.write_text(text.replace("@DIR@", str(self.home)), encoding="utf-8")
        return path

    def copy(self, source, name=None):
        text = Path(source).read_text(encoding="utf-8")
        path = self.file(name or Path(source).name, text)
        shutil.copymode(source, path)

    def inside(self, *command):
        """The command line that runs it in the session's namespaces, as an ordinary user, and its environment."""
        for path in [self.home, *self.home.rglob("*")]:
            if path not in self.programs:  # LinuxCNC's rtapi_app runs what is root's
                shutil.chown(path, "nobody")
        shell = ["sh", "-ec", INSIDE.format(modules=MODULES, libexec=self.libexec), "sh", *command]
        return unshare(shell), {**os.environ, "D": str(self.folder)}

    def run(self, *command):
        """In a session of its own, which has its share of a busy processor, and with it a compiler of lowest priority in it."""
        line, environment = self.inside(*command)
        done = subprocess.run(line, env=environment, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                              stderr=subprocess.STDOUT, text=True, errors="replace", timeout=patience(TIMEOUT), check=False,
                              start_new_session=True)
        print(done.stdout)
        return done

    def halrun(self, commands):
        self.file("until", UNTIL).chmod(0o755)
        self.file("said", SAID).chmod(0o755)
        shutil.copy(Path(self.rungc).parent / "rungctl", self.home)
        self.file("test.hal", commands)
        return self.run("halrun", "test.hal")


def expect(condition, what):
    if not condition:
        raise AssertionError(what)


# A change of the programs of `remote`, by the ending of their files: a rung more.
EDITS = {".pmc": ("FUNC END2", "LD   COOLANT_FLOW\nOUT  R90.0\n\nFUNC END2")}
REMOTE = '\n[rungctl]\npermissions = ["set", "force", "reload"]\nprotected = ["ESTOP_OK"]\n'


def prepare_remote(bench, options):
    program = Path(options.program)
    text = program.read_text(encoding="utf-8")
    old, new = EDITS[program.suffix]
    expect(text.count(old) == 1, f"{old} is not once in {program}")
    bench.program(bench.file("edited" + program.suffix, text.replace(old, new)), "edited.so")
    if "alarm" in options.steps.split():
        endless = text.replace(old, "FUNC LBL\nPRM  L9\nLD   ESTOP_OK\nFUNC JMPB\nPRM  L9\n\n" + old)
        bench.program(bench.file("endless.pmc", endless), "endless.so")
    bench.file("flow.txt", options.flow)


def session(bench, options):
    """A whole LinuxCNC: spindle, coolant, tool change, a part program, emergency stop."""
    bench.program(options.program)
    map_text = "".join(Path(path).read_text(encoding="utf-8") for path in options.map)
    if "remote" in options.steps.split():
        prepare_remote(bench, options)
        map_text += REMOTE
    bench.file("program.map", map_text)
    for tool in (Path(options.rungc).parent / "rungctl", HERE.parents[1] / "machine/rung-hal/rung-operator"):
        shutil.copy(tool, bench.home)
    for name in ("machine.ini", "machine.hal", "tool.tbl", "drive.py"):
        bench.copy(HERE / name)
    bench.file("steps.txt", options.steps)
    start_machine(bench)


def start_machine(bench):
    """What LinuxCNC has printed meanwhile."""
    output = bench.run("linuxcnc", "-r", str(bench.home / "machine.ini")).stdout
    result = bench.home / "result.txt"
    expect(result.exists(), "LinuxCNC did not start the driver")
    expect(result.read_text(encoding="utf-8") == "passed", result.read_text(encoding="utf-8"))
    return output


PROGRAM_AXIS = """
[JOINT_3]
TYPE = LINEAR
MIN_LIMIT = -100
MAX_LIMIT = 100
MAX_VELOCITY = 100
MAX_ACCELERATION = 2000
FERROR = 50
MIN_FERROR = 50
HOME = 0
HOME_SEARCH_VEL = 0
HOME_SEQUENCE = 0
"""


def prepare_extra_joint(bench, options, program, joint):
    """A machine with a fourth joint, and the files that have the name of the program."""
    name = Path(program).stem
    bench.program(HERE / program)
    bench.copy(HERE / f"{name}.map", "program.map")
    ini = (HERE / "machine.ini").read_text(encoding="utf-8") + joint
    for old, new in (("JOINTS = 3", "JOINTS = 4"), ("coordinates=XYZ", "coordinates=XYZ kinstype=BOTH"),
                     ("./drive.py", f"./{name}.py")):
        expect(ini.count(old) == 1, f"{old} is not once in machine.ini")
        ini = ini.replace(old, new)
    bench.file("machine.ini", ini)
    bench.copy(HERE / f"{name}.hal", "machine.hal")
    for file in ("tool.tbl", "drive.py", f"{name}.py"):
        bench.copy(HERE / file)
    tools = HERE.parents[1] / "machine/rung-hal"
    for tool in (Path(options.rungc).parent / "rungctl", tools / "rung-operator", tools / "rung-services"):
        shutil.copy(tool, bench.home)


def services(bench, options):
    """What a program asks of its CNC: LinuxCNC moves an axis for it, and gives and takes data."""
    prepare_extra_joint(bench, options, "services.pmc", PROGRAM_AXIS)
    start_machine(bench)


def axes(bench, options):
    """The positioning unit of a TECHNOL program moves an extra joint, whose reference is not at 0."""
    prepare_extra_joint(bench, options, "axes.plc", PROGRAM_AXIS.replace("HOME = 0\n", "HOME = 7\nHOME_OFFSET = 7\n"))
    output = start_machine(bench)
    for reason in ("POS_INIT is refused: the axis has no reference", "the positioning unit has lost the axis: its drive"):
        expect(re.search(rf"^rung: {TIME} axis 4: {re.escape(reason)}", output, re.MULTILINE), f"no message: {reason}")


LOAD = """
loadrt threads name1=servo period1=1000000
loadrt rung_hal so=@DIR@/program.so map=@DIR@/program.map {options}
addf {prefix}.scan servo
start
"""


# Pins of HAL, what test(1) is to find of their values, in their order; after so many looks it is shown as it is.
UNTIL = """#!/bin/sh
tries=6000
while [ $# -gt 0 ] && [ $tries -gt 0 ]; do
  if [ "$(halcmd getp "$1")" "$2" "$3" ]; then shift 3; else tries=$((tries - 1)); sleep 0.01; fi
done
"""
# The same with a text in the messages of the program.
SAID = """#!/bin/sh
tries=6000
until rungctl messages | grep -qF "$*" || [ $tries = 0 ]; do tries=$((tries - 1)); sleep 0.01; done
"""


def until(*conditions):
    """Lines for halrun that wait for "PIN = VALUE"."""
    return f"loadusr -w ./until {' '.join(conditions)}\n"


def said(*texts):
    """Lines for halrun that wait for words in the program's messages."""
    return "".join(f"loadusr -w ./said {text}\n" for text in texts)


def shown(output, pin):
    """Values of a pin in the outputs of `show pin`, in order."""
    rows = [line.split() for line in output.splitlines()]
    return [row[3] for row in rows if len(row) >= 5 and row[4] == pin]


def fault(bench, _options):
    """A program that loops for ever: the watchdog stops it, outputs go to 0, pins and a message tell."""
    bench.program(HERE / "stuck.pmc")
    bench.copy(HERE / "stuck.map", "program.map")
    show = "show pin box\n"
    runs = until("box.fault = FALSE", "box.lamp = TRUE") + show
    stopped = until("box.fault = TRUE", "box.lamp = FALSE", "box.fault-line -gt 0") + show
    # The thread that scans counts a hundred times two of its periods meanwhile.
    stays = "setp updown.0.reset 1\nsetp updown.0.reset 0\n" + until("updown.0.count -ge 100")
    counts = "loadrt charge_pump\nloadrt updown\naddf charge-pump servo\naddf updown.0 servo\nnet tick charge-pump.out updown.0.countup\n"
    done = bench.halrun(LOAD.format(options="names=box", prefix="box") + counts + "setp box.number 77\nsetp box.run 1\n" + runs +
                        "setp box.stick 1\n" + stopped + "setp box.stick 0\n" + stays + show +
                        "setp box.reset 1\n" + runs + said("the program has been restarted") + "show funct\n")
    values = {pin: shown(done.stdout, "box." + pin) for pin in ("lamp", "value", "fault", "fault-line", "scans")}
    expect(values["lamp"] == ["TRUE", "FALSE", "FALSE", "TRUE"], values)
    expect([float(value) for value in values["value"]] == [77, 0, 0, 77], values)
    expect(values["fault"] == ["FALSE", "TRUE", "TRUE", "FALSE"], values)
    lines = (HERE / "stuck.pmc").read_text(encoding="utf-8").splitlines()
    loop = range(lines.index("FUNC LBL") + 1, lines.index("PRM  L1", lines.index("FUNC JMPB")) + 2)
    expect(int(values["fault-line"][1], 0) in loop, values)
    expect(int(values["scans"][0], 0) > 0, values)
    expect(re.search(rf"^box: {TIME} the program has stopped: dead-loop \(rung 3, ", done.stdout, re.MULTILINE), "no message")
    expect("stuck.pmc:" in done.stdout, "no source file in the message")
    expect(re.search(rf"^box: {TIME} the program has been restarted$", done.stdout, re.MULTILINE), "no message of the restart")


def killed(bench, _options):
    """What the log of the program has said is not lost with the process."""
    bench.program(HERE / "stuck.pmc")
    bench.copy(HERE / "stuck.map", "program.map")
    done = bench.halrun(LOAD.format(options="names=box", prefix="box") + "setp box.stick 1\n" + until("box.fault = TRUE") +
                        said("the program has stopped") + "loadusr -w pkill -KILL rtapi_app\n")
    expect(re.search(rf"^box: {TIME} the program has stopped: dead-loop", done.stdout, re.MULTILINE), "the log is lost")


# TECHNOL: while GO is on, a byte to the serial port and half of the full voltage at the analogue output 6.
DEVICES = """DATA
        DFM GO
DATA_END
MODULE_INPUT
MODULE_INPUT_END
MODULE_BLOCK_INIT
MODULE_BLOCK_INIT_END
MODULE_BLOCK_DONE
MODULE_BLOCK_DONE_END
MODULE_INIT
MODULE_INIT_END
MODULE_CLEAR
MODULE_CLEAR_END
MODULE_HALT
MODULE_HALT_END
MODULE_MAIN
        LDR  GO
        JL0  REST
        COM_SEND 1,41h
        ANALOG_PORT 6
        ANALOG 4000h
        SPI_AX ,,,,4
REST:
MODULE_MAIN_END
STOP
"""


def devices(bench, _options):
    """A TECHNOL program with a serial port of this machine, and its analogue outputs as pins."""
    master, slave = pty.openpty()
    os.chmod(os.ttyname(slave), 0o666)
    os.set_blocking(master, False)
    bench.program(bench.file("devices.plc", DEVICES))
    bench.file("program.map", 'in.go = { type = "bit", name = "GO" }\n'
                              f'[devices]\ncom = {{ 1 = "{os.ttyname(slave)}", 2 = "/dev/no-such-port" }}\n')
    done = bench.halrun(LOAD.format(options="", prefix="rung") + "setp rung.go 1\n" +
                        until("rung.scans -gt 30", "rung.analog-out-6 != 0") +
                        "show pin rung.analog-out-6\nshow pin rung.analog-out-7\n")
    values = [float(shown(done.stdout, f"rung.analog-out-{port}")[0]) for port in (6, 7)]
    expect(abs(values[0] - 0x4000 / 0x7FFF) < 1e-4 and values[1] == 0, values)
    expect(os.read(master, 1024).startswith(b"AAA"), "nothing has left the port")
    expect("/dev/no-such-port cannot be opened: No such file or directory" in done.stdout, "a missing device")
    expect("SPI_AX: this host cannot move axes for the program" in done.stdout, "a refused instruction")


def instances(bench, _options):
    """Two programs with a map each, in two threads."""
    bench.program(HERE / "stuck.pmc")
    bench.copy(HERE / "stuck.map", "program.map")
    bench.file("other.map", 'param.limit = { type = "s32", name = "D8:4", value = 42 }\n'
                            'out.limit-now = { type = "s32", name = "D8:4" }\n')
    done = bench.halrun("loadrt threads name1=servo period1=1000000 name2=slow period2=8000000\n"
                        "loadrt rung_hal names=left,right so=@DIR@/program.so map=@DIR@/program.map,@DIR@/other.map\n"
                        "addf left.scan servo\naddf right.scan slow\nstart\nsetp left.run 1\n" +
                        until("left.lamp = TRUE", "right.limit-now = 42") + "show pin left.lamp\nshow pin right.limit-now\n"
                        "setp right.limit 43\n" + until("right.limit-now = 43") + "show pin right.limit-now\nshow param right.limit\n")
    expect(shown(done.stdout, "left.lamp") == ["TRUE"], "left does not run")
    expect(shown(done.stdout, "right.limit-now") == ["42", "43"], shown(done.stdout, "right.limit-now"))
    expect(done.returncode == 0, done.returncode)


def unload(bench, _options):
    """Unloaded while its thread runs, it switches its outputs off, and can be loaded again, many times."""
    bench.program(HERE / "stuck.pmc")
    bench.copy(HERE / "stuck.map", "program.map")
    load = "loadrt rung_hal so=@DIR@/program.so map=@DIR@/program.map names=box\naddf box.scan servo\n"
    run = "setp box.run 1\n" + until("box.lamp = TRUE") + "show sig\n"
    again = "unloadrt rung_hal\nshow sig\n" + load + "net lamp box.lamp\n" + run
    done = bench.halrun("loadrt threads name1=servo period1=1000000\nstart\nnewsig lamp bit\n" + load +
                        "net lamp box.lamp\n" + run + 10 * again)
    lamps = [row.split()[1] for row in done.stdout.splitlines() if row.split()[-1:] == ["lamp"] and len(row.split()) == 3]
    expect(lamps == ["TRUE"] + 10 * ["FALSE", "TRUE"], lamps)
    expect(done.returncode == 0, done.returncode)


def retained(bench, _options):
    """D and the log continue where the last session stopped; a place that cannot be written stops the loading."""
    bench.program(HERE / "stuck.pmc")
    kept = 'out.kept = { type = "s32", name = "D4:4" }\n'
    bench.file("program.map", 'in.number = { type = "s32", name = "D4:4" }\n' + kept)
    bench.file("first.map", kept)
    load = LOAD.format(options="retain=@DIR@/memory", prefix="rung")
    show = until("rung.kept = 4711") + "show pin rung.kept\nloadusr -w @DIR@/rungctl top --once\n"
    bench.halrun(load + "setp rung.number 4711\n" + show)
    done = bench.halrun(load.replace("program.map", "first.map") + show)
    expect(shown(done.stdout, "rung.kept") == ["4711"], shown(done.stdout, "rung.kept"))
    expect(re.search(r"\nscan: last [\d.]+ us, longest [\d.]+\b", done.stdout), "no times of scans")
    expect(done.stdout.count("started with the program stuck, code ") == 3, "its start is printed once, and twice in the log")
    log = bench.home / "memory.log"
    expect((log.read_text().count("started with"), log.read_text().count("the host has ended")) == (2, 2), "not two sessions in the log")
    expect(log.owner() == "nobody", log.owner())
    done = bench.halrun(LOAD.format(options="retain=/nowhere/memory", prefix="rung"))
    expect("cannot write /nowhere/memory" in done.stdout, "no message")


def mistakes(bench, _options):
    """What is wrong with the files is reported at the start, and nothing is loaded then."""
    bench.program(HERE / "stuck.pmc")

    def load(text, options="", prefix="rung"):
        bench.file("program.map", text)
        done = bench.halrun(LOAD.format(options=options, prefix=prefix))
        expect(done.returncode != 0, "loaded in spite of the mistake")
        return done.stdout

    output = load("""[in]
a = { type = "bit", name = "X0.0" }
b = { type = "bit", name = "Y0.0" }
[out]
c = { type = "bit", name = "NOWHERE" }
[[abort]]
pin = "a"
edge = "up"
""")
    expect("program.map:3:28: in.b.name: found Y0.0, an output of the program, expected" in output, "line 3")
    expect("program.map:5:28: out.c.name: found an unknown name NOWHERE, expected" in output, "line 5")
    expect('program.map:8:8: abort.edge: found "up", expected "rise" or "fall"; write' in output, "line 8")
    # Connections are rung-run's; what nobody knows is not passed over.
    output = load("""[out]
lamp = { type = "bit", name = "Y0.0", sfae = true }
[modbus-server]
discrete-inputs = { lamp = 0 }
[shared-memory]
name = "box"
pins = { lamp = 0 }
[[sned]]
pin = "a"
""")
    refused = ": found a connection that only rung-run serves, expected none in LinuxCNC, where HAL connects the pins; remove the table ["
    for line, table in ((3, "modbus-server"), (5, "shared-memory")):
        expect(f"program.map:{line}:1: {table}{refused}{table}]" in output, f"the table {table}")
    expect("program.map:2:39: out.lamp: found an unknown key sfae, expected type, name, scale, bits, safe; did you mean safe?" in output,
           "an unknown key of a pin")
    expect("program.map:8:3: the file: found an unknown key sned, expected include, " in output and "; did you mean send?" in output,
           "an unknown table")
    output = load("[in]\nin bit a X0.0\n")
    expect("program.map:2:4: Error while parsing key-value pair" in output, "not TOML")
    expect("cannot make pin rung.fault" in load('out.fault = { type = "bit", name = "Y0.0" }\n'), "a reserved name")
    expect("rung_hal: cannot load /nowhere.so: " in load("", "so=/nowhere.so"), "a missing program")
    expect("and2.so: it has no seal" in load("", "so=/usr/lib/linuxcnc/modules/and2.so"), "not a program")
    shutil.copy(bench.home / "program.so", bench.home / "nobodys.so")
    expect("nobodys.so: it belongs to user" in load("", "so=@DIR@/nobodys.so"), "a program that is not root's")
    expect("rung_hal: cannot read /nowhere.map" in load("", "map=/nowhere.map"), "a missing map")
    output = load("", "names=a,b,c map=/nowhere.map,/nowhere.map")
    expect("one for all instances or one for each of names=" in output, "two maps for three instances")
    # Files are opened with the rights of the user: what only root can read stays unread.
    secret = bench.folder / "secret.map"
    secret.write_text("secret of root\n", encoding="utf-8")
    secret.chmod(0o600)
    output = load("", "map=@DIR@/../secret.map") + load('include = "../secret.map"\n') + load('PlcErrors = "../secret.map"\n')
    expect(output.count("secret.map: Permission denied") == 3 and "secret of root" not in output, "root's file was read")
    output = load("", "retain=@DIR@/../memory")
    expect("/../memory" in output and not list(bench.folder.glob("memory*")), "root's folder was written")


def sources(bench, options):
    """LinuxCNC's process, which has root's rights, compiles sources at its start and for rungctl."""
    source = (HERE / "stuck.pmc").read_text(encoding="utf-8")
    for name, text in {"first.pmc": source, "edited.pmc": source.replace("LD   X1.0", "LDI  X1.0", 1),
                       "wrong.pmc": source.replace("OUT  Y0.0", "OUT  X0.5")}.items():
        expect(name == "first.pmc" or text != source, f"{name} is the same")
        bench.file(name, text)
    map_text = (HERE / "stuck.map").read_text(encoding="utf-8")
    bench.file("program.map", map_text + '\n[rungctl]\npermissions = ["reload"]\n')
    shutil.copy(Path(options.rungc).parent / "rungctl", bench.home)
    load = LOAD.format(options="names=box", prefix="box").replace("so=@DIR@/program.so", "source=@DIR@/first.pmc")
    show = "show pin box\n"
    lit = until("box.lamp = TRUE") + show
    done = bench.halrun(load + "setp box.run 1\n" + lit + "loadusr -w rungctl reload @DIR@/edited.pmc\n" +
                        until("box.lamp = FALSE") + show + "loadusr -w rungctl rollback\n" + lit)
    expect(shown(done.stdout, "box.lamp") == ["TRUE", "FALSE", "TRUE"], shown(done.stdout, "box.lamp"))
    expect("reload edited, compiled here from sources" in done.stdout, "no message of the reload")

    def refused(source):
        done = bench.halrun(load.replace("@DIR@/first.pmc", source))
        expect(done.returncode != 0, f"loaded {source}")
        return done.stdout

    wrong = refused("@DIR@/wrong.pmc")
    expect("home/wrong.pmc:" in wrong and "error: " in wrong, "no place of the mistake")
    secret = bench.folder / "secret.pmc"  # whose rights are those of its user
    secret.write_text(source, encoding="utf-8")
    secret.chmod(0o600)
    expect("secret.pmc': Permission denied" in refused("@DIR@/../secret.pmc"), "root's file was read")
    expect("exclude each other" in refused("@DIR@/first.pmc so=@DIR@/program.so"), "both")
    shutil.chown(bench.folder / "libexec/rung-compile", "nobody")
    expect("it must be writable only by root" in refused("@DIR@/first.pmc"), "a compiler that is not root's was started")
    (bench.folder / "libexec/rung-compile").unlink()
    expect("install the package rung" in refused("@DIR@/first.pmc"), "no message of the missing compiler")


def main():
    cases = {case.__name__: case for case in (session, services, axes, fault, killed, devices, sources, instances, unload, retained, mistakes)}
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("case", choices=cases)
    parser.add_argument("--module", default="", help="the component; empty when it was not built")
    parser.add_argument("--rungc", required=True)
    parser.add_argument("--libexec", default="", help="the folder in which the component looks for rung-compile")
    parser.add_argument("--program", default=HERE / "handshake.pmc", help="source of the PLC program of `session`")
    parser.add_argument("--steps", default="spindle coolant tools part counters remote alarm emergency_stop", help="what `session` does, in order")
    parser.add_argument("--flow", default="COOLANT_FLOW", help="the program's flow switch, which no rung writes")
    parser.add_argument("--map", nargs="+", default=[HERE / "handshake.map"], help="its mapping file, in one or several pieces")
    options = parser.parse_args()
    check_machine(options.module)
    with tempfile.TemporaryDirectory(dir="/var/tmp", prefix="rung-cnc-") as folder:
        cases[options.case](Bench(options, folder), options)
    print("passed")


if __name__ == "__main__":
    main()
