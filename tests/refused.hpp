// Calls that must throw an Error.
#pragma once

#include <gmock/gmock.h>

#include <string>

#include "ccd/query/error.hpp"

namespace nearmiss::testing {

/// Matches a call that throws an Error whose message contains these words.
inline auto is_refused_with(const std::string& words) {
  return ::testing::ThrowsMessage<Error>(::testing::HasSubstr(words));
}

}  // namespace nearmiss::testing

/// Expects that an expression throws an Error whose message contains these words.
#define EXPECT_REFUSED(expression, words) \
  EXPECT_THAT([&] { (void)(expression); }, ::nearmiss::testing::is_refused_with(words))

/// Expects that an expression throws an Error with this message.
#define EXPECT_ERROR(expression, message) \
  EXPECT_THAT([&] { (void)(expression); }, ::testing::ThrowsMessage<::nearmiss::Error>(message))
