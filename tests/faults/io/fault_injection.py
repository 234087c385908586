#!/usr/bin/env python3
"""Requirement: whichever call that writes, syncs, renames, makes or removes a file fails, the program ends with
code 3 and names the file and the reason, and every file that was whole before is whole afterwards.

Runs a small case again and again; in run n the shim makes the n-th such call below the run folder fail, until a
run meets no n-th call any more; then the same while a run goes on from a checkpoint, which must go on from it
again afterwards.  fault_injection.py PROGRAM SHIM [--stays] [--each] [--errno NAME]
"""
import argparse
import errno
import json
import os
import re
import shutil
import subprocess
import sys
import tempfile
import xml.etree.ElementTree as xml

CASE = os.path.join(os.path.dirname(os.path.abspath(__file__)), 'case.toml')


STOPS = ('--set', 'run.max_steps=45')


def run(program, out, environment, *arguments, begin='--out'):
    return subprocess.run([program, 'run', CASE, begin, out, '--quiet', '--threads', '1', *arguments],
                          env={**os.environ, **environment}, text=True, stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                          timeout=900, cwd=os.path.dirname(out) if os.path.isdir(os.path.dirname(out)) else None)


def is_whole_frame(path):
    with open(path, 'rb') as file:
        return file.read().rstrip().endswith(b'</VTKFile>')


def broken_files(out):
    """What in a run folder a reader would stumble over."""
    broken = []
    for folder, _, names in os.walk(out):
        for name in names:
            path = os.path.join(folder, name)
            if name.endswith(('.vtu', '.vtp')) and not is_whole_frame(path):
                broken.append(path)
            if name.endswith('.pvd'):
                for entry in xml.parse(path).getroot().iter('DataSet'):
                    if not os.path.exists(os.path.join(folder, entry.get('file'))):
                        broken.append(f'{path} names {entry.get("file")}')
            if name == 'run.json':
                json.load(open(path))
            if name == 'history.csv':
                lines = open(path).read().split('\n')
                width = {line.count(',') for line in lines if line}
                if len(width) > 1:
                    broken.append(f'{path} has rows of different lengths')
            if name.endswith('.part'):
                broken.append(f'{path} was left behind')
    return broken


def complaints(result, reason, stays, out):
    """What is wrong with the end of a run in which a call failed."""
    found = []
    if result.returncode != 3:
        found.append(f'exit code {result.returncode} instead of 3')
    text = re.sub(r'\[fault [a-z]+\]\n', '', result.stderr)
    if reason not in text:
        found.append(f'the reason "{reason}" is not named')
    if out not in text and not re.search(rf"'{os.path.basename(out)}[/']", text):
        found.append('no file is named')
    found += [] if stays else broken_files(out)
    return found


def goes_on(program, out):
    """What is wrong with the run folder that a failed call has left, seen by a run that goes on from it."""
    again = run(program, out, {}, begin='--restart')
    return [] if again.returncode == 0 else [f'cannot go on afterwards: exit code {again.returncode}: {again.stderr}']


def all_calls(program, shim, stopped):
    """The calls of a run in which none fails, as `kind file`, the numbers in the names of files made one."""
    with tempfile.TemporaryDirectory() as folder:
        out = os.path.join(os.path.realpath(folder), 'run')
        if stopped:
            shutil.copytree(stopped, out)
        environment = {'LD_PRELOAD': shim, 'FISSURA_FAULT_FOLDER': out, 'FISSURA_FAULT_CALL': '0', 'FISSURA_FAULT_ERRNO': '0',
                       'FISSURA_FAULT_LIST': '1'}
        result = run(program, out, environment, begin='--restart' if stopped else '--out')
        calls = re.findall(r'\[call ([a-z]+) (.*)\]', result.stderr)
        bad = [] if result.returncode == 0 else [f'without a fault: exit code {result.returncode}: {result.stderr}']
        return [f'{kind} {re.sub("[0-9]+", "0", file[len(out):])}' for kind, file in calls], bad


