// The family `mesh`: queries like those of a simulation.
#pragma once

#include "fuzz/families/families.hpp"
#include "fuzz/meshes/mesh.hpp"
#include "fuzz/scenes/scene.hpp"
#include "fuzz/stop.hpp"

namespace nearmiss {

/// The family made from a moving mesh. Its queries are pairs whose swept boxes meet: unchanged, perturbed,
/// moved by ulps, or with one primitive moved so that the two touch at a random time, as nearly as double
/// allows. At most `most` pairs of each kind are kept; the choice only depends on the mesh. Throws Error if
/// there is no pair of a kind, and Stopped if the stop is due before all pairs are known.
Family mesh_family(const MovingMesh& mesh, const Stop& stop = Stop::never(), std::size_t most = 1 << 15);
/// The same for all steps of a scene.
Family mesh_family(const Scene& scene, const Stop& stop = Stop::never(), std::size_t most = 1 << 15);

}  // namespace nearmiss
