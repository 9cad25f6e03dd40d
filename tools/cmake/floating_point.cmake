# Theorem 4.1 of the paper assumes that every operation is rounded on its own to IEEE double.
# A compiler that contracts, reorders or widens is refused here, not found out by a campaign.
include(CheckCXXSourceCompiles)

add_compile_options($<$<COMPILE_LANGUAGE:CXX>:-ffp-contract=off>)

set(CMAKE_REQUIRED_FLAGS "${CMAKE_CXX_FLAGS} -ffp-contract=off")
check_cxx_source_compiles("
  #include <cfloat>
  #include <limits>
  static_assert(FLT_EVAL_METHOD == 0);
  static_assert(std::numeric_limits<double>::is_iec559 && std::numeric_limits<double>::digits == 53);
  static_assert(std::numeric_limits<float>::is_iec559 && std::numeric_limits<float>::digits == 24);
  #ifdef __FAST_MATH__
  #error fast-math
  #endif
  int main() {}
" NEARMISS_IEEE_DOUBLE)
unset(CMAKE_REQUIRED_FLAGS)
if(NOT NEARMISS_IEEE_DOUBLE)
  message(FATAL_ERROR "nearmiss needs IEEE double evaluation: FLT_EVAL_METHOD 0 and no -ffast-math. "
    "CMAKE_CXX_FLAGS is '${CMAKE_CXX_FLAGS}'.")
endif()
