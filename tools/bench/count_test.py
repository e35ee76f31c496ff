#!/usr/bin/env python3
"""The rules of count.py: what is a failure, and where; and which compilers of others are counted, and how."""
import os
import tempfile
import unittest
from pathlib import Path
from unittest import mock

import count
import peers
import report
import services
from callgrind import Failure

HERE = {"compiler": "1"}
TABLE = {"environment": HERE, "instructions": {"a": 1000, "b": 2000}}


def fails(counts, here=None, pinned_only=False):
    return count.verdict(counts, TABLE, here or HERE, pinned_only)[1]


class Verdict(unittest.TestCase):
    def test_the_same_and_fewer_pass(self):
        self.assertFalse(fails({"a": 1000, "b": 1500}))

    def test_one_percent_more_passes_and_beyond_it_fails(self):
        self.assertFalse(fails({"a": 1010}))
        self.assertTrue(fails({"a": 1011}))

    def test_a_missing_count_fails(self):
        self.assertTrue(fails({"c": 1}))
        self.assertTrue(fails({"c": 1}, pinned_only=True))

    def test_elsewhere_growth_is_reported_and_does_not_fail(self):
        lines, failed = count.verdict({"a": 5000}, TABLE, {"compiler": "2"}, False)
        self.assertFalse(failed)
        self.assertIn("a: 1000 before, 5000 now", lines)

    def test_where_it_must_be_pinned_another_environment_fails(self):
        self.assertTrue(fails({"a": 1000}, {"compiler": "2"}, pinned_only=True))
        self.assertFalse(fails({"a": 1000}, pinned_only=True))


class Services(unittest.TestCase):
    def rows(self, more):
        return {services.WITHOUT: (10, 1000, 0), f"{services.ALL}; idle": (20, 1000 + more, 0)}

    def test_idle_services_add_two_hundred_instructions_at_most(self):
        self.assertEqual(services.excess(self.rows(200)), "")
        self.assertIn("add 201 instructions", services.excess(self.rows(201)))


class PeersFolder(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name).resolve()
        environment = mock.patch.dict(os.environ, {"PEERS_DIR": str(self.folder)})
        environment.start()
        self.addCleanup(environment.stop)

    def executable(self, path, text):
        path.parent.mkdir(parents=True)
        path.write_text(f"#!/bin/sh\n{text}\n", encoding="ascii")
        path.chmod(0o755)
        return path

    def test_without_it_there_are_none(self):
        del os.environ["PEERS_DIR"]
        self.assertEqual(peers.versions(), {})
        self.assertEqual(peers.Peers("/nowhere", self.folder).forms("bits", 100), {})

    def test_only_those_that_are_there_are_named(self):
        (self.folder / "matiec").mkdir()
        self.assertEqual(peers.named(), {peers.Matiec: self.folder / "matiec"})
        self.assertEqual(peers.versions(), {"matiec": "of an unknown version"})

    def test_a_folder_without_any_is_a_failure(self):
        with self.assertRaisesRegex(Failure, "none of the folders matiec, strucpp"):
            peers.named()

    def test_one_that_cannot_be_run_is_a_failure_with_its_text(self):
        generated = self.executable(self.folder / "bin" / "generated", "echo text")
        self.executable(self.folder / "matiec" / "iec2c", "echo no such function >&2; exit 1")
        with self.assertRaisesRegex(Failure, "no such function"):
            peers.Peers(generated, self.folder).forms("bits", 100)

    def test_one_that_is_not_there_is_a_failure_that_names_it(self):
        generated = self.executable(self.folder / "bin" / "generated", "echo text")
        (self.folder / "matiec").mkdir()
        with self.assertRaisesRegex(Failure, "matiec/iec2c"):
            peers.Peers(generated, self.folder).forms("bits", 100)

    def test_what_their_languages_lack_is_left_out(self):
        (self.folder / "matiec").mkdir()
        self.assertEqual(peers.Peers("/nowhere", self.folder).forms("mechanisms", 100), {})
        self.assertEqual(peers.Peers("/nowhere", self.folder).forms("bits", 10_000), {})


class PeersTable(unittest.TestCase):
    def row(self, ours, of_peers):
        return {"ours": ours, "rungs": ours - 10, "straight": {("byte", "g++"): 500}, "peers": of_peers}

    def test_the_compiler_with_fewer_instructions_counts(self):
        rows = {("nct", "bits", 100): None,
                ("gsk", "bits", 100): self.row(900, {"matiec, gcc": 2000, "matiec, clang": 1800, "STruC++, g++": 1}),
                ("technol", "bits", 100): self.row(450, {"matiec, gcc": 1000, "matiec, clang": 900})}
        self.assertIn("| 100 × bit logic | – | 900 | 450 | 500 | 1,800 | clang | – | 0.50 | 0.50 |",
                      report.peers_text(rows, {"matiec": "abc"}).splitlines())

    def test_small_ratios_keep_two_digits(self):
        rows = {(dialect, "bits", 100): self.row(820, {"ClassicLadder, gcc": 281222}) for dialect in report.DIALECTS}
        self.assertIn("| 281,222 | gcc | 0.0029 | 0.0029 | 0.0029 |", report.peers_text(rows, {"ClassicLadder": "abc"}))

    def test_each_is_counted_with_the_kinds_that_it_has(self):
        self.assertEqual(peers.ClassicLadder.kinds, ("bits",))
        self.assertFalse([kind for peer in peers.KNOWN for kind in peer.kinds if kind not in report.TITLES])

    def test_without_peers_there_is_no_table(self):
        rows = {(dialect, "bits", 100): self.row(900, {}) for dialect in report.DIALECTS}
        self.assertEqual(report.peers_text(rows, {}), "")


if __name__ == "__main__":
    unittest.main()
