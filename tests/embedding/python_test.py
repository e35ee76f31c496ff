#!/usr/bin/env python3
"""The Python module rung: against the C header, and with programs of every dialect.
python_test.py RUNGC LIBRUNG_RUNTIME FOLDER_OF_THE_MODULE"""
import ctypes
import enum
import gc
import importlib
import os
import pickle
import re
import shutil
import subprocess
import sys
import tempfile
import threading
import unittest
import weakref
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "support"))
from patience import patience

RUNGC = None
RUNTIME = None
rung = None  # the module

ROOT = Path(__file__).resolve().parents[2]
MODULE = None  # rung.py
ABI = ROOT / "rtlib/abi"
HEADER = (ABI / "rung/runtime.h").read_text()
FOLDER = None  # temporary, of the programs

MS = 1_000_000  # ns

# A text, arrays, reals and a constant. NEXT: WORDS has moved, LONG is gone, SPEED is of another type, LAST is new.
VALUES = """DATA
COUNT:  DS 2
LONG:   DS 4
TEXT:   STR  8,'ABCD'
        EQUI FIVE,5
DATA_END
MODULE_INPUT
MODULE_INPUT_END
MODULE_MAIN
        LOD  COUNT
        AD   CNST.1
        STO  COUNT
MODULE_MAIN_END
MODULE_BLOCK_INIT
MODULE_BLOCK_INIT_END
MODULE_BLOCK_DONE
MODULE_BLOCK_DONE_END
MODULE_INIT
        DEF_OUT WORDS[3],'words',TYPE_WORD
        DEF_OUT REALS[2],'reals',TYPE_REAL
        DEF_OUT SPEED,'speed',TYPE_REAL
MODULE_INIT_END
MODULE_CLEAR
MODULE_CLEAR_END
MODULE_HALT
MODULE_HALT_END
STOP
"""
NEXT = (VALUES.replace("LONG:   DS 4\n", "").replace("'speed',TYPE_REAL", "'speed',TYPE_WORD")
        .replace("        DEF_OUT WORDS", "        DEF_OUT LAST,'last',TYPE_WORD\n        DEF_OUT WORDS"))
MESSAGES = """dialect nct
module MAIN
message 20 "Spindle {#0:F0} has not stopped"
message 21 "Temperature {*0:F2} \N{DEGREE SIGN}C"
symbol SHOW  7000.00 ; a bit
symbol WARM  7000.01
rung
|--[SHOW]--{MSG #20 #0 #1 #3}--(7100.00)
rung
|--[WARM]--{ALRF #21 #2 #0 *-0.25}--(7100.01)
"""
# Message 12 with the value of COUNT while SHOW is on, 13 with it.
NOTES = VALUES.replace("DATA\n", "DATA\n        DFM  SHOW,,,,,,,\n", 1).replace(
    "MODULE_MAIN_END", "        LDR  SHOW\n        JL0  QUIET\n        ESET 12,-,-,COUNT\n        ESET 13\nQUIET:\nMODULE_MAIN_END")
# Asks for a tool offset by the block from D100 on: function, result, length, number, attribute, data. AGAIN: ever again.
WINDOW = """dialect gsk
symbol ASK  R0.0
symbol DONE R0.1
module LEVEL1
rung
|--[ASK]--{WINDR D100 R10}--(DONE)
module LEVEL2
rung
|--[X0.0]--(Y0.0)
"""
AGAIN = WINDOW.replace("[ASK]", "[ASK]--[/DONE]")


def build(source, name, *options):
    output = str(Path(FOLDER.name) / name)
    subprocess.run([RUNGC, "build", source, "-o", output, "--no-project", "-q", *options], check=True)
    return output


def written(name, text):
    path = Path(FOLDER.name) / name
    path.write_text(text)
    return str(path)


def setUpModule():
    global FOLDER
    FOLDER = tempfile.TemporaryDirectory()
    for name in ("axis", "axis-2"):
        build(f"examples/embed-plc/{name}.lad", f"{name}.so", "--profile")
    for name, text in (("values.plc", VALUES), ("next.plc", NEXT), ("messages.lad", MESSAGES), ("notes.plc", NOTES), ("window.lad", WINDOW),
                       ("again.lad", AGAIN)):
        build(written(name, text), Path(name).stem + ".so")


def tearDownModule():
    FOLDER.cleanup()


def program(name):
    return str(Path(FOLDER.name) / name)


def compiled(name, text, *options):
    output = program(name)
    subprocess.run(["cc", "-std=c11", "-Wall", "-Werror", f"-I{ABI}", *options, "-o", output, written(f"{name}.c", text)], check=True)
    return output


class Case(unittest.TestCase):
    def image(self, name="axis"):
        image = rung.Image(program(f"{name}.so"))
        self.addCleanup(image.close)
        return image

    def plc(self, name="axis", **options):
        """An instance that is switched on."""
        plc = rung.Instance(self.image(name), **options)
        self.addCleanup(plc.close)
        plc.power_on(rung.COLD)
        return plc

    def fails(self, status, call, *args, text="", **kwargs):
        with self.assertRaises(rung.Error) as caught:
            call(*args, **kwargs)
        self.assertEqual(caught.exception.status, status, caught.exception)
        self.assertIn(text, str(caught.exception))


# ---- against the header ----------------------------------------------------------------------------------------------

TAGS = {"c_uint32": "uint32_t", "c_int32": "int32_t", "c_uint64": "uint64_t", "c_int64": "int64_t", "c_double": "double"}


def members(text):
    """The names and values of the enum constants in a piece of C."""
    return {name: int(value) for name, value in re.findall(r"\b(RUNG_\w+) = (-?\d+)", text)}


