// The built-in subjects.
#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

#include "ccd/query/arithmetic.hpp"
#include "ccd/query/error.hpp"
#include "ccd/query/excerpt.hpp"
#include "ccd/subjects/number_options.hpp"
#include "ccd/subjects/plugin.hpp"
#include "ccd/subjects/stopwatch.hpp"
#include "ccd/subjects/subject.hpp"
#include "ccd/wang/advance.hpp"
#include "ccd/wang/basic.hpp"
#include "ccd/wang/bounds/tight_tolerances.hpp"
#include "ccd/wang/bridson.hpp"
#include "ccd/wang/closest_approach.hpp"
#include "ccd/wang/loosened.hpp"
#include "ccd/wang/pair_bound.hpp"
#include "ccd/wang/wang.hpp"
#include "ccd/wang/wang_batch.hpp"
#include "ccd/wang/wang_time.hpp"
#include "ccd/wang/within.hpp"

namespace nearmiss {

namespace {

/// A built-in subject. Its Policy has the members below, in which `given` is the bound that replaces the
/// pair's own bound:
/// - `template <Kind> Verdict decide(query, given)` for vt and ee. It takes separations if the constant
///   `takes_separation` is true.
/// - `Verdict decide_within(query, given)` for vv and ve, always with separations.
/// - `double distance_bound(query, given)` and `double needed_tolerance(query, given)`.
/// - The constants `claims_bound` and `time_sort`.
/// - A number for each option.
template <class Policy, bool is_batched = false>
class BuiltInSubject final : public Subject {
 public:
  BuiltInSubject(std::string_view name, std::optional<double> given, const Policy& policy = {})
      : name_(name), given_(given), policy_(policy) {}

  [[nodiscard]] const std::string& name() const override { return name_; }

  [[nodiscard]] Verdict decide(const Query& query) const override {
    const PlainArithmetic guard;
    return decide_plainly(query);
  }

  void decide(std::span<const Query> queries, std::span<Verdict> verdicts) const override {
    const PlainArithmetic guard;
    if constexpr (is_batched) {
      wang_in_lanes(QueryRows(queries), verdicts, given_);
      for (std::size_t i = 0; i < queries.size(); ++i)
        if (!is_decided(verdicts[i])) verdicts[i] = decide_plainly(queries[i]);
    } else {
      for (std::size_t i = 0; i < queries.size(); ++i) verdicts[i] = decide_plainly(queries[i]);
    }
  }

  [[nodiscard]] double distance_bound(const Query& query) const override {
    const PlainArithmetic guard;
    return policy_.distance_bound(query, given_);
  }

  [[nodiscard]] double needed_tolerance(const Query& query) const override {
    const PlainArithmetic guard;
    return policy_.needed_tolerance(query, given_);
  }

  [[nodiscard]] bool claims_bound() const override { return Policy::claims_bound; }
  [[nodiscard]] bool decides(Kind /*kind*/) const override { return true; }
  [[nodiscard]] bool takes_separation(Kind kind) const override {
    return !is_of_meshes(kind) || Policy::takes_separation;
  }
  [[nodiscard]] TimeSort time_sort() const override { return Policy::time_sort; }

 private:
  [[nodiscard]] Verdict decide_plainly(const Query& query) const {
    if (!is_finite(query)) refuse_coordinates(name_);
    if (!is_of_meshes(query.kind)) return policy_.decide_within(query, given_);
    return with_kind(query.kind, [&]<Kind kind>() { return policy_.template decide<kind>(query, given_); });
  }

  std::string name_;
  std::optional<double> given_;
  Policy policy_;
};

template <bool plane_culling>
struct Basic {
  static constexpr bool claims_bound = false;
  static constexpr bool takes_separation = false;
  static constexpr TimeSort time_sort = TimeSort::estimate;

  template <Kind kind>
  static Verdict decide(const Query& query, const std::optional<double>& /*given*/) {
    return basic<kind, double, plane_culling>(query);
  }
  static Verdict decide_within(const Query& query, const std::optional<double>& /*given*/) {
    return closest_approach<plane_culling>(query);
  }
  static double distance_bound(const Query& /*query*/, const std::optional<double>& /*given*/) {
    return std::numeric_limits<double>::infinity();
  }
  static double needed_tolerance(const Query& /*query*/, const std::optional<double>& /*given*/) {
    return std::numeric_limits<double>::quiet_NaN();
  }
};

struct Bridson : Basic<false>, BridsonTolerances {
  template <Kind kind>
  [[nodiscard]] Verdict decide(const Query& query, const std::optional<double>& /*given*/) const {
    return bridson<kind>(query, *this);
  }
};

/// The policy of the empty subject, which computes nothing.
struct Empty : Basic<false> {
  template <Kind kind>
  static Verdict decide(const Query& /*query*/, const std::optional<double>& /*given*/) {
    return {};
  }
  static Verdict decide_within(const Query& /*query*/, const std::optional<double>& /*given*/) { return {}; }
};

template <WangOptions options, class Rule = PaperTolerances>
struct Wang : Rule {
  static constexpr bool claims_bound = true;
  static constexpr bool takes_separation = false;
  static constexpr TimeSort time_sort = TimeSort::none;

