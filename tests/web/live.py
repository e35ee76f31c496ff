"""A program on its live page, for the tests of this folder."""
import json
import re
import subprocess
import sys
import threading
import urllib.error
import urllib.request
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "support"))
from patience import patience

ROOT = Path(__file__).resolve().parents[2]
LINK = re.compile(r"http://([^/]+)/\?token=([0-9a-f]+)")


class Live:
    """rungc run … --web, until close()."""

    def __init__(self, rungc, *words, cwd=ROOT, command="run", option="--web", environment=None, under=()):
        words = [*under, rungc, command, *map(str, words), *([option] if option else [])]
        self.process = subprocess.Popen(words, cwd=cwd, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, env=environment)
        printed = []
        found = None
        while found is None:
            line = self.process.stdout.readline()
            if not line:
                raise AssertionError(f"no link: {''.join(printed)[-2000:]}")
            printed.append(line)
            found = LINK.match(line)
        self.drain = threading.Thread(target=self.process.stdout.read, daemon=True)  # messages of the program
        self.drain.start()
        self.take(found)

    @classmethod
    def of_link(cls, link):
        """Another browser of a page that is there."""
        live = cls.__new__(cls)
        live.take(LINK.match(link))
        return live

    def take(self, link):
        self.link = link.group()
        self.address, self.token = link.groups()
        self.cookie = ""

    def log_in(self):
        """As a browser that opens the link, without one."""
        with urllib.request.urlopen(self.link, timeout=patience()) as answer:
            self.cookie = answer.headers["Set-Cookie"].split(";")[0]
        return self

    def ask(self, path, body=None):
        """The answer of the page's server, for a client that has the cookie."""
        request = urllib.request.Request(f"http://{self.address}/api/{path}", headers={"Cookie": self.cookie})
        if body is not None:
            request.data = json.dumps(body).encode()
            request.add_header("Origin", f"http://{self.address}")
        with urllib.request.urlopen(request, timeout=patience()) as answer:
            return json.load(answer)

    def log_in_again(self, browser):
        """Beside a browser that has used the link."""
        self.cookie = "; ".join(f"{one['name']}={one['value']}" for one in browser.driver.get_cookies())

    def order_link(self):
        """A link for one more browser."""
        return self.ask("link", {})["link"]

    def order(self, what, **more):
        return self.ask("order", {"do": what, **more})["done"]

    def refusal(self, what, **more):
        """Why the program does not take it (status 409); None if it has. Any other error is one of the test."""
        try:
            self.order(what, **more)
            return None
        except urllib.error.HTTPError as error:
            if error.code != 409:
                raise
            return error.read().decode()

    def close(self):
        self.process.terminate()
        self.process.wait(timeout=patience())
        self.drain.join()
        self.process.stdout.close()
