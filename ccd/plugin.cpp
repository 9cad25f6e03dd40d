#include "ccd/plugin.hpp"

#include <dlfcn.h>

#include "ccd/error.hpp"
#include "ccd/nearmiss_subject.h"

namespace nearmiss {

namespace {

struct Unload {
  void operator()(void* handle) const { dlclose(handle); }
};
using Library = std::unique_ptr<void, Unload>;

class Plugin final : public Subject {
 public:
  Plugin(const std::string& path, Library library, const nearmiss_subject& subject)
      : path_(path), library_(std::move(library)), subject_(subject), name_(subject.name) {}

  [[nodiscard]] const std::string& name() const override { return name_; }

  using Subject::decide;
  [[nodiscard]] Verdict decide(const Query& query) const override {
    Verdict verdict;
    const auto test = query.kind == Kind::vertex_triangle ? subject_.vertex_triangle : subject_.edge_edge;
    const int answer = test(query.x.data(), &verdict.time);
    if (answer < 0 || answer > 1)
      throw Error(path_ + ": the plug-in returned " + std::to_string(answer) + " for a " +
                  std::string(short_name(query.kind)) + " query, expected 0 or 1");
    verdict.hit = answer == 1;
    verdict.stage = verdict.hit ? Stage::unspecified : Stage::none;
    return verdict;
  }

  [[nodiscard]] double distance_bound(const Query& query) const override {
    if (subject_.distance_bound == nullptr) return std::numeric_limits<double>::infinity();
    const double bound = subject_.distance_bound(query.x.data(), query.kind == Kind::edge_edge ? 1 : 0);
    if (!(bound >= 0))
      throw Error(path_ + ": the plug-in claims a distance bound of " + std::to_string(bound) +
                  ", expected 0 or more");
    return bound;
  }

 private:
  std::string path_;
  Library library_;
  const nearmiss_subject& subject_;  // owned by the library
  std::string name_;
};

}  // namespace

std::unique_ptr<Subject> load_plugin(const std::string& path) {
  Library library(dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL));
  if (!library) throw Error(path + ": cannot load the plug-in: " + dlerror());
  using GetSubject = decltype(&nearmiss_get_subject);
  const auto get = reinterpret_cast<GetSubject>(dlsym(library.get(), "nearmiss_get_subject"));
  if (get == nullptr)
    throw Error(path + ": no function nearmiss_get_subject, expected by ccd/nearmiss_subject.h");
  const nearmiss_subject* subject = get();
  if (subject == nullptr) throw Error(path + ": nearmiss_get_subject returned a null pointer");
  if (subject->abi != NEARMISS_SUBJECT_ABI)
    throw Error(path + ": found plug-in abi " + std::to_string(subject->abi) + ", expected " +
                std::to_string(NEARMISS_SUBJECT_ABI));
  if (subject->name == nullptr || subject->vertex_triangle == nullptr || subject->edge_edge == nullptr)
    throw Error(path + ": found a null name or function, expected name, vertex_triangle and edge_edge");
  return std::make_unique<Plugin>(path, std::move(library), *subject);
}

}  // namespace nearmiss
