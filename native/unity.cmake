# Unity builds: sources compiled in groups, as most of the time goes into headers. `make build` has the groups of a release,
# so that sources that do not compile together are seen there. Two sources of a group may not share a name in anonymous
# namespaces. A name there that a header has too would hide that one, silently: tests/python/test_native_rooms.py looks for
# such names. <windows.h> makes macros of words like "near", so that the sources that include it are by themselves.

# Puts SOURCES of a target into COUNT groups. A hash of a file's name chooses its group, so that a new file moves no other.
function(koebe_unity_groups target name count)
  foreach(source IN LISTS ARGN)
    string(MD5 hash ${source})
    string(SUBSTRING ${hash} 6 4 digits)
    math(EXPR group "0x${digits} % ${count}")
    file(STRINGS ${CMAKE_CURRENT_SOURCE_DIR}/${source} windows REGEX "#include <windows.h>")
    if(NOT windows)
      set_source_files_properties(${source} TARGET_DIRECTORY ${target} PROPERTIES UNITY_GROUP ${name}${group})
    endif()
  endforeach()
  if(KOEBE_UNITY)
    set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_MODE GROUP DISABLE_PRECOMPILE_HEADERS ON)
  endif()
endfunction()

# Moves SOURCES that include CGAL, Boost's graphs or JSON into one group: these headers take seconds to read and instantiate.
function(koebe_heavy_group target name)
  string(CONCAT include "(<CGAL/|\"planar/(planar_region|meeting_boxes)[.]h\"|\"cut/(edge_graph|disjoint_sets)[.]h\""
    "|<nlohmann/|\"(report/([a-z]+_)?json|io/glb_(container|editor))[.]h\")")
  foreach(source IN LISTS ARGN)
    file(STRINGS ${CMAKE_CURRENT_SOURCE_DIR}/${source} found REGEX "#include ${include}")
    if(found)
      set_source_files_properties(${source} TARGET_DIRECTORY ${target} PROPERTIES UNITY_GROUP ${name})
    endif()
  endforeach()
endfunction()
