#include "ccd/subjects/plugin.hpp"

#include <algorithm>
#include <array>
#include <filesystem>
#include <limits>
#include <system_error>
#include <utility>

#include "ccd/query/error.hpp"

namespace nearmiss {

bool is_file(std::string_view path) {
  std::error_code unknown;
  return std::filesystem::is_regular_file(path, unknown);
}

namespace {

/// The path at the start of a plug-in's name: the shortest prefix that has a '/', is a file, and ends at a
/// ':' or at the end of the name. If no prefix is a file, returns a guess for the error message: the path is
/// taken to end at the first ':' after its last '/'. A '/' after the first '=' belongs to an option, and does
/// not count.
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

Plugin::Loaded Plugin::load(const PluginName& name) {
  auto library = std::make_unique<PluginLibrary>(name.path);
  auto detector = std::make_unique<Detector>(library->subject(name.subject), name.options);
  return {std::move(library), std::move(detector)};
}

Plugin::Plugin(std::string_view name) : Plugin(load(PluginName::parse(name))) {}

Plugin::Plugin(Loaded loaded) : DescribedSubject(loaded.detector->info()), loaded_(std::move(loaded)) {}

template <class Act>
auto Plugin::ask(const Query& query, const Act& act) const {
  const Query seen = rounded(query);
  std::array<double, std::tuple_size_v<decltype(Query::x)>> x;
  lay_out(info(), seen, 0, 1, x.data());
  const std::lock_guard lock(mutex_);
  return act(*loaded_.detector, seen, x.data());
}

void Plugin::decide(std::span<const Query> queries, std::span<Verdict> verdicts) const {
  for (std::size_t i = 0; i < queries.size(); ++i)
    verdicts[i] =
        !is_asked(queries[i].kind, queries[i].separation > 0)
            ? Verdict{.fault = Fault::not_asked}
            : ask(queries[i], [&](const Detector& detector, const Query& seen, const double* x) {
                int answer = 0;
                double time = std::numeric_limits<double>::quiet_NaN();
                detector.decide(seen.kind, x, &seen.separation, std::span(&answer, 1), std::span(&time, 1));
                return verdict_of(info(), answer, time);
              });
}

BoundAnswer Plugin::ask_bound(const Query& query) const {
  return ask(query, [](const Detector& detector, const Query& seen, const double* x) {
    return detector.bound(seen.kind, x, seen.separation);
  });
}

DistanceAnswer Plugin::ask_distance(const Query& query) const {
  return ask(query, [](const Detector& detector, const Query& seen, const double* x) {
    return detector.distance(seen.kind, x);
  });
}

StepAnswer Plugin::ask_step(const Query& query) const {
  return ask(query, [](const Detector& detector, const Query& seen, const double* x) {
    return detector.step(seen.kind, x);
  });
}

}  // namespace nearmiss
