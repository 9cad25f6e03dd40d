# Makes the copies of ccd/ that defects.cpp compiles, with the edits of edits.txt.
include(${PROJECT_SOURCE_DIR}/tools/cmake/edited_copies.cmake)
set(templates advance cubic motion plane_culling proximity quadratic ve_culling vertex_edge vertex_vertex wang wang_time within)
list(TRANSFORM templates REPLACE "(.+)" "ccd/wang/\\1.hpp")
nearmiss_edited_copies(${CMAKE_CURRENT_LIST_DIR}/edits.txt defective fuzz/subjects/defects/edits.hpp ${templates})
set_source_files_properties(${PROJECT_SOURCE_DIR}/fuzz/subjects/defects.cpp PROPERTIES INCLUDE_DIRECTORIES ${PROJECT_BINARY_DIR})
