#!/usr/bin/env python3
"""The live page as people use it, in Chromium: page_test.py RUNGC"""
import sys
import time
import unittest
from pathlib import Path

import machine_test
from browser import Browser, Keys
from live import ROOT, Live

RUNGC = ""
EXAMPLE = ROOT / "examples" / "gsk-mill"
LAMP = ROOT / "tests" / "web" / "toggle.lad"
WITHIN = ROOT / "tests" / "web" / "within.lad"


class Page(unittest.TestCase):
    """One program and one browser for all tests, which leave it running."""

    @classmethod
    def setUpClass(cls):
        cls.live = Live(RUNGC, EXAMPLE)
        cls.browser = Browser()
        cls.browser.open(cls.live.link)
        cls.live.log_in_again(cls.browser)

    @classmethod
    def tearDownClass(cls):
        cls.browser.close()
        cls.live.close()

    def setUp(self):
        self.browser.click("#tab-ladder")

    def tearDown(self):
        self.assertEqual(self.browser.errors(), [])

    def scan(self):
        return int(self.browser.text("#scan"))

    def pause(self):
        self.live.order("pause")
        self.browser.until("return document.getElementById('state').textContent === 'Paused'", "paused")

    def run_on(self):
        self.live.order("run")
        self.browser.until("return document.getElementById('state').textContent === 'Running'", "running")

    def test_runs_and_pauses(self):
        before = self.scan()
        self.browser.until("return Number(document.getElementById('scan').textContent) > arguments[0] + 20", "scans", before)
        self.browser.click("#go")
        self.browser.until("return document.getElementById('state').textContent === 'Paused'", "paused")
        at = self.scan()
        time.sleep(0.3)
        self.assertEqual(self.scan(), at)
        self.browser.click("#step")
        self.browser.until("return Number(document.getElementById('scan').textContent) === arguments[0]", "a step", at + 1)
        self.browser.click("#go")
        self.browser.until("return document.getElementById('state').textContent === 'Running'", "running")

    def test_goes_back_and_shows_what_was(self):
        """Scans that are shown again show what they have shown, forwards and backwards, and the newest scan stays."""
        self.pause()
        self.browser.js("document.querySelector('#ladder').scrollTop = 0")
        self.browser.until("return document.getElementById('r1')", "the first rungs, which are drawn after the scrolling")
        newest = self.scan()
        flow = "return [...document.querySelectorAll('article')].map(e => e.dataset.row + e.dataset.flow).join()"
        shown = {}
        for scan in range(newest, newest - 12, -1):
            self.live.order("seek", scans=scan)
            self.browser.until("return document.getElementById('space').dataset.scan === String(arguments[0])", "scan", scan)
            shown[scan] = self.browser.js(flow)
        for scan in sorted(shown):
            self.live.order("seek", scans=scan)
            self.browser.until("return document.getElementById('space').dataset.scan === String(arguments[0])", "scan", scan)
            self.assertEqual(self.browser.js(flow), shown[scan], f"scan {scan}")
        self.live.order("seek", scans=newest - 200)
        self.browser.until("return document.getElementById('state').textContent === 'Past'", "the past")
        self.run_on()
        self.assertGreaterEqual(self.scan(), newest)

    def test_timeline_by_mouse(self):
        self.pause()
        newest = self.scan()
        slider = self.browser.find("#slider")
        self.browser.js("arguments[0].value = Number(arguments[0].max) - 50; arguments[0].dispatchEvent(new Event('input'))", slider)
        self.browser.until("return document.getElementById('scan').textContent === String(arguments[0])", "dragged", newest - 50)
        self.assertEqual(self.browser.text("#go"), "To now")
        self.browser.click("#go")
        self.browser.until("return document.getElementById('state').textContent === 'Running'", "running")

    def test_search(self):
        for what, rung in (("Y8.0", "r260"), ("SPINDLE_CW", "r260"), ("260", "r260"), ("contactor counter", "r261")):
            with self.subTest(what):
                box = self.browser.find("#what")
                box.clear()
                box.send_keys(what)
                self.browser.until("return document.querySelectorAll('#found li:not(.none)').length > 0", "found")
                box.send_keys(Keys.ENTER)
                self.browser.until("return document.querySelector('article.now')?.id === arguments[0]", rung, rung)

    def test_an_exact_name_is_found_first(self):
        for what in ("ON", "SIM", "X8.4"):
            with self.subTest(what):
                box = self.browser.find("#what")
                box.clear()
                box.send_keys(what)
                first = self.browser.until("const li = document.querySelector('#found li:not(.none)'); return li && [...li.children].map(e => e.textContent)", "found")
                self.assertTrue(first[1] == what or first[2].startswith(what + " "), first)
        self.browser.find("#what").send_keys(Keys.ESCAPE)

    def test_goes_to_the_element(self):
        """What is searched, and a rung where a name is read or written, leads to the contact or coil itself."""
        page = self.browser
        seen = """const one = document.querySelector(arguments[0] + ' .at'), pane = document.getElementById('ladder').getBoundingClientRect();
                  if (!one || one.dataset.name !== arguments[1] || one.classList.contains('o') !== arguments[2]) return false;
                  const box = one.getBoundingClientRect();
                  return box.left >= pane.left && box.right <= pane.right && box.top >= pane.top && box.bottom <= pane.bottom"""
        page.find("#what").clear()
        page.find("#what").send_keys("SPINDLE_CW", Keys.ENTER)
        page.until(seen, "its coil", "#r260", "SPINDLE_CW", True)
        page.js("[...document.querySelectorAll('#detail dd')][1].querySelector('a').click()")
        page.until(seen, "its contact", "#r1", "SPINDLE_CW", False)
        page.js("[...document.querySelectorAll('#detail dd')][0].querySelector('a').click()")
        page.until(seen, "its coil again", "#r260", "SPINDLE_CW", True)
        page.keys(Keys.ESCAPE)

    def test_cross_reference_by_click(self):
        self.browser.js("document.activeElement.blur()")
        self.browser.find("#what").clear()
        self.browser.find("#what").send_keys("260")
        self.browser.until("return document.querySelector('#found li')", "found")
        self.browser.find("#what").send_keys(Keys.ENTER)
        self.browser.until("return document.querySelector('#r260 .k')", "the rung")
        self.browser.js("document.querySelector('#r260 [data-name=CW_ORDER]').dispatchEvent(new MouseEvent('click', {bubbles: true}))")
        self.browser.until("return document.querySelector('#detail h2')?.textContent === 'CW_ORDER'", "the name")
        self.browser.until("return /^[01]$/.test(document.querySelector('#detail output')?.textContent)", "its value")
        link = self.browser.js("return [...document.querySelectorAll('#detail dd')][0].querySelector('a').textContent")
        self.browser.js("[...document.querySelectorAll('#detail dd')][0].querySelector('a').click()")
        self.browser.until("return document.querySelector('article.now')?.id === arguments[0]", link, "r" + link)
        self.browser.js("[...document.querySelectorAll('#detail button')].find(b => b.textContent === 'Why?').click()")
        self.browser.until("return /CW_ORDER \\(\\S+\\) = [01], (since|unchanged)/.test(document.querySelector('.why')?.textContent)", "why")

    def test_watch(self):
        self.browser.click("#tab-watch")
        self.browser.find("#watch input").send_keys("SPINDLE_CW", Keys.ENTER)
        self.browser.until("return document.querySelector('#watch td.value')?.textContent === '0'", "a value")
        self.pause()
        newest = self.scan()
        self.browser.click("#trace")
        self.browser.until("return document.querySelector('.lines svg .wave')", "a line")
        self.assertEqual(self.scan(), newest)
        self.browser.js("const s = document.querySelector('.lines svg'), b = s.getBoundingClientRect();"
                        "s.dispatchEvent(new MouseEvent('click', {clientX: b.left + b.width - 1}))")
        self.browser.until("return document.getElementById('scan').textContent === String(arguments[0])", "the last scan of it", newest)
        self.run_on()
        self.browser.js("document.querySelector('#watch td .close').click()")
        self.browser.until("return document.querySelectorAll('#watch tbody tr').length === 0", "removed")

    def test_traces_have_one_axis(self):
        """Lines of names, values and buttons of different widths are above each other, and the scans below them."""
        page = self.browser
        page.click("#tab-watch")
        for name in ("SPINDLE_CW", "POCKET", "X_ESP"):
            page.find("#watch .add input").send_keys(name, Keys.ENTER)
        page.until("return document.querySelectorAll('#watch tbody tr').length === 3", "the names")
        page.click("#trace")
        page.until("return document.querySelectorAll('.lines svg').length === 3", "the lines")
        edges = page.js("return [...document.querySelectorAll('.lines svg, .lines .scans')].map(e => { const b = e.getBoundingClientRect(); return [b.left, b.right]; })")
        self.assertEqual(edges, [edges[0]] * 4)
        first, *_, last = page.js("return [...document.querySelectorAll('.scans span')].map(e => Number(e.textContent))")
        self.assertIn(f"from scan {first} to {last}", page.js("return document.querySelector('.lines svg').getAttribute('aria-label')"))
        for _ in range(3):
            page.js("document.querySelector('#watch td .close').click()")
        page.until("return document.querySelectorAll('#watch tbody tr').length === 0", "removed")

    def test_inputs_and_outputs(self):
        self.browser.click("#tab-io")
        self.browser.until("return document.querySelectorAll('#io tbody tr').length > 300", "all")
        self.browser.until("return document.querySelector('#io td.value').textContent === '0'", "a value")
        self.browser.find("#io input").send_keys("LUBE")
        self.browser.until("const n = document.querySelectorAll('#io tbody tr').length; return n > 0 && n < 20", "some")
        self.browser.find("#io input").clear()

    def test_inputs_and_outputs_are_sorted(self):
        page = self.browser
        page.click("#tab-io")
        page.find("#io input").clear()
        column = "return [...document.querySelectorAll(`#io tbody tr > :nth-child(${arguments[0]})`)].map(e => e.textContent)"
        for head, number, first in (("Address", 2, "X0.0"), ("Name", 3, None)):
            button = f"#io thead th:nth-child({number}) button"
            self.assertEqual(page.text(button), head)
            page.js("document.querySelector(arguments[0]).focus()", button)
            page.keys(Keys.ENTER)
            page.until("return document.querySelector(`#io thead th:nth-child(${arguments[0]})`).getAttribute('aria-sort') === 'ascending'", head, number)
            up = page.js(column, number)
            self.assertGreater(len(up), 300)
            page.keys(Keys.ENTER)
            page.until("return document.querySelector(`#io thead th:nth-child(${arguments[0]})`).getAttribute('aria-sort') === 'descending'", head, number)
            down = page.js(column, number)
            self.assertEqual(sorted(up), sorted(down))
            self.assertEqual((up[0], up[-1]), (down[-1], down[0]))
            self.assertNotEqual(up, down)
        page.click("#io thead th:nth-child(2) button")
        addresses = page.js(column, 2)
        place = [(one[0], *map(int, one[1:].split("."))) for one in addresses if "." in one]
        self.assertEqual(place, sorted(place))
        page.until("return /^[01]$/.test(document.querySelector('#io td.value').textContent)", "the value of the first row")

    def test_writes_only_when_switched_on(self):
        """A page with writing off is refused by the server, too."""
        with self.assertRaises(Exception):
            self.live.ask("order", {"do": "set", "name": "X8.4", "value": "1"})
        page = self.browser
        page.find("#what").clear()
        page.find("#what").send_keys("X_ESP")
        page.until("return document.querySelector('#found li')", "found")
        page.find("#what").send_keys(Keys.ENTER)
        page.until("return document.querySelector('#detail h2')?.textContent === 'X_ESP'", "the name")
        self.assertEqual(page.js("return document.querySelectorAll('#detail .write').length"), 0)
        page.click("#writing")
        page.js("[...document.querySelectorAll('dialog button')].find(b => b.textContent === 'Switch on').click()")
        page.until("return document.querySelector('#detail .write input')", "the form")
        page.js("document.querySelector('#detail .write input').value = '1'")
        page.js("[...document.querySelectorAll('#detail .write button')].find(b => b.textContent === 'Force').click()")
        page.until("return document.querySelector('#detail output').textContent === '1 (forced)'", "forced")
        page.until("return document.querySelector('#r2 .forced')?.dataset.name === 'X_ESP'", "marked in the rung")
        page.until("return document.querySelector('#r2 [data-name=X_ESP]').dataset.on === '1'", "it conducts")
        self.assertEqual(page.text("#forced"), "1 forced")
        page.js("[...document.querySelectorAll('#detail .write button')].find(b => b.textContent === 'Release').click()")
        page.until("return document.getElementById('forced').hidden", "released")
        page.click("#tab-log")
        page.until("return /force X_ESP 1/.test(document.getElementById('log').textContent)", "in the history")
        page.click("#writing")
        page.until("return document.getElementById('writing').getAttribute('aria-pressed') === 'false'", "off")

    def test_keyboard_alone(self):
        page = self.browser
        page.js("document.activeElement.blur()")
        page.keys("/", "255", Keys.ENTER)
        page.until("return document.activeElement.id === 'r255'", "the rung has the focus")
        page.keys(Keys.ARROW_DOWN)
        page.until("return document.activeElement.id === 'r256'", "the next")
        page.keys(Keys.ARROW_RIGHT)
        page.until("return document.querySelector('#r256 .at') && !document.getElementById('detail').hidden", "an element")
        page.js("document.querySelector('#detail button:not(.close)').focus()")
        page.keys(Keys.ESCAPE)
        page.until("return document.getElementById('detail').hidden && document.activeElement.id === 'r256'", "closed, and back at its rung")
        page.keys(" ")
        page.until("return document.getElementById('state').textContent === 'Paused'", "paused")
        page.keys(",")
        page.until("return document.getElementById('state').textContent === 'Past'", "one scan back")
        page.keys(" ")
        page.until("return document.getElementById('state').textContent === 'Running'", "running")
        page.keys("3")
        page.until("return !document.getElementById('io').hidden", "the view")
        page.keys("p")
        page.until("return document.querySelectorAll('#legend .heat').length === 5 && !document.getElementById('ladder').hidden", "the profile")
        page.keys("p")
        page.until("return document.getElementById('legend').hidden", "without it")

    def test_menu_and_dialogs_by_keyboard(self):
        page = self.browser
        page.js("document.getElementById('more').focus()")
        page.keys(Keys.ENTER)
        page.until("return document.activeElement.id === 'theme'", "the first item")
        page.keys(Keys.ARROW_UP)
        page.until("return document.activeElement.id === 'keys'", "the last item")
        page.keys(Keys.ENTER)
        page.until("return document.getElementById('dialog').open", "the list of keys")
        self.assertEqual(page.js("const d = document.getElementById('dialog'); return document.getElementById(d.getAttribute('aria-labelledby')).textContent"), "Keys")
        page.keys(Keys.ENTER)
        page.until("return !document.getElementById('dialog').open", "closed")
        page.js("document.getElementById('more').focus()")
        page.keys(Keys.ENTER)
        page.keys(Keys.ESCAPE)
        page.until("return document.getElementById('menu-more').hidden && document.activeElement.id === 'more'", "back at its button")

    def test_is_read_aloud(self):
        page = self.browser
        page.keys("/", "260", Keys.ENTER)
        text = page.until("const t = document.querySelector('#r260')?.getAttribute('aria-label'); return /CW_ORDER (conducts|does not)/.test(t) && t", "the rung in words")
        self.assertIn("Rung 260: contactor clockwise. ", text)
        self.assertIn("SPINDLE_CW off", text)
        unnamed = page.js("return [...document.querySelectorAll('button,input,select,table:not(:has(caption)),[role]')].filter(e => e.offsetParent && "
                          "!e.textContent.trim() && !e.getAttribute('aria-label') && !e.getAttribute('aria-labelledby')).map(e => e.outerHTML)")
        self.assertEqual(unnamed, [])

    def test_trigger(self):
        """A trace around the scan in which a condition began to hold, with scans before and after it."""
        page = self.browser
        page.click("#tab-watch")
        page.js("localStorage.clear()")
        page.find("#watch .add input").send_keys("X_ESP", Keys.ENTER)
        page.until("return document.querySelector('#watch td.value')", "a value")
        page.js("document.querySelector('.when').value = 'NO_SUCH_NAME'")
        page.click("#arm")
        page.until("return /NO_SUCH_NAME/.test(document.getElementById('toast').textContent)", "what is wrong")
        self.assertEqual(page.text("#hits"), "")
        self.assertEqual([" 409 " in error for error in page.errors()], [True])
        page.js("document.querySelector('.when').value = 'falls X_ESP'")
        page.js("document.querySelector('[aria-label=\"Scans of a trace\"]').value = '100'")
        page.click("#arm")
        page.until("return /^Waiting for falls X_ESP/.test(document.getElementById('hits').textContent)", "it waits")
        for value in ("1", "0"):
            self.live.order("set", name="X_ESP", value=value, writing=True)
            at = self.scan()
            page.until("return Number(document.getElementById('scan').textContent) > arguments[0] + 5", "scans", at)
        page.until("return /1 of 1: scan \\d+/.test(document.getElementById('hits').textContent)", "the trace")
        page.until("return document.querySelector('.lines .hit')", "its line")
        hit = int(page.text("#hits a"))
        page.until("return document.getElementById('arm').textContent === 'Wait for it'", "once")
        label = page.js("return document.querySelector('.lines svg').getAttribute('aria-label')")
        self.assertEqual(label, f"X_ESP from scan {hit - 49} to {hit + 50}: 0 to 0")
        page.click("#tab-log")
        page.until("return [...document.querySelectorAll('.k-trigger')].some(row => /falls X_ESP/.test(row.textContent))", "in the history")
        page.click("#tab-watch")
        page.js("document.querySelector('#watch td .close').click()")

    def test_profile(self):
        """Shares of the rungs as colours, with figures and a legend."""
        page = self.browser
        page.click("#profile")
        page.until("return document.querySelectorAll('#legend .heat').length === 5", "the legend")
        page.until("return document.querySelectorAll('.share').length > 1", "shares at the rungs")
        shares = self.live.ask("shares?scans=50")
        self.assertAlmostEqual(sum(rung[2] for rung in shares["rungs"]), 1, places=6)
        self.assertEqual(shares["last"] - shares["first"], 49)
        self.assertEqual(max(rung[3] for rung in shares["rungs"]), 5)
        hottest = page.js("const a = document.querySelector('#legend a'); a.click(); return a.textContent")
        page.until("return document.getElementById('r' + arguments[0])?.dataset.heat === '5'", "the hottest", hottest)
        self.assertRegex(page.text(f"#r{hottest} .share"), r"^\d+(\.\d)? %, (once a scan|\d+ runs in 200 scans)$")
        page.click("#profile")
        page.until("return !document.querySelector('.share') && document.getElementById('legend').hidden", "gone")

    def test_messages(self):
        """Each message with the times when it came, was acknowledged, and went."""
        page = self.browser
        page.click("#tab-log")
        page.until("return document.querySelectorAll('#alarms tbody tr.on').length > 0", "a message that is on")
        self.assertEqual(self.live.refusal("seek", scans=1), None)
        self.run_on()
        page.until("return document.querySelector('#alarms tbody tr.on td:nth-child(2) a')", "its scan")
        page.click("#writing")
        page.js("[...document.querySelectorAll('dialog button')].find(b => b.textContent === 'Switch on').click()")
        page.until("return [...document.querySelectorAll('#log button')].some(b => b.textContent === 'Acknowledge all' && b.offsetParent)", "the button")
        page.js("[...document.querySelectorAll('#log button')].find(b => b.textContent === 'Acknowledge all').click()")
        page.until("return document.querySelector('#alarms tbody tr.on td:nth-child(3) a')", "acknowledged")
        page.click("#writing")

    def test_phone(self):
        page = Browser()
        try:
            page.phone()
            page.open(self.live.order_link())
            page.until("return document.querySelectorAll('article').length > 1", "rungs")
            wide = page.js("return document.documentElement.scrollWidth")
            self.assertLessEqual(wide, 390)
            page.until("return document.querySelector('article svg')?.getBoundingClientRect().width < 560", "narrow drawings")
            page.click("#menu")
            page.until("return getComputedStyle(document.getElementById('side')).display !== 'none'", "the contents")
            page.js("[...document.querySelectorAll('#tree li')][3].click()")
            page.until("return getComputedStyle(document.getElementById('side')).display === 'none'", "closed again")
            page.phone(820, 1180)
            page.until("return document.querySelector('article svg') && innerWidth === 820", "a tablet")
            page.until("const w = document.querySelector('article svg')?.getBoundingClientRect().width; return w > 600 && w < 820", "drawings that fit it")
            page.click("#tab-io")
            page.until("return document.querySelectorAll('#io tbody tr').length > 300", "inputs and outputs")
            shown = page.js("return [...document.querySelectorAll('#io thead th')].filter(h => h.getBoundingClientRect().right <= 820).map(h => h.textContent)")
            for head in ("Address", "Name", "Value", "Drawn as", "Written in"):
                self.assertIn(head, shown)
            self.assertEqual(page.errors(), [])
        finally:
            page.close()

    def test_two_browsers_of_which_one_writes(self):
        other = Browser()
        try:
            other.open(self.live.order_link())
            self.live.order("force", name="X_ESP", value="1", writing=True)
            for page in (self.browser, other):
                page.until("return document.getElementById('forced').textContent === '1 forced'", "forced in both")
            self.assertEqual(other.text("#writing"), "Writing off")
            other.click("#forced")
            buttons = other.js("return [...document.querySelectorAll('dialog button')].map(b => b.textContent)")
            self.assertEqual(buttons, ["Close"])
            other.keys(Keys.ENTER)
            self.live.order("unforce", name="X_ESP", writing=True)
            other.until("return document.getElementById('forced').hidden", "released in both")
            other.click("#tab-log")
            other.until("return /force X_ESP 1/.test(document.getElementById('log').textContent)", "in its history")
            self.assertEqual(other.errors(), [])
        finally:
            other.close()

    def test_two_browsers(self):
        other = Browser()
        try:
            other.open(self.live.order_link())
            self.pause()
            other.until("return document.getElementById('state').textContent === 'Paused'", "paused there, too")
            self.assertEqual(int(other.text("#scan")), self.scan())
            other.click("#go")
            self.browser.until("return document.getElementById('state').textContent === 'Running'", "running here, too")
            self.assertEqual(other.errors(), [])
        finally:
            other.close()


