// How the claims of the paper are measured, one function each (claims.cpp says which).
#pragma once

#include "tools/paper/claims.hpp"

namespace nearmiss::tools::paper {

Measured safe(const Results& results, const Stop& stop);
Measured random_cases(const Results& results, const Stop& stop);
Measured candidates(const Results& results, const Stop& stop);
Measured boxes(const Results& results, const Stop& stop);
Measured planes(const Results& results, const Stop& stop);
Measured percent_of_edge(const Results& results, const Stop& stop);
Measured constants(const Results& results, const Stop& stop);
Measured closed_forms(const Results& results, const Stop& stop);
Measured bound(const Results& results, const Stop& stop);
Measured order(const Results& results, const Stop& stop);
Measured half_an_edge(const Results& results, const Stop& stop);
Measured precisions(const Results& results, const Stop& stop);
Measured vertex_edge_culling(const Results& results, const Stop& stop);
Measured animation_time(const Results& results, const Stop& stop);
Measured planeless_time(const Results& results, const Stop& stop);
Measured random_time(const Results& results, const Stop& stop);
Measured exact_time(const Results& results, const Stop& stop);
Measured more_positives(const Results& results, const Stop& stop);
Measured case_numbers(const Results& results, const Stop& stop);
Measured basic_fails(const Results& results, const Stop& stop);
Measured hair(const Results& results, const Stop& stop);
Measured tolerances_do_not_save(const Results& results, const Stop& stop);
Measured fewer_positives(const Results& results, const Stop& stop);
Measured larger_B(const Results& results, const Stop& stop);
Measured next_step(const Results& results, const Stop& stop);
Measured exact_normals(const Results& results, const Stop& stop);
Measured fast_math(const Results& results, const Stop& stop);
Measured gpu(const Results& results, const Stop& stop);
Measured micrometres(const Results& results, const Stop& stop);
Measured peak(const Results& results, const Stop& stop);

}  // namespace nearmiss::tools::paper
