// Plug-ins as subjects that run in this process.
#pragma once

#include <memory>
#include <mutex>
#include <string>
#include <string_view>
#include <vector>

#include "ccd/subjects/detector.hpp"
#include "ccd/subjects/subject.hpp"

namespace nearmiss {

/// The prefix of the name of a subject that is a separate program: "pipe:COMMAND".
inline constexpr std::string_view program_prefix = "pipe:";

inline bool is_program(std::string_view name) { return name.starts_with(program_prefix); }

/// Whether a path leads to a regular file; false if that is unknown, as for a name that is too long.
bool is_file(std::string_view path);

/// Whether a subject's name is that of a plug-in: a program, or a shared object whose path has a '/'.
bool is_plugin(std::string_view name);

/// A shared object as the command line names it: PATH[:SUBJECT][:KEY=VALUE]..., with a '/' in the path. The
/// path is the shortest prefix that is a file and ends at a ':' or at the end of the name.
struct PluginName {
  std::string path;
  std::string subject;  ///< one of the shared object's subjects; "" if the name leaves it open
  std::string options;  ///< "KEY=VALUE:KEY=VALUE"

  /// Throws Error if a subject is named twice, or after an option.
  static PluginName parse(std::string_view name);
};

/// A subject that runs a detector of a shared object in this process.
class Plugin final : public Subject {
 public:
  /// Throws Error.
  explicit Plugin(std::string_view name);

  [[nodiscard]] const std::string& name() const override { return info_.name; }
  [[nodiscard]] const DetectorInfo& info() const { return info_; }

  using Subject::decide;
  [[nodiscard]] Verdict decide(const Query& query) const override;
  [[nodiscard]] double distance_bound(const Query& query) const override;
  [[nodiscard]] BoundAnswer ask_bound(const Query& query) const override;
  [[nodiscard]] bool claims_bound() const override { return info_.claims_bound; }
  [[nodiscard]] bool gives_distance(Kind kind) const override {
    return nearmiss::gives_distance(info_, kind);
  }
  [[nodiscard]] DistanceAnswer ask_distance(const Query& query) const override;
  [[nodiscard]] bool filters_step(Kind kind) const override { return nearmiss::filters_step(info_, kind); }
  [[nodiscard]] StepAnswer ask_step(const Query& query) const override;
  [[nodiscard]] bool decides(Kind kind) const override { return nearmiss::decides(info_, kind); }
  [[nodiscard]] bool takes_separation(Kind kind) const override {
    return nearmiss::takes_separation(info_, kind);
  }
  [[nodiscard]] TimeSort time_sort() const override { return info_.time_sort; }
  [[nodiscard]] Contract contract() const override { return info_.contract; }
  [[nodiscard]] bool rounds() const override { return info_.is_narrow; }
  [[nodiscard]] Query rounded(const Query& query) const override { return rounded_for(info_, query); }

 protected:
  [[nodiscard]] const Subject& empty() const override;

 private:
  /// Makes the empty subject.
  Plugin();

  /// Calls act(detector) with a detector that no other thread uses meanwhile.
  template <class Act>
  auto with_detector(const Act& act) const;

  std::unique_ptr<PluginLibrary> library_;
  const nearmiss_subject* subject_;
  std::string options_;
  DetectorInfo info_;
  mutable std::mutex mutex_;
  mutable std::vector<std::unique_ptr<Detector>> idle_;
};

}  // namespace nearmiss
