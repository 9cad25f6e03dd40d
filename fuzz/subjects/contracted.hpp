// Subjects that are asked only what their contracts allow.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "ccd/subject.hpp"

namespace nearmiss {

/// A subject with a contract as one that is asked only queries that keep it; others have the fault `contract`. With
/// `asks_beyond`, there is a second subject that is asked only these others, NAME (beyond contract)
/// (reports/statistics/failure.hpp). Nothing changes for a subject without a contract.
std::vector<std::unique_ptr<Subject>> keep_contract(std::unique_ptr<Subject> subject, bool asks_beyond);

/// The subject that keep_contract() took, if it made this one; otherwise this one.
const Subject& without_contract(const Subject& subject);

/// What a contract takes for granted, in words; "" if nothing.
std::string in_words(const Contract& contract);

}  // namespace nearmiss
