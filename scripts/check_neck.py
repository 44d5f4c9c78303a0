#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Checks that all faces of a crowd end in the ring of a body (docs/neck.md).

  scripts/check_neck.py CROWD BODY.obj

Reads OBJ, PLY, GLB, text USD and NumPy files of the folder CROWD/meshes with its own readers; needs
Python and numpy. For every file it checks that
  - each vertex of the body's ring is a vertex of the mesh, with the same single-precision numbers;
  - each of these vertices has one unit normal, the same in all files;
  - shapes in the file (GLB morph targets, USD blend shapes) do not move the ring;
  - the body in the file, if there is one, has the ring with the same normals.
Prints the number of files of each kind, and the angle between the common normals and those of the
body. The exit code is 1 if any file fails.
"""
import collections
import json
import os
import re
import struct
import sys

import numpy as np


def numbers(text):
    return np.array(text.split(), dtype=np.float64)


def read_obj(path, faces=False):
    """Positions, and rows (vertex, normal) of all corners; with `faces`, the polygons as well."""
    v, vn, f = [], [], []
    with open(path, 'rb') as file:
        for line in file:
            if line.startswith(b'v '):
                v.append(line[2:].split(None, 3))
            elif line.startswith(b'vn '):
                vn.append(line[3:])
            elif line.startswith(b'f '):
                f.append(line[2:])
    points = np.array([row[:3] for row in v], dtype=np.float64)
    normals = numbers(b' '.join(vn)).reshape(-1, 3)
    if faces:
        polygons = [[int(c.split(b'/')[0]) - 1 for c in line.split()] for line in f]
        return points, polygons
    if not len(normals):
        return points, None, None
    text = b' '.join(f)
    columns = 2 if b'//' in text else 3
    corners = numbers(text.replace(b'/', b' ')).astype(np.int64).reshape(-1, columns)
    return points, corners[:, 0] - 1, normals[corners[:, -1] - 1]


PLY_TYPES = {'float': '<f4', 'double': '<f8', 'uchar': 'u1', 'int': '<i4', 'uint': '<u4'}


def read_ply(path):
    with open(path, 'rb') as file:
        fields, count, element = [], 0, ''
        while True:
            words = file.readline().decode().split()
            if words == ['end_header']:
                break
            if words[0] == 'format' and words[1] != 'binary_little_endian':
                raise ValueError('a PLY file of another format')
            if words[0] == 'element':
                element = words[1]
                count = int(words[2]) if element == 'vertex' else count
            if words[0] == 'property' and element == 'vertex':
                fields.append((words[2], PLY_TYPES[words[1]]))
        rows = np.fromfile(file, dtype=np.dtype(fields), count=count)
    points = np.stack([rows[c] for c in 'xyz'], axis=1)
    if 'nx' not in rows.dtype.names:
        return points, None, None
    return points, np.arange(count), np.stack([rows['n' + c] for c in 'xyz'], axis=1)


GLTF_TYPES = {5120: 'i1', 5121: 'u1', 5122: '<i2', 5123: '<u2', 5125: '<u4', 5126: '<f4'}


def accessor(gltf, binary, number):
    one = gltf['accessors'][number]
    columns = {'SCALAR': 1, 'VEC2': 2, 'VEC3': 3, 'VEC4': 4}[one['type']]

    def rows(view, offset, kind, count, columns):
        view = gltf['bufferViews'][view]
        start = view.get('byteOffset', 0) + offset
        size = np.dtype(kind).itemsize * columns
        stride = view.get('byteStride', size)
        raw = np.frombuffer(binary, np.uint8, stride * (count - 1) + size, start)
        raw = np.lib.stride_tricks.as_strided(raw, (count, size), (stride, 1))
        return np.ascontiguousarray(raw).view(kind).reshape(count, columns)

    kind = GLTF_TYPES[one['componentType']]
    if 'bufferView' in one:
        values = rows(one['bufferView'], one.get('byteOffset', 0), kind, one['count'], columns)
    else:
        values = np.zeros((one['count'], columns), kind)
    if 'sparse' in one:
        sparse, values = one['sparse'], values.copy()
        at = sparse['indices']
        index = rows(at['bufferView'], at.get('byteOffset', 0), GLTF_TYPES[at['componentType']],
                     sparse['count'], 1)[:, 0]
        at = sparse['values']
        values[index] = rows(at['bufferView'], at.get('byteOffset', 0), kind, sparse['count'], columns)
    return values


def read_glb(path, name=None):
    """All primitives of the first mesh, which is the face, or of the mesh `name` (None if there is no
    such mesh), and the rows that its targets move."""
    data = open(path, 'rb').read()
    length = struct.unpack_from('<I', data, 12)[0]
    gltf = json.loads(data[20:20 + length])
    binary = memoryview(data)[28 + length:]
    meshes = [mesh for mesh in gltf['meshes'] if name in (None, mesh['name'])]
    if not meshes:
        return None
    points, normals, moved, known = [], [], [], set()
    for primitive in meshes[0]['primitives']:
        attributes = primitive['attributes']
        if attributes['POSITION'] in known:
            continue
        known.add(attributes['POSITION'])
        points.append(accessor(gltf, binary, attributes['POSITION']))
        normals.append(accessor(gltf, binary, attributes['NORMAL']))
        moves = np.zeros(len(points[-1]), bool)
        for target in primitive.get('targets', []):
            moves |= (accessor(gltf, binary, target['POSITION']) != 0).any(axis=1)
        moved.append(moves)
    points = np.concatenate(points)
    return points, np.arange(len(points)), np.concatenate(normals), np.concatenate(moved)


def read_usda(path, name='mesh'):
    """The mesh `name` (None if there is no such mesh), and the rows that its blend shapes move."""
    text = open(path).read()
    begin = text.find(f'def Mesh "{name}"')
    if begin < 0:
        return None
    end = text.find('def Mesh', begin + 1)
    text = text[begin:end if end >= 0 else len(text)]

    def rows(key, columns):
        at = text.find(key)
        if at < 0:
            return None
        body = text[at + len(key):text.index(']', at + len(key))]
        return numbers(re.sub('[(),]', ' ', body)).reshape(-1, columns)

    points = rows('point3f[] points = [', 3)
    normals = rows('normal3f[] normals = [', 3)
    moved = np.zeros(len(points), bool)
    for shape in re.finditer(r'def BlendShape .*?\n\s*\}', text, re.S):
        index = re.search(r'pointIndices = \[(.*?)\]', shape.group(0), re.S)
        if index:
            moved[numbers(index.group(1).replace(',', ' ')).astype(np.int64)] = True
    if normals is None:
        return points, None, None, moved
    return points, np.arange(len(points)), normals, moved


def read_npy(path):
    return np.load(path), None, None


READERS = {'.obj': read_obj, '.ply': read_ply, '.glb': read_glb, '.usda': read_usda, '.npy': read_npy}
BODY_READERS = {'.glb': read_glb, '.usda': read_usda}


def body_rings(points, polygons):
    """Closed loops of edges that have one polygon."""
    edges = collections.Counter()
    after = {}
    for polygon in polygons:
        for a, b in zip(polygon, polygon[1:] + polygon[:1]):
            edges[(min(a, b), max(a, b))] += 1
            after[(a, b)] = True
    following = {a: b for a, b in after if edges[(min(a, b), max(a, b))] == 1}
    rings = []
    while following:
        ring = [next(iter(following))]
        while ring[-1] in following:
            ring.append(following.pop(ring[-1]))
        rings.append(ring[:-1])
    return rings


def area_normals(points, polygons):
    normals = np.zeros_like(points)
    for polygon in polygons:
        p = points[polygon]
        area = 0.5 * np.cross(p, np.roll(p, -1, axis=0)).sum(axis=0)
        normals[polygon] += area
    return normals / np.maximum(np.linalg.norm(normals, axis=1, keepdims=True), 1e-30)


def rows_at(points, places):
    """For each place, the rows of `points` with exactly these single-precision numbers."""
    zero = np.float32(0)  # turns −0 into 0
    singles, wanted = points.astype(np.float32) + zero, places.astype(np.float32) + zero
    found = collections.defaultdict(list)
    for row in np.flatnonzero(np.isin(singles[:, 0], wanted[:, 0])):
        found[tuple(singles[row])].append(row)
    return [found.get(tuple(place), []) for place in wanted]


def main():
    if len(sys.argv) != 3:
        sys.exit(__doc__.split('\n\n')[1])
    crowd, body = sys.argv[1:]
    points, polygons = read_obj(body, faces=True)
    rings = body_rings(points, polygons)
    plan = [json.loads(line) for line in open(f'{crowd}/plan.jsonl')]
    worn = {name for face in plan for name in face.get('attachments', [])}
    ids = {face['id'] for face in plan}
    paths = []
    for folder, _, names in os.walk(f'{crowd}/meshes'):
        for stem, kind in map(os.path.splitext, names):
            words = stem.split('+')
            is_mesh = words[0] in ids and not worn.intersection(words) and kind in READERS
            if is_mesh and words[-1] != 'shapes':
                paths.append(os.path.join(folder, stem + kind))
    paths.sort()
    if not paths:
        sys.exit(f'{crowd}/meshes: no mesh files')
    ring, counts, faults = None, collections.Counter(), []
    common, with_normals, moving, bodies = {}, 0, 0, 0

    def check(path, here, rows, normals, moved):
        """Checks the ring of one mesh: the face's, or the body's in the same file."""
        nonlocal ring
        if ring is None:
            matched = [sum(bool(r) for r in rows_at(here, points[one])) for one in rings]
            ring = rings[int(np.argmax(matched))]
        at = rows_at(here, points[ring])
        missing = sum(not found for found in at)
        if missing:
            faults.append(f'{path}: {missing} of {len(ring)} ring vertices are elsewhere')
            return
        if moved is not None and any(moved[row] for found in at for row in found):
            faults.append(f'{path}: a shape moves the ring')
        if rows is None:
            return
        of_row = collections.defaultdict(list)
        on_ring = np.zeros(len(here), bool)
        on_ring[[row for found in at for row in found]] = True
        for corner in np.flatnonzero(on_ring[rows]):
            of_row[rows[corner]].append(normals[corner])
        for i, found in enumerate(at):
            for normal in (np.float32(n) for row in found for n in of_row[row]):
                first = common.setdefault(i, normal)
                if not np.array_equal(first, normal):
                    faults.append(f'{path}: ring vertex {i} has normal {normal}, elsewhere {first}')
                if abs(np.linalg.norm(normal) - 1) > 1e-5:
                    faults.append(f'{path}: the normal of ring vertex {i} has no unit length')

    for path in paths:
        kind = os.path.splitext(path)[1]
        here, rows, normals, *moved = READERS[kind](path)
        moved = moved[0] if moved else None
        counts[kind] += 1
        with_normals += rows is not None
        moving += moved is not None and moved.any()
        check(path, here, rows, normals, moved)
        held = BODY_READERS[kind](path, 'body') if kind in BODY_READERS else None
        if held is not None:
            bodies += 1
            check(f'{path}, body', *held)
    kinds = ', '.join(f'{count} {kind[1:]}' for kind, count in sorted(counts.items()))
    print(f'{len(paths)} files ({kinds}), ring of {len(ring)} vertices')
    print(f'normals in {with_normals} files; {moving} files have shapes that move vertices; '
          f'{bodies} files contain the body')
    if common:
        own = area_normals(points, polygons)[ring]
        all_of = np.array([common[i] for i in range(len(ring))])
        degrees = np.degrees(np.arccos(np.clip(np.abs((own * all_of).sum(axis=1)), -1, 1)))
        print(f'angle between the common normals and those of the body alone: '
              f'rms {np.sqrt((degrees ** 2).mean()):.2f}, max {degrees.max():.2f} degrees')
    for fault in faults[:20]:
        print(fault)
    print(f'{len(faults)} faults' if faults else 'every file ends in the ring')
    sys.exit(1 if faults else 0)


if __name__ == '__main__':
    main()
