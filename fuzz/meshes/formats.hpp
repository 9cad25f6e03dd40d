// Mesh files: OBJ, OFF, PLY and STL.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "fuzz/meshes/mesh.hpp"

namespace nearmiss {

/// If read_mesh knows the ending of the file (.obj, .off, .ply or .stl), returns this ending in lower case.
/// Otherwise, returns an empty string.
std::string mesh_ending(const std::filesystem::path& file);

/// Reads a mesh file; its ending, in upper or lower case, gives the format. Throws Error if the reader of the
/// format throws Error, and also if the file cannot be read, has more than 1 GiB, or has an unknown ending.
///
/// In all formats, a byte order mark before text is skipped, and polygons become fans of triangles. Meshes
/// are not repaired: a CCD must cope with duplicate faces, faces that have a vertex twice, and points in no
/// primitive. A set of points without primitives is a mesh, too.
Mesh read_mesh(const std::filesystem::path& file);

/// Reads the vertices, faces and polylines of an OBJ file, and skips everything else that the format has. A
/// line that ends in a backslash continues in the next line, unless the backslash is in a comment. `text` is
/// the whole file, and messages call the file `name`. Throws Error, with file and line, for a number that is
/// not finite, a primitive with too few vertices or with a vertex that does not exist, and a line that is not
/// in the format. Throws Error for a file without a point.
Mesh parse_obj(std::string_view text, const std::string& name);

/// Reads an OFF text file with a vertex or a face on each line. Comments, normals, colours and textures are
/// skipped. Throws Error as parse_obj does. Also throws Error if the file has fewer or more lines than it
/// announces, if it is binary or a SKEL file, or if its dimension is not 3.
Mesh parse_off(std::string_view text, const std::string& name);

/// Reads a PLY file, which may be text, or binary in either byte order. The element vertex must have the
/// properties x, y and z of type float or double. Each item of the element face must have a list of int or
/// uint, which has the vertices of the face. Other elements and properties are skipped. But a file with items
/// of the elements edge, halfedge or tristrips is refused, because these items are primitives. Throws Error
/// as parse_obj does, and also if the file is shorter or longer than its header says.
Mesh parse_ply(std::string_view text, const std::string& name);

/// Reads an STL file, text or binary; several solids become one mesh. In this format, each triangle has three
/// points of its own. The reader merges equal points into one point (0 and -0 are equal), which has the
/// coordinates of the first of the merged points. So two frames have the same primitives only if the same
/// corners of triangles coincide in both frames. Throws Error as parse_ply does.
Mesh parse_stl(std::string_view text, const std::string& name);

}  // namespace nearmiss
