# SPDX-License-Identifier: Apache-2.0
import json
import os
import signal
import subprocess
import sys
import threading
import time

import numpy as np
import pytest

import crowdface


def files_of(folder):
    """Contents of the files that must not depend on the run."""
    return {
        str(path.relative_to(folder)): path.read_bytes()
        for path in sorted(folder.rglob("*"))
        if path.is_file() and path.name not in ("timings.json", "crowdface.log", "config.yaml")
        and not path.name.startswith(".")
    }  # fmt: skip


def single(positions):
    return np.asarray(positions).astype(np.float32).astype(np.float64)


def test_generates_the_bytes_of_the_program(place, config, made):
    crowd = crowdface.generate(config, out=place / "python")
    assert crowd.folder == place / "python"
    ours, wanted = files_of(crowd.folder), files_of(made)
    assert ours.keys() == wanted.keys()
    assert [name for name in wanted if ours[name] != wanted[name] and "report" not in name
            and "ledger" not in name] == []  # fmt: skip
    from_file = crowdface.generate(place / "crowd.yaml", out=place / "from_file")
    assert (from_file.folder / "plan.jsonl").read_bytes() == (made / "plan.jsonl").read_bytes()


def test_plans_without_meshes(place, config, made):
    crowd = crowdface.plan(config, out=place / "planned", settings={"crowd.count": 3})
    assert len(crowd) == 3
    assert not (crowd.folder / "meshes").exists()
    lines = (made / "plan.jsonl").read_text().splitlines()
    assert (crowd.folder / "plan.jsonl").read_text().splitlines() == lines[:3]
    with pytest.raises(crowdface.MissingInput, match="no report"):
        crowd.report()
    with pytest.raises(crowdface.MissingInput, match="small_0001.obj"):
        crowd["small_0001"].mesh()


def test_a_job_casts_and_blends_what_the_program_writes(config, made):
    job = crowdface.Job(config)
    recipes = job.cast()
    assert recipes == [json.loads(line) for line in (made / "plan.jsonl").read_text().splitlines()]
    crowd = crowdface.open_crowd(made)
    for recipe, positions in zip(recipes, job.blend_all(recipes)):
        face = crowd[recipe["id"]]
        np.testing.assert_array_equal(single(positions), single(face.positions()))
        np.testing.assert_array_equal(job.blend(recipe), positions)
        for name, worn in job.attachments(recipe, positions).items():
            file = crowdface.read_heads(face.mesh(f"+{name}.obj"))
            np.testing.assert_array_equal(single(worn), single(file.positions(0)))
    assert any(recipe["attachments"] for recipe in recipes)
    assert job.regions == ["top", "middle", "bottom"]
    np.testing.assert_allclose(job.masks.sum(axis=1), 1)


def test_a_job_carries_shapes(place, config):
    heads = crowdface.read_heads(place / "heads")
    (place / "shapes").mkdir()
    # The chin of the neutral mesh, the first head, moves down.
    neutral = heads.positions(0)
    smile = neutral.copy()
    front = neutral[:, 2] > np.quantile(neutral[:, 2], 0.9)
    smile[front, 1] -= 0.2
    for name, positions in (("neutral", neutral), ("smile", smile)):
        crowdface.Heads([positions], heads.faces, names=[name]).save(place / "shapes")
    config["shapes"] = {
        "neutral": str(place / "shapes/neutral.obj"), "directory": str(place / "shapes")
    }  # fmt: skip
    config["output"]["meshes"] = ["points"]
    del config["attachments"]
    job = crowdface.Job(config)
    assert job.shape_names == ["smile"]
    crowd = crowdface.generate(config, out=place / "with_shapes")
    recipe = crowd["small_0001"].recipe
    vertices, moves = job.shapes(recipe, job.blend(recipe))["smile"]
    assert 0 < len(vertices) == len(moves)
    written = np.load(crowd["small_0001"].mesh("+shapes.npy"))
    np.testing.assert_array_equal(written["vertex"], vertices)
    np.testing.assert_array_equal(written["delta"], moves.astype(np.float32))


