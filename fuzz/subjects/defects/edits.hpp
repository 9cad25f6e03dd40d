// Selects which edit of edits.txt the copies of ccd/ make. The copies (copies.cmake) are in the build folder,
// in the namespace of this header.
#pragma once

namespace nearmiss::defective {

/// The number of the edit that code on this thread makes, counted from 1 in the order of the list; 0: none.
inline constinit thread_local int active_edit = 0;

/// Whether code on this thread makes this edit.
inline bool makes(int edit) { return edit == active_edit; }

}  // namespace nearmiss::defective