class Header(unittest.TestCase):
    def output(self, body):
        """What a C program with the header prints, in lines."""
        text = ('#include <stddef.h>\n#include <stdio.h>\n#include "rung/runtime.h"\n'
                "#define TYPE(value) _Generic((value), uint32_t: \"uint32_t\", int32_t: \"int32_t\", uint64_t: \"uint64_t\", "
                "int64_t: \"int64_t\", double: \"double\", const char*: \"const char*\", char*: \"char*\", int64_t*: \"int64_t*\", "
                "void*: \"void*\", default: \"other\")\n"
                f"int main(void) {{\n{body}\nreturn 0;\n}}\n")
        return subprocess.run([compiled("header", text)], capture_output=True, text=True, check=True).stdout.splitlines()

    @staticmethod
    def structs():
        return {name: kind for name, kind in vars(rung._abi).items() if name.startswith("rung_")}

    @staticmethod
    def tag(kind):
        if issubclass(kind, ctypes.Array):
            return "char*" if kind._type_ is ctypes.c_char else "int64_t*"
        if kind is ctypes.c_char_p:
            return "const char*"
        if kind is ctypes.c_void_p:
            return "void*"
        return next((tag for name, tag in TAGS.items() if getattr(ctypes, name) is kind), "other")

    def test_structs_are_laid_out_as_in_c(self):
        structs = self.structs()
        asked, expected = [], []
        for name, kind in structs.items():
            for field, of in kind._fields_:
                asked.append(f'printf("{name}.{field} %zu %zu %s\\n", offsetof({name}, {field}), sizeof((({name}*)0)->{field}), '
                             f"TYPE((({name}*)0)->{field}));")
                expected.append(f"{name}.{field} {getattr(kind, field).offset} {ctypes.sizeof(of)} {self.tag(of)}")
            asked.append(f'printf("{name} %zu\\n", sizeof({name}));')
            expected.append(f"{name} {ctypes.sizeof(kind)}")
        self.assertEqual(self.output("\n".join(asked)), expected)
        declared = set(re.findall(r"^typedef (?:struct|union) (rung_\w+) \{", HEADER, re.MULTILINE))
        self.assertEqual(declared, set(structs) - {"rung_program"})

    def test_every_struct_has_its_size(self):
        for name, kind in self.structs().items():
            if hasattr(kind, "size"):
                self.assertEqual(kind().size, ctypes.sizeof(kind), name)

    def test_every_function_is_declared_with_its_types(self):
        declared = re.findall(r"^RUNG_API ([^;(]*?)(\w+)\(((?:[^;()]|\([^()]*\))*)\);", HEADER, re.MULTILINE)
        self.assertEqual(len(declared), HEADER.count("\nRUNG_API "))
        self.assertEqual({name for _, name, _ in declared}, set(rung._abi.FUNCTIONS))
        results = {"int32_t": ctypes.c_int32, "uint32_t": ctypes.c_uint32, "const char*": ctypes.c_char_p,
                   "const rung_program*": ctypes.POINTER(rung._abi.rung_program)}
        handles = dict.fromkeys(("rung_image*", "rung_instance*", "rung_watch*", "rung_replacement*", "rung_forces*", "rung_trace*", "rung_shadow*"), (rung._Handle,))
        kinds = rung._KINDS
        types = {name: (kinds[name],) for name in ("int32_t", "uint32_t", "int64_t", "uint64_t", "size_t")}
        types |= {"rung_cell": types["uint32_t"], "char*": (kinds["text"], kinds["path"], ctypes.c_char_p), "void*": (ctypes.c_void_p,),
                  "callback": (ctypes.CFUNCTYPE(None, ctypes.c_void_p),)}
        types |= {f"{name}*": (ctypes.POINTER(getattr(ctypes, kind)),) for name, kind in
                  {"uint32_t": "c_uint32", "int64_t": "c_int64", "size_t": "c_size_t", "rung_cell": "c_uint32"}.items()}
        types |= {f"{name}*": (ctypes.POINTER(kind),) for name, kind in self.structs().items()}
        types |= handles | {f"{name}*": (kinds["new"],) for name in handles}
        for result, name, parameters in declared:
            with self.subTest(function=name):
                function = getattr(rung._library, name)
                self.assertIs(function.restype, results[result.strip()])
                wanted = [] if parameters == "void" else parameters.split(",")
                self.assertEqual(len(function.argtypes), len(wanted))
                for parameter, given in zip(wanted, function.argtypes):
                    kind = "callback" if "(*" in parameter else re.sub(r"\bconst |\w+$", "", " ".join(parameter.split())).strip()
                    self.assertIn(given, types[kind], parameter)

    def test_enums_are_those_of_c(self):
        enums = {rung.Status: ("rung_status", "RUNG_"), rung.Power: ("rung_power", "RUNG_"), rung.Access: ("rung_access", "RUNG_"),
                 rung.Direction: ("rung_direction", "RUNG_"), rung.FunctionKind: ("rung_function_kind", "RUNG_FUNCTION_"),
                 rung.LogLevel: ("rung_log_level", "RUNG_LOG_"), rung.StateFlags: ("rung_state_flags", "RUNG_STATE_"),
                 rung.Type: ("rung_type", "RUNG_TYPE_"), rung.SymbolFlags: ("rung_symbol_flags", "RUNG_SYMBOL_"),
                 rung.MessageOp: ("rung_message_op", "RUNG_MESSAGE_"), rung.ChangeKind: ("rung_change_kind", "RUNG_CHANGE_"),
                 rung.RungChangeKind: ("rung_rung_change_kind", "RUNG_RUNG_"),
                 rung.ShadowState: ("rung_shadow_state", "RUNG_SHADOW_"),
                 rung._Answering: ("rung_answer", "RUNG_"), rung._InstanceFlags: ("rung_instance_flags", "RUNG_"),
                 rung._MessageFlags: ("rung_message_flags", "RUNG_MESSAGE_")}
        of_module = {kind for kind in vars(rung).values() if isinstance(kind, enum.EnumMeta)}
        self.assertEqual(of_module, set(enums))
        text = HEADER + (ABI / "rung/program.h").read_text()
        for kind, (name, prefix) in enums.items():
            body = re.search(rf"^enum {name} \{{(.*?)\n?\}};", text, re.MULTILINE | re.DOTALL)[1]
            self.assertEqual({prefix + member.name: member.value for member in kind}, members(body), name)

    def test_types_of_bound_variables(self):
        names = {"BOOL": ctypes.c_bool, "I8": ctypes.c_int8, "U8": ctypes.c_uint8, "I16": ctypes.c_int16, "U16": ctypes.c_uint16,
                 "I32": ctypes.c_int32, "U32": ctypes.c_uint32, "I64": ctypes.c_int64, "F32": ctypes.c_float, "F64": ctypes.c_double}
        expected = {f"RUNG_HOST_{name}": rung._HOST_TYPES[kind] for name, kind in names.items()}
        self.assertEqual(expected, {name: value for name, value in members(HEADER).items() if name.startswith("RUNG_HOST_")})
        self.assertEqual(rung._HOST_TYPES.keys() - names.values(), {ctypes.c_uint64})

    def test_further_constants(self):
        lines = self.output('printf("%u %u\\n%u\\n%u\\n", RUNG_RUNTIME_MAJOR, RUNG_RUNTIME_MINOR, RUNG_NONE, RUNG_MAX_SERVICE_ARGS);')
        self.assertEqual(lines, [f"{rung._abi.RUNG_RUNTIME_MAJOR} {rung._abi.RUNG_RUNTIME_MINOR}", str(rung._NONE), str(rung._MOST_ARGS)])

    def test_everything_public_is_described(self):
        for name in rung.__all__:
            thing = getattr(rung, name)
            if not isinstance(thing, enum.Enum):
                self.assertTrue(thing.__doc__, name)
        for kind in (rung.Image, rung.Instance, rung.Cell, rung.Watch, rung.Replacement):
            for name, method in vars(kind).items():
                if callable(method) and (not name.startswith("_") or name in ("__getitem__", "__setitem__")):
                    self.assertTrue(method.__doc__, name)


# ---- where the library is --------------------------------------------------------------------------------------------

class Loading(unittest.TestCase):
    def imports(self, module, code="print(rung.version(), rung._library._name)", **environment):
        plain = {name: value for name, value in os.environ.items() if name not in ("RUNG_RUNTIME", "PYTHONPATH", "LD_LIBRARY_PATH")}
        return subprocess.run([sys.executable, "-B", "-c", f"import rung; {code}"], capture_output=True, text=True, timeout=patience(),
                              env=plain | {"PYTHONPATH": str(Path(module).parent)} | environment)

    def loaded(self, module, library, **environment):
        done = self.imports(module, **environment)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(done.stdout.strip().split(") ")[0], "(0, 1")
        self.assertEqual(os.path.normpath(done.stdout.strip().split(") ")[1]), str(library))

    def refused(self, text, module=None, **environment):
        done = self.imports(module or MODULE, **environment)
        self.assertEqual(done.returncode, 1)
        self.assertRegex(done.stderr.splitlines()[-1], f"^ImportError: .*{text}")

    def test_places_of_the_library(self):
        with tempfile.TemporaryDirectory() as folder:
            def linked(place):
                path = Path(folder) / place / "librung-runtime.so.0"
                path.parent.mkdir(parents=True, exist_ok=True)
                path.symlink_to(RUNTIME)
                return path

            module = Path(folder) / "lib/python/site/rung.py"
            module.parent.mkdir(parents=True)
            for file in (MODULE, MODULE.with_name("_rung_abi.py")):
                shutil.copy(file, module.parent)
            self.refused("librung-runtime.so.0.*RUNG_RUNTIME", module)
            self.loaded(module, "librung-runtime.so.0", LD_LIBRARY_PATH=str(Path(RUNTIME).parent))
            for place in ("lib/lib", "lib/python/lib", "lib/python/site"):  # from the farthest to the nearest
                self.loaded(module, linked(place))
            self.loaded(module, RUNTIME, RUNG_RUNTIME=RUNTIME)

    def test_a_library_that_is_not_there(self):
        self.refused("/nowhere/lib.so.*RUNG_RUNTIME", RUNG_RUNTIME="/nowhere/lib.so")

    def test_another_library(self):
        self.refused("undefined symbol: rung_runtime_version", RUNG_RUNTIME=compiled("other.so", "int other;\n", "-shared"))

    def test_a_library_of_another_version(self):
        for version, text in ((0x10000, "1.0"), (0x0, "0.0"), (0x20003, "2.3")):
            code = f"#include <stdint.h>\nuint32_t rung_runtime_version(void);\nuint32_t rung_runtime_version(void) {{ return {version}; }}\n"
            library = compiled(f"version{text}.so", code, "-shared", "-fPIC")
            self.refused(f"version{text}.so is version {text} of librung-runtime, but this module needs version 0.1", RUNG_RUNTIME=library)

    def test_a_library_without_a_function(self):
        code = "unsigned rung_runtime_version(void);\nunsigned rung_runtime_version(void) { return 1; }\n"
        self.refused("undefined symbol: rung_error_text", RUNG_RUNTIME=compiled("bare_library.so", code, "-shared", "-fPIC"))

    def test_the_version(self):
        self.assertEqual(rung.version(), (0, 1))


# ---- images ----------------------------------------------------------------------------------------------------------

class Images(Case):
    def test_what_an_image_is(self):
        image = self.image()
        self.assertEqual((image.name, image.dialect), ("axis", "gsk"))
        self.assertEqual(rung.Image(Path(program("values.so"))).dialect, "technol")

    def test_symbols(self):
        symbols = {symbol.name: symbol for symbol in self.image().symbols()}
        self.assertEqual(list(symbols), sorted(symbols))
        self.assertIn("STROKES", symbols)
        self.assertEqual(symbols["AT_END"].comment, "bit of COMPARED: the position is beyond the limit")
        self.assertEqual((symbols["AT_END"].type, symbols["AT_END"].byte, symbols["AT_END"].bit), (rung.Type.BIT, 10, 2))
        symbols = {symbol.name: symbol for symbol in self.image("values").symbols()}
        five = symbols["FIVE"]
        self.assertEqual((five.flags, five.space, five.value), (rung.SymbolFlags.CONST, None, 5))
        self.assertEqual((symbols["WORDS"].type, symbols["WORDS"].count), (rung.Type.I16, 3))
        self.assertEqual((symbols["TEXT"].type, symbols["SPEED"].type), (rung.Type.TEXT, rung.Type.F64))

    def test_files_that_are_refused(self):
        self.fails(rung.Status.REFUSED, rung.Image, "/nowhere/program.so", text="/nowhere/program.so")
        self.fails(rung.Status.REFUSED, rung.Image, written("text.so", "not a program"), text="text.so")
        self.fails(rung.Status.BAD_ARGUMENT, rung.Image, 5, text="5 is not a path")
        self.fails(rung.Status.BAD_ARGUMENT, rung.Image, "a\0b", text="character 0")
        self.fails(rung.Status.WRONG_TYPE, rung.Image, program("axis.so"), keys_folder=5)

    def test_without_a_seal(self):
        sealed = Path(program("axis.so")).read_bytes()
        bare = Path(program("bare.so"))
        bare.write_bytes(sealed[:-136])  # docs/security.md
        self.fails(rung.Status.REFUSED, rung.Image, bare, text="seal")
        with rung.Image(bare, allow_unsealed=True, keys_folder=FOLDER.name) as image:
            self.assertEqual(image.name, "axis")

    def test_a_closed_image(self):
        with self.image() as image:
            plc = rung.Instance(image)
            symbols = image.symbols()
            next(symbols)
        image.close()  # again
        self.assertEqual(image.name, "axis")
        self.fails(rung.Status.BAD_HANDLE, rung.Instance, image)
        self.fails(rung.Status.BAD_HANDLE, next, symbols)
        with plc:  # continues with what it has
            plc.power_on()
            self.assertTrue(plc.scan())

    def test_handles_of_another_kind(self):
        plc = self.plc()
        for wrong in (plc, "image", None, 8, 4096, ctypes.c_void_p(8)):
            self.fails(rung.Status.BAD_HANDLE, rung.Instance, wrong, text="not that of an image")
            self.fails(rung.Status.BAD_HANDLE, rung.Replacement, plc, wrong)
        self.fails(rung.Status.BAD_HANDLE, rung.Replacement, self.image(), self.image(), text="not that of an instance")
        self.fails(rung.Status.BAD_HANDLE, plc.replace, plc, text="not that of a replacement")


