#!/usr/bin/env python3
"""What ./dev decides, with made-up graphs, lists and trees: dev_test.py CMAKE"""
import os
import re
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.dont_write_bytecode = True
sys.path.insert(0, str(ROOT / "tools" / "dev"))
import affected
import ninja_graph
import test_list

CMAKE = "cmake"
NINJA = """
rule CXX
  command = true
build base.o: CXX /s/ir/base.cpp | pch.pch || order_of_base
build lib/libbase.a: CXX base.o
build user.o: CXX /s/tools/user.cpp || order_of_user
build alone.o: CXX /s/tools/alone.cpp
build bin/user: CXX user.o | lib/libbase.a lib/plugin.so || lib/libbase.a
build bin/alone: CXX alone.o
build lib/plugin.so: CXX plugin.o
build plugin.o: CXX /s/codegen/plug$ in.cpp
build made.inc | ${cmake_ninja_workdir}made.inc: CUSTOM bin/gen /s/rtlib/signals.csv
build order_of_user: phony || made.inc
build order_of_base: phony
build bin/gen: CXX gen.o
build gen.o: CXX /s/rtlib/gen.cpp
build test_base.o: CXX /s/tests/unit/base/base_test.cpp
build bin/tests/test_base: CXX test_base.o | lib/libbase.a
build test_base: phony bin/tests/test_base
build user: phony bin/user
build alone: phony bin/alone
"""
DEPS = """base.o: #deps 2, deps mtime 1 (VALID)
    /s/ir/base.cpp
    /s/ir/base.h

user.o: #deps 2, deps mtime 1 (VALID)
    /s/tools/user.cpp
    /s/tools/user.h

old.o: #deps 1, deps mtime 1 (STALE)
    /s/ir/old.h
"""
LIST = "\n".join("\t".join(row) for row in (
    ("# kind", "name"),
    ("family", "base.", "tests/unit/base", "test_base", "", "threads"),
    ("test", "user", "tests/user", "user", "", ""),
    ("test", "user.data", "tests/data", "user", "tests/data/one examples/mill", ""),
    ("test", "alone", "tests/alone", "alone", "", ""),
    ("test", "base.script", "tests/scripts", "", "", ""),
    ("test", "tree", "tests/tree", "", ".", ""),
))
FILES = {
    "ir/base.cpp": "", "ir/base.h": "", "tools/user.cpp": "", "rtlib/signals.csv": "", "README.md": "", "odd.xyz": "",
    "tests/unit/base/base_test.cpp": 'TEST(Suite, Case) {}\n  read("examples/mill/mill.pmc");\n#include "docs/x.h"\n',
    "tests/user/user_test.py": "import helper\n", "tests/other/helper.py": "open(ROOT / 'docs' / 'a')\n",
    "tests/user/other_test.py": "", "tests/data/one/x": "", "tests/data/two/x": "", "examples/mill/mill.pmc": "",
    "examples/lathe/lathe.lad": "", "docs/a.md": "", "docs/x.h": "", "tests/alone/data.csv": "",
}


def graph(unknown=()):
    return ninja_graph.Graph(ninja_graph.statements(NINJA), ninja_graph.logged_headers(DEPS), unknown)


