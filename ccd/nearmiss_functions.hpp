// Makes plug-ins from functions with the field's usual signatures, in C++17. The source of a plug-in includes
// the header of the functions, then this header, and describes a detector. tools/subject compiles the source:
//
//   #include "mine.hpp"
//   #include "ccd/nearmiss_functions.hpp"
//   NEARMISS_SUBJECT(detector("mine").vertex_triangle(point_triangle_ccd).edge_edge(edge_edge_ccd))
//
// This header recognises the signature of each function. V stands for the positions of the vertices x0 x1 ..
// at t = 0, then their positions at t = 1: 8 arguments for vt and ee, 6 for ve, 4 for vv. X stands for the
// positions at t = 0, D for their displacements, and h for the separation:
//
//   signature                                          as in                gives times       takes h
//   bool f(V, double& toi, double h, double tmax)      ipc-toolkit          lower bounds      yes
//   bool f(X, D, double eta, double h, double& toi)    Codim-IPC            lower bounds      yes
//   bool f(V, double h, double& toi)                   CTCD                 estimates         yes
//   bool f(V, double& toi)                                                  estimates         no
//   bool f(V)                                                               none              no
//   bool f(x0, x0 at t = 1, 0, x1, x1 at t = 1, 1, ..) El Topo              none              no
//   Answer f(const Question&)                          everything else      none              no
//
// The compiler does not notice if a function takes its vertices in another order, such as the triangle first,
// or if its numbers, such as toi, have another meaning than in the table. Call such a function from a
// function that takes a Question (fuzz/subjects/peers/ has examples). If the functions of a detector give
// times of different sorts, the detector claims the weakest sort.
//
// A function with the signature of Codim-IPC gets eta = 0.1, toi = 1, rounded displacements, and the query's
// separation as the thickness h. A function may take a vertex as a const double*, as a vector of Eigen if
// Eigen is included before this header, or as a type T for which T{x, y, z} takes three numbers. A function
// may return `int` in place of `bool`.
//
// If a function f is overloaded, has default arguments or is a member, pass NEARMISS_CALL(f), such as
// NEARMISS_CALL(ipc::AdditiveCCD().edge_edge_ccd). set() sets any field of nearmiss_subject.h, even if the
// table gives another value:
//
//   .set(&nearmiss_subject::time_sort, NEARMISS_NO_TIME).set(&nearmiss_contract::apart_at_start, 1)
//
// A detector may also have functions that return the distance of primitives at rest. Such a function takes
// the vertices x0 x1 .. at one time. If f returns the squared distance, squared(f) returns the distance:
//
//   NEARMISS_SUBJECT(detector("mine").edge_edge_distance(squared(NEARMISS_CALL(ipc::edge_edge_distance))))
//
// .edge_edge_step(f) and the like add a filter of steps, a function double f(const Question&, double* y). The
// filter writes to y the positions of the vertices at the end of the safe step, and returns the clearance
// that the filter claims during this step (nearmiss_subject.h).
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <functional>
#include <limits>
#include <memory>
#include <string>
#include <tuple>
#include <type_traits>
#include <utility>

// The names of these two headers are relative to the folder of this header, in the source tree and in an
// installation.
#include "nearmiss_subject.h"
#include "subjects/number_options.hpp"

namespace nearmiss::plugin {

/// Converts to Number and to no other type. (Compilers differ in whether T{x, y, z} may round a double.)
template <class Number>
struct Exactly {
  template <class T, class = std::enable_if_t<std::is_same_v<T, Number>>>
  operator T() const;  // NOLINT(google-explicit-constructor)
};

/// Whether T{x, y, z} takes three values of type Number.
template <class T, class Number, class = void>
constexpr bool is_braced = false;
template <class T, class Number>
constexpr bool
    is_braced<T, Number, std::void_t<decltype(T{Exactly<Number>(), Exactly<Number>(), Exactly<Number>()})>> =
        true;

template <class T>
constexpr bool is_eigen =
#ifdef EIGEN_WORLD_VERSION
    std::is_base_of_v<Eigen::EigenBase<T>, T>;
#else
    false;
#endif

/// A vertex. It converts to every type that a function may use for a vertex.
class Point {
 public:
  explicit Point(const double* x) : x_(x) {}

