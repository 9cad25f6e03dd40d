#include "oracle/explanation.hpp"

#include <array>
#include <string_view>

#include "ccd/query/arithmetic.hpp"
#include "oracle/exact/first_approach.hpp"
#include "oracle/exact/first_contact.hpp"
#include "oracle/parity/parity.hpp"

namespace nearmiss {

namespace {

using Contact = Explanation::Contact;

Contact contact_of(exact::Root& t) {
  exact::Root early{exact::Number(0x1p-40)};
  if (t.is(0)) return Contact::start;
  if (t.is(1)) return Contact::end;
  return early.is_below(t) ? Contact::inside : Contact::early;
}

}  // namespace

Explanation explain(const Query& query) {
  const PlainArithmetic guard;
  exact::Predicates predicates(query);
  Explanation result;
  if (vertices(query.kind) == 4)
    result.roots =
        predicates.F().is_zero() ? -1 : static_cast<int>(exact::roots_in_step(predicates.F()).size());
  if (query.separation > 0) {
    result.is_approach = true;
    if (auto approach = exact::first_approach(query)) result.contact = contact_of(approach->time);
  } else if (auto first = exact::first_contact(predicates)) {
    result.contact = contact_of(first->time);
    result.unseen_by_parity = vertices(query.kind) == 4 && !root_parity(query).collision();
  }
  return result;
}

std::string to_text(const Explanation& explanation) {
  static constexpr std::array<std::string_view, 5> times{"never", "at t = 0", "within 2^-40 after t = 0",
                                                         "inside the step", "at t = 1"};
  std::string text(explanation.is_approach                ? "within the separation "
                   : explanation.contact == Contact::none ? "no contact"
                                                          : "contact ");
  if (explanation.is_approach || explanation.contact != Contact::none)
    text += times[static_cast<std::size_t>(explanation.contact)];
  if (!explanation.roots) return text;
  text += "; the vertices are ";
  switch (*explanation.roots) {
    case -1:
      text += "always coplanar";
      break;
    case 0:
      text += "never coplanar";
      break;
    case 1:
      text += "coplanar once";
      break;
    default:
      text.append("coplanar ").append(std::to_string(*explanation.roots)).append(" times");
  }
  if (explanation.unseen_by_parity)
    text += "; root parity counts an even number of roots and cannot see the contact";
  return text;
}

}  // namespace nearmiss
