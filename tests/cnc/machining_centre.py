"""The session of the machining centre: its own configuration of LinuxCNC, with technol.py in place of the display."""
import shutil
from pathlib import Path

HERE = Path(__file__).resolve().parent

# A change that the session loads while the machine works.
EDIT = "        LDR  I_COOL_LEVEL\n        WR   I_COOL_LEVEL\n"


def prepare(bench, options):
    """The folder of the example's configuration, as a user has it, and the compiled program."""
    program = Path(options.program)
    shutil.copytree(program / "linuxcnc", bench.home, dirs_exist_ok=True)
    bench.program(program)
    edited = bench.home / "edited"
    shutil.copytree(program, edited)
    supply = edited / "supply.plc"
    supply.write_text(supply.read_text(encoding="utf-8").replace("MODULE_MAIN_END", EDIT + "MODULE_MAIN_END"), encoding="utf-8")
    bench.program(edited, "edited.so")
    machine = bench.home / "machine.ini"
    text = machine.read_text(encoding="utf-8")
    text = text.replace("/usr/local/lib/rung/centre.so", str(bench.home / "program.so"))
    text = text.replace("DISPLAY = axis", "DISPLAY = ./technol.py")
    machine.write_text(text, encoding="utf-8")
    for name in ("technol.py", "drive.py"):
        bench.copy(HERE / name)
    for tool in (Path(options.rungc).parent / "rungctl", HERE.parents[1] / "tools/rung-hal/rung-operator"):
        shutil.copy(tool, bench.home)


def run(bench, options):
    """The words of result.txt: "passed", or what went wrong."""
    prepare(bench, options)
    bench.run("linuxcnc", "-r", str(bench.home / "machine.ini"))
    result = bench.home / "result.txt"
    return result.read_text(encoding="utf-8") if result.exists() else "LinuxCNC did not start the driver"
