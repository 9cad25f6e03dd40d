#include "fuzz/ladder/scalars.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string>
#include <utility>

#include "ccd/error.hpp"

namespace nearmiss {

namespace {

using ladder::Algorithm;

constexpr std::array<std::pair<std::string_view, Algorithm>, 3> algorithms{
    {{"basic", Algorithm::basic}, {"wang", Algorithm::wang}, {"wang-tight", Algorithm::wang_tight}}};

}  // namespace

std::unique_ptr<Subject> try_make_scaled(std::string_view name_and_bound, std::optional<double> given_bound) {
  const SplitName split = split_bound(name_and_bound, given_bound);
  const std::string_view name = split.name;
  const auto colon = name.find(':');
  if (colon == std::string_view::npos || name.find('/') != std::string_view::npos) return nullptr;
  const auto algorithm = std::find_if(algorithms.begin(), algorithms.end(),
                                      [&](const auto& each) { return each.first == name.substr(0, colon); });
  if (algorithm == algorithms.end())
    throw Error(
        fmt::format("unknown subject '{}', expected basic, wang or wang-tight before the colon", name));
  std::string names;
  for (const ladder::Scalar& scalar : scalars()) {
    if (scalar.name == name.substr(colon + 1))
      return scalar.make(name_and_bound, algorithm->second, split.bound);
    names += fmt::format("{}{}", names.empty() ? "" : ", ", scalar.name);
  }
  throw Error(
      fmt::format("unknown subject '{}', expected one of these scalars behind the colon: {}", name, names));
}

}  // namespace nearmiss
