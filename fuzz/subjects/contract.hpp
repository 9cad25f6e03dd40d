// Whether a query keeps a subject's contract.
#pragma once

#include "ccd/query/query.hpp"
#include "ccd/subjects/subject.hpp"

namespace nearmiss {

/// Whether the query has all properties that the contract requires, decided exactly. If the four vertices are
/// coplanar at all times, F counts as having more than one root.
bool keeps_contract(const Query& query, const Contract& contract);

}  // namespace nearmiss
