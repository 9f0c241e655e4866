# SPDX-License-Identifier: Apache-2.0
"""Says in one clear message which Python modules are missing, before anything else is imported."""

import importlib.util
import sys

PACKAGES = {  # module: package of Debian
    "numpy": "python3-numpy",
    "scipy": "python3-scipy",
    "matplotlib": "python3-matplotlib",
    "h5py": "python3-h5py",
}
EXIT_RESOURCES = 4


def missing(modules=tuple(PACKAGES)):
    """Names of the modules that this interpreter cannot find."""
    return [m for m in modules if importlib.util.find_spec(m) is None]


def require(modules=tuple(PACKAGES)):
    """Leave with exit code 4 and a message when a module is missing or Python is too old."""
    if sys.version_info < (3, 11):
        version = ".".join(map(str, sys.version_info[:2]))
        print(f"brisance report: Python 3.11 or newer is needed; {sys.executable} is {version}", file=sys.stderr)
        raise SystemExit(EXIT_RESOURCES)
    lacking = missing(modules)
    if lacking:
        print(f"brisance report: {sys.executable} has no module {', '.join(lacking)}.\n"
              f"Install it, for example: apt install {' '.join(PACKAGES.get(m, m) for m in lacking)}", file=sys.stderr)
        raise SystemExit(EXIT_RESOURCES)
