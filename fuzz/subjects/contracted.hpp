// Contracts, and subjects that are asked only what their contracts allow.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "ccd/subjects/subject.hpp"

namespace nearmiss {

/// Whether the query has all properties that the contract requires, decided exactly. If the four vertices are
/// coplanar at all times, F counts as having more than one root.
bool keeps_contract(const Query& query, const Contract& contract);

/// For a subject with a contract, makes one that is asked only queries that keep the contract; all other
/// queries get the fault `contract`. If `asks_beyond`, makes a second subject that is asked only these
/// others, with the name "NAME (beyond contract)" (reports/statistics/failure.hpp). A subject without a
/// contract is returned unchanged.
std::vector<std::unique_ptr<Subject>> keep_contract(std::unique_ptr<Subject> subject, bool asks_beyond);

/// The requirements of a contract, in words; "" if it has none.
std::string in_words(const Contract& contract);

}  // namespace nearmiss
