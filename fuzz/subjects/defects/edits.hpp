// Selects which edit of edits.txt the copies of ccd/ make. The copies (copies.cmake) are in the build folder,
// in the namespace of this header.
#pragma once

namespace nearmiss::defective {

/// The number of the edit that the copies make on this thread, counted from 1 in the order of edits.txt; 0:
/// none.
inline constinit thread_local int active_edit = 0;

inline bool makes(int edit) { return edit == active_edit; }

}  // namespace nearmiss::defective