class Connection(unittest.TestCase):
    def test_comes_back(self):
        """A page whose server is silent says so, and goes on when it speaks again."""
        live = Live(RUNGC, EXAMPLE)
        page = Browser()
        try:
            page.open(live.link)
            page.js("window.real = window.fetch; window.fetch = () => Promise.reject(new TypeError('cut'))")
            page.until("return !document.getElementById('lost').hidden", "it says that it has no connection")
            self.assertEqual(page.text("#state"), "No connection")
            before = page.text("#scan")
            page.js("window.fetch = window.real")
            page.until("return document.getElementById('lost').hidden", "it is there again")
            page.until("return Number(document.getElementById('scan').textContent) > arguments[0]", "scans", int(before))
        finally:
            page.close()
            live.close()


    def test_comes_back_while_the_time_line_is_dragged(self):
        """The scan to which it was dragged meanwhile is shown then, and the time line follows again."""
        live = Live(RUNGC, EXAMPLE)
        page = Browser()
        try:
            page.open(live.link)
            page.until("return Number(document.getElementById('scan').textContent) > 60", "scans")
            live.log_in_again(page)
            live.order("pause")
            page.until("return document.getElementById('state').textContent === 'Paused'", "paused")
            page.js("window.real = window.fetch; window.fetch = () => Promise.reject(new TypeError('cut'))")
            page.until("return !document.getElementById('lost').hidden", "no connection")
            for scan in (40, 30, 20):
                page.js("const s = document.getElementById('slider'); s.focus(); s.value = arguments[0]; s.dispatchEvent(new Event('input'))", scan)
            page.js("window.fetch = window.real")
            page.until("return document.getElementById('lost').hidden && document.getElementById('scan').textContent === '20'", "the scan that was asked for last")
            page.click("#step")
            page.until("return document.getElementById('slider').value === '21'", "the time line follows")
            self.assertEqual(page.errors(), [])
        finally:
            page.close()
            live.close()


