#include "fuzz/scenes/marks.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <boost/container/static_vector.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <vector>

#include "reports/text/json.hpp"

namespace nearmiss {

namespace {

// A picture has at most this many marked primitives, and at most this many unmarked primitives.
constexpr std::size_t most_primitives = 8000;
constexpr std::uint32_t collides = 1, tangled = 2;
constexpr std::size_t most_subjects = 15;  // bits of a mark: 2 + 2 * 15
constexpr std::uint32_t falsely_reported_by(std::size_t subject) { return 4U << (2 * subject); }
constexpr std::uint32_t missed_by(std::size_t subject) { return 8U << (2 * subject); }

/// The mark (a set of the bits above) of the primitive whose vertices are `primitive`; 0 if this primitive
/// has no mark.
template <class Key>
std::uint32_t mark_of(const std::map<Key, std::uint32_t>& marks, const Key& primitive) {
  const auto found = marks.find(primitive);
  return found == marks.end() ? 0 : found->second;
}

std::array<int, 2> edge(int a, int b) { return {std::min(a, b), std::max(a, b)}; }

/// The vertices of a triangle, a line or a dot.
using Vertices = boost::container::static_vector<int, 3>;

using Numbers = std::vector<std::int64_t>;

std::string to_text(const Numbers& numbers) { return fmt::format("{}", fmt::join(numbers, " ")); }

/// Numbers the points that are shown, and lists their coordinates as integers from 0 to 9999.
class ShownPoints {
 public:
  explicit ShownPoints(const MovingMesh& mesh) : mesh_(mesh), numbers_(mesh.start.size(), -1) {
    for (const auto* points : {&mesh.start, &mesh.end})
      for (const auto& p : *points) {
        lo_ = lo_.cwiseMin(p);
        hi_ = hi_.cwiseMax(p);
      }
    // Halves the bounds first, since their difference may overflow.
    scale_ = (hi_ / 2 - lo_ / 2).maxCoeff();
  }

  /// Adds a primitive to a list: the numbers of its points, then its mark.
  void show(Numbers& list, const Vertices& vertices, std::uint32_t mark) {
    for (const int vertex : vertices) list.push_back(number(vertex));
    list.push_back(mark);
  }
  [[nodiscard]] const Numbers& coordinates() const { return coordinates_; }

 private:
  int number(int vertex) {
    int& number = numbers_[static_cast<std::size_t>(vertex)];
    if (number < 0) {
      number = count_++;
      for (const auto* points : {&mesh_.start, &mesh_.end})
        for (int k = 0; k < 3; ++k) {
          const double part = ((*points)[static_cast<std::size_t>(vertex)][k] / 2 - lo_[k] / 2) / scale_;
          coordinates_.push_back(scale_ > 0 ? std::lround(9999 * part) : 0);
        }
    }
    return number;
  }

  const MovingMesh& mesh_;
  Vector3<double> lo_ = Vector3<double>::Constant(std::numeric_limits<double>::infinity());
  Vector3<double> hi_ = -lo_;
  double scale_ = 0;
  std::vector<int> numbers_;
  int count_ = 0;
  Numbers coordinates_;
};

/// At most `most` elements of a list, evenly spread.
template <class T>
std::vector<T> thinned(const std::vector<T>& all, std::size_t most) {
  std::vector<T> some;
  for (std::size_t i = 0; i < std::min(most, all.size()); ++i)
    some.push_back(all[all.size() <= most ? i : i * all.size() / most]);
  return some;
}

struct Marked {
  Vertices vertices;
  std::uint32_t mark;
};

}  // namespace

void Marks::add_collision(const Candidate& candidate) { add(candidate, collides); }

void Marks::add(const Candidate& candidate, std::size_t subject, const Outcome& outcome) {
  if (outcome.collision) add(candidate, collides);
  if (subject >= most_subjects || outcome.verdict.fault != Fault::none) return;
  if (outcome.verdict.hit != outcome.collision)
    add(candidate, outcome.collision ? missed_by(subject) : falsely_reported_by(subject));
}

void Marks::add_tangled(const std::array<int, 2>& edge, const std::array<int, 3>& triangle) {
  edges_[edge] |= tangled;
  triangles_[triangle] |= tangled;
}

void Marks::add(const Candidate& candidate, Mark mark) {
  const auto& v = candidate.vertices;
  if (has_triangle(candidate.kind)) {
    points_[v[0]] |= mark;
    triangles_[{v[1], v[2], v[3]}] |= mark;
  } else {
    edges_[edge(v[0], v[1])] |= mark;
    edges_[edge(v[2], v[3])] |= mark;
  }
}

void Marks::merge(const Marks& other) {
  for (const auto& [primitive, mark] : other.triangles_) triangles_[primitive] |= mark;
  for (const auto& [primitive, mark] : other.edges_) edges_[primitive] |= mark;
  for (const auto& [point, mark] : other.points_) points_[point] |= mark;
}

std::size_t Marks::missed() const {
  Mark is_missed = 0;
  for (std::size_t subject = 0; subject < most_subjects; ++subject) is_missed |= missed_by(subject);
  const auto number = [&](const auto& marks) {
    return std::count_if(marks.begin(), marks.end(),
                         [&](const auto& each) { return (each.second & is_missed) != 0; });
  };
  return static_cast<std::size_t>(number(triangles_) + number(edges_) + number(points_));
}

/// The marked primitives of a mesh, and its other primitives.
struct Marks::Primitives {
  std::vector<Marked> marked, others;

