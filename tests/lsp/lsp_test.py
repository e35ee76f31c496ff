#!/usr/bin/env python3
"""The language server, as an editor uses it: lsp_test.py RUNGC"""
import json
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "support"))
from patience import patience
from root import go_to_root

from client import Client, applied, span

RUNGC = None

MAIN = """dialect nct
module MAIN
symbol START 7000.00 ; green button, allow(never-written)
symbol LAMP 7001.00
const LIMIT #10
section "Lamp"
rung "on"
|--[START]--(LAMP)
rung
|--[LAMP]--{MOV 7020 LIMIT}
rung
|--[START]--{JMP #1}
rung
|--{JME #1}
rung
|--{END}
"""


class Case(unittest.TestCase):
    encodings = ["utf-32"]
    files = {"main.lad": MAIN}

    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        self.path = Path(self.folder.name).resolve()
        for name, text in self.files.items():
            (self.path / name).write_text(text, encoding="utf-8")
        self.client = Client(RUNGC, self.path, self.encodings)

    def tearDown(self):
        self.assertEqual(self.client.end(), 0)
        self.client.process.stdin.close()
        self.client.process.stdout.close()

    def codes(self, name="main.lad"):
        return [one["code"] for one in self.client.wait_for_diagnostics(name)]

    def check(self, name="main.lad"):
        """The codes and places of `rungc check` of the same text."""
        result = subprocess.run([RUNGC, "check", "--json", name], cwd=self.path, capture_output=True, text=True, timeout=patience())
        return [(one["code"], one["line"] - 1, one["column"] - 1) for one in json.loads(result.stdout)]


def place(text, word, nth=0):
    """Of its nth occurrence: line and column from 0."""
    at = -1
    for _ in range(nth + 1):
        at = text.index(word, at + 1)
    return text.count("\n", 0, at), at - (text.rfind("\n", 0, at) + 1)


class Diagnostics(Case):
    def test_come_and_go_as_one_types(self):
        self.client.open("main.lad")
        self.assertEqual(self.codes(), [])
        line, column = place(MAIN, "(LAMP)")
        self.client.change("main.lad", (span(line, column + 1, line, column + 5), "LAMQ"))
        [wrong] = self.client.wait_for_diagnostics("main.lad")
        self.assertEqual((wrong["code"], wrong["severity"], wrong["range"]), ("undeclared-symbol", 1, span(line, column + 1, line, column + 5)))
        self.client.change("main.lad", MAIN)
        self.assertEqual(self.codes(), [])

    def test_have_fixes(self):
        right = MAIN.replace("const", 'message 1 "Lamp is on"\nconst')
        text = right.replace("message 1", "message #1")
        self.client.open("main.lad", text)
        wrong = self.client.wait_for_diagnostics("main.lad")[0]
        [action] = self.client.of("main.lad", "codeAction", range=wrong["range"], context={"diagnostics": [wrong]})
        self.assertEqual(action["title"], "Write '1'")
        self.assertEqual(applied(text, action["edit"]["changes"][self.client.uri("main.lad")]), right)

    def test_are_those_of_check(self):
        text = MAIN.replace("[LAMP]", "[LAMP").replace("const LIMIT #10", "const LIMIT #10\nsymbol SPARE 7002.00")
        (self.path / "main.lad").write_text(text, encoding="utf-8")
        self.client.open("main.lad")
        found = [(one["code"], one["range"]["start"]["line"], one["range"]["start"]["character"]) for one in self.client.wait_for_diagnostics("main.lad")]
        self.assertEqual(found, self.check())
        self.assertTrue(found)

    def test_go_with_the_file(self):
        self.client.open("main.lad", MAIN.replace("(LAMP)", "(LAMQ)"))
        self.assertEqual(self.codes(), ["undeclared-symbol"])
        self.client.close("main.lad")
        self.client.open("main.lad")
        self.assertEqual(self.codes(), [])


