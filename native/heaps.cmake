# Sources compiled several at once, in heaps: most of the time goes into headers. `make build` has the heaps of a release,
# so that what does not compile together is seen there. Two sources of one heap may not have a name twice in nameless
# namespaces. A name there that a header has too would hide that one, silently: tests/python/test_native_rooms.py looks for
# such names. <windows.h> makes macros of words like "near", so that the sources that include it are by themselves.

# Puts SOURCES of a target into COUNT heaps. Which heap, a file's name tells, so that a new file moves no other. What
# includes CGAL has two heaps of its own, as its headers alone take four seconds.
function(koebe_heaps target name count)
  foreach(source IN LISTS ARGN)
    string(MD5 hash ${source})
    string(SUBSTRING ${hash} 6 4 digits)
    math(EXPR heap "0x${digits} % ${count}")
    file(STRINGS ${CMAKE_CURRENT_SOURCE_DIR}/${source} windows REGEX "#include <windows.h>")
    file(STRINGS ${CMAKE_CURRENT_SOURCE_DIR}/${source} cgal REGEX "#include (<CGAL/|\"planar/(planar_region|meeting_boxes).h\")")
    if(cgal)
      math(EXPR heap "${heap} % 2")
      string(PREPEND heap _cgal)
    endif()
    if(NOT windows)
      set_source_files_properties(${source} TARGET_DIRECTORY ${target} PROPERTIES UNITY_GROUP ${name}${heap})
    endif()
  endforeach()
  if(KOEBE_HEAPS)
    set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_MODE GROUP DISABLE_PRECOMPILE_HEADERS ON)
  endif()
endfunction()

# Moves those SOURCES that have an include of this form into one heap: what it reads takes seconds to read, and to
# instantiate.
function(koebe_heap_of target name include)
  foreach(source IN LISTS ARGN)
    file(STRINGS ${CMAKE_CURRENT_SOURCE_DIR}/${source} found REGEX "#include ${include}")
    if(found)
      set_source_files_properties(${source} TARGET_DIRECTORY ${target} PROPERTIES UNITY_GROUP ${name})
    endif()
  endforeach()
endfunction()
