/* The digest of the sources that the library is compiled from, by which garage2usd.native.load knows a stale one. */
#include "arrays.h"

FROM_PYTHON
const char sources_digest[] = SOURCES_DIGEST;
