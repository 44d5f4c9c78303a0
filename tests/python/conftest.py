# SPDX-License-Identifier: Apache-2.0
"""What the tests of the Python module share: the program, small synthetic heads, a small crowd."""

import copy
import json
import os
import subprocess

import pytest


def run_program(*arguments):
    """Runs the program. Returns what it prints."""
    command = [os.environ["CROWDFACE_PROGRAM"], *map(str, arguments)]
    return subprocess.run(command, check=True, stdout=subprocess.PIPE, text=True).stdout


@pytest.fixture(scope="session")
def program():
    return run_program


@pytest.fixture(scope="session")
def place(tmp_path_factory):
    """A folder with heads/ (four heads with hair) and a cache."""
    folder = tmp_path_factory.mktemp("place")
    os.environ["XDG_CACHE_HOME"] = str(folder / "cache")
    run_program("synth", "-q", "-o", folder / "heads", "--count", 4, "--vertices", 5000,
                "--textures", 64, "--hair")  # fmt: skip
    return folder


@pytest.fixture(scope="session")
def _config(place):
    heads = str(place / "heads")
    return {
        "schema": 1,
        "crowd": {"name": "small", "count": 4, "seed": 3},
        "faces": {"directory": heads, "units": "cm"},
        "regions": {"names": ["top", "middle", "bottom"], "mask": heads + "/regions.png"},
        "sampling": {"smoothness": [0.15, 0.6]},
        "traits": {"nose_width": {"at_least": "1 mm"}},
        "attachments": {"from": heads + "/attachments"},
        "textures": {"blend": "none"},
        "output": {"meshes": ["obj"], "contact_sheet": "none"},
    }


@pytest.fixture()
def config(_config):
    """The config of the small crowd."""
    return copy.deepcopy(_config)


@pytest.fixture(scope="session")
def made(place, _config):
    """The folder of the small crowd as the program makes it."""
    file = place / "crowd.yaml"
    file.write_text(json.dumps(_config))
    run_program("generate", "-q", file, "--out", place / "made")
    return place / "made"
