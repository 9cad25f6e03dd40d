// The one exception type of the project.
#pragma once

#include <stdexcept>

namespace nearmiss {

/// An error that the user can correct: bad usage or bad input. The message is one line that says where the
/// error is (file and line, if any), what was found and what was expected. Only code in tools/ prints the
/// message.
class Error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace nearmiss
