#!/usr/bin/env python3
"""rungc bind as a user sees it: bind_test.py RUNGC RUNTIME.so STRUCT_HOST LINUXCNC_HOST, of which the last may be ''

The layout of random structs against what compilers say; code that no longer compiles when the header has changed; hosts
and programs of different layouts; every mistake."""
import json
import os
import random
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "support"))
from patience import patience
from root import go_to_root

RUNGC = RUNTIME = STRUCT_HOST = LINUXCNC_HOST = None
OK, WRONG, USAGE, ENVIRONMENT = 0, 1, 2, 3
EXAMPLE = Path("examples/embed-struct")
# In a build with sanitizers: hosts have none, and cannot be linked to a library that has them.
NO_HOSTS = os.environ.get("RUNG_NO_HOSTS") == "1"
COMPILERS = (("gcc", "-std=gnu11", "c"), ("clang-19", "-std=gnu11", "c"), ("g++", "-std=gnu++17", "cc"), ("clang++-19", "-std=gnu++17", "cc"))

# A host that binds a struct, runs a few scans, and prints what was wrong.
HOST = """#include <stdio.h>
#include "binding.h"
static %s block;
int main(int argc, char** argv) {
  rung_image* image = NULL;
  rung_instance* plc = NULL;
  if (argc < 2 || rung_image_open(argv[1], NULL, &image) < 0 || rung_instance_new(image, NULL, &plc) < 0 ||
      rung_bind_%s(plc, &block) < 0 || rung_instance_power_on(plc, RUNG_COLD) < 0) {
    printf("%%s\\n", rung_error_text());
    return 1;
  }
  printf("bound\\n");
  return 0;
}
"""


class Bind(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)

    def path(self, name):
        return Path(self.folder.name) / name

    def write(self, name, text):
        self.path(name).write_text(text)
        return self.path(name)

    def run_it(self, *words):
        return subprocess.run([*map(str, words)], capture_output=True, text=True, timeout=patience(300))

    def bind(self, *words):
        return self.run_it(RUNGC, "bind", *words)

    def binding(self, header, members, program=EXAMPLE / "panel.lad", name="nc_block", flags=()):
        """Makes binding.h."""
        done = self.bind(header, program, "--no-project", "-q", "--struct", name, "--members", members, "-o", self.path("binding.h"), "--", *flags)
        self.assertEqual((done.returncode, done.stdout, done.stderr), (OK, "", ""))

    def compile(self, words, source, output="host"):
        if NO_HOSTS:
            self.skipTest("no hosts")
        return self.run_it(*words, "-Wall", "-Wextra", "-pedantic", "-Werror", "-Irtlib/abi", f"-I{self.folder.name}", source, "-o", self.path(output),
                           RUNTIME, f"-Wl,-rpath,{Path(RUNTIME).parent}")

    def compiled(self, words, source, output="host"):
        done = self.compile(words, source, output)
        self.assertEqual((done.returncode, done.stderr), (0, ""), words)
        return self.path(output)


