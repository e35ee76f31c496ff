"""Writes a ladder as straight-line C++: a network is a few statements, a function is inline code.

A bit that only contacts and coils use is a byte of 0 or 1; bytes that functions use are in memory as the control has
them. A scan is level 1 and the whole of level 2. Requests to the CNC stay unanswered.

The shared object exports
  void scan()                  one scan, 8 ms after the one before
  const Place places[]         the bytes that the ladder names (place.h); area 0 behind the last one
  bool* bits()                 the bits that are held as bytes
  uint8_t* area(char letter)   the bytes that are held as the control has them
"""
from ladder import FUNCTIONS, NO_OUTPUT, NUMBERS, RELATIONS

SIZES = {"B": 1, "W": 2, "D": 4}
ACCURACY_MS = (8, 48, 1000, 10_000, 60_000, 1, 10, 100)  # of TMRC
OPERATORS = {"EQ": "==", "NE": "!=", "GT": ">", "LT": "<", "GE": ">=", "LE": "<=", "EOR": "^", "AND": "&", "OR": "|"}
AREA_BYTES = {"X": 1128, "Y": 1128, "F": 9768, "G": 9768, "R": 9500, "E": 10_000, "A": 9250, "T": 9500, "C": 5200, "K": 1000, "D": 10_000, "Z": 500}



