// libFuzzer target: the reader of *.case files.
#include "corpus/case.hpp"

#include "fuzz/libfuzzer/reader_target.hpp"

void nearmiss::libfuzzer::read(std::istream& in) { expect_round_trip(parse_case(in, "input.case")); }
