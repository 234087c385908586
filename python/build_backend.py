"""The build backend of `pip install .` (PEP 517): CMake builds the module, and what it leaves becomes the wheel. Nothing is
downloaded, so it works offline; the compiler and the libraries are those of `make setup-python`."""
import base64
import hashlib
import os
import subprocess
import sys
import sysconfig
import tarfile
import tomllib
import zipfile
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent


def _project():
    with open(ROOT / "pyproject.toml", "rb") as file:
        return tomllib.load(file)["project"]


def _stem():
    project = _project()
    return f"{project['name']}-{project['version']}"


def _metadata():
    project = _project()
    lines = ["Metadata-Version: 2.1", f"Name: {project['name']}", f"Version: {project['version']}",
             f"Summary: {project['description']}", f"License: {project['license']['text']}",
             f"Requires-Python: {project['requires-python']}"]
    lines += [f"Requires-Dist: {name}" for name in project["dependencies"]]
    return "\n".join(lines) + "\n"


def _tag():
    python = f"cp{sys.version_info.major}{sys.version_info.minor}"
    return f"{python}-{python}-{sysconfig.get_platform().replace('-', '_').replace('.', '_')}"


def _compile(build):
    subprocess.run(["cmake", "-S", str(ROOT), "-B", str(build), "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release",
                    "-DFISSURA_TESTS=OFF", "-DFISSURA_PYTHON=ON", f"-DPython_EXECUTABLE={sys.executable}"], check=True)
    subprocess.run(["cmake", "--build", str(build), "--target", "fissura_python"], check=True)
    return build / "python/fissura"


def build_wheel(wheel_directory, config_settings=None, metadata_directory=None):
    """Compiles into build-python (kept: the next time is quick) and packs the wheel."""
    package = _compile(Path(os.environ.get("FISSURA_BUILD", ROOT / "build-python")))
    info, name = f"{_stem()}.dist-info", f"{_stem()}-{_tag()}.whl"
    files = {f"fissura/{f.name}": f.read_bytes() for f in sorted(package.iterdir()) if f.suffix in (".py", ".so")}
    files[f"{info}/METADATA"] = _metadata().encode()
    files[f"{info}/WHEEL"] = f"Wheel-Version: 1.0\nGenerator: fissura\nRoot-Is-Purelib: false\nTag: {_tag()}\n".encode()
    record = []
    with zipfile.ZipFile(Path(wheel_directory) / name, "w", zipfile.ZIP_DEFLATED) as wheel:
        for path, content in files.items():
            wheel.writestr(path, content)
            digest = base64.urlsafe_b64encode(hashlib.sha256(content).digest()).rstrip(b"=").decode()
            record.append(f"{path},sha256={digest},{len(content)}")
        wheel.writestr(f"{info}/RECORD", "\n".join([*record, f"{info}/RECORD,,"]) + "\n")
    return name


def build_sdist(sdist_directory, config_settings=None):
    """The files that git knows."""
    listed = subprocess.run(["git", "ls-files", "-z"], cwd=ROOT, check=True, capture_output=True, text=True).stdout
    name = f"{_stem()}.tar.gz"
    with tarfile.open(Path(sdist_directory) / name, "w:gz", format=tarfile.PAX_FORMAT) as archive:
        for file in filter(None, listed.split("\0")):
            archive.add(ROOT / file, f"{_stem()}/{file}")
    return name