def length(form):
    """Bytes of an element, and the number of elements."""
    digits = form % 1000
    return digits % 10, max(1, digits // 10)


class Writer:
    def __init__(self, ladder):
        self.ladder = ladder
        self.parts = [*ladder.levels.values(), *ladder.subprograms.values()]
        self.real = set()  # bytes that functions use
        self.whole = {}  # areas with tables, from which byte on
        self.counts = dict.fromkeys(("timer", "counter", "w", "request", "axis"), 0)
        self.edges = {}
        self.bits = {}
        self.undefined = set()  # bytes for the control's own use
        for part in self.parts:
            for statement in part:
                if statement.is_function:
                    self.use(statement)
        self.used("R", 9000, 10)
        self.used("R", 9091, 1)
        self.used("R", 9015, 1)

    def used(self, area, byte, size):
        self.real.update((area, at) for at in range(byte, byte + size))

    def use(self, f):
        sizes = {}
        name, args = f.word, f.operands
        if name in ("TMR",):
            self.used("T", 2 * args[0] - 2, 2)
            self.used("T", 9000 + 2 * args[0] - 2, 2)
        elif name == "CTR":
            self.used("C", 4 * args[0] - 4, 4)
        elif name == "CTRB":
            self.used("C", 5000 + 2 * args[0] - 2, 2)
        elif name == "MOVN":
            sizes = {1: args[0], 2: args[0]}
        elif name == "XMOVB":
            size, elements = length(args[0])
            sizes = {1: size, 3: size * elements, 4: size}
            self.whole[args[2][0]] = min(args[2][1], self.whole.get(args[2][0], args[2][1]))
        elif name == "DECB":
            size, elements = length(args[0])
            sizes = {1: size, 3: elements}
        elif name == "NUMEB":
            size, elements = length(args[0])
            sizes = {2: size * elements}
        elif name in ("WINDR", "WINDW", "EXIN"):
            sizes = {0: 74}
        elif name == "AXCTL":
            sizes = {1: 8}
            path, group = args[0] // 1000, args[0] % 1000 - 1
            self.used("G", 1000 * path + 142 + 12 * group, 8)
            self.used("F", 1000 * path + 130 + 3 * group, 1)
        elif name in ("TMRC",):
            sizes = {1: 2}
            self.undefined.update((args[2][0], args[2][1] + i) for i in range(4))
        elif name == "CTRC":
            sizes = {0: 2, 1: 4}
            self.undefined.update((args[1][0], args[1][1] + i) for i in (2, 3))
        elif name == "CODB":
            sizes = {2: 1, 3: args[0] % 10}
        elif name in ("MOVE", "MOVOR", "MOVB"):
            sizes = dict.fromkeys(range(len(args)), 1)
        elif name in ("MOVW", "MOVD"):
            sizes = dict.fromkeys(range(2), SIZES[name[-1]])
        elif name[:2] in RELATIONS or name[:3] == "RNG":
            sizes = dict.fromkeys(range(len(args)), SIZES[name[-1]])
        elif name in ("COMPB", "ADDB", "SUBB", "MULB", "DIVB", "EOR", "AND", "OR", "NOT", "DCNVB"):
            sizes = dict.fromkeys(range(1, len(args)), length(args[0])[0])
        for index, size in sizes.items():
            if isinstance(args[index], tuple) and args[index][0] != "P":
                self.used(*args[index][:2], size)

    # Places

    def in_memory(self, area, byte):
        return (area, byte) in self.real or byte >= self.whole.get(area, 1 << 30)

    def place(self, operand):
        return f"{operand[0]}[{operand[1]}]"

    def bit(self, operand):
        """Of a bit held as a byte: its number."""
        return self.bits.setdefault(operand, len(self.bits))

    def contact(self, operand):
        area, byte, bit = operand
        return f"at({area}[{byte}], {bit})" if self.in_memory(area, byte) else f"B[{self.bit(operand)}]"

    def coil(self, word, operand, value):
        area, byte, bit = operand
        if not self.in_memory(area, byte):
            bit = f"B[{self.bit(operand)}]"
            return {"WRT": f"{bit} = {value};", "WRT.NOT": f"{bit} = !{value};", "SET": f"{bit} = {bit} | {value};",
                    "RST": f"{bit} = {bit} & !{value};"}[word]
        place = f"{area}[{byte}]"
        return {"WRT": f"to({place}, {bit}, {value});", "WRT.NOT": f"to({place}, {bit}, !{value});",
                "SET": f"{place} |= {value} << {bit};", "RST": f"{place} &= ~({value} << {bit});"}[word]

    def number(self, kind):
        self.counts[kind] += 1
        return f"{kind}s[{self.counts[kind] - 1}]"

    def value(self, operand, size):
        return f"load<{size}>(&{self.place(operand)})" if isinstance(operand, tuple) else str(self.fit(operand, size))

    @staticmethod
    def fit(number, size):
        kept = number % (1 << 8 * size)
        return kept - (1 << 8 * size) if kept >> (8 * size - 1) else kept

    # Functions: statements that set `w` where they have an output; conditions are c[0], c[1]…, the last is ACT

    def function(self, f, c):
        name, args, act = f.word, f.operands, c[-1] if c else "true"
        if name in ("MOVB", "MOVW", "MOVD"):
            size = SIZES[name[-1]]
            return f"if ({act}) store<{size}>(&{self.place(args[1])}, {self.value(args[0], size)});"
        if name == "MOVN":
            return f"if ({act}) std::memmove(&{self.place(args[2])}, &{self.place(args[1])}, {args[0]});"
        if name == "MOVE":
            mask = int(str(args[0]), 2) << 4 | int(str(args[1]), 2)
            return f"if ({act}) {self.place(args[3])} = {self.place(args[2])} & {mask};"
        if name == "MOVOR":
            return f"if ({act}) {self.place(args[2])} = {self.place(args[0])} | {self.place(args[1])};"
        if name == "NUMEB":
            size, elements = length(args[0])
            stores = " ".join(f"store<{size}>(&{args[2][0]}[{args[2][1] + size * i}], {self.fit(args[1], size)});" for i in range(elements))
            return f"if ({act}) {{ {stores} }}"
        if name == "COMPB":
            size = length(args[0])[0]
            return (f"if ({act}) {{ const int64_t a = {self.value(args[1], size)}, b = {self.value(args[2], size)}; "
                    f"R[9000] = (R[9000] & ~0x23) | (a == b) | (a < b) << 1 | (a - b != static_cast<Of<{size}>::S>(a - b)) << 5; }}")
        if name[:2] in RELATIONS and len(name) == 3 and name[-1] in SIZES:
            size = SIZES[name[-1]]
            return f"w = {act} && {self.value(args[0], size)} {OPERATORS[name[:2]]} {self.value(args[1], size)};"
        if name[:3] == "RNG":
            low, high, value = (self.value(each, SIZES[name[-1]]) for each in args)
            return f"{{ const int64_t a = {low}, b = {high}, x = {value}; w = {act} && (a < b ? a <= x && x <= b : b <= x && x <= a); }}"
        if name in ("EOR", "AND", "OR"):
            size = length(args[0])[0]
            return f"if ({act}) store<{size}>(&{self.place(args[3])}, {self.value(args[1], size)} {OPERATORS[name]} {self.value(args[2], size)});"
        if name == "NOT":
            size = length(args[0])[0]
            return f"if ({act}) store<{size}>(&{self.place(args[2])}, ~{self.value(args[1], size)});"
        if name in ("ADDB", "SUBB", "MULB", "DIVB"):
            return self.arithmetic(name, args, c)
        if name == "DECB":
            size, elements = length(args[0])
            code, first = f"loadU<{size}>(&{self.place(args[1])})", args[2] % (1 << 8 * size)
            bytes_ = "".join(f"{args[3][0]}[{args[3][1] + i}] = {act} && i - {8 * i}u < 8 ? 1 << (i - {8 * i}u) : 0; " for i in range(elements))
            return f"{{ const uint32_t i = ({code} - {first}u) & {(1 << 8 * size) - 1}u; {bytes_}}}"
        if name == "CODB":
            size, rows = args[0] % 10, args[4:]
            w = self.number("w")
            table = ", ".join(str(self.fit(row, size)) for row in rows)
            return (f"{{ static const int32_t table[] = {{{table}}}; const unsigned i = {self.place(args[2])}; if ({c[0]}) {w} = 0; else if ({act}) {{ "
                    f"{w} = i >= {len(rows)}; if (i < {len(rows)}) store<{size}>(&{self.place(args[3])}, table[i]); }} w = {w}; }}")
        if name == "XMOVB":
            size, elements = length(args[0])
            w, table = self.number("w"), f"&{args[2][0]}[{args[2][1]} + {size} * i]"
            data, bytes_ = f"&{self.place(args[3])}", size * elements
            return (f"{{ const uint32_t i = loadU<{size}>(&{self.place(args[4])}); if ({c[1]}) {w} = 0; else if ({act}) {{ {w} = i >= loadU<{size}>(&{self.place(args[1])}); "
                    f"if (!{w}) {{ if ({c[0]}) std::memmove({table}, {data}, {bytes_}); else std::memmove({data}, {table}, {bytes_}); }} }} w = {w}; }}")
        if name == "DCNVB":
            size, w = args[0] % 10, self.number("w")
            return (f"if ({c[2]}) {w} = 0; else if ({act}) {w} = {c[1]} ? fromDecimal(&{self.place(args[2])}, {size}, loadU<{size}>(&{self.place(args[1])}), {c[0]}) "
                    f": toDecimal(&{self.place(args[2])}, {size}, {self.value(args[1], size)}, R[9000]); w = {w};")
        if name in ("DIFU", "DIFD"):
            edge = self.edges.setdefault(args[0], len(self.edges)) if args[0] else None
            place = self.number("w") if edge is None else f"edges[{edge}]"
            return f"{{ const bool now = {act}; w = {'now & !' + place if name == 'DIFU' else '!now & ' + place}; {place} = now; }}"
        if name in ("TMR", "TMRB", "TMRC", "TMRBF"):
            return self.timer(name, args, act)
        if name in ("CTR", "CTRB", "CTRC"):
            place = {"CTR": lambda: f"C + {4 * args[0] - 2}", "CTRB": lambda: f"C + {5000 + 2 * args[0] - 2}", "CTRC": lambda: f"&{self.place(args[1])}"}[name]()
            preset = {"CTR": lambda: f"loadU<2>(C + {4 * args[0] - 4})", "CTRB": lambda: str(args[1]), "CTRC": lambda: f"loadU<2>(&{self.place(args[0])})"}[name]()
            return f"w = count({self.number('counter')}, {c[0]}, {c[1]}, {c[2]}, {c[3]}, {preset}, {place});"
        if name == "EXIN":
            return f"w = {act}; R[9000] = (R[9000] & ~1) | w;"
        if name in ("WINDR", "WINDW"):
            return f"w = window({self.number('request')}, {act}, &{self.place(args[0])}, {'true' if name == 'WINDW' else 'false'}, R[9000]);"
        if name == "AXCTL":
            path, group = args[0] // 1000, args[0] % 1000 - 1
            return f"w = axis({self.number('axis')}, {c[0]}, {act}, &{self.place(args[1])}, G + {1000 * path + 142 + 12 * group}, F + {1000 * path + 130 + 3 * group}, R[9000]);"
        if name == "DISPB":
            return ""
        if name in ("CALL", "CALLU"):
            return f"if ({act}) P{args[0][1]}();"
        raise ValueError(name)

    def arithmetic(self, name, args, c):
        size, w = length(args[0])[0], self.number("w")
        a, b = self.value(args[1], size), self.value(args[2], size)
        out = f"&{self.place(args[3])}"
        if name == "DIVB":
            work = (f"const int64_t a = {a}, b = {b}; if (b == 0) {w} = 1; else {{ const int64_t q = a / b, rest = a % b; flags<{size}>(R[9000], q); "
                    f"{w} = at(R[9000], 5); store<{size}>({out}, q); store<{size}>(R + 9002, rest); }}")
        else:
            work = f"const int64_t x = {a} {'+-*'[('ADDB', 'SUBB', 'MULB').index(name)]} {b}; flags<{size}>(R[9000], x); {w} = at(R[9000], 5); store<{size}>({out}, x);"
        return f"if ({c[0]}) {w} = 0; else if ({c[1]}) {{ {work} }} w = {w};"

    def timer(self, name, args, act):
        timer = self.number("timer")
        if name == "TMRBF":
            return f"w = offDelay({timer}, {act}, {args[1]});"
        if name == "TMRB":
            return f"w = onDelay({timer}, {act}, {args[1]});"
        if name == "TMRC":
            return f"w = onDelay({timer}, {act}, {ACCURACY_MS[args[0]]} * loadU<2>(&{self.place(args[1])}));"
        n = args[0]
        unit = f"unitMs(loadU<2>(T + {9000 + 2 * n - 2}), {48 if n <= 8 else 8})"
        return f"w = onDelay({timer}, {act}, {unit} * loadU<2>(T + {2 * n - 2}));"

    # Networks

    def part(self, statements):
        stack, known, jumps, text = [], [], 0, []
        for s in statements:
            if not s.is_function:
                self.basic(s, stack, text, known)
            elif s.word == "JMP":
                jumps += 1
                text.append(f"if (!({stack.pop()})) {{")
            elif s.word == "JMPE":
                text.append("}")
            else:
                names, conditions = [], FUNCTIONS[NUMBERS[s.word]][1]
                for condition in stack[len(stack) - conditions:]:
                    names.append(f"c{len(known)}")
                    known.append(names[-1])
                    text.append(f"{names[-1]} = {condition};")
                text.append(self.function(s, names) + f" // {s.word}, line {s.line}")
                has_output = s.word not in NO_OUTPUT and s.word != "CALLU"
                if has_output:
                    known.append(f"c{len(known)}")
                    text.append(f"{known[-1]} = w;")
                    stack[:] = [known[-1]]
                else:
                    stack[:] = names[-1:]
        declared = f"bool w = false{''.join(f', {name} = false' for name in known)};"
        return "\n  ".join([declared, "(void)w;", *text])

    def basic(self, s, stack, text, known):
        word = s.word
        if word in ("AND.STK", "OR.STK"):
            right, left = stack.pop(), stack.pop()
            stack.append(f"({left} {'&' if word == 'AND.STK' else '|'} {right})")
            return
        if word in ("WRT", "WRT.NOT", "SET", "RST"):
            if not stack[-1].isalnum():
                text.append(f"v = {stack[-1]};")
                stack[-1] = "v"
            text.append(self.coil(word, s.operands[0], stack[-1]))
            return
        bit = self.contact(s.operands[0])
        if word == "RDNT":
            edge = self.number("w")
            known.append(f"c{len(known)}")
            text.append(f"{known[-1]} = !{bit} & {edge}; {edge} = {bit};")
            bit = known[-1]
        elif word.endswith(".NOT") or ".NOT." in word:
            bit = f"!{bit}"
        if word == "RD" or word == "RD.NOT" or word == "RDNT":
            stack[:] = [bit]
        elif word.startswith("RD"):
            stack.append(bit)
        else:
            stack[-1] = f"({stack[-1]} {'&' if word.startswith('AND') else '|'} {bit})"

    def text(self):
        functions = []
        for name, part in [*((f"P{number}", part) for number, part in self.ladder.subprograms.items()), *self.ladder.levels.items()]:
            body = self.part(part)
            functions.append(f"static __attribute__((noinline)) void {name}() {{\n  bool v = false; (void)v;\n  {body}\n}}\n")
        out = ['#include "functions.h"', '#include "place.h"']
        out += [f"static uint8_t {area}[{size + 32}];" for area, size in AREA_BYTES.items()]
        out.append(f"static bool B[{len(self.bits) + 1}];")
        out += [f"static {kind} {name}s[{self.counts[name] + 1}];" for name, kind in (("timer", "Timer"), ("counter", "Counter"), ("w", "bool"), ("request", "Request"), ("axis", "Axis"))]
        out.append(f"static bool edges[{len(self.edges) + 1}];")
        out += [f"static void P{number}();" for number in self.ladder.subprograms]
        out += functions
        out.append(self.interface())
        return "\n".join(out) + "\n"

    def interface(self):
        levels = "".join(f"  {name}();\n" for name in self.ladder.levels if name != "END1")
        places = {}
        for (area, byte, bit), number in self.bits.items():
            places.setdefault((area, byte), [-1] * 8)[bit] = number
        tables = {(area, byte) for area, first in self.whole.items() for byte in range(first, AREA_BYTES[area])}
        for place in (self.real | tables) - self.undefined:
            places[place] = []
        rows = ",\n".join(f"  {{'{area}', {byte}, {int(not bits)}, {{{', '.join(map(str, bits))}}}}}" for (area, byte), bits in sorted(places.items()))
        areas = "".join(f"  case '{area}': return {area};\n" for area in AREA_BYTES)
        return f"""
#define EXPORT extern "C" __attribute__((visibility("default")))
EXPORT void scan() {{
  static uint8_t first[6], others[6]; // R9000-R9005 of level 1 and of the others
  std::memcpy(others, R + 9000, 6);
  std::memcpy(R + 9000, first, 6);
  END1();
  std::memcpy(first, R + 9000, 6);
  std::memcpy(R + 9000, others, 6);
{levels}}}
EXPORT const Place places[] = {{
{rows},
  {{}}}};
EXPORT bool* bits() {{ return B; }}
EXPORT uint8_t* area(char letter) {{
  switch (letter) {{
{areas}  }}
  return nullptr;
}}
"""


def source(ladder):
    return Writer(ladder).text()