  template <Kind kind>
  [[nodiscard]] Verdict decide(const Query& query, const std::optional<double>& given) const {
    return wang<kind, double, options, Rule>(query, given, *this);
  }
  static Verdict decide_within(const Query& query, const std::optional<double>& given) {
    return wang_within<double, Rule>(query, options.plane_culling, given);
  }
  static double distance_bound(const Query& query, const std::optional<double>& given) {
    if (!is_of_meshes(query.kind)) return within_distance_bound<Rule>(query, given);
    return distance_bound_of(Rule()(1.0), given.value_or(pair_bound(query)));
  }
  [[nodiscard]] double needed_tolerance(const Query& query, const std::optional<double>& given) const {
    return least_loosening([&](double s) {
      const Loosened<Rule> tolerances{*this, s};
      if (!is_of_meshes(query.kind))
        return wang_within<double>(query, options.plane_culling, given, tolerances).hit;
      return with_kind(
          query.kind, [&]<Kind kind>() { return wang<kind, double, options>(query, given, tolerances).hit; });
    });
  }
};

/// The paper's tolerances with a given interval h for VE culling.
struct WithInterval : PaperTolerances {
  double h = PaperTolerances()(1.0).h;

  template <class T>
  [[nodiscard]] Tolerances<T> operator()(T B) const {
    Tolerances<T> tol = PaperTolerances::operator()(B);
    tol.h = static_cast<T>(h);
    return tol;
  }
};
using WangEps = Wang<WangOptions{true, VeCulling::fixed}, WithInterval>;

template <WangOptions options>
struct WangTime : Wang<options> {
  static constexpr TimeSort time_sort = TimeSort::lower_bound;

  template <Kind kind>
  static Verdict decide(const Query& query, const std::optional<double>& given) {
    return wang_time<kind, double, options>(query, given);
  }
  static Verdict decide_within(const Query& query, const std::optional<double>& given) {
    return wang_within_time<double>(query, options.plane_culling, given);
  }
};

struct Advance {
  static constexpr bool claims_bound = true;
  static constexpr bool takes_separation = true;
  static constexpr TimeSort time_sort = TimeSort::lower_bound;

