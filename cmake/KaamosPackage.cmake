# SPDX-License-Identifier: MIT
# cmake --install and find_package(kaamos CONFIG). Called once, after all folders have been added,
# so that a new library or dependency is packaged without a line here.
include_guard()
include(CMakePackageConfigHelpers)

set(KAAMOS_PACKAGE_DIR "${CMAKE_INSTALL_LIBDIR}/cmake/kaamos")
# Headers below these folders are included by their path relative to the folder.
set(KAAMOS_PACKAGE_INCLUDE_DIRS "${CMAKE_INSTALL_INCLUDEDIR}" "${CMAKE_INSTALL_INCLUDEDIR}/kaamos")

define_property(TARGET PROPERTY KAAMOS_NOT_INSTALLED BRIEF_DOCS "The library serves programs of this tree alone")

# kaamos_collect_libraries(variable folder...): collects every library target in these folders and
# below, unless it is KAAMOS_NOT_INSTALLED.
function(kaamos_collect_libraries result)
  set(libraries)
  foreach(folder IN LISTS ARGN)
    get_property(targets DIRECTORY "${folder}" PROPERTY BUILDSYSTEM_TARGETS)
    foreach(target IN LISTS targets)
      get_target_property(type ${target} TYPE)
      get_target_property(stays ${target} KAAMOS_NOT_INSTALLED)
      if(NOT stays AND type MATCHES "^(STATIC|SHARED|INTERFACE|OBJECT)_LIBRARY$")
        list(APPEND libraries ${target})
      endif()
    endforeach()
    get_property(children DIRECTORY "${folder}" PROPERTY SUBDIRECTORIES)
    kaamos_collect_libraries(nested ${children})
    list(APPEND libraries ${nested})
  endforeach()
  set(${result} ${libraries} PARENT_SCOPE)
endfunction()

# Gives a target the same name in this build as in the installed package.
function(kaamos_add_alias name target)
  if(TARGET kaamos::${name})
    return()
  endif()
  get_target_property(type ${target} TYPE)
  if(type STREQUAL "EXECUTABLE")
    add_executable(kaamos::${name} ALIAS ${target})
  else()
    add_library(kaamos::${name} ALIAS ${target})
  endif()
endfunction()

# The include folders of the source tree serve the build only; an installed library has its own.
function(kaamos_make_includes_relocatable target)
  get_target_property(folders ${target} INTERFACE_INCLUDE_DIRECTORIES)
  set(relocatable)
  foreach(folder IN LISTS folders)
    if(folder AND NOT folder MATCHES "^\\$<(BUILD|INSTALL)_INTERFACE:")
      set(folder "$<BUILD_INTERFACE:${folder}>")
    endif()
    list(APPEND relocatable ${folder})
  endforeach()
  list(FILTER relocatable EXCLUDE REGEX "NOTFOUND$")
  foreach(folder IN LISTS KAAMOS_PACKAGE_INCLUDE_DIRS)
    list(APPEND relocatable "$<INSTALL_INTERFACE:${folder}>")
  endforeach()
  set_target_properties(${target} PROPERTIES INTERFACE_INCLUDE_DIRECTORIES "${relocatable}")
endfunction()

# find_library gives a library an absolute path. The package needs its bare name, which works
# elsewhere.
function(kaamos_make_links_relocatable target)
  get_target_property(linked ${target} INTERFACE_LINK_LIBRARIES)
  if(NOT linked)
    return()
  endif()
  set(relocatable)
  foreach(item IN LISTS linked)
    if(item MATCHES "^(\\$<LINK_ONLY:)?(/[^>]*/lib([^/>]+)[.](a|so))>?$")
      list(APPEND relocatable "$<BUILD_INTERFACE:${item}>" "$<INSTALL_INTERFACE:${CMAKE_MATCH_3}>")
    else()
      list(APPEND relocatable "${item}")
    endif()
  endforeach()
  set_target_properties(${target} PROPERTIES INTERFACE_LINK_LIBRARIES "${relocatable}")
