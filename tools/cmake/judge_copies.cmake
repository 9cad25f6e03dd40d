# project() includes this file in the copies of the tree that tests/judge/copy.mjs makes. It precompiles the
# libraries' headers, so that they are compiled once and not for every defect. The source files for wider
# instructions have other flags and cannot share precompiled headers.
function(nearmiss_precompile)
  set(numbers <CGAL/Gmpq.h> <CGAL/Mpzf.h> <CGAL/Interval_nt.h> <CGAL/Simple_cartesian.h>
    <CGAL/Exact_predicates_inexact_constructions_kernel.h> <boost/multiprecision/gmp.hpp> <Eigen/Core> <Eigen/Geometry>)
  target_precompile_headers(nearmiss_oracle PRIVATE ${numbers} <algorithm> <functional> <memory> <optional> <sstream> <vector>)
  set(filter ${PROJECT_SOURCE_DIR}/oracle/filter)
  set_source_files_properties(${filter}/batch_sse2.cpp ${filter}/batch_avx2.cpp ${filter}/batch_avx512.cpp DIRECTORY oracle
    PROPERTIES SKIP_PRECOMPILE_HEADERS ON)
  target_precompile_headers(oracle_tests PRIVATE ${numbers} <gtest/gtest.h> <gmock/gmock.h> <random> <vector>)
  set_source_files_properties(${PROJECT_SOURCE_DIR}/tests/oracle/root_test.cpp DIRECTORY tests PROPERTIES SKIP_PRECOMPILE_HEADERS ON)
endfunction()
cmake_language(DEFER CALL nearmiss_precompile)
