#!/usr/bin/env python3
"""rungc diff against edits whose meaning is known: this script changes the text of programs by rules of its own, and knows which lines then do
otherwise. diff_truth_test.py RUNGC [SEED]; RUNG_TRUTH=large: all examples, many edits."""
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

RUNGC = None
SEED = 1
LARGE = os.environ.get("RUNG_TRUTH") == "large"
EDITS = 50  # of a program; in a large run as many of each of ROUNDS seeds
ROUNDS = 8
TRIES = 40  # for one edit: where it does not suit the place that was drawn, the compiler refuses the program

SMALL = {"nct": ["nct-lathe"], "gsk": ["gsk-mill"], "technol": ["technol-mill"], "fanuc": ["fanuc-vmc"]}
ALL = {
    "nct": ["nct-lathe", "nct-turning-centre"],
    "gsk": ["gsk-mill", "gsk-panel", "first-cnc"],
    "technol": ["technol-mill", "technol-magazine", "technol-machining-centre"],
    "fanuc": ["fanuc-vmc"],
}

TEXT = re.compile(r"\"[^\"]*\"|'[^']*'")


class Unsuitable(Exception):
    """The edit finds no place in this program."""


class Edit:
    """A changed file of the project, and what has to be reported: rungs as (kinds, line before, line after), 0 for none, and what else by
    the beginnings of names."""

    def __init__(self, file, lines, rungs=(), names=(), contents=(), messages=(), configuration=()):
        self.file, self.lines, self.rungs = file, lines, list(rungs)
        self.more = {}  # other files
        self.other = {"names": list(names), "contents": list(contents), "messages": list(messages), "configuration": list(configuration)}


# ---- what a program is to this script: lines ------------------------------------------------------------------------


class Source:
    def __init__(self, folder, dialect, rng):
        self.folder, self.dialect, self.rng = folder, dialect, rng
        ending = {"nct": "*.lad", "gsk": "*.[lp][am][dc]", "technol": "*.plc", "fanuc": "*.mne"}[dialect]
        self.files = {path.name: path.read_text().splitlines() for path in sorted(folder.glob(ending))}
        self.file = rng.choice(sorted(self.files))
        self.lines = list(self.files[self.file])
        self.is_ladder = self.file.endswith(".lad")
        self.without_code = set(outside_ladder(self.lines)) if dialect == "fanuc" else ()

    def code(self, at):
        """Without the remark; a mark inside a text does not count. Of a mnemonic file only the ladder."""
        return "" if at in self.without_code else code_of(self.lines[at])

    def pick(self, found):
        found = list(found)
        if not found:
            raise Unsuitable
        return self.rng.choice(found)

    def edit(self, **what):
        return Edit(self.file, self.lines, **what)

    def is_in_message(self, word):
        """Texts of messages have no quotes in a mnemonic file."""
        return self.dialect == "fanuc" and any(re.match(r"A\d", line) and re.search(rf"\b{word}\b", line) for line in self.lines)

    def occurs(self, word):
        """Lines of all files with the word in their code, as (file, line); of a mnemonic file in its ladder."""
        pattern = re.compile(rf"(?<![\w]){re.escape(word)}(?![\w])", re.IGNORECASE if self.dialect == "technol" else 0)
        return [(file, i) for file, lines in self.files.items() for i, line in enumerate(lines)
                if pattern.search(TEXT.sub("", code_of(line))) and not (file == self.file and i in self.without_code)]

    def replace_word(self, word, other):
        """Not in texts: what is there is another thing of that name, as a key of the control's configuration."""
        pattern = re.compile(rf"({TEXT.pattern})|(?<![\w]){re.escape(word)}(?![\w])")
        for i, line in enumerate(self.lines):
            code = code_of(line)
            self.lines[i] = pattern.sub(lambda found: found[1] or other, code) + line[len(code):]


def outside_ladder(lines):
    """Of a mnemonic file: lines of other sections, and comments."""
    inside = False
    for at, line in enumerate(lines):
        inside = line.startswith("%@3") if line.startswith("%") else inside
        if not inside or line.startswith(("%", "(*")):
            yield at


def code_of(line):
    inside = False
    for at, letter in enumerate(line):
        inside ^= letter in "\"'"
        if letter == ";" and not inside:
            return line[:at]
    return line