def test_a_crowd_is_plain_objects(place, made):
    crowd = crowdface.open_crowd(made)
    assert list(crowd) == ["small_0001", "small_0002", "small_0003", "small_0004"]
    tags = (place / "heads/tags.yaml").read_text()
    for face in crowd.values():
        assert face.mesh() == made / f"meshes/{face.id}.obj"
        assert face.mesh() in face.files and all(file.exists() for file in face.files)
        assert face.sex in ("female", "male")
        assert face.sex in face.tags and all(tag in tags for tag in face.tags)
        assert face.traits["nose_width"] > 1
        assert face.recipe["regions"].keys() == {"top", "middle", "bottom"}
        assert face.target in crowdface.read_heads(place / "heads").names
    assert [face.index for face in crowd.values()] == [1, 2, 3, 4]
    table = crowd.table()
    assert [row["id"] for row in table] == list(crowd)
    assert table[0]["family"] is None
    assert isinstance(table[0]["top_iterations"], int)
    assert isinstance(table[0]["nearest_face_mm"], float)
    assert crowd.report()["reached"]
    assert crowd.verify()["files"] > 4
    assert crowd.verify()["missing"] == []
    with pytest.raises(crowdface.MissingInput, match="plan.jsonl"):
        crowdface.open_crowd(place / "heads")


def test_pandas_takes_the_table(made):
    pandas = pytest.importorskip("pandas")
    frame = pandas.DataFrame(crowdface.open_crowd(made).table())
    assert len(frame) == 4 and frame["nearest_face_mm"].dtype == float


def test_a_round_redraws_what_a_review_rejects(place, config, made):
    crowd = crowdface.generate(config, out=place / "reviewed")
    before = {face.id: face.mesh().read_bytes() for face in crowd.values()}
    review = crowd.write_review(
        place / "review.yaml", keep=["small_0001"], reject=["small_0002"],
        lock={"small_0003": ["top"]}, notes={"small_0003": "the chin"},
    )  # fmt: skip
    crowd.run_round(review)
    after = {face.id: face.mesh().read_bytes() for face in crowd.values()}
    assert [face for face in before if before[face] != after[face]] == ["small_0002", "small_0003"]
    assert crowd["small_0003"].recipe["note"] == "the chin"
    with pytest.raises(crowdface.UsageError, match="small_0009"):
        crowd.write_review(place / "other.yaml", reject=["small_0009"])


def test_single_faces_are_changed(place, config, made):
    changes = {
        "small_0002": {"variant_of": "small_0001", "distance": "0.5 mm"},
        "small_0003": {"wears": []},
        "small_0004": {"lock": ["top"]},
    }
    crowd = crowdface.generate(config, out=place / "changed")
    crowd.run_round(crowd.write_review(place / "changes.yaml", changes=changes))
    assert [face.changed for face in crowd.values()] == [
        (), ("review 1: variant_of",), ("review 1: wears",), ("review 1: lock",)
    ]  # fmt: skip
    assert crowd["small_0003"].attachments == ()
    meshes = {face.id: face.mesh().read_bytes() for face in crowd.values()}
    assert meshes["small_0001"] == (made / "meshes/small_0001.obj").read_bytes()
    # The same changes in the config of a job give the same faces.
    job = crowdface.Job({**config, "changes": changes})
    recipes = job.cast()
    assert [recipe.get("changed", []) for recipe in recipes] == [
        [line.replace("review 1", "config") for line in face.changed] for face in crowd.values()
    ]
    for recipe, positions in zip(recipes, job.blend_all(recipes)):
        np.testing.assert_array_equal(single(positions), single(crowd[recipe["id"]].positions()))
    apart = crowdface.distances(job.heads, [crowd[face].positions() for face in list(crowd)[:2]])
    assert 0.4 < apart[0, 1] < 0.6
    with pytest.raises(crowdface.UsageError, match="small_0009"):
        crowd.write_review(place / "other.yaml", changes={"small_0009": {"age": "older"}})


