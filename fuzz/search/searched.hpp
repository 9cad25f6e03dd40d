// The subject of a directed search, and what all searches have in common.
#pragma once

#include <atomic>
#include <functional>
#include <string_view>

#include "ccd/subjects/subject.hpp"
#include "fuzz/families/families.hpp"
#include "fuzz/search/maximiser.hpp"
#include "fuzz/stop.hpp"

namespace nearmiss {

/// The subject of some searches.
class Searched {
 public:
  Searched(const Subject& subject, const Stop& stop, ChooseSeparation separation)
      : subject_(subject), stop_(stop), separation_(std::move(separation)) {}

  [[nodiscard]] const Subject& operator*() const { return subject_; }
  [[nodiscard]] const Subject* operator->() const { return &subject_; }

  /// Draws the separation of one search. It is 0, and takes no random number, if the search is for contact.
  [[nodiscard]] double separation(Random& random, Kind kind) const;

  using Value = std::function<double(const Verdict&)>;

  /// The objective of a query: `value` of the subject's answer. It is `unwanted` if the query is not finite
  /// or breaks the subject's contract, or if the subject is not asked any more. It is `if_slow` if the answer
  /// exceeds the time limit. Throws Stopped.
  [[nodiscard]] double objective(const Query& query, const Value& value,
                                 const std::function<double()>& if_slow) const;

  /// Counts a search that the time limit ended. After a few of these, the subject is not asked any more.
  void count_slow_search() const { ++slow_searches_; }

 private:
  const Subject& subject_;
  const Stop& stop_;
  ChooseSeparation separation_;
  mutable std::atomic<int> slow_searches_ = 0;
};

/// One search: the best of the queries that it tries.
using SearchOne = Query (*)(const Searched&, Random&, Kind);

/// The family of a search's results. Its name consists of the prefix and the subject's name.
Family search_family(std::string_view prefix, std::string_view about, SearchOne search_one,
                     const Subject& subject, const Stop& stop, std::string_view separation);

}  // namespace nearmiss
