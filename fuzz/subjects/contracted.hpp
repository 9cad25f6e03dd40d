// Contracts, and subjects that are asked only queries that keep their contracts.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "ccd/subjects/subject.hpp"

namespace nearmiss {

/// Whether the query has all properties that the contract requires; the result is exact. If the four vertices
/// are coplanar at all times, their volume F(t) counts as having more than one root.
bool keeps_contract(const Query& query, const Contract& contract);

/// Makes a subject that asks `subject` only the queries that keep its contract; all other queries get the
/// fault `contract`. With `asks_beyond`, also makes the subject "NAME (beyond contract)"
/// (reports/statistics/failure.hpp), which asks `subject` only the queries that break its contract. A subject
/// without a contract is returned unchanged.
std::vector<std::unique_ptr<Subject>> keep_contract(std::unique_ptr<Subject> subject, bool asks_beyond);

/// The requirements of a contract, in words; "" if the contract has none.
std::string in_words(const Contract& contract);

}  // namespace nearmiss
