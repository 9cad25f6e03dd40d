// What CGAL's readers are given. They trust a file: they allocate what a header promises, read beyond the
// words of a line (COFF), take properties of a wrong type for null pointers (PLY), a missing coordinate for
// 0, 0.5 for vertex 0 and 3,5 for 3; what was not well as text they read as binary, on top of what they have
// (STL). So a file is checked before, and written anew in the plainest form that says the same.
#pragma once

#include <string>
#include <string_view>

namespace nearmiss {

/// OFF as text, a vertex or a face on each line, without comments, normals, colours and textures. Throws
/// Error with the line for what is no OFF, what is no finite number, a face of fewer than three vertices or
/// of one that does not exist, a file that ends too early or goes on too long, and what CGAL cannot read: the
/// binary form, SKEL, and other dimensions than 3.
std::string plain_off(std::string_view text, std::string_view name);

/// PLY in which vertex and face are the only elements with a name, and x, y, z and vertex_indices the only
/// properties; with as many numbers, all in their type's range, as it says, each list of a length that is
/// there. Throws Error, with the line in header and text, for all else, and for what CGAL cannot read:
/// coordinates that are neither float nor double, indices that are neither int nor uint, and the elements
/// edge, halfedge and tristrips.
std::string plain_ply(std::string_view text, std::string_view name);

/// STL of finite coordinates: one solid if it is text; else without the words of the header. Throws Error, of
/// a text with the line.
std::string plain_stl(std::string_view text, std::string_view name);

}  // namespace nearmiss
