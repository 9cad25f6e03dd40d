# Writes the definition of commit() (tools/commit.hpp) to FILE, if the definition has changed. Runs at each
# build:
#   cmake -D SOURCE=... -D FILE=... -P commit.cmake
function(git result)
  execute_process(COMMAND git -C ${SOURCE} ${ARGN} OUTPUT_VARIABLE output ERROR_QUIET RESULT_VARIABLE code)
  if(NOT code EQUAL 0)
    set(output "")
  endif()
  set(${result} "${output}" PARENT_SCOPE)
endfunction()

git(prefix rev-parse --show-prefix)  # an empty line, unless SOURCE is a folder in another repository
git(commit rev-parse HEAD)
string(STRIP "${commit}" commit)
if(NOT prefix STREQUAL "\n" OR NOT commit)
  set(commit unknown)
else()
  # Only changes of the source code count, because tests, documents and users' files do not change what
  # nearmiss does.
  set(code CMakeLists.txt ccd oracle corpus fuzz reports tools)
  git(changes status --porcelain -- ${code})
  if(changes)
    git(difference diff HEAD --binary -- ${code})
    string(SHA256 digest "${changes}${difference}")
    string(SUBSTRING ${digest} 0 12 digest)
    string(APPEND commit -dirty.${digest})
  endif()
endif()
file(CONFIGURE OUTPUT ${FILE} @ONLY CONTENT [[
#include "tools/commit.hpp"

std::string nearmiss::tools::commit() { return "@commit@"; }
]])
