# SPDX-License-Identifier: Apache-2.0
import gc
import os
import subprocess
import sys

import numpy as np
import pytest

import crowdface


def single(positions):
    """Positions as a mesh file stores them."""
    return np.asarray(positions).astype(np.float32).astype(np.float64)


def numbers_of(obj):
    """The vertices of an OBJ file, parsed by Python."""
    rows = [line.split()[1:4] for line in obj.read_text().splitlines() if line.startswith("v ")]
    return np.array(rows, dtype=np.float64)


@pytest.fixture(scope="module")
def heads(place):
    return crowdface.read_heads(place / "heads")


def test_reads_the_numbers_of_the_files(place, heads):
    assert heads.names == ["synth_01", "synth_02", "synth_03", "synth_04"]
    assert len(heads) == 4
    for i, name in enumerate(heads.names):
        np.testing.assert_array_equal(heads.positions(i), numbers_of(place / f"heads/{name}.obj"))
    polygons = [
        [int(corner.split("/")[0]) - 1 for corner in line.split()[1:]]
        for line in (place / "heads/synth_01.obj").read_text().splitlines()
        if line.startswith("f ")
    ]
    assert heads.faces.tolist() == polygons
    assert heads.offsets.tolist() == list(range(0, 4 * len(polygons) + 1, 4))
    assert heads.uv_corners.size == heads.corners.size
    assert heads.uv_corners.max() < len(heads.uvs)


def test_arrays_are_views_that_keep_the_heads_alive(place):
    heads = crowdface.read_heads([place / "heads/synth_01.obj", place / "heads/synth_02.obj"])
    arrays = [heads.positions(0), heads.uvs, heads.corners, heads.offsets, heads.faces]
    for array, again in zip(
        arrays, [heads.positions(0), heads.uvs, heads.corners, heads.offsets, heads.faces]
    ):
        assert np.shares_memory(array, again)
        assert not array.flags.writeable
    sums = [array.sum() for array in arrays]
    del heads
    gc.collect()
    assert [array.sum() for array in arrays] == sums


# Peak memory of a call, in bytes for each of many vertices. None of them but three has a polygon.
PEAK = """
import sys
import numpy as np
import crowdface
def peak():
    with open("/proc/self/status") as status:
        return next(int(line.split()[1]) for line in status if line.startswith("VmHWM"))
def bytes_per_vertex(call):
    with open("/proc/self/clear_refs", "w") as refs:
        refs.write("5")
    before = peak()
    call()
    return 1024 * (peak() - before) / len(face)
face = np.random.default_rng(1).normal(size=(1500000, 3))
heads = crowdface.Heads([face], [[0, 1, 2]])
smoothing = crowdface.Smoothing(heads)
"""


@pytest.mark.parametrize(
    "call, needed",
    [
        # Six fields of four numbers: the input, two terms before and after a round, and the sum.
        ("smoothing.smooth(face, 2)", 6 * 32),
        # The mean head, and who is whose neighbour.
        ("crowdface.distances(heads, [face, face])", 36),
    ],
)
def test_arguments_are_read_where_they_are(call, needed):
    script = f"{PEAK}print(bytes_per_vertex(lambda: {call}))"
    said = subprocess.run([sys.executable, "-c", script], check=True, stdout=subprocess.PIPE, text=True)
    assert float(said.stdout) < needed + 12  # a copy would take 24


def test_other_arrays_are_converted(heads):
    positions = heads.positions(0)
    smoothing = crowdface.Smoothing(heads)
    expected = smoothing.smooth(positions, 5)
    padded = np.zeros((len(positions), 6))
    padded[:, :3] = positions
    for other in (np.asfortranarray(positions), padded[:, :3], positions.tolist()):
        np.testing.assert_array_equal(smoothing.smooth(other, 5), expected)
    rounded = positions.astype(np.float32)
    np.testing.assert_array_equal(
        smoothing.smooth(rounded, 5), smoothing.smooth(rounded.astype(np.float64), 5)
    )
    for wrong in (positions[1:], positions[:, :2], positions.ravel(), [positions]):
        with pytest.raises(crowdface.InvalidInput, match=r"positions: expected an array \(4849, 3\), found \("):
            smoothing.smooth(wrong, 5)
        with pytest.raises(crowdface.InvalidInput, match=r"faces: expected an array \(4849, 3\), found \("):
            crowdface.distances(heads, [positions, wrong])


def test_heads_are_made_from_arrays(heads):
    made = crowdface.Heads(
        [heads.positions(i) for i in range(4)], heads.faces, uvs=heads.uvs,
        uv_faces=heads.uv_corners.reshape(heads.faces.shape), names=heads.names,
    )  # fmt: skip
    for name in ("names", "vertex_count"):
        assert getattr(made, name) == getattr(heads, name)
    for name in ("corners", "offsets", "uvs", "uv_corners", "faces"):
        np.testing.assert_array_equal(getattr(made, name), getattr(heads, name))
    np.testing.assert_array_equal(made.mean(), heads.mean())
    stacked = crowdface.Heads(
        np.stack([heads.positions(i) for i in range(2)]), (heads.corners, heads.offsets)
    )
    assert stacked.names == ["head_00", "head_01"]
    np.testing.assert_array_equal(stacked.faces, heads.faces)
    copied = crowdface.Heads([np.eye(3)], [[0, 1, 2]], uvs=np.eye(1, 2), uv_faces=[[0, -1, 0]])
    again = crowdface.Heads(
        [np.eye(3)], [[0, 1, 2]], uvs=copied.uvs, uv_faces=(copied.uv_corners, copied.offsets)
    )
    assert again.uv_corners.tolist() == copied.uv_corners.tolist() == [0, 0xFFFFFFFF, 0]
    mixed = crowdface.Heads([np.eye(4, 3)], [[0, 1, 2], [0, 1, 2, 3]])
    assert mixed.faces is None
    assert mixed.offsets.tolist() == [0, 3, 7]


