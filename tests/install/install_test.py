#!/usr/bin/env python3
"""What `cmake --install` leaves serves others without source and build: install_test.py CMAKE BUILD_DIR SOURCE_DIR

Everything is copied from the installed tree, and runs in an environment of its own. Where the system lets us, the
source and the build are not even there for what runs.
"""
import os
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
import xml.etree.ElementTree
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "support"))
from patience import patience

CMAKE = BUILD = SOURCE = None
FOLDER = None  # temporary
HOME = PREFIX = None  # in it: the working directory, and what is installed
SAID = ""  # by the installation
HIDE = []  # before a command: it does not see source and build
SUFFIXES_OF_TEXT = {".cmake", ".pc", ".h", ".hpp", ".py", ".xml", ".svg", ".md", ".1", ".5", ".9", ""}

PARENT = """cmake_minimum_required(VERSION 3.25)
project(parent LANGUAGES C CXX)
add_subdirectory("${RUNG}" rung)
add_executable(host main.c)
target_link_libraries(host Rung::runtime)
"""


def run(*command, hidden=True, check=True, cwd=None, timeout=300, **more):
    environment = {"PATH": "/usr/local/bin:/usr/bin:/bin", "HOME": str(HOME), "LANG": "C.UTF-8", "TMPDIR": FOLDER.name}
    done = subprocess.run([*(HIDE if hidden else []), *map(str, command)], env=environment | more, cwd=cwd or HOME,
                          stdin=subprocess.DEVNULL, capture_output=True, text=True, timeout=patience(timeout))
    if check and done.returncode != 0:
        raise AssertionError(f"{' '.join(map(str, command))}: status {done.returncode}\n{done.stdout}{done.stderr}")
    return done


def hiding():
    """The words before a command that take source and build from its sight."""
    script = 'mount -t tmpfs none "$0" && mount -t tmpfs none "$1" 2>/dev/null; shift; exec "$@"'
    for options in ([], ["--user", "--map-root-user"]):  # root, or who may call himself so
        words = ["unshare", *options, "--mount", "sh", "-c", script, str(SOURCE), str(BUILD)]
        tried = subprocess.run([*words, "test", "!", "-e", str(SOURCE / "README.md")], capture_output=True)
        if tried.returncode == 0:
            return words
    if os.environ.get("CI"):
        raise RuntimeError("source and build cannot be hidden here, so nothing would be proven")
    return []


def setUpModule():
    global FOLDER, HOME, PREFIX, HIDE
    FOLDER = tempfile.TemporaryDirectory()
    unittest.addModuleCleanup(FOLDER.cleanup)
    HOME, PREFIX = Path(FOLDER.name) / "home", Path(FOLDER.name) / "prefix"
    HOME.mkdir()
    global SAID
    SAID = run(CMAKE, "--install", BUILD, "--prefix", PREFIX, hidden=False).stdout
    shutil.copytree(PREFIX / "share/doc/rung/examples", HOME / "examples")
    HIDE = hiding()
    for name in ("axis", "axis-2"):
        run(PREFIX / "bin/rungc", "build", f"examples/embed-plc/{name}.lad", "-o", f"{name}.so", "--profile",
            "--no-project", "-q")


def library_folder():
    return next(PREFIX.glob("lib/**/librung-runtime.so.0")).parent


def is_elf(path):
    with open(path, "rb") as file:
        return file.read(4) == b"\x7fELF"


