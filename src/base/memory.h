// The memory of this process.
#pragma once
#include <cstddef>

namespace windhover {

/// Resident bytes of this rank, now and at most so far.
double resident_bytes();
double peak_resident_bytes();

/// Gives what has been freed back to the system (MPI libraries make malloc keep it).
void release_free_memory();

/// Moves an array that is swept in full to the kernel's large pages (2 MiB): fewer misses in the processor's page tables.
/// Only where the kernel offers them (Linux 6.1); elsewhere, and on small arrays, nothing happens.
void use_large_pages(const void* data, std::size_t bytes);
template <class Array>
void use_large_pages(const Array& a) {
  use_large_pages(a.data(), a.size() * sizeof(*a.data()));
}

}  // namespace windhover
