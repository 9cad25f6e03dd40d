#include "tests/refused.hpp"

#include <exception>

#include "ccd/query/error.hpp"

namespace nearmiss::testing {

std::string message_of_error(const std::function<void()>& call) {
  try {
    call();
    ADD_FAILURE() << "found no error, expected an Error";
  } catch (const Error& error) {
    return error.what();
  } catch (const std::exception& other) {
    ADD_FAILURE() << "found '" << other.what() << "', expected an Error";
  }
  return "";
}

}  // namespace nearmiss::testing