class Names(Case):
    def setUp(self):
        super().setUp()
        self.client.open("main.lad")

    def ranges(self, found):
        return [(one["range"]["start"]["line"], one["range"]["start"]["character"]) for one in found]

    def test_lead_to_their_declaration(self):
        self.assertEqual(self.ranges(self.client.at("main.lad", *place(MAIN, "LAMP", 1), "definition")), [place(MAIN, "LAMP")])

    def test_lead_to_their_uses(self):
        places = [place(MAIN, "LAMP", nth) for nth in range(3)]
        found = self.client.at("main.lad", *places[1], "references", context={"includeDeclaration": True})
        self.assertEqual(self.ranges(found), places)
        found = self.client.at("main.lad", *places[1], "references", context={"includeDeclaration": False})
        self.assertEqual(self.ranges(found), places[1:])

    def test_are_marked_where_they_are_written(self):
        found = self.client.at("main.lad", *place(MAIN, "LAMP", 1), "documentHighlight")
        self.assertEqual([one["kind"] for one in found], [1, 3, 2])

    def test_have_an_explanation(self):
        value = self.client.at("main.lad", *place(MAIN, "START", 1), "hover")["contents"]["value"]
        self.assertIn("START: read here", value)
        self.assertIn("green button", value)
        self.assertIn("MOV", self.client.at("main.lad", *place(MAIN, "MOV"), "hover")["contents"]["value"])

    def test_are_renamed_everywhere(self):
        edit = self.client.at("main.lad", *place(MAIN, "LAMP", 2), "rename", newName="LIGHT")
        changes = edit["changes"][self.client.uri("main.lad")]
        self.assertEqual(applied(MAIN, changes), MAIN.replace("LAMP", "LIGHT"))

    def test_of_another_length_get_new_columns(self):
        before = """rung
|--[START]--+--[7000.01]--+--(LAMP) ; comment
            +--[LAMP]-----+--(7002.00)
"""
        after = """rung
|--[START]--+--[7000.01]--------+--(THE_LONG_LAMP) ; comment
            +--[THE_LONG_LAMP]--+--(7002.00)
"""
        text = MAIN.replace("rung\n", before + "rung\n", 1)
        self.client.change("main.lad", text)
        edit = self.client.at("main.lad", *place(text, "LAMP"), "rename", newName="THE_LONG_LAMP")
        self.assertEqual(applied(text, edit["changes"][self.client.uri("main.lad")]),
                         text.replace(before, after).replace("LAMP", "THE_LONG_LAMP").replace("THE_LONG_THE_LONG_", "THE_LONG_"))

    def test_are_not_renamed_to_what_collides(self):
        params = {"textDocument": {"uri": self.client.uri("main.lad")}, "position": dict(zip(("line", "character"), place(MAIN, "LAMP")))}
        for name in ("START", "LIMIT", "two words", "", "7000.00", "7"):
            answer = self.client.answer("textDocument/rename", {**params, "newName": name})
            self.assertIn(f"'{name}' cannot be the name", answer["error"]["message"], name)

    def test_complete_what_is_begun(self):
        self.client.change("main.lad", MAIN.replace("(LAMP)", "(LA"))
        line, column = place(MAIN, "(LAMP)")
        labels = [item["label"] for item in self.client.at("main.lad", line, column + 3, "completion")["items"]]
        self.assertEqual(labels[0], "LAMP")
        line, column = place(MAIN, "{MOV")
        labels = [item["label"] for item in self.client.at("main.lad", line, column + 3, "completion")["items"]]
        self.assertIn("MOVF", labels)
        self.assertNotIn("LAMP", labels)


class Outline(Case):
    def setUp(self):
        super().setUp()
        self.client.open("main.lad")

    def test_has_sections_and_rungs(self):
        module, *names = self.client.of("main.lad", "documentSymbol")
        [section] = module["children"]
        self.assertEqual((module["name"], section["name"], section["children"][0]["name"]), ("MAIN", "Lamp", "on"))
        self.assertEqual([one["name"] for one in names], ["START", "LAMP", "LIMIT", "#1"])
        folds = self.client.of("main.lad", "foldingRange")
        self.assertIn({"startLine": 1, "endLine": MAIN.count("\n") - 1}, folds)

    def test_finds_names_of_the_workspace(self):
        found = self.client.request("workspace/symbol", {"query": "green"})
        self.assertEqual([one["name"] for one in found], ["START"])

    def test_colours_words_by_what_they_are(self):
        legend = self.client.server["capabilities"]["semanticTokensProvider"]["legend"]["tokenTypes"]
        data = self.client.of("main.lad", "semanticTokens/full")["data"]
        lines, line, column, found = MAIN.split("\n"), 0, 0, []
        for i in range(0, len(data), 5):
            line, column = line + data[i], data[i + 1] + (column if data[i] == 0 else 0)
            found.append((lines[line][column:column + data[i + 2]], legend[data[i + 3]]))
        for one in (("START", "variable"), ("LIMIT", "enumMember"), ("7020", "property"), ("MOV", "function"), ("#1", "method")):
            self.assertIn(one, found)

    def test_formats(self):
        self.client.change("main.lad", MAIN.replace("|--[START]--(LAMP)", "|-[START]-(LAMP)"))
        [edit] = self.client.of("main.lad", "formatting", options={"tabSize": 2, "insertSpaces": True})
        self.assertIn("|--[START]", edit["newText"])


