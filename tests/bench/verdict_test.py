#!/usr/bin/env python3
"""The judgement of delays: limits at, below and above."""

import pathlib
import sys
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
from verdict import judge  # noqa: E402


class Judge(unittest.TestCase):
    def test_reached_up_to_the_target(self):
        self.assertEqual(judge(20, 15, 20), "0.75 reached")
        self.assertEqual(judge(20, 22, 20), "1.10 reached")
        self.assertEqual(judge(20, 22.2, 20), "1.11 missed")

    def test_the_peer_is_the_mean_of_both_series(self):
        self.assertEqual(judge(100, 105, 110), "1.00 reached")
        self.assertEqual(judge(110, 105, 100), "1.00 reached")
        self.assertEqual(judge(110, 116, 100), "1.10 missed")

    def test_no_verdict_where_the_peer_does_not_agree_with_itself(self):
        self.assertEqual(judge(100, 300, 110.1), "no verdict (100.0, 110.1)")
        self.assertEqual(judge(200, 100, 100), "no verdict (200.0, 100.0)")
        self.assertEqual(judge(0, 1, 0), "no verdict (0.0, 0.0)")


if __name__ == "__main__":
    unittest.main()