def is_unique(lines, text):
    return lines.count(text) == 1


# ---- rungs, as far as they are certain ------------------------------------------------------------------------------

LADDER_HEADS = re.compile(r"(rung|module|section|symbol|const|message|button|dialect|level|subprogram|sub)\b", re.IGNORECASE)
LOGIC = {
    "gsk": re.compile(r"\s*(LD|LDI|AND|ANI|OR|ORI|ORB|ANB|OUT|OUTI|SET|RST)\b"),
    "technol": re.compile(r"\s*(LDR|LA|LO|LX|CA|WR|FL|FL0|FL1)\b"),
    "fanuc": re.compile(r"\s*((RD|RD\.NOT|RD\.STK|RD\.NOT\.STK|AND|AND\.NOT|OR|OR\.NOT|WRT|WRT\.NOT|SET|RST)\s+\S|(AND|OR)\.STK\s*$)"),
}
BEGINS = {"gsk": re.compile(r"\s*LDI?\s"), "technol": re.compile(r"\s*LDR\s"), "fanuc": re.compile(r"\s*RD(\.NOT)?\s")}
ENDS = {"gsk": re.compile(r"\s*(OUT|OUTI|SET|RST)\s"), "technol": re.compile(r"\s*(WR|FL|FL0|FL1)\s"), "fanuc": re.compile(r"\s*(WRT|WRT\.NOT|SET|RST)\s")}
# Of contacts: those that are not negated, the same negated, and all with their bit; of a rung its words.
PLAIN = {"gsk": {"LD": "LDI", "AND": "ANI", "OR": "ORI"}, "fanuc": {"RD": "RD.NOT", "RD.STK": "RD.NOT.STK", "AND": "AND.NOT", "OR": "OR.NOT"}}
CONTACT = {"gsk": r"\s*(?:LD|AND|OR|LDI|ANI|ORI)\s+(\w+(?:\.\d)?)\s*$", "technol": r"\s*(?:LDR|LA|LO)\s+(\w+)\s*$",
           "fanuc": r"\s*(?:RD|AND|OR)(?:\.NOT)?(?:\.STK)?\s+(\S+)\s*$"}
COIL = {"gsk": r"\s*OUT\s+(\S+)", "technol": r"\s*WR\s+(\w+)\s*$", "fanuc": r"\s*WRT\s+(\S+)", "nct": r"--\((\w+)\)\s*$"}
FIRST = {"gsk": r"\s*LD\s+(\S+)", "technol": r"\s*LDR\s+(\w+)\s*$", "fanuc": r"\s*RD\s+(\S+)", "nct": r"\|--\[(\w+)\]"}
WORDS = {"gsk": ("LD ", "ANI ", "OUT "), "technol": ("LDR ", "LA  -", "WR "), "fanuc": ("RD ", "AND.NOT ", "WRT ")}


def ladder_rungs(source):
    heads = [i for i, line in enumerate(source.lines) if LADDER_HEADS.match(line)] + [len(source.lines)]
    rungs = []
    for begin, end in zip(heads, heads[1:]):
        if source.lines[begin].split()[0] == "rung":
            while end > begin and not source.code(end - 1).strip():
                end -= 1
            rungs.append((begin, end))
    return rungs


def equations(source):
    """Of a list: those that consist of contacts and coils alone, between an output and a load."""
    begin, end = BEGINS[source.dialect], ENDS[source.dialect]
    code = [i for i in range(len(source.lines)) if source.code(i).strip()]
    borders = [b for a, b in zip(code, code[1:]) if end.match(source.code(a)) and begin.match(source.code(b))]
    found = []
    for first, following in zip(borders, borders[1:]):
        body = [i for i in code if first <= i < following]
        one_load = source.dialect != "technol" or sum(1 for i in body if begin.match(source.code(i))) == 1
        if one_load and all(LOGIC[source.dialect].match(source.code(i)) for i in body):
            found.append((first, body[-1] + 1))
    return found


def rungs(source):
    return ladder_rungs(source) if source.is_ladder else equations(source)


def is_plain(text):
    """Nothing that others go by: a label, a subroutine, a common line."""
    return not re.search(r"\b(JME|SBN|RET|END|JMPE|LBL|SP|SPE|COM|COME|END1|END2)\b", text)