class Layouts(Bind):
    def test_random_structs_lie_where_compilers_say(self):
        for language, compilers in (("c", COMPILERS[:2]), ("cc", COMPILERS[2:])):
            made = RandomHeader(random.Random(f"layouts of {language}"), language)
            header = self.write("random.h" if language == "c" else "random.hpp", made.text())
            read = {}
            for name in made.structs:
                done = self.bind(header, "--struct", name, "--template")
                self.assertEqual((done.returncode, done.stderr), (OK, ""), header.read_text())
                read[name] = members_of(done.stdout)
            source = self.write(f"print.{language}", made.printer(header, read))
            for compiler, standard, _ in compilers:
                with self.subTest(compiler=compiler):
                    program = self.path("print")
                    done = self.run_it(compiler, standard, "-w", source, "-o", program)
                    self.assertEqual(done.returncode, 0, done.stderr)
                    said = dict(line.rsplit(" ", 1) for line in self.run_it(program).stdout.splitlines())
                    expected = {f"{name} {member}": place for name, members in read.items() for member, place in members.items()}
                    self.assertEqual(said, expected)
                    self.assertGreater(len(said), 400)
                    self.assertGreater(sum("." in place for place in said.values()), 50)

    def test_flags_decide(self):
        header = self.write("block.h", "#ifdef WIDE\ntypedef long number;\n#else\ntypedef short number;\n#endif\nstruct S { char c; number n; };\n")
        database = [{"directory": self.folder.name, "file": "block.c", "command": "cc -DWIDE -m32 -c block.c"}]
        self.write("block.c", "#include \"block.h\"\n")
        self.write("compile_commands.json", json.dumps(database))
        for words, place in (((), "2"), (("--", "-DWIDE"), "8"), (("--", "-DWIDE", "-m32"), "4"), (("-p", self.folder.name), "4")):
            done = self.bind(header, "--struct", "S", "--template", *words)
            self.assertEqual(members_of(done.stdout).get("n"), place, (words, done.stderr))

    def test_names_of_cpp(self):
        header = self.write("block.hpp", """#include <cstdint>
namespace nc {
enum class Mode : uint8_t { Manual, Auto = 7 };
struct Base { int32_t position; };
class Block : public Base { public: Mode mode; struct Inner { bool a; } inner; std::int16_t words[2][3]; int get() const { return hidden; } private: int hidden = 0; };
using Alias = Block;
}
""")
        done = self.bind(header, "--struct", "nc::Alias", "--template")
        self.assertEqual(members_of(done.stdout), {"position": "0", "mode": "4", "inner.a": "5", "words": "6"}, done.stderr)


        members = self.write("cpp.bind", '[in]\nmode = "MODE"\nposition = "POSITION:4"\n"words[1][2]" = "D20:2"\n"words[0]" = "D22"\n[out]\ninner.a = "DRIVE"\n')
        self.binding(header, members, name="nc::Alias")
        for words in (("g++", "-std=c++17"), ("clang++-19", "-std=c++20")):
            self.compiled(words, self.write("host.cc", HOST % ("nc::Alias", "nc_Alias")))


