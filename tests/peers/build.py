"""Runs a compiler or a generator, unless what it made is there and current."""

import hashlib
import shutil
import subprocess
from pathlib import Path


class Missing(Exception):
    """Why a peer cannot run, and what would mend it."""


def compiler(name, package):
    """Its path, or why there is none."""
    found = shutil.which(name)
    if found is None:
        raise Missing(f"no {name}; install with `apt-get install {package}`")
    return found


def version_of(compiler_path):
    printed = subprocess.run([compiler_path, "--version"], capture_output=True, text=True)
    return printed.stdout.splitlines()[0]


def make(output, sources, command):
    """Runs the command that makes `output` of `sources`; its standard output, now or then.

    Current means: made by the same command of the same bytes on the same kind of processor. The
    headers of the packages are fixed by requirements.txt, which is to be among the sources.
    """
    words = [str(word) for word in command]
    stamp, printed = (output.with_name(f"{output.name}.{end}") for end in ("stamp", "out"))
    now = digest([processor(), *words], sources)
    if output.exists() and stamp.exists() and stamp.read_text(encoding="utf-8") == now:
        return printed.read_text(encoding="utf-8")
    print(f"making {output.name}", flush=True)
    stamp.unlink(missing_ok=True)
    made = subprocess.run(words, capture_output=True, text=True)
    if made.returncode != 0:
        errors = [line for line in made.stderr.splitlines() if "error" in line][:5]
        said = "\n".join(errors or made.stderr.splitlines()[-5:])
        raise Missing(f"`{' '.join(words)}` failed ({made.returncode}): {said}")
    printed.write_text(made.stdout, encoding="utf-8")
    stamp.write_text(now, encoding="utf-8")
    return made.stdout


def digest(words, sources):
    found = hashlib.sha256("\0".join(words).encode())
    for source in sources:
        found.update(hashlib.sha256(Path(source).read_bytes()).digest())
    return found.hexdigest()


def processor():
    """What `-march=native` depends on."""
    try:
        lines = Path("/proc/cpuinfo").read_text(encoding="utf-8").splitlines()
    except OSError:
        return "unknown"
    return "\n".join(line for line in lines if line.startswith(("model name", "flags")))
