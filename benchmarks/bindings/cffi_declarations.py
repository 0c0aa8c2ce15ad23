"""What cffi is told of the C functions; run as a program it writes and compiles the module of its API mode."""

import sys
from pathlib import Path

import cffi

NATIVE = Path(__file__).parents[2] / "garage2usd" / "native"
DECLARATIONS = """
typedef struct { double *at; int64_t layers, rows, columns; } DoubleCube;
typedef struct { double *at; int64_t rows, columns; } DoubleTable;
typedef struct { double *at; int64_t count; } DoubleRow;
typedef struct { DoubleCube shapes; DoubleTable boxes; DoubleRow body; } Scene;
double least_along(const Scene *scene, const double *poses, int64_t steps, const double *bulges, double most);
void mark_touched(const Scene *scene, const double *pose, double margin, bool *is_touched);
"""
builder = cffi.FFI()
builder.cdef(DECLARATIONS)
builder.set_source(
    "sweep_cffi",
    '#include "driving.h"\n'
    "extern double least_along(const Scene *, const double *, int64_t, const double *, double);\n"
    "extern void mark_touched(const Scene *, const double *, double, bool *);\n",
    sources=[str(NATIVE / "sweep.c"), str(NATIVE / "elementary.c")],
    include_dirs=[str(NATIVE)],
    extra_compile_args=["-O3", "-ffp-contract=off", "-fno-math-errno", "-DNDEBUG"],
    py_limited_api=True,
)

if __name__ == "__main__":
    builder.compile(tmpdir=sys.argv[1])
