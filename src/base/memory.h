// The memory of this process.
#pragma once

namespace windhover {

/// Resident bytes of this rank now.
double resident_bytes();

/// Gives what has been freed back to the system (MPI libraries make malloc keep it).
void release_free_memory();

}  // namespace windhover
