// Files of meshes: OBJ, OFF, PLY and STL.
#pragma once

#include <filesystem>
#include <iosfwd>
#include <string>

#include "fuzz/meshes/mesh.hpp"

namespace nearmiss {

/// The ending of a file in lower case if read_mesh knows it (.obj, .off, .ply, .stl), else nothing.
std::string mesh_ending(const std::filesystem::path& file);

/// Reads a file by its ending, in upper or lower case. Throws Error as the format's reader does, and if the file
/// cannot be read or has another ending.
///
/// In all formats polygons become fans of triangles, and nothing else is changed: duplicate faces, faces that have
/// a vertex twice, and points in no primitive are for a CCD to cope with. A set of points is a mesh.
Mesh read_mesh(const std::filesystem::path& file);

/// Reads an OBJ file: vertices, faces and polylines; everything else that the format has is skipped. `name`
/// stands for the file in messages. Throws Error with file and line for a number that is not finite, a primitive
/// with too few vertices or with one that does not exist, and a line that is not of the format; and for a file
/// without a point.
Mesh parse_obj(std::istream& in, const std::string& name);

/// Reads an OFF file of text, with a vertex or a face on each line. Comments are skipped, and so are normals,
/// colours and textures. Throws Error as parse_obj does, if the file ends too early or goes on too long, and for
/// the binary form, SKEL, and dimensions other than 3.
Mesh parse_off(std::istream& in, const std::string& name);

/// Reads a PLY file, text or binary in either byte order: the element vertex with x, y and z of type float or
/// double, and the element face with lists of int or uint. Other elements and properties are skipped; but edge,
/// halfedge and tristrips, which hold primitives too, are refused. Throws Error as parse_off does.
Mesh parse_ply(std::istream& in, const std::string& name);

/// Reads an STL file, text or binary; several solids become one mesh. The format gives each triangle three points
/// of its own. Equal points (0 and -0 are equal) become one, the first of them, since two frames have the same
/// primitives only if the same corners coincide in both. Throws Error as parse_off does.
Mesh parse_stl(std::istream& in, const std::string& name);

}  // namespace nearmiss
