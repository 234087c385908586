"""Fissura from Python: how reinforced concrete cracks, slips, yields and falls apart.

    import fissura

    run = fissura.open("case.toml")            # or a dictionary with the keys of the deck
    while run.step(1000):                      # a thousand time steps; False once the run has ended
        print(run.time, run.history["force"][-1])
    run.field("stress")                        # a copy, one row per tet in the order of the input
    run.view("u")                              # the displacements themselves: read-only, no copy

Names are those of the deck and of the glossary; numbers are in SI units, texts carry their unit ("30 GPa").
"""
import builtins as _builtins
import json as _json
import math as _math
import os as _os

from . import _core, deck
from .errors import FileError, InputError, RunError

__version__ = _core.version
__all__ = ["open", "check", "echo", "new", "templates", "views", "fields", "Run", "History", "InputError", "RunError",
           "FileError"]

_MANY = 2**62  # steps: as many as it takes


def open(case, *, set=(), out=None, force=False, threads=None, quiet=True, folder="."):
    """Builds the model of a case, ready to be stepped.

    case     the path of a deck, or a dictionary with the deck's keys: {"concrete": [{"E": "30 GPa", ...}], ...}
    set      changes to the deck, as on the command line: ["run.end_time=5 ms"] or {"concrete.0.penalty": 60}
    out      the run folder; without one nothing is written and the history is kept in memory
    force    overwrite an existing run folder
    threads  0 = all; as the deck says unless given. The results do not depend on it.
    quiet    nothing on the terminal
    folder   where a dictionary's mesh file is looked for
    """
    return Run(_core_run(case, set, folder, out, force, threads, quiet))


def check(case, *, set=(), folder="."):
    """The forecast of `fissura check` as text; raises InputError with everything that is wrong."""
    return _told(_core.check, *_source(case, folder), _changes(set))


def echo(case, *, set=(), folder="."):
    """The deck with every default, as text."""
    return _told(_core.echo, *_source(case, folder), _changes(set))


def templates():
    """The starting cases of `fissura new`: {name: deck}."""
    return dict(_core.templates())


def new(template, folder):
    """Writes a starting case as `folder`/case.toml and returns its path; never over an existing one."""
    texts = templates()
    if template not in texts:
        raise InputError(f"there is no template `{template}`; there are: {', '.join(texts)}")
    _os.makedirs(folder, exist_ok=True)
    path = _os.path.join(folder, "case.toml")
    with _builtins.open(path, "x", encoding="utf-8") as file:
        file.write(texts[template])
    return path


def views():
    """What Run.view knows: {name: meaning}."""
    return dict(_core.views())


def fields():
    """What Run.field knows: {name: meaning}."""
    return dict(_core.fields())


class History(dict):
    """The rows so far as arrays by column: history["force"]. `units` holds the unit of each."""

    def __init__(self, columns, rows):
        super().__init__((name, rows[:, i].copy()) for i, (name, unit) in enumerate(columns))
        self.units = dict(columns)

    def __missing__(self, name):
        raise KeyError(f"there is no column `{name}`; there are: {', '.join(self)}")


