"""A terminal for a program that draws a whole screen: the lines that a user sees."""
import fcntl
import os
import pty
import re
import select
import signal
import struct
import subprocess
import termios
import time

SEQUENCE = re.compile(rb"\x1b\[([?>!]?)([0-9;]*)([@-~])|\x1b[()*+].|\x1b[^\[]")


class Screen:
    def __init__(self, words, environment, columns=80, rows=24, term="xterm-256color"):
        self.columns, self.rows = columns, rows
        self.cells = [[" "] * columns for _ in range(rows)]
        self.row = self.column = 0
        self.top, self.bottom = 0, rows - 1  # the lines that scroll
        self.saved = (0, 0)
        self.last = " "
        self.raw = b""
        self.seen = b""  # everything that was written
        self.master, slave = pty.openpty()
        self.set_size(columns, rows)
        self.process = subprocess.Popen(words, stdin=slave, stdout=slave, stderr=subprocess.PIPE, close_fds=True, start_new_session=True,
                                        env={**environment, "TERM": term, "LC_ALL": "C.UTF-8"})
        os.close(slave)

    def set_size(self, columns, rows):
        fcntl.ioctl(self.master, termios.TIOCSWINSZ, struct.pack("HHHH", rows, columns, 0, 0))

    def resize(self, columns, rows):
        self.columns, self.rows = columns, rows
        self.cells = [[" "] * columns for _ in range(rows)]
        self.top, self.bottom = 0, rows - 1
        self.set_size(columns, rows)
        self.process.send_signal(signal.SIGWINCH)

    def press(self, keys):
        os.write(self.master, keys.encode())

    def text(self):
        """What is on the screen now."""
        while select.select([self.master], [], [], 0)[0]:
            try:
                got = os.read(self.master, 65536)
            except OSError:  # the program has ended
                break
            if not got:
                break
            self.raw += got
            self.seen += got
        self.take()
        return "\n".join("".join(line).rstrip() for line in self.cells)

    def shows(self, condition, seconds):
        """Whether the screen shows it within that time; then what it shows."""
        end = time.monotonic() + seconds
        while time.monotonic() < end:
            text = self.text()
            if condition(text) if callable(condition) else condition in text:
                return text
            time.sleep(0.02)
        return None

    def end(self, seconds):
        """The exit status."""
        end = time.monotonic() + seconds
        while self.process.poll() is None and time.monotonic() < end:
            self.text()
            time.sleep(0.02)
        return self.process.poll()

    def hang_up(self):
        os.close(self.master)
        self.master = None

    def close(self):
        if self.process.poll() is None:
            self.process.kill()
        self.process.wait()
        self.process.stderr.close()
        if self.master is not None:
            os.close(self.master)

    # ---- what a terminal does

    def take(self):
        while self.raw:
            if self.raw[0] == 0x1B:
                found = SEQUENCE.match(self.raw)
                if not found:
                    if len(self.raw) < 32:
                        return  # the rest comes
                    self.raw = self.raw[1:]
                    continue
                self.raw = self.raw[found.end():]
                if len(found.group()) == 2:
                    self.escape(found.group()[1:].decode())
                if found.group(3) and not found.group(1):
                    self.control(found.group(3).decode(), [int(n or 0) for n in found.group(2).split(b";")])
                continue
            size = 1 if self.raw[0] < 0x80 else 2 if self.raw[0] < 0xE0 else 3 if self.raw[0] < 0xF0 else 4
            if len(self.raw) < size:
                return
            self.character(self.raw[:size].decode("utf-8", "replace"))
            self.raw = self.raw[size:]

    def character(self, char):
        if char == "\r":
            self.column = 0
        elif char == "\n":
            self.down()
        elif char == "\b":
            self.column = max(self.column - 1, 0)
        elif char == "\t":
            self.column = min(self.column // 8 * 8 + 8, self.columns - 1)
        elif char >= " ":
            if self.row < self.rows and self.column < self.columns:
                self.cells[self.row][self.column] = char
            self.column += 1
            self.last = char

    def scroll(self, first, count):
        """Moves the lines from `first` to the end of those that scroll: up, or down if `count` is negative."""
        for _ in range(abs(count)):
            del self.cells[first if count > 0 else self.bottom]
            self.cells.insert(self.bottom if count > 0 else first, [" "] * self.columns)

    def down(self):
        if self.row == self.bottom:
            self.scroll(self.top, 1)
        else:
            self.row = min(self.row + 1, self.rows - 1)

    def escape(self, letter):
        if letter == "M":
            if self.row == self.top:
                self.scroll(self.top, -1)
            else:
                self.row = max(self.row - 1, 0)
        elif letter == "D":
            self.down()
        elif letter == "7":
            self.saved = (self.row, self.column)
        elif letter == "8":
            self.row, self.column = self.saved

    def control(self, letter, numbers):
        first = numbers[0]
        count = max(first, 1)
        if letter in "Hf":
            self.row = min(max(first, 1), self.rows) - 1
            self.column = min(max(numbers[1] if len(numbers) > 1 else 1, 1), self.columns) - 1
        elif letter in "ABCD":
            self.row = min(max(self.row + {"A": -count, "B": count}.get(letter, 0), 0), self.rows - 1)
            self.column = min(max(self.column + {"C": count, "D": -count}.get(letter, 0), 0), self.columns - 1)
        elif letter == "d":
            self.row = min(count, self.rows) - 1
        elif letter == "G":
            self.column = min(count, self.columns) - 1
        elif letter == "J":
            for row in range(self.rows):
                for column in range(self.columns):
                    after = (row, column) >= (self.row, self.column)
                    if first == 2 or after == (first == 0):
                        self.cells[row][column] = " "
        elif letter == "K":
            begin = self.column if first == 0 else 0
            end = self.column + 1 if first == 1 else self.columns
            self.cells[self.row][begin:end] = [" "] * (end - begin)
        elif letter == "X":
            end = min(self.column + count, self.columns)
            self.cells[self.row][self.column:end] = [" "] * (end - self.column)
        elif letter == "b":
            for _ in range(count):
                self.character(self.last)
        elif letter == "P":
            line = self.cells[self.row]
            self.cells[self.row] = (line[:self.column] + line[self.column + count:] + [" "] * count)[:self.columns]
        elif letter == "@":
            line = self.cells[self.row]
            self.cells[self.row] = (line[:self.column] + [" "] * count + line[self.column:])[:self.columns]
        elif letter in "LM":
            self.scroll(self.row, count if letter == "M" else -count)
        elif letter in "ST":
            self.scroll(self.top, count if letter == "S" else -count)
        elif letter == "Z":
            for _ in range(count):
                self.column = (self.column - 1) // 8 * 8 if self.column else 0
        elif letter == "r":
            self.top = max(first, 1) - 1
            self.bottom = min(numbers[1] if len(numbers) > 1 and numbers[1] else self.rows, self.rows) - 1
            self.row = self.column = 0
