// The memory of this process.
#pragma once

namespace windhover {

/// Resident bytes of this rank, now and at most so far.
double resident_bytes();
double peak_resident_bytes();

/// Gives what has been freed back to the system (MPI libraries make malloc keep it).
void release_free_memory();

/// Has malloc ask for the kernel's large pages (2 MiB): fewer misses in the processor's page tables, which cost twice in a virtual
/// machine. The GNU C library takes such a wish from its environment at the start of a program alone, so this replaces the
/// program by itself, before MPI starts. Returns if GLIBC_TUNABLES is set: this has been done, or the user rules.
void use_large_pages(char** arguments);

}  // namespace windhover
