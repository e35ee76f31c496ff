#!/usr/bin/env python3
"""Forces of cells that rungs write, in a host whose compiler is a process of its own, and attacks on that: force_test.py BIN"""
import fcntl
import json
import os
import random
import socket
import struct
import subprocess
import sys
import tempfile
import unittest
import zlib
from pathlib import Path

import remote_test
import source_test
from patience import patience
from remote_test import PROGRAM, WRONG
from source_test import FAKE, SourceHost

BIN = Path(sys.argv[1]).resolve()
EXAMPLES = Path(__file__).resolve().parents[2] / "examples"
# A counter and a coil that rungs write.
COUNTING = PROGRAM.replace("symbol GUARD X0.2", "symbol GUARD X0.2\nsymbol COUNT D8")
HEAD = b"rung-forces 1\n"


class Forcing(SourceHost):
    """With the one that asks in a thread of its own, where his answer takes its time."""

    def begin(self, **request):
        connection = self.connected()
        connection[0].sendall(json.dumps(request).encode() + b"\n")
        return connection

    def answer(self, connection):
        connection[0].settimeout(patience())
        return json.loads(connection[1].readline())

    def fake(self, body):
        """The compiler, from the next process on."""
        self.compiler.write_text(FAKE.format(python="/usr/bin/python3", good=str(self.program), body=body))
        self.compiler.chmod(0o755)


    def keep_what_it_is_given(self, path):
        self.fake(f"open({str(path)!r}, 'wb').write(all); os.write(3, b'failed\\n' + sys.argv[1].encode())")
        self.compiler.write_text(self.compiler.read_text().replace(
            "while os.read(0, 65536): pass", "all = b''\nwhile piece := os.read(0, 65536): all += piece"))


class Forces(Forcing):
    def test_a_cell_that_rungs_write(self):
        self.assertEqual(self.ctl("force", "Y0.0", "true"), "Y0.0 is forced to true\n")
        self.wait(lambda: self.get("Y0.0"))
        self.ctl("force", "X0.0", "true")  # the whole set anew
        self.ctl("force", "Y0.0", "false")
        self.wait(lambda: not self.get("Y0.0"))
        names = {force["name"]: force["value"] for force in json.loads(self.ctl("forced", "--json"))["forced"]}
        self.assertEqual(names, {"X0.0": True, "Y0.0": False})
        self.assertRegex(self.ctl("forced"), r"(?m)^X0\.0 = true, by \S+, since program time \d+\.\d{3} s$")
        self.assertIn("\n2 forced: see rungctl forced\n", self.ctl("status"))
        self.assertEqual(self.ctl("unforce", "Y0.0"), "Y0.0 is no longer forced\n")
        self.wait(lambda: self.get("Y0.0"))
        self.ctl("force", "Y0.0", "false")
        self.assertEqual(self.ctl("unforce", "X0.0"), "X0.0 is no longer forced\n")  # what is left needs code
        self.assertEqual(self.ctl("forced").split(",")[0], "Y0.0 = false")
        self.assertEqual(self.ctl("unforce", "--all").count("is no longer forced\n"), 1)
        self.assertNotIn("forced", self.ctl("status"))
        self.wait(lambda: not self.get("X0.0"))
        self.assertIn("force Y0.0 to true", self.logged())
        self.assertScans()

    def test_the_answer_has_the_id_of_its_request(self):
        connection = self.connected()
        connection[0].sendall(b'{"do":"force","name":"Y0.0","value":true,"id":[7]}\n{"do":"forced","id":8}\n')
        self.assertEqual(self.answer(connection), {"ok": True, "id": [7], "name": "Y0.0", "value": True})
        second = self.answer(connection)
        self.assertEqual((second["id"], [force["name"] for force in second["forced"]]), (8, ["Y0.0"]))

    def test_of_a_program_from_sources(self):
        edited = self.home / "edited.pmc"
        edited.write_text(PROGRAM.replace("LD   X0.0", "LDI  X0.0"))
        self.ctl("force", "Y0.0", "true")
        self.ctl("reload", edited)
        self.assertEqual(self.ctl("forced"), "nothing is forced\n")
        self.wait(lambda: self.get("Y0.0"))
        self.ctl("force", "Y0.0", "false")
        self.wait(lambda: not self.get("Y0.0"))
        self.ctl("rollback")
        self.assertEqual(self.ctl("forced"), "nothing is forced\n")
        self.ctl("force", "Y0.0", "true")
        self.wait(lambda: self.get("Y0.0"))

    def test_a_fault_ends_it(self):
        self.ctl("force", "Y0.0", "true")
        self.wait(lambda: self.get("Y0.0"))
        self.ctl("set", "X0.1", "1")
        self.wait(lambda: "stopped by a fault: dead-loop (rung " in self.ctl("status"))
        self.assertIn("a fault has stopped the program", self.ctl("force", "Y0.0", "true", status=WRONG))
        self.ctl("set", "X0.1", "0")
        self.ctl("reset")
        self.wait(lambda: "\nrunning: " in self.ctl("status"))
        self.assertEqual(self.ctl("forced"), "nothing is forced\n")
        self.ctl("force", "Y0.0", "true")
        self.wait(lambda: self.get("Y0.0"))


