// The class of a query.
#pragma once

#include "ccd/query.hpp"
#include "reports/statistics/query_class.hpp"

namespace nearmiss {

QueryClass classify(const Query& query);

}  // namespace nearmiss
