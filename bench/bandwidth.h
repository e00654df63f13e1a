#pragma once
#include <mpi.h>

/// Sustained bandwidth of a = b + s c over arrays much larger than the caches, all ranks at once, bytes per second.
double measured_bandwidth(MPI_Comm comm);
