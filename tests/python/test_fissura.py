#!/usr/bin/python3
"""The Python module: the same runs as the command line's, views that cannot be written and outlive their run.

    PYTHONPATH=build/python tests/python/test_fissura.py build/fissura
"""
import gc
import json
import os
import subprocess
import sys
import tempfile
import threading
import unittest
import weakref

import numpy as np

import fissura

PROGRAM = None
TIE = {
    "title": "tie",
    "mesh": {"box": [{"from": ["0 m", "0 m", "0 m"], "to": ["600 mm", "100 mm", "100 mm"], "cells": [6, 2, 2]}]},
    "concrete": [{"name": "C30/37", "preset": "mc2010", "f_ck": "30 MPa"}],
    "steel": [{"name": "B500", "f_y": "500 MPa", "f_u": "550 MPa"}],
    "bar": [{"name": "bar", "steel": "B500", "diameter": "12 mm",
             "points": [["0 m", "40 mm", "45 mm"], ["600 mm", "40 mm", "45 mm"]]}],
    "support": [{"name": "left", "where": {"plane": "x", "at": "0 m"}, "fix": ["x", "y", "z"]}],
    "motion": [{"name": "pull", "where": {"plane": "x", "at": "600 mm"}, "axis": "x",
                "velocity": {"value": "0.5 m/s", "over": "0.3 ms"}}],
    "gauge": [{"name": "force", "kind": "reaction", "of": ["pull"], "axis": "x"}],
    "run": {"end_time": "0.8 ms", "threads": 1},
    "output": {"history_points": 50, "frames": 2},
}


def tie(**changes):
    return fissura.open(TIE, set={f"run.{k}": v for k, v in changes.items()})


