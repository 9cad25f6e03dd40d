// Meshes that move from one step to the next.
#pragma once

#include <array>
#include <filesystem>
#include <iosfwd>
#include <string>
#include <vector>

#include "ccd/query.hpp"

namespace nearmiss {

/// Points, and the primitives that join them: triangles of surfaces, and lines of hair; a point may be in none.
/// Indices count from 0 and are in range.
struct Mesh {
  std::vector<Vector3<double>> points;
  std::vector<std::array<int, 3>> triangles;
  std::vector<std::array<int, 2>> lines;
};

/// Reads an OBJ file: vertices, faces and polylines; all else that the format has is passed over. `name`
/// stands for the file in messages. Throws Error with file and line for what is no finite number, a primitive
/// with a vertex that does not exist or with too few, and a line that is not of the format; and for a file
/// without a point.
///
/// Of all formats: polygons become fans of triangles. Nothing else is changed: faces that have a vertex
/// twice, or that are there twice, are for a CCD to cope with, points that are in no primitive too. A point set
/// is a mesh.
Mesh parse_obj(std::istream& in, const std::string& name);

/// Reads an OFF file, as text: OFF with normals, colours or textures too, which are passed over, as are
/// comments. A vertex or a face is a line. Throws Error as parse_obj does, and where the file ends too early
/// or goes on.
Mesh parse_off(std::istream& in, const std::string& name);

/// Reads a PLY file, as text or binary in either order of bytes: the elements vertex, with x, y and z that
/// are float or double (and no more exact than that), and face; others are passed over, but edge, halfedge
/// and tristrips, without which the mesh would be another one, are refused. Throws Error as parse_off does.
Mesh parse_ply(std::istream& in, const std::string& name);

/// Reads an STL file, as text or binary, several solids as one mesh. The format gives each triangle three
/// points of its own; those that are equal (0 and -0 are) become one, the first of them: two frames have the
/// same primitives only if the same corners meet in both. Throws Error as parse_off does.
Mesh parse_stl(std::istream& in, const std::string& name);

/// The ending of a file in lower case if read_mesh knows it (.obj, .off, .ply, .stl), else nothing.
std::string mesh_ending(const std::filesystem::path& file);

/// Reads a file by its ending, in any case. Throws Error as the format's reader does, and where the file
/// cannot be read or has another ending.
Mesh read_mesh(const std::filesystem::path& file);

/// The connected parts of a mesh.
struct Bodies {
  int count = 0;
  std::vector<int> of_point;  ///< of each point the number of its body; by their first points, from 0
};

/// The bodies of a mesh: points that triangles and lines join are of one. A point in no primitive is one of its
/// own.
Bodies bodies(const Mesh& mesh);

/// A mesh whose points move linearly.
struct MovingMesh {
  std::vector<Vector3<double>> start, end;
  std::vector<std::array<int, 3>> triangles;
  std::vector<std::array<int, 2>>
      edges;  ///< of triangles and lines, each once, the smaller index first, ascending
};

/// A moving mesh from its parts; `mesh` gives the start.
MovingMesh make_moving_mesh(Mesh mesh, std::vector<Vector3<double>> end);

/// Throws Error where the two do not have the same number of points and the same primitives; the names stand for
/// them in the message.
void expect_same_primitives(const Mesh& first, const std::string& first_name, const Mesh& other,
                            const std::string& other_name);

}  // namespace nearmiss