# ---- running ---------------------------------------------------------------------------------------------------------

class Running(Case):
    def test_by_the_clock_of_the_host(self):
        plc = self.plc(measure=True)
        state = plc.state()
        self.assertEqual(state.flags, rung.StateFlags.ON | rung.StateFlags.AT_START)
        self.assertEqual((state.due_us, state.wait_ns, state.scans), (8000, 8 * MS, 0))
        for _ in range(16):
            self.assertIs(plc.run_due(MS), True)
        state = plc.state()
        self.assertEqual((state.scans, state.now_us, state.missed), (2, 16000, 0))
        self.assertGreater(state.worst_ns, 0)
        self.assertLessEqual(state.last_ns, state.worst_ns)
        self.assertTrue(plc.run_due(30 * 8 * MS))
        self.assertEqual((plc.state().missed, plc.state().now_us), (29, 16000 + 240000))

    def test_bad_times(self):
        plc = self.plc()
        for wrong in (-1, 3_600_000_000_001, 1 << 64, "1", 1.5, None):
            self.fails(rung.Status.BAD_ARGUMENT, plc.run_due, wrong)
            self.fails(rung.Status.BAD_ARGUMENT, plc.limit, wrong)
        self.assertEqual(plc.state().now_us, 0)

    def test_by_parts_of_the_schedule(self):
        plc = self.plc("values")
        self.assertIs(plc.scan(), True)
        self.assertIs(plc.scan(count=4), True)
        self.assertEqual((plc["COUNT"], plc.state().scans), (5, 5))
        while plc["COUNT"] == 5:
            self.assertIs(plc.slice(), True)
        self.assertEqual(plc.state().worst_ns, 0)  # not measured
        for wrong in (0, -1, 1 << 32):
            self.fails(rung.Status.BAD_ARGUMENT, plc.scan, wrong)
        self.fails(rung.Status.WRONG_TYPE, plc.scan, 1.0)
        plc = self.plc()
        plc["START"] = 1
        self.assertIs(plc.fast(), True)
        self.assertEqual(plc["ENABLE"], 1)
        plc["STOP"] = 1
        self.assertIs(plc.slot(), True)
        self.assertEqual(plc["ENABLE"], 0)

    def test_stop_and_start(self):
        plc = self.plc("values")
        plc.stop()
        self.assertTrue(plc.scan(3))
        self.assertIn(rung.StateFlags.STOPPED, plc.state().flags)
        self.assertEqual(plc["COUNT"], 0)
        plc.start()
        plc.scan(3)
        self.assertEqual(plc["COUNT"], 3)

    def test_a_fault(self):
        plc = self.plc()
        self.assertIsNone(plc.fault())
        enable = ctypes.c_bool()
        plc.bind("ENABLE", enable, rung.FROM_PROGRAM)
        plc["START"] = 1
        plc.scan(2)
        self.assertTrue(enable.value)
        plc["JAM"] = 1
        self.assertIs(plc.scan(1000), False)
        self.assertLess(plc.state().scans, 10)
        for run in (plc.scan, plc.slice, plc.slot, plc.fast):
            self.assertIs(run(), False)
        self.assertIs(plc.run_due(8 * MS), False)
        fault = plc.fault()
        self.assertEqual((fault.code, fault.task, fault.rung), ("dead-loop", "LEVEL2", 5))
        self.assertEqual(fault.file, "examples/embed-plc/axis.lad")
        self.assertIn("{LBL L1}", Path(fault.file).read_text().splitlines()[fault.line])  # the line after `rung`
        self.assertEqual(fault.text, f"dead-loop (rung 5, {fault.file}:{fault.line})")
        self.assertIn(rung.StateFlags.FAULTED, plc.state().flags)
        self.assertFalse(enable.value)  # safe
        plc["JAM"] = 0
        plc.power_on()
        self.assertIsNone(plc.fault())
        self.assertTrue(plc.scan())

    def test_a_limit_of_time(self):
        plc = self.plc()
        plc.limit(1)
        plc["JAM"] = 1
        self.assertFalse(plc.scan(10))
        self.assertEqual(plc.fault().code, "max-time")
        plc.limit(0)
        plc["JAM"] = 0
        plc.power_on(rung.COLD)
        self.assertTrue(plc.scan(10))

    def test_power(self):
        plc = rung.Instance(self.image("values"))
        self.addCleanup(plc.close)
        for run in (plc.scan, plc.slice, plc.slot, plc.fast, plc.power_off):
            self.fails(rung.Status.WRONG_STATE, run, text="not switched on")
        self.fails(rung.Status.WRONG_STATE, plc.run_due, MS)
        self.assertNotIn(rung.StateFlags.ON, plc.state().flags)
        for wrong in (2, -1, "warm", 1 << 32):
            self.fails(rung.Status.BAD_ARGUMENT, plc.power_on, wrong)
        plc.power_on()
        plc["LONG"] = 7
        plc.power_on(rung.WARM)
        plc.power_off()
        self.assertNotIn(rung.StateFlags.ON, plc.state().flags)
        plc.power_on(rung.COLD)
        self.assertEqual(plc["LONG"], 0)

    def test_a_closed_instance(self):
        plc = self.plc()
        cell = plc.cell("START")
        with plc:
            pass
        plc.close()  # again
        for call in (plc.power_on, plc.power_off, plc.stop, plc.start, plc.slice, plc.scan, plc.slot, plc.fast, plc.state, plc.fault,
                     plc.shown, plc.next_request, plc.flush, plc.worst_rung, cell.read):
            self.fails(rung.Status.BAD_HANDLE, call, text="not that of an instance")
        for call, arguments in ((plc.run_due, (MS,)), (plc.limit, (0,)), (plc.cell, ("STOP",)), (plc.__getitem__, ("START",)),
                                (plc.__setitem__, ("START", 1)), (plc.read_all, (["START"],)), (plc.write_all, ({"START": 1},)),
                                (plc.bind, ("START", ctypes.c_bool(), rung.TO_PROGRAM)), (list, (plc.messages(),)),
                                (list, (plc.profile(),)), (plc.answer, (1,)), (plc.begin_function, (0, rung.M, 3)),
                                (plc.function_done, (0, 0)), (plc.abort_functions, (0,)), (plc.keep, ("x",)), (plc.replace, (None,)),
                                (cell.write, (1,)), (rung.Replacement, (plc, self.image()))):
            self.fails(rung.Status.BAD_HANDLE, call, *arguments)


# ---- names and values ------------------------------------------------------------------------------------------------

