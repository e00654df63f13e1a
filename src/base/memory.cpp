#include "base/memory.h"

#include <malloc.h>

#include <fstream>
#include <sstream>
#include <string>

namespace windhover {

double resident_bytes() {
  std::ifstream status("/proc/self/status");
  double kilobytes = 0;
  for (std::string line; std::getline(status, line);)
    if (line.rfind("VmRSS:", 0) == 0) std::istringstream(line.substr(6)) >> kilobytes;
  return 1024 * kilobytes;
}

void release_free_memory() { malloc_trim(0); }

}  // namespace windhover
