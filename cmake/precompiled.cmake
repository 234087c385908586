# Headers from outside that nearly every file reads are parsed once and not two hundred times: a third of the build. None
# of our own is among them, so that an edit never makes them anew. Where a compiler cache is used it does better alone (it keeps
# objects made with precompiled headers only under special settings), and a file that lacks an #include is found.
if(CMAKE_CXX_COMPILER_LAUNCHER OR DEFINED ENV{CMAKE_CXX_COMPILER_LAUNCHER})
  set(precompile OFF)
else()
  set(precompile ON)
endif()
option(FISSURA_PRECOMPILE "Parse the headers that most files read once" ${precompile})

set(precompiled_headers <algorithm> <array> <cmath> <cstdint> <filesystem> <fstream> <functional> <map> <memory> <numeric> <optional>
  <span> <string> <string_view> <utility> <vector> <fmt/core.h>)

# fissura_precompile(FIRST OTHERS...): libraries that are compiled with the same options; the first one parses for all.
function(fissura_precompile first)
  if(NOT FISSURA_PRECOMPILE)
    return()
  endif()
  target_precompile_headers(${first} PRIVATE ${precompiled_headers})
  foreach(other ${ARGN})
    target_precompile_headers(${other} REUSE_FROM ${first})
  endforeach()
endfunction()