def test_progress_is_reported_and_cancels(place, config, made):
    stages = []

    def stop_at_faces(stage, done, total):
        assert 0 <= done <= total
        stages.append(stage)
        return stage != "faces"

    with pytest.raises(crowdface.Interrupted) as caught:
        crowdface.generate(config, out=place / "cancelled", progress=stop_at_faces)
    assert caught.value.code == 75
    assert "casting" in stages and stages[-1] == "faces"
    # The same call continues, and the crowd is the same.
    crowdface.generate(config, out=place / "cancelled")
    for name, content in files_of(made).items():
        if name.startswith("meshes") or name == "plan.jsonl":
            assert (place / "cancelled" / name).read_bytes() == content


def test_an_exception_of_the_progress_function_is_raised(config):
    def fail(*step):
        raise KeyError("mine")

    with pytest.raises(KeyError, match="mine"):
        crowdface.Job(config, progress=fail)
    with pytest.raises(crowdface.UsageError, match="starts no long call"):
        crowdface.Job(config, progress=lambda *step: crowdface.Job(config))
    assert crowdface.Job(config).regions  # later calls work


def test_errors_tell_file_line_and_code(place, config):
    file = place / "wrong.yaml"
    file.write_text("schema: 1\ncrowd: {name: a, count: 2}\nfaces: {directory: heads, units: cm}\ncrwd: 3\n")
    with pytest.raises(crowdface.UsageError) as caught:
        crowdface.generate(file)
    error = caught.value
    assert (error.code, error.file, error.line, error.column) == (64, str(file), 4, 1)
    assert isinstance(error, crowdface.Error) and "crwd" in str(error)
    (place / "broken.obj").write_text("v 0 0 0\nv 1 0 x\nf 1 2 3\n")
    with pytest.raises(crowdface.InvalidInput) as caught:
        crowdface.read_heads(place / "broken.obj")
    assert (caught.value.code, caught.value.file, caught.value.line) == (65, str(place / "broken.obj"), 2)
    with pytest.raises(crowdface.MissingInput) as caught:
        crowdface.read_heads(place / "absent.obj")
    assert (caught.value.code, caught.value.file) == (66, str(place / "absent.obj"))
    config["diversity"] = {"min_distance": "90 mm"}
    with pytest.raises(crowdface.Unsatisfiable) as caught:
        crowdface.Job(config).cast()
    assert caught.value.code == 3


def test_other_threads_run_during_long_calls(place, config):
    counts = []
    done = threading.Event()

    def count():
        while not done.wait(0.005):
            counts.append(time.monotonic())

    thread = threading.Thread(target=count)
    thread.start()
    start = time.monotonic()
    crowdface.generate(config, out=place / "released")
    seconds = time.monotonic() - start
    done.set()
    thread.join()
    assert len(counts) > 5
    assert max(np.diff([start, *counts])) < max(0.3, seconds / 2)


def test_calls_of_two_threads_run_one_after_the_other(config):
    results = []
    threads = [
        threading.Thread(target=lambda: results.append(crowdface.Job(config).cast()))
        for _ in range(2)
    ]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert len(results) == 2 and results[0] == results[1]


def test_control_c_stops_a_long_call(place, config):
    script = f"""
import crowdface, sys
config = {config!r}
config["crowd"]["count"] = 5000
try:
    crowdface.generate(config, out={str(place / "stopped")!r},
                       progress=lambda *step: print(*step, flush=True))
except KeyboardInterrupt:
    crowdface.Job({config!r})  # the module still works
    sys.exit(42)
"""
    process = subprocess.Popen(
        [sys.executable, "-c", script], stdout=subprocess.PIPE, text=True, env=dict(os.environ)
    )
    for line in process.stdout:
        if line.startswith("casting"):
            break
    start = time.monotonic()
    process.send_signal(signal.SIGINT)
    process.stdout.read()
    assert process.wait(60) == 42
    assert time.monotonic() - start < 30


def test_the_example_makes_a_crowd_from_arrays(place):
    example = os.path.join(os.environ["CROWDFACE_EXAMPLES"], "crowd_from_arrays.py")
    said = subprocess.run(
        [sys.executable, example, "5"], check=True, stdout=subprocess.PIPE, text=True, cwd=place
    ).stdout
    assert "6 heads of 4800 vertices" in said
    assert "arrays_0005: the shape of" in said
    assert float(said.split("most alike are ")[1].split(" mm")[0]) > 0.1