# ---- edits that change nothing -------------------------------------------------------------------------------------


def remark(source):
    at = source.pick(begin for begin, _ in rungs(source))
    source.lines.insert(at, source.rng.choice(["; a remark", ";", "  ; (S X) [Y] {MOV A B} LD X0.0"]))
    return source.edit()


def remark_behind(source):
    at = source.pick(i for i in range(len(source.lines)) if ";" not in source.lines[i] and source.code(i).strip() and not source.lines[i].startswith("include"))
    source.lines[at] += "  ; another remark"
    return source.edit()


def blank_lines(source):
    at = source.pick(begin for begin, _ in rungs(source))
    source.lines[at:at] = [""] * source.rng.randint(1, 3)
    return source.edit()


def spaces(source):
    if source.is_ladder:
        at = source.pick(i for i, line in enumerate(source.lines) if re.match(r"(symbol|const)\s+\w+ ", line))
        source.lines[at] = re.sub(r"^(\w+)\s+(\w+) ", r"\1   \2    ", source.lines[at])
    else:
        at = source.pick(i for begin, end in equations(source) for i in range(begin, end) if source.code(i).strip())
        code = source.code(at)
        source.lines[at] = source.rng.choice(["  ", "\t", "            "]) + re.sub(r"^(\s*\w+)\s+", r"\1 \t ", code).strip() + source.lines[at][len(code):]
    return source.edit()


def title(source):
    if source.is_ladder:
        at = source.pick(begin for begin, _ in ladder_rungs(source))
        source.lines[at] = 'rung "another title"'
    else:
        at = source.pick(begin for begin, _ in equations(source))
        source.lines[at] = source.code(at) + " ; another title"
    return source.edit()


def spelling(source):
    """Another spelling of a number."""
    number = {"nct": r"#(\d+)\b", "gsk": r"\b(?:PRM|FUNC)(\s+)(\d+)\s*$", "fanuc": r"^\s*(?:SUB\s+)?(\d+)\s*$", "technol": r"(\bCNST\.|\bTIM\s+\S+,)(\d+)\b"}[source.dialect]
    at = source.pick(i for i in range(len(source.lines)) if re.search(number, source.code(i)) and not re.search(r"JMP|JME|SBS|SBN|\.\d", source.code(i).replace("CNST.", "")))
    code = source.code(at)
    if source.dialect == "nct":  # in a rung of several lines as long as before, or these had to be laid out anew
        def other(m):
            return f"#${int(m[1]):X}"

        alone = source.lines[at].startswith("const") or any(end - begin == 2 and begin == at - 1 for begin, end in ladder_rungs(source))
        new = re.sub(number, other, code)
        if new == code or (not alone and len(new) != len(code)):
            raise Unsuitable
    elif source.dialect in ("gsk", "fanuc"):
        new = re.sub(r"(\d+)\s*$", r"0\1", code)
    else:
        new = re.sub(number, lambda m: f"{m[1]}0{int(m[2]):X}h", code)
    source.lines[at] = new + source.lines[at][len(code):]
    return source.edit()


def label(source):
    """A label or subroutine by another name."""
    if source.dialect == "nct":
        kind = source.rng.choice([("JME", "JMP"), ("SBN", "SBS")])
        own = {m for line in source.lines for m in re.findall(rf"\b{kind[0]} #(\d+)", code_of(line))}
        elsewhere = {m for file, lines in source.files.items() if file != source.file for line in lines for m in re.findall(r"\b(?:JME|JMP|SBN|SBS) #(\d+)", code_of(line))}
        used = own | elsewhere | {m for line in source.lines for m in re.findall(r"\b(?:JME|JMP|SBN|SBS) #(\d+)", code_of(line))}
        old = source.pick(sorted(own - elsewhere))
        new = source.pick(str(n).rjust(len(old), "9") for n in range(1, 99) if len(str(n)) == len(old) and str(n) not in used)
        pattern = rf"\b({kind[0]}|{kind[1]}) #{old}\b"
        source.lines = [re.sub(pattern, rf"\1 #{new}", code_of(line)) + line[len(code_of(line)):] for line in source.lines]
    elif source.dialect == "gsk":
        old = source.pick(sorted({m for line in source.lines for m in re.findall(r"^\s*PRM\s+([LP]\d+)\s*$", code_of(line))}))
        used = {m for line in source.lines for m in re.findall(r"\b[LP]\d+\b", code_of(line))}
        new = next(f"{old[0]}{n}" for n in range(900, 0, -1) if f"{old[0]}{n}" not in used)
        source.replace_word(old, new)
    elif source.dialect == "fanuc":
        raise Unsuitable  # subprograms have names here, whose numbers are those of symbols
    else:
        old = source.pick(sorted({m for line in source.lines for m in re.findall(r"^(\w+):\s*(?:$|LDR|LOD|EX|FL)", code_of(line))}))
        source.replace_word(old, "LABEL_" + old[:20])
    return source.edit()


