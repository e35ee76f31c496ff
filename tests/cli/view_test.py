#!/usr/bin/env python3
"""rungc view as a user sees it: pages that stand alone, pictures that are XML, nothing half written. view_test.py RUNGC"""
import re
import subprocess
import sys
import tempfile
import unittest
import xml.etree.ElementTree
from html.parser import HTMLParser
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "support"))
from patience import patience, seconds_of_children
from root import go_to_root

RUNGC = None
OK, WRONG, USAGE, ENVIRONMENT = 0, 1, 2, 3
ROOT = Path(__file__).resolve().parents[2]
LATHE = [f"examples/nct-lathe/{name}.lad" for name in ("io", "main", "probe")]
VOID = {"meta", "input", "br", "img", "link", "hr"}


class Page(HTMLParser):
    """Texts and attributes of a page; says when tags do not match."""

    def __init__(self, text):
        super().__init__()
        self.open, self.wrong, self.texts, self.ids, self.links, self.loads = [], [], [], [], [], []
        self.feed(text)
        self.wrong += self.open

    def handle_starttag(self, tag, attributes):
        values = dict(attributes)
        if tag not in VOID:
            self.open.append(tag)
        if "id" in values:
            self.ids.append(values["id"])
        if "href" in values:
            self.links.append(values["href"])
        self.loads += [values[name] for name in ("src", "xlink:href", "action", "data") if name in values]

    def handle_startendtag(self, tag, attributes):
        pass

    def handle_endtag(self, tag):
        if not self.open or self.open.pop() != tag:
            self.wrong.append(tag)

    def handle_data(self, data):
        self.texts.append(data)


