#include "ccd/subjects/detector.hpp"

#include <dlfcn.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <tuple>

#include "ccd/query/arithmetic.hpp"
#include "ccd/query/error.hpp"
#include "ccd/query/printable.hpp"

namespace nearmiss {

namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// The oldest version of the plug-in interface that still works.
constexpr int oldest_interface = 2;

static_assert(bit_of(Kind::vertex_triangle) == NEARMISS_VERTEX_TRIANGLE);
static_assert(bit_of(Kind::edge_edge) == NEARMISS_EDGE_EDGE);
static_assert(bit_of(Kind::vertex_vertex) == NEARMISS_VERTEX_VERTEX);
static_assert(bit_of(Kind::vertex_edge) == NEARMISS_VERTEX_EDGE);

std::string text_or_empty(const char* text) { return text == nullptr ? "" : text; }

bool is_power_of_two(double x) {
  int exponent = 0;
  return std::isfinite(x) && std::frexp(x, &exponent) == 0.5;
}

Contract contract_of(const nearmiss_contract& given) {
  return {.apart_at_start = given.apart_at_start != 0,
          .one_root = given.one_root != 0,
          .apart_by = given.apart_by,
          .grid = given.grid,
          .shortest = given.shortest,
          .longest = given.longest};
}

/// The fields that versions 3 and 4 added to nearmiss_subject. A shared object that was compiled with an
/// older version lacks them.
struct NewFields {
  int separation_kinds = 0, distance_kinds = 0, step_kinds = 0;
  decltype(nearmiss_subject::distance_bound_within) distance_bound_within = nullptr;
  decltype(nearmiss_subject::distance) distance = nullptr;
  decltype(nearmiss_subject::step) step = nullptr;
  int layout = NEARMISS_ROWS;
  decltype(nearmiss_subject::seconds_of_kernels) seconds_of_kernels = nullptr;

  explicit NewFields(const nearmiss_subject& subject) {
    if (subject.interface_version < 3) return;
    separation_kinds = subject.separation_kinds;
    distance_bound_within = subject.distance_bound_within;
    if (subject.interface_version < 4) return;
    distance_kinds = subject.distance_kinds;
    distance = subject.distance;
    step_kinds = subject.step_kinds;
    step = subject.step;
    layout = subject.layout;
    seconds_of_kernels = subject.seconds_of_kernels;
  }
};

DetectorInfo info_of(const nearmiss_subject& subject, const std::string& options) {
  return {
      .name = subject.name + (options.empty() ? "" : ":" + options),
      .version = text_or_empty(subject.version),
      .about = text_or_empty(subject.about),
      .kinds = subject.kinds,
      .is_narrow = subject.bits == 24,
      .time_sort = static_cast<TimeSort>(subject.time_sort),
      .separation_kinds = subject.takes_separation != 0 ? subject.kinds : NewFields(subject).separation_kinds,
      .distance_kinds = NewFields(subject).distance_kinds,
      .step_kinds = NewFields(subject).step_kinds,
      .batch = std::clamp<std::size_t>(subject.batch, 1, largest_batch),
      .in_arrays = NewFields(subject).layout == NEARMISS_ARRAYS,
      .claims_bound =
          subject.distance_bound != nullptr || NewFields(subject).distance_bound_within != nullptr,
      .contract = contract_of(subject.contract)};
}

void find_nothing(void* /*state*/, int /*kind*/, std::size_t n, const double* /*x*/, const double* /*h*/,
                  int* answer, double* /*toi*/) {
  std::fill_n(answer, n, NEARMISS_NO_COLLISION);
}

const nearmiss_subject& empty_subject() {
  static const nearmiss_subject subject = [] {
    nearmiss_subject empty{};
    empty.interface_version = NEARMISS_INTERFACE;
    empty.name = "empty";
    empty.kinds = bits_of_all_kinds;
    empty.decide = find_nothing;
    return empty;
  }();
  return subject;
}

}  // namespace

