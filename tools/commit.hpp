// The source code from which nearmiss was built.
#pragma once

#include <string>

namespace nearmiss::tools {

/// The commit that was checked out when nearmiss was built, as 40 hexadecimal digits. If the source code
/// differed from the commit, "-dirty." and the beginning of a digest of the changes follow. The digest covers
/// the names of new files, but not their content. Returns "unknown" if the source code was not in a Git
/// repository of its own.
std::string commit();

}  // namespace nearmiss::tools
