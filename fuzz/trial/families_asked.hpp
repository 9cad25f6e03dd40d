// Families for a trial that runs inside another program, such as a unit test.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "fuzz/families/families.hpp"
#include "fuzz/trial/trial.hpp"

namespace nearmiss {

/// The families with the given names, restricted to queries of the given kinds. The names `all` and
/// `vertices` stand for groups of families. Without names, returns all families that have queries of these
/// kinds, in the order of a campaign. `separation` applies to families without separations of their own. It
/// is a positive number, or "drawn" for a random separation in each query. If `separation` is "", vv and ve
/// queries get random separations, and the queries of the other kinds ask for contact. Throws Error for an
/// unknown name, and for a family without queries of these kinds.
std::vector<Family> families_asked(const std::vector<std::string>& names, std::span<const Kind> asked,
                                   std::string_view separation = {});

/// Throws Error if the trial would ask some subject no query at all.
void expect_all_asked(const Subjects& subjects, std::span<const Family> families);

}  // namespace nearmiss