class Recorded(unittest.TestCase):
    def test_why_by_address(self):
        """What decided is framed though the rung names it otherwise, with its value, and what would be different."""
        live = Live(RUNGC, EXAMPLE / "tool-change.scn", command="replay")
        page = Browser()
        try:
            page.open(live.link)
            page.find("#what").send_keys("FIN", Keys.ENTER)
            page.until("return document.querySelector('#detail h2')?.textContent === 'FIN'", "the name")
            page.js("[...document.querySelectorAll('#detail button')].find(b => b.textContent === 'Why?').click()")
            page.until("return document.querySelectorAll('.step').length > 1", "the chain")
            self.assertIn("TF = 0 (alone)", page.text(".step"))
            self.assertIn("It would be different with M_STROBE (R15.4) = 1", page.text(".different"))
            framed = page.until("const all = [...document.querySelectorAll('#r448 .cause[data-name]')].map(e => e.dataset.name); return all.length && all", "framed")
            self.assertEqual(sorted(set(framed)), ["EF", "M_STROBE", "SF", "TF"])
            self.assertEqual(page.errors(), [])
        finally:
            page.close()
            live.close()

    def test_replay(self):
        """A scenario as it ran: played, dragged back, asked why; it cannot be changed."""
        live = Live(RUNGC, EXAMPLE / "spindle.scn", command="replay")
        page = Browser()
        try:
            page.open(live.link)
            page.until("return document.getElementById('state').textContent === 'Past'", "the past")
            last = int(page.text("#scan"))
            self.assertEqual(page.text("#go"), "Play")
            page.until("return [...document.querySelectorAll('#alarms .text')].some(cell => cell.textContent === '49 PRESS MACHINE ON')", "messages with their texts")
            page.click("#back")
            page.until("return document.getElementById('scan').textContent === String(arguments[0])", "a scan back", last - 1)
            page.js("const s = document.getElementById('slider'); s.value = 2; s.dispatchEvent(new Event('input'))")
            page.until("return document.getElementById('scan').textContent === '2'", "the beginning")
            page.click("#go")
            page.until("return Number(document.getElementById('scan').textContent) > 12", "it plays")
            page.click("#go")
            page.click("#tab-log")
            page.until("return document.querySelectorAll('#log tbody tr.k-statement').length > 3", "what the scenario did")
            page.click("#tab-ladder")
            page.js("const s = document.getElementById('slider'); s.value = s.max; s.dispatchEvent(new Event('input'))")
            page.until("return document.getElementById('scan').textContent === String(arguments[0])", "the end", last)
            page.find("#what").send_keys("SPINDLE_CW", Keys.ENTER)
            page.until("return document.querySelector('#detail h2')?.textContent === 'SPINDLE_CW'", "the name")
            page.js("[...document.querySelectorAll('#detail button')].find(b => b.textContent === 'Why?').click()")
            page.until("return document.querySelectorAll('.step').length > 0", "the chain")
            page.until("return document.querySelector('#r260 .cause')", "what decided, in the drawing")
            page.click("#writing")
            page.until("return /recording cannot be changed/.test(document.getElementById('toast').textContent)", "refused")
            self.assertEqual(page.errors(), [])
        finally:
            page.close()
            live.close()