SYMBOL = {"nct": r"symbol\s+(\w+)\s", "gsk": r"symbol\s+(\w+)\s", "fanuc": r"(\w+),[XYRDKFG]\d+"}


def renamed(source):
    """A name of an address or a variable; the rungs are the same."""
    if source.dialect == "technol":
        bits = {name for _, names in flags(source) for name in names if name}
        old = source.pick(sorted(bits | {m[1] for line in source.lines if (m := re.match(r"(\w+):\s+(?:DS|DFM)\s", code_of(line)))}))
    else:
        old = source.pick(m[1] for line in source.lines if (m := re.match(SYMBOL[source.dialect], line)) and source.occurs(m[1]) and not source.is_in_message(m[1]))
    drawn = any("|" in source.files[file][i] for file, i in source.occurs(old))
    new = ("Z" + old[1:]) if drawn else old + "X"
    if source.occurs(new):
        raise Unsuitable
    source.replace_word(old, new)
    other = {}
    for name in source.files:
        if name != source.file:
            source.lines, kept = list(source.files[name]), source.lines
            source.replace_word(old, new)
            other[name], source.lines = source.lines, kept
    edit = source.edit(names=[old, new])
    edit.more = other
    return edit


def variable(source):
    """A new variable in front of all others moves them."""
    if source.dialect != "technol":
        raise Unsuitable
    at = source.pick(i for i, line in enumerate(source.lines) if re.match(r"\s*DATA\s*$", code_of(line)))
    source.lines.insert(at + 1, f"NEW_VARIABLE: DS {source.rng.randint(1, 40)}")
    return source.edit(names=["NEW_VARIABLE"])


def flags(source):
    """Lines that declare the bits of a byte, with its label and their names."""
    for i in range(len(source.lines)):
        found = re.match(r"(?:(\w+):)?\s+DFM\s+([\w,]+)\s*$", source.code(i))
        if found:
            yield (i, found[1]), found[2].split(",")


def swapped_bits(source, is_terminal):
    if source.dialect != "technol":
        raise Unsuitable
    moves = "\n".join(source.code(i) for i in range(len(source.lines)))
    (at, _), names = source.pick((place, names) for place, names in flags(source) if is_terminal(place[1], moves) and len(set(names) - {""}) > 1)
    code = "\n".join(code_of(line) for lines in source.files.values() for line in lines)
    if any(name and re.search(rf"\.{name}\b", code) for name in names):
        raise Unsuitable  # BYTE.NAME: it is the number of a bit in another byte, too
    one, other = source.rng.sample([i for i, name in enumerate(names) if name], 2)
    changed = list(names)
    changed[one], changed[other] = names[other], names[one]
    source.lines[at] = source.lines[at].replace(",".join(names), ",".join(changed))
    return [names[one], names[other]]


def place_in_byte(source):
    """Two bits of a byte that nothing uses as a whole change places."""
    swapped_bits(source, lambda label, _: label is None)
    return source.edit()


# ---- edits that change a rung --------------------------------------------------------------------------------------