std::string fault_of_name(std::string_view name) {
  if (name.empty()) return "a detector without a name";
  if (name.size() > longest_name)
    return "a name of " + std::to_string(name.size()) + " bytes, not " + std::to_string(longest_name) +
           " at most";
  if (printable(name) != name) return "a name with characters that are not seen, or that is no UTF-8";
  constexpr std::array<std::string_view, 18> like_a_blank{
      "\u00a0", "\u1680", "\u2000", "\u2001", "\u2002", "\u2003", "\u2004", "\u2005", "\u2006",
      "\u2007", "\u2008", "\u2009", "\u200a", "\u200c", "\u200d", "\u202f", "\u205f", "\u3000"};
  const auto is_in_name = [&](std::string_view blank) { return name.find(blank) != std::string_view::npos; };
  if (name.starts_with(' ') || name.ends_with(' ') || std::ranges::any_of(like_a_blank, is_in_name))
    return "a name that begins or ends with a blank, or has another one than U+0020";
  if (name.find_first_of(":=/,") != std::string_view::npos)
    return "the name '" + std::string(name) + "' with ':', '=', '/' or ','";
  if (name == "oracle") return "the name 'oracle', under which the oracle's own errors are reported";
  if (name.ends_with(" (beyond contract)"))  // marks a subject that is asked queries outside its contract
    return "the name '" + std::string(name) + "', which --beyond-contract gives";
  return "";
}

std::string fault_of(const Contract& contract) {
  if (contract.grid != 0 && !is_power_of_two(contract.grid)) return "a grid that is no power of two";
  const auto is_length = [](double limit) { return limit >= 0 && std::isfinite(limit); };
  if (!is_length(contract.apart_by) || (contract.apart_by != 0 && !contract.apart_at_start))
    return "a distance at t = 0 that is none, or without apart_at_start";
  if (!is_length(contract.shortest) || !is_length(contract.longest) ||
      (contract.longest != 0 && contract.longest < contract.shortest))
    return "limits of lengths that no length meets, or that are not finite";
  return "";
}

std::string fault_of(const nearmiss_subject& subject) {
  const std::string name = text_or_empty(subject.name);
  if (std::string fault = fault_of_name(name); !fault.empty()) return fault;
  const NewFields added(subject);
  const bool decides_nothing = subject.kinds == 0 && (added.distance_kinds != 0 || added.step_kinds != 0);
  if (subject.decide == nullptr && !decides_nothing) return "'" + name + "' without the function decide";
  const auto is_known = [](int some) { return some > 0 && some <= bits_of_all_kinds; };
  if (!is_known(subject.kinds) && !decides_nothing) return "'" + name + "' with no known kind of queries";
  if ((added.separation_kinds & subject.kinds) != added.separation_kinds)
    return "'" + name + "' with separations for a kind of queries that it does not decide";
  for (const auto& [what, of, has_function] :
       {std::tuple{"distance", added.distance_kinds, added.distance != nullptr},
        std::tuple{"step", added.step_kinds, added.step != nullptr}}) {
    if (of != 0 && !is_known(of)) return "'" + name + "' with unknown kinds in " + what + "_kinds";
    if ((of != 0) != has_function)
      return "'" + name + "' with " + what + "_kinds or the function " + what + ", but not both";
  }
  if (subject.bits != 0 && subject.bits != 24 && subject.bits != 53)
    return "'" + name + "' with coordinates of " + std::to_string(subject.bits) + " bits, not 24 or 53";
  if (subject.time_sort < NEARMISS_NO_TIME || subject.time_sort > NEARMISS_TIME_FREE_STEP)
    return "'" + name + "' with an unknown sort of time";
  if (const int layout = NewFields(subject).layout; layout != NEARMISS_ROWS && layout != NEARMISS_ARRAYS)
    return "'" + name + "' with an unknown layout";
  const std::string of_contract = fault_of(contract_of(subject.contract));
  return of_contract.empty() ? "" : "'" + name + "' with " + of_contract;
}

