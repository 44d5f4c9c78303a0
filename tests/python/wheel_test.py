# SPDX-License-Identifier: Apache-2.0
import importlib.util
import os
import subprocess
import sys
import zipfile

import crowdface


def test_the_wheel_has_all_that_the_module_needs(place, tmp_path):
    spec = importlib.util.spec_from_file_location("build_wheel", os.environ["CROWDFACE_BACKEND"])
    backend = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(backend)
    wheel = backend.pack(os.environ["CROWDFACE_BUILD"], tmp_path)
    with zipfile.ZipFile(tmp_path / wheel) as archive:
        names = archive.namelist()
        archive.extractall(tmp_path / "site")
    record = (tmp_path / f"site/crowdface-{crowdface.__version__}.dist-info/RECORD").read_text()
    assert sorted(line.split(",")[0] for line in record.splitlines()) == sorted(names)
    for name in ("__init__.py", "_crowdface.pyi", "py.typed", "libcrowdface_images.so"):
        assert f"crowdface/{name}" in names
    # A library that images need is found beside the module: TIFF textures are read with it.
    script = """
import crowdface, sys
assert crowdface.__file__.startswith(sys.argv[1]), crowdface.__file__
job = crowdface.Job({"schema": 1, "crowd": {"name": "a", "count": 2},
                     "faces": {"directory": sys.argv[2], "units": "cm"},
                     "regions": {"names": ["top", "middle", "bottom"], "mask": sys.argv[3]}})
assert job.regions == ["top", "middle", "bottom"]
"""
    mask = tmp_path / "mask.tiff"
    subprocess.run(["oiiotool", place / "heads/regions.png", "-o", mask], check=True)
    subprocess.run(
        [sys.executable, "-c", script, tmp_path / "site", place / "heads", mask],
        check=True, cwd=tmp_path, env={**os.environ, "PYTHONPATH": str(tmp_path / "site")},
    )  # fmt: skip