class Hosts(unittest.TestCase):
    def check_toy(self, *command, **environment):
        done = run(*command, "axis.so", "axis-2.so", **environment)
        self.assertRegex(done.stdout, r"70\d ms: dead-loop \(rung 5, \S*axis\.lad:\d+\)\n")
        self.assertRegex(done.stdout, r"1\d\d\d ms: the new program runs\n")
        self.assertRegex(done.stdout, r"(?m)^1\d strokes; the worst rung is .*axis-2\.lad:\d+$")

    def check_libraries(self, program, *names):
        found = run("ldd", program).stdout
        for name in names:
            self.assertIn(f"{name} => {library_folder()}/", found)

    def test_cmake_package(self):
        run(CMAKE, "-S", "examples/embed-plc", "-B", "hosts", f"-DCMAKE_PREFIX_PATH={PREFIX}", "-DCMAKE_COMPILE_WARNING_AS_ERROR=ON",
            "-DCMAKE_C_FLAGS=-Wall", "-DCMAKE_CXX_FLAGS=-Wall")
        run(CMAKE, "--build", "hosts")
        for name in ("embed-c", "embed-cpp"):
            with self.subTest(host=name):
                self.check_toy(HOME / "hosts" / name)
                self.check_libraries(HOME / "hosts" / name, "librung-runtime.so.0")
        self.check_libraries(HOME / "hosts/embed-jit", "librung-runtime.so.0", "librung-compiler.so.0")
        done = run(HOME / "hosts/embed-jit", "examples/embed-plc/axis.lad", "examples/embed-plc/axis-2.lad")
        self.assertEqual((done.stdout, done.stderr),
                         ("the drive is on at 0 mm: 1, at 6 mm: 0\n"
                          "the new program, which goes further: 1, at 6 mm: 1\n", ""))

    def test_pkg_config(self):
        def asked(*words):
            return run("pkg-config", *words, PKG_CONFIG_PATH=str(library_folder() / "pkgconfig")).stdout.split()

        run("cc", "-std=c11", "-Wall", "-Werror", "-D_GNU_SOURCE", *asked("--cflags", "rung-runtime"), "-o", "by-pkg",
            "examples/embed-c/main.c", *asked("--libs", "rung-runtime"),
            "-Wl,-rpath," + asked("--variable=libdir", "rung-runtime")[0])
        self.check_toy(HOME / "by-pkg")
        self.check_libraries(HOME / "by-pkg", "librung-runtime.so.0")
        self.assertIn("-lrung-runtime", asked("--libs", "rung-compiler"))
        self.assertEqual(asked("--modversion", "rung-compiler"), asked("--modversion", "rung-runtime"))

    def test_bound_by_its_header(self):
        if not (Path(BUILD) / "bin/rung-layout").exists():
            self.skipTest("this build leaves rungc bind out")
        toy = "examples/embed-struct"
        run(PREFIX / "bin/rungc", "bind", f"{toy}/nc_block.h", f"{toy}/panel.lad", "--no-project", "--struct", "nc_block", "--members", f"{toy}/nc.bind",
            "-o", "nc_binding.h")
        run(PREFIX / "bin/rungc", "build", f"{toy}/panel.lad", "--no-project", "-q", "--binding", "nc_binding.h", "-o", "panel.so")
        run("cc", "-std=c11", "-Wall", "-Werror", f"-I{PREFIX}/include", "-I.", f"-I{toy}", f"{toy}/main.c", "-o", "by-header",
            library_folder() / "librung-runtime.so", f"-Wl,-rpath,{library_folder()}")
        self.assertIn("; no whole copy for 5 slices\n", run(HOME / "by-header", "panel.so").stdout)

    def test_python(self):
        folder = str(next(PREFIX.glob("lib/python3/**/rung.py")).parent)
        found = run("python3", "-c", "import rung; print(rung.__file__, rung._library._name)", PYTHONPATH=folder)
        for path in found.stdout.split():
            self.assertTrue(Path(path).resolve().is_relative_to(PREFIX), found.stdout)
        self.check_toy("python3", "-B", "examples/embed-python/axis.py", PYTHONPATH=folder)


