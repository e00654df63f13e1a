# cmake -D SOURCE_DIR= -D OUTPUT= -D VERSION= -P Revision.cmake: writes base/version.cpp, touching it only when it changes.
cmake_minimum_required(VERSION 3.25)
execute_process(COMMAND git -C ${SOURCE_DIR} describe --always --dirty --abbrev=12
  OUTPUT_VARIABLE revision OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
if(NOT revision)
  set(revision unknown)
endif()
file(CONFIGURE OUTPUT ${OUTPUT} @ONLY CONTENT
"#include \"base/version.h\"
namespace windhover {
const char* const version = \"@VERSION@\";
const char* const revision = \"@revision@\";
}
")
