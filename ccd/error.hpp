// The one exception type of the project.
#pragma once

#include <stdexcept>

namespace nearmiss {

/// Something that the user can act on: bad usage or bad input. The message is one line that says where (file and
/// line, if there is one), what was found and what was expected. Only tools/ prints it.
class Error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace nearmiss