class Runs(unittest.TestCase):
    def test_same_bits_as_the_command_line(self):
        """A case from a file or a dictionary, stepped in pieces on any threads, ends in the state of the command line."""
        with tempfile.TemporaryDirectory() as folder:
            deck = os.path.join(folder, "case.toml")
            with open(deck, "w", encoding="utf-8") as file:
                file.write(fissura.deck.text(TIE))
            out = os.path.join(folder, "cli")
            subprocess.run([PROGRAM, "run", deck, "--out", out, "--quiet"], check=True)
            with open(os.path.join(out, "run.json"), encoding="utf-8") as file:
                expected = json.load(file)
            self.assertGreater(expected["joints_damaged"], 0)
            run = fissura.open(deck, threads=2)
            while run.step(7):
                pass
            self.assertEqual(run.state_hash, expected["state_hash"])
            self.assertEqual(run.status, "complete")
            summary = fissura.open(TIE).run()
            self.assertEqual(summary["state_hash"], expected["state_hash"])
            self.assertEqual(summary["energy"], expected["energy"])
            rows = np.genfromtxt(os.path.join(out, "history.csv"), delimiter=",", skip_header=1)
            np.testing.assert_array_equal(run.history["force"], rows[:, 1])
            np.testing.assert_array_equal(run.history["time"], rows[:, 0])
            self.assertEqual(run.history.units["force"], "N")

    def test_run_folder(self):
        """With `out` the same folder is written as by the command line, and none is overwritten."""
        with tempfile.TemporaryDirectory() as folder:
            out = os.path.join(folder, "run")
            with fissura.open(TIE, out=out) as run:
                run.run_until("0.4 ms")
                self.assertAlmostEqual(run.time, 4e-4, delta=run.dt)
                self.assertEqual(run.status, "running")
            self.assertEqual(run.status, "stopped")
            self.assertFalse(run.step())
            for name in ("run.json", "history.csv", "fields.pvd", "case.toml", "log.txt"):
                self.assertTrue(os.path.exists(os.path.join(out, name)), name)
            with self.assertRaises(fissura.FileError):
                fissura.open(TIE, out=out)

    def test_numbers_of_steps_and_times(self):
        """Nothing to do is done at once; numbers without meaning are refused, naming the argument, and change nothing."""
        run = tie()
        self.assertTrue(run.step(0))
        self.assertTrue(run.run_until(0))
        self.assertTrue(run.run_until("0 ms"))
        self.assertEqual((run.steps, run.time), (0, 0))
        self.assertTrue(run.step(3.0))
        self.assertTrue(run.step(np.int64(2)))
        self.assertTrue(run.run_until(run.time / 2), "it has been there already")
        for bad in (-1, 2.5, float("nan"), float("inf"), -float("inf"), "3", 2**70):
            with self.assertRaisesRegex(fissura.InputError, "`steps` must be a whole number from 0 to"):
                run.step(bad)
        for bad in (-1, -1e-9, float("nan"), float("inf"), "-1 ms"):
            with self.assertRaisesRegex(fissura.InputError, "`time` must be 0 s or more"):
                run.run_until(bad)
        self.assertEqual(run.steps, 5)
        for bad in (-1, 1025, 1.5, float("nan"), 10**30):
            with self.assertRaisesRegex(fissura.InputError, "`threads` must be a whole number from 0 to 1024"):
                fissura.open(TIE, threads=bad)

    def test_one_run_at_a_time(self):
        """A folder in which a run is at work is refused to another one, from Python or the command line, until it is closed;
        `force` clears run folders only."""
        with tempfile.TemporaryDirectory() as folder:
            out = os.path.join(folder, "run")
            run = fissura.open(TIE, out=out)
            run.step(20)
            with self.assertRaisesRegex(fissura.FileError, "is in use by process"):
                fissura.open(TIE, out=out, force=True)
            done = subprocess.run([PROGRAM, "run", os.path.join(out, "case.toml"), "--out", out, "--force"], capture_output=True, text=True)
            self.assertEqual(done.returncode, 3, done.stderr)
            run.close()
            self.assertFalse(os.path.exists(os.path.join(out, ".lock")))
            fissura.open(TIE, out=out, force=True).run()
            with self.assertRaisesRegex(fissura.FileError, "--force does not clear"):
                fissura.open(TIE, out=folder, force=True)

    def test_another_working_folder(self):
        """A run goes on writing into its folder when the program goes elsewhere."""
        before = os.getcwd()
        with tempfile.TemporaryDirectory() as folder:
            try:
                os.chdir(folder)
                run = fissura.open(TIE, out="run")
                os.chdir("/")
                run.run()
            finally:
                os.chdir(before)
            self.assertTrue(os.path.exists(os.path.join(folder, "run", "run.json")))

    def test_steered_runs_are_not_gone_on_with(self):
        """The deck does not know of changed loads: the command line refuses to go on from there."""
        with tempfile.TemporaryDirectory() as folder:
            out = os.path.join(folder, "run")
            with fissura.open(TIE, out=out) as run:
                run.step(10)
                run.change("pull", velocity="0.1 m/s")
                run.step(10)
            done = subprocess.run([PROGRAM, "run", os.path.join(out, "case.toml"), "--restart", out], capture_output=True, text=True)
            self.assertEqual(done.returncode, 2, done.stderr)
            self.assertIn("a program has changed a load in mid-run", done.stderr)

    def test_changing_loads(self):
        """A load that is changed between steps goes on without a jump; what is no load is refused."""
        run = tie()
        run.run_until(4e-4)
        before = run.view("v")[..., 0].max()
        run.change("pull", velocity={"value": "0 m/s", "over": "0.2 ms"})
        run.step()
        self.assertAlmostEqual(run.view("v")[..., 0].max(), before, delta=0.05)
        run.run()
        self.assertLess(abs(run.summary["energy_residual"]), 0.01)
        run = tie()
        for name, curve, words in (("push", {"velocity": "1 m/s"}, "there are: `pull`"),
                                   ("pull", {"force": "1 N"}, "give `displacement` or `velocity`"),
                                   ("pull", {"velocity": "1 m"}, "m is not a velocity"),
                                   ("pull", {"speed": "1 m/s"}, "a load has no `speed`")):
            with self.assertRaisesRegex(fissura.InputError, words):
                run.change(name, **curve)

    def test_failure(self):
        """A run that fails raises RunError with its reason."""
        run = fissura.open(TIE, set={"run.dt": "5 us"})
        with self.assertRaises(fissura.RunError):
            run.run()
        self.assertEqual(run.status, "failed")

    def test_faulty_cases(self):
        """Every finding is told with the line that was made of the dictionary."""
        case = dict(TIE, concrete=[{"E": "30 N", "f_t": "3 MPa", "f_c": "30 MPa"}],
                    support=[{"where": {"plane": "x", "at": "0 m"}, "fixx": ["x"]}])
        with self.assertRaises(fissura.InputError) as caught:
            fissura.check(case)
        text = str(caught.exception)
        self.assertIn('N is not a pressure', text)
        self.assertIn('    E = "30 N"', text)
        self.assertIn("did you mean `fix`?", text)
        self.assertEqual(len(caught.exception.findings), 3)
        with self.assertRaises(fissura.InputError):
            fissura.open("nowhere.toml")
        with self.assertRaises(TypeError):
            fissura.check({"title": object()})

    def test_other_python_threads_go_on(self):
        """Stepping lets other threads of Python work, and two runs stepped at once do not disturb each other."""
        expected = tie().run()["state_hash"]
        runs = [tie(), tie()]
        threads = [threading.Thread(target=run.run) for run in runs]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        self.assertEqual([run.state_hash for run in runs], [expected, expected])


