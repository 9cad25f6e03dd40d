#include "oracle/agreement.hpp"

#include <bit>
#include <cstdint>

#include "oracle/oracle.hpp"

namespace nearmiss {

std::string Answers::disagreement() const {
  std::string parts;
  const auto check = [&](bool fits, const char* part) {
    if (!fits) parts.append(parts.empty() ? "" : " ").append(part);
  };
  check(exact == sturm.collision, "exact");
  check(parity.on_boundary == sturm.on_boundary, "boundary");
  check(parity.on_boundary || parity.odd == sturm.odd(), "parity");
  return parts;
}

Answers ask_all(const Query& query) { return ask_others(query, collides_exactly(query)); }

Answers ask_others(const Query& query, bool exact) { return {exact, count_roots(query), root_parity(query)}; }

bool is_sampled(const Query& query, std::uint64_t one_in) {
  std::uint64_t hash = static_cast<std::uint64_t>(query.kind);
  for (const double c : query.x) {
    hash = (hash ^ std::bit_cast<std::uint64_t>(c)) * 0x9e3779b97f4a7c15;
    hash ^= hash >> 32;
  }
  return hash % one_in == 0;
}

}  // namespace nearmiss
