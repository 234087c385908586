#!/usr/bin/python3
"""The commands that look at a run meet damaged and hostile run folders. Each test states its requirement.

    damaged_test.py build/fissura
"""
import base64
import json
import os
import re
import shutil
import struct
import subprocess
import sys
import tempfile
import unittest
import zlib
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(Path(__file__).resolve().parent))
from small_run import change_summary, make_run, put_markup

PROGRAM = str(Path(sys.argv.pop(1)).resolve()) if len(sys.argv) > 1 else str(ROOT / "build/fissura")
ESCAPES = "\x1b[2J\x1b]0;owned\x07\x9b31m\u202e"

COMMANDS = {"report": ["report"], "watch": ["watch", "--once"], "plot": ["plot", "--y", "force", "--peak"], "compare": ["compare"],
            "picture": ["picture"]}
ALL = frozenset(COMMANDS)
DRAWN = frozenset({"report", "picture"})           # those that read frames
CURVES = frozenset({"plot", "compare"})            # those that need a row

DAMAGES = []


def damage(refused_by, said):
    """A kind of damage: a function of the copy of a good run folder; who must refuse it, and with which words."""
    def add(make):
        DAMAGES.append((make.__name__.replace("_", " "), make, refused_by, said))
        return make
    return add


def change(path, old, new, count=1):
    data = path.read_bytes()
    assert old in data, (path, old)
    path.write_bytes(data.replace(old, new, count))


def last(run, kind):
    return sorted((run / "frames").glob(f"{kind}_*"))[-1]


@damage(ALL, "no run folder (it holds neither history.csv nor run.json)")
def empty_folder(run):
    shutil.rmtree(run)
    run.mkdir()


@damage(ALL, "it is a file, no run folder")
def file_instead_of_a_folder(run):
    shutil.rmtree(run)
    run.write_text("time [s]\n")


@damage(ALL, "no such run folder")
def folder_that_is_a_link_to_itself(run):
    shutil.rmtree(run)
    run.symlink_to(run)


@damage(frozenset(), "")
def run_json_missing(run):
    (run / "run.json").unlink()


@damage(ALL, "run.json': no JSON object")
def run_json_empty(run):
    (run / "run.json").write_bytes(b"")


