#include "fuzz/scenes/candidates.hpp"

#include <CGAL/Bbox_3.h>
#include <CGAL/box_intersection_d.h>

#include <algorithm>
#include <array>
#include <limits>
#include <optional>
#include <span>
#include <vector>

namespace nearmiss {

namespace {

using Box = CGAL::Box_intersection_d::Box_with_info_d<double, 3, std::size_t>;

/// The boxes that primitives sweep; a box's info is the primitive's number.
template <class Vertices>
std::vector<Box> swept_boxes(const MovingMesh& mesh, std::size_t count, const Vertices& vertices) {
  std::vector<Box> boxes;
  boxes.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    CGAL::Bbox_3 bounds;
    for (const int vertex : vertices(i)) {
      const auto v = static_cast<std::size_t>(vertex);
      for (const auto& p : {mesh.start[v], mesh.end[v]})
        bounds += CGAL::Bbox_3(p.x(), p.y(), p.z(), p.x(), p.y(), p.z());
    }
    boxes.emplace_back(bounds, i);
  }
  return boxes;
}

/// Brings boxes that are near each other together: borders[i] to borders[i + 1] is a part.
class Parts {
 public:
  explicit Parts(std::vector<Box>& boxes)
      : boxes_(boxes), most_(std::clamp(boxes.size() / 64, smallest, largest)) {
    split(0, boxes.size());
    borders_.push_back(boxes.size());
  }
  std::vector<std::size_t> borders() && { return std::move(borders_); }

 private:
  // Each part looks at the boxes of all others once, which large meshes need few of.
  static constexpr std::size_t smallest = 256;
  static constexpr std::size_t largest = 16384;

  [[nodiscard]] auto begin(std::size_t i) const { return boxes_.begin() + static_cast<std::ptrdiff_t>(i); }

  /// In the middle of what is longest, until a part is small enough.
  void split(std::size_t first, std::size_t end) {
    const auto in_order = [](int d) {
      return [d](const Box& a, const Box& b) {
        return a.min_coord(d) != b.min_coord(d) ? a.min_coord(d) < b.min_coord(d) : a.info() < b.info();
      };
    };
    if (end - first <= most_) {
      borders_.push_back(first);
      std::sort(begin(first), begin(end), [](const Box& a, const Box& b) { return a.info() < b.info(); });
      return;
    }
    CGAL::Bbox_3 all;
    std::for_each(begin(first), begin(end), [&](const Box& box) { all += box.bbox(); });
    int longest = 0;
    for (const int d : {1, 2})
      if (all.max(d) - all.min(d) > all.max(longest) - all.min(longest)) longest = d;
    const std::size_t middle = first + (end - first) / 2;
    std::nth_element(begin(first), begin(middle), begin(end), in_order(longest));
    split(first, middle);
    split(middle, end);
  }

  std::vector<Box>& boxes_;
  std::size_t most_;
  std::vector<std::size_t> borders_;
};

/// The pair of vertex v and triangle t, or of edges i and j; nothing where they have a vertex in common.
std::optional<Candidate> vertex_triangle(const MovingMesh& mesh, std::size_t v, std::size_t t) {
  const auto vertex = static_cast<int>(v);
  const auto& corners = mesh.triangles[t];
  if (std::find(corners.begin(), corners.end(), vertex) != corners.end()) return std::nullopt;
  return Candidate{Kind::vertex_triangle, {vertex, corners[0], corners[1], corners[2]}};
}

std::optional<Candidate> edge_edge(const MovingMesh& mesh, std::size_t i, std::size_t j) {
  const auto& e = mesh.edges[std::min(i, j)];
  const auto& f = mesh.edges[std::max(i, j)];
  if (std::find_first_of(e.begin(), e.end(), f.begin(), f.end()) != e.end()) return std::nullopt;
  return Candidate{Kind::edge_edge, {e[0], e[1], f[0], f[1]}};
}

/// The end of an enumeration that has no other way to be left.
struct Stopped {};

/// Passes pairs on and counts those with a common vertex.
class Passer {
 public:
  Passer(const MovingMesh& mesh, Kind kind, const CandidateSink& sink, const Stop& stop)
      : mesh_(mesh), kind_(kind), sink_(sink), stop_(stop) {}