class View(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        self.html, self.svg = (str(Path(self.folder.name) / f"out.{end}") for end in ("html", "svg"))

    def file(self, name, content):
        path = Path(self.folder.name) / name
        path.write_text(content)
        return str(path)

    def view(self, *args):
        return subprocess.run([RUNGC, "view", *args], capture_output=True, timeout=patience(300))

    def page(self, *args):
        done = self.view(*args, "-o", self.html)
        self.assertEqual((done.returncode, done.stdout), (OK, f"wrote {self.html}\n".encode()), done.stderr)
        return Page(Path(self.html).read_text())

    def left_over(self):
        return sorted(path.name for path in Path(self.folder.name).iterdir() if path.name.startswith("out"))

    def test_another_spelling_of_a_box_is_the_same_box(self):
        """Below MOVCMND begins a box of its own, not a pin of it."""
        def drawn(mnemonic):
            program = self.file("axis.lad", "dialect nct\nmodule MAIN\nrung\n|--[7000.00]--+--{%s #0 #1 *1.0 *2.0}\n%s+--{MOV 7001 #1}\nrung\n|--{END}\n"
                                % (mnemonic, " " * 14))
            done = self.view(program, "-o", self.svg)
            self.assertEqual(done.returncode, OK, done.stderr)
            return len(xml.etree.ElementTree.parse(self.svg).findall(".//{*}rect"))
        self.assertEqual(drawn("MOVCMD"), drawn("MOVCMND"))

    def test_a_page_stands_alone(self):
        for files in (LATHE, ["examples/gsk-panel/panel.lad"], ["examples/gsk-mill/mill.pmc"]):
            page = self.page(*files)
            self.assertEqual(page.wrong, [])
            self.assertEqual(len(page.ids), len(set(page.ids)))
            self.assertEqual(page.loads, [])
            self.assertTrue(page.links)
            self.assertEqual([link for link in page.links if link.startswith("#") and link[1:] not in page.ids], [])
            sources = {link.split("#")[0] for link in page.links if not link.startswith("#")}
            self.assertTrue(sources)
            self.assertLessEqual({(Path(self.folder.name) / source).resolve() for source in sources},
                                 {(ROOT / name).resolve() for name in files})

    def test_a_page_has_everything(self):
        page = self.page(*LATHE)
        texts = "\n".join(page.texts)
        for wanted in ("Module INT0", "initially all acknowledges are 1", "main.lad:7", "CHUCK_WANT", "4002", "Address of Timer",
                       "word: not 0 while the chuck has to be clamped", "Turret: one step per scan", "LIGHT", "io.lad"):
            self.assertIn(wanted, texts)
        rungs = sum(Path(ROOT, name).read_text().count("\nrung") for name in LATHE)
        self.assertEqual([f"r{i + 1}" for i in range(rungs)], [i for i in page.ids if re.fullmatch(r"r\d+", i)])

    def test_a_list_is_drawn_with_its_own_lines_and_messages(self):
        texts = self.page("examples/gsk-mill/mill.pmc", "--config", "messages=mill.msg").texts
        lines = Path(ROOT, "examples/gsk-mill/mill.pmc").read_text().splitlines()
        title = texts.index("always 1")
        number = int(texts[title + 1].removeprefix("mill.pmc:"))
        self.assertEqual(lines[number - 1].split()[:2], ["LD", "ON"])
        self.assertTrue(any(text.startswith("\u201c") for text in texts), "no message text")

    def test_links_to_sources_are_as_asked_for(self):
        self.assertIn("editor:/x?7", self.page(LATHE[1], LATHE[0], "--link", "editor:/x?{line}").links)
        self.assertEqual([link for link in self.page(*LATHE, "--link", "").links if not link.startswith("#")], [])

    def test_every_call_of_a_machine_leads_to_its_subprogram(self):
        self.page("examples/gsk-mill/mill.pmc")
        text = Path(self.html).read_text()
        self.assertGreater(len(re.findall(r'<a href="#r\d+">CALLU?</a></text>', text)), 10)
        self.assertEqual(re.findall(r'">CALLU?</text>', text), [])
        self.assertIn("Subprogram P5: overrides", text)

    def test_the_title_block(self):
        page = self.page(*LATHE, "--title", "Lathe <7>", "--revision", "C2", "--date", "1 March")
        for wanted in ("Lathe <7>", "Revision C2", "1 March"):
            self.assertIn(wanted, page.texts)
        text = Path(self.html).read_text()
        self.assertIn("<title>Lathe &lt;7&gt;</title>", text)
        self.assertIn('content: "Revision C2, 1 March"', text)
        self.assertIn("<h1>lathe</h1>", (self.page(*LATHE), Path(self.html).read_text())[1], "the name of the project")
        self.assertIn("<h1>nct-lathe</h1>", (self.page(*LATHE, "--no-project"), Path(self.html).read_text())[1])
        self.assertIn("<h1>mill.pmc</h1>", (self.page("examples/gsk-mill/mill.pmc", "--no-project"), Path(self.html).read_text())[1])

    def test_a_picture_is_xml(self):
        source = self.file("t.lad", 'dialect nct\nmodule MAIN\nsymbol A_B 7000.00 ; <b> "\u4e3b" \' ]]>\n'
                                    'rung "</title><script>"\n|--[A_B]--(A_B) ; & <\n')
        self.assertEqual(self.view(source, "-o", self.svg).returncode, OK)
        root = xml.etree.ElementTree.parse(self.svg).getroot()
        texts = [node.text for node in root.iter("{http://www.w3.org/2000/svg}text")]
        self.assertEqual(texts.count("A_B"), 2)
        self.assertIn("& <", texts)
        titles = [node.text for node in root.iter("{http://www.w3.org/2000/svg}title")]
        self.assertEqual(titles, ["t.lad", "Rung 1: </title><script>"])
        page = self.page(source)
        self.assertEqual(page.wrong, [])
        self.assertIn("</title><script>", page.texts)

    def test_the_picture_of_the_readme_is_what_the_tool_draws(self):
        readme = Path(ROOT, "README.md").read_text()
        program = Path(ROOT, "docs/lamp.lad").read_text()
        self.assertIn(program, readme)
        self.assertIn("(docs/lamp.svg)", readme)
        self.assertEqual(self.view("docs/lamp.lad", "-o", self.svg).returncode, OK)
        self.assertEqual(Path(self.svg).read_text(), Path(ROOT, "docs/lamp.svg").read_text(), "stale: run tests/update")

    def test_a_program_with_errors_gives_no_file(self):
        source = self.file("t.lad", "dialect nct\nmodule MAIN\nrung\n|--[7000.00]--(7001.00)\nrung\n|--[7000.01]--\n")
        Path(self.html).write_text("as it was")
        done = self.view(source, "-o", self.html)
        self.assertEqual((done.returncode, done.stdout), (WRONG, b""))
        self.assertIn(b"t.lad:6:", done.stderr)
        self.assertEqual(Path(self.html).read_text(), "as it was")
        self.assertEqual(self.left_over(), ["out.html"])

    def test_warnings_do_not_hinder(self):
        source = self.file("t.lad", "dialect nct\nmodule MAIN\nsymbol MINE 0056.00\nrung\n|--[7000.00]--(7001.00)\n")
        done = self.view(source, "-o", self.svg)
        self.assertEqual(done.returncode, OK)
        self.assertIn(b"warning", done.stderr)
        self.assertEqual(self.left_over(), ["out.svg"])

    def test_wrong_use(self):
        done = self.view("docs/lamp.lad")
        self.assertEqual(done.returncode, USAGE)
        self.assertIn(b"only a project has a default name", done.stderr)
        self.assertEqual(self.view(*LATHE, "--no-project").returncode, USAGE)
        done = self.view(*LATHE, "-o", str(Path(self.folder.name) / "out.pdf"))
        self.assertEqual((done.returncode, self.left_over()), (USAGE, []))
        self.assertIn(b".svg", done.stderr)

    def test_technol_has_ladders_and_charts(self):
        mill = ("examples/technol-mill/mill.plc", "examples/technol-mill/changer.plc")
        self.assertEqual(self.view(*mill, "-o", self.svg).returncode, OK)
        self.assertIn("Mechanism SPD_CW: spindle clockwise", Path(self.svg).read_text(encoding="utf-8"))
        self.assertEqual(self.view(*mill, "--title", "Mill 3", "-o", self.html).returncode, OK)
        page = Path(self.html).read_text(encoding="utf-8")
        self.assertIn("<h1>Mill 3</h1>", page)
        rungs = [int(number) for number in re.findall(r'<figure class="R[^"]*" id="r(\d+)"', page)]
        self.assertEqual(rungs, list(range(1, len(rungs) + 1)))
        for cell in ("MECH.SPD_CW.CONT", "MECH.CHANGE.CONT", "@BLOCK_INIT.CONT"):
            self.assertIn(f'data-cell="{cell}" data-states="0"', page)
        self.assertEqual(self.view("examples/technol-machining-centre", "-o", self.html).returncode, OK)
        page = Path(self.html).read_text(encoding="utf-8")
        for line in Path("examples/technol-machining-centre/centre.inc").read_text(encoding="utf-8").splitlines():
            if name := re.match(r"\s*EQUI\s+(\w+)", line):  # an included file declares names, and has no rung
                self.assertIn(f'<th scope="row">{name[1]}</th>', page)

    def test_places_have_the_names_that_stand_at_the_terminals(self):
        source = Path(self.folder.name) / "press.lad"
        source.write_text("""dialect nct
module MAIN
symbol LS_TOP INP000.11  ; ram at top
symbol Y_UP   OUT000.05  ; allow(never-read)
rung "up"
|--[LS_TOP]--[INP000.12]--(Y_UP)
""", encoding="utf-8")
        self.assertEqual(self.view(str(source), "-o", self.html).returncode, OK)
        page = Path(self.html).read_text(encoding="utf-8")
        for name, address in (("LS_TOP", "INP000.11"), ("Y_UP", "OUT000.05"), ("INP000.12", "")):
            self.assertIn(f'<th scope="row">{name}</th><td class="v">{address}</td>', page)
            self.assertIn(f">{address or name}<", page[page.index("<figure"):page.index("</figure>")])
        self.assertNotRegex(page, r"\b(0030|0732)\.")
        self.assertNotIn("allow(", page)
        source.write_text("dialect nct\nmodule MAIN\nrung\n|--[0030.12]--(0732.03)\n", encoding="utf-8")
        self.assertEqual(self.view(str(source), "-o", self.html).returncode, OK)
        page = Path(self.html).read_text(encoding="utf-8")
        for name in ("INP000.12", "OUT000.03"):  # for addresses that are numbers, too
            self.assertIn(f">{name}<", page[page.index("<figure"):page.index("</figure>")])

    def test_the_environment(self):
        self.assertEqual(self.view("nowhere.lad", "-o", self.html).returncode, ENVIRONMENT)
        done = self.view(*LATHE, "-o", "/nowhere/out.html")
        self.assertEqual(done.returncode, ENVIRONMENT)
        self.assertIn(b"cannot write '/nowhere/out.html'", done.stderr)
        folder = Path(self.folder.name) / "out.svg"
        folder.mkdir()
        self.assertEqual(self.view(*LATHE, "-o", str(folder)).returncode, ENVIRONMENT)
        self.assertEqual(self.left_over(), ["out.svg"])

    def test_many_rungs(self):
        rungs = "".join(f'\nrung "number {i}"\n|--[{4000 + i // 32}.{i % 32:02}]--+--[/7000.00]--({6000 + i // 32}.{i % 32:02})\n'
                        f"|--[7000.01]--+\n" for i in range(50000))
        source = self.file("many.lad", "dialect nct\nmodule MAIN\n" + rungs)
        start = seconds_of_children()
        self.assertEqual(self.view(source, "-o", self.html).returncode, OK)
        self.assertLess(seconds_of_children() - start, 60)
        size = Path(self.html).stat().st_size
        self.assertLess(size, 50000 * 1600)


if __name__ == "__main__":
    go_to_root()
    RUNGC = sys.argv.pop(1)
    unittest.main()
