#!/usr/bin/env python3
"""Keeps the words of words.txt out of what users read: the docs and the reference, diagnostics, the headers that a program
or a host includes, and every text and comment in the code. words_test.py"""
import bisect
import functools
import re
import sys
import unittest
from pathlib import Path

HERE = Path(__file__).resolve().parent
ROOT = HERE.parents[1]
sys.path.insert(0, str(ROOT / "tools/dev"))
import folders

# Files that are read as they are.
PLACES = ("README.md", "CONTRIBUTING.md", "docs/*.md", "docs/dialects/*.md", "docs/reference/*.md", "examples/**/*.md",
          "ir/support/diag/*.def", "tools/rungc/templates/**/*",
          "rtlib/abi/rung/*", "rtlib/**/*.h", "machine/*/*.h", "tools/*/*.h", "ir/core/*.h")
# Code whose string literals are read, as messages and tables of the reference are made of them, and its comments.
CODE = tuple(f"{folder}/**/*.{kind}" for folder in folders.PRODUCT for kind in ("cpp", "h"))
TOKEN = re.compile(r"""(?P<comment>//[^\n]*|/\*.*?\*/)|(?P<include>^[ ]*\#[ ]*include[^\n]*)
                     |(?P<number>\b[0-9](?:[\w.]|'(?=\w))*|'(?:[^'\\\n]|\\.)+')
                     |R"(?P<mark>[^(\s]*)\((?P<raw>.*?)\)(?P=mark)"|"(?P<text>(?:[^"\\\n]|\\.)*)"|(?P<code>\S)""",
                   re.DOTALL | re.MULTILINE | re.VERBOSE)


def rows(name):
    """The columns of each line of a list."""
    for line in (HERE / name).read_text().splitlines():
        if line.strip() and not line.startswith("#"):
            yield [column.strip() for column in re.split(r" +\| +", line)]


@functools.cache
def words():
    """(expression, what to write, example)"""
    return [(re.compile(pattern), instead, example) for pattern, instead, example in rows("words.txt")]


def without_allowed(path, text):
    """The text with its right uses blanked out; lines stay where they are."""
    for place, allowed, _ in rows("words_allowed.txt"):
        if place == path:
            text = text.replace(allowed, re.sub(r"\S", "~", allowed))
    return text


def flat(text):
    """The text as one line, without the quotes of broken strings and the marks of comments; where each line begins."""
    begins, out = [], ""
    for line in text.split("\n"):
        begins.append(len(out))
        out += re.sub(r"^[\s\"]+$|^\s*(?://|\*|\"|>)?\s*|\s*\"?\s*$", "", line) + " "
    return out, begins


def findings(path, text):
    """`file:line: found word; write ...` for each listed word of a text."""
    whole, begins = flat(without_allowed(path, text))
    whole = whole.lower()
    found = []
    for expression, instead, _ in words():
        for match in expression.finditer(whole):
            found.append((bisect.bisect_right(begins, match.start()), f"found '{match.group()}'; write: {instead}"))
    return [f"{path}:{line}: {report}" for line, report in sorted(found)]


def line_ends(text):
    return "\n" * text.count("\n")


def literals(code):
    """The code with its string literals only, in their lines; neighbours that the compiler joins stay neighbours, between
    others there is a bar."""
    def kept(match):
        if match["code"] or match["number"]:
            return "|"
        if match["comment"] or match["include"]:
            return line_ends(match[0])
        text = match["raw"] if match["raw"] is not None else re.sub(r"\\.", " ", match["text"])
        return f" {text} "
    return re.sub(r"\|+", "|", TOKEN.sub(kept, code))


def comments(code):
    """The code with its comments only, in their lines; between those with code between them there is a bar."""
    bars = TOKEN.sub(lambda match: match[0] if match["comment"] else "|" + line_ends(match[0]), code)
    return re.sub(r"\|+", "|", bars)


def files(places):
    return [path for place in places for path in sorted(ROOT.glob(place)) if path.is_file()]


def texts():
    """(path, text) of all that is read. A file may be read as it is, for its literals and for its comments."""
    for path in files(PLACES):
        yield path.relative_to(ROOT).as_posix(), path.read_text()
    for path in files(CODE):
        code = path.read_text()
        yield path.relative_to(ROOT).as_posix(), literals(code)
        yield path.relative_to(ROOT).as_posix(), comments(code)


class Words(unittest.TestCase):
    def test_users_read_the_english_of_the_field(self):
        found = list(dict.fromkeys(report for path, text in texts() for report in findings(path, text)))
        self.assertEqual(found, [], "\n" + "\n".join(found) + "\na right use is listed in tests/docs/words_allowed.txt")

    def test_every_place_has_files(self):
        for place in PLACES + CODE:
            self.assertTrue(files([place]), place)

    def test_every_word_is_found(self):
        for expression, instead, example in words():
            self.assertTrue(any(instead in report for report in findings("x", f"A line.\n{example}.\n")), example)

    def test_a_word_is_found_with_its_line_also_across_lines(self):
        self.assertEqual(findings("a.md", "One.\nTwo.\nIt stands in\n  front of it.\n"),
                         ["a.md:3: found 'in front'; write: before",
                          "a.md:3: found 'stands'; write: is, appears, lies, is written; is stopped, of a program"])
        self.assertEqual(findings("a.def", '     "Put it in "\n     "front of END.")\n'), ["a.def:1: found 'in front'; write: before"])
        self.assertEqual(findings("a.h", "// The clock goes\n// on.\n"), ["a.h:1: found 'goes on'; write: continue"])

    def test_a_word_in_a_string_literal_is_found(self):
        self.assertEqual(findings("a.cpp", literals('int x = 1;\nfail("\'{}\' is no "\n     "bit");\n')),
                         ["a.cpp:2: found 'is no '; write: is not a"])
        self.assertEqual(findings("a.cpp", literals('f(1\'000, \'"\', "it is\\nbehind");')),
                         ["a.cpp:1: found 'behind'; write: after, in time or order; beyond, past an end"])
        self.assertEqual(findings("a.cpp", literals('f(R"x(\n"behind")x", 2);')),
                         ["a.cpp:2: found 'behind'; write: after, in time or order; beyond, past an end"])

    def test_a_word_in_a_comment_is_found(self):
        self.assertEqual(findings("a.cpp", comments('int behind; // what\n// stands\nf("behind"); // there\n')),
                         ["a.cpp:2: found 'stands'; write: is, appears, lies, is written; is stopped, of a program"])
        self.assertEqual(findings("a.cpp", comments("// it is\nint no;\n// no end\n")), [])

    def test_code_around_string_literals_is_not_looked_at(self):
        for code in ('// behind "it"\n', '/* "behind" */ f("after");', 'int behind = 1;', '#include "behind/a.h"\n',
                     'f("it is", "no bit");', "f('\"', behind, '\"');", 'int a = 0x1\'f; int behind; f(\'x\');'):
            self.assertEqual(findings("a.cpp", literals(code)), [], code)

    def test_right_uses_are_not_found(self):
        for text in ("There is no drawing.", "a stand-alone page", "the standard", "it is no longer used", "channel 1 words it so"):
            self.assertEqual([r for r in findings("x", text) if "1 words" not in r], [])

    def test_allowed_uses_exist_and_are_needed(self):
        for path, allowed, reason in rows("words_allowed.txt"):
            text = (ROOT / path).read_text()
            self.assertIn(allowed, text, path)
            self.assertTrue(reason, path)
            self.assertTrue(findings("without exceptions", allowed), f"{path}: '{allowed}' needs no exception")


if __name__ == "__main__":
    unittest.main()
