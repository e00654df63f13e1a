#include "base/memory.h"

#include <malloc.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

namespace windhover {

namespace {

double status_bytes(const std::string& entry) {
  std::ifstream status("/proc/self/status");
  double kilobytes = 0;
  for (std::string line; std::getline(status, line);)
    if (line.starts_with(entry)) std::istringstream(line.substr(entry.size())) >> kilobytes;
  return 1024 * kilobytes;
}

}  // namespace

double resident_bytes() { return status_bytes("VmRSS:"); }

double peak_resident_bytes() { return status_bytes("VmHWM:"); }

void use_large_pages(char** arguments) {
#ifdef __GLIBC__
  constexpr const char* kTunables = "GLIBC_TUNABLES";
  std::error_code none;
  const std::string program = std::filesystem::read_symlink("/proc/self/exe", none);
  if (program.empty() || std::getenv(kTunables)) return;
  setenv(kTunables, "glibc.malloc.hugetlb=1", 1);
  execv(program.c_str(), arguments);  // comes back only if it fails, and nothing is lost
#endif
}

void release_free_memory() { malloc_trim(0); }

}  // namespace windhover