class Values(Case):
    def setUp(self):
        self.values = self.plc("values")

    def test_numbers(self):
        plc = self.values
        for value, seen in ((True, 1), (-1, -1), (0xFFFF, -1), (-32768, -32768), (-2, -2)):
            plc["COUNT"] = value
            self.assertEqual(plc["COUNT"], seen)
        for wrong in (70000, -40000, 1 << 40, 1 << 64, -1 << 64):
            self.fails(rung.Status.BAD_ARGUMENT, plc.__setitem__, "COUNT", wrong, text=f"COUNT: {wrong} is not in the range of -32768 to 65535")
            self.fails(rung.Status.BAD_ARGUMENT, plc.write_all, {"COUNT": wrong}, text="is not in the range")
        self.assertEqual(plc["COUNT"], -2)
        plc["LONG"] = 0x12345678
        self.assertIs(type(plc["LONG"]), int)
        self.assertEqual(plc["LONG"], 0x12345678)
        plc["SPEED"] = -1.5
        self.assertEqual(plc["SPEED"], -1.5)
        plc["SPEED"] = 3
        self.assertIs(type(plc["SPEED"]), float)
        self.assertEqual(plc["FIVE"], 5)

    def test_reals_by_their_names(self):
        plc = self.plc("messages")  # of NCT: a double has two words
        plc["REAL.7200"] = 2.5
        self.assertEqual((plc["REAL.7200"], plc["7200"], plc["7201"]), (2.5, 0, 0x40040000))
        plc.write_all({"REAL.7200": 3, "7202": 5})
        self.assertEqual(plc.read_all(["REAL.7200", "7202"]), {"REAL.7200": 3.0, "7202": 5})
        info = plc.cell("REAL.7200").info
        self.assertEqual((info.type, info.address), (rung.Type.F64, "REAL.7200"))
        self.fails(rung.Status.WRONG_TYPE, plc.__setitem__, "REAL.7200", "2.5", text="is not a real number")
        for wrong in ("REAL.9999", "REAL.SHOW", "REAL."):
            self.fails(rung.Status.NOT_FOUND, plc.__getitem__, wrong)
        self.values["REAL.TEXT"] = -0.5  # of TECHNOL: where eight bytes are
        self.assertEqual((self.values["REAL.TEXT"], self.values["QWRD.TEXT"]), (-0.5, -0x4020000000000000))

    def test_bits_and_addresses(self):
        plc = self.plc()
        for wrong in (2, -1, 256):
            self.fails(rung.Status.BAD_ARGUMENT, plc.__setitem__, "X10.0", wrong, text="is not in the range of 0 to 1")
        plc["X10.0"] = 1
        self.assertEqual((plc["START"], plc["X10"]), (1, 1))
        plc["D0:4"] = -123456
        self.assertEqual((plc["D0:4"], plc["D0"], plc["D0:2"]), (-123456, -64, 7616))

    def test_names_without_a_cell(self):
        plc = self.plc()
        self.assertEqual(plc.describe("D0:4"), plc.cell("D0:4").info)
        self.fails(rung.Status.NOT_FOUND, plc.describe, "NOWHERE")
        plc.release("D0:4")
        plc.release("D0:4")  # again
        self.assertEqual(plc["D0:4"], 0)

    def test_arrays(self):
        plc = self.values
        plc["WORDS"] = [1, -2, 7000]
        self.assertEqual(plc["WORDS"], [1, -2, 7000])
        self.fails(rung.Status.BAD_ARGUMENT, plc.__setitem__, "WORDS", [1, -2, 70000], text="is not in the range")
        plc["WORDS"] = (number for number in (4, 5, 6))
        plc["REALS"] = (0.5, 2)
        self.assertEqual((plc["WORDS"], plc["REALS"]), ([4, 5, 6], [0.5, 2.0]))
        self.assertEqual(plc["WORDS[1]"], 5)
        for wrong in ([1, 2], [1, 2, 3, 4], [], 5, "ab"):
            self.fails(rung.Status.BAD_ARGUMENT, plc.__setitem__, "WORDS", wrong, text="WORDS has 3 elements")
        self.fails(rung.Status.WRONG_TYPE, plc.__setitem__, "WORDS", [1, 2, "3"], text="'3' is not an integer")
        self.assertEqual(plc["WORDS"], [4, 5, 6])

    def test_texts(self):
        plc = self.values
        self.assertEqual(plc["TEXT"], "ABCD")
        plc["TEXT"] = "\u010dau"  # in the control's own characters
        self.assertEqual(plc["TEXT"], "\u010dau")
        plc["TEXT"] = "much longer than it"
        self.assertTrue("much longer than it".startswith(plc["TEXT"]) and len(plc["TEXT"]) >= 8)
        plc["TEXT"] = ""
        self.assertEqual(plc["TEXT"], "")
        for wrong in (5, 1.5, None, b"bytes", ["a"], "\udc80"):
            self.fails(rung.Status.WRONG_TYPE, plc.__setitem__, "TEXT", wrong, text="is not a text")
        self.fails(rung.Status.BAD_ARGUMENT, plc.__setitem__, "TEXT", "a\0b", text="character 0")

    def test_values_of_another_type(self):
        plc = self.values
        for wrong in ("1", 1.0, None, b"1"):
            self.fails(rung.Status.WRONG_TYPE, plc.__setitem__, "COUNT", wrong, text="COUNT")
        for wrong in ("1.5", None, b"1", 10 ** 400, 1j):
            self.fails(rung.Status.WRONG_TYPE, plc.__setitem__, "SPEED", wrong, text="SPEED")
        for wrong in (1 << 64, (-1 << 63) - 1):
            self.fails(rung.Status.BAD_ARGUMENT, plc.__setitem__, "COUNT", wrong, text="not in the range")
        self.fails(rung.Status.BAD_ARGUMENT, plc.__setitem__, "COUNT", [1, 2])

    def test_names_that_are_not_found(self):
        plc = self.values
        self.fails(rung.Status.NOT_FOUND, plc.__getitem__, "NOBODY", text="NOBODY is not a name")
        self.fails(rung.Status.NOT_FOUND, plc.__setitem__, "NOBODY", 1)
        self.fails(rung.Status.NOT_FOUND, plc.__getitem__, "WORDS[3]")
        self.fails(rung.Status.NOT_FOUND, plc.__getitem__, "")
        for wrong in (5, None, b"COUNT"):
            self.fails(rung.Status.BAD_ARGUMENT, plc.__getitem__, wrong, text="is not a text")
        self.fails(rung.Status.BAD_ARGUMENT, plc.__getitem__, "COUNT\0")
        self.fails(rung.Status.WRONG_TYPE, plc.__setitem__, "FIVE", 6, text="constant")
        for wrong in (4, -1, "w", 1 << 32):
            self.fails(rung.Status.BAD_ARGUMENT, plc.cell, "COUNT", wrong)
        self.fails(rung.Status.WRONG_TYPE, plc.cell, "COUNT", rung.REAL, text="COUNT has no room for a real")

    def test_cells(self):
        plc = self.values
        cell = plc.cell("WORDS", rung.WRITE)
        self.assertIs(cell, plc.cell("WORDS", rung.WRITE))
        self.assertIsNot(cell, plc.cell("WORDS"))
        info = cell.info
        self.assertEqual((info.type, info.count, info.access), (rung.Type.I16, 3, rung.WRITE))
        self.assertEqual((plc.cell("WORDS").info.access, plc.cell("FIVE").info.space), (rung.READ, None))
        self.assertEqual(self.plc().cell("AT_END").info.address, "R10.2")
        cell.write(7)
        cell.write([8, 9], first=1)
        cell.write([])
        self.assertEqual((cell.read(), cell.read(2), cell.read(1, 2), cell.read(first=0, count=3), cell.read(0, 0)),
                         (7, 9, [8, 9], [7, 8, 9], []))
        for first, count in ((3, 1), (0, 4), (2, 2), (0xFFFFFFFF, 1), (-1, 1), ("0", 1)):
            self.fails(rung.Status.BAD_ARGUMENT, cell.read, first, count)
        for count in (-1, 1 << 40):
            self.fails(rung.Status.BAD_ARGUMENT, cell.read, 0, count)
        for count in ("2", 1.0, None):
            self.fails(rung.Status.WRONG_TYPE, cell.read, 0, count)
        for value, first in ((1, 3), ([1, 2], 2), (1, -1)):
            self.fails(rung.Status.BAD_ARGUMENT, cell.write, value, first)
        self.fails(rung.Status.WRONG_TYPE, plc.cell("WORDS").write, 1, text="RUNG_WRITE")
        text = plc.cell("TEXT", rung.WRITE)
        text.write("new")
        self.assertEqual(text.read(), "new")
        self.fails(rung.Status.BAD_ARGUMENT, text.read, 1, text="as a whole")
        self.fails(rung.Status.BAD_ARGUMENT, text.write, "x", 1, text="as a whole")

    def test_many_at_once(self):
        plc = self.values
        plc.write_all({"COUNT": 3, "SPEED": 2.5, "WORDS": 9})
        self.assertEqual(plc.read_all(["SPEED", "COUNT", "WORDS"]), {"SPEED": 2.5, "COUNT": 3, "WORDS": 9})
        self.assertEqual(plc["WORDS"], [9, 0, 0])
        self.assertEqual(plc.read_all(iter(["FIVE"])), {"FIVE": 5})
        self.assertEqual(plc.read_all([]), {})
        plc.write_all({})
        self.fails(rung.Status.WRONG_TYPE, plc.read_all, ["COUNT", "TEXT"])
        self.fails(rung.Status.NOT_FOUND, plc.read_all, ["COUNT", "NOBODY"])
        for wrong, status in (({"COUNT": 8, "TEXT": 1}, rung.Status.WRONG_TYPE), ({"COUNT": 8, "NOBODY": 1}, rung.Status.NOT_FOUND),
                              ({"COUNT": 8, "LONG": "1"}, rung.Status.WRONG_TYPE), ({"COUNT": 8, "FIVE": 1}, rung.Status.WRONG_TYPE)):
            self.fails(status, plc.write_all, wrong)
        self.assertEqual(plc["COUNT"], 3)  # all or nothing

    def test_bound_variables(self):
        plc = self.values
        inputs = {ctypes.c_bool: 1, ctypes.c_int8: -5, ctypes.c_uint8: 200, ctypes.c_int16: -300, ctypes.c_uint16: 40000,
                  ctypes.c_int32: -70000, ctypes.c_uint32: 3 << 30, ctypes.c_int64: -1, ctypes.c_uint64: 5}
        for kind, value in inputs.items():
            with self.subTest(kind=kind):
                plc = self.plc("values")
                given, seen = kind(value), kind()
                plc.bind("LONG", given, rung.TO_PROGRAM)
                plc.bind("LONG", seen, rung.FROM_PROGRAM)
                plc.scan()
                self.assertEqual(plc["LONG"], (value + (1 << 31)) % (1 << 32) - (1 << 31))
                self.assertEqual(seen.value, value)
                plc.power_off()
                self.assertEqual(seen.value, 0)
        for kind in (ctypes.c_float, ctypes.c_double):
            given, seen, rounded, count = kind(2.5), kind(), ctypes.c_int16(), ctypes.c_double()
            self.values.bind("SPEED", given, rung.TO_PROGRAM, scale=1000)
            self.values.bind("SPEED", seen, rung.FROM_PROGRAM, 100)
            self.values.bind("SPEED", rounded, rung.FROM_PROGRAM)
            self.values.bind("COUNT", count, rung.FROM_PROGRAM, 0.5)
            self.values.scan()
            self.assertEqual((self.values["SPEED"], seen.value, rounded.value), (2500, 25, 2500))
            self.assertEqual(count.value, 2 * self.values["COUNT"])

    def test_variables_that_cannot_be_bound(self):
        plc = self.values
        for wrong in (5, True, None, ctypes.c_char(), ctypes.c_char_p(), (ctypes.c_int32 * 2)(), ctypes.pointer(ctypes.c_int32()),
                      ctypes.c_int32.__ctype_be__()):
            self.fails(rung.Status.WRONG_TYPE, plc.bind, "LONG", wrong, rung.TO_PROGRAM, text="LONG: a bound variable is")
        good = ctypes.c_int32()
        self.fails(rung.Status.NOT_FOUND, plc.bind, "NOBODY", good, rung.TO_PROGRAM)
        self.fails(rung.Status.WRONG_TYPE, plc.bind, "TEXT", good, rung.TO_PROGRAM)
        self.fails(rung.Status.WRONG_TYPE, plc.bind, "FIVE", good, rung.TO_PROGRAM)
        self.fails(rung.Status.WRONG_TYPE, plc.bind, 5, good, rung.TO_PROGRAM)
        self.fails(rung.Status.BAD_ARGUMENT, plc.bind, "LONG", good, 4)
        self.fails(rung.Status.WRONG_TYPE, plc.bind, "LONG", good, rung.BOUND_REAL)
        self.fails(rung.Status.BAD_ARGUMENT, plc.bind, "LONG", good, 1 << 32)
        self.fails(rung.Status.WRONG_TYPE, plc.bind, "LONG", good, "in")
        self.fails(rung.Status.BAD_ARGUMENT, plc.bind, "LONG", good, rung.TO_PROGRAM, float("nan"))
        self.fails(rung.Status.WRONG_TYPE, plc.bind, "LONG", good, rung.TO_PROGRAM, "1")
        plc["LONG"] = 3
        plc.scan()
        self.assertEqual(plc["LONG"], 3)  # nothing was bound

    def test_bound_variables_are_kept_alive(self):
        plc = self.values
        alive = weakref.ref(variable := ctypes.c_int32(77))
        plc.bind("LONG", variable, rung.TO_PROGRAM)
        del variable
        gc.collect()
        plc.scan()
        self.assertEqual(plc["LONG"], 77)
        self.assertIsNotNone(alive())
        plc.close()
        self.assertIsNone(alive())