class Ninja(unittest.TestCase):
    def test_statements(self):
        made = dict((outputs[0], inputs) for outputs, inputs in ninja_graph.statements(NINJA))
        self.assertEqual(made["base.o"], ["/s/ir/base.cpp", "pch.pch", "order_of_base"])
        self.assertEqual(made["plugin.o"], ["/s/codegen/plug in.cpp"])
        self.assertEqual(made["made.inc"], ["bin/gen", "/s/rtlib/signals.csv"])
        self.assertEqual(made["order_of_base"], [])

    def test_stale_headers_do_not_count(self):
        self.assertEqual(set(ninja_graph.logged_headers(DEPS)), {"base.o", "user.o"})

    def test_names(self):
        for name, expected in (("../ir/x.h", "/s/ir/x.h"), ("a/b.o", "a/b.o"), ("/s/build/a/b.o", "a/b.o"), ("/s/ir/x.h", "/s/ir/x.h"),
                               ("${cmake_ninja_workdir}a/b.o", "a/b.o"), ("target", "target"), ("/s/build2/x", "/s/build2/x")):
            self.assertEqual(ninja_graph.canonical(name, "/s/build"), expected)

    def test_reached(self):
        reached = graph().reached(["/s/ir/base.h"])
        self.assertTrue({"base.o", "lib/libbase.a", "bin/user", "user", "test_base"} <= set(reached))
        self.assertNotIn("alone", reached)
        self.assertEqual(reached["user"], "/s/ir/base.h")
        self.assertIn("user", graph().reached(["/s/codegen/plug in.cpp"]), "what a program loads")
        self.assertIn("user", graph().reached(["/s/rtlib/gen.cpp"]), "by a file that a program of ours makes")

    def test_sources(self):
        self.assertEqual(graph().sources("test_base"), ["/s/tests/unit/base/base_test.cpp"])

    def test_objects_that_are_not_made_or_too_old_are_unknown(self):
        with tempfile.TemporaryDirectory() as folder:
            source = Path(folder, "s.cpp")
            source.write_text("")
            Path(folder, "build.ninja").write_text(
                f"rule CXX\n  command = touch $out\n  depfile = $out.d\n  deps = gcc\n"
                f"build a.o: CXX {source}\nbuild b.o: CXX {source}\n")
            Path(folder, "..", Path(folder).name + ".h").write_text("")
            header = f"../{Path(folder).name}.h"
            self.addCleanup(os.remove, folder + ".h")
            for name in ("a.o", "b.o"):
                Path(folder, name + ".d").write_text(f"{name}: {source} {header}\n")
            self.assertEqual(ninja_graph.load(folder).unknown, {"a.o", "b.o"})
            subprocess.run(["ninja", "-C", folder, "a.o"], check=True, capture_output=True)
            self.assertEqual(ninja_graph.load(folder).unknown, {"b.o"})
            self.assertEqual(set(ninja_graph.load(folder).reached([folder + ".h"])), {folder + ".h", "a.o"})
            later = os.stat(Path(folder, "a.o")).st_mtime + 10
            os.utime(source, (later, later))
            self.assertEqual(ninja_graph.load(folder).unknown, {"a.o", "b.o"})


class Selection(unittest.TestCase):
    ENTRIES = test_list.read(LIST)

    def needed(self, *arguments, listed=()):
        found = test_list.needed(self.ENTRIES, arguments, listed, lambda target: [FILES["tests/unit/base/base_test.cpp"]])
        return found if found is None else [entry.name for entry in found]

    def test_selectors(self):
        self.assertIsNone(self.needed())
        self.assertIsNone(self.needed("-j4", "-V"))
        self.assertEqual(self.needed("-R", "user", listed=["user", "user.data"]), ["user", "user.data"])
        self.assertEqual(self.needed("--rerun-failed", listed=["user"]), ["user"])
        self.assertIsNone(self.needed("-R", "x", listed=["somebody_elses_test"]), "all, rather than too little")

    def test_a_family_that_is_not_built(self):
        self.assertEqual(self.needed("-R", "^base"), ["base."])
        self.assertEqual(self.needed("-R", "Suite"), ["base."])
        self.assertEqual(self.needed("-R", "NOT_BUILT", listed=["base.NOT_BUILT"]), ["base."])
        self.assertEqual(self.needed("-R", "nothing"), [])
        self.assertEqual(self.needed("--tests-regex=^base", "-E", "base"), [])
        self.assertEqual(self.needed("-E", "Suite", listed=["user"]), ["base.", "user"], "others may be in it")
        self.assertEqual(self.needed("-L", "threads"), ["base."])
        self.assertEqual(self.needed("-L", "cnc"), [])
        self.assertEqual(self.needed("-LE", "threads", listed=["user"]), ["user"])

    def test_one_name_may_begin_with_a_family(self):
        self.assertEqual(self.needed("-R", "script", listed=["base.script"]), ["base.script"])
        self.assertEqual(test_list.owner(self.ENTRIES, "base.Suite.Case").name, "base.")

    def test_suites(self):
        source = "TEST_F(A, b)\nTEST_F(A, c)\nTEST_P(C,\n d) {}\nINSTANTIATE_TEST_SUITE_P(Some, C, Values(1));\n// TEST(No, no)\n"
        self.assertEqual(test_list.suites("x.", [source]), ["x.A", "x.C"])


