# SPDX-License-Identifier: MIT
# Two thirds of what a file takes to compile go into headers and into templates that its neighbours
# instantiate too. With KAAMOS_BATCHES the sources of a target are compiled several at a time, which
# halves the processor time of a whole build. In return a change of one file compiles its whole batch,
# compile_commands.json has no entries for tools to find, and a forgotten #include does not show. So the
# presets for development and for sanitizers compile each file by itself. CMake's own unity builds put
# neighbours together without looking: one in six of such batches would hold two equal names in unnamed
# namespaces, which is no mistake in the sources, or two directives that make names ambiguous.
include_guard()

option(KAAMOS_BATCHES "Compile several sources at a time" OFF)
set(KAAMOS_BATCH_SIZE 12 CACHE STRING "How many sources are compiled at a time at most")
option(KAAMOS_BATCH_ALL "Compile together also what runs faster compiled by itself (KAAMOS_ALONE)" OFF)
define_property(TARGET PROPERTY KAAMOS_ALONE BRIEF_DOCS "Each source of the target is compiled by itself")
define_property(SOURCE PROPERTY KAAMOS_ALONE BRIEF_DOCS "The source is compiled by itself")

# kaamos_collect_batched(variable folder...): the targets of these folders and below whose sources may
# be compiled together. Those that kaamos-hlsl generates are not among them: they are large, and all
# declare the same names.
function(kaamos_collect_batched result)
  set(batched)
  foreach(folder IN LISTS ARGN)
    get_property(targets DIRECTORY "${folder}" PROPERTY BUILDSYSTEM_TARGETS)
    foreach(target IN LISTS targets)
      get_target_property(linked ${target} LINK_LIBRARIES)
      get_target_property(alone ${target} KAAMOS_ALONE)
      if("kaamos_build_flags" IN_LIST linked AND (KAAMOS_BATCH_ALL OR NOT alone))
        list(APPEND batched ${target})
      endif()
    endforeach()
    get_property(children DIRECTORY "${folder}" PROPERTY SUBDIRECTORIES)
    kaamos_collect_batched(nested ${children})
    list(APPEND batched ${nested})
  endforeach()
  set(${result} ${batched} PARENT_SCOPE)
endfunction()

# kaamos_collect_batched_sources(variable target): the target's sources that have no flags of their own,
# relative to the project's folder.
function(kaamos_collect_batched_sources result target)
  set(batched)
  get_target_property(sources ${target} SOURCES)
  get_target_property(folder ${target} SOURCE_DIR)
  foreach(source IN LISTS sources)
    if(NOT source MATCHES "^[^$]*[.]cpp$")
      continue()
    endif()
    get_filename_component(source "${source}" ABSOLUTE BASE_DIR "${folder}")
    set(own)
    set(properties GENERATED COMPILE_OPTIONS COMPILE_DEFINITIONS)
    if(NOT KAAMOS_BATCH_ALL)
      list(APPEND properties KAAMOS_ALONE)
    endif()
    foreach(property IN LISTS properties)
      get_source_file_property(value "${source}" TARGET_DIRECTORY ${target} ${property})
      if(value)
        set(own ${property})
      endif()
    endforeach()
    if(NOT own)
      file(RELATIVE_PATH source "${PROJECT_SOURCE_DIR}" "${source}")
      list(APPEND batched "${source}")
    endif()
  endforeach()
  set(${result} ${batched} PARENT_SCOPE)
endfunction()

# kaamos_collect_names(names directives source): what a source declares at the start of a line, which is
# outside of classes and functions, and its using directives.
function(kaamos_collect_names names directives source)
  file(STRINGS "${PROJECT_SOURCE_DIR}/${source}" lines REGEX "^[A-Za-z_#]")
  set(found)
  set(used)
  foreach(line IN LISTS lines)
    if(line MATCHES "^using namespace ")
      list(APPEND used "${line}")
    elseif(line MATCHES "^#define ([A-Za-z0-9_]+)")
      list(APPEND found ${CMAKE_MATCH_1})
    elseif(line MATCHES "^(static |inline )*(constexpr|const) .* =")
      string(REGEX MATCHALL "[A-Za-z0-9_]+[^ ]* =" constants "${line}")
      list(TRANSFORM constants REPLACE "[^A-Za-z0-9_].*" "")
      list(APPEND found ${constants})
    elseif(NOT line MATCHES "^#" AND NOT line MATCHES "^(namespace|TEST|INSTANTIATE)"
           AND line MATCHES "[ *&]([A-Za-z0-9_]+)( =|{| {|;| :[^:]|[(]|[[])")
      list(APPEND found ${CMAKE_MATCH_1})
    endif()
  endforeach()
  list(REMOVE_ITEM found "" const)  # of member functions
  set(${names} "${found}" PARENT_SCOPE)
  set(${directives} "${used}" PARENT_SCOPE)
