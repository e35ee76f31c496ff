#!/usr/bin/env python3
"""The text of a host's runtime without signal tables, by the linker's map of tests/size/minimal_host.cpp: size_test.py MAP

Prints what each archive brings, in bytes: code, constants and exception tables; not the strings, which the linker merges with
those of the tables."""
import collections
import re
import sys
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
MAP = None
# docs/architecture.md states it.
MOST = 250_000
ARCHIVES = ("rung_core", "rung_rtlib", "rung_nc_names", "rung_nc_control")
TEXT = (".text", ".rodata", ".eh_frame", ".gcc_except_table")


def sections(text):
    """(archive, object, section, bytes) of the input sections of archives."""
    for line in text.splitlines():
        found = re.match(r"\s*[0-9a-f]+\s+[0-9a-f]+\s+([0-9a-f]+)\s+\d+\s+\S*?lib(\w+)\.a\((\S+)\):\((\S+?)\)", line)
        if found:
            size, archive, member, section = found.groups()
            yield archive, member, section, int(size, 16)


class Size(unittest.TestCase):
    def test_the_runtime_without_tables_is_small(self):
        sizes = collections.Counter()
        files = collections.Counter()
        for archive, member, section, size in sections(Path(MAP).read_text()):
            if section.startswith(TEXT):
                sizes[archive] += size
                files[archive, member] += size
        for archive in ARCHIVES:
            print(f"{archive:16} {sizes[archive]:7}")
            self.assertGreater(sizes[archive], 0, "the map names no file of it")
            for (owner, member), size in files.most_common():
                if owner == archive and size > 4000:
                    print(f"    {member:32} {size:6}")
        total = sum(sizes[archive] for archive in ARCHIVES)
        print(f"{'sum':16} {total:7}, at most {MOST}; tables and lists of rung_nc: {sizes['rung_nc']}")
        self.assertLessEqual(total, MOST, "the runtime has grown")
        self.assertGreater(total, MOST * 0.9, "it has become smaller: lower MOST, and the figure in docs/architecture.md")

    def test_the_figure_of_the_docs(self):
        self.assertTrue(f"less than {MOST // 1000} kB" in (ROOT / "docs/architecture.md").read_text(), "docs/architecture.md states another size")


if __name__ == "__main__":
    MAP = sys.argv.pop(1)
    unittest.main()
