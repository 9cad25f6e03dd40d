#include "oracle/features.hpp"

#include <algorithm>
#include <array>
#include <string_view>

#include "ccd/query/arithmetic.hpp"
#include "oracle/exact/first_approach.hpp"
#include "oracle/exact/first_contact.hpp"
#include "oracle/exact/nearness.hpp"

namespace nearmiss {

namespace {

using Multiplicity = ContactFeatures::Multiplicity;
using Time = ContactFeatures::Time;
using Location = ContactFeatures::Location;

Multiplicity multiplicity(const exact::Polynomial& F, exact::Root& t) {
  if (F.is_zero()) return Multiplicity::planar;
  return t.sign_of(F.derivative()) == 0 ? Multiplicity::multiple : Multiplicity::simple;
}

bool is_degenerate(const Query& query, exact::FirstContact& contact) {
  if (vertices(query.kind) == 4) return contact.meeting.degenerate;
  const auto x = moving_points(query, exact::Unit(query));
  return std::ranges::any_of(topology(query.kind).edges, [&](VertexPair edge) {
    const exact::PolynomialVector e = x[edge.to] - x[edge.from];
    return contact.time.sign_of(dot(e, e)) == 0;
  });
}

Time time_class(const exact::Root& t) { return t.is(0) ? Time::start : t.is(1) ? Time::end : Time::inside; }

}  // namespace

std::optional<ContactFeatures> contact_features(const Query& query) {
  const PlainArithmetic guard;
  exact::Predicates predicates(query);
  auto contact = exact::first_contact(predicates);
  if (!contact) return std::nullopt;
  return ContactFeatures{multiplicity(predicates.F(), contact->time), time_class(contact->time),
                         static_cast<Location>(contact->meeting.vanishing_weights),
                         is_degenerate(query, *contact)};
}

std::optional<ApproachFeatures> approach_features(const Query& query) {
  const PlainArithmetic guard;
  auto approach = exact::first_approach(query);
  if (!approach) return std::nullopt;
  exact::Root& time = approach->time;
  const exact::Nearness nearness(query, query.separation);
  ApproachFeatures features{.time = time_class(time),
                            .closest = ApproachFeatures::Closest::interiors,
                            .touches = !approach->below || time.is_below(*approach->below)};
  for (const exact::FeatureNearness& each : nearness.statements()) {
    const auto closest = static_cast<ApproachFeatures::Closest>(each.features);
    if (closest < features.closest && each.holds_at(time)) features.closest = closest;
  }
  return features;
}

namespace {

std::string_view name(Time time) {
  static constexpr std::array<std::string_view, 3> times{"at-start", "inside", "at-end"};
  return times[static_cast<std::size_t>(time)];
}

}  // namespace

std::string to_text(Kind kind, const ApproachFeatures& features) {
  static constexpr std::array<std::array<std::string_view, 3>, 2> closest{
      {{"vertex-vertex", "vertex-edge", "vertex-face"}, {"end-end", "end-edge", "edge-edge"}}};
  std::string text("approach ");
  text.append(name(features.time)).append(" ");
  text.append(closest[has_triangle(kind) ? 0 : 1][static_cast<std::size_t>(features.closest)]);
  if (features.touches) text += " touching";
  return text;
}

std::string to_text(Kind kind, const ContactFeatures& features) {
  static constexpr std::array<std::string_view, 3> multiplicities{"planar", "simple-root", "multiple-root"};
  static constexpr std::array<std::array<std::string_view, 3>, 2> locations{
      {{"in-face", "on-edge", "on-vertex"}, {"crossing", "end-on-edge", "end-on-end"}}};
  std::string text;
  if (vertices(kind) == 4)
    text.append(multiplicities[static_cast<std::size_t>(features.multiplicity)]).append(" ");
  text.append(name(features.time));
  text.append(" ").append(locations[has_triangle(kind) ? 0 : 1][static_cast<std::size_t>(features.location)]);
  if (features.degenerate) text += " degenerate";
  return text;
}

}  // namespace nearmiss
