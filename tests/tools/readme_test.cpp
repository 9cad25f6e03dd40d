// The first example of README.md prints what README.md says.
#include <algorithm>
#include <fstream>
#include <string>

#include "tests/tools/command_line.hpp"

namespace nearmiss {
namespace {

/// A command in README.md, after "$ nearmiss ", and the lines that follow it up to an empty one.
struct Example {
  std::string arguments, output;
};

Example first_example() {
  const std::string indent(4, ' ');
  const std::string prompt = indent + "$ nearmiss ";
  std::ifstream readme(NEARMISS_README);
  Example example;
  for (std::string line; std::getline(readme, line);) {
    if (example.arguments.empty()) {
      if (line.starts_with(prompt)) example.arguments = line.substr(prompt.size());
    } else if (line.starts_with(indent)) {
      example.output += line.substr(indent.size()) + '\n';
    } else {
      break;
    }
  }
  return example;
}

class ReadmeTest : public testing::CommandLine {};

TEST_F(ReadmeTest, TheFirstExamplePrintsWhatItSays) {
  const Example example = first_example();
  ASSERT_THAT(example.arguments, ::testing::StartsWith("fuzz "));
  ASSERT_EQ(std::count(example.output.begin(), example.output.end(), '\n'), 2) << example.output;
  const Output output = run(example.arguments);
  EXPECT_EQ(output.out.substr(0, example.output.size()), example.output) << "nearmiss " << example.arguments;
}

}  // namespace
}  // namespace nearmiss