class Affected(unittest.TestCase):
    ENTRIES = test_list.read(LIST)

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.root = Path(folder.name)
        for name, text in FILES.items():
            (self.root / name).parent.mkdir(parents=True, exist_ok=True)
            (self.root / name).write_text(text)

    def choose(self, *changed, unknown=()):
        of = graph(unknown)
        reader = affected.Reader(self.root, set(FILES) | set(changed),
                                 lambda target: [source.removeprefix("/s/") for source in of.sources(target)],
                                 {"user": ["/usr/bin/python3", "tests/user/user_test.py"], "x": ["tests/user/other_test.py"]})
        chosen = affected.choose(changed, self.ENTRIES, of, lambda path: "/s/" + path, reader)
        return chosen if isinstance(chosen, str) else {entry.name for entry in chosen}

    def test_by_what_is_built(self):
        self.assertEqual(self.choose("ir/base.h"), {"base.", "user", "user.data", "tree"})
        self.assertEqual(self.choose("tools/alone.cpp"), {"alone", "tree"})
        self.assertEqual(self.choose("rtlib/signals.csv"), {"user", "user.data", "tree"})

    def test_a_header_that_some_object_may_include(self):
        self.assertEqual(self.choose("ir/base.h", unknown=["alone.o"]), {"base.", "user", "user.data", "alone", "tree"})
        self.assertEqual(self.choose("tools/user.cpp", unknown=["alone.o"]), {"user", "user.data", "tree"})
        self.assertEqual(self.choose("rtlib/signals.csv", unknown=["alone.o"]), {"user", "user.data", "alone", "tree"})

    def test_by_what_is_read(self):
        self.assertEqual(self.choose("examples/mill/mill.pmc"), {"base.", "user.data", "tree"})
        self.assertEqual(self.choose("tests/data/one/x"), {"user.data", "tree"})
        self.assertEqual(self.choose("tests/alone/data.csv"), {"alone", "tree"})
        self.assertEqual(self.choose("docs/a.md"), {"user", "tree"}, "by a module that a script imports")
        self.assertEqual(self.choose("tests/other/helper.py"), {"user", "tree"})
        self.assertIn("nothing says", self.choose("tests/data/two/x"))

    def test_scripts_of_other_tests(self):
        self.assertEqual(self.choose("tests/user/user_test.py"), {"user", "tree"})

    def test_everything(self):
        for path in ("CMakeLists.txt", "ir/CMakeLists.txt", "cmake/RungHelpers.cmake", "dev", "tools/dev/tests.py", ".ci/run",
                     "CMakePresets.json"):
            self.assertIn("decides how everything", self.choose("ir/base.cpp", path))
        self.assertIn("nothing says", self.choose("odd.xyz"))
        (self.root / "tests/data/one/new_test.cpp").write_text("TEST(New, Case) {}\n")
        self.assertIn("nothing known is built", self.choose("tests/data/one/new_test.cpp"))
        self.assertEqual(self.choose("tests/data/one/gone_test.cpp"), {"user.data", "tree"})
        self.assertIn("nothing known is built", self.choose("ir/new.h"))
        self.assertIn("nothing known is built", self.choose("tools/reads/new.cpp"))
        self.assertIn("nothing says", self.choose("examples/lathe/lathe.lad"))

    def test_pages_are_read_by_what_reads_the_whole_tree(self):
        self.assertEqual(self.choose("README.md"), {"tree"})

    def test_named_paths(self):
        exists = {"examples/mill": "folder", "examples/mill/mill.pmc": "file", "tests": "folder", "tools": "folder",
                  "examples": "folder", "docs": "folder", "README.md": "file", "docs/a.md": "file"}.get
        for text, paths in (('"examples/mill/mill.pmc"', {"examples/mill"}), ("'examples/mill'", {"examples/mill"}),
                            ('"examples/" + name', {"examples"}), ('f"examples/{name}/x"', {"examples"}),
                            ('root / "tests"', {"tests"}), ('"the tools are"', set()), ('"check examples"', {"examples"}),
                            ('"my/tools/x"', set()), ('#include "tools/x.h"', set()), ('"docs/gone.md"', {"docs"}), ('"docs/a.md"', {"docs/a.md"}), ('Path(ROOT, "README.md")', {"README.md"}), ('"OTHER.md"', set())):
            self.assertEqual(affected.named_paths(text, exists), paths, text)

    def test_expression(self):
        chosen = [entry for entry in self.ENTRIES if entry.name in ("base.", "user.data")]
        self.assertEqual(affected.expression(chosen), r"^(base\.|user\.data$)")


