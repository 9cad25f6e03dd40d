# nearmiss_add_trial(NAME name SOURCES adapter.cpp [TARGET library...] [CASES 100000] [SEED 1] [SEPARATION h|drawn]
#                    [FAMILIES name...] [OPTIONS option...]): builds a plug-in of the adapter, which describes a
# detector (nearmiss/ccd/nearmiss_functions.hpp), and adds a test that puts the plug-in on trial. The test
# writes its results to name.xml in the build folder, as JUnit's XML. OPTIONS are further options of nearmiss
# fuzz.
function(nearmiss_add_trial)
  cmake_parse_arguments(PARSE_ARGV 0 trial "" "NAME;CASES;SEED;SEPARATION" "SOURCES;TARGET;FAMILIES;OPTIONS")
  if(NOT trial_NAME OR NOT trial_SOURCES OR trial_UNPARSED_ARGUMENTS OR trial_KEYWORDS_MISSING_VALUES)
    message(FATAL_ERROR "nearmiss_add_trial: found '${trial_UNPARSED_ARGUMENTS}${trial_KEYWORDS_MISSING_VALUES}', expected NAME and SOURCES, a value for each argument, and none but those that it lists")
  endif()
  # The caller's scope may lack the package's targets, if another folder of the project has found the package.
  find_package(nearmiss 1 REQUIRED COMPONENTS tools PATHS ${CMAKE_CURRENT_FUNCTION_LIST_DIR} NO_DEFAULT_PATH)
  if(NOT DEFINED trial_CASES)
    set(trial_CASES 100000)
  endif()
  foreach(option SEED SEPARATION)
    if(NOT "${trial_${option}}" STREQUAL "")
      string(TOLOWER ${option} name)
      list(APPEND given --${name} ${trial_${option}})
    endif()
  endforeach()
  if(trial_FAMILIES)
    list(JOIN trial_FAMILIES "," families)
    list(APPEND given --family ${families})
  endif()
  if(NOT CMAKE_BUILD_TYPE AND NOT CMAKE_CONFIGURATION_TYPES)
    message(STATUS "nearmiss_add_trial: CMAKE_BUILD_TYPE is empty, so ${trial_NAME} is not optimised and takes longer")
  endif()
  add_library(${trial_NAME}_ccd MODULE ${trial_SOURCES})
  target_include_directories(${trial_NAME}_ccd PRIVATE ${nearmiss_PLUGIN_INCLUDE_DIR})
  target_link_libraries(${trial_NAME}_ccd PRIVATE ${trial_TARGET})
  target_compile_features(${trial_NAME}_ccd PRIVATE cxx_std_17)
  add_test(NAME ${trial_NAME} COMMAND nearmiss::nearmiss fuzz --subject $<TARGET_FILE:${trial_NAME}_ccd> --cases ${trial_CASES}
    ${given} --quiet --junit ${CMAKE_CURRENT_BINARY_DIR}/${trial_NAME}.xml ${trial_OPTIONS})
endfunction()