bool decides(const DetectorInfo& info, Kind kind) { return (info.kinds & bit_of(kind)) != 0; }

bool gives_distance(const DetectorInfo& info, Kind kind) { return (info.distance_kinds & bit_of(kind)) != 0; }

bool filters_step(const DetectorInfo& info, Kind kind) { return (info.step_kinds & bit_of(kind)) != 0; }

bool takes_separation(const DetectorInfo& info, Kind kind) {
  return (info.separation_kinds & bit_of(kind)) != 0;
}

Query rounded_for(const DetectorInfo& info, const Query& query) {
  if (!info.is_narrow) return query;
  const auto round = [](double& number) {
    constexpr double most = std::numeric_limits<float>::max();
    number = static_cast<double>(static_cast<float>(std::clamp(number, -most, most)));
  };
  Query rounded = query;
  for (double& c : rounded.x) round(c);
  round(rounded.separation);
  return rounded;
}

void lay_out(const DetectorInfo& info, const Query& query, std::size_t i, std::size_t n, double* x) {
  const std::size_t size = coordinate_count(query.kind);
  if (!info.in_arrays) {
    copy_coordinates(query.kind, query.x.data(), x + size * i);
    return;
  }
  std::array<double, std::tuple_size_v<decltype(Query::x)>> row;
  copy_coordinates(query.kind, query.x.data(), row.data());
  for (std::size_t k = 0; k < size; ++k) x[n * k + i] = row[k];
}

Verdict verdict_of(const DetectorInfo& info, int answer, double time) {
  if (answer < 0) return {.fault = Fault::error, .fault_code = answer};
  const Verdict invalid{.time = time, .fault = Fault::invalid, .fault_code = answer};
  switch (answer) {
    case NEARMISS_NO_COLLISION:
      return {};
    case NEARMISS_UNKNOWN:
      return Verdict::accepted(Stage::unknown, nan);
    case NEARMISS_COLLISION:
      if (info.time_sort == TimeSort::none) return Verdict::accepted(Stage::unspecified, nan);
      return time >= 0 && time <= 1 ? Verdict::accepted(Stage::unspecified, time) : invalid;
    default:
      return invalid;
  }
}

void expect_usable(const std::string& where, const nearmiss_subject& subject,
                   const std::vector<std::string>& other_names) {
  if (subject.interface_version < oldest_interface || subject.interface_version > NEARMISS_INTERFACE)
    throw Error(where + ": found version " + std::to_string(subject.interface_version) +
                " of the plug-in interface, expected " + std::to_string(oldest_interface) + " to " +
                std::to_string(NEARMISS_INTERFACE));
  std::string fault = fault_of(subject);
  if (fault.empty() && std::find(other_names.begin(), other_names.end(), subject.name) != other_names.end())
    fault = "two detectors with the name '" + std::string(subject.name) + "'";
  if (!fault.empty()) throw Error(where + ": found " + fault + ", expected what ccd/nearmiss_subject.h says");
}

void PluginLibrary::Unload::operator()(void* handle) const { dlclose(handle); }

PluginLibrary::PluginLibrary(const std::string& path)
    : path_(path), library_(dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL)) {
  make_arithmetic_plain();  // loading a library linked by g++ -ffast-math turns on flushing of subnormals
  if (!library_) throw Error(path + ": cannot load the plug-in: " + dlerror());
  using GetSubject = decltype(&nearmiss_get_subject);
  const auto get = reinterpret_cast<GetSubject>(dlsym(library_.get(), "nearmiss_get_subject"));
  if (get == nullptr)
    throw Error(path + ": no function nearmiss_get_subject, expected by ccd/nearmiss_subject.h");
  while (const nearmiss_subject* const subject = get(subjects_.size())) {
    if (subjects_.size() == most_detectors)
      throw Error(path + ": found more than " + std::to_string(most_detectors) +
                  " detectors, expected nearmiss_get_subject to return a null pointer behind the last");
    expect_usable(path, *subject, names());
    subjects_.push_back(subject);
  }
  if (subjects_.empty()) throw Error(path + ": nearmiss_get_subject returned a null pointer");
}

