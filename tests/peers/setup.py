"""Sets up the peers: a Python environment, the spacecraft, the runners, and the list of them.

    python setup.py --into target/peers [--library target/flight/release/libprecess.a] [--subject NAME]

Safe to run again; what is there and current is kept. Needs Python 3.10 to 3.13 and a package
index; a compiler that is missing costs only its peers. `peers.json` says what works and what
is missing, and how to install it. See README.md.
"""

import argparse
import json
import os
import subprocess
import sys
import venv
from pathlib import Path

HERE = Path(__file__).resolve().parent
REQUIREMENTS = HERE / "requirements.txt"
# In a folder of the environment: it needs another version of what others need.
MJBATCH = HERE / "requirements-mjbatch.txt"
LIBRARY = HERE.parent.parent / "target" / "flight" / "release" / "libprecess.a"


def main():
    arguments = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    arguments.add_argument("--into", type=Path, required=True, metavar="FOLDER")
    arguments.add_argument("--library", type=Path, default=LIBRARY, metavar="FILE")
    arguments.add_argument("--subject", default="", metavar="NAME", help="only peers of this subject")
    given = arguments.parse_args()
    into = given.into.resolve()
    into.mkdir(parents=True, exist_ok=True)
    try:
        python = environment(into / "venv")
    except subprocess.CalledProcessError:
        # Debian's Python comes without the part of it that puts pip there.
        pip = into / "venv" / "bin" / "pip"
        install = f"{pip} install -r {os.path.relpath(REQUIREMENTS)}"
        mend = install if pip.exists() else "apt-get install python3-venv"
        missing = {"name": "all peers", "missing": f"no Python packages; install with `{mend}`"}
        (into / "peers.json").write_text(json.dumps([missing], indent=1) + "\n", encoding="utf-8")
        sys.exit(missing["missing"])
    try:
        if not given.subject:
            ensure(python, MJBATCH, into / "venv" / "mjbatch")
    except subprocess.CalledProcessError:
        # Its row is missing then, and says so.
        print(f"packages of {MJBATCH.name} cannot be installed", flush=True)
    words = [python, "-B", HERE / "prepare.py", into, given.library.resolve(), given.subject]
    sys.exit(subprocess.run(words).returncode)


def environment(folder):
    """The interpreter of an environment that holds the requirements."""
    python = folder / "bin" / "python"
    if not python.exists():
        venv.create(folder, with_pip=True, symlinks=True)
    ensure(python, REQUIREMENTS, None)
    return python


def ensure(python, requirements, target):
    """Installs packages unless they are there: among those of the environment, or in a folder."""
    folder = target or python.parent.parent
    installed, required = folder / "installed.txt", requirements.read_text(encoding="utf-8")
    if installed.exists() and installed.read_text(encoding="utf-8") == required:
        return
    print(f"packages of {requirements.name} into {folder}", flush=True)
    into = ["--upgrade", "--target", target] if target else []
    subprocess.run(
        [python, "-m", "pip", "install", "--quiet", "--disable-pip-version-check", *into,
         "--requirement", requirements],
        check=True,
    )  # fmt: skip
    installed.write_text(required, encoding="utf-8")


if __name__ == "__main__":
    main()
