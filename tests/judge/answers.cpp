// Prints the oracle's answers to queries of all families, and whether certificates prove them: usage:
// judge_answers QUERIES. It prints one line for each query:
//
//   FAMILY:SEED:INDEX KIND ANSWER PROVED TIME TIME PROVED DISTANCE DISTANCE PROVED
//
// ANSWER is 0, 1 or tie. TIME TIME enclose the earliest time, and DISTANCE DISTANCE the smallest distance;
// "-" stands for what there is not. PROVED is 1 or 0.
#include <fmt/format.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <string_view>

#include "corpus/query_text.hpp"
#include "fuzz/families/families.hpp"
#include "oracle/agreement/checked.hpp"
#include "oracle/distance.hpp"
#include "oracle/oracle.hpp"

namespace nearmiss {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Whether a certificate proves a bound of the smallest distance. If it does not, the next double away from
/// the distance may be the proved one.
template <class Certify>
bool is_proved_bound(const Query& query, std::string_view claim, double h, double next,
                     const Certify& certify) {
  const auto is_proved_for = [&](double each, bool is_strict) {
    const Query with_h = with_separation(query, each);
    return proved(certify(with_h, is_strict)) == statement_about(with_h, claim, {}, is_strict);
  };
  return is_proved_for(h, false) || is_proved_for(next, claim == "apart");
}

bool is_proved_distance(const Query& query, const Enclosure& d) {
  const auto apart = [](const Query& each, bool is_strict) { return certify_apart(each, {}, is_strict); };
  const auto meets = [](const Query& each, bool) { return certify_meets(each, {}); };
  return (d.lo == 0 || is_proved_bound(query, "apart", d.lo, std::nextafter(d.lo, 0), apart)) &&
         (d.hi == infinity || is_proved_bound(query, "meets", d.hi, std::nextafter(d.hi, infinity), meets));
}

std::string line(const Query& query) {
  const Decision decision = decide(query);
  const std::string_view answer = decision.is_tie ? "tie" : decision.collision ? "1" : "0";
  std::string text = fmt::format("{} {} {:d}", short_name(query.kind), answer, is_proved(query, decision));
  if (decision.collision || decision.is_tie) {
    const Enclosure t = EarliestTime(query, decision.known).enclosure();
    text +=
        fmt::format(" {} {} {:d}", to_hex(t.lo), to_hex(t.hi), time_disagreement(query, decision).empty());
  } else {
    text += " - - 1";
  }
  const Enclosure d = minimum_distance(query);
  return text + fmt::format(" {} {} {:d}", to_hex(d.lo), to_hex(d.hi), is_proved_distance(query, d));
}

}  // namespace
}  // namespace nearmiss

int main(int argc, char** argv) {
  using namespace nearmiss;
  const auto most = static_cast<std::uint64_t>(argc > 1 ? parse_number(argv[1], "QUERIES") : 1000);
  const auto families = all_families();
  for (std::uint64_t i = 0; i < most; ++i) {
    const Family& family = families[i % families.size()];
    const std::uint64_t index = i / families.size();
    fmt::print("{}:1:{} {}\n", family.name, index, line(make_query(family, 1, index)));
    std::fflush(stdout);
  }
}