class Machine(unittest.TestCase):
    """A machine that runs, with a host and a page of its own for each test."""

    def begin(self, **how):
        machine_test.BIN = Path(RUNGC).resolve().parent
        self.host = machine_test.Host(**how)
        self.addCleanup(self.host.end)
        self.live = self.host.page()
        self.addCleanup(self.live.close)
        self.page = Browser()
        self.addCleanup(self.page.close)
        self.page.open(self.live.link)
        self.state("Running")

    def state(self, text):
        self.page.until("return document.getElementById('state').textContent === arguments[0]", text, text)

    def scan(self):
        return int(self.page.text("#scan"))

    def later(self, scan):
        self.page.until("return Number(document.getElementById('scan').textContent) > arguments[0]", "scans", scan)

    def choose(self, name):
        box = self.page.find("#what")
        box.clear()
        box.send_keys(name)
        self.page.until("return document.querySelector('#found li:not(.none)')", "found")
        box.send_keys(Keys.ENTER)
        self.page.until("return document.querySelector('#detail h2')?.textContent === arguments[0]", name, name)

    def begin_writing(self):
        """The lamp's name is chosen, and writing is on."""
        self.begin()
        self.choose("LAMP")
        self.switch_writing_on()
        return self.page

    def begin_marking(self):
        page = self.begin_writing()
        page.click("#more")
        page.click("#mark")
        return page

    def switch_writing_on(self):
        self.page.click("#writing")
        self.page.js("[...document.querySelectorAll('dialog button')].find(b => b.textContent === 'Switch on').click()")
        self.page.until("return document.querySelector('#detail .write input')", "the form")

    def write(self, value, button):
        self.page.js("document.querySelector('#detail .write input').value = arguments[0]", value)
        self.page.js("[...document.querySelectorAll('#detail .write button')].find(b => b.textContent === arguments[0]).click()", button)

    def test_live_past_and_why(self):
        self.begin()
        page = self.page
        self.later(self.scan() + 30)
        page.until("return document.querySelector('#r2 .o[data-name=LAMP]')?.dataset.on === '0'", "the lamp is off")
        self.host.done("set", "BUTTON", "on")
        page.until("return document.querySelector('#r2 .o[data-name=LAMP]').dataset.on === '1'", "the lamp is on")
        self.choose("LAMP")
        page.js("[...document.querySelectorAll('#detail button')].find(b => b.textContent === 'Why?').click()")
        page.until("return /BUTTON/.test(document.querySelector('.step:last-child')?.textContent)", "the chain")
        page.js("document.querySelector('.step a:last-of-type').click()")
        self.state("Past")
        pressed = self.scan()
        self.assertEqual(page.text("#go"), "To now")
        page.click("#back")
        page.until("return document.getElementById('scan').textContent === String(arguments[0])", "a scan back", pressed - 1)
        page.until("return document.querySelector('#r2 .o[data-name=LAMP]').dataset.on === '0'", "it was off")
        page.until("return Number(document.getElementById('slider').max) > arguments[0] + 100", "the machine runs on", pressed)
        self.assertEqual(self.scan(), pressed - 1)
        page.click("#go")
        self.state("Running")
        self.later(pressed + 100)
        self.assertEqual(page.errors(), [])

    def test_force_with_the_right(self):
        self.begin()
        self.choose("LAMP")
        self.switch_writing_on()
        self.write("1", "Force")
        self.page.until("return document.querySelector('#detail output').textContent === '1 (forced)'", "forced")
        self.page.until("return document.querySelector('#r2 .forced')?.dataset.name === 'LAMP'", "marked in the rung")
        self.write("", "Release")
        self.page.until("return document.getElementById('forced').hidden", "released")
        self.page.click("#tab-log")
        self.page.until("return /unforce LAMP .*by/.test(document.getElementById('log').textContent)", "in the history")
        self.assertEqual(self.page.errors(), [])

    def test_force_without_the_right(self):
        self.begin(map=machine_test.MAP)
        self.page.click("#writing")
        self.page.until("return /permissions/.test(document.getElementById('toast').textContent)", "refused, with what is needed")
        self.assertEqual(self.page.js("return document.getElementById('writing').getAttribute('aria-pressed')"), "false")

    def test_writing_is_taken_away_while_a_dialog_is_open(self):
        """The host comes back without the right: the page switches writing off, and the dialog writes nothing."""
        page = self.begin_marking()
        page.find("dialog input").send_keys("never")
        self.host.kill()
        (self.host.home / "plc.map").write_text(machine_test.MAP)
        self.host.start()
        page.until("return document.getElementById('writing').textContent === 'Writing off'", "switched off")
        self.assertTrue(page.js("return document.getElementById('dialog').open"))
        page.find("dialog input").send_keys(Keys.ENTER)
        page.until("return /writing is switched off/.test(document.getElementById('toast').textContent)", "refused")
        page.until("return !document.querySelector('#detail .write')", "nothing can be written")
        self.assertNotIn("never", page.text("#log"))

    def test_marks_by_keyboard(self):
        page = self.begin_marking()
        page.keys(Keys.ENTER)
        page.until("return document.querySelector('dialog .wrong').textContent === 'A mark needs a text.'", "refused with a word")
        page.keys("here", Keys.ENTER)
        page.until("return !document.getElementById('dialog').open", "closed")
        page.click("#tab-log")
        page.until("return [...document.querySelectorAll('.k-mark')].some(row => /here/.test(row.textContent))", "in the history")
        self.assertEqual(page.errors(), [])

    def test_stopped_by_the_operator(self):
        """Rungs are as in the last scan that ran, and the page says so; also one that is opened later, and in the past."""
        self.begin()
        page = self.page
        self.host.done("set", "BUTTON", "on")
        page.until("return document.querySelector('#r2 .o[data-name=LAMP]')?.dataset.on === '1'", "the lamp is on")
        self.host.done("stop")
        self.state("Stopped")
        says = "const s = document.getElementById('stopped'); return !s.hidden && /^The operator has stopped the program. Rungs are as in scan \\d+/.test(s.textContent) && Number(/\\d+/.exec(s.textContent)[0])"
        ran = page.until(says, "it says so")
        self.later(ran + 20)
        self.assertEqual(page.js("return [document.querySelectorAll('.idle').length, document.querySelector('#r2 .o[data-name=LAMP]').dataset.on]"), [0, "1"])
        second = self.host.page()
        self.addCleanup(second.close)
        page.open(second.link)
        self.state("Stopped")
        self.assertGreater(page.until(says, "a page that was opened later"), 0)
        page.until("return document.querySelectorAll('article').length > 2 && !document.querySelector('.idle')", "with power")
        page.click("#back")
        self.state("Past")
        page.until(says, "in the past")
        self.host.done("start")
        page.click("#go")
        self.state("Running")
        page.until("return document.getElementById('stopped').hidden", "it runs")
        self.assertEqual(page.errors(), [])

    def test_a_fault_while_it_is_paused(self):
        self.begin()
        page = self.page
        page.click("#go")
        self.state("Past")
        at = self.scan()
        self.host.done("set", "ENDLESS", "on")
        page.click("#tab-log")
        page.until("return document.querySelector('.k-fault')", "in the history")
        self.assertEqual((page.text("#state"), self.scan()), ("Past", at))
        page.click("#go")
        self.state("Fault")
        page.until("return document.getElementById('messages').textContent.length > 10", "which fault")
        page.click("#tab-ladder")
        page.until("return document.querySelectorAll('article').length > 2 && !document.querySelector('.idle')", "the rungs of its scan")
        self.assertEqual(page.errors(), [])

    def test_another_program_while_values_are_forced(self):
        """The list of forced values is open when another program takes over: its page has no dialog, and does not write."""
        page = self.begin_writing()
        self.write("1", "Force")
        page.until("return document.getElementById('forced').textContent === '1 forced'", "forced")
        page.js("document.querySelector('#detail .write input').value = '0'")
        page.click("#forced")
        page.until("return document.getElementById('dialog').open", "the list")
        self.host.build("other.pmc", machine_test.OTHER)
        self.host.done("reload", self.host.home / "other.so")
        page.until("return /lamp of another program/.test(document.getElementById('r2')?.textContent)", "the other program")
        page.until("return /Another program runs now/.test(document.getElementById('toast').textContent)", "it says so")
        self.assertFalse(page.js("return document.getElementById('dialog').open"))
        self.assertEqual(page.text("#writing"), "Writing off")
        page.until("return document.getElementById('forced').hidden", "a force ends with its program")
        self.assertEqual(page.errors(), [])

    def test_its_page_is_killed_and_opened_again(self):
        """kill -9 of the page's process: the machine runs on, and another page has its past."""
        self.begin()
        self.later(self.scan() + 30)
        at = self.scan()
        self.live.process.kill()
        self.live.process.wait()
        self.page.until("return !document.getElementById('lost').hidden", "it says that it has no connection")
        self.assertEqual(self.page.text("#state"), "No connection")
        again = self.host.page()
        self.addCleanup(again.close)
        self.page.open(again.link)
        self.state("Running")
        self.assertGreater(self.scan(), at)
        self.page.js("const s = document.getElementById('slider'); s.value = arguments[0]; s.dispatchEvent(new Event('input'))", at)
        self.page.until("return document.getElementById('scan').textContent === String(arguments[0])", "what was before", at)
        self.state("Past")

    def test_a_host_that_is_killed_and_started_again(self):
        self.begin()
        self.host.kill()
        self.state("No connection")
        self.page.until("const n = document.getElementById('notice'); return !n.hidden && /plc/.test(n.textContent)", "it says why")
        last = self.scan()
        self.host.start()
        self.state("Running")
        self.later(last + 20)
        self.page.until("return document.getElementById('notice').hidden", "all is well")
        self.assertEqual(self.page.errors(), [])

    def test_another_program_is_drawn(self):
        self.begin()
        self.host.build("other.pmc", machine_test.OTHER)
        self.host.done("reload", self.host.home / "other.so")
        self.page.until("return /lamp of another program/.test(document.getElementById('r2')?.textContent)", "the other program")
        self.state("Running")

    def test_two_browsers(self):
        self.begin()
        self.live.log_in_again(self.page)
        other = Browser()
        self.addCleanup(other.close)
        other.open(self.live.order_link())
        self.page.click("#go")
        other.until("return document.getElementById('state').textContent === 'Past'", "paused there, too")
        other.click("#go")
        self.state("Running")


