# Theorem 4.1 of Wang's paper assumes that every operation is rounded to IEEE double. Therefore this file
# switches contraction off, and refuses a compiler that reorders or widens operations. Every header of ccd/
# refuses such a compiler, too.
include(CheckCXXSourceCompiles)

add_compile_options($<$<COMPILE_LANGUAGE:CXX>:-ffp-contract=off>)

set(CMAKE_REQUIRED_FLAGS "${CMAKE_CXX_FLAGS} -ffp-contract=off")
set(CMAKE_REQUIRED_INCLUDES ${PROJECT_SOURCE_DIR})
check_cxx_source_compiles("
  #include \"ccd/query/arithmetic.hpp\"
  int main() {}
" NEARMISS_IEEE_DOUBLE)
unset(CMAKE_REQUIRED_FLAGS)
unset(CMAKE_REQUIRED_INCLUDES)
string(TOUPPER "${CMAKE_BUILD_TYPE}" type)
if("${CMAKE_CXX_FLAGS} ${CMAKE_CXX_FLAGS_${type}}" MATCHES "-(Ofast|f(fast|unsafe|associative|reciprocal|finite)-math)")
  set(NEARMISS_IEEE_DOUBLE OFF)  # headers cannot see all of clang's -ffast-math
endif()
if(NOT NEARMISS_IEEE_DOUBLE)
  message(FATAL_ERROR "nearmiss needs IEEE double evaluation: FLT_EVAL_METHOD 0 and no -ffast-math or part of it. "
    "CMAKE_CXX_FLAGS is '${CMAKE_CXX_FLAGS}'.")
endif()
