#include "fuzz/subjects/defects.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "ccd/query/error.hpp"
#include "ccd/query/excerpt.hpp"
#include "ccd/wang/loosened.hpp"
#include "corpus/query_text.hpp"
#include "defective/ccd/wang/advance.hpp"
#include "defective/ccd/wang/wang.hpp"
#include "defective/ccd/wang/wang_time.hpp"
#include "defective/ccd/wang/within.hpp"

namespace nearmiss {

namespace {

constexpr std::string_view prefix = "defect:";

template <class T>
constexpr std::array tolerance_members{&Tolerances<T>::delta, &Tolerances<T>::D2,      &Tolerances<T>::rho,
                                       &Tolerances<T>::psi,   &Tolerances<T>::lambda2, &Tolerances<T>::S,
                                       &Tolerances<T>::mu,    &Tolerances<T>::tau,     &Tolerances<T>::eta};

constexpr std::array tolerance_table{
    NamedTolerance{"delta", &Tolerances<double>::delta, 2, true},
    NamedTolerance{"D2", &Tolerances<double>::D2, 2, true},
    NamedTolerance{"rho", &Tolerances<double>::rho, 2, false},
    NamedTolerance{"psi", &Tolerances<double>::psi, 2, true},
    NamedTolerance{"lambda2", &Tolerances<double>::lambda2, 2, false},
    NamedTolerance{"S", &Tolerances<double>::S, 1, true},
    NamedTolerance{"mu", &Tolerances<double>::mu, 3, true},
    NamedTolerance{"tau", &Tolerances<double>::tau, 2, false},
    NamedTolerance{"eta", &Tolerances<double>::eta, 1, false},
};

/// The paper's tolerances for double, each multiplied by a factor.
struct DefectiveTolerances {
  Tolerances<double> factors{1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1};
  /// The tolerance that the defect changes; null if the defect changes no tolerance.
  const NamedTolerance* changed = nullptr;

  /// These tolerances, but with `changed` loosened by the factor s. If `changed` is null, all tolerances that
  /// accept more pairs when they are larger are loosened: lengths by s, squares of lengths by s², and so on.
  [[nodiscard]] DefectiveTolerances loosened(double s) const {
    DefectiveTolerances loose = *this;
    if (changed != nullptr) {
      loose.factors.*changed->value *= changed->accepts ? s : 1 / s;
    } else {
      for (const NamedTolerance& each : tolerance_table)
        if (each.accepts) loose.factors.*each.value *= std::pow(s, each.dimension);
    }
    return loose;
  }

  template <class T>
  [[nodiscard]] Tolerances<T> operator()(T B) const {
    return changed_from<T>(paper_tolerances(static_cast<double>(B)));
  }
  template <class T>
  [[nodiscard]] Tolerances<T> of_vertices(T B, T R) const {
    return changed_from<T>(PaperTolerances().of_vertices(static_cast<double>(B), static_cast<double>(R)));
  }
  template <class T>
  [[nodiscard]] Tolerances<T> of_edge(T B, T R) const {
    return changed_from<T>(PaperTolerances().of_edge(static_cast<double>(B), static_cast<double>(R)));
  }

 private:
  template <class T>
  [[nodiscard]] Tolerances<T> changed_from(const Tolerances<double>& paper) const {
    Tolerances<T> tol{};
    for (std::size_t i = 0; i < tolerance_table.size(); ++i) {
      const auto member = tolerance_members<double>[i];
      tol.*tolerance_members<T>[i] = static_cast<T>(paper.*member * factors.*member);
    }
    return tol;
  }
};

/// The sound subjects from which defects are made.
enum class Sound : std::uint8_t { wang, wang_time, advance };
constexpr std::array<std::string_view, 3> sound_names{"wang", "wang-time", "advance"};

/// An edit of ccd/, and the name of the subject that it makes defective.
struct NamedEdit {
  std::string_view name, about, of;

  [[nodiscard]] constexpr std::ptrdiff_t place() const {
    return std::ranges::find(sound_names, of) - sound_names.begin();
  }
};
constexpr auto edit_table = std::to_array<NamedEdit>({
#include "defective/edits.inc"
});
static_assert(std::ranges::all_of(edit_table, [](const NamedEdit& each) {
  return each.place() < static_cast<std::ptrdiff_t>(sound_names.size());
}));

/// The change that makes a sound subject defective.
struct Change {
  Sound sound = Sound::wang;
  int edit = 0;  ///< the number of the edit in edit_table, from 1; 0: none
  DefectiveTolerances tolerances = {};
  bool in_float = false;  ///< whether the subject computes in float; in wang-time, only the time is in float
};

template <Kind kind>
Verdict decide_by(const Change& change, const Query& query, const DefectiveTolerances& tolerances) {
  using defective::WangOptions;
  defective::active_edit = change.edit;
  if (change.sound == Sound::advance) return defective::advance<kind, double>(query);
  if (change.sound == Sound::wang_time) {
    Verdict verdict = defective::wang_time<kind, double, WangOptions{}>(query, std::nullopt, tolerances);
    if (verdict.hit && change.in_float)
      verdict.time = defective::detail::contactless_until<kind, float>(query);
    return verdict;
  }
  return change.in_float ? defective::wang<kind, float, WangOptions{}>(query, std::nullopt, tolerances)
                         : defective::wang<kind, double, WangOptions{}>(query, std::nullopt, tolerances);
}

Verdict decide_within_by(const Change& change, const Query& query, const DefectiveTolerances& tolerances) {
  defective::active_edit = change.edit;
  if (change.sound == Sound::advance) return defective::advance<Kind::vertex_triangle, double>(query);
  if (change.sound == Sound::wang_time) {
    Verdict verdict = defective::wang_within_time<double>(query, true, std::nullopt, tolerances);
    if (verdict.hit && change.in_float)
      verdict.time = defective::advance<Kind::vertex_triangle, float>(query).time;
    return verdict;
  }
  return change.in_float ? defective::wang_within<float>(query, true, std::nullopt, tolerances)
                         : defective::wang_within<double>(query, true, std::nullopt, tolerances);
}

class DefectiveSubject final : public Subject {
 public:
  DefectiveSubject(std::string_view name, const Change& change)
      : name_(name),
        change_(change),
        sound_(make_subject(sound_names[static_cast<std::size_t>(change.sound)])) {}

