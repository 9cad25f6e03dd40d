// Subjects that shared objects export (nearmiss_subject.h).
#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "ccd/nearmiss_subject.h"
#include "ccd/subject.hpp"

namespace nearmiss {

/// Whether a subject's name is the path of a plug-in, that is, contains a '/'.
inline bool is_plugin_path(std::string_view name) { return name.find('/') != std::string_view::npos; }

/// The subject that a shared object exports, run in this process. A plug-in may change the rounding mode, the
/// treatment of subnormals or the traps; arithmetic is plain again after each answer.
class Plugin final : public Subject {
 public:
  /// Throws Error if the file cannot be loaded, lacks nearmiss_get_subject, has another abi, or lacks a
  /// function.
  explicit Plugin(const std::string& path);

  [[nodiscard]] const std::string& name() const override { return name_; }
  /// The plug-in's own version; "" if it gives none.
  [[nodiscard]] const std::string& version() const { return version_; }

  using Subject::decide;
  [[nodiscard]] Verdict decide(const Query& query) const override;
  [[nodiscard]] double distance_bound(const Query& query) const override;
  [[nodiscard]] BoundAnswer ask_bound(const Query& query) const override;
  [[nodiscard]] bool claims_bound() const override { return subject_->distance_bound != nullptr; }

  /// The plug-in's return value. `time` is set to the time that the plug-in gives, and is left unchanged if
  /// it gives none.
  int ask(const Query& query, double& time) const;

  /// A plug-in that does nothing and answers 0.
  static const Plugin& empty_plugin();

 protected:
  [[nodiscard]] const Subject& empty() const override { return empty_plugin(); }

 private:
  /// Makes a plug-in of a subject that is part of this program.
  explicit Plugin(const nearmiss_subject& subject) : subject_(&subject), name_(subject.name) {}

  struct Unload {
    void operator()(void* handle) const;
  };

  std::unique_ptr<void, Unload> library_;
  const nearmiss_subject* subject_ = nullptr;  // owned by the library
  std::string name_, version_;
};

/// A plug-in's answer as a verdict.
Verdict plugin_verdict(int answer, double time);

}  // namespace nearmiss