class Hosts(Bind):
    def program(self, *words):
        done = self.run_it(RUNGC, "build", EXAMPLE / "panel.lad", "--no-project", "-q", "-o", self.path("panel.so"), *words)
        self.assertEqual((done.returncode, done.stderr), (OK, ""))
        return self.path("panel.so")

    @unittest.skipIf(NO_HOSTS, "no hosts")
    def test_the_example(self):
        done = self.run_it(STRUCT_HOST, self.program())
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertIn("\n100 ms: 4.200 mm, drive 1, lamps 81 0f, feed 1.2\n", done.stdout)
        self.assertIn("\nlamps 81 0f; no whole copy for 5 slices\n", done.stdout)

    @unittest.skipIf(NO_HOSTS, "no hosts")
    @unittest.skipIf(os.environ.get("RUNG_NO_LINUXCNC") == "1", "no headers of LinuxCNC")
    def test_linuxcnc(self):
        self.assertTrue(LINUXCNC_HOST)
        subprocess.run([RUNGC, "build", "examples/embed-linuxcnc/lamp.lad", "--no-project", "-q", "-o", self.path("lamp.so")], check=True)
        done = self.run_it(LINUXCNC_HOST, self.path("lamp.so"))
        self.assertEqual((done.returncode, done.stdout, done.stderr),
                         (0, "at rest: red 0, green 1, yellow 0\ncutting: red 0, green 1, yellow 1\nbeyond a limit: red 1, green 0, yellow 1\n"
                             "in the middle of a change: red 1, green 0, yellow 1\nafter it: red 0, green 1, yellow 1\n", ""))

    def test_code_for_each_compiler(self):
        self.binding(EXAMPLE / "nc_block.h", EXAMPLE / "nc.bind")
        self.write("nc_block.h", (EXAMPLE / "nc_block.h").read_text())
        program = self.program("--binding", self.path("binding.h"))
        for compiler, standard, language in COMPILERS:
            with self.subTest(compiler=compiler):
                host = self.compiled((compiler, standard), self.write(f"host.{language}", HOST % ("nc_block", "nc_block")))
                self.assertEqual(self.run_it(host, program).stdout, "bound\n")

    def test_a_header_that_has_changed_does_not_compile(self):
        self.binding(EXAMPLE / "nc_block.h", EXAMPLE / "nc.bind")
        text = (EXAMPLE / "nc_block.h").read_text()
        host = self.write("host.c", HOST % ("nc_block", "nc_block"))
        for before, after, said in (
            ("uint8_t lamps[2];", "uint8_t more, lamps[1];", "nc_block.lamps was 2 bytes at 30 and has changed"),
            ("  double feed;", "  long long feed;", "nc_block.feed was double and has changed"),
            ("  int32_t position;", "  uint32_t position;", "nc_block.axis[0].position was i32 and has changed"),
            ("  uint8_t tail;\n", "  uint8_t tail;\n  double rest;\n", "nc_block had 48 bytes and has changed"),
            ("NC_MODE_MDI, ", "NC_MODE_MDI, NC_MODE_JOG, ", "NC_MODE_AUTO was 2 and has changed"),
            ("  uint8_t head;", "  int8_t before; uint8_t head;", "nc_block.head was a counter at 0 and has changed"),
        ):
            with self.subTest(change=after):
                self.assertIn(before, text)
                self.write("nc_block.h", text.replace(before, after))
                for words in (("gcc", "-std=gnu11"), ("clang-19", "-std=gnu11")):
                    done = self.compile(words, host)
                    self.assertEqual(done.returncode, 1)
                    self.assertIn(f"{said} since rungc bind has read nc_block.h: run it again", done.stderr)
        self.write("nc_block.h", text.replace("unsigned start : 1, stop : 1;", "unsigned stop : 1, start : 1;"))
        host = self.compiled(("gcc", "-std=gnu11", "-O2"), host)
        done = self.run_it(host, self.program())
        self.assertEqual((done.returncode, done.stdout),
                         (1, "the bit-field keys.start of nc_block lies elsewhere than its layout says: run rungc bind again\n"))

    def test_program_and_host_of_different_layouts(self):
        text = (EXAMPLE / "nc_block.h").read_text()
        self.binding(EXAMPLE / "nc_block.h", EXAMPLE / "nc.bind")
        program = self.program("--binding", self.path("binding.h"))
        header = self.write("nc_block.h", text.replace("  uint8_t buttons[2];\n  uint8_t lamps[2];", "  uint8_t lamps[2];\n  uint8_t buttons[2];"))
        self.binding(header, EXAMPLE / "nc.bind")
        host = self.compiled(("gcc", "-std=gnu11"), self.write("host.c", HOST % ("nc_block", "nc_block")))
        done = self.run_it(host, program)
        self.assertEqual((done.returncode, done.stdout),
                         (1, "panel was compiled for another layout of nc_block than this host's: it has \"in buttons: 2 bytes at 28 = BUTTONS\", "
                             "the host \"in buttons: 2 bytes at 30 = BUTTONS\"; run rungc bind again, and compile both\n"))
        self.assertEqual(self.run_it(host, self.program("--binding", self.path("binding.h"))).stdout, "bound\n")
        self.assertEqual(self.run_it(host, self.program()).stdout, "bound\n", "it says nothing of layouts")

    def test_a_project_names_its_bindings(self):
        self.write("panel.lad", (EXAMPLE / "panel.lad").read_text())
        self.write("rung.toml", 'dialect = "gsk"\nfiles = ["panel.lad"]\nbindings = ["binding.h"]\n')
        done = self.run_it(RUNGC, "build", self.folder.name)
        self.assertEqual((done.returncode, done.stdout), (ENVIRONMENT, ""))
        self.assertIn(f"cannot read {self.path('binding.h')}: No such file or directory", done.stderr)
        self.binding(EXAMPLE / "nc_block.h", EXAMPLE / "nc.bind")
        done = self.run_it(RUNGC, "build", self.folder.name, "-o", self.path("panel.so"))
        self.assertEqual((done.returncode, done.stderr), (OK, ""))
        self.assertIn(b"in buttons: 2 bytes at 28 = BUTTONS", self.path("panel.so").read_bytes())

    def test_a_changed_binding_is_not_built_for(self):
        self.binding(EXAMPLE / "nc_block.h", EXAMPLE / "nc.bind")
        changed = self.write("changed.h", self.path("binding.h").read_text().replace("in mode: u32 at 8", "in mode: u32 at 9"))
        for file, status, said in ((changed, WRONG, "it was changed after rungc bind has made it; run rungc bind again"),
                                   (EXAMPLE / "nc_block.h", WRONG, "it is not a file that rungc bind has made"),
                                   ("/nowhere.h", ENVIRONMENT, "cannot read /nowhere.h: No such file or directory")):
            done = self.run_it(RUNGC, "build", EXAMPLE / "panel.lad", "--no-project", "-q", "-o", self.path("panel.so"), "--binding", file)
            self.assertEqual((done.returncode, done.stdout), (status, ""))
            self.assertIn(said, done.stderr)
            self.assertFalse(self.path("panel.so").exists())


