"""Writes tests/fixtures/gpu.json: registers, stack and spills of the batch kernels of every kind, compiled for a GPU.

    python gpu.py           compiles all sets by NVRTC and ptxas for sm_90; writes
    python gpu.py --check   the same; more than the stored file has is an error; writes nothing

No GPU is needed, and none is used. The sources are those of `precess-bake --general --batch`. PTX must have no fused
multiply-add of floating point: the sources have none, and --fmad=false forms none. Exit status: 0 if all is well, 1 if
something is wrong, 77 if a package is missing: see requirements.txt.
"""

import argparse
import ctypes
import json
import re
import subprocess
import sys
import tempfile
from pathlib import Path

import programs

MISSING = 77
HERE = Path(__file__).resolve().parent
ROOT = HERE.parent.parent
FIXTURE = HERE.parent / "fixtures" / "gpu.json"

try:
    import nvidia.cuda_nvcc as nvcc
    import nvidia.cuda_nvrtc as nvrtc
except ModuleNotFoundError as error:
    if error.name not in ("nvidia", "nvidia.cuda_nvcc", "nvidia.cuda_nvrtc"):
        raise
    print(error, file=sys.stderr)
    sys.exit(MISSING)

FLAGS = ["--gpu-architecture=compute_90", "--fmad=false", "--device-as-default-execution-space"]

BODY = """[[device.body]]
mass = 1.0
origin = [0.0, 0.0, 0.0]
centre_of_mass = [0.0, 0.0, 0.0]
inertia = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]
"""
UNIT = "[[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]"


def ran(package, *words, **more):
    """What a program of the workspace prints."""
    command = [programs.folder() / package, *words]
    return subprocess.run(command, text=True, check=True, cwd=ROOT, stdout=subprocess.PIPE, **more).stdout


def bodies():
    """How many bodies each kind has."""
    kinds = json.loads(ran("precess", "kinds", "--json"))
    return {kind: len(of) for kind, of in sorted(kinds.items())}


def description(name, kinds, count):
    """Of a set; the numbers are not used."""
    lines = [f'format = 1\nname = "{name}"\n[hub]\nmass = 1.0\ncentre_of_mass = [0.0, 0.0, 0.0]']
    lines.append(f"inertia = {UNIT}")
    for k, kind in enumerate(kinds):
        lines.append(f'[[device]]\nname = "device{k}"\nkind = "{kind}"\nmount = {UNIT}')
        lines.append(BODY * count[kind])
    return "\n".join(lines)


def package(module):
    return Path(next(iter(module.__path__)))


def text_of(library, program, what):
    """A text that NVRTC has of a program: `Log` or `PTX`."""
    size = ctypes.c_size_t()
    getattr(library, f"nvrtcGet{what}Size")(program, ctypes.byref(size))
    text = ctypes.create_string_buffer(size.value)
    getattr(library, f"nvrtcGet{what}")(program, text)
    return text.value.decode()


def ptx_of(library, folder, name):
    """The PTX of a set's batch kernels, from the sources alone: no header of this machine is read."""
    headers = [*folder.glob("*.h"), *folder.glob("*.c"), *(folder / "nvrtc").glob("*.h")]
    count = len(headers)
    strings = ctypes.c_char_p * count
    program = ctypes.c_void_p()
    source = (folder / f"{name}_batch.cu").read_bytes()
    texts = strings(*(header.read_bytes() for header in headers))
    names = strings(*(header.name.encode() for header in headers))
    made = library.nvrtcCreateProgram(
        ctypes.byref(program), source, b"batch.cu", count, texts, names
    )
    flags = (ctypes.c_char_p * len(FLAGS))(*(flag.encode() for flag in FLAGS))
    if made or library.nvrtcCompileProgram(program, len(FLAGS), flags):
        sys.exit(f"{name}: NVRTC rejects the sources: {text_of(library, program, 'Log')}")
    ptx = text_of(library, program, "PTX")
    library.nvrtcDestroyProgram(ctypes.byref(program))
    return ptx


def resources(name, ptx, folder):
    """Registers and bytes of stack and spills of each kernel, functions that it calls included."""
    path = folder / "batch.ptx"
    path.write_text(ptx)
    ptxas = package(nvcc) / "bin" / "ptxas"
    command = [ptxas, "-arch=sm_90", "-v", "-o", folder / "batch.cubin", path]
    said = subprocess.run(command, capture_output=True, text=True, check=True).stderr
    kernels = {}
    for part in said.split("Compiling entry function '")[1:]:
        kernel = part.split("'")[0].removeprefix(f"{name}_batch_")
        spills = re.findall(r"(\d+) bytes spill stores, (\d+) bytes spill loads", part)
        stack = re.search(r"(\d+) bytes cumulative stack size", part)
        kernels[kernel] = {
            "registers": int(re.search(r"Used (\d+) registers", part)[1]),
            "stack": int(stack[1]) if stack else 0,
            "spill_stores": sum(int(stores) for stores, _ in spills),
            "spill_loads": sum(int(loads) for _, loads in spills),
        }
    return kernels


def compiled():
    library = ctypes.CDLL(str(package(nvrtc) / "lib" / "libnvrtc.so.12"))
    found = {}
    count = bodies()
    # A set of one device of each kind, and one of four devices.
    sets = {f"one_{kind}": [kind] for kind in count} | {"four_dgvscmg": ["dgvscmg"] * 4}
    with tempfile.TemporaryDirectory() as temporary:
        for name, kinds in sets.items():
            folder = Path(temporary) / name
            words = ["--general", "--batch", "--out", folder]
            ran("precess-bake", *words, input=description(name, kinds, count))
            ptx = ptx_of(library, folder, name)
            fused = re.findall(r"\b(?:fma|mad)\.\S*f(?:32|64)", ptx)
            if fused:
                sys.exit(f"{name}: {len(fused)} fused multiply-adds in PTX, such as {fused[0]}")
            # The check can fail: sums and products are there under the names that are looked for.
            if not re.search(r"\bmul\.rn\.f64", ptx) or not re.search(r"\badd\.rn\.f64", ptx):
                sys.exit(f"{name}: PTX without rounded products and sums")
            found[name] = resources(name, ptx, folder)
            run = found[name]["run"]
            print(f"{name}: run {run}", flush=True)
    return found


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--check", action="store_true")
    check = parser.parse_args().check
    found = compiled()
    if not check:
        FIXTURE.write_text(json.dumps(found, indent=1) + "\n")
        return
    stored = json.loads(FIXTURE.read_text())
    if stored.keys() != found.keys():
        sys.exit(f"sets differ from those of {FIXTURE.name}: run gpu.py")
    for name, kernels in found.items():
        for kernel, numbers in kernels.items():
            for what, number in numbers.items():
                budget = stored[name][kernel][what]
                if number > budget:
                    sys.exit(f"{name}: {what} of {kernel}: {number}, budget {budget}")


if __name__ == "__main__":
    main()