class Run:
    """One run: made by fissura.open, ended by its end time, by close() or at the end of a `with` block."""

    def __init__(self, core):
        self._core = core

    # ---- going on

    def step(self, steps=1):
        """Makes up to so many time steps; 0: none. False once the run has ended; raises RunError if it failed."""
        return self._go(_count("steps", steps), None)

    def run_until(self, time):
        """Goes on to this time, in seconds or as a text ("5 ms"). False once the run has ended.

        A time that has been reached already leaves the run as it is.
        """
        return self._go(_MANY, _seconds(time))

    def run(self):
        """Goes on to the end and returns the summary."""
        self._go(_MANY, None)
        return self.summary

    def close(self):
        """Ends the run: the last frame and run.json are written where there is a run folder."""
        self._core.finish()

    def change(self, load, **curve):
        """Changes a load from now on: change("pull", velocity={"value": "0.2 m/s", "over": "1 ms"}).

        The key and its value are those of the deck, for a [[motion]], [[force]], [[traction]], or "gravity". Time 0 of
        the new curve is now. A ramp ("over") sets out from the present value; a plain value jumps to it.
        """
        if len(curve) != 1:
            raise TypeError('change expects one key, e.g. change("pull", velocity="0.2 m/s")')
        (key, value), = curve.items()
        _told(self._core.change, load, key, deck.value(value))

    def _go(self, steps, until):
        going = self._core.advance(steps, until)
        if not going:
            self._core.finish()
            if self.status == "failed":
                raise RunError(self.reason)
        return going

    def __enter__(self):
        return self

    def __exit__(self, *error):
        self.close()

    def __repr__(self):
        state = self.status if self.ended else f"t = {self.time:.4g} s"
        return f"<fissura.Run {self.title or 'untitled'!r}: {self.tets} tets, {self.joints} joints, {state}>"

    # ---- looking

    def view(self, name):
        """Raw state as a read-only array that shows the run as it goes on; fissura.views() names them.

        It lies on the memory of the run, strided, in the run's own order of tets and joints, and keeps the run alive.
        """
        return self._core.view(name)

    def field(self, name):
        """A copy with one row per tet, in the order of the input's numbers; fissura.fields() names them."""
        return self._core.field(name)

    @property
    def cracks(self):
        """The damaged joints as triangles: points, cells, opening, sliding, damage, mode, broken, ... (copies)."""
        return self._core.grid("cracks")

    @property
    def bars(self):
        """Bar elements (two points) and then bar joints (one point): stress, strain, slip, bar, copy, ... (copies)."""
        return self._core.grid("bars")

    @property
    def history(self):
        """The rows so far: gauges, reactions, energies and counts, as in history.csv."""
        return History(self._core.columns(), self._core.history())

    @property
    def summary(self):
        """What run.json holds, as a dictionary."""
        return _json.loads(self._core.summary())

    @property
    def state_hash(self):
        """A number that is the same for the same state, on any number of threads, as in run.json."""
        return f"{self._core.state_hash:016x}"

    time = property(lambda self: self._core.time, doc="Time reached [s].")
    steps = property(lambda self: self._core.steps, doc="Time steps made.")
    dt = property(lambda self: self._core.dt, doc="Time step [s].")
    stage = property(lambda self: self._core.stage, doc="Name of the present stage.")
    title = property(lambda self: self._core.title, doc="Title of the case.")
    tets = property(lambda self: self._core.tets, doc="Number of tetrahedra.")
    joints = property(lambda self: self._core.joints, doc="Number of joints.")
    ended = property(lambda self: self._core.ended, doc="Whether the run has ended.")
    status = property(lambda self: self._core.result[0] if self.ended else "running",
                      doc="running, complete, stopped or failed.")
    reason = property(lambda self: self._core.result[1] if self.ended else "", doc="Why the run ended.")


def _source(case, folder):
    if isinstance(case, dict):
        return deck.text(case), _os.path.join(folder, "case"), True
    return "", _os.fspath(case), False


def _changes(changes):
    if not isinstance(changes, dict):
        return list(changes)
    return [f"{key}={deck.value(value)}" for key, value in changes.items()]


def _core_run(case, changes, folder, out, force, threads, quiet):
    text, name, is_text = _source(case, folder)
    return _told(_core.Run, text, name, is_text, _changes(changes), "" if out is None else _os.path.abspath(out),
                 -1 if threads is None else _count("threads", threads, _core.most_threads), force, quiet)


def _told(function, *arguments):
    """Calls; a finding in a dictionary is shown with the line that was made of it."""
    try:
        return function(*arguments)
    except InputError as error:
        if not (len(arguments) > 2 and arguments[2] is True):
            raise
        lines = arguments[0].split("\n")
        told = [f"{message}\n    {lines[line - 1]}" if 0 < line <= len(lines) else message
                for _, line, _, message in error.findings]
        raise InputError("\n".join(told), error.findings) from None


def _seconds(time):
    seconds = _core.seconds(time) if isinstance(time, str) else float(time)
    if not (_math.isfinite(seconds) and seconds >= 0):
        raise InputError(f"`time` must be 0 s or more, not {time!r}")
    return seconds


def _count(name, number, most=_MANY):
    """A whole number from 0 to `most`; 2.0 is one, 2.5 and nan are none."""
    try:
        count = int(number)
    except (OverflowError, ValueError):  # inf, nan
        count = -1
    if isinstance(number, str) or count != number or not 0 <= count <= most:
        raise InputError(f"`{name}` must be a whole number from 0 to {most}, not {number!r}")
    return count
