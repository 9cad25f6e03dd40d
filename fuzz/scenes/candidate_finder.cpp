// Finds candidates by CGAL's box intersection.
#include <CGAL/Bbox_3.h>
#include <CGAL/box_intersection_d.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "fuzz/scenes/candidate_passer.hpp"
#include "oracle/filter/box.hpp"

namespace nearmiss {

namespace {

using Box = CGAL::Box_intersection_d::Box_with_info_d<double, 3, std::size_t>;

/// The bounds, moved outward by at least half of a separation on each side.
CGAL::Bbox_3 grown(const CGAL::Bbox_3& bounds, double separation) {
  if (separation == 0) return bounds;
  const auto above = [](double x) { return std::nextafter(x, std::numeric_limits<double>::infinity()); };
  const double half = above(separation / 2);
  const auto low = [&](int k) { return -above(half - bounds.min(k)); };
  const auto high = [&](int k) { return above(bounds.max(k) + half); };
  return {low(0), low(1), low(2), high(0), high(1), high(2)};
}

/// The swept boxes of primitives; `info` of a box is the number of its primitive. They are so large that the boxes of two
/// primitives overlap if these are not farther apart than the separation along any axis.
template <class VerticesOf>
std::vector<Box> swept_boxes(const MovingMesh& mesh, std::size_t count, const VerticesOf& vertices_of) {
  std::vector<Box> boxes;
  boxes.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    CGAL::Bbox_3 bounds;
    for (const int vertex : vertices_of(i)) {
      const auto v = static_cast<std::size_t>(vertex);
      for (const auto& p : {mesh.start[v], mesh.end[v]})
        bounds += CGAL::Bbox_3(p.x(), p.y(), p.z(), p.x(), p.y(), p.z());
    }
    boxes.emplace_back(grown(bounds, mesh.separation), i);
  }
  return boxes;
}

/// Orders boxes so that the boxes of a part are near each other. Part i goes from borders[i] to borders[i +
/// 1].
class BoxPartition {
 public:
  explicit BoxPartition(std::vector<Box>& boxes)
      : boxes_(boxes), most_(std::clamp(boxes.size() / 64, smallest, largest)) {
    split(0, boxes.size());
    borders_.push_back(boxes.size());
  }
  std::vector<std::size_t> borders() && { return std::move(borders_); }

 private:
  // Searching a part goes through all boxes once, so a large mesh must not have many parts.
  static constexpr std::size_t smallest = 256;
  static constexpr std::size_t largest = 16384;

  [[nodiscard]] auto begin(std::size_t i) const { return boxes_.begin() + static_cast<std::ptrdiff_t>(i); }

  /// Halves a range of boxes along the longest axis of their extent, until it is small enough for a part.
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

}  // namespace

/// The boxes of triangles or edges, divided into parts, and the boxes of the vertices.
class CandidateFinder::Boxes {
 public:
  Boxes(const MovingMesh& mesh, Kind kind) : mesh_(mesh), kind_(kind) {
    if (kind == Kind::edge_edge) {
      divided_ = swept_boxes(mesh, mesh.edges.size(), [&](std::size_t i) { return mesh.edges[i]; });
    } else {
      divided_ = swept_boxes(mesh, mesh.triangles.size(), [&](std::size_t i) { return mesh.triangles[i]; });
      vertices_ =
          swept_boxes(mesh, mesh.start.size(), [](std::size_t i) { return std::array{static_cast<int>(i)}; });
    }
    borders_ = BoxPartition(divided_).borders();
  }

  [[nodiscard]] std::size_t parts() const { return borders_.size() - 1; }

  std::uint64_t find(std::size_t part, const CandidateSink& sink, const IsOver& is_over) const {
    const auto at = [](const std::vector<Box>& boxes, std::size_t i) {
      return boxes.begin() + static_cast<std::ptrdiff_t>(i);
    };
    std::vector<Box> part_boxes(at(divided_, borders_[part]), at(divided_, borders_[part + 1]));
    CGAL::Bbox_3 all;
    for (const Box& box : part_boxes) all += box.bbox();
    std::vector<Box> near;
    const auto is_near = [&](const Box& box) { return CGAL::do_overlap(all, box.bbox()); };
    if (kind_ == Kind::edge_edge)  // the earlier of two parts finds the pairs between them
      std::copy_if(at(divided_, borders_[part + 1]), divided_.end(), std::back_inserter(near), is_near);
    else
      std::copy_if(vertices_.begin(), vertices_.end(), std::back_inserter(near), is_near);

    // Up to this number of boxes, all pairs are compared. CGAL's default, 10, takes twice as long on meshes
    // of 64,000 triangles.
    constexpr std::ptrdiff_t scanned = 200;
    const CandidateSink sink_near = [&](const Candidate& candidate) {
      if (boxes_meet(make_query(mesh_, candidate))) sink(candidate);
    };
    CandidatePasser passer(mesh_, kind_, mesh_.separation > 0 ? sink_near : sink, is_over);
    const auto pass = [&](const Box& a, const Box& b) { passer.pass(a.info(), b.info()); };
    try {
      if (kind_ == Kind::edge_edge)
        CGAL::box_self_intersection_d(part_boxes.begin(), part_boxes.end(), pass, scanned);
      CGAL::box_intersection_d(near.begin(), near.end(), part_boxes.begin(), part_boxes.end(), pass, scanned);
    } catch (const Stopped&) {
    }
    return passer.sharing();
  }

 private:
  const MovingMesh& mesh_;
  Kind kind_;
  std::vector<Box> divided_, vertices_;
  std::vector<std::size_t> borders_;
};

CandidateFinder::CandidateFinder(const MovingMesh& mesh, Kind kind)
    : boxes_(std::make_unique<const Boxes>(mesh, kind)) {}
CandidateFinder::CandidateFinder(CandidateFinder&&) noexcept = default;
CandidateFinder::~CandidateFinder() = default;

std::size_t CandidateFinder::parts() const { return boxes_->parts(); }

std::uint64_t CandidateFinder::find(std::size_t part, const CandidateSink& sink,
                                    const IsOver& is_over) const {
  return boxes_->find(part, sink, is_over);
}

std::uint64_t find_candidates(const MovingMesh& mesh, Kind kind, const CandidateSink& sink,
                              const IsOver& is_over) {
  const CandidateFinder finder(mesh, kind);
  std::uint64_t sharing = 0;
  for (std::size_t part = 0; part < finder.parts() && !is_over(); ++part)
    sharing += finder.find(part, sink, is_over);
  return sharing;
}

void find_candidates(const MovingMesh& mesh, const CandidateSink& sink) {
  for (const Kind kind : kinds) find_candidates(mesh, kind, sink, [] { return false; });
}

}  // namespace nearmiss