# ---- messages, services, functions -----------------------------------------------------------------------------------

class Messages(Case):
    def test_shown_and_cleared(self):
        plc = self.plc("messages")
        self.assertEqual((list(plc.messages()), plc.shown()), ([], []))
        plc.write_all({"SHOW": 1, "WARM": 1})
        plc.scan()
        first, second = plc.messages()
        self.assertEqual((first.op, first.number, first.channel, first.index, first.value), (rung.MessageOp.SHOW, 20, 0, 1, 3))
        self.assertTrue(first.text.endswith("Spindle 3 has not stopped"), first)
        self.assertEqual((second.op, second.number, second.channel, second.value), (rung.MessageOp.SHOW_LOG, 21, 2, -0.25))
        self.assertEqual((type(first.value), type(second.value)), (int, float))
        self.assertTrue(second.text.endswith("Temperature -0.25 \N{DEGREE SIGN}C"), second)
        self.assertEqual(list(plc.messages()), [])
        self.assertEqual([(message.number, message.value) for message in plc.shown()], [(20, 3), (21, -0.25)])
        plc["SHOW"] = 0
        plc.scan()
        self.assertEqual([(message.op, message.number) for message in plc.messages()], [(rung.MessageOp.CLEAR, 20)])
        self.assertEqual([message.number for message in plc.shown()], [21])

    def test_texts_of_the_configuration(self):
        plc = rung.Instance(self.image("notes"))
        self.addCleanup(plc.close)
        plc.define_message(12, "Pump %d is hot: 70 \N{DEGREE SIGN}C", lasts=True)
        plc.define_message(13, "counted", logged_only=True)
        plc.power_on(rung.COLD)
        self.fails(rung.Status.WRONG_STATE, plc.define_message, 12, "late", text="before the first power-on")
        plc["SHOW"] = 1
        plc.scan()
        first, second = plc.messages()
        self.assertEqual((first.op, first.number, first.value), (rung.MessageOp.SHOW_LOG, 12, 1))
        self.assertEqual(first.text, "PLC00012 0 1 0 0 Pump 1 is hot: 70 \N{DEGREE SIGN}C")
        self.assertEqual((second.op, second.text), (rung.MessageOp.LOG, "PLC00013 0 0 0 0 counted"))
        self.assertEqual([message.number for message in plc.shown()], [12])
        other = rung.Instance(self.image("messages"))
        self.addCleanup(other.close)
        self.fails(rung.Status.NOT_FOUND, other.define_message, 20, "x", text="in the program")

    def test_lost(self):
        plc = self.plc("messages")
        for _ in range(300):
            plc["SHOW"] = 1 - plc["SHOW"]
            plc.scan()
        self.assertGreater(plc.state().lost_messages, 0)
        self.assertEqual(len(list(plc.messages())), 300 - plc.state().lost_messages)


class Services(Case):
    def asking(self, **options):
        plc = self.plc("window", **options)
        plc.write_all({"D100:2": 1, "D104:2": 4, "D106:2": 7, "D108:2": 3, "D110:4": 0, "ASK": 1})
        return plc

    def result(self, plc):
        """The end code and the data that the program has got."""
        plc.scan(4)
        self.assertEqual(plc["DONE"], 1)
        return plc["D102:2"], plc["D110:4"]

    def test_without_a_host_they_are_refused(self):
        self.assertEqual(self.result(self.asking()), (6, 0))

    def test_answered_at_once(self):
        seen = []

        def answer(plc, request):
            seen.append((plc, request, plc["D106:2"], plc.read_all(["ASK"])))
            return rung.Answer([0, -1234567])

        plc = self.asking(request=answer)
        plc.read_all(["D106:2", "ASK"])  # in a callback no name is looked up
        gc.collect()  # the callback is kept
        self.assertEqual(self.result(plc), (0, -1234567))
        (instance, request, number, asked), = seen
        self.assertIs(instance, plc)
        self.assertEqual((request.service.split()[0], request.args, number, asked), ("windr", (1, 4, 7, 3), 7, {"ASK": 1}))
        self.assertGreater(request.ticket, 0)

    def test_answers_of_a_callback(self):
        for answer, result in ((rung.Answer((3, 5)), (3, 0)), (rung.Answer([], True), (6, 0)), (rung.Answer(error=True), (6, 0)),
                               (rung.Answer(), (0, 0)), (None, (6, 0))):
            self.assertEqual(self.result(self.asking(request=lambda *_: answer)), result, answer)

    def test_wrong_answers_of_a_callback(self):
        for answer, status in ((5, rung.Status.WRONG_TYPE), ([0, 1], rung.Status.WRONG_TYPE), (True, rung.Status.WRONG_TYPE),
                               (rung.Answer(["1"]), rung.Status.WRONG_TYPE), (rung.Answer([1 << 63]), rung.Status.BAD_ARGUMENT),
                               (rung.Answer(range(17)), rung.Status.BAD_ARGUMENT)):
            plc = self.asking(request=lambda *_: answer)
            self.fails(status, plc.scan)
            self.assertEqual(self.result(plc), (6, 0), answer)

    def test_they_wait_for_an_answer(self):
        for options in ({"queue_requests": True}, {"request": lambda *_: rung.QUEUE}):
            plc = self.asking(**options)
            self.assertIsNone(plc.next_request())
            plc.scan(3)
            request = plc.next_request()
            self.assertEqual(request.args, (1, 4, 7, 3))
            self.assertIsNone(plc.next_request())
            self.assertEqual(plc["DONE"], 0)
            self.assertIs(plc.answer(request.ticket, [0, 99]), True)
            self.assertEqual(self.result(plc), (0, 99))

    def test_an_answer_that_failed(self):
        plc = self.asking(queue_requests=True)
        plc.scan()
        plc.answer(plc.next_request().ticket, error=True)
        self.assertEqual(self.result(plc), (6, 0))

    def test_answers_to_nobody(self):
        plc = self.asking(queue_requests=True)
        self.assertTrue(plc.answer(12345, [1]))
        plc.scan()
        self.assertEqual(plc.state().stray_replies, 1)
        while plc.answer(12345):  # until there are more than the program can have asked for
            pass
        plc.scan()
        self.assertTrue(plc.answer(12345))
        self.fails(rung.Status.BAD_ARGUMENT, plc.answer, 1, range(17), text="at most 16")
        self.fails(rung.Status.WRONG_TYPE, plc.answer, 1, ["text"])
        self.fails(rung.Status.BAD_ARGUMENT, plc.answer, 1, [1 << 63])
        self.fails(rung.Status.BAD_ARGUMENT, plc.answer, -1)
        self.fails(rung.Status.WRONG_TYPE, plc.answer, "1")