def negated(source):
    if source.is_ladder:
        begin, end = source.pick(r for r in ladder_rungs(source) if r[1] - r[0] == 2 and re.search(r"\[\w", source.lines[r[0] + 1]))
        contacts = [m.start() for m in re.finditer(r"\[(?=\w)", source.lines[begin + 1])]
        at = source.rng.choice(contacts) + 1
        source.lines[begin + 1] = source.lines[begin + 1][:at] + "/" + source.lines[begin + 1][at:]
        return source.edit(rungs=[("changed", begin, begin)])
    plain = PLAIN.get(source.dialect, {})
    contact = rf"(\s*)({'|'.join(map(re.escape, plain))})(?=\s+\S)" if plain else r"(\s*)(LDR|LA|LO)(\s+)(\w+)\s*$"
    at = source.pick(i for i in range(len(source.lines)) if re.match(contact, source.code(i)))
    code = source.code(at)
    if plain:
        new = re.sub("^" + contact, lambda m: m[1] + plain[m[2]], code)
    else:
        new = re.sub(contact, r"\1\2\3-\4", code)
    source.lines[at] = new + source.lines[at][len(code):]
    return source.edit(rungs=[("changed", at, at)])


def operand(source):
    """Another bit in a contact."""
    contact = CONTACT.get(source.dialect)
    if source.is_ladder:
        begin, end = source.pick(r for r in ladder_rungs(source) if r[1] - r[0] == 2 and re.search(r"\[\w+\]", source.lines[r[0] + 1]))
        at = begin + 1
        contact = r"\[(\w+)\]"
    else:
        at = source.pick(i for i in range(len(source.lines)) if re.match(contact, source.code(i)))
    code = source.code(at)
    found = re.search(contact, code) if source.is_ladder else re.match(contact, code)
    others = {m for i in range(len(source.lines)) for m in (re.findall(contact, source.code(i)) if source.is_ladder else re.findall("^" + contact, source.code(i)))}
    other = source.pick(sorted(others - {found[1]}))
    source.lines[at] = code[: found.start(1)] + other + code[found.end(1):] + source.lines[at][len(code):]
    if source.is_ladder:
        at = begin
    return source.edit(rungs=[("changed", at, at)])


def new_rung(source):
    """A contact and a coil that occur elsewhere, so that no name is new."""
    coil = re.compile(COIL["nct" if source.is_ladder else source.dialect])
    a = bits(source)
    b = source.pick(sorted({m[1] for i in range(len(source.lines)) if (m := coil.search(source.code(i)))}))
    if source.is_ladder:
        return ["rung", f"|--[{a}]--[/{b}]--(9870.05)", ""]
    return [f"        {word}{bit}" for word, bit in zip(WORDS[source.dialect], (a, b, b))]


def inserted(source):
    at = source.pick(begin for begin, _ in rungs(source))
    source.lines[at:at] = new_rung(source)
    return source.edit(rungs=[("added", None, at)])


def bits(source):
    """A contact that occurs elsewhere."""
    contact = re.compile(FIRST["nct" if source.is_ladder else source.dialect])
    return source.pick(sorted({m[1] for i in range(len(source.lines)) if (m := contact.match(source.code(i)))}))


def jumped_over(source):
    """A jump and its label around rungs that stay as they are."""
    if source.is_ladder and source.dialect == "gsk":
        raise Unsuitable
    found = rungs(source)
    first = source.pick(range(len(found) - 1))
    begin, end = found[first][0], found[min(first + source.rng.randint(1, 12), len(found) - 1)][0]
    if begin == end:
        raise Unsuitable
    bit = bits(source)
    if source.dialect == "nct":
        jump, label = ["rung", f"|--[{bit}]--{{JMP #97}}", ""], ["rung", "|--{JME #97}", ""]
    elif source.dialect == "gsk":
        jump, label = [f"LD {bit}", "FUNC JMPB", "PRM L990"], ["FUNC LBL", "PRM L990"]
    elif source.dialect == "fanuc":
        jump, label = [f"RD {bit}", "JMPB L990"], ["LBL L990"]
    else:
        jump, label = [f"        LDR {bit}", "        JL1 A_NEW_LABEL"], ["A_NEW_LABEL:"]
    source.lines[end:end] = label
    source.lines[begin:begin] = jump
    new = [("added", None, begin)]
    return source.edit(rungs=new if source.dialect == "technol" else new + [("added", None, end + len(jump))])