  template <class T, class = std::enable_if_t<std::is_same_v<T, const double*> || is_eigen<T> ||
                                              is_braced<T, double> || is_braced<T, float>>>
  operator T() const {  // NOLINT(google-explicit-constructor): functions take it as their vector
    if constexpr (std::is_same_v<T, const double*>) return x_;
#ifdef EIGEN_WORLD_VERSION
    else if constexpr (is_eigen<T>)  // does not copy the coordinates, so that an Eigen::Ref may refer to them
      return T(Eigen::Map<const Eigen::Vector3d>(x_).template cast<typename T::Scalar>());
#endif
    else if constexpr (is_braced<T, double>)
      return T{x_[0], x_[1], x_[2]};
    else
      return T{static_cast<float>(x_[0]), static_cast<float>(x_[1]), static_cast<float>(x_[2])};
  }

 private:
  const double* x_;
};

constexpr std::size_t vertices_of(int kind) {
  return kind == NEARMISS_VERTEX_VERTEX ? 2 : kind == NEARMISS_VERTEX_EDGE ? 3 : 4;
}

/// One query, for a function whose signature is not in the table.
struct Question {
  int kind;
  const double* x;  ///< the query's coordinates (nearmiss_subject.h)
  double separation;

  [[nodiscard]] Point start(std::size_t vertex) const { return Point(x + 3 * vertex); }
  [[nodiscard]] Point end(std::size_t vertex) const { return start(vertices_of(kind) + vertex); }
};

/// The detector's answer to one query.
struct Answer {
  int value = NEARMISS_NO_COLLISION;
  double time = std::numeric_limits<double>::quiet_NaN();

  /// The answer of a function that returns only whether there is a collision.
  static Answer of(bool collides) { return {collides ? NEARMISS_COLLISION : NEARMISS_NO_COLLISION}; }
  static Answer of(bool collides, double time) { return {of(collides).value, time}; }

  /// Whether a simulation must treat the query as a collision.
  explicit operator bool() const { return value != NEARMISS_NO_COLLISION; }
};

/// The vertices of a query at t = 0, then those at t = 1, as a tuple.
template <std::size_t... i>
auto points(const Question& q, std::index_sequence<i...> /*vertices*/) {
  return std::tuple(q.start(i)..., q.end(i)...);
}

/// Calls act(start 0, start 1, ..., end 0, end 1, ...) for a query of n vertices.
template <std::size_t n = 4, class Act>
auto with_vertices(const Question& q, const Act& act) {
  return std::apply(act, points(q, std::make_index_sequence<n>()));
}

/// A query's coordinates at t = 0, then the rounded displacements of its vertices.
inline std::array<double, 24> displaced(const Question& q) {
  const std::size_t n = 3 * vertices_of(q.kind);
  std::array<double, 24> x;
  std::copy(q.x, q.x + n, x.begin());
  std::transform(q.x + n, q.x + 2 * n, q.x, x.begin() + n, std::minus<>());
  return x;
}

/// Calls act(start 0, start 1, ..., displacement 0, displacement 1, ...) for a query of n vertices.
template <std::size_t n = 4, class Act>
auto with_displacements(const Question& q, const Act& act) {
  return with_vertices<n>({q.kind, displaced(q).data(), q.separation}, act);
}

template <class Result>
constexpr bool is_answer =
    std::is_same_v<Result, bool> || std::is_same_v<Result, int> || std::is_same_v<Result, Answer>;

/// Whether a function of type F takes arguments of these types, and returns an answer.
template <class Void, class F, class... Argument>
constexpr bool answers = false;
template <class F, class... Argument>
constexpr bool answers<std::void_t<std::invoke_result_t<const F&, Argument...>>, F, Argument...> =
    is_answer<std::invoke_result_t<const F&, Argument...>>;

/// Asks a function of type F about queries of one kind, as its signature requires. `State` is a tuple of the
/// arguments that come before the arguments in the table above: the options, or nothing.
template <class F, class State, int kind>
class Asked {
  using Vertices = std::make_index_sequence<vertices_of(kind)>;

