#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Plots the time per face over the number of heads, measured and from the paper, as SVG.

  scripts/plot_table1.py times.json table1.svg
"""
import json
import sys

WIDTH, HEIGHT, LEFT, BOTTOM, TOP = 560, 320, 58, 50, 46
# Table 1 of the paper: 1.2 million vertices a head, one frame on an RTX 2080 Ti.
PAPER = {2: 14.1, 4: 15.6, 7: 17.5, 10: 20.4, 13: 23.2, 15: 25.0}


def main():
    measured = json.load(open(sys.argv[1]))
    vertices, faces = measured['vertices'], measured['faces']
    ours = {int(n): 1000 * s / faces for n, s in measured['heads'].items()}
    most = max(list(ours.values()) + list(PAPER.values())) * 1.12

    def at(heads, ms):
        return (LEFT + (heads - 1) / 15 * (WIDTH - LEFT - 24),
                HEIGHT - BOTTOM - ms / most * (HEIGHT - BOTTOM - TOP))

    out = [f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH} {HEIGHT}" '
           'font-family="sans-serif" font-size="12">',
           f'<rect width="{WIDTH}" height="{HEIGHT}" fill="white"/>',
           f'<text x="{WIDTH / 2}" y="{HEIGHT - 12}" text-anchor="middle">heads</text>',
           f'<text x="{LEFT}" y="20" font-weight="bold">milliseconds a face</text>']
    step = next(s for s in (0.1, 0.2, 0.5, 1, 2, 5, 10, 20, 50, 100, 1000) if most / s <= 7)
    tick = 0
    while tick <= most:
        x, y = at(1, tick)
        out.append(f'<line x1="{x}" y1="{y:.1f}" x2="{WIDTH - 24}" y2="{y:.1f}" stroke="#ddd"/>'
                   f'<text x="{x - 8}" y="{y + 4:.1f}" text-anchor="end">{tick:g}</text>')
        tick = round(tick + step, 6)
    for heads in PAPER:
        x, y = at(heads, 0)
        out.append(f'<text x="{x:.1f}" y="{y + 18}" text-anchor="middle">{heads}</text>')
    series = [(PAPER, '#9a9a9a', 'the paper: 1.2 million vertices, graphics card'),
              (ours, '#c0392b', f'crowdface: {vertices:,} vertices, processor')]
    for row, (points, colour, title) in enumerate(series):
        line = ' '.join('%.1f,%.1f' % at(n, ms) for n, ms in sorted(points.items()))
        out.append(f'<polyline points="{line}" fill="none" stroke="{colour}" stroke-width="2"/>')
        for n, ms in points.items():
            x, y = at(n, ms)
            out.append(f'<circle cx="{x:.1f}" cy="{y:.1f}" r="3.5" fill="{colour}"/>')
        y = 20 + 16 * row
        out.append(f'<circle cx="{WIDTH - 350}" cy="{y - 4}" r="4" fill="{colour}"/>'
                   f'<text x="{WIDTH - 340}" y="{y}">{title}</text>')
    open(sys.argv[2], 'w').write('\n'.join(out + ['</svg>\n']))


main()