def wait(source):
    """A mechanism waits once more."""
    if source.dialect != "technol":
        raise Unsuitable
    mechanism, places = False, []
    code = [i for i in range(len(source.lines)) if source.code(i).strip()]
    for i, following in zip(code, code[1:]):
        word = source.code(i).split()[0]
        mechanism = word == "MECH_BEGIN" or (mechanism and word != "MECH_END")
        if mechanism and word in ("EX", "EX0", "EX1", "TIM"):
            places.append(following)
    at = source.pick(places)
    if source.code(at).strip().endswith(":"):
        raise Unsuitable  # before or after the label is not the same
    new = [f"        LDR  {bits(source)}", "        EX1"]
    below = [source.code(i).split() for i in code if i >= at][:2]
    if below == [line.split() for line in new]:
        raise Unsuitable  # which of two that are alike is new cannot be told
    source.lines[at:at] = new
    return source.edit(rungs=[("added", None, at)])


def removed(source):
    texts = {r: "\n".join(source.lines[r[0]:r[1]]) for r in rungs(source)}
    # With the only call the subprogram is gone as well: what nothing calls is not in the program.
    begin, end = source.pick(r for r, text in texts.items() if is_plain(text) and not re.search(r"\bCALLU?\b", text))
    del source.lines[begin:end]
    return source.edit(rungs=[("removed", begin, None)])


def moved(source):
    found = rungs(source)
    texts = ["\n".join(source.code(i).strip() for i in range(*r) if not source.code(i).startswith("rung")) for r in found]
    alone = [i for i, r in enumerate(found) if texts.count(texts[i]) == 1 and is_plain(texts[i]) and "SBS" not in texts[i] and "JMP" not in texts[i]]
    which = source.pick(alone)
    target = source.pick(i for i in range(len(found)) if abs(i - which) > 3)
    begin, end = found[which]
    block, to = source.lines[begin:end], found[target][0]
    if to > begin:
        source.lines[to:to] = block + [""]
        del source.lines[begin:end]
        to -= end - begin
    else:
        del source.lines[begin:end]
        source.lines[to:to] = block + [""]
    return source.edit(rungs=[("moved", begin, to)])


def jump(source):
    """Another target."""
    if source.dialect == "fanuc":
        raise Unsuitable  # each subprogram is called once, and what nothing calls is not in the program
    pattern = {"nct": r"\b(JMP|SBS) #(\d+)", "gsk": r"\bPRM\s+(P)(\d+)\s*$", "technol": r"\b(JL0|JL1|JUM)\s+(\w+)"}[source.dialect]
    at = source.pick(i for i in range(len(source.lines)) if re.search(pattern, source.code(i)) and not (source.dialect == "gsk" and re.search(r"FUNC\s+SP\b", source.lines[i - 1])))
    code = source.code(at)
    found = re.search(pattern, code)
    if source.dialect == "gsk" and len(source.occurs("P" + found[2])) < 3:
        raise Unsuitable  # what nothing calls is not in the program
    others = {m[2] for i in range(len(source.lines)) if (m := re.search(pattern, source.code(i))) and m[1] == found[1] and len(m[2]) == len(found[2])} if source.dialect != "technol" else {
        m[1] for line in source.lines if (m := re.match(r"(\w+):\s*$", code_of(line)))}
    other = source.pick(sorted(others - {found[2]}))
    source.lines[at] = code[: found.start(2)] + other + code[found.end(2):] + source.lines[at][len(code):]
    return source.edit(rungs=[("changed", at, at)])


def terminal(source):
    """Two bits of a byte that goes to terminals or comes from there change places."""
    return source.edit(names=swapped_bits(source, lambda label, moves: label and re.search(rf"\bMOVE\s+({label},P\dIN|P\dOUT,{label})\b", moves)))


def constant(source):
    """The value of a constant: its name, and the rungs that use it."""
    pattern = {"nct": r"(const\s+)(\w+)(\s+#)(\d+)(?![\d.])", "technol": r"(\s*EQUI\s+)(\w+)(\s*,\s*)(\d+)(?!\w)"}.get(source.dialect)
    if pattern is None:
        raise Unsuitable
    at = source.pick(i for i in range(len(source.lines)) if re.match(pattern, source.code(i)))
    found = re.match(pattern, source.lines[at])
    name, value = found[2], found[4]
    uses = [(file, i) for file, i in source.occurs(name) if (file, i) != (source.file, at)]
    if any(re.search(r"\bDS\b|\bEQUI\b|\bconst\b|IF\b|struc", source.files[file][i]) for file, i in uses):
        raise Unsuitable
    source.lines[at] = source.lines[at][: found.start(4)] + str(int(value) + 1).rjust(len(value), "0") + source.lines[at][found.end(4):]
    return source.edit(names=[name], rungs=[("uses", (file, i), (file, i)) for file, i in uses])


