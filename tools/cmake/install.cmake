# Installs the components that are built: ccd (headers and the CMake target nearmiss::ccd), oracle (a
# library, its headers, the target nearmiss::oracle, and a file for pkg-config), trial (a library, its
# headers and the target nearmiss::trial; see fuzz/CMakeLists.txt) and tools (see tools/CMakeLists.txt).
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

# Headers are installed in include/nearmiss. Only the headers of the templates are installed in
# include/nearmiss/ccd, which has no further folders. Installed headers include "nearmiss/ccd/query.hpp" in
# place of "ccd/query/query.hpp", because the compiler might look for "ccd/query/query.hpp" in a user's folder
# ccd.
set(query arithmetic error kind query scalar)
set(wang advance basic cubic motion pair_bound plane_culling proximity quadratic tolerances ve_culling verdict
  vertex_edge vertex_vertex wang wang_time within)
set(wang/bounds constraints proven solver_errors tight_tolerances)
foreach(room query wang wang/bounds)
  list(TRANSFORM ${room} REPLACE "(.+)" "ccd/${room}/\\1.hpp" OUTPUT_VARIABLE headers)
  list(APPEND templates ${headers})
endforeach()
set(interface ccd/query/queries.h ccd/wang/wang.h oracle/interface/oracle.h oracle/interface/nearmiss.h oracle/interface/nearmiss.hpp
  oracle/interface/contact.hpp)

# nearmiss_install_headers(COMPONENT HEADER...)
function(nearmiss_install_headers component)
  foreach(header IN LISTS ARGN)
    set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/${header})
    file(READ ${PROJECT_SOURCE_DIR}/${header} text)
    string(REGEX REPLACE "#include \"(ccd/query|ccd/wang|oracle/interface)/([a-z_]+\\.h)\"" "#include \"nearmiss/\\2\"" text "${text}")
    string(REGEX REPLACE "#include \"(oracle|fuzz)/interface/" "#include \"nearmiss/" text "${text}")
    if(header MATCHES "^fuzz/")
      string(REGEX REPLACE "#include \"ccd/(nearmiss_[a-z]+\\.hp*)\"" "#include \"nearmiss/ccd/\\1\"" text "${text}")
    endif()
    string(REGEX REPLACE "#include \"ccd/(query|wang/bounds|wang)/" "#include \"nearmiss/ccd/" text "${text}")
    if(header MATCHES "^ccd/.+hpp$")  # a user's compiler must not warn about our templates and Eigen's
      string(REPLACE "#pragma once" "#pragma once\n#pragma GCC system_header" text "${text}")
    endif()
    string(REGEX REPLACE "^(oracle|fuzz)/interface/" "" place ${header})
    string(REGEX REPLACE "^ccd/(query|wang)/([a-z_]+\\.h)$" "\\2" place ${place})
    string(REGEX REPLACE "^ccd/(query|wang/bounds|wang)/" "ccd/" place ${place})
    set(made ${PROJECT_BINARY_DIR}/include/nearmiss/${place})
    file(CONFIGURE OUTPUT ${made} CONTENT "${text}" @ONLY)
    get_filename_component(folder nearmiss/${place} DIRECTORY)
    install(FILES ${made} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/${folder} COMPONENT ${component})
  endforeach()
endfunction()

set(nearmiss_private ${CMAKE_INSTALL_LIBDIR}/nearmiss)  # for files that users do not use directly
set(config ${CMAKE_INSTALL_LIBDIR}/cmake/nearmiss)
set(written ${PROJECT_BINARY_DIR}/install)

# nearmiss_install_target(COMPONENT TARGET): installs a target as nearmiss::COMPONENT, for find_package.
function(nearmiss_install_target component target)
  add_library(nearmiss::${component} ALIAS ${target})  # for projects that have this one as a subdirectory
  target_include_directories(${target} INTERFACE $<BUILD_INTERFACE:${PROJECT_BINARY_DIR}/include>)
  install(TARGETS ${target} EXPORT nearmiss-${component}
    LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT ${component} NAMELINK_COMPONENT ${component}-dev
    INCLUDES DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
  install(EXPORT nearmiss-${component} NAMESPACE nearmiss:: DESTINATION ${config} COMPONENT ${component}-dev)
endfunction()

if("ccd" IN_LIST NEARMISS_COMPONENTS)
  add_library(nearmiss_templates INTERFACE)
  set_target_properties(nearmiss_templates PROPERTIES EXPORT_NAME ccd)
  target_compile_features(nearmiss_templates INTERFACE cxx_std_20)
  # Users of the templates must also round every operation to double; ccd/README.md says why.
  target_compile_options(nearmiss_templates INTERFACE $<$<COMPILE_LANGUAGE:CXX>:-ffp-contract=off>)
  target_link_libraries(nearmiss_templates INTERFACE Eigen3::Eigen)
  nearmiss_install_headers(ccd-dev ${templates} ccd/nearmiss_subject.h ccd/nearmiss_record.h ccd/nearmiss_functions.hpp ccd/subjects/number_options.hpp)
  nearmiss_install_target(ccd nearmiss_templates)
endif()

if("oracle" IN_LIST NEARMISS_COMPONENTS)
  nearmiss_install_headers(oracle-dev ${interface})
  # The C++ interface and the templates share the enumeration of the kinds of queries.
  nearmiss_install_headers(oracle-dev ccd/query/kind.hpp)
  nearmiss_install_target(oracle nearmiss_interface)
  if(IS_ABSOLUTE ${CMAKE_INSTALL_LIBDIR} OR IS_ABSOLUTE ${CMAKE_INSTALL_INCLUDEDIR})
    set(pkgconfig_prefix ${CMAKE_INSTALL_PREFIX})
  else()
    file(RELATIVE_PATH up /${CMAKE_INSTALL_LIBDIR}/pkgconfig /)  # so that the prefix can be moved
    string(REGEX REPLACE "/$" "" pkgconfig_prefix "\${pcfiledir}/${up}")
  endif()
  foreach(place LIBDIR INCLUDEDIR)
    cmake_path(ABSOLUTE_PATH CMAKE_INSTALL_${place} BASE_DIRECTORY "\${prefix}" OUTPUT_VARIABLE pkgconfig_${place})
  endforeach()
  configure_file(${CMAKE_CURRENT_LIST_DIR}/nearmiss.pc.in ${written}/nearmiss.pc @ONLY)
  install(FILES ${written}/nearmiss.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig COMPONENT oracle-dev)
endif()

configure_package_config_file(${CMAKE_CURRENT_LIST_DIR}/nearmissConfig.cmake.in ${written}/nearmissConfig.cmake INSTALL_DESTINATION ${config}
  PATH_VARS CMAKE_INSTALL_INCLUDEDIR)
write_basic_package_version_file(${written}/nearmissConfigVersion.cmake COMPATIBILITY SameMajorVersion)
install(FILES ${PROJECT_SOURCE_DIR}/LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT licence)
foreach(component ccd-dev oracle-dev trial-dev)  # users may install only one of them
  install(FILES ${written}/nearmissConfig.cmake ${written}/nearmissConfigVersion.cmake DESTINATION ${config} COMPONENT ${component})
endforeach()
