// Subjects that are asked only what their contracts allow.
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "ccd/subject.hpp"

namespace nearmiss {

/// What follows the name of a subject in results for queries beyond its contract.
inline constexpr std::string_view beyond_contract = " (beyond contract)";

/// A subject with a contract as one that is asked only queries that keep it; others have the fault `contract`. With
/// `asks_beyond`, there is a second subject, NAME (beyond contract), that is asked only these others. Nothing changes for
/// a subject without a contract.
std::vector<std::unique_ptr<Subject>> keep_contract(std::unique_ptr<Subject> subject, bool asks_beyond);

/// What a contract takes for granted, in words; "" if nothing.
std::string in_words(const Contract& contract);

}  // namespace nearmiss
