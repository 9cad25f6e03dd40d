# The Debian packages that CPack makes (tools/package): one for each group of components.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME nearmiss)
set(CPACK_DEBIAN_PACKAGE_RELEASE 0upstream1)  # sorts before release 1, which Debian's own package would have
set(version ${PROJECT_VERSION}-${CPACK_DEBIAN_PACKAGE_RELEASE})
set(maintainer "nearmiss maintainers <maintainers@nearmiss.invalid>")
if(DEFINED ENV{DEBFULLNAME} AND DEFINED ENV{DEBEMAIL})
  set(maintainer "$ENV{DEBFULLNAME} <$ENV{DEBEMAIL}>")
endif()
set(CPACK_DEBIAN_PACKAGE_MAINTAINER "${maintainer}")
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_COMPRESSION_TYPE xz)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_ENABLE_COMPONENT_DEPENDS OFF)
set(CPACK_COMPONENTS_GROUPING ONE_PER_GROUP)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(CPACK_STRIP_FILES ON)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
set(CPACK_COMPONENTS_ALL "")
set(debian ${PROJECT_BINARY_DIR}/debian)

string(TIMESTAMP date "%a, %d %b %Y %H:%M:%S +0000" UTC)  # the date of SOURCE_DATE_EPOCH, if it is set
file(CONFIGURE OUTPUT ${debian}/changelog.Debian CONTENT "nearmiss (${version}) unstable; urgency=medium

  * Release ${PROJECT_VERSION}.

 -- ${maintainer}  ${date}
" @ONLY)
execute_process(COMMAND gzip -9nkf ${debian}/changelog.Debian COMMAND_ERROR_IS_FATAL ANY)

# nearmiss_package(NAME SECTION COMPONENT...): makes a package of these components. The file
# tools/debian/NAME.txt describes the package.
macro(nearmiss_package name section)
  string(MAKE_C_IDENTIFIER ${name} group)
  string(TOUPPER ${group} GROUP)
  set(doc ${CMAKE_INSTALL_DATADIR}/doc/${name})
  install(FILES ${PROJECT_SOURCE_DIR}/tools/debian/copyright ${debian}/changelog.Debian.gz DESTINATION ${doc}
    COMPONENT debian-${name} EXCLUDE_FROM_ALL)
  foreach(component ${ARGN} debian-${name})
    list(APPEND CPACK_COMPONENTS_ALL ${component})
    string(TOUPPER ${component} COMPONENT)
    set(CPACK_COMPONENT_${COMPONENT}_GROUP ${group})
  endforeach()
  set(CPACK_DEBIAN_${GROUP}_PACKAGE_NAME ${name})
  set(CPACK_DEBIAN_${GROUP}_PACKAGE_SECTION ${section})
  file(READ ${PROJECT_SOURCE_DIR}/tools/debian/${name}.txt CPACK_DEBIAN_${GROUP}_DESCRIPTION)
endmacro()

nearmiss_package(libnearmiss1 libs oracle)
nearmiss_package(libnearmiss-trial1 libs trial)
nearmiss_package(libnearmiss-dev libdevel oracle-dev ccd-dev trial-dev)
nearmiss_package(nearmiss science tools)
nearmiss_package(python3-nearmiss python python)
set(control shlibs symbols triggers)
list(TRANSFORM control PREPEND ${PROJECT_SOURCE_DIR}/tools/debian/ OUTPUT_VARIABLE CPACK_DEBIAN_LIBNEARMISS1_PACKAGE_CONTROL_EXTRA)
set(CPACK_DEBIAN_LIBNEARMISS_TRIAL1_PACKAGE_CONTROL_EXTRA ${PROJECT_SOURCE_DIR}/tools/debian/trial/shlibs
  ${PROJECT_SOURCE_DIR}/tools/debian/triggers)
set(CPACK_DEBIAN_LIBNEARMISS_DEV_PACKAGE_DEPENDS
  "libnearmiss1 (= ${version}), libnearmiss-trial1 (= ${version}), libeigen3-dev")
set(CPACK_DEBIAN_NEARMISS_PACKAGE_SUGGESTS "libnearmiss-dev")
# The extension modules work only with the version of Python for which they are built.
math(EXPR next "${Python_VERSION_MINOR} + 1")
set(CPACK_DEBIAN_PYTHON3_NEARMISS_PACKAGE_DEPENDS
  "python3 (>= 3.${Python_VERSION_MINOR}~), python3 (<< 3.${next}), python3-numpy (>= 1:1.22)")
set(CPACK_DEBIAN_PYTHON3_NEARMISS_PACKAGE_CONTROL_EXTRA ${PROJECT_SOURCE_DIR}/tools/debian/python3/postinst ${PROJECT_SOURCE_DIR}/tools/debian/python3/prerm)
include(CPack)
