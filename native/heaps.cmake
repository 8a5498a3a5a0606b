# Sources compiled several at once, in heaps: most of the time goes into headers. `make build` has the heaps of a release,
# so that what does not compile together is seen there. Two sources of one heap may not have a name twice in nameless
# namespaces. A name there that a header has too would hide that one, silently: tests/python/test_native_rooms.py looks for
# such names. <windows.h> makes macros of words like "near", so that the sources that include it are by themselves.

# Puts SOURCES of a target into COUNT heaps. Which heap, a file's name tells, so that a new file moves no other.
function(koebe_heaps target name count)
  foreach(source IN LISTS ARGN)
    string(MD5 hash ${source})
    string(SUBSTRING ${hash} 6 4 digits)
    math(EXPR heap "0x${digits} % ${count}")
    file(STRINGS ${CMAKE_CURRENT_SOURCE_DIR}/${source} windows REGEX "#include <windows.h>")
    if(NOT windows)
      set_source_files_properties(${source} TARGET_DIRECTORY ${target} PROPERTIES UNITY_GROUP ${name}${heap})
    endif()
  endforeach()
  if(KOEBE_HEAPS)
    set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_MODE GROUP DISABLE_PRECOMPILE_HEADERS ON)
  endif()
endfunction()

# Moves those SOURCES into one heap that include CGAL, Boost's graphs or JSON, which take seconds to read, and to instantiate.
function(koebe_heavy_heap target name)
  string(CONCAT include "(<CGAL/|\"planar/(planar_region|meeting_boxes)[.]h\"|\"cut/(edge_graph|disjoint_sets)[.]h\""
    "|<nlohmann/|\"(report/([a-z]+_)?json|io/glb_(container|editor))[.]h\")")
  foreach(source IN LISTS ARGN)
    file(STRINGS ${CMAKE_CURRENT_SOURCE_DIR}/${source} found REGEX "#include ${include}")
    if(found)
      set_source_files_properties(${source} TARGET_DIRECTORY ${target} PROPERTIES UNITY_GROUP ${name})
    endif()
  endforeach()
endfunction()