endfunction()

# kaamos_collect_dependencies(variable target...): the find_dependency lines for everything these
# targets link. "TBB::tbb" comes from package TBB; Debian's Embree is the one target without a
# namespace.
function(kaamos_collect_dependencies result)
  set(lines)
  foreach(target IN LISTS ARGN)
    get_target_property(linked ${target} INTERFACE_LINK_LIBRARIES)
    foreach(item IN LISTS linked)
      string(REGEX REPLACE "^\\$<LINK_ONLY:(.*)>$" "\\1" item "${item}")
      if(item MATCHES "^embree[0-9]*$")
        list(APPEND lines "find_dependency(embree)")
      elseif(item MATCHES "^Boost::([a-z_]+)$")
        list(APPEND lines "find_dependency(Boost CONFIG COMPONENTS ${CMAKE_MATCH_1})")
      elseif(item MATCHES "^kaamos::")
        continue()
      elseif(item MATCHES "^([A-Za-z0-9_]+)::")
        list(APPEND lines "find_dependency(${CMAKE_MATCH_1})")
      endif()
    endforeach()
  endforeach()
  list(REMOVE_DUPLICATES lines)
  list(SORT lines)
  list(JOIN lines "\n" text)
  set(${result} "${text}" PARENT_SCOPE)
endfunction()

function(kaamos_install_headers)
  foreach(folder IN ITEMS rtapi/include runtime/shader/include)
    if(IS_DIRECTORY "${PROJECT_SOURCE_DIR}/${folder}")
      install(DIRECTORY "${PROJECT_SOURCE_DIR}/${folder}/" DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}")
    endif()
  endforeach()
  # What D3D12 programs include instead of Win32's headers, and Microsoft's own. They are in a folder
  # of their own, because they have the names of Windows' headers.
  if(TARGET kaamos_d3d12)
    install(DIRECTORY "${PROJECT_SOURCE_DIR}/d3d12/include/win" "${KAAMOS_DIRECTX_INCLUDE_DIR}/directx"
      DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}/kaamos-d3d12" FILES_MATCHING PATTERN "*.h")
    install(FILES "${KAAMOS_DIRECTX_INCLUDE_DIR}/wsl/wrladapter.h" "${KAAMOS_DIRECTX_INCLUDE_DIR}/wsl/winadapter.h"
      DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}/kaamos-d3d12/wsl")
  endif()
  # Headers of the effects include each other as "effects/...", which also works below
  # include/kaamos. Their shader files are installed with them.
  file(READ "${PROJECT_SOURCE_DIR}/cmake/Doxyfile" manual)
  string(REGEX MATCH "\nEXCLUDE_PATTERNS[^\n\\]*(\\\n[^\n\\]*)*" internal "${manual}")
  string(REGEX MATCHALL "[*][^ \n\\]+" patterns "${internal}")
  set(internal)
  foreach(pattern IN LISTS patterns)
    list(APPEND internal PATTERN "${pattern}" EXCLUDE)
  endforeach()
  install(DIRECTORY "${PROJECT_SOURCE_DIR}/effects" DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}/kaamos"
    FILES_MATCHING PATTERN "*.h" PATTERN "*.inc" PATTERN "*.hlsl" PATTERN "*.hlsli" PATTERN "testdata" EXCLUDE
    PATTERN "effects/measure" EXCLUDE ${internal})
endfunction()

