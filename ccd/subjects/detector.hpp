// Detectors exported by shared objects (nearmiss_subject.h).
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

/// The description that a detector gives of itself in its nearmiss_subject.
struct DetectorInfo {
  std::string name;  ///< the name of the detector, with its options
  std::string version = {}, about = {};
  int kinds = 0;
  bool is_narrow = false;  ///< whether the detector takes coordinates rounded to 24 bits
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

inline constexpr std::size_t most_detectors = 64;         ///< the most detectors in a shared object
inline constexpr std::size_t longest_name = 255;          ///< the longest name of a detector, in bytes
inline constexpr std::size_t largest_batch = 10'000'000;  ///< the largest batch, in queries

/// Says how a nearmiss_subject contradicts the rules of nearmiss_subject.h; "" if it follows all of them.
std::string fault_of(const nearmiss_subject& subject);
/// Throws an Error that begins with `where` if a detector contradicts nearmiss_subject.h, was compiled with
/// an unknown version of this header, or has a name in `other_names`.
void expect_usable(const std::string& where, const nearmiss_subject& subject,
                   const std::vector<std::string>& other_names = {});
/// Says why the name of a detector is not allowed; "" if it is allowed.
std::string fault_of_name(std::string_view name);
/// Says why a contract is not valid; "" if it is valid.
std::string fault_of(const Contract& contract);

bool decides(const DetectorInfo& info, Kind kind);
bool gives_distance(const DetectorInfo& info, Kind kind);
bool filters_step(const DetectorInfo& info, Kind kind);
bool takes_separation(const DetectorInfo& info, Kind kind);
/// The query that a detector decides in place of `query`. If the detector takes floats (`is_narrow`), all
/// numbers are rounded to float, and a number beyond the range of float becomes the largest float with the
/// number's sign.
Query rounded_for(const DetectorInfo& info, const Query& query);
/// Writes the coordinates of query i of a batch of n queries to `x`, at the places from which a detector
/// reads the coordinates.
void lay_out(const DetectorInfo& info, const Query& query, std::size_t i, std::size_t n, double* x);
/// The verdict for a detector's answer and time of impact, which is NaN if the detector gave none.
Verdict verdict_of(const DetectorInfo& info, int answer, double time);

/// A loaded shared object.
class PluginLibrary {
 public:
  /// Throws Error if the file cannot be loaded, lacks nearmiss_get_subject(), or has a detector that
  /// contradicts nearmiss_subject.h.
  explicit PluginLibrary(const std::string& path);

  [[nodiscard]] std::vector<std::string> names() const;
  /// The detector with this name, or the first detector if the name is "". Throws Error if no detector has
  /// this name.
  [[nodiscard]] const nearmiss_subject& subject(std::string_view name) const;

 private:
  struct Unload {
    void operator()(void* handle) const;
  };

  std::string path_;
  std::unique_ptr<void, Unload> library_;
  std::vector<const nearmiss_subject*> subjects_;  // `library_` owns them
};

/// An open detector, which only one thread may use at a time. Arithmetic is plain (arithmetic.hpp) after each
/// call, whatever the detector does.
class Detector {
 public:
  /// Opens the detector that `subject` describes. `subject` must outlive this object. Throws Error if the
  /// detector refuses the options.
  Detector(const nearmiss_subject& subject, const std::string& options);
  /// Uses a state that the caller has opened and will close.
  Detector(const nearmiss_subject& subject, void* state);
  Detector(const Detector&) = delete;
  Detector& operator=(const Detector&) = delete;
  ~Detector();

  [[nodiscard]] const DetectorInfo& info() const { return info_; }
  [[nodiscard]] const nearmiss_subject& subject() const { return subject_; }

  /// Decides answers.size() queries of one kind. `x` and `separations` are as for decide() in
  /// nearmiss_subject.h; if the detector takes floats, the caller must have rounded the numbers in `x` and
  /// `separations` to float.
  void decide(Kind kind, const double* x, const double* separations, std::span<int> answers,
              std::span<double> times) const;
  [[nodiscard]] BoundAnswer bound(Kind kind, const double* x, double separation) const;
  /// The distance that the detector gives for the primitives at t = 0. The detector must give distances for
  /// this kind.
  [[nodiscard]] DistanceAnswer distance(Kind kind, const double* x) const;
  /// The detector's answer when it filters the step of the query with the coordinates `x`. The detector must
  /// filter steps for this kind.
  [[nodiscard]] StepAnswer step(Kind kind, const double* x) const;
  /// The time that the last decide() took, in ns, not counting copies to and from a device; 0 if the detector
  /// does not give this time.
  [[nodiscard]] std::uint64_t kernel_nanoseconds() const;

  /// A detector that answers every query with NEARMISS_NO_COLLISION and computes nothing.
  static const Detector& empty();

 private:
  const nearmiss_subject& subject_;
  DetectorInfo info_;
  void* state_ = nullptr;
  bool closes_ = true;
};

}  // namespace nearmiss
