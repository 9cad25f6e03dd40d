#include "ccd/plugin.hpp"

#include <dlfcn.h>

#include "ccd/arithmetic.hpp"
#include "ccd/error.hpp"

namespace nearmiss {

void Plugin::Unload::operator()(void* handle) const { dlclose(handle); }

Plugin::Plugin(const std::string& path) : library_(dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL)) {
  make_arithmetic_plain();  // loading a library linked by g++ -ffast-math turns on flushing of subnormals
  if (!library_) throw Error(path + ": cannot load the plug-in: " + dlerror());
  using GetSubject = decltype(&nearmiss_get_subject);
  const auto get = reinterpret_cast<GetSubject>(dlsym(library_.get(), "nearmiss_get_subject"));
  if (get == nullptr)
    throw Error(path + ": no function nearmiss_get_subject, expected by ccd/nearmiss_subject.h");
  subject_ = get();
  if (subject_ == nullptr) throw Error(path + ": nearmiss_get_subject returned a null pointer");
  if (subject_->abi != NEARMISS_SUBJECT_ABI)
    throw Error(path + ": found plug-in abi " + std::to_string(subject_->abi) + ", expected " +
                std::to_string(NEARMISS_SUBJECT_ABI));
  if (subject_->name == nullptr || subject_->vertex_triangle == nullptr || subject_->edge_edge == nullptr)
    throw Error(path + ": found a null name or function, expected name, vertex_triangle and edge_edge");
  name_ = subject_->name;
  if (subject_->version != nullptr) version_ = subject_->version;
}

const Plugin& Plugin::empty_plugin() {
  const auto decide_nothing = [](const double* /*x*/, double* /*toi*/) { return 0; };
  static const nearmiss_subject nothing{.abi = NEARMISS_SUBJECT_ABI,
                                        .name = "empty",
                                        .version = "",
                                        .vertex_triangle = decide_nothing,
                                        .edge_edge = decide_nothing,
                                        .distance_bound = nullptr};
  static const Plugin plugin(nothing);
  return plugin;
}

int Plugin::ask(const Query& query, double& time) const {
  const auto test = query.kind == Kind::vertex_triangle ? subject_->vertex_triangle : subject_->edge_edge;
  const int answer = test(query.x.data(), &time);
  make_arithmetic_plain();
  return answer;
}

Verdict Plugin::decide(const Query& query) const {
  double time = std::numeric_limits<double>::quiet_NaN();
  const int answer = ask(query, time);
  return plugin_verdict(answer, time);
}

BoundAnswer Plugin::ask_bound(const Query& query) const {
  if (!claims_bound()) return BoundAnswer::given(std::numeric_limits<double>::infinity());
  const double bound = subject_->distance_bound(query.x.data(), query.kind == Kind::edge_edge ? 1 : 0);
  make_arithmetic_plain();
  return BoundAnswer::given(bound);
}

double Plugin::distance_bound(const Query& query) const { return ask_bound(query).bound_or_nan(); }

Verdict plugin_verdict(int answer, double time) {
  Verdict verdict;
  if (answer < 0 || answer > 1) {
    verdict.fault = Fault::error;
    verdict.fault_code = answer;
  } else {
    verdict.hit = answer == 1;
    verdict.stage = verdict.hit ? Stage::unspecified : Stage::none;
    verdict.time = time;
  }
  return verdict;
}

}  // namespace nearmiss