def address(source):
    """The address of a name: that, and the rungs that use it."""
    pattern = {"nct": r"(symbol\s+)(\w+)(\s+)(\d{4}\.\d\d)(?!\S)", "gsk": r"(symbol\s+)(\w+)(\s+)([RD]\d+\.\d)(?!\S)",
               "fanuc": r"()(\w+)(,)([RD]\d+\.\d)(?=,)"}.get(source.dialect)
    if pattern is None:
        raise Unsuitable
    at = source.pick(i for i in range(len(source.lines)) if re.match(pattern, source.lines[i]))
    found = re.match(pattern, source.lines[at])
    everything = "\n".join("\n".join(lines) for lines in source.files.values())
    if everything.count(found[4]) != 1:
        raise Unsuitable
    new = "9876.31" if source.dialect == "nct" else "R998.7"
    source.lines[at] = source.lines[at][: found.start(4)] + new + source.lines[at][found.end(4):]
    uses = [(file, i) for file, i in source.occurs(found[2]) if (file, i) != (source.file, at)]
    return source.edit(names=[found[2]], rungs=[("uses", use, use) for use in uses])


def message(source):
    pattern = {"nct": r'((message|button)\s+(\d+)\s+")([^"{]+)(")', "gsk": r"((\d+)()\s+\")([^\"]+)(\")", "fanuc": r"(A\d+\.\d()()\s+\d+\s+)(.+?)()$"}.get(source.dialect)
    if source.dialect == "gsk":
        if not (source.folder / "mill.msg").exists():
            raise Unsuitable
        source.file, source.lines = "mill.msg", (source.folder / "mill.msg").read_text().splitlines()
    if pattern is None:
        raise Unsuitable
    at = source.pick(i for i in range(len(source.lines)) if re.match(pattern, source.lines[i]))
    found = re.match(pattern, source.lines[at])
    source.lines[at] = found[1] + "another text" + found[5] + source.lines[at][found.end():]
    name = found[3] if found[2] == "message" else f"button {found[3]}" if found[2] == "button" else ""
    return source.edit(messages=[name])


def content(source):
    """What a text holds at the start."""
    if source.dialect != "technol":
        raise Unsuitable
    at = source.pick(i for i in range(len(source.lines)) if re.match(r"\w+:\s+STR\s+\d+\s*,\s*'[^']+'", source.lines[i]))
    name = source.lines[at].split(":")[0]
    source.lines[at] = re.sub(r"'([^'])", lambda m: "'" + ("Q" if m[1] != "Q" else "R"), source.lines[at], count=1)
    return source.edit(contents=[name.upper()])


def configuration(source):
    key = {"nct": ("period_us", 40000), "gsk": ("tmr.7", 480), "fanuc": ("tmr.7", 480), "technol": ("period_us", 10000)}[source.dialect]
    text = (source.folder / "rung.toml").read_text()
    if key[0] in text:
        raise Unsuitable
    line = f'"{key[0]}" = {key[1]}'
    source.file = "rung.toml"
    source.lines = (text.replace("[config]", "[config]\n" + line) if "[config]" in text else text + "\n[config]\n" + line).splitlines()
    return source.edit(configuration=[key[0]])


NOTHING = [remark, remark_behind, blank_lines, spaces, title, spelling, label, renamed, variable, place_in_byte]
SOMETHING = [negated, operand, inserted, jumped_over, wait, removed, moved, jump, terminal, constant, address, message, content, configuration]


# ---- what is found, against what has to be -------------------------------------------------------------------------


def covers(rung, file, line):
    first = rung["line"] - 1
    return Path(rung["file"]).name == file and first <= line < first + max(1, rung["text"].count("\n") + 1)