@damage(ALL, "run.json': no JSON object")
def run_json_truncated(run):
    data = (run / "run.json").read_bytes()
    (run / "run.json").write_bytes(data[:len(data) // 2])


@damage(ALL, "run.json': no JSON object")
def run_json_garbage(run):
    (run / "run.json").write_bytes(os.urandom(3000))


@damage(ALL, "run.json': no JSON object")
def run_json_a_list(run):
    (run / "run.json").write_text("[1, 2, 3]")


@damage(ALL, "run.json': its brackets stand too deep in each other")
def run_json_nested_deep(run):
    (run / "run.json").write_text('{"status": ' + "[" * 100000 + "]" * 100000 + "}")


@damage(ALL, "run.json': `status` is no text")
def run_json_status_a_number(run):
    change_summary(run, status=7)


@damage(ALL, "run.json': `title` is no text")
def run_json_title_a_list(run):
    change_summary(run, title=["a", "b"])


@damage(ALL, "run.json': `state_hash` is no text")
def run_json_hash_null(run):
    change_summary(run, state_hash=None)


@damage(ALL, "run.json': `steps` is no number")
def run_json_numbers_as_text(run):
    change_summary(run, wall_seconds="3.5", steps="many")


@damage(ALL, "run.json': `fragments.largest` is no list of pieces")
def run_json_fragments_without_pieces(run):
    change_summary(run, fragments={"count": 5, "mass": 1, "largest": []})


@damage(ALL, "run.json': it has no `status`")
def run_json_without_keys(run):
    (run / "run.json").write_text("{}")


@damage(frozenset(), "")
def run_json_huge_and_missing_numbers(run):
    change_summary(run, steps=1e300, wall_seconds=-1e300, force_imbalance=None, quasi_static_share=None, dt=5e-324)


@damage(ALL, "run.json': no JSON object")
def run_json_not_a_number(run):
    change(run / "run.json", b'"dt": ', b'"dt": NaN, "x": ')


@damage(ALL, "run.json': it is no file")
def run_json_a_folder(run):
    (run / "run.json").unlink()
    (run / "run.json").mkdir()


@damage(CURVES, "history.csv")
def history_missing(run):
    (run / "history.csv").unlink()


@damage(CURVES, "history.csv")
def history_of_no_bytes(run):
    (run / "history.csv").write_bytes(b"")


@damage(CURVES, "history.csv")
def history_with_a_header_only(run):
    text = (run / "history.csv").read_text()
    (run / "history.csv").write_text(text[:text.index("\n") + 1])


@damage(ALL, "history.csv': its first column is not `time`")
def history_without_its_first_column(run):
    lines = (run / "history.csv").read_text().splitlines()
    (run / "history.csv").write_text("".join(line.split(",", 1)[1] + "\n" for line in lines))


@damage(CURVES, "no ")
def history_without_its_gauges(run):
    lines = (run / "history.csv").read_text().splitlines()
    (run / "history.csv").write_text("".join(line.split(",")[0] + "\n" for line in lines))


@damage(ALL, "history.csv': line 4 has 2 values for ")
def history_with_ragged_rows(run):
    lines = (run / "history.csv").read_text().splitlines()
    lines[3] = "1e-5,2"
    (run / "history.csv").write_text("\n".join(lines) + "\n")


@damage(ALL, "history.csv': line 3: 'twelve")
def history_with_words(run):
    lines = (run / "history.csv").read_text().splitlines()
    lines[2] = "twelve" + ESCAPES + lines[2][lines[2].index(","):]
    (run / "history.csv").write_text("\n".join(lines) + "\n")


@damage(ALL, "history.csv'")
def history_binary(run):
    (run / "history.csv").write_bytes(b"\x00\xff\n" + os.urandom(5000) + b"\n")


@damage(frozenset(), "")
def history_of_numbers_that_are_none(run):
    lines = (run / "history.csv").read_text().splitlines()
    width = lines[0].count(",")
    rows = [f"{1e-5 * i}," + ",".join(["nan", "inf", "-inf", "1e308", "-1e308"][(i + k) % 5] for k in range(width)) for i in range(6)]
    (run / "history.csv").write_text("\n".join([lines[0], *rows]) + "\n")


@damage(ALL, "history.csv': it is no file")
def history_that_is_a_pipe(run):
    (run / "history.csv").unlink()
    os.mkfifo(run / "history.csv")


@damage(ALL, "history.csv'")
def history_that_is_a_link_to_itself(run):
    (run / "history.csv").unlink()
    (run / "history.csv").symlink_to("history.csv")


@damage(DRAWN, "fields_")
def frame_truncated(run):
    data = last(run, "fields").read_bytes()
    last(run, "fields").write_bytes(data[:len(data) // 2])


@damage(DRAWN, "bars_")
def frame_of_no_bytes(run):
    last(run, "bars").write_bytes(b"")


@damage(DRAWN, "cracks_")
def frame_with_damaged_blocks(run):
    data = bytearray(last(run, "cracks").read_bytes())
    start = data.index(b'<AppendedData encoding="raw">') + 60
    for i in range(start, len(data) - 60):
        data[i] ^= 0x5A
    last(run, "cracks").write_bytes(data)


@damage(DRAWN, "fields_")
def frame_of_text(run):
    text = base64.b64encode(os.urandom(3000))
    change(last(run, "fields"), b'encoding="raw">', b'encoding="base64">' + text)


@damage(DRAWN, "fields_")
def frame_with_a_wrong_number_of_values(run):
    path = last(run, "fields")
    path.write_bytes(re.sub(rb'NumberOfPoints="\d+"', b'NumberOfPoints="17"', path.read_bytes()))


@damage(DRAWN, "cracks_")
def frame_with_huge_sizes(run):
    path = last(run, "cracks")
    path.write_bytes(re.sub(rb'NumberOf(Points|Cells)="\d+"', b'NumberOf\\1="999999999999999999"', path.read_bytes()))


@damage(frozenset({"picture"}), "bars_")  # of an array that the report does not read
def frame_with_huge_blocks(run):
    path = last(run, "bars")
    data = path.read_bytes()
    start = data.index(b"_", data.index(b"<AppendedData")) + 1
    path.write_bytes(data[:start] + struct.pack("<3Q", 2 ** 40, 2 ** 26, 0) + data[start + 24:])


@damage(DRAWN, "fields_")
def frame_with_a_bomb(run):
    """A thousand times its size, for every array."""
    path = last(run, "fields")
    data = path.read_bytes()
    start = data.index(b"_", data.index(b"<AppendedData")) + 1
    block = zlib.compress(bytes(1 << 26), 9)
    head = re.sub(rb'offset="\d+"', b'offset="0"', data[:start])
    path.write_bytes(head + struct.pack("<11Q", 8, 1 << 26, 0, *[len(block)] * 8) + block * 8 + b"\n</AppendedData></VTKFile>")


@damage(DRAWN, "fields_")
def frame_without_displacement(run):
    path = last(run, "fields")
    change(path, b'Name="displacement"', b'Name="displacemen!"')
    change(path, b'Name="Points"', b'Name="Pointed"')


@damage(DRAWN, "fields_")
def frame_that_is_a_device(run):
    path = last(run, "fields")
    path.unlink()
    path.symlink_to("/dev/zero")


@damage(ALL, "fields.pvd")
def list_of_frames_truncated(run):
    data = (run / "fields.pvd").read_bytes()
    (run / "fields.pvd").write_bytes(data[:len(data) // 2])


@damage(DRAWN, "fields_99999.vtu")
def list_that_names_missing_files(run):
    path = run / "fields.pvd"
    path.write_bytes(re.sub(rb"fields_\d+", b"fields_99999", path.read_bytes()))


@damage(ALL, "fields.pvd': it names '../../../../../../etc/passwd', which does not lie in the run folder")
def list_that_names_files_outside(run):
    path = run / "fields.pvd"
    path.write_bytes(re.sub(rb'file="[^"]*"', b'file="../../../../../../etc/passwd"', path.read_bytes()))


@damage(ALL, "bars.pvd': it names '/etc/passwd', which does not lie in the run folder")
def list_that_names_files_from_the_root(run):
    path = run / "bars.pvd"
    path.write_bytes(re.sub(rb'file="[^"]*"', b'file="/etc/passwd"', path.read_bytes()))


@damage(ALL, "cracks.pvd': frame 1 has no time")
def list_without_times(run):
    path = run / "cracks.pvd"
    path.write_bytes(re.sub(rb'timestep="[^"]*"', b'timestep="nan"', path.read_bytes()))


@damage(DRAWN, "bars_")
def bars_that_are_tets(run):
    shutil.copy(last(run, "fields"), last(run, "bars"))


@damage(frozenset({"picture"}), "rigid.pvd")
def list_that_expands(run):
    """Entities that stand for each other a thousand million times."""
    lines = [f'<!ENTITY e{i} "{f"&e{i - 1};" * 10}">' for i in range(1, 10)]
    (run / "rigid.pvd").write_text('<?xml version="1.0"?><!DOCTYPE VTKFile [<!ENTITY e0 "ha">' + "".join(lines) + "]><VTKFile>&e9;</VTKFile>")


@damage(frozenset(), "")
def names_with_escape_sequences(run):
    """In deck, log, curve names, units, title and reason."""
    change_summary(run, title=ESCAPES + "title $\\frac", reason=ESCAPES, version=ESCAPES)
    text = (run / "history.csv").read_text()
    (run / "history.csv").write_text(text.replace("force [N]", f"force [N{ESCAPES}]").replace("reaction_left_x", f"left{ESCAPES}$_x", 1))
    (run / "log.txt").write_text(f"2026-01-31 12:00:00 {ESCAPES}: 1\n2026-01-31 12:00:00 warning: {ESCAPES}\n")
    deck = (run / "case.toml").read_text()
    (run / "case.toml").write_text(re.sub(r'title = "[^"]*"', 'title = "\\\\u001b[2Jdeck"', deck))


@damage(frozenset(), "")
def names_with_scripts(run):
    put_markup(run, "upper")


@damage(frozenset(), "")
def deck_and_log_garbage(run):
    (run / "case.toml").write_bytes(os.urandom(4000))
    (run / "log.txt").write_bytes(os.urandom(4000))


@damage(frozenset(), "")
def deck_nested_deep(run):
    (run / "case.toml").write_text("a = " + "[" * 200000)


class Damaged(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.scratch = tempfile.TemporaryDirectory()
        cls.folder = Path(cls.scratch.name)
        cls.good = make_run(PROGRAM, cls.folder)
        cls.has_page = "built without the report page" not in cls.look("report", cls.good)[2]

    @classmethod
    def tearDownClass(cls):
        cls.scratch.cleanup()

    @classmethod
    def look(cls, command, run):
        words = [str(cls.good)] if command == "compare" else []
        out = [] if command in ("watch", "compare") else ["-o", str(cls.folder / f"{Path(run).name}_{command}.{'html' if command == 'report' else 'png'}")]
        done = subprocess.run([PROGRAM, COMMANDS[command][0], *words, str(run), *COMMANDS[command][1:], *out], capture_output=True,
                              timeout=300, stdin=subprocess.DEVNULL)
        return done.returncode, done.stdout.decode("utf-8", "backslashreplace"), done.stderr.decode("utf-8", "backslashreplace")

    def complaints(self, kind, command, run, must_refuse, said):
        """What is wrong with the answer of a command."""
        code, out, err = self.look(command, run)
        wrong = []
        differs = command == "compare" and code == 1 and out.rstrip().endswith("differ")
        if code not in (0, 2, 3) and not differs:
            wrong.append(f"exit code {code}")
        for word in ("Traceback", "internal error", "terminate called", "out of memory"):
            if word in out + err:
                wrong.append(f"says '{word}'")
        if len(err.splitlines()) > 3 or len(err) > 1500:
            wrong.append("says too much")
        if code in (2, 3) and not err.strip():
            wrong.append("says nothing")
        if re.search(r"[\x00-\x08\x0b-\x1f\x7f-\x9f\u202e]", out + err):
            wrong.append("commands the terminal")
        if must_refuse and (self.has_page or command != "report"):
            if code not in (2, 3):
                wrong.append(f"is not refused (exit code {code})")
            if said not in err:
                wrong.append(f"does not say '{said}'")
        elif not must_refuse and code not in (0,) and not differs and (self.has_page or command != "report"):
            wrong.append(f"is refused (exit code {code})")
        return [f"{kind}: {command}: {w}: {out[-200:]!r} {err[-600:]!r}" for w in wrong]

    def test_every_command_meets_every_damage(self):
        """Whatever a run folder holds, each command answers with its result or with a plain line that names the file and the reason,
        and ends with 0, 2 or 3; never a traceback, an internal error or a character that commands the terminal."""
        tasks = []
        for number, (kind, make, refused_by, said) in enumerate(DAMAGES):
            run = self.folder / f"run_{number}"
            shutil.copytree(self.good, run, symlinks=True)
            make(run)
            for command in COMMANDS:
                tasks.append((kind, command, run, command in refused_by, said))
        with ThreadPoolExecutor(2) as pool:
            found = list(pool.map(lambda task: self.complaints(*task), tasks))
        self.assertGreater(len(DAMAGES), 40)
        self.maxDiff = None
        self.assertEqual([], [line for lines in found for line in lines])

    def test_hostile_folder_names(self):
        """A folder whose name holds escape sequences or line breaks is told by a name that commands nothing."""
        for name in (f"a{ESCAPES}", "b\nfissura: all is well", "c\r\x08"):
            run = self.folder / name
            code, out, err = self.look("watch", run)
            self.assertEqual(code, 3)
            self.assertRegex(err, r"^fissura: [ -~]*\n")
            shutil.copytree(self.good, run)
            for command in COMMANDS:
                code, out, err = self.look(command, run)
                self.assertIsNone(re.search(r"[\x00-\x08\x0b-\x1f\x7f-\x9f\u202e]", out + err), (command, out, err))

    def test_scripts_in_names_stay_text(self):
        """A page of a run whose title, reasons, names, log and deck hold markup has it only as text, packed away from the parser."""
        if not self.has_page:
            self.skipTest("built without the report page")
        run = self.folder / "scripts"
        shutil.copytree(self.good, run)
        names_with_scripts(run)
        code, out, err = self.look("report", run)
        self.assertEqual(code, 0, err)
        text = (self.folder / "scripts_report.html").read_text()
        self.assertNotIn("owned'</script>", text)
        self.assertNotIn("<img src=x", text)
        self.assertEqual(text.count("<script"), text.count("</script>"))
        self.assertIn("&lt;script&gt;", text[:text.index("<style>")])

    def test_check_and_run_command_no_terminal(self):
        """`check` and `run` refuse names and titles with escape sequences at their places, and show none of them."""
        deck = self.folder / "hostile.toml"
        text = (self.folder / "tie.toml").read_text()
        deck.write_text(text.replace('title = "frames"', 'title = "a\\u001b[2Jb"').replace("upper", "up\\u009b31mper"))
        for words in (["check", deck], ["run", deck, "--until", "1e-5", "--threads", "1", "--out", self.folder / "hostile"]):
            done = subprocess.run([PROGRAM, *map(str, words)], capture_output=True, timeout=300)
            self.assertEqual(done.returncode, 2, done.stderr)
            self.assertRegex(done.stderr.decode(), r"hostile.toml:2:9: error: .*control character")
            self.assertNotRegex(done.stdout.decode() + done.stderr.decode(), r"[\x00-\x08\x0b-\x1f\x7f-\x9f]")
        self.assertFalse((self.folder / "hostile").exists())


if __name__ == "__main__":
    unittest.main()
