// The harness's own way to ask a subject, as a C function. tests/python/speed.py compares the interfaces with
// it.
#include <algorithm>
#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "fuzz/subjects/built_in.hpp"

namespace {

struct Harness {
  std::unique_ptr<nearmiss::Subject> subject;
  std::vector<nearmiss::Query> queries;
  std::vector<nearmiss::Verdict> verdicts;
};

}  // namespace

extern "C" {

/// A built-in subject, with `count` queries of 24 coordinates each; `kind` has the values of queries.h.
[[gnu::visibility("default")]] void* harness_new(const char* subject, int kind, const double* x,
                                                 std::size_t count) {
  auto* const harness = new Harness{nearmiss::make_built_in(subject), std::vector<nearmiss::Query>(count),
                                    std::vector<nearmiss::Verdict>(count)};
  for (nearmiss::Query& query : harness->queries) {
    query.kind = kind == 1 ? nearmiss::Kind::vertex_triangle : nearmiss::Kind::edge_edge;
    std::copy_n(x, query.x.size(), query.x.begin());
    x += query.x.size();
  }
  return harness;
}

/// Asks the subject all queries.
[[gnu::visibility("default")]] void harness_decide(void* harness) {
  auto& [subject, queries, verdicts] = *static_cast<Harness*>(harness);
  subject->decide(queries, verdicts);
}

[[gnu::visibility("default")]] void harness_delete(void* harness) { delete static_cast<Harness*>(harness); }
}