class Arrays(unittest.TestCase):
    def test_views_show_the_run_and_refuse_writing(self):
        """A view follows the run without a copy; it cannot be written, nor made writable."""
        run = tie()
        self.assertEqual(set(fissura.views()), {
            "u", "v", "position", "joint_status", "element_stress", "joint_stress", "joint_strain",
            "slip", "normalised_slip", "dowel_force", "reaction"})
        views = {name: run.view(name) for name in fissura.views()}
        self.assertEqual(views["u"].shape, (run.tets, 4, 3))
        self.assertEqual(views["u"].strides, (96, 24, 8))
        self.assertEqual(views["u"].max(), 0)
        run.run()
        self.assertGreater(views["u"].max(), 1e-4)
        self.assertEqual((views["joint_status"] > 0).sum(), run.summary["joints_damaged"])
        self.assertGreater(views["element_stress"].max(), 1e6)
        for name, view in views.items():
            self.assertFalse(view.flags.writeable, name)
            self.assertFalse(view.flags.owndata, name)
            with self.assertRaises(ValueError):
                view[...] = 0
            with self.assertRaises(ValueError):
                view.setflags(write=True)
            with self.assertRaises(ValueError):
                view.flags.writeable = True
        with self.assertRaisesRegex(fissura.InputError, "there is no view `uu`"):
            run.view("uu")

    def test_views_outlive_the_run(self):
        """A view keeps the memory of its run alive after the run object is gone, and lets it go in the end."""
        run = tie()
        run.run()
        core = weakref.ref(run)
        u, position = run.view("u"), run.view("position")
        copy = u.copy()
        part = u[3:9, :, 0]
        del run
        gc.collect()
        self.assertIsNone(core(), "the run object itself is gone")
        others = [tie() for _ in range(3)]  # new memory where the old one would have been
        del others
        gc.collect()
        np.testing.assert_array_equal(u, copy)
        del u
        gc.collect()
        np.testing.assert_array_equal(part, copy[3:9, :, 0])
        self.assertTrue(np.isfinite(position).all())
        del part, position
        gc.collect()

    def test_runs_may_end_in_any_order(self):
        """Runs with their own threads are dropped while others go on."""
        first, second, third = (fissura.open(TIE, threads=2) for _ in range(3))
        first.step(5), second.step(5)
        del first
        gc.collect()
        self.assertTrue(second.step(5))
        del third
        gc.collect()
        second.run()

    def test_fields_are_copies_in_input_order(self):
        """A field has a row per tet in the order of the input's numbers; changing it changes nothing."""
        run = tie()
        run.run()
        ids = run.field("input_id")
        self.assertTrue((np.diff(ids) > 0).all())
        u = run.field("displacement")
        self.assertEqual(u.shape, (run.tets, 4, 3))
        x = run.field("position")
        self.assertAlmostEqual(x.max(), 0.6)
        at_left = np.isclose(x[..., 0], 0)
        self.assertEqual(np.abs(u[at_left]).max(), 0)
        np.testing.assert_array_equal(np.sort(u, axis=None), np.sort(run.view("u"), axis=None))
        u[...] = 7
        self.assertLess(run.view("u").max(), 1)
        self.assertEqual(run.field("stress").shape, (run.tets, 6))
        self.assertEqual(run.field("fragment").min(), 0)
        self.assertEqual(run.field("kappa").shape, (run.joints, 3))
        damaged = run.view("joint_status") > 0
        self.assertGreater(run.field("kappa")[damaged].max(), 0.5)
        self.assertEqual(run.field("kappa")[~damaged].max(), 0)
        failed = run.field("time_of_failure")
        self.assertEqual((failed > 0).sum(), (run.view("joint_status") >= 2).sum())
        with self.assertRaisesRegex(fissura.InputError, "there is no field `strain`"):
            run.field("strain")

    def test_cracks_and_bars(self):
        """The arrays of the frames: one triangle per damaged joint, elements and joints of the bars."""
        run = tie()
        run.run()
        cracks, bars = run.cracks, run.bars
        self.assertEqual(len(cracks["opening"]), run.summary["joints_damaged"])
        self.assertEqual(cracks["points"].shape, (3 * len(cracks["opening"]), 3))
        self.assertEqual(len(bars["stress"]), run.summary["bar_elements"] + run.summary["bar_joints"])