@pytest.mark.parametrize(
    "positions, faces, message",
    [
        ([np.eye(3)], [[0, 1, 3]], "numbers from 0 to 2, found 3"),
        ([np.eye(3)], np.array([[0, 1, -1]]), "found -1"),
        ([np.eye(3)], [[0, 1]], "polygon 0: expected at least three corners"),
        ([np.eye(3), np.eye(4, 3)], [[0, 1, 2]], "head 1: expected 3 rows"),
        ([np.full((3, 3), np.nan)], [[0, 1, 2]], "finite"),
        ([np.eye(3)], ([0, 1, 2], [0, 2]), "offsets"),
        ([], [[0, 1, 2]], "at least one head"),
    ],
)
def test_bad_arrays_are_refused(positions, faces, message):
    with pytest.raises(crowdface.InvalidInput, match=message):
        crowdface.Heads(positions, faces)


def test_smooths_as_the_program(place, heads, program):
    out = place / "smooth.obj"
    program("smooth", "-q", place / "heads/synth_01.obj", "--iterations", "7,300", "-o", out)
    smoothing = crowdface.Smoothing(heads)
    levels = smoothing.smooth_to_levels(heads.positions(0), [7, 300])
    for level, positions in zip((7, 300), levels):
        np.testing.assert_array_equal(single(positions), single(numbers_of(place / f"smooth_{level}.obj")))
        np.testing.assert_array_equal(smoothing.smooth(heads.positions(0), level), positions)
    np.testing.assert_array_equal(smoothing.smooth(heads.positions(0), 0), heads.positions(0))
    free = crowdface.Smoothing(heads, boundary="free").smooth(heads.positions(0), 7)
    assert not np.array_equal(free, levels[0])


def test_blends_a_recipe(heads):
    smoothing = crowdface.Smoothing(heads)
    itself = {"target": "synth_02", "regions": {"all": {"weights": {"synth_02": 1}, "iterations": 50}}}
    np.testing.assert_array_equal(smoothing.blend(itself), heads.positions(1))
    # Eq. 7: the smoothed difference of target and source, plus the source.
    other = {"target": "synth_02", "regions": {"all": {"weights": {"synth_01": 1}, "iterations": 50}}}
    expected = heads.positions(0) + smoothing.smooth(heads.positions(1) - heads.positions(0), 50)
    np.testing.assert_allclose(smoothing.blend(other), expected, atol=1e-12)
    half = np.linspace(0, 1, heads.vertex_count)
    regions = {"a": other["regions"]["all"], "b": itself["regions"]["all"]}
    both = smoothing.blend({"target": "synth_02", "regions": regions}, np.stack([half, 1 - half], 1))
    mixed = half[:, None] * expected + (1 - half)[:, None] * heads.positions(1)
    np.testing.assert_allclose(both, mixed, atol=1e-12)
    with pytest.raises(crowdface.InvalidInput, match="4849 by 2"):
        smoothing.blend({"target": "synth_02", "regions": regions})
    with pytest.raises(crowdface.InvalidInput, match="synth_09"):
        smoothing.blend({**itself, "target": "synth_09"})


def test_distances_are_those_of_the_example_program(place, heads):
    matrix = crowdface.distances(heads)
    assert matrix.shape == (4, 4)
    np.testing.assert_array_equal(matrix, matrix.T)
    np.testing.assert_array_equal(np.diag(matrix), 0)
    pair = crowdface.read_heads([place / "heads/synth_01.obj", place / "heads/synth_03.obj"])
    example = os.environ["CROWDFACE_DISTANCE_EXAMPLE"]
    said = subprocess.run(
        [example, place / "heads/synth_01.obj", place / "heads/synth_03.obj"],
        check=True, stdout=subprocess.PIPE, text=True,
    ).stdout  # fmt: skip
    # The example takes the areas of the first head, the module those of the mean of the heads.
    first = crowdface.Heads([pair.positions(0)], (pair.corners, pair.offsets))
    ours = crowdface.distances(first, [pair.positions(0), pair.positions(1)])[0, 1]
    assert f"{ours:.6g} mm\n" == said
    metres = crowdface.distances(heads, unit="m")
    np.testing.assert_allclose(metres, matrix * 100)


def test_a_job_with_heads_in_arrays_is_the_job_with_files(place, heads, config):
    files = crowdface.Job(config)
    plain = {key: config[key] for key in ("schema", "crowd", "faces", "regions", "sampling")}
    expected = crowdface.Job(plain)
    job = crowdface.Job(
        {**plain, "faces": {"units": "cm"}, "regions": {"names": files.regions}}, heads, files.masks
    )
    assert not list(place.glob("crowdface-*"))
    recipes, wanted = job.cast(), expected.cast()
    assert [recipe["target"] for recipe in recipes] == [recipe["target"] for recipe in wanted]
    assert len(recipes) == 4
    for recipe in wanted:
        # Masks given as arrays are normalised a second time, which may change their last bits.
        np.testing.assert_allclose(expected.blend(recipe), job.blend(recipe), rtol=0, atol=1e-12)
