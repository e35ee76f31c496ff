#!/usr/bin/env python3
"""Whoever talks to the live page's server without being its page gets nothing and changes nothing: security_test.py RUNGC"""
import collections
import json
import os
import random
import re
import shutil
import socket
import subprocess
import sys
import tempfile
import time
import unittest
from pathlib import Path

from live import ROOT, Live
from patience import patience, wait_until

RUNGC = ""
EXAMPLE = ROOT / "examples" / "gsk-mill"
ORDER = json.dumps({"do": "force", "name": "X_ESP", "value": "1", "writing": True})
SLOW = 200
FUZZED = 5000
SCANS = 300  # whose instructions are counted


def slow_clients(live):
    """Connections that have sent a part of a request, or nothing."""
    host, port = live.address.split(":")
    head = f"GET / HTTP/1.1\r\nHost: {live.address}\r\n".encode()
    links = []
    for i in range(SLOW):
        links.append(socket.create_connection((host, int(port)), timeout=patience(20)))
        links[-1].sendall(head[:i % len(head)])
    return links


@unittest.skipUnless(shutil.which("valgrind"), "valgrind counts instructions")
class Counts(unittest.TestCase):
    """Instructions of the scans themselves, exact: whatever clients do, they are the same."""

    def count(self, clients):
        with tempfile.TemporaryDirectory(prefix="rung-counts-") as folder:
            counts = Path(folder) / "counts"
            live = Live(RUNGC, ROOT / "tests" / "web" / "toggle.lad", under=("valgrind", "--tool=callgrind", "--toggle-collect=*SessionSource::oneScan*",
                                                                            f"--callgrind-out-file={counts}")).log_in()
            links = []
            try:
                live.order("pause")
                links = slow_clients(live) if clients else []
                subprocess.run(["callgrind_control", "-z", str(live.process.pid)], check=True, capture_output=True, timeout=patience())
                live.order("step", scans=SCANS)
            finally:
                for link in links:
                    link.close()
                live.close()
            return int(re.search(r"^(?:summary|totals): (\d+)", counts.read_text(), re.MULTILINE).group(1))

    def test_slow_clients(self):
        alone, beside = self.count(False), self.count(True)
        print(f"{SCANS} scans: {alone} instructions, beside {SLOW} slow clients {beside}")
        self.assertGreater(alone, 1000 * SCANS)
        self.assertLess(abs(beside - alone), alone / 1000)


