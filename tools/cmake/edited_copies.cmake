# Makes copies of headers. The copies have named edits, such as planted defects, that a program can switch on
# and off while it runs.
#
# A list of edits has this form:
#
#   == GROUP ==
#
#   NAME in FILE: what the edit makes wrong
#   - the text of an expression or a statement, which must be in FILE once; its blanks and line ends match
#     any blanks and line ends
#   + the text that replaces it
#   and in FILE (2 of 3)
#   - the text at another place of the same edit: the second of three places in FILE with this text
#   + the text that replaces it
#
# For edit 17, the copy has one of these two texts in place of TEXT:
#
#   (makes(17) ? (EDITED) : (TEXT))             if TEXT is an expression
#   if (makes(17)) { EDITED } else { TEXT }     if TEXT is a statement, which ends with ; or }
#
# Edits are numbered from 1. The text of one edit may contain the whole text of another edit. Texts of edits
# must not overlap in any other way.

if(NOT nearmiss_unedited)
  set(nearmiss_unedited ${PROJECT_SOURCE_DIR})  # the tree whose headers are copied
endif()

# Reads a list of edits. Sets `rows` to a table with {NAME, ABOUT, GROUP} of each edit, and `places` to the
# number of places. A place is a text that an edit replaces. For each place N, sets place_N_edit to the number
# of its edit, and place_N_name, _file, _nth, _of, _before and _after to what the list says about the place.
macro(nearmiss_read_edits list)
  file(READ ${list} unread)
  set(rows "")
  set(edits 0)
  set(places 0)
  while(unread MATCHES "^([^\n]*)\n(.*)$")
    set(line "${CMAKE_MATCH_1}")
    set(unread "${CMAKE_MATCH_2}")
    if(line MATCHES "^- ?(.*)$")
      string(APPEND place_${places}_before " ${CMAKE_MATCH_1}")
      string(STRIP "${place_${places}_before}" place_${places}_before)
    elseif(line MATCHES "^\\+ ?(.*)$")
      string(APPEND place_${places}_after " ${CMAKE_MATCH_1}")
      string(STRIP "${place_${places}_after}" place_${places}_after)
    elseif(line MATCHES "^== (.+) ==$")
      set(group "${CMAKE_MATCH_1}")
    elseif(line MATCHES "^([^# ]+) in ([^ :]+)( \\(([0-9]+) of ([0-9]+)\\))?(: (.+))?$")
      if(NOT CMAKE_MATCH_1 STREQUAL "and")
        math(EXPR edits "${edits} + 1")
        set(name "${CMAKE_MATCH_1}")
        string(APPEND rows "{\"${name}\", \"${CMAKE_MATCH_7}\", \"${group}\"},\n")
      endif()
      math(EXPR places "${places} + 1")
      set(place_${places}_edit ${edits})
      set(place_${places}_name "${name}")
      set(place_${places}_file ${CMAKE_MATCH_2})
      set(place_${places}_nth 1)
      set(place_${places}_of 1)
      if(CMAKE_MATCH_4)
        set(place_${places}_nth ${CMAKE_MATCH_4})
        set(place_${places}_of ${CMAKE_MATCH_5})
      endif()
    elseif(line MATCHES "^[^#]")
      message(FATAL_ERROR "${list}: found '${line}', expected NAME in FILE: ABOUT, or a line with - or +")
    endif()
  endwhile()
endmacro()

# Finds a place in a text. Sets `start` and `end` to the offsets, in bytes, of the place's beginning and end.
function(nearmiss_find_place place text)
  string(REGEX REPLACE "([][+.*()^?|$])" "\\\\\\1" pattern "${place_${place}_before}")
  string(REGEX REPLACE "[ \n]+" "[ \n]+" pattern "${pattern}")
  set(found 0)
  set(end 0)
  set(rest "${text}")
  while(rest MATCHES "${pattern}")
    string(FIND "${rest}" "${CMAKE_MATCH_0}" before)
    string(LENGTH "${CMAKE_MATCH_0}" length)
    math(EXPR found "${found} + 1")
    math(EXPR start "${end} + ${before}")
    math(EXPR end "${start} + ${length}")
    string(SUBSTRING "${text}" ${end} -1 rest)
    if(found EQUAL place_${place}_nth)
      set(start ${start} PARENT_SCOPE)
      set(end ${end} PARENT_SCOPE)
    endif()
  endwhile()
  if(NOT found EQUAL place_${place}_of)
    message(FATAL_ERROR "${list}: ${place_${place}_name}: found '${place_${place}_before}' ${found} times in "
      "${place_${place}_file}, expected ${place_${place}_of}")
  endif()
