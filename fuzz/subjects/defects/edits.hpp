// Selects the edit of edits.txt that the copies of ccd/ make. The copies are in the build folder
// (copies.cmake), and in this namespace.
#pragma once

namespace nearmiss::defective {

/// The number of the edit that calls from this thread make, from 1 in the order of the list; 0: none.
inline constinit thread_local int active_edit = 0;

/// Whether calls from this thread make an edit.
inline bool makes(int edit) { return edit == active_edit; }

}  // namespace nearmiss::defective