class Mistakes(Bind):
    def refused(self, header, name, *words, status=WRONG):
        done = self.bind(header, "--struct", name, "--template", *words)
        self.assertEqual((done.returncode, done.stdout), (status, ""), done.stderr)
        return done.stderr

    def test_headers(self):
        self.assertIn("there is no file /nowhere.h", self.refused("/nowhere.h", "S"))
        wrong = self.write("wrong.h", "struct S {\n  something a;\n  nothing b;\n};\n")
        said = self.refused(wrong, "S")
        self.assertIn(f"{wrong}:2:3: error: unknown type name 'something'", said)
        self.assertIn(f"{wrong}:3:3: error: unknown type name 'nothing'", said)
        self.assertIn("the header has errors, or needs other compile flags: write them after --", said)
        good = self.write("good.h", "struct Block { int a; };\nstruct Later;\ntypedef struct { struct Later* l; } Users;\n")
        self.assertIn("there is no struct Blokc in " + str(good) + "; did you mean Block?", self.refused(good, "Blokc"))
        self.assertIn(f"Later is declared at {good}:2:8 and defined nowhere", self.refused(good, "Later"))
        self.assertIn("there is no compile_commands.json in /nowhere that can be read", self.refused(good, "Block", "-p", "/nowhere"))
        self.assertIn("big-endian", self.refused(good, "Block", "--", "--target=powerpc64-linux-gnu"))
        cpp = self.write("good.hpp", "struct V { virtual ~V(); int a; };\ntemplate <class T> struct Of { T t; };\n")
        self.assertIn("V has virtual functions", self.refused(cpp, "V"))
        self.assertIn("Of is a template", self.refused(cpp, "Of"))

    def test_members_and_names_all_at_once(self):
        header = self.write("block.h", """#include <stdint.h>
enum small { A, B = 200 };
typedef struct {
  int32_t number; int64_t wide; float real; _Bool flag; void* pointer; long double longer; char* names[3];
  struct { int x; } inner[2]; double reals[4]; enum small small; uint8_t bytes[4]; uint8_t head; uint16_t tail;
} Block;
""")
        members = self.write("wrong.bind", """[counters]
head = "head"
tail = "tail"
[in]
nubmer = "START"
number = "MODE"
wide = "POSITION:4"
pointer = "MODE"
longer = "MODE"
names = "D20"
inner = "D20"
"inner[2].x" = "D20"
"inner[0].y" = "D20"
"inner[0].x.z" = "D20"
"number[1]" = "D20"
reals = "D20"
flag = "DRIVE"
real = "START"
bytes = "NOBODY"
small = "MODE"
[out]
number = { name = "MODE", scale = 3 }
"bytes[0]" = "POSITION:4"
"bytes[1]" = "OVERIDE"
bytes = { name = "D21", weight = 2 }
""")
        done = self.bind(header, EXAMPLE / "panel.lad", "--no-project", "--struct", "Block", "--members", members)
        self.assertEqual((done.returncode, done.stdout), (WRONG, ""))
        said = done.stderr.splitlines()
        for line, text in (
            (24, "out.bytes: found an unknown key weight, expected name, scale, cut"),
            (5, "in.nubmer: found an unknown member nubmer, expected one of Block; did you mean number?"),
            (6, "in.number: found 32 bits of number for the 8 bits of MODE, expected as many, or room for more; name a longer cell"),
            (7, "in.wide: found 64 bits of wide for the 32 bits of POSITION:4, expected"),
            (8, "in.pointer: found a pointer (void *), expected a number, a bit or an array of integers; bind another member"),
            (9, "in.longer: found a long double (long double), expected"),
            (10, "in.names: found a pointer (char *), expected"),
            (11, "in.inner: found an array of structs ("),
            (12, "in.inner[2].x: found the index [2], expected 0 to 1; write for example inner[0]"),
            (13, "in.inner[0].y: found an unknown member y, expected one of"),
            (14, "in.inner[0].x.z: found a member of inner[0].x, which is int, expected one of a struct"),
            (15, "in.number[1]: found an index of number, which is not an array, expected none; remove it"),
            (16, "in.reals: found an array of double, expected one of integers, which is bound as bytes; bind its elements: write \"reals[0]\""),
            (17, "in.flag: found DRIVE, an output of the program, expected a name that the host may write; move the line to [out]"),
            (18, "in.real: found the bit START for a float, expected a number; name a cell"),
            (19, "in.bytes: found an unknown name NOBODY, expected a symbol or an address of the program"),
            (22, "out.number: found a scale of int32_t, expected one of a float or a double; remove scale"),
            (23, "out.bytes[0]: found 32 bits of POSITION:4 for the 8 bits of bytes[0], expected"),
            (24, "out.bytes[1]: found an unknown name OVERIDE, expected a symbol or an address of the program, or a signal of the NC interface; did you mean OVERRIDE?"),
            (3, "counters: found tail, of type uint16_t, expected an unsigned integer, of the same width as the other counter"),
        ):
            with self.subTest(text=text):
                # TOML gives lines; those of the same table may be a line apart in this list.
                self.assertTrue(any(re.match(rf"{re.escape(str(members))}:\d+:\d+: {re.escape(text)}", one) for one in said), "\n".join(said))
        self.assertEqual(len(said), 20, "\n".join(said))  # small fits, as all its constants do

    def test_binding_files(self):
        header = EXAMPLE / "nc_block.h"
        for text, said in (
            ("in = 3\n", ":1:6: in: found 3, expected a table; write for example [in]"),
            ("[inn]\n", ":1:2: the file: found an unknown key inn, expected in, out, counters; did you mean in?"),
            ("[in\n", "the file must be TOML"),
            ("[in]\nmode = 3\n", ":2:8: in.mode: found 3, expected a name of the program; write for example mode = \"X0.0\""),
            ("[counters]\nhead = \"head\"\n", "counters: found one of head and tail, expected both"),
            ("[counters]\nhead = \"mode\"\ntail = \"tail\"\n[in]\nmode = \"MODE\"\n", "counters: found tail, of type uint8_t, expected"),
            ("", "the file binds nothing"),
        ):
            with self.subTest(text=text):
                members = self.write("wrong.bind", text)
                done = self.bind(header, EXAMPLE / "panel.lad", "--no-project", "--struct", "nc_block", "--members", members)
                self.assertEqual((done.returncode, done.stdout), (WRONG, ""))
                self.assertIn(str(members), done.stderr)
                self.assertIn(said, done.stderr)

    def test_usage(self):
        header = EXAMPLE / "nc_block.h"
        for words, status, said in (((header, "--struct", "nc_block"), USAGE, "expected --template or --members FILE"),
                                    ((header,), USAGE, "--struct"),
                                    ((header, "--struct", "a" * 101, "--template"), USAGE, "at most 100 characters"),
                                    ((header, "--struct", "nc_block", "--members", "/nowhere"), ENVIRONMENT, "cannot read /nowhere")):
            done = self.bind(*words, *(() if "--members" not in words else (EXAMPLE / "panel.lad", "--no-project")))
            self.assertEqual((done.returncode, done.stdout), (status, ""), done.stderr)
            self.assertIn(said, done.stderr)

    def test_without_the_program_that_reads_headers(self):
        copy = self.path("rungc")
        copy.symlink_to(Path(RUNGC).resolve())  # it looks beside the file itself
        self.assertEqual(self.run_it(copy, "bind", EXAMPLE / "nc_block.h", "--struct", "nc_block", "--template").returncode, OK)
        copy.unlink()
        shutil.copy(RUNGC, copy)
        done = self.run_it(copy, "bind", EXAMPLE / "nc_block.h", "--struct", "nc_block", "--template")
        self.assertEqual((done.returncode, done.stdout), (ENVIRONMENT, ""))
        self.assertIn("install the package rung-bind", done.stderr)