class Functions(Case):
    def test_the_handshake(self):
        plc = self.plc()
        line = plc.begin_function(0, rung.M, 3)
        self.assertIsNone(plc.begin_function(0, rung.M, 4))  # later
        plc.scan(2)
        self.assertEqual((plc["F7.0"], plc["F10:4"]), (1, 3))
        self.assertIs(plc.function_done(0, line), False)
        plc["G4.3"] = 1
        plc.scan(2)
        plc["G4.3"] = 0
        plc.scan(2)
        self.assertIs(plc.function_done(0, line), True)
        self.assertEqual(plc["F7.0"], 0)

    def test_an_end_unanswered(self):
        plc = self.plc()
        line = plc.begin_function(0, rung.T, 12)
        plc.scan(2)
        self.assertEqual((plc.function_done(0, line), plc["F7.3"]), (False, 1))
        plc.abort_functions(0)
        self.assertEqual((plc.function_done(0, line), plc["F7.3"]), (True, 0))

    def test_what_is_wrong(self):
        plc = self.plc()
        self.fails(rung.Status.NOT_FOUND, plc.begin_function, 1, rung.M, 3, text="channel 1")
        self.fails(rung.Status.NOT_FOUND, plc.function_done, 40, 0)
        self.fails(rung.Status.NOT_FOUND, plc.abort_functions, 40)
        self.fails(rung.Status.BAD_ARGUMENT, plc.begin_function, 0, 6, 3)
        for wrong in (-1, 1 << 32, "3", 3.0):
            self.fails(rung.Status.BAD_ARGUMENT, plc.begin_function, 0, rung.M, wrong)
            self.fails(rung.Status.BAD_ARGUMENT, plc.function_done, 0, wrong)
            self.fails(rung.Status.BAD_ARGUMENT, plc.abort_functions, wrong)
        plc.power_off()
        self.fails(rung.Status.WRONG_STATE, plc.begin_function, 0, rung.M, 3)


# ---- callbacks -------------------------------------------------------------------------------------------------------

class Callbacks(Case):
    def jammed(self, **options):
        plc = self.plc(**options)
        plc["JAM"] = 1
        return plc

    def test_a_fault_is_reported(self):
        seen = []
        plc = self.jammed(fault=lambda plc: seen.append((plc, plc["JAM"])))
        self.assertEqual(plc["JAM"], 1)
        self.assertFalse(plc.scan(10))
        self.assertFalse(plc.scan(10))
        self.assertEqual(seen, [(plc, 1)])

    def test_an_exception_comes_from_the_call(self):
        def raising(plc):
            raise ZeroDivisionError("in the callback")

        for run in (lambda plc: plc.scan(10), lambda plc: plc.run_due(100 * MS), lambda plc: [plc.slice() for _ in range(100)],
                    lambda plc: [plc.slot() for _ in range(100)]):
            plc = self.jammed(fault=raising)
            with self.assertRaisesRegex(ZeroDivisionError, "in the callback"):
                run(plc)
            self.assertIs(plc.scan(), False)  # once
            self.assertEqual(plc.fault().code, "dead-loop")

    def test_every_kind_of_exception(self):
        for kind in (KeyboardInterrupt, SystemExit, rung.Error):
            def raising(plc, kind=kind):
                raise kind(-5, "x")

            with self.assertRaises(kind):
                self.jammed(fault=raising).scan(10)

    def test_the_first_of_several(self):
        calls = []

        def raising(*_):
            calls.append(len(calls))
            raise ValueError(f"number {calls[-1]}")

        plc = self.plc("again", request=raising, catch_up=10)
        plc.write_all({"D100:2": 1, "D104:2": 4, "ASK": 1})
        with self.assertRaisesRegex(ValueError, "number 0"):
            plc.run_due(10 * 8 * MS)
        self.assertGreater(len(calls), 1)
        with self.assertRaisesRegex(ValueError, f"number {len(calls)}"):
            plc.run_due(10 * 8 * MS)
        plc["ASK"] = 0
        self.assertTrue(plc.run_due(10 * 8 * MS))

    def test_in_a_callback_the_instance_is_only_read(self):
        image = self.image("axis-2")
        tried = []

        def callback(plc, _):
            cell = plc.cell("D100:2")
            tried.append((plc["D100:2"], cell.read(), plc.state().flags, plc.fault(), plc.shown()))
            for call in (lambda: plc.scan(), lambda: plc.run_due(MS), lambda: plc.__setitem__("D100:2", 5), plc.power_on, plc.power_off,
                         plc.close, plc.stop, lambda: plc.cell("R5")):
                self.fails(rung.Status.WRONG_STATE, call)
                tried.append(call)

        plc = self.plc("window", request=callback)
        plc.read_all(["D100:2"])
        plc.cell("D100:2", rung.WRITE)
        plc.write_all({"D104:2": 4, "D100:2": 1, "ASK": 1})
        self.assertTrue(plc.scan())
        self.assertEqual(len(tried), 9)
        self.assertEqual(tried[0][:2], (1, 1))
        self.assertEqual(plc["D100:2"], 1)
        self.assertTrue(image)

    def test_an_error_in_a_callback_comes_through(self):
        plc = self.plc("window", request=lambda plc, _: plc.__setitem__("D100:2", 5))
        plc.cell("D100:2", rung.WRITE)
        plc.write_all({"D100:2": 1, "D104:2": 4, "ASK": 1})
        self.fails(rung.Status.WRONG_STATE, plc.scan, text="callback")

    def test_another_instance_in_a_callback(self):
        def inner_fault(_):
            raise LookupError("of the inner one")

        inner = self.jammed(fault=inner_fault)
        seen = []

        def outer_fault(_):
            try:
                inner.scan(10)
            except LookupError as error:
                seen.append(str(error))
            raise ArithmeticError("of the outer one")

        with self.assertRaisesRegex(ArithmeticError, "of the outer one"):
            self.jammed(fault=outer_fault).scan(10)
        self.assertEqual(seen, ["of the inner one"])

    def test_the_log(self):
        lines = []
        kept = program("logged")
        for suffix in (".a", ".b"):
            written("logged" + suffix, "damaged" * 100)
        with rung.Instance(self.image(), log=lambda level, text: lines.append((level, text))) as plc:
            plc.keep(kept)
            plc.power_on()
        (level, text), = lines
        self.assertEqual(level, rung.LogLevel.WARNING)
        self.assertIn("logged.a", text)

    def test_an_exception_of_the_log(self):
        for suffix in (".a", ".b"):
            written("raising" + suffix, "damaged" * 100)

        def raising(level, text):
            raise ValueError(text)

        with rung.Instance(self.image(), log=raising) as plc:
            plc.keep(program("raising"))
            self.assertRaisesRegex(ValueError, "raising.a", plc.power_on)
            self.assertTrue(plc.scan())  # it is on all the same

    def test_an_exception_beside_an_error(self):
        def raising(level, text):
            raise ValueError(text)

        raised = rung._Raised()
        self.assertIsNone(raised.first)

        def failing(callback):
            callback(None, rung.LogLevel.INFO, b"both")
            return -3

        with self.assertRaisesRegex(ValueError, "both") as caught:
            rung._run(failing, rung._callback(rung._CALLBACKS["log"], lambda _, level, text: raising(level, text.decode())))
        self.assertEqual(caught.exception.__context__.status, rung.Status.WRONG_THREAD)  # neither is lost

    def test_another_thread(self):
        inside, go = threading.Event(), threading.Event()

        def waiting(plc, _):
            inside.set()
            go.wait(60)

        plc = self.plc("window", request=waiting)
        plc.write_all({"D100:2": 1, "D104:2": 4, "ASK": 1})
        thread = threading.Thread(target=plc.scan)
        thread.start()
        try:
            self.assertTrue(inside.wait(60))
            for call in (plc.scan, plc.state, plc.close, lambda: plc["ASK"], lambda: plc.run_due(MS)):
                self.fails(rung.Status.WRONG_THREAD, call, text="another thread")
            self.assertEqual(list(plc.messages()), [])  # which any thread may take
            self.assertIsNone(plc.next_request())
            with rung.Replacement(plc, self.image("window")) as change:  # prepared meanwhile
                self.assertEqual(change.changes(), [])
        finally:
            go.set()
            thread.join()
        self.assertTrue(plc.scan())

    def test_exceptions_belong_to_the_thread_of_the_call(self):
        inside, go = threading.Event(), threading.Event()
        raised = []

        def raising(plc):
            inside.set()
            go.wait(60)
            raise ValueError("of the thread")

        plc, other = self.jammed(fault=raising), self.plc()

        def scanning():
            try:
                plc.scan(10)
            except ValueError as error:
                raised.append(error)

        thread = threading.Thread(target=scanning)
        thread.start()
        self.assertTrue(inside.wait(60))
        self.assertTrue(other.scan())
        self.fails(rung.Status.WRONG_THREAD, plc.scan)
        go.set()
        thread.join()
        self.assertEqual(str(raised[0]), "of the thread")


# ---- retained memory, profile ----------------------------------------------------------------------------------------

