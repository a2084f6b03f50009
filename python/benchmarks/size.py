"""What takes the room in the native module, by the map of a linker of LLVM.

    maturin build --release --manifest-path python/Cargo.toml -- -C link-arg=-Wl,-Map=FILE
    python python/benchmarks/size.py FILE

Prints the table of docs/python.md: the code of each crate that was compiled, that of the library (`precess-dynamics`, generic, so
compiled in the crates that call it) apart.
"""

from __future__ import annotations

import re
import sys
from collections import Counter
from pathlib import Path

#: Address, size, alignment, indent of an input section; object file; name.
SECTION = re.compile(r"\s*[0-9a-f]+\s+[0-9a-f]+\s+([0-9a-f]+)\s+\d+\s{9}(\S.*):\(\.text\.(.*)\)")
LIBRARY = "the library: every kind in plain and in dual numbers"
OURS = {
    "_native": "the binding",
    "precess": "the engine",
    "precess_craft": LIBRARY,
    "precess_lanes": "batches in lanes: every kind but the flexible VSCMG for AVX2 and AVX-512",
}


def main() -> None:
    found: Counter[str] = Counter()
    for line in Path(sys.argv[1]).read_text(errors="replace").splitlines():
        if section := SECTION.match(line):
            size, file, name = section.groups()
            # Of what was optimised together the second word is the crate.
            words = file.split("/")[-1].split(".")
            crate = re.sub(r"-[0-9a-f]{16}$", "", words[1] if words[0] == "_native" else words[0])
            kind = OURS.get(crate, "other crates and the standard library")
            if crate in ("_native", "precess") and ("precess_dynamics" in name or "pulp" in name):
                kind = LIBRARY
            found[kind] += int(size, 16)
    print("| code | MB |\n|---|---:|")
    for kind, size in found.most_common():
        print(f"| {kind} | {size / 1e6:.1f} |")
    print(f"| all | {sum(found.values()) / 1e6:.1f} |")


if __name__ == "__main__":
    main()
