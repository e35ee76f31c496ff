"""The session of the machining centre: its own configuration of LinuxCNC, with technol.py in place of the display."""
import shutil
from pathlib import Path

HERE = Path(__file__).resolve().parent


def prepare(bench, options):
    """The folder of the example's configuration, as a user has it, and the compiled program."""
    program = Path(options.program)
    shutil.copytree(program / "linuxcnc", bench.home, dirs_exist_ok=True)
    bench.program(program)
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