# Components: runtime, d3d12 (shared libraries), tools (programs), python; all else is for development.
function(kaamos_install_package)
  set(CMAKE_INSTALL_DEFAULT_COMPONENT_NAME development)
  kaamos_collect_libraries(libraries "${PROJECT_SOURCE_DIR}/runtime" "${PROJECT_SOURCE_DIR}/rtapi"
    "${PROJECT_SOURCE_DIR}/d3d12" "${PROJECT_SOURCE_DIR}/effects")
  foreach(library IN LISTS libraries)
    string(REGEX REPLACE "^kaamos_" "" name ${library})
    set_target_properties(${library} PROPERTIES EXPORT_NAME ${name})
    kaamos_add_alias(${name} ${library})
    kaamos_make_includes_relocatable(${library})
    kaamos_make_links_relocatable(${library})
  endforeach()
  if(TARGET kaamos_d3d12_shared)
    list(REMOVE_ITEM libraries kaamos_d3d12_shared)
    install(TARGETS kaamos_d3d12_shared EXPORT kaamosTargets LIBRARY DESTINATION "${CMAKE_INSTALL_LIBDIR}"
      COMPONENT d3d12 NAMELINK_COMPONENT development)
  endif()
  list(APPEND libraries kaamos_build_flags)
  kaamos_collect_dependencies(KAAMOS_DEPENDENCIES ${libraries})

  set(programs)
  foreach(program IN ITEMS kaamos-hlsl kaamos-dxc kaamos-import-vcxproj northlight kaamos-conformance kaamos-test kaamos-verify)
    if(TARGET ${program})
      list(APPEND programs ${program})
      kaamos_add_alias(${program} ${program})
    endif()
  endforeach()
  install(TARGETS ${libraries} ${programs} EXPORT kaamosTargets
    ARCHIVE DESTINATION "${CMAKE_INSTALL_LIBDIR}" COMPONENT development
    LIBRARY DESTINATION "${CMAKE_INSTALL_LIBDIR}" COMPONENT runtime NAMELINK_COMPONENT development
    OBJECTS DESTINATION "${CMAKE_INSTALL_LIBDIR}/kaamos" COMPONENT development
    RUNTIME DESTINATION "${CMAKE_INSTALL_BINDIR}" COMPONENT tools)
  # Everything that is installed: what scripts/package builds.
  add_custom_target(package-files DEPENDS ${libraries} ${programs})
  foreach(target IN ITEMS kaamos_d3d12_shared kaamos_python)
    if(TARGET ${target})
      add_dependencies(package-files ${target})
    endif()
  endforeach()
  install(EXPORT kaamosTargets NAMESPACE kaamos:: DESTINATION "${KAAMOS_PACKAGE_DIR}")
  kaamos_install_headers()

  configure_package_config_file("${PROJECT_SOURCE_DIR}/cmake/kaamosConfig.cmake.in"
    "${PROJECT_BINARY_DIR}/kaamosConfig.cmake" INSTALL_DESTINATION "${KAAMOS_PACKAGE_DIR}"
    PATH_VARS CMAKE_INSTALL_INCLUDEDIR)
  write_basic_package_version_file("${PROJECT_BINARY_DIR}/kaamosConfigVersion.cmake"
    COMPATIBILITY SameMinorVersion)
  install(FILES "${PROJECT_BINARY_DIR}/kaamosConfig.cmake" "${PROJECT_BINARY_DIR}/kaamosConfigVersion.cmake"
    DESTINATION "${KAAMOS_PACKAGE_DIR}")
  install(FILES "${PROJECT_SOURCE_DIR}/cmake/KaamosShaders.cmake" "${PROJECT_SOURCE_DIR}/cmake/KaamosD3d12.cmake"
    DESTINATION "${KAAMOS_PACKAGE_DIR}" OPTIONAL)
  install(FILES "${PROJECT_SOURCE_DIR}/runtime/shader/gdb/kaamos_gdb.py"
    DESTINATION "${CMAKE_INSTALL_DATADIR}/kaamos/gdb")
  # kaamos-test carries it with it; editors and other compilers look for a file.
  install(FILES "${PROJECT_SOURCE_DIR}/tests/shaders/include/kaamos/test.hlsli"
    DESTINATION "${CMAKE_INSTALL_DATADIR}/kaamos/hlsl/kaamos")
  install(FILES "${PROJECT_SOURCE_DIR}/LICENSE" DESTINATION "${CMAKE_INSTALL_DOCDIR}")
endfunction()
