#include "fuzz/libfuzzer/reader_target.hpp"

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <sstream>
#include <string>

#include "ccd/query/error.hpp"
#include "ccd/query/printable.hpp"
#include "corpus/query_text.hpp"

namespace nearmiss::libfuzzer {

namespace {

/// Whether two queries have the same bits. Unlike ==, this function distinguishes 0 from -0.
bool same_bits(const Query& a, const Query& b) {
  return a.kind == b.kind && a.separation == b.separation &&
         std::memcmp(a.x.data(), b.x.data(), sizeof a.x) == 0;
}

}  // namespace

void expect(bool condition, const char* what) {
  if (condition) return;
  std::fprintf(stderr, "expected %s\n", what);
  std::abort();
}

void expect_round_trip(const Case& each) {
  std::istringstream text(to_text(each));
  const Case again = parse_case(text, "again");
  expect(same_bits(again.query, each.query), "the same query");
  expect(again.truth == each.truth, "the same truth");
  // to_text does not write unprintable characters.
  expect(printable(again.why) == printable(each.why) && to_text(again) == to_text(each), "the same reason");
  expect(again.provenance == printable(each.provenance), "the same provenance");
  expect(same_bits(parse_line(each.query.kind, to_line(each.query), "again"), each.query), "the same line");
}

void expect_sound(const Mesh& mesh) {
  const int points = static_cast<int>(mesh.points.size());
  const auto exists = [&](int i) { return 0 <= i && i < points; };
  expect(points > 0, "a point");
  for (const auto& p : mesh.points) expect(p.allFinite(), "finite coordinates");
  for (const auto& t : mesh.triangles) expect(std::all_of(t.begin(), t.end(), exists), "vertices that exist");
  for (const auto& l : mesh.lines) expect(std::all_of(l.begin(), l.end(), exists), "vertices that exist");
}

}  // namespace nearmiss::libfuzzer

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  std::istringstream in(std::string(reinterpret_cast<const char*>(data), size));
  try {
    nearmiss::libfuzzer::read(in);
  } catch (const nearmiss::Error&) {
    return 0;  // refused
  }
  return 0;
}
