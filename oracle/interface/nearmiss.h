/** \file
 * The C interface of nearmiss: exact answers (oracle.h) and the failure-proof CCD (wang.h) for queries in the
 * caller's memory (queries.h). C99. Link with -lnearmiss. */
#ifndef NEARMISS_H
#define NEARMISS_H

#include "ccd/query/queries.h"
#include "ccd/wang/wang.h"
#include "oracle/interface/oracle.h"

#endif