def wrong_rungs(edit, found):
    """"" or what is wrong with the rungs."""
    left = list(found)
    for kind, before, after in edit.rungs:
        if kind == "uses":  # one rung may have several
            continue
        fitting = [change for change in left if fits(change, kind, edit.file, before, after)]
        if len(fitting) != 1:
            return f"{len(fitting)} rungs are {kind} there"
        left.remove(fitting[0])
    uses = [before for kind, before, _ in edit.rungs if kind == "uses"]
    for file, line in uses:
        if not any(change["before"] and covers(change["before"], file, line) for change in found):
            return f"nothing in line {line + 1} of {file}"
    for change in left:
        if not uses or change["change"] != "changed" or not any(covers(change["before"], *use) for use in uses):
            return f"too much: {change}"
    return ""


def fits(change, kind, file, before, after):
    if change["change"] != kind:
        return False
    if before is not None and not covers(change["before"], file, before):
        return False
    return after is None or covers(change["after"], file, after)


def wrong_names(expected, found):
    names = [change["name"].split(":")[-1] for change in found]  # without the file of a local one
    for name in expected:
        if not any(found_name.startswith(name) for found_name in names):
            return f"{name} is not reported, but {names}"
    for found_name in names:
        if not any(found_name.startswith(name) for name in expected):
            return f"{found_name} is reported"
    return ""


class Truth(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def diff(self, old, new):
        done = subprocess.run([RUNGC, "diff", old, new, "--format", "json"], capture_output=True, text=True, timeout=patience(300), check=False)
        return done.returncode, json.loads(done.stdout) if done.stdout else None, done.stderr

    def one(self, example, dialect, make, rng):
        """False: the edit does not suit the place."""
        old, new = self.folder / "old", self.folder / "new"
        if not old.exists():
            shutil.copytree(Path("examples") / example, old, ignore=shutil.ignore_patterns("linuxcnc", "*.scn"))
        shutil.rmtree(new, ignore_errors=True)
        shutil.copytree(old, new)
        toml = (old / "rung.toml").read_text()
        if "scenarios" in toml:
            for folder in (old, new):
                (folder / "rung.toml").write_text(re.sub(r"(?m)^scenarios.*$", "", toml))
        try:
            edit = make(Source(old, dialect, rng))
        except Unsuitable:
            return False
        for name, lines in {edit.file: edit.lines, **edit.more}.items():
            (new / name).write_text("\n".join(lines) + "\n")
        status, found, said = self.diff(old, new)
        if found is None:
            self.assertEqual(status, 1, said)
            return False
        what = f"{make.__name__} in {example}/{edit.file}:\n{self.text_diff(old / edit.file, new / edit.file)}\n{json.dumps(found, indent=1)[:3000]}"
        wrong = wrong_rungs(edit, found["rungs"])
        for kind, expected in edit.other.items():
            wrong = wrong or wrong_names(expected, found[kind])
        self.assertEqual(wrong, "", what)
        self.assertEqual(status, 1 if edit.rungs or any(edit.other.values()) else 0, what)
        return True

    @staticmethod
    def text_diff(old, new):
        return subprocess.run(["diff", "-U1", old, new], capture_output=True, text=True, check=False).stdout[:2000]

    def edits(self, dialect, example, seed):
        rng = random.Random(f"{dialect} {example} {seed}")
        shutil.rmtree(self.folder / "old", ignore_errors=True)
        done, suitable = {}, list(NOTHING + SOMETHING)
        while sum(done.values()) < EDITS:
            self.assertGreater(len(suitable), 8, f"few edits suit this program: {suitable}")
            for make in list(suitable):
                if any(self.one(example, dialect, make, rng) for _ in range(TRIES)):
                    done[make.__name__] = done.get(make.__name__, 0) + 1
                else:
                    suitable.remove(make)
                if sum(done.values()) == EDITS:
                    break
        print(f"{dialect} {example} {seed}: {done}", flush=True)

    def test_edits(self):
        for dialect, examples in (ALL if LARGE else SMALL).items():
            for example in examples:
                for seed in range(SEED, SEED + (ROUNDS if LARGE else 1)):
                    with self.subTest(dialect=dialect, example=example, seed=seed):
                        self.edits(dialect, example, seed)


if __name__ == "__main__":
    go_to_root()
    RUNGC = str(Path(sys.argv.pop(1)).absolute())
    if len(sys.argv) > 1 and sys.argv[1].isdigit():
        SEED = int(sys.argv.pop(1))
    unittest.main()