class ForcesWithoutIr(Forcing):
    build_options = ("--no-ir",)

    def test_it_is_refused(self):
        self.assertIn("rungs of stuck write a variable that is to be forced: it carries no IR: it was built with --no-ir",
                      self.ctl("force", "Y0.0", "true", status=WRONG))
        self.ctl("force", "X0.0", "true")
        self.wait(lambda: self.get("Y0.0"))


class ForcesThatTakeTime(Forcing):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.compiler = cls.home / "fake"

    def setUp(self):
        self.fake("signal.pause()")
        super().setUp()
        self.asking = self.begin(do="force", name="Y0.0", value=True)
        self.wait(self.children)

    def refused(self):
        answer = self.answer(self.asking)
        self.assertEqual(set(answer), {"ok", "error"})
        self.wait(lambda: not self.children())
        return answer["error"]

    def test_others_are_answered(self):
        before = self.scans()
        self.wait(lambda: self.scans() > before + 5)
        for words in (("force", "X0.0", "true"), ("unforce", "X0.0")):
            self.assertIn("another force is being compiled", self.ctl(*words, status=WRONG))
        self.assertEqual(self.ctl("forced"), "nothing is forced\n")
        self.assertEqual(self.ctl("unforce", "--all"), "nothing was forced\n")
        self.assertEqual(self.refused(), "all forces have been released in the meantime")
        self.ctl("force", "X0.0", "true")

    def test_a_stop(self):
        self.ctl("stop")
        self.assertEqual(self.refused(), "the program has been stopped in the meantime; all forces have ended")

    def test_a_fault(self):
        self.ctl("set", "X0.1", "1")
        self.assertEqual(self.refused(), "the program has stopped in the meantime; all forces have ended")

    def test_a_reload(self):
        self.ctl("reload", self.program)
        self.assertEqual(self.refused(), "another program has taken over in the meantime; all forces have ended")

    def test_who_has_asked_goes_away(self):
        self.asking[0].shutdown(socket.SHUT_RDWR)
        self.assertScans()
        self.ctl("force", "X0.0", "true")

    def test_the_process_is_killed(self):
        os.kill(self.children()[0], 9)
        self.assertIn("to be forced: the compiler process failed: it was ended by the signal Killed", self.refused())


