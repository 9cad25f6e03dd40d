// Detectors that shared objects export (nearmiss_subject.h).
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "ccd/nearmiss_subject.h"
#include "ccd/subjects/subject.hpp"

namespace nearmiss {

/// What a detector says about itself (nearmiss_subject.h).
struct DetectorInfo {
  std::string name;  ///< with its options
  std::string version = {}, about = {};
  int kinds = 0;
  bool is_narrow = false;  ///< whether it takes coordinates of 24 bits
  TimeSort time_sort{};
  int separation_kinds = 0;  ///< the kinds for which it uses h, as a sum of bits
  int distance_kinds = 0;    ///< the kinds for which it gives distances, as a sum of bits
  int step_kinds = 0;        ///< the kinds for which it filters steps, as a sum of bits
  std::size_t batch = 1;
  bool in_arrays = false;  ///< whether it reads coordinates in the layout NEARMISS_ARRAYS
  bool claims_bound = false;
  Contract contract = {};

  bool operator==(const DetectorInfo&) const = default;
};

/// Limits: the number of detectors in a shared object, the bytes of a detector's name, and the number of
/// queries that it gets at once.
inline constexpr std::size_t most_detectors = 64;
inline constexpr std::size_t longest_name = 255;
inline constexpr std::size_t largest_batch = 10'000'000;

/// How a description, a name or a contract contradicts nearmiss_subject.h; "" if it does not.
std::string fault_of(const nearmiss_subject& subject);
/// Throws an Error that begins with `where` if a detector contradicts nearmiss_subject.h, was compiled with
/// an unknown version of it, or has one of `other_names`.
void expect_usable(const std::string& where, const nearmiss_subject& subject,
                   const std::vector<std::string>& other_names = {});
std::string fault_of_name(std::string_view name);
std::string fault_of(const Contract& contract);

/// Whether a detector decides queries of a kind.
bool decides(const DetectorInfo& info, Kind kind);
/// Whether a detector gives the distance of primitives of a kind.
bool gives_distance(const DetectorInfo& info, Kind kind);
/// Whether a detector filters the steps of primitives of a kind.
bool filters_step(const DetectorInfo& info, Kind kind);
/// Whether a detector uses the separation of queries of a kind.
bool takes_separation(const DetectorInfo& info, Kind kind);
/// The query that a detector decides. If the detector is narrow, numbers are rounded to float; numbers beyond
/// the range of float become the largest float.
Query rounded_for(const DetectorInfo& info, const Query& query);
/// Writes the coordinates of query i, one of n queries of one kind, to the places in `x` at which a detector
/// reads them.
void lay_out(const DetectorInfo& info, const Query& query, std::size_t i, std::size_t n, double* x);
/// A detector's answer as a verdict. `time` is the time that it gave, or NaN.
Verdict verdict_of(const DetectorInfo& info, int answer, double time);

/// A loaded shared object.
class PluginLibrary {
 public:
  /// Throws Error if the file cannot be loaded, lacks nearmiss_get_subject, or exports a subject that does
  /// not follow nearmiss_subject.h.
  explicit PluginLibrary(const std::string& path);

  [[nodiscard]] std::vector<std::string> names() const;
  /// The subject of this name, or the first one if the name is "". Throws Error if there is no such subject.
  [[nodiscard]] const nearmiss_subject& subject(std::string_view name) const;

 private:
  struct Unload {
    void operator()(void* handle) const;
  };

  std::string path_;
  std::unique_ptr<void, Unload> library_;
  std::vector<const nearmiss_subject*> subjects_;  // `library_` owns them
};

/// A detector that is open, for one thread. The detector may change the rounding mode, the treatment of
/// subnormals or the traps; arithmetic is plain again after each call.
class Detector {
 public:
  /// Opens the detector. The subject must outlive it. Throws Error if the subject refuses the options.
  Detector(const nearmiss_subject& subject, const std::string& options);
  /// Uses a detector that is already open, with the state `state`. The caller closes it.
  Detector(const nearmiss_subject& subject, void* state);
  Detector(const Detector&) = delete;
  Detector& operator=(const Detector&) = delete;
  ~Detector();

  [[nodiscard]] const DetectorInfo& info() const { return info_; }
  [[nodiscard]] const nearmiss_subject& subject() const { return subject_; }

  /// Decides answers.size() queries of one kind, whose coordinates lie as nearmiss_subject.h says, and are
  /// rounded to float if the detector is narrow.
  void decide(Kind kind, const double* x, const double* separations, std::span<int> answers,
              std::span<double> times) const;
  /// The bound that the detector claims for one query.
  [[nodiscard]] BoundAnswer bound(Kind kind, const double* x, double separation) const;
  /// The detector's distance at t = 0, for a kind for which it gives distances.
  [[nodiscard]] DistanceAnswer distance(Kind kind, const double* x) const;
  /// The detector's safe part of the step, for a kind for which the detector filters steps.
  [[nodiscard]] StepAnswer step(Kind kind, const double* x) const;
  /// The time that the last decision took without copies, in ns; 0 if the detector does not say it.
  [[nodiscard]] std::uint64_t kernel_nanoseconds() const;

  /// A detector that does nothing and finds no collision.
  static const Detector& empty();

 private:
  const nearmiss_subject& subject_;
  DetectorInfo info_;
  void* state_ = nullptr;
  bool closes_ = true;
};

}  // namespace nearmiss
