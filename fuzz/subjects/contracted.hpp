// Subjects that are asked only what their contracts allow.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "ccd/subjects/subject.hpp"

namespace nearmiss {

/// A subject with a contract as one that is asked only queries that keep it; others have the fault `contract`. With
/// `asks_beyond`, there is a second subject that is asked only these others, NAME (beyond contract)
/// (reports/statistics/failure.hpp). Nothing changes for a subject without a contract.
std::vector<std::unique_ptr<Subject>> keep_contract(std::unique_ptr<Subject> subject, bool asks_beyond);

/// What a contract takes for granted, in words; "" if nothing.
std::string in_words(const Contract& contract);

}  // namespace nearmiss
