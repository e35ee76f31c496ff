#!/usr/bin/env python3
"""Every kind of change to the headers is found: abi_test.py"""
import tempfile
import unittest
import unittest.mock
from pathlib import Path

import abi

VERSION = "RUNG_API uint32_t rung_runtime_version(void);"
# Header, what of it is replaced, by what, and where that shows.
CHANGES = [
    ("rung/runtime.h", VERSION, "", "librung-runtime.so.0"),
    ("rung/runtime.h", VERSION, VERSION.replace("uint32_t", "uint64_t"), "librung-runtime.so.0"),
    ("rung/runtime.h", VERSION, VERSION + "\nRUNG_API int32_t rung_instance_more(void);", "librung-runtime.so.0"),
    ("rung/runtime.h", "  uint64_t failed_saves;", "  uint64_t failed_saves, more;", "librung-runtime.so.0"),
    ("rung/runtime.h", "RUNG_EMPTY = 1,", "RUNG_EMPTY = 7,", "rung-values.so"),
    ("rung/runtime.h", "RUNG_EMPTY = 1,", "RUNG_EMPTY = 1, RUNG_MORE = 9,", "rung-values.so"),
    ("rung/runtime.h", "RUNG_MOST_WATCHES 16u", "RUNG_MOST_WATCHES 17u", "rung-values.so"),
    ("rung/program.h", "RUNG_ABI_VERSION 7u", "RUNG_ABI_VERSION 8u", "rung-values.so"),
    ("rung/program.h", "  uint32_t memory_align;", "  uint32_t memory_align, more;", "rung-values.so"),
    ("rung/compiler.h", "  const char* cache_folder;", "  const char *cache_folder, *more;", "librung-compiler.so.0"),
]


class Changes(unittest.TestCase):
    def test_are_found(self):
        for header, former, now, where in CHANGES:
            with self.subTest(now or former), tempfile.TemporaryDirectory() as temporary:
                folder = Path(temporary)
                (folder / "rung").mkdir()
                for name in abi.HEADERS:
                    (folder / name).write_text(abi.path_of(name).read_text())
                text = (folder / header).read_text()
                self.assertEqual(text.count(former), 1)
                (folder / header).write_text(text.replace(former, now))
                with unittest.mock.patch.object(abi, "INCLUDES", [folder]):
                    found = {stand_in.name for stand_in in abi.stand_ins(folder) if abi.difference(stand_in)}
                self.assertIn(where, found)


if __name__ == "__main__":
    unittest.main()
