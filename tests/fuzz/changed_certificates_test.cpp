// A changed certificate never proves a false statement.
#include <gmpxx.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "corpus/query_text.hpp"
#include "fuzz/families/families.hpp"
#include "fuzz/random.hpp"
#include "oracle/certificates/certificate.hpp"
#include "oracle/oracle.hpp"
#include "reports/text/json.hpp"
#include "tests/fuzz/family_queries.hpp"
#include "tools/certificates/check.hpp"

namespace nearmiss {
namespace {

using certificates::Statement;
using nlohmann::json;

/// Whether the oracle agrees with a statement about a span that begins at t = 0. Returns nothing for a
/// statement about any other span.
std::optional<bool> is_true(const Statement& statement) {
  if (statement.from != 0 || statement.to != mpq_class(statement.to.get_d())) return std::nullopt;
  const Kind kind = parse_kind(statement.kind, "kind");
  const Query query = with_separation(nearmiss::query_of(kind, statement.x.data()), statement.h);
  const bool is_apart = statement.claim == "apart";
  auto time = earliest_time(query);
  if (!time) return is_apart;
  const double end = statement.to.get_d();
  // In a query with a separation, `time` is the first time at which the distance equals the separation. A
  // later time is late only if the distance falls below the separation before that later time.
  const bool within = time->is_before(statement.open ? end : std::nextafter(end, 2.0));
  const bool below =
      query.separation > 0 && time->makes_late(statement.open ? end : std::nextafter(end, 2.0));
  if (is_apart) return statement.strict ? !within : !below;
  return statement.strict ? below : within;
}

std::size_t index_below(std::size_t size, Random& random) {
  return static_cast<std::size_t>(random.integer(0, static_cast<int>(size) - 1));
}

void change_bit(json& number, Random& random) {
  const double x = std::strtod(number.get<std::string>().c_str(), nullptr);
  const auto changed =
      std::bit_cast<double>(std::bit_cast<std::uint64_t>(x) ^ (1ULL << random.integer(0, 63)));
  if (std::isfinite(changed)) number = to_hex(changed);
}

void swap_vertices(json& x, Random& random) {
  const std::size_t vertices = x.size() / 6;
  const std::size_t a = index_below(vertices, random);
  const std::size_t b = index_below(vertices, random);
  for (std::size_t k = 0; k < 3; ++k)
    for (const std::size_t end : {std::size_t{0}, 3 * vertices})
      std::swap(x[end + 3 * a + k], x[end + 3 * b + k]);
}

/// Removes the proof's last or first piece, or exchanges two of the proof's numbers.
void change_proof(json& certificate, Random& random) {
  if (certificate.contains("normals")) {
    const bool first = random.integer(0, 1) == 0;
    for (const char* key : {"times", "normals"}) {
      json& list = certificate[key];
      list.erase(first ? 0 : list.size() - 1);
    }
    if (first)
      certificate["times"].front() = certificate["from"];
    else
      certificate["times"].back() = certificate["to"];
    return;
  }
  json& list = certificate[certificate.contains("weights") ? "weights" : "bracket"];
  std::swap(list[index_below(list.size(), random)], list[index_below(list.size(), random)]);
}

/// Changes one character of a text: a digit, a sign, or a letter.
std::string with_another_character(std::string text, Random& random) {
  constexpr std::string_view alphabet = "0123456789abcdefp-/x";
  text[index_below(text.size(), random)] = alphabet[index_below(alphabet.size(), random)];
  return text;
}

std::string changed(const std::string& text, Random& random) {
  const int change = random.integer(0, 7);
  if (change < 2) return with_another_character(text, random);
  json certificate = json::parse(text);
  if (change == 2) change_bit(certificate["x"][index_below(certificate["x"].size(), random)], random);
  if (change == 3) swap_vertices(certificate["x"], random);
  if (change == 4) change_proof(certificate, random);
  if (change == 5) change_bit(certificate[random.integer(0, 1) == 0 ? "h" : "to"], random);
  if (change == 6) certificate["claim"] = certificate["claim"] == "apart" ? "meets" : "apart";
  if (change == 7) certificate["strict"] = !certificate.value("strict", certificate["claim"] == "apart");
  return certificate.dump();
}

TEST(ChangedCertificate, ProvesNothingFalse) {
  Random random(1, 2, 3);
  int changes = 0;
  int accepted = 0;
  int judged = 0;
  for (const Family& family : all_families())
    for (std::uint64_t i = 0; i < testing::query_count(4); ++i)
      for (const auto& text : certify_time(make_query(family, 1, i)))
        for (int change = 0; text && change < 20; ++change) {
          const std::string line = changed(*text, random);
          ++changes;
          try {
            const Statement claimed = certificates::check(line);
            ++accepted;
            const auto truth = is_true(claimed);
            EXPECT_TRUE(truth.value_or(true)) << line;
            judged += truth ? 1 : 0;
          } catch (const certificates::Refused&) {
          }
        }
  EXPECT_GT(accepted, changes / 20);
  EXPECT_GT(judged, accepted / 2);
}

}  // namespace
}  // namespace nearmiss