class CMakePackage(unittest.TestCase):
    def configure(self, text, check=True):
        with tempfile.TemporaryDirectory(dir=HOME) as folder:
            text = f"cmake_minimum_required(VERSION 3.25)\nproject(asks LANGUAGES C)\n{text}\n"
            (Path(folder) / "CMakeLists.txt").write_text(text)
            return run(CMAKE, "-S", folder, "-B", f"{folder}/build", f"-DCMAKE_PREFIX_PATH={PREFIX}", check=check)

    def test_runtime_alone(self):
        self.configure("find_package(Rung REQUIRED COMPONENTS runtime)\n"
                       "if(NOT TARGET Rung::runtime OR TARGET Rung::compiler)\nmessage(FATAL_ERROR wrong)\nendif()")

    def test_the_compiler_brings_the_runtime(self):
        self.configure("find_package(Rung REQUIRED COMPONENTS compiler)\n"
                       "if(NOT TARGET Rung::runtime OR NOT TARGET Rung::compiler)\nmessage(FATAL_ERROR wrong)\nendif()")

    def test_without_components_all_are_found(self):
        self.configure("find_package(Rung REQUIRED)\n"
                       "if(NOT TARGET Rung::runtime OR NOT TARGET Rung::compiler)\nmessage(FATAL_ERROR wrong)\nendif()")

    def test_a_component_that_does_not_exist(self):
        done = self.configure("find_package(Rung REQUIRED COMPONENTS runtime debugger)", check=False)
        self.assertNotEqual(done.returncode, 0)
        self.assertIn("component 'debugger' is not installed", " ".join(done.stderr.split()))
        self.configure("find_package(Rung REQUIRED COMPONENTS runtime OPTIONAL_COMPONENTS debugger)\n"
                       "if(Rung_debugger_FOUND)\nmessage(FATAL_ERROR wrong)\nendif()")

    def test_another_version(self):
        done = self.configure("find_package(Rung 9 REQUIRED)", check=False)
        self.assertNotEqual(done.returncode, 0)
        self.assertIn('compatible with requested version "9"', " ".join(done.stderr.split()))

    def test_as_a_subproject(self):
        """Only configured. What the compiler and the tests need may be missing."""
        (HOME / "parent").mkdir()
        (HOME / "parent/CMakeLists.txt").write_text(PARENT)
        (HOME / "parent/main.c").write_text("int main(void) { return 0; }\n")
        others = ("LLVM", "LLD", "CLI11", "GTest", "benchmark", "EXPAT", "fmt", "nlohmann_json", "pugixml", "tomlplusplus")
        run(CMAKE, "-S", "parent", "-B", "parent/build", f"-DRUNG={SOURCE}", "-DRUNG_COMPILER=OFF", "-DRUNG_TESTS=OFF",
            *(f"-DCMAKE_DISABLE_FIND_PACKAGE_{name}=ON" for name in others), hidden=False)


class Command(unittest.TestCase):
    def test_an_example_runs(self):
        done = run(PREFIX / "bin/rungc", "run", cwd=HOME / "examples/gsk-mill")
        self.assertRegex(done.stdout, r"(?m)^1 scans?, ")

    def test_a_scenario_runs(self):
        done = run(PREFIX / "bin/rungc", "test", "examples/gsk-mill/power-up.scn", "examples/embed-plc")
        self.assertRegex(done.stdout, r"(?m)^2 passed, 0 failed")

    def test_the_script_of_the_first_cnc_can_be_started(self):
        self.assertTrue(os.access(HOME / "examples/first-cnc/mdi", os.X_OK))

    def test_a_host_answers_rungctl(self):
        run(PREFIX / "bin/rungc", "build", "-q", "examples/gsk-mill", "-o", "mill.so")
        self.host_answers("mill.so")

    def test_a_host_compiles_sources(self):
        self.host_answers("examples/gsk-mill")

    def host_answers(self, program):
        environment = {"RUNG_SOCKETS": str(HOME / "sockets")}
        host = subprocess.Popen([*HIDE, PREFIX / "bin/rung-run", program, "examples/gsk-mill/mill.map", "--name", "mill"], cwd=HOME,
                                env={"PATH": "/usr/bin:/bin", "HOME": str(HOME)} | environment, stderr=subprocess.PIPE, text=True)
        try:
            self.assertIn("listening at", host.stderr.readline())
            done = run(PREFIX / "bin/rungctl", "get", "SA", **environment)
            self.assertEqual(done.stdout, "SA = true\n")
        finally:
            host.terminate()
            self.assertEqual(host.wait(10), 0)
            host.stderr.close()


