"""A client of the language server, for tests: it speaks as an editor does, and waits for what the server says."""
import json
import subprocess
import threading
from queue import Empty, Queue

from patience import patience


class Client:
    """`rungc lsp` in a folder. Requests wait for their answers; diagnostics are kept by their documents."""

    def __init__(self, rungc, folder, encodings=None):
        self.process = subprocess.Popen([rungc, "lsp"], stdin=subprocess.PIPE, stdout=subprocess.PIPE, cwd=folder)
        self.folder = folder
        self.count = 0
        self.versions = {}
        self.diagnostics = {}
        self.said = Queue()
        self.reader = threading.Thread(target=self.read, daemon=True)
        self.reader.start()
        general = {"positionEncodings": encodings} if encodings else {}
        self.server = self.request("initialize", {"processId": None, "rootUri": self.uri(""), "capabilities": {"general": general}})
        self.notify("initialized", {})

    def uri(self, name):
        return (self.folder / name).as_uri() if name else self.folder.as_uri()

    def read(self):
        while message := self.one():
            self.said.put(message)
        self.said.put(None)

    def one(self):
        length = None
        while line := self.process.stdout.readline():
            if line == b"\r\n":
                return json.loads(self.process.stdout.read(length))
            name, _, value = line.partition(b":")
            if name.lower() == b"content-length":
                length = int(value)
        return None

    def send_bytes(self, data):
        self.process.stdin.write(data)
        self.process.stdin.flush()

    def send(self, message):
        data = json.dumps({"jsonrpc": "2.0", **message}).encode()
        self.send_bytes(b"Content-Length: %d\r\n\r\n%s" % (len(data), data))

    def notify(self, method, params):
        self.send({"method": method, "params": params})

    def next(self):
        try:
            message = self.said.get(timeout=patience())
        except Empty:
            raise AssertionError("the server says nothing") from None
        assert message is not None, "the server has ended"
        if message.get("method") == "textDocument/publishDiagnostics":
            params = message["params"]
            self.diagnostics[params["uri"].rsplit("/", 1)[1]] = params["diagnostics"]
        return message

    def answer(self, method, params):
        """The whole answer, also an error."""
        self.count += 1
        self.send({"id": self.count, "method": method, "params": params})
        while (message := self.next()).get("id") != self.count:
            pass
        return message

    def request(self, method, params):
        answer = self.answer(method, params)
        assert "error" not in answer, answer["error"]
        return answer["result"]

    def open(self, name, text=None):
        if text is None:
            text = (self.folder / name).read_text(encoding="utf-8")
        self.versions[name] = 1
        self.notify("textDocument/didOpen", {"textDocument": {"uri": self.uri(name), "languageId": "rung", "version": 1, "text": text}})

    def change(self, name, *changes):
        """Each a range and a text, or a whole text."""
        self.versions[name] += 1
        content = [{"text": change} if isinstance(change, str) else {"range": change[0], "text": change[1]} for change in changes]
        self.notify("textDocument/didChange", {"textDocument": {"uri": self.uri(name), "version": self.versions[name]}, "contentChanges": content})

    def close(self, name):
        self.notify("textDocument/didClose", {"textDocument": {"uri": self.uri(name)}})

    def wait_for_diagnostics(self, name):
        """Those of the document's last text."""
        wanted = (self.uri(name), self.versions[name])
        while (message := self.next()).get("method") != "textDocument/publishDiagnostics" or (message["params"]["uri"], message["params"].get("version")) != wanted:
            pass
        return self.diagnostics[name]

    def at(self, name, line, character, method, **more):
        """A request about a place, counted from 0."""
        return self.request("textDocument/" + method, {"textDocument": {"uri": self.uri(name)}, "position": {"line": line, "character": character}, **more})

    def of(self, name, method, **more):
        return self.request("textDocument/" + method, {"textDocument": {"uri": self.uri(name)}, **more})

    def end(self):
        """The exit status."""
        self.request("shutdown", None)
        self.notify("exit", None)
        return self.process.wait(patience())


def span(begin_line, begin, end_line, end):
    return {"start": {"line": begin_line, "character": begin}, "end": {"line": end_line, "character": end}}


def applied(text, edits):
    """The text after edits of the protocol, in characters of Unicode."""
    lines = text.split("\n")
    starts = [0]
    for line in lines:
        starts.append(starts[-1] + len(line) + 1)
    offset = lambda at: starts[at["line"]] + at["character"]
    for edit in sorted(edits, key=lambda edit: offset(edit["range"]["start"]), reverse=True):
        text = text[:offset(edit["range"]["start"])] + edit["newText"] + text[offset(edit["range"]["end"]):]
    return text