  template <std::size_t... i>
  static auto indexed(const Question& q, std::index_sequence<i...> /*vertices*/) {
    return std::tuple_cat(std::tuple<Point, Point, std::size_t>(q.start(i), q.end(i), i)...);
  }
  template <class Arguments>
  struct Takes;
  template <class... Argument>
  struct Takes<std::tuple<Argument...>> : std::bool_constant<answers<void, F, Argument...>> {};

  using Points = decltype(points(std::declval<Question>(), Vertices()));
  using Indexed = decltype(indexed(std::declval<Question>(), Vertices()));
  /// Whether the function takes the state, then the vertices in the tuple First, then arguments of the types
  /// `Argument`.
  template <class First, class... Argument>
  static constexpr bool takes = Takes<decltype(std::tuple_cat(
      std::declval<State>(), std::declval<First>(), std::declval<std::tuple<Argument...>>()))>::value;

  static constexpr bool is_question = takes<std::tuple<const Question&>>;
  // If the function also takes a number in place of the reference double& toi, it has another signature.
  static constexpr bool is_ipc =
      takes<Points, double&, double, double> && !takes<Points, double, double, double>;
  static constexpr bool is_displaced =
      takes<Points, double, double, double&> && !takes<Points, double, double, double>;
  static constexpr bool is_within = takes<Points, double, double&> && !takes<Points, double, double>;
  static constexpr bool is_timed = takes<Points, double&> && !takes<Points, double>;
  static constexpr bool is_plain = takes<Points>;
  static constexpr bool is_indexed = takes<Indexed>;
  static_assert(is_question || is_ipc || is_displaced || is_within || is_timed || is_plain || is_indexed,
                "the function has none of the signatures that nearmiss_functions.hpp lists");

 public:
  static constexpr bool takes_separation = !is_question && (is_ipc || is_displaced || is_within);
  static constexpr int time_sort = is_question              ? NEARMISS_NO_TIME
                                   : is_ipc || is_displaced ? NEARMISS_TIME_LOWER_BOUND
                                   : is_within || is_timed  ? NEARMISS_TIME_ESTIMATE
                                                            : NEARMISS_NO_TIME;

  static Answer ask(const F& f, const State& state, const Question& q) {
    double toi = std::numeric_limits<double>::quiet_NaN();
    const auto call = [&](auto&& first, auto... rest) {
      return std::apply(f, std::tuple_cat(state, std::forward<decltype(first)>(first), std::move(rest)...));
    };
    const auto vertices = [&] { return points(q, Vertices()); };
    if constexpr (is_question) {
      const auto said = call(std::tuple<const Question&>(q));
      if constexpr (std::is_same_v<decltype(said), const Answer>)
        return said;
      else
        return Answer::of(said);
    } else if constexpr (is_ipc) {
      const bool collides = call(vertices(), std::tuple<double&, double, double>(toi, q.separation, 1));
      return Answer::of(collides, toi);
    } else if constexpr (is_displaced) {
      toi = 1;  // the function expects the end of the time step here
      const bool collides = with_displacements<vertices_of(kind)>(q, [&](const auto&... v) {
        return call(std::tuple(v...), std::tuple<double, double, double&>(0.1, q.separation, toi));
      });
      return Answer::of(collides, toi);
    } else if constexpr (is_within) {
      const bool collides = call(vertices(), std::tuple<double, double&>(q.separation, toi));
      return Answer::of(collides, toi);
    } else if constexpr (is_timed) {
      const bool collides = call(vertices(), std::tuple<double&>(toi));
      return Answer::of(collides, toi);
    } else if constexpr (is_plain) {
      return Answer::of(call(vertices()));
    } else {
      return Answer::of(call(indexed(q, Vertices())));
    }
  }
};

template <class Settings>
Settings owner_of(const Option<Settings>* /*option*/);

/// The task of a function of a detector: to decide queries, to give distances, or to filter steps.
enum class Role { decide, measure, step };

/// A function of a detector, with its role and the kind of its queries.
template <Role its_role, int its_kind, class F>
struct Part {
  static constexpr Role role = its_role;
  static constexpr int kind = its_kind;
  F f;
};

/// Whether a function of type F takes arguments of these types, and returns a number.
template <class F, class Arguments>
constexpr bool gives_number = false;
template <class F, class... Argument>
constexpr bool gives_number<F, std::tuple<Argument...>> =
    std::is_invocable_r_v<double, const F&, Argument...>;

/// The distance that f gives for the primitives with the coordinates x. `front` has the arguments that f
/// takes before the vertices.
template <class F, class Front, std::size_t... i>
double distance_by(const F& f, const Front& front, const double* x, std::index_sequence<i...> /*vertices*/) {
  auto arguments = std::tuple_cat(front, std::tuple(Point(x + 3 * i)...));
  static_assert(gives_number<F, decltype(arguments)>,
                "a function that gives a distance takes the vertices at one time, and returns a number");
  if constexpr (gives_number<F, decltype(arguments)>) return std::apply(f, arguments);
  return 0;
}

template <class F>
auto squared(F f) {
  return [f](auto&&... argument) -> decltype(std::sqrt(f(std::forward<decltype(argument)>(argument)...))) {
    return std::sqrt(f(std::forward<decltype(argument)>(argument)...));
  };
}

struct NoOptions {};

/// A description of a detector. Each member function returns a copy of the description with one more function
/// or setting.
template <class Settings, class... Parts>
struct Detector {
  nearmiss_subject subject;
  std::tuple<Parts...> parts;

