#include "ccd/nearmiss_functions.hpp"

namespace {

using nearmiss::plugin::Answer;
using nearmiss::plugin::Question;

Answer always(const Question& /*q*/) { return Answer::of(true); }

}  // namespace

NEARMISS_SUBJECT(detector("always").vertex_triangle(always).edge_edge(always))