  void pass(std::size_t i, std::size_t j) {
    constexpr std::uint64_t now_and_then = 1 << 16;
    if (++passed_ % now_and_then == 0 && stop_()) throw Stopped();
    const auto candidate =
        kind_ == Kind::vertex_triangle ? vertex_triangle(mesh_, i, j) : edge_edge(mesh_, i, j);
    if (candidate)
      sink_(*candidate);
    else
      ++sharing_;
  }
  [[nodiscard]] std::uint64_t sharing() const { return sharing_; }

 private:
  const MovingMesh& mesh_;
  Kind kind_;
  const CandidateSink& sink_;
  const Stop& stop_;
  std::uint64_t passed_ = 0;
  std::uint64_t sharing_ = 0;
};

}  // namespace

/// Triangles or edges, in parts, and the vertices.
class CandidateFinder::Boxes {
 public:
  Boxes(const MovingMesh& mesh, Kind kind) : mesh_(mesh), kind_(kind) {
    if (kind == Kind::edge_edge) {
      own_ = swept_boxes(mesh, mesh.edges.size(), [&](std::size_t i) { return mesh.edges[i]; });
    } else {
      own_ = swept_boxes(mesh, mesh.triangles.size(), [&](std::size_t i) { return mesh.triangles[i]; });
      others_ =
          swept_boxes(mesh, mesh.start.size(), [](std::size_t i) { return std::array{static_cast<int>(i)}; });
    }
    borders_ = Parts(own_).borders();
  }

  [[nodiscard]] std::size_t parts() const { return borders_.size() - 1; }

  std::uint64_t find(std::size_t part, const CandidateSink& sink, const Stop& stop) const {
    const auto at = [](const std::vector<Box>& boxes, std::size_t i) {
      return boxes.begin() + static_cast<std::ptrdiff_t>(i);
    };
    std::vector<Box> own(at(own_, borders_[part]), at(own_, borders_[part + 1]));
    CGAL::Bbox_3 all;
    for (const Box& box : own) all += box.bbox();
    std::vector<Box> near;
    const auto is_near = [&](const Box& box) { return CGAL::do_overlap(all, box.bbox()); };
    if (kind_ == Kind::edge_edge)  // of two parts the one in front finds what is between them
      std::copy_if(at(own_, borders_[part + 1]), own_.end(), std::back_inserter(near), is_near);
    else
      std::copy_if(others_.begin(), others_.end(), std::back_inserter(near), is_near);

    // So few boxes are scanned where CGAL's default, 10, sorts them on: twice as fast on meshes of 64,000
    // triangles.
    constexpr std::ptrdiff_t scanned = 200;
    Passer passer(mesh_, kind_, sink, stop);
    const auto pass = [&](const Box& a, const Box& b) { passer.pass(a.info(), b.info()); };
    try {
      if (kind_ == Kind::edge_edge) CGAL::box_self_intersection_d(own.begin(), own.end(), pass, scanned);
      CGAL::box_intersection_d(near.begin(), near.end(), own.begin(), own.end(), pass, scanned);
    } catch (const Stopped&) {
    }
    return passer.sharing();
  }

 private:
  const MovingMesh& mesh_;
  Kind kind_;
  std::vector<Box> own_, others_;
  std::vector<std::size_t> borders_;
};

CandidateFinder::CandidateFinder(const MovingMesh& mesh, Kind kind)
    : boxes_(std::make_unique<const Boxes>(mesh, kind)) {}
CandidateFinder::CandidateFinder(CandidateFinder&&) noexcept = default;
CandidateFinder::~CandidateFinder() = default;

std::size_t CandidateFinder::parts() const { return boxes_->parts(); }

std::uint64_t CandidateFinder::find(std::size_t part, const CandidateSink& sink, const Stop& stop) const {
  return boxes_->find(part, sink, stop);
}