  void add(const Vertices& vertices, Mark mark) { (mark != 0 ? marked : others).push_back({vertices, mark}); }
};

/// Adds the triangles, each with its own marks and the marks of its edges. Then adds the edges that are in no
/// triangle.
void Marks::add_surfaces(const MovingMesh& mesh, Primitives& primitives) const {
  const auto size = mesh.start.size() + 1;
  // Most primitives have no mark. A search for the mark is necessary only if all vertices of a primitive
  // belong to marked primitives.
  std::vector<bool> is_marked(size);
  const auto mark_vertices = [&](const auto& marks) {
    for (const auto& [primitive, unused] : marks)
      for (const int vertex : primitive) is_marked[static_cast<std::size_t>(vertex)] = true;
  };
  mark_vertices(triangles_);
  mark_vertices(edges_);
  const auto mark_of_primitive = [&](const auto& marks, const auto& primitive) {
    const auto may_be_marked = [&](int vertex) { return is_marked[static_cast<std::size_t>(vertex)]; };
    return std::ranges::all_of(primitive, may_be_marked) ? mark_of(marks, primitive) : 0;
  };
  // The edges are sorted. The edges whose smaller vertex is v have the indices from first[v] to first[v + 1]
  // - 1.
  std::vector<std::ptrdiff_t> first(size);
  for (const auto& e : mesh.edges) ++first[static_cast<std::size_t>(e[0]) + 1];
  std::partial_sum(first.begin(), first.end(), first.begin());
  std::vector<bool> is_of_triangle(mesh.edges.size());
  for (const auto& t : mesh.triangles) {
    Mark mark = mark_of_primitive(triangles_, t);
    for (const auto& side : {edge(t[0], t[1]), edge(t[1], t[2]), edge(t[2], t[0])}) {
      mark |= mark_of_primitive(edges_, side);
      const auto* const at = &first[static_cast<std::size_t>(side[0])];
      const auto end = mesh.edges.begin() + at[1];
      const auto place = std::lower_bound(mesh.edges.begin() + at[0], end, side);
      if (place != end && *place == side)
        is_of_triangle[static_cast<std::size_t>(place - mesh.edges.begin())] = true;
    }
    primitives.add(Vertices(t.begin(), t.end()), mark);
  }
  for (std::size_t i = 0; i < mesh.edges.size(); ++i)
    if (const auto& e = mesh.edges[i]; !is_of_triangle[i])
      primitives.add(Vertices(e.begin(), e.end()), mark_of_primitive(edges_, e));
}

/// Adds the points that have a mark, and the points that are in no edge and no triangle.
void Marks::add_points(const MovingMesh& mesh, Primitives& primitives) const {
  std::vector<bool> in_primitive(mesh.start.size());
  for (const auto& t : mesh.triangles)
    for (const int vertex : t) in_primitive[static_cast<std::size_t>(vertex)] = true;
  for (const auto& e : mesh.edges)
    for (const int vertex : e) in_primitive[static_cast<std::size_t>(vertex)] = true;
  for (int v = 0; v < static_cast<int>(mesh.start.size()); ++v)
    if (const Mark mark = mark_of(points_, v); mark != 0 || !in_primitive[static_cast<std::size_t>(v)])
      primitives.add({v}, mark);
}

ScenePicture Marks::picture(const std::string& step, const MovingMesh& mesh,
                            const std::vector<std::string>& subjects) const {
  Primitives primitives;
  add_surfaces(mesh, primitives);
  add_points(mesh, primitives);
  nlohmann::json json;
  json["primitives"] = primitives.marked.size() + primitives.others.size();
  json["meanings"] = {"collides", "tangled"};
  for (const std::string& subject : subjects)
    for (const char* what : {"falsely reported by", "missed by"})
      json["meanings"].push_back(fmt::format("{} {}", what, subject));
  std::array<Numbers, 3> lists;  // one list for the points, one for the lines and one for the triangles
  ShownPoints points(mesh);
  for (const auto& some :
       {thinned(primitives.others, most_primitives), thinned(primitives.marked, most_primitives)})
    for (const Marked& each : some) points.show(lists[each.vertices.size() - 1], each.vertices, each.mark);
  json["points"] = to_text(points.coordinates());
  json["dots"] = to_text(lists[0]);
  json["lines"] = to_text(lists[1]);
  json["triangles"] = to_text(lists[2]);
  return {step, json_text(json)};
}

}  // namespace nearmiss
