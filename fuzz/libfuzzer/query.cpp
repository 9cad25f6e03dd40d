// libFuzzer: 24 doubles and a kind are a query; the failure-proof CCD must not miss it nor report it from
// afar.
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <iostream>

#include "ccd/subject.hpp"
#include "corpus/query_text.hpp"
#include "oracle/oracle.hpp"

namespace {

using namespace nearmiss;

[[noreturn]] void report(const char* what, const Subject& subject, const Query& query) {
  std::cerr << what << " of " << subject.name() << ": " << short_name(query.kind) << ' ' << to_line(query)
            << '\n';
  std::abort();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  Query query;
  if (size < 1 + sizeof query.x) return -1;
  query.kind = kinds[data[0] % kinds.size()];
  std::memcpy(query.x.data(), data + 1, sizeof query.x);
  if (!is_finite(query)) return -1;
  static const auto subject = make_subject("wang");
  const bool hit = subject->decide(query).hit;
  const bool collision = collides(query);
  if (collision && !hit) report("false negative", *subject, query);
  if (hit && !collision && distance_exceeds(query, subject->distance_bound(query)))
    report("refuted bound", *subject, query);
  return 0;
}