  template <Role role, int kind, class F>
  auto with(F f) const {
    using Added = Part<role, kind, F>;
    return Detector<Settings, Parts..., Added>{subject, std::tuple_cat(parts, std::tuple(Added{f}))};
  }
  template <class F>
  auto vertex_triangle(F f) const {
    return with<Role::decide, NEARMISS_VERTEX_TRIANGLE>(f);
  }
  template <class F>
  auto edge_edge(F f) const {
    return with<Role::decide, NEARMISS_EDGE_EDGE>(f);
  }
  template <class F>
  auto vertex_vertex(F f) const {
    return with<Role::decide, NEARMISS_VERTEX_VERTEX>(f);
  }
  template <class F>
  auto vertex_edge(F f) const {
    return with<Role::decide, NEARMISS_VERTEX_EDGE>(f);
  }
  template <class F>
  auto vertex_triangle_distance(F f) const {
    return with<Role::measure, NEARMISS_VERTEX_TRIANGLE>(f);
  }
  template <class F>
  auto edge_edge_distance(F f) const {
    return with<Role::measure, NEARMISS_EDGE_EDGE>(f);
  }
  template <class F>
  auto vertex_vertex_distance(F f) const {
    return with<Role::measure, NEARMISS_VERTEX_VERTEX>(f);
  }
  template <class F>
  auto vertex_edge_distance(F f) const {
    return with<Role::measure, NEARMISS_VERTEX_EDGE>(f);
  }
  template <class F>
  auto vertex_triangle_step(F f) const {
    return with<Role::step, NEARMISS_VERTEX_TRIANGLE>(f);
  }
  template <class F>
  auto edge_edge_step(F f) const {
    return with<Role::step, NEARMISS_EDGE_EDGE>(f);
  }
  template <class F>
  auto vertex_vertex_step(F f) const {
    return with<Role::step, NEARMISS_VERTEX_VERTEX>(f);
  }
  template <class F>
  auto vertex_edge_step(F f) const {
    return with<Role::step, NEARMISS_VERTEX_EDGE>(f);
  }

  /// Sets a field of nearmiss_subject, or of its contract.
  template <class T, class Value>
  Detector set(T nearmiss_subject::*field, Value value) const {
    Detector changed = *this;
    changed.subject.*field = value;
    return changed;
  }
  template <class T, class Value>
  Detector set(T nearmiss_contract::*field, Value value) const {
    Detector changed = *this;
    changed.subject.contract.*field = value;
    return changed;
  }

