#include "ccd/query/queries.h"

const char* nearmiss_version(void) { return NEARMISS_VERSION; }

const char* nearmiss_message(int status) {
  switch (status) {
    case NEARMISS_OK:
      return "all queries are answered";
    case NEARMISS_NOT_FINITE:
      return "a coordinate or a separation is not finite, or a separation is negative";
    case NEARMISS_BAD_ARGUMENT:
      return "a pointer is null; a kind, a type, the number of a query, a width, a largest time or what to "
             "prove is out of range; or wang has a separation";
    case NEARMISS_OUT_OF_MEMORY:
      return "out of memory";
    default:
      return "no status";
  }
}
