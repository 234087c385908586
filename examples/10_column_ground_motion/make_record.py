#!/usr/bin/python3
"""Writes record.txt: a made ground motion, not a measured one.

a(t) = e(t) sum_k w(f_k) sin(2 pi f_k t + 2 pi frac(k 0.6180339887)),  f_k = 0.4 Hz + k 0.2 Hz, k = 0 ... 60

w is the amplitude of Kanai and Tajimi's filter, 2.5 Hz and 60 % damped; e rises as a parabola in 0.4 s, is 1 until 1.4 s
and falls as exp(-2.5 (t - 1.4 s)). Scaled to a largest value of 1 g; every 10 ms for 2.5 s.
"""
from math import exp, pi, sin, sqrt
from pathlib import Path


def weight(f):
    r = (f / 2.5) ** 2
    return sqrt((1 + 4 * 0.36 * r) / ((1 - r) ** 2 + 4 * 0.36 * r))


def envelope(t):
    return (t / 0.4) ** 2 if t < 0.4 else 1 if t < 1.4 else exp(-2.5 * (t - 1.4))


def acceleration(t):
    frequencies = [0.4 + 0.2 * k for k in range(61)]
    return envelope(t) * sum(weight(f) * sin(2 * pi * (f * t + k * 0.6180339887 % 1)) for k, f in enumerate(frequencies))


times = [0.01 * i for i in range(251)]
values = [acceleration(t) for t in times]
largest = max(abs(a) for a in values)
lines = ["# A made ground motion: see make_record.py. Time [s], acceleration [g].", "time acceleration"]
lines += [f"{t:.2f} {a / largest:.6f}" for t, a in zip(times, values)]
Path(__file__).with_name("record.txt").write_text("\n".join(lines) + "\n", encoding="utf-8")