  /// Lets the user set, by KEY=NUMBER, the options that `settings` lists. Every function then gets, as its
  /// first argument, a struct whose members have the values of the options.
  template <const auto& settings>
  auto options() const {
    using State = decltype(owner_of(settings.data()));
    Detector<State, Parts...> changed{subject, parts};
    changed.subject.open = [](const char* text, char* message, std::size_t size) -> void* {
      auto state = std::make_unique<State>();
      const std::string fault = set_options(settings, text, *state);
      if (fault.empty()) return state.release();
      std::snprintf(message, size, "%s", fault.c_str());
      return nullptr;
    };
    changed.subject.close = [](void* state) { delete static_cast<State*>(state); };
    return changed;
  }

  using Front =
      std::conditional_t<std::is_same_v<Settings, NoOptions>, std::tuple<>, std::tuple<const Settings&>>;
  static Front front(const void* state) {
    if constexpr (std::is_same_v<Settings, NoOptions>)
      return {};
    else
      return {*static_cast<const Settings*>(state)};
  }

  template <class Act>
  void for_each_part(const Act& act) const {
    std::apply([&](const auto&... part) { (act(part), ...); }, parts);
  }
  /// Calls act(part) for each function that has the role `role` and the kind `kind`.
  template <Role role, class Act>
  void for_parts_of(int kind, const Act& act) const {
    for_each_part([&](const auto& part) {
      if constexpr (std::decay_t<decltype(part)>::role == role)
        if (part.kind == kind) act(part);
    });
  }
  /// The Asked object, whose ask() calls the part's function.
  template <int kind, class F>
  static Asked<F, Front, kind> asked(const Part<Role::decide, kind, F>& /*part*/) {
    return {};
  }
};

/// The value of a field that is still to be set from the signatures of the detector's functions.
constexpr int from_signatures = -1;

/// A detector without functions. nearmiss shows its name, its version and the line `about` to users.
inline Detector<NoOptions> detector(const char* name, const char* version = "", const char* about = "") {
  nearmiss_subject subject{};
  subject.interface_version = NEARMISS_INTERFACE;
  subject.name = name;
  subject.version = version;
  subject.about = about;
  subject.time_sort = from_signatures;
  subject.takes_separation = from_signatures;
  return {subject, {}};
}

/// Detector number i in the tuple of detectors that Described::describe() returns.
template <class Described, std::size_t i>
const auto& described() {
  static const auto all = Described::describe();
  return std::get<i>(all);
}

/// Implements decide() of nearmiss_subject.h: answers n queries of a kind with the detector's function for
/// this kind.
template <class Detector>
void decide_each(const Detector& detector, void* state, int kind, std::size_t n, const double* x,
                 const double* h, int* answer, double* toi) {
  detector.template for_parts_of<Role::decide>(kind, [&](const auto& part) {
    for (std::size_t k = 0; k < n; ++k) {
      const Answer said = detector.asked(part).ask(part.f, detector.front(state),
                                                   {kind, x + 6 * vertices_of(kind) * k, h[k]});
      answer[k] = said.value;
      toi[k] = said.time;
    }
  });
}

/// Implements distance() of nearmiss_subject.h.
template <class Described, std::size_t i>
double distance_of(void* state, int kind, const double* x, double* /*weights*/) {
  const auto& detector = described<Described, i>();
  double distance = std::numeric_limits<double>::quiet_NaN();
  detector.template for_parts_of<Role::measure>(kind, [&](const auto& part) {
    constexpr std::size_t n = vertices_of(std::decay_t<decltype(part)>::kind);
    distance = distance_by(part.f, detector.front(state), x, std::make_index_sequence<n>());
  });
  return distance;
}

/// Implements step() of nearmiss_subject.h.
template <class Described, std::size_t i>
double step_of(void* state, int kind, const double* x, double* y) {
  const auto& detector = described<Described, i>();
  double clearance = std::numeric_limits<double>::quiet_NaN();
  detector.template for_parts_of<Role::step>(kind, [&](const auto& part) {
    clearance =
        std::apply(part.f, std::tuple_cat(detector.front(state), std::tuple(Question{kind, x, 0}, y)));
  });
  return clearance;
}

/// The nearmiss_subject of a detector, in which decide, distance and step are still null pointers.
template <class Detector>
nearmiss_subject described_by(const Detector& detector) {
  nearmiss_subject subject = detector.subject;
  // `sort` is the weakest sort of times that any of the detector's functions gives.
  int sort = NEARMISS_TIME_LOWER_BOUND, with_separation = 0;
  detector.for_each_part([&](const auto& part) {
    constexpr Role role = std::decay_t<decltype(part)>::role;
    if constexpr (role == Role::decide) {
      const auto asked = detector.asked(part);
      subject.kinds |= part.kind;
      sort = std::min(sort, asked.time_sort);
      with_separation |= asked.takes_separation ? part.kind : 0;
    } else {
      (role == Role::measure ? subject.distance_kinds : subject.step_kinds) |= part.kind;
    }
  });
  if (subject.kinds == 0) sort = NEARMISS_NO_TIME;
  if (subject.time_sort == from_signatures) subject.time_sort = sort;
  if (subject.takes_separation == from_signatures) {
    subject.takes_separation = with_separation == subject.kinds ? 1 : 0;
    if (subject.takes_separation == 0) subject.separation_kinds = with_separation;
  }
  return subject;
}

/// The nearmiss_subject of a detector without options. The subject only decides queries, and the state of its
/// decide() is a pointer to the detector.
template <class... Parts>
nearmiss_subject described_by_itself(const Detector<NoOptions, Parts...>& detector) {
  using Its = Detector<NoOptions, Parts...>;
  nearmiss_subject subject = described_by(detector);
  subject.distance_kinds = subject.step_kinds = 0;
  subject.decide = [](void* itself, int kind, std::size_t n, const double* x, const double* h, int* answer,
                      double* toi) {
    decide_each(*static_cast<const Its*>(itself), nullptr, kind, n, x, h, answer, toi);
  };
  return subject;
}

template <class Described, std::size_t i>
nearmiss_subject subject_of() {
  nearmiss_subject subject = described_by(described<Described, i>());
  subject.decide = [](void* state, int kind, std::size_t n, const double* x, const double* h, int* answer,
                      double* toi) {
    decide_each(described<Described, i>(), state, kind, n, x, h, answer, toi);
  };
  if (subject.distance_kinds != 0) subject.distance = distance_of<Described, i>;
  if (subject.step_kinds != 0) subject.step = step_of<Described, i>;
  return subject;
}

template <class Described, std::size_t... i>
const nearmiss_subject* numbered(std::size_t index, std::index_sequence<i...> /*detectors*/) {
  static const std::array subjects{subject_of<Described, i>()...};
  return index < subjects.size() ? &subjects[index] : nullptr;
}

template <class Described>
const nearmiss_subject* numbered(std::size_t index) {
  return numbered<Described>(index,
                             std::make_index_sequence<std::tuple_size_v<decltype(Described::describe())>>());
}

}  // namespace nearmiss::plugin

/// A callable object for a function that may have overloads or default arguments.
#define NEARMISS_CALL(...)                                                                         \
  [](auto&&... argument) -> decltype(__VA_ARGS__(std::forward<decltype(argument)>(argument)...)) { \
    return __VA_ARGS__(std::forward<decltype(argument)>(argument)...);                             \
  }

/// Makes the shared object a plug-in with these detectors, even if the compiler hides other symbols.
#define NEARMISS_SUBJECT(...)                                                                      \
  namespace {                                                                                      \
  struct NearmissDescribed {                                                                       \
    static auto describe() {                                                                       \
      using namespace nearmiss::plugin; /* NOLINT */                                               \
      return std::make_tuple(__VA_ARGS__);                                                         \
    }                                                                                              \
  };                                                                                               \
  }                                                                                                \
  [[gnu::visibility("default")]] const nearmiss_subject* nearmiss_get_subject(std::size_t index) { \
    return nearmiss::plugin::numbered<NearmissDescribed>(index);                                   \
  }
