#include "fuzz/subjects/ladder/scalars.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <utility>

#include "ccd/query/error.hpp"
#include "ccd/query/excerpt.hpp"
#include "ccd/query/scalar_name.hpp"

namespace nearmiss {

namespace {

using ladder::Algorithm;

constexpr std::array<std::pair<std::string_view, Algorithm>, 3> algorithms{
    {{"basic", Algorithm::basic}, {"wang", Algorithm::wang}, {"wang-tight", Algorithm::wang_tight}}};

std::optional<ladder::Scalar> scalar_of(std::string_view name) {
  for (const ladder::Scalar& scalar : named_scalars())
    if (scalar.name == name) return scalar;
  if (ladder::Scalar scalar = ladder::double_with_wide_normals(); scalar.name == name) return scalar;
  if (!name.starts_with('p')) return std::nullopt;
  const int bits = 1 - epsilon_exponent_of(name).value_or(1);
  if (bits < ladder::fewest_bits || bits > ladder::most_bits) return std::nullopt;
  return ladder::bits_scalar(bits);
}

}  // namespace

std::unique_ptr<Subject> try_make_scaled(std::string_view name_and_bound, std::optional<double> given_bound) {
  const SplitName split = split_bound(name_and_bound, given_bound);
  const std::string_view name = split.name;
  const auto colon = name.find(':');
  if (colon == std::string_view::npos || name.find('/') != std::string_view::npos) return nullptr;
  const auto algorithm = std::find_if(algorithms.begin(), algorithms.end(),
                                      [&](const auto& each) { return each.first == name.substr(0, colon); });
  const auto scalar = scalar_of(name.substr(colon + 1));
  if (algorithm == algorithms.end() && !scalar) return nullptr;
  if (algorithm == algorithms.end())
    throw Error(fmt::format("unknown subject '{}', expected basic, wang or wang-tight before the colon",
                            excerpt(name)));
  if (scalar) return scalar->make(name_and_bound, scalar->epsilon_exponent, algorithm->second, split.bound);
  std::string names;
  for (const ladder::Scalar& each : named_scalars()) names += each.name + ", ";
  throw Error(fmt::format("unknown subject '{}', expected a scalar behind the colon: {}p{} to p{}",
                          excerpt(name), names, ladder::fewest_bits, ladder::most_bits));
}

}  // namespace nearmiss
