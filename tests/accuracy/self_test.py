"""The ratchet itself: what it must refuse, and what it must let pass."""
import pathlib
import tempfile
import unittest

import accuracy
from accuracy import Record


class Ratchet(unittest.TestCase):
    WORST = {"width": Record("1e-11", "4e-12"), "edge": Record("2", "1.5")}

    def run_with(self, **changes):
        log = {**self.WORST, **changes}
        return accuracy.check({name: record for name, record in log.items() if record}, self.WORST)

    def test_what_is_recorded_passes(self):
        self.assertEqual(self.run_with(), [])
        self.assertEqual(self.run_with(width=Record("1e-11", "1e-15")), [])  # better today
        self.assertEqual(self.run_with(width=Record("0.1e-10", "9e-12")), [])  # worse, but allowed

    def test_a_slack_allowance_is_refused(self):
        worst = {"width": Record("1e-11", "1.2e-12")}
        self.assertIn("slack", accuracy.check({"width": Record("1e-11", "1e-12")}, worst)[0])
        exact = {"exact": Record("8e-16", "0")}  # eight roundings are never slack
        self.assertEqual(accuracy.check(exact, exact), [])
        exact = {"exact": Record("9e-16", "0")}
        self.assertIn("slack", accuracy.check(exact, exact)[0])

    def test_an_allowance_that_was_changed_is_refused(self):
        self.assertIn("recorded is 2", self.run_with(edge=Record("3", "1.5"))[0])

    def test_a_name_that_is_gone_or_new_is_refused(self):
        self.assertIn("was not observed", self.run_with(edge=None)[0])
        self.assertIn("is new", self.run_with(other=Record("1", "1"))[0])

    def test_the_worst_of_several_processes_counts(self):
        with tempfile.TemporaryDirectory() as directory:
            log = pathlib.Path(directory) / "log"
            log.write_text("width,1e-11,1e-12\nwidth,1e-11,3e-12\nwidth,1e-11,2e-12\n")
            records, complaints = accuracy.read(log)
            self.assertEqual((records, complaints), ({"width": Record("1e-11", "3e-12")}, []))
            log.write_text("width,1e-11,1e-12\nwidth,1e-10,1e-12\n")
            self.assertIn("two allowances", accuracy.read(log)[1][0])

    def test_records_only_grow_and_read_back(self):
        log = {"width": Record("5e-12", "1e-12"), "new": Record("1", "0.3")}
        merged = accuracy.merged(log, self.WORST)
        self.assertEqual(merged, {"new": Record("1", "0.3"), "width": Record("5e-12", "4e-12")})
        with tempfile.TemporaryDirectory() as directory:
            path = pathlib.Path(directory) / "worst.csv"
            accuracy.write(merged, path)
            self.assertEqual(accuracy.read(path), (merged, []))


if __name__ == "__main__":
    unittest.main()