  template <Kind kind>
  static Verdict decide(const Query& query, const std::optional<double>& /*given*/) {
    return advance<kind, double>(query);
  }
  static Verdict decide_within(const Query& query, const std::optional<double>& given) {
    return decide<Kind::vertex_triangle>(query, given);
  }
  static double distance_bound(const Query& query, const std::optional<double>& /*given*/) {
    const double bound =
        with_kind(query.kind, [&]<Kind kind>() { return advance_distance_bound<kind, double>(query); });
    return std::nextafter(bound, std::numeric_limits<double>::infinity());
  }
  static double needed_tolerance(const Query& /*query*/, const std::optional<double>& /*given*/) {
    return std::numeric_limits<double>::quiet_NaN();
  }
};

template <class Policy>
constexpr std::array<Option<Policy>, 0> options_of{};
template <>
constexpr std::array<Option<Bridson>, 2> options_of<Bridson>{
    {{"thickness", &Bridson::thickness, 0, 1e300}, {"barycentric", &Bridson::barycentric, 0, 1e300}}};
template <>
constexpr std::array<Option<WangEps>, 1> options_of<WangEps>{{{"h", &WangEps::h, 1e-300, 1}}};

struct Entry {
  SubjectInfo info;
  /// Makes the subject `name` with these options. Returns null if `options` is not empty, but the subject has
  /// no options.
  std::unique_ptr<Subject> (*make)(std::string_view name, const std::string& options,
                                   std::optional<double> given);
};

template <class Policy, bool is_batched = false>
constexpr Entry entry(std::string_view name, std::string_view about) {
  return {{name, about},
          [](std::string_view own_name, const std::string& options,
             std::optional<double> given) -> std::unique_ptr<Subject> {
            Policy policy;
            if constexpr (options_of<Policy>.empty()) {
              if (!options.empty()) return nullptr;
            } else {
              const std::string fault = set_options(options_of<Policy>, options, policy);
              if (!fault.empty()) throw Error("subject '" + excerpt(own_name) + "': " + fault);
            }
            return std::make_unique<BuiltInSubject<Policy, is_batched>>(own_name, given, policy);
          }};
}

constexpr std::array registry{
    entry<Basic<true>>(
        "basic", "cubic CCD, or closest approach of vertices and edges, without any tolerance: the baseline"),
    entry<Basic<false>>("basic-plain", "the same without plane culling"),
    entry<Bridson>("bridson",
                   "the same with the user's tolerances: bridson:thickness=LENGTH:barycentric=NUMBER"),
    entry<Wang<WangOptions{true, VeCulling::per_root}>, true>(
        "wang", "the failure-proof CCD: plane culling, vertex-edge culling with an interval for each root"),
    entry<Wang<WangOptions{true, VeCulling::per_root}>>("wang-scalar", "the same, one query at a time"),
    entry<WangEps>("wang-eps",
                   "the same with a fixed interval: the paper's square root of epsilon, or wang-eps:h=TIME"),
    entry<Wang<WangOptions{false, VeCulling::per_root}>>("wang-no-planes",
                                                         "wang-scalar without plane culling"),
    entry<Wang<WangOptions{false, VeCulling::none}>>("wang-plain", "the same without either culling"),
    entry<Wang<WangOptions{true, VeCulling::per_root}, TightTolerances>>(
        "wang-tight", "wang with the smallest tolerances that its proof allows"),
    entry<WangTime<WangOptions{true, VeCulling::per_root}>>(
        "wang-time", "wang with a lower bound of the earliest time at which the distance is at most h"),
    entry<Advance>("advance", "conservative advancement: steps in time that cannot be too long"),
};

}  // namespace

std::vector<SubjectInfo> subjects() {
  std::vector<SubjectInfo> infos;
  for (const Entry& each : registry) infos.push_back(each.info);
  return infos;
}

BatchTime Subject::decide_timed(std::span<const Query> queries, std::span<Verdict> verdicts) const {
  const std::size_t few = std::min(warm_up_queries, queries.size());
  for (const Subject* each : {&empty(), this}) each->decide(queries.first(few), verdicts.first(few));
  return {queries.size(), time_beyond(
                              CLOCK_THREAD_CPUTIME_ID, [&] { decide(queries, verdicts); },
                              [&] { empty().decide(queries, verdicts); })};
}

void Subject::time_each(std::span<const Query> queries,
                        std::span<std::optional<std::uint64_t>> nanoseconds) const {
  Verdict verdict;
  for (std::size_t i = 0; i < queries.size(); ++i)
    nanoseconds[i] = best_time_beyond(
        CLOCK_THREAD_CPUTIME_ID, [&] { verdict = decide(queries[i]); },
        [&] { verdict = empty().decide(queries[i]); });
}

const Subject& Subject::empty() const {
  static const BuiltInSubject<Empty> subject("empty", std::nullopt);
  return subject;
}

SplitName split_bound(std::string_view name, std::optional<double> given_bound) {
  const auto at = name.rfind('@');
  if (at == std::string_view::npos || is_plugin(name)) return {name, given_bound};
  if (name.substr(at) == of_scene && given_bound) return {name.substr(0, at), given_bound};
  double bound = 0;
  const char* const end = name.data() + name.size();
  const auto [rest, error] = std::from_chars(name.data() + at + 1, end, bound);
  if (error == std::errc::invalid_argument || rest != end) return {name, given_bound};
  if (error != std::errc() || !(bound > 0) || !std::isfinite(bound))
    throw Error("subject '" + excerpt(name) + "': found the bound '" + excerpt(name.substr(at + 1)) +
                "', expected a positive finite number");
  return {name.substr(0, at), bound};
}

std::unique_ptr<Subject> try_make_subject(std::string_view name_or_path, std::optional<double> given_bound) {
  if (is_plugin(name_or_path)) return std::make_unique<Plugin>(name_or_path);
  const auto [name, bound] = split_bound(name_or_path, given_bound);
  const PluginName parsed = PluginName::parse(name);
  for (const Entry& each : registry)
    if (each.info.name == parsed.path)
      return each.make(name_or_path, parsed.subject.empty() ? parsed.options : parsed.subject, bound);
  return nullptr;
}

std::unique_ptr<Subject> make_subject(std::string_view name_or_path, std::optional<double> given_bound) {
  auto subject = try_make_subject(name_or_path, given_bound);
  if (!subject) refuse_subject(name_or_path, subjects());
  return subject;
}

void refuse_coordinates(std::string_view name) {
  throw Error(std::string(name) + ": found a coordinate that is not finite, expected finite numbers");
}

void refuse_subject(std::string_view name, std::span<const SubjectInfo> known) {
  for (const SubjectInfo& info : known)
    if (name.starts_with(std::string(info.name) + ":"))
      throw Error("subject '" + excerpt(name) + "': found '" + excerpt(name.substr(info.name.size() + 1)) +
                  "', expected no options");
  std::string names;
  for (const SubjectInfo& info : known) names += (names.empty() ? "" : ", ") + std::string(info.name);
  throw Error("unknown subject '" + excerpt(name) + "', expected one of " + names +
              " or the path of a plug-in such as ./plugin.so");
}

}  // namespace nearmiss
