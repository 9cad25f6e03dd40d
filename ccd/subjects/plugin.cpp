#include "ccd/subjects/plugin.hpp"

#include <algorithm>
#include <array>
#include <filesystem>
#include <limits>
#include <system_error>

#include "ccd/query/error.hpp"

namespace nearmiss {

bool is_file(std::string_view path) {
  std::error_code unknown;
  return std::filesystem::is_regular_file(path, unknown);
}

namespace {

/// The path at the start of a plug-in's name: the shortest prefix that has a '/', is a file, and ends at a
/// ':' or at the end of the name. If no prefix is a file, the path ends at the first ':' after the last '/'
/// before any option, so that a message can name it.
std::string_view path_in(std::string_view name) {
  for (std::size_t end = 0; end != std::string_view::npos;) {
    end = name.find(':', end + 1);
    const std::string_view part = name.substr(0, end);
    if (part.find('/') != std::string_view::npos && is_file(part)) return part;
  }
  const std::size_t in_file = name.rfind('/', name.find('=')) + 1;
  return name.substr(0, name.find(':', in_file));
}

}  // namespace

bool is_plugin(std::string_view name) {
  const bool may_be_path = name.find('/') != std::string_view::npos;
  return is_program(name) || (may_be_path && path_in(name).find('/') != std::string_view::npos);
}

PluginName PluginName::parse(std::string_view name) {
  PluginName parsed{.path = std::string(path_in(name)), .subject = "", .options = ""};
  for (std::size_t at = parsed.path.size(); at < name.size();) {
    const std::size_t end = std::min(name.find(':', at + 1), name.size());
    const std::string part(name.substr(at + 1, end - at - 1));
    at = end;
    if (part.find('=') != std::string::npos) {
      parsed.options += (parsed.options.empty() ? "" : ":") + part;
    } else if (part.empty() || !parsed.subject.empty() || !parsed.options.empty()) {
      throw Error(std::string(name) + ": found '" + part + "', expected PATH[:SUBJECT][:KEY=VALUE]...");
    } else {
      parsed.subject = part;
    }
  }
  return parsed;
}

Plugin::Plugin(std::string_view name) {
  const PluginName parsed = PluginName::parse(name);
  library_ = std::make_unique<PluginLibrary>(parsed.path);
  subject_ = &library_->subject(parsed.subject);
  options_ = parsed.options;
  idle_.push_back(std::make_unique<Detector>(*subject_, options_));
  info_ = idle_.back()->info();
}

Plugin::Plugin() : subject_(&Detector::empty().subject()), info_(Detector::empty().info()) {}

const Subject& Plugin::empty() const {
  static const Plugin plugin;
  return plugin;
}

template <class Act>
auto Plugin::with_detector(const Act& act) const {
  std::unique_ptr<Detector> detector;
  {
    const std::lock_guard lock(mutex_);
    if (!idle_.empty()) {
      detector = std::move(idle_.back());
      idle_.pop_back();
    }
  }
  if (!detector) detector = std::make_unique<Detector>(*subject_, options_);
  auto answer = act(*detector);
  const std::lock_guard lock(mutex_);
  idle_.push_back(std::move(detector));
  return answer;
}

Verdict Plugin::decide(const Query& query) const {
  if (!is_asked(query.kind, query.separation > 0)) return {.fault = Fault::not_asked};
  return with_detector([&](const Detector& detector) {
    const Query seen = rounded(query);
    int answer = 0;
    double time = std::numeric_limits<double>::quiet_NaN();
    std::array<double, std::tuple_size_v<decltype(Query::x)>> x;
    lay_out(info_, seen, 0, 1, x.data());
    detector.decide(query.kind, x.data(), &seen.separation, std::span(&answer, 1), std::span(&time, 1));
    return verdict_of(info_, answer, time);
  });
}

BoundAnswer Plugin::ask_bound(const Query& query) const {
  const Query seen = rounded(query);
  std::array<double, std::tuple_size_v<decltype(Query::x)>> x;
  lay_out(info_, seen, 0, 1, x.data());
  return with_detector(
      [&](const Detector& detector) { return detector.bound(query.kind, x.data(), seen.separation); });
}

DistanceAnswer Plugin::ask_distance(const Query& query) const {
  const Query seen = rounded(query);
  std::array<double, std::tuple_size_v<decltype(Query::x)>> x;
  lay_out(info_, seen, 0, 1, x.data());
  return with_detector([&](const Detector& detector) { return detector.distance(query.kind, x.data()); });
}

StepAnswer Plugin::ask_step(const Query& query) const {
  const Query seen = rounded(query);
  std::array<double, std::tuple_size_v<decltype(Query::x)>> x;
  lay_out(info_, seen, 0, 1, x.data());
  return with_detector([&](const Detector& detector) { return detector.step(query.kind, x.data()); });
}

double Plugin::distance_bound(const Query& query) const { return ask_bound(query).bound_or_nan(); }

}  // namespace nearmiss