endfunction()

# kaamos_choose_batches(prefix target): sets prefix_count and the lists prefix_1, prefix_2, ... A source
# joins the first batch that has room, the same using directives and none of its names.
function(kaamos_choose_batches prefix target)
  kaamos_collect_batched_sources(sources ${target})
  set(count 0)
  foreach(source IN LISTS sources)
    kaamos_collect_names(names directives "${source}")
    set(number 1)
    while(number LESS_EQUAL count)
      list(LENGTH batch_${number} length)
      set(shared)
      if(length LESS KAAMOS_BATCH_SIZE AND directives STREQUAL directives_${number})
        set(shared ${names_${number}})
        list(REMOVE_ITEM shared ${names} "")
        list(LENGTH shared left)
        list(LENGTH names_${number} all)
        if(left EQUAL all)
          break()
        endif()
      endif()
      math(EXPR number "${number} + 1")
    endwhile()
    if(number GREATER count)
      set(count ${number})
      set(directives_${number} "${directives}")
    endif()
    list(APPEND batch_${number} "${source}")
    list(APPEND names_${number} ${names})
  endforeach()
  if(NOT count)
    set(${prefix}_count 0 PARENT_SCOPE)
    return()
  endif()
  foreach(number RANGE 1 ${count})
    set(${prefix}_${number} ${batch_${number}} PARENT_SCOPE)
  endforeach()
  set(${prefix}_count ${count} PARENT_SCOPE)
endfunction()

function(kaamos_batch_target target)
  kaamos_choose_batches(batch ${target})
  if(NOT batch_count)
    return()
  endif()
  get_target_property(folder ${target} BINARY_DIR)
  foreach(number RANGE 1 ${batch_count})
    list(LENGTH batch_${number} length)
    if(length LESS 2)
      continue()
    endif()
    # CMake does not compile sources that count as headers.
    list(TRANSFORM batch_${number} PREPEND "${PROJECT_SOURCE_DIR}/" OUTPUT_VARIABLE paths)
    set_source_files_properties(${paths} TARGET_DIRECTORY ${target} PROPERTIES HEADER_FILE_ONLY ON)
    # Paths below the project's folder, so that the compiler cache serves several checkouts.
    list(TRANSFORM batch_${number} REPLACE "(.+)" "#include \"\\1\"" OUTPUT_VARIABLE text)
    list(JOIN text "\n" text)
    set(file "${folder}/batches/${target}_${number}.cpp")
    file(CONFIGURE OUTPUT "${file}" @ONLY CONTENT
"// Made by cmake/KaamosBatches.cmake. If names of these files clash, run CMake again: it separates them.
@text@
")
    target_sources(${target} PRIVATE "${file}")
    # A local name may be that of a constant of another file, and the classes of a source file may have
    # members whose types are in its unnamed namespace, of which g++ warns in headers.
    set_source_files_properties("${file}" TARGET_DIRECTORY ${target} PROPERTIES
      COMPILE_OPTIONS "-Wno-shadow;$<$<CXX_COMPILER_ID:GNU>:-Wshadow=local>;$<$<CXX_COMPILER_ID:GNU>:-Wno-subobject-linkage>")
  endforeach()
  target_include_directories(${target} PRIVATE "${PROJECT_SOURCE_DIR}")
endfunction()

# Called once, after every folder was added.
function(kaamos_batch_sources)
  if(NOT KAAMOS_BATCHES)
    return()
  endif()
  kaamos_collect_batched(targets "${PROJECT_SOURCE_DIR}")
  foreach(target IN LISTS targets)
    kaamos_batch_target(${target})
  endforeach()
endfunction()
