// Calls that must throw an Error.
#pragma once

#include <gmock/gmock.h>

#include <functional>
#include <string>

namespace nearmiss::testing {

/// The message of the Error that a call throws. Without such an Error, the test fails, and the message is
/// empty. Matching the message compiles faster than matching the call, whose type differs from all others.
std::string message_of_error(const std::function<void()>& call);

}  // namespace nearmiss::testing

/// Expects that an expression throws an Error whose message matches.
#define EXPECT_ERROR(expression, message) \
  EXPECT_THAT(::nearmiss::testing::message_of_error([&] { (void)(expression); }), message)

/// Expects that an expression throws an Error whose message contains these words.
#define EXPECT_REFUSED(expression, words) EXPECT_ERROR(expression, ::testing::HasSubstr(words))
