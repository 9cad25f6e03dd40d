// Checks that calls throw an Error.
#pragma once

#include <gmock/gmock.h>

#include <functional>
#include <string>

namespace nearmiss::testing {

/// The message of the Error that a call throws. If there is no Error, the test fails, and the message is
/// empty.
std::string message_of_error(const std::function<void()>& call);

}  // namespace nearmiss::testing

/// Expects that an expression throws an Error whose message satisfies the matcher `message`.
#define EXPECT_ERROR(expression, message) \
  EXPECT_THAT(::nearmiss::testing::message_of_error([&] { (void)(expression); }), message)

/// Expects that an expression throws an Error whose message contains `words`.
#define EXPECT_REFUSED(expression, words) EXPECT_ERROR(expression, ::testing::HasSubstr(words))
