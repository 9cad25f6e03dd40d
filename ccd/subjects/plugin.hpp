// Subjects that run the detectors of shared objects in this process.
#pragma once

#include <memory>
#include <mutex>
#include <span>
#include <string>
#include <string_view>

#include "ccd/query/query.hpp"
#include "ccd/subjects/described_subject.hpp"
#include "ccd/subjects/detector.hpp"

namespace nearmiss {

/// The prefix in the name of a subject that is a separate program: "pipe:COMMAND".
inline constexpr std::string_view program_prefix = "pipe:";

inline bool is_program(std::string_view name) { return name.starts_with(program_prefix); }

/// Whether a path leads to a regular file; false after an error, such as a path that is too long.
bool is_file(std::string_view path);

/// Whether a subject's name names a program or a shared object. The path of a shared object must have a '/'.
bool is_plugin(std::string_view name);

/// The parts of a subject's name on the command line, which has the form PATH[:SUBJECT][:KEY=VALUE].... The
/// path is the shortest prefix that has a '/', is a file, and ends at a ':' or at the end of the name.
struct PluginName {
  std::string path;
  std::string subject;  ///< the name of a detector of the shared object; "" if the command line names none
  std::string options;  ///< "KEY=VALUE:KEY=VALUE"

  /// Throws Error if the name has two SUBJECTs, or has a SUBJECT after a KEY=VALUE.
  static PluginName parse(std::string_view name);
};

/// A subject that runs a detector of a shared object in this process, for one thread at a time.
class Plugin final : public DescribedSubject {
 public:
  /// Throws Error if the shared object cannot be loaded, or if the detector refuses the options in the name.
  explicit Plugin(std::string_view name);

  using DescribedSubject::decide;
  void decide(std::span<const Query> queries, std::span<Verdict> verdicts) const override;
  [[nodiscard]] BoundAnswer ask_bound(const Query& query) const override;
  [[nodiscard]] DistanceAnswer ask_distance(const Query& query) const override;
  [[nodiscard]] StepAnswer ask_step(const Query& query) const override;

 private:
  struct Loaded {
    std::unique_ptr<PluginLibrary> library;
    std::unique_ptr<Detector> detector;  ///< exported by `library`
  };
  static Loaded load(const PluginName& name);
  explicit Plugin(Loaded loaded);

  /// Returns act(detector, seen, x), where `seen` is the query rounded for the detector, and x has the
  /// coordinates of `seen` in the detector's layout.
  template <class Act>
  auto ask(const Query& query, const Act& act) const;

  Loaded loaded_;
  mutable std::mutex mutex_;
};

}  // namespace nearmiss
