#!/usr/bin/env python3
"""The rules of count.py: what is a failure, and where."""
import unittest

import count
import services

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
        return {services.WITHOUT: (10, 1000, 0), f"{services.ALL}; at rest": (20, 1000 + more, 0)}

    def test_at_rest_they_add_two_hundred_instructions_at_most(self):
        self.assertEqual(services.excess(self.rows(200)), "")
        self.assertIn("add 201 instructions", services.excess(self.rows(201)))


if __name__ == "__main__":
    unittest.main()
