// Families of queries near given ones, such as those that a simulation recorded.
#pragma once

#include <span>
#include <vector>

#include "fuzz/families/families.hpp"

namespace nearmiss {

/// Families whose queries are the given ones: unchanged, perturbed, moved by ulps, or with one primitive
/// moved so that the two touch at a random time, as nearly as double allows. Queries for contact are in
/// `near`, those with separations in `near-within`; those of two vertices, or of a vertex and an edge, in
/// v-near and v-near-within. A family without queries is left out.
std::vector<Family> near_families(std::span<const Query> queries);

/// A query that is changed in one of these ways. Perturbations are of `size` times its extent.
Query changed(Random& random, const Query& query, double size);

}  // namespace nearmiss