class Retained(Case):
    def test_it_is_kept(self):
        kept = Path(program("kept"))

        def run(value):
            with rung.Instance(self.image()) as plc:
                plc.keep(kept)
                plc.power_on(rung.WARM)
                before = plc["STROKES:2"]
                plc["STROKES:2"] = value
                plc.scan(4)
                plc.flush()
                state = plc.state()
                self.assertGreaterEqual(state.saves, 1)
                self.assertEqual(state.failed_saves, 0)
                plc.power_off()
            return before

        self.assertEqual((run(11), run(12), run(13)), (0, 11, 12))
        self.assertTrue(Path(f"{kept}.a").exists() and Path(f"{kept}.b").exists())

    def test_what_is_wrong(self):
        plc = self.plc()
        self.assertIsNone(plc.unsaved())
        self.fails(rung.Status.WRONG_STATE, plc.flush)
        self.fails(rung.Status.WRONG_STATE, plc.keep, program("late"))
        with rung.Instance(self.image()) as plc:
            self.fails(rung.Status.BAD_ARGUMENT, plc.keep, "")
            self.fails(rung.Status.BAD_ARGUMENT, plc.keep, 5)
            self.fails(rung.Status.BAD_ARGUMENT, plc.keep, "a\0")
            plc.keep(program("nowhere/kept"))
            self.fails(rung.Status.FAILED, plc.power_on, text="nowhere")
            self.fails(rung.Status.WRONG_STATE, plc.scan)
            plc.keep(program("elsewhere"))
            plc.power_on()
            self.fails(rung.Status.WRONG_STATE, plc.keep, program("again"))

    def test_two_at_one_place(self):
        with rung.Instance(self.image()) as first, rung.Instance(self.image()) as second:
            for plc in (first, second):
                plc.keep(program("shared"))
            first.power_on()
            self.fails(rung.Status.FAILED, second.power_on, text="shared")


class Profiled(Case):
    def test_rungs(self):
        plc = self.plc()
        self.assertIsNone(plc.worst_rung())
        plc.scan(20)
        rungs = [rung_ for rung_ in plc.profile() if rung_.rung != 0]
        self.assertEqual([entry.title for entry in rungs][:3], ["the drive", "the stroke: 5 mm", "counted once"])
        for entry in rungs:
            self.assertEqual((entry.runs, entry.file), (20, "examples/embed-plc/axis.lad"))
            self.assertGreaterEqual(entry.total_ns, 0)
            self.assertGreater(entry.line, 0)
        worst = plc.worst_rung()
        self.assertIn(worst, list(plc.profile()))
        plc.power_on()
        self.assertIsNone(plc.worst_rung())

    def test_a_program_without_counters(self):
        plc = self.plc("values")
        self.fails(rung.Status.WRONG_STATE, list, plc.profile(), text="--profile")
        self.fails(rung.Status.WRONG_STATE, plc.worst_rung)


# ---- watching --------------------------------------------------------------------------------------------------------

class Watching(Case):
    def test_the_newest_scan(self):
        plc = self.plc("values")
        with rung.Watch(plc, ["COUNT", "SPEED", "WORDS"]) as watch:
            self.assertIsNone(watch.newest())
            plc.write_all({"SPEED": 2.5, "WORDS": 7})
            plc.scan(3)
            plc["COUNT"] = 50  # not at the end of a scan
            sample, values = watch.newest()
            self.assertEqual(values, {"COUNT": 3, "SPEED": 2.5, "WORDS": 7})
            self.assertEqual((sample.scan, sample.now_us, sample.generation, sample.lost), (3, plc.state().now_us, 0, 0))
            self.assertEqual(watch.newest(), (sample, values))
            self.assertEqual(list(watch.samples()), [])  # none is kept
        self.fails(rung.Status.BAD_HANDLE, watch.newest, text="not that of a watch")
        self.fails(rung.Status.BAD_HANDLE, list, watch.samples())
        watch.close()  # again

    def test_every_scan(self):
        plc = self.plc("values")
        watch = rung.Watch(plc, iter(["COUNT"]), depth=4)
        plc.scan(3)
        self.assertEqual([(sample.scan, values["COUNT"]) for sample, values in watch.samples()], [(1, 1), (2, 2), (3, 3)])
        plc.scan(6)
        samples = list(watch.samples())
        self.assertEqual([values["COUNT"] for _, values in samples], [4, 5, 6, 7])
        self.assertEqual(samples[-1][0].lost, 2)
        self.assertEqual(watch.newest()[1], {"COUNT": 9})

    def test_a_name_that_another_program_does_not_have(self):
        plc = self.plc("values")
        plc["LONG"] = 5
        watch = rung.Watch(plc, ["LONG", "COUNT"])
        plc.scan()
        self.assertEqual(watch.newest()[1], {"LONG": 5, "COUNT": 1})
        self.assertTrue(plc.replace(rung.Replacement(plc, self.image("next"))))
        plc.scan()
        sample, values = watch.newest()
        self.assertEqual((values, sample.generation), ({"LONG": 0, "COUNT": 2}, 1))

    def test_by_another_thread(self):
        plc = self.plc("values")
        watch = rung.Watch(plc, ["COUNT"], depth=1000)
        seen, go = [], threading.Event()

        def looking():
            go.wait(60)
            while not seen or seen[-1] < 300:
                seen.extend(values["COUNT"] for _, values in watch.samples())
                newest = watch.newest()
                if newest is not None:
                    self.assertLessEqual(newest[1]["COUNT"], 300)

        thread = threading.Thread(target=looking)
        thread.start()
        go.set()
        plc.scan(300)
        thread.join(60)
        self.assertEqual(seen, list(range(1, 301)))

    def test_what_is_wrong(self):
        plc = self.plc("values")
        self.fails(rung.Status.WRONG_TYPE, rung.Watch, plc, ["COUNT", "TEXT"])
        self.fails(rung.Status.NOT_FOUND, rung.Watch, plc, ["NOBODY"])
        self.fails(rung.Status.BAD_ARGUMENT, rung.Watch, plc, [])
        for depth in (-1, 1_000_001, "1"):
            self.fails(rung.Status.BAD_ARGUMENT, rung.Watch, plc, ["COUNT"], depth)
        watches = [rung.Watch(plc, ["COUNT"]) for _ in range(16)]
        self.fails(rung.Status.WRONG_STATE, rung.Watch, plc, ["COUNT"])
        watches[3].close()
        watches.append(rung.Watch(plc, ["COUNT"]))
        plc.scan()
        plc.close()
        for watch in watches:
            self.fails(rung.Status.BAD_HANDLE, watch.newest)
            watch.close()


# ---- another program -------------------------------------------------------------------------------------------------

