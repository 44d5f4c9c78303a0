# SPDX-License-Identifier: Apache-2.0
"""The build backend of `pip install .` (PEP 517): builds the release preset and packs the module.

It needs the Debian packages of scripts/install_dependencies.sh --package, and no network.
"""

import base64
import hashlib
import re
import subprocess
import sys
import sysconfig
import tempfile
import zipfile
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent


def _version():
    return re.search(r"project\(crowdface VERSION (\S+)", (ROOT / "CMakeLists.txt").read_text())[1]


def _package_files(build, prefix):
    """The files of the package `crowdface`, by their path in the wheel."""
    subprocess.run(
        ["cmake", "--install", build, "--prefix", prefix, "--component", "python"],
        check=True, stdout=subprocess.DEVNULL,
    )  # fmt: skip
    package = next(Path(prefix).rglob("__init__.py")).parent
    if not (package / f"_crowdface{sysconfig.get_config_var('EXT_SUFFIX')}").exists():
        raise SystemExit(
            f"{build}: the module is built for another Python; configure with "
            f"-DPython_EXECUTABLE={sys.executable}"
        )
    files = {f"crowdface/{file.relative_to(package)}": file for file in package.rglob("*")}
    files.update({f"crowdface/{file.name}": file for file in Path(build).glob("lib/**/libcrowdface_*.so")})
    gallery = Path(build) / "share/crowdface/gallery"
    files.update(
        {f"crowdface/gallery/{file.relative_to(gallery)}": file for file in gallery.rglob("[!.]*")}
    )
    return {name: file for name, file in sorted(files.items()) if file.is_file()}


def pack(build, wheel_directory):
    """Packs the wheel of a build folder. Returns its name."""
    python = f"cp{sys.version_info.major}{sys.version_info.minor}"
    platform = re.sub(r"[-.]", "_", sysconfig.get_platform())
    info = f"crowdface-{_version()}.dist-info"
    wheel = f"crowdface-{_version()}-{python}-{python}-{platform}.whl"
    texts = {
        f"{info}/METADATA": f"Metadata-Version: 2.1\nName: crowdface\nVersion: {_version()}\n"
        "Summary: Crowds of believable faces from a handful of scanned heads\n"
        "License: Apache-2.0\nRequires-Python: >=3.9\nRequires-Dist: numpy\n",
        f"{info}/WHEEL": "Wheel-Version: 1.0\nGenerator: crowdface\nRoot-Is-Purelib: false\n"
        f"Tag: {python}-{python}-{platform}\n",
    }
    with tempfile.TemporaryDirectory() as prefix:
        contents = {name: file.read_bytes() for name, file in _package_files(build, prefix).items()}
    contents.update({name: text.encode() for name, text in texts.items()})
    record = ""
    with zipfile.ZipFile(Path(wheel_directory) / wheel, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, content in contents.items():
            archive.writestr(name, content)
            digest = base64.urlsafe_b64encode(hashlib.sha256(content).digest()).rstrip(b"=").decode()
            record += f"{name},sha256={digest},{len(content)}\n"
        archive.writestr(f"{info}/RECORD", f"{record}{info}/RECORD,,\n")
    return wheel


def build_wheel(wheel_directory, config_settings=None, metadata_directory=None):
    command = [ROOT / "scripts/build.sh", "release", "crowdface", "crowdface_python"]
    subprocess.run(command, check=True, cwd=ROOT)
    return pack(ROOT / "build/release", wheel_directory)


def build_sdist(sdist_directory, config_settings=None):
    raise SystemExit("scripts/package.sh makes the source tarball")