def members_of(template):
    """Of a template: the place of each member."""
    return dict(re.findall(r'^# "?([^" ]+)"? = "" # .* at (\S+)$', template, re.MULTILINE))


class RandomHeader:
    INTEGERS = ("char", "signed char", "unsigned char", "short", "unsigned short", "int", "unsigned", "long", "unsigned long long")
    WIDTH = {"char": 8, "signed char": 8, "unsigned char": 8, "short": 16, "unsigned short": 16, "int": 32, "unsigned": 32, "long": 64, "unsigned long long": 64}

    def __init__(self, chance, language):
        self.chance, self.language, self.lines, self.structs, self.number = chance, language, [], [], 0
        self.lines.append("enum kind { KIND_A, KIND_B = 3, KIND_C = -1 };")
        for i in range(40):
            self.structs.append(f"S{i}")
            packed = chance.random() < 0.2
            self.lines.append(f"#pragma pack(push, {chance.choice((1, 2, 4))})" if packed else "")
            self.lines.append(f"typedef struct S{i} {self.body(2)} S{i};")
            self.lines.append("#pragma pack(pop)" if packed else "")

    def text(self):
        return "#pragma once\n" + "\n".join(self.lines) + "\n"

    def name(self):
        self.number += 1
        return f"m{self.number}"

    def body(self, depth):
        return "{ " + " ".join(self.member(depth) for _ in range(self.chance.randint(1, 12))) + " }"

    def member(self, depth):
        draw = self.chance.random()
        integer = self.chance.choice(self.INTEGERS)
        if draw < 0.3:
            return f"{integer} {self.name()} : {self.chance.randint(1, self.WIDTH[integer])};"
        if draw < 0.33:
            return f"{integer} : {self.chance.choice((0, 3))};"
        if draw < 0.55:
            return f"{integer} {self.name()}{self.array()};"
        if draw < 0.65:
            return f"{self.chance.choice(('float', 'double', 'enum kind', 'bool' if self.language == 'cc' else '_Bool'))} {self.name()}{self.array()};"
        if draw < 0.7:
            return f"void* {self.name()};"
        if draw < 0.75:
            return f"{integer} {self.name()} __attribute__((aligned({self.chance.choice((4, 8, 16))})));"
        if depth == 0:
            return f"double {self.name()};"
        what = self.chance.choice(("struct", "struct", "union"))
        # C++ has no anonymous structs, but as an extension; both compilers have that one.
        return f"{what} {self.body(depth - 1)} {self.name() + self.array() if self.chance.random() < 0.7 else ''};"

    def array(self):
        return "".join(f"[{self.chance.randint(1, 3)}]" for _ in range(self.chance.choice((0, 0, 0, 1, 2))))

    def printer(self, header, read):
        """A program that prints the place of each member, of bit-fields as they show in the bytes."""
        bit_fields = set(re.findall(r"\b(m\d+) : \d", self.text()))
        lines = ["#include <stddef.h>", "#include <stdio.h>", "#include <string.h>", f'#include "{header}"', "int main(void) {", "  unsigned char bytes[4096];"]
        for name, members in read.items():
            for member in members:
                if member.split(".")[-1] in bit_fields:
                    lines.append(f"  {{ {name} s; memset(&s, 0, sizeof s); s.{member} = -1; memcpy(bytes, &s, sizeof s); int bit = 0;"
                                 f" while (!(bytes[bit / 8] >> bit % 8 & 1)) ++bit; printf(\"{name} {member} %d.%d\\n\", bit / 8, bit % 8); }}")
                else:
                    lines.append(f'  printf("{name} {member} %d\\n", (int)offsetof({name}, {member}));')
        return "\n".join(lines) + "\n  return 0;\n}\n"


if __name__ == "__main__":
    go_to_root()
    RUNGC, RUNTIME, STRUCT_HOST, LINUXCNC_HOST = sys.argv[1:5]
    unittest.main(argv=sys.argv[:1])