class Replacing(Case):
    def test_the_axis(self):
        plc, new = self.plc(), self.image("axis-2")
        strokes = ctypes.c_uint16()
        plc.bind("STROKES:2", strokes, rung.FROM_PROGRAM)
        plc["STROKES:2"] = 30
        plc.scan()
        with rung.Replacement(plc, new) as change:
            report = change.report()
            changes = change.changes()
            self.assertEqual(report.changes, len(changes))
            self.assertGreater(report.kept_cells, 5)
            self.assertGreater(report.bytes, 0)
            self.assertGreater(report.steps, 0)
            self.assertGreater(report.slice_ns, 0)
            self.assertEqual(report.period_ns, 8_000_000)
            self.assertRegex(report.bound, r"[mun]s: \d+ steps of .*, and the period is 8 ms$")
            change.allow_late()
            self.assertEqual(changes[0], rung.Change(rung.ChangeKind.MOVED, False, "STROKES", ""))
            kinds = {(one.kind, one.is_state) for one in changes[1:]}
            self.assertEqual(kinds, {(rung.ChangeKind.NEW, True)})
            self.assertEqual(plc["D10:2"], 30)
            self.assertIs(plc.replace(change), True)
            self.assertEqual(plc.state().generation, 1)
            self.assertEqual((plc["STROKES:2"], plc["D20:2"]), (30, 30))
            plc.scan()
            self.assertEqual(strokes.value, 30)
            self.assertEqual(change.changes()[0].kind, rung.ChangeKind.MOVED)  # now of the way back
            self.assertTrue(plc.replace(change))
            self.assertEqual(plc.cell("STROKES:2").info.address, "D10:2")
        self.fails(rung.Status.BAD_HANDLE, plc.replace, change)
        self.fails(rung.Status.BAD_HANDLE, change.report)
        self.fails(rung.Status.BAD_HANDLE, change.changes)
        change.close()  # again

    def test_cells_of_another_program(self):
        plc = self.plc("values")
        plc["WORDS"] = [1, 2, 3]
        cells = [plc.cell(name) for name in ("LONG", "SPEED", "WORDS", "TEXT")]
        long, speed, words, text = cells
        offset = words.info.byte
        change = rung.Replacement(plc, self.image("next"))
        named = {(one.kind, one.name) for one in change.changes() if not one.is_state}
        self.assertLessEqual({(rung.ChangeKind.REMOVED, "LONG"), (rung.ChangeKind.RETYPED, "SPEED"), (rung.ChangeKind.NEW, "LAST"),
                              (rung.ChangeKind.MOVED, "WORDS")}, named)
        self.assertTrue(plc.replace(change))
        self.fails(rung.Status.NOT_FOUND, long.read, text="does not have")
        self.fails(rung.Status.NOT_FOUND, plc.__getitem__, "LONG")
        self.fails(rung.Status.WRONG_TYPE, speed.read, text="another type")
        self.assertEqual((plc["WORDS"], plc["LAST"], text.read()), ([1, 2, 3], 0, "ABCD"))
        self.assertNotEqual(words.info.byte, offset)
        self.assertTrue(plc.replace(change))
        self.assertEqual((long.read(), speed.read()), (0, 0.0))

    def test_not_at_this_moment(self):
        plc = self.plc("messages")
        change = rung.Replacement(plc, self.image("messages"))
        plc.slice()
        self.assertNotIn(rung.StateFlags.AT_START, plc.state().flags)
        self.assertIs(plc.replace(change), False)
        plc.scan()
        self.assertIs(plc.replace(change), True)

    def test_replacements_that_do_not_fit(self):
        plc, other = self.plc(), self.plc()
        self.fails(rung.Status.REFUSED, rung.Replacement, plc, self.image("values"), text="technol")
        first, second = (rung.Replacement(plc, self.image("axis-2")) for _ in range(2))
        self.fails(rung.Status.BAD_ARGUMENT, other.replace, first, text="another instance")
        self.assertTrue(plc.replace(first))
        self.fails(rung.Status.WRONG_STATE, plc.replace, second, text="another program")

    def test_a_program_runs_beside_the_one_that_runs(self):
        plc = self.plc()
        position = ctypes.c_int32(0)
        plc.bind("D0:4", position, rung.TO_PROGRAM)
        plc["START"] = True
        with rung.Shadow(plc, self.image("axis-2"), scans=50) as shadow:
            self.assertIs(shadow.work(), False)
            self.assertEqual(shadow.report().state, rung.ShadowState.PREPARED)
            plc.slice()
            while not plc.shadow(shadow):
                plc.slice()
            self.fails(rung.Status.WRONG_STATE, plc.shadow, shadow)
            for _ in range(60):
                position.value += 250
                plc.scan()
                while shadow.work():
                    pass
            report = shadow.report()
            self.assertEqual((report.state, report.fault), (rung.ShadowState.FINISHED, ""))
            self.assertGreaterEqual(report.runs, 50)
            found = {difference.name: difference for difference in shadow.differences()}
            self.assertEqual(len(found), report.differences)
            self.assertEqual(found["ENABLE"].type, rung.Type.BIT)
            self.assertNotEqual(found["ENABLE"].running, found["ENABLE"].next)  # the other one goes further
            plc.shadow(None)
        with rung.Shadow(plc, self.image("axis"), scans=5, room=1) as shadow:
            self.assertTrue(plc.shadow(shadow))
            plc.scan()
            plc.scan()
            self.assertTrue(shadow.work())
            self.assertEqual(shadow.report().state, rung.ShadowState.TOO_SLOW)
        self.fails(rung.Status.REFUSED, rung.Shadow, plc, self.image("values"), 5, text="technol")
        self.fails(rung.Status.BAD_ARGUMENT, rung.Shadow, plc, self.image("axis"), 0)

    def test_they_end_with_their_instance(self):
        plc = self.plc()
        change = rung.Replacement(plc, self.image("axis-2"))
        plc.close()
        self.fails(rung.Status.BAD_HANDLE, change.report)
        change.close()


# ---- lives -----------------------------------------------------------------------------------------------------------

class Forcing(Case):
    def test_cells_are_held(self):
        plc = self.plc("values")
        forces = rung.Forces(plc, {"LONG": 7}, owner="me")
        self.assertEqual(plc.forced(), [])
        self.assertTrue(plc.force(forces))
        plc["LONG"] = 1
        plc.scan()
        self.assertEqual(plc["LONG"], 7)
        self.assertEqual([(force.name, force.value, force.owner) for force in plc.forced()], [("LONG", 7, "me")])
        self.assertTrue(plc.force(None))
        self.assertEqual(plc.forced(), [])
        with rung.Forces(plc, {"LONG": 8}) as other:
            plc.force(other)
        self.assertEqual(plc.forced(), [], "a set that is closed ends")

    def test_what_is_wrong(self):
        plc = self.plc("values")
        self.fails(rung.Status.NOT_FOUND, rung.Forces, plc, {"NOBODY": 1})
        self.fails(rung.Status.BAD_ARGUMENT, rung.Forces, plc, {})
        self.fails(rung.Status.REFUSED, rung.Forces, plc, {"COUNT": 1}, text="compiler")
        self.fails(rung.Status.WRONG_TYPE, rung.Forces, plc, {"LONG": "text"})

    def test_a_trace(self):
        plc = self.plc("values")
        path = str(Path(FOLDER.name) / "trace.vcd")
        with rung.Watch(plc, ["COUNT"], depth=8) as watch, rung.Trace(watch, path) as trace:
            self.assertFalse(trace.write())
            plc.scan(2)
            self.assertTrue(trace.write())
            plc.scan()
        with open(path, encoding="utf-8") as file:
            self.assertRegex(file.read(), r"COUNT \$end[^$]*")
        with rung.Watch(plc, ["COUNT"]) as watch:
            self.fails(rung.Status.BAD_ARGUMENT, rung.Trace, watch, path, text="keeps no scans")


class Lives(Case):
    def test_what_nobody_uses_ends(self):
        kept = program("dropped")
        variable = ctypes.c_int32()
        plc = rung.Instance(self.image(), request=lambda *_: None, fault=lambda *_: None, log=lambda *_: None)
        plc.keep(kept)
        plc.power_on()
        plc["STROKES:2"] = 5
        plc.bind("STROKES:2", variable, rung.FROM_PROGRAM)
        cell = plc.cell("STROKES:2")
        plc.scan()
        alive = weakref.ref(plc)
        del plc  # without the collector: it is in no cycle
        self.assertIsNone(alive())
        self.fails(rung.Status.BAD_HANDLE, cell.read)
        with rung.Instance(self.image()) as plc:  # its file is free
            plc.keep(kept)
            plc.power_on()
            self.assertEqual(plc["STROKES:2"], 5)

    def test_cycles_end_in_any_order(self):
        for turn in range(20):
            class Host:
                def fault(self, plc):
                    pass

            host = Host()
            host.image = rung.Image(program("axis.so"))
            host.plc = rung.Instance(host.image, fault=host.fault)
            host.changes = [rung.Replacement(host.plc, rung.Image(program("axis-2.so"))) for _ in range(turn % 3)]
            host.watch = rung.Watch(host.plc, ["STROKES"])
            host.plc.power_on()
            host.plc.scan()
            alive = weakref.ref(host.plc)
            del host
            gc.collect()
            self.assertIsNone(alive())

    def test_a_process_ends_with_all_of_it_open(self):
        code = ("import rung, sys\n"
                "image, new = map(rung.Image, sys.argv[1:])\n"
                "plc = rung.Instance(image, fault=print, log=print)\n"
                "plc.power_on()\n"
                "change = rung.Replacement(plc, new)\n"
                "watch = rung.Watch(plc, ['STROKES'], 5)\n"
                "plc.scan()\n"
                "print(plc.replace(change))\n")
        done = subprocess.run([sys.executable, "-B", "-c", code, program("axis.so"), program("axis-2.so")], capture_output=True, text=True,
                              env=os.environ | {"PYTHONPATH": str(MODULE.parent)}, timeout=patience())
        self.assertEqual((done.returncode, done.stdout, done.stderr), (0, "True\n", ""))

    def test_errors(self):
        error = rung.Error(-5, "not there")
        self.assertEqual((error.status, str(error)), (rung.Status.NOT_FOUND, "not there"))
        again = pickle.loads(pickle.dumps(error))
        self.assertEqual((again.status, str(again)), (error.status, "not there"))
        self.assertEqual(rung.Error(-77, "of a later library").status, -77)


class Example(unittest.TestCase):
    def run_axis(self, *arguments):
        return subprocess.run([sys.executable, "-B", "examples/embed-python/axis.py", *arguments], capture_output=True, text=True,
                              env=os.environ | {"PYTHONPATH": str(MODULE.parent)}, timeout=patience())

    def test_the_toy_runs_faults_and_changes(self):
        done = self.run_axis(program("axis.so"), program("axis-2.so"))
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        lines = done.stdout.splitlines()
        self.assertRegex(lines[0], r"^703 ms: dead-loop \(rung 5, examples/embed-plc/axis\.lad:\d+\)$")
        self.assertEqual(lines[1:3], ["1000 ms: the new program runs", "  moved: STROKES"])
        self.assertRegex(lines[-1], r"^11 strokes; the worst rung is .*, examples/embed-plc/axis-2\.lad:\d+$")

    def test_what_is_wrong_is_said(self):
        done = self.run_axis("/nowhere/axis.so", program("axis-2.so"))
        self.assertEqual((done.returncode, len(done.stderr.splitlines())), (1, 1))
        self.assertIn("/nowhere/axis.so", done.stderr)
        self.assertIn("PROGRAM.so NEXT.so", self.run_axis().stderr)

    def test_it_is_short(self):
        self.assertLessEqual(len(Path("examples/embed-python/axis.py").read_text().splitlines()), 60)


if __name__ == "__main__":
    RUNGC, RUNTIME, folder = (os.path.abspath(sys.argv.pop(1)) for _ in range(3))
    MODULE = Path(folder) / "rung.py"
    os.environ["RUNG_RUNTIME"] = RUNTIME
    os.chdir(ROOT)
    sys.dont_write_bytecode = True
    sys.path.insert(0, str(MODULE.parent))
    rung = importlib.import_module("rung")
    unittest.main()
