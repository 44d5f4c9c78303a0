#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Plots the time to prepare a head over the number of vertices and over L_max, as SVG.

  scripts/bench.sh smooth --benchmark_filter=PrepareHead --benchmark_out=prepare.json
  scripts/plot_prepare.py prepare.json docs/images/prepare_time.svg
"""
import json
import math
import re
import sys

WIDTH, HEIGHT, MARGIN = 360, 260, 52


def panel(title, label, points, left):
    """One plot of (x, seconds), both axes logarithmic."""
    xs, ys = [p[0] for p in points], [p[1] for p in points]
    x0, x1 = math.floor(math.log10(min(xs))), math.ceil(math.log10(max(xs)))
    y0, y1 = math.floor(math.log10(min(ys))), math.ceil(math.log10(max(ys)))

    def at(x, y):
        u = (math.log10(x) - x0) / (x1 - x0)
        v = (math.log10(y) - y0) / (y1 - y0)
        return left + MARGIN + u * (WIDTH - 1.5 * MARGIN), HEIGHT - MARGIN - v * (HEIGHT - 2 * MARGIN)

    out = [f'<text x="{left + WIDTH / 2}" y="24" text-anchor="middle" font-weight="bold">{title}</text>',
           f'<text x="{left + WIDTH / 2}" y="{HEIGHT - 12}" text-anchor="middle">{label}</text>']
    for exponent in range(x0, x1 + 1):
        x, bottom = at(10.0**exponent, 10.0**y0)
        out.append(f'<path d="M{x:.1f} {bottom:.1f}V{MARGIN}" stroke="#ddd"/>'
                   f'<text x="{x:.1f}" y="{bottom + 16:.1f}" text-anchor="middle">{10**exponent:,}</text>')
    for exponent in range(y0, y1 + 1):
        x, y = at(10.0**x0, 10.0**exponent)
        out.append(f'<path d="M{x:.1f} {y:.1f}H{left + WIDTH - MARGIN / 2:.1f}" stroke="#ddd"/>'
                   f'<text x="{x - 6:.1f}" y="{y + 4:.1f}" text-anchor="end">{10.0**exponent:g} s</text>')
    line = " ".join(f"{x:.1f},{y:.1f}" for x, y in (at(*p) for p in sorted(points)))
    out.append(f'<polyline points="{line}" fill="none" stroke="#36c" stroke-width="2"/>')
    out += [f'<circle cx="{x:.1f}" cy="{y:.1f}" r="3.5" fill="#36c"/>' for x, y in (at(*p) for p in points)]
    return out


def main(source, target):
    runs = {}
    for run in json.load(open(source, encoding="utf-8"))["benchmarks"]:
        match = re.search(r"PrepareHead/vertices:(\d+)/L_max:(\d+)/order:0", run["name"])
        if match:
            runs[int(match[1]), int(match[2])] = run["real_time"] / 1e3
    largest = max(v for v, _ in runs)
    by_level = [(level, s) for (v, level), s in runs.items() if v == largest]
    by_size = [(v, s) for (v, level), s in runs.items() if abs(level / v - 1 / 60) < 0.002]
    parts = [f'<svg xmlns="http://www.w3.org/2000/svg" width="{2 * WIDTH}" height="{HEIGHT}" '
             'font-family="sans-serif" font-size="11"><rect width="100%" height="100%" fill="white"/>']
    parts += panel("The same size of smoothing at any resolution", "vertices", by_size, 0)
    parts += panel(f"{largest:,} vertices", "L_max", by_level, WIDTH)
    parts.append("</svg>")
    open(target, "w", encoding="utf-8").write("\n".join(parts) + "\n")


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    main(*sys.argv[1:])