class Headers(unittest.TestCase):
    def test_each_compiles_alone(self):
        headers = sorted((PREFIX / "include/rung").iterdir())
        self.assertLessEqual({"runtime.h", "runtime.hpp", "compiler.h", "program.h"}, {h.name for h in headers})
        strict = ["-Wall", "-Wextra", "-pedantic", "-Werror", "-fsyntax-only", f"-I{PREFIX}/include"]
        for header in headers:
            languages = ["c++"] if header.suffix == ".hpp" else ["c", "c++"]
            for language in languages:
                with self.subTest(header=header.name, language=language):
                    source = HOME / f"alone.{'c' if language == 'c' else 'cpp'}"
                    source.write_text(f"#include <rung/{header.name}>\n")
                    run("cc" if language == "c" else "c++", f"-std={'c11' if language == 'c' else 'c++20'}", *strict,
                        source)


class System(unittest.TestCase):
    """What a system shows of Rung."""

    def test_manual_pages(self):
        pages = sorted((PREFIX / "share/man").glob("man?/*"))
        names = {"rung-run.1", "rung.toml.5", "rung-map.5", "rung-binding.5", "rung-scenario.5", "rung-ladder.5",
                 "rung-coverage.5", "rung-profile.5", "rung-wcet.5"}
        for program in ("rungc", "rungctl"):
            commands = re.findall(rf"(?m)^  {program} (\S+)", run(PREFIX / f"bin/{program}", "help").stdout)
            self.assertGreater(len(commands), 10)
            names |= {f"{program}.1", *(f"{program}-{name}.1" for name in commands)}
        if any(PREFIX.glob("lib/linuxcnc/modules/*")):
            names |= {"rung_hal.9", "rung-operator.1", "rung-services.1"}
        self.assertEqual({page.name for page in pages}, names)
        for page in pages:
            with self.subTest(page=page.name):
                run("mandoc", "-T", "lint", "-W", "error", page)
                self.assertEqual(page.parent.name, "man" + page.name[-1])
                shown = run("mandoc", "-T", "utf8", "-O", "width=100", page).stdout
                shown = re.sub(".\b", "", shown)
                self.assertRegex(shown[:600], rf"\nNAME\n {{5,7}}{re.escape(page.name[:-2])} [-–] \w")
                self.assertIsNone(re.search(r"\]\(.*\)", shown), "a link of Markdown")
        # What a page refers to is there; LinuxCNC's component may not be.
        for page in pages:
            for name, section in re.findall(r"(?m)^\.BR (\S+) \((\d)\)", page.read_text()):
                name = name.replace("\\-", "-")
                self.assertIn(f"{name}.{section}", names | {"rung_hal.9"}, page.name)

    def completions(self, *words):
        script = (f'source "{PREFIX}/share/bash-completion/completions/rungc"\n'
                  'COMP_WORDS=("$@") COMP_CWORD=$(($# - 1))\n'
                  'function=$(complete -p rungc | sed "s/.* -F \\([^ ]*\\) .*/\\1/")\n'
                  '"$function" rungc "${COMP_WORDS[COMP_CWORD]}" "${COMP_WORDS[COMP_CWORD-1]}"\n'
                  'echo "${COMPREPLY[*]}"')
        return run("bash", "-u", "-c", script, "bash", *words).stdout.split()

    def test_bash_completion(self):
        for program in ("rungc", "rungctl"):
            run("bash", "-n", PREFIX / "share/bash-completion/completions" / program)
        self.assertEqual(self.completions("rungc", "ru"), ["run"])
        self.assertIn("test", self.completions("rungc", ""))
        self.assertEqual(self.completions("rungc", "run", "--en"), ["--engine"])
        self.assertEqual(self.completions("rungc", "build", "--via", ""), ["llvm", "cpp"])
        self.assertEqual(self.completions("rungc", "build", "--via", "=", "c"), ["cpp"])  # as readline cuts --via=c
        self.assertEqual(self.completions("rungc", "help", "pro"), ["profile"])
        self.assertEqual(self.completions("rungc", "emit", "cpp", ""), [])  # names of files, by bash itself
        self.assertEqual(self.completions("rungc", "run", ""), [])

    def test_zsh_completion(self):
        for program in ("rungc", "rungctl"):
            file = PREFIX / f"share/zsh/vendor-completions/_{program}"
            run("zsh", "-n", file)
            self.assertTrue(file.read_text().startswith(f"#compdef {program}\n"))

    def test_types_of_files(self):
        space = "{http://www.freedesktop.org/standards/shared-mime-info}"
        root = xml.etree.ElementTree.parse(PREFIX / "share/mime/packages/rung.xml").getroot()
        types = {of.get("type"): of for of in root.iter(space + "mime-type")}
        icons = {icon.stem for icon in (PREFIX / "share/icons/hicolor/scalable/mimetypes").iterdir()}
        self.assertEqual(icons, {name.replace("/", "-") for name in types})
        for icon in (PREFIX / "share/icons/hicolor/scalable/mimetypes").iterdir():
            xml.etree.ElementTree.parse(icon)
        endings = {glob.get("pattern")[1:] for glob in root.iter(space + "glob")}
        self.assertEqual(endings - {".nct"}, {".lad", ".scn", ".pmc", ".plc"})


