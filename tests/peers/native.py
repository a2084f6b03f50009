"""How each native runner is compiled: compiler, flags, headers, libraries."""

import importlib.metadata
import json
import sysconfig
import threading
from pathlib import Path

from build import Missing, compiler, make, version_of

HERE = Path(__file__).resolve().parent
ROOT = HERE.parent.parent
SOURCES = HERE / "native"
PACKAGES = Path(sysconfig.get_path("purelib"))
PREFIX = PACKAGES / "cmeel.prefix"

# `-w`: what the compilers warn of is in the packages' headers.
COMMON = ["-std=c++17", "-DNDEBUG", "-w", f"-isystem{PREFIX}/include"]
# The definitions are those of Pinocchio's own CMake package.
PINOCCHIO = [
    *COMMON, f"-isystem{PREFIX}/include/eigen3",
    "-DBOOST_MPL_LIMIT_LIST_SIZE=30", "-DBOOST_MPL_LIMIT_VECTOR_SIZE=30",
    "-DBOOST_MPL_CFG_NO_PREPROCESSED_HEADERS", "-DBOOST_FUSION_INVOKE_MAX_ARITY=12",
]  # fmt: skip
PLAIN = ["-O3", "-march=native"]
# The quickest of the sets in README.md.
BEST = [*PLAIN, "-DEIGEN_DONT_VECTORIZE", "-fno-vectorize", "-fno-slp-vectorize"]

# The code is without loops: 25 thousand statements at N = 16, a hundred thousand at N = 64.
GENERATED = [1, 2, 4, 8, 16]

# Of derivatives; the generated code has hundreds of thousands of statements at N = 16, which take minutes to compile.
DERIVATIVES_OF = [1, 4, 16]
GENERATED_DERIVATIVES = [1, 4]
GENERATOR = threading.Lock()
# Of CasADi's Jacobian gcc takes more than five minutes at -O3; both have no loops to optimise.
STRAIGHT = ["-O1", "-march=native"]


def pinocchio_default(into):
    gxx = compiler("g++", "g++")
    command = runner(into / "pinocchio-default", "pinocchio_aba.cpp", [gxx, *PLAIN, *PINOCCHIO])
    return command, f"pin {version('pin')}; {version_of(gxx)}; {' '.join(PLAIN)}"


def pinocchio_best(into):
    clang = compiler("clang++", "clang")
    command = runner(into / "pinocchio-best", "pinocchio_aba.cpp", [clang, *BEST, *PINOCCHIO])
    return command, f"pin {version('pin')}; {version_of(clang)}; {' '.join(BEST)}"


def casadi(into):
    """The generator, then C for each size, then what calls it."""
    gxx, gcc = compiler("g++", "g++"), compiler("gcc", "gcc")
    package = PACKAGES / "casadi"
    # Without optimisation: the generator runs for seconds, but would take minutes to compile.
    [generate] = runner(
        into / "casadi-generate", "casadi_generate.cpp",
        [gxx, "-O0", *PINOCCHIO, f"-isystem{package}/include"],
        [package / "libcasadi.so", f"-Wl,-rpath,{package}"],
    )  # fmt: skip
    counts, objects = [], []
    for n in GENERATED:
        given, code, compiled = into / f"{n}.json", into / f"aba_{n}.c", into / f"aba_{n}.o"
        printed = make(code, [given, generate], [generate, given, f"{into}/"])
        # Not position-independent code of a library: that is 5 to 9 % slower.
        make(compiled, [code], [gcc, *PLAIN, "-c", code, "-o", compiled])
        objects.append(compiled)
        count = json.loads(printed)
        counts.append(f"N = {n}: {count['arithmetic']} + {count['trigonometric']} trigonometric")
    command = runner(into / "casadi", "casadi_aba.cpp", [gxx, *PLAIN, *COMMON], objects)
    return command, (
        f"casadi {version('casadi')} over pin {version('pin')}; {version_of(gcc)}; "
        f"{' '.join(PLAIN)}; operations {', '.join(counts)}"
    )


def pinocchio_derivatives(into):
    clang = compiler("clang++", "clang")
    program, source = into / "pinocchio-derivatives", "pinocchio_derivatives.cpp"
    command = runner(program, source, [clang, *BEST, *PINOCCHIO])
    return command, f"pin {version('pin')}; {version_of(clang)}; {' '.join(BEST)}"


def casadi_derivatives(into, what):
    """The generator, then C for each size, then what calls it: `jacobian` or `analytic`."""
    gxx, gcc = compiler("g++", "g++"), compiler("gcc", "gcc")
    package = PACKAGES / "casadi"
    # Peers are prepared side by side, and both need it.
    with GENERATOR:
        [generate] = runner(
            into / "casadi-generate-derivatives", "casadi_generate_derivatives.cpp",
            [gxx, "-O0", *PINOCCHIO, f"-isystem{package}/include"],
            [package / "libcasadi.so", f"-Wl,-rpath,{package}"],
        )  # fmt: skip
    flags = STRAIGHT if what == "jacobian" else PLAIN
    counts, objects = [], []
    for n in GENERATED_DERIVATIVES:
        given = into / "derivatives" / f"{n}.json"
        code, compiled = into / f"{what}_{n}.c", into / f"{what}_{n}.o"
        printed = make(code, [given, generate], [generate, given, f"{into}/", what])
        make(compiled, [code], [gcc, *flags, "-c", code, "-o", compiled])
        objects.append(compiled)
        counts.append(f"N = {n}: {json.loads(printed)['operations']}")
    command = runner(
        into / f"casadi-{what}", "casadi_derivatives.cpp",
        [gxx, *PLAIN, *COMMON, f"-DWHAT={what}"], objects,
    )  # fmt: skip
    return command, (
        f"casadi {version('casadi')} over pin {version('pin')}; {version_of(gcc)}; "
        f"{' '.join(flags)}; operations {', '.join(counts)}"
    )


def mujoco(into, source="mujoco_smooth"):
    gxx = compiler("g++", "g++")
    package = PACKAGES / "mujoco"
    [library] = package.glob("libmujoco.so.*")
    command = runner(
        into / source.replace("_", "-"), f"{source}.cpp",
        [gxx, *PLAIN, *COMMON, f"-isystem{package}/include"],
        [library, f"-Wl,-rpath,{package}"],
    )  # fmt: skip
    return command, f"mujoco {version('mujoco')} of PyPI, built as it comes; called from C++"


def library(into, archive):
    """The C library of Precess, which is Rust behind `precess.h`: linked, not compiled here."""
    gxx = compiler("g++", "g++")
    if not archive.exists():
        raise Missing(f"no {archive.name}; build it with `cargo xtask capi`")
    command = runner(
        into / "precess-library", "precess_library.cpp",
        [gxx, *PLAIN, *COMMON, f"-I{ROOT / 'flight' / 'capi' / 'include'}"], [archive],
    )  # fmt: skip
    return command, "`libprecess.a`, called from C++"


def runner(program, source, compile_words, link_words=()):
    """The command of a runner, compiled of its source and of objects made before."""
    sources = [HERE / "requirements.txt", SOURCES / source, *sorted(SOURCES.glob("*.hpp"))]
    sources += [word for word in link_words if str(word).endswith((".o", ".a"))]
    make(program, sources, [*compile_words, SOURCES / source, "-o", program, *link_words])
    return [program]


def version(package):
    return importlib.metadata.version(package)