class Charts(unittest.TestCase):
    def test_equations_and_steps(self):
        """Equations of a TECHNOL program are ladders, mechanisms charts with the step at which each continues."""
        live = Live(RUNGC, ROOT / "examples" / "technol-mill")
        page = Browser()
        try:
            page.open(live.link)
            page.find("#what").send_keys("23", Keys.ENTER)
            page.until("return document.querySelectorAll('#r23 .k').length >= 1", "contacts")
            page.until("return document.querySelectorAll('#r23 .k[data-on=\"0\"],#r23 .k[data-on=\"1\"]').length >= 3", "their state")
            page.until("for (const row of document.querySelectorAll('.row')) if (row.querySelector('.st')) return true;"
                       "document.getElementById('ladder').scrollTop += 300; return false", "a chart")
            page.until("return document.querySelectorAll('.st[data-on=\"1\"]').length > 0", "the step that continues")
            self.assertEqual(page.errors(), [])
        finally:
            page.close()
            live.close()


def seen_in_frames(page, look):
    """The values that an expression of JavaScript has had in 400 frames; on(selector) is the state of an element."""
    return page.driver.execute_async_script("""
        const done = arguments[0], seen = new Set(), on = selector => document.querySelector(selector).dataset.on;
        let left = 400;
        const look = () => { seen.add(""" + look + """); if (--left) requestAnimationFrame(look); else done([...seen].sort()); };
        look();""")


