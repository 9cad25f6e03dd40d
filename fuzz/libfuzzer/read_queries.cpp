// libFuzzer target: the reader of query files, *.vt and *.ee.
#include "corpus/readers.hpp"
#include "fuzz/libfuzzer/reader_target.hpp"

void nearmiss::libfuzzer::read(std::istream& in) {
  read_query_lines(in, Kind::edge_edge, "input.ee", expect_round_trip);
}