class BrokenForceCompilers(Forcing):
    """What a compiler process delivers that somebody has taken over, or that does not work."""

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.compiler = cls.home / "fake"
        other = remote_test.build(Path(tempfile.mkdtemp(dir=cls.home)), source=COUNTING.replace("OUT  Y0.0", "OUT  Y0.1"))
        cls.other = other
        larger = COUNTING.replace("FUNC END2", "".join(f"LD   X0.3\nOUT  R{cell}.0\n" for cell in range(300)) + "FUNC END2")
        cls.larger = remote_test.build(Path(tempfile.mkdtemp(dir=cls.home)), source=larger)

    def refused(self, body):
        self.fake(body)
        text = self.ctl("force", "Y0.0", "true", status=WRONG)
        self.assertEqual(self.ctl("forced"), "nothing is forced\n")
        self.assertScans()
        return text

    def test_code_that_is_none(self):
        done = '; os.write(3, b"compiled\\n")'
        for body, error in (("image(b'junk' * 1000)" + done, "it is not an ELF"),
                            ("pass" + done, "it is not sealed, so others could still change it"),
                            ("image(good[:-1])" + done, "cannot load the code with the forced variables: "),
                            (f"image(open({str(self.other)!r}, 'rb').read())" + done, "made code of another program"),
                            (f"image(open({str(self.larger)!r}, 'rb').read())" + done, "chunks and"),
                            ('os.write(3, b"hello\\n")', "the compiler process gave an unknown answer"),
                            ('os.write(3, b"failed\\nno")', "to be forced: no"),
                            ("sys.exit(5)", "it ended with status 5")):
            self.assertIn(error, self.refused(body), body)

    def test_no_compiler(self):
        self.fake("pass")
        self.compiler.unlink()
        self.assertIn("install the package rung", self.ctl("force", "Y0.0", "true", status=WRONG))
        self.ctl("force", "X0.0", "true")  # which needs none

    def test_it_is_given_the_program_and_nothing_else(self):
        """As it is loaded, whatever has its path now."""
        given = self.home / "given"
        loaded = self.program.read_bytes()
        self.addCleanup(lambda: self.replace(loaded))
        self.replace(b"another file")
        self.keep_what_it_is_given(given)
        self.assertIn("to be forced: --forces", self.ctl("force", "Y0.0", "true", status=WRONG))
        self.assertTrue(given.read_bytes().startswith(HEAD))
        self.assertTrue(given.read_bytes().endswith(loaded))

    def replace(self, data):
        other = self.home / "replacing"
        other.write_bytes(data)
        other.rename(self.program)


class ForcesOfDialects(SourceHost):
    """Programs that write by computed addresses: hardly a cell that may not be written."""
    map = '[rungctl]\npermissions = ["set", "force", "reload"]\n'

    def run_example(self, name):
        self.end()
        self.program = EXAMPLES / name
        self.start()
        self.wait(lambda: self.socket.exists() and self.logged().count("listening at") == 2)

    def test_nct(self):
        self.run_example("nct-turning-centre")
        self.ctl("force", "B_CONV", "true")  # an input
        self.wait(lambda: self.get("CONV_ON"))
        self.ctl("force", "CONV_ON", "false")
        self.wait(lambda: not self.get("CONV_ON"))
        self.ctl("unforce", "CONV_ON")
        self.wait(lambda: self.get("CONV_ON"))
        self.ctl("unforce", "B_CONV")
        self.ctl("set", "B_CONV", "false")
        self.wait(lambda: not self.get("CONV_ON"))

    def test_technol(self):
        self.run_example("technol-machining-centre")
        before = self.get("O_LIGHT")
        self.ctl("force", "K_LIGHT", "true")  # an input, of a key that toggles
        self.wait(lambda: self.get("O_LIGHT") != before)
        self.ctl("force", "O_COOL2", "true")
        self.wait(lambda: self.get("O_COOL2"))
        self.ctl("unforce", "O_COOL2")
        self.wait(lambda: not self.get("O_COOL2"))
        self.ctl("unforce", "--all")
        self.assertEqual(self.get("O_LIGHT"), not before)


