# One folder = one namespace = one library. A module names the modules above it that it includes; the order of
# src/fissura/CMakeLists.txt is the order of the layers, so an arrow that points the wrong way does not link.
#
#   fissura_module(mesh NEEDS core geometry LIBRARIES gmsh)
function(fissura_module name)
  cmake_parse_arguments(M "" "" "NEEDS;LIBRARIES" ${ARGN})
  file(GLOB sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/${name}/*.cpp)
  set(target fissura_${name})
  list(TRANSFORM M_NEEDS PREPEND fissura_)
  if(sources)
    add_library(${target} STATIC ${sources})
    target_include_directories(${target} PUBLIC ${PROJECT_SOURCE_DIR}/src)
    target_link_libraries(${target} PUBLIC ${M_NEEDS} ${M_LIBRARIES})
  else()
    add_library(${target} INTERFACE)
    target_include_directories(${target} INTERFACE ${PROJECT_SOURCE_DIR}/src)
    target_link_libraries(${target} INTERFACE ${M_NEEDS} ${M_LIBRARIES})
  endif()
endfunction()

# One test program per module and kind: tests/<kind>/<module>/*.cpp, linked to that module alone.
function(fissura_tests kind module)
  file(GLOB sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/${kind}/${module}/*.cpp)
  if(NOT sources)
    return()
  endif()
  set(target ${kind}_${module})
  add_executable(${target} ${sources})
  target_link_libraries(${target} PRIVATE fissura_${module} GTest::gtest GTest::gtest_main)
  target_include_directories(${target} PRIVATE ${PROJECT_SOURCE_DIR}/tests)
  target_compile_definitions(${target} PRIVATE
    FISSURA_EXAMPLES="${PROJECT_SOURCE_DIR}/examples" FISSURA_TEST_DATA="${CMAKE_CURRENT_SOURCE_DIR}/${kind}/${module}")
  if(NOT TARGET tests_${kind})
    add_custom_target(tests_${kind}) # all programs of one kind
  endif()
  add_dependencies(tests_${kind} ${target})
  gtest_discover_tests(${target} TEST_PREFIX "${kind}." DISCOVERY_TIMEOUT 600 PROPERTIES TIMEOUT 1500)
endfunction()