CHECKS = """set -euo pipefail
source "$1/tools/dev/checks.sh"
die() { echo "dev: $*" >&2; exit 3; }
setup() { :; }
check_parts() { printf '%s\\n' 'good|1|-' 'bad|1|-' 'more|?|-' 'named|-|-'; }
check_good() { echo good runs; [ -z "${EDITS:-}" ] || touch "$EDITS"; }
check_bad() { false; echo "goes on after a mistake"; }
check_more() { echo more runs >&2; }
check_named() { :; }
minutes_allowed=${MINUTES:-60}
check "${@:2}"
"""


class Checks(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        self.git("init", "-q")
        (self.folder / ".gitignore").write_text("out/\n")
        self.commit()

    def git(self, *words):
        subprocess.run(["git", "-c", "user.name=n", "-c", "user.email=e@x", *words], cwd=self.folder, check=True)

    def commit(self):
        self.git("add", "-A")
        self.git("commit", "-q", "--allow-empty", "-m", "m")

    def check(self, *words, **environment):
        done = subprocess.run(["bash", "-c", CHECKS, "dev", ROOT, *words], cwd=self.folder, capture_output=True, text=True,
                              env={**os.environ, **environment})
        return done.returncode, done.stdout, done.stderr

    def ran(self, *words, **environment):
        return re.findall(r"^-- check (\w+)$", self.check(*words, **environment)[1], re.MULTILINE)

    def test_a_part_that_fails_does_not_stop_the_others(self):
        status, output, errors = self.check()
        self.assertEqual((status, errors), (3, "dev: failed: bad\n"))
        self.assertNotIn("goes on", output)
        for line in (r"^good +[0-9a-f]{12} +\S+ \S+ +0:0\d  passed$", r"^bad .* failed$", r"^more .* passed$", r"^named .* not run$"):
            self.assertRegex(output, re.compile(line, re.MULTILINE))
        self.assertEqual((self.folder / "out/check-good.log").read_text(), "good runs\n")
        self.assertEqual((self.folder / "out/check-more.log").read_text(), "more runs\n")

    def test_any_order(self):
        self.assertEqual(self.ran("named", "good"), ["named", "good"])
        self.assertEqual(self.check("good")[0], 0)
        self.assertIn("'none' is not a check", self.check("none")[2])
        self.assertIn("'-x' is not an option", self.check("-x")[2])

    def test_resume(self):
        self.check()
        self.assertEqual(self.ran("--resume"), ["bad"])
        self.assertEqual(self.ran("--resume", "named", "good"), ["named"])
        (self.folder / "new").write_text("")
        self.assertEqual(self.ran("--resume"), ["good", "bad", "more"], "a tree with changes is not the commit")
        self.commit()
        self.assertEqual(self.ran("--resume"), ["good", "bad", "more"], "what ran on a tree with changes counts for no commit")
        self.assertEqual(self.ran("--resume"), ["bad"])
        self.assertEqual(self.ran("--table"), [])
        self.assertIn("passed", self.check("--table")[1])

    def test_an_edit_while_a_part_runs(self):
        self.check("good", EDITS="new")
        (self.folder / "new").unlink()
        self.assertEqual(self.ran("--resume", "good"), ["good"], "what ran is not the commit")

    def test_a_name_is_no_expression(self):
        self.assertIn("'go.d' is not a check", self.check("go.d")[2])

    def test_the_limit(self):
        status, output, _ = self.check("good", MINUTES="-1")
        self.assertEqual(status, 3)
        self.assertIn("over -1 min", output)

    def test_each_part_of_dev_has_its_function(self):
        listed = subprocess.run(["bash", "-c", "source <(sed -n '/^check_parts()/,/^}/p' dev); check_parts"], cwd=ROOT,
                                capture_output=True, text=True, check=True).stdout
        names = [line.split("|")[0] for line in listed.splitlines()]
        defined = re.findall(r"^check_([\w-]+)\(\)", (ROOT / "tools/dev/checks.sh").read_text(), re.MULTILINE)
        self.assertEqual(sorted(names), sorted(set(defined) - {"table"}))
        self.assertTrue(all(line.count("|") == 2 for line in listed.splitlines()))


PROJECT = """cmake_minimum_required(VERSION 3.25)
project(made_up NONE)
include("{helpers}")
enable_testing()
add_custom_target(thing)
add_subdirectory(below)
rung_write_test_needs()
"""


class Words(unittest.TestCase):
    def refused(self, *words):
        done = subprocess.run([ROOT / "dev", "test", *words], capture_output=True, text=True)
        self.assertEqual((done.returncode, done.stdout), (3, ""))
        return done.stderr

    def test_what_ctest_would_pass_over(self):
        self.assertIn("'gsk' is not an option; tests are selected by -R gsk", self.refused("gsk"))
        self.assertIn("chooses by itself", self.refused("--changed", "-R", "x"))
        self.assertIn("chooses by itself", self.refused("--changed", "HEAD", "-LE", "cnc", "--tests-regex", "x"))


class Configuring(unittest.TestCase):
    def configure(self, below):
        with tempfile.TemporaryDirectory() as folder:
            Path(folder, "below").mkdir()
            Path(folder, "CMakeLists.txt").write_text(PROJECT.format(helpers=ROOT / "cmake/RungHelpers.cmake"))
            Path(folder, "below/CMakeLists.txt").write_text(below)
            done = subprocess.run([CMAKE, "-G", "Ninja", "-S", folder, "-B", folder + "/build"], capture_output=True, text=True)
            listed = Path(folder, "build/tests.tsv")
            return done.returncode, " ".join(done.stderr.split()), listed.read_text() if listed.exists() else ""

    def test_the_list(self):
        status, errors, text = self.configure("""add_test(NAME a COMMAND true)
add_test(NAME b.c COMMAND true)
rung_test_needs(TESTS a b.c TARGETS thing IF_BUILT nothing READS below)
""")
        self.assertEqual(status, 0, errors)
        self.assertEqual(test_list.read(text), [test_list.Entry(False, name, "below", ("thing",), ("below",), "")
                                                for name in ("a", "b.c")])

    def test_mistakes(self):
        for below, error in (
                ("add_test(NAME silent COMMAND true)\n", "says what these tests need: silent"),
                ('set_property(DIRECTORY APPEND PROPERTY TEST_INCLUDE_FILES "/x/rung_test_y[1]_include.cmake")\n',
                 "says what these tests need: rung_test_y"),
                ("add_test(NAME a COMMAND true)\nrung_test_needs(TESTS a TARGETS no_such)\n", "there is no target no_such"),
                ("add_test(NAME a COMMAND true)\nrung_test_needs(TESTS a READS no/folder)\n", "there is no no/folder to read"),
                ("rung_test_needs(TESTS a)\n", "a is not a test of this folder")):
            status, errors, _ = self.configure(below)
            self.assertNotEqual(status, 0, below)
            self.assertIn(error, errors)


if __name__ == "__main__":
    if len(sys.argv) > 1 and not sys.argv[1].startswith("-"):
        CMAKE = sys.argv.pop(1)
    unittest.main()