class Cases(unittest.TestCase):
    def test_templates(self):
        """All templates are there, are written once, and pass the check."""
        with tempfile.TemporaryDirectory() as folder:
            path = fissura.new("block", os.path.join(folder, "a"))
            self.assertIn("tets            768", fissura.check(path))
            with self.assertRaises(FileExistsError):
                fissura.new("block", os.path.join(folder, "a"))
        self.assertEqual(set(fissura.templates()), {"beam", "block", "column", "slab_impact", "tie", "wall_panel"})

    def test_dictionaries_are_decks(self):
        """A dictionary and its deck are the same case, whatever stands in its texts."""
        case = dict(TIE, title='a "quoted" title with \\ and \u00e4 and \U0001f9f1')
        self.assertIn("a \\\"quoted\\\" title", fissura.deck.text(case))
        self.assertEqual(fissura.echo(case).count("[[bar]]"), 1)
        with_numpy = dict(TIE, mesh={"box": [dict(TIE["mesh"]["box"][0], cells=np.array([6, 2, 2]))]})
        self.assertEqual(fissura.echo(with_numpy), fissura.echo(TIE))

    def test_keyboard_interrupt(self):
        """Ctrl-C reaches a run that is stepped from Python, and the run can go on afterwards."""
        import _thread
        run = fissura.open(TIE, set={"run.end_time": "1 s"})
        timer = threading.Timer(0.3, _thread.interrupt_main)
        timer.start()
        with self.assertRaises(KeyboardInterrupt):
            run.run()
        self.assertEqual(run.status, "running")
        self.assertTrue(run.step())


if __name__ == "__main__":
    PROGRAM = sys.argv.pop(1) if len(sys.argv) > 1 and not sys.argv[1].startswith("-") else "fissura"
    unittest.main()
