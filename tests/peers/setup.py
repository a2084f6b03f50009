"""Sets up the peers: a Python environment, the spacecraft, the runners, and the list of them.

    python setup.py --into target/peers

Safe to run again; what is there and current is kept. Needs Python 3.10 to 3.13 and a package
index; a compiler that is missing costs its peers alone. `peers.json` says what works and what
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


def main():
    arguments = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    arguments.add_argument("--into", type=Path, required=True, metavar="FOLDER")
    into = arguments.parse_args().into.resolve()
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
    sys.exit(subprocess.run([python, "-B", HERE / "prepare.py", into]).returncode)


def environment(folder):
    """The interpreter of an environment that holds the requirements."""
    python, installed = folder / "bin" / "python", folder / "installed.txt"
    required = REQUIREMENTS.read_text(encoding="utf-8")
    if not (installed.exists() and installed.read_text(encoding="utf-8") == required):
        print(f"packages of {REQUIREMENTS.name} into {folder}", flush=True)
        if not python.exists():
            venv.create(folder, with_pip=True, symlinks=True)
        subprocess.run(
            [python, "-m", "pip", "install", "--quiet", "--disable-pip-version-check",
             "--requirement", REQUIREMENTS],
            check=True,
        )  # fmt: skip
        installed.write_text(required, encoding="utf-8")
    return python


if __name__ == "__main__":
    main()