std::uint64_t find_candidates(const MovingMesh& mesh, Kind kind, const CandidateSink& sink,
                              const Stop& stop) {
  const CandidateFinder finder(mesh, kind);
  std::uint64_t sharing = 0;
  for (std::size_t part = 0; part < finder.parts() && !stop(); ++part)
    sharing += finder.find(part, sink, stop);
  return sharing;
}

void find_candidates(const MovingMesh& mesh, const CandidateSink& sink) {
  for (const Kind kind : kinds) find_candidates(mesh, kind, sink, [] { return false; });
}

std::uint64_t find_candidates_by_sweep(const MovingMesh& mesh, Kind kind, const CandidateSink& sink,
                                       const Stop& stop) {
  struct Swept {
    std::array<double, 3> lo, hi;
    std::size_t info;
    bool second;
  };
  std::vector<Swept> all;
  const auto add = [&](std::span<const int> vertices, std::size_t info, bool second) {
    Swept box{.lo = {}, .hi = {}, .info = info, .second = second};
    box.lo.fill(std::numeric_limits<double>::infinity());
    box.hi.fill(-std::numeric_limits<double>::infinity());
    for (const int vertex : vertices)
      for (const auto* points : {&mesh.start, &mesh.end})
        for (std::size_t k = 0; k < 3; ++k) {
          const double c = (*points)[static_cast<std::size_t>(vertex)][static_cast<int>(k)];
          box.lo[k] = std::min(box.lo[k], c);
          box.hi[k] = std::max(box.hi[k], c);
        }
    all.push_back(box);
  };
  const bool one_side = kind == Kind::edge_edge;
  if (one_side)
    for (std::size_t i = 0; i < mesh.edges.size(); ++i) add(mesh.edges[i], i, false);
  else
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) add(mesh.triangles[i], i, true);
  for (int v = 0; !one_side && v < static_cast<int>(mesh.start.size()); ++v)
    add(std::array{v}, static_cast<std::size_t>(v), false);

  std::sort(all.begin(), all.end(), [](const Swept& a, const Swept& b) { return a.lo[0] < b.lo[0]; });
  Passer passer(mesh, kind, sink, stop);
  try {
    for (std::size_t i = 0; i < all.size(); ++i)
      for (std::size_t j = i + 1; j < all.size() && all[j].lo[0] <= all[i].hi[0]; ++j) {
        const Swept& a = all[i];
        const Swept& b = all[j];
        if (!one_side && a.second == b.second) continue;
        if (a.lo[1] > b.hi[1] || b.lo[1] > a.hi[1] || a.lo[2] > b.hi[2] || b.lo[2] > a.hi[2]) continue;
        if (a.second)
          passer.pass(b.info, a.info);
        else
          passer.pass(a.info, b.info);
      }
  } catch (const Stopped&) {
  }
  return passer.sharing();
}

std::size_t pair_rows(const MovingMesh& mesh, Kind kind) {
  return kind == Kind::edge_edge ? mesh.edges.size() : mesh.start.size();
}

std::uint64_t for_pairs_of_row(const MovingMesh& mesh, Kind kind, std::size_t row, const CandidateSink& sink,
                               const Stop& stop) {
  Passer passer(mesh, kind, sink, stop);
  const bool of_edges = kind == Kind::edge_edge;
  const std::size_t end = of_edges ? mesh.edges.size() : mesh.triangles.size();
  try {
    for (std::size_t i = of_edges ? row + 1 : 0; i < end; ++i) passer.pass(row, i);
  } catch (const Stopped&) {
  }
  return passer.sharing();
}

Query make_query(const MovingMesh& mesh, const Candidate& candidate) {
  Query query{.kind = candidate.kind};
  for (int i = 0; i < 4; ++i) {
    const auto v = static_cast<std::size_t>(candidate.vertices[static_cast<std::size_t>(i)]);
    query.set_start(i, mesh.start[v]);
    query.set_end(i, mesh.end[v]);
  }
  return query;
}

}  // namespace nearmiss
