#include "fuzz/subjects/parity.hpp"

#include <string>

#include "oracle/parity/parity.hpp"

namespace nearmiss {

namespace {

class ParitySubject final : public Subject {
 public:
  [[nodiscard]] const std::string& name() const override { return name_; }

  [[nodiscard]] Verdict decide(const Query& query) const override {
    const PlainArithmetic guard;
    if (!is_finite(query)) refuse_coordinates(name_);
    if (!root_parity(query).collision()) return Verdict::rejected(Rejection::exact);
    return {.hit = true, .stage = Stage::exact};
  }

  [[nodiscard]] double distance_bound(const Query& /*query*/) const override { return 0; }
  [[nodiscard]] Contract contract() const override { return {.one_root = true}; }

 private:
  std::string name_{parity_info.name};
};

}  // namespace

std::unique_ptr<Subject> try_make_parity(std::string_view name) {
  return name == parity_info.name ? std::make_unique<ParitySubject>() : nullptr;
}

}  // namespace nearmiss
