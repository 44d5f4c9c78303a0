# SPDX-License-Identifier: Apache-2.0
import json

import numpy as np
import pytest

import crowdface


@pytest.fixture(scope="module")
def landmarks(place):
    """Landmarks of synth_02 as a scan of synth_01: the same vertices."""
    heads = crowdface.read_heads([place / "heads/synth_01.obj", place / "heads/synth_02.obj"])
    skin = np.linspace(0, heads.vertex_count // 2, 12).astype(int)
    return {
        "template": {f"l{i}": int(vertex) for i, vertex in enumerate(skin)},
        "scan": {f"l{i}": heads.positions(1)[vertex].tolist() for i, vertex in enumerate(skin)},
    }


def test_wraps_as_the_program(place, program, landmarks):
    file = place / "landmarks.yaml"
    file.write_text(json.dumps(landmarks))
    template, scan = place / "heads/synth_01.obj", place / "heads/synth_02.obj"
    program("wrap", "-q", template, scan, "--landmarks", file, "--no-pictures", "-o", place / "w.obj")
    wrapped = crowdface.wrap(template, scan, landmarks=landmarks, out=place / "ours.obj")
    assert (place / "ours.obj").read_bytes() == (place / "w.obj").read_bytes()
    np.testing.assert_array_equal(wrapped.positions, crowdface.read_heads(place / "w.obj").positions(0))
    heads = crowdface.read_heads([template, scan])
    before, after = crowdface.distances(heads, [heads.positions(1), heads.positions(0), wrapped.positions])[0, 1:]
    assert after < before / 2
    assert len(wrapped.report["landmarks"]) == 12
    arrays = crowdface.wrap(
        crowdface.read_heads(template), crowdface.read_heads(scan), landmarks=landmarks
    )
    np.testing.assert_array_equal(arrays.positions, wrapped.positions)


def test_bakes_the_colours_of_a_scan(place, program, landmarks):
    file = place / "colour_landmarks.yaml"
    file.write_text(json.dumps(landmarks))
    template, scan = place / "heads/synth_01.obj", place / "heads/synth_02.obj"
    for folder in ("by_program", "by_python"):
        (place / folder).mkdir()
    program("wrap", "-q", template, scan, "--landmarks", file, "--no-pictures", "--texture", 64,
            "--delight", "-o", place / "by_program/head.obj")  # fmt: skip
    out = place / "by_python/head.obj"
    crowdface.wrap(template, scan, landmarks=landmarks, out=out, texture=64, delight=True)
    files = {path.name: path.read_bytes() for path in (place / "by_program").iterdir()}
    assert "head.colour.png" in files and "head.filled.png" in files
    ours = {path.name: path.read_bytes() for path in (place / "by_python").iterdir()}
    assert {name for name in files if ours[name] != files[name]} <= {"head.wrap.json"}
    with pytest.raises(crowdface.UsageError, match="out=FILE.obj"):
        crowdface.wrap(template, scan, texture=64)
    with pytest.raises(crowdface.UsageError, match="--texture"):
        crowdface.wrap(template, scan, out=out, delight=True)


def test_wraps_without_any_landmarks(place):
    template, scan = place / "heads/synth_01.obj", place / "heads/synth_02.obj"
    directions = {"scan_up": "+Y", "scan_front": "+Z"}
    assert crowdface.wrap(template, scan, **directions).report["landmarks"]
    assert not crowdface.wrap(template, scan, landmarks="none", **directions).report["landmarks"]


def test_strict_refuses_a_doubtful_head(place, landmarks):
    template, scan = (crowdface.read_heads(place / f"heads/synth_0{i}.obj") for i in (1, 2))

    def in_front(head, below_nose):
        """The vertex in the middle of the face, this many cm below the tip of the nose."""
        x, y, z = head.positions(0).T
        off = np.abs(x) + np.abs(y - (y[z.argmax()] - below_nose))
        return int(np.where(off < 0.5, z, -np.inf).argmax())

    mouth = {"template": in_front(template, 3.5), "scan": in_front(scan, 6.5)}
    strayed = {
        "template": {**landmarks["template"], "lip": mouth["template"]},
        "scan": {**landmarks["scan"], "lip": scan.positions(0)[mouth["scan"]].tolist()},
    }
    assert crowdface.wrap(template, scan, landmarks=strayed).positions.shape == (4849, 3)
    with pytest.raises(crowdface.InvalidInput, match="--strict: .*(doubtful|check it)"):
        crowdface.wrap(template, scan, landmarks=strayed, strict=True)
    crowdface.wrap(template, template, strict=True)


def test_a_bad_wrap_is_an_error(place):
    template = place / "heads/synth_01.obj"
    with pytest.raises(crowdface.UsageError, match="units"):
        crowdface.wrap(template, template, units="miles")
    with pytest.raises(crowdface.UsageError, match="template_landmarks.*found \"size\""):
        crowdface.wrap(template, template, size="8")
    with pytest.raises(crowdface.MissingInput):
        crowdface.wrap(template, place / "no.obj")
