// libFuzzer target: the reader of sample queries, *.csv.
#include "corpus/sample_csv.hpp"
#include "fuzz/libfuzzer/reader_target.hpp"

void nearmiss::libfuzzer::read(std::istream& in) {
  read_sample_csv(in, "edge-edge/input.csv", expect_round_trip);
}
