#include "my_ccd.hpp"

#include "ccd/nearmiss_functions.hpp"

NEARMISS_SUBJECT(detector("mine").vertex_triangle(user::point_triangle_ccd))
