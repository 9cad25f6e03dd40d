# Settings of all our targets, such as warnings as errors, sanitizers, clang-tidy and ccache.
find_program(CCACHE ccache)
if(CCACHE)
  set(CMAKE_C_COMPILER_LAUNCHER ${CCACHE})
  # ccache caches a file that uses a precompiled header only if ccache may ignore changed #defines, and the
  # macros __DATE__ and __TIME__. With CCACHE_DEPEND, ccache does not preprocess a file before compiling the
  # file.
  set(CMAKE_CXX_COMPILER_LAUNCHER ${CMAKE_COMMAND} -E env CCACHE_SLOPPINESS=pch_defines,time_macros CCACHE_DEPEND=1
    ${CCACHE})
endif()

if(NEARMISS_CLANG_TIDY)
  find_program(CLANG_TIDY clang-tidy REQUIRED)
  set(CMAKE_CXX_CLANG_TIDY ${CLANG_TIDY} --quiet)
endif()

if(NEARMISS_SANITIZE)
  add_compile_options(-fsanitize=address,undefined -fno-sanitize-recover=all -fno-omit-frame-pointer)
  add_link_options(-fsanitize=address,undefined)
  add_compile_definitions(_GLIBCXX_ASSERTIONS)
endif()

if(NEARMISS_LIBFUZZER)
  add_compile_options(-fsanitize=fuzzer-no-link)  # coverage of all our code
  add_link_options(-fsanitize=undefined)  # provides the runtime of coverage to executables without libFuzzer
endif()

# The compiler options for the vector instructions of x86-64. Other processors' vector instructions need no
# options.
if(CMAKE_SYSTEM_PROCESSOR MATCHES "^(x86_64|AMD64)$")
  set(nearmiss_avx2 -mavx2)
  set(nearmiss_avx512 -mavx512f -mavx512dq -mavx512vl)
  set(nearmiss_bmi2 -mbmi2)
endif()

# Our code joins bools by | to save a branch, although clang advises against it.
set(nearmiss_joined_bools $<$<CXX_COMPILER_ID:Clang>:-Wno-bitwise-instead-of-logical>)

# Warnings are errors only for developers. A user who just builds nearmiss may have a compiler that gives more
# warnings.
if("tests" IN_LIST NEARMISS_COMPONENTS)
  set(nearmiss_werror -Werror)
endif()

# In a unity build, which compiles several files as one, a name in one file may hide an internal name of
# another file.
set(nearmiss_shadow -Wshadow)
if(CMAKE_UNITY_BUILD AND CMAKE_CXX_COMPILER_ID STREQUAL GNU)
  set(nearmiss_shadow -Wshadow=local)
endif()

# nearmiss_options(TARGET): turns on warnings, and makes includes relative to the top folder:
# "folder/file.hpp".
function(nearmiss_options target)
  target_compile_options(${target} PRIVATE -Wall -Wextra -Wpedantic ${nearmiss_shadow} -Wconversion ${nearmiss_werror} ${nearmiss_joined_bools})
  target_include_directories(${target} PUBLIC $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}>)
endfunction()

# The only header of nearmiss that several targets precompile.
set(nearmiss_statistics_header ${PROJECT_SOURCE_DIR}/reports/statistics/statistics.hpp)

# nearmiss_precompile(TARGET HEADER...): precompiles the headers that most files of a target include; most of
# these headers belong to other libraries. The preset debug precompiles no headers, so its build fails if a
# file does not include what it uses.
# nearmiss_precompile(TARGET REUSE_FROM OTHER): uses the precompiled headers of a target with the same options.
function(nearmiss_precompile target)
  if("${ARGV1}" STREQUAL REUSE_FROM)
    target_precompile_headers(${target} ${ARGN})
  else()
    target_precompile_headers(${target} PRIVATE <algorithm> <functional> <map> <optional> <string> <vector> <Eigen/Core> <Eigen/Geometry>
      ${ARGN})
  endif()
  if(CMAKE_CXX_COMPILER_ID STREQUAL GNU AND NOT CMAKE_DISABLE_PRECOMPILE_HEADERS)
    # g++ 12 gives false warnings about the code of std::string if the header <string> is precompiled (bug
    # 105651).
    target_compile_options(${target} PRIVATE -Wno-array-bounds -Wno-restrict -Wno-stringop-overflow)
    # The precompiled headers already fill the default heap of g++. Without this option, g++ would spend a
    # sixth of its time on garbage collection.
    target_compile_options(${target} PRIVATE --param=ggc-min-heapsize=400000)
  endif()
endfunction()

# nearmiss_seldom_runs(TARGET): compiles code that seldom runs with less optimization. Full optimization would
# double the compile time of such code, and save no run time.
function(nearmiss_seldom_runs target)
  target_compile_options(${target} PRIVATE $<$<CONFIG:Release>:-O1>)
endfunction()

# nearmiss_library(FOLDER LIB...): makes a library of the .cpp files directly in a folder. The folder's
# CMakeLists.txt adds the .cpp files of its subfolders.
function(nearmiss_library folder)
  get_filename_component(name ${folder} NAME)
  file(GLOB sources CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/${folder}/*.cpp)
  add_library(nearmiss_${name} STATIC ${sources})
  set_target_properties(nearmiss_${name} PROPERTIES CXX_VISIBILITY_PRESET hidden VISIBILITY_INLINES_HIDDEN ON)
  nearmiss_options(nearmiss_${name})
  target_link_libraries(nearmiss_${name} PUBLIC ${ARGN})
endfunction()

# nearmiss_tests(FOLDER LIB...): makes a GoogleTest executable of tests/FOLDER/*.cpp, and adds each of its
# tests to CTest.
function(nearmiss_tests folder)
  file(GLOB sources CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/tests/${folder}/*.cpp)
  add_executable(${folder}_tests ${sources})
  nearmiss_options(${folder}_tests)
  target_link_libraries(${folder}_tests PRIVATE ${ARGN} nearmiss_testing GTest::gmock GTest::gtest_main)
  gtest_discover_tests(${folder}_tests TEST_PREFIX ${folder}. NO_PRETTY_VALUES PROPERTIES TIMEOUT 600 DISCOVERY_TIMEOUT 60)
endfunction()

# nearmiss_uses_cgal(TARGET): sets up a target that includes CGAL's number types.
function(nearmiss_uses_cgal target)
  target_link_libraries(${target} PRIVATE CGAL::CGAL)
  # The compiler must know that interval arithmetic changes the rounding mode.
  target_compile_options(${target} PRIVATE -frounding-math)
  if(CMAKE_CXX_COMPILER_ID STREQUAL GNU AND NOT NEARMISS_CLANG_TIDY)  # clang-tidy does not know the options
    # g++ 12 gives two false warnings. It warns of a use after free in CGAL's inlined reference-counted
    # handles. It also warns of a mismatched delete in CGAL's Mpzf, although Mpzf first resets its pointer to
    # the address that new[] returned.
    target_compile_options(${target} PRIVATE -Wno-use-after-free -Wno-mismatched-new-delete)
  endif()
endfunction()