class Security(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.live = Live(RUNGC, EXAMPLE).log_in()
        host, port = cls.live.address.split(":")
        cls.where = (host, int(port))

    @classmethod
    def tearDownClass(cls):
        cls.live.close()

    def tearDown(self):
        """Nothing has been written, and the program runs."""
        before = self.picture()
        self.assertEqual(before["forces"], [])
        kinds = {event[3] for event in self.live.ask("events?after=0")}
        self.assertLessEqual(kinds, {"message", "gone"})
        self.assertIsNotNone(wait_until(lambda: self.picture()["scan"] > before["scan"]))

    def picture(self):
        return self.live.ask("picture?page=test&after=0&from=0&to=0")

    def connect(self):
        return socket.create_connection(self.where, timeout=patience(20))

    def raw(self, data, wait=True):
        """The whole answer to these bytes."""
        with self.connect() as link:
            try:
                link.sendall(data)
                if not wait:
                    return b""
                link.shutdown(socket.SHUT_WR)
                got = b""
                while part := link.recv(65536):
                    got += part
                return got
            except OSError:  # closed in the middle
                return b""

    def request(self, method="GET", path="/api/picture?after=0", body="", **headers):
        """The status and the whole answer; headers with _ for -."""
        fields = {"Host": self.live.address, "Connection": "close", **({"Content-Length": len(body)} if method == "POST" else {})}
        fields.update({name.replace("_", "-"): value for name, value in headers.items()})
        head = "".join(f"{name}: {value}\r\n" for name, value in fields.items() if value is not None)
        answer = self.raw(f"{method} {path} HTTP/1.1\r\n{head}\r\n{body}".encode())
        return (int(answer.split()[1]) if answer.startswith(b"HTTP/1.1 ") else 0), answer

    def test_the_page_itself(self):
        """What the others below do wrong is all that keeps them out."""
        status, answer = self.request(Cookie=self.live.cookie)
        self.assertEqual(status, 200)
        for header in (b"Content-Security-Policy: default-src 'none'", b"X-Content-Type-Options: nosniff",
                       b"Cross-Origin-Resource-Policy: same-origin"):
            self.assertIn(header, answer)
        status, _ = self.request("POST", "/api/order", '{"do": "run"}', Cookie=self.live.cookie, Origin=f"http://{self.live.address}")
        self.assertEqual(status, 200)

    def test_token_is_spent(self):
        self.assertEqual(self.request(path="/?token=" + self.live.token)[0], 403)

    def test_token_guessed(self):
        tokens = ["", "0" * 48, self.live.token[:-1] + ("0" if self.live.token[-1] != "0" else "1"), self.live.token[:47], "%00" * 48]
        tokens += ["".join(random.choices("0123456789abcdef", k=48)) for _ in range(300)]
        for token in tokens:
            status, answer = self.request(path="/?token=" + token)
            self.assertEqual(status, 403, token)
            self.assertNotIn(b"Set-Cookie", answer)

    def test_cookie_guessed(self):
        name, secret = self.live.cookie.split("=")
        for cookie in (None, f"{name}=", f"{name}={secret[:-1]}", f"{name}={secret}0", f"x{name}={secret}", f"{name}={'0' * 48}", "=" * 500):
            for path in ("/", "/main.js", "/api/index", "/api/picture?after=0"):
                self.assertEqual(self.request(path=path, Cookie=cookie)[0], 403, cookie)
            self.assertEqual(self.request("POST", "/api/order", ORDER, Cookie=cookie, Origin=f"http://{self.live.address}")[0], 403)

    def test_page_from_elsewhere(self):
        """Also one on another port of this computer, which the browser sends the cookie to (SameSite knows no ports)."""
        port = self.where[1]
        for origin in ("http://evil.example", "https://" + self.live.address, f"http://127.0.0.1:{port + 1}", f"http://localhost:{port}", "null", None):
            status, _ = self.request("POST", "/api/order", ORDER, Cookie=self.live.cookie, Origin=origin)
            self.assertEqual(status, 403, origin)
            if origin is not None:
                self.assertEqual(self.request(Cookie=self.live.cookie, Origin=origin)[0], 403, origin)
        for site in ("cross-site", "same-site", "none"):
            self.assertEqual(self.request(Cookie=self.live.cookie, Sec_Fetch_Site=site)[0], 403, site)

    def test_names_that_are_not_ours(self):
        """A name that somebody's name server gives this address (DNS rebinding) is refused, whatever else is right."""
        port = self.where[1]
        for host in ("evil.example", f"evil.example:{port}", f"127.0.0.1.evil.example:{port}", "127.0.0.1", f"127.0.0.1:{port + 1}",
                     f"localhost.evil.example:{port}", f"[::1]evil:{port}", "", f"@{self.live.address}", f"{self.live.address}:{port}"):
            status, _ = self.request("POST", "/api/order", ORDER, Host=host, Cookie=self.live.cookie, Origin=f"http://{host}")
            self.assertIn(status, (0, 400, 403), host)
            status, _ = self.request(Host=host, Cookie=self.live.cookie)
            self.assertIn(status, (0, 400, 403), host)

    def test_other_methods(self):
        for method in ("PUT", "DELETE", "OPTIONS", "PATCH", "TRACE", "CONNECT", "PROPFIND", "MKCOL", "X"):
            status, answer = self.request(method, "/api/order", ORDER, Cookie=self.live.cookie, Origin=f"http://{self.live.address}")
            self.assertNotEqual(status, 200, method)
            self.assertNotIn(b"Access-Control", answer)

    def test_writing_switched_off(self):
        status, _ = self.request("POST", "/api/order", ORDER.replace("true", "false"), Cookie=self.live.cookie, Origin=f"http://{self.live.address}")
        self.assertEqual(status, 403)

    def test_files(self):
        for path in ("/../etc/passwd", "/%2e%2e/%2e%2e/etc/passwd", "//etc/passwd", "/app/main.js", "/x%00/etc/passwd", "/api/"):
            status, answer = self.request(path=path, Cookie=self.live.cookie)
            self.assertIn(status, (0, 400, 404), path)
            self.assertNotIn(b"root:", answer)

    def test_malformed_orders(self):
        own = {"Cookie": self.live.cookie, "Origin": f"http://{self.live.address}"}
        for body in ("", "null", "[]", "{", '{"do": 1}', '{"do": "no"}', '{"do": "force"}', '{"do": "force", "writing": "yes"}', '{"do": "force", "name": ["X"], "writing": true}',
                     '{"do": "seek", "scans": "x", "writing": true, "do": "x"}', "[" * 50000, '{"do": "set", "name": "X_ESP 1\\nforce X_ESP", "value": "1", "writing": true}',
                     '{"do": "statement", "name": "include /etc/passwd", "writing": true}', '{"do": "statement", "name": "program /etc/passwd", "writing": true}'):
            self.assertIn(self.request("POST", "/api/order", body, **own)[0], (400, 403, 409, 500), body[:60])
        self.assertIn(self.request("POST", "/api/order", "x" * 70000, **own)[0], (0, 413))
        for length in ("-1", "99999999999999999999", "70000", "abc", "1e3"):
            answer = self.raw(f"POST /api/order HTTP/1.1\r\nHost: {self.live.address}\r\nCookie: {self.live.cookie}\r\nOrigin: http://{self.live.address}\r\nContent-Length: {length}\r\n\r\n{ORDER}".encode())
            self.assertNotIn(b"HTTP/1.1 200", answer, length)

    def test_other_protocols(self):
        """There is no WebSocket: a handshake and frames after it are refused."""
        status, _ = self.request(path="/api/picture", Cookie=self.live.cookie, Upgrade="websocket", Connection="Upgrade", Sec_WebSocket_Version="13",
                                 Sec_WebSocket_Key="dGhlIHNhbXBsZSBub25jZQ==", Origin=f"http://{self.live.address}")
        self.assertIn(status, (400, 404))
        handshake = (f"GET / HTTP/1.1\r\nHost: {self.live.address}\r\nCookie: {self.live.cookie}\r\nUpgrade: websocket\r\nConnection: Upgrade\r\n"
                     "Sec-WebSocket-Version: 13\r\nSec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n\r\n").encode()
        for frame in (b"\x81\xff" + b"\xff" * 12, b"\x81\x7f\x7f\xff\xff\xff\xff\xff\xff\xff", bytes(random.randbytes(300)), b"\x89\x80abcd", b"\x00"):
            self.assertNotIn(b"101 ", self.raw(handshake + frame))

    def test_fuzzed(self):
        """Requests with bytes changed, inserted, cut off; and no requests at all. The seed is in the failure."""
        seed = int(os.environ.get("RUNG_SEED", time.time()))
        chance = random.Random(seed)
        good = (f"POST /api/order HTTP/1.1\r\nHost: evil\r\nCookie: {self.live.cookie}\r\nOrigin: http://evil\r\n"
                f"Content-Length: {len(ORDER)}\r\n\r\n{ORDER}").encode()
        kinds = collections.Counter()
        for i in range(FUZZED):
            data = bytearray(good if i % 4 else chance.randbytes(chance.randrange(2000)))
            for _ in range(chance.randrange(1, 8)):
                at = chance.randrange(len(data) + 1)
                what = chance.randrange(4)
                if what == 0 and at < len(data):
                    data[at] = chance.randrange(256)
                elif what == 1:
                    data[at:at] = chance.choice((b"\r\n", b"\0", b":", b" ", b"\xff" * 9, b"Host: x\r\n", b"Transfer-Encoding: chunked\r\n", b"A" * 9000))
                elif what == 2:
                    del data[at:at + chance.randrange(40)]
                else:
                    del data[at:]
            answer = self.raw(bytes(data))
            kinds.update(status for status in (400, 403) if b" %d " % status in answer)
            self.assertNotIn(b" 200 OK", answer, f"seed {seed}, request {i}: {bytes(data)!r}")
        self.assertGreater(min(kinds[400], kinds[403]), FUZZED // 20, kinds)

    def test_slow_clients(self):
        """Half requests of 200 clients: the program goes on meanwhile, and then the page is there again."""
        before = self.picture()
        begin = time.monotonic()
        links = slow_clients(self.live)
        for link in links[::7]:
            try:
                link.sendall(b"X")
            except OSError:
                pass
        time.sleep(2)
        self.assertIsNotNone(wait_until(self.answers, step=0.2))
        after = self.picture()
        seconds = time.monotonic() - begin
        self.assertGreater((after["us"] - before["us"]) / 1e6, 0.8 * seconds - 0.5, "the program's clock")
        for link in links:
            link.close()

    def answers(self):
        try:
            return self.picture()["scan"]
        except OSError:
            return None


if __name__ == "__main__":
    RUNGC = sys.argv.pop(1)
    unittest.main()