std::vector<std::string> PluginLibrary::names() const {
  std::vector<std::string> names;
  for (const nearmiss_subject* each : subjects_) names.emplace_back(each->name);
  return names;
}

const nearmiss_subject& PluginLibrary::subject(std::string_view name) const {
  std::string known;
  for (const nearmiss_subject* each : subjects_) {
    if (name.empty() || name == each->name) return *each;
    known += (known.empty() ? "" : ", ") + std::string(each->name);
  }
  throw Error(path_ + ": found no detector '" + std::string(name) + "', expected one of " + known);
}

Detector::Detector(const nearmiss_subject& subject, const std::string& options)
    : subject_(subject), info_(info_of(subject, options)) {
  if (subject.open == nullptr) {
    if (!options.empty())
      throw Error(std::string(subject.name) + ": found the options '" + options + "', expected none");
    return;
  }
  std::array<char, 512> message{};
  state_ = subject.open(options.c_str(), message.data(), message.size());
  make_arithmetic_plain();
  message.back() = '\0';
  if (state_ == nullptr)
    throw Error(std::string(subject.name) + ": refuses the options '" + options + "': " + message.data());
}

Detector::Detector(const nearmiss_subject& subject, void* state)
    : subject_(subject), info_(info_of(subject, "")), state_(state), closes_(false) {}

Detector::~Detector() {
  if (closes_ && state_ != nullptr && subject_.close != nullptr) subject_.close(state_);
  make_arithmetic_plain();
}

void Detector::decide(Kind kind, const double* x, const double* separations, std::span<int> answers,
                      std::span<double> times) const {
  std::fill(answers.begin(), answers.end(), std::numeric_limits<int>::min());
  std::fill(times.begin(), times.end(), nan);
  subject_.decide(state_, bit_of(kind), answers.size(), x, separations, answers.data(), times.data());
  make_arithmetic_plain();
}

BoundAnswer Detector::bound(Kind kind, const double* x, double separation) const {
  if (!info_.claims_bound) return BoundAnswer::given(std::numeric_limits<double>::infinity());
  const auto within = NewFields(subject_).distance_bound_within;
  const double bound = within != nullptr ? within(state_, bit_of(kind), x, separation)
                                         : subject_.distance_bound(state_, bit_of(kind), x);
  make_arithmetic_plain();
  return BoundAnswer::given(bound);
}

DistanceAnswer Detector::distance(Kind kind, const double* x) const {
  std::array<double, 4> weights = DistanceAnswer().weights;
  const double distance = NewFields(subject_).distance(state_, bit_of(kind), x, weights.data());
  make_arithmetic_plain();
  return DistanceAnswer::given(distance, weights);
}

StepAnswer Detector::step(Kind kind, const double* x) const {
  StepAnswer none;
  none.y.fill(nan);
  const double clearance = NewFields(subject_).step(state_, bit_of(kind), x, none.y.data());
  make_arithmetic_plain();
  return StepAnswer::given(none.y, clearance, vertices(kind));
}

std::uint64_t Detector::kernel_nanoseconds() const {
  const auto seconds_of_kernels = NewFields(subject_).seconds_of_kernels;
  if (seconds_of_kernels == nullptr) return 0;
  const double seconds = seconds_of_kernels(state_);
  make_arithmetic_plain();
  constexpr double longest = 1e6;
  return seconds >= 0 && seconds <= longest ? static_cast<std::uint64_t>(seconds * 1e9) : 0;
}

const Detector& Detector::empty() {
  static const Detector detector(empty_subject(), "");
  return detector;
}

}  // namespace nearmiss
