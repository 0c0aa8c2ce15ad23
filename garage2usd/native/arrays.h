/* NumPy arrays in C order: the address of the first number, and the shape. */
#ifndef GARAGE2USD_ARRAYS_H
#define GARAGE2USD_ARRAYS_H

#include <stdbool.h>
#include <stdint.h>
#ifndef NDEBUG
#include <stdio.h>
#include <stdlib.h>
#endif

/* A function that garage2usd.native finds by its name; all others stay within the library. */
#if defined(_WIN32)
#define FROM_PYTHON __declspec(dllexport)
#elif defined(__APPLE__)
#define FROM_PYTHON __attribute__((visibility("default")))
#else
#define FROM_PYTHON __attribute__((visibility("protected")))
#endif

#define ROW_OF(type) struct { type *at; int64_t count; }
#define TABLE_OF(type) struct { type *at; int64_t rows, columns; }
#define CUBE_OF(type) struct { type *at; int64_t layers, rows, columns; }

typedef ROW_OF(bool) BoolRow;
typedef ROW_OF(int8_t) Int8Row;
typedef ROW_OF(int32_t) Int32Row;
typedef ROW_OF(int64_t) Int64Row;
typedef ROW_OF(uint64_t) UInt64Row;
typedef ROW_OF(double) DoubleRow;
typedef TABLE_OF(bool) BoolTable;
typedef TABLE_OF(int8_t) Int8Table;
typedef TABLE_OF(int32_t) Int32Table;
typedef TABLE_OF(int64_t) Int64Table;
typedef TABLE_OF(float) FloatTable;
typedef TABLE_OF(double) DoubleTable;
typedef CUBE_OF(int32_t) Int32Cube;
typedef CUBE_OF(int64_t) Int64Cube;
typedef CUBE_OF(double) DoubleCube;

/* Entries of arrays: `AT(row, index)`, `IN(table, row, column)`, and `PLACE(table, place)` by row * columns + column.
 *
 * The package is compiled with NDEBUG, which leaves the checks out. Without it, as in the tests with sanitizers, an
 * index outside its array ends the program; sanitizers miss an index that meets another row or another array. */
#ifndef NDEBUG
static inline int64_t within(int64_t index, int64_t count, const char *array, const char *file, int line)
{
    if (index < 0 || index >= count) {
        fprintf(stderr, "%s:%d: index %lld of %s, which has %lld\n", file, line, (long long)index, array,
                (long long)count);
        abort();
    }
    return index;
}
#define WITHIN(index, count, array) within(index, count, array, __FILE__, __LINE__)
#else
#define WITHIN(index, count, array) (index)
#endif
#define AT(row, index) ((row).at[WITHIN(index, (row).count, #row)])
#define PLACE(table, place) ((table).at[WITHIN(place, (table).rows * (table).columns, #table)])
#define IN(table, row, column) \
    ((table).at[WITHIN(row, (table).rows, "rows of " #table) * (table).columns + \
                WITHIN(column, (table).columns, "columns of " #table)])

#endif