  [[nodiscard]] const std::string& name() const override { return name_; }

  using Subject::decide;
  [[nodiscard]] Verdict decide(const Query& query) const override {
    if (!is_finite(query)) refuse_coordinates(name_);
    return decide(query, change_.tolerances);
  }

  [[nodiscard]] double distance_bound(const Query& query) const override {
    return sound_->distance_bound(query);
  }
  [[nodiscard]] bool decides(Kind kind) const override { return sound_->decides(kind); }
  [[nodiscard]] bool takes_separation(Kind kind) const override { return sound_->takes_separation(kind); }
  [[nodiscard]] TimeSort time_sort() const override { return sound_->time_sort(); }

  [[nodiscard]] double needed_tolerance(const Query& query) const override {
    if (change_.sound == Sound::advance) return sound_->needed_tolerance(query);
    return least_loosening([&](double s) { return decide(query, change_.tolerances.loosened(s)).hit; });
  }

 private:
  [[nodiscard]] Verdict decide(const Query& query, const DefectiveTolerances& tolerances) const {
    if (!is_of_meshes(query.kind)) return decide_within_by(change_, query, tolerances);
    return with_kind(query.kind, [&]<Kind kind>() { return decide_by<kind>(change_, query, tolerances); });
  }

  std::string name_;
  Change change_;
  std::unique_ptr<Subject> sound_;
};

/// A defect that computes in float, and the sound subject from which it is made.
struct InFloat {
  std::string_view name, about;
  Sound of;
};
constexpr std::array in_float_table{
    InFloat{"float", "float, with the tolerances for double", Sound::wang},
    InFloat{"time-float", "the time of a computation in float", Sound::wang_time},
};

/// Reads "TOLERANCE*FACTOR", and sets this factor in `tolerances`; returns false if `name` has another form.
bool take_factor(std::string_view name, DefectiveTolerances& tolerances) {
  const std::size_t star = name.find('*');
  if (star == std::string_view::npos) return false;
  for (const NamedTolerance& tolerance : tolerance_table) {
    if (tolerance.name != name.substr(0, star)) continue;
    const double factor = parse_number(name.substr(star + 1), name);
    if (factor < 0) throw Error(fmt::format("{}: found the factor {}, expected 0 or more", name, factor));
    tolerances.factors.*tolerance.value = factor;
    tolerances.changed = &tolerance;
    return true;
  }
  return false;
}

std::vector<Defect> make_library() {
  std::vector<Defect> library;
  for (const NamedTolerance& tolerance : tolerance_table) {
    const auto add = [&](double factor) {
      library.push_back({scaled_tolerance(tolerance.name, factor),
                         fmt::format("the tolerance {} times {}", tolerance.name, factor)});
    };
    for (const double factor : {0.5, 0.1, 0.01, 0.0}) add(factor);
    if (tolerance.accepts) continue;
    for (const double factor : {10.0, 100.0}) add(factor);
  }
  for (const NamedEdit& each : edit_table)
    library.push_back({fmt::format("{}{}", prefix, each.name), std::string(each.about)});
  for (const InFloat& each : in_float_table)
    library.push_back({fmt::format("{}{}", prefix, each.name), std::string(each.about)});
  return library;
}

}  // namespace

std::span<const NamedTolerance> named_tolerances() { return tolerance_table; }

std::string scaled_tolerance(std::string_view tolerance, double factor) {
  return fmt::format("{}{}*{}", prefix, tolerance, factor);
}

std::span<const Defect> defects() {
  static const std::vector<Defect> library = make_library();
  return library;
}

std::unique_ptr<Subject> try_make_defect(std::string_view name) {
  if (!name.starts_with(prefix)) return nullptr;
  const std::string_view defect = name.substr(prefix.size());
  Change change;
  bool known = take_factor(defect, change.tolerances);
  for (const InFloat& each : in_float_table) {
    if (each.name != defect) continue;
    known = true;
    change = {.sound = each.of, .in_float = true};
  }
  for (std::size_t i = 0; i < edit_table.size(); ++i) {
    if (edit_table[i].name != defect) continue;
    known = true;
    change = {.sound = static_cast<Sound>(edit_table[i].place()), .edit = static_cast<int>(i) + 1};
  }
  if (!known)
    throw Error(
        fmt::format("unknown defect '{}', expected one that 'nearmiss subjects' lists", excerpt(name)));
  return std::make_unique<DefectiveSubject>(name, change);
}

}  // namespace nearmiss