class ForceAttacks(Forcing):
    """The process itself, given what no host gives it."""

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        for name, source, options in (("other", PROGRAM.replace("OUT  Y0.0", "OUT  Y0.1"), ()), ("bare", PROGRAM, ("--no-ir",))):
            (cls.home / name).mkdir()
            setattr(cls, name, remote_test.build(cls.home / name, *options, source=source).read_bytes())
        subprocess.run(["objcopy", "--dump-section", f".rung.ir={cls.home}/section", cls.program, cls.home / "copy"], check=True)
        cls.ir = zlib.decompress((cls.home / "section").read_bytes()[8:])

    def setUp(self):
        """`hashes` and `file` are what a host gives."""
        self.compiler = self.home / "fake"
        given = self.home / "given"
        self.keep_what_it_is_given(given)
        super().setUp()
        self.ctl("force", "Y0.0", "true", status=WRONG)
        data = given.read_bytes()
        self.assertTrue(data.startswith(HEAD))
        self.hashes = data[len(HEAD):len(HEAD) + 16]
        count, *self.forced = struct.unpack_from("<5I", data, len(HEAD) + 16)
        self.assertEqual(count, 1)
        self.file = data[len(HEAD) + 36:]

    def packed(self, hashes=None, forced=None, file=None):
        fields = [tuple(self.forced)] if forced is None else forced
        return (HEAD + (hashes or self.hashes) + struct.pack("<I", len(fields)) +
                b"".join(struct.pack("<4I", *field) for field in fields) + (self.file if file is None else file))

    def with_ir(self, text, size=None):
        section = self.home / "section"
        section.write_bytes(struct.pack("<Q", len(text) if size is None else size) + zlib.compress(text, 1))
        subprocess.run(["objcopy", "--update-section", f".rung.ir={section}", self.program, self.home / "copy"], check=True)
        return (self.home / "copy").read_bytes()

    def process(self, data, *words):
        """Its verdict and report, and the program that it has made."""
        files = (os.memfd_create("image", os.MFD_ALLOW_SEALING), *os.pipe())
        image, answers, answer = (fcntl.fcntl(file, fcntl.F_DUPFD_CLOEXEC, 20) for file in files)  # above those that it gets
        for file in files:
            os.close(file)

        def give_files():
            os.dup2(answer, 3)
            os.dup2(image, 4)

        done = subprocess.Popen([BIN / "rung-compile", *words], stdin=subprocess.PIPE, stdout=subprocess.DEVNULL,
                                stderr=subprocess.DEVNULL, close_fds=False, preexec_fn=give_files, start_new_session=True)
        os.close(answer)
        with os.fdopen(answers, "rb") as answers:
            try:
                with done.stdin:
                    done.stdin.write(data)
            except BrokenPipeError:
                pass  # it has seen enough
            verdict, _, report = answers.read().decode().partition("\n")
        status = done.wait(patience())
        made = os.pread(image, 1 << 26, 0)
        os.close(image)
        self.assertEqual(status, 0, report)
        return verdict, report, made

    def refused(self, data, *words):
        verdict, report, made = self.process(data, *(words or ("--forces",)))
        self.assertEqual((verdict, made), ("failed", b""), report)
        return report

    def test_a_good_one(self):
        verdict, report, made = self.process(self.packed(), "--forces")
        self.assertEqual((verdict, report), ("compiled", ""))
        self.assertTrue(made.startswith(b"\x7fELF"))
        self.assertNotIn(b".rung.ir", made)

    def test_one_form_is_not_taken_for_the_other(self):
        """Whoever may send sources cannot send IR."""
        self.assertEqual(self.process(self.packed())[:2], ("failed", "found bytes that are not sources, or not all of them"))
        sources = source_test.packed({b"a.pmc": PROGRAM.encode()}, [b"a.pmc"], b"gsk")
        self.assertEqual(self.process(sources)[0], "compiled")
        self.assertEqual(self.refused(sources), "found bytes that are not forces, or not all of them")

    def test_bytes_that_are_not_forces(self):
        good = self.packed()
        for size in (0, 5, len(HEAD), len(HEAD) + 10, len(HEAD) + 18, len(HEAD) + 30):
            self.assertEqual(self.refused(good[:size]), "found bytes that are not forces, or not all of them")
        self.assertEqual(self.refused(self.packed(forced=[])), "found no forced byte, expected one at least")
        space, byte, mask, value = self.forced
        for forced, error in (([(space, byte, 0, 0)], "without bits"), ([(space, byte, 256, 0)], "without bits"),
                              ([(space, byte, 1, 2)], "with others than its own"),
                              ([(space, byte, 1, 1)] * 2, "not in their order"),
                              ([(space, byte + 1, 1, 1), (space, byte, 1, 1)], "not in their order"),
                              ([(space, 2**32 - 1, 1, 1)], "lies in no space of the program"),
                              ([(2**32 - 1, byte, 1, 1)], "lies in no space of the program"),
                              ([(space, at, 1, 1) for at in range(4097)], "found 4097 forced bytes, expected at most 4096")):
            self.assertIn(error, self.refused(self.packed(forced=forced)), forced[:3])
        self.assertIn("expected no more", self.refused(self.packed(file=bytes(70 << 20))))

    def test_files_that_are_not_the_programs(self):
        nothing = "it carries no IR: it was built with --no-ir, or by another linker"
        another = "this compiler compiles its IR differently; compile it again"
        for data, error in (({"file": b""}, nothing), ({"file": self.file[:3000]}, nothing), ({"file": bytes(1 << 20)}, nothing),
                            ({"file": self.bare}, nothing), ({"file": self.other}, another), ({"hashes": bytes(16)}, another)):
            self.assertEqual(self.refused(self.packed(**data)), error)

    def test_files_that_are_damaged(self):
        chance = random.Random(4711)
        for _ in range(15):
            data = bytearray(self.file)
            for _ in range(chance.randrange(1, 40)):
                data[chance.choice((chance.randrange(len(data)), chance.randrange(64), len(data) - 1 - chance.randrange(3000)))] = chance.randrange(256)
            self.assertIn(self.process(self.packed(file=bytes(data)), "--forces")[0], ("failed", "compiled"))  # and it ends well

    def test_ir_that_is_not_the_programs(self):
        self.assertEqual(self.process(self.packed(file=self.with_ir(self.ir)), "--forces")[0], "compiled")
        for text, size, error in ((b"", None, "its IR has another version; compile it again"),
                                  (b"rung-ir 2" + self.ir[9:], None, "its IR has another version; compile it again"),
                                  (self.ir, 2**62, "its IR is damaged"), (self.ir, 5, "its IR is damaged"),
                                  (self.ir, 2**30, "its IR is damaged"),
                                  (self.ir + b"?", None, "its IR cannot be read: "),
                                  (self.ir.splitlines(True)[0], None, "its IR "),
                                  (self.ir.splitlines(True)[0] + b"(" * 10_000_000, None, "its IR cannot be read: ")):
            self.assertIn(error, self.refused(self.packed(file=self.with_ir(text, size))), text[:20])

    def test_ir_that_is_changed(self):
        """Words of the text in other places, from a seed: nothing of it becomes code. Marks, which are comments, may change."""
        def code(text):
            return b"\n".join(line for line in text.splitlines() if not line.startswith(b"; mark ")).split()

        chance = random.Random(815)
        words = self.ir.split(b" ")
        for _ in range(60):
            text = list(words)
            for _ in range(chance.randrange(1, 4)):
                at = chance.randrange(len(text))
                text[at] = chance.choice((chance.choice(words), b"4294967295", b"-1", b"", b"9" * 30, text[at] + b"\n" + text[at]))
            if code(b" ".join(text)) != code(self.ir):
                self.refused(self.packed(file=self.with_ir(b" ".join(text))))

    def test_a_gigabyte_of_ir(self):
        head = self.ir.splitlines(True)[0]
        self.assertIn("its IR ", self.refused(self.packed(file=self.with_ir(head + bytes((1 << 30) - len(head))))))


if __name__ == "__main__":
    sys.argv.pop(1)
    remote_test.BIN = BIN
    source_test.BIN = BIN
    unittest.main()
