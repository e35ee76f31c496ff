"""Reads the ladder and the symbols of FANUC's mnemonic files.

Written from the description of the format alone, and not from the compiler's reader, which is compared with it.
"""
import re
from dataclasses import dataclass, field

# Functions by number: name, conditions, parameters. CODB has the rows of its table besides.
FUNCTIONS = {
    1: ("END1", 0, 0), 2: ("END2", 0, 0), 48: ("END3", 0, 0), 64: ("END", 0, 0),
    3: ("TMR", 1, 1), 24: ("TMRB", 1, 2), 54: ("TMRC", 1, 3), 77: ("TMRBF", 1, 2),
    5: ("CTR", 4, 1), 55: ("CTRC", 4, 2), 56: ("CTRB", 4, 2),
    25: ("DECB", 1, 4), 27: ("CODB", 2, 4), 31: ("DCNVB", 4, 3),
    8: ("MOVE", 1, 4), 28: ("MOVOR", 1, 3), 43: ("MOVB", 1, 2), 44: ("MOVW", 1, 2), 47: ("MOVD", 1, 2), 45: ("MOVN", 1, 3),
    35: ("XMOVB", 3, 5), 32: ("COMPB", 1, 3), 40: ("NUMEB", 1, 3),
    36: ("ADDB", 2, 4), 37: ("SUBB", 2, 4), 38: ("MULB", 2, 4), 39: ("DIVB", 2, 4),
    59: ("EOR", 1, 4), 60: ("AND", 1, 4), 61: ("OR", 1, 4), 62: ("NOT", 1, 3),
    57: ("DIFU", 1, 1), 58: ("DIFD", 1, 1), 41: ("DISPB", 1, 1), 42: ("EXIN", 1, 1), 51: ("WINDR", 1, 1), 52: ("WINDW", 1, 1), 53: ("AXCTL", 2, 2),
    10: ("JMP", 1, 1), 30: ("JMPE", 0, 0), 65: ("CALL", 1, 1), 66: ("CALLU", 0, 1), 71: ("SP", 0, 1), 72: ("SPE", 0, 0),
}
RELATIONS = ("EQ", "NE", "GT", "LT", "GE", "LE")
SIZES = "BWD"
for _i, _relation in enumerate(RELATIONS):
    for _j, _size in enumerate(SIZES):
        FUNCTIONS[200 + 3 * _i + _j] = (_relation + _size, 1, 2)
for _j, _size in enumerate(SIZES):
    FUNCTIONS[218 + _j] = ("RNG" + _size, 1, 3)
NUMBERS = {name: number for number, (name, _, _) in FUNCTIONS.items()}
# Without an output of their own; a coil behind them takes the condition.
NO_OUTPUT = {"DECB", "MOVE", "MOVOR", "MOVB", "MOVW", "MOVD", "MOVN", "COMPB", "NUMEB", "EOR", "AND", "OR", "NOT", "DISPB", "JMP", "CALL"}

CONTACTS = {"RD", "RD.NOT", "RD.STK", "RD.NOT.STK", "RD.STK.NOT", "RDNT", "AND", "AND.NOT", "OR", "OR.NOT"}
COILS = {"WRT", "WRT.NOT", "SET", "RST"}
STACK = {"AND.STK", "OR.STK"}
ADDRESS = re.compile(r"([A-Z])0*(\d+)(?:\.([0-7]))?$")
NUMBER = re.compile(r"-?\d+$")


@dataclass
class Statement:
    word: str  # of a contact or coil; of a function its name
    operands: list
    line: int
    is_function: bool = False


@dataclass
class Ladder:
    levels: dict = field(default_factory=dict)  # by the name of their end
    subprograms: dict = field(default_factory=dict)  # by number


def text_of(path):
    data = path.read_bytes()
    if data.startswith(b"\xff\xfe"):
        return data.decode("utf-16")
    return data.decode("utf-16-le" if data[1:2] == b"\0" else "latin-1")