def sweep(program, shim, code, stays, each, stopped=None):
    """Number of calls, number of those made to fail, and the list of complaints: of a new run, or of one that goes on from a copy
    of `stopped`."""
    reason = os.strerror(code)
    calls, bad = all_calls(program, shim, stopped)
    numbers = sorted({call: n for n, call in reversed([*enumerate(calls, 1)])}.values()) if each else range(1, len(calls) + 1)
    for n in numbers:
        with tempfile.TemporaryDirectory() as folder:
            folder = os.path.realpath(folder)
            out = os.path.join(folder, 'run')
            if stopped:
                shutil.copytree(stopped, out)
            environment = {'LD_PRELOAD': shim, 'FISSURA_FAULT_FOLDER': out, 'FISSURA_FAULT_CALL': str(n),
                           'FISSURA_FAULT_ERRNO': str(code)}
            if stays:
                environment['FISSURA_FAULT_STAYS'] = '1'
            result = run(program, out, environment, begin='--restart' if stopped else '--out')
            call = re.search(r'\[fault ([a-z]+)\]', result.stderr)
            if not call:
                bad.append(f'call {n} ({calls[n - 1]}): it never came')
                continue
            found = complaints(result, reason, stays, out) + (goes_on(program, out) if stopped else [])
            for complaint in found:
                bad.append(f'call {n} ({calls[n - 1]}): {complaint}; it said: {result.stderr.strip()[-200:]}')
    return len(calls), len(numbers), bad


def sweep_restart(program, shim, code, stays, each):
    """The same for a run that was stopped between two checkpoints and goes on."""
    with tempfile.TemporaryDirectory() as folder:
        stopped = os.path.join(os.path.realpath(folder), 'stopped')
        begun = run(program, stopped, {}, *STOPS)
        if begun.returncode != 0:
            return 0, 0, [f'the run to go on from: exit code {begun.returncode}: {begun.stderr}']
        return sweep(program, shim, code, stays, each, stopped)


def check_full_device(program):
    """Output to /dev/full, which takes nothing, and folders that cannot be."""
    bad = []
    with tempfile.TemporaryDirectory() as folder, open('/dev/full', 'w') as full:
        checked = subprocess.run([program, 'check', CASE], stdout=full, stderr=subprocess.PIPE, text=True)
        if checked.returncode != 3 or os.strerror(errno.ENOSPC) not in checked.stderr:
            bad.append(f'check > /dev/full: code {checked.returncode}: {checked.stderr}')
        file = os.path.join(folder, 'file')
        open(file, 'w').close()
        below = run(program, os.path.join(file, 'run'), {})
        if below.returncode != 3 or file not in below.stderr:
            bad.append(f'a run folder below a file: code {below.returncode}: {below.stderr}')
        out = os.path.join(folder, 'run')
        os.mkdir(out)
        os.symlink('/dev/full', os.path.join(out, 'history.csv.link'))
        again = run(program, out, {})
        if again.returncode != 3 or 'exists already' not in again.stderr:
            bad.append(f'an existing folder: code {again.returncode}: {again.stderr}')
        limited = subprocess.run(['bash', '-c', f'ulimit -f 20; exec "{program}" run "{CASE}" --out "{folder}/small" --quiet'],
                                 stderr=subprocess.PIPE, text=True)
        if limited.returncode != 3 or os.strerror(errno.EFBIG) not in limited.stderr:
            bad.append(f'a limit on the size of files: code {limited.returncode}: {limited.stderr}')
    return bad


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument('program')
    parser.add_argument('shim')
    parser.add_argument('--stays', action='store_true', help='all later calls fail as well, as on a full disk')
    parser.add_argument('--errno', default='ENOSPC')
    parser.add_argument('--each', action='store_true', help='of the calls of one kind for one kind of file only the first')
    arguments = parser.parse_args()
    program = os.path.abspath(arguments.program)
    how = (program, os.path.abspath(arguments.shim), getattr(errno, arguments.errno), arguments.stays, arguments.each)
    calls, failed, bad = sweep(*how)
    calls_on, failed_on, bad_on = sweep_restart(*how)
    bad += bad_on + check_full_device(program)
    print(f'{failed} of {calls} calls of a new run and {failed_on} of {calls_on} of one that goes on, each made to fail with '
          f'{arguments.errno}: {len(bad)} complaints')
    print('\n'.join(bad[:40]))
    sys.exit(1 if bad or min(failed, failed_on) < 20 else 0)


if __name__ == '__main__':
    main()