endfunction()

# Sets `result` to a copy of `text`, the text of `file`. The copy has a switch at each place of this file.
function(nearmiss_switch file text result)
  set(spans "")
  foreach(place RANGE 1 ${places})
    if(place_${place}_file STREQUAL file)
      nearmiss_find_place(${place} "${text}")
      math(EXPR length "${end} - ${start}")
      list(APPEND spans ${length}:${start}:${end}:${place})
    endif()
  endforeach()
  list(SORT spans COMPARE NATURAL ORDER DESCENDING)  # the longest first: it may contain others
  set(points "")
  foreach(span IN LISTS spans)
    string(REPLACE ":" ";" span ${span})
    list(POP_FRONT span length start end place)
    set(edited "${place_${place}_after}")
    if(place_${place}_before MATCHES "[;}]$")
      string(APPEND opened_at_${start} "if (makes(${place_${place}_edit})) { ${edited} } else { ")
      string(PREPEND closed_at_${end} " }")
    else()
      string(APPEND opened_at_${start} "(makes(${place_${place}_edit}) ? (${edited}) : (")
      string(PREPEND closed_at_${end} "))")
    endif()
    list(APPEND points ${start} ${end})
  endforeach()
  list(REMOVE_DUPLICATES points)
  list(SORT points COMPARE NATURAL)
  set(copied "")
  set(done 0)
  foreach(point IN LISTS points)
    math(EXPR length "${point} - ${done}")
    string(SUBSTRING "${text}" ${done} ${length} part)
    string(APPEND copied "${part}${closed_at_${point}}${opened_at_${point}}")
    set(done ${point})
  endforeach()
  string(SUBSTRING "${text}" ${done} -1 part)
  set(${result} "${copied}${part}" PARENT_SCOPE)
endfunction()

# nearmiss_edited_copies(LIST SPACE SWITCH HEADER...): copies each header "folder/file.hpp" to
# "SPACE/folder/file.hpp" in the build folder, and puts the copy into the namespace nearmiss::SPACE. A copy
# has a switch for each edit of its header in the file LIST, which names headers without their folders. The
# copies include each other in place of the originals. They also include the header SWITCH, which declares
# `makes`. The compiler gives no warnings about the copies. "SPACE/edits.inc" is the table of the edits.
function(nearmiss_edited_copies list space switch)
  nearmiss_read_edits(${list})
  list(TRANSFORM ARGN REPLACE ".*/" "" OUTPUT_VARIABLE files)
  foreach(place RANGE 1 ${places})
    if(NOT place_${place}_file IN_LIST files)
      message(FATAL_ERROR "${list}: ${place_${place}_name}: found the file ${place_${place}_file}, expected one of ${files}")
    endif()
  endforeach()
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${list})
  foreach(header IN LISTS ARGN)
    set(source ${nearmiss_unedited}/${header})
    set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${source})
    cmake_path(GET header FILENAME file)
    file(READ ${source} text)
    nearmiss_switch(${file} "${text}" text)
    string(REPLACE "#pragma once" "#pragma once\n#pragma GCC system_header\n#include \"${switch}\"" text "${text}")
    string(REPLACE "namespace nearmiss {" "namespace nearmiss::${space} {" text "${text}")
    foreach(other IN LISTS ARGN)
      string(REPLACE "#include \"${other}\"" "#include \"${space}/${other}\"" text "${text}")
    endforeach()
    file(CONFIGURE OUTPUT ${PROJECT_BINARY_DIR}/${space}/${header} CONTENT "${text}" @ONLY)
  endforeach()
  file(CONFIGURE OUTPUT ${PROJECT_BINARY_DIR}/${space}/edits.inc CONTENT "${rows}" @ONLY)
endfunction()