def sections(text):
    """The sections of a file by their heads."""
    found, head = [], None
    for number, line in enumerate(text.splitlines(), 1):
        if line.startswith("%@"):
            head = line.strip()
            found.append((head, []))
        elif line.startswith("%"):
            head = None
        elif head is not None:
            found[-1][1].append((number, line))
    return found


def symbols(files):
    """Addresses by symbol, in capitals."""
    found = {}
    for head, lines in (section for file in files for section in sections(text_of(file))):
        if not head.startswith("%@2"):
            continue
        columns = {key: int(at) - 1 for key, at in re.findall(r"(SYM|ADR)=(\d+)", head)}
        for _, line in lines:
            if columns:
                cells = [cell.strip() for cell in line.split(",")]
                if len(cells) > max(columns.values()):
                    found[cells[columns["SYM"]].upper()] = cells[columns["ADR"]].upper()
            elif len(words := line.split()) >= 2 and not line.startswith("$"):
                found[words[1].upper()] = words[0].upper()
    return found


class Reader:
    def __init__(self, names):
        self.names = names
        self.ladder = Ladder()
        self.part = []
        self.pending = None  # a function that lacks parameters
        self.missing = 0
        self.in_comment = False

    def operand(self, word):
        """An address as (area, byte, bit or None), or a number."""
        word = word.upper()
        if NUMBER.match(word):
            return int(word)
        if not ADDRESS.match(word):
            word = self.names[word]
        area, byte, bit = ADDRESS.match(word).groups()
        return area, int(byte), None if bit is None else int(bit)

    def without_comments(self, line):
        kept = ""
        while line:
            mark = "*)" if self.in_comment else "(*"
            before, found, line = line.partition(mark)
            kept += "" if self.in_comment else before
            if found:
                self.in_comment = not self.in_comment
        return kept.partition(";")[0]

    def line(self, number, line):
        words = re.sub(r"^\s*N\d+:", "", self.without_comments(line)).split()
        while words:
            words = self.statement(number, words)

    def statement(self, number, words):
        if self.missing:
            return self.parameter(words)
        word, rest = words[0].upper(), words[1:]
        if self.pending is not None and self.pending.word in ("JMPE", "JMP") and NUMBER.match(word):
            return rest
        self.pending = None
        if word in STACK:
            self.part.append(Statement(word, [], number))
            return rest
        if word in COILS or word in CONTACTS and rest:
            self.part.append(Statement({"RD.STK.NOT": "RD.NOT.STK"}.get(word, word), [self.operand(rest[0])], number))
            return rest[1:]
        if rest and rest[0].upper() == "SP":
            words, rest = rest[1:], [words[0], *rest[1:]]
            word = "SP"
        if word == "SUB":
            word, rest = FUNCTIONS[int(rest[0])][0], rest[1:]
        self.pending = Statement(word, [], number, True)
        self.missing = FUNCTIONS[NUMBERS[word]][2]
        if not self.missing:
            self.complete()
        return rest

    def parameter(self, words):
        self.pending.operands.append(self.operand(words[0]))
        self.missing -= 1
        if self.pending.word == "CODB" and len(self.pending.operands) == 4:
            self.missing = self.pending.operands[1]
        if not self.missing:
            self.complete()
        return words[1:]

    def complete(self):
        function = self.pending
        if function.word in ("END1", "END2", "END3"):
            self.ladder.levels[function.word] = self.part
            self.part = []
        elif function.word == "SP":
            self.part = self.ladder.subprograms[function.operands[0][1]] = []
        elif function.word not in ("SPE", "END"):
            self.part.append(function)


def read(files):
    """The ladder of all files of a program."""
    reader = Reader(symbols(files))
    for head, lines in (section for file in files for section in sections(text_of(file))):
        if re.match(r"%@3\b", head):
            for number, line in lines:
                reader.line(number, line)
    return reader.ladder