class Beside(Case):
    """What an editor shows beside the text."""
    files = {"main.lad": MAIN, "main.plc": "...\n"}

    def test_are_counts_of_uses(self):
        self.client.open("main.lad")
        lenses = self.client.of("main.lad", "codeLens")
        self.assertEqual([one["command"]["title"] for one in lenses], ["0 writes, 2 reads", "1 write, 1 read"])

    def test_are_addresses_in_lists(self):
        text = "dialect gsk\nsymbol DOOR X10.0\nsymbol LAMP Y1.0\nFUNC END1\nLD DOOR\nOUT LAMP\nFUNC END2\n"
        self.client.open("list.pmc", text)
        self.assertEqual(self.codes("list.pmc"), [])
        hints = self.client.of("list.pmc", "inlayHint", range=span(0, 0, 99, 0))
        self.assertEqual([(one["label"], one["position"]["line"]) for one in hints], [("X10.0", 4), ("Y1.0", 5)])

    def test_are_no_hints_in_drawings(self):
        self.client.open("main.lad")
        self.assertEqual(self.client.of("main.lad", "inlayHint", range=span(0, 0, 99, 0)), [])


class Units(Case):
    """Columns are counted as both sides have agreed."""
    def columns(self, *encodings):
        client = Client(RUNGC, self.path, list(encodings) or None)
        client.open("main.lad", MAIN.replace("(LAMP)", "(L🟢üP)"))
        [wrong] = client.wait_for_diagnostics("main.lad")
        client.end()
        client.process.stdin.close()
        client.process.stdout.close()
        return client.server["capabilities"]["positionEncoding"], wrong["range"]["end"]["character"] - wrong["range"]["start"]["character"]

    def test_are_agreed_on(self):
        self.assertEqual(self.columns(), ("utf-16", 2))
        self.assertEqual(self.columns("utf-8", "utf-16"), ("utf-8", 4))
        self.assertEqual(self.columns("utf-32"), ("utf-32", 1))
        self.assertEqual(self.columns("utf-7", "utf-16"), ("utf-16", 2))


class Projects(Case):
    files = {"rung.toml": 'name = "two"\ndialect = "nct"\nfiles = ["main.lad", "names.lad"]\n',
             "main.lad": MAIN.replace("symbol LAMP 7001.00\n", ""), "names.lad": "dialect nct\nmodule MAIN\nsymbol LAMP 7001.00\n"}

    def test_have_all_their_files(self):
        self.client.open("main.lad")
        self.assertEqual(self.codes(), [])
        text = self.files["main.lad"]
        [found] = self.client.at("main.lad", *place(text, "LAMP"), "definition")
        self.assertEqual(found["uri"], self.client.uri("names.lad"))
        edit = self.client.at("main.lad", *place(text, "LAMP"), "rename", newName="LIGHT")
        self.assertEqual(sorted(edit["changes"]), sorted([self.client.uri("main.lad"), self.client.uri("names.lad")]))

    def test_are_checked_where_a_file_is_open(self):
        self.client.open("names.lad")
        self.client.open("main.lad")
        self.codes()
        self.client.change("names.lad", "dialect nct\nmodule MAIN\nsymbol LAMPE 7001.00\n")
        self.assertIn("undeclared-symbol", self.codes())

    def test_may_have_mistakes(self):
        self.client.open("rung.toml", self.files["rung.toml"] + "nothing = 1\n")
        self.assertTrue(self.codes("rung.toml"))


class BadInput(Case):
    def test_of_every_kind_is_answered(self):
        self.client.open("main.lad")
        for method, params in (("textDocument/hover", None), ("textDocument/hover", {"textDocument": 1}),
                               ("textDocument/hover", {"textDocument": {"uri": self.client.uri("main.lad")}, "position": {"line": -1, "character": 0}}),
                               ("textDocument/hover", {"textDocument": {"uri": self.client.uri("none.lad")}, "position": {"line": 0, "character": 0}}),
                               ("no/method", {}), ("initialize", {})):
            self.assertIn("error", self.client.answer(method, params), method)
        self.client.send_bytes(b"Content-Length: 5\r\n\r\n{\"a\":")
        self.assertEqual(self.client.next()["error"]["code"], -32700)
        self.client.notify("textDocument/didChange", {"textDocument": {}})
        self.client.notify("nothing", {})
        self.assertTrue(self.client.at("main.lad", *place(MAIN, "START", 1), "hover"))

    def test_a_place_beyond_the_text_is_its_end(self):
        self.client.open("main.lad")
        self.assertIsNone(self.client.at("main.lad", 9999, 9999, "hover"))
        self.assertEqual(self.client.at("main.lad", 0, 9999, "definition"), [])


if __name__ == "__main__":
    RUNGC = str(Path(sys.argv.pop(1)).resolve())
    go_to_root()
    unittest.main()
