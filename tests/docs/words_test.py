#!/usr/bin/env python3
"""Keeps the words of words.txt out of the docs. words_test.py"""
import bisect
import re
import unittest
from pathlib import Path

HERE = Path(__file__).resolve().parent
ROOT = HERE.parents[1]
PLACES = ("README.md", "CONTRIBUTING.md", "docs/*.md", "docs/dialects/*.md", "examples/**/*.md")


def rows(name):
    """The columns of each line of a list."""
    for line in (HERE / name).read_text().splitlines():
        if line.strip() and not line.startswith("#"):
            yield [column.strip() for column in re.split(r" +\| +", line)]


def words():
    """(expression, what to write, example)"""
    for pattern, instead, example in rows("words.txt"):
        yield re.compile(pattern, re.IGNORECASE), instead, example


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
    found = []
    for expression, instead, _ in words():
        for match in expression.finditer(whole):
            found.append((bisect.bisect_right(begins, match.start()), f"found '{match.group()}'; write: {instead}"))
    return [f"{path}:{line}: {report}" for line, report in sorted(found)]


def texts():
    for place in PLACES:
        for path in sorted(ROOT.glob(place)):
            yield path.relative_to(ROOT).as_posix(), path.read_text()


class Words(unittest.TestCase):
    def test_users_read_the_english_of_the_field(self):
        found = [report for path, text in texts() for report in findings(path, text)]
        self.assertEqual(found, [], "\n" + "\n".join(found) + "\na right use is listed in tests/docs/words_allowed.txt")

    def test_every_place_has_files(self):
        for place in PLACES:
            self.assertTrue(list(ROOT.glob(place)), place)

    def test_every_word_is_found(self):
        for expression, instead, example in words():
            self.assertTrue(any(instead in report for report in findings("x", f"A line.\n{example}.\n")), example)

    def test_a_word_is_found_with_its_line_also_across_lines(self):
        self.assertEqual(findings("a.md", "One.\nTwo.\nIt stands in\n  front of it.\n"),
                         ["a.md:3: found 'in front'; write: before",
                          "a.md:3: found 'stands'; write: is, appears, lies, is written; is stopped, of a program"])
        self.assertEqual(findings("a.def", '     "Put it in "\n     "front of END.")\n'), ["a.def:1: found 'in front'; write: before"])
        self.assertEqual(findings("a.h", "// The clock goes\n// on.\n"), ["a.h:1: found 'goes on'; write: continue"])

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
