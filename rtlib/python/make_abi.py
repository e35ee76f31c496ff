#!/usr/bin/env python3
"""Writes _rung_abi.py, rung/runtime.h for ctypes, which rung.py imports. make_abi.py RUNTIME.h PROGRAM.h OUTPUT"""
import re
import sys
from pathlib import Path

HEAD = '''"""rung/runtime.h for ctypes, made from it by make_abi.py when Rung was built. The module rung is for people."""
import ctypes
from ctypes import CFUNCTYPE, POINTER


class Sized(ctypes.Structure):
    """A struct that begins with its size."""

    def __init__(self, **values):
        super().__init__(size=ctypes.sizeof(self), **values)


'''
SCALARS = {"int32_t": "ctypes.c_int32", "uint32_t": "ctypes.c_uint32", "int64_t": "ctypes.c_int64", "uint64_t": "ctypes.c_uint64",
           "size_t": "ctypes.c_size_t", "double": "ctypes.c_double", "rung_cell": "ctypes.c_uint32"}
# Of rung/program.h, which programs are made of, the module has rung_program and these.
PROGRAM_ENUMS = ("rung_type", "rung_symbol_flags", "rung_message_op")
PROGRAM_CONSTANTS = ("RUNG_NONE", "RUNG_MAX_SERVICE_ARGS")


def without_comments(text):
    return re.sub(r"/\*.*?\*/|//[^\n]*", " ", text, flags=re.DOTALL)


def constants(text):
    return dict(re.findall(r"^#define (RUNG_\w+) \(?(0x[0-9A-Fa-f]+|\d+)u?\)?[ \t]*$", text, re.MULTILINE))


def enums(text):
    """{name: [(member, value)]}; every member in the header has an explicit value."""
    return {name: [tuple(re.split(r"\s*=\s*", member)) for member in split(body, ",")]
            for name, body in re.findall(r"\benum (rung_\w+) \{(.*?)\}", text, re.DOTALL)}


def split(text, separator):
    """Splits a text at separators outside parentheses."""
    return [part.strip() for part in re.split(separator + r"(?![^()]*\))", text) if part.strip() not in ("", "void")]


class Types:
    """Translates types of C to ctypes. `structs` are the structs to write, `handles` point to types private to the
    library."""

    def __init__(self, structs, handles):
        self.structs, self.handles = structs, handles

    def of(self, declared):
        """(name, type) of a member or a parameter."""
        function = re.fullmatch(r"(.*?)\(\*(\w+)\)\((.*)\)", declared, re.DOTALL)
        if function:
            result, name, parameters = function.groups()
            kinds = [self.kind(result)] + [self.of(parameter)[1] for parameter in split(parameters, ",")]
            return name, f"CFUNCTYPE({', '.join(kinds)})"
        kind, name, count = re.fullmatch(r"(.*?)(\w+)(?:\[(\w+)\])?", declared, re.DOTALL).groups()
        return name, self.kind(kind) + (f" * {count}" if count else "")

    def kind(self, text):
        base = " ".join(re.sub(r"\bconst\b|\*", " ", text).split())
        stars = text.count("*")
        if base == "void":
            return "ctypes.c_void_p" if stars else "None"
        if base == "char":
            return ("ctypes.c_char", "ctypes.c_char_p", "POINTER(ctypes.c_char_p)")[stars]
        known = SCALARS.get(base, base if base in self.structs else "ctypes.c_void_p")
        return f"POINTER({known})" if stars else known

    def parameter(self, declared):
        """A parameter as in FUNCTIONS: a word if rung.py converts the argument."""
        *kind, name = re.findall(r"\w+|\*", declared)
        kind = [word for word in kind if word != "const"]
        if kind[0] in self.handles:
            return '"handle"' if len(kind) == 2 else '"new"'
        if "const char*" in declared:
            return '"path"' if name == "path" else '"text"'
        if len(kind) == 1:
            return '"uint32_t"' if kind[0] == "rung_cell" else f'"{kind[0]}"'
        return self.of(declared)[1]


def struct(types, kind, name, body):
    members = [types.of(member) for member in split(body, ";")]
    base = "ctypes.Union" if kind == "union" else "Sized" if members[0][0] == "size" else "ctypes.Structure"
    fields = "".join(f'\n        ("{member}", {of}),' for member, of in members)
    return f"\n\nclass {name}({base}):\n    _fields_ = [{fields}\n    ]\n"


def module(runtime, program):
    of_program = constants(program)
    numbers = {name: of_program[name] for name in PROGRAM_CONSTANTS} | constants(runtime)
    lists = {name: values for name, values in enums(program).items() if name in PROGRAM_ENUMS} | enums(runtime)
    structs = {name: (kind, body) for text in (program, runtime)
               for kind, name, body in re.findall(r"typedef (struct|union) (rung_\w+) \{(.*?)\n\} \w+;", text, re.DOTALL)
               if text is runtime or name == "rung_program"}
    types = Types(structs, re.findall(r"typedef struct (rung_\w+) \1;", runtime))
    functions = re.findall(r"^RUNG_API (.*?)(\w+)\(((?:[^()]|\([^()]*\))*)\);", runtime, re.MULTILINE | re.DOTALL)
    out = [HEAD, *(f"{name} = {value}\n" for name, value in numbers.items()), "\nENUMS = {\n"]
    for name, values in lists.items():
        members = "".join(f'\n        "{member}": {value},' for member, value in values)
        out.append(f'    "{name}": {{{members}\n    }},\n')
    out.append("}\n")
    out += [struct(types, kind, name, body) for name, (kind, body) in structs.items()]
    out.append("\n\n# The result, and the parameters; rung.py says what a word means.\nFUNCTIONS = {\n")
    for result, name, parameters in functions:
        kinds = [types.kind(result), *(types.parameter(parameter) for parameter in split(parameters, ","))]
        out.append(f'    "{name}": ({", ".join(kinds)},),\n')
    return "".join([*out, "}\n"])


def main():
    runtime, program = (without_comments(Path(name).read_text()) for name in sys.argv[1:3])
    Path(sys.argv[3]).write_text(module(runtime, program))


if __name__ == "__main__":
    main()
