#include "base/memory.h"

#include <malloc.h>
#include <sys/mman.h>

#include <cstdint>
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

void use_large_pages(const void* data, std::size_t bytes) {
#ifdef __linux__
  constexpr std::uintptr_t kPage = 2 << 20;
  constexpr int kCollapse = 25;  // MADV_COLLAPSE, newer than the C library's headers
  const auto begin = (reinterpret_cast<std::uintptr_t>(data) + kPage - 1) / kPage * kPage;
  const auto end = (reinterpret_cast<std::uintptr_t>(data) + bytes) / kPage * kPage;
  if (begin < end) madvise(reinterpret_cast<void*>(begin), end - begin, kCollapse);
#endif
}

void release_free_memory() { malloc_trim(0); }

}  // namespace windhover
