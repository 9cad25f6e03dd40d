// libFuzzer: whatever a file holds, a reader takes it or throws Error, and what it took it can write and read
// again.
#include <cstdint>
#include <cstdlib>
#include <sstream>
#include <string>

#include "ccd/error.hpp"
#include "corpus/readers.hpp"
#include "corpus/sample_csv.hpp"

namespace {

using namespace nearmiss;

void check(const Case& each) {
  std::istringstream again(to_text(each));
  if (!(parse_case(again, "again").query == each.query)) std::abort();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return -1;
  std::istringstream in(std::string(reinterpret_cast<const char*>(data + 1), size - 1));
  try {
    switch (data[0] % 3) {
      case 0:
        check(parse_case(in, "input"));
        break;
      case 1:
        read_query_lines(in, Kind::edge_edge, "input", check);
        break;
      default:
        read_sample_csv(in, "edge-edge/input.csv", check);
    }
  } catch (const Error&) {
    return 0;
  }
  return 0;
}