class Alternating(unittest.TestCase):
    def test_one_scan_at_a_time(self):
        """X alternates; two rungs read X and not X, and no picture has them both on, or both off."""
        live = Live(RUNGC, LAMP)
        page = Browser()
        try:
            page.open(live.link)
            page.until("return document.querySelectorAll('article').length === 3", "rungs")
            seen = seen_in_frames(page, "on('.o[data-name=SAME]') + on('.o[data-name=OTHER]') + on('#r2 [data-name=X]') + on('#r3 [data-name=X]')")
            self.assertEqual(seen, ["0101", "1010"])
        finally:
            page.close()
            live.close()

    def test_within_a_scan(self):
        """X becomes its opposite within each scan: each contact shows what it was when its rung was evaluated."""
        live = Live(RUNGC, WITHIN)
        page = Browser()
        try:
            page.open(live.link)
            page.until("return document.querySelectorAll('article').length === 5", "rungs")
            seen = seen_in_frames(page, "on('#r3 [data-name=X]') + on('#r3 [data-name=FIRST]') + on('#r5 [data-name=X]') + on('#r5 [data-name=SECOND]')")
            self.assertEqual(seen, ["0011", "1100"])
        finally:
            page.close()
            live.close()


if __name__ == "__main__":
    RUNGC = sys.argv.pop(1)
    unittest.main()
