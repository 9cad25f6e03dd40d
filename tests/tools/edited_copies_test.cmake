# Checks what tools/cmake/edited_copies.cmake makes of a small header, and that it refuses wrong edits.
#   cmake -DFOLDER=an empty folder -P edited_copies_test.cmake
cmake_minimum_required(VERSION 3.25)

set(header [[
#pragma once
namespace nearmiss {
inline int next(int a) {
  if (a < 2) return a + 1;
  return a +
         1;
}
}  // namespace nearmiss
]])
set(list [[
== group ==

# a comment
outer in next.hpp (2 of 2): the later return is wrong
- return a + 1;
+ return a;
and in next.hpp
- a < 2
+ a <= 2

inner in next.hpp (2 of 2): so is what it returns
- a + 1
+ a - 1
]])

if(NOT DEFINED EDITS)  # makes the copies for each list in a process of its own
  set(PROJECT_BINARY_DIR ${FOLDER}/build)
  function(make_copies about edits)
    file(WRITE ${FOLDER}/edits.txt "${edits}")
    execute_process(COMMAND ${CMAKE_COMMAND} -DFOLDER=${FOLDER} -DEDITS=${FOLDER}/edits.txt -P ${CMAKE_SCRIPT_MODE_FILE}
      ERROR_VARIABLE errors)
    string(REGEX REPLACE "[ \n]+" " " errors "${errors}")
    string(FIND "${errors}" "${about}" place)
    if(place EQUAL -1)
      message(SEND_ERROR "found '${errors}', expected '${about}'")
    endif()
  endfunction()

  file(WRITE ${FOLDER}/ccd/next.hpp "${header}")
  make_copies("" "${list}")
  file(READ ${FOLDER}/build/other/ccd/next.hpp made)
  string(REPLACE "return a +\n         1;" "if (makes(1)) { return a; } else { return (makes(2) ? (a - 1) : (a +\n         1)); }" expected "${header}")
  string(REPLACE "a < 2" "(makes(1) ? (a <= 2) : (a < 2))" expected "${expected}")
  string(REPLACE "nearmiss {" "nearmiss::other {" expected "${expected}")
  string(REPLACE "#pragma once" "#pragma once\n#pragma GCC system_header\n#include \"switch.hpp\"" expected "${expected}")
  if(NOT made STREQUAL expected)
    message(SEND_ERROR "found\n${made}\nexpected\n${expected}")
  endif()
  file(READ ${FOLDER}/build/other/edits.inc rows)
  if(NOT rows STREQUAL [[
{"outer", "the later return is wrong", "group"},
{"inner", "so is what it returns", "group"},
]])
    message(SEND_ERROR "found the table\n${rows}")
  endif()

  string(REPLACE "- a < 2" "- a < 3" wrong "${list}")
  make_copies("edits.txt: outer: found 'a < 3' 0 times in next.hpp, expected 1" "${wrong}")
  string(REPLACE "inner in next.hpp (2 of 2)" "inner in next.hpp" wrong "${list}")
  make_copies("edits.txt: inner: found 'a + 1' 2 times in next.hpp, expected 1" "${wrong}")
  string(REPLACE "inner in next.hpp" "inner in last.hpp" wrong "${list}")
  make_copies("edits.txt: inner: found the file last.hpp, expected one of next.hpp" "${wrong}")
  string(REPLACE "+ a <= 2" "a <= 2" wrong "${list}")
  make_copies("edits.txt: found 'a <= 2', expected" "${wrong}")
  return()
endif()

function(set_property)  # a script has no directory whose properties could be set
endfunction()
set(PROJECT_BINARY_DIR ${FOLDER}/build)
set(nearmiss_unedited ${FOLDER})
include(${CMAKE_CURRENT_LIST_DIR}/../../tools/cmake/edited_copies.cmake)
nearmiss_edited_copies(${EDITS} other switch.hpp ccd/next.hpp)