class Places(unittest.TestCase):
    def test_what_is_not_found_by_itself_is_said(self):
        self.assertIn(f"Python finds the module rung by PYTHONPATH={PREFIX}/lib/python3/dist-packages\n", SAID)
        if any(PREFIX.glob("lib/linuxcnc/modules/*")):
            self.assertIn(f"sudo ln -sf {PREFIX}/lib/linuxcnc/modules/rung_hal.so /usr/lib/linuxcnc/modules/\n", SAID)

    def test_below_usr_local_python_finds_it(self):
        """Debian's own, which may not be the one of this test."""
        debian = Path("/usr/bin/python3")
        if not debian.exists() or "/usr/local/lib" not in subprocess.run([debian, "-c", "import sys; print(sys.path)"], capture_output=True, text=True).stdout:
            self.skipTest("needs Debian's Python")
        stage = Path(FOLDER.name) / "stage"
        said = run(CMAKE, "--install", BUILD, "--prefix", "/usr/local", hidden=False, DESTDIR=str(stage)).stdout
        folder, = {str(path.parent) for path in stage.glob("usr/local/lib/python3*/**/rung.py")}
        path = subprocess.run([debian, "-c", "import sys; print(*sys.path, sep='\\n')"], capture_output=True, text=True).stdout.splitlines()
        self.assertIn(folder.removeprefix(str(stage)), path)
        self.assertNotIn("PYTHONPATH", said)

    def test_nothing_names_source_or_build(self):
        folders = [str(folder).encode() for folder in (SOURCE, BUILD)]
        looked = 0
        for path in PREFIX.rglob("*"):
            if not path.is_file() or path.is_symlink() or is_elf(path):
                continue
            if path.suffix in SUFFIXES_OF_TEXT or path.is_relative_to(PREFIX / "share"):
                looked += 1
                text = path.read_bytes()
                for folder in folders:
                    self.assertNotIn(folder, text, path)
        self.assertGreater(looked, 100)

    def test_libraries_are_found_by_the_system_alone(self):
        """No RUNPATH: what the files need is the system's, or lies beside them and is found by who links it."""
        files = [path for path in PREFIX.rglob("*") if path.is_file() and not path.is_symlink() and is_elf(path)]
        self.assertGreaterEqual(len(files), 3)
        for path in files:
            dynamic = run("readelf", "-d", path).stdout
            self.assertNotRegex(dynamic, r"\((RPATH|RUNPATH)\)", path)

    def test_no_library_is_loaded_from_the_working_folder(self):
        """What an empty entry of a RUNPATH means; in the build tree as well."""
        files = [path for folder in ("bin", "lib") for path in (BUILD / folder).rglob("*")
                 if path.is_file() and not path.is_symlink() and is_elf(path)]
        self.assertGreaterEqual(len(files), 10)
        for path in files:
            dynamic = run("readelf", "-d", path, hidden=False).stdout
            for entries in re.findall(r"\((?:RPATH|RUNPATH)\).*\[(.*)\]", dynamic):
                self.assertNotIn("", entries.split(":"), path)


if __name__ == "__main__":
    if len(sys.argv) < 4:
        sys.exit(__doc__)
    CMAKE, BUILD, SOURCE = sys.argv[1], Path(sys.argv[2]).resolve(), Path(sys.argv[3]).resolve()
    unittest.main(argv=[sys.argv[0], *sys.argv[4:]])
