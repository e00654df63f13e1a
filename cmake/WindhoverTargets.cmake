# windhover_library(NAME PUBLIC LIBS...): src/NAME/*.cpp and src/NAME/*/*.cpp as one static library windhover_NAME.
add_library(windhover_flags INTERFACE)
target_include_directories(windhover_flags INTERFACE ${CMAKE_SOURCE_DIR}/src)
# -fno-math-errno -fno-trapping-math: lets sqrt and selects vectorise; results stay IEEE exact.
target_compile_options(windhover_flags INTERFACE -Wall -Wextra -Wno-psabi -fno-math-errno -fno-trapping-math)
if(WINDHOVER_NATIVE)
  target_compile_options(windhover_flags INTERFACE -march=native -mprefer-vector-width=512)
endif()
if(WINDHOVER_SANITIZE)
  target_compile_options(windhover_flags INTERFACE -fsanitize=address,undefined -fno-omit-frame-pointer)
  target_link_options(windhover_flags INTERFACE -fsanitize=address,undefined)
endif()
find_program(CCACHE ccache)
if(CCACHE)
  set(CMAKE_CXX_COMPILER_LAUNCHER ${CCACHE})
endif()

function(windhover_library name)
  file(GLOB sources CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/src/${name}/*.cpp
    ${CMAKE_SOURCE_DIR}/src/${name}/*/*.cpp)
  add_library(windhover_${name} STATIC ${sources})
  target_link_libraries(windhover_${name} ${ARGN})
  target_link_libraries(windhover_${name} PUBLIC windhover_flags)
endfunction()

# windhover_test(FOLDER RANKS 1 2 [LABELS ...] LIBS ...): tests/FOLDER/test_*.cpp as one Catch2 program, run on each number of ranks.
function(windhover_test folder)
  cmake_parse_arguments(ARG "" "" "RANKS;LIBS" ${ARGN})
  file(GLOB sources CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/tests/${folder}/test_*.cpp)
  if(NOT sources)
    return()
  endif()
  add_executable(test_${folder} ${sources} ${CMAKE_SOURCE_DIR}/tests/main.cpp)
  target_link_libraries(test_${folder} PRIVATE windhover_flags ${ARG_LIBS})
  target_include_directories(test_${folder} PRIVATE ${CMAKE_SOURCE_DIR}/tests)
  target_compile_definitions(test_${folder} PRIVATE
    WINDHOVER_SOURCE_DIR="${CMAKE_SOURCE_DIR}" WINDHOVER_BINARY_DIR="${CMAKE_BINARY_DIR}"
    WINDHOVER_PYTHON="${WINDHOVER_PYTHON}")
  foreach(ranks ${ARG_RANKS})
    add_test(NAME ${folder}_${ranks}
      COMMAND ${MPIEXEC_EXECUTABLE} --oversubscribe -n ${ranks} $<TARGET_FILE:test_${folder}>)
    set_tests_properties(${folder}_${ranks} PROPERTIES PROCESSORS ${ranks})
  endforeach()
endfunction()
